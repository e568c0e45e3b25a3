# SPDX-License-Identifier: BSD-3-Clause
"""Radiometric Statistics against closed forms."""
import numpy as np
from checks import array, close, fails, points, run_all
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkIntArray, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import (vtkCellArray, vtkCompositeDataSet, vtkMultiBlockDataSet,
                                           vtkPolyData)
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkradiometry import vtkRadiometricStatistics, vtkWorkPlaneSource


def surface(points, cells, cell_data=None, point_data=None):
    data = vtkPolyData()
    positions = vtkPoints()
    positions.SetData(numpy_to_vtk(np.array(points, float), deep=True))
    data.SetPoints(positions)
    polys = vtkCellArray()
    for cell in cells:
        polys.InsertNextCell(len(cell), cell)
    data.SetPolys(polys)
    for where, arrays in ((data.GetCellData(), cell_data), (data.GetPointData(), point_data)):
        for name, values in (arrays or {}).items():
            array = numpy_to_vtk(np.array(values), deep=True)
            array.SetName(name)
            where.AddArray(array)
    return data


def table(data, *names, **properties):
    """{(block, group, array, component): row}"""
    statistics = vtkRadiometricStatistics()
    statistics.SetInputDataObject(data)
    for name in names:
        statistics.AddArrayName(name)
    for name, value in properties.items():
        getattr(statistics, "Set" + name)(value)
    statistics.Update()
    out = statistics.GetOutput()
    columns = [out.GetColumnName(i) for i in range(out.GetNumberOfColumns())]
    rows = {}
    for i in range(out.GetNumberOfRows()):
        row = {c: out.GetValueByName(i, c).ToString() if c in ("Block", "GroupName", "Array")
               else out.GetValueByName(i, c).ToDouble() for c in columns}
        rows[row["Block"], int(row["Group"]), row["Array"], int(row["Component"])] = row
    assert len(rows) == out.GetNumberOfRows()
    return rows


# A unit square, a triangle of area 2 and one of no area.
POINTS = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [4, 0, 0], [6, 0, 0], [4, 2, 0]]
CELLS = [[0, 1, 2, 3], [4, 5, 6], [0, 1, 1]]


def test_cell_values():
    row = table(surface(POINTS, CELLS, {"E": [10.0, 1.0, 99.0]}), "E", Threshold=10)[
        "", -1, "E", 0]
    for name, value in (("Area", 3), ("Minimum", 1), ("Maximum", 10), ("Mean", 4), ("Flux", 12),
                        ("U0", 0.25), ("Ud", 0.1), ("ShareAbove", 1 / 3), ("Cells", 2)):
        close(row[name], value, relative=1e-15)


def test_units_of_length():
    row = table(surface(POINTS, CELLS, {"E": [10.0, 1.0, 0.0]}), "E", MetersPerUnit=0.001)[
        "", -1, "E", 0]
    close(row["Area"], 3e-6)
    close(row["Flux"], 12e-6)
    close(row["Mean"], 4)


def test_bands_and_luminance():
    rows = table(surface(POINTS, CELLS, {"E": [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [0.0] * 3]}), "E")
    assert sorted(key[3] for key in rows) == [-1, 0, 1, 2]
    for c in range(3):
        close(rows["", -1, "E", c]["Mean"], (1 + c + 2 * (4 + c)) / 3)
    weights = np.array([0.2126, 0.7152, 0.0722])
    close(rows["", -1, "E", -1]["Flux"], weights @ [1, 2, 3] + 2 * weights @ [4, 5, 6])
    close(rows["", -1, "E", -1]["Minimum"], weights @ [1, 2, 3])


