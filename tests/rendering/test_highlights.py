# SPDX-License-Identifier: BSD-3-Clause
"""Highlights on computed fields; shadows that the simulation knows; lights that move with things."""
import math

import numpy as np

from drawing import Errors, Window, add, lights, polydata, run, square
from vtkmodules.vtkCommonCore import VTK_DOUBLE
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkradiometry import vtkIrradianceFilter, vtkRadiosityFilter

SUN = {"LightType": 2, "Direction": (0, 0, -1), "Intensity": (2.0, 2.0, 2.0)}


def shown(surface, *records, **properties):
    w = Window()
    w.mapper.SetInputDataObject(surface)
    w.mapper.SetLightData(lights(*records))
    for name, value in properties.items():
        getattr(w.mapper, "Set" + name)(value)
    return w


def field_square():
    surface = square()
    add(surface.GetCellData(), "Radiosity", [(3.0, 2.0, 1.0)])
    return surface


def test_field_without_specular_material_is_the_field_alone():
    w = shown(field_square(), SUN, FieldMode=1, FieldArrayName="Radiosity", FieldScale=0.5)
    assert w.at(0, 0).tolist() == [1.5, 1.0, 0.5]
    assert "Lights" not in w.mapper.GetShaderFeatures()
    assert "radiometryLights" not in w.mapper.GetFragmentShaderText()


def test_highlight_of_the_property_is_added():
    # Seen along the mirror direction of the sun: rho_s (n + 2)/(2 pi) E.
    w = shown(field_square(), SUN, FieldMode=1, FieldArrayName="Radiosity", FieldScale=0.5)
    w.actor.GetProperty().SetSpecular(0.25)
    w.actor.GetProperty().SetSpecularPower(30)
    highlight = 0.25 * 32 / (2 * math.pi) * 2.0
    np.testing.assert_allclose(w.at(0, 0), np.array([1.5, 1.0, 0.5]) + highlight, rtol=2e-6)
    text = w.mapper.GetFragmentShaderText()
    assert "sums.specular" in text and "color += diffuseColor" not in text
    w.mapper.HighlightsOff()
    assert w.at(0, 0).tolist() == [1.5, 1.0, 0.5]
    w.mapper.HighlightsOn()
    w.mapper.SetReflectionModelToBlinnPhong()
    np.testing.assert_allclose(w.at(0, 0), np.array([1.5, 1.0, 0.5]) + 0.5, rtol=2e-6)


def test_highlight_of_the_surface_arrays_goes_before_the_property():
    surface = field_square()
    add(surface.GetCellData(), "SpecularReflectance", [(0.1, 0.2, 0.3)])
    add(surface.GetFieldData(), "Shininess", [50.0])
    w = shown(surface, SUN, FieldMode=1, FieldArrayName="Radiosity")
    w.actor.GetProperty().SetSpecular(1.0)
    highlight = np.array([0.1, 0.2, 0.3]) * 52 / (2 * math.pi) * 2.0
    np.testing.assert_allclose(w.at(0, 0), np.array([3.0, 2.0, 1.0]) + highlight, rtol=2e-6)
    w.mapper.SetShading(0)
    np.testing.assert_allclose(w.at(0, 0), np.array([3.0, 2.0, 1.0]) + highlight, rtol=2e-6)


def test_fields_without_normals_have_highlights_of_their_faces():
    surface = polydata([(-0.8, -0.8, 0), (0.8, -0.8, 0), (0, 0.8, 0)], [(0, 1, 2)])
    add(surface.GetPointData(), "Radiosity", [2.0] * 3)
    w = shown(surface, SUN, FieldMode=1, FieldArrayName="Radiosity")
    w.actor.GetProperty().SetSpecular(0.5)
    w.actor.GetProperty().SetSpecularPower(10)
    np.testing.assert_allclose(w.at(0, 0), 2.0 + 0.5 * 12 / (2 * math.pi) * 2.0, rtol=2e-6)


def floor(n=8):
    source = vtkPlaneSource()
    source.SetOrigin(-0.8, -0.8, 0)
    source.SetPoint1(0.8, -0.8, 0)
    source.SetPoint2(-0.8, 0.8, 0)
    source.SetResolution(n, n)
    source.SetOutputPointsPrecision(VTK_DOUBLE)
    return source


