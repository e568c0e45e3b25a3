# SPDX-License-Identifier: BSD-3-Clause
"""vtkLinearFloatPass: nothing is clamped, background, depth, samples, translucency, the display
transform around it."""
import math

import numpy as np

from drawing import Window, add, lights, polydata, run, square
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkActor, vtkTextActor, vtkWindowToImageFilter
import vtkmodules.vtkRenderingFreeType  # noqa: F401
from vtkradiometry.vtkRadiometryRendering import vtkOpenColorIOPass, vtkPhongGouraudMapper


def field(value, z=0.0, half=0.8):
    surface = square(z, half)
    add(surface.GetCellData(), "F", [value])
    mapper = vtkPhongGouraudMapper()
    mapper.SetInputDataObject(surface)
    mapper.SetFieldModeToOn()
    mapper.SetFieldArrayName("F")
    return mapper


def shown(window):
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.ShouldRerenderOff()
    grab.Update()
    image = grab.GetOutput()
    x, y, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(y, x, -1)


def test_values_above_one_and_below_zero_survive():
    for value in (4.5, 1e6, -2.0, 1e-30):
        w = Window(mapper=field(value))
        assert w.at(0, 0)[0] == np.float32(value)


def test_background():
    w = Window(mapper=field(2.0))
    w.renderer.SetBackground(0.2, 0.4, 0.6)
    w.renderer.SetBackgroundAlpha(0.5)
    w.renderer.GradientBackgroundOn()
    assert w.draw()[0, 0].tolist() == [0, 0, 0, 0]
    # The renderer keeps its own.
    assert w.renderer.GetBackground() == (0.2, 0.4, 0.6)
    assert w.renderer.GetBackgroundAlpha() == 0.5
    assert w.renderer.GetGradientBackground()
    w.renderer.GradientBackgroundOff()
    w.target.KeepBackgroundOn()
    assert np.allclose(w.draw()[0, 0], [0.2, 0.4, 0.6, 0.5])


def test_depth_in_both_projections():
    for parallel in (True, False):
        w = Window(mapper=field(1.0, z=0.5))
        camera = w.renderer.GetActiveCamera()
        camera.SetParallelProjection(parallel)
        w.draw()
        depth = vtk_to_numpy(w.target.GetDepth().GetPointData().GetScalars())
        depth = depth.reshape(w.size, w.size)
        assert np.allclose(depth[30, 30], 4.5, rtol=1e-6), depth[30, 30]
        assert depth[0, 0] == np.float32(1e10)
        w.target.SetBackgroundDepth(7.0)
        assert vtk_to_numpy(w.target.GetDepth().GetPointData().GetScalars())[0] == 7.0


def test_samples_are_averaged_in_linear_light():
    # An edge through the middle of a pixel column: half of 8 and half of nothing.
    size = 60
    step = 2.0 / size
    edge = (30 + 0.5) * step - 1.0
    surface = polydata([(-1, -1, 0), (edge, -1, 0), (edge, 1, 0), (-1, 1, 0)], [(0, 1, 2, 3)])
    add(surface.GetCellData(), "F", [8.0])
    w = Window(size=size)
    w.mapper.SetInputDataObject(surface)
    w.mapper.SetFieldModeToOn()
    w.mapper.SetFieldArrayName("F")
    w.target.SetSamples(4)
    picture = w.draw()
    assert picture[20, 29].tolist() == [8, 8, 8, 1]
    assert picture[20, 30].tolist() == [4, 4, 4, 0.5]
    assert picture[20, 31].tolist() == [0, 0, 0, 0]
    w.target.GetDepth()
    assert w.target.GetColor().GetDimensions() == (size, size, 1)
    w.target.SetSamples(1)
    assert w.draw()[20, 29].tolist() == [8, 8, 8, 1]