def test_groups():
    data = surface(POINTS, CELLS, {"E": [10.0, 1.0, 99.0], "ObjectIndex": [1, 0, 1]})
    names = vtkStringArray()
    names.SetName("ObjectNames")
    for name in ("far", "near"):
        names.InsertNextValue(name)
    data.GetFieldData().AddArray(names)
    rows = table(data, "E", GroupArray="ObjectIndex")
    assert len(rows) == 3
    close(rows["", 1, "E", 0]["Mean"], 10)
    close(rows["", 0, "E", 0]["Area"], 2)
    assert rows["", 1, "E", 0]["GroupName"] == "near"
    close(sum(rows["", g, "E", 0]["Flux"] for g in (0, 1)), rows["", -1, "E", 0]["Flux"])


def test_point_values():
    """x on a unit square: mean 1/2, and the share above t is 1 - t, whatever the triangulation."""
    for resolution in (1, 7):
        plane = vtkPlaneSource()
        plane.SetResolution(resolution, resolution)
        plane.Update()
        data = plane.GetOutput()
        x = np.array([data.GetPoint(i)[0] + 0.5 for i in range(data.GetNumberOfPoints())])
        array = numpy_to_vtk(x, deep=True)
        array.SetName("x")
        data.GetPointData().AddArray(array)
        for threshold in (-1.0, 0.0, 0.3, 0.9, 1.0, 2.0):
            row = table(data, "x", Threshold=threshold)["", -1, "x", 0]
            close(row["Mean"], 0.5, relative=1e-7)  # vtkPlaneSource's points are single precision
            close(row["ShareAbove"], np.clip(1 - threshold, 0, 1), relative=1e-6, absolute=1e-6)
            close([row["Minimum"], row["Maximum"]], [0, 1], absolute=1e-7)


def test_many_small_among_few_large():
    """The sums are compensated: a million tiny values do not vanish beside a large one."""
    n = 20000
    points = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    data = surface(points, [[0, 1, 2]] * (n + 1), {"E": [1e16] + [1.0] * n})
    close(table(data, "E")["", -1, "E", 0]["Flux"], 0.5 * (1e16 + n), relative=0)


def test_blocks():
    blocks = vtkMultiBlockDataSet()
    for i, (name, value) in enumerate((("a", 1.0), ("b", 3.0))):
        blocks.SetBlock(i, surface(POINTS, CELLS, {"E": [value, value, 0.0]}))
        blocks.GetMetaData(i).Set(vtkCompositeDataSet.NAME(), name)
    rows = table(blocks, "E")
    close(rows["a", -1, "E", 0]["Mean"], 1)
    close(rows["b", -1, "E", 0]["Mean"], 3)
    close(rows["(all)", -1, "E", 0]["Mean"], 2)
    close(rows["(all)", -1, "E", 0]["Area"], 6)
    close(rows["(all)", -1, "E", 0]["Cells"], 4)


def test_default_arrays():
    data = surface(POINTS, CELLS, {"Irradiance": [1.0, 2.0, 3.0], "IrradianceError": [0.0] * 3,
                                   "Other": [1.0] * 3}, {"Radiosity": [1.0] * 7})
    assert {key[2] for key in table(data)} == {"Irradiance", "Radiosity"}


def test_dark_and_empty():
    row = table(surface(POINTS, CELLS, {"E": [0.0, 0.0, 0.0]}), "E")["", -1, "E", 0]
    close([row["U0"], row["Ud"], row["Mean"]], [0, 0, 0])
    assert table(surface(POINTS, [], {}), "E") == {}
    assert table(surface(POINTS, [[0, 1, 1]], {"E": [1.0]}), "E") == {}


def plane(resolution, values=None, name="E"):
    """A square of side 10 in double precision with values(x, y) at its points or on its cells."""
    source = vtkPlaneSource()
    source.SetOrigin(0, 0, 0)
    source.SetPoint1(10, 0, 0)
    source.SetPoint2(0, 10, 0)
    source.SetResolution(resolution, resolution)
    source.SetOutputPointsPrecision(1)
    source.Update()
    data = source.GetOutput()
    xyz = points(data)
    array_ = numpy_to_vtk(values(xyz[:, 0], xyz[:, 1]), deep=True)
    array_.SetName(name)
    data.GetPointData().AddArray(array_)
    return data


