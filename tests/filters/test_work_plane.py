# SPDX-License-Identifier: BSD-3-Clause
"""Work Plane: the spacing rule of EN 12464-1, the sensors' places, normals and pieces of surface."""
import math

import numpy as np
import vtkmodules.all as vtk
from checks import array, close, fails, points, run_all, simulation, sun
from vtkradiometry import (vtkIrradianceFilter, vtkPointLightSource, vtkRadiometricStatistics,
                           vtkWorkPlaneSource)

AUTO, RECTANGLE, ROOM, ON_SURFACE = range(4)
STANDARD, SPACING, RESOLUTION = range(3)
UP, NEAREST, ODD = range(3)


def work_plane(data=None, **properties):
    source = vtkWorkPlaneSource()
    if data is not None:
        source.SetInputDataObject(data)
    for name, value in properties.items():
        getattr(source, "Set" + name)(value)
    return source


def rectangle(a, b, **properties):
    return work_plane(Origin=(0, 0, 0), Point1=(a, 0, 0), Point2=(0, b, 0), **properties)


def box(x=6.0, y=4.0, z=3.0, centre=(0.0, 0.0, 0.0)):
    """A closed room whose fronts look inside."""
    source = vtk.vtkCubeSource()
    source.SetXLength(x)
    source.SetYLength(y)
    source.SetZLength(z)
    source.SetCenter(centre)
    source.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
    inside = vtk.vtkReverseSense()
    inside.SetInputConnection(source.GetOutputPort())
    inside.Update()
    return inside.GetOutput()


def made(source):
    source.Update()
    return source.GetOutput()


def counts(source):
    return tuple(np.ravel(array(made(source).GetFieldData(), "SensorGridDimensions")))


def areas(mesh):
    sizes = vtk.vtkCellSizeFilter()
    sizes.SetInputData(mesh)
    sizes.Update()
    return array(sizes.GetOutput().GetCellData(), "Area")


def test_spacing_rule_by_hand():
    """p = 0.2 * 5^log10(d) by hand, and the numbers of points in the standard's table A.1: 0.2 m and
    5 points at 1 m, 1 m and 10 at 10 m, 5 m and 20 at 100 m; the table rounds p in between."""
    for d, p, nearest, up in ((1, 0.2, 5, 5), (2, 0.32467, 6, 7), (5, 0.61601, 8, 9), (10, 1.0, 10, 10),
                              (25, 1.89735, 13, 14), (50, 3.08006, 16, 17), (100, 5.0, 20, 20)):
        assert counts(rectangle(d, d, Rounding=NEAREST)) == (nearest, nearest), d
        assert counts(rectangle(d, d)) == (up, up), d
        spacing = float(array(made(rectangle(d, d)).GetFieldData(), "SensorGridRule")[0]
                        .split("p = ")[1].split(" m")[0])
        close(spacing, p, relative=1e-4)


def test_spacing_never_exceeds_ten_metres():
    """5^log10(d) passes 10 m at 270 m: a field of 1000 m needs 100 points each way, not 40."""
    assert counts(rectangle(1000, 900)) == (100, 90)


def test_longer_side_decides_unless_it_is_twice_the_other():
    # 5 x 4: the published example of the rule, 8 x 6 points.
    assert counts(rectangle(5, 4, Rounding=NEAREST)) == (8, 6)
    assert counts(rectangle(4, 5, Rounding=NEAREST)) == (6, 8)
    # 10 x 5: the ratio is 2, so p = 0.616 m of the shorter side.
    assert counts(rectangle(10, 5)) == (math.ceil(10 / 0.61601), math.ceil(5 / 0.61601))
    # 10 x 5.01: it is below 2, so p = 1 m of the longer side.
    assert counts(rectangle(10, 5.01)) == (10, 6)


def test_odd_numbers_and_explicit_spacing():
    assert counts(rectangle(10, 10, Rounding=ODD)) == (11, 11)
    assert counts(rectangle(2, 1.5, SpacingRule=SPACING, Spacing=0.25)) == (8, 6)
    assert counts(rectangle(2, 1.5, SpacingRule=SPACING, Spacing=0.3)) == (7, 5)
    assert counts(rectangle(2, 1.5, SpacingRule=RESOLUTION, Resolution=(3, 70))) == (3, 70)


