# SPDX-License-Identifier: BSD-3-Clause
"""Radiance toward an eye, solid angles and image irradiance through the filter."""
import math

import numpy as np
import vtkmodules.all as vtk
from checks import array, close, fails, run_all, simulation, square, strings
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkradiometry import (vtkAreaLightSource, vtkDirectionalLightSource, vtkEnvironmentLightSource,
                           vtkIrradianceFilter, vtkPointLightSource, vtkRadianceFilter,
                           vtkRadiosityFilter, vtkSurfaceMaterialFilter)


def box(inward=True, size=2.0):
    source = vtk.vtkCubeSource()
    source.SetXLength(size)
    source.SetYLength(size)
    source.SetZLength(size)
    source.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
    turn = vtk.vtkReverseSense()
    turn.SetInputConnection(source.GetOutputPort())
    turn.SetReverseCells(inward)
    turn.Update()
    return turn.GetOutput()


def named(values, name):
    made = numpy_to_vtk(np.array(values, float), deep=True)
    made.SetName(name)
    return made


def add(data, name, values, points=False):
    (data.GetPointData() if points else data.GetCellData()).AddArray(named(values, name))
    return data


def lamp(position, intensity):
    source = vtkPointLightSource()
    source.SetPosition(*position)
    source.SetIntensity(intensity)
    return source


def output(f, port=0):
    f.Update()
    return f.GetOutputDataObject(port)


def radiance(data, *lights, **properties):
    views = {k: properties.pop(k) for k in ("ViewPoint", "ViewDirection") if k in properties}
    f = simulation(vtkRadianceFilter, data, *lights, **properties)
    for name, value in views.items():
        getattr(f, "Set" + name)(*value)
    return f


def test_radiosity_over_pi():
    data = add(square(2), "Radiosity", [1.0, 2.0, 3.0, 4.0])
    add(data, "RadiosityError", [0.1] * 4)
    cells = output(radiance(data, ViewPoint=(0, 0, 3))).GetCellData()
    close(array(cells, "Radiance"), np.array([1, 2, 3, 4]) / math.pi)
    close(array(cells, "RadianceError"), [0.1 / math.pi] * 4)
    assert array(cells, "Facing").tolist() == [1] * 4
    # From behind a front-only surface sends nothing; in its plane nothing is seen of it.
    below = output(radiance(data, ViewPoint=(0, 0, -3))).GetCellData()
    close(array(below, "Radiance"), [0] * 4)
    assert array(below, "Facing").tolist() == [-1] * 4
    beside = output(radiance(data, ViewPoint=(5, 0, 0))).GetCellData()
    close(array(beside, "Radiance"), [0] * 4)
    close(array(beside, "SolidAngle"), [0] * 4)
    assert array(beside, "Facing").tolist() == [0] * 4


def test_irradiance_reflected_and_emitted():
    data = add(square(1), "Irradiance", [10.0])
    add(data, "IrradianceError", [0.2])
    add(data, "DiffuseReflectance", [0.3])
    add(data, "EmittedExitance", [2.0])
    f = radiance(data, ViewPoint=(0, 0, 3))
    cells = output(f).GetCellData()
    close(array(cells, "Radiance"), [(0.3 * 10 + 2) / math.pi])
    close(array(cells, "RadianceError"), [0.3 * 0.2 / math.pi])
    plan = output(f, 1)
    rows = dict(zip(strings(plan, "Effect"), strings(plan, "Decision")))
    assert rows["Emission"] == "simulated", rows
    assert set(strings(plan, "Unit")) == {"W/(m^2 sr)"}


def test_two_sided():
    data = add(square(1), "Radiosity", [1.0])
    add(data, "RadiosityBack", [5.0])
    close(array(output(radiance(data, ViewPoint=(0, 0, -3))).GetCellData(), "Radiance"), [0.0])
    f = radiance(data, ViewPoint=(0, 0, -3), TwoSided=True)
    close(array(output(f).GetCellData(), "Radiance"), [5 / math.pi])
    f = radiance(data, ViewPoint=(0, 0, -3), TwoSided=True, BackFaces=2)
    close(array(output(f).GetCellData(), "Radiance"), [0.0])
    plan = output(f, 1)
    bounds = plan.GetColumnByName("Bound")
    row = strings(plan, "Effect").index("BackFaces")
    assert strings(plan, "Decision")[row] == "left out" and bounds.GetValue(row) >= 5 / math.pi