def lines_of(data, *levels, **properties):
    """(lines, table of levels)"""
    statistics = vtkRadiometricStatistics()
    statistics.SetInputDataObject(data)
    for level in levels:
        statistics.AddIsovalue(level)
    for name, value in {"ArrayName": "E", **properties}.items():
        getattr(statistics, "Set" + name)(value)
    statistics.Update()
    return statistics.GetOutputDataObject(1), statistics.GetOutputDataObject(2)


def test_lines_of_a_linear_field():
    """On E = 3x + 4y the line E = 20 runs from (20/3, 0) to (0, 5): 25/3 long, straight, whatever
    the mesh; the area above is the square less the triangle below."""
    for resolution in (1, 4, 9):
        data = plane(resolution, lambda x, y: 3 * x + 4 * y)
        lines, levels = lines_of(data, 20.0)
        xyz = points(lines)
        close(3 * xyz[:, 0] + 4 * xyz[:, 1], [20.0] * len(xyz))
        assert lines.GetNumberOfCells() == 1, "one line, not pieces"
        close(array(lines.GetCellData(), "Length"), [25 / 3])
        close(array(lines.GetCellData(), "Isovalue"), [20])
        close(array(lines.GetPointData(), "E"), [20] * len(xyz))
        assert array(lines.GetCellData(), "Label") == ["20"]
        close(array(levels.GetRowData(), "AreaAbove"), [100 - 50 / 3])
        close(array(levels.GetRowData(), "ShareAbove"), [1 - 1 / 6])
        close(array(levels.GetRowData(), "Length"), [25 / 3])


def test_lines_of_triangles_and_metres():
    data = plane(5, lambda x, y: x)
    triangles = vtkTriangleFilter()
    triangles.SetInputData(data)
    triangles.Update()
    lines, levels = lines_of(triangles.GetOutput(), 3.3, MetersPerUnit=0.001)
    close(points(lines)[:, 0], [3.3] * lines.GetNumberOfPoints())
    close(array(levels.GetRowData(), "Length"), [0.010])


def test_lines_are_round_and_closed():
    """E = 100 - r^2: the level 84 is a circle of radius 4, one closed line."""
    data = plane(80, lambda x, y: 100 - (x - 5)**2 - (y - 5)**2)
    lines, _ = lines_of(data, 84.0)
    assert lines.GetNumberOfCells() == 1
    cell = lines.GetCell(0)
    assert cell.GetPointId(0) != cell.GetPointId(1)
    xyz = points(lines)
    close(xyz[0], xyz[-1])
    close(np.hypot(xyz[:, 0] - 5, xyz[:, 1] - 5), [4] * len(xyz), relative=5e-4)
    close(array(lines.GetCellData(), "Length"), [8 * np.pi], relative=1e-3)


def test_lines_of_cell_values():
    """Cell averages of E = x: away from the border the averaged corners are exact."""
    data = plane(20, lambda x, y: x)
    centres = 0.25 + 0.5 * (np.arange(400) % 20)
    array_ = numpy_to_vtk(centres, deep=True)
    array_.SetName("C")
    data.GetCellData().AddArray(array_)
    lines, _ = lines_of(data, 3.1, ArrayName="C")
    close(points(lines)[:, 0], [3.1] * lines.GetNumberOfPoints())
    close(array(lines.GetCellData(), "Length"), [10])


