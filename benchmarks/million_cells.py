#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Question: what do a million cells of a furnished scene cost on two cores, and are they right?

Four furnished rooms (benchmarks/FurnishedScene.h) with panels and point lights, three bands, through
vtkRadiosityFilter at 3 %, in a process of its own that two cores are given to (NumberOfThreads 2), with a
TimeBudget below three minutes: seconds of Update(), its peak of memory, the share of cells whose stated error meets the tolerance. Then the true
error: 200 cells drawn at random are computed by path tracing in Mitsuba 3 (benchmarks/accuracy/
mitsuba3.py, which shares nothing with the filter but the scene) until their standard error is below 1 %.

    ./run --python benchmarks/million_cells.py [--cells 1e6] [--tolerance 0.03] [--site DIR] ...

Without Mitsuba (--site: where it is) the true error is left out, with a line. Writes
benchmarks/results/radiosity-million.json.
"""
import argparse
import importlib.util
import json
import os
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import vtkradiometry as vr

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from radiosity.furnished import Furnished  # noqa: E402
from provenance import provenance, write  # noqa: E402


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--cells", type=float, default=1e6)
    parser.add_argument("--tolerance", type=float, default=0.03)
    parser.add_argument("--cores", type=int, default=2)
    parser.add_argument("--method", type=int, default=0)
    parser.add_argument("--time-budget", type=float, default=165.0)
    parser.add_argument("--memory-limit", type=float, default=8192.0, help="MiB")
    parser.add_argument("--sample", type=int, default=200, help="cells that are checked")
    parser.add_argument("--site", help="folder that holds mitsuba")
    parser.add_argument("--build", default="build")
    parser.add_argument("--out", default="radiosity-million")
    parser.add_argument("--child", help="what the process itself is given", default="")
    return parser.parse_args()


def run(options):
    """In the process of its own: the filter, its figures, and the values in a file."""
    scene = Furnished(int(options.cells), options.build)
    surface, lights = scene.surface(), scene.lights()
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    radiosity = vr.vtkRadiosityFilter()
    radiosity.SetInputData(surface)
    radiosity.AddLightsData(lights)
    radiosity.SetRelativeTolerance(options.tolerance)
    radiosity.SetNumberOfThreads(options.cores)
    radiosity.SetMethod(options.method)
    radiosity.SetTimeBudget(options.time_budget)
    radiosity.SetMemoryLimit(options.memory_limit)
    begin, used = time.monotonic(), time.process_time()
    radiosity.Update()
    seconds, processor = time.monotonic() - begin, time.process_time() - used
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    out = radiosity.GetOutput(0)
    get = out.GetCellData().GetArray
    np.savez(options.child, values=vtk_to_numpy(get("Irradiance")),
             error=vtk_to_numpy(get("IrradianceError")))
    table = radiosity.GetOutputDataObject(1)
    plan = [{table.GetColumnName(c): table.GetValue(r, c).ToString()
             for c in range(table.GetNumberOfColumns())} for r in range(table.GetNumberOfRows())]
    print(json.dumps({
        "cells": len(scene), "seconds": seconds, "processorSeconds": processor, "peakBytes": peak,
        "inputBytes": before, "plan": plan, "timeBudget": options.time_budget,
        "method": out.GetFieldData().GetAbstractArray("RadiometryMethod").GetValue(0)}))


def reference(options, scene, chosen):
    """Irradiance of the chosen cells and its standard error, by paths."""
    if options.site:
        sys.path.append(options.site)
    if not importlib.util.find_spec("mitsuba"):
        print("no mitsuba: true error left out", file=sys.stderr)
        return None
    from accuracy.mitsuba3 import Mitsuba
    mitsuba = Mitsuba("paths").set_threads(len(os.sched_getaffinity(0)))
    scene = scene.plain()
    mitsuba.build(scene)
    batches = []
    begin = time.monotonic()
    while len(batches) < 8 or (len(batches) < 256 and time.monotonic() - begin < 60.0):
        batches.append(mitsuba.estimate(scene, 4096, 31 + len(batches), chosen))
        mean = np.mean(batches, 0)
        spread = np.std(batches, 0, ddof=1 if len(batches) > 1 else 0) / np.sqrt(len(batches))
        if len(batches) >= 8 and np.median(spread / np.maximum(mean, 1e-30)) < 0.003:
            break
    return mean, spread, 4096 * len(batches)


def main():
    options = arguments()
    if options.child:
        run(options)
        return
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "values.npz")
        everywhere = sorted(os.sched_getaffinity(0))
        os.sched_setaffinity(0, everywhere[-options.cores:])
        answer = subprocess.run([sys.executable, *sys.argv, "--child", path], check=True,
                                stdout=subprocess.PIPE)
        os.sched_setaffinity(0, everywhere)
        out = json.loads(answer.stdout)
        data = np.load(path)
        values, error = (data[name].astype(float) for name in ("values", "error"))
    # What the tolerance is of, in dark cells: 5 % of the band's mean (docs/filters/radiosity.md).
    scene = Furnished(int(options.cells), options.build)
    mean = (values * scene.area[:, None]).sum(0) / scene.area.sum()
    allowed = options.tolerance * np.maximum(values, 0.05 * mean)
    met = (error <= allowed).all(1)
    out.update({"question": "a million cells of a furnished scene", **provenance(),
                "cores": options.cores, "tolerance": options.tolerance, "mean": mean.tolist(),
                "metShare": float(met.mean()), "metAreaShare": float(scene.area[met].sum()
                                                                     / scene.area.sum()),
                "medianStated": float(np.median(error / np.maximum(values, 0.05 * mean)))})
    print({key: value for key, value in out.items() if key != "plan"}, file=sys.stderr)
    chosen = np.sort(np.random.default_rng(7).choice(len(scene), options.sample, replace=False))
    found = reference(options, scene, chosen)
    if found:
        exact, spread, paths = found
        scale = np.maximum(exact, 0.05 * mean)
        relative = (values[chosen] - exact) / scale
        noise = spread / scale
        out["sample"] = {
            "cells": options.sample, "paths": paths,
            "rms": float(np.sqrt(max((relative**2).mean() - (noise**2).mean(), 0.0))),
            "rmsOfReference": float(np.sqrt((noise**2).mean())),
            "median": float(np.median(np.abs(relative))),
            "within": float((np.abs(relative) <= options.tolerance + 2 * noise).mean()),
            "covered": float((np.abs(values[chosen] - exact)
                              <= np.hypot(error[chosen], 2 * spread)).mean()),
            "mean": float(relative.mean())}
        print(out["sample"], file=sys.stderr)
    write(options.out, out)


if __name__ == "__main__":
    main()
