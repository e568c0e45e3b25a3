# SPDX-License-Identifier: BSD-3-Clause
"""--sky, --sky-map and --sun: on open ground every sky gives the illuminance that was asked for, the
sun its share by the sine of its altitude, and the picture shows the sky."""
import json
import math
import os
import tempfile

import numpy as np
import vtkmodules.all as vtk
from vtkmodules.util.numpy_support import numpy_to_vtk

import tiny_scene
from front_end import listing, require, run
from vtkradiometry import sky, vtkEnvironmentLightSource, vtkOpenEXRWriter
from vtkradiometry.lights import Lights


def ground_only():
    """The tiny scene's floor and its camera, without lights."""
    gltf = tiny_scene.document(lights=False)
    gltf["nodes"] = [n for n in gltf["nodes"] if n.get("name") == "floor" or "camera" in n]
    gltf["scenes"] = [{"nodes": list(range(len(gltf["nodes"])))}]
    return gltf


def hemisphere(axis, n=400):
    """Midpoints of equal steps of azimuth and of cos^2: equal parts of projected solid angle."""
    azimuth = 2 * np.pi * (np.arange(n) + 0.5) / n
    sine = np.sqrt((np.arange(n) + 0.5) / n)  # of the angle from the axis
    s, a = (v.ravel() for v in np.meshgrid(sine, azimuth))
    local = np.column_stack([s * np.cos(a), s * np.sin(a), np.sqrt(1 - s * s)])
    first = np.cross(axis, [1.0, 0.0, 0.0] if abs(axis[0]) < 0.9 else [0.0, 1.0, 0.0])
    first = first / np.linalg.norm(first)
    return local @ np.stack([first, np.cross(axis, first), axis])


# What the picture shows is what lights: the integral of its radiance is the illuminance.
for preset in range(4):
    source = vtkEnvironmentLightSource()
    source.SetPreset(preset)
    source.SetUpDirection(0, 1, 0)
    source.SetNorthDirection(0, 0, -1)
    source.SetSunAltitude(35)
    source.SetSunAzimuth(100)
    source.SetIntensity(10000)
    source.SetGroundReflectance(0.2)
    source.Update()
    light = Lights(source.GetOutput())
    up = np.array([0.0, 1.0, 0.0])
    lux = 683.002 * np.pi * sky.radiance(light, hemisphere(up)).mean()
    require(abs(lux / 10000 - 1) < 2e-3, "sky", preset, "gives", lux)
    below = sky.radiance(light, np.array([[0.0, -1.0, 0.0]]))[0, 0] * 683.002
    expected = 10000 / math.pi * (1.0 if preset == 0 else 0.2)
    require(abs(below / expected - 1) < 1e-6, "ground", preset, below, expected)
    sun = np.array([math.cos(math.radians(35)) * math.sin(math.radians(100)),
                    math.sin(math.radians(35)),
                    -math.cos(math.radians(35)) * math.cos(math.radians(100))])
    if preset >= 2:
        toward, away = sky.radiance(light, np.array([sun, sun * [-1, 1, -1]]))[:, 0]
        require(toward > 1.5 * away, "brighter around the sun", preset, toward, away)

with tempfile.TemporaryDirectory() as where:
    scene = tiny_scene.write(os.path.join(where, "ground.gltf"), ground_only())

    def mean(*arguments):
        """The mean illuminance on a plane over the ground, and the report."""
        out = os.path.join(where, "out")
        done = run(scene, "-o", out, "--size", "64x64", "-q", "--no-radiosity", "--max-edge", 0.5,
                   "--work-plane", 0.5, "--tolerance", 0.01, *arguments)
        require(done.returncode == 0, done.stderr)
        with open(os.path.join(out, "report.json"), encoding="utf-8") as stream:
            report = json.load(stream)
        row = report["work_plane"]["statistics"][0]
        require(abs(row["U0"] - 1) < 0.02, "open ground is even", row)
        return row["Mean"], report

    for kind in ("uniform", "overcast"):
        value, report = mean("--sky", kind, "--sky-illuminance", 5000)
        require(abs(value / 5000 - 1) < 0.01, kind, value)
        require(report["scene"]["lights"][0]["Kind"] == "environment", report["scene"])
        require(any(words.startswith("Sky:") for words in report["assumptions"]), report)
    value, _ = mean("--sky", "clear", "--sun", "30,135")
    require(abs(value / (10000 + 80000 * 0.5) - 1) < 0.01, "clear with sun", value)
    value, _ = mean("--sky", "clear", "--sun", "30,135", "--sun-illuminance", 0)
    require(abs(value / 10000 - 1) < 0.01, "clear without sun", value)
    value, report = mean("--sun", "30,135")
    require(abs(value / 40000 - 1) < 1e-6, "sun alone", value)
    # 135 degrees from north over east: the light travels to the north-west, -X and -Z in glTF.
    direction = report["scene"]["lights"][0]["Direction"]
    require(np.allclose(direction, [-math.sqrt(3 / 8), -0.5, -math.sqrt(3 / 8)]), direction)

    # A map that is 2 W/(m2 sr) everywhere: pi times that.
    image = vtk.vtkImageData()
    image.SetDimensions(16, 8, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(np.full((128, 3), 2.0, np.float32), deep=True))
    writer = vtkOpenEXRWriter()
    writer.SetInputData(image)
    writer.SetFileName(os.path.join(where, "even.exr"))
    writer.Write()
    value, _ = mean("--sky-map", os.path.join(where, "even.exr"))
    require(abs(value / (2 * math.pi * 683.002) - 1) < 0.01, "map", value)

    for words, arguments in (("--sun", ["--sky", "clear"]), ("altitude", ["--sun", "95,0"]),
                             ("--sky-map", ["--sky", "overcast", "--sky-map", "x.exr"]),
                             ("x.exr", ["--sky-map", "x.exr"]),
                             ("--ground-reflectance", ["--ground-reflectance", "1.5"])):
        bad = os.path.join(where, "bad")
        done = run(scene, "-o", bad, *arguments)
        require(done.returncode == 2 and words in done.stderr, arguments, done.stderr)
        require(listing(bad) is None, arguments, listing(bad))
