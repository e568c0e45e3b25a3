# SPDX-License-Identifier: BSD-3-Clause
"""Errors against the truth, and what they cost: slopes and the time to an error."""
import numpy as np

LEVELS = (0.1, 0.01, 0.001, 0.0001)
LIT = 0.01     # of a band's greatest value: what gets less is not judged relative to itself
SUDDEN = 100.0  # times less error than the run before
EXACT = 1e-9   # errors below are rounding and have no slope


def judged(values, truth):
    """RMS of the relative difference over what is lit, the truth's own noise taken off."""
    exact, spread = truth.values, truth.spread
    lit = exact > LIT * exact.max(0)
    relative = values[lit] / exact[lit] - 1.0
    noise = ((spread[lit] / exact[lit])**2).mean()
    square = (relative**2).mean()
    return {"rms": float(np.sqrt(max(square - noise, 0.04 * square))),
            "mean": float(relative.mean()), "greatest": float(np.abs(relative).max())}


def covered(values, error, truth):
    """Share of values whose stated error, with two of the truth's, holds the difference."""
    rounding = 1e-12 * truth.values.max(0)
    allowed = np.hypot(error, 2.0 * truth.spread) + rounding
    if truth.check is not None:
        allowed = allowed + 1e-5 * truth.values.max(0)
    return float((np.abs(values - truth.values) <= allowed).mean())


def noise_of(truth):
    lit = truth.values > LIT * truth.values.max(0)
    return float(np.sqrt(((truth.spread[lit] / truth.values[lit])**2).mean()))


def fitted(curve, key="seconds"):
    """p of error = c time^p over the sweep; None where the error has no trend."""
    runs = [(run[key], run["rms"]) for run in curve if run["rms"] > EXACT]
    if len(runs) < 3:
        return None
    return float(np.polyfit(*np.log(np.array(runs)).T, 1)[0])


def front(curve, key):
    """The runs that none beats in both time and error."""
    best, out = np.inf, []
    for time, rms in sorted((run[key], run["rms"]) for run in curve):
        if rms < best:
            out.append((time, rms))
            best = rms
    return out


def seconds_at(curve, level, key="seconds"):
    """The least time for an error, between the runs of a sweep; None where none reaches it. Where a
    run is suddenly exact, nothing is told between it and the one before."""
    runs = front(curve, key)
    for number, (time, rms) in enumerate(runs):
        if rms <= level:
            if number == 0:
                return time
            before = runs[number - 1]
            if before[1] > SUDDEN * rms:
                return time
            share = np.log(before[1] / level) / np.log(before[1] / rms)
            return float(before[0] * (time / before[0])**share)
    return None


def add_times(programs, floor):
    """Each program's time to the levels and its factor over the first program's. Errors below half of
    the truth's own (`floor`) cannot be told."""
    for program in programs:
        program["slope"] = fitted(program["curve"])
        program["at"] = []
        for level in LEVELS:
            entry = {"error": level, "judged": level >= 0.5 * floor}
            for key, factor in (("seconds", "factor"), ("allSeconds", "allFactor")):
                entry[key] = entry[factor] = None
                if entry["judged"]:
                    ours = seconds_at(programs[0]["curve"], level, key)
                    entry[key] = seconds_at(program["curve"], level, key)
                    if ours and entry[key]:
                        entry[factor] = entry[key] / ours
            program["at"].append(entry)
