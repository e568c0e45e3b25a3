# SPDX-License-Identifier: BSD-3-Clause
"""--work-plane and --dose: the numbers of a known light, the picture, the table, the report."""
import csv
import json
import os
import tempfile

import numpy as np
from matplotlib import image
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import tiny_scene
from front_end import listing, require, run


def bulb_only():
    """The tiny scene with its point light of 100 cd at (0.5, 1.5, 1.5) alone."""
    gltf = tiny_scene.document()
    gltf["nodes"] = [n for n in gltf["nodes"]
                     if n.get("extensions", {}).get("KHR_lights_punctual", {}).get("light", 0) == 0]
    gltf["scenes"] = [{"nodes": list(range(len(gltf["nodes"])))}]
    return gltf


with tempfile.TemporaryDirectory() as where:
    scene = tiny_scene.write(os.path.join(where, "tiny.gltf"), bulb_only())
    out = os.path.join(where, "out")
    done = run(scene, "-o", out, "--size", "320x200", "--no-radiosity", "--work-plane", 1.0,
               "--wall-zone", 0.2, "--grid-spacing", 0.2, "--dose", 60)
    require(done.returncode == 0, done.returncode, done.stderr)
    names = {os.path.basename(p) for p in listing(out)}
    require({"workplane.png", "workplane.csv"} <= names, names)

    with open(os.path.join(out, "workplane.csv"), encoding="utf-8") as stream:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(stream)]
    require(len(rows) == 64, "8 x 8 points on 1.6 m x 1.6 m, not", len(rows))
    for row in rows:
        across = np.hypot(row["X"] - 0.5, row["Z"] - 1.5)
        expected = 100.0 * 0.5 / (across**2 + 0.25)**1.5
        require(row["Y"] == 1.0 and 0.29 < row["X"] < 1.71 and 0.29 < row["Z"] < 1.71, row)
        require(abs(row["Illuminance"] / expected - 1.0) < 1e-6, row, expected)
        require(abs(row["LuminousExposure"] / (60.0 * expected) - 1.0) < 1e-6, row)
        require(abs(row["Dose"] * 683.002 / (60.0 * expected) - 1.0) < 1e-6, row)

    with open(os.path.join(out, "report.json"), encoding="utf-8") as stream:
        report = json.load(stream)
    plane = report["work_plane"]
    lux = [row["Illuminance"] for row in rows]
    stated = plane["statistics"][0]
    require(stated["Quantity"] == "Illuminance" and stated["Unit"] == "lx", stated)
    for name, value in (("Mean", np.mean(lux)), ("Minimum", min(lux)), ("Maximum", max(lux)),
                        ("U0", min(lux) / np.mean(lux)), ("Ud", min(lux) / max(lux)),
                        ("Points", 64)):
        require(abs(stated[name] / value - 1.0) < 1e-9, name, stated[name], value)
    require(plane["levels"] and all(row["Label"].endswith(" lx") for row in plane["levels"]), plane)
    for row in plane["levels"]:
        share = np.mean(np.array(lux) >= row["Isovalue"])
        require(abs(row["ShareAbove"] - share) < 1e-9, row, share)
    require("Work plane: mean" in done.stdout and "U0" in done.stdout, done.stdout)
    with open(os.path.join(out, "report.txt"), encoding="utf-8") as stream:
        require("Work plane" in stream.read(), "report.txt says nothing of the work plane")

    picture = image.imread(os.path.join(out, "workplane.png"))[:, :, :3]
    require(picture.shape[1] <= 320 and picture.shape[0] >= 100, picture.shape)
    require(picture.std() > 0.1, "an empty picture")

    reader = vtkXMLPolyDataReader()
    reader.SetFileName(os.path.join(out, "scene.vtp"))
    reader.Update()
    cells = reader.GetOutput().GetCellData()
    irradiance, dose = (vtk_to_numpy(cells.GetArray(n)) for n in ("Irradiance", "Dose"))
    require(np.allclose(dose, 60.0 * irradiance, rtol=1e-12), "dose on the surface")

    # With reflections the plane gets more; the surface's own values do not change.
    more = os.path.join(where, "more")
    done = run(scene, "-o", more, "--size", "64x64", "--work-plane", "-q", "--wall-zone", 0)
    require(done.returncode == 0 and done.stderr == "", done.stderr)
    plain = os.path.join(where, "plain")
    done = run(scene, "-o", plain, "--size", "64x64", "-q")
    require(done.returncode == 0, done.stderr)
    require("workplane.png" not in {os.path.basename(p) for p in listing(plain)}, "not asked for")
    values = []
    for folder in (more, plain):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(os.path.join(folder, "scene.vtp"))
        reader.Update()
        values.append(vtk_to_numpy(reader.GetOutput().GetCellData().GetArray("Radiosity")))
    require(values[0].tobytes() == values[1].tobytes(), "the grid changes the surface's values")

    # What cannot be: one line, and nothing written.
    for words, arguments in (("--work-plane", ["--work-plane", "high"]),
                             ("--dose", ["--dose", "-1"]),
                             ("sensors", ["--work-plane", "--grid-spacing", "1e-6"]),
                             ("--at", ["--at", "1,2,3"]),
                             ("--toward", ["--luminaire", "x.ies", "--toward", "1,2,3"]),
                             ("X,Y,Z", ["--luminaire", "x.ies", "--at", "1,2"]),
                             ("no such file", ["--luminaire", "x.ies", "--at", "-1,2,-3"])):
        bad = os.path.join(where, "bad")
        done = run(scene, "-o", bad, *arguments)
        require(done.returncode == 2 and words in done.stderr, arguments, done.stderr)
        require(listing(bad) is None, arguments, listing(bad))
