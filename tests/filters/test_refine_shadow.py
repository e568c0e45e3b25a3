# SPDX-License-Identifier: BSD-3-Clause
"""RefineShadowBoundaries: the edges of shadows become geometry."""
import numpy as np
import vtkmodules.all as vtk
from checks import array, cell_values, close, run_all, simulation, square, sun
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkradiometry import vtkIrradianceFilter, vtkPointLightSource


def floor(resolution=1, size=4.0, center=(0, 0, 0)):
    data = square(resolution, size, center)
    tag(data, "Tag", 10.0 * np.arange(resolution * resolution) + 3.0)
    return data


def tag(data, name, values):
    a = numpy_to_vtk(np.asarray(values, float), deep=True)
    a.SetName(name)
    data.GetCellData().AddArray(a)


def lamp(position=(0.3, -0.2, 3.0), intensity=10.0):
    source = vtkPointLightSource()
    source.SetPosition(position)
    source.SetIntensity(intensity)
    return source


def run(data, *lights, occluders=(), **properties):
    f = simulation(vtkIrradianceFilter, data, *lights, **properties)
    for o in occluders:
        f.AddOccludersData(o)
    f.Update()
    return f


def polygons(data):
    """The corners of each polygon."""
    result = []
    ids = vtk.vtkIdList()
    for c in range(data.GetNumberOfCells()):
        data.GetCellPoints(c, ids)
        result.append(np.array([data.GetPoint(ids.GetId(k)) for k in range(ids.GetNumberOfIds())]))
    return result


def area(polygon):
    normal = np.zeros(3)
    for k in range(1, len(polygon) - 1):
        normal += np.cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0])
    return 0.5 * np.linalg.norm(normal)


def check_pieces(whole, refined, relative=1e-9):
    """Area and flux of each cell are those of its pieces; cell data is the cell's."""
    before, after = whole.GetOutputDataObject(0), refined.GetOutputDataObject(0)
    ids = array(after.GetCellData(), "OriginalCellIds").astype(int)
    values = array(after.GetCellData(), "Irradiance")
    areas = np.array([area(p) for p in polygons(after)])
    cells = polygons(before)
    old = array(before.GetCellData(), "Irradiance")
    errors = array(before.GetCellData(), "IrradianceError")
    tags = array(before.GetCellData(), "Tag")
    close(array(after.GetCellData(), "Tag"), tags[ids], 0.0)
    scale = np.abs(old).max()
    for c, polygon in enumerate(cells):
        mine = ids == c
        assert mine.any()
        close(areas[mine].sum(), area(polygon), 1e-12)
        got = (values.T * areas).T[mine].sum(axis=0)
        close(got, old[c] * area(polygon), relative,
              relative * scale * area(polygon) + (errors[c].max() * area(polygon) if relative > 1e-6 else 0))
    return ids, values, areas


def test_square_over_a_floor():
    light = np.array([0.3, -0.2, 3.0])
    blocker = floor(1, 1.0, (0.1, 0.15, 1.0))
    corners = np.array([[-0.4, -0.35, 1.0], [0.6, -0.35, 1.0], [0.6, 0.65, 1.0], [-0.4, 0.65, 1.0]])
    shadow = light + (corners - light) * 1.5
    for resolution in (1, 5):
        data = floor(resolution)
        whole = run(data, lamp(light), occluders=[blocker])
        refined = run(data, lamp(light), occluders=[blocker], RefineShadowBoundaries=True)
        ids, values, areas = check_pieces(whole, refined)
        out = refined.GetOutputDataObject(0)
        dark = values == 0.0
        # The shadow is dark to the last digit, and its area is that of the projected square.
        close(areas[dark].sum(), 1.5 * 1.5, 1e-12)
        close(values[~dark].min() > 0.1, True)
        # Its corners are the projected corners, and its edges lie on the lines between them.
        places = np.array([p for p, d in zip(polygons(out), dark) if d for p in p])
        for corner in shadow:
            assert np.abs(places - corner).max(axis=1).min() < 1e-12, corner
        rim = np.minimum.reduce([np.abs(places[:, 0] - shadow[0, 0]), np.abs(places[:, 0] - shadow[1, 0]),
                                 np.abs(places[:, 1] - shadow[0, 1]), np.abs(places[:, 1] - shadow[2, 1])])
        inside = [(p[0] > shadow[0, 0] - 1e-12) & (p[0] < shadow[1, 0] + 1e-12) &
                  (p[1] > shadow[0, 1] - 1e-12) & (p[1] < shadow[2, 1] + 1e-12) for p in places]
        assert all(inside)
        if resolution == 1:
            assert (rim < 1e-12).all()
            # One dark square and few pieces of light round it: no sliver, nothing needless.
            assert dark.sum() == 1, dark.sum()
            assert len(values) <= 7, len(values)
        # Cells that no edge crosses are as they were.
        alone = np.bincount(ids) == 1
        cells, pieces = polygons(data), polygons(out)
        for c in np.flatnonzero(alone):
            close(pieces[int(np.flatnonzero(ids == c)[0])], cells[c], 0.0)
        method = array(out.GetFieldData(), "RadiometryMethod")[0]
        assert "cut along the edges of shadows" in method, method
        # Exact values, rounding only.
        assert (array(out.GetCellData(), "IrradianceError") <= 1e-10 * values.max()).all()


