# SPDX-License-Identifier: BSD-3-Clause
"""Whether stated errors and bounds hold, and what single precision would do, in words: calibration.json,
effect-saving.json, effect-instructions.json, float-against-double.json."""
from pages.words import from_where, number, share, table


def calibration(data):
    rows = []
    for row in data["rows"]:
        rows.append(figures([row["group"], row["effect"], row["method"]], row))
    for name, row in data.get("groups", {}).items():
        rows.append(figures([f"**{name}**", "", ""], row))
    rows.append(figures(["**all**", "", ""], data["all"]))
    return (from_where(data) + f"; at most {data['seeds']} seeds and {data['effort']:g} s a part.\n\n"
            + table(["", "effect", "method", "exact to rounding", "covered", "estimated", "covered",
                     "median stated/true"], rows))


def figures(names, row):
    return [*names, row["exact"], share(row["exact_covered"]), row["values"], share(row["covered"]),
            number(row["sharpness"])]


def calibration_said(data):
    weak = [row for row in data["rows"] if row["values"] >= 30 and row["covered"] < 0.95]
    wide = [row for row in data["rows"] if row["values"] >= 30 and row["sharpness"] > 10.0]
    every = data["all"]
    lines = [f"Over all, {share(every['covered'])} of the estimated values are within their stated errors "
             f"and the median of stated over true error is {number(every['sharpness'])} (asked for: 95 %, "
             "10)."]
    if weak:
        lines.append("Below 95 % (rows of 30 values and more): " + "; ".join(
            f"{row['effect']}, {row['method']} ({share(row['covered'])})" for row in weak) + ".")
    if wide:
        lines.append("Stated more than ten times too wide in the median: " + "; ".join(
            f"{row['effect']}, {row['method']} ({number(row['sharpness'])})" for row in wide) + ".")
    return " ".join(lines)


def random_scenes(data):
    rows = []
    for name, label in (("direct", "Irradiance"), ("radiosity", "Radiosity")):
        d = data[name]
        quantile = dict((round(q, 2), v) for q, v in d["on_over_auto_quantiles"])
        rows.append([label, d["scenes"], d["values"], d["values_equal"], d["values_beyond"],
                     f"{quantile[0.05]:.2f}", f"{quantile[0.5]:.2f}", f"{quantile[0.95]:.2f}",
                     f"{d['seconds_on'] / d['seconds_auto']:.2f}"])
    text = from_where(data) + ".\n\n" + table(
        ["filter", "scenes", "values", "equal", "beyond bound and errors", "On/Auto, 5 %", "median", "95 %",
         "all together"], rows)
    rows = []
    for name, label in (("direct", "Irradiance"), ("radiosity", "Radiosity")):
        for e in (e for e in data[name]["effects"] if e["values"]):
            rows.append([label, e["effect"], e["scenes"], e["dropped_by_auto"], e["values"],
                         e["beyond_bound"], number(e["bound_over_change_median"])])
    return text + "\n\n" + table(["filter", "effect Off", "scenes", "dropped by Auto", "values",
                                  "beyond its bound", "bound/change, median"], rows)


def instructions(data):
    scenes = [key for key in data["rows"][0] if key != "left_out"]
    rows = [[row["left_out"], *(f"{100 * row[s]['more']:+.3f} %" for s in scenes)] for row in data["rows"]]
    return (f"Commit {data['commit']}, {data['valgrind']}.\n\n"
            + table(["compiled without", *(f"{s}: more instructions with it" for s in scenes)], rows))


def precision(data):
    rows = []
    for row in data["rows"]:
        cells = []
        for key in ("float", "double", "data_in_float"):
            value = row.get(key)
            cells.append(number(value["median"]) if value else "–")
        rows.append([row["kernel"], row["case"], *cells])
    speed = table(["kernel", "ns, float", "ns, double", "double/float"],
                  [[n["kernel"], f"{n['float']:.0f}", f"{n['double']:.0f}",
                    f"{n['double'] / n['float']:.2f}"] for n in data["nanoseconds"]])
    return (from_where(data) + ".\n\n" + speed + "\n\nMedian relative error:\n\n"
            + table(["kernel", "case", "in float", "in double", "data in float, then exact"], rows)
            + ("\n\n" + data["what_follows"] if data.get("what_follows") else ""))


