# SPDX-License-Identifier: BSD-3-Clause
"""convergence.png and convergence.csv: the estimated error of a run against the seconds it took."""
import csv

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkStringArray


def rows_of(table):
    """A vtkTable as (names, list of rows)."""
    columns = []
    names = []
    for index in range(table.GetNumberOfColumns()):
        column = table.GetColumn(index)
        names.append(column.GetName())
        if isinstance(column, vtkStringArray):
            columns.append([column.GetValue(k) for k in range(column.GetNumberOfTuples())])
        else:
            columns.append([v.item() if v.ndim == 0 else v.tolist() for v in vtk_to_numpy(column)])
    return names, [list(row) for row in zip(*columns)]


def write_csv(path, tables):
    """One row a record; the first column says which computation it belongs to."""
    header = ["Computation"]
    for _, table in tables:
        header += [name for name in rows_of(table)[0] if name not in header]
    with open(path, "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        writer.writerow(header)
        for computation, table in tables:
            names, rows = rows_of(table)
            for row in rows:
                value = dict(zip(names, row), Computation=computation)
                writer.writerow([value.get(name, "") for name in header])


def _column(names, *wanted):
    for word in wanted:
        for index, name in enumerate(names):
            if name.lower().replace(" ", "") == word:
                return index
    return None


def curve(table):
    """(seconds, estimated relative error) of a Convergence table, finite positive values only."""
    names, rows = rows_of(table)
    when = _column(names, "seconds", "time")
    what = _column(names, "relativeerror", "estimatedrelativeerror", "estimatederror", "error")
    if when is None or what is None or not rows:
        return np.empty(0), np.empty(0)
    seconds = np.array([row[when] for row in rows], dtype=float)
    error = np.array([row[what] for row in rows], dtype=float)
    good = np.isfinite(seconds) & np.isfinite(error) & (error > 0.0)
    return np.maximum(seconds[good], 1e-4), error[good]


def write_png(path, tables, tolerance, title, size=(1280, 720)):
    """Both axes logarithmic, one curve a computation, the requested tolerance as a line."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot, ticker

    # 10 inches wide at any number of pixels, so that the text keeps its share of the picture.
    figure, axes = pyplot.subplots(figsize=(10.0, max(10.0 * size[1] / size[0], 4.0)),
                                   dpi=size[0] / 10.0)
    drawn = 0
    floor = 1e-3 * tolerance  # nobody asks for less: smaller errors are drawn on the lower edge
    for (computation, table), mark in zip(tables, "os^D"):
        seconds, error = curve(table)
        if len(seconds):
            axes.plot(seconds, 100.0 * np.maximum(error, floor), marker=mark, clip_on=False,
                      label=f"{computation}, estimated")
            drawn += 1
    axes.axhline(100.0 * tolerance, color="0.35", linestyle="--", linewidth=1.2,
                 label=f"requested: {100.0 * tolerance:g} %")
    axes.set_yscale("log")
    if drawn:
        axes.set_xscale("log")
        axes.set_ylim(bottom=100.0 * floor)
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter(ticker.FormatStrFormatter("%g"))  # 0.01, not 10^-2
    else:
        axes.text(0.5, 0.6, "every value is exact to rounding: no error to show",
                  transform=axes.transAxes, horizontalalignment="center")
    axes.set_xlabel("seconds since the computation began")
    axes.set_ylabel("estimated relative error of the mean, %")
    axes.set_title(title)
    axes.grid(True, which="both", alpha=0.25)
    axes.legend()
    figure.tight_layout()
    figure.savefig(path, format="png")
    pyplot.close(figure)
