#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Question: does direct light say beforehand how long it will take, and does it keep a time budget?

Prediction: nine scenes, values on cells and at points, tolerances from 0.1 to 1e-4, on one thread and on
all: the seconds that were predicted over those that the simulation took, and when that was said. Runs
that are predicted to take longer than --longest are stopped there and counted apart.
Budget: the same scenes and larger ones with a TimeBudget of a part of what the tolerance takes, and with
fixed budgets: the seconds of Update(). Kept: within 10 % or 0.5 s, whichever is more, or the tolerance
was met before.

    ./run --python benchmarks/direct_prediction.py [--longest 20] [--only KEY] [--skip-large] [--out NAME]

Writes benchmarks/results/direct-prediction.json.
"""
import argparse
import os
import sys
import time

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from accuracy.lamp import PANEL, POINT, SKY, SUN, Lamp  # noqa: E402
from accuracy.scenes import Scene, box_over_floor, lamp_over_floor, panel_over_floor  # noqa: E402
from accuracy.scenes import scene as accuracy_scene  # noqa: E402
from accuracy.shapes import plane  # noqa: E402
from accuracy.vtkdata import polydata, joined, lights, surface  # noqa: E402
from provenance import provenance, write  # noqa: E402

import vtkradiometry as vr  # noqa: E402

TOLERANCES = (1e-1, 1e-2, 1e-3, 1e-4)


def sky():
    return Lamp(SKY, np.array([100.0 / np.pi]))


def sun(height=0.7):
    return Lamp(SUN, np.array([800.0]),
                direction=-np.array([np.cos(height), 0.3 * np.cos(height), np.sin(height)]) /
                np.linalg.norm([np.cos(height), 0.3 * np.cos(height), np.sin(height)]))


def grid_of_lamps(count, half, height):
    side = int(np.ceil(np.sqrt(count)))
    at = half * (2.0 * (np.arange(side) + 0.5) / side - 1.0)
    return [Lamp(POINT, np.array([100.0]), position=np.array([at[k % side], at[k // side], height]))
            for k in range(count)]


def leaves(count, seed=1):
    """Squares of 12 cm turned at random in a cube of 3 m, over a floor."""
    random = np.random.default_rng(seed)
    centre = random.uniform([-1.5, -1.5, 0.5], [1.5, 1.5, 3.5], (count, 3))
    a = random.normal(size=(count, 3))
    a /= np.linalg.norm(a, axis=1)[:, None]
    b = np.cross(a, random.normal(size=(count, 3)))
    b /= np.linalg.norm(b, axis=1)[:, None]
    a, b = 0.06 * a[:, None], 0.06 * b[:, None]
    signs = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    return centre[:, None] + signs[:, :1] * a + signs[:, 1:] * b


def direct(key, **changes):
    found = accuracy_scene(key)
    found.indirect = False
    for name, value in changes.items():
        setattr(found, name, value)
    return found


def scenes():
    lamp, panel, box = lamp_over_floor(), panel_over_floor(), box_over_floor()

    def floor(key, n, lamps, blockers=(), half=3.0):
        return Scene(key, key, corners=plane(half, n), lamps=list(lamps), blockers=list(blockers))

    yield "open-plane", floor("open-plane", 256, [lamp])
    yield "blocked-plane", floor("blocked-plane", 128, [lamp], [box])
    yield "blocked-plane-panel", floor("blocked-plane-panel", 40, [panel], [box])
    yield "open-plane-panel", floor("open-plane-panel", 128, [panel])
    yield "street", direct("street-canyon")
    yield "crater", direct("crater")
    yield "many-lights", floor("many-lights", 32, grid_of_lamps(10000, 100.0, 5.0), half=100.0)
    yield "gallery", direct("gallery")
    both = np.concatenate([plane(3.0, 32), leaves(2000)])
    yield "leaves", Scene("leaves", "leaves", corners=both, lamps=[sun()])
    yield "leaves-panel", Scene("leaves-panel", "leaves", corners=np.concatenate(
        [plane(3.0, 16), leaves(300)]), lamps=[panel])
    yield "plane-sky", floor("plane-sky", 24, [sky(), sun()], [box])


def large():
    """For the budget alone."""
    box = box_over_floor()
    yield "million-cells", Scene("m", "m", corners=plane(3.0, 1000), lamps=[lamp_over_floor()],
                                 blockers=[box])
    yield "million-cells-sky", Scene("ms", "ms", corners=plane(3.0, 1000), lamps=[sky(), sun()],
                                     blockers=[box])
    yield "million-cells-panel", Scene("mp", "mp", corners=plane(3.0, 1000),
                                       lamps=[panel_over_floor()], blockers=[box])
    yield "ten-thousand-lights", Scene(
        "t", "t", corners=plane(100.0, 200), lamps=grid_of_lamps(10000, 100.0, 5.0), blockers=[box])


def make(scene, points=False, threads=0, tolerance=0.01, budget=0.0):
    run = vr.vtkIrradianceFilter()
    run.SetInputData(surface(scene))
    for data in lights(scene):
        run.AddLightsData(data)
    if scene.blockers:
        run.SetInputData(2, polydata(*joined(scene.blockers)))
    run.SetSampleLocation(1 if points else 0)
    run.SetNumberOfThreads(threads)
    run.SetRelativeTolerance(tolerance)
    run.SetTimeBudget(budget)
    return run


def cost(run):
    found = run.GetOutput(0).GetFieldData().GetArray("RadiometryCost")
    return None if found is None else dict(zip(
        ("seconds", "predicted", "predictedAt"), (found.GetComponent(0, k) for k in range(3))))


def timed(run, longest=0.0):
    said = []

    def predicted(*_):
        said.append(run.GetPredictedSeconds())
        if longest > 0.0 and said[0] > longest:
            run.SetAbortExecute(1)

    seen = run.AddObserver(vr.vtkIrradianceFilter.PredictedEvent, predicted)
    begin = time.monotonic()
    run.Update()
    seconds = time.monotonic() - begin
    run.RemoveObserver(seen)
    return seconds, said


def predictions(options):
    rows = []
    for key, scene in scenes():
        if options.only and key not in options.only:
            continue
        for threads in options.threads:
            for points in (False, True):
                for tolerance in TOLERANCES:
                    run = make(scene, points, threads, tolerance)
                    timed(run, options.longest)
                    found = cost(run)
                    row = {"scene": key, "threads": threads, "points": points,
                           "tolerance": tolerance, "values": len(scene)}
                    if found:
                        row.update(found)
                        row["ratio"] = found["predicted"] / found["seconds"]
                    else:
                        row["stopped"] = run.GetPredictedSeconds()
                    row["load"] = os.getloadavg()[0]
                    rows.append(row)
                    print(key, threads, "points" if points else "cells", tolerance,
                          {k: round(v, 4) for k, v in row.items() if k in
                           ("seconds", "predicted", "predictedAt", "ratio", "stopped")}, flush=True)
                    if not found:
                        break
    return rows


def budgets(options):
    rows = []
    tried = [(key, scene, (0.1, 0.3), {}) for key, scene in scenes()]
    if not options.skip_large:
        for key, scene in large():
            tried.append((key, scene, (0.5, 2.0, 5.0), {}))
            tried.append((key + " points", scene, (2.0,), {"SampleLocation": 1}))
            if len(scene.lamps) <= 64:
                tried.append((key + " visibility", scene, (2.0,), {"LightVisibility": 1}))
            tried.append((key + " refine", scene, (2.0,), {"RefineShadowBoundaries": 1}))
    for key, scene, given, settings in tried:
        if options.only and key.split()[0] not in options.only:
            continue
        for budget in given:
            run = make(scene, tolerance=1e-5, budget=budget)
            for name, value in settings.items():
                getattr(run, "Set" + name)(value)
            seconds, _ = timed(run)
            outcome = run.GetOutput(0).GetFieldData().GetAbstractArray("RadiometryOutcome")
            outcome = outcome.GetValue(0) if outcome else ""
            late = seconds - budget
            row = {"scene": key, "budget": budget, "seconds": seconds, "outcome": outcome,
                   "kept": bool(late <= max(0.5, 0.1 * budget) and
                                (late >= -max(0.5, 0.1 * budget) or "time budget" not in outcome)),
                   "load": os.getloadavg()[0]}
            rows.append(row)
            print("budget", key, budget, round(seconds, 3), row["kept"], outcome, flush=True)
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--longest", type=float, default=20.0)
    parser.add_argument("--only", nargs="*")
    parser.add_argument("--threads", nargs="*", type=int, default=[1, 0])
    parser.add_argument("--skip-large", action="store_true")
    parser.add_argument("--skip-budgets", action="store_true")
    parser.add_argument("--skip-predictions", action="store_true")
    parser.add_argument("--out", default="direct-prediction")
    options = parser.parse_args()
    out = {"question": "predicted over actual seconds of direct light; time budgets kept",
           **provenance()}
    out["predictions"] = [] if options.skip_predictions else predictions(options)
    ratios = np.array([row["ratio"] for row in out["predictions"] if "ratio" in row])
    if len(ratios):
        within = np.abs(np.log2(ratios)) <= 1.0
        out["withinFactorTwo"] = float(within.mean())
        out["medianRatio"] = float(np.median(ratios))
        print("within a factor of 2:", within.mean(), "of", len(ratios))
    out["budgets"] = [] if options.skip_budgets else budgets(options)
    if out["budgets"]:
        out["budgetsKept"] = float(np.mean([row["kept"] for row in out["budgets"]]))
        print("budgets kept:", out["budgetsKept"], "of", len(out["budgets"]))
    write(options.out, out)


if __name__ == "__main__":
    main()
