# SPDX-License-Identifier: BSD-3-Clause
"""Radiometric View in ParaView: the panel's lists, the conversion, what stays as it is, states, two
views, tiles, selection, captures, errors, and the toggles of the Render View."""
import os
import sys
import tempfile

import numpy as np

import display

display.ensure()

from paraview import servermanager, simple as pv  # noqa: E402
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkImageData  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGReader  # noqa: E402
from vtkradiometry.vtkRadiometryFilters import vtkOpenEXRReader  # noqa: E402
from vtkradiometry.vtkRadiometryRendering import vtkOpenColorIOImageFilter  # noqa: E402

import view_scene  # noqa: E402

os.environ.pop("OCIO", None)
FOLDER = tempfile.mkdtemp()
SIZE = [200, 150]


def read(reader, path):
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    x, y, _ = image.GetDimensions()
    data = image.GetPointData()
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)).reshape(y, x, -1)
            for i in range(data.GetNumberOfArrays())}


def picture(view, size=SIZE):
    path = os.path.join(FOLDER, "picture.png")
    pv.SaveScreenshot(path, view, ImageResolution=size)
    return next(iter(read(vtkPNGReader(), path).values()))[:, :, :3].astype(int)


def capture(view, name="capture.exr"):
    path = os.path.join(FOLDER, name)
    if os.path.exists(path):
        os.remove(path)
    view.CaptureLinear = path
    assert view.CaptureLinear == ""
    return read(vtkOpenEXRReader(), path)


def new_view(kind="RadiometricView", scene=True, others=True,
             automatic=0):
    view = pv.CreateView(kind)
    view.ViewSize = SIZE
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = [0.1, 0.2, 0.3]
    if kind == "RadiometricView":
        view.AutoExposure = automatic
    if scene:
        view_scene.make_scene(view, others)
        pv.Render(view)
    return view


def converted(linear, display="", view="", exposure=0.0, config=""):
    """What OpenColorIO makes of pixels on the CPU."""
    image = vtkImageData()
    image.SetDimensions(linear.shape[1], linear.shape[0], 1)
    values = numpy_to_vtk(np.ascontiguousarray(linear, np.float32).reshape(-1, 4), deep=True)
    values.SetName("RGBA")
    image.GetPointData().SetScalars(values)
    change = vtkOpenColorIOImageFilter()
    change.SetInputData(image)
    change.SetConfigFileName(config)
    change.SetDisplay(display)
    change.SetView(view)
    change.SetExposure(exposure)
    change.Update()
    result = change.GetOutput().GetPointData().GetScalars()
    return vtk_to_numpy(result).reshape(linear.shape)


def errors_of(action):
    """The error texts that an action leaves."""
    window = vtkStringOutputWindow()
    before = vtkOutputWindow.GetInstance()
    vtkOutputWindow.SetInstance(window)
    try:
        action()
    finally:
        vtkOutputWindow.SetInstance(before)
    return window.GetOutput()


def texts(view, name):
    values = view.SMProxy.GetProperty(name)
    return [values.GetElement(i) for i in range(values.GetNumberOfElements())]


def test_the_panel_lists_what_the_config_has():
    view = new_view(scene=False)
    assert texts(view, "DisplayNames") == ["Default", "sRGB", "Rec.1886", "Display P3"]
    assert texts(view, "ViewNames") == ["Default", "Plain", "ACES", "Raw"]
    assert texts(view, "LookNames") == ["Default", "Gamut Compression"]
    assert "ACEScg" in texts(view, "ColorSpaceNames")
    assert list(view.GetProperty("Display").GetAvailable()) == texts(view, "DisplayNames")
    assert (view.Display, view.View, view.Look, view.SourceColorSpace) == ("Default",) * 4
    assert (view.ConfigFileName, view.Exposure, view.Samples) == ("", 0, 1)
    shared = os.environ.get("RADIOMETRY_SHARED_DATA", "")
    other = os.path.join(shared, "ocio/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio")
    if os.path.exists(other):
        view.ConfigFileName = other
        assert texts(view, "DisplayNames")[1] == "sRGB - Display"
        view.Display = "Rec.2100-PQ - Display"
        assert any("1000 nits" in name for name in texts(view, "ViewNames"))
        view.ConfigFileName = ""
    view.Display = "Default"
    assert texts(view, "DisplayNames") == ["Default", "sRGB", "Rec.1886", "Display P3"]


