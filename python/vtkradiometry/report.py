# SPDX-License-Identifier: BSD-3-Clause
"""report.json and report.txt: what was computed, how well, what was left out, and how long it took."""
import json
import math
import textwrap

from .scales import format_number

WIDTH = 100


def _plain(value):
    """JSON has no NaN and no infinity: they become null."""
    if isinstance(value, float) and not math.isfinite(value):
        return None
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return value


def write_json(path, report):
    """The report as it is, for programs."""
    with open(path, "w", encoding="utf-8") as stream:
        json.dump(_plain(report), stream, indent=2, allow_nan=False)
        stream.write("\n")


def _cell(value):
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "-"
    if isinstance(value, float):
        return format_number(value)
    if isinstance(value, (list, tuple)):
        return " ".join(_cell(item) for item in value)
    return str(value)


def table(rows, columns=None):
    """Rows (dictionaries) as lines of aligned text; the last column is wrapped."""
    if not rows:
        return []
    columns = columns or list(dict.fromkeys(key for row in rows for key in row))
    columns = [c for c in columns if any(row.get(c) not in (None, "") for row in rows)]
    cells = [[_cell(row.get(column, "")) for column in columns] for row in rows]
    widths = [max(len(line[k]) for line in cells + [columns]) for k in range(len(columns) - 1)]
    indent = sum(widths) + 2 * len(widths)
    lines = []
    for line in [columns] + cells:
        head = "  ".join(text.ljust(width) for text, width in zip(line, widths))
        last = textwrap.wrap(line[-1], max(WIDTH - indent, 24)) or [""]
        lines.append((head + ("  " if widths else "") + last[0]).rstrip())
        lines += [" " * indent + more for more in last[1:]]
    return lines


def _title(text):
    return ["", text, "-" * len(text)]


def _pairs(items):
    width = max((len(key) for key in items), default=0)
    lines = []
    for key, value in items.items():
        wrapped = textwrap.wrap(_cell(value), max(WIDTH - width - 2, 24)) or [""]
        lines.append(f"{key.ljust(width)}  {wrapped[0]}")
        lines += [" " * (width + 2) + more for more in wrapped[1:]]
    return lines


PLAN_COLUMNS = ("Effect", "Decision", "Bound", "Unit", "Seconds", "Why")


def _plan_lines(rows):
    """The plan with its reasons last, where they have room."""
    if not rows:
        return ["(none)"]
    known = list(dict.fromkeys(key for row in rows for key in row))
    order = [c for c in PLAN_COLUMNS if c in known]
    rest = [c for c in known if c not in order]
    if "Why" in order:
        order.remove("Why")
        return table(rows, order + rest + ["Why"])
    return table(rows, order + rest)


def text_lines(report):
    """The report as lines of text, for people."""
    lines = [f"vtkRadiometry {report['versions'].get('vtkRadiometry', '')}: {report['scene']['file']}"]
    if report.get("summary"):
        lines.append("")
        for words in report["summary"].split("\n"):
            lines += textwrap.wrap(words, WIDTH)
    lines += _title("Scene")
    lines += _pairs({key: value for key, value in report["scene"].items() if key != "lights"})
    if report["scene"].get("lights"):
        lines += [""] + table(report["scene"]["lights"])
    if report.get("assumptions"):
        lines += _title("Assumed while reading")
        for words in report["assumptions"]:
            lines += textwrap.wrap(words, WIDTH, initial_indent="- ", subsequent_indent="  ")
    for computation in report["computations"]:
        lines += _title(f"{computation['name']}: {computation['seconds']:.2f} s")
        lines += _pairs(computation["facts"])
        lines += ["", "What was simulated, what was not, and why:"]
        lines += _plan_lines(computation["effect_plan"])
        lines += ["", "Estimated error against time:"] + table(computation["convergence"])
        for words in computation["warnings"]:
            lines += textwrap.wrap("warning: " + words, WIDTH, subsequent_indent="  ")
    if report.get("study"):
        lines += _title("Accuracy study") + report["study"]["text"]
    if report.get("work_plane"):
        plane = report["work_plane"]
        lines += _title("Work plane") + textwrap.wrap(plane["grid"], WIDTH) + [""]
        lines += table(plane["statistics"]) + [""] + table(plane["levels"])
    for name, rows in report["statistics"].items():
        lines += _title(f"Statistics: {name}")
        lines += table(rows)
    if report.get("flux"):
        lines += _title("Flux")
        lines += table(report["flux"])
    lines += _title("Pictures") + _pairs(report["pictures"])
    lines += _title("Time") + _pairs(
        {stage: f"{seconds:.2f} s" for stage, seconds in report["seconds"].items()})
    lines += _title("Options") + _pairs(report["options"])
    lines += _title("Versions") + _pairs(report["versions"])
    return lines


def write_text(path, report):
    """The report for people."""
    with open(path, "w", encoding="utf-8") as stream:
        stream.write("\n".join(text_lines(report)) + "\n")
