# SPDX-License-Identifier: BSD-3-Clause
"""The figures of docs/accuracy.md, drawn from benchmarks/results."""
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

from pages.curves import judged_rows  # noqa: E402
from pages.plan import predictions, within  # noqa: E402
from pages.scale import exponent, power_of  # noqa: E402
from pages.words import result  # noqa: E402

IMAGES = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))),
                      "docs", "images")
RED, BLUE, ORANGE, GREEN, GREY = "#c0392b", "#2471a3", "#d68910", "#1e8449", "#7f8c8d"
LOOKS = {"vtkRadiometry": (RED, "o", "-"), "Mitsuba 3": (BLUE, "s", "-"),
         "Mitsuba 3, particles": (BLUE, "s", "-"), "Mitsuba 3, paths": ("#85c1e9", "D", "--"),
         "Radiance": (ORANGE, "^", "-"), "Radiance, ambient cache": (ORANGE, "^", "-"),
         "Radiance, no cache": ("#f0b27a", "v", "--"), "pyviewfactor": (GREEN, "P", ":")}
OPERATORS = {"Dense": (BLUE, "s"), "Hierarchical": (RED, "o"), "MonteCarlo": (ORANGE, "^")}
FLOOR = 1e-6  # errors below are drawn on this line


def save(figure, name):
    figure.savefig(os.path.join(IMAGES, name + ".png"), dpi=110)
    plt.close(figure)


