# SPDX-License-Identifier: BSD-3-Clause
"""Where lights come from, what they are attached to, how many, and what is wrong with them."""
import math

import numpy as np

from drawing import Errors, Window, add, lights, polydata, run, square
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkMultiBlockDataSet
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkHardwareSelector,
    vtkLight,
    vtkPolyDataMapper,
)
from vtkradiometry import vtkAreaLightSource, vtkEnvironmentLightSource
from vtkradiometry.vtkRadiometryRendering import vtkPhongGouraudMapper


def lit(*records, **options):
    w = Window(**options)
    w.mapper.SetInputDataObject(square())
    w.mapper.SetLightData(lights(*records))
    return w


def test_point_light_in_physical_units():
    # E = I/h^2 below the light, L = E/pi for a white surface.
    w = lit({"Position": (0, 0, 2), "Intensity": (8, 4, 2)})
    x = 1.0 / w.size  # the centre of the pixel beside the middle
    h2 = 4 + 2 * x * x
    expected = np.array([8, 4, 2]) * 2 / h2 ** 1.5 / math.pi
    assert np.allclose(w.at(0, 0), expected, rtol=2e-6), (w.at(0, 0), expected)
    w.mapper.SetMetersPerUnit(0.5)  # the light is half as far
    assert np.allclose(w.at(0, 0), 4 * expected, rtol=2e-6)
    w.mapper.SetMetersPerUnit(1)
    w.mapper.SetLightScale(3)
    assert np.allclose(w.at(0, 0), 3 * expected, rtol=2e-6)
    w.mapper.SetLightScale(1)
    w.mapper.SetReflectionModelToBlinnPhong()  # legacy: no 1/pi
    assert np.allclose(w.at(0, 0), math.pi * expected, rtol=2e-6)


def test_luminaire_is_drawn_with_its_web():
    # A web of cos(gamma), straight below and at 14 degrees.
    def with_web(index):
        data = lights({"Position": (0, 0, 2), "Intensity": (8, 4, 2), "PhotometricWeb": index})
        gamma = np.linspace(0, 90, 181)
        for name, values in (("PhotometricWeb0", np.cos(np.radians(gamma)).clip(0)),
                             ("PhotometricWeb0Horizontal", [0.0]),
                             ("PhotometricWeb0Vertical", gamma)):
            array = numpy_to_vtk(np.array(values), deep=True)
            array.SetName(name)
            data.GetFieldData().AddArray(array)
        w = Window()
        w.mapper.SetInputDataObject(square())
        w.mapper.SetLightData(data)
        return w

    plain = lit({"Position": (0, 0, 2), "Intensity": (8, 4, 2)})
    with_cosine = with_web(0)
    for x in (1 / 60, 0.5 + 1 / 60):
        cosine = 2 / math.sqrt(4 + x * x + (1 / 60) ** 2)
        assert np.allclose(with_cosine.at(x, 0), cosine * plain.at(x, 0), rtol=1e-4), x
    assert "Luminaire" in with_cosine.mapper.GetShaderFeatures()
    assert np.allclose(with_web(-1).at(0, 0), plain.at(0, 0), rtol=1e-6)
    missing = with_web(3)
    errors = Errors(missing.mapper)
    assert (missing.at(0, 0) == 0).all()
    assert len(errors.texts) == 1 and "PhotometricWeb3" in errors.texts[0], errors.texts


def test_one_band_and_other_numbers_of_bands():
    for intensity, grey in ((6.0, 6.0), ((2.0, 4.0, 3.0, 3.0), 3.0)):
        w = lit({"LightType": 2, "Intensity": intensity})
        assert np.allclose(w.at(0, 0), [grey / math.pi] * 3, rtol=1e-6)


