#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Question: how far from the truth are the seconds that radiosity predicts, and are time budgets kept?

Each scene, tolerance, method and refinement in a filter of its own: seconds of the run predicted and
spent (field data RadiometryCost), seconds of Update(); then time budgets, that a run may not overstay by
more than 10 % or 0.5 s.

    ./run --python benchmarks/radiosity_prediction.py [--scenes NAME ...] [--longest 60] ...

Writes benchmarks/results/radiosity-prediction.json.
"""
import argparse
import os
import sys
import time

import vtkradiometry as vr

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from radiosity.prediction_scenes import SCENES  # noqa: E402
from provenance import provenance, write  # noqa: E402

METHODS = {"Auto": 0, "Dense": 1, "Hierarchical": 2, "MonteCarlo": 3}
REFINEMENTS = {"Auto": 0, "On": 1, "Off": 2}
MOST_DENSE = 10000  # cells
PREDICTED = ("open plane", "blocked plane", "Cornell box", "gallery", "street", "crater", "room 1e4")
BUDGETED = ("Cornell box", "gallery", "furnished 1e5", "furnished 1e6")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--scenes", nargs="*", default=list(PREDICTED))
    parser.add_argument("--tolerances", nargs="*", type=float, default=[0.1, 0.05, 0.02, 0.01])
    parser.add_argument("--methods", nargs="*", default=list(METHODS))
    parser.add_argument("--refinements", nargs="*", default=["Auto", "Off"])
    parser.add_argument("--budgets", nargs="*", type=float, default=[1, 3, 10, 30])
    parser.add_argument("--budget-scenes", nargs="*", default=list(BUDGETED))
    parser.add_argument("--longest", type=float, default=60.0,
                        help="runs end there; what would take longer counts if it was said so")
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--points", action="store_true", help="values at points under the budgets")
    parser.add_argument("--verbose", action="store_true")
    parser.add_argument("--out", default="radiosity-prediction")
    return parser.parse_args()


def made(scene, threads):
    surface, lights, occluder = scene
    run = vr.vtkRadiosityFilter()
    run.SetInputData(surface)
    for light in lights:
        run.AddLightsData(light)
    if occluder is not None:
        run.AddOccludersData(occluder)
    run.SetNumberOfThreads(threads)
    return run


def table(run, port):
    data = run.GetOutputDataObject(port)
    columns = [data.GetColumnName(c) for c in range(data.GetNumberOfColumns())]
    return [{c: data.GetValueByName(r, c).ToString() for c in columns}
            for r in range(data.GetNumberOfRows())]


def update(run, verbose):
    begin, used = time.monotonic(), time.process_time()
    run.Update()
    seconds, used = time.monotonic() - begin, time.process_time() - used
    field = run.GetOutput(0).GetFieldData()
    cost = field.GetArray("RadiometryCost")
    if cost is None:
        raise SystemExit("the filter failed")
    names = [cost.GetComponentName(k) for k in range(cost.GetNumberOfComponents())]
    row = dict(zip(names, cost.GetTuple(0)))
    row["update"], row["processor"] = seconds, used
    row["method"] = field.GetAbstractArray("RadiometryMethod").GetValue(0)
    outcome = field.GetAbstractArray("RadiometryOutcome")
    row["outcome"] = outcome.GetValue(0) if outcome else ""
    rows = table(run, 2)
    if rows:
        row["error"] = float(rows[-1]["EstimatedError"])
    if verbose:
        for r in rows:
            print("   ", " ".join(f"{k[:6]} {v[:7]}" for k, v in r.items()), file=sys.stderr)
    return row


def predictions(options):
    for name in options.scenes:
        scene = SCENES[name]()
        for method in options.methods:
            if method == "Dense" and scene[0].GetNumberOfCells() > MOST_DENSE:
                continue
            for refinement in options.refinements:
                for tolerance in options.tolerances:
                    run = made(scene, options.threads)
                    run.SetRelativeTolerance(tolerance)
                    run.SetMethod(METHODS[method])
                    run.SetRefinement(REFINEMENTS[refinement])
                    run.SetTimeBudget(options.longest)
                    row = {"scene": name, "asked": method, "refinement": refinement,
                           "tolerance": tolerance, **update(run, options.verbose)}
                    row["ratio"] = row["PredictedSeconds"] / max(row["Seconds"], 1e-9)
                    print(f"{name:14} {method:12} {refinement:4} {tolerance:5g}  "
                          f"{row['Seconds']:7.2f} s  said {row['PredictedSeconds']:7.2f} s "
                          f"at {row['PredictedAt']:6.2f}  x{row['ratio']:5.2f}  cpu {row['processor']:6.1f}  "
                          f"{row.get('error', 0):7.4f}  {row['outcome']}  |  {row['method']}",
                          file=sys.stderr, flush=True)
                    yield row


def budgets(options):
    for name in options.budget_scenes:
        scene = SCENES[name]()
        for points in (False, True) if options.points else (False,):
            for budget in options.budgets:
                run = made(scene, options.threads)
                run.SetTimeBudget(budget)
                run.SetSampleLocation(int(points))
                row = {"scene": name, "budget": budget, "points": points,
                       **update(run, options.verbose)}
                row["over"] = row["update"] - budget
                row["kept"] = row["over"] <= max(0.1 * budget, 0.5)
                print(f"{name:14} budget {budget:4g} {'points' if points else 'cells':6}  "
                      f"{row['update']:7.2f} s  {'kept' if row['kept'] else 'OVER'}  "
                      f"{row.get('error', 0):7.4f}  {row['Seconds']:.2f} s in the core  "
                      f"cpu {row['processor']:.1f}  {row['outcome']}", file=sys.stderr, flush=True)
                yield row


def main():
    options = arguments()
    rows = list(predictions(options))
    kept = list(budgets(options))
    good = [r for r in rows if 0.5 <= r["ratio"] <= 2.0]
    write(options.out, {
        "question": "how far from the truth are predicted seconds, and are time budgets kept?",
        **provenance(), "cores": len(os.sched_getaffinity(0)), "threads": options.threads,
        "longest": options.longest, "withinTwo": len(good) / max(1, len(rows)), "runs": rows,
        "budgetsKept": sum(r["kept"] for r in kept) / max(1, len(kept)), "budgets": kept})
    print(f"{len(good)} of {len(rows)} predictions within a factor of 2, "
          f"{sum(r['kept'] for r in kept)} of {len(kept)} budgets kept", file=sys.stderr)


if __name__ == "__main__":
    main()
