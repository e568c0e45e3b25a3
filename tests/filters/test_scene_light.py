# SPDX-License-Identifier: BSD-3-Clause
"""From a file or a source to irradiance: units and cones arrive in the simulation as they were
meant."""
import math

import numpy as np
from checks import array, close, run_all, shared
from test_statistics import surface
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkradiometry import (vtkIrradianceFilter, vtkPointLightSource, vtkRadiometricSceneReader,
                           vtkRadiometricStatistics, vtkSpotLightSource, vtkDirectionalLightSource)

K = 683.002


def irradiance(data, *lights, **options):
    direct = vtkIrradianceFilter()
    direct.SetInputData(data)
    for light in lights:
        if hasattr(light, "GetOutputPort"):
            direct.AddLightsConnection(light.GetOutputPort())
        else:
            direct.AddLightsData(light)
    for name, value in options.items():
        getattr(direct, "Set" + name)(value)
    direct.Update()
    return direct.GetOutputDataObject(0)


def small_square(size=1e-4, height=0.0):
    h = size / 2
    return surface([[-h, -h, height], [h, -h, height], [h, h, height], [-h, h, height]],
                   [[0, 1, 2, 3]])


def illuminance(light):
    """lx on a tiny square at the origin, facing up."""
    return K * array(irradiance(small_square(), light).GetCellData(), "Irradiance").reshape(-1)[0]


def test_100_lumen_at_1_metre():
    point = vtkPointLightSource()
    point.SetPosition(0, 0, 1)
    point.SetIntensity(100)
    point.SetIntensityUnitToLumen()
    close(illuminance(point), 7.957747154594767, relative=1e-8)
    lambertian = vtkSpotLightSource()
    lambertian.SetPosition(0, 0, 1)
    lambertian.SetIntensity(100)
    lambertian.SetIntensityUnitToLumen()
    lambertian.SetCutoff(90)
    lambertian.SetExponent(1)
    close(illuminance(lambertian), 31.830988618379067, relative=1e-8)
    sun = vtkDirectionalLightSource()
    sun.SetIntensity(50000)
    sun.SetIntensityUnitToLux()
    sun.SetDirection(0, 0.6, -0.8)
    close(illuminance(sun), 40000, relative=1e-12)


def test_flux_of_a_spot_arrives():
    """All lumens of a spot fall on a plane that catches its cone."""
    plane = vtkPlaneSource()
    plane.SetOrigin(-4, -4, 0)
    plane.SetPoint1(4, -4, 0)
    plane.SetPoint2(-4, 4, 0)
    plane.SetResolution(9, 9)
    plane.Update()
    for cutoff, inner, exponent in ((30, -1, 0), (30, -1, 3), (35, 20, 0), (35, 30, 2)):
        spot = vtkSpotLightSource()
        spot.SetPosition(0.3, 0.2, 2)
        spot.SetIntensity(1000)
        spot.SetIntensityUnitToLumen()
        spot.SetCutoff(cutoff)
        spot.SetInnerCutoff(inner)
        spot.SetExponent(exponent)
        lit = irradiance(plane.GetOutput(), spot, RelativeTolerance=1e-3)
        statistics = vtkRadiometricStatistics()
        statistics.SetInputDataObject(lit)
        statistics.SetArrayName("Irradiance")
        statistics.Update()
        flux = statistics.GetOutput().GetValueByName(0, "Flux").ToDouble()
        # The tolerance of the simulation, cell by cell.
        close(K * flux, 1000, relative=1e-3)


def test_light_visibility():
    """A real export: three spots of 5, 5 and 6 cd before a wall, against glTF's formula."""
    path = shared("gltf/LightVisibility_reduced.gltf")
    if path is None:
        return
    reader = vtkRadiometricSceneReader()
    reader.SetFileName(path)
    reader.Update()
    fine = vtkLinearSubdivisionFilter()
    fine.SetInputData(reader.GetOutput(0))
    fine.SetNumberOfSubdivisions(5)
    fine.Update()
    wall = fine.GetOutput()
    lit = irradiance(wall, reader.GetOutput(1), RelativeTolerance=1e-4)
    found = array(lit.GetCellData(), "Irradiance")
    corners = vtk_to_numpy(wall.GetPoints().GetData()).astype(float)[
        vtk_to_numpy(wall.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    # Average of glTF's formula over each triangle by a 7-point rule of degree 5.
    a, b = (6 - math.sqrt(15)) / 21, (6 + math.sqrt(15)) / 21
    rule = [((1 / 3,) * 3, 9 / 40)]
    for s, weight in ((a, (155 - math.sqrt(15)) / 1200), (b, (155 + math.sqrt(15)) / 1200)):
        rule += [((1 - 2 * s, s, s), weight), ((s, 1 - 2 * s, s), weight), ((s, s, 1 - 2 * s), weight)]
    expected = np.zeros_like(found)
    inside = np.ones(len(found), bool)
    lights = reader.GetOutput(1)
    for i in range(3):
        position = np.array(lights.GetPoint(i))
        intensity = array(lights.GetPointData(), "Intensity")[i]
        for weights, w in rule:
            to = np.einsum("k,ikj->ij", weights, corners) - position
            r = np.linalg.norm(to, axis=1)
            cosine = -to[:, 2] / r
            edge = np.clip((cosine - math.cos(0.8)) / (math.cos(0.65) - math.cos(0.8)), 0, 1) ** 2
            expected += w * np.outer(edge * cosine / r**2, intensity)
        # The formula has kinks where the edge begins and ends: leave out the cells they cross.
        to = corners - position
        angle = np.arccos(-to[..., 2] / np.linalg.norm(to, axis=2))
        for kink in (0.65, 0.8):
            inside &= (angle.min(axis=1) > kink + 1e-3) | (angle.max(axis=1) < kink - 1e-3)
    assert inside.mean() > 0.5 and expected[inside].max() > 1e-3
    close(found[inside], expected[inside], relative=2e-4, absolute=1e-9)


if __name__ == "__main__":
    run_all(globals())
