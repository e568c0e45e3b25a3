# SPDX-License-Identifier: BSD-3-Clause
"""Numbers and tables in words, for the page that is written from results."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from provenance import result  # noqa: E402,F401


def number(value):
    """Three digits; powers of ten in short."""
    if value is None:
        return "–"
    if value >= 1000 or 0 < abs(value) < 1e-3:
        return f"{value:.1e}".replace("e+0", "e").replace("e-0", "e-").replace("e+", "e")
    return f"{value:.3g}"


def share(value):
    return "–" if value is None else f"{100 * value:.1f} %"


def percent(value):
    return "–" if value is None else f"{100 * value:.2g} %"


def times(value):
    """A factor: two digits."""
    if value is None:
        return "–"
    return f"{value:.0f}" if value >= 10 else f"{value:.2g}"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows])


def from_where(data):
    return f"Commit {data['commit']}, {data['processor']}, load {data['load']:.0f} when it began"


def listed(words):
    """a, b and c."""
    words = list(words)
    return words[0] if len(words) == 1 else ", ".join(words[:-1]) + " and " + words[-1]
