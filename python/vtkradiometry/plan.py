# SPDX-License-Identifier: BSD-3-Clause
"""The effect plan as text: a line for each effect that matters, the others by name."""
import math
import textwrap

from .scales import format_number

WIDTH = 100
LEFT_OUT = ("left out", "dropped")


def _bound(row):
    """What leaving an effect out may change, in words."""
    bound, unit = row.get("Bound"), row.get("Unit", "")
    if bound is None or not math.isfinite(bound):
        return "no bound"
    return f"at most {format_number(bound)} {unit}".strip()


def plan_lines(name, rows):
    """The rows of an effect plan as lines: effect, decision, bound, why."""
    effects = [row for row in rows if not row["Effect"].startswith("Error: ")]
    told = [row for row in effects if row["Decision"] == "simulated"]
    told += [row for row in effects if row["Decision"] in LEFT_OUT]
    absent = [row["Effect"] for row in effects if row["Decision"] == "not needed"]
    if not effects:
        return []
    lines = [f"{name}: what the scene calls for"]
    cells = [(row["Effect"], row["Decision"],
              _bound(row) if row["Decision"] in LEFT_OUT or row.get("Bound") else "")
             for row in told]
    widths = [max((len(cell[k]) for cell in cells), default=0) for k in range(3)]
    indent = 2 + sum(width + 2 for width in widths if width)
    for cell, row in zip(cells, told):
        head = "  " + "".join(text.ljust(width) + "  "
                              for text, width in zip(cell, widths) if width)
        why = textwrap.wrap(row.get("Why", ""), max(WIDTH - indent, 30)) or [""]
        lines.append((head + why[0]).rstrip())
        lines += [" " * indent + more for more in why[1:]]
    if absent:
        lines += textwrap.wrap("not needed: " + ", ".join(absent), WIDTH,
                               initial_indent="  ", subsequent_indent="    ")
    return lines
