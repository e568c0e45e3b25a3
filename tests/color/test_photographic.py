# SPDX-License-Identifier: BSD-3-Clause
"""Exposure, False Color Image and Image Comparison: numbers, what is not finite, errors."""
import math
import os
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkradiometry import (vtkExposureFilter, vtkFalseColorImageFilter, vtkImageComparisonFilter,
                           vtkOpenEXRReader, vtkOpenEXRWriter)

KM = 683.002
NAN, INF = float("nan"), float("inf")


def image(pixels, name="RGB", unit=None):
    """An image from rows x columns x channels, the first row at the bottom."""
    pixels = np.asarray(pixels, np.float32)
    result = vtkImageData()
    result.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    array = numpy_to_vtk(np.ascontiguousarray(pixels.reshape(-1, pixels.shape[2])), deep=True)
    array.SetName(name)
    if unit:
        array.GetInformation().Set(vtkDataArray.UNITS_LABEL(), unit)
    result.GetPointData().SetScalars(array)
    return result


def pixels(data, name=None):
    array = data.GetPointData().GetArray(name) if name else data.GetPointData().GetScalars()
    width, height, _ = data.GetDimensions()
    return vtk_to_numpy(array).reshape(height, width, -1)


def run(cls, *inputs, **properties):
    """The filter after an update, with the errors that it told in .told."""
    f = cls()
    told = []

    def tell(_object, _event, text=""):
        told.append(text)

    tell.CallDataType = "string0"
    f.AddObserver("ErrorEvent", tell)
    f.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
    for port, data in enumerate(inputs):
        f.SetInputData(port, data)
    for key, value in properties.items():
        if key == "Levels":
            for level in value:
                f.AddLevel(level)
        else:
            getattr(f, "Set" + key)(value)
    f.Update()
    return f, told


def field(data, name):
    array = data.GetFieldData().GetAbstractArray(name)
    assert array is not None, name
    return array.GetValue(0) if array.GetNumberOfValues() == 1 else vtk_to_numpy(array)


def near(a, b, relative=1e-6):
    a, b = np.asarray(a, float), np.asarray(b, float)
    assert a.shape == b.shape, (a.shape, b.shape)
    assert (np.abs(a - b) <= relative * np.abs(b)).all(), (a, b)


ramp = np.stack([np.outer(np.ones(10), np.linspace(0.1, 10, 100))] * 3, axis=-1)


def test_exposure_of_a_camera():
    f, told = run(vtkExposureFilter, image(ramp, unit="cd/m^2"), Mode=1, FNumber=4.0,
                  ShutterTime=0.01, IsoSpeed=200.0)
    assert not told
    gain = 0.65 * 200 * 0.01 / (78 * 16.0)
    near(pixels(f.GetOutput()), ramp * gain)
    near(f.GetUsedGain(), gain)
    near(f.GetUsedExposureValue(), math.log2(16 / 0.01 * 100 / 200))
    near(field(f.GetOutput(), "ExposureValue"), f.GetUsedExposureValue())
    near(2 ** field(f.GetOutput(), "ExposureStops"), gain)
    # The same light in W/(m^2 sr): the same EV, a gain 683.002 times as great.
    w, _ = run(vtkExposureFilter, image(ramp / KM), Mode=0,
               ExposureValue=f.GetUsedExposureValue())
    near(pixels(w.GetOutput()), ramp * gain, 2e-6)
    stated, _ = run(vtkExposureFilter, image(ramp), Mode=0, LuminancePerUnit=1.0,
                    ExposureValue=f.GetUsedExposureValue())
    near(stated.GetUsedGain(), gain)


def test_exposure_by_what_is_in_the_picture():
    f, _ = run(vtkExposureFilter, image(ramp), Mode=3, Percentile=90.0, PercentileLevel=0.5)
    near(np.percentile(pixels(f.GetOutput())[..., 0], 90), 0.5)
    f, _ = run(vtkExposureFilter, image(ramp), Mode=2, Compensation=1.0)
    near(np.exp(np.log(pixels(f.GetOutput())[..., 0].astype(float)).mean()), 0.36)
    f, _ = run(vtkExposureFilter, image(ramp), Mode=4, Compensation=-2.0)
    near(pixels(f.GetOutput()), 0.25 * ramp)
    assert f.GetUsedStops() == -2.0


