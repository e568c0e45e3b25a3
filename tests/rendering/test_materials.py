# SPDX-License-Identifier: BSD-3-Clause
"""Materials of the data: the surface arrays, lit by the lights."""
import math

import numpy as np

from drawing import Window, add, lights, polydata, run, square
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet

SUN = {"LightType": 2, "Intensity": (math.pi,) * 3}  # E = pi: a white surface shows 1


def pair():
    """Two squares side by side in one polydata, both facing +z."""
    points = [(-0.9, -0.5, 0), (0, -0.5, 0), (0.9, -0.5, 0), (0.9, 0.5, 0), (0, 0.5, 0),
              (-0.9, 0.5, 0)]
    return polydata(points, [(0, 1, 4, 5), (1, 2, 3, 4)], [(0, 0, 1)] * 6)


def window(surface, *records):
    w = Window()
    w.mapper.SetInputDataObject(surface)
    w.mapper.SetLightData(lights(*records))
    w.mapper.SetFieldModeToMaterials()
    return w


def test_diffuse_by_cell():
    surface = pair()
    add(surface.GetCellData(), "DiffuseReflectance", [(0.5, 0.25, 0.125), (0.75, 0.5, 1)])
    for shading in ("Flat", "Gouraud", "Phong"):
        w = window(surface, SUN)
        getattr(w.mapper, "SetShadingTo" + shading)()
        picture = w.draw()
        assert np.allclose(w.at(-0.5, 0, picture), (0.5, 0.25, 0.125), rtol=1e-6), shading
        assert np.allclose(w.at(0.5, 0, picture), (0.75, 0.5, 1), rtol=1e-6), shading
        assert "Specular" not in w.mapper.GetShaderFeatures()
        assert "Emission" not in w.mapper.GetShaderFeatures()


def test_one_band_and_field_data_for_a_block():
    tree = vtkMultiBlockDataSet()
    for i in range(2):
        x = -0.5 + i
        block = polydata([(x - 0.4, -0.5, 0), (x + 0.4, -0.5, 0), (x + 0.4, 0.5, 0)], [(0, 1, 2)])
        add(block.GetFieldData(), "DiffuseReflectance", [0.25 + 0.5 * i])
        tree.SetBlock(i, block)
    w = window(tree, SUN)
    picture = w.draw()
    assert np.allclose(w.at(-0.4, -0.2, picture), [0.25] * 3, rtol=1e-6)
    assert np.allclose(w.at(0.6, -0.2, picture), [0.75] * 3, rtol=1e-6)


def test_exponents_without_a_highlight():
    """A perfect mirror shows no light source, in the picture as in the model; and no NaN."""
    for exponent in (math.inf, math.nan, -1.0, 1e30):
        surface = square()
        add(surface.GetCellData(), "DiffuseReflectance", [0.5])
        add(surface.GetCellData(), "SpecularReflectance", [0.4])
        add(surface.GetCellData(), "Shininess", [exponent])
        w = Window()
        w.mapper.SetInputDataObject(surface)
        w.mapper.SetFieldModeToMaterials()
        w.mapper.SetLightData(lights({"LightType": 2, "Direction": (0.3, 0, -1)}))
        picture = w.draw()
        assert np.isfinite(picture).all(), exponent
        np.testing.assert_allclose(w.at(0, 0, picture), 0.5 / math.pi / math.sqrt(1.09), rtol=2e-6)


def test_missing_arrays_are_the_property():
    w = window(square(), SUN)
    w.actor.GetProperty().SetColor(0.2, 0.4, 0.6)
    w.actor.GetProperty().SetDiffuse(0.5)
    assert np.allclose(w.at(0, 0), (0.1, 0.2, 0.3), rtol=1e-6)
    w.actor.GetProperty().SetDiffuse(1.0)  # and follow it
    assert np.allclose(w.at(0, 0), (0.2, 0.4, 0.6), rtol=1e-6)


def test_emitted_exitance_is_seen_as_radiance():
    surface = pair()
    add(surface.GetCellData(), "EmittedExitance", [(0, 0, 0), (10 * math.pi, 0, 0)])
    w = window(surface)  # no light at all
    picture = w.draw()
    assert w.at(-0.5, 0, picture).tolist() == [0, 0, 0]
    assert np.allclose(w.at(0.5, 0, picture), (10, 0, 0), rtol=1e-6)
    assert "MaterialEmission" in w.mapper.GetShaderFeatures()


def test_highlights_by_cell():
    surface = pair()
    add(surface.GetCellData(), "DiffuseReflectance", [0.0, 0.0])
    add(surface.GetCellData(), "SpecularReflectance", [0.5, 0.25])
    add(surface.GetCellData(), "Shininess", [20.0, 60.0])
    # Light, eye and normal in line: the peak rho (n + 2)/2 of the energy-conserving lobe for E = pi.
    for shading in ("Flat", "Gouraud", "Phong"):
        w = window(surface, SUN)
        getattr(w.mapper, "SetShadingTo" + shading)()
        picture = w.draw()
        assert np.allclose(w.at(-0.5, 0, picture), 0.5 * 22 / 2, rtol=1e-6), shading
        assert np.allclose(w.at(0.5, 0, picture), 0.25 * 62 / 2, rtol=1e-6), shading
        # The exponent is the cell's: Gouraud gives way.
        assert w.mapper.GetShadingUsed() == (0 if shading == "Flat" else 2)


def test_backs():
    surface = pair()
    add(surface.GetCellData(), "DiffuseReflectance", [0.5, 0.75])
    w = window(surface, dict(SUN, Direction=(0, 0, -1), AttachedTo=2))
    w.actor.RotateY(180)
    picture = w.draw()
    assert np.allclose(w.at(0.5, 0, picture), 0.5, rtol=1e-6)  # both sides alike
    add(surface.GetCellData(), "BackDiffuseReflectance", [0.125, 0.25])
    surface.Modified()
    picture = w.draw()
    assert np.allclose(w.at(0.5, 0, picture), 0.125, rtol=1e-6)
    assert np.allclose(w.at(-0.5, 0, picture), 0.25, rtol=1e-6)
    add(surface.GetCellData(), "TwoSided", [0, 1])  # the first reflects on its front only
    surface.Modified()
    picture = w.draw()
    assert w.at(0.5, 0, picture).tolist() == [0, 0, 0]
    assert np.allclose(w.at(-0.5, 0, picture), 0.25, rtol=1e-6)


def test_many_cells_few_materials():
    n = 40
    ticks = np.linspace(-0.9, 0.9, n + 1)
    points = [(x, y, 0) for y in ticks for x in ticks]
    cells = [(j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1,
              (j + 1) * (n + 1) + i) for j in range(n) for i in range(n)]
    surface = polydata(points, cells)
    values = np.where(np.indices((n, n)).sum(axis=0) % 2 == 0, 0.25, 0.75).ravel()
    add(surface.GetCellData(), "DiffuseReflectance", values)
    w = Window(size=200)
    w.mapper.SetInputDataObject(surface)
    w.mapper.SetLightData(lights(SUN))
    w.mapper.SetFieldModeToMaterials()
    picture = w.draw()
    step = 1.8 / n
    for cell in range(0, n * n, 7):
        x, y = -0.9 + (cell % n + 0.5) * step, -0.9 + (cell // n + 0.5) * step
        assert abs(w.at(x, y, picture)[0] - values[cell]) < 1e-6, cell


run(globals())