def test_lights_of_the_renderer_give_the_diffuse_of_vtk():
    """Physical and legacy models show what VTK's own mapper shows, to its 8 bits and beyond."""
    sphere = vtkSphereSource()
    sphere.SetRadius(0.9)
    sphere.SetThetaResolution(60)
    sphere.SetPhiResolution(60)
    pictures = []
    for mapper in (vtkPolyDataMapper(), vtkPhongGouraudMapper(), vtkPhongGouraudMapper()):
        w = Window(mapper=mapper)
        mapper.SetInputConnection(sphere.GetOutputPort())
        if len(pictures) == 2:
            mapper.SetReflectionModelToPhong()
        w.actor.GetProperty().SetColor(0.9, 0.5, 0.2)
        for kind in range(3):
            light = vtkLight()
            light.SetLightTypeToSceneLight()
            light.SetPosition(2 - kind, 1 + kind, 3)
            light.SetFocalPoint(0, 0, 0)
            light.SetColor(1, 0.5 * kind, 0.3)
            light.SetIntensity(0.7)
            light.SetPositional(kind > 0)
            light.SetConeAngle(60 if kind == 1 else 120)
            light.SetExponent(3)
            light.SetAttenuationValues(1, 0.1, 0.2)
            w.renderer.AddLight(light)
        w.target.AllSceneLinearOn()
        pictures.append(w.draw())
    assert pictures[0][:, :, :3].max() > 0.5
    for picture in pictures[1:]:
        assert np.allclose(picture, pictures[0], atol=2e-6), abs(picture - pictures[0]).max()


def test_lights_under_the_renderers_key():
    w = Window()
    w.mapper.SetInputDataObject(square())
    by_headlight = w.at(0, 0)
    tree = vtkMultiBlockDataSet()
    tree.SetBlock(0, lights({"LightType": 2, "Intensity": (math.pi, 0, 0)}))
    tree.SetBlock(1, lights({"LightType": 2, "Intensity": (0, 2 * math.pi, 0)}))
    info = w.renderer.GetInformation()
    if info is None:
        from vtkmodules.vtkCommonCore import vtkInformation
        info = vtkInformation()
        w.renderer.SetInformation(info)
    key = vtkPhongGouraudMapper.LIGHT_DATA()
    info.Set(key, tree)
    assert np.allclose(w.at(0, 0), (1, 2, 0), rtol=1e-6)
    w.mapper.SetLightData(lights({"LightType": 2, "Intensity": (0, 0, math.pi)}))
    assert np.allclose(w.at(0, 0), (0, 0, 1), rtol=1e-6)  # the mapper's own come first
    w.mapper.SetLightData(None)
    info.Remove(key)
    assert np.allclose(w.at(0, 0), by_headlight)


def test_attached_lights():
    # In the actor's coordinates: it goes where the actor goes.
    record = {"Position": (0, 0, 1), "Intensity": (1, 1, 1)}
    w = lit(dict(record, AttachedTo=1))
    still = w.draw()
    w.actor.SetPosition(0, 0, -3)
    assert np.allclose(w.draw(), still, rtol=1e-5)
    w = lit(dict(record, AttachedTo=0))
    w.actor.SetPosition(0, 0, -3)
    assert w.at(0, 0)[0] < 0.1 * still[30, 30, 0]
    # In the camera's: it goes where the camera goes.
    w = lit({"LightType": 2, "Direction": (0, 0, -1), "AttachedTo": 2})
    w.renderer.GetActiveCamera().Azimuth(180)  # from behind, two-sided
    assert np.allclose(w.at(0, 0), 1 / math.pi, rtol=1e-6)
    w = lit({"LightType": 2, "Direction": (0, 0, -1), "AttachedTo": 0})
    w.renderer.GetActiveCamera().Azimuth(180)
    assert w.at(0, 0)[0] == 0.0


def test_hundreds_of_lights():
    rng = np.random.default_rng(3)
    records, expected = [], np.zeros(3)
    w = Window()
    x = 1.0 / w.size
    for i in range(600):
        position = rng.uniform((-2, -2, 0.5), (2, 2, 4))
        intensity = rng.uniform(0, 1, 3)
        to_light = position - (x, x, 0)
        r = np.linalg.norm(to_light)
        kind = i % 3
        direction = -to_light / r
        if kind == 2:
            expected += intensity * -direction[2]
        else:
            expected += intensity * to_light[2] / r ** 3
        records.append({"LightType": kind, "Position": position, "Intensity": intensity,
                        "Direction": direction, "SpotCutoff": 40})
    w.mapper.SetInputDataObject(square())
    w.mapper.SetLightData(lights(*records))
    assert np.allclose(w.at(0, 0), expected / math.pi, rtol=1e-5)
    assert w.mapper.GetNumberOfLightsDrawn() == 600


