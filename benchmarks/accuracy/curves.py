#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Question: what does an error cost in time, beside Mitsuba 3, Radiance and pyviewfactor?

The scenes of accuracy/scenes.py, judged by accuracy/truth.py. Every program is asked on the same machine
in the same run on one core, in the fastest fair way that we know for it (accuracy/mitsuba3.py,
radiance.py, factors.py say which); scenes run beside each other, a core each.

A curve is a sweep of the setting that trades time for error. The error is the RMS of the relative
difference over cells and bands that get more than 1 % of the band's greatest value. Seconds are processor
seconds (accuracy/clock.py), counted twice: `seconds` leaves out what others do before light (loading and
compiling, oconv, the start of a process) and nothing for the filters of the project; `allSeconds` counts
all of it.

    ./run --python benchmarks/accuracy/curves.py [--site DIR] [--python-of-peer DIR/bin/python] ...

The peers are optional: what is absent is left out, with a line. Writes
benchmarks/results/accuracy-curves.json; a scene that is not asked, or
does not end, keeps what stands there.
"""
import argparse
import importlib.util
import json
import os
import subprocess
import sys
import tempfile
import time

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from accuracy import judge  # noqa: E402
from accuracy.scenes import MAKERS, scene  # noqa: E402
from accuracy.truth import truth  # noqa: E402
from provenance import provenance, result, write  # noqa: E402

NAME = "accuracy-curves"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--site", help="folder that holds mitsuba and pyradiance")
    parser.add_argument("--python-of-peer", help="a Python that has pyviewfactor")
    parser.add_argument("--seconds", type=float, default=6.0,
                        help="a sweep ends with the first run that is longer")
    parser.add_argument("--jobs", type=int, default=max(1, len(os.sched_getaffinity(0)) - 1))
    parser.add_argument("--only", default="", help="scenes, with commas between")
    parser.add_argument("--out", default=NAME)
    parser.add_argument("--child", help=argparse.SUPPRESS)
    return parser.parse_args()


def programs(options, one):
    """Ours first; then the peers that are here and can do the task."""
    from accuracy.ours import Ours
    found, absent = [Ours()], []
    if options.site:
        sys.path.append(options.site)
    if importlib.util.find_spec("mitsuba"):
        from accuracy.mitsuba3 import Mitsuba
        ways = ("particles", "paths") if one.indirect else ("direct",)
        found += [Mitsuba(way).set_threads(1) for way in ways]
    else:
        absent.append("Mitsuba 3")
    radiance = importlib.util.find_spec("pyradiance")
    if radiance:
        from accuracy.radiance import Radiance
        ways = ("ambient cache", "no cache") if one.indirect else ("direct",)
        found += [Radiance(os.path.dirname(radiance.origin), way) for way in ways]
    else:
        absent.append("Radiance")
    from accuracy.factors import PyViewFactor, able
    if options.python_of_peer and able(one):
        found.append(PyViewFactor(options.python_of_peer))
    elif not options.python_of_peer:
        absent.append("pyviewfactor")
    return found, absent


def sweep(program, one, exact, limit):
    curve = []
    for setting, values, seconds, everything in program.sweep(one, limit):
        run = {"setting": setting, "seconds": seconds, "allSeconds": everything,
               **judge.judged(values, exact)}
        last = getattr(program, "last", None)
        if last is not None:
            lit = exact.values > judge.LIT * exact.values.max(0)
            run["stated"] = float(np.median(last.error[lit] / exact.values[lit]))
            run["covered"] = judge.covered(last.values, last.error, exact)
            run["cost"] = last.cost()
            run["outcome"] = last.what_ended_it()
            run["method"] = last.text("RadiometryMethod")
        curve.append(run)
        print(f"{one.key:20s} {program.name:24s} {setting:40s} {seconds:9.4f} s {run['rms']:.2e} "
              f"{run.get('covered', 0):.3f}", file=sys.stderr, flush=True)
    return {"name": program.name, "version": str(program.version), "curve": curve}


def child(options):
    """One scene, on the core that this process was given."""
    one = scene(options.child)
    exact = truth(one)
    found, absent = programs(options, one)
    row = {"key": one.key, "scene": one.name, "values": len(one), "bands": one.bands,
           "points": one.sensors is not None, "indirect": one.indirect, "absent": absent}
    if exact is None:
        row["noTruth"] = True
    else:
        row["truth"] = {"source": exact.source, "check": exact.check, "noise": judge.noise_of(exact)}
        row["programs"] = [sweep(program, one, exact, options.seconds) for program in found]
        judge.add_times(row["programs"], row["truth"]["noise"])
    with open(options.out, "w", encoding="utf-8") as file:
        json.dump(row, file)


def beside_each_other(keys, command, jobs, finished):
    """Runs `command(key, path)` of each scene in a process of its own, a core each, the longest first."""
    cores = sorted(os.sched_getaffinity(0))[-jobs:]
    waiting, running = list(keys), {}
    with tempfile.TemporaryDirectory() as folder:
        while waiting or running:
            free = [core for core in cores if core not in running]
            while waiting and free:
                core, key = free.pop(), waiting.pop(0)
                path = os.path.join(folder, key + ".json")
                process = subprocess.Popen(command(key, path), preexec_fn=lambda c=core:
                                           os.sched_setaffinity(0, {c}))
                running[core] = (key, path, process)
            for core, (key, path, process) in list(running.items()):
                if process.poll() is not None:
                    del running[core]
                    if process.returncode == 0:
                        with open(path, encoding="utf-8") as file:
                            finished(key, json.load(file))
                    else:
                        print(f"{key}: ended with {process.returncode}: left out", file=sys.stderr)
            time.sleep(0.1)


def main():
    options = arguments()
    if options.child:
        child(options)
        return
    wanted = options.only.split(",") if options.only else list(MAKERS)
    old = result(options.out)  # scenes that do not end keep what stands there, with its commit
    rows = {row["key"]: row for row in old["rows"]} if old else {}
    about = {"question": "error against time beside others", **provenance(), "threads": 1,
             "beside": options.jobs, "seconds": options.seconds}

    def finished(key, row):
        rows[key] = {**row, "commit": about["commit"]}
        write(options.out, {**about, "rows": [rows[k] for k in MAKERS if k in rows]})

    def command(key, path):
        return [sys.executable, *sys.argv, "--child", key, "--out", path]

    for key in wanted:  # before the clock runs: by plain numpy, on all cores
        truth(scene(key))
    longest = ("gallery", "cornell-box", "street-canyon", "crater")
    beside_each_other(sorted(wanted, key=lambda k: k not in longest), command, options.jobs, finished)


if __name__ == "__main__":
    main()
