# SPDX-License-Identifier: BSD-3-Clause
"""vtkOpenEXRWriter and vtkOpenEXRReader from Python: names, orientation, types, units, errors."""
import os
import shutil
import subprocess
import sys
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray, vtkStringArray
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet, vtkImageData, vtkMultiBlockDataSet, vtkPolyData)
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer

from vtkradiometry import vtkOpenEXRReader, vtkOpenEXRWriter

WIDTH, HEIGHT = 23, 17
FOLDER = tempfile.mkdtemp()
FAILURES = []


def check(condition, what):
    if not condition:
        FAILURES.append(what)
        print("FAILED:", what)


def image(**arrays):
    result = vtkImageData()
    result.SetDimensions(WIDTH, HEIGHT, 1)
    for name, values in arrays.items():
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        array.SetName(name)
        result.GetPointData().AddArray(array)
    return result


def write(data, name, prepare=None, **properties):
    """Errors told and what Write returned."""
    writer = vtkOpenEXRWriter()
    errors = []
    writer.AddObserver("ErrorEvent", lambda *_: errors.append(1))
    writer.SetInputDataObject(data)
    writer.SetFileName(os.path.join(FOLDER, name))
    for key, value in properties.items():
        getattr(writer, "Set" + key)(value)
    if prepare:
        prepare(writer)
    return len(errors) if writer.Write() == 1 else -max(1, len(errors))


def read(name, **properties):
    reader = vtkOpenEXRReader()
    errors = []
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(1))
    reader.SetFileName(os.path.join(FOLDER, name))
    for key, value in properties.items():
        getattr(reader, "Set" + key)(value)
    reader.Update()
    output = reader.GetOutput()
    arrays = {}
    for i in range(output.GetPointData().GetNumberOfArrays()):
        array = output.GetPointData().GetArray(i)
        arrays[array.GetName()] = vtk_to_numpy(array)
    return arrays, output, len(errors)


def field(output, name):
    array = output.GetFieldData().GetAbstractArray(name)
    if array is None:
        return None
    values = [array.GetValue(i) for i in range(array.GetNumberOfValues())]
    return values[0] if len(values) == 1 else values


random = np.random.default_rng(5)
n = WIDTH * HEIGHT
rgb = random.normal(size=(n, 3)).astype(np.float32)
normal = random.normal(size=(n, 3)).astype(np.float32)
depth = np.arange(n, dtype=np.float64)
irradiance = (random.random((n, 3)) * 1e5).astype(np.float32)
spectrum = random.random((n, 5)).astype(np.float32)
cell = np.arange(n, dtype=np.int64) * 10_000_019 % 4294967291
signed = np.arange(n, dtype=np.int32) - 5

data = image(RGB=rgb, N=normal, Z=depth, Irradiance=irradiance, Spectrum=spectrum, Cell=cell,
             Signed=signed)
data.GetPointData().GetArray("Irradiance").GetInformation().Set(
    vtkDataArray.UNITS_LABEL(), "W/m^2")
version = vtkStringArray()
version.SetName("version of the project")
version.InsertNextValue("0.1.0")
data.GetFieldData().AddArray(version)
numbers = numpy_to_vtk(np.array([0.01]), deep=True)
numbers.SetName("RelativeTolerance")
data.GetFieldData().AddArray(numbers)


def attributes(writer):
    writer.AddAttribute("Z.units", "m")
    writer.AddAttribute("Exposure", 1.5)


check(write(data, "all.exr", attributes, WhiteLuminance=100.0,
            AdoptedNeutral=(0.3127, 0.3290)) == 0, "writing works")
arrays, output, errors = read("all.exr")
check(errors == 0 and output.GetDimensions() == (WIDTH, HEIGHT, 1), "reading works")
check(set(arrays) == {"RGB", "N", "Z", "Irradiance", "Spectrum", "Cell", "Signed"},
      "names come back: %s" % sorted(arrays))
for name, values in (("RGB", rgb), ("N", normal), ("Irradiance", irradiance),
                     ("Spectrum", spectrum), ("Z", depth), ("Signed", signed)):
    check((arrays[name] == values).all(), name + " comes back exactly and the right way up")
