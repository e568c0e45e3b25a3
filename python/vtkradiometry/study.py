# SPDX-License-Identifier: BSD-3-Clause
"""./run --study: the last computation at a list of tolerances or time budgets (vtkAccuracyStudy), as
text, study.csv and study.png."""
import csv
import os
import textwrap

import numpy as np

from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from .faults import InputFault, Listener
from .plots import rows_of
from .quantities import format_percent
from .report import table
from .scales import format_number
from .vtkRadiometryFilters import vtkAccuracyStudy

TIME_BUDGETS = 1
UNKNOWN = -1.0
PART = "Error: "
COLORS = ("#1f77b4", "#d95f02", "#7570b3", "#1b9e77", "#e6ab02", "#666666")


class Study:
    """What the study found: a dictionary a run, and a dictionary a figure of its summary."""

    def __init__(self, name, quantity, runs, summary, seconds, warnings):
        self.name, self.quantity = name, quantity
        self.runs, self.summary = runs, summary
        self.seconds, self.warnings = seconds, warnings

    def figure(self, name):
        """A row of the summary."""
        return next(row for row in self.summary if row["Figure"] == name)

    def rows(self):
        """What the terminal and the report show of each run."""
        return [_shown(run) for run in self.runs]

    def reference(self):
        """The run that the others are compared with; None where a reference was given."""
        return next((run for run in self.runs if run["Reference"].startswith("none")), None)

    def lines(self):
        """The study as aligned text."""
        lines = [f"Study of {self.name} ({self.quantity})"]
        if not self.runs:
            return lines + ["  " + self.figure("Runs")["Note"]]
        lines += ["  " + line for line in table(self.rows())]
        effects = list(dict.fromkeys(run["Effects"] for run in self.runs))
        lines += textwrap.wrap("effects on: " + " | ".join(effects), 98, initial_indent="  ",
                               subsequent_indent="    ")
        lines += ["  " + line for line in table(self._arrivals())]
        lines += [f"  {words}" for words in self._sentences()]
        if any(_own(run) for run in self.runs):
            lines.append("  * within the error that the reference states of itself "
                         f"({format_percent(self.figure('Estimated error of the reference')['Value'])})"
                         ": may be the reference's own")
        stopped = self.figure("Runs")["Note"].partition("; ")[2]
        return lines + (["  " + stopped] if stopped else [])


    def _arrivals(self):
        """Seconds to each error, a row for each kind of error, and its slope."""
        found = []
        for kind in ("estimated", "true"):
            row = {"seconds to": f"{kind} error"}
            for figure in self.summary:
                name = figure["Figure"]
                if name.startswith("Seconds to ") and name.endswith(f" {kind} error"):
                    row[name[len("Seconds to "):-len(f" {kind} error")]] = _seconds(figure)
            slope = self.figure(f"Slope of the {kind} error")
            row["slope"] = f"{slope['Value']:.2f}" if slope["Relation"] == "=" else "-"
            found.append(row)
        return found

    def _sentences(self):
        predicted = self.figure("Runs predicted within a factor of two")
        if predicted["Relation"] == "=":
            yield f"predicted within a factor of two: {predicted['Note']}"
        figures = {row["Figure"]: row for row in self.summary if row["Figure"].startswith("Float")}
        for what, words in (("input", "input in single precision changes values by"),
                            ("result", "storing results in single precision changes them by")):
            row = figures.get(f"Float {what}: median relative difference")
            if row and row["Relation"] == "=":
                most = figures[f"Float {what}: greatest relative difference"]["Value"]
                yield f"{words} {row['Value']:.1e} in the median, {most:.1e} at most (relative)"
            elif row:
                yield f"{words} an amount that is {row['Note']}"


def _seconds(figure):
    """Seconds with their relation; by the slope where runs do not go that far."""
    if figure["Relation"] == "unknown":
        return "-"
    words = {"=": "", "<=": "<= ", ">": "> "}[figure["Relation"]] + format_number(figure["Value"])
    later = figure["Note"].partition("by the slope about ")[2]
    return words + (f" (~{later[:-2]})" if later else "")