def test_exposure_repairs_and_counts():
    odd = ramp.copy()
    odd[0, 0, 1], odd[3, 5, 0], odd[7, 7, 2] = NAN, INF, -INF
    f, told = run(vtkExposureFilter, image(odd), Mode=3)
    assert not told and f.GetNonFinitePixels() == 3
    out = pixels(f.GetOutput())
    assert np.isfinite(out).all()
    assert out[0, 0, 1] == 0 and out[7, 7, 2] == 0
    near(out[3, 5, 0], 10 * f.GetUsedGain())
    assert field(f.GetOutput(), "NonFinitePixels") == 3
    assert "3 pixels are not finite" in field(f.GetOutput(), "ExposureSummary")
    kept, _ = run(vtkExposureFilter, image(odd), RepairPixels=False)
    assert (~np.isfinite(pixels(kept.GetOutput()))).sum() == 3
    dark, told = run(vtkExposureFilter, image(np.zeros((4, 4, 3))), Mode=2)
    assert not told and (pixels(dark.GetOutput()) == 0).all() and dark.GetUsedGain() == 1
    # Where nothing was drawn there is nothing to measure.
    rgba = np.zeros((2, 2, 4))
    rgba[0, 0] = [1.0, 1.0, 1.0, 0.5]
    f, _ = run(vtkExposureFilter, image(rgba, "RGBA"), Percentile=0.0)
    near(pixels(f.GetOutput())[0, 0], [0.5, 0.5, 0.5, 0.5])


def test_exposure_tells_what_is_wrong():
    for properties, word in ((dict(Mode=1, FNumber=0.0), "FNumber"),
                             (dict(Percentile=120.0), "Percentile"),
                             (dict(Mode=2, KeyValue=NAN), "KeyValue"),
                             (dict(Compensation=INF), "Compensation"),
                             (dict(LuminancePerUnit=-1.0), "LuminancePerUnit")):
        f, told = run(vtkExposureFilter, image(ramp), **properties)
        assert len(told) == 1 and word in told[0], (properties, told)
        assert (pixels(f.GetOutput()) == ramp.astype(np.float32)).all()
    solid = vtkImageData()
    solid.SetDimensions(2, 2, 2)
    assert len(run(vtkExposureFilter, solid)[1]) == 1


def legend_of(data):
    limits = vtk_to_numpy(data.GetFieldData().GetArray("LegendLimits"))
    colors = vtk_to_numpy(data.GetFieldData().GetArray("LegendColors"))
    return limits, colors


def test_false_colour_is_the_legends():
    rng = np.random.default_rng(3)
    radiance = rng.lognormal(0, 2, (30, 40, 3))
    luminance = KM * radiance.astype(np.float32).astype(float) @ [0.2126, 0.7152, 0.0722]
    for properties in (dict(), dict(LogScale=False), dict(Steps=6), dict(Palette=2),
                       dict(Levels=[10, 100, 300, 500, 1000, 5000]),
                       dict(ScalarRange=(50.0, 2000.0))):
        f, told = run(vtkFalseColorImageFilter, image(radiance), **properties)
        assert not told, told
        out = f.GetOutput()
        limits, colors = legend_of(out)
        assert len(limits) == len(colors) + 1
        shown = pixels(out, "FalseColor")[:, :40]
        row = np.clip(np.searchsorted(limits, luminance, side="right") - 1, 0, len(colors) - 1)
        assert (shown == colors[row]).all(), properties
        table = f.GetOutputDataObject(1)
        assert table.GetNumberOfRows() == len(colors)
        near(vtk_to_numpy(table.GetColumnByName("Lower")), limits[:-1])
        near(vtk_to_numpy(table.GetColumnByName("Upper")), limits[1:])
        assert (vtk_to_numpy(table.GetColumnByName("Green")) == colors[:, 1]).all()
        assert field(out, "LegendTitle") == "Luminance"
        assert field(out, "LegendUnit") == "cd/m\u00b2"


def test_the_drawn_legend_has_these_colours():
    data = image(np.full((240, 20, 3), 0.5))
    f, _ = run(vtkFalseColorImageFilter, data, Steps=5, ScalarRange=(1.0, 1e5))
    strip = pixels(f.GetOutput(), "FalseColor")[:, 20:]
    _, colors = legend_of(f.GetOutput())
    bar = strip[:, 15]
    seen = [tuple(c) for c, n in zip(*np.unique(bar, axis=0, return_counts=True)) if n > 10]
    for color in colors:
        assert tuple(color) in seen, (color, seen)
    # Labels: something dark beside the bar.
    assert (strip[:, 30:].max(axis=2) < 120).sum() > 50
    plain, _ = run(vtkFalseColorImageFilter, data, Legend=False)
    assert plain.GetOutput().GetDimensions() == data.GetDimensions()
    assert plain.GetOutput().GetPointData().GetArray("RGB") is not None


