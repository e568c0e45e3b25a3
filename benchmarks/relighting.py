#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Question: what does a changed light or reflectance cost beside the first solve?

The furnished scene (benchmarks/FurnishedScene.h) in 1e5 cells through vtkRadiosityFilter, one element a
cell (Refinement Off) and a tolerance that the first execution meets, so that every execution solves the same
1e5 unknowns by the same exchange: the first execution builds what depends on geometry, the following ones change one thing each - point lights moved
by 0.1 m, dimmed, recoloured, panels dimmed, another reflectance of the walls - in the same filter, which
is told of nothing. The moved lights and the changed reflectance are judged against new filters that begin
with them: the results must agree within their stated errors. Seconds are the clock's of Update().

    ./run --python benchmarks/relighting.py [--cells 1e5] [--threads 0] [--tolerance 0.1]

Writes benchmarks/results/radiosity-relighting.json.
"""
import argparse
import os
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import vtkradiometry as vr

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from radiosity.furnished import Furnished, named  # noqa: E402
from provenance import provenance, write  # noqa: E402


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--cells", type=float, default=1e5)
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--tolerance", type=float, default=0.1)
    parser.add_argument("--time-budget", type=float, default=60.0)
    parser.add_argument("--method", type=int, default=0)
    parser.add_argument("--refinement", type=int, default=2, help="0 Auto, 1 On, 2 Off")
    parser.add_argument("--build", default="build")
    parser.add_argument("--out", default="radiosity-relighting")
    return parser.parse_args()


class Run:
    def __init__(self, options, surface, lights):
        self.filter = vr.vtkRadiosityFilter()
        self.filter.SetRelativeTolerance(options.tolerance)
        self.filter.SetNumberOfThreads(options.threads)
        self.filter.SetMethod(options.method)
        self.filter.SetRefinement(options.refinement)
        self.filter.SetTimeBudget(options.time_budget)
        self.surface, self.lights = surface, lights
        self.filter.SetInputData(surface)
        self.filter.SetInputDataObject(1, lights)

    def update(self):
        begin = time.monotonic()
        self.filter.Update()
        seconds = time.monotonic() - begin
        out = self.filter.GetOutput(0)
        get = out.GetCellData().GetArray
        return (seconds, vtk_to_numpy(get("Irradiance")).astype(float).copy(),
                vtk_to_numpy(get("IrradianceError")).astype(float).copy(),
                out.GetFieldData().GetAbstractArray("RadiometryMethod").GetValue(0))


def changes(scene):
    """Name, lights, reflectance, exitance (None: as they are), judged against a new filter or not."""
    yield "lights moved by 0.1 m", scene.lights((0.1, -0.05, -0.05)), None, None, True
    yield "lights dimmed to 0.3", scene.lights(factor=(0.3, 0.3, 0.3)), None, None, False
    yield "lights recoloured", scene.lights(factor=(1.2, 0.8, 0.4)), None, None, False
    yield "panels dimmed to 0.5", scene.lights(), None, 0.5 * scene.exitance, False
    changed = scene.reflectance.copy()
    begin, end = scene.kinds[1]
    changed[begin:end] = (0.5, 0.6, 0.7)
    yield "reflectance of the walls", scene.lights(), changed, None, True


def main():
    options = arguments()
    scene = Furnished(int(options.cells), options.build)
    surface = scene.surface()
    run = Run(options, surface, scene.lights())
    first, _, _, method = run.update()
    print(f"first {first:.2f} s  {method}", file=sys.stderr)
    rows = []
    for name, lights, reflectance, exitance, judged in changes(scene):
        named(surface.GetCellData(), "DiffuseReflectance",
              scene.reflectance if reflectance is None else reflectance)
        named(surface.GetCellData(), "EmittedExitance",
              scene.exitance if exitance is None else exitance)
        surface.Modified()
        run.filter.SetInputDataObject(1, lights)
        seconds, values, error, how = run.update()
        row = {"change": name, "seconds": seconds, "factor": first / seconds, "method": how}
        if judged:
            fresh, truth, spread, _ = Run(options, surface, lights).update()
            row["freshSeconds"] = fresh
            row["covered"] = float((np.abs(values - truth) <= np.hypot(error, spread)).mean())
            row["rmsDifference"] = float(np.sqrt(((values - truth)**2).mean()) / truth.mean())
        rows.append(row)
        print(row, file=sys.stderr)
    write(options.out, {"question": "a change of light or reflectance beside the first solve",
                        **provenance(), "cells": len(scene), "threads": options.threads,
                        "cores": len(os.sched_getaffinity(0)), "tolerance": options.tolerance,
                        "firstSeconds": first, "method": method, "rows": rows})


if __name__ == "__main__":
    main()
