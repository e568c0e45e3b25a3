# SPDX-License-Identifier: BSD-3-Clause
"""The part of accuracy/factors.py that runs in pyviewfactor's own Python:

    python factors_peer.py IN.npz OUT.npz

Its fast path (compute_viewfactor_matrix: semi-analytic kernel, obstruction through a tree of boxes, numba)
runs once on a few cells, so that compiling is not counted; the least of the repeats counts. Processor
seconds. NUMBA_NUM_THREADS sets the threads.
"""
import sys
import time
import warnings

import numpy as np
import pyvista
import pyviewfactor


def mesh(cells):
    size = cells.shape[1]
    points, index = np.unique(cells.reshape(-1, 3).round(9), axis=0, return_inverse=True)
    faces = np.column_stack([np.full(len(cells), size), np.ravel(index).reshape(-1, size)])
    return pyvista.PolyData(points, faces.ravel())


def both(cells, lamps):
    """Cells and pieces of panels in one mesh."""
    a, b = mesh(cells), mesh(lamps)
    faces = [a.faces.reshape(-1, a.faces[0] + 1), b.faces.reshape(-1, b.faces[0] + 1).copy()]
    faces[1][:, 1:] += a.n_points
    return pyvista.PolyData(np.concatenate([a.points, b.points]),
                            np.concatenate([f.ravel() for f in faces]))


def factors(data):
    """F[i, j] of i to j."""
    cells, lamps = data["cells"], data["lamps"]
    if not len(lamps):
        surface = mesh(cells)
        return pyviewfactor.compute_viewfactor_matrix(surface, obstacles=[surface]).T
    surface = both(cells, lamps)
    if not len(data["triangles"]):
        return pyviewfactor.compute_viewfactor_matrix(surface, skip_obstruction=True).T
    return pyviewfactor.compute_viewfactor_matrix(
        surface, obstacles=[mesh(data["points"][data["triangles"]])]).T


def irradiance(data):
    f = factors(data)
    count = len(data["cells"])
    if len(data["lamps"]):
        return f[:count, count:] @ data["exitance"]
    out = []
    for band in range(data["exitance"].shape[1]):
        rho, emitted = data["reflectance"][:, band], data["exitance"][:, band]
        leaving = np.linalg.solve(np.eye(count) - rho[:, None] * f, emitted)
        out.append(f @ leaving)
    return np.column_stack(out)


def main():
    warnings.simplefilter("ignore")
    with np.load(sys.argv[1]) as file:
        data = {name: file[name] for name in file.files}
    few = dict(data, cells=data["cells"][:30])
    if not len(data["lamps"]):
        few["reflectance"], few["exitance"] = data["reflectance"][:30], data["exitance"][:30]
    irradiance(few)
    cold = time.process_time()
    least = np.inf
    for _ in range(int(data["repeats"])):
        begin = time.process_time()
        values = irradiance(data)
        least = min(least, time.process_time() - begin)
        if least > 2.0:
            break
    np.savez(sys.argv[2], irradiance=values, seconds=least, everything=least + cold,
             version=pyviewfactor.__version__)


if __name__ == "__main__":
    main()
