# SPDX-License-Identifier: BSD-3-Clause
"""vtkOpenColorIOImageFilter from Python: numbers, types, alpha, errors, and the tahoe pair."""
import os
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkTIFFReader

from vtkradiometry import vtkOpenColorIOImageFilter

os.environ.pop("OCIO", None)
FAILURES = []


def check(condition, what):
    if not condition:
        FAILURES.append(what)
        print("FAILED:", what)


def image(pixels, name="RGB", scalars=True):
    """An image of one row from an array of colours."""
    result = vtkImageData()
    result.SetDimensions(len(pixels), 1, 1)
    array = numpy_to_vtk(np.ascontiguousarray(pixels), deep=True)
    array.SetName(name)
    if scalars:
        result.GetPointData().SetScalars(array)
    else:
        result.GetPointData().AddArray(array)
    return result


def run(data, **properties):
    """The output's active scalars and the number of errors."""
    f = vtkOpenColorIOImageFilter()
    errors = []
    f.AddObserver("ErrorEvent", lambda *_: errors.append(1))
    f.SetInputData(data)
    for key, value in properties.items():
        getattr(f, "Set" + key)(value)
    f.Update()
    scalars = f.GetOutput().GetPointData().GetScalars()
    return (vtk_to_numpy(scalars) if scalars else None), len(errors), f.GetOutput()


def srgb(x):
    x = np.asarray(x, float)
    return np.where(x <= 0.0030399346, 12.923210180787857 * x,
                    1.055 * np.abs(x) ** (1 / 2.4) - 0.055)


linear = np.array([[0.5, 0.4, 0.3], [0.0, 1.0, 2.0], [0.001, 0.18, 5.0]], np.float32)

shown, errors, _ = run(image(linear))
check(errors == 0 and np.abs(shown - srgb(linear)).max() < 4e-6, "plain sRGB is the curve")

for scalar_type in (np.float64, np.float32):
    shown, errors, _ = run(image(linear.astype(scalar_type), scalars=False), Exposure=1.0)
    check(np.abs(shown - srgb(2 * linear)).max() < 4e-6, "an array named RGB is found")

published, errors, _ = run(image(linear[:1]), SourceColorSpace="ACEScg",
                           TargetColorSpace="ACES2065-1")
check(np.abs(published[0] - [0.453158317919, 0.394926024520, 0.299297344519]).max() < 2e-7,
      "ACEScg to ACES2065-1 is the published number")

# Alpha: nothing where it is 0, unpremultiplied where it is between.
rgba = np.array([[0.5, 0.4, 0.3, 0.0], [0.25, 0.2, 0.15, 0.5], [0.5, 0.4, 0.3, 1.0]], np.float32)
shown, errors, _ = run(image(rgba, "RGBA"))
check((shown[0] == rgba[0]).all(), "alpha 0 is untouched")
check(np.abs(shown[1, :3] - 0.5 * srgb(linear[0])).max() < 2e-6, "alpha one half")
check((shown[:, 3] == rgba[:, 3]).all(), "alpha is kept")

# Bytes in and out.
codes = np.array([[0, 128, 255], [1, 2, 3]], np.uint8)
same, errors, _ = run(image(codes), SourceColorSpace="sRGB Texture", OutputScalarType=3)
check(same.dtype == np.uint8 and (same == codes).all(), "sRGB bytes come back from sRGB bytes")
wild = np.array([[-1.0, np.nan, 7.0]], np.float32)
bytes_, errors, _ = run(image(wild), View="Raw", OutputScalarType=3)
check((bytes_ == [[0, 0, 255]]).all(), "bytes are clamped and NaN is black")

one, _, _ = run(image(np.tile(linear, (20000, 1))), NumberOfThreads=1, View="ACES")
four, _, _ = run(image(np.tile(linear, (20000, 1))), NumberOfThreads=4, View="ACES")
check((one == four).all(), "threads do not matter")