def test_sensors_lie_in_the_middle_of_equal_parts():
    source = rectangle(4, 2, SpacingRule=RESOLUTION, Resolution=(4, 2))
    sensors = made(source)
    x, y = np.meshgrid([0.5, 1.5, 2.5, 3.5], [0.5, 1.5])
    close(points(sensors), np.column_stack([x.ravel(), y.ravel(), 0 * x.ravel()]), absolute=1e-15)
    close(array(sensors.GetPointData(), "Normals"), [[0, 0, 1]] * 8)
    assert sensors.GetNumberOfVerts() == 8 and sensors.GetNumberOfPolys() == 0
    mesh = source.GetOutput(1)
    assert mesh.GetNumberOfPoints() == 15 and mesh.GetNumberOfCells() == 8
    close(areas(mesh), [1] * 8)
    centre = vtk.vtkCellCenters()
    centre.SetInputData(mesh)
    centre.Update()
    close(points(centre.GetOutput()), points(sensors), absolute=1e-7)


def test_slanting_rectangle_and_flipped_normals():
    for flip, sign in ((False, 1), (True, -1)):
        source = work_plane(Origin=(1, 1, 1), Point1=(1, 3, 1), Point2=(1, 1, 5), FlipNormals=flip)
        sensors = made(source)
        close(array(sensors.GetPointData(), "Normals"),
              [[sign, 0, 0]] * sensors.GetNumberOfPoints(), absolute=1e-15)
        normals = vtk.vtkPolyDataNormals()
        normals.SetInputData(source.GetOutput(1))
        normals.ComputeCellNormalsOn()
        normals.ConsistencyOff()
        normals.SplittingOff()
        normals.Update()
        close(array(normals.GetOutput().GetCellData(), "Normals")[:, 0],
              [sign] * sensors.GetNumberOfPoints(), relative=1e-6)
        close(areas(source.GetOutput(1)).sum(), 8)


def test_work_plane_over_a_room():
    room = box(6, 4, 3, centre=(10, 20, 31.5))
    sensors = made(work_plane(room))
    xyz = points(sensors)
    close(xyz[:, 2], [30.8] * len(xyz))
    # 5 x 3 m are left: p = 0.616 m, 9 x 5 points, half a spacing from the edge of that.
    assert counts(work_plane(room)) == (9, 5)
    close([xyz[:, 0].min(), xyz[:, 0].max()], [7.5 + 2.5 / 9, 12.5 - 2.5 / 9])
    close([xyz[:, 1].min(), xyz[:, 1].max()], [18.5 + 0.3, 21.5 - 0.3])
    close(array(sensors.GetPointData(), "Normals"), [[0, 0, 1]] * len(xyz))
    whole = points(made(work_plane(room, WallZone=0, Height=0)))
    close(whole[:, 2], [30] * len(whole))
    assert whole[:, 0].min() < 7.4


def test_the_floor_decides_and_not_what_sticks_out():
    """A window's box outside the wall does not widen the room; a room without a floor, or with a
    small pit in it, is its bounds."""
    append = vtk.vtkAppendPolyData()
    append.AddInputData(box(6, 4, 3))
    append.AddInputData(box(1, 1, 1, centre=(3.5, 0, 0)))
    append.Update()
    close(points(made(work_plane(append.GetOutput()))), points(made(work_plane(box(6, 4, 3)))))
    append.AddInputData(box(0.5, 0.5, 0.5, centre=(0, 0, -1.75)))  # a pit: lowest, and small
    append.Update()
    mesh = work_plane(append.GetOutput(), Height=1)
    made(mesh)
    close(mesh.GetOutput(1).GetBounds(), (-2.5, 3.5, -1.5, 1.5, -1, -1))