def curves(data):
    rows = judged_rows(data)
    across = 3
    down = -(-len(rows) // across)
    figure, axes = plt.subplots(down, across, figsize=(13.5, 4.0 * down + 0.7), sharey=True, squeeze=False)
    looks = {}
    for ax, row in zip(axes.ravel(), rows):
        for program in row["programs"]:
            colour, mark, line = LOOKS.get(program["name"], (GREY, "x", "-"))
            runs = sorted((run["seconds"], max(run["rms"], FLOOR)) for run in program["curve"])
            looks[program["name"]], = ax.loglog(*zip(*runs), marker=mark, ms=5, lw=1.4, ls=line,
                                                color=colour, label=program["name"])
        if row["truth"]["noise"]:
            ax.axhspan(FLOOR / 3, 0.5 * row["truth"]["noise"], color="black", alpha=0.08, lw=0)
            ax.text(1.3e-3, 0.3 * row["truth"]["noise"], "below what the reference tells", fontsize=8,
                    color="#555555", va="top")
        for level in (0.1, 0.01, 0.001, 0.0001):
            ax.axhline(level, color="grey", lw=0.7, ls=":")
        what = "places" if row["points"] else "cells"
        ax.set_title(f"{row['scene']}\n{row['values']} {what}"
                     + (", with reflections" if row["indirect"] else ""), fontsize=11)
        ax.set_ylim(FLOOR / 3, 2)
        ax.set_xlim(1e-3, 40)
        ax.grid(alpha=0.25)
    for ax in axes.ravel()[len(rows):]:
        ax.axis("off")
    for ax in axes[-1]:
        ax.set_xlabel("processor seconds, one thread")
    for ax in axes[:, 0]:
        ax.set_ylabel("RMS relative error")
        ax.set_yticks([10.0**k for k in range(-6, 1)])
        ax.set_yticklabels(["≤ 0.0001 %", "0.001 %", "0.01 %", "0.1 %", "1 %", "10 %", "100 %"])
        ax.minorticks_off()
    figure.legend(looks.values(), looks.keys(), loc="lower center", ncol=4, fontsize=11, frameon=False)
    figure.tight_layout(rect=(0, 0.55 / (4.0 * down + 0.7), 1, 1))
    save(figure, "accuracy-curves")


def saving(data):
    entries = [(f"{row['scene']}{' (open)' if row['open'] else ''}", s)
               for row in data["rows"] for s in row["saving"]]
    figure, ax = plt.subplots(figsize=(10.0, 0.36 * len(entries) + 1.5))
    for y, (_, s) in enumerate(entries[::-1]):
        colour = RED if s["filter"] == "Radiosity" else BLUE
        ax.barh(y, s["ratio"] - 1.0, left=1.0, height=0.7, color=colour)
        ax.plot([s["ratioLow"], s["ratioHigh"]], [y, y], color="black", lw=1.2)
        ax.text(max(s["ratio"], s["ratioHigh"], 1.0) * 1.04, y, f"{s['ratio']:.2f}", va="center", fontsize=9)
    ax.set_yticks(range(len(entries)))
    ax.set_yticklabels([name for name, _ in entries[::-1]], fontsize=9)
    ax.set_xscale("log")
    greatest = max(max(s["ratio"], s["ratioHigh"]) for _, s in entries)
    ax.set_xlim(0.7, max(8.0, 1.6 * greatest))
    ticks = [t for t in (0.8, 1, 1.5, 2, 3, 5, 10, 20, 50, 100) if t < 1.6 * max(greatest, 5.0)]
    ax.set_xticks(ticks)
    ax.set_xticklabels([f"{t:g}" for t in ticks])
    ax.minorticks_off()
    ax.axvline(1.0, color="black", lw=1)
    ax.axvline(5.0, color=GREY, lw=1, ls="--")
    ax.set_xlabel("processor seconds with every effect On, over those with Auto (line: quartiles; dashed: 5)")
    handles = [plt.Rectangle((0, 0), 1, 1, color=c) for c in (BLUE, RED)]
    ax.legend(handles, ["Irradiance", "Radiosity"], fontsize=10, loc="lower center",
              bbox_to_anchor=(0.4, 1.0), ncol=2, frameon=False)
    figure.tight_layout()
    save(figure, "accuracy-saving")


def predicted(found):
    figure, (scatter, bars) = plt.subplots(1, 2, figsize=(12.0, 5.0))
    for kind, colour, mark in (("Irradiance", BLUE, "s"), ("Radiosity", RED, "o")):
        points = [(t, p) for _, k, p, t, _ in found if k == kind]
        if points:
            scatter.loglog(*zip(*points), ls="", marker=mark, ms=5, alpha=0.6, color=colour, label=kind)
    low = 0.5 * min(min(p, t) for _, _, p, t, _ in found)
    high = 2.0 * max(max(p, t) for _, _, p, t, _ in found)
    ends = np.array([low, high])
    scatter.fill_between(ends, 0.5 * ends, 2.0 * ends, color=GREY, alpha=0.2, lw=0, label="factor of 2")
    scatter.plot(ends, ends, color="black", lw=1)
    scatter.set(xlim=ends, ylim=ends, xlabel="seconds that the run took", ylabel="seconds that it predicted")
    scatter.grid(alpha=0.25)
    scatter.legend(fontsize=10, loc="upper left")
    ratios = np.array([p / t for _, _, p, t, _ in found])
    edges = 2.0**np.arange(-3.25, 3.5, 0.5)
    bars.hist(np.clip(ratios, edges[0], edges[-1]), edges, color=GREY, edgecolor="white")
    bars.axvspan(0.5, 2.0, color=GREY, alpha=0.2, lw=0)
    bars.set_xscale("log")
    ticks = [0.125, 0.25, 0.5, 1, 2, 4, 8]
    bars.set_xticks(ticks)
    bars.set_xticklabels([f"{t:g}" for t in ticks])
    bars.minorticks_off()
    bars.set(xlabel="predicted over actual (ends: beyond)", ylabel="runs",
             title=f"{100 * within(ratios):.0f} % of {len(ratios)} runs within a factor of 2")
    figure.tight_layout()
    save(figure, "accuracy-predictions")


def calibration(data):
    rows = [row for row in data["rows"] if row["values"] >= 30]
    figure, (cover, sharp) = plt.subplots(1, 2, figsize=(13.0, 0.2 * len(rows) + 1.4), sharey=True)
    y = np.arange(len(rows))[::-1]
    colours = [RED if row["covered"] < 0.95 else BLUE for row in rows]
    cover.barh(y, [100 * max(row["covered"], 0.8) - 80 for row in rows], left=80, height=0.7, color=colours)
    cover.axvline(95, color="black", lw=1, ls="--")
    cover.set(xlim=(80, 100.5), xlabel="values within their stated error, %")
    sharp.barh(y, [max(row["sharpness"], 1e-3) for row in rows], height=0.7,
               color=[RED if row["sharpness"] > 10.0 else BLUE for row in rows])
    sharp.set_xscale("log")
    sharp.set_xlim(0.5, 100)
    sharp.axvline(10, color="black", lw=1, ls="--")
    sharp.set_xlabel("median of stated over true error")
    cover.set_yticks(y)
    cover.set_yticklabels([f"{row['effect']} | {row['method']}" for row in rows], fontsize=7)
    cover.set_ylim(-0.6, len(rows) - 0.4)
    figure.tight_layout()
    save(figure, "accuracy-calibration")


def direct_scaling(data):
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
    save(figure, "direct-scaling")


def radiosity_scaling(data):
    figure, (time, parts, memory) = plt.subplots(1, 3, figsize=(14, 4.4))
    for name, rows in data["operators"].items():
        rows = [row for row in rows if "failed" not in row]
        colour, mark = OPERATORS[name]
        n = [row["elements"] for row in rows]
        power = data["exponents"][name]
        time.loglog(n, [row["seconds"] for row in rows], marker=mark, ms=4, color=colour,
                    label=f"{name}: {power_of(power['seconds'])}")
        parts.loglog(n, [row["solveSeconds"] for row in rows], marker=mark, ms=4, color=colour,
                     label=f"{name}, solve: {power_of(power['solveSeconds'])}")
        parts.loglog(n, [row["applySeconds"] for row in rows], marker=mark, ms=3, ls=":",
                     color=colour, label=f"{name}, one product")
        memory.loglog(n, [row["operatorBytes"] / 2**20 for row in rows], marker=mark, ms=4,
                      color=colour, label=f"{name}: {power_of(power['operatorBytes'])}")
        large = [row for row in rows if row["elements"] > 900]  # below, the libraries' own
        memory.loglog([row["elements"] for row in large], [row["bytes"] / 2**20 for row in large],
                      marker=mark, ms=3, ls=":", color=colour)
    time.set(xlabel="elements", ylabel="seconds", title="All: build the operator and solve")
    parts.set(xlabel="elements", ylabel="seconds", title="Solve by an operator that is there")
    memory.set(xlabel="elements", ylabel="MiB", title="Operator (line), process (dots)")
    for ax in (time, parts, memory):
        ax.grid(alpha=0.25)
        ax.legend(fontsize=8, loc="upper left")
    parts.set_ylim(top=parts.get_ylim()[1] * 50)
    figure.tight_layout()
    save(figure, "radiosity-scaling")


def factors(data):
    rows = data["rows"]
    figure, axes = plt.subplots(1, len(rows), figsize=(3.4 * len(rows), 4.0), sharey=True)
    for ax, row in zip(np.atleast_1d(axes), rows):
        ax.loglog([run["seconds"] for run in row["curve"]],
                  [max(run["rms"], 1e-14) for run in row["curve"]], marker="o", ms=5, color=RED,
                  label="vtkViewFactorFilter")
        if "peer" in row:
            ax.loglog([row["peer"]["seconds"]], [row["peer"]["rms"]], marker="s", ms=8, ls="",
                      color=BLUE, label="pyviewfactor")
        ax.set(xlabel="seconds", title=row["mesh"].replace(", ", "\n"))
        ax.title.set_fontsize(10)
        ax.set_xlim(1e-3, 100.0)
        ax.set_xticks([1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0])
        ax.grid(alpha=0.25)
    np.atleast_1d(axes)[0].set_ylabel("RMS relative error of the pairs")
    np.atleast_1d(axes)[0].legend(fontsize=8, loc="center left")
    figure.tight_layout()
    save(figure, "view-factors")


def draw():
    """What there is a result for; says what it drew."""
    for name, function in (("accuracy-curves", curves), ("accuracy-runs", saving),
                           ("calibration", calibration), ("direct-scaling", direct_scaling),
                           ("radiosity-scaling", radiosity_scaling), ("view-factors", factors)):
        data = result(name)
        if data:
            function(data)
            print(f"drawn: {name}")
    found, _ = predictions()
    if found:
        predicted(found)
        print("drawn: predictions")
