# SPDX-License-Identifier: BSD-3-Clause
"""Runs the simulating filters with progress, and keeps their three outputs."""
import time

from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData, vtkTable
from vtkmodules.util.numpy_support import vtk_to_numpy

from .faults import InputFault, Listener
from .plots import rows_of
from .scales import format_number

METHODS = {"auto": 0, "dense": 1, "hierarchical": 2, "montecarlo": 3}
SAMPLES = {"cells": 0, "points": 1}


class Result:
    """What a simulating filter gave: surface, measuring grid (or None), plan and convergence, and
    the time it took."""

    def __init__(self, name, surface, work_plane, plan, convergence, seconds, warnings):
        self.name = name
        self.surface = surface
        self.work_plane = work_plane
        self.plan = plan
        self.convergence = convergence
        self.seconds = seconds
        self.warnings = warnings

    def plan_rows(self):
        """The effect plan as a list of dictionaries."""
        names, rows = rows_of(self.plan)
        return [dict(zip(names, row)) for row in rows]

    def convergence_rows(self):
        """The convergence record as a list of dictionaries."""
        names, rows = rows_of(self.convergence)
        return [dict(zip(names, row)) for row in rows]

    def facts(self):
        """What the filter says about its result (units, options, outcome) as a dictionary."""
        return {name[len("Radiometry"):]: value for name, value in field_facts(self.surface).items()
                if name.startswith("Radiometry")}


def field_facts(data):
    """Field data arrays of up to 16 values as plain Python values."""
    facts = {}
    field = data.GetFieldData()
    for index in range(field.GetNumberOfArrays()):
        array = field.GetAbstractArray(index)
        if array is None or not 0 < array.GetNumberOfValues() <= 16:
            continue
        if isinstance(array, vtkStringArray):
            values = [array.GetValue(k) for k in range(array.GetNumberOfValues())]
        elif array.HasAComponentName():
            values = [", ".join(f"{array.GetComponentName(k)} {format_number(array.GetComponent(0, k))}"
                                for k in range(array.GetNumberOfComponents())
                                if array.GetComponent(0, k) >= 0.0)]
        elif hasattr(array, "GetDataType"):
            values = vtk_to_numpy(array).reshape(-1).tolist()
        else:
            continue
        facts[array.GetName()] = values[0] if len(values) == 1 else values
    return facts


def _set(algorithm, name, value):
    """Sets a property that this class has; others are for other classes."""
    method = getattr(algorithm, "Set" + name, None)
    if method is not None:
        method(value)


def configure(algorithm, options):
    """Hands the command line's options to a simulating filter."""
    _set(algorithm, "RelativeTolerance", options.tolerance)
    _set(algorithm, "TimeBudget", options.time_budget)
    _set(algorithm, "NumberOfThreads", options.threads)
    _set(algorithm, "SampleLocation", SAMPLES[options.samples])
    _set(algorithm, "Method", METHODS[options.method])
    _set(algorithm, "ExposureTime", options.dose)
    if options.two_sided is not None:
        _set(algorithm, "TwoSided", bool(options.two_sided))


def prepare(algorithm, scene, options):
    """Gives `algorithm` the scene's surface and measuring grid, its lights and the options."""
    given = scene.surface
    if scene.work_plane is not None:
        given = vtkMultiBlockDataSet()
        given.SetBlock(0, scene.surface)
        given.SetBlock(1, scene.work_plane)
    algorithm.SetInputDataObject(0, given)
    scene.lights.connect(algorithm)
    configure(algorithm, options)
    _set(algorithm, "Photometric", scene.work_plane is not None)
    _set(algorithm, "LuminousEfficacy", scene.efficacy())
    return algorithm


def run(algorithm, name, scene, options, progress):
    """Runs `algorithm` on the scene and returns its Result.

    Raises InputFault with the filter's own words if it refuses its input, and Stopped when the
    user stopped it.
    """
    prepare(algorithm, scene, options)
    with Listener() as listener:
        listener.observe(algorithm)
        listener.observe(algorithm.GetExecutive())
        with progress.stage(name), progress.filter(algorithm, foretold=True):
            begin = time.monotonic()
            algorithm.Update()
            seconds = time.monotonic() - begin
        listener.check(name.lower())
        warnings = list(dict.fromkeys(listener.warnings))
    surface, work_plane = _block(algorithm, 0), _block(algorithm, 1)
    if surface is None or surface.GetNumberOfCells() != scene.surface.GetNumberOfCells():
        raise InputFault(f"{name.lower()}: no result, and the filter does not say why")
    plan, convergence = vtkTable(), vtkTable()
    plan.ShallowCopy(algorithm.GetOutputDataObject(1))
    convergence.ShallowCopy(algorithm.GetOutputDataObject(2))
    return Result(name, surface, work_plane, plan, convergence, seconds, warnings)


def _block(algorithm, index):
    """A part of the first output, without its pipeline: 0 the surface, 1 the measuring grid."""
    data = algorithm.GetOutputDataObject(0)
    if isinstance(data, vtkMultiBlockDataSet):
        data = data.GetBlock(index) if index < data.GetNumberOfBlocks() else None
    elif index > 0:
        data = None
    if data is None:
        return None
    copy = vtkPolyData()
    copy.ShallowCopy(data)
    return copy
