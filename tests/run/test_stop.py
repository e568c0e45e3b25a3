# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C while it computes: exit status 130, nothing left behind, results of before untouched."""
import os
import signal
import subprocess
import tempfile
import threading
import time

import tiny_scene
from front_end import PYTHON, listing, require



def crowded():
    """The tiny scene under thousands of lights: direct light that takes minutes."""
    gltf = tiny_scene.document()
    lights = gltf["extensions"]["KHR_lights_punctual"]["lights"]
    for k in range(1500):
        lights.append({"type": "point", "intensity": 1.0})
        gltf["nodes"].append({"translation": [0.1 + 0.0012 * k, 1.0, 1.9 - 0.0012 * k],
                              "extensions": {"KHR_lights_punctual": {"light": len(lights) - 1}}})
    gltf["scenes"] = [{"nodes": list(range(len(gltf["nodes"])))}]
    return gltf


# (stage to stop in, scene, options that make this stage run for minutes)
CASES = (
    ("Irradiance", crowded(), ["--max-edge", "0.04"]),
    ("Radiosity", tiny_scene.document(), ["--max-edge", "0.015", "--tolerance", "1e-7"]),
)
with tempfile.TemporaryDirectory() as where:
    for stage, gltf, options in CASES:
        scene = tiny_scene.write(os.path.join(where, stage + ".gltf"), gltf)
        out = os.path.join(where, "out-" + stage)
        process = subprocess.Popen(
            [PYTHON, "-m", "vtkradiometry", scene, "--output", out, *options],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        watchdog = threading.Timer(100.0, process.kill)  # a stage that never comes fails below
        watchdog.start()
        seen = []
        for line in process.stderr:
            seen.append(line)
            if line.startswith(stage):
                break
        time.sleep(0.5)
        require(process.poll() is None, stage, "was over before it could be stopped", seen)
        begin = time.monotonic()
        process.send_signal(signal.SIGINT)
        rest, said = process.communicate(timeout=60)
        took = time.monotonic() - begin
        watchdog.cancel()
        require(process.returncode == 130, stage, process.returncode, rest, said)
        require("Traceback" not in said, said)
        require(listing(out) is None, stage, "left", listing(out))
        print(f"{stage}: stopped after {took:.2f} s")
