# SPDX-License-Identifier: BSD-3-Clause
"""Area lights: their source, their data, and their light on a surface."""
import math

import numpy as np
from checks import array, cell_values, close, fails, run_all, simulation
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkIntArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkradiometry import (
    vtkAreaLightSource,
    vtkIrradianceFilter,
    vtkRadiosityFilter,
    vtkSpotLightSource,
)

K = 683.002
WATT_M2, WATT, RADIANCE, LUMEN_M2, LUMEN, LUMINANCE = range(6)


def made(**properties):
    source = vtkAreaLightSource()
    for name, value in properties.items():
        getattr(source, "Set" + name)(value)
    return source


def exitance(**properties):
    source = made(**properties)
    source.Update()
    return array(source.GetOutput().GetPointData(), "Intensity")


def polygon(corners, intensity=1.0, kind=3, **arrays):
    """One polygon as light data."""
    data = vtkPolyData()
    points = vtkPoints()
    points.SetDataTypeToDouble()
    cells = vtkCellArray()
    cells.InsertNextCell(len(corners))
    for corner in corners:
        cells.InsertCellPoint(points.InsertNextPoint(corner))
    data.SetPoints(points)
    data.SetPolys(cells)
    arrays = {"LightType": kind, "Intensity": intensity, **arrays}
    for name, value in arrays.items():
        values = np.broadcast_to(np.asarray(value, float), (len(corners),) + np.shape(value)[1:])
        found = numpy_to_vtk(np.array(values), deep=True)
        found.SetName(name)
        data.GetPointData().AddArray(found)
    return data


def plane(size=2.0, n=1, z=0.0, down=False):
    source = vtkPlaneSource()
    source.SetOrigin(-size / 2, -size / 2, z)
    source.SetPoint1((-size / 2, size / 2, z) if down else (size / 2, -size / 2, z))
    source.SetPoint2((size / 2, -size / 2, z) if down else (-size / 2, size / 2, z))
    source.SetResolution(n, n)
    source.Update()
    return source.GetOutput()


def lit(surface, *data, kind=vtkIrradianceFilter, **properties):
    f = simulation(kind, surface, **properties)
    for one in data:
        f.AddInputDataObject(1, one)
    return f


SQUARE = [(-.5, -.5, 1), (-.5, .5, 1), (.5, .5, 1), (.5, -.5, 1)]  # shines down


def test_units():
    shape = dict(Width=2, Height=3)
    close(exitance(Intensity=5, **shape), [5] * 4)
    close(exitance(Intensity=12, IntensityUnit=WATT, **shape), [2] * 4)
    close(exitance(Intensity=12, IntensityUnit=WATT, TwoSided=True, **shape), [1] * 4)
    close(exitance(Intensity=7, IntensityUnit=RADIANCE), [7 * math.pi] * 4)
    close(exitance(Intensity=7, IntensityUnit=LUMEN_M2), [7 / K] * 4)
    close(exitance(Intensity=7, IntensityUnit=LUMEN, **shape), [7 / 6 / K] * 4)
    close(exitance(Intensity=7, IntensityUnit=LUMINANCE, LuminousEfficacy=100),
          [7 * math.pi / 100] * 4)
    disc = exitance(Intensity=9, IntensityUnit=WATT, Shape=1, Radius=2, Sides=7)
    close(disc, [9 / (4 * math.pi)] * 7)  # equal area
    colours = exitance(Intensity=2, Color=(1, 0.5, 0))
    close(colours, [[2, 1, 0]] * 4)


def test_shapes_shine_along_direction():
    source = made(Position=(1, 2, 3), Direction=(0, 2, 0), ReferenceDirection=(0, 1, 5), Width=4,
                  Height=1)
    source.Update()
    data = source.GetOutput()
    corners = np.array([data.GetPoint(i) for i in range(4)])
    close(corners.mean(axis=0), (1, 2, 3))
    close(np.ptp(corners, axis=0), (1, 0, 4), absolute=1e-12)
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    close(normal / np.linalg.norm(normal), (0, 1, 0), absolute=1e-12)
    close(array(data.GetPointData(), "Direction"), [[0, 1, 0]] * 4, absolute=1e-12)
    assert data.GetNumberOfVerts() == 0 and data.GetNumberOfPolys() == 1


def test_hundred_lumens_far_away():
    """31.831 lx at 1 m on the axis, by the inverse square from 100 m; so does each shape."""
    for shape in (dict(), dict(Shape=1, Sides=3), dict(Shape=1)):
        source = made(Intensity=100, IntensityUnit=LUMEN, Position=(0, 0, 100), Width=0.1,
                      Height=0.1, Radius=0.05, **shape)
        f = simulation(vtkIrradianceFilter, plane(0.01), source, Photometric=True)
        close(cell_values(f, "Illuminance") * 100**2, [31.830988618379067], 1e-5)