def test_light_is_shown_as_the_cpu_converts_it():
    view = new_view(others=False)
    linear = capture(view)["RGBA"]
    seen = linear[:, :, 3] == 1
    assert seen.mean() > 0.1, seen.mean()
    for settings in (("", "", 0), ("sRGB", "ACES", 1.0), ("Rec.1886", "Plain", -2.5),
                     ("Display P3", "ACES", -1.0), ("sRGB", "Raw", 0)):
        view.Display, view.View = (name or "Default" for name in settings[:2])
        view.Exposure = settings[2]
        expected = 255 * np.clip(converted(linear, *settings), 0, 1)[:, :, :3]
        difference = np.abs(picture(view) - expected)[seen]
        assert difference.max() <= 0.51, (settings, difference.max())
        assert np.ptp(expected[seen]) > 100


def test_the_default_picture_is_a_good_one():
    picture_ = picture(new_view(automatic=1))
    lit = (picture_ != [26, 51, 77]).any(axis=2)
    grey = picture_[lit].mean()
    assert lit.mean() > 0.2 and 60 < grey < 220, grey
    assert (picture_[lit] == 255).all(axis=1).mean() < 0.1  # hardly anything is burnt out


def test_false_colours_legend_and_background_are_the_render_views():
    for mode in ("Single Color", "Gradient"):
        plain = new_view("RenderView")
        light = new_view()
        for view in (plain, light):
            view.BackgroundColorMode = mode
            view.Background2 = [0.9, 0.5, 0.1]
            view.UseFXAA = 0
        light.Exposure = -3
        light.View = "ACES"
        a, b = picture(plain), picture(light)
        same = (a == b).all(axis=2)
        # Everything but what is light (the sphere and the plane).
        rgba = capture(light)["RGBA"]
        assert same[rgba[:, :, 3] == 0].all()
        # The column and the legend stand before light in part; letters let some of it through.
        before = (rgba[:, :, 3] > 0) & (np.ptp(b, axis=2) > 60)
        assert same[before].mean() > 0.8 and before.sum() > 100, (same[before].mean(), before.sum())
        assert not same.all()
        pv.Delete(plain)
        pv.Delete(light)


def test_skybox_and_environment_background_stay():
    plain, light = new_view("RenderView"), new_view()
    for view in (plain, light):
        view.UseFXAA = 0
        view.BackgroundColorMode = "Skybox"
        view.UseEnvironmentLighting = 0
        view.BackgroundTexture = pv.CreateTexture(make_texture())
    light.Exposure = -4
    a, b = picture(plain), picture(light)
    rgba = capture(light)["RGBA"]
    assert np.array_equal(a[rgba[:, :, 3] == 0], b[rgba[:, :, 3] == 0])
    assert len(np.unique(b[rgba[:, :, 3] == 0], axis=0)) > 20
    assert b[rgba[:, :, 3] == 1].mean() < a[rgba[:, :, 3] == 1].mean()


def make_texture():
    from vtkmodules.vtkIOImage import vtkPNGWriter

    pixels = np.zeros((64, 128, 3), np.uint8)
    pixels[:, :, 0] = np.arange(128) * 2
    pixels[:, :, 1] = np.arange(64)[:, None] * 4
    image = vtkImageData()
    image.SetDimensions(128, 64, 1)
    values = numpy_to_vtk(pixels.reshape(-1, 3), deep=True)
    values.SetName("RGB")
    image.GetPointData().SetScalars(values)
    writer = vtkPNGWriter()
    writer.SetFileName(os.path.join(FOLDER, "sky.png"))
    writer.SetInputData(image)
    writer.Write()
    return writer.GetFileName()