def test_the_window_can_change_size():
    w = Window(mapper=field(3.0))
    for size in (60, 91, 40):
        w.size = size
        w.window.SetSize(size, size)
        picture = w.draw()
        assert picture.shape == (size, size, 4)
        assert picture[size // 2, size // 2, 0] == 3.0


def test_translucency_is_not_clamped():
    w = Window(mapper=field(6.0, z=-0.5))
    front = vtkActor()
    front.SetMapper(field(3.0))
    front.GetProperty().SetOpacity(0.5)
    w.renderer.AddActor(front)
    assert w.at(0, 0).tolist() == [4.5] * 3


def test_two_renderers_in_one_window():
    w = Window(mapper=field(2.0))
    other = Window(mapper=field(5.0))
    other.window.RemoveRenderer(other.renderer)
    w.renderer.SetViewport(0, 0, 0.5, 1)
    other.renderer.SetViewport(0.5, 0, 1, 1)
    w.window.AddRenderer(other.renderer)
    w.window.SetSize(120, 60)
    w.window.Render()
    assert w.target.GetColor().GetDimensions() == (60, 60, 1)
    assert w.read()[30, 30, 0] == 2.0
    assert other.read()[30, 30, 0] == 5.0


def test_overlays_are_on_the_window_and_not_in_the_picture():
    w = Window(mapper=field(0.0))
    text = vtkTextActor()
    text.SetInput("lx")
    text.GetTextProperty().SetFontSize(30)
    text.SetPosition(5, 5)
    w.renderer.AddViewProp(text)
    picture = w.draw()
    assert picture[:, :, :3].max() == 0.0
    assert shown(w.window).max() > 200


def test_display_transform_around_it():
    w = Window(mapper=field(0.18))
    w.renderer.SetBackground(0.2, 0.4, 0.6)
    linear = w.draw()[30, 30, 0]
    display = vtkOpenColorIOPass()
    display.SetDelegatePass(w.target)
    display.SetView("Plain")
    w.renderer.SetPass(display)
    w.window.Render()
    pixels = shown(w.window)
    # sRGB's curve at 0.18: 1.055 x^(1/2.4) - 0.055 = 0.4614
    assert abs(int(pixels[30, 30, 0]) - 255 * (1.055 * 0.18 ** (1 / 2.4) - 0.055)) < 1.0
    assert pixels[0, 0].tolist()[:3] == [51, 102, 153]  # the background is left alone
    assert w.read()[30, 30, 0] == linear == np.float32(0.18)  # read before the transform
    assert w.read()[0, 0].tolist() == [0, 0, 0, 0]
    w.target.SetSamples(2)
    w.window.Render()
    assert abs(int(shown(w.window)[30, 30, 0]) - 118) <= 1


def test_normals_as_colours():
    w = Window()
    w.mapper.SetInputDataObject(square())
    w.mapper.SetFieldModeToNormals()
    w.actor.RotateX(30)
    expected = (0, -math.sin(math.pi / 6), math.cos(math.pi / 6))
    assert np.allclose(w.at(0, 0), expected, atol=1e-6)
    w.actor.RotateX(180)  # the back: toward the viewer when two-sided, as it is otherwise
    assert np.allclose(w.at(0, 0), expected, atol=1e-6)
    w.mapper.TwoSidedOff()
    assert np.allclose(w.at(0, 0), -np.array(expected), atol=1e-6)


def test_reading_before_the_first_frame():
    w = Window(mapper=field(1.0))
    assert w.target.GetColor() is None
    assert w.target.GetDepth() is None


def test_lit_values_above_one():
    w = Window()
    w.mapper.SetInputDataObject(square())
    w.mapper.SetLightData(lights({"LightType": 2, "Intensity": (100 * math.pi,) * 3}))
    for shading in ("Flat", "Gouraud", "Phong"):
        getattr(w.mapper, "SetShadingTo" + shading)()
        assert np.allclose(w.at(0, 0), 100, rtol=1e-6), shading


run(globals())