def test_panel_of_the_references():
    sensor = vtkPolyData()
    points = vtkPoints()
    points.InsertNextPoint(0, 0, 0)
    verts = vtkCellArray()
    verts.InsertNextCell(1, [0])
    sensor.SetPoints(points)
    sensor.SetVerts(verts)
    normals = numpy_to_vtk(np.array([[0.0, 0.0, 1.0]]), deep=True)
    normals.SetName("Normals")
    sensor.GetPointData().AddArray(normals)
    source = made(Intensity=1000, IntensityUnit=LUMINANCE, Position=(0, 0, 3), Width=2, Height=1)
    f = simulation(vtkIrradianceFilter, sensor, source, Photometric=True)
    f.Update()
    out = f.GetOutputDataObject(0)
    data = out.GetPointData() if out.GetPointData().HasArray("Illuminance") else out.GetCellData()
    close(array(data, "Illuminance"), [203.626], 5e-6)


def test_polygons_of_an_input():
    """An L of two rectangles sends what they send; flux is shared by area."""
    ell = polygon([(0, 0, 2), (0, 2, 2), (1, 2, 2), (1, 1, 2), (2, 1, 2), (2, 0, 2)])
    parts = [polygon([(0, 0, 2), (0, 2, 2), (1, 2, 2), (1, 0, 2)]),
             polygon([(1, 0, 2), (1, 1, 2), (2, 1, 2), (2, 0, 2)])]
    sources = []
    for data, flux in ((ell, 6.0), (parts[0], 4.0), (parts[1], 2.0)):
        source = made(Shape=2, IntensityUnit=WATT, Intensity=flux)
        source.SetInputData(data)
        sources.append(source)
    whole = cell_values(simulation(vtkIrradianceFilter, plane(3.0, 3), sources[0]), "Irradiance")
    both = cell_values(simulation(vtkIrradianceFilter, plane(3.0, 3), *sources[1:]), "Irradiance")
    assert whole.min() > 0
    close(whole, both, 1e-6)
    close(array(sources[0].GetOutput().GetPointData(), "Intensity"), [2.0] * 6)


def test_light_data_round_trip():
    first = made(TwoSided=True, Intensity=3, LightName="panel")
    values = cell_values(simulation(vtkIrradianceFilter, plane(2, 2), first), "Irradiance")
    first.Update()
    again = cell_values(lit(plane(2, 2), first.GetOutput()), "Irradiance")
    close(values, again, 0)
    # Cells in the plane of the light see nothing of it; above it they see the back.
    up = made(TwoSided=False, Direction=(0, 0, 1), Position=(0, 0, 1), Intensity=3)
    close(cell_values(simulation(vtkIrradianceFilter, plane(2, 2), up), "Irradiance"), [0] * 4)
    up.TwoSidedOn()
    assert cell_values(simulation(vtkIrradianceFilter, plane(2, 2), up), "Irradiance").min() > 0


def test_parallel_squares_as_light_and_as_emitting_surface():
    light = cell_values(lit(plane(1.0), polygon(SQUARE)), "Irradiance")
    close(light, [0.199824895698387], 1e-6)
    # The same square as a surface that emits, below the switch Emission.
    from vtkmodules.vtkFiltersCore import vtkAppendPolyData
    both = vtkAppendPolyData()
    both.AddInputData(plane(1.0))
    both.AddInputData(plane(1.0, z=1.0, down=True))
    both.Update()
    surface = both.GetOutput()
    emitted = numpy_to_vtk(np.array([0.0, 1.0]), deep=True)
    emitted.SetName("EmittedExitance")
    surface.GetCellData().AddArray(emitted)
    values = cell_values(lit(surface), "Irradiance")
    close(values, [0.199824895698387, 0.0], 1e-6)
    off = lit(surface, Emission=2)
    close(cell_values(off, "Irradiance"), [0.0, 0.0])
    plan = off.GetOutputDataObject(1)
    row = [plan.GetColumnByName("Effect").GetValue(i) for i in range(9)].index("Emission")
    bounds = next(plan.GetColumn(c) for c in range(plan.GetNumberOfColumns())
                  if "ound" in plan.GetColumnName(c))
    assert bounds.GetVariantValue(row).ToDouble() >= 0.2


def test_radiosity_is_lit_too():
    for kind in (vtkIrradianceFilter, vtkRadiosityFilter):
        f = lit(plane(1.0), polygon(SQUARE), kind=kind)
        close(cell_values(f, "Irradiance"), [0.199824895698387], 1e-4)


