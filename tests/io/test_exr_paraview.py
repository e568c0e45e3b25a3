# SPDX-License-Identifier: BSD-3-Clause
"""In ParaView: SaveData writes .exr, OpenDataFile reads it, OpenColorIO Transform shows it."""
import os
import shutil
import sys
import tempfile

import numpy as np
from paraview import simple
from paraview.vtk.util.numpy_support import vtk_to_numpy

simple.LoadPlugin(os.path.join(os.environ["PV_PLUGIN_PATH"], "Radiometry.so"), remote=False,
                  ns=globals())
os.environ.pop("OCIO", None)
folder = tempfile.mkdtemp()
failures = []


def check(condition, what):
    if not condition:
        failures.append(what)
        print("FAILED:", what)


def points(source):
    source.UpdatePipeline()
    data = source.GetClientSideObject().GetOutputDataObject(0).GetPointData()
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i))
            for i in range(data.GetNumberOfArrays())}


wavelet = simple.Wavelet(WholeExtent=[0, 12, 0, 8, 0, 0])
colour = simple.Calculator(Input=wavelet, ResultArrayName="RGB",
                           Function="RTData*iHat/500+RTData*jHat/900+0.2*kHat")
before = points(colour)
path = os.path.join(folder, "picture.exr")
simple.SaveData(path, proxy=colour, Compression="PIZ", Attributes=["RTData.units", "W/m^2"])
check(os.path.exists(path), "SaveData writes .exr")

reader = simple.OpenDataFile(path)
check(reader is not None and reader.GetXMLName() == "OpenEXRReader", "OpenDataFile reads .exr")
after = points(reader)
check(set(after) == {"RGB", "RTData"}, "the arrays: %s" % sorted(after))
check((after["RTData"] == before["RTData"]).all(), "a float array exactly")
check((after["RGB"] == before["RGB"].astype(np.float32)).all(), "the colours")
data = reader.GetClientSideObject().GetOutputDataObject(0)
check(data.GetFieldData().GetAbstractArray("RTData.units").GetValue(0) == "W/m^2", "attributes")

group = simple.GroupDatasets(Input=[colour, wavelet])
parts = os.path.join(folder, "parts.exr")
simple.SaveData(parts, proxy=group, ArrayPixelTypes=["RTData", "0"])
second = simple.OpenDataFile(parts)
second.Part = 1
parted = points(second)
check(set(parted) == {"RTData"}, "a group becomes parts: %s" % sorted(parted))
check(np.abs(parted["RTData"] - before["RTData"]).max() < 0.13
      and (parted["RTData"] != before["RTData"]).any(), "one array as half")
second.Part = 0
second.ColorSpace = "Linear Rec.709"
check("RGB" in points(second), "the first part")
simple.Delete(second)

shown = simple.OpenColorIOTransform(Input=reader, Colors=["POINTS", "RGB"], Exposure=1.0,
                                    Display="sRGB", View="Plain")
encoded = points(shown)["RGB"]
linear = 2 * after["RGB"].astype(float)
check(np.abs(encoded - np.where(linear <= 0.0030399346, 12.92321018 * linear,
                                1.055 * linear ** (1 / 2.4) - 0.055)).max() < 1e-5, "plain sRGB")
shown.OutputScalarType = "Unsigned Char"
check(points(shown)["RGB"].dtype == np.uint8, "as bytes")
simple.SaveData(os.path.join(folder, "picture.png"), proxy=shown)
check(os.path.exists(os.path.join(folder, "picture.png")), "and as a PNG")

state = os.path.join(folder, "state.pvsm")
simple.SaveState(state)
simple.ResetSession()
simple.LoadState(state)
again = simple.FindSource("OpenColorIOTransform1")
check(again is not None and again.Exposure == 1.0 and again.View == "Plain", "state")

shutil.rmtree(folder)
sys.exit(1 if failures else 0)
