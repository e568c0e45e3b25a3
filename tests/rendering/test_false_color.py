# SPDX-License-Identifier: BSD-3-Clause
"""False colour: the pixel under the surface has the colour that the legend has, in all 8 bits."""
import math

import numpy as np

from drawing import Window, add, polydata, run, square
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkUnsignedCharArray, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkColorTransferFunction,
    vtkCompositeDataDisplayAttributes,
    vtkDiscretizableColorTransferFunction,
)

SIZE = 200


class Picture(Window):
    """A window of 8 bits with one surface in false colour, seen as drawing.Window does."""

    def __init__(self, surface, table, array, cells=False, size=SIZE):
        super().__init__(size)
        self.renderer.SetPass(None)
        self.mapper.SetInputDataObject(surface)
        self.mapper.SetFieldModeToFalseColor()
        self.mapper.SetLookupTable(table)
        self.mapper.SetUseLookupTableScalarRange(True)
        self.mapper.SelectColorArray(array)
        if cells:
            self.mapper.SetScalarModeToUseCellFieldData()
        else:
            self.mapper.SetScalarModeToUsePointFieldData()

    def draw(self):
        self.window.Render()
        out = vtkUnsignedCharArray()
        self.window.GetPixelData(0, 0, self.size - 1, self.size - 1, 0, out, 0)
        return vtk_to_numpy(out).reshape(self.size, self.size, 3).astype(int)


def ramp(low, high):
    """A square over the whole window whose scalar rises from `low` at the left to `high`."""
    surface = polydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [(0, 1, 2, 3)],
                       [(0, 0, 1)] * 4)
    add(surface.GetPointData(), "E", [low, high, high, low])
    return surface



def colors_of(table, values):
    """What a legend shows for the values: the table's own 8-bit colours."""
    from vtkmodules.util.numpy_support import numpy_to_vtk

    array = numpy_to_vtk(np.asarray(values, dtype=float), deep=True)
    return vtk_to_numpy(table.MapScalars(array, 1, 0)).astype(int)