def test_panel_in_a_ceiling_is_not_hidden_by_it():
    for tilt in (0.0, 0.3):
        turn = np.array([[1, 0, 0], [0, math.cos(tilt), -math.sin(tilt)],
                         [0, math.sin(tilt), math.cos(tilt)]])
        surface = plane(4.0, 4, z=1.0, down=True)
        ceiling = vtkPolyData()
        ceiling.DeepCopy(surface)
        points = vtkPoints()
        points.SetDataTypeToDouble()
        for i in range(surface.GetNumberOfPoints()):
            points.InsertNextPoint(turn @ surface.GetPoint(i))
        ceiling.SetPoints(points)
        corners = [tuple(turn @ np.array(c)) for c in SQUARE]
        f = lit(plane(1.0), polygon(corners))
        f.AddInputDataObject(2, ceiling)
        close(cell_values(f, "Irradiance"),
              cell_values(lit(plane(1.0), polygon(corners)), "Irradiance"), 1e-12)


def test_lights_at_a_ceiling_in_single_precision():
    """2.8 m is 2.79999995 m in single precision: a panel or spot at 2.8 m would lie behind it."""
    ceiling = vtkPlaneSource()
    ceiling.SetOrigin(-2, -2, 2.8)
    ceiling.SetPoint1(-2, 2, 2.8)
    ceiling.SetPoint2(2, -2, 2.8)
    ceiling.SetResolution(3, 3)
    ceiling.Update()
    assert ceiling.GetOutput().GetPoint(0)[2] < 2.8
    panel = made(Position=(0, 0, 2.8), Width=1.2, Height=0.3, Intensity=100.0)
    panel.Update()
    spot = vtkSpotLightSource()
    spot.SetPosition(0.3, 0.1, 2.8)
    spot.Update()
    for light in (panel.GetOutput(), spot.GetOutput()):
        bare = cell_values(lit(plane(2.0, 4), light), "Irradiance")
        f = lit(plane(2.0, 4), light)
        f.AddInputDataObject(2, ceiling.GetOutput())
        assert bare.min() > 0.0
        close(cell_values(f, "Irradiance"), bare, 1e-6)
    # A light truly above the ceiling stays there.
    above = made(Position=(0, 0, 2.80001), Width=1.2, Height=0.3, Intensity=100.0)
    above.Update()
    f = lit(plane(2.0, 4), above.GetOutput())
    f.AddInputDataObject(2, ceiling.GetOutput())
    assert (cell_values(f, "Irradiance") == 0.0).all()


def test_bad_data_is_named():
    def bad(data, *words):
        fails(lit(plane(), data), *words)

    nan = math.nan
    bad(polygon([(0, 0, 1), (1, 0, 1), (0, 1, 1), (1, 1, 1)]), "Polygons", "0", "cross")
    bad(polygon([(0, 0, 1), (1, 0, 1), (1, 1, 1.5), (0, 1, 1)]), "Polygons", "0", "flat")
    bad(polygon([(0, 0, 1), (1, 0, 1), (1, nan, 1), (0, 1, 1)]), "Points", "2", "finite")
    bad(polygon(SQUARE, nan), "Intensity", "nan")
    bad(polygon(SQUARE, -1.0), "Intensity", "-1")
    bad(polygon(SQUARE, kind=[3, 3, 0, 3]), "LightType", "2", "polygon 0")
    bad(polygon(SQUARE, Attenuation=[[1, 0, 0]] * 4), "Attenuation")
    loose = polygon(SQUARE)
    loose.SetPolys(vtkCellArray())
    bad(loose, "LightType", "0", "polygon")


def test_shared_and_zero_area_polygons():
    """Two lights that share corners; one without area gives nothing."""
    data = polygon(SQUARE + [(1.5, .5, 1), (1.5, -.5, 1)])
    cells = vtkCellArray()
    cells.InsertNextCell(4, [0, 1, 2, 3])
    cells.InsertNextCell(4, [3, 2, 4, 5])
    cells.InsertNextCell(3, [0, 3, 0])
    data.SetPolys(cells)
    long = polygon([(-.5, -.5, 1), (-.5, .5, 1), (1.5, .5, 1), (1.5, -.5, 1)])
    close(cell_values(lit(plane(2, 2), data), "Irradiance"),
          cell_values(lit(plane(2, 2), long), "Irradiance"), 1e-6)


def test_bad_properties_are_named():
    nan = math.nan
    for properties, words in (
            (dict(Width=0), ("Width", "0")), (dict(Height=nan), ("Height", "nan")),
            (dict(Shape=1, Radius=-1), ("Radius", "-1")), (dict(Shape=1, Sides=2), ("Sides", "2")),
            (dict(Direction=(0, 0, 0)), ("Direction",)),
            (dict(ReferenceDirection=(0, nan, 0)), ("ReferenceDirection",)),
            (dict(Shape=2), ("Input",)), (dict(Shape=3), ("Shape", "3")),
            (dict(IntensityUnit=6), ("IntensityUnit", "6")), (dict(Intensity=-2), ("Intensity",))):
        fails(made(**properties), *words)
    source = made(Shape=2)
    source.SetInputData(polygon([(0, 0, 0), (1, 0, 0), (2, 0, 0)]))
    fails(source, "Polygons", "area")


if __name__ == "__main__":
    run_all(globals())