def _known(value):
    return value is not None and value != UNKNOWN


def _own(run):
    """Whether a true error cannot be told from that of the reference."""
    return _known(run["TrueError"]) and run["TrueError"] < run["ReferenceError"]


def _shown(run):
    """A run in the words of the terminal."""
    return {
        "asked": (f"{format_number(100.0 * run['RelativeTolerance'])} %" if run["TimeBudget"] == 0.0
                  else f"{format_number(100.0 * run['RelativeTolerance'])} % or "
                       f"{format_number(run['TimeBudget'])} s"),
        "seconds": format_number(run["Seconds"]),
        "predicted": format_number(run["PredictedSeconds"])
                     if _known(run["PredictedSeconds"]) else "-",
        "estimated error": format_percent(run["EstimatedError"])
                           if _known(run["EstimatedError"]) else "-",
        "true error": (format_percent(run["TrueError"]) + (" *" if _own(run) else "")
                       if _known(run["TrueError"])
                       else ("(reference)" if run["Reference"].startswith("none") else "-")),
        "covered": f"{100.0 * run['Coverage']:.1f} %" if _known(run["Coverage"]) else "-",
        "sharpness": format_number(run["Sharpness"]) if _known(run["Sharpness"]) else "-",
        "samples": format_number(run["Samples"]) if _known(run["Samples"]) else "-",
        "MiB": format_number(run["MemoryMiB"]) if _known(run["MemoryMiB"]) else "-",
    }


def _rows(data):
    names, rows = rows_of(data)
    return [dict(zip(names, row)) for row in rows]


def read_reference(path):
    """The surface of an earlier run; None for None."""
    if path is None:
        return None
    if not os.path.isfile(path):
        raise InputFault(f"{path}: no such file")
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    with Listener() as listener:
        listener.observe(reader)
        listener.observe(reader.GetExecutive())
        reader.Update()
        listener.check(path)
    return reader.GetOutput()


def run(algorithm, name, reference, options, progress):
    """Studies a simulating filter that has its inputs and settings. It is not executed."""
    kind, levels = options.study
    study = vtkAccuracyStudy()
    study.SetFilter(algorithm)
    study.SetFloatComparison(options.study_float)
    if reference is not None:
        study.SetReferenceData(reference)
    if kind == "budgets":
        algorithm.SetRelativeTolerance(options.study_tolerance)
        study.SetMode(TIME_BUDGETS)
        study.ClearTimeBudgets()
        for level in levels:
            study.AddTimeBudget(level)
    elif levels:
        study.ClearTolerances()
        for level in levels:
            study.AddTolerance(level)
    with Listener() as listener:
        listener.observe(study)
        listener.observe(study.GetExecutive())
        stage = "Study of " + name
        with progress.stage(stage), progress.filter(study):
            study.Update()
        listener.check("study")
        warnings = list(dict.fromkeys(listener.warnings))
    runs, summary = _rows(study.GetOutputDataObject(0)), _rows(study.GetOutputDataObject(1))
    if not summary:
        raise InputFault("study: no result, and it does not say why")
    return Study(name, "irradiance", runs, summary, progress.seconds[stage], warnings)


