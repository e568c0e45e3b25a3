# SPDX-License-Identifier: BSD-3-Clause
"""Field mode: computed values are drawn as they are, exactly, whatever their size."""
import numpy as np

from drawing import Errors, Window, add, polydata, run, square
from vtkmodules.vtkCommonDataModel import (
    vtkCompositeDataSet,
    vtkMultiBlockDataSet,
    vtkPolyData,
)
from vtkmodules.vtkRenderingCore import vtkCompositeDataDisplayAttributes
from vtkmodules.vtkFiltersCore import vtkStripper


def grid(n=8):
    """n x n squares over [-0.9, 0.9]^2, the cells numbered row by row."""
    ticks = np.linspace(-0.9, 0.9, n + 1)
    points = [(x, y, 0.0) for y in ticks for x in ticks]
    cells = [(j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i)
             for j in range(n) for i in range(n)]
    return polydata(points, cells, [(0, 0, 1)] * len(points))


def centre(cell, n=8):
    step = 1.8 / n
    return -0.9 + (cell % n + 0.5) * step, -0.9 + (cell // n + 0.5) * step


def test_cell_field_is_exact():
    surface = grid()
    rng = np.random.default_rng(1)
    values = (10.0 ** rng.uniform(-6, 6, (64, 3))).astype(np.float32)
    values[5] = (-3.25, 0.0, 1e30)
    add(surface.GetCellData(), "Radiosity", values)
    w = Window()
    w.mapper.SetInputDataObject(surface)
    w.mapper.SetFieldModeToOn()
    w.mapper.SetFieldArrayName("Radiosity")
    picture = w.draw()
    for cell in range(64):
        assert np.array_equal(w.at(*centre(cell), picture), values[cell]), cell
    assert picture[0, 0].tolist() == [0, 0, 0, 0]  # the background gives no light
    w.mapper.SetFieldScale(0.25)  # a power of two: still exact
    picture = w.draw()
    for cell in range(64):
        assert np.array_equal(w.at(*centre(cell), picture), np.float32(0.25) * values[cell])


def test_one_band_is_grey_and_other_numbers_their_mean():
    for bands, expected in ((1, [2.0, 2.0, 2.0]), (2, [3.0, 3.0, 3.0]), (5, [6.0, 6.0, 6.0])):
        surface = square()
        add(surface.GetCellData(), "Irradiance", [[2.0 * (i + 1) for i in range(bands)]])
        w = Window()
        w.mapper.SetInputDataObject(surface)
        w.mapper.SetFieldModeToOn()
        w.mapper.SetFieldArrayName("Irradiance")
        assert w.at(0, 0).tolist() == expected, bands


def test_point_field_is_interpolated_linearly():
    surface = polydata([(-1, -1, 0), (1, -1, 0), (-1, 1, 0)], [(0, 1, 2)])
    add(surface.GetPointData(), "Radiance", [(0, 100, 5), (50, 100, 5), (0, -100, 5)])
    w = Window()
    w.mapper.SetInputDataObject(surface)
    w.mapper.SetFieldModeToOn()
    w.mapper.SetFieldArrayName("Radiance")
    picture = w.draw()
    for j in range(w.size):
        for i in range(w.size - j - 2):
            u, v = (i + 0.5) / w.size, (j + 0.5) / w.size
            expected = (50 * u, 100 - 200 * v, 5)
            assert np.allclose(picture[j, i, :3], expected, rtol=2e-6, atol=1e-4), (i, j)


def test_association_can_be_chosen():
    surface = square()
    add(surface.GetPointData(), "F", [1.0] * 4)
    add(surface.GetCellData(), "F", [7.0])
    w = Window()
    w.mapper.SetInputDataObject(surface)
    w.mapper.SetFieldModeToOn()
    w.mapper.SetFieldArrayName("F")
    assert w.at(0, 0)[0] == 1.0  # points first
    w.mapper.SetFieldAssociation(1)
    assert w.at(0, 0)[0] == 7.0
    w.mapper.SetFieldAssociation(0)
    assert w.at(0, 0)[0] == 1.0


def test_the_array_can_change_after_a_frame():
    surface = square()
    add(surface.GetCellData(), "A", [2.0])
    add(surface.GetCellData(), "B", [3.0])
    add(surface.GetPointData(), "C", [4.0] * 4)
    w = Window()
    w.mapper.SetInputDataObject(surface)
    w.mapper.SetFieldModeToOn()
    for name, value in (("A", 2.0), ("B", 3.0), ("C", 4.0), ("A", 2.0)):
        w.mapper.SetFieldArrayName(name)
        assert w.at(0, 0)[0] == value, name
    surface.GetCellData().GetArray("A").SetValue(0, 9.0)
    surface.GetCellData().GetArray("A").Modified()
    surface.Modified()
    assert w.at(0, 0)[0] == 9.0


def test_back_field_on_the_back():
    for attributes, tuples in (("GetCellData", 1), ("GetPointData", 4)):
        surface = square()
        add(getattr(surface, attributes)(), "Radiosity", [5.0] * tuples)
        w = Window()
        w.mapper.SetInputDataObject(surface)
        w.mapper.SetFieldModeToOn()
        w.mapper.SetFieldArrayName("Radiosity")
        w.actor.RotateX(180)
        assert w.at(0, 0)[0] == 5.0  # no array for the back: the same
        add(getattr(surface, attributes)(), "RadiosityBack", [8.0] * tuples)
        surface.Modified()
        assert w.at(0, 0)[0] == 8.0
        w.mapper.TwoSidedOff()
        assert w.at(0, 0)[0] == 5.0
        w.mapper.TwoSidedOn()
        w.actor.RotateX(180)
        assert w.at(0, 0)[0] == 5.0
        w.actor.SetScale(-1, 1, 1)  # a mirror shows the front still
        assert w.at(0, 0)[0] == 5.0
        assert "FieldOfBack" in w.mapper.GetShaderFeatures()


def test_missing_array_is_black_and_said():
    w = Window()
    w.mapper.SetInputDataObject(square())
    w.mapper.SetFieldModeToOn()
    w.mapper.SetFieldArrayName("NoSuchArray")
    errors = Errors(w.mapper)
    assert w.draw()[30, 30].tolist() == [0, 0, 0, 1]
    assert any("NoSuchArray" in text for text in errors.texts), errors.texts


def blocks():
    """Four blocks side by side: cell field, point field, no field, cell field without normals."""
    tree = vtkMultiBlockDataSet()
    for i in range(4):
        x = -0.75 + 0.5 * i
        points = [(x - 0.2, -0.5, 0), (x + 0.2, -0.5, 0), (x + 0.2, 0.5, 0), (x - 0.2, 0.5, 0)]
        block = polydata(points, [(0, 1, 2, 3)], [(0, 0, 1)] * 4 if i < 3 else None)
        if i in (0, 3):
            add(block.GetCellData(), "F", [10.0 + i])
        elif i == 1:
            add(block.GetPointData(), "F", [10.0 + i] * 4)
        tree.SetBlock(i, block)
    return tree


def test_multiblock_with_mixed_fields():
    w = Window()
    w.mapper.SetInputDataObject(blocks())
    w.mapper.SetFieldModeToOn()
    w.mapper.SetFieldArrayName("F")
    picture = w.draw()
    seen = [w.at(-0.75 + 0.5 * i, 0, picture)[0] for i in range(4)]
    assert seen == [10.0, 11.0, 0.0, 13.0], seen


def test_multiblock_visibility_and_block_colors():
    tree = blocks()
    w = Window()
    w.mapper.SetInputDataObject(tree)
    attributes = vtkCompositeDataDisplayAttributes()
    w.mapper.SetCompositeDataDisplayAttributes(attributes)
    w.mapper.SetFieldModeToOn()
    w.mapper.SetFieldArrayName("F")
    attributes.SetBlockVisibility(tree.GetBlock(0), False)
    picture = w.draw()
    assert w.at(-0.75, 0, picture)[0] == 0.0
    assert w.at(-0.25, 0, picture)[0] == 11.0
    # Lit, a block's colour is its material: one headlight, so the colour itself is seen.
    w.mapper.SetFieldModeToOff()
    attributes.SetBlockColor(tree.GetBlock(1), (0.25, 0.5, 0.75))
    picture = w.draw()
    assert np.allclose(w.at(-0.25, 0, picture), (0.25, 0.5, 0.75), atol=1e-6)
    assert np.allclose(w.at(0.25, 0, picture), (1, 1, 1), atol=1e-6)


def test_blocks_that_share_points_but_not_their_field_are_refused():
    first = square()
    second = vtkPolyData()
    second.ShallowCopy(first)
    add(first.GetPointData(), "F", [1.0] * 4)
    add(second.GetPointData(), "F", [2.0] * 4)
    tree = vtkMultiBlockDataSet()
    tree.SetBlock(0, first)
    tree.SetBlock(1, second)
    w = Window()
    w.mapper.SetInputDataObject(tree)
    w.mapper.SetFieldModeToOn()
    w.mapper.SetFieldArrayName("F")
    errors = Errors(w.mapper)
    w.draw()
    assert any("share" in text for text in errors.texts), errors.texts


def test_strips_concave_polygons_and_degenerate_cells():
    surface = grid()
    stripper = vtkStripper()
    triangles = polydata([(-0.9, -0.9, 0), (0.9, -0.9, 0), (-0.9, 0.9, 0), (0.9, 0.9, 0)],
                         [(0, 1, 2), (2, 1, 3)])
    stripper.SetInputDataObject(triangles)
    stripper.Update()
    strip = stripper.GetOutput()
    assert strip.GetNumberOfStrips() == 1
    add(strip.GetCellData(), "F", [6.0])
    w = Window()
    w.mapper.SetInputDataObject(strip)
    w.mapper.SetFieldModeToOn()
    w.mapper.SetFieldArrayName("F")
    assert w.at(-0.5, -0.5)[0] == 6.0 and w.at(0.5, 0.5)[0] == 6.0
    # Degenerate polygons before a good one must not shift the cells' values.
    points = [(0, 0, 0), (0, 0, 0), (0, 0, 0), (-0.5, -0.5, 0), (0.5, -0.5, 0), (0, 0.5, 0)]
    surface = polydata(points, [(0, 1, 2), (0, 0, 3), (3, 4, 5)])
    add(surface.GetCellData(), "F", [1.0, 2.0, 3.0])
    w.mapper.SetInputDataObject(surface)
    assert w.at(0, -0.2)[0] == 3.0


def test_reflectance_from_an_array():
    surface = square()
    add(surface.GetCellData(), "DiffuseReflectance", [(0.5, 0.25, 0.125)])
    w = Window()
    w.mapper.SetInputDataObject(surface)
    w.mapper.SetFieldModeToReflectance()
    w.mapper.SetFieldArrayName("DiffuseReflectance")
    # The renderer's headlight of intensity 1 shows a surface that faces it as its reflectance.
    assert np.allclose(w.at(0, 0), (0.5, 0.25, 0.125), rtol=1e-6)


run(globals())