def test_nothing_in_the_way_changes_nothing():
    data = floor(3)
    whole = run(data, lamp())
    refined = run(data, lamp(), RefineShadowBoundaries=True)
    out = refined.GetOutputDataObject(0)
    assert out.GetNumberOfCells() == 9 and out.GetNumberOfPoints() == data.GetNumberOfPoints()
    close(array(out.GetCellData(), "Irradiance"), cell_values(whole, "Irradiance"), 0.0)
    close(array(out.GetCellData(), "OriginalCellIds"), np.arange(9), 0.0)


def test_many_edges_and_lights():
    # A sphere and a box on the floor under three lights; far away, too.
    counts = []
    for center in ((0.0, 0.0), (5e5, 4e6)):
        ball = vtk.vtkSphereSource()
        ball.SetCenter(center[0] + 0.3, center[1] + 0.2, 1.2)
        ball.SetRadius(0.6)
        ball.SetThetaResolution(24)
        ball.SetPhiResolution(12)
        ball.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
        ball.Update()
        box = vtk.vtkCubeSource()
        box.SetCenter(center[0] - 1.0, center[1] - 0.5, 0.25)
        box.SetXLength(0.5)
        box.SetYLength(0.5)
        box.SetZLength(0.5)
        box.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
        box.Update()
        blocked = [ball.GetOutput(), box.GetOutput()]
        data = floor(3, 4.0, (*center, 0.0))
        lights = [lamp((center[0] + 0.5, center[1] + 1.0, 3.0)),
                  lamp((center[0] - 1.5, center[1] - 1.0, 2.0), 4.0), sun((0.3, 0.2, -1.0), 5.0)]
        whole = run(data, *lights, occluders=blocked, RelativeTolerance=1e-6)
        refined = run(data, *lights, occluders=blocked, RefineShadowBoundaries=True)
        ids, values, areas = check_pieces(whole, refined, 1e-5)
        errors = array(refined.GetOutputDataObject(0).GetCellData(), "IrradianceError")
        assert np.median(errors) <= 1e-8 * values.max()
        # Three lights, some eighty edges: few pieces, and no sliver that rounding made (the least
        # piece, 6e-9 m^2, is the same in both places).
        assert 20 < len(values) < 200, len(values)
        assert areas.min() > 1e-10 * areas.sum(), areas.min()
        counts.append(len(values))
    assert abs(counts[0] - counts[1]) <= 5, counts