def test_cell_values_do_not_mix_over_an_edge():
    """A floor of 0 and a wall of 10 that share an edge: no line of 5 anywhere."""
    data = surface([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [1, 0, 1], [1, 1, 1]],
                   [[0, 1, 2, 3], [1, 4, 5, 2]], {"E": [0.0, 10.0]})
    assert lines_of(data, 5.0)[0].GetNumberOfCells() == 0
    flat = surface([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]],
                   [[0, 1, 2, 3], [1, 4, 5, 2]], {"E": [0.0, 10.0]})
    lines, _ = lines_of(flat, 5.0 + 1e-9)
    close(array(lines.GetCellData(), "Length"), [1.0], relative=1e-6)


def test_automatic_levels():
    """Steps of 1, 2 and 5: evenly spaced for a narrow range, in decades for a wide one."""
    _, levels = lines_of(plane(4, lambda x, y: 200 + 30 * x))
    close(array(levels.GetRowData(), "Isovalue"), [250, 300, 350, 400, 450])
    _, levels = lines_of(plane(4, lambda x, y: 1 + 70 * x))
    close(array(levels.GetRowData(), "Isovalue"), [2, 5, 10, 20, 50, 100, 200, 500])
    _, levels = lines_of(plane(4, lambda x, y: 0 * x + 7))
    assert levels.GetNumberOfRows() == 0


def test_lines_prefer_illuminance():
    data = plane(2, lambda x, y: x, "Irradiance")
    other = numpy_to_vtk(100 * points(data)[:, 0], deep=True)
    other.SetName("Illuminance")
    data.GetPointData().AddArray(other)
    statistics = vtkRadiometricStatistics()
    statistics.SetInputDataObject(data)
    statistics.AddIsovalue(300.0)
    statistics.Update()
    lines = statistics.GetOutputDataObject(1)
    close(points(lines)[:, 0], [3] * lines.GetNumberOfPoints())
    close(array(lines.GetCellData(), "Length"), [10])
    statistics.SetIsolineArray("Irradiance")
    statistics.Update()
    assert statistics.GetOutputDataObject(1).GetNumberOfPoints() == 0


def sensors(xyz, values):
    data = vtkPolyData()
    positions = vtkPoints()
    positions.SetData(numpy_to_vtk(np.array(xyz, float), deep=True))
    data.SetPoints(positions)
    verts = vtkCellArray()
    for i in range(len(xyz)):
        verts.InsertNextCell(1, [i])
    data.SetVerts(verts)
    for name, tuples in (("Normals", [[0.0, 0.0, 1.0]] * len(xyz)), ("E", values)):
        array_ = numpy_to_vtk(np.array(tuples, float), deep=True)
        array_.SetName(name)
        data.GetPointData().AddArray(array_)
    return data


def test_sensors_without_cells_weigh_alike():
    row = table(sensors([[0, 0, 0], [1, 0, 0], [5, 0, 0]], [1, 2, 6]), "E", Threshold=2)[
        "", -1, "E", 0]
    for name, value in (("Mean", 3), ("Minimum", 1), ("Maximum", 6), ("U0", 1 / 3), ("Ud", 1 / 6),
                        ("ShareAbove", 2 / 3), ("Cells", 3), ("Area", 3)):
        close(row[name], value)


def test_further_thresholds():
    statistics = vtkRadiometricStatistics()
    statistics.SetInputDataObject(plane(3, lambda x, y: x))
    statistics.SetArrayName("E")
    statistics.SetThreshold(2.0)
    statistics.AddThreshold(5.0)
    statistics.AddThreshold(7.5)
    statistics.Update()
    out = statistics.GetOutput()
    for name, value in (("ShareAbove", 0.8), ("ShareAbove 5", 0.5), ("ShareAbove 7.5", 0.25)):
        close(out.GetValueByName(0, name).ToDouble(), value)
    close(np.ravel(array(out.GetFieldData(), "Threshold")), [2, 5, 7.5])
    statistics.ClearThresholds()
    statistics.Update()
    assert statistics.GetOutput().GetColumnByName("ShareAbove 5") is None


