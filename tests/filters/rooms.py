# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces and lamps that tests of radiosity share."""
import numpy as np
from checks import array
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkradiometry import vtkPointLightSource


def grid(points, cells):
    data = vtkPolyData()
    p = vtkPoints()
    p.SetDataTypeToDouble()
    for x in points:
        p.InsertNextPoint(x)
    polygons = vtkCellArray()
    for cell in cells:
        polygons.InsertNextCell(len(cell), cell)
    data.SetPoints(p)
    data.SetPolys(polygons)
    return data


def faces(corner_a_b, n):
    """Parallelograms (corner, a, b) of n x n quads each; fronts along a x b."""
    points, cells = [], []
    for corner, a, b in corner_a_b:
        corner, a, b = map(np.asarray, (corner, a, b))
        first = len(points)
        for j in range(n + 1):
            for i in range(n + 1):
                points.append(tuple(corner + a * i / n + b * j / n))
        for j in range(n):
            for i in range(n):
                p = first + j * (n + 1) + i
                cells.append((p, p + 1, p + n + 2, p + n + 1))
    return grid(points, cells)


def room(size, n):
    """The inside of a cube with a corner at the origin."""
    s = size
    x, y, z = (s, 0, 0), (0, s, 0), (0, 0, s)
    return faces([((0, 0, 0), x, y), ((0, 0, s), y, x), ((0, 0, 0), z, x), ((0, s, 0), x, z),
                  ((0, 0, 0), y, z), ((s, 0, 0), z, y)], n)


def with_array(data, name, values):
    values = np.broadcast_to(np.asarray(values, float), (data.GetNumberOfCells(),)).copy()
    a = numpy_to_vtk(values, deep=True)
    a.SetName(name)
    data.GetCellData().AddArray(a)
    return data


def areas(data):
    mass = vtkCellSizeFilter()
    mass.SetInputData(data)
    mass.Update()
    return array(mass.GetOutput().GetCellData(), "Area")


def lamp(position, lumen):
    source = vtkPointLightSource()
    source.SetPosition(position)
    source.SetIntensity(lumen)
    source.SetIntensityUnit(3)
    return source
