# SPDX-License-Identifier: BSD-3-Clause
"""Two ranks of pvbatch draw the picture of one: surfaces split, every light on every rank once."""
import os
import shutil
import subprocess
import sys
import tempfile

import display

display.ensure()

from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGReader  # noqa: E402

if not shutil.which("mpiexec") or not shutil.which("pvbatch"):
    print("skipped: no mpiexec or no pvbatch")
    sys.exit(77)

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "ranks_scene.py")
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                   OMPI_MCA_rmaps_base_oversubscribe="1",
                   OMPI_MCA_hwloc_base_binding_policy="none",
                   OMPI_MCA_mpi_yield_when_idle="1")


def draw(folder, name, before=(), after=()):
    path = os.path.join(folder, name)
    subprocess.run([*before, "pvbatch", *after, SCENE, path], env=ENVIRONMENT, check=True,
                   timeout=120, stdout=subprocess.DEVNULL)
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(int)


with tempfile.TemporaryDirectory() as folder:
    one = draw(folder, "one.png")
    two = draw(folder, "two.png", before=["mpiexec", "-np", "2"])
    print("brightest", one.max(), "greatest difference", abs(one - two).max())
    assert one.max() > 200 and (one.max(axis=1) > 20).mean() > 0.1
    assert (one == two).all()
