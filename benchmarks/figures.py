#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the figures of docs/accuracy.md from the results of the benchmarks, and writes its tables.

    /usr/bin/python3 benchmarks/figures.py

Reads benchmarks/results/*.json; writes docs/images/direct-*.png, radiosity-*.png, view-factors.png and
what stands in docs/accuracy.md between <!-- direct: NAME -->, <!-- radiosity: NAME --> or
<!-- view: factors --> and <!-- end -->.
"""
import json
import os
import re
import sys

import matplotlib
import numpy as np

sys.modules.setdefault("figures", sys.modules[__name__])
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
COLOURS = {"vtkRadiometry": "#c0392b", "Mitsuba 3": "#2471a3", "Radiance": "#d68910"}
MARKS = {"vtkRadiometry": "o", "Mitsuba 3": "s", "Radiance": "^"}
FLOOR = 1e-6  # errors below are drawn on this line
FEWEST = 30  # values, for a bar of coverage


def results(name, prefix="direct-"):
    path = os.path.join(ROOT, "benchmarks", "results", f"{prefix}{name}.json")
    if not os.path.exists(path):
        return None
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def save(figure, name, prefix="direct-"):
    figure.savefig(os.path.join(ROOT, "docs", "images", f"{prefix}{name}.png"), dpi=110)
    plt.close(figure)


def draw_others(data):
    rows = data["rows"]
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    figure, axes = plt.subplots(2, len(scenes), figsize=(4.0 * len(scenes), 7.4), sharey=True,
                                squeeze=False)
    for row in rows:
        ax = axes[0 if row["receivers"] == "cells" else 1][scenes.index(row["scene"])]
        for program in row["programs"]:
            name = program["name"]
            ax.loglog([run["seconds"] for run in program["curve"]],
                      [max(run["rms"], FLOOR) for run in program["curve"]],
                      marker=MARKS[name], ms=5, lw=1.3, color=COLOURS[name], label=name)
        where = "averages of cells" if row["receivers"] == "cells" else "values at points"
        ax.set_title(f"{row['scene']}\n{where}", fontsize=10)
        for level in (1e-2, 1e-3):
            ax.axhline(level, color="grey", lw=0.7, ls=":")
        ax.set_ylim(FLOOR / 2, 1)
        ax.set_xlim(5e-4, 20)
        ax.set_xlabel("processor seconds")
        ax.grid(alpha=0.25)
    for ax in axes[:, 0]:
        ax.set_ylabel("RMS relative error")
        ax.set_yticks([10.0**k for k in range(-6, 1)])
        ax.set_yticklabels(["≤ $10^{-6}$"] + [f"$10^{{{k}}}$" for k in range(-5, 1)])
    axes[0][0].legend(fontsize=9, loc="upper right")
    figure.tight_layout()
    save(figure, "error-against-time")


def exponent(rows, size, least):
    """p of seconds = c size^p, least squares of the logarithms over sizes from `least` on."""
    rows = [row for row in rows if row and row[size] >= least]
    return np.polyfit(np.log([row[size] for row in rows]),
                      np.log([row["seconds"] for row in rows]), 1)[0]


def draw_scaling(data):
    figure, (cells, lights, memory) = plt.subplots(1, 3, figsize=(13.5, 4.2))
    rows = [r for r in data["overCells"] if r]
    x = [r["cells"] for r in rows]
    power = data["exponents"]["overCells"]
    for key, label, colour in (("seconds", "direct light, shadow lines included", "#c0392b"),
                               ("secondsAgain", "again on the same geometry", "#e59866"),
                               ("buildingSeconds", "Embree's hierarchy", "#7f8c8d")):
        cells.loglog(x, [r[key] for r in rows], marker="o", ms=4, color=colour,
                     label=f"{label}: $n^{{{power[key]:.2f}}}$")
    cells.set(xlabel="triangles", ylabel="seconds", title="One point light, 1 % asked")
    for key, label, colour in (("overLightsThatAllMatter", "every light matters", "#c0392b"),
                               ("overLightsOfWhichFewMatter", "few matter to a cell", "#2471a3")):
        rows_l = [r for r in data[key] if r]
        p = exponent(rows_l, "lights", 100)
        lights.loglog([r["lights"] for r in rows_l], [r["seconds"] for r in rows_l], marker="o",
                      ms=4, color=colour, label=f"{label}: $n^{{{p:.2f}}}$")
    lights.set(xlabel="point lights", ylabel="seconds", title="2048 cells, 64 boxes, 1 % asked")
    memory.loglog(x, [r["peakBytesPerCell"] for r in rows], marker="o", ms=4, color="#c0392b",
                  label="peak, everything included")
    memory.loglog(x, [r["inputBytesPerCell"] for r in rows], marker="o", ms=4, color="#7f8c8d",
                  label="scene and patches alone")
    memory.set(xlabel="triangles", ylabel="bytes a cell", title="Memory")
    for ax, place in ((cells, "upper left"), (lights, "upper left"), (memory, "upper right")):
        ax.grid(alpha=0.25)
        ax.legend(fontsize=9, loc=place)
    cells.set_ylim(top=cells.get_ylim()[1] * 30)
    lights.set_ylim(top=lights.get_ylim()[1] * 5)
    figure.tight_layout()
    save(figure, "scaling")


def draw_coverage(table):
    figure, ax = plt.subplots(figsize=(9.0, 0.21 * len(table) + 1.2))
    names = [f"{light}, {receivers}" for light, receivers, _ in table][::-1]
    for offset, key, count, label, colour in (
            (0.18, "exactCoverage", "exact", "exact to rounding", "#7f8c8d"),
            (-0.18, "estimatedCoverage", "estimated", "estimated", "#c0392b")):
        y = [i + offset for i, (_, _, s) in enumerate(table[::-1]) if s[count] >= FEWEST]
        share = [100 * s[key] for _, _, s in table[::-1] if s[count] >= FEWEST]
        ax.barh(y, [v - 80 for v in share], left=80, height=0.34, color=colour, label=label)
    ax.axvline(95, color="black", lw=1, ls="--")
    ax.set_yticks(range(len(names)))
    ax.set_yticklabels(names, fontsize=7.5)
    ax.set_ylim(-0.6, len(names) - 0.4)
    ax.set(xlim=(80, 100.5), xlabel="share of values whose true error is within the stated one, %")
    ax.legend(fontsize=9, loc="lower center", bbox_to_anchor=(0.4, 1.0), ncol=2)
    figure.tight_layout()
    save(figure, "coverage")


def coverage_table(data):
    """Rows joined over blockers: (light, receivers, sums)."""
    table = {}
    for row in data["rows"]:
        s = table.setdefault((row["light"], row["receivers"]), {
            "exact": 0, "estimated": 0, "a": 0.0, "b": 0.0, "undecided": 0, "medians": []})
        s["exact"] += row["exact"]
        s["estimated"] += row["estimated"]
        s["undecided"] += row["undecided"]
        s["a"] += row["exact"] * row["exactCoverage"]
        s["b"] += row["estimated"] * row["estimatedCoverage"]
        if row["estimated"]:
            s["medians"].append((row["blockers"], row["medianRatio"], row["estimated"]))
    for s in table.values():
        s["exactCoverage"] = s["a"] / s["exact"] if s["exact"] else None
        s["estimatedCoverage"] = s["b"] / s["estimated"] if s["estimated"] else None
    return [(light, receivers, s) for (light, receivers), s in table.items()]


def share(value):
    return "–" if value is None else f"{100 * value:.1f} %"


def number(value):
    if value is None:
        return "–"
    if value >= 1000:
        return f"{value:.1e}".replace("e+0", "e")
    return f"{value:.3g}"


def others_text(data):
    lines = [f"Commit {data['commit']}, {data['processor']}, {data['threads']} thread(s), "
             f"{data['cells']} receivers, load {data['load']:.0f} of other work on the machine.", "",
             "| scene | receivers | program | slope | seconds at 1 % | factor | all counted | "
             "seconds at 0.1 % | factor | all counted |", "|---|---|---|---|---|---|---|---|---|---|"]
    for row in data["rows"]:
        for program in row["programs"]:
            cells = []
            for at, ours in zip(program["at"], row["programs"][0]["at"]):
                seconds, mark = at["seconds"], ""
                if at["extrapolated"]:  # not reached: at least its longest run
                    seconds, mark = max(run["seconds"] for run in program["curve"]), "> "
                cells += [mark + number(seconds), mark + number(seconds / ours["seconds"]),
                          "–" if mark else number(at["allFactor"])]
            slope = "–" if program["slope"] is None else f"{program['slope']:.2f}"
            worst = max(run["rms"] for run in program["curve"])
            if worst < 1e-5:
                slope = f"error {worst:.0e}"
            lines.append(f"| {row['scene']} | {row['receivers']} | {program['name']} | {slope} | "
                         + " | ".join(cells) + " |")
    lines += ["", ">: not reached by its longest run. Slope: p of error = c seconds^p; \"error\" where it does "
              "not depend on time. All counted: loading and compiling included."]
    return "\n".join(lines)


def scaling_text(data):
    p = data["exponents"]
    last = [r for r in data["overCells"] if r][-1]
    all_last = [r for r in data["overLightsThatAllMatter"] if r]
    few_last = [r for r in data["overLightsOfWhichFewMatter"] if r]
    lines = [f"Commit {data['commit']}, {data['processor']}, {data['threads']} threads, "
             f"load {data['load']:.0f} of other work.", "", "| | exponent | at the greatest size |",
             "|---|---|---|",
             f"| seconds against triangles | {p['overCells']['seconds']:.2f} | "
             f"{last['cells']:.2g}: {last['seconds']:.2f} s, {last['buildingSeconds']:.2f} s before "
             "it for Embree's hierarchy |",
             f"| the same geometry again | {p['overCells']['secondsAgain']:.2f} | "
             f"{last['secondsAgain']:.2f} s |"]
    for key, label, rows in (
            ("overLightsThatAllMatter", "seconds against lights, every one matters", all_last),
            ("overLightsOfWhichFewMatter", "seconds against lights, few matter to a cell",
             few_last)):
        lines.append(f"| {label} | {exponent(rows, 'lights', 100):.2f} (from 100 on) | {rows[-1]['lights']}: "
                     f"{rows[-1]['seconds']:.2f} s, {rows[-1]['seconds'] / rows[0]['seconds']:.0f} "
                     f"times one light; stated error {rows[-1]['meanError']:.1e} |")
    lines.append(f"| memory | | {last['peakBytesPerCell']:.0f} bytes a cell at the peak, of which "
                 f"{last['inputBytesPerCell']:.0f} are the scene and its patches |")
    return "\n".join(lines)


def coverage_text(data, table):
    every = data["all"]
    lines = [f"Commit {data['commit']}; {data['seeds']} seeds a case.", "",
             "| light | receivers | exact to rounding | covered | estimated | covered | "
             "median error/true error, by blockers |", "|---|---|---|---|---|---|---|"]
    for light, receivers, s in table:
        medians = ", ".join(f"{number(m)} ({b.split()[0]})" for b, m, _ in s["medians"])
        lines.append(f"| {light} | {receivers} | {s['exact']} | {share(s['exactCoverage'])} | "
                     f"{s['estimated']} | {share(s['estimatedCoverage'])} | {medians} |")
    lines.append(f"| **all** | | {every['exact']} | {share(every['exactCoverage'])} | "
                 f"{every['estimated']} | {share(every['estimatedCoverage'])} | "
                 f"{number(every['medianRatio'])} |")
    return "\n".join(lines)


def write(name, text, kind="direct"):
    path = os.path.join(ROOT, "docs", "accuracy.md")
    with open(path, encoding="utf-8") as file:
        page = file.read()
    mark = re.compile(rf"(<!-- {kind}: {name} -->\n)(?:.*?\n)??(<!-- end -->)", re.DOTALL)
    assert mark.search(page), f"no place for {name} in docs/accuracy.md"
    page = mark.sub(lambda m: m.group(1) + text + "\n" + m.group(2), page)
    with open(path, "w", encoding="utf-8") as file:
        file.write(page)


def main():
    others, scaling, coverage = (results(n) for n in ("others", "scaling", "coverage"))
    if others:
        draw_others(others)
        write("others", others_text(others))
    if scaling:
        draw_scaling(scaling)
        write("scaling", scaling_text(scaling))
    if coverage:
        table = coverage_table(coverage)
        draw_coverage(table)
        write("coverage", coverage_text(coverage, table))
    import figures_radiosity  # takes its helpers from here
    figures_radiosity.main()


if __name__ == "__main__":
    main()
