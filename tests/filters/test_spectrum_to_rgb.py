# SPDX-License-Identifier: BSD-3-Clause
"""Spectrum to RGB: colours of arrays of N bands, alone and behind the simulating filters."""
import csv

import numpy as np
from checks import SHARED_DATA, array, cell_values, close, fails, run_all, shared, simulation, square
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet
from vtkradiometry import (vtkDirectionalLightSource, vtkIrradianceFilter, vtkPointLightSource,
                           vtkRadiosityFilter, vtkSpectrumToRGBFilter)

KM = 683.002
EIGHT = [420.0, 460.0, 500.0, 540.0, 580.0, 620.0, 660.0, 700.0]


def add(attributes, name, values):
    values = np.ascontiguousarray(values, float)
    found = numpy_to_vtk(values, deep=True)
    found.SetName(name)
    attributes.AddArray(found)


def wavelengths(data, values):
    add(data.GetFieldData(), "Wavelengths", values)
    return data


def to_rgb(data, **properties):
    f = vtkSpectrumToRGBFilter()
    f.SetInputData(data)
    for name, value in properties.items():
        getattr(f, "Set" + name)(value)
    return f


def spectral_lamp(power):
    """A point light of len(power) bands [W/sr] at (0, 0, 1)."""
    lamp = vtkPointLightSource()
    lamp.SetPosition(0, 0, 1)
    lamp.Update()
    data = lamp.GetOutput()
    data.GetPointData().RemoveArray("Intensity")
    add(data.GetPointData(), "Intensity", [power])
    return data


def test_a_line_at_555_nm_is_683_lumens_a_watt():
    image = wavelengths(vtkImageData(), [555.0])
    image.SetDimensions(2, 1, 1)
    add(image.GetPointData(), "Irradiance", [1.0, 0.25])
    f = to_rgb(image, Photometric=True)
    f.Update()
    close(array(f.GetOutput().GetPointData(), "Illuminance"), [KM, 0.25 * KM])
    rgb = array(f.GetOutput().GetPointData(), "IrradianceRGB")
    assert rgb.shape == (2, 3) and rgb[0, 0] < rgb[0, 1] and rgb[0, 2] < 0, rgb
    close(rgb @ [0.2126390058715104, 0.7151686787677559, 0.07219231536073372], [1.0, 0.25], 1e-12)
    assert f.GetOutput().GetPointData().GetArray("Illuminance").GetInformation() is not None


def test_gamut():
    image = wavelengths(vtkImageData(), [480.0, 520.0])
    image.SetDimensions(1, 1, 1)
    add(image.GetPointData(), "S", [[0.0, 1.0]])
    kept, clipped, pale = [
        array((lambda f: (f.Update(), f.GetOutput())[1])(to_rgb(image, Gamut=g)).GetPointData(),
              "SRGB")[0] for g in (0, 1, 2)]
    assert kept.min() < 0
    close(clipped, np.maximum(kept, 0))
    weights = [0.2126390058715104, 0.7151686787677559, 0.07219231536073372]
    assert pale.min() >= 0 and abs(pale @ weights - kept @ weights) < 1e-15


def test_own_wavelengths_go_first_and_units_pass():
    image = wavelengths(vtkImageData(), [1000.0, 1100.0])
    image.SetDimensions(1, 1, 1)
    add(image.GetPointData(), "S", [[1.0, 1.0]])
    dark = to_rgb(image)
    dark.Update()
    close(array(dark.GetOutput().GetPointData(), "SRGB"), [[0, 0, 0]])
    seen = to_rgb(image)
    seen.AddWavelength(500)
    seen.AddWavelength(600)
    seen.Update()
    assert array(seen.GetOutput().GetPointData(), "SRGB").max() > 0.1


def test_composite_data_takes_the_wavelengths_around_it():
    blocks = vtkMultiBlockDataSet()
    wavelengths(blocks, EIGHT)
    for k in range(2):
        plane = square()
        add(plane.GetCellData(), "Radiosity", [np.full(8, 1.0 + k)])
        blocks.SetBlock(k, plane)
    blocks.SetBlock(2, square())  # without the array: passes
    f = to_rgb(blocks)
    f.Update()
    out = f.GetOutputDataObject(0)
    one, two = [array(out.GetBlock(k).GetCellData(), "RadiosityRGB") for k in range(2)]
    close(two, 2 * one)
    assert out.GetBlock(2).GetCellData().GetArray("RadiosityRGB") is None