# The input is not changed, other arrays pass, the extent stays.
data = image(linear)
extra = numpy_to_vtk(np.arange(3.0), deep=True)
extra.SetName("Irradiance")
data.GetPointData().AddArray(extra)
shown, errors, output = run(data)
check((vtk_to_numpy(data.GetPointData().GetArray("RGB")) == linear).all(), "input unchanged")
check(output.GetPointData().GetArray("Irradiance") is not None, "other arrays pass")
data.GetPointData().SetActiveScalars("Irradiance")
shown, errors, output = run(data)
check(errors == 0 and output.GetPointData().GetArray("Irradiance") is not None
      and np.abs(shown - srgb(linear)).max() < 4e-6, "other active scalars pass, too")

# What is wrong is told, and the picture is the input's.
broken = os.path.join(tempfile.mkdtemp(), "broken.ocio")
with open(broken, "w") as f:
    f.write("this is not a config")
for properties in (dict(ConfigFileName="/nowhere.ocio"), dict(ConfigFileName=broken),
                   dict(View="Pretty"), dict(SourceColorSpace="Klingon"), dict(Look="Noir"),
                   dict(Exposure=float("nan")), dict(OutputScalarType=12)):
    shown, errors, _ = run(image(linear), **properties)
    check(errors == 1 and (shown == linear).all(), "told and unchanged: %s" % properties)
shown, errors, _ = run(image(np.ones((3, 2), np.float32), "two"))
check(errors == 1, "two components are no colour")

os.environ["OCIO"] = "/nowhere/variable.ocio"
shown, errors, _ = run(image(linear))
check(errors == 1, "a missing $OCIO is told")
shown, errors, _ = run(image(linear), ConfigFileName="builtin")
check(errors == 0, "builtin does not look at $OCIO")
del os.environ["OCIO"]

f = vtkOpenColorIOImageFilter()
f.SetInputData(image(linear))
f.Update()
check((f.GetUsedConfig(), f.GetUsedSourceColorSpace(), f.GetUsedDisplay(), f.GetUsedView())
      == ("builtin", "Linear Rec.709", "sRGB", "Plain"), "what was used is told")
check(f.GetConfigDisplays() == "sRGB, Rec.1886, Display P3", "displays are listed")
check(f.GetConfigViews("sRGB") == "Plain, ACES, Raw", "views are listed")

# The colour-checker matrix that OpenImageIO applied to tahoe-tiny.tif to make tahoe-ccmatrix.tif.
tahoe = os.path.join(os.environ["RADIOMETRY_SHARED_DATA"], "ocio", "tahoe-tiny.tif")
if os.path.exists(tahoe):
    config = os.path.join(tempfile.mkdtemp(), "checker.ocio")
    with open(config, "w") as f:
        f.write("ocio_profile_version: 2\n"
                "roles: {default: plain, scene_linear: plain}\n"
                "displays: {screen: [!<View> {name: checker, colorspace: checker}]}\n"
                "colorspaces:\n"
                "  - !<ColorSpace> {name: plain}\n"
                "  - !<ColorSpace>\n"
                "    name: checker\n"
                "    from_scene_reference: !<MatrixTransform> {matrix: [0.805, -0.311, 0.506, 0,"
                " 0.506, 0.805, -0.311, 0, -0.311, 0.506, 0.805, 0, 0, 0, 0, 1]}\n")

    def read(name):
        reader = vtkTIFFReader()
        reader.SetFileName(name)
        reader.Update()
        return reader.GetOutput()

    expected = vtk_to_numpy(read(tahoe.replace("tiny", "ccmatrix")).GetPointData().GetScalars())
    shown, errors, _ = run(read(tahoe), ConfigFileName=config, SourceColorSpace="plain",
                           OutputScalarType=3)
    difference = np.abs(shown.astype(int) - expected)
    print("tahoe: greatest difference", difference.max(), "in", (difference > 0).mean())
    check(errors == 0 and difference.max() <= 1, "tahoe-ccmatrix is reproduced to one code value")
    check((difference > 0).mean() < 0.01, "and nearly everywhere exactly")
else:
    print("no", tahoe)

sys.exit(1 if FAILURES else 0)