def test_narrow_rooms_keep_half_of_their_width():
    """A corridor of 1.2 m would lose all but 0.2 m to zones of 0.5 m: they are 0.3 m there."""
    mesh = work_plane(box(6, 1.2, 3))
    made(mesh)
    bounds = mesh.GetOutput(1).GetBounds()
    close(bounds[:4], (-2.5, 2.5, -0.3, 0.3))


def test_up_directions():
    room = box(6, 4, 3)
    for up, axis, height in (((0, 1, 0), 1, -2 + 0.8), ((0, 0, -5), 2, 1.5 - 0.8),
                             ((1e-3, 0, 0), 0, -3 + 0.8)):
        sensors = made(work_plane(room, UpDirection=up))
        close(points(sensors)[:, axis], [height] * sensors.GetNumberOfPoints())
        expected = np.zeros(3)
        expected[axis] = np.sign(up[axis])
        close(array(sensors.GetPointData(), "Normals"),
              [expected] * sensors.GetNumberOfPoints(), absolute=1e-15)
    # A room turned about z by 30 degrees has a slanting up only if asked for: any direction works.
    sensors = made(work_plane(room, UpDirection=(1, 1, 1), WallZone=0))
    heights = points(sensors) @ np.ones(3) / math.sqrt(3)
    close(heights, [-6.5 / math.sqrt(3) + 0.8] * len(heights))


def test_units_of_length():
    """Lengths are metres, coordinates are not: a room in millimetres gets the same grid."""
    metres = points(made(work_plane(box(6, 4, 3))))
    millimetres = points(made(work_plane(box(6000, 4000, 3000), MetersPerUnit=0.001)))
    close(millimetres, 1000 * metres, relative=1e-9, absolute=1e-9)


def test_far_away():
    """UTM coordinates: the sensors keep their places to the rounding of a double."""
    near = points(made(work_plane(box(6, 4, 3))))
    far = points(made(work_plane(box(6, 4, 3, centre=(5e5, 4e6, 100)))))
    close(far - [5e5, 4e6, 100], near, absolute=2e-9)


def test_on_a_surface():
    """Sensors cover every polygon: their pieces add up to its area, normals are the surface's."""
    room = box(2, 1.5, 1)
    source = work_plane(room, Mode=ON_SURFACE, SpacingRule=SPACING, Spacing=0.25)
    sensors = made(source)
    assert sensors.GetNumberOfPoints() == 2 * (8 * 6 + 8 * 4 + 6 * 4)
    normals = array(sensors.GetPointData(), "Normals")
    xyz = points(sensors)
    half = np.array([1, 0.75, 0.5])
    for k in range(3):
        for sign in (-1, 1):
            wall = np.abs(xyz[:, k] - sign * half[k]) < 1e-12
            assert wall.any()
            expected = np.zeros(3)
            expected[k] = -sign  # inward
            inner = wall & (np.abs(np.delete(xyz, k, axis=1)) < np.delete(half, k)).all(axis=1)
            close(normals[inner], [expected] * inner.sum(), absolute=1e-15)
    close(areas(source.GetOutput(1)).sum(), 2 * (3 + 2 + 1.5))


def test_triangles_polygons_and_strips_on_a_surface():
    ball = vtk.vtkSphereSource()
    ball.SetThetaResolution(24)
    ball.SetPhiResolution(24)
    ball.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
    disc = vtk.vtkRegularPolygonSource()
    disc.SetNumberOfSides(7)
    stripper = vtk.vtkStripper()
    stripper.SetInputConnection(ball.GetOutputPort())
    for producer in (ball, disc, stripper):
        producer.Update()
        surface = vtk.vtkTriangleFilter()
        surface.SetInputConnection(producer.GetOutputPort())
        surface.Update()
        total = areas(surface.GetOutput()).sum()
        source = work_plane(producer.GetOutput(), Mode=ON_SURFACE, SpacingRule=SPACING,
                            Spacing=0.05)
        sensors = made(source)
        close(areas(source.GetOutput(1)).sum(), total, relative=1e-6)
        mesh = source.GetOutput(1)
        assert mesh.GetNumberOfCells() == sensors.GetNumberOfPoints()
        if producer is not disc:
            out = np.einsum("ij,ij->i", points(sensors),
                            array(sensors.GetPointData(), "Normals"))
            assert out.min() > 0.4, "normals look out of the ball"
        cell = vtk.vtkGenericCell()
        for i in range(0, mesh.GetNumberOfCells(), 7):
            mesh.GetCell(i, cell)
            for k in range(cell.GetNumberOfEdges()):
                assert math.sqrt(cell.GetEdge(k).GetLength2()) <= 0.05 * (1 + 1e-9)