check(arrays["Cell"].dtype == np.uint32 and (arrays["Cell"] == cell).all(), "integers as uint")
check(output.GetPointData().GetScalars().GetName() == "RGB", "RGB are the active scalars")
check(field(output, "Z.units") == "m" and field(output, "Irradiance.units") == "W/m^2", "units")
unit = output.GetPointData().GetArray("Irradiance").GetInformation().Get(
    vtkDataArray.UNITS_LABEL())
check(unit == "W/m^2", "the unit is the array's again")
check(field(output, "Exposure") == 1.5 and field(output, "RelativeTolerance") == 0.01, "numbers")
check(field(output, "version of the project") == "0.1.0", "field data become attributes")
check(np.allclose(field(output, "chromaticities"),
                  [0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329]), "chromaticities")
check(field(output, "whiteLuminance") == 100.0, "whiteLuminance")
check(np.allclose(field(output, "adoptedNeutral"), [0.3127, 0.3290]), "adoptedNeutral")

# A second round changes nothing: what the reader makes, the writer takes.
check(write(output, "again.exr") == 0, "the reader's output can be written")
arrays2, output2, errors = read("again.exr")
check(all((arrays[k] == arrays2[k]).all() for k in arrays), "a second round is the same")
check(field(output2, "chromaticities") == field(output, "chromaticities"), "attributes too")

# The first row of VTK is the lowest line of the file, as another program sees it.
ramp = np.repeat(np.arange(HEIGHT, dtype=np.float32), WIDTH)
check(write(image(Y=ramp), "ramp.exr", Compression=0) == 0, "uncompressed")
content = open(os.path.join(FOLDER, "ramp.exr"), "rb").read()
last = np.frombuffer(content[-4 * WIDTH:], "<f4")
check((last == 0.0).all(), "row 0 is written last, at the bottom")
if shutil.which("exrheader"):
    header = subprocess.run(["exrheader", os.path.join(FOLDER, "all.exr")], capture_output=True,
                            text=True, check=False)
    check(header.returncode == 0 and "N.X, 32-bit floating-point" in header.stdout
          and "Irradiance.G" in header.stdout and "chromaticities" in header.stdout,
          "exrheader reads it")

# Names.
data = image(Colours=rgb)
data.GetPointData().SetActiveScalars("Colours")
check(write(data, "names.exr") == 0 and "RGB" in read("names.exr")[0], "active scalars are RGB")
rgba = np.hstack([rgb, np.ones((n, 1), np.float32)])
check(write(image(RGBA=rgba), "names.exr") == 0, "RGBA")
check((read("names.exr")[0]["RGBA"] == rgba).all(), "RGBA comes back as one")
spectral = image(Flux=irradiance)
for i, name in enumerate(("450nm", "550nm", "650nm")):
    spectral.GetPointData().GetArray("Flux").SetComponentName(i, name)
check(write(spectral, "names.exr") == 0 and "Flux.550nm" in read("names.exr")[0],
      "components keep their names")
check(field(read("names.exr")[1], "chromaticities") is None, "no R, G, B: no chromaticities")
check(write(image(Normals=normal), "names.exr") == 0 and "N" in read("names.exr")[0], "Normals")
codes = random.integers(0, 256, (n, 3)).astype(np.uint8)
check(write(image(RGB=codes), "names.exr") == 0
      and np.allclose(read("names.exr")[0]["RGB"], codes / 255.0), "bytes count as 0 to 1")

# Types and packing.
check(write(image(RGB=rgb, Z=depth), "types.exr", lambda w: w.SetArrayPixelType("Z", 1),
            PixelType=0, Compression=4, TileSize=8) == 0, "half, PIZ, tiles")
arrays, _, _ = read("types.exr")
check(np.abs(arrays["RGB"] - rgb).max() < 4e-3 and (arrays["RGB"] != rgb).any(), "half rounds")
check((arrays["Z"] == depth).all(), "one array kept as float")

# Windows.
check(write(image(Z=depth), "windows.exr", DataWindowOrigin=(10, 20),
            DisplayWindow=(0, 0, 99, 79)) == 0, "windows")