def test_behind_irradiance_and_radiosity():
    power = np.array([1.0, 3.0, 2.0, 5.0, 4.0, 1.0, 0.5, 7.0])
    rho = np.linspace(0.2, 0.8, 8)
    plane = wavelengths(square(), EIGHT)
    add(plane.GetCellData(), "DiffuseReflectance", [rho])
    for kind in (vtkIrradianceFilter, vtkRadiosityFilter):
        f = simulation(kind, plane)
        f.AddLightsInputData(spectral_lamp(power)) if hasattr(f, "AddLightsInputData") else \
            f.SetInputData(1, spectral_lamp(power))
        f.Update()
        out = f.GetOutputDataObject(0)
        close(array(out.GetFieldData(), "Wavelengths"), EIGHT)
        irradiance = array(out.GetCellData(), "Irradiance")[0]
        assert irradiance.shape == (8,)
        close(irradiance / irradiance[0], power / power[0], 1e-9)
        rgb = vtkSpectrumToRGBFilter()
        rgb.SetInputConnection(f.GetOutputPort(0))
        rgb.PhotometricOn()
        rgb.Update()
        cells = rgb.GetOutputDataObject(0).GetCellData()
        # Linear: the colour of the sum is the sum of the bands' colours.
        alone = [array(to_rgb_of(np.eye(8)[b] * irradiance[b]), "ERGB")[0] for b in range(8)]
        close(array(cells, "IrradianceRGB")[0], np.sum(alone, axis=0), 1e-12)
        assert array(cells, "Illuminance")[0] > 0
        assert cells.GetArray("IrradianceErrorRGB") is None
        close(array(cells, "DiffuseReflectanceRGB")[0][0] > 0, True)
        if kind is vtkRadiosityFilter:
            close(array(cells, "Radiosity")[0] / irradiance, rho, 1e-9)
            assert cells.GetArray("RadiosityRGB") is not None


def test_simulations_weight_lumens_by_v_lambda_and_pass_wavelengths():
    def irradiance(surface, lamp):
        f = simulation(vtkIrradianceFilter, surface, Photometric=True)
        f.SetInputData(1, lamp)
        return f

    # Stated by the lights alone, around composite data, or by both.
    lamp = wavelengths(spectral_lamp([1.0, 1.0]), [555.0, 2000.0])
    blocks = vtkMultiBlockDataSet()
    blocks.SetBlock(0, square())
    wavelengths(blocks, [555.0, 2000.0])
    for surface in (square(), blocks, wavelengths(square(), [555.0, 2000.0])):
        f = irradiance(surface, lamp)
        f.Update()
        out = f.GetOutputDataObject(0)
        out = out.GetBlock(0) if out.IsA("vtkMultiBlockDataSet") else out
        close(array(out.GetFieldData(), "Wavelengths"), [555.0, 2000.0])
        # 555 nm reaches from -167.5 to 1277.5 nm: the whole of V over that width.
        e = array(out.GetCellData(), "Irradiance")[0, 0]
        close(array(out.GetCellData(), "Illuminance"), [KM * e * 106.8565 / 1445.0], 1e-6)
    # One band of ultraviolet is no light to see.
    out = irradiance(wavelengths(square(), [254.0]), spectral_lamp([1.0]))
    out.Update()
    close(array(out.GetOutput().GetCellData(), "Illuminance"), [0.0])
    fails(irradiance(wavelengths(square(), [500.0, 600.0]), lamp), "Wavelengths", "555", "500")
    fails(irradiance(square(), wavelengths(spectral_lamp([1.0] * 3), [500.0, 600.0])),
          "Wavelengths", "2 values", "3 bands")


def to_rgb_of(tuple_):
    image = wavelengths(vtkImageData(), EIGHT)
    image.SetDimensions(1, 1, 1)
    add(image.GetPointData(), "E", [tuple_])
    f = to_rgb(image)
    f.Update()
    return f.GetOutput().GetPointData()


def test_cornell_box_walls():
    file = shared("mesh/cornell/cornell_measured_spectra.csv")
    if file is None:
        print("no", SHARED_DATA)
        return
    with open(file) as lines:
        rows = [r for r in csv.reader(line for line in lines if not line.startswith("#"))][1:]
    table = np.array(rows, float)
    image = wavelengths(vtkImageData(), table[:, 0])
    image.SetDimensions(3, 1, 1)
    add(image.GetPointData(), "DiffuseReflectance", table[:, 1:].T)
    f = to_rgb(image, Illuminant=1)
    f.Update()
    # As Mitsuba's "cbox" states them (illuminant E): white, green, red.
    close(array(f.GetOutput().GetPointData(), "DiffuseReflectanceRGB"),
          [[0.885809, 0.698859, 0.666422], [0.105421, 0.37798, 0.076425],
           [0.570068, 0.0430135, 0.0443706]], absolute=0.005, relative=0)


def test_faults_are_named():
    image = vtkImageData()
    image.SetDimensions(2, 1, 1)
    add(image.GetPointData(), "S", [[1.0, 1.0], [1.0, np.nan]])
    fails(to_rgb(image), "Wavelengths")
    fails(to_rgb(wavelengths(image, [500.0, 600.0])), "S", "1", "nan")
    fails(to_rgb(wavelengths(image, [0.5, 0.6])), "Wavelengths", "0.5", "nanometres")
    fails(to_rgb(wavelengths(image, [500.0, 500.0])), "Wavelengths", "500")
    fails(to_rgb(image, ArrayName="T"), "T")
    wavelengths(image, [400.0, 500.0, 600.0])
    fails(to_rgb(image), "none with a component for each wavelength")
    fails(to_rgb(image, ArrayName="S"), "S", "2 components", "3 wavelengths")


run_all(globals())