def test_false_colour_of_any_array_in_its_unit():
    values = np.linspace(-3, 5, 64).reshape(8, 8, 1)
    f, _ = run(vtkFalseColorImageFilter, image(values, "Temperature", "K"), LogScale=False)
    limits, _ = legend_of(f.GetOutput())
    assert (limits[0], limits[-1]) == (-3.0, 5.0)
    assert field(f.GetOutput(), "LegendUnit") == "K"
    assert field(f.GetOutput(), "LegendTitle") == "Temperature"
    f, _ = run(vtkFalseColorImageFilter, image(np.ones((4, 4, 3)), "Illuminance", "lx"))
    assert field(f.GetOutput(), "LegendUnit") == "lx"
    near(legend_of(f.GetOutput())[0][-1], 1.0)


def test_iso_lines_lie_where_the_level_is_passed():
    values = np.tile(np.arange(32.0) + 0.5, (8, 1))[..., None]
    f, _ = run(vtkFalseColorImageFilter, image(values, "V"), LogScale=False, Palette=3,
               Levels=[0, 8, 16, 24, 32], IsoLines=True, Legend=False)
    off, _ = run(vtkFalseColorImageFilter, image(values, "V"), LogScale=False, Palette=3,
                 Levels=[0, 8, 16, 24, 32], Legend=False)
    changed = (pixels(f.GetOutput(), "FalseColor") != pixels(off.GetOutput(), "FalseColor")).any(2)
    assert sorted(set(np.nonzero(changed)[1])) == [7, 15, 23] and changed.sum() == 24
    near(vtk_to_numpy(f.GetOutput().GetFieldData().GetArray("IsoLineLevels")), [0, 8, 16, 24, 32])


def test_false_colour_marks_and_counts_what_is_not_finite():
    odd = ramp.copy()
    odd[2, 2], odd[3, 3, 0] = NAN, INF
    f, told = run(vtkFalseColorImageFilter, image(odd), NonFiniteColor=(0.0, 1.0, 0.0))
    assert not told and field(f.GetOutput(), "NonFinitePixels") == 2
    out = pixels(f.GetOutput(), "FalseColor")
    assert (out[2, 2] == [0, 255, 0]).all() and (out[3, 3] == [0, 255, 0]).all()
    rgba = np.ones((2, 2, 4))
    rgba[1, 0] = 0
    f, told = run(vtkFalseColorImageFilter, image(rgba, "RGBA"))
    assert not told and field(f.GetOutput(), "NonFinitePixels") == 0
    assert (pixels(f.GetOutput(), "FalseColor")[1, 0] == 224).all()
    nothing, told = run(vtkFalseColorImageFilter, image(np.full((3, 3, 3), NAN)))
    assert not told and field(nothing.GetOutput(), "NonFinitePixels") == 9


def test_false_colour_tells_what_is_wrong():
    for properties, word in ((dict(ScalarRange=(0.0, 1.0)), "Minimum"),
                             (dict(ScalarRange=(2.0, 1.0)), "Maximum"),
                             (dict(Levels=[2, 1]), "Levels"), (dict(Steps=-2), "Steps"),
                             (dict(ArrayName="Gone"), "Gone")):
        f, told = run(vtkFalseColorImageFilter, image(ramp), **properties)
        assert len(told) == 1 and word in told[0], (properties, told)
        assert f.GetOutput().GetNumberOfPoints() == 0
    two = image(np.ones((2, 2, 2)), "Two")
    assert "2 components" in run(vtkFalseColorImageFilter, two)[1][0]


