# SPDX-License-Identifier: BSD-3-Clause
"""The scenes of accuracy/scenes.py as VTK data, and the filters on them."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

import vtkradiometry as vr
from accuracy.lamp import PANEL, SUN
from accuracy.shapes import joined


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


def surface(scene):
    """The cells, equal corners one point, with their materials; or the sensors."""
    if scene.sensors is not None:
        data = polydata(scene.sensors, np.arange(len(scene))[:, None], "Verts")
        named(data.GetPointData(), "Normals", scene.normals)
        return data
    size = scene.corners.shape[1]
    points, index = np.unique(scene.corners.reshape(-1, 3).round(9), axis=0, return_inverse=True)
    data = polydata(points, np.ravel(index).reshape(-1, size))
    named(data.GetCellData(), "DiffuseReflectance", scene.reflectance)
    if scene.exitance.any():
        named(data.GetCellData(), "EmittedExitance", scene.exitance)
    if scene.two_sided.any():
        named(data.GetCellData(), "TwoSided", scene.two_sided.astype(np.int32))
    return data


def lights(scene):
    """One polydata of all lamps of a kind each."""
    out = []
    for kind in dict.fromkeys(lamp.kind for lamp in scene.lamps):
        lamps = [lamp for lamp in scene.lamps if lamp.kind == kind]
        places = np.concatenate([lamp.places() for lamp in lamps])
        if kind == PANEL:
            data = polydata(places, np.arange(len(places)).reshape(len(lamps), -1))
        else:
            data = polydata(places, np.arange(len(places))[:, None], "Verts")
        each = len(places) // len(lamps)
        named(data.GetPointData(), "LightType", np.full(len(places), kind, np.int32))
        named(data.GetPointData(), "Intensity",
              np.repeat([lamp.intensity for lamp in lamps], each, 0).astype(float))
        if kind == SUN:
            named(data.GetPointData(), "Direction", np.array([lamp.direction for lamp in lamps]))
        out.append(data)
    return out


def scene_filter(scene, method, indirect):
    run = vr.vtkRadiosityFilter() if indirect else vr.vtkIrradianceFilter()
    run.SetInputData(surface(scene))
    for data in lights(scene):
        run.AddLightsData(data)
    if scene.blockers:
        run.SetInputData(2, polydata(*joined(scene.blockers)))
    if indirect:
        run.SetMethod(method)
    return run