_, output, _ = read("windows.exr")
check(field(output, "dataWindow") == [10, 20, 10 + WIDTH - 1, 20 + HEIGHT - 1], "data window")
check(output.GetOrigin() == (10.0, 79.0 - (20 + HEIGHT - 1), 0.0), "origin from the lower left")

# What the reader made is written in the same place again.
check(write(output, "windows2.exr") == 0, "windows again")
_, again, _ = read("windows2.exr")
check(field(again, "dataWindow") == field(output, "dataWindow")
      and field(again, "displayWindow") == field(output, "displayWindow"), "windows are kept")

# Several parts: inputs, blocks, names, views, sizes of their own.
writer = vtkOpenEXRWriter()
writer.SetFileName(os.path.join(FOLDER, "parts.exr"))
small = vtkImageData()
small.SetDimensions(5, 4, 1)
small_z = numpy_to_vtk(np.arange(20, dtype=np.float32), deep=True)
small_z.SetName("Z")
small.GetPointData().AddArray(small_z)
for part in (image(RGB=rgb), image(RGB=2 * rgb), small):
    trivial = vtkTrivialProducer()
    trivial.SetOutput(part)
    writer.AddInputConnection(trivial.GetOutputPort())
writer.SetPartName(0, "rgb.left")
writer.SetPartView(0, "left")
writer.SetPartName(1, "rgb.right")
writer.SetPartView(1, "right")
check(writer.Write() == 1, "three inputs")
reader = vtkOpenEXRReader()
reader.SetFileName(os.path.join(FOLDER, "parts.exr"))
reader.UpdateInformation()
check([reader.GetPartName(i) for i in range(reader.GetNumberOfParts())]
      == ["rgb.left", "rgb.right", "part2"], "three parts and their names")
left, output, _ = read("parts.exr")
check((left["RGB"] == rgb).all() and field(output, "view") == "left"
      and field(output, "name") == "rgb.left", "the first part")
right, output, _ = read("parts.exr", PartName="rgb.right")
check((right["RGB"] == 2 * rgb).all() and field(output, "view") == "right", "a part by name")
last, output, _ = read("parts.exr", Part=2)
check((last["Z"] == np.arange(20)).all() and output.GetDimensions() == (5, 4, 1), "a small part")
check(field(output, "displayWindow") == [0, 0, WIDTH - 1, HEIGHT - 1], "one display window")
check(read("parts.exr", PartName="nobody")[2] > 0, "no part of that name")
check(read("parts.exr", Part=3)[2] > 0, "no fourth part")

blocks = vtkMultiBlockDataSet()
for i, (name, part) in enumerate((("beauty", image(RGB=rgb)), ("data", image(Z=depth)))):
    blocks.SetBlock(i, part)
    blocks.GetMetaData(i).Set(vtkCompositeDataSet.NAME(), name)
check(write(blocks, "blocks.exr", lambda w: w.SetArrayPixelType("Z", 0), TileSize=16) == 0,
      "composite data")
check((read("blocks.exr", PartName="beauty")[0]["RGB"] == rgb).all()
      and np.abs(read("blocks.exr", PartName="data")[0]["Z"] - depth).max() <= 0.13,
      "blocks are parts")
blocks.GetMetaData(1).Set(vtkCompositeDataSet.NAME(), "beauty")
check(write(blocks, "twice.exr") < 0 and not os.path.exists(os.path.join(FOLDER, "twice.exr")),
      "two parts of one name")
blocks.SetBlock(1, vtkPolyData())
check(write(blocks, "twice.exr") < 0, "a block that is no image")
check(write(vtkMultiBlockDataSet(), "twice.exr") < 0, "no block at all")

# DWA: the level counts.
waves = (2 + np.sin(0.3 * np.arange(n))).astype(np.float32)
sizes = []
for level in (0, 45, 1000):
    check(write(image(RGB=np.repeat(waves[:, None], 3, 1)), "dwa.exr", PixelType=0, Compression=8,
                DwaCompressionLevel=level) == 0, "DWAA")
    sizes.append(os.path.getsize(os.path.join(FOLDER, "dwa.exr")))
check(sizes[0] >= sizes[1] >= sizes[2] and sizes[0] > sizes[2], "a level packs more: %s" % sizes)

