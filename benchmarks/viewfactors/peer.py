# SPDX-License-Identifier: BSD-3-Clause
"""pyviewfactor on a mesh, in its own Python (it brings its own VTK): reads and writes .npz.

    python peer.py MESH.npz OUT.npz

Its fast path (compute_viewfactor_matrix: semi-analytic kernel, obstruction through a tree of boxes, all
cores through numba) runs once on a small mesh, so that compiling is not counted, then `repeats` times on
the mesh; the least time counts. NUMBA_NUM_THREADS sets the threads.
"""
import sys
import time
import warnings

import numpy as np
import pyvista
import pyviewfactor


def mesh(points, quads):
    return pyvista.PolyData(points, np.column_stack([np.full(len(quads), 4), quads]).ravel())


def factors(points, quads, blocker):
    surface = mesh(points, quads)
    if len(blocker):
        return pyviewfactor.compute_viewfactor_matrix(
            surface, obstacles=[mesh(points, quads[blocker])])
    return pyviewfactor.compute_viewfactor_matrix(surface, skip_obstruction=True)


def main():
    warnings.simplefilter("ignore")
    data = np.load(sys.argv[1])
    few = np.unique(np.concatenate([np.arange(min(30, len(data["quads"]))), data["blocker"]]))
    factors(data["points"], data["quads"][few], np.searchsorted(few, data["blocker"]))
    least = np.inf
    for _ in range(int(data["repeats"])):
        begin = time.monotonic()
        f = factors(data["points"], data["quads"], data["blocker"])
        least = min(least, time.monotonic() - begin)
        if least > 5.0:
            break
    np.savez(sys.argv[2], factors=f.T, seconds=least, version=pyviewfactor.__version__)


if __name__ == "__main__":
    main()