def check_ramp(table, low, high):
    """Every pixel has its value's colour; on a step, within rounding of the value."""
    picture = Picture(ramp(low, high), table, "E").draw()
    t = (np.arange(SIZE) + 0.5) / SIZE
    exact = low + (high - low) * t
    slack = 2e-6 * max(abs(low), abs(high), abs(high - low))
    below, at, above = (colors_of(table, exact + d)[:, :3] for d in (-slack, 0.0, slack))
    for j in (3, SIZE // 2, SIZE - 5):
        row = picture[j]
        same = (row == at).all(1) | (row == below).all(1) | (row == above).all(1)
        assert same.all(), (j, np.flatnonzero(~same)[:5], row[~same][:3], at[~same][:3])
        # ... and exactly that of its value wherever rounding leaves no choice
        firm = (below == at).all(1) & (above == at).all(1)
        assert firm.mean() > 0.9
        assert (row[firm] == at[firm]).all()
    return picture


def table_of(colors, low, high, log=False):
    table = vtkLookupTable()
    table.SetNumberOfTableValues(len(colors))
    for i, c in enumerate(colors):
        table.SetTableValue(i, *c)
    table.SetRange(low, high)
    if log:
        table.SetScaleToLog10()
    table.SetNanColor(1.0, 0.0, 1.0, 1.0)
    table.SetBelowRangeColor(0.1, 0.9, 0.2, 1.0)
    table.SetAboveRangeColor(0.95, 0.15, 0.05, 1.0)
    table.UseBelowRangeColorOn()
    table.UseAboveRangeColorOn()
    table.Build()
    return table


def rainbow(n):
    rng = np.random.default_rng(n)
    return [(*c, 1.0) for c in rng.uniform(0, 1, (n, 3))]


def test_table_with_steps_and_values_out_of_range():
    check_ramp(table_of(rainbow(7), 2.0, 5.0), 1.0, 6.0)
    check_ramp(table_of(rainbow(256), 0.0, 1.0), -0.2, 1.2)
    check_ramp(table_of(rainbow(16), -3e-9, 5e-9), -4e-9, 6e-9)


def test_range_far_from_zero_keeps_its_digits():
    check_far = table_of(rainbow(9), 1e6, 1e6 + 1.0)
    picture = Picture(ramp(1e6, 1e6 + 1.0), check_far, "E").draw()
    t = (np.arange(SIZE) + 0.5) / SIZE
    at = colors_of(check_far, 1e6 + t)[:, :3]
    away = np.abs(t * 9 - np.round(t * 9)) > 1e-4
    assert (picture[SIZE // 2][away] == at[away]).all()


def test_logarithmic_table():
    check_ramp(table_of(rainbow(12), 1e-3, 1e4, log=True), 1e-4, 1.0)
    check_ramp(table_of(rainbow(12), 1e-3, 1e4, log=True), 1.0, 2e4)
    check_ramp(table_of(rainbow(5), 0.5, 32.0, log=True), -1.0, 40.0)  # 0 and less, too


def test_continuous_map():
    function = vtkColorTransferFunction()
    function.AddRGBPoint(0.0, 0.0, 0.0, 0.3)
    function.AddRGBPoint(0.37, 0.9, 0.1, 0.0)
    function.AddRGBPoint(1.0, 1.0, 1.0, 0.8)
    check_ramp(function, 0.0, 1.0)
    function.SetColorSpaceToLab()
    check_ramp(function, -0.1, 1.1)
    function.SetColorSpaceToRGB()
    function.AddRGBPoint(0.6, 0.0, 1.0, 0.0, 0.5, 1.0)  # a step between two nodes
    check_ramp(function, 0.0, 1.0)


def test_map_of_paraview_kind():
    function = vtkDiscretizableColorTransferFunction()
    function.AddRGBPoint(1e-2, 0.0, 0.0, 0.3)
    function.AddRGBPoint(1e2, 1.0, 0.9, 0.2)
    function.DiscretizeOn()
    function.SetNumberOfValues(13)
    function.SetUseLogScale(True)
    function.Build()
    check_ramp(function, 1e-2, 10.0)
    function.DiscretizeOff()
    function.Build()
    check_ramp(function, 1e-2, 10.0)


def test_cells_are_constant_and_exact():
    n = 10
    ticks = np.linspace(-1, 1, n + 1)
    points = [(x, y, 0.0) for y in ticks for x in ticks]
    cells = [(j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i)
             for j in range(n) for i in range(n)]
    surface = polydata(points, cells)
    values = np.linspace(-1.0, 11.0, 100)
    values[7] = math.nan
    values[8], values[9] = math.inf, -math.inf
    values[10:21] = np.arange(11)  # on the steps themselves
    add(surface.GetCellData(), "E", values)
    table = table_of(rainbow(10), 0.0, 10.0)
    picture = Picture(surface, table, "E", cells=True).draw()
    expected = colors_of(table, values)[:, :3]
    blocks = picture.reshape(n, SIZE // n, n, SIZE // n, 3)
    for cell in range(100):
        block = blocks[cell // n, :, cell % n].reshape(-1, 3)
        assert (block == expected[cell]).all(), (cell, values[cell])
    assert expected[7].tolist() == [255, 0, 255]


def test_points_of_one_value_on_a_step_are_of_one_colour():
    table = table_of(rainbow(10), 0.0, 10.0)
    for value in range(11):
        picture = Picture(ramp(value, value), table, "E", size=50).draw().reshape(-1, 3)
        assert (picture == colors_of(table, [value])[0, :3]).all(), value


def test_nan_at_a_point_is_the_colour_of_nan():
    surface = polydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [(0, 1, 2), (0, 2, 3)])
    add(surface.GetPointData(), "E", [1.0, math.nan, 1.0, 1.0])
    table = table_of(rainbow(4), 0.0, 2.0)
    picture = Picture(surface, table, "E").draw()
    assert picture[20, 180].tolist() == [255, 0, 255]
    assert picture[180, 20].tolist() == colors_of(table, [1.0])[0, :3].tolist()


def test_vectors_by_length_and_by_component():
    surface = polydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [(0, 1, 2, 3)])
    add(surface.GetPointData(), "E", [(3.0, 4.0, 0.0)] * 4)
    table = table_of(rainbow(6), 0.0, 6.0)
    table.SetVectorModeToMagnitude()
    assert Picture(surface, table, "E", size=40).draw()[20, 20].tolist() == \
        colors_of(table, [5.0])[0, :3].tolist()
    table.SetVectorModeToComponent()
    table.SetVectorComponent(1)
    assert Picture(surface, table, "E", size=40).draw()[20, 20].tolist() == \
        colors_of(table, [4.0])[0, :3].tolist()


def test_changed_map_and_range_change_the_picture():
    table = table_of(rainbow(3), 0.0, 3.0)
    picture = Picture(ramp(0.5, 0.5), table, "E", size=30)
    first = picture.draw()[15, 15].tolist()
    table.SetRange(-3.0, 1.0)
    second = picture.draw()[15, 15].tolist()
    assert first == colors_of(table_of(rainbow(3), 0.0, 3.0), [0.5])[0, :3].tolist()
    assert second == colors_of(table, [0.5])[0, :3].tolist() != first
    table.SetTableValue(2, 0.2, 0.4, 0.6)
    assert picture.draw()[15, 15].tolist() == [51, 102, 153]
    picture.mapper.SetUseLookupTableScalarRange(False)
    picture.mapper.SetScalarRange(0.4, 6.0)
    assert picture.draw()[15, 15].tolist() == colors_of(table, [0.5])[0, :3].tolist()
    assert list(table.GetRange()) == [0.4, 6.0]


def test_light_and_shading_have_no_effect():
    table = table_of(rainbow(5), 0.0, 1.0)
    surface = ramp(0.0, 1.0)
    picture = Picture(surface, table, "E")
    before = picture.draw()
    picture.renderer.RemoveAllLights()
    picture.renderer.AutomaticLightCreationOff()
    picture.mapper.SetEmission(3, 3, 3)
    picture.mapper.SetLightScale(5)
    picture.actor.GetProperty().SetDiffuse(0.2)
    picture.actor.GetProperty().SetSpecular(0.9)
    picture.actor.GetProperty().SetAmbient(0.9)
    for shading in range(4):
        picture.mapper.SetShading(shading)
        assert (picture.draw() == before).all()
    assert not picture.mapper.GetSceneLinear()
    assert "radiometryLights" not in picture.mapper.GetFragmentShaderText()


def test_the_float_target_gets_the_same_colours():
    table = table_of(rainbow(16), 0.0, 1.0)
    picture = Picture(ramp(-0.1, 1.1), table, "E")
    before = picture.draw()
    w = Window(size=SIZE, mapper=picture.mapper)
    assert w.draw().max() == 0  # it is no light
    w.target.AllSceneLinearOn()
    assert (np.round(255 * w.draw()[:, :, :3]).astype(int) == before).all()


def test_opacity_of_the_map():
    table = table_of([(1, 0, 0, 0.25), (0, 1, 0, 1.0)], 0.0, 2.0)
    picture = Picture(ramp(0.0, 2.0), table, "E", size=40)
    picture.renderer.SetBackground(0, 0, 1)
    got = picture.draw()
    assert np.abs(got[20, 5] - [0.25 * 255, 0, 0.75 * 255]).max() <= 1
    assert got[20, 35].tolist() == [0, 255, 0]


def test_blocks_of_cells_of_points_and_without_scalars():
    table = table_of(rainbow(8), 0.0, 8.0)
    blocks = vtkMultiBlockDataSet()
    for i, (x0, x1) in enumerate(((-1.0, -0.4), (-0.3, 0.3), (0.4, 1.0))):
        surface = polydata([(x0, -1, 0), (x1, -1, 0), (x1, 1, 0), (x0, 1, 0)], [(0, 1, 2, 3)])
        if i == 0:
            add(surface.GetPointData(), "E", [3.5] * 4)
            surface.GetPointData().SetActiveScalars("E")
        elif i == 1:
            add(surface.GetCellData(), "E", [6.5])
            surface.GetCellData().SetActiveScalars("E")
        blocks.SetBlock(i, surface)
    picture = Picture(blocks, table, "E")
    picture.mapper.SetScalarModeToDefault()
    picture.actor.GetProperty().SetDiffuseColor(0.2, 0.4, 0.8)
    got = picture.draw()
    assert got[100, 30].tolist() == colors_of(table, [3.5])[0, :3].tolist()
    assert got[100, 100].tolist() == colors_of(table, [6.5])[0, :3].tolist()
    assert got[100, 170].tolist() == [51, 102, 204]
    colors = vtkCompositeDataDisplayAttributes()
    picture.mapper.SetCompositeDataDisplayAttributes(colors)
    colors.SetBlockColor(blocks.GetBlock(0), [1.0, 0.2, 0.0])
    got = picture.draw()
    if vtkVersion.GetVTKMajorVersion() == 9 and vtkVersion.GetVTKMinorVersion() < 3:
        assert got[100, 30].tolist() == [255, 51, 0]
    else:  # VTK lets the scalars of a block go before its colour
        assert got[100, 30].tolist() == colors_of(table, [3.5])[0, :3].tolist()
    assert got[100, 100].tolist() == colors_of(table, [6.5])[0, :3].tolist()


def test_without_scalars_the_property_and_direct_colours_as_they_are():
    surface = square()
    picture = Picture(surface, table_of(rainbow(3), 0, 1), "nothing", size=40)
    picture.actor.GetProperty().SetDiffuseColor(1.0, 0.6, 0.2)
    assert picture.draw()[20, 20].tolist() == [255, 153, 51]
    add(surface.GetPointData(), "RGB", [(10, 20, 30)] * 4, dtype=np.uint8)
    picture = Picture(surface, table_of(rainbow(3), 0, 1), "RGB", size=40)
    picture.mapper.SelectColorArray("RGB")
    picture.mapper.SetColorModeToDefault()
    assert picture.draw()[20, 20].tolist() == [10, 20, 30]


def test_edges_lie_on_the_colours():
    table = table_of([(0, 0, 1, 1)], 0.0, 1.0)
    surface = square()
    add(surface.GetPointData(), "E", [0.5] * 4)
    picture = Picture(surface, table, "E", size=60)
    picture.actor.GetProperty().EdgeVisibilityOn()
    picture.actor.GetProperty().SetEdgeColor(1, 1, 1)
    picture.actor.GetProperty().SetLineWidth(3)
    got = picture.draw()
    assert got[30, 20].tolist() == [0, 0, 255]
    assert got[30, 6].tolist() == got[53, 30].tolist() == [255, 255, 255]


def test_the_legend_has_the_colours_of_the_surface():
    table = table_of(rainbow(6), 0.0, 6.0)
    table.UseBelowRangeColorOff()
    table.UseAboveRangeColorOff()
    picture = Picture(ramp(0.0, 6.0), table, "E", size=300)
    picture.actor.SetScale(0.5, 0.5, 1.0)
    bar = vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetMaximumNumberOfColors(6)
    bar.SetPosition(0.8, 0.1)
    bar.SetPosition2(0.15, 0.8)
    picture.renderer.AddActor2D(bar)
    got = picture.draw()
    surface = [tuple(c) for c in got[150, 76:224:2]]
    legend = {tuple(c) for c in got[30:270, 240:290].reshape(-1, 3)}
    assert len(set(surface)) == 6
    assert set(surface) <= legend


if __name__ == "__main__":
    run(globals())
