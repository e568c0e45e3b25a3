# SPDX-License-Identifier: BSD-3-Clause
"""The installed project: a C++ program finds it with find_package and runs, Python imports it."""
import os
import subprocess
import sys
import tempfile

SOURCE = os.environ["RADIOMETRY_SOURCE_DIR"]
BUILD = os.environ["RADIOMETRY_BUILD_DIR"]


def call(*command, **environment):
    done = subprocess.run(command, capture_output=True, text=True, check=False,
                          env={**os.environ, **environment})
    if done.returncode != 0:
        print(" ".join(command), "\n", done.stdout[-3000:], done.stderr[-3000:])
        sys.exit(1)
    return done.stdout


with tempfile.TemporaryDirectory() as folder:
    prefix = os.path.join(folder, "prefix")
    program = os.path.join(folder, "consumer")
    call("cmake", "--install", BUILD, "--prefix", prefix)
    call("cmake", "-S", os.path.join(SOURCE, "tests", "run", "consumer"), "-B", program, "-G",
         "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}")
    call("cmake", "--build", program)
    call(os.path.join(program, "consumer"))

    packages = os.path.join(prefix, "lib", "python3", "dist-packages")
    origin = call("/usr/bin/python3", "-c",
                  "import vtkradiometry as v; v.vtkSpotLightSource(); v.vtkPhongGouraudMapper();"
                  "print(v.__file__)", PYTHONPATH=packages).strip()
    assert origin.startswith(prefix), origin
    plugin = os.path.join(prefix, "lib", "paraview", "plugins", "Radiometry", "Radiometry.so")
    if os.path.exists(os.path.join(BUILD, "lib", "paraview")):
        assert os.path.isfile(plugin), plugin
    assert os.path.isfile(os.path.join(prefix, "share", "doc", "vtkRadiometry", "LICENSE"))
