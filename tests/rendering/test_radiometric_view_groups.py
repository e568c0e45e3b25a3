# SPDX-License-Identifier: BSD-3-Clause
"""vtkLinearFloatPass and vtkOpenColorIOPass among other props: light is converted, everything else
keeps its bytes, and the nearest is seen whichever group it belongs to."""
import numpy as np

from drawing import Errors, Window, add, polydata, run, square
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkOutputWindow
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkHardwareSelector,
    vtkPolyDataMapper,
    vtkWindowToImageFilter,
)
import vtkmodules.vtkRenderingFreeType  # noqa: F401
from vtkradiometry.vtkRadiometryRendering import vtkOpenColorIOPass, vtkPhongGouraudMapper

SIZE = 60


def srgb(x):
    return 12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055


def light(value, z=0.0, half=0.8, opacity=1.0):
    """A square of one radiance."""
    surface = square(z, half)
    add(surface.GetCellData(), "F", [value])
    mapper = vtkPhongGouraudMapper()
    mapper.SetInputDataObject(surface)
    mapper.SetFieldModeToOn()
    mapper.SetFieldArrayName("F")
    return actor(mapper, opacity)


def stock(colour, z=0.0, half=0.4, opacity=1.0):
    """A square in a display's colours."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputDataObject(square(z, half))
    thing = actor(mapper, opacity)
    thing.GetProperty().SetColor(*colour)
    thing.GetProperty().LightingOff()
    return thing


def actor(mapper, opacity):
    thing = vtkActor()
    thing.SetMapper(mapper)
    thing.GetProperty().SetOpacity(opacity)
    return thing


class View(Window):
    def __init__(self, *actors, display=vtkOpenColorIOPass):
        super().__init__(size=SIZE)
        self.renderer.RemoveActor(self.actor)
        self.target = display()
        self.renderer.SetPass(self.target)
        self.renderer.SetBackground(0.2, 0.4, 0.6)
        for thing in actors:
            self.renderer.AddActor(thing)

    def shown(self):
        self.window.Render()
        grab = vtkWindowToImageFilter()
        grab.SetInput(self.window)
        grab.ReadFrontBufferOff()
        grab.ShouldRerenderOff()
        grab.Update()
        image = grab.GetOutput()
        x, y, _ = image.GetDimensions()
        return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(y, x, -1).astype(int)

    def middle(self):
        return self.shown()[SIZE // 2, SIZE // 2].tolist()


def close(pixel, values):
    assert all(abs(p - 255 * v) <= 1.0 for p, v in zip(pixel, values)), (pixel, values)


RED = (0.8, 0.2, 0.0)
RED_BYTES = [204, 51, 0]


def test_the_nearest_is_seen():
    for samples in (1, 3):
        for z, seen in ((0.5, RED_BYTES), (-0.5, None)):
            view = View(light(0.18), stock(RED, z))
            view.target.SetSamples(samples)
            if seen:
                assert view.middle() == seen
            else:
                close(view.middle(), [srgb(0.18)] * 3)
            picture = view.shown()
            close(picture[SIZE // 2, 10], [srgb(0.18)] * 3)  # beside the small square
            assert picture[0, 0].tolist() == [51, 102, 153]
            # The light that is read is all of it, hidden by nothing that is no light.
            assert view.read()[SIZE // 2, SIZE // 2].tolist() == [np.float32(0.18)] * 3 + [1]


def test_other_props_keep_their_bytes():
    others = [stock(RED, 0.1), stock((0.1, 0.9, 0.3), 0.2, 0.2), stock((0, 0, 1), 0.3, 0.3, 0.5)]
    plain = View(*others)
    plain.renderer.SetPass(None)
    expected = plain.shown()
    view = View(*others)
    view.target.SetView("ACES")
    view.target.SetExposure(3)
    assert np.array_equal(view.shown(), expected)
    assert len(np.unique(expected.reshape(-1, 3), axis=0)) == 4


def test_false_colour_is_the_legend():
    table = vtkLookupTable()
    table.SetRange(0, 10)
    table.Build()
    surface = square()
    add(surface.GetCellData(), "E", [7.0])
    surface.GetCellData().SetActiveScalars("E")
    wanted = [0.0] * 3
    table.GetColor(7.0, wanted)
    for mapper in (vtkPolyDataMapper(), vtkPhongGouraudMapper()):
        mapper.SetInputDataObject(surface)
        mapper.SetLookupTable(table)
        mapper.SetScalarRange(0, 10)
        coloured = actor(mapper, 1.0)
        if isinstance(mapper, vtkPhongGouraudMapper):
            mapper.SetFieldModeToFalseColor()
            if mapper.GetSceneLinear():
                continue
        else:
            coloured.GetProperty().LightingOff()
        legend = vtkScalarBarActor()
        legend.SetLookupTable(table)
        plain = View(coloured, legend)
        plain.renderer.SetPass(None)
        expected = plain.shown()
        view = View(coloured, legend, light(0.5, -0.5, 0.95))
        view.target.SetExposure(-2)
        picture = view.shown()
        assert picture[15, 20].tolist() == expected[15, 20].tolist()
        close(picture[15, 20], wanted)
        # The same colour on the legend.
        opaque = (expected == expected[15, 20]).all(axis=2)
        assert (picture[opaque] == expected[15, 20]).all() and opaque.sum() > 500


def test_the_conversion_is_the_cpus():
    # A float target around the display pass keeps what it shows, before any byte.
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkradiometry.vtkRadiometryRendering import vtkLinearFloatPass, vtkOpenColorIOImageFilter

    strip = [(x, y, 0) for x in np.linspace(-0.9, 0.9, 30) for y in (-0.9, 0.9)]
    surface = polydata(strip, [(2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1) for i in range(29)])
    add(surface.GetPointData(), "F",
        [(0.002 * 2 ** (i / 4), 0.01 * (60 - i), 0.5 + i / 10) for i in range(60)])
    mapper = vtkPhongGouraudMapper()
    mapper.SetInputDataObject(surface)
    mapper.SetFieldModeToOn()
    mapper.SetFieldArrayName("F")
    view = View(actor(mapper, 1.0), light(0.3, 0.5, 0.3, 0.5))
    display = view.target
    around = vtkLinearFloatPass()
    around.SetDelegatePass(display)
    around.AllSceneLinearOn()
    view.renderer.SetPass(around)

    def floats(image):
        return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(SIZE, SIZE, 4).copy()

    for samples in (1, 2):
        display.SetSamples(samples)
        for screen in ("sRGB", "Display P3"):
            for kind, stops in (("Plain", 0.5), ("ACES", -1.0)):
                display.SetDisplay(screen)
                display.SetView(kind)
                display.SetExposure(stops)
                view.window.Render()
                linear = vtkImageData()
                linear.DeepCopy(display.GetColor())
                shown = floats(around.GetColor())
                cpu = vtkOpenColorIOImageFilter()
                cpu.SetInputData(linear)
                cpu.SetConfigFileName("builtin")
                cpu.SetDisplay(screen)
                cpu.SetView(kind)
                cpu.SetExposure(stops)
                cpu.Update()
                expected = floats(cpu.GetOutput())
                seen = floats(linear)[:, :, 3] == 1
                difference = np.abs(shown - expected)[seen] / np.maximum(1, np.abs(expected[seen]))
                assert seen.mean() > 0.6
                assert difference.max() <= 5e-6, (screen, kind, samples, difference.max())


def test_translucent_light_is_blended_linearly():
    view = View(light(1.6, -0.5), light(0.2, 0.0, 0.8, 0.25))
    assert np.allclose(view.draw()[30, 30, :3], 0.25 * 0.2 + 0.75 * 1.6, rtol=1e-6)
    # The order of the actors does not matter.
    view = View(light(0.2, 0.2, 0.8, 0.25), light(0.8, 0.0, 0.8, 0.5), light(1.6, -0.5))
    expected = 0.25 * 0.2 + 0.75 * (0.5 * 0.8 + 0.5 * 1.6)
    assert np.allclose(view.draw()[30, 30, :3], expected, rtol=1e-6)
    # Nor does the order of the polygons of one actor, or where they cross.
    zs = (0.3, -0.2, 0.1, 0.4, -0.4)
    points = [(x, y, z) for z in zs for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    surface = polydata(points, [tuple(range(4 * i, 4 * i + 4)) for i in range(len(zs))])
    add(surface.GetCellData(), "F", [1.0 + i for i in range(len(zs))])
    mapper = vtkPhongGouraudMapper()
    mapper.SetInputDataObject(surface)
    mapper.SetFieldModeToOn()
    mapper.SetFieldArrayName("F")
    expected = 0.0
    for z, value in sorted(zip(zs, (1.0 + i for i in range(len(zs))))):
        expected = 0.3 * value + 0.7 * expected
    for samples in (1, 2):
        view = View(actor(mapper, 0.3))
        view.target.SetSamples(samples)
        picture = view.draw()
        assert np.allclose(picture[30, 30, :3], expected, rtol=1e-6), picture[30, 30]
        assert np.allclose(picture[30, 30, 3], 1 - 0.7 ** len(zs), rtol=1e-6)
    builds = mapper.GetNumberOfShaderBuilds()
    view.draw()
    view.draw()
    assert mapper.GetNumberOfShaderBuilds() == builds


def test_translucent_light_over_others():
    # Over a display's colour: blended as shown.
    view = View(light(0.18, 0.5, 0.8, 0.5), stock(RED, 0.0))
    close(view.middle(), [0.5 * srgb(0.18) + 0.5 * c for c in RED])
    # In front of it, with light behind it: that light is hidden.
    view = View(light(0.18, 0.5, 0.8, 0.5), stock(RED, 0.0), light(5.0, -0.5))
    close(view.middle(), [0.5 * srgb(0.18) + 0.5 * c for c in RED])
    for samples in (1, 2):
        # Behind it: gone, the opaque light too.
        view = View(light(0.18, 0.0, 0.8, 0.5), stock(RED, 0.5), light(5.0, -0.5))
        view.target.SetSamples(samples)
        assert view.middle() == RED_BYTES


def test_other_translucent_surfaces_over_light():
    view = View(light(0.18, 0.0), stock(RED, 0.5, 0.4, 0.25))
    close(view.middle(), [0.75 * srgb(0.18) + 0.25 * c for c in RED])
    view = View(light(0.18, 0.0), stock(RED, -0.5, 0.4, 0.25))
    close(view.middle(), [srgb(0.18)] * 3)  # behind it: hidden
    # Several of them: as VTK blends them over a stock surface of that colour, peeled or not.
    grey = round(255 * srgb(0.18)) / 255
    for peeling in (False, True):
        front = [stock(RED, 0.5, 0.4, 0.25), stock((0, 0, 1), 0.6, 0.4, 0.5)]
        view = View(light(0.18, 0.0, 0.8), *front)
        plain = View(stock((grey,) * 3, 0.0, 0.8), *front)
        plain.renderer.SetPass(None)
        for thing in (view, plain):
            thing.renderer.SetUseDepthPeeling(peeling)
        assert np.array_equal(view.shown(), plain.shown())


def test_glare_on_glass_stays_bright():
    # f(64) 0.25 = 1.47: more than the surface covers, and than a display has.
    view = View(light(64.0, 0.5, 0.8, 0.25))
    assert view.middle() == [255, 255, 255]
    view = View(light(1.0, 0.5, 0.8, 0.25))
    close(view.middle(), [0.25 + 0.75 * c for c in (0.2, 0.4, 0.6)])


def test_edges_between_the_groups_show_nothing_else():
    # Black light before white stock: an edge pixel may be any grey, never the blue behind both.
    view = View(light(0.0, 0.5, 0.41), stock((1, 1, 1), 0.0, 0.8))
    for samples in (1, 2, 4):
        view.target.SetSamples(samples)
        inside = view.shown()[10:50, 10:50]
        assert np.ptp(inside, axis=2).max() == 0
    between = inside[(inside[:, :, 0] > 0) & (inside[:, :, 0] < 255)]
    assert len(between) > 50  # smooth edges


def test_gradient_background_stays():
    view = View(light(0.5, 0.0, 0.5))
    view.renderer.GradientBackgroundOn()
    view.renderer.SetBackground2(1, 0.5, 0)
    converted = view.shown()
    view.renderer.SetPass(None)
    plain = view.shown()
    assert np.array_equal(converted[:, :10], plain[:, :10])
    assert len(np.unique(plain[:, 0], axis=0)) > 30


def test_the_linear_pass_alone_groups_too():
    from vtkradiometry.vtkRadiometryRendering import vtkLinearFloatPass

    view = View(light(0.5), stock(RED, 0.5), display=vtkLinearFloatPass)
    picture = view.shown()
    assert picture[30, 30].tolist() == RED_BYTES
    close(picture[30, 10], [0.5] * 3)
    assert view.read()[30, 30, 0] == 0.5
    assert picture[0, 0].tolist() == [51, 102, 153]


def test_all_props_as_light():
    view = View(stock((0.5, 0.25, 0.125)))
    assert view.middle() == [128, 64, 32]
    assert view.read().max() == 0
    view.target.AllSceneLinearOn()
    close(view.middle(), [srgb(0.5), srgb(0.25), srgb(0.125)])
    assert view.read()[30, 30, 0] == 0.5


def test_wireframes_are_drawn_by_vtk():
    thing = light(0.5)
    thing.GetProperty().SetRepresentationToWireframe()
    thing.GetProperty().SetColor(0.5, 0.5, 0.5)
    thing.GetProperty().LightingOff()
    view = View(thing)
    view.shown()
    assert view.read().max() == 0


def test_exposure_needs_no_other_shader():
    view = View(light(0.09))
    view.shown()
    text = view.target.GetFragmentShaderSource()
    for stops in (1, 2, -1.5):
        view.target.SetExposure(stops)
        close(view.middle(), [min(1, srgb(0.09 * 2 ** stops))] * 3)
        assert view.target.GetFragmentShaderSource() == text


def test_a_broken_config_changes_nothing_else():
    vtkOutputWindow.GetInstance().SetDisplayMode(0)
    view = View(light(0.5), stock(RED, 0.5))
    errors = Errors(view.target)
    view.target.SetConfigFileName("/nowhere/config.ocio")
    for _ in range(3):
        picture = view.shown()
        assert picture[30, 30].tolist() == RED_BYTES
        close(picture[30, 10], [0.5] * 3)
    assert len(errors.texts) == 1 and "/nowhere/config.ocio" in errors.texts[0], errors.texts


def test_selection_sees_both_groups():
    near = stock(RED, 0.5, 0.2)
    far = light(0.18)
    view = View(near, far)
    view.window.Render()
    for area, wanted in (((30, 30, 31, 31), near), ((10, 30, 11, 31), far)):
        selector = vtkHardwareSelector()
        selector.SetRenderer(view.renderer)
        selector.SetArea(*area)
        selector.SetFieldAssociation(1)
        found = selector.Select()
        assert found.GetNumberOfNodes() == 1
        properties = found.GetNode(0).GetProperties()
        assert properties.Get(found.GetNode(0).PROP()) == wanted
    # And the next frame is a picture again.
    assert view.middle() == RED_BYTES


def test_off_screen_leaves_the_window_alone():
    from vtkradiometry.vtkRadiometryRendering import vtkLinearFloatPass

    view = View(light(0.18), stock(RED, 0.5))
    view.window.Render()
    before = view.shown()
    aside = vtkLinearFloatPass()
    aside.SetSamples(2)
    aside.RenderOffScreen(view.renderer)
    samples = vtk_to_numpy(aside.GetSampleColor().GetPointData().GetScalars())
    assert samples.shape == (4 * SIZE * SIZE, 4) and samples.max() == 1
    color = vtk_to_numpy(aside.GetColor().GetPointData().GetScalars()).reshape(SIZE, SIZE, 4)
    assert np.array_equal(color, view.read())
    assert aside.GetSampleNearest() is None
    aside.ReleaseGraphicsResources(view.window)
    assert np.array_equal(view.shown(), before)


def test_depth_of_translucent_light_for_compositing():
    from vtkradiometry.vtkRadiometryRendering import vtkLinearFloatPass

    view = View(light(0.18, 0.0), light(1.0, 0.5, 0.3, 0.5))
    view.window.Render()
    aside = vtkLinearFloatPass()
    aside.RenderOffScreen(view.renderer)

    def at(image, x):
        values = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(SIZE, SIZE)
        return aside.DistanceOf(float(values[30, x]))

    assert abs(at(aside.GetSampleDepth(), 30) - 5) < 1e-4
    assert abs(at(aside.GetSampleNearest(), 30) - 4.5) < 1e-4
    assert abs(at(aside.GetSampleNearest(), 10) - 5) < 1e-4
    color = vtk_to_numpy(aside.GetColor().GetPointData().GetScalars()).reshape(SIZE, SIZE, 4)
    assert np.allclose(color[30, 30, 0], 0.59)
    aside.ReleaseGraphicsResources(view.window)


run(globals())