def test_comparison_of_two_exr_files():
    rng = np.random.default_rng(8)
    a = rng.lognormal(0, 1, (12, 20, 3)).astype(np.float32)
    b = (a * (1 + 0.05 * rng.standard_normal(a.shape))).astype(np.float32)
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for k, values in enumerate((a, b)):
            writer = vtkOpenEXRWriter()
            writer.SetInputData(image(values))
            writer.SetFileName(os.path.join(folder, "%d.exr" % k))
            writer.Write()
            files.append(writer.GetFileName())
        f = vtkImageComparisonFilter()
        for port, name in enumerate(files):
            reader = vtkOpenEXRReader()
            reader.SetFileName(name)
            f.SetInputConnection(port, reader.GetOutputPort())
        f.SetGap(3)
        f.SetDifferenceGain(10)
        f.Update()
    panels = pixels(f.GetOutput())
    assert panels.shape == (12, 66, 3)
    assert (panels[:, :20] == a).all() and (panels[:, 23:43] == b).all()
    assert (panels[:, 20:23] == 0).all()
    near(panels[:, 46:], 10 * np.abs(b.astype(float) - a), 1e-5)
    table = f.GetOutputDataObject(1)

    def column(name):
        found = table.GetColumnByName(name)
        return [found.GetValue(i) for i in range(table.GetNumberOfRows())]

    assert column("Channel") == ["R", "G", "B", "All"]
    d = b.astype(float) - a
    rmse = np.sqrt((d ** 2).mean(axis=(0, 1)))
    near(column("RMSE"), [*rmse, np.sqrt((d ** 2).mean())])
    near(column("MeanAbsolute")[3], np.abs(d).mean())
    near(column("Maximum")[:3], np.abs(d).max(axis=(0, 1)))
    near(column("PSNR")[:3], 20 * np.log10(a.max(axis=(0, 1)) / rmse))
    worst = np.unravel_index(np.abs(d[..., 1]).argmax(), d.shape[:2])
    assert (column("MaximumY")[1], column("MaximumX")[1]) == worst
    near(column("RelativeRMSE")[3], np.sqrt((d ** 2).sum() / (a.astype(float) ** 2).sum()))
    floor = 1e-3 * a.astype(float).mean()
    near(column("MeanRelative")[3], (np.abs(d) / np.maximum(a, floor)).mean())
    alone = f.GetOutputDataObject(2)
    near(pixels(alone, "RGBDifference"), d.astype(np.float32), 1e-5)
    assert alone.GetDimensions() == (20, 12, 1)


def test_comparison_counts_what_is_not_finite():
    a, b = ramp.copy(), ramp.copy()
    a[1, 1, 0] = NAN
    b[1, 1, 0] = NAN
    b[2, 2, 1] = INF
    f, told = run(vtkImageComparisonFilter, image(a), image(b))
    assert not told
    table = f.GetOutputDataObject(1)
    get = lambda name, row: table.GetColumnByName(name).GetValue(row)  # noqa: E731
    assert (get("NonFiniteA", 3), get("NonFiniteB", 3), get("Unlike", 3)) == (1, 2, 1)
    assert get("RMSE", 3) == 0 and get("PSNR", 3) == INF and get("MaximumX", 3) == -1
    assert np.isfinite(pixels(f.GetOutput())[:, -100:]).all()
    assert np.isnan(pixels(f.GetOutputDataObject(2), "RGBDifference")).sum() == 2


def test_comparison_panels_and_errors():
    a, b = np.full((2, 2, 3), 2.0), np.full((2, 2, 3), 1.0)
    shown, _ = run(vtkImageComparisonFilter, image(a), image(b), DifferenceKind=1, Gap=0)
    near(pixels(shown.GetOutput())[0, 4], [0, 0, 1])  # less than A: blue
    shown, _ = run(vtkImageComparisonFilter, image(a), image(b), DifferenceKind=2, Gap=0)
    near(pixels(shown.GetOutput())[0, 4], [0.5, 0.5, 0.5])
    for other, properties, word in ((image(np.ones((2, 3, 3))), {}, "3 x 2"),
                                    (image(np.ones((2, 2, 1))), {}, "1 channels"),
                                    (image(b), dict(ArrayName="Gone"), "Gone"),
                                    (image(b), dict(DifferenceGain=NAN), "DifferenceGain"),
                                    (image(b), dict(RelativeFloor=-1.0), "RelativeFloor")):
        f, told = run(vtkImageComparisonFilter, image(a), other, **properties)
        assert len(told) == 1 and word in told[0], told
        assert f.GetOutput().GetNumberOfPoints() == 0
        assert f.GetOutputDataObject(1).GetNumberOfRows() == 0


for name, function in list(globals().items()):
    if name.startswith("test_"):
        function()
        print("passed", name)
sys.exit(0)