# Colours by the file's chromaticities.
xyz = [1, 0, 0, 1, 0, 0, 1 / 3, 1 / 3]
check(write(image(RGB=np.tile(np.float32([0.9505, 1, 1.089]), (n, 1))), "xyz.exr",
            Chromaticities=xyz) == 0, "other chromaticities")
arrays, output, _ = read("xyz.exr", ColorSpace=1)
check(np.abs(arrays["RGB"] - 1).max() < 1e-3, "D65 is white in Rec.709")
check(np.allclose(field(output, "chromaticities"),
                  [0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329]), "and says so")
check((read("xyz.exr")[0]["RGB"][0] == np.float32([0.9505, 1, 1.089])).all(), "or as stored")

# What is wrong is told, and nothing is written.
bad = depth.copy()
bad[40] = np.nan
check(write(image(Z=bad), "bad.exr") < 0, "NaN is an error")
check(not os.path.exists(os.path.join(FOLDER, "bad.exr")), "and nothing is written")
check(write(image(Z=bad), "bad.exr", KeepNonFinite=True) == 0, "NaN is kept on request")
check(np.isnan(read("bad.exr")[0]["Z"][40]), "and comes back")
check(read("bad.exr", KeepNonFinite=False)[2] > 0, "a strict reader refuses it")
check(write(image(Z=depth * 1e6), "bad.exr", PixelType=0) < 0, "too much for half")
check(not np.isfinite(read("bad.exr")[0]["Z"]).all(), "and the old file is still there")
check(write(image(), "none.exr") < 0, "no arrays")
deep = vtkImageData()
deep.SetDimensions(3, 3, 3)
check(write(deep, "none.exr") < 0, "three slices")
check(write(image(Z=depth), "no/such/folder.exr") < 0, "no folder")
check(write(image(Z=depth), "none.exr",
            lambda w: w.AddAttribute("dataWindow", "mine")) < 0, "a name of the format's own")
check(not [f for f in os.listdir(FOLDER) if "none" in f or "tmp" in f], "nothing is left")
for name in ("missing.exr", "../../nowhere"):
    _, output, errors = read(name)
    check(errors > 0 and output.GetNumberOfPoints() == 0, "missing: error and empty")
with open(os.path.join(FOLDER, "cut.exr"), "wb") as f:
    f.write(content[: len(content) // 2])
_, output, errors = read("cut.exr")
check(errors > 0 and output.GetPointData().GetNumberOfArrays() == 0, "cut short: error and empty")
check(read("all.exr", Part=1)[2] > 0, "no second part")
check(vtkOpenEXRReader().CanReadFile(os.path.join(FOLDER, "all.exr")) == 1, "CanReadFile")
check(vtkOpenEXRReader().CanReadFile(__file__) == 0, "this is no picture")

shared = os.path.join(os.environ["RADIOMETRY_SHARED_DATA"], "exr")
if os.path.isdir(shared):
    arrays, _, _ = read(os.path.join(shared, "Chromaticities", "Rec709_YC.exr"))
    check(set(arrays) == {"RGB"}, "luminance and chroma are read as RGB")
    looks = {}
    for name in ("Rec709", "Rec709_YC", "XYZ", "XYZ_YC"):
        looks[name] = read(os.path.join(shared, "Chromaticities", name + ".exr"),
                           ColorSpace=1)[0]["RGB"]
    for name, most in (("XYZ", 1e-3), ("Rec709_YC", 0.03), ("XYZ_YC", 0.03)):
        off = np.abs(looks[name] - looks["Rec709"]).mean() / np.abs(looks["Rec709"]).mean()
        check(off < most, "%s looks like Rec709: %g" % (name, off))
    _, output, errors = read(os.path.join(shared, "Trunks.exr"))
    check(errors > 0 and output.GetNumberOfPoints() == 0, "deep data are refused")
    arrays, output, errors = read(os.path.join(shared, "TestImages", "AllHalfValues.exr"))
    check(errors == 0 and np.isnan(arrays["RGB"]).any(), "NaN of a real file")
else:
    print("no", shared)

shutil.rmtree(FOLDER)
sys.exit(1 if FAILURES else 0)
