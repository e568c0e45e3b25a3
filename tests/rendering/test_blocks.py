# SPDX-License-Identifier: BSD-3-Clause
"""Composite data: trees of blocks, each with its own visibility, colour, opacity and arrays; levels
of detail."""
import math

import numpy as np

from drawing import Errors, Window, add, lights, run, square
from vtkmodules.vtkCommonDataModel import (
    vtkMultiBlockDataSet,
    vtkPartitionedDataSet,
    vtkPartitionedDataSetCollection,
    vtkPolyData,
)
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkRenderingCore import vtkCompositeDataDisplayAttributes, vtkLODProp3D
from vtkradiometry.vtkRadiometryRendering import vtkPhongGouraudMapper

SUN = {"LightType": 2, "Intensity": (math.pi,) * 3}
SHADINGS = ("Flat", "Gouraud", "Phong")


def tile(x, y=0.0, z=0.0):
    """A square of 0.4 about (x, y)."""
    turn = vtkTransform()
    turn.Translate(x, y, z)
    moved = vtkTransformPolyDataFilter()
    moved.SetTransform(turn)
    moved.SetInputDataObject(square(half=0.2))
    moved.Update()
    return moved.GetOutput()


def window(data, shading="Phong"):
    w = Window()
    w.mapper.SetInputDataObject(data)
    w.mapper.SetLightData(lights(SUN))
    getattr(w.mapper, "SetShadingTo" + shading)()
    w.attributes = vtkCompositeDataDisplayAttributes()
    w.mapper.SetCompositeDataDisplayAttributes(w.attributes)
    w.actor.GetProperty().SetColor(0.5, 0.5, 0.5)
    return w


def row(count=4):
    tree = vtkMultiBlockDataSet()
    for i in range(count):
        tree.SetBlock(i, tile(-0.75 + 0.5 * i))
    return tree


def seen(w, count=4):
    picture = w.draw()
    return [w.at(-0.75 + 0.5 * i, 0, picture).tolist() for i in range(count)]


def near(values, *expected):
    assert np.allclose(values, [(e,) * 3 if np.isscalar(e) else e for e in expected],
                       rtol=1e-6), values


def test_trees_of_blocks():
    inner = row(2)
    outer = vtkMultiBlockDataSet()
    outer.SetBlock(0, inner)
    outer.SetBlock(1, None)
    outer.SetBlock(2, vtkPolyData())
    deep = vtkMultiBlockDataSet()
    deep.SetBlock(0, tile(0.25))
    outer.SetBlock(3, deep)
    outer.SetBlock(4, tile(0.75))
    for shading in SHADINGS:
        w = window(outer, shading)
        errors = Errors(w.mapper)
        near(seen(w), 0.5, 0.5, 0.5, 0.5)
        w.attributes.SetBlockVisibility(inner, False)  # a branch
        near(seen(w), 0, 0, 0.5, 0.5)
        w.attributes.SetBlockColor(deep, (0.25, 0.5, 1.0))
        near(seen(w), 0, 0, (0.25, 0.5, 1.0), 0.5)
        # (VTK 9.2 does not notice Remove...() by itself; neither do its own mappers.)
        w.attributes.SetBlockVisibility(inner, True)
        w.attributes.RemoveBlockColor(deep)
        w.attributes.Modified()
        near(seen(w), 0.5, 0.5, 0.5, 0.5)
        assert not errors.texts


def test_partitioned_collections():
    collection = vtkPartitionedDataSetCollection()
    for i in range(2):
        pieces = vtkPartitionedDataSet()
        pieces.SetPartition(0, tile(-0.75 + i))
        pieces.SetPartition(1, tile(-0.25 + i))
        collection.SetPartitionedDataSet(i, pieces)
    for shading in SHADINGS:
        near(seen(window(collection, shading)), 0.5, 0.5, 0.5, 0.5)


def test_blocks_of_one_layout_and_of_others():
    """Blocks with and without normals, with cell or point scalars: each is drawn right."""
    tree = row()
    tree.GetBlock(1).GetPointData().SetNormals(None)
    add(tree.GetBlock(2).GetPointData(), "F", [3.0] * 4)
    add(tree.GetBlock(3).GetCellData(), "F", [7.0])
    for shading in SHADINGS:
        w = window(tree, shading)
        near(seen(w), 0.5, 0.5, 0.5, 0.5)
        w.mapper.SetFieldModeToOn()
        w.mapper.SetFieldArrayName("F")
        near(seen(w), 0, 0, 3, 7)


def test_opacity_of_a_block():
    tree = row(2)
    tree.SetBlock(2, tile(-0.75, z=-1.0))  # behind the first
    w = window(tree)
    w.attributes.SetBlockColor(tree.GetBlock(0), (1.0, 1.0, 1.0))
    w.attributes.SetBlockOpacity(tree.GetBlock(0), 0.25)
    picture = w.draw()
    # 0.25 of its own 1.0 over 0.5, whichever is drawn first: the opaque ones come first.
    assert np.allclose(w.at(-0.75, 0, picture), 0.25 + 0.75 * 0.5, rtol=1e-6)
    assert np.allclose(w.at(-0.25, 0, picture), 0.5, rtol=1e-6)
    w.attributes.SetBlockOpacity(tree.GetBlock(0), 1.0)
    assert np.allclose(w.at(-0.75, 0), 1.0, rtol=1e-6)


def test_light_above_one_through_a_translucent_block():
    tree = vtkMultiBlockDataSet()
    for i, (z, value) in enumerate(((0.0, 3.0), (-1.0, 6.0))):
        tree.SetBlock(i, tile(0, z=z))
        add(tree.GetBlock(i).GetCellData(), "F", [value])
    w = window(tree)
    w.mapper.SetFieldModeToOn()
    w.mapper.SetFieldArrayName("F")
    w.attributes.SetBlockOpacity(tree.GetBlock(0), 0.5)
    assert np.allclose(w.at(0, 0), 4.5, rtol=1e-6)


def test_a_block_is_added_and_taken_away():
    tree = row(3)
    w = window(tree, "Flat")
    near(seen(w), 0.5, 0.5, 0.5, 0)
    tree.SetBlock(3, tile(0.75))
    tree.SetBlock(0, None)
    tree.Modified()
    near(seen(w), 0, 0.5, 0.5, 0.5)
    w.mapper.SetInputDataObject(tile(-0.75))  # and a surface of its own in their place
    near(seen(w), 0.5, 0, 0, 0)


def test_levels_of_detail():
    """Whichever mapper a level has draws with its own settings."""
    fine, coarse = vtkPhongGouraudMapper(), vtkPhongGouraudMapper()
    for mapper, scale in ((fine, 1.0), (coarse, 0.5)):
        mapper.SetInputDataObject(tile(0))
        mapper.SetLightData(lights(SUN))
        mapper.SetLightScale(scale)
    w = Window()
    w.renderer.RemoveActor(w.actor)
    prop = vtkLODProp3D()
    levels = [prop.AddLOD(mapper, 0.0) for mapper in (fine, coarse)]
    prop.AutomaticLODSelectionOff()
    w.renderer.AddActor(prop)
    for level, expected in zip(levels * 2, (1.0, 0.5, 1.0, 0.5)):
        prop.SetSelectedLODID(level)
        assert np.allclose(w.at(0, 0), expected, rtol=1e-6)


run(globals())
