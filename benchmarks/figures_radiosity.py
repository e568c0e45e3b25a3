# SPDX-License-Identifier: BSD-3-Clause
"""The figures and tables of radiosity and view factors in docs/accuracy.md and docs/scaling.md; called by
benchmarks/figures.py. A result that is not there leaves its part of the page as it is."""
import matplotlib.pyplot as plt
import numpy as np

from figures import number, results, save, share, write

RED, BLUE, ORANGE, GREY = "#c0392b", "#2471a3", "#d68910", "#7f8c8d"
LOOKS = {"vtkRadiometry": (RED, "o", "-"), "Mitsuba 3, particles": (BLUE, "s", "-"),
         "Mitsuba 3, paths": (BLUE, "D", ":"), "Radiance, ambient cache": (ORANGE, "^", "-"),
         "Radiance, no cache": (ORANGE, "v", ":")}
OPERATORS = {"Dense": (BLUE, "s"), "Hierarchical": (RED, "o"), "MonteCarlo": (ORANGE, "^")}


def from_where(data):
    return (f"Commit {data['commit']}, {data['processor']}, load {data['load']:.0f} when it began")


def draw_others(data):
    figure, ax = plt.subplots(figsize=(8.2, 5.4))
    for row in data["rows"]:
        colour, mark, line = LOOKS.get(row["name"], (GREY, "x", "--"))
        ax.loglog([run["seconds"] for run in row["curve"]], [run["rms"] for run in row["curve"]],
                  marker=mark, ms=5, lw=1.4, ls=line, color=colour, label=row["name"])
    for level in (0.03, 0.01, 0.003):
        ax.axhline(level, color="grey", lw=0.7, ls=":")
    ax.set(xlabel="processor seconds" if data["threads"] == 1 else "seconds",
           ylabel="RMS relative error of the cells' irradiance",
           title=f"Cornell box, {data['cells']} cells, three bands, {data['threads']} thread(s)")
    ticks = [0.3, 0.1, 0.03, 0.01, 0.003, 0.001]
    ax.set_yticks(ticks)
    ax.set_yticklabels([f"{100 * t:g} %" for t in ticks])
    ax.minorticks_off()
    ax.grid(alpha=0.25)
    ax.legend(fontsize=9, loc="lower left")
    figure.tight_layout()
    save(figure, "radiosity-error-against-time", "")


def others_text(data):
    levels = [at["error"] for at in data["rows"][0]["at"]]
    reference = data["reference"]
    lines = [f"{from_where(data)}; {data['threads']} thread(s), {data['cells']} cells.", "",
             "| program | slope | " + " | ".join(f"seconds at {100 * level:g} % | factor"
                                                 for level in levels) + " | all counted, at 1 % |",
             "|---|---|" + "---|---|" * len(levels) + "---|"]
    for row in data["rows"]:
        cells = []
        for at in row["at"]:
            if at["extrapolated"] or at["seconds"] is None:
                longest = max(run["seconds"] for run in row["curve"])
                ours = next(a for a in data["rows"][0]["at"] if a["error"] == at["error"])
                known = ours["seconds"] and not ours["extrapolated"]
                cells += [f"> {number(longest)}",
                          f"> {number(longest / ours['seconds'])}" if known else "–"]
            else:
                cells += [number(at["seconds"]), number(at["factor"])]
        all_counted = next(at for at in row["at"] if at["error"] == 0.01)
        slope = "–" if row["slope"] is None else f"{row['slope']:.2f}"
        beyond = all_counted["extrapolated"] or all_counted["allFactor"] is None
        lines.append(f"| {row['name']} | {slope} | " + " | ".join(cells) + " | "
                     + ("–" if beyond else number(all_counted["allFactor"])) + " |")
    lines += ["", ">: not reached by its longest run. Factor: its time over vtkRadiometry's. The "
              f"reference: {reference['particles']:.1e}".replace("e+0", "e")
              + " light paths, standard error "
              f"{100 * reference['rmsStandardErrorOfReference']:.2f} % RMS; vtkRadiometry at a tolerance "
              f"of {100 * reference['tolerance']:g} % differs from it by "
              f"{100 * reference['rmsDifference']:.2f} % RMS and {100 * reference['meanDifference']:+.3f} % "
              f"in the mean, {share(reference['covered'])} of the values within both errors."]
    runs = [run for run in data["rows"][0]["curve"] if "covered" in run]
    lines += ["", "| tolerance | seconds | RMS error | median stated | covered | method |",
              "|---|---|---|---|---|---|"]
    lines += [f"| {run['setting'].split()[-1]} | {number(run['seconds'])} | {100 * run['rms']:.2f} % | "
              f"{100 * run['stated']:.2f} % | {share(run['covered'])} | "
              f"{run['method'].split(':')[0].split(' as ')[0]} |" for run in runs]
    return "\n".join(lines)