def test_of_its_own_accord():
    """Without Radiosity or Irradiance direct light is computed: the same as Irradiance gives."""
    light = lamp((0.3, 0.2, 1.5), 4.0)
    direct = simulation(vtkIrradianceFilter, square(3), light)
    after = radiance(output(direct), ViewPoint=(0, 0, 3))
    alone = radiance(square(3), light, ViewPoint=(0, 0, 3))
    for name in ("Radiance", "RadianceError"):
        close(array(output(alone).GetCellData(), name), array(output(after).GetCellData(), name))
    close(array(output(after).GetCellData(), "Radiance"),
          0.5 / math.pi * array(output(direct).GetCellData(), "Irradiance"))
    field = output(after).GetFieldData()
    units = array(field, "RadiometryUnits")
    assert "Radiance [W/(m^2 sr)]" in units and "Irradiance [W/m^2]" in units, units
    assert len(array(field, "RadiometryOptions")) == 2


def test_box_fills_the_sphere():
    for eye in ((0, 0, 0), (0.9, -0.99, 0.5), (1 - 1e-12, 0, 0), (1, 0.2, 0.1)):
        cells = output(radiance(box(), ViewPoint=eye)).GetCellData()
        close(array(cells, "SolidAngle").sum(), 4 * math.pi, relative=1e-9)
        close(array(cells, "ProjectedSolidAngle").sum(), math.pi, relative=1e-9)
        assert (array(cells, "Facing") == 1).all()
    f = radiance(box(), ViewPoint=(0, 0, 0), ReceiverNormal=(0.3, -0.7, 0.2))
    close(array(output(f).GetCellData(), "ProjectedSolidAngle").sum(), math.pi, relative=1e-9)


def test_radiance_times_projected_solid_angle_is_irradiance():
    """What a sensor gets of an area light, and what the light's polygon sends it."""
    panel = vtkAreaLightSource()
    panel.SetIntensity(50.0)  # exitance
    panel.Update()
    surface = vtk.vtkPolyData()
    surface.DeepCopy(panel.GetOutput())
    surface.GetCellData().Initialize()
    surface.GetPointData().Initialize()
    add(surface, "Radiosity", [50.0])
    for eye, normal in (((0.4, 0.3, -2.0), (0, 0, 1)), ((0.2, 0.8, -0.3), (0, -0.3, 0.4))):
        sensors = vtk.vtkPolyData()
        points = vtk.vtkPoints()
        points.SetDataTypeToDouble()
        points.InsertNextPoint(eye)
        sensors.SetPoints(points)
        verts = vtk.vtkCellArray()
        verts.InsertNextCell(1, [0])
        sensors.SetVerts(verts)
        sensors.GetPointData().AddArray(named([normal], "Normals"))
        e = output(simulation(vtkIrradianceFilter, sensors, panel))
        seen = output(radiance(surface, ViewPoint=eye, ReceiverNormal=normal)).GetCellData()
        sent = array(seen, "Radiance") * array(seen, "ProjectedSolidAngle")
        close(sent.sum(), array(e.GetPointData(), "Irradiance")[0], relative=1e-10)
        assert sent.sum() > 0.0


