# SPDX-License-Identifier: BSD-3-Clause
"""The irradiance filter on every kind of input: closed forms, invariants, bad input refused."""
import math

import numpy as np
import vtkmodules.all as vtk
import checks
from checks import array, close, fails, run_all, simulation, square, strings, sun
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkradiometry import vtkIrradianceFilter, vtkPointLightSource, vtkSpotLightSource

CELLS, POINTS = 0, 1


def plane(resolution=1, size=2.0, z=0.0, origin=(0.0, 0.0)):
    return square(resolution, size, (*origin, z))


def point_light(position, intensity, unit=0):
    source = vtkPointLightSource()
    source.SetPosition(position)
    source.SetIntensity(intensity)
    source.SetIntensityUnit(unit)
    return source


def irradiance(data, *lights, **properties):
    return simulation(vtkIrradianceFilter, data, *lights, **properties)


def cell_values(f, name="Irradiance"):
    return checks.cell_values(f, name)


def add_cell_array(data, name, values):
    a = numpy_to_vtk(np.asarray(values, float), deep=True)
    a.SetName(name)
    data.GetCellData().AddArray(a)
    return data


def polydata(points, *polygons, strips=False):
    data = vtk.vtkPolyData()
    p = vtk.vtkPoints()
    p.SetDataTypeToDouble()
    for x in points:
        p.InsertNextPoint(x)
    cells = vtk.vtkCellArray()
    for polygon in polygons:
        cells.InsertNextCell(len(polygon), polygon)
    data.SetPoints(p)
    (data.SetStrips if strips else data.SetPolys)(cells)
    return data


def square_above(d, half=1.0):
    """Solid angle of a square of half side `half` from d above its centre."""
    return 4.0 * math.atan2(half * half, d * math.sqrt(2.0 * half * half + d * d))


def test_point_light_over_cell_is_solid_angle_over_area():
    for d in (1e-9, 1e-3, 1.0, 1e3, 1e9):
        e = cell_values(irradiance(plane(), point_light((0, 0, d), 5.0)))
        close(e, [5.0 * square_above(d) / 4.0], 1e-12)


def test_hundred_lumen_at_one_metre():
    tiny = plane(size=1e-4)
    f = irradiance(tiny, point_light((0, 0, 1), 100, 3), Photometric=True)
    close(cell_values(f, "Illuminance"), [100 / (4 * math.pi)], 1e-8)
    units = array(f.GetOutput(0).GetFieldData(), "RadiometryUnits")
    assert "Illuminance [lx]" in units and "Irradiance [W/m^2]" in units, units


def test_metres_per_unit_scales_surface_and_lights():
    inches = irradiance(plane(3), point_light((0.1, 0.2, 1), 5.0), MetersPerUnit=0.0254)
    metres = irradiance(plane(3), point_light((0.1, 0.2, 1), 5.0))
    close(cell_values(inches), cell_values(metres) / 0.0254**2, 1e-12)


def test_scale_and_place_do_not_matter():
    reference = cell_values(irradiance(plane(4), point_light((0.1, 0.2, 1), 1.0)))
    for scale in (1e-6, 1e9):
        scaled = irradiance(plane(4, 2 * scale), point_light((0.1 * scale, 0.2 * scale, scale), 1.0))
        close(cell_values(scaled) * scale**2, reference, 1e-9)
    utm = irradiance(plane(4, origin=(5e5, 4e6)), point_light((5e5 + 0.1, 4e6 + 0.2, 1), 1.0))
    close(cell_values(utm), reference, 1e-6)


def test_lights_add_up_over_several_inputs_and_disabled_ones_do_not_count():
    a, b = point_light((0, 0, 1), 3.0), sun((0, 0, -1), 2.0)
    both = cell_values(irradiance(plane(3), a, b))
    close(both, cell_values(irradiance(plane(3), a)) + 2.0, 1e-13)
    b.SetLightEnabled(False)
    close(cell_values(irradiance(plane(3), a, b)), cell_values(irradiance(plane(3), a)))
    close(cell_values(irradiance(plane(3))), np.zeros(9))


