# SPDX-License-Identifier: BSD-3-Clause
"""What the plan saves, predictions, budgets, refinement and parts of the error, in words:
benchmarks/results/accuracy-runs.json, and the predictions of every run that is on record."""
import numpy as np

from pages.words import from_where, listed, number, percent, result, share, table, times

SLOWER = 0.97    # On over Auto: Auto is more than 3 % slower
OPEN = 5.0       # demanded of open scenes


def saving(data):
    rows = []
    for row in data["rows"]:
        for s in row["saving"]:
            rays = "–"
            if s["raysOn"]:
                rays = f"{number(s['raysAuto'])} / {number(s['raysOn'])}"
            rows.append([row["scene"] + (" (open)" if row["open"] else ""), s["filter"],
                         percent(s["tolerance"]), number(s["auto"]), number(s["on"]),
                         f"**{s['ratio']:.2f}**", f"{s['ratioLow']:.2f} – {s['ratioHigh']:.2f}", rays,
                         s["pairs"], share(s["agree"])])
    return table(["scene", "filter", "asked", "s, Auto", "s, all On", "On/Auto", "quartiles",
                  "rays, Auto / On", "pairs", "agree"], rows)


def saving_said(data):
    every = [(row, s) for row in data["rows"] for s in row["saving"]]
    open_ones = [(row, s) for row, s in every if row["open"]]
    slower = [(row, s) for row, s in every if s["ratio"] < SLOWER]
    commits = sorted({row["commit"] for row in data["rows"]})
    lines = [from_where({**data, "commit": listed(commits)}) + "."]
    for name in ("Irradiance", "Radiosity"):
        ratios = [s["ratio"] for _, s in open_ones if s["filter"] == name]
        if ratios:
            enough = sum(ratio >= OPEN for ratio in ratios)
            lines.append(f"{name} on the open scenes: {listed(f'{r:.1f}' for r in ratios)} times as fast "
                         f"({enough} of {len(ratios)} at least the {OPEN:g} times that were asked for).")
    if slower:
        lines.append("More than 3 % slower with the plan: " + listed(
            f"{row['scene']}, {s['filter']} ({100 * (1 / s['ratio'] - 1):.0f} %)" for row, s in slower) + ".")
    else:
        lines.append("Nowhere is the plan more than 3 % slower than all effects On.")
    return " ".join(lines)


def refinement(data):
    rows = []
    for row in data["rows"]:
        r = row["refinement"]
        rows.append([row["scene"], f"{percent(r['loose'])}, then {percent(r['tight'])}",
                     number(r["first"]), number(r["then"]), number(r["atOnce"]), f"{r['ratio']:.2f}",
                     share(r["agree"])])
    return table(["scene", "asked", "s, first", "s, refined", "s, at once", "both / at once",
                  "agree within errors"], rows)


def all_budgets(data):
    rows = [{"scene": row["scene"], **b} for row in data["rows"] for b in row["budgets"]]
    direct, radiosity = result("direct-prediction"), result("radiosity-prediction")
    for more in (direct["budgets"] if direct else []):
        rows.append({"scene": f"{more['scene']}, direct", "given": more["budget"], "wall": more["seconds"],
                     "outcome": more["outcome"], "kept": more["kept"]})
    for more in (radiosity["budgets"] if radiosity else []):
        rows.append({"scene": f"{more['scene']}, radiosity", "given": more["budget"],
                     "wall": more["update"], "outcome": more["outcome"], "kept": more["kept"]})
    return rows


def budgets(data):
    every = all_budgets(data)
    limited = [b for b in every if "budget" in b["outcome"] or not b["kept"]]
    kept = [b for b in limited if b["kept"]]
    rows = []
    for scene in dict.fromkeys(b["scene"] for b in limited):
        rows.append([scene, ", ".join(f"{b['given']:g}: {b['wall']:.2f}{'' if b['kept'] else ' (not kept)'}"
                                      for b in limited if b["scene"] == scene)])
    return (f"{len(kept)} of {len(limited)} budgets that ended a run were kept within 10 % or 0.5 s; "
            f"{len(every) - len(limited)} further runs had met what was asked, or were as fine as can be, "
            "before.\n\n" + table(["scene", "given: taken, s of the clock"], rows))