def test_state_keeps_the_settings():
    pv.ResetSession()
    view = new_view()
    view.Display, view.View, view.Exposure, view.Samples = "Display P3", "ACES", -0.75, 2
    view.Look = "Gamut Compression"
    before = picture(view)
    capture(view)
    state = os.path.join(FOLDER, "state.pvsm")
    pv.SaveState(state)
    with open(state) as text:
        assert "capture.exr" not in text.read()
    os.remove(os.path.join(FOLDER, "capture.exr"))
    pv.ResetSession()
    pv.LoadState(state)
    view = next(v for v in pv.GetViews() if v.GetXMLName() == "RadiometricView")
    assert (view.Display, view.View, view.Look) == ("Display P3", "ACES", "Gamut Compression")
    assert (view.Exposure, view.Samples) == (-0.75, 2)
    assert np.array_equal(picture(view), before)
    assert not os.path.exists(os.path.join(FOLDER, "capture.exr"))


def test_two_views_of_two_displays():
    one, two = new_view(), new_view()
    two.Display, two.View, two.Exposure = "Rec.1886", "ACES", 1
    a, b = picture(one), picture(two)
    assert np.abs(a - b).max() > 20
    assert np.array_equal(picture(one), a) and np.array_equal(picture(two), b)
    linear = capture(one)["RGBA"]
    assert np.allclose(capture(two)["RGBA"], linear, atol=1e-6)
    two.Display, two.View, two.Exposure = "Default", "Default", 0
    assert np.array_equal(picture(two), a)


def test_screenshots_in_tiles():
    view = new_view(others=False)
    view.View = "ACES"
    big = [3 * SIZE[0], 3 * SIZE[1]]
    tiles = picture(view, big)
    view.ViewSize = big
    whole = picture(view, big)
    view.ViewSize = SIZE
    assert tiles.shape == whole.shape and np.ptp(whole) > 200
    different = np.abs(tiles - whole).max(axis=2)
    # A silhouette may move by a pixel: the projection of a tile rounds otherwise.
    assert (different > 1).mean() < 1e-3, (different > 1).mean()