def test_percentiles():
    """Of x + y on a square of side 10 the median is 10 and P12.5 is 5; of cells, each value by its
    area."""
    def row(data, *percentiles):
        statistics = vtkRadiometricStatistics()
        statistics.SetInputDataObject(data)
        statistics.SetArrayName("E")
        for percentile in percentiles:
            statistics.AddPercentile(percentile)
        statistics.Update()
        out = statistics.GetOutput()
        return [out.GetValueByName(0, f"P{p:g}").ToDouble() for p in percentiles]

    close(row(plane(7, lambda x, y: x + y), 50, 12.5, 87.5), [10, 5, 15], relative=1e-11)
    cells = surface(POINTS, CELLS, {"E": [10.0, 1.0, 99.0]})  # areas 1, 2 and 0
    close(row(cells, 66, 67, 1, 99), [1, 10, 1, 10])
    close(row(sensors([[k, 0, 0] for k in range(10)], range(1, 11)), 50, 51, 90), [5, 6, 9])
    statistics = vtkRadiometricStatistics()
    statistics.SetInputDataObject(cells)
    statistics.SetArrayName("E")
    statistics.AddPercentile(100.0)
    fails(statistics, "Percentiles", "100")


def test_blocks_with_a_grid_of_sensors():
    """A work plane beside a surface: each with its own area, both in the whole."""
    source = vtkWorkPlaneSource()
    source.SetPoint1(1.5, -0.5, 0)
    source.Update()
    grid = source.GetOutput()
    grid.GetPointData().AddArray(_named("E", np.full(grid.GetNumberOfPoints(), 4.0)))
    blocks = vtkMultiBlockDataSet()
    blocks.SetBlock(0, grid)
    blocks.SetBlock(1, surface(POINTS, CELLS, {"E": [1.0, 1.0, 0.0]}))
    rows = table(blocks, "E")
    close(rows["block 0", -1, "E", 0]["Area"], 2)
    close(rows["(all)", -1, "E", 0]["Area"], 5)
    close(rows["(all)", -1, "E", 0]["Mean"], (2 * 4 + 3 * 1) / 5)


def _named(name, values):
    result = numpy_to_vtk(values, deep=True)
    result.SetName(name)
    return result


def test_lines_can_be_left_out():
    lines, levels = lines_of(plane(4, lambda x, y: x), 5.0, GenerateIsolines=False)
    assert lines.GetNumberOfPoints() == 0 and levels.GetNumberOfRows() == 0


def test_none_as_in_paraview():
    data = surface(POINTS, CELLS, {"E": [10.0, 1.0, 99.0]})
    assert len(table(data, "E", GroupArray="None", IsolineArray="None")) == 1


def test_errors():
    def statistics(data, name="E", **properties):
        filter_ = vtkRadiometricStatistics()
        filter_.SetInputDataObject(data)
        filter_.SetArrayName(name)
        for key, value in properties.items():
            getattr(filter_, "Set" + key)(value)
        return filter_

    good = surface(POINTS, CELLS, {"E": [1.0, 2.0, 3.0]})
    fails(statistics(good, "Missing"), "Missing")
    fails(statistics(good, GroupArray="ObjectIndex"), "ObjectIndex", "missing")
    fails(statistics(good, IsolineArray="Nowhere"), "Nowhere", "missing")
    fails(statistics(good, Threshold=float("nan")), "Threshold", "nan")
    lines = statistics(good)
    lines.AddIsovalue(float("inf"))
    fails(lines, "Isovalues[0]", "inf")
    fails(statistics(good, MetersPerUnit=0.0), "MetersPerUnit", "0")
    fails(statistics(surface(POINTS, CELLS, {"E": [1.0, float("nan"), 3.0]})), "E[1]", "nan")
    bad = [list(p) for p in POINTS]
    bad[2][1] = float("inf")
    fails(statistics(surface(bad, CELLS, {"E": [1.0, 2.0, 3.0]})), "Points[2]", "inf")


if __name__ == "__main__":
    run_all(globals())