def power_of(value, mark="n^"):
    return "–" if value is None else f"{mark}{value:.2f}"


def draw_scaling(data):
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
    save(figure, "radiosity-scaling", "")


def scaling_text(data):
    lines = [f"{from_where(data)}; {data['threads']} threads, {100 * data['tolerance']:g} % asked of the "
             f"exchange, one band; Monte Carlo with {data['rays']} rays an element.", "",
             "| operator | build | one product | solve | all | operator's bytes | greatest n | its seconds "
             "| solve | MiB, operator | MiB, process |", "|---|---|---|---|---|---|---|---|---|---|---|"]
    for name, rows in data["operators"].items():
        rows = [row for row in rows if "failed" not in row]
        power, last = data["exponents"][name], rows[-1]
        lines.append(
            f"| {name} | " + " | ".join(power_of(power[key]) for key in (
                "buildSeconds", "applySeconds", "solveSeconds", "seconds", "operatorBytes"))
            + f" | {last['elements']} | {last['seconds']:.1f} | {last['solveSeconds']:.2f} | "
            f"{last['operatorBytes'] / 2**20:.0f} | {last['bytes'] / 2**20:.0f} |")
    return "\n".join(lines)


def relighting_text(data):
    lines = [f"{from_where(data)}; {data['cells']} cells, {100 * data['tolerance']:g} % asked, "
             f"{data['threads'] or data['cores']} threads. First solve: {data['firstSeconds']:.1f} s "
             f"({data['method'].split(':')[0]}).", "",
             "| change | seconds | times faster than the first | agrees with a new filter |",
             "|---|---|---|---|"]
    for row in data["rows"]:
        agrees = "–"
        if "covered" in row:
            agrees = (f"{share(row['covered'])} of values within both errors, "
                      f"{100 * row['rmsDifference']:.2f} % RMS")
        lines.append(f"| {row['change']} | {row['seconds']:.2f} | {row['factor']:.1f} | {agrees} |")
    return "\n".join(lines)


def million_text(data):
    lines = [f"{from_where(data)}.", "", "| | |", "|---|---|",
             f"| cells, bands, cores | {data['cells']}, 3, {data['cores']} |",
             f"| seconds | {data['seconds']:.0f} |",
             f"| peak of the process's memory | {data['peakBytes'] / 2**30:.2f} GiB, of which "
             f"{data['inputBytes'] / 2**30:.2f} before Update() |",
             f"| method | {data['method']} |",
             f"| stated: cells, area that meet {100 * data['tolerance']:g} % | "
             f"{share(data['metShare'])}, {share(data['metAreaShare'])} |",
             f"| stated: median | {100 * data['medianStated']:.2f} % |"]
    if "sample" in data:
        s = data["sample"]
        lines += [f"| true: RMS, median over {s['cells']} cells drawn at random | {100 * s['rms']:.2f} %, "
                  f"{100 * s['median']:.2f} % (reference: {s['paths']} paths a cell, "
                  f"{100 * s['rmsOfReference']:.2f} %) |",
                  f"| true: values within {100 * data['tolerance']:g} % | {share(s['within'])} |",
                  f"| true: values within their stated errors | {share(s['covered'])} |"]
    return "\n".join(lines)


