# SPDX-License-Identifier: BSD-3-Clause
"""Rounded ranges and iso-line levels for legends."""
import math

import numpy as np


def nice_step(span, wanted):
    """1, 2 or 5 times a power of ten, giving about `wanted` steps in `span` (at most a third more)."""
    raw = span / max(wanted, 1)
    power = 10.0 ** math.floor(math.log10(raw))
    for factor in (1.0, 2.0, 5.0, 10.0):
        if 0.75 * raw <= factor * power:
            return factor * power
    return 10.0 * power


def weighted_quantile(values, weights, fractions):
    """Quantiles of `values`, each counted with its weight (its area)."""
    order = np.argsort(values)
    cumulated = np.cumsum(np.asarray(weights, dtype=float)[order])
    position = np.asarray(fractions) * cumulated[-1]
    return np.asarray(values)[order][np.searchsorted(cumulated, position).clip(0, len(values) - 1)]


class Scale:
    """A colour scale: `low`, `high`, whether it is logarithmic, and the `levels` on it."""

    def __init__(self, low, high, log, levels):
        self.low, self.high, self.log, self.levels = low, high, log, levels

    @classmethod
    def linear(cls, low, high, wanted=8):
        step = nice_step(high - low, wanted)
        first, last = math.floor(low / step + 1e-9), math.ceil(high / step - 1e-9)
        levels = [round(k * step, 12) for k in range(first, last + 1)]
        return cls(levels[0], levels[-1], False, levels)

    @classmethod
    def logarithmic(cls, low, high):
        """Ends and levels at 1, 2, 5 times powers of ten; at powers of ten over many decades."""
        decades = math.log10(high / low)
        factors = (1.0, 2.0, 5.0) if decades <= 4.3 else (1.0,)
        candidates = [round_significant(f * 10.0**p)
                      for p in range(math.floor(math.log10(low)) - 1, math.ceil(math.log10(high)) + 2)
                      for f in factors]
        first = max(c for c in candidates if c <= low * 1.0000001)
        last = min(c for c in candidates if c >= high * 0.9999999)
        if first == last:
            last = min(c for c in candidates if c > first)
        return cls(first, last, True, [c for c in candidates if first <= c <= last])

    @classmethod
    def choose(cls, values, weights, kind="auto", limits=None):
        """A scale for `values` that leaves out the brightest 1 % of the area when they stand apart.

        kind auto: logarithmic when the bright part (99 % quantile) exceeds the median fifteenfold.
        """
        if limits:
            low, high = limits
            log = kind == "log" or (kind == "auto" and low > 0.0 and high / low > 100.0)
            if log and low <= 0.0:
                raise ValueError("a logarithmic range must begin above 0")
            levels = (cls.logarithmic(low, high) if log else cls.linear(low, high)).levels
            return cls(low, high, log, [v for v in levels if low <= v <= high])
        values = np.asarray(values, dtype=float)
        top = float(values.max(initial=0.0))
        if not top > 0.0:
            return cls.linear(0.0, 1.0)
        faint, median, bright = weighted_quantile(values, weights, [0.05, 0.5, 0.99])
        high = top if top <= 1.5 * bright or bright <= 0.0 else bright
        if kind == "log" or (kind == "auto" and high > 15.0 * median):
            return cls.logarithmic(max(float(faint), high * 1e-3), float(high))
        if kind == "auto" and values.min() > 0.7 * high:
            margin = max(high - float(values.min()), 1e-3 * high)
            return cls.linear(max(float(values.min()) - 0.1 * margin, 0.0), high, 6)
        return cls.linear(0.0, float(high))

    def fraction(self, value):
        """Where `value` lies on the scale, 0 at `low` and 1 at `high`."""
        if self.log:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)

    def label(self, level):
        """The level as text, without needless digits."""
        return format_number(level)


def round_significant(value, digits=12):
    """`value` without the last bits that a product of powers of ten leaves."""
    return float(f"{value:.{digits}g}")


def format_number(value):
    """4 significant digits, no exponent between 0.001 and 99999."""
    if value == 0.0:
        return "0"
    if 1e-3 <= abs(value) < 1e5:
        text = f"{value:.4g}"
        if "e" in text:
            text = f"{value:.0f}"
        return text
    return f"{value:.3g}"
