# SPDX-License-Identifier: BSD-3-Clause
"""Dose: irradiance times exposure time, with its error and its photometric counterpart."""
import numpy as np
import vtkmodules.all as vtk
from checks import array, close, fails, run_all, simulation, sun
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkradiometry import vtkIrradianceFilter, vtkPointLightSource, vtkRadiosityFilter


def plane(resolution=3):
    source = vtk.vtkPlaneSource()
    source.SetResolution(resolution, resolution)
    source.Update()
    return source.GetOutput()


def output(f):
    f.Update()
    return f.GetOutputDataObject(0)


def test_sun_for_an_hour():
    """1000 W/m^2 at 60 degrees for an hour: 1.8 MJ/m^2, and in lx s by the efficacy."""
    slanting = sun((0.8660254037844386, 0, -0.5), 1000.0)
    f = simulation(vtkIrradianceFilter, plane(), slanting, ExposureTime=3600.0, Photometric=True,
                   LuminousEfficacy=100.0)
    cells = output(f).GetCellData()
    close(array(cells, "Dose"), [1.8e6] * 9, relative=1e-9)
    close(array(cells, "LuminousExposure"), [1.8e8] * 9, relative=1e-9)
    units = array(f.GetOutputDataObject(0).GetFieldData(), "RadiometryUnits")
    assert "Dose [J/m^2]" in units and "LuminousExposure [lx s]" in units, units
    options = array(f.GetOutputDataObject(0).GetFieldData(), "RadiometryOptions")
    assert "ExposureTime=3600" in options[0], options


def test_dose_keeps_the_irradiance_and_its_error():
    """Under a blocker there is an error: it scales with the time as the value does."""
    lamp = vtkPointLightSource()
    lamp.SetPosition(0.1, 0.2, 1.0)
    balls = vtk.vtkAppendPolyData()
    for k in range(6):
        ball = vtk.vtkSphereSource()
        ball.SetRadius(0.05)
        ball.SetCenter(-0.4 + 0.15 * k, 0.1 * (k % 3) - 0.1, 0.3)
        balls.AddInputConnection(ball.GetOutputPort())
    balls.Update()
    values = []
    for seconds in (0.0, 7.0):
        f = simulation(vtkIrradianceFilter, plane(2), lamp, ExposureTime=seconds,
                       RelativeTolerance=0.05, TwoSided=True)
        f.AddOccludersData(balls.GetOutput())
        values.append(output(f).GetCellData())
    assert not values[0].HasArray("Dose")
    for name in ("", "Back", "Error", "BackError"):
        close(array(values[1], "Irradiance" + name), array(values[0], "Irradiance" + name))
        close(array(values[1], "Dose" + name), 7.0 * array(values[0], "Irradiance" + name))
    assert array(values[1], "DoseError").max() > 0.0


def test_points_sensors_and_radiosity():
    down = sun((0, 0, -1), 2.0)
    f = simulation(vtkIrradianceFilter, plane(), down, ExposureTime=5.0, SampleLocation=1)
    close(array(output(f).GetPointData(), "Dose"), [10.0] * 16)
    sensors = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    points.InsertNextPoint(0, 0, 0)
    sensors.SetPoints(points)
    normals = numpy_to_vtk(np.array([[0.0, 0.0, 1.0]]), deep=True)
    normals.SetName("Normals")
    sensors.GetPointData().AddArray(normals)
    verts = vtk.vtkCellArray()
    verts.InsertNextCell(1, [0])
    sensors.SetVerts(verts)
    f = simulation(vtkIrradianceFilter, sensors, down, ExposureTime=5.0)
    close(array(output(f).GetPointData(), "Dose"), [10.0])
    f = simulation(vtkRadiosityFilter, plane(), down, ExposureTime=5.0)
    close(array(output(f).GetCellData(), "Dose"), [10.0] * 9, relative=1e-6)


def test_bad_times():
    for bad in (-1.0, float("nan"), float("inf")):
        f = simulation(vtkIrradianceFilter, plane(), sun((0, 0, -1), 1.0), ExposureTime=bad)
        fails(f, "ExposureTime")


if __name__ == "__main__":
    run_all(globals())