def test_on_a_composite_and_a_grid():
    blocks = vtk.vtkMultiBlockDataSet()
    blocks.SetBlock(0, box(2, 2, 2))
    blocks.SetBlock(1, box(2, 2, 2, centre=(5, 0, 0)))
    sensors = made(work_plane(blocks, Mode=ON_SURFACE, SpacingRule=SPACING, Spacing=1.0))
    assert sensors.GetNumberOfPoints() == 48
    room = points(made(work_plane(blocks, WallZone=0)))
    assert room[:, 0].max() > 5.5
    wavelet = vtk.vtkRTAnalyticSource()
    wavelet.SetWholeExtent(0, 2, 0, 2, 0, 2)
    wavelet.Update()
    sensors = made(work_plane(wavelet.GetOutput(), Mode=ON_SURFACE, SpacingRule=SPACING,
                              Spacing=1.0))
    assert sensors.GetNumberOfPoints() == 24


def test_sensors_on_a_surface_are_lit_and_not_shadowed_by_it():
    """A closed room with a lamp in its middle lights every sensor on its walls: I cos/r^2."""
    room = box(3, 2, 2.5)
    lamp = vtkPointLightSource()
    lamp.SetIntensity(10.0)
    sensors = made(work_plane(room, Mode=ON_SURFACE))
    f = simulation(vtkIrradianceFilter, sensors, lamp)
    f.AddOccludersData(room)
    f.Update()
    xyz = points(sensors)
    normals = array(sensors.GetPointData(), "Normals")
    expected = -10.0 * np.einsum("ij,ij->i", xyz, normals) / np.linalg.norm(xyz, axis=1)**3
    close(array(f.GetOutputDataObject(0).GetPointData(), "Irradiance"), expected)


def test_irradiance_statistics_and_lines_of_a_work_plane():
    """From the plane through Irradiance to numbers and lines, and nothing written in between."""
    room = box(6, 4, 3, centre=(0, 0, 1.5))
    lamp = vtkPointLightSource()
    lamp.SetPosition(0, 0, 2.8)
    lamp.SetIntensity(10000.0)
    lamp.SetIntensityUnitToLumen()
    plane = work_plane(room, SpacingRule=SPACING, Spacing=0.02)
    irradiance = vtkIrradianceFilter()
    irradiance.SetInputConnection(plane.GetOutputPort())
    irradiance.AddLightsConnection(lamp.GetOutputPort())
    irradiance.AddOccludersData(room)
    irradiance.SetPhotometric(True)
    statistics = vtkRadiometricStatistics()
    statistics.SetInputConnection(irradiance.GetOutputPort())
    statistics.AddIsovalue(150.0)
    statistics.Update()
    table = statistics.GetOutputDataObject(0)
    rows = {table.GetValueByName(i, "Array").ToString(): i for i in range(table.GetNumberOfRows())}
    row = rows["Illuminance"]
    # The flux through the plane is I times its solid angle.
    a, b, h = 2.5, 1.5, 2.0
    omega = 4 * math.atan2(a * b, h * math.sqrt(a * a + b * b + h * h))
    intensity = 10000 / (4 * math.pi)
    close(table.GetValueByName(row, "Flux").ToDouble(), intensity * omega, relative=2e-5)
    close(table.GetValueByName(row, "Area").ToDouble(), 15.0)
    lowest = intensity * h / (a * a + b * b + h * h)**1.5
    close(table.GetValueByName(row, "Minimum").ToDouble(), lowest, relative=0.01)
    # 150 lx where I h/(r^2 + h^2)^(3/2) is: a circle of 0.91 m.
    r = math.sqrt((intensity * h / 150.0)**(2 / 3) - h * h)
    lines = statistics.GetOutputDataObject(1)
    assert lines.GetNumberOfCells() == 1
    close(np.hypot(points(lines)[:, 0], points(lines)[:, 1]), [r] * lines.GetNumberOfPoints(),
          relative=2e-4)
    close(array(lines.GetCellData(), "Length"), [2 * math.pi * r], relative=1e-3)
    assert array(lines.GetCellData(), "Label") == ["150 lx"]
    cells = statistics.GetOutputDataObject(3)
    assert cells.GetNumberOfPolys() == plane.GetOutput().GetNumberOfPoints()
    assert cells.GetCellData().HasArray("Illuminance")