def predictions():
    """(source, filter, predicted, actual, share of the run after which it was said) of every run on record
    that said something, and how many said nothing."""
    found, silent = [], {}

    def add(source, kind, predicted, seconds, at):
        if predicted is None or predicted < 0.0 or not seconds:
            silent[source] = silent.get(source, 0) + 1
        else:
            found.append((source, kind, predicted, seconds, min(1.0, (at or 0.0) / seconds)))

    curves, runs = result("accuracy-curves"), result("accuracy-runs")
    for row in (curves["rows"] if curves else []):
        for run in (row["programs"][0]["curve"] if "programs" in row else []):
            add("error against time", "Radiosity" if row["indirect"] else "Irradiance",
                *(run["cost"].get(name) for name in ("predicted", "seconds", "predictedAt")))
    for row in (runs["rows"] if runs else []):
        for note in row["notes"]:
            kind = "Radiosity" if "Radiosity" in note["filter"] else "Irradiance"
            what = note["what"].split(",")[0]
            source = {"saving": "what the plan saves", "budget": "budgets"}.get(what, "refinement")
            add(source, kind, *(note.get(name) for name in ("predicted", "seconds", "predictedAt")))
    for name, kind in (("direct-prediction", "Irradiance"), ("radiosity-prediction", "Radiosity")):
        data = result(name)
        for row in (data.get("predictions") or data.get("runs") or [] if data else []):
            lower = {key.lower(): value for key, value in row.items()}
            add(name, kind, lower.get("predicted", lower.get("predictedseconds")), lower.get("seconds"),
                lower.get("predictedat"))
    return found, silent


def within(ratios, factor=2.0):
    ratios = np.asarray(ratios)
    return float((np.abs(np.log(ratios)) <= np.log(factor)).mean())


def prediction_row(words, runs):
    ratios = [predicted / seconds for _, _, predicted, seconds, _ in runs]
    if not ratios:
        return []
    return [[*words, len(ratios), f"{np.median(ratios):.2f}", share(within(ratios)),
             f"{min(ratios):.2g} – {max(ratios):.2g}", percent(float(np.median([r[4] for r in runs])))]]


def prediction_table():
    found, silent = predictions()
    if not found:
        return None
    rows = []
    for source in dict.fromkeys(run[0] for run in found):
        for kind in ("Irradiance", "Radiosity"):
            rows += prediction_row([source, kind], [r for r in found if r[:2] == (source, kind)])
    for kind in ("Irradiance", "Radiosity"):
        rows += prediction_row(["**all**", kind], [r for r in found if r[1] == kind])
    rows += prediction_row(["**all**", "both"], found)
    rows += prediction_row(["**all of more than 0.1 s**", "both"], [r for r in found if r[3] > 0.1])
    rows += prediction_row(["**all said in the first half of the run**", "both"],
                           [r for r in found if r[4] <= 0.5])
    ratios = [predicted / seconds for _, _, predicted, seconds, _ in found]
    edges = [0.0, 0.25, 0.5, 0.7, 0.85, 1.0, 1.2, 1.4, 2.0, 4.0, np.inf]
    counts = np.histogram(ratios, edges)[0]
    words = [f"{a:g} – {b:g}" if b < np.inf else f"over {a:g}" for a, b in zip(edges, edges[1:])]
    text = table(["runs of", "filter", "runs", "median of predicted/actual", "within a factor of 2",
                  "range", "said after this share of the run, median"], rows)
    text += "\n\n" + table(["predicted/actual", *words], [["runs", *counts]])
    if silent:
        text += "\n\nSaid nothing (too short for a pilot, or gone on with): " + ", ".join(
            f"{count} of {name}" for name, count in silent.items()) + "."
    return text


def parts(data):
    names = list(dict.fromkeys(name for row in data["rows"] for name in row["error"]["parts"]))
    rows = []
    for row in data["rows"]:
        e = row["error"]
        cells = [percent(e["parts"].get(name)) if e["parts"] else "–" for name in names]
        rows.append([row["scene"], percent(row["refinement"]["tight"]),
                     e["method"].split(" as ")[0] or "direct light", *cells, percent(e["stated"]),
                     f"{e['memory']:.1f}" if e["memory"] else "–", f"{row['peakMiB']:.0f}"])
    return table(["scene", "asked", "method", *names, "all, median", "MiB, operator", "MiB, process"], rows)
