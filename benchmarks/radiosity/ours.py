# SPDX-License-Identifier: BSD-3-Clause
"""vtkRadiosityFilter on the Cornell box. Its seconds are those of Update() of a filter that is new: it
begins with VTK data and builds everything it needs; nothing is taken off."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

import vtkradiometry as vr

METHODS = ("Auto", "Dense", "Hierarchical", "MonteCarlo")


def polydata(box):
    """Equal points are one point, as a mesh has them."""
    points, index = np.unique(box.corners.reshape(-1, 3).round(9), axis=0, return_inverse=True)
    data = vtkPolyData()
    places = vtkPoints()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    data.SetPoints(places)
    cells = vtkCellArray()
    cells.SetData(
        numpy_to_vtkIdTypeArray(np.arange(0, 3 * len(box) + 1, 3, dtype=np.int64), deep=True),
        numpy_to_vtkIdTypeArray(np.ravel(index).astype(np.int64), deep=True))
    data.SetPolys(cells)
    for name, values in (("DiffuseReflectance", box.reflectance), ("EmittedExitance", box.exitance)):
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        array.SetName(name)
        data.GetCellData().AddArray(array)
    return data


class Ours:
    name = "vtkRadiometry"

    def __init__(self, threads, clock, method=0):
        self.threads, self.clock, self.method = threads, clock, method
        self.version = vr.__version__
        self.stated = None
        if method:
            self.name = f"vtkRadiometry, {METHODS[method]}"

    def run(self, box, tolerance, budget=0.0):
        """Irradiance, cells x 3, and the seconds."""
        radiosity = vr.vtkRadiosityFilter()
        radiosity.SetInputData(polydata(box))
        radiosity.SetRelativeTolerance(tolerance)
        radiosity.SetMethod(self.method)
        radiosity.SetTimeBudget(budget)
        radiosity.SetNumberOfThreads(self.threads)
        begin = self.clock()
        radiosity.Update()
        spent = self.clock() - begin
        surface = radiosity.GetOutput(0)
        values, self.stated = (vtk_to_numpy(surface.GetCellData().GetArray(name)).astype(float)
                               for name in ("Irradiance", "IrradianceError"))
        self.why = surface.GetFieldData().GetAbstractArray("RadiometryMethod").GetValue(0)
        return values, spent

    def sweep(self, box, seconds):
        for tolerance in (0.5, 0.2, 0.1, 0.07, 0.05, 0.04, 0.03, 0.02, 0.01, 0.005, 0.003, 0.002, 0.001):
            values, spent = self.run(box, tolerance)
            if spent < seconds / 20:  # the least of two: a short run feels the machine
                values, again = self.run(box, tolerance)
                spent = min(spent, again)
            yield f"tolerance {tolerance}", values, spent, spent
            if spent > seconds:
                break
