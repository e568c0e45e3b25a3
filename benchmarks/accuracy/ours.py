# SPDX-License-Identifier: BSD-3-Clause
"""The filters of the project on the scenes. Their seconds are those of Update() of a filter that is new:
it begins with VTK data and builds everything it needs; nothing is taken off."""
import time

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import vtkradiometry as vr
from accuracy.clock import clock

METHODS = ("Auto", "Dense", "Hierarchical", "MonteCarlo")
COST = ("seconds", "predicted", "predictedAt", "samples", "memory")


def table_of(table):
    """A vtkTable as rows of a dictionary."""
    rows = []
    for r in range(table.GetNumberOfRows()):
        values = {}
        for c in range(table.GetNumberOfColumns()):
            value = table.GetValue(r, c)
            values[table.GetColumnName(c)] = (value.ToString() if value.IsString()
                                              else value.ToDouble())
        rows.append(values)
    return rows


class Run:
    """One execution: its values, what it said, and what it took."""

    def __init__(self, scene, run):
        begin, wall = clock(), time.monotonic()
        run.Update()
        self.seconds, self.wall = clock() - begin, time.monotonic() - wall
        out = run.GetOutput(0)
        data = out.GetCellData() if scene.sensors is None else out.GetPointData()
        self.values, self.error = (
            vtk_to_numpy(data.GetArray(name)).astype(float).reshape(len(scene), -1)
            for name in ("Irradiance", "IrradianceError"))
        self.field, self.filter = out.GetFieldData(), run

    def text(self, name):
        array = self.field.GetAbstractArray(name)
        return array.GetValue(0) if array else ""

    def cost(self):
        """Field data RadiometryCost: what the run itself says of its cost, by the clock."""
        array = self.field.GetArray("RadiometryCost")
        return dict(zip(COST, array.GetTuple(0))) if array else {}

    def plan(self):
        return table_of(self.filter.GetOutputDataObject(1))

    def convergence(self):
        return table_of(self.filter.GetOutputDataObject(2))

    def what_ended_it(self):
        return self.text("RadiometryOutcome")


def new_filter(scene, tolerance, threads, method=0, budget=0.0):
    run = scene.filter(method)
    run.SetRelativeTolerance(tolerance)
    run.SetTimeBudget(budget)
    run.SetNumberOfThreads(threads)
    return run


class Ours:
    name = "vtkRadiometry"
    version = vr.__version__

    def __init__(self, threads=1, method=0):
        self.threads, self.method = threads, method
        self.last = None
        if method:
            self.name = f"vtkRadiometry, {METHODS[method]}"

    def sweep(self, scene, seconds):
        """Yields setting, values, seconds, and seconds with loading, which are the same."""
        loose = (0.5, 0.2, 0.1, 0.05, 0.03, 0.02, 0.01, 0.005, 0.003, 0.002, 0.001)
        steps = loose if scene.indirect else (0.5, 0.3, 0.1, 0.03, 0.01, 0.003, 1e-3, 3e-4, 1e-4, 1e-5)
        for tolerance in steps:
            least = np.inf
            for _ in range(3):
                run = Run(scene, new_filter(scene, tolerance, self.threads, self.method))
                if run.seconds < least:
                    least, self.last = run.seconds, run
                if least > seconds / 20:  # a short run feels the machine: the least of three
                    break
            yield f"tolerance {tolerance:g}", self.last.values, least, least
            if least > seconds:
                break
