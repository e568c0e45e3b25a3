#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Question: what does an error of direct light cost in time, beside Mitsuba 3 and Radiance?

Four scenes (benchmarks/direct/scenes.py), a point light and an area light with and without a convex
blocker over a floor of square cells; two kinds of receivers, averages over the cells and values at
their centres. Every program is asked on the same machine in the same run with the same number of
threads, and judged by closed forms that are checked by plain summation (benchmarks/direct/truth.py).

A curve is a sweep of the setting that trades time for error: tolerance for vtkIrradianceFilter,
samples for Mitsuba, points a cell or -ds for rtrace. The error is the RMS over the receivers that get
more than 1 % of the greatest value of the relative difference to the truth. Seconds are processor
seconds (benchmarks/direct/clock.py), counted in two ways: `seconds` leaves out what the others do before light (loading and compiling for Mitsuba,
oconv and the start of a process for Radiance) and leaves out nothing for vtkIrradianceFilter;
`allSeconds` counts all of it. The factor at 1 % is the time another program needs for that error over
ours; where its sweep ended before, it is continued along its own slope and said to be so.

    ./run --python benchmarks/beside_others.py [--site DIR] [--cells 64] [--threads 1] ...

The peers are optional: `pip install mitsuba==3.5.2 pyradiance` into a virtual environment whose
site-packages is DIR; what is absent is left out, with a line.
"""
import argparse
import importlib.util
import json
import os
import subprocess
import sys

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from direct import truth  # noqa: E402
from direct.ours import Ours  # noqa: E402
from direct.scenes import scenes  # noqa: E402

LEVELS = (0.01, 0.001)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--site", help="folder that holds mitsuba and pyradiance")
    parser.add_argument("--cells", type=int, default=64, help="cells a side of the floor")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=20.0,
                        help="a sweep ends with the first run that is longer")
    parser.add_argument("--only", default="", help="part of the scene's name")
    return parser.parse_args()


def programs(options):
    found = [Ours(options.threads)]
    if options.site:
        sys.path.append(options.site)
    if importlib.util.find_spec("mitsuba"):
        from direct.mitsuba3 import Mitsuba
        found.append(Mitsuba(options.threads))
    else:
        print("no mitsuba: left out", file=sys.stderr)
    radiance = importlib.util.find_spec("pyradiance")
    if radiance:
        from direct.radiance import Radiance
        found.append(Radiance(os.path.dirname(radiance.origin), options.threads))
    else:
        print("no pyradiance: left out", file=sys.stderr)
    return found


def judged(values, exact):
    lit = exact > 0.01 * exact.max()
    relative = values[lit] / exact[lit] - 1.0
    wrong = np.abs(values[~lit] - exact[~lit])
    return {"rms": float(np.sqrt((relative**2).mean())), "greatest": float(np.abs(relative).max()),
            "darkRms": float(np.sqrt((wrong**2).mean()) / exact.max()) if len(wrong) else 0.0}


def seconds_at(curve, level, key):
    """The least time for an error, between or (extrapolated: True) beyond the runs of a sweep."""
    runs = sorted((run[key], run["rms"]) for run in curve)
    best, front = np.inf, []
    for time, rms in runs:  # the runs that none beats in both
        if rms < best:
            front.append((time, rms))
            best = rms
    for number, (time, rms) in enumerate(front):
        if rms <= level:
            if number == 0:
                return time, False
            before = front[number - 1]
            share = np.log(before[1] / level) / np.log(before[1] / rms)
            return float(before[0] * (time / before[0])**share), False
    slope = fitted(curve, key)
    if not slope or slope >= -0.05:
        return None, True
    return float(front[-1][0] * (level / front[-1][1])**(1.0 / slope)), True


def fitted(curve, key="seconds"):
    """p of error = c time^p over the sweep; None where the error has no trend."""
    runs = [(run[key], run["rms"]) for run in curve if run["rms"] > 1e-9]
    if len(runs) < 3:
        return None
    return float(np.polyfit(*np.log(np.array(runs)).T, 1)[0])


def compare(scene, receivers, exact, found, limit):
    row = {"scene": scene.name, "receivers": receivers, "count": len(exact), "programs": []}
    for program in found:
        curve = []
        for setting, values, seconds, everything in program.sweep(scene, receivers, limit):
            run = {"setting": setting, "seconds": seconds, "allSeconds": everything,
                   **judged(values, exact)}
            if isinstance(program, Ours):
                run["covered"] = float((np.abs(values - exact) <= program.stated
                                        + exact.max() * (1e-5 if receivers == "cells"
                                                         and scene.panel is not None else 1e-12)
                                        ).mean())
            curve.append(run)
            print(f"{scene.name:32s} {receivers:7s} {program.name:14s} {setting:28s} "
                  f"{seconds:9.4f} s {run['rms']:.2e}", file=sys.stderr)
        row["programs"].append({"name": program.name, "curve": curve, "slope": fitted(curve)})
    for other in row["programs"]:
        other["at"] = []
        for level in LEVELS:
            entry = {"error": level}
            for key in ("seconds", "allSeconds"):
                ours, _ = seconds_at(row["programs"][0]["curve"], level, key)
                theirs, extrapolated = seconds_at(other["curve"], level, key)
                entry[key] = theirs
                entry["extrapolated"] = extrapolated
                entry["factor" if key == "seconds" else "allFactor"] = (
                    theirs / ours if ours and theirs else None)
            other["at"].append(entry)
    return row


def processor():
    with open("/proc/cpuinfo", encoding="ascii", errors="replace") as file:
        return next((line.split(":")[1].strip() for line in file if "model name" in line), "unknown")


def commit():
    found = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, check=False)
    return found.stdout.decode().strip()


def main():
    options = arguments()
    # The same cores for all: a library's pool may hold one thread more than it was asked for.
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[-options.threads:])
    found = programs(options)
    out = {"question": "error against time of direct light, beside Mitsuba 3 and Radiance",
           "commit": commit(), "processor": processor(), "threads": options.threads, "load": os.getloadavg()[0],
           "cells": options.cells**2, "versions": {p.name: p.version for p in found}, "rows": []}
    for scene in scenes(options.cells):
        if options.only not in scene.name:
            continue
        cells, points = truth.truth(scene)
        check = truth.check(scene, cells, points)
        for receivers, exact in (("cells", cells), ("points", points)):
            row = compare(scene, receivers, exact, found, options.seconds)
            row["truthCheck"] = check
            out["rows"].append(row)
    print(json.dumps(out, indent=1))


if __name__ == "__main__":
    main()