def test_bad_lights_are_named_once_and_the_others_drawn():
    good = {"LightType": 2, "Intensity": (math.pi,) * 3}
    for name, value in (("Intensity", (float("nan"), 1, 1)), ("Direction", (0, 0, 0)),
                        ("SpotCutoff", 120), ("SpotExponent", -1), ("Attenuation", (0, 0, 0)),
                        ("Attenuation", (1, -1, 0)), ("LightType", 9)):
        bad = {"LightType": 1, "Position": (0, 0, 1), name: value}
        w = lit(good, bad)
        errors = Errors(w.mapper)
        assert np.allclose(w.at(0, 0), 1, rtol=1e-6), name
        assert len(errors.texts) == 1 and name in errors.texts[0], (name, errors.texts)
        assert "light 1" in errors.texts[0]
        w.draw()
        assert len(errors.texts) == 1
    w = lit(good, {"Position": (float("inf"), 0, 0)})
    errors = Errors(w.mapper)
    w.draw()
    assert len(errors.texts) == 1 and "Points" in errors.texts[0]


def test_area_light_above_a_floor():
    # F = 4/pi/sqrt(2) atan(1/sqrt(2)) below the middle of a square of side 2 one above.
    source = vtkAreaLightSource()
    source.SetPosition(1 / 60, 1 / 60, 1)  # above the middle of a pixel
    source.SetDirection(0, 0, -1)
    source.SetWidth(2)
    source.SetHeight(2)
    source.SetIntensity(5.0)
    source.Update()
    w = Window()
    w.mapper.SetInputDataObject(square())
    w.mapper.SetLightData(source.GetOutput())
    factor = 4 / math.pi / math.sqrt(2) * math.atan(1 / math.sqrt(2))
    assert np.allclose(w.at(1 / 60, 1 / 60), 5 * factor / math.pi, rtol=2e-5)
    assert w.mapper.GetNumberOfLightsDrawn() == 1
    assert w.mapper.GetNumberOfLightsNotDrawn() == 0
    source.SetDirection(0, 0, 1)  # seen from behind
    source.Update()
    assert (w.at(0, 0) == 0).all()


def test_environment_lights_a_floor():
    source = vtkEnvironmentLightSource()
    source.Update()
    radiance = source.GetOutput().GetPointData().GetArray("Intensity").GetComponent(0, 0)
    w = Window()
    w.mapper.SetInputDataObject(square())
    w.mapper.SetLightData(source.GetOutput())
    uniform = lights({"LightType": 4, "Intensity": (1.0, 2.0, 3.0)})
    first = w.at(0, 0)
    assert first[0] > 0 and radiance > 0
    w.mapper.SetLightData(uniform)
    assert np.allclose(w.at(0, 0), (1, 2, 3), rtol=1e-6)  # E = pi L, and so L of a white surface


def test_points_of_area_lights_without_a_polygon_are_counted():
    w = lit({"LightType": 2, "Intensity": (math.pi,) * 3}, {"LightType": 3})
    assert np.allclose(w.at(0, 0), 1, rtol=1e-6)
    assert w.mapper.GetNumberOfLightsDrawn() == 1
    assert w.mapper.GetNumberOfLightsNotDrawn() == 1


def test_degenerate_normals_reflect_nothing():
    for normal in ((0, 0, 0), (float("nan"), 0, 1), (float("inf"), 0, 0)):
        for shading in ("Gouraud", "Phong"):
            surface = polydata([(-1, -1, 0), (1, -1, 0), (0, 1, 0)], [(0, 1, 2)], [normal] * 3)
            w = Window()
            w.mapper.SetInputDataObject(surface)
            w.mapper.SetLightData(lights({"LightType": 2}))
            getattr(w.mapper, "SetShadingTo" + shading)()
            w.mapper.SetEmission(0.5, 0.5, 0.5)
            assert w.at(0, 0).tolist() == [0.5, 0.5, 0.5], (normal, shading)


