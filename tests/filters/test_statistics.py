# SPDX-License-Identifier: BSD-3-Clause
"""Radiometric Statistics against closed forms."""
import numpy as np
from checks import close, fails, run_all
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkIntArray, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import (vtkCellArray, vtkCompositeDataSet, vtkMultiBlockDataSet,
                                           vtkPolyData)
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkradiometry import vtkRadiometricStatistics


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
    fails(statistics(good, MetersPerUnit=0.0), "MetersPerUnit", "0")
    fails(statistics(surface(POINTS, CELLS, {"E": [1.0, float("nan"), 3.0]})), "E[1]", "nan")
    bad = [list(p) for p in POINTS]
    bad[2][1] = float("inf")
    fails(statistics(surface(bad, CELLS, {"E": [1.0, 2.0, 3.0]})), "Points[2]", "inf")


if __name__ == "__main__":
    run_all(globals())