def test_a_sun_on_a_plane_is_even():
    plane = made(rectangle(3, 2))
    f = simulation(vtkIrradianceFilter, plane, sun((0, 0, -1), 5.0))
    f.Update()
    statistics = vtkRadiometricStatistics()
    statistics.SetInputDataObject(f.GetOutputDataObject(0))
    statistics.Update()
    table = statistics.GetOutputDataObject(0)
    for name, value in (("U0", 1), ("Ud", 1), ("Mean", 5), ("Area", 6), ("Flux", 30)):
        close(table.GetValueByName(0, name).ToDouble(), value)
    assert statistics.GetOutputDataObject(1).GetNumberOfCells() == 0


def test_properties_out_of_range():
    nan, infinite = float("nan"), float("inf")
    room = box()
    for data, properties, words in (
            (None, dict(Point1=(-0.5, -0.5, 0)), ("Point1", "area")),
            (None, dict(Point2=(3.5, -0.5, 0)), ("Point2", "parallel")),
            (None, dict(Origin=(0, nan, 0)), ("Origin[1]", "nan")),
            (None, dict(Point1=(infinite, 0, 0)), ("Point1[0]", "inf")),
            (None, dict(Mode=ROOM), ("Input", "missing")),
            (None, dict(Mode=ON_SURFACE), ("Input", "missing")),
            (None, dict(Mode=7), ("Mode", "7")),
            (None, dict(SpacingRule=3), ("SpacingRule", "3")),
            (None, dict(Rounding=-1), ("Rounding", "-1")),
            (None, dict(Resolution=(0, 5)), ("Resolution[0]", "0")),
            (None, dict(SpacingRule=SPACING, Spacing=0), ("Spacing", "0")),
            (None, dict(SpacingRule=SPACING, Spacing=1e-9), ("sensors", "10000000")),
            (None, dict(SpacingRule=RESOLUTION, Resolution=(100000, 100000)), ("sensors",)),
            (None, dict(MetersPerUnit=-1), ("MetersPerUnit", "-1")),
            (room, dict(WallZone=-0.1), ("WallZone", "-0.1")),
            (room, dict(Height=nan), ("Height", "nan")),
            (room, dict(UpDirection=(0, 0, 0)), ("UpDirection",)),
            (room, dict(UpDirection=(nan, 0, 1)), ("UpDirection", "nan")),
            (room, dict(Mode=ON_SURFACE, SpacingRule=RESOLUTION), ("SpacingRule",)),
            (room, dict(Mode=ON_SURFACE, SpacingRule=SPACING, Spacing=1e-6), ("sensors",)),
            (vtk.vtkPolyData(), dict(Mode=ROOM), ("Input", "empty")),
            (vtk.vtkPolyData(), dict(Mode=ON_SURFACE), ("side",))):
        fails(work_plane(data, **properties), *words)
    bad = box()
    bad.GetPoints().SetPoint(3, 0, nan, 0)
    fails(work_plane(bad), "Points[3]", "nan")
    fails(work_plane(bad, Mode=ON_SURFACE, SpacingRule=SPACING), "Points[3]", "nan")


def test_recovers_after_an_error():
    source = rectangle(1, 1, Mode=9)
    fails(source, "Mode")
    source.SetMode(AUTO)
    assert made(source).GetNumberOfPoints() == 25


if __name__ == "__main__":
    run_all(globals())