def simulated(kind, data, samples=0):
    """Under a lid over x < 0.1, out of the picture's sight, at z = 0.5; the edge is inside a cell."""
    lid = vtkPlaneSource()
    lid.SetOrigin(-9, -9, 0.5)
    lid.SetPoint1(0.1, -9, 0.5)
    lid.SetPoint2(-9, 9, 0.5)
    lid.SetOutputPointsPrecision(VTK_DOUBLE)
    source = floor()
    f = kind()
    f.SetInputConnection(source.GetOutputPort())
    f.AddLightsData(data)
    f.AddOccludersConnection(lid.GetOutputPort())
    f.SetLightVisibility(True)
    f.SetSampleLocation(samples)
    f.Update()
    return f.GetOutputDataObject(0)


def test_shadows_of_the_simulation_are_in_the_picture():
    off = {"LightType": 2, "Direction": (0, 0.1, -1), "LightEnabled": 0}
    lamp = {"Position": (0.0, 0.0, 0.4), "Intensity": (0.5, 0.5, 0.5)}
    data = lights(off, SUN, lamp)
    for kind in (vtkIrradianceFilter, vtkRadiosityFilter):
        surface = simulated(kind, data)
        w = Window()
        w.mapper.SetInputDataObject(surface)
        w.mapper.SetLightData(data)
        w.mapper.SetScalarVisibility(False)
        w.mapper.UseLightVisibilityOff()
        open_sky = w.draw()
        assert "Visibility" not in w.mapper.GetShaderFeatures()
        w.mapper.UseLightVisibilityOn()
        picture = w.draw()
        sun = 2.0 / math.pi
        lost = (open_sky - picture)[:, :, 0]

        def at(x):
            return lost[int((0.05 + 1) / 2 * w.size), int((x + 1) / 2 * w.size)]

        np.testing.assert_allclose(at(-0.5), sun, rtol=1e-5)  # the lamp still shines
        np.testing.assert_allclose(at(0.1), 0.5 * sun, rtol=1e-5)  # half of the cell [0, 0.2]
        assert at(0.5) == 0.0


def test_shares_of_points_are_interpolated():
    data = lights(SUN)
    surface = simulated(vtkIrradianceFilter, data, samples=1)
    w = Window(size=160)
    w.mapper.SetInputDataObject(surface)
    w.mapper.SetLightData(data)
    w.mapper.SetScalarVisibility(False)
    sun = 2.0 / math.pi
    row = w.draw()[80 + 4, :, 0]
    x = (np.arange(160) + 0.5) / 80 - 1
    inside = np.abs(x) < 0.79
    expected = sun * np.clip(x / 0.2, 0, 1)  # hidden at x = 0, lit at 0.2
    np.testing.assert_allclose(row[inside], expected[inside], atol=1e-5)
    assert "VisibilityOfPoints" in w.mapper.GetShaderFeatures()


def test_highlights_on_a_field_have_the_shadows():
    data = lights(SUN)
    surface = simulated(vtkIrradianceFilter, data)
    w = Window()
    w.mapper.SetInputDataObject(surface)
    w.mapper.SetLightData(data)
    w.mapper.SetFieldModeToOn()
    w.mapper.SetFieldArrayName("Irradiance")
    w.mapper.SetFieldScale(0.5 / math.pi)
    w.actor.GetProperty().SetSpecular(0.3)
    w.actor.GetProperty().SetSpecularPower(20)
    highlight = 0.3 * 22 / (2 * math.pi) * 2.0
    picture = w.draw()
    assert w.at(-0.5, 0.05, picture).tolist() == [0, 0, 0]
    np.testing.assert_allclose(w.at(0.5, 0.05, picture), 1.0 / math.pi + highlight, rtol=1e-5)


def test_a_light_that_moved_casts_no_shadow_that_is_not_its_own():
    data = lights(SUN)
    surface = simulated(vtkIrradianceFilter, data)
    w = Window()
    w.mapper.SetInputDataObject(surface)
    w.mapper.SetScalarVisibility(False)
    w.mapper.SetLightData(data)
    assert w.at(-0.5, 0.05)[0] == 0.0
    moved = lights({**SUN, "Direction": (0.1, 0, -1)})
    w.mapper.SetLightData(moved)
    np.testing.assert_allclose(w.at(-0.5, 0.05)[0], 2 / math.pi / math.sqrt(1.01), rtol=1e-5)
    other = lights({"Position": (0, 0, 3)}, SUN)  # in another place of the list
    w.mapper.SetLightData(other)
    without = w.at(-0.5, 0.05)[0]
    w.mapper.SetLightData(lights({"Position": (0, 0, 3)}))
    assert without == w.at(-0.5, 0.05)[0] > 0.0