def test_selection():
    view = new_view(scene=False)
    plane = pv.Plane(XResolution=4, YResolution=4)
    view_scene.shown(plane, view)
    view.CameraPosition, view.CameraFocalPoint = [0, 0, 3], [0, 0, 0]
    before = picture(view)
    middle = [SIZE[0] // 2 + 5, SIZE[1] // 2 + 5]
    pv.SelectSurfaceCells(Rectangle=middle + middle, View=view)
    extract = pv.ExtractSelection(Input=plane)
    extract.UpdatePipeline()
    assert extract.GetDataInformation().GetNumberOfCells() == 1
    pv.ClearSelection(plane)
    assert np.array_equal(picture(view), before)


def test_camera_and_light_move_the_picture():
    view = new_view(scene=False)
    view_scene.shown(pv.Plane(Origin=[-1, -1, 0], Point1=[1, -1, 0], Point2=[-1, 1, 0]), view)
    lamp = pv.PointLight(Position=[0, 0, 1], Intensity=np.pi)
    shown = pv.Show(lamp, view)
    assert shown.Representation == "Radiometric Lights"
    shown.ShowGlyphs = 0
    view.CameraPosition, view.CameraFocalPoint = [0, 0, 4], [0, 0, 0]
    linear = capture(view)
    row, column = SIZE[1] // 2, SIZE[0] // 2
    assert abs(linear["RGBA"][row, column, 0] - 1) < 1e-3
    assert abs(linear["Z"][row, column, 0] - 4) < 1e-4
    lamp.Position = [0, 0, 2]
    assert abs(capture(view)["RGBA"][row, column, 0] - 0.25) < 1e-3
    view.CameraPosition = [0, 0, 5]
    moved = capture(view)
    assert abs(moved["Z"][row, column, 0] - 5) < 1e-4
    assert (moved["RGBA"][:, :, 3] > 0).sum() < (linear["RGBA"][:, :, 3] > 0).sum()


def test_automatic_exposure():
    view = new_view(others=False, automatic=1)
    before = picture(view)
    rgba = capture(view)["RGBA"]
    lit = rgba[rgba[:, :, 3] > 0]
    luminance = lit[:, :3] @ [0.2126390, 0.7151687, 0.0721923]
    luminance = luminance[luminance > 0]
    typical = np.exp(np.log(luminance).mean())
    wanted = np.log2(min(0.25 / typical, 1 / np.quantile(luminance, 0.98)))
    assert abs(view_scene.used_exposure(view) - wanted) <= 0.25, (view_scene.used_exposure(view), wanted)
    assert view_scene.used_exposure(view) * 4 % 1 == 0
    linear = 255 * np.clip(converted(rgba, "", "", view_scene.used_exposure(view)), 0, 1)[:, :, :3]
    assert np.abs(before - linear)[rgba[:, :, 3] == 1].max() <= 0.51
    first = view_scene.used_exposure(view)
    view.Exposure = 1.5
    picture(view)
    assert view_scene.used_exposure(view) == first + 1.5
    view.Exposure = 0
    # A lamp of 800 lm, 2^7 times weaker: the same picture, to a quarter stop.
    lamp = next(s for s in pv.GetSources().values() if s.GetXMLName() == "PointLight")
    lamp.Intensity, lamp.IntensityUnit = 800, "lm"
    weak = picture(view)
    assert view_scene.used_exposure(view) > first + 5
    assert abs(weak.mean() - before.mean()) < 0.1 * before.mean()
    # Tiles of a large picture have one exposure: no seam where they meet.
    big = picture(view, [3 * SIZE[0], 3 * SIZE[1]])
    small = big[1::3, 1::3]
    assert np.median(np.abs(small - weak).max(axis=2)) <= 1
    # Nothing to see: nothing happens.
    for source in pv.GetSources().values():
        pv.Hide(source, view)
    assert picture(view).std(axis=(0, 1)).max() == 0


def test_samples_smooth_in_linear_light():
    view = new_view()
    hard = capture(view)["RGBA"]
    view.Samples = 4
    soft = capture(view)["RGBA"]
    assert set(np.unique(hard[:, :, 3])) == {0, 1}
    assert len(np.unique(soft[:, :, 3])) > 5
    assert abs(soft.mean() - hard.mean()) < 0.02 * hard.mean()
    shown = picture(view)
    assert len(np.unique(shown.reshape(-1, 3), axis=0)) > 100


def test_a_capture_says_how_it_was_made():
    view = new_view()
    view.Samples, view.SourceColorSpace, view.Exposure = 3, "ACEScg", 1.5
    view.CaptureLinear = os.path.join(FOLDER, "notes.exr")
    reader = vtkOpenEXRReader()
    reader.SetFileName(os.path.join(FOLDER, "notes.exr"))
    reader.Update()
    data = reader.GetOutput().GetFieldData()
    notes = {data.GetArrayName(i): data.GetAbstractArray(i)
             for i in range(data.GetNumberOfArrays())}
    assert notes["software"].GetValue(0).startswith("vtkRadiometry ")
    assert notes["units"].GetValue(0) == "W/(m^2 sr)"
    assert notes["colorSpace"].GetValue(0) == "ACEScg"
    assert notes["displayExposure"].GetTuple1(0) == 1.5
    assert np.allclose(vtk_to_numpy(notes["cameraPosition"]).ravel(), view.CameraPosition)
    assert notes["cameraViewAngle"].GetTuple1(0) == view.CameraViewAngle
    chromaticities = vtk_to_numpy(notes["chromaticities"]).ravel()
    assert np.allclose(chromaticities[:2], [0.713, 0.293])  # the red of AP1
    nowhere = os.path.join(FOLDER, "no", "folder.exr")
    message = errors_of(lambda: setattr(view, "CaptureLinear", nowhere))
    assert nowhere in message, message
    assert len(capture(view)) == 2  # and all is well again


def test_configs_by_environment_and_broken_ones():
    view = new_view(others=False)
    good = picture(view)
    linear = capture(view)["RGBA"]
    seen = linear[:, :, 3] == 1

    def break_it(name):
        view.ConfigFileName = name
        for _ in range(3):
            pv.Render(view)

    message = errors_of(lambda: break_it("/nowhere/config.ocio"))
    assert message.count("/nowhere/config.ocio") == 1, message
    plain = np.abs(picture(view) - 255 * np.clip(linear[:, :, :3], 0, 1))[seen]
    assert plain.max() <= 0.51
    assert texts(view, "DisplayNames") == ["Default"]
    view.ConfigFileName = ""
    assert np.array_equal(picture(view), good)
    message = errors_of(lambda: (setattr(view, "View", "Sepia"), pv.Render(view)))
    assert "Sepia" in message and "Plain" in message, message
    view.View = "Default"

    own = os.path.join(os.environ["RADIOMETRY_SOURCE_DIR"], "color", "radiometry.ocio")
    with open(own) as text:
        other = text.read().replace("active_views: [Plain, ACES, Raw]", "active_views: [ACES, Plain]")
    path = os.path.join(FOLDER, "environment.ocio")
    with open(path, "w") as file:
        file.write(other)
    os.environ["OCIO"] = path
    try:
        expected = 255 * np.clip(converted(linear, "sRGB", "ACES"), 0, 1)[:, :, :3]
        assert np.abs(picture(view) - expected)[seen].max() <= 0.51
        view.ConfigFileName = "builtin"
        assert np.array_equal(picture(view), good)
    finally:
        del os.environ["OCIO"]
    view.ConfigFileName = ""
    assert np.array_equal(picture(view), good)


def test_toggles_of_the_render_view_do_no_harm():
    view = new_view()
    good = picture(view)
    view.UseFXAA = 1
    assert np.array_equal(picture(view), good)
    view.UseToneMapping = 1
    assert np.array_equal(picture(view), good)
    view.UseAmbientOcclusion = 1
    shaded = picture(view)
    rgba = capture(view)["RGBA"]
    assert (shaded == good).all(axis=2).mean() > 0.8
    assert rgba[:, :, 3].max() == 1
    view.UseAmbientOcclusion = 0
    view.HiddenLineRemoval = 1
    assert np.array_equal(picture(view), good)
    view.HiddenLineRemoval = 0
    view.CameraParallelProjection = 1
    assert picture(view).std() > 10
    view.CameraParallelProjection = 0
    errors_of(lambda: (setattr(view, "EnableRayTracing", 1), pv.Render(view)))
    errors_of(lambda: (setattr(view, "EnableRayTracing", 0), pv.Render(view)))
    assert np.array_equal(picture(view), good)
    view.StereoType, view.StereoRender = "Red-Blue", 1
    assert picture(view).std() > 10


def test_an_ordinary_render_view_is_as_before():
    view = new_view("RenderView", others=False)
    view.UseFXAA = 0
    linear = capture(new_view(others=False))["RGBA"]
    expected = 255 * np.clip(linear[:, :, :3], 0, 1)
    assert np.abs(picture(view) - expected)[linear[:, :, 3] == 1].max() <= 0.51


pv.LoadPlugin(view_scene.PLUGIN, remote=False, ns=vars(pv))
chosen = sys.argv[1:]
for name, test in list(globals().items()):
    if name.startswith("test_") and (not chosen or name in chosen):
        pv.ResetSession()
        test()
        print("passed", name)
        sys.stdout.flush()
