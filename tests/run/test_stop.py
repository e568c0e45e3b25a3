# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C while it computes: exit status 130, nothing left behind, results of before untouched."""
import os
import signal
import subprocess
import tempfile
import time

import tiny_scene
from front_end import PYTHON, listing, require

with tempfile.TemporaryDirectory() as where:
    scene = tiny_scene.write(os.path.join(where, "tiny.gltf"))
    for stage in ("Irradiance", "Radiosity"):
        out = os.path.join(where, "out-" + stage)
        # Fine enough to run for minutes if nobody stopped it.
        edge = {"Irradiance": "0.004", "Radiosity": "0.02"}[stage]
        process = subprocess.Popen(
            [PYTHON, "-m", "vtkradiometry", scene, "--output", out, "--tolerance", "1e-6",
             "--max-edge", edge],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
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
        require(process.returncode == 130, stage, process.returncode, rest, said)
        require("Traceback" not in said, said)
        require(listing(out) is None, stage, "left", listing(out))
        print(f"{stage}: stopped after {took:.2f} s")