def test_image_irradiance():
    """E = L pi/4 cos^4/N^2 at the middle of each cell; the cell's extent is in the error."""
    data = add(square(20, 4.0), "Radiosity", [math.pi] * 400)
    f = radiance(data, ViewPoint=(0, 0, 2), ViewAxis=(0, 0, -1), FNumber=2.8)
    cells = output(f).GetCellData()
    middles = vtk.vtkCellCenters()
    middles.SetInputData(data)
    middles.Update()
    p = np.array([middles.GetOutput().GetPoint(i) for i in range(400)])
    cosine = 2.0 / np.sqrt((p ** 2).sum(axis=1) + 4.0)
    close(array(cells, "ImageIrradiance"), math.pi / 4 * cosine ** 4 / 2.8 ** 2, relative=1e-6)
    close(array(cells, "OffAxisAngle"), np.degrees(np.arccos(cosine)), absolute=1e-4)
    error = array(cells, "ImageIrradianceError") / array(cells, "ImageIrradiance")
    assert 1e-4 < error.max() < 0.02, error.max()
    doubled = output(radiance(data, ViewPoint=(0, 0, 2), ViewAxis=(0, 0, -1), FNumber=5.6))
    close(array(doubled.GetCellData(), "ImageIrradiance"), array(cells, "ImageIrradiance") / 4)
    none = output(radiance(data, ViewPoint=(0, 0, 2), FNumber=0)).GetCellData()
    assert not none.HasArray("ImageIrradiance")
    behind = output(radiance(data, ViewPoint=(0, 0, 2), ViewAxis=(0, 0, 1)))
    close(array(behind.GetCellData(), "ImageIrradiance"), [0] * 400)


def test_view_direction():
    data = add(square(2), "Radiosity", [1.0] * 4)
    cells = output(radiance(data, ViewDirection=(1, 0, -1))).GetCellData()
    close(array(cells, "Radiance"), [1 / math.pi] * 4)
    assert not cells.HasArray("SolidAngle")
    close(array(cells, "OffAxisAngle"), [0] * 4)
    assert array(output(radiance(data, ViewDirection=(0, 0, 1))).GetCellData(), "Facing").max() == -1


def test_highlight_and_photometry():
    """A glossy plate under a sun, seen along the mirror direction: (n + 2)/(2 pi) rho_s E."""
    data = add(square(2), "SpecularReflectance", [0.2] * 4)
    add(data, "Shininess", [50.0] * 4)
    add(data, "DiffuseReflectance", [0.0] * 4)
    sun = vtkDirectionalLightSource()
    sun.SetDirection(1, 0, -1)
    sun.SetIntensity(100.0)
    f = radiance(data, sun, ViewDirection=(-1, 0, -1), Photometric=True, LuminousEfficacy=100.0)
    cells = output(f).GetCellData()
    exact = 0.2 * 52 / (2 * math.pi) * 100 * math.sqrt(0.5)
    close(array(cells, "Radiance"), [exact] * 4, relative=1e-9)
    close(array(cells, "Luminance"), [100 * exact] * 4, relative=1e-9)
    assert cells.HasArray("ImageIlluminance")
    off = output(radiance(data, sun, ViewDirection=(-1, 0, -1), SpecularTransport=2), 1)
    row = strings(off, "Effect").index("SpecularTransport")
    assert strings(off, "Decision")[row] == "left out"
    assert off.GetColumnByName("Bound").GetValue(row) >= exact


def test_glossy_plate_under_a_sky():
    data = add(square(1), "SpecularReflectance", [0.5])
    add(data, "Shininess", [0.0])
    add(data, "DiffuseReflectance", [0.0])
    sky = vtkEnvironmentLightSource()
    sky.SetPreset(0)
    sky.SetIntensityUnit(0)
    sky.SetIntensity(3.0)
    cells = output(radiance(data, sky, ViewPoint=(1, 0, 2))).GetCellData()
    assert abs(array(cells, "Radiance")[0] - 1.5) <= array(cells, "RadianceError")[0] + 1e-12


def test_points():
    """Results at points where the surface has them there, or they are asked for."""
    light = lamp((0.3, 0.2, 1.5), 4.0)
    at_points = output(simulation(vtkIrradianceFilter, square(3), light, SampleLocation=1))
    found = output(radiance(at_points, ViewPoint=(0, 0, 3)))
    close(array(found.GetPointData(), "Radiance"),
          0.5 / math.pi * array(at_points.GetPointData(), "Irradiance"))
    assert not found.GetCellData().HasArray("Radiance")
    of_cells = add(square(3), "Radiosity", [2.0] * 9)
    found = output(radiance(of_cells, ViewPoint=(0, 0, 3), SampleLocation=1))
    close(array(found.GetPointData(), "Radiance"), [2 / math.pi] * 16)
    alone = output(radiance(square(3), light, ViewPoint=(0, 0, 3), SampleLocation=1))
    close(array(alone.GetPointData(), "Radiance"),
          0.5 / math.pi * array(at_points.GetPointData(), "Irradiance"))


