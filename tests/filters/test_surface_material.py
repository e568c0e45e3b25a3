# SPDX-License-Identifier: BSD-3-Clause
"""Surface Material: every property in its array, on the cells that were chosen, and bad ones
refused."""
import math

import numpy as np
from checks import array, close, fails, run_all
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkMultiBlockDataSet
from test_statistics import CELLS, POINTS, surface
from vtkradiometry import vtkSurfaceMaterialFilter

K = 683.002


def made(data, **properties):
    material = vtkSurfaceMaterialFilter()
    material.SetInputDataObject(data)
    for name, value in properties.items():
        getattr(material, "Set" + name)(value)
    return material


def cells(data, **properties):
    material = made(data, **properties)
    material.Update()
    return material.GetOutputDataObject(0).GetCellData()


def plain(**arrays):
    return surface(POINTS, CELLS, arrays)


def test_arrays():
    data = cells(plain(), DiffuseReflectance=(0.1, 0.2, 0.3), SpecularReflectance=(0.4, 0.4, 0.5),
                 Shininess=25, Transmittance=(0.1, 0, 0), Emission=7, EmissionColor=(1, 0.5, 0),
                 TwoSided=True)
    close(array(data, "DiffuseReflectance"), [[0.1, 0.2, 0.3]] * 3)
    close(array(data, "SpecularReflectance"), [[0.4, 0.4, 0.5]] * 3)
    close(array(data, "Transmittance"), [[0.1, 0, 0]] * 3)
    close(array(data, "EmittedExitance"), [[7, 3.5, 0]] * 3)
    close(array(data, "Shininess"), [25] * 3)
    assert array(data, "TwoSided").tolist() == [1] * 3
    assert cells(plain()).GetArray("Transmittance") is None


def test_emission_units():
    for unit, expected in ((0, 10), (1, 10 / K), (2, 10 * math.pi), (3, 10 * math.pi / K)):
        data = cells(plain(), Emission=10, EmissionUnit=unit)
        close(array(data, "EmittedExitance"), [[expected] * 3] * 3)


def test_presets():
    assert vtkSurfaceMaterialFilter.GetPresetName(0) is None
    for preset in range(1, vtkSurfaceMaterialFilter.GetNumberOfPresets() + 1):
        assert vtkSurfaceMaterialFilter.GetPresetName(preset)
        assert vtkSurfaceMaterialFilter.GetPresetSource(preset)
        rho = array(cells(plain(), Preset=preset, SpecularReflectance=(1, 1, 1),
                          DiffuseReflectance=(0, 0, 0)), "DiffuseReflectance")
        assert np.all((0 <= rho) & (rho <= 1))
    close(array(cells(plain(), Preset=1), "DiffuseReflectance"), [[0.7] * 3] * 3)
    close(array(cells(plain(), Preset=1), "SpecularReflectance"), [[0] * 3] * 3)


def test_bands():
    close(array(cells(plain(), Bands=1, DiffuseReflectance=(1, 0, 0)), "DiffuseReflectance"),
          [0.2126] * 3)
    close(array(cells(plain(), Bands=5), "DiffuseReflectance"), [[0.5] * 5] * 3)
    one = cells(plain(DiffuseReflectance=[0.1, 0.2, 0.3]), DiffuseReflectance=(0, 1, 0))
    close(array(one, "DiffuseReflectance"), [0.7152] * 3)


def test_selection():
    data = plain(ObjectIndex=[0, 1, 1], DiffuseReflectance=[[0.1] * 3, [0.2] * 3, [0.3] * 3])
    names = vtkStringArray()
    names.SetName("ObjectNames")
    for name in ("floor", "lamp"):
        names.InsertNextValue(name)
    data.GetFieldData().AddArray(names)
    for choice in (dict(SelectionValue=1), dict(SelectionName="lamp")):
        out = cells(data, SelectionArray="ObjectIndex", DiffuseReflectance=(0.9, 0.9, 0.9),
                    Emission=5, **choice)
        close(array(out, "DiffuseReflectance"), [[0.1] * 3, [0.9] * 3, [0.9] * 3])
        close(array(out, "EmittedExitance"), [[0] * 3, [5] * 3, [5] * 3])
        close(array(out, "Shininess"), [10] * 3)
    close(array(data.GetCellData(), "DiffuseReflectance")[1], [0.2] * 3)  # the input is as it was


def test_blocks():
    blocks = vtkMultiBlockDataSet()
    for i, name in enumerate(("walls", "lamp")):
        blocks.SetBlock(i, plain())
        blocks.GetMetaData(i).Set(vtkCompositeDataSet.NAME(), name)
    material = made(blocks, BlockName="lamp", Emission=3)
    material.Update()
    out = material.GetOutputDataObject(0)
    assert out.GetBlock(0).GetCellData().GetArray("EmittedExitance") is None
    close(array(out.GetBlock(1).GetCellData(), "EmittedExitance"), [[3] * 3] * 3)
    fails(made(blocks, BlockName="roof"), "BlockName", "roof")


def test_empty_surface():
    out = cells(surface(POINTS, []), Emission=1)
    assert out.GetArray("EmittedExitance").GetNumberOfTuples() == 0


def test_errors():
    nan = float("nan")
    for properties, words in (
        (dict(DiffuseReflectance=(0.5, 1.2, 0.5)), ("DiffuseReflectance[1]", "1.2")),
        (dict(DiffuseReflectance=(-0.1, 0, 0)), ("DiffuseReflectance[0]", "-0.1")),
        (dict(DiffuseReflectance=(nan, 0, 0)), ("DiffuseReflectance[0]", "nan")),
        (dict(SpecularReflectance=(0, 0, 0.6)), ("SpecularReflectance", "[2]", "1.1")),
        (dict(Transmittance=(0, 0, 2)), ("Transmittance[2]", "2")),
        (dict(Shininess=-1), ("Shininess", "-1")),
        (dict(Emission=-1), ("Emission", "-1")),
        (dict(EmissionColor=(0, -1, 0)), ("EmissionColor[1]", "-1")),
        (dict(EmissionUnit=9), ("EmissionUnit", "9")),
        (dict(Emission=1, EmissionUnit=1, LuminousEfficacy=0), ("LuminousEfficacy", "0")),
        (dict(Preset=99), ("Preset", "99")),
        (dict(Bands=5, DiffuseReflectance=(0.1, 0.2, 0.3)), ("DiffuseReflectance", "grey")),
        (dict(SelectionArray="ObjectIndex"), ("ObjectIndex", "missing")),
    ):
        fails(made(plain(), **properties), *words)
    fails(made(plain(ObjectIndex=[0, 1, 1]), SelectionArray="ObjectIndex", SelectionValue=4),
          "ObjectIndex", "4")
    fails(made(plain(DiffuseReflectance=[[0.1, 0.2]] * 3), Bands=3), "DiffuseReflectance",
          "2 components")


if __name__ == "__main__":
    run_all(globals())