def test_utm_coordinates():
    """Half a million metres from the origin the picture is the same."""
    origin = np.array([500000.25, 4000000.5, 120.125])
    pictures = []
    for shift in (np.zeros(3), origin):
        for shading in ("Flat", "Gouraud", "Phong"):
            points = [np.array(p) + shift
                      for p in ((-0.8, -0.7, 0), (0.7, -0.6, 0.3), (0.1, 0.8, -0.2))]
            surface = polydata(points, [(0, 1, 2)], [(0.1, 0.2, 0.97), (-0.1, 0, 0.99), (0, 0, 1)])
            w = Window()
            w.mapper.SetInputDataObject(surface)
            w.mapper.SetLightData(lights({"Position": shift + (0.5, 0.3, 1.0)}))
            getattr(w.mapper, "SetShadingTo" + shading)()
            camera = w.renderer.GetActiveCamera()
            camera.SetFocalPoint(shift)
            camera.SetPosition(shift + (0, 0, 5))
            pictures.append(w.draw())
    for near, far in zip(pictures[:3], pictures[3:]):
        inside = (near[:, :, 3] == 1) & (far[:, :, 3] == 1)
        assert inside.sum() > 500
        assert (near[:, :, 3] != far[:, :, 3]).sum() < 10
        # float32 view coordinates of points 5 m away; the light's own are double before that
        assert np.allclose(near[inside], far[inside], rtol=2e-5)


def test_edges_and_selection_are_left_to_vtk():
    for shading in ("Flat", "Gouraud", "Phong"):
        w = lit({"LightType": 2, "Intensity": (math.pi,) * 3})
        getattr(w.mapper, "SetShadingTo" + shading)()
        w.actor.GetProperty().EdgeVisibilityOn()
        w.actor.GetProperty().SetEdgeColor(0, 1, 0)
        picture = w.draw()
        assert np.allclose(w.at(0, 0, picture), (1, 1, 1), rtol=1e-6), shading
        edge = w.at(-0.8 + 0.5 / w.size, 0, picture)
        assert abs(edge[1] - 1) < 1e-6 and edge[0] < 0.6 and edge[2] == edge[0], (shading, edge)
    selector = vtkHardwareSelector()
    selector.SetRenderer(w.renderer)
    selector.SetArea(20, 20, 40, 40)
    selector.SetFieldAssociation(vtkDataObject.FIELD_ASSOCIATION_CELLS)
    w.renderer.SetPass(None)
    selection = selector.Select()
    assert selection.GetNumberOfNodes() == 1
    assert selection.GetNode(0).GetSelectionList().GetValue(0) == 0
    w.renderer.SetPass(w.target)
    selector.SetFieldAssociation(vtkDataObject.FIELD_ASSOCIATION_CELLS)
    assert selector.Select().GetNumberOfNodes() == 1  # through the float pass, too
    assert np.allclose(w.at(0, 0), (1, 1, 1), rtol=1e-6)


def test_shallow_copy_takes_the_settings_over():
    w = lit({"LightType": 2, "Intensity": (math.pi,) * 3})
    w.mapper.SetShadingToFlat()
    w.mapper.SetReflectionModelToBlinnPhong()
    w.mapper.SetEmission(1, 2, 3)
    w.mapper.SetLightScale(0.5)
    copy = vtkPhongGouraudMapper()
    copy.ShallowCopy(w.mapper)
    before = w.draw()
    w.actor.SetMapper(copy)
    assert np.array_equal(w.draw(), before)
    assert copy.GetShading() == 0 and copy.GetReflectionModel() == 0


def test_scalar_colours_are_the_material():
    surface = square()
    add(surface.GetPointData(), "c", np.array([(255, 51, 0)] * 4), dtype=np.uint8)
    surface.GetPointData().SetActiveScalars("c")
    for shading in ("Flat", "Gouraud", "Phong"):
        w = Window()
        w.mapper.SetInputDataObject(surface)
        w.mapper.SetLightData(lights({"LightType": 2, "Intensity": (2 * math.pi,) * 3}))
        getattr(w.mapper, "SetShadingTo" + shading)()
        assert np.allclose(w.at(0, 0), (2, 0.4, 0), rtol=1e-6), shading


run(globals())