def test_bands_of_the_results():
    """Three bands of Irradiance in a scene whose materials have one."""
    data = square(1)
    values = numpy_to_vtk(np.array([[1.0, 2.0, 3.0]]), deep=True)
    values.SetName("Irradiance")
    data.GetCellData().AddArray(values)
    cells = output(radiance(data, ViewPoint=(0, 0, 3))).GetCellData()
    close(array(cells, "Radiance"), [[0.5 / math.pi, 1 / math.pi, 1.5 / math.pi]])


def test_default_eye_and_cameras():
    f = simulation(vtkRadianceFilter, add(square(1), "Radiosity", [1.0]))
    field = output(f).GetFieldData()
    distance = math.sqrt(2) / math.sin(math.radians(15))
    close(array(field, "ViewPoint"), [[0, 0, distance]], relative=1e-12, absolute=1e-12)
    assert "none was given" in array(field, "RadiometryMethod")[0]
    f.SetCameraPosition(0, 4, 3)
    f.SetCameraFocalPoint(0, 0, 0)
    field = output(f).GetFieldData()
    close(array(field, "ViewPoint"), [[0, 4, 3]])
    close(array(field, "ViewAxis"), [[0, -0.8, -0.6]])
    camera = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    points.InsertNextPoint(1, 2, 3)
    camera.SetPoints(points)
    camera.GetPointData().AddArray(named([[0, 0, -2.0]], "Direction"))
    f.SetCameraData(camera)
    field = output(f).GetFieldData()
    close(array(field, "ViewPoint"), [[1, 2, 3]])
    close(array(field, "ViewAxis"), [[0, 0, -1]])
    f.SetViewPoint(0, 0, 0)  # set, though all zero
    close(array(output(f).GetFieldData(), "ViewPoint"), [[0, 0, 0]])
    f = simulation(vtkRadianceFilter, add(square(1), "Radiosity", [1.0]), ViewFrom=3)
    fails(f, "Camera")


def test_units_of_length():
    small = output(radiance(add(square(2, 2000.0), "Radiosity", [1.0] * 4), ViewPoint=(0, 0, 3000),
                            MetersPerUnit=0.001)).GetCellData()
    same = output(radiance(add(square(2, 2.0), "Radiosity", [1.0] * 4), ViewPoint=(0, 0, 3)))
    close(array(small, "SolidAngle"), array(same.GetCellData(), "SolidAngle"))


def test_blocks_and_strange_cells():
    whole = vtk.vtkMultiBlockDataSet()
    whole.SetBlock(0, add(square(1), "Radiosity", [1.0]))
    whole.SetBlock(2, add(square(2, 1.0, (0, 0, 1.0)), "Radiosity", [2.0] * 4))
    out = output(radiance(whole, ViewPoint=(0, 0, 3)))
    close(array(out.GetBlock(2).GetCellData(), "Radiance"), [2 / math.pi] * 4)
    whole.SetBlock(2, square(2))
    fails(radiance(whole, ViewPoint=(0, 0, 3)), "block 1, Radiosity", "missing")
    # A line, a vertex and a triangle without area beside a triangle.
    mesh = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    for p in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (2, 0, 0)):
        points.InsertNextPoint(p)
    mesh.SetPoints(points)
    for setter, cells in ((mesh.SetVerts, [[0]]), (mesh.SetLines, [[0, 1]]),
                          (mesh.SetPolys, [[0, 1, 2], [0, 1, 3]])):
        made = vtk.vtkCellArray()
        for ids in cells:
            made.InsertNextCell(len(ids), ids)
        setter(made)
    add(mesh, "Radiosity", [1.0] * 4)
    cells = output(radiance(mesh, ViewPoint=(0.2, 0.2, 3))).GetCellData()
    close(array(cells, "Radiance"), [0, 0, 1 / math.pi, 0])
    assert (array(cells, "SolidAngle") > 0).tolist() == [False, False, True, False]
    empty = output(radiance(vtk.vtkPolyData()))
    assert empty.GetNumberOfCells() == 0


