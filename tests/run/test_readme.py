# SPDX-License-Identifier: BSD-3-Clause
"""The README's snippets run as they stand (with a small scene for room.glb)."""
import os
import re
import subprocess
import sys
import tempfile

import tiny_scene
from front_end import PYTHON, require

SOURCE = os.environ["RADIOMETRY_SOURCE_DIR"]
with open(os.path.join(SOURCE, "README.md"), encoding="utf-8") as stream:
    TEXT = stream.read()
snippets = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)
require(len(snippets) == 2, "README has", len(snippets), "Python snippets")
for link in re.findall(r"\]\(([^)#:]+)\)", TEXT):
    require(os.path.exists(os.path.join(SOURCE, link)), "README links to", link)

CHECK = """
assert values.GetNumberOfTuples() == 1600 and errors.GetNumberOfTuples() == 1600
middle = max(values.GetTuple1(k) for k in range(1600))
assert abs(middle / 100.0 - 1.0) < 1e-3, middle  # 100 W/sr at 1 m
assert plan.GetNumberOfRows() > 0
"""
with tempfile.TemporaryDirectory() as folder:
    tiny_scene.write(os.path.join(folder, "room.gltf"))
    for interpreter, code in ((PYTHON, snippets[0] + CHECK), ("pvpython", snippets[1])):
        if interpreter == "pvpython" and not os.path.exists(
                os.path.join(os.environ["RADIOMETRY_BUILD_DIR"], "lib", "paraview")):
            continue
        script = os.path.join(folder, "snippet.py")
        with open(script, "w", encoding="utf-8") as stream:
            stream.write(code.replace("room.glb", "room.gltf"))
        done = subprocess.run([interpreter, script], cwd=folder, capture_output=True, text=True,
                              check=False)
        said = done.stdout + done.stderr
        require(done.returncode == 0 and "rror" not in said, interpreter, said)
sys.exit(0)
