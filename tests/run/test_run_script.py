# SPDX-License-Identifier: BSD-3-Clause
"""The scripts: a build with nothing to do does nothing; ./run passes scripts to Python."""
import glob
import os
import subprocess
import sys
import tempfile

from front_end import require

SOURCE = os.environ["RADIOMETRY_SOURCE_DIR"]
BUILD = os.environ["RADIOMETRY_BUILD_DIR"]
ENVIRONMENT = {**os.environ, "VTKRADIOMETRY_BUILD_DIR": BUILD}
ENVIRONMENT.pop("PYTHONPATH", None)
ENVIRONMENT.pop("PV_PLUGIN_PATH", None)

if not os.path.exists(os.path.join(BUILD, "build.ninja")):
    sys.exit(77)


def call(*command):
    return subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True, check=False)


def times():
    files = glob.glob(os.path.join(BUILD, "lib", "**", "*.so*"), recursive=True)
    return {f: os.stat(f).st_mtime_ns for f in files + [os.path.join(BUILD, "build.ninja")]}


build = os.path.join(SOURCE, "tools", "build")
first = call(build)
require(first.returncode == 0, first.stdout, first.stderr)
before = times()
require(len(before) > 4, "no libraries in the build folder", list(before))
second = call(build)
require(second.returncode == 0 and second.stdout + second.stderr == "",
        "a build with nothing to do says", second.stdout, second.stderr)
require(times() == before, "a build with nothing to do changed files")

run = os.path.join(SOURCE, "run")
with tempfile.TemporaryDirectory() as folder:
    script = os.path.join(folder, "script.py")
    with open(script, "w", encoding="utf-8") as stream:
        stream.write("import sys, vtkradiometry\n"
                     "print(vtkradiometry.vtkPointLightSource().GetClassName(), sys.argv[1:])\n"
                     "sys.exit(7)\n")
    done = call(run, "--python", script, "a b", "--c")
    require(done.returncode == 7, "exit status", done.returncode, done.stderr)
    require("vtkPointLightSource ['a b', '--c']" in done.stdout, done.stdout)
    if os.path.exists(os.path.join(BUILD, "lib", "paraview")):
        with open(script, "w", encoding="utf-8") as stream:
            stream.write("from paraview.simple import *\n"
                         "LoadDistributedPlugin('Radiometry', ns=globals())\n"
                         "light = PointLight()\nlight.UpdatePipeline()\n"
                         "print('points', light.GetDataInformation().GetNumberOfPoints())\n")
        done = call(run, "--pvpython", script)
        require("points 1" in done.stdout + done.stderr, done.stdout, done.stderr)
    done = call(run, "--pvbatch", "none", script)
    require(done.returncode == 2 and len(done.stderr.strip().split("\n")) == 1, done.stderr)
    done = call(run, "--help")
    require(done.returncode == 0 and "--tolerance" in done.stdout and "--pvbatch" in done.stdout,
            done.stdout)
