# SPDX-License-Identifier: BSD-3-Clause
"""vtkIrradianceFilter on the scenes. Its seconds are those of Update(): it begins with VTK data and
builds everything it needs, every time; nothing is taken off."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

import vtkradiometry as vr
from direct.clock import clock


def polydata(points, cells, kind="Polys"):
    data = vtkPolyData()
    places = vtkPoints()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
    data.SetPoints(places)
    array = vtkCellArray()
    offsets = np.arange(len(cells) + 1) * np.shape(cells)[1]
    array.SetData(numpy_to_vtkIdTypeArray(offsets.astype(np.int64), deep=True),
                  numpy_to_vtkIdTypeArray(np.ravel(cells).astype(np.int64), deep=True))
    getattr(data, "Set" + kind)(array)
    return data


def named(data, name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    data.AddArray(array)


def floor(scene):
    x = scene.edges()
    places = np.stack(np.meshgrid(x, x, indexing="xy"), -1).reshape(-1, 2)
    n = scene.cells
    first = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    quads = first[:, None] + np.array([0, 1, n + 2, n + 1])
    return polydata(np.column_stack([places, np.zeros(len(places))]), quads)


def sensors(scene):
    points = scene.centres()
    data = polydata(points, np.arange(len(points))[:, None], "Verts")
    named(data.GetPointData(), "Normals", np.tile([0.0, 0.0, 1.0], (len(points), 1)))
    return data


def lights(scene):
    if scene.point is not None:
        data = polydata(scene.point[None], [[0]], "Verts")
        kind, intensity = 0, scene.intensity
    else:
        data = polydata(scene.panel, [[0, 1, 2, 3]])
        kind, intensity = 3, scene.exitance
    count = data.GetNumberOfPoints()
    named(data.GetPointData(), "LightType", np.full(count, kind, np.int32))
    named(data.GetPointData(), "Intensity", np.full(count, intensity))
    return data


class Ours:
    name = "vtkRadiometry"

    def __init__(self, threads):
        self.threads = threads
        self.version = vr.__version__ if hasattr(vr, "__version__") else ""

    def sweep(self, scene, receivers, seconds):
        for tolerance in (0.3, 0.1, 0.03, 0.01, 0.003, 0.001, 3e-4, 1e-4):
            spent = np.inf
            for _ in range(3):
                run = vr.vtkIrradianceFilter()
                run.SetInputData(floor(scene) if receivers == "cells" else sensors(scene))
                if len(scene.blocker.points):
                    run.SetInputData(2, polydata(scene.blocker.points, scene.blocker.triangles))
                run.AddLightsData(lights(scene))
                run.SetRelativeTolerance(tolerance)
                run.SetNumberOfThreads(self.threads)
                begin = clock()
                run.Update()
                spent = min(spent, clock() - begin)
                if spent > seconds / 4:
                    break
            result = run.GetOutput(0)
            data = result.GetCellData() if receivers == "cells" else result.GetPointData()
            values, self.stated = (vtk_to_numpy(data.GetArray(name)).astype(float)
                                   for name in ("Irradiance", "IrradianceError"))
            yield f"tolerance {tolerance}", values, spent, spent
            if spent > seconds:
                break