def test_two_sided_composite_strips_and_limit():
    # A block of strips, one of polygons, one of lines, one empty; both sides lit.
    stripped = vtk.vtkStripper()
    mesh = vtk.vtkTriangleFilter()
    mesh.SetInputData(floor(2))
    stripped.SetInputConnection(mesh.GetOutputPort())
    stripped.Update()
    strip = vtk.vtkPolyData()
    strip.DeepCopy(stripped.GetOutput())
    tag(strip, "Tag", np.arange(strip.GetNumberOfCells()))
    lines = vtk.vtkLineSource()
    lines.Update()
    segment = vtk.vtkPolyData()
    segment.DeepCopy(lines.GetOutput())
    tag(segment, "Tag", [7.0])
    blocks = vtk.vtkMultiBlockDataSet()
    blocks.SetBlock(0, strip)
    blocks.SetBlock(1, segment)
    blocks.SetBlock(3, floor(2, 2.0, (0, 0, -0.5)))
    # Blockers above and below cut each side at another place.
    above, below = floor(1, 0.6, (0.1, 0.1, 1.0)), floor(1, 0.5, (-0.3, 0.2, -2.0))
    lights = [lamp(), lamp((0.2, 0.1, -4.0))]
    options = dict(occluders=[above, below], TwoSided=True)
    whole = run(blocks, *lights, **options)
    refined = run(blocks, *lights, RefineShadowBoundaries=True, **options)
    before, after = whole.GetOutputDataObject(0), refined.GetOutputDataObject(0)
    seen = 0
    assert after.GetNumberOfBlocks() == 4 and after.GetBlock(2) is None
    for k in (0, 3):
        old, new = before.GetBlock(k), after.GetBlock(k)
        assert new.GetNumberOfCells() > old.GetNumberOfCells()
        ids = array(new.GetCellData(), "OriginalCellIds").astype(int)
        close(array(new.GetCellData(), "Tag"), array(old.GetCellData(), "Tag")[ids], 0.0)
        for name in ("Irradiance", "IrradianceBack"):
            flux = []
            for data in (old, new):
                triangles = vtk.vtkTriangleFilter()
                triangles.SetInputData(data)
                triangles.Update()
                out = triangles.GetOutput()
                flux.append(sum(area(p) * v for p, v in
                                zip(polygons(out), array(out.GetCellData(), name))))
            close(flux[1], flux[0], 1e-9)
            seen += flux[0] > 0.1
    assert seen == 3  # the upper floor hides the upper light from the lower one
    assert after.GetBlock(1).GetNumberOfLines() == 1
    close(array(after.GetBlock(1).GetCellData(), "Irradiance"), [0.0], 0.0)
    # The limit: said, and the flux stays.
    data = floor(1)
    ball = vtk.vtkSphereSource()
    ball.SetCenter(0.0, 0.0, 1.2)
    ball.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
    ball.SetThetaResolution(20)
    ball.Update()
    whole = run(data, lamp(), occluders=[ball.GetOutput()], RelativeTolerance=1e-6)
    f = simulation(vtkIrradianceFilter, data, lamp(), RefineShadowBoundaries=True,
                   MaximumPiecesPerCell=5, RelativeTolerance=1e-6)
    f.AddOccludersData(ball.GetOutput())
    warnings = []

    def note(caller, event, text=""):
        warnings.append(text)

    note.CallDataType = "string0"
    f.AddObserver("WarningEvent", note)
    f.Update()
    assert len(warnings) == 1 and "MaximumPiecesPerCell" in warnings[0], warnings
    out = f.GetOutputDataObject(0)
    assert 1 < out.GetNumberOfCells() <= 5
    assert "reached the limit" in array(out.GetFieldData(), "RadiometryMethod")[0]
    check_pieces(whole, f, 1e-5)


def test_without_time_cells_stay_whole():
    blocker = floor(1, 1.0, (0.1, 0.15, 1.0))
    f = run(floor(5), lamp(), occluders=[blocker], RefineShadowBoundaries=True, TimeBudget=1e-9)
    out = f.GetOutputDataObject(0)
    assert out.GetNumberOfCells() == 25
    outcome = array(out.GetFieldData(), "RadiometryOutcome")[0]
    assert "no time was left to cut" in outcome, outcome


def test_with_values_at_points_it_has_no_effect():
    f = simulation(vtkIrradianceFilter, floor(2), lamp(), RefineShadowBoundaries=True,
                   SampleLocation=1)
    warnings = []

    def note(caller, event, text=""):
        warnings.append(text)

    note.CallDataType = "string0"
    f.AddObserver("WarningEvent", note)
    f.Update()
    assert len(warnings) == 1 and "SampleLocation" in warnings[0], warnings
    assert f.GetOutputDataObject(0).GetNumberOfCells() == 4


def test_threads_and_metres_per_unit():
    blocker = floor(1, 1.0, (0.1, 0.15, 1.0))
    results = []
    for threads in (1, 2, 7):
        f = run(floor(3), lamp(), occluders=[blocker], RefineShadowBoundaries=True,
                NumberOfThreads=threads)
        out = f.GetOutputDataObject(0)
        results.append((array(out.GetCellData(), "Irradiance").tobytes(),
                        np.concatenate(polygons(out)).tobytes()))
    assert results[0] == results[1] == results[2]
    small = run(floor(3), lamp(), occluders=[blocker], RefineShadowBoundaries=True, MetersPerUnit=0.25)
    one = run(floor(3), lamp(), occluders=[blocker], RefineShadowBoundaries=True)
    a, b = small.GetOutputDataObject(0), one.GetOutputDataObject(0)
    close(np.concatenate(polygons(a)), np.concatenate(polygons(b)), 0.0, 1e-14)
    close(array(a.GetCellData(), "Irradiance"), 16.0 * array(b.GetCellData(), "Irradiance"), 1e-12)


if __name__ == "__main__":
    run_all(globals())