def test_bands_and_one_band_serving_all():
    data = add_cell_array(plane(2), "DiffuseReflectance", np.full((4, 3), 0.2))
    e = cell_values(irradiance(data, point_light((0, 0, 1), 3.0)))
    assert e.shape == (4, 3)
    close(e[:, 0], e[:, 2])
    wide = add_cell_array(plane(2), "DiffuseReflectance", np.full((4, 64), 0.2))
    assert cell_values(irradiance(wide, sun((0, 0, -1), 1))).shape == (4, 64)


def test_cells_of_every_kind():
    light = sun((0, 0, -1), 7.0)
    square = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    concave = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (2, 1, 0), (0, 4, 0)]
    close(cell_values(irradiance(polydata(square, (0, 1, 2, 3)), light)), [7.0])
    close(cell_values(irradiance(polydata(concave, (0, 1, 2, 3, 4)), light)), [7.0], 1e-12)
    strip = polydata([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], (0, 1, 2, 3), strips=True)
    close(cell_values(irradiance(strip, light)), [7.0])
    # A concave cell under a point light: its flux is that of its triangles, the notch left out.
    p = point_light((2, 3, 1), 1.0)
    whole = cell_values(irradiance(polydata(concave, (0, 1, 2, 3, 4)), p))[0] * 10.0
    parts = [(0, 1, 3), (1, 2, 3), (0, 3, 4)]
    areas = np.array([2.0, 4.0, 4.0])
    close(cell_values(irradiance(polydata(concave, *parts), p)) @ areas, whole, 1e-12)
    # Without area: 0, error 0, counted; with the good cell beside it unharmed.
    points = square + [(5, 5, 0), (6, 5, 0), (7, 5, 0)]
    f = irradiance(polydata(points, (0, 1, 2, 3), (4, 5, 6), (4, 4, 5)), light)
    close(cell_values(f), [7.0, 0.0, 0.0])
    close(cell_values(f, "IrradianceError")[1:], [0.0, 0.0])
    assert "CellsWithoutArea=2" in array(f.GetOutput(0).GetFieldData(), "RadiometryOptions")[0]


def test_verts_lines_and_empty_input_are_no_error():
    data = plane()
    verts = vtk.vtkCellArray()
    verts.InsertNextCell(1, [0])
    lines = vtk.vtkCellArray()
    lines.InsertNextCell(2, [0, 1])
    data.SetVerts(verts)
    data.SetLines(lines)
    close(cell_values(irradiance(data, sun((0, 0, -1), 1))), [0.0, 0.0, 1.0])
    only_lines = polydata([(0, 0, 0), (1, 0, 0)])
    only_lines.SetLines(lines)
    close(cell_values(irradiance(only_lines, sun((0, 0, -1), 1))), [0.0])
    f = irradiance(vtk.vtkPolyData(), sun((0, 0, -1), 1))
    f.Update()
    assert f.GetOutput(0).GetNumberOfCells() == 0


def test_unstructured_and_composite_input():
    light = point_light((0.3, 0.2, 1), 5.0)
    flat = cell_values(irradiance(plane(3), light))
    append = vtk.vtkAppendFilter()
    append.AddInputData(plane(3))
    append.Update()
    close(cell_values(irradiance(append.GetOutput(), light)), flat)
    # Blocks light up alone but shadow each other.
    blocks = vtk.vtkMultiBlockDataSet()
    blocks.SetBlock(0, plane(3))
    blocks.SetBlock(2, plane(1, 10.0, z=0.5))
    f = irradiance(blocks, light)
    f.Update()
    out = f.GetOutputDataObject(0)
    assert out.IsA("vtkMultiBlockDataSet") and out.GetNumberOfBlocks() == 3
    close(array(out.GetBlock(0).GetCellData(), "Irradiance"), np.zeros(9))
    assert array(out.GetBlock(2).GetCellData(), "Irradiance")[0] > 0.0
    assert out.GetBlock(1) is None
    # What is no dataset keeps its place: results stay with their own block.
    blocks.SetBlock(1, vtk.vtkTable())
    f = irradiance(blocks, light)
    f.Update()
    out = f.GetOutputDataObject(0)
    close(array(out.GetBlock(0).GetCellData(), "Irradiance"), np.zeros(9))
    assert array(out.GetBlock(2).GetCellData(), "Irradiance")[0] > 0.0