def draw_factors(data):
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
    save(figure, "view-factors", "")


def factors_text(data):
    lines = [f"{from_where(data)}; {data['threads']} threads.", "",
             "| mesh | pairs | program | seconds | RMS | greatest | all together | factor |",
             "|---|---|---|---|---|---|---|---|"]
    for row in data["rows"]:
        peer = row.get("peer")
        bound = peer["rms"] if peer else 1.0
        good = [run for run in row["curve"] if run["rms"] <= bound]
        best = min(good, key=lambda run: run["seconds"]) if good else row["curve"][-1]
        lines.append(f"| {row['mesh']} | {row['pairs']} | vtkViewFactorFilter, {best['tolerance']:g} | "
                     f"{number(best['seconds'])} | {best['rms']:.1e} | {best['greatest']:.1e} | "
                     f"{100 * best['mean']:+.3f} % | 1 |")
        if peer:
            factor = number(row["factor"]) if row.get("factor") else "– (its error was not reached)"
            lines.append(f"| | | pyviewfactor {peer['version']} | {number(peer['seconds'])} | "
                         f"{peer['rms']:.1e} | {peer['greatest']:.1e} | {100 * peer['mean']:+.3f} % | "
                         f"{factor} |")
    if "blocked" in data:
        b = data["blocked"]
        lines += ["", f"Blocked, {b['pairs']:.2g} pairs (OpenViewFactor publishes 1.4e5 pairs/s at 0.51 % "
                  "off):".replace("e+0", "e"), "",
                  "| tolerance | seconds | F | off | stated | pairs/s | times 1.4e5 |",
                  "|---|---|---|---|---|---|---|"]
        lines += [f"| {run['tolerance']:g} | {number(run['seconds'])} | {run['viewFactor']:.6f} | "
                  f"{100 * run['off']:+.3f} % | {100 * run['stated'] / b['exact']:.3f} % | "
                  f"{number(run['pairsPerSecond'])} | {run['pairsPerSecond'] / 1.4e5:.0f} |"
                  for run in b["curve"]]
    return "\n".join(lines)


def coverage_text(data):
    lines = [f"{from_where(data)}; {data['seeds']} seeds.", "",
             "| scene | tolerance | " + " | ".join(
                 f"{m}: covered | error/true" for m in data["all"]) + " |",
             "|---|---|" + "---|---|" * len(data["all"])]
    cases = dict.fromkeys((row["scene"], row["tolerance"]) for row in data["rows"])
    for scene, tolerance in cases:
        cells = []
        for method in data["all"]:
            row = next((r for r in data["rows"] if (r["scene"], r["tolerance"], r["method"])
                        == (scene, tolerance, method)), None)
            cells += [share(row["coverage"]), number(row["medianRatio"])] if row else ["–", "–"]
        lines.append(f"| {scene} | {tolerance:g} | " + " | ".join(cells) + " |")
    cells = []
    for method in data["all"].values():
        cells += [f"**{share(method['coverage'])}**", f"**{number(method['medianRatio'])}**"]
    lines.append("| **all** | | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main():
    for name, draw, text in (
            ("radiosity-others", draw_others, others_text),
            ("radiosity-scaling", draw_scaling, scaling_text),
            ("radiosity-relighting", None, relighting_text),
            ("radiosity-million", None, million_text),
            ("view-factors", draw_factors, factors_text),
            ("radiosity-coverage", None, coverage_text)):
        data = results(name, "")
        if data:
            if draw:
                draw(data)
            kind, _, part = name.partition("-")
            write(part, text(data), "view" if kind == "view" else kind)
