# SPDX-License-Identifier: BSD-3-Clause
"""The whole way on a small scene: every file is there and sound."""
import csv
import json
import math
import os
import re
import struct
import tempfile

import numpy as np
from matplotlib import image
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import tiny_scene
from vtkradiometry import options
from vtkradiometry.progress import foretell
from vtkradiometry import vtkOpenEXRReader
from front_end import exr_channels, exr_header, listing, require, run

FILES = {"scene.vtp", "scene.exr", "scene.png", "luminance.png", "falsecolor.png",
         "convergence.png", "convergence.csv", "report.txt", "report.json"}
SIZE = (320, 200)


def check_surface(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    surface = reader.GetOutput()
    cells = surface.GetCellData()
    values = {}
    for name in ("Irradiance", "IrradianceError", "Radiosity", "RadiosityError",
                 "DiffuseReflectance"):
        require(cells.HasArray(name), name, "is missing in scene.vtp")
        values[name] = vtk_to_numpy(cells.GetArray(name))
        require(np.isfinite(values[name]).all() and values[name].min() >= 0.0, name)
    require(values["Irradiance"].max() > 0.0, "no light in scene.vtp")
    # Nothing emits here: what leaves is the reflected part of what arrives.
    expected = values["DiffuseReflectance"] * values["Irradiance"]
    require(np.allclose(values["Radiosity"], expected, rtol=0.05, atol=0.02 * expected.mean()),
            "radiosity is not reflectance times irradiance")
    # The floor's mean illuminance without reflections is known for the point light alone, so at
    # least that much must arrive.
    names = [surface.GetFieldData().GetAbstractArray(k).GetName()
             for k in range(surface.GetFieldData().GetNumberOfArrays())]
    require({"Version", "Options", "Scene"} <= set(names), "field data:", names)
    return surface


def check_exr(path):
    attributes = exr_header(path)
    channels = exr_channels(attributes)
    for name in ("R", "G", "B", "Z", "N.X", "N.Y", "N.Z", "Irradiance.R", "IrradianceError.R",
                 "Radiosity.R", "RadiosityError.R"):
        require(name in channels, name, "is no channel of scene.exr:", sorted(channels))
    window = struct.unpack("<4i", attributes["dataWindow"][1])
    require((window[2] - window[0] + 1, window[3] - window[1] + 1) == SIZE, "size", window)
    chromaticities = struct.unpack("<8f", attributes["chromaticities"][1])
    require(np.allclose(chromaticities, (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290),
                        atol=1e-4), chromaticities)
    text = b" ".join(value for kind, value in attributes.values() if kind == "string").decode()
    require("W/m^2" in text or "W/m2" in text, "no unit among the attributes:", text)


def check_png(path, spread, brightest=0.95):
    picture = image.imread(path)
    require(picture.shape[:2] == SIZE[::-1], path, picture.shape)
    grey = picture[:, :, :3].mean(axis=2)
    require(0.05 < grey.mean() < brightest and grey.std() > spread, path, grey.mean(), grey.std())
    return picture


def check_legend(path):
    """The legend's bar: a column that runs through the colour map from bottom to top."""
    from matplotlib import colormaps

    picture = check_png(path, 0.05)[:, :, :3]
    wanted = colormaps["viridis"](np.linspace(1.0, 0.0, 9))[:, :3]
    columns = picture[:, int(0.80 * SIZE[0]):]
    for x in range(columns.shape[1]):
        column = columns[:, x]
        rows = [int(np.abs(column - colour).sum(axis=1).argmin()) for colour in wanted]
        close = [np.abs(column[row] - colour).sum() < 0.06 for row, colour in zip(rows, wanted)]
        if all(close) and rows == sorted(rows) and rows[-1] - rows[0] > 0.4 * SIZE[1]:
            break
    else:
        require(False, "no legend in", path)
    dark = (columns.max(axis=2) < 0.5).mean()
    require(dark > 0.005, "no text beside the legend in", path)


def check_luminance(folder):
    """Beside the picture its legend; brighter where the linear picture is."""
    shown = image.imread(os.path.join(folder, "luminance.png"))[:, :, :3]
    require(shown.shape[0] == SIZE[1] and shown.shape[1] > SIZE[0] + 40, shown.shape)
    linear = vtkOpenEXRReader()
    linear.SetFileName(os.path.join(folder, "scene.exr"))
    linear.Update()
    rgb = vtk_to_numpy(linear.GetOutput().GetPointData().GetScalars())[:, :3]
    luminance = (rgb @ [0.2126, 0.7152, 0.0722]).reshape(SIZE[1], SIZE[0])[::-1].ravel()
    green = shown[:, :SIZE[0], 1].ravel()  # of viridis: rises with the value
    seen = luminance > 0.0
    dim, bright = np.quantile(luminance[seen], [0.2, 0.8])
    require(green[luminance > bright].mean() > green[seen & (luminance < dim)].mean() + 0.1,
            "luminance.png does not follow the picture")


def check_report(folder):
    with open(os.path.join(folder, "report.json"), encoding="utf-8") as stream:
        report = json.load(stream)
    require([c["name"] for c in report["computations"]] == ["Irradiance", "Radiosity"], "names")
    for computation in report["computations"]:
        require(computation["effect_plan"], "no effect plan")
        for row in computation["effect_plan"]:
            require({"Effect", "Decision", "Bound", "Unit"} <= set(row), row)
        require(computation["convergence"], "no convergence record")
        require(computation["seconds"] > 0.0, "no time")
    for name in ("Irradiance", "Radiosity"):
        require(report["statistics"][name], "no statistics of", name)
    flux = {row["Array"]: row["W per band"] for row in report["flux"]}
    require(all(0.0 < out < into for out, into in zip(flux["Radiosity"], flux["Irradiance"])), flux)
    require(report["assumptions"] and report["versions"]["vtkRadiometry"], "assumptions, versions")
    require(len(report["scene"]["lights"]) == 3, report["scene"])
    with open(os.path.join(folder, "report.txt"), encoding="utf-8") as stream:
        text = stream.read()
    for words in ("What was simulated", "Statistics", "Time", "Flux", "bulb"):
        require(words in text, words, "is not in report.txt")
    require(max(map(len, text.split("\n"))) <= 160, "report.txt has very long lines")


def check_csv(path):
    with open(path, encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    require({row["Computation"] for row in rows} == {"Irradiance", "Radiosity"}, rows)
    for row in rows:
        require(float(row["Seconds"]) >= 0.0, row)
        require(math.isfinite(float(row["EstimatedError"])), row)


def check_study(folder, said):
    """A row a run, the picture, and both in the report; the plan beside it. The reference is the
    surface of an earlier run."""
    with open(os.path.join(folder, "study.csv"), encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    require([float(row["RelativeTolerance"]) for row in rows] == [0.3, 0.1], rows)
    require(all(0.0 <= float(row["TrueError"]) < 0.3 for row in rows), rows)
    require({row["Reference"] for row in rows} == {"the reference that was given"}, rows)
    require(all(0.0 < float(row["EstimatedError"]) < 0.3 for row in rows), rows)
    check_png(os.path.join(folder, "study.png"), 0.02, 0.99)
    for words in ("Study of Radiosity", "30 %", "seconds to", "slope", "effects on: ",
                  "input in single precision", "Radiosity: what the scene calls for",
                  "not needed: "):
        require(words in said, words, "is not said:", said)
    require(re.search(r"\n  Interreflection +simulated +\w", said), "no line of an effect:", said)
    with open(os.path.join(folder, "report.txt"), encoding="utf-8") as stream:
        require("Accuracy study" in stream.read(), "no study in report.txt")
    with open(os.path.join(folder, "report.json"), encoding="utf-8") as stream:
        require(len(json.load(stream)["study"]["runs"]) == 2, "no study in report.json")


class Foretold:
    """What a filter says before it runs."""

    def __init__(self, seconds, budget, tolerance=0.01):
        self.numbers = seconds, budget, tolerance

    def GetPredictedSeconds(self):
        return self.numbers[0]

    def GetTimeBudget(self):
        return self.numbers[1]

    def GetRelativeTolerance(self):
        return self.numbers[2]


for foretold, words in ((Foretold(12.3, 0.0), "about 12 s to 1 %"),
                        (Foretold(3.21, 15.0, 0.005), "about 3.2 s to 0.5 %"),
                        (Foretold(15.0, 15.0), "about 15 s, the time budget, which ends it before "
                                               "1 % everywhere")):
    require(foretell(foretold) == words, foretell(foretold), words)
for text, wanted in (("0.1,0.02", ("tolerances", [0.1, 0.02])), ("1s, 5s", ("budgets", [1.0, 5.0]))):
    require(options.parse(["--study", text]).study == wanted, text)
require(options.parse(["--study", "1s"]).study_tolerance == options.FINEST, "tolerance of budgets")
require(options.parse(["--study", "1s", "--tolerance", "0.1"]).study_tolerance == 0.1, "as given")
require(options.parse(["--study"]).study == ("tolerances", []), "no list")
require(options.parse([]).study is None, "no study")

with tempfile.TemporaryDirectory() as where:
    for wrong in ("room.glb", "0.1,1s", "2", "0", "0s", "nan", ""):
        done = run(os.path.join(where, "tiny.gltf"), "--study", wrong)
        require(done.returncode == 2 and "--study" in done.stderr, wrong, done.stderr)
    scene = tiny_scene.write(os.path.join(where, "tiny.gltf"))
    out = os.path.join(where, "new", "results")
    done = run(scene, "--output", out, "--size", f"{SIZE[0]}x{SIZE[1]}", "--max-edge", 0.3)
    require(done.returncode == 0, done.returncode, done.stderr, done.stdout)
    require({os.path.basename(p) for p in listing(out)} == FILES, listing(out))
    for name in FILES:
        require(name in done.stdout, name, "is not announced:", done.stdout)
    check_surface(os.path.join(out, "scene.vtp"))
    check_exr(os.path.join(out, "scene.exr"))
    check_png(os.path.join(out, "scene.png"), 0.05)
    check_luminance(out)
    check_legend(os.path.join(out, "falsecolor.png"))
    check_png(os.path.join(out, "convergence.png"), 0.02, 0.99)  # lines on white
    check_csv(os.path.join(out, "convergence.csv"))
    check_report(out)

    # The same again: the surface's values are the same bytes, with other numbers of threads too.
    again = os.path.join(where, "again")
    done = run(scene, "--output", again, "--size", "320x200", "--max-edge", 0.3, "--threads", 1,
               "--quiet", "--study", "0.1,0.3", "--study-float",
               "--study-reference", os.path.join(out, "scene.vtp"))
    check_study(again, done.stdout)
    require(done.returncode == 0 and done.stderr == "", done.returncode, done.stderr)
    first, second = (check_surface(os.path.join(f, "scene.vtp")) for f in (out, again))
    for name in ("Irradiance", "Radiosity", "RadiosityError"):
        one, other = (vtk_to_numpy(s.GetCellData().GetArray(name)) for s in (first, second))
        require(one.tobytes() == other.tobytes(), name, "depends on the number of threads")
