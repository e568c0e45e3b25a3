#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Question: what do view factors cost, and how right are they, beside pyviewfactor?

The same meshes (benchmarks/viewfactors/scenes.py), every cell a patch, all pairs, the same number of
threads: a closed cube, where nothing hides anything, and two squares with a plate between. Each pair is
judged by its closed form. Errors are RMS over the pairs that see each other of the relative difference.
vtkViewFactorFilter is swept over its tolerance; the factor in time is taken at the first of its runs
whose error is at most the other's. Seconds are the clock's, of Update() and of compute_viewfactor_matrix.

Then the blocked case that OpenViewFactor publishes with 6.3e6 pairs in 44.9 s (1.4e5 pairs/s, 0.51 %
off): a cylinder of radius 0.125 in an open one of 0.25 in a sphere of 3, factor of the inner cylinder to
the sphere, exactly 0.0891315669923, by rays (Method MonteCarlo). Effective pairs: cells of the one times
cells of the other.

    ./run --python benchmarks/view_factors.py [--python-of-peer DIR/bin/python] [--threads 4]

The peer is optional: `python3 -m venv DIR; DIR/bin/pip install pyviewfactor`; absent, it is left out,
with a line. Writes benchmarks/results/view-factors.json.
"""
import argparse
import os
import subprocess
import sys
import tempfile
import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

import vtkradiometry as vr

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from provenance import provenance, write  # noqa: E402
from viewfactors import scenes  # noqa: E402

PUBLISHED = 1.4e5  # pairs/s
MONTE_CARLO = 3
REPEATS = 3
BUDGET = 10.0  # s, of a run; a sweep ends with the first that takes half of it


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--python-of-peer", help="a Python that has pyviewfactor")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--only", default="", help="cube, plate or blocked")
    parser.add_argument("--out", default="view-factors")
    return parser.parse_args()


def surface(points, quads, group=None):
    data = vtkPolyData()
    places = vtkPoints()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    data.SetPoints(places)
    cells = vtkCellArray()
    cells.SetData(
        numpy_to_vtkIdTypeArray(np.arange(0, 4 * len(quads) + 1, 4, dtype=np.int64), deep=True),
        numpy_to_vtkIdTypeArray(np.ravel(quads).astype(np.int64), deep=True))
    data.SetPolys(cells)
    if group is not None:
        array = numpy_to_vtk(np.asarray(group, np.int32), deep=True)
        array.SetName("Group")
        data.GetCellData().AddArray(array)
    return data


def ours(data, tolerance, threads, group=None, method=0):
    """Rows of the table (from, to, factor, error) and the seconds."""
    run = vr.vtkViewFactorFilter()
    run.SetAbsoluteTolerance(1e-4 if group else 0.0)
    run.SetInputData(data)
    run.SetRelativeTolerance(tolerance)
    run.SetNumberOfThreads(threads)
    run.SetTimeBudget(BUDGET)
    run.SetMethod(method)
    if group:
        run.SetPatchArray(group)
    begin = time.monotonic()
    run.Update()
    seconds = time.monotonic() - begin
    table = run.GetOutputDataObject(1)
    columns = [vtk_to_numpy(table.GetColumnByName(name)).astype(float).copy()
               for name in ("From", "To", "ViewFactor", "ViewFactorError")]
    return columns, seconds


def judged(f, exact):
    with np.errstate(invalid="ignore"):
        seen = exact > 1e-6 * np.nanmax(exact)
        dark = exact == 0.0
    relative = f[seen] / exact[seen] - 1.0
    return {"rms": float(np.sqrt((relative**2).mean())), "greatest": float(np.abs(relative).max()),
            "mean": float(f[seen].sum() / exact[seen].sum() - 1.0),
            "greatestWhereDark": float(f[dark].max()) if dark.any() else 0.0}


def peer(options, mesh):
    with tempfile.TemporaryDirectory() as folder:
        np.savez(os.path.join(folder, "in.npz"), points=mesh.points, quads=mesh.quads,
                 blocker=np.zeros(0, int) if mesh.blocker is None else mesh.blocker, repeats=REPEATS)
        program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "viewfactors", "peer.py")
        environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
        subprocess.run([options.python_of_peer, program, os.path.join(folder, "in.npz"),
                        os.path.join(folder, "out.npz")], check=True,
                       env=dict(environment, NUMBA_NUM_THREADS=str(options.threads)))
        data = np.load(os.path.join(folder, "out.npz"))
        return data["factors"], float(data["seconds"]), str(data["version"])


def compare(options, mesh):
    count = len(mesh.quads)
    with np.errstate(invalid="ignore"):
        pairs = int((mesh.exact > 0).sum() / 2)
    row = {"mesh": mesh.name, "cells": count, "pairs": pairs, "curve": []}
    for tolerance in (0.3, 0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-6, 1e-8):
        least = np.inf
        for _ in range(REPEATS):
            (i, j, f, error), seconds = ours(surface(mesh.points, mesh.quads), tolerance,
                                             options.threads)
            least = min(least, seconds)
            if least > 1.0:
                break
        matrix, spread = np.zeros((count, count)), np.zeros((count, count))
        matrix[i.astype(int), j.astype(int)] = f
        spread[i.astype(int), j.astype(int)] = error
        compared = ~np.isnan(mesh.exact)
        covered = (np.abs(matrix - mesh.exact)
                   <= spread + mesh.truth * mesh.exact + 1e-15)[compared]
        run = {"tolerance": tolerance, "seconds": least, **judged(matrix, mesh.exact),
               "covered": float(covered.mean())}
        row["curve"].append(run)
        print(f"{mesh.name:40s} {tolerance:7g} {least:8.3f} s  rms {run['rms']:.1e}  greatest "
              f"{run['greatest']:.1e}  covered {run['covered']:.3f}", file=sys.stderr)
        if least > 0.5 * BUDGET:
            break
    if options.python_of_peer:
        f, seconds, version = peer(options, mesh)
        row["peer"] = {"name": "pyviewfactor", "version": version, "seconds": seconds,
                       **judged(f, mesh.exact)}
        good = [run["seconds"] for run in row["curve"] if run["rms"] <= row["peer"]["rms"]]
        row["factor"] = seconds / min(good) if good else None
        print(f"{mesh.name:40s} pyviewfactor {seconds:8.3f} s  rms {row['peer']['rms']:.1e}  factor "
              f"{row['factor']}", file=sys.stderr)
    return row


def blocked(options):
    parts = [scenes.tube(0.125, 1.0, 64, 8), scenes.tube(0.25, 1.0, 64, 8), scenes.globe(3.0, 80)]
    points, quads = scenes.joined(parts)
    group = np.repeat([0, 1, 2], [len(part[1]) for part in parts])
    pairs = len(parts[0][1]) * len(parts[2][1])
    curve = []
    for tolerance in (0.1, 0.03, 0.01, 0.007, 0.005, 0.004, 0.003, 0.002, 0.001):
        (i, j, f, error), seconds = min(
            (ours(surface(points, quads, group), tolerance, options.threads, "Group", MONTE_CARLO)
             for _ in range(REPEATS)), key=lambda run: run[1])
        at = np.flatnonzero((i == 0) & (j == 2))
        value, spread = (float(f[at[0]]), float(error[at[0]])) if len(at) else (0.0, 0.0)
        off = value / scenes.EXACT_TUBE - 1.0
        curve.append({"tolerance": tolerance, "seconds": seconds, "viewFactor": value,
                      "stated": spread, "off": off, "pairsPerSecond": pairs / seconds})
        print(f"blocked {tolerance:7g} {seconds:8.3f} s  F {value:.6f} +- {spread:.1e} ({off:+.2%})  "
              f"{pairs / seconds:.2e} pairs/s", file=sys.stderr)
        if seconds > 0.5 * BUDGET:
            break
    good = [run["pairsPerSecond"] for run in curve
            if abs(run["off"]) <= 0.005 and run["stated"] <= 0.005 * scenes.EXACT_TUBE]
    return {"pairs": pairs, "exact": scenes.EXACT_TUBE, "curve": curve,
            "pairsPerSecond": max(good) if good else None,
            "factor": max(good) / PUBLISHED if good else None}


def main():
    options = arguments()
    if not options.python_of_peer:
        print("no --python-of-peer: pyviewfactor left out", file=sys.stderr)
    meshes = [("cube", scenes.box, n) for n in (4, 8, 12)]
    meshes += [("plate", scenes.plates, n) for n in (8, 16)]
    out = {"question": "view factors of all pairs of cells, beside pyviewfactor", **provenance(),
           "threads": options.threads,
           "rows": [compare(options, make(n)) for name, make, n in meshes if options.only in name]}
    if options.only in "blocked":
        out["blocked"] = blocked(options)
    write(options.out, out)


if __name__ == "__main__":
    main()