def test_occluders_only_block():
    light = sun((0, 0, -1), 4.0)
    f = irradiance(plane(1), light)
    half = plane(1, 2.0, z=1.0, origin=(1.0, 0.0))  # covers x > 0
    f.AddOccludersData(half)
    close(cell_values(f), [2.0], 1e-12)
    assert f.GetOutput(0).GetNumberOfCells() == 1


def test_back_faces_only_where_two_sided():
    below = sun((0, 0, 1), 3.0)
    close(cell_values(irradiance(plane(), below)), [0.0])
    f = irradiance(plane(), below, TwoSided=True)
    close(cell_values(f), [0.0])
    close(cell_values(f, "IrradianceBack"), [3.0])
    assert not irradiance(plane(), below).GetOutput(0).GetCellData().HasArray("IrradianceBack")
    mixed = add_cell_array(plane(2), "TwoSided", [0, 1, 0, 1])
    close(cell_values(irradiance(mixed, below), "IrradianceBack"), [0.0, 3.0, 0.0, 3.0])


def test_sensors_are_not_shadowed_by_what_they_lie_on():
    rng = np.random.default_rng(3)
    n = np.array([0.3, -0.5, 0.8])
    n /= np.linalg.norm(n)
    u = np.cross(n, [1, 0, 0])
    u /= np.linalg.norm(u)
    v = np.cross(n, u)
    corners = [1000 + s * u + t * v for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    table = polydata([tuple(c) for c in corners], (0, 1, 2, 3))
    grid = vtk.vtkPolyData()
    points = vtk.vtkPoints()  # single precision: rounded off the table by up to 3e-5
    normals = vtk.vtkDoubleArray()
    normals.SetName("Normals")
    normals.SetNumberOfComponents(3)
    verts = vtk.vtkCellArray()
    for i in range(200):
        s, t = rng.uniform(-0.9, 0.9, 2)
        points.InsertNextPoint(tuple(1000 + s * u + t * v))
        normals.InsertNextTuple(n)
        verts.InsertNextCell(1, [i])
    grid.SetPoints(points)
    grid.SetVerts(verts)
    grid.GetPointData().AddArray(normals)
    f = irradiance(grid, sun(-n, 9.0))
    f.AddOccludersData(table)
    f.Update()
    close(array(f.GetOutput(0).GetPointData(), "Irradiance"), np.full(200, 9.0))
    f = irradiance(grid, sun(n, 9.0))  # from behind
    f.AddOccludersData(table)
    f.Update()
    close(array(f.GetOutput(0).GetPointData(), "Irradiance"), np.zeros(200))


def test_point_values_split_at_creases_and_smooth_elsewhere():
    cube = vtk.vtkCubeSource()
    cube.Update()
    f = irradiance(cube.GetOutput(), sun((0, 0, -1), 2.0), SampleLocation=POINTS)
    f.Update()
    out = f.GetOutput(0)
    assert out.GetNumberOfPoints() == 24
    e = array(out.GetPointData(), "Irradiance")
    assert sorted(e)[-4:] == [2.0] * 4 and np.count_nonzero(e) == 4
    sphere = vtk.vtkSphereSource()
    sphere.SetThetaResolution(40)
    sphere.SetPhiResolution(40)
    sphere.Update()
    f = irradiance(sphere.GetOutput(), sun((0, 0, -1), 1.0), SampleLocation=POINTS)
    f.Update()
    out = f.GetOutput(0)
    z = np.array([out.GetPoint(i)[2] for i in range(out.GetNumberOfPoints())])
    e = array(out.GetPointData(), "Irradiance")
    # cos(theta) with no acne and no dark terminator: |difference| within the normals' averaging.
    close(e, np.clip(2 * z, 0, None), 0.0, 0.01)


def test_corner_points_of_a_closed_room_do_not_leak():
    room = vtk.vtkCubeSource()
    room.Update()
    inward = vtk.vtkReverseSense()
    inward.SetInputConnection(room.GetOutputPort())
    inward.ReverseCellsOn()
    inward.Update()
    for position in ((0.5001, 0.2, 0.1), (3, 2, 1), (0.1, -0.5001, 0.4999)):
        f = irradiance(inward.GetOutput(), point_light(position, 1e6), SampleLocation=POINTS)
        f.Update()
        close(array(f.GetOutput(0).GetPointData(), "Irradiance"), np.zeros(24))


def test_spot_through_the_filter():
    spot = vtkSpotLightSource()
    spot.SetPosition(0, 0, 2)
    spot.SetDirection(0, 0, -1)
    spot.SetCutoff(20)
    spot.SetIntensity(10)
    e = cell_values(irradiance(plane(9, 4.0), spot))
    area = (4.0 / 9) ** 2
    close(e.sum() * area, 10 * 2 * math.pi * (1 - math.cos(math.radians(20))), 1e-11)
    off = irradiance(plane(1, 1e-3), spot, SpotShape=2)
    off.Update()
    plan = off.GetOutputDataObject(1)
    row = strings(plan, "Effect").index("SpotShape")
    assert strings(plan, "Decision")[row] == "left out"


def test_effect_plan_bounds_what_is_left_out():
    data = plane(4)
    light = point_light((0, 0, 1), 5.0)
    for shadow in (plane(1, 1.0, z=0.5), plane(1, 0.1, z=0.5)):
        full = irradiance(data, light)
        full.AddOccludersData(shadow)
        bare = irradiance(data, light, Occlusion=2)
        bare.AddOccludersData(shadow)
        change = np.abs(cell_values(bare) - cell_values(full)).max()
        plan = bare.GetOutputDataObject(1)
        row = strings(plan, "Effect").index("Occlusion")
        bound = plan.GetColumnByName("Bound").GetValue(row)
        assert 0.0 < change <= bound < 100 * change, (change, bound)
        assert strings(full.GetOutputDataObject(1), "Decision")[row] == "simulated"
    alone = irradiance(data, light)
    alone.Update()
    assert strings(alone.GetOutputDataObject(1), "Decision")[row] == "not needed"


def test_convergence_table_and_time_budget():
    sphere = vtk.vtkSphereSource()
    sphere.SetThetaResolution(200)
    sphere.SetPhiResolution(200)
    sphere.SetCenter(0, 0, 1)
    sphere.Update()
    f = irradiance(plane(20, 4.0), point_light((0, 0, 3), 1.0), RelativeTolerance=1e-6)
    f.AddOccludersData(sphere.GetOutput())
    f.Update()
    table = f.GetOutputDataObject(2)
    seconds = array(table.GetRowData(), "Seconds")
    error = array(table.GetRowData(), "EstimatedError")
    assert len(seconds) >= 2 and (np.diff(seconds) > 0).all()
    assert error[-1] < error[0] and (np.diff(error) <= 1e-15).all(), error
    f.ReleaseCache()
    f.SetTimeBudget(1e-4)
    f.Update()
    outcome = array(f.GetOutput(0).GetFieldData(), "RadiometryOutcome")[0]
    assert "time budget" in outcome, outcome


def test_threads_give_the_same_bytes():
    sphere = vtk.vtkSphereSource()
    sphere.SetCenter(0, 0, 1)
    sphere.Update()
    results = []
    for threads in (1, 2, 7):
        f = irradiance(plane(12, 4.0), point_light((0, 0.1, 3), 1.0), NumberOfThreads=threads)
        f.AddOccludersData(sphere.GetOutput())
        results.append((cell_values(f).tobytes(), cell_values(f, "IrradianceError").tobytes()))
    assert results[0] == results[1] == results[2]


def test_abort_leaves_nothing():
    f = irradiance(plane(50), point_light((0, 0, 1), 1.0))
    f.AddObserver("ProgressEvent", lambda o, e: o.SetAbortExecute(1))
    f.Update()
    assert f.GetOutputDataObject(0).GetNumberOfCells() == 0
    assert f.GetOutputDataObject(2).GetNumberOfRows() == 0


def test_bad_input_is_named():
    light = point_light((0, 0, 1), 1.0)

    def bad_points(value):
        data = plane()
        data.GetPoints().SetPoint(2, value, 0, 0)
        return data

    fails(irradiance(bad_points(math.nan), light), "Points[2] = nan")
    fails(irradiance(bad_points(math.inf), light), "Points[2] = inf")
    fails(irradiance(bad_points(1e200), light), "Points[2] = 1e+200")
    for name, value in (("DiffuseReflectance", -0.1), ("DiffuseReflectance", 1.5),
                        ("SpecularReflectance", math.nan), ("EmittedExitance", -1.0),
                        ("EmittedExitance", math.inf), ("Transmittance", 2.0),
                        ("BackDiffuseReflectance", -3.0)):
        data = add_cell_array(plane(2), name, [0, 0, 0, value])
        fails(irradiance(data, light), f"{name}[3] = {value:g}")
    data = add_cell_array(plane(2), "DiffuseReflectance", [0.1, 0.7, 0, 0])
    add_cell_array(data, "SpecularReflectance", [0.1, 0.7, 0, 0])
    fails(irradiance(data, light), "[1] = 1.4", "at most 1")
    light.Update()
    for name, value in (("LightType", 9), ("LightType", 3), ("Intensity", math.nan),
                        ("Intensity", -1.0), ("Intensity", math.inf)):
        lights = vtk.vtkPolyData()
        lights.DeepCopy(light.GetOutput())
        lights.GetPointData().GetArray(name).SetComponent(0, 0, value)
        f = irradiance(plane())
        f.AddLightsData(lights)
        fails(f, f"{name}[0] = {value:g}")
    data = add_cell_array(plane(2), "DiffuseReflectance", np.full((4, 3), 0.2))
    add_cell_array(data, "EmittedExitance", np.full((4, 2), 0.2))
    fails(irradiance(data, light), "EmittedExitance", "2 bands")
    fails(irradiance(plane(), light, MetersPerUnit=0.0), "MetersPerUnit = 0")
    fails(irradiance(plane(), light, RelativeTolerance=math.nan), "RelativeTolerance = nan")
    blocks = vtk.vtkMultiBlockDataSet()
    blocks.SetBlock(0, plane())
    blocks.SetBlock(1, add_cell_array(plane(), "DiffuseReflectance", [7.0]))
    fails(irradiance(blocks, light), "block 1, DiffuseReflectance[0] = 7")


def test_arrays_of_the_wrong_length_and_ids_out_of_range():
    light = point_light((0, 0, 1), 1.0)
    data = plane(2)
    short = numpy_to_vtk(np.zeros(3), deep=True)
    short.SetName("DiffuseReflectance")
    data.GetCellData().AddArray(short)
    fails(irradiance(data, light), "DiffuseReflectance = 3 tuples", "4")
    light.Update()
    lights = vtk.vtkPolyData()
    lights.DeepCopy(light.GetOutput())
    lights.GetPointData().GetArray("Intensity").SetNumberOfTuples(0)
    f = irradiance(plane())
    f.AddLightsData(lights)
    fails(f, "Intensity = 0 tuples")
    for bad in (4, -1, 1 << 40):
        square = polydata([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], (0, 1, 2), (0, 1, bad))
        fails(irradiance(square, light), f"Polys[1] = {bad:.9g}", "below 4")


def test_extreme_intensities():
    for value in (0.0, 1e-300, 1e30, 1e300):
        e = cell_values(irradiance(plane(), sun((0, 0, -1), value)))
        close(e, [value])
    e = cell_values(irradiance(plane(), point_light((0, 0, 1), 5e-324)))
    assert 0.0 <= e[0] <= 1e-322  # the least number: right to a step of its kind


run_all(globals())
