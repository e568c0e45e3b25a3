# SPDX-License-Identifier: BSD-3-Clause
"""Spectra in the picture: fields, materials and lights of N bands have the filter's colours."""
import math

import numpy as np

from drawing import Errors, Window, add, lights, run, square
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkradiometry import vtkSpectrumToRGBFilter

EIGHT = [420.0, 460.0, 500.0, 540.0, 580.0, 620.0, 660.0, 700.0]
REDDISH = [0.1, 0.1, 0.2, 0.3, 0.5, 0.9, 0.8, 0.6]
BLUISH = [3.0, 4.0, 3.0, 2.0, 1.0, 0.5, 0.2, 0.1]


def expected(name, values, band_values):
    data = square()
    add(data.GetFieldData(), "Wavelengths", EIGHT)
    add(data.GetCellData(), name, [values])
    f = vtkSpectrumToRGBFilter()
    f.SetInputData(data)
    f.SetBandValues(band_values)
    f.Update()
    rgb = f.GetOutput().GetCellData().GetArray(name + "RGB")
    return vtk_to_numpy(rgb)[0]


def surface(name, values, wavelengths=EIGHT, points=False):
    data = square()
    if points:
        add(data.GetPointData(), name, [values] * 4)
    else:
        add(data.GetCellData(), name, [values])
    if wavelengths:
        add(data.GetFieldData(), "Wavelengths", wavelengths)
    return data


def test_fields_have_the_colours_of_the_filter():
    rgb = expected("Radiosity", BLUISH, vtkSpectrumToRGBFilter.POWER_IN_BAND)
    assert rgb[2] > rgb[0]
    for points in (False, True):
        w = Window()
        w.mapper.SetInputDataObject(surface("Radiosity", BLUISH, points=points))
        w.mapper.SetFieldModeToOn()
        w.mapper.SetFieldArrayName("Radiosity")
        np.testing.assert_allclose(w.at(0, 0), rgb, rtol=2e-6)
    w.mapper.SetInputDataObject(surface("Radiosity", BLUISH, wavelengths=None))
    np.testing.assert_allclose(w.at(0, 0), [np.mean(BLUISH)] * 3, rtol=2e-6)
    w.mapper.SetInputDataObject(surface("Radiosity", BLUISH, wavelengths=EIGHT[:5]))  # others'
    np.testing.assert_allclose(w.at(0, 0), [np.mean(BLUISH)] * 3, rtol=2e-6)


def test_reflectances_and_lights():
    rho = expected("DiffuseReflectance", REDDISH, vtkSpectrumToRGBFilter.REFLECTANCE)
    light = expected("Intensity", BLUISH, vtkSpectrumToRGBFilter.POWER_IN_BAND)
    data = lights({"LightType": 2, "Intensity": BLUISH})
    add(data.GetFieldData(), "Wavelengths", EIGHT)
    w = Window()
    w.mapper.SetInputDataObject(surface("DiffuseReflectance", REDDISH))
    w.mapper.SetLightData(data)
    w.mapper.SetFieldModeToMaterials()
    np.testing.assert_allclose(w.at(0, 0), rho * light / math.pi, rtol=5e-6)
    w.mapper.SetFieldModeToReflectance()
    w.mapper.SetFieldArrayName("DiffuseReflectance")
    np.testing.assert_allclose(w.at(0, 0), rho * light / math.pi, rtol=5e-6)


def test_wavelengths_that_say_nothing_are_named():
    w = Window()
    errors = Errors(w.mapper)
    w.mapper.SetInputDataObject(surface("Radiosity", BLUISH, wavelengths=[math.nan] + EIGHT[1:]))
    w.mapper.SetFieldModeToOn()
    w.mapper.SetFieldArrayName("Radiosity")
    np.testing.assert_allclose(w.at(0, 0), [np.mean(BLUISH)] * 3, rtol=2e-6)
    assert len(errors.texts) == 1 and "Wavelengths" in errors.texts[0], errors.texts
    data = lights({"LightType": 2, "Intensity": BLUISH})
    add(data.GetFieldData(), "Wavelengths", [1.0] * 8)
    w = Window()
    errors = Errors(w.mapper)
    w.mapper.SetInputDataObject(square())
    w.mapper.SetLightData(data)
    np.testing.assert_allclose(w.at(0, 0), [np.mean(BLUISH) / math.pi] * 3, rtol=2e-6)
    assert len(errors.texts) == 1 and "Wavelengths" in errors.texts[0], errors.texts


if __name__ == "__main__":
    run(globals())
