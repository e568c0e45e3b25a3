# SPDX-License-Identifier: BSD-3-Clause
"""Error against time beside others, in words: benchmarks/results/accuracy-curves.json."""
import numpy as np

from pages.words import listed, number, percent, share, table, times

OURS = "vtkRadiometry"
EXACT = 1e-9


def judged_rows(data):
    return [row for row in data["rows"] if "programs" in row]


def about(data):
    rows = judged_rows(data)
    versions = {}
    for row in rows:
        for program in row["programs"]:
            versions[program["name"].split(",")[0]] = program["version"]
    commits = sorted({row.get("commit", data["commit"]) for row in data["rows"]})
    absent = sorted({name for row in data["rows"] for name in row["absent"]})
    lines = [f"Commit {listed(commits)}, {data['processor']}, one thread a program, "
             f"{data['beside']} scenes beside each other on cores of their own, load {data['load']:.0f} "
             "of other work when it began. " + ", ".join(
                 f"{name} {version.split()[1] if name == 'Radiance' and ' ' in version else version}"
                 for name, version in versions.items()) + "."]
    lines += [f"{name} was absent and is left out." for name in absent]
    without = [row["scene"] for row in data["rows"] if "noTruth" in row]
    if without:
        lines.append(f"Without a reference and so not judged: {listed(without)}.")
    return "\n".join(lines)


def scenes(data):
    rows = []
    for row in judged_rows(data):
        truth = row["truth"]
        own = f"{percent(truth['noise'])} RMS" if truth["noise"] else (
            f"{number(truth['check'])}, summation" if truth["check"] is not None else "rounding")
        rows.append([row["scene"], f"{row['values']} {'places' if row['points'] else 'cells'}"
                     + (f", {row['bands']} bands" if row["bands"] > 1 else ""),
                     "all" if row["indirect"] else "none", truth["source"], own])
    return table(["scene", "values", "reflections", "truth", "its own error"], rows)


def slope(program):
    worst = max(run["rms"] for run in program["curve"])
    if worst < EXACT:
        return f"exact ({number(worst)})"
    return "–" if program["slope"] is None else f"{program['slope']:.2f}"


def at_level(program, ours, at):
    """Seconds and factor to ours, as words."""
    if not at["judged"]:
        return "·", "·"
    if at["seconds"] is None:
        longest = max(run["seconds"] for run in program["curve"])
        known = ours["seconds"]
        return f"> {number(longest)}", f"> {times(longest / known)}" if known else "–"
    return number(at["seconds"]), times(at["factor"])


def levels(data):
    head = ["scene", "program", "slope"]
    for at in judged_rows(data)[0]["programs"][0]["at"]:
        head += [f"s at {100 * at['error']:g} %", "×"]
    rows = []
    for row in judged_rows(data):
        ours = row["programs"][0]
        for program in row["programs"]:
            cells = [row["scene"] if program is ours else "", program["name"], slope(program)]
            for at, mine in zip(program["at"], ours["at"]):
                cells += at_level(program, mine, at)
            rows.append(cells)
    return (table(head, rows) + "\n\ns: processor seconds until the RMS error is that small; ×: its seconds "
            "over vtkRadiometry's; >: not reached by its longest run; ·: below what the reference can "
            "tell. Slope: p of error = c seconds^p.")


def comparisons(data):
    """(scene, level, the peer that is first there, its entry, ours), where a level can be judged."""
    for row in judged_rows(data):
        ours = row["programs"][0]
        for number_of, mine in enumerate(ours["at"]):
            if not mine["judged"]:
                continue
            peers = [(p, p["at"][number_of]) for p in row["programs"][1:]
                     if p["at"][number_of]["seconds"] is not None]
            best = min(peers, key=lambda peer: peer[1]["seconds"], default=None)
            yield row, mine, best


def not_the_best(data):
    """Where another program is ahead, and where nobody can tell."""
    ahead, lost, count, won, nobody, blind = [], [], 0, 0, 0, 0
    for row in judged_rows(data):
        blind += sum(not at["judged"] for at in row["programs"][0]["at"])
    everything = 0  # first with all counted
    for row, mine, best in comparisons(data):
        count += 1
        others = [at["allSeconds"] for p in row["programs"][1:] for at in p["at"]
                  if at["error"] == mine["error"] and at["allSeconds"] is not None]
        everything += mine["allSeconds"] is not None and mine["allSeconds"] <= min(others, default=np.inf)
        if mine["seconds"] is None and best is None:
            nobody += 1
        elif mine["seconds"] is None:
            lost.append((row, mine, best))
        elif best is None or best[1]["seconds"] >= mine["seconds"]:
            won += 1
        else:
            ahead.append((row, mine, best))
    lines = [f"Of {count} pairs of scene and error that can be judged ({blind} are below what a reference "
             f"tells), vtkRadiometry is the first in {won}, and with loading and compiling counted for all in "
             f"{everything}; in {nobody} nobody got there."]
    if ahead:
        lines.append("Another program is ahead of it:\n")
        for row, mine, (program, at) in sorted(ahead, key=lambda e: e[2][1]["factor"]):
            loaded = (f"; {times(at['allFactor'])} of it with loading and compiling" if at["allFactor"]
                      else "")
            lines.append(f"- {row['scene']} at {100 * mine['error']:g} %: {program['name']} needs "
                         f"{times(at['factor'])} of vtkRadiometry's time{loaded}.")
    if lost:
        lines.append("\nvtkRadiometry's longest run did not get there, another program's did:\n")
        for row, mine, (program, at) in lost:
            lines.append(f"- {row['scene']} at {100 * mine['error']:g} %: {program['name']} in "
                         f"{number(at['seconds'])} s.")
    flat = [(row["scene"], row["programs"][0]["slope"]) for row in judged_rows(data)
            if row["programs"][0]["slope"] is not None and row["programs"][0]["slope"] > -0.45]
    if flat:
        lines.append("\nIts error falls more slowly than time^-0.45: " + ", ".join(
            f"{name} ({p:.2f})" for name, p in flat) + ".")
    return "\n".join(lines)


def ours_alone(data):
    """Stated against true, run by run."""
    rows = []
    for row in judged_rows(data):
        runs = row["programs"][0]["curve"]
        steps = [run for run in runs if run["setting"].split()[-1] in ("0.1", "0.01", "0.001")] or runs[-1:]
        for run in steps:
            rows.append([row["scene"], run["setting"].split()[-1], number(run["seconds"]),
                         number(run["rms"]), number(run["stated"]), share(run["covered"]),
                         run["method"].split(":")[0].split(" as ")[0] or "direct light"])
    return table(["scene", "tolerance", "s", "true error, RMS", "stated error, median", "covered",
                  "method"], rows)


