# SPDX-License-Identifier: BSD-3-Clause
"""Hardware selection through the mapper: the right cells, points and blocks, in each kind of
shading and field, with and without the float pass, and the picture is as before afterwards."""
import math

import numpy as np

from drawing import Window, add, lights, polydata, run
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet,
    vtkDataObject,
    vtkMultiBlockDataSet,
    vtkSelectionNode,
)
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer
from vtkmodules.vtkFiltersCore import vtkStripper, vtkTriangleFilter
from vtkmodules.vtkRenderingCore import vtkHardwareSelector

SUN = {"LightType": 2, "Intensity": (math.pi,) * 3}
SHADINGS = ("Flat", "Gouraud", "Phong")
N = 4  # squares along each side of the grid over [-0.8, 0.8]^2


def grid():
    ticks = np.linspace(-0.8, 0.8, N + 1)
    points = [(x, y, 0.0) for y in ticks for x in ticks]
    cells = [(j * (N + 1) + i, j * (N + 1) + i + 1, (j + 1) * (N + 1) + i + 1, (j + 1) * (N + 1) + i)
             for j in range(N) for i in range(N)]
    return polydata(points, cells, [(0, 0, 1)] * len(points))


def window(data, shading="Phong"):
    w = Window()
    w.mapper.SetInputDataObject(data)
    w.mapper.SetLightData(lights(SUN))
    getattr(w.mapper, "SetShadingTo" + shading)()
    w.draw()
    return w


def pixel(w, x):
    return int((x + 1) / 2 * w.size)


def pick(w, low, high, association):
    """{composite index or None: sorted ids} in the rectangle between two places."""
    selector = vtkHardwareSelector()
    selector.SetRenderer(w.renderer)
    selector.SetArea(pixel(w, low[0]), pixel(w, low[1]), pixel(w, high[0]), pixel(w, high[1]))
    selector.SetFieldAssociation(association)
    selection = selector.Select()
    found = {}
    for i in range(selection.GetNumberOfNodes()):
        node = selection.GetNode(i)
        info = node.GetProperties()
        key = vtkSelectionNode.COMPOSITE_INDEX()
        block = info.Get(key) if info.Has(key) else None
        found[block] = sorted(vtk_to_numpy(node.GetSelectionList()).tolist())
    return found


CELLS = vtkDataObject.FIELD_ASSOCIATION_CELLS
POINTS = vtkDataObject.FIELD_ASSOCIATION_POINTS


def test_cells():
    for shading in SHADINGS:
        w = window(grid(), shading)
        before = w.draw()
        for through_pass in (True, False):
            w.renderer.SetPass(w.target if through_pass else None)
            # Each cell by a place in its middle, then a block of two by two.
            for cell in range(N * N):
                x, y = -0.6 + 0.4 * (cell % N), -0.6 + 0.4 * (cell // N)
                assert list(pick(w, (x, y), (x, y), CELLS).values()) == [[cell]], (shading, cell)
            assert list(pick(w, (-0.3, -0.3), (0.3, 0.3), CELLS).values()) == [[5, 6, 9, 10]]
            assert pick(w, (0.9, 0.9), (0.95, 0.95), CELLS) == {}
        w.renderer.SetPass(w.target)
        assert np.array_equal(w.draw(), before), shading


def test_points():
    for shading in SHADINGS:
        w = window(grid(), shading)
        found = list(pick(w, (-0.1, -0.1), (0.1, 0.1), POINTS).values())
        assert found == [[12]], (shading, found)  # the middle one of five by five
        found = list(pick(w, (-0.5, -0.1), (0.5, 0.1), POINTS).values())
        assert found == [[11, 12, 13]], (shading, found)


def test_blocks():
    tree = vtkMultiBlockDataSet()
    for i in range(3):
        x = -0.6 + 0.6 * i
        corners = [(x - 0.25, -0.25, 0), (x + 0.25, -0.25, 0), (x + 0.25, 0.25, 0)]
        tree.SetBlock(i, polydata(corners, [(0, 1, 2)], [(0, 0, 1)] * 3))
    producer = vtkTrivialProducer()  # selection of blocks asks the mapper's input algorithm
    producer.SetOutput(tree)
    for shading in SHADINGS:
        w = window(tree, shading)
        w.mapper.SetInputConnection(producer.GetOutputPort())
        w.draw()
        for i in range(3):
            x = -0.6 + 0.6 * i + 0.1
            found = pick(w, (x, -0.1), (x, -0.1), CELLS)
            assert found == {i + 1: [0]}, (shading, i, found)  # 0 is the root
        assert set(pick(w, (-0.9, -0.2), (0.9, 0.2), CELLS)) == {1, 2, 3}
    assert vtkCompositeDataSet.NAME() is not None


def test_strips():
    triangles = vtkTriangleFilter()
    triangles.SetInputDataObject(grid())
    stripper = vtkStripper()
    stripper.SetInputConnection(triangles.GetOutputPort())
    stripper.Update()
    strips = stripper.GetOutput()
    w = window(strips)
    every = list(pick(w, (-0.9, -0.9), (0.9, 0.9), CELLS).values())
    assert every == [list(range(strips.GetNumberOfCells()))], every


def test_fields_materials_and_translucent_ones():
    surface = grid()
    add(surface.GetCellData(), "F", np.arange(N * N) * 100.0)
    add(surface.GetPointData(), "P", np.arange((N + 1) ** 2) * 0.1)
    add(surface.GetCellData(), "DiffuseReflectance", np.linspace(0.1, 0.9, N * N))
    for mode, array in (("On", "F"), ("On", "P"), ("Materials", ""), ("Normals", ""),
                        ("Reflectance", "DiffuseReflectance"), ("FalseColor", "")):
        for opacity in (1.0, 0.5):
            w = window(surface)
            getattr(w.mapper, "SetFieldModeTo" + mode)()
            w.mapper.SetFieldArrayName(array)
            w.actor.GetProperty().SetOpacity(opacity)
            before = w.draw()
            found = list(pick(w, (-0.3, -0.3), (0.3, 0.3), CELLS).values())
            assert found == [[5, 6, 9, 10]], (mode, array, opacity, found)
            assert np.array_equal(w.draw(), before), mode


run(globals())
