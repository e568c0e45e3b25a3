#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Question: what does an error of the cells' irradiance cost in time, beside Mitsuba 3 and Radiance?

The Cornell box in triangles of even size, three bands, averages over the cells, all bounces. Every
program is asked on the same machine in the same run with the same number of threads, in the fastest fair
way that we know for it (benchmarks/radiosity/*.py say which), and judged by a reference of light paths
(benchmarks/radiosity/reference.py), whose own standard error is known and taken off.

A curve is a sweep of the setting that trades time for error. The error is the RMS over cells and bands,
of those that get more than 1 % of the band's greatest value, of the relative difference. Seconds are
processor seconds on one thread, the clock's on more; `seconds` leaves out what others do before light
(loading and compiling, oconv, the start of a process) and nothing for vtkRadiosityFilter; `allSeconds`
counts all of it.

    ./run --python benchmarks/radiosity_beside_others.py [--site DIR] [--edge 0.08] [--threads 1] ...

Mitsuba makes the reference: without it there is none, and the program says so and ends. Radiance is
left out with a line where pyradiance is absent. Writes benchmarks/results/radiosity-others.json.
"""
import argparse
import importlib.util
import os
import sys
import time

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from beside_others import fitted, seconds_at  # noqa: E402
from direct.clock import clock  # noqa: E402
from radiosity import reference  # noqa: E402
from radiosity.cornell import Box  # noqa: E402
from radiosity.ours import METHODS, Ours  # noqa: E402
from provenance import provenance, write  # noqa: E402

LEVELS = (0.1, 0.03, 0.01, 0.003)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--site", help="folder that holds mitsuba and pyradiance")
    parser.add_argument("--edge", type=float, default=0.08, help="greatest edge of a cell, m")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=12.0,
                        help="a sweep ends with the first run that is longer")
    parser.add_argument("--reference-seconds", type=float, default=60.0)
    parser.add_argument("--methods", default="0", help="of vtkRadiosityFilter, e.g. 0123")
    parser.add_argument("--only", default="", help="part of the programs' names")
    parser.add_argument("--out", default="radiosity-others")
    return parser.parse_args()


def programs(options, seconds):
    found = [Ours(options.threads, seconds, METHODS.index(METHODS[int(m)])) for m in options.methods]
    from radiosity.mitsuba3 import Mitsuba
    found += [Mitsuba(options.threads, seconds, True), Mitsuba(options.threads, seconds, False)]
    radiance = importlib.util.find_spec("pyradiance")
    if radiance:
        from radiosity.radiance import Radiance
        folder = os.path.dirname(radiance.origin)
        found += [Radiance(folder, options.threads, seconds, cache) for cache in (True, False)]
    else:
        print("no pyradiance: left out", file=sys.stderr)
    return [program for program in found if options.only in program.name]


def judged(values, exact, spread):
    lit = exact > 0.01 * exact.max(0)
    relative = values[lit] / exact[lit] - 1.0
    noise = ((spread[lit] / exact[lit])**2).mean()
    square = (relative**2).mean()
    return {"rms": float(np.sqrt(max(square - noise, 0.04 * square))), "rawRms": float(np.sqrt(square)),
            "mean": float(relative.mean()), "greatest": float(np.abs(relative).max())}


def sweep(program, box, exact, spread, limit):
    curve = []
    for setting, values, seconds, everything in program.sweep(box, limit):
        run = {"setting": setting, "seconds": seconds, "allSeconds": everything,
               **judged(values, exact, spread)}
        if isinstance(program, Ours):
            run["stated"] = float(np.median(program.stated[exact > 0] / exact[exact > 0]))
            run["covered"] = float((np.abs(values - exact)
                                    <= np.hypot(program.stated, 2 * spread)).mean())
            run["method"] = program.why
        curve.append(run)
        print(f"{program.name:26s} {setting:48s} {seconds:9.3f} s {run['rms']:.2e} "
              f"{run.get('covered', 0):.3f} {run.get('method', '')[:60]}", file=sys.stderr)
    return {"name": program.name, "curve": curve, "slope": fitted(curve)}


def add_times(rows):
    """Seconds at each level, and the factor over the first program's."""
    for row in rows:
        row["at"] = []
        for level in LEVELS:
            entry = {"error": level}
            for key, factor in (("seconds", "factor"), ("allSeconds", "allFactor")):
                ours, beyond = seconds_at(rows[0]["curve"], level, key)
                theirs, extrapolated = seconds_at(row["curve"], level, key)
                entry[key], entry["extrapolated"] = theirs, extrapolated
                entry[factor] = theirs / ours if ours and theirs and not beyond else None
            row["at"].append(entry)


def main():
    options = arguments()
    if options.site:
        sys.path.append(options.site)
    if not importlib.util.find_spec("mitsuba"):
        sys.exit("no mitsuba (--site DIR): no reference, nothing to compare")
    from radiosity.mitsuba3 import Mitsuba
    box = Box(options.edge)
    everywhere = os.sched_getaffinity(0)
    exact, spread, particles = reference.by_particles(
        Mitsuba(len(everywhere), clock, True), box, options.reference_seconds)
    ours = Ours(len(everywhere), time.monotonic)
    values, _ = ours.run(box, 0.002, 0.5 * options.reference_seconds)
    check = reference.agreement(exact, spread, values, ours.stated)
    print(len(box), "cells", particles, "particles", check, file=sys.stderr)

    # The same cores for all: a library's pool may hold one thread more than it was asked for.
    os.sched_setaffinity(0, sorted(everywhere)[-options.threads:])
    found = programs(options, clock if options.threads == 1 else time.monotonic)
    out = {"question": "error against time of irradiance with all reflections, Cornell box",
           **provenance(), "threads": options.threads, "cells": len(box), "edge": options.edge,
           "versions": {p.name: p.version for p in found},
           "reference": {"particles": particles, "tolerance": 0.002, **check}}
    out["rows"] = [sweep(program, box, exact, spread, options.seconds) for program in found]
    add_times(out["rows"])
    write(options.out, out)


if __name__ == "__main__":
    main()