def write_csv(path, study):
    """The table of the runs as it is; empty where something is not known."""
    names = list(study.runs[0]) if study.runs else []
    with open(path, "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        writer.writerow(names)
        for run_ in study.runs:
            writer.writerow([run_[name] if _known(run_[name]) else "" for name in names])


def _curve(axes, study, key, label, color, marker):
    """One curve of error against seconds with its slope; False where there is nothing to draw."""
    found = [(run_["TotalSeconds"], run_[key]) for run_ in study.runs if run_[key] > 0.0]
    if not found:
        return False
    seconds, errors = np.array(sorted(found)).T  # a loaded machine may take longer for less
    slope = study.figure(f"Slope of the {label} error")
    words = f"{label} error"
    if slope["Relation"] == "=":
        words += f": slope {slope['Value']:.2f}"
        # The power law that was fitted, through the middle of the points.
        ends = np.array([seconds.min(), seconds.max()])
        middle = np.exp(np.log(seconds).mean()), np.exp(np.log(errors).mean())
        axes.plot(ends, 100.0 * middle[1] * (ends / middle[0]) ** slope["Value"], color=color,
                  linestyle=":", linewidth=1.2)
    axes.plot(seconds, 100.0 * errors, marker=marker, color=color, label=words)
    return True


def _parts(axes, study):
    """The parts of the error by source, as shares of the mean value, like the curves beside them."""
    names = [name for name in study.runs[0] if name.startswith(PART)] if study.runs else []
    drawn = []
    for name, color in zip(names, COLORS):
        found = [(run_["TotalSeconds"], 100.0 * run_[name] * run_["EstimatedError"]
                  / run_["AbsoluteError"]) for run_ in study.runs
                 if run_[name] > 0.0 and run_["AbsoluteError"] > 0.0]
        if found:
            drawn.append((name[len(PART):], color, *np.array(sorted(found)).T))
    for name, color, seconds, errors in sorted(drawn, key=lambda part: -part[3][-1]):
        axes.plot(seconds, errors, marker="s", markersize=4, color=color, label=name)
    return len(drawn)


def _reference(axes, study):
    """A ring about the run that stands in for the truth, and how far that can be trusted."""
    run_ = study.reference()
    trust = study.figure("Estimated error of the reference")
    if run_ is not None and run_["EstimatedError"] > 0.0:
        axes.plot(run_["TotalSeconds"], 100.0 * run_["EstimatedError"], marker="o", markersize=14,
                  markerfacecolor="none", markeredgecolor="0.3", linestyle="none",
                  label="the reference of the true errors")
    if trust["Relation"] == "=" and trust["Value"] > 0.0:
        axes.axhline(100.0 * trust["Value"], color="0.5", linestyle="--", linewidth=1.0,
                     label="what the reference states of itself")


def _finish(axes, drawn, title):
    from matplotlib import ticker

    axes.set_title(title, fontsize=11)
    axes.set_xlabel("seconds of the run")
    axes.grid(True, which="both", alpha=0.25)
    if not drawn:
        axes.text(0.5, 0.6, "every value is exact to rounding:\nno error to show",
                  transform=axes.transAxes, horizontalalignment="center")
        return
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(ticker.FormatStrFormatter("%g"))
        axis.set_minor_formatter(ticker.NullFormatter())
    for axis in (axes.xaxis, axes.yaxis):
        low, high = axis.get_view_interval()
        if high < 100.0 * low:  # hardly a power of ten on the axis: label some in between
            axis.set_minor_formatter(ticker.FormatStrFormatter("%g"))
            axis.set_minor_locator(ticker.LogLocator(subs=(2.0, 3.0, 5.0)))
    axes.legend()


def write_png(path, study, title, size=(1280, 720)):
    """Both axes logarithmic: the errors on the left, their parts by source on the right."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    parts = any(name.startswith(PART) for run_ in study.runs for name in run_)
    figure, panels = pyplot.subplots(
        1, 2 if parts else 1, squeeze=False, sharex=True,
        figsize=(12.0, max(12.0 * size[1] / size[0], 5.0)), dpi=size[0] / 12.0)
    drawn = [_curve(panels[0][0], study, "EstimatedError", "estimated", COLORS[0], "o"),
             _curve(panels[0][0], study, "TrueError", "true", COLORS[1], "^")]
    if any(drawn):
        _reference(panels[0][0], study)
    _finish(panels[0][0], any(drawn), f"{study.name}: error against time")
    panels[0][0].set_ylabel("relative error of the mean, %")
    if parts:
        _finish(panels[0][1], _parts(panels[0][1], study), "estimated error by source")
    effects = list(dict.fromkeys(run_["Effects"] for run_ in study.runs))
    figure.suptitle(f"{title}    effects on: {'; '.join(effects) or 'none'}", fontsize=10, wrap=True)
    figure.tight_layout()
    figure.savefig(path, format="png")
    pyplot.close(figure)
