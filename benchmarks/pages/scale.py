# SPDX-License-Identifier: BSD-3-Clause
"""Cost against size, re-lighting and view factors in words: direct-scaling.json, radiosity-scaling.json,
radiosity-million.json, radiosity-relighting.json, view-factors.json, direct-light.json."""
import numpy as np

from pages.words import from_where, number, share


def exponent(rows, size, least):
    """p of seconds = c size^p, least squares of the logarithms over sizes from `least` on."""
    rows = [row for row in rows if row and row[size] >= least]
    return np.polyfit(np.log([row[size] for row in rows]),
                      np.log([row["seconds"] for row in rows]), 1)[0]


def direct_scaling(data):
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


def power_of(value, mark="n^"):
    return "–" if value is None else f"{mark}{value:.2f}"


def radiosity_scaling(data):
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


def relighting(data):
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


def million(data):
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


def factors(data):
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


def machine(data):
    return (f"{data['triangles']} triangles under one point light at 1 %, every value exact to rounding: "
            f"{data['ratio']:.2f} times the time of a bare Embree loop of one shadow ray a triangle, with "
            f"{data['raysPerTriangle']:.2f} rays a triangle. The visibility query alone, a ray a triangle "
            f"with its ends decided in double, traces {data['queryThroughput']:.2f} times as many rays a "
            f"second as the bare loop ({data['bareRaysPerSecond'] / 1e6:.0f} million). The lines at which "
            f"shadows can begin, found once a geometry, take {data['shadowLinesSeconds']:.2f} s more.")
