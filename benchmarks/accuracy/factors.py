# SPDX-License-Identifier: BSD-3-Clause
"""pyviewfactor on the scenes whose light comes from diffuse surfaces alone, in its own Python (it brings
its own VTK): factors of all pairs, then one solve of B = M + rho F B, or E = F M from a panel.

A sweep cuts the cells, or the panel, into more and more pieces; what a cell gets is their mean.
"""
import os
import subprocess
import sys
import tempfile

import numpy as np

from accuracy.lamp import PANEL
from accuracy.shapes import joined

PEER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "factors_peer.py")
MOST = 8000  # pieces: a full matrix


def able(scene):
    """Whether it has the lights of a scene: panels and surfaces that emit."""
    return all(lamp.kind == PANEL for lamp in scene.lamps)


def cut(corners, n):
    """n x n similar pieces of each cell, of the cells one after the other."""
    if corners.shape[1] == 3:
        a, b, c = (corners[:, k] for k in range(3))

        def at(i, j):
            return a + (b - a) * (i / n) + (c - a) * (j / n)
        pieces = [[at(i, j), at(i + 1, j), at(i, j + 1)] for i in range(n) for j in range(n - i)]
        pieces += [[at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
                   for i in range(n) for j in range(n - i - 1)]
    else:
        a, b, d = (corners[:, k] for k in (0, 1, 3))

        def at(i, j):
            return a + (b - a) * (i / n) + (d - a) * (j / n)
        pieces = [[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
                  for i in range(n) for j in range(n)]
    size = corners.shape[1]
    return np.array(pieces).transpose(2, 0, 1, 3).reshape(-1, size, 3)


class PyViewFactor:
    name = "pyviewfactor"

    def __init__(self, python, threads=1):
        self.python, self.threads = python, threads
        self.version = ""

    def ask(self, cells, lamps, blockers, reflectance, exitance, repeats):
        """Irradiance of the cells (bands), the seconds, and with starting and compiling."""
        with tempfile.TemporaryDirectory() as folder:
            inside, outside = (os.path.join(folder, name) for name in ("in.npz", "out.npz"))
            points, triangles = joined(blockers)
            np.savez(inside, cells=cells, lamps=lamps, points=points, triangles=triangles,
                     reflectance=reflectance, exitance=exitance, repeats=repeats)
            environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
            threads = {name: str(self.threads) for name in (
                "NUMBA_NUM_THREADS", "OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS")}
            subprocess.run([self.python, PEER, inside, outside], check=True, stdout=sys.stderr,
                           env=dict(environment, **threads))
            with np.load(outside) as data:
                self.version = str(data["version"])
                return data["irradiance"], float(data["seconds"]), float(data["everything"])

    def sweep(self, scene, seconds):
        for n in (1, 2, 3, 4, 6, 8):
            if scene.lamps:  # the panel is cut; the cells' means are their middles' neighbourhood
                lamps = cut(np.array([lamp.corners for lamp in scene.lamps]), n)
                exitance = np.repeat([lamp.intensity for lamp in scene.lamps], n * n, 0)
                cells, each, reflectance = scene.corners, 1, np.zeros((0, scene.bands))
            else:
                lamps, each = np.zeros((0, 4, 3)), n * n
                cells = cut(scene.corners, n)
                reflectance, exitance = (np.repeat(v, each, 0)
                                         for v in (scene.reflectance, scene.exitance))
            if len(cells) + len(lamps) > MOST:
                break
            values, spent, everything = self.ask(cells, lamps, scene.blockers, reflectance, exitance, 2)
            what = f"{n * n} pieces of the panel" if scene.lamps else f"{each} pieces a cell"
            yield what, values.reshape(len(scene), each, -1).mean(1), spent, everything
            if spent > seconds:
                break
