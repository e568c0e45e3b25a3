#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Question: what does the plan of effects save, do runs keep what they predict and the budget that they
are given, what does refining cost beside starting anew, and of what is the error made?

On the scenes of accuracy/scenes.py, the project's filters alone, one thread, scenes beside each other, a
core each.

- saving: every effect Auto against every effect On, in turns, until both have run for some seconds; the
  ratio is the median over the pairs of processor seconds. Both filters.
- refinement: one filter at a loose tolerance and then a tight one, against a new filter at the tight one.
- budget: a tolerance that cannot be reached, and seconds (of the clock) that are given.
- parts: the error by its source, of the run at the tight tolerance; memory.

Every run notes what it predicted. Writes benchmarks/results/accuracy-runs.json; a scene that is not asked, or
does not end, keeps what stands there.

    ./run --python benchmarks/accuracy/runs.py [--only SCENE,...] [--seconds 4] [--jobs 3]
"""
import argparse
import json
import os
import resource
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from accuracy.curves import beside_each_other  # noqa: E402
from accuracy.scenes import MAKERS, scene  # noqa: E402
from provenance import provenance, result, write  # noqa: E402

NAME = "accuracy-runs"
ON = 1
TOLERANCE = {False: 0.01, True: 0.1}   # of the runs that are compared, by whether light is reflected
BUDGETS = (0.5, 2.0, 5.0)              # s
OUT_OF_REACH = 1e-6
LEVELS = ((0.1, 0.01), (0.1, 0.03), (0.2, 0.1))  # loose and tight: the first that ends in time
LONGEST = 20.0                         # s, predicted, of a tight run


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--seconds", type=float, default=4.0, help="of each comparison, at least")
    parser.add_argument("--jobs", type=int, default=max(1, len(os.sched_getaffinity(0)) - 1))
    parser.add_argument("--only", default="", help="scenes, with commas between")
    parser.add_argument("--out", default=NAME)
    parser.add_argument("--child", help="internal: the scene of this process")
    return parser.parse_args()


class Bench:
    def __init__(self, one, seconds):
        self.one, self.seconds, self.notes = one, seconds, []

    def filter(self, tolerance, indirect, budget=0.0):
        run = self.one.filter(0, indirect)
        run.SetRelativeTolerance(tolerance)
        run.SetTimeBudget(budget)
        run.SetNumberOfThreads(1)
        return run

    def run(self, made, what):
        """Executes a filter and notes its prediction."""
        from accuracy.ours import Run
        run = Run(self.one, made)
        cost = run.cost()
        self.notes.append({"what": what, "filter": made.GetClassName(),
                           "tolerance": made.GetRelativeTolerance(), "budget": made.GetTimeBudget(),
                           "wall": run.wall, "outcome": run.what_ended_it(), **cost})
        return run

    def saving(self, indirect):
        tolerance = TOLERANCE[indirect]
        first = self.run(self.filter(tolerance, indirect), "saving")
        switches = [row["Effect"] for row in first.plan() if row["Switch"]]

        def all_on():
            made = self.filter(tolerance, indirect)
            for name in switches:
                getattr(made, "Set" + name)(ON)
            return made

        other = self.run(all_on(), "saving, all on")
        pairs = []
        while len(pairs) < 3 or (len(pairs) < 25 and np.sum(pairs) < self.seconds):
            made, forced = self.filter(tolerance, indirect), all_on()
            turns = [lambda: self.run(made, "saving"), lambda: self.run(forced, "saving, all on")]
            if len(pairs) % 2:  # each is the first as often as the other
                taken = [turn().seconds for turn in turns[::-1]][::-1]
            else:
                taken = [turn().seconds for turn in turns]
            pairs.append(taken)
        pairs = np.array(pairs)
        ratio = pairs[:, 1] / pairs[:, 0]
        allowed = np.abs(first.error) + np.abs(other.error)
        return {"filter": "Radiosity" if indirect else "Irradiance", "tolerance": tolerance,
                "pairs": len(pairs), "auto": float(np.median(pairs[:, 0])),
                "on": float(np.median(pairs[:, 1])), "ratio": float(np.median(ratio)),
                "ratioLow": float(np.quantile(ratio, 0.25)), "ratioHigh": float(np.quantile(ratio, 0.75)),
                "raysAuto": first.cost().get("samples"), "raysOn": other.cost().get("samples"),
                "agree": float((np.abs(first.values - other.values) <= allowed + 1e-12
                                * first.values.max()).mean()),
                "methodAuto": first.text("RadiometryMethod").split(":")[0],
                "methodOn": other.text("RadiometryMethod").split(":")[0],
                "leftOut": [row["Effect"] for row in first.plan()
                            if row["Switch"] and row["Decision"] in ("not needed", "left out", "dropped")]}

    def levels(self):
        """The loose and the tight tolerance of this scene, by what the filter predicts."""
        for loose, tight in LEVELS:
            seconds = self.filter(tight, self.one.indirect).PredictSeconds()
            if seconds <= LONGEST:
                return loose, tight
        return LEVELS[-1]

    def refinement(self):
        loose, tight = self.levels()
        made = self.filter(loose, self.one.indirect, 2.0 * LONGEST)
        first = self.run(made, "first")
        made.SetRelativeTolerance(tight)
        second = self.run(made, "refined")
        fresh = self.run(self.filter(tight, self.one.indirect, 2.0 * LONGEST), "at once")
        allowed = np.hypot(second.error, fresh.error) + 1e-12 * fresh.values.max()
        return {"loose": loose, "tight": tight, "first": first.seconds, "then": second.seconds,
                "atOnce": fresh.seconds, "ratio": (first.seconds + second.seconds) / fresh.seconds,
                "agree": float((np.abs(second.values - fresh.values) <= allowed).mean()),
                "outcome": second.what_ended_it()}, fresh

    def parts(self, run):
        """The error by source, as shares of the mean irradiance."""
        rows = [row for row in run.plan() if row["Effect"].startswith("Error:")]
        mean = float(run.values.mean())
        lit = run.values > 0.01 * run.values.max(0)
        return {"parts": {row["Effect"][7:]: row["Bound"] / mean for row in rows},
                "dropped": sum(row["Bound"] for row in run.plan()
                               if row["Switch"] == "Auto" and row["Decision"] == "left out"
                               and np.isfinite(row["Bound"]) and "dropped" in row["Why"]) / mean,
                "stated": float(np.median(run.error[lit] / run.values[lit])),
                "mean": mean, "memory": run.cost().get("memory"),
                "method": run.text("RadiometryMethod").split(":")[0],
                "convergence": run.convergence()}

    def budgets(self):
        rows = []
        for given in BUDGETS:
            run = self.run(self.filter(OUT_OF_REACH, self.one.indirect, given), "budget")
            over = run.wall - given
            ended = "budget" in run.what_ended_it()
            rows.append({"given": given, "wall": run.wall, "outcome": run.what_ended_it(),
                         "byBudget": ended,
                         "kept": bool(over <= max(0.1 * given, 0.5)
                                      and (not ended or over >= -max(0.1 * given, 0.5)))})
            if not ended and run.wall < given:
                break
        return rows


def child(options):
    one = scene(options.child)
    bench = Bench(one, options.seconds)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    row = {"key": one.key, "scene": one.name, "values": len(one), "bands": one.bands, "open": one.open}
    row["refinement"], fresh = bench.refinement()
    row["error"] = bench.parts(fresh)
    row["peakMiB"] = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024.0
    row["saving"] = [bench.saving(indirect) for indirect in (False, True)
                     if indirect or not one.exitance.any()
                     if one.sensors is None or not indirect]
    row["budgets"] = bench.budgets()
    row["notes"] = bench.notes
    with open(options.out, "w", encoding="utf-8") as file:
        json.dump(row, file)
    print(one.key, row["refinement"], row["saving"], row["budgets"], file=sys.stderr, flush=True)


def main():
    options = arguments()
    if options.child:
        child(options)
        return
    wanted = options.only.split(",") if options.only else list(MAKERS)
    old = result(options.out)  # scenes that do not end keep what stands there, with its commit
    rows = {row["key"]: row for row in old["rows"]} if old else {}
    about = {"question": "what the plan saves, and whether predictions and budgets hold",
             **provenance(), "threads": 1, "beside": options.jobs}

    def finished(key, row):
        rows[key] = {**row, "commit": about["commit"]}
        write(options.out, {**about, "rows": [rows[k] for k in MAKERS if k in rows]})

    def command(key, path):
        return [sys.executable, *sys.argv, "--child", key, "--out", path]

    longest = ("gallery", "cornell-box", "street-canyon", "crater")
    beside_each_other(sorted(wanted, key=lambda k: k not in longest), command, options.jobs, finished)


if __name__ == "__main__":
    main()