def test_blocks_that_know_other_lights():
    data = lights(SUN)
    first = simulated(vtkIrradianceFilter, data)
    tree = vtkMultiBlockDataSet()
    tree.SetBlock(0, first)
    plain = polydata([(-0.8, 0.82, 0), (0.8, 0.82, 0), (0.8, 0.99, 0), (-0.8, 0.99, 0)],
                     [(0, 1, 2, 3)], [(0, 0, 1)] * 4)
    tree.SetBlock(1, plain)  # knows nothing
    w = Window()
    w.mapper.SetInputDataObject(tree)
    w.mapper.SetLightData(data)
    w.mapper.SetScalarVisibility(False)
    picture = w.draw()
    assert w.at(-0.5, 0.05, picture)[0] == 0.0
    np.testing.assert_allclose(w.at(-0.5, 0.9, picture)[0], 2 / math.pi, rtol=1e-5)


def test_too_many_lights_for_points_are_told():
    data = lights(*[{**SUN, "Direction": (0.01 * i, 0, -1)} for i in range(18)])
    surface = simulated(vtkIrradianceFilter, data, samples=1)
    w = Window()
    errors = Errors(w.mapper)
    w.mapper.SetInputDataObject(surface)
    w.mapper.SetLightData(data)
    w.draw()
    assert any("16 of 18 lights" in t for t in errors.texts), errors.texts


def test_attached_lights_follow_their_frames():
    """The same picture as of lights put there by hand, at every step, without a new shader."""
    surface = square(half=0.5)
    spot = {"LightType": 1, "Position": (0.3, 0.1, 0.6), "Direction": (-0.4, 0, -1),
            "Intensity": (3, 2, 1), "SpotCutoff": 40.0, "SpotExponent": 2.0}
    for frame in (0, 1, 2):
        w = shown(surface, {**spot, "AttachedTo": frame})
        by_hand = shown(surface, spot)
        for each in (w, by_hand):
            each.actor.GetProperty().SetSpecular(0.4)
        builds = None
        pictures = []
        for step in range(4):
            angle = 15.0 * step
            for each in (w, by_hand):
                each.actor.SetOrientation(0, 0, angle)
                each.actor.SetPosition(0.05 * step, 0, -0.1 * step)
                camera = each.renderer.GetActiveCamera()
                camera.SetPosition(0.4 * step, 0, 5)
                camera.SetFocalPoint(0.1 * step, 0, 0)
            matrix = None
            if frame == 1:
                matrix = w.actor.GetMatrix()
            elif frame == 2:
                matrix = w.renderer.GetActiveCamera().GetModelViewTransformMatrix()
                matrix = type(matrix)()
                matrix.DeepCopy(w.renderer.GetActiveCamera().GetModelViewTransformMatrix())
                matrix.Invert()
            where, toward = spot["Position"], spot["Direction"]
            if frame == 2:
                # Given in eye coordinates, near the surface: 5 in front of the eye.
                eye = (spot["Position"][0], spot["Position"][1], spot["Position"][2] - 5)
                w.mapper.GetLightData().DeepCopy(
                    lights({**spot, "Position": eye, "AttachedTo": 2}))
                where = eye
            if matrix:
                where = matrix.MultiplyPoint((*where, 1))[:3]
                toward = matrix.MultiplyPoint((*toward, 0))[:3]
            by_hand.mapper.SetLightData(lights({**spot, "Position": where, "Direction": toward}))
            picture = w.draw()
            assert picture[:, :, :3].max() > 0.5
            np.testing.assert_allclose(picture, by_hand.draw(), rtol=2e-5, atol=2e-6)
            pictures.append(picture)
            builds = builds or w.mapper.GetNumberOfShaderBuilds()
            assert w.mapper.GetNumberOfShaderBuilds() == builds
        assert np.abs(pictures[0] - pictures[-1]).max() > 0.1


if __name__ == "__main__":
    run(globals())
