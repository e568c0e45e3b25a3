# SPDX-License-Identifier: BSD-3-Clause
"""A client and pvserver, of one rank and of two, draw the picture of ParaView alone: the surface here or
there, a light moved and one hidden, a state saved and loaded, cells selected."""
import os
import shutil
import socket
import subprocess
import sys
import tempfile

import display

display.ensure()

from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGReader  # noqa: E402

if not shutil.which("mpiexec") or not shutil.which("pvserver"):
    print("skipped: no mpiexec or no pvserver")
    sys.exit(77)

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "servers_scene.py")
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                   OMPI_MCA_rmaps_base_oversubscribe="1",
                   OMPI_MCA_hwloc_base_binding_policy="none",
                   OMPI_MCA_mpi_yield_when_idle="1")
# What that folder holds is loaded at the start, and a second time is an error.
ENVIRONMENT.pop("PV_PLUGIN_PATH", None)
PICTURES = ("local", "remote", "moved", "state")


def free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


def run(where, ranks, *arguments):
    """The scene, drawn by pvpython alone (0 ranks) or with a server."""
    server, port = None, []
    if ranks:
        port = [str(free_port())]
        before = ["mpiexec", "-np", str(ranks)] if ranks > 1 else []
        server = subprocess.Popen([*before, "pvserver", "--server-port=" + port[0]],
                                  env=ENVIRONMENT, stdout=subprocess.PIPE,
                                  stderr=subprocess.DEVNULL, text=True)
        for line in server.stdout:  # until it listens
            if "Accepting connection" in line:
                break
    try:
        subprocess.run(["pvpython", SCENE, where, *port, *arguments], env=ENVIRONMENT, check=True,
                       timeout=60, stdout=subprocess.DEVNULL)
    finally:
        if server:
            try:  # it ends with its client
                server.wait(timeout=20)
            except subprocess.TimeoutExpired:
                server.terminate()
                server.wait()


def draw(folder, ranks):
    """The pictures by name and how many cells were selected."""
    where = os.path.join(folder, str(ranks))
    os.mkdir(where)
    run(where, ranks)
    if ranks == 1:
        run(where, ranks, os.path.join(folder, "0", "servers.pvsm"))
    images = {}
    for name in PICTURES[:4 if ranks == 1 else 3]:
        reader = vtkPNGReader()
        reader.SetFileName(os.path.join(where, name + ".png"))
        reader.Update()
        images[name] = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(int)
    with open(os.path.join(where, "selected.txt")) as file:
        return images, int(file.read())


with tempfile.TemporaryDirectory() as folder:
    alone, count = draw(folder, 0)
    assert alone["local"].max() > 200 and (alone["local"].max(axis=1) > 20).mean() > 0.1
    assert abs(alone["local"] - alone["moved"]).max() > 50
    assert count > 0
    alone["state"] = alone["local"]  # what a state draws when a server loads it
    for ranks in (1, 2):
        images, selected = draw(folder, ranks)
        for name in images:
            difference = abs(images[name] - alone[name])
            print(ranks, name, "greatest difference", difference.max(),
                  "pixels", int((difference.max(axis=1) > 0).sum()))
            # Two ranks: each makes its part of the sphere, whose points differ in the last digit.
            assert difference.max() <= ranks - 1, (ranks, name)
            assert (difference.max(axis=1) > 0).sum() <= 8 * (ranks - 1), (ranks, name)
        assert selected == count, (ranks, selected, count)