def test_bad_input():
    nan = float("nan")
    data = add(square(1), "Radiosity", [1.0])
    fails(radiance(data, ViewPoint=(0, nan, 0)), "ViewPoint")
    fails(radiance(data, ViewDirection=(0, 0, 0)), "ViewDirection")
    fails(radiance(data, ViewPoint=(0, 0, 3), FNumber=-1.0), "FNumber")
    fails(radiance(data, ViewPoint=(0, 0, 3), FNumber=nan), "FNumber")
    fails(radiance(data, ViewPoint=(0, 0, 3), ViewAxis=(nan, 0, 1)), "ViewAxis")
    fails(radiance(data, ViewPoint=(0, 0, 3), ReceiverNormal=(nan, 0, 1)), "ReceiverNormal")
    fails(radiance(add(square(2), "Radiosity", [1, nan, 1, 1]), ViewPoint=(0, 0, 3)),
          "Radiosity", "1", "nan")
    fails(radiance(add(square(2), "Irradiance", [1, 1, -2, 1]), ViewPoint=(0, 0, 3)),
          "Irradiance", "2", "-2")


def test_after_radiosity_in_a_room():
    """A closed white room: surroundings in a glossy floor, all values finite and errors stated."""
    material = vtkSurfaceMaterialFilter()
    material.SetInputData(box(True, 3.0))
    material.Update()
    room = vtk.vtkPolyData()
    room.ShallowCopy(material.GetOutput())
    add(room, "DiffuseReflectance", [0.5] * 6)
    add(room, "SpecularReflectance", [0.0, 0.0, 0.0, 0.0, 0.3, 0.0])
    add(room, "Shininess", [20.0] * 6)
    light = lamp((0.2, 0.1, 0.5), 10.0)
    radiosity = simulation(vtkRadiosityFilter, room, light, RelativeTolerance=0.05)
    f = radiance(output(radiosity), light, ViewPoint=(0.5, -0.5, 0.2), RelativeTolerance=0.02)
    cells = output(f).GetCellData()
    value = array(cells, "Radiance")
    diffuse = array(cells, "Radiosity") / math.pi
    assert np.isfinite(value).all() and np.isfinite(array(cells, "RadianceError")).all()
    close(np.delete(value, 4, axis=0), np.delete(diffuse, 4, axis=0))
    assert (value[4] > diffuse[4] * 1.05).all(), (value[4], diffuse[4])
    assert output(f, 2).GetNumberOfRows() >= 1


def test_predicts_its_time():
    plane = vtk.vtkPlaneSource()
    plane.SetResolution(40, 40)
    plane.Update()
    floor = add(plane.GetOutput(), "SpecularReflectance", [0.3] * 1600)
    f = radiance(floor, lamp((0.1, 0.2, 1.0), 3.0), ViewPoint=(2, 0, 1), RelativeTolerance=0.003,
                 NumberOfThreads=1)
    before = f.PredictSeconds()
    assert before > 0.0
    assert f.GetOutputDataObject(0).GetNumberOfCells() == 0  # a pilot has no results
    first = output(f)
    cost = array(first.GetFieldData(), "RadiometryCost")[0]
    assert cost[2] <= cost[0] and cost[2] < cost[1], cost  # said before all was spent
    assert 0.2 < f.GetPredictedSeconds() / cost[0] < 5.0, cost  # a loaded machine; 2 when quiet
    assert f.GetElapsedSeconds() >= cost[0]
    again = radiance(floor, lamp((0.1, 0.2, 1.0), 3.0), ViewPoint=(2, 0, 1),
                     RelativeTolerance=0.003, NumberOfThreads=2)
    assert np.array_equal(array(output(again).GetCellData(), "Radiance"),
                          array(first.GetCellData(), "Radiance"))


if __name__ == "__main__":
    run_all(globals())
