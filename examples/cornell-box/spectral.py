#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The Cornell box in the 76 bands that it was measured in, beside the same box in three.

    ./run --python examples/cornell-box/spectral.py [FOLDER]

Writes spectral.exr, rgb.exr, comparison.png (spectral | three bands | difference) and
luminance.png (false colours), and prints how far three bands are from 76.
"""
import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (the renderer)
from vtkradiometry import (vtkExposureFilter, vtkFalseColorImageFilter, vtkImageComparisonFilter,
                           vtkLinearFloatPass, vtkOpenColorIOImageFilter, vtkOpenEXRWriter,
                           vtkPhongGouraudMapper, vtkRadiometricSceneReader, vtkRadiosityFilter,
                           vtkSpectrumToRGBFilter)
from vtkradiometry.mesh import refine, triangles

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import make_cornell_box as box  # noqa: E402  (the measured spectra)

SIZE = 480
EDGE = 0.045  # m, the longest of the mesh
TOLERANCE = 0.02


def array(name, values):
    made = numpy_to_vtk(np.ascontiguousarray(values, float), deep=True)
    made.SetName(name)
    return made


def surface_in_three_bands(edge):
    reader = vtkRadiometricSceneReader()
    reader.SetFileName(os.path.join(HERE, "cornell-box.glb"))
    reader.Update()
    surface, _ = refine(reader.GetOutput(0), edge)
    surface.GetFieldData().ShallowCopy(reader.GetOutput(0).GetFieldData())
    return apart(surface, "light"), reader.GetOutput(2)


def material_of_cells(surface):
    names = surface.GetFieldData().GetAbstractArray("MaterialNames")
    every = np.array([names.GetValue(i) for i in range(names.GetNumberOfValues())])
    return every[vtk_to_numpy(surface.GetCellData().GetArray("MaterialIndex"))]


def apart(surface, material):
    """The surface with points of its own for the cells of a material: values at points are means of
    the cells around, and the lamp's must not run into the ceiling."""
    corners = triangles(surface).copy()
    chosen = material_of_cells(surface) == material
    old, own = np.unique(corners[chosen], return_inverse=True)
    xyz = vtk_to_numpy(surface.GetPoints().GetData())
    corners[chosen] = len(xyz) + own.reshape(-1, 3)
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.vstack([xyz, xyz[old]]), deep=True))
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, 3 * len(corners) + 1, 3), deep=True),
                  numpy_to_vtkIdTypeArray(corners.ravel(), deep=True))
    made = vtkPolyData()
    made.SetPoints(points)
    made.SetPolys(cells)
    made.GetCellData().ShallowCopy(surface.GetCellData())
    made.GetFieldData().ShallowCopy(surface.GetFieldData())
    return made


def in_76_bands(surface):
    """The same surface with the measured reflectances and the lamp's spectrum."""
    data = vtkPolyData()
    data.ShallowCopy(surface)
    materials = material_of_cells(surface)
    rho = {"white": box.spectrum(box.WHITE), "green": box.spectrum(box.GREEN),
           "red": box.spectrum(box.RED), "light": [box.LIGHT_REFLECTANCE] * 76}
    wavelengths = np.array(list(box.WAVELENGTHS), float)
    data.GetFieldData().AddArray(array("Wavelengths", wavelengths))
    # W/m^2 in each band, scaled to the luminance that the lamp has in three bands.
    power = np.array([box.light_at(w) for w in wavelengths])
    power *= np.pi * box.LUMINANCE / lumens(power, wavelengths)
    data.GetCellData().AddArray(array("DiffuseReflectance", [rho[m] for m in materials]))
    data.GetCellData().AddArray(array("EmittedExitance", np.outer(materials == "light", power)))
    data.GetCellData().AddArray(array("SpecularReflectance", np.zeros(len(materials))))
    return data


def lumens(power, wavelengths):
    """Luminous exitance of a spectrum [lm/m^2]: 683.002 lm/W times its sum weighted by V."""
    point = vtkPolyData()
    points = vtkPoints()
    points.InsertNextPoint(0, 0, 0)
    point.SetPoints(points)
    point.GetPointData().AddArray(array("Radiosity", [power]))
    point.GetFieldData().AddArray(array("Wavelengths", wavelengths))
    to_rgb = vtkSpectrumToRGBFilter()
    to_rgb.SetInputData(point)
    to_rgb.PhotometricOn()
    to_rgb.Update()
    return to_rgb.GetOutput().GetPointData().GetArray("LuminousExitance").GetValue(0)


def radiosity(surface, tolerance):
    solve = vtkRadiosityFilter()
    solve.SetInputData(surface)
    solve.SetRelativeTolerance(tolerance)
    solve.SetSampleLocation(1)  # points, for a smooth picture
    solve.Update()
    return solve


def picture(producer, name, cameras, size):
    """The scene-linear picture of an array of radiosities."""
    mapper = vtkPhongGouraudMapper()
    mapper.SetInputConnection(producer.GetOutputPort(0))
    mapper.SetFieldModeToOn()
    mapper.SetFieldArrayName(name)
    mapper.SetFieldScale(1 / np.pi)
    actor = vtkActor()
    actor.SetMapper(mapper)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    linear = vtkLinearFloatPass()
    linear.SetSamples(3)
    renderer.SetPass(linear)
    camera = renderer.GetActiveCamera()
    data = cameras.GetPointData()
    camera.SetPosition(cameras.GetPoint(0))
    camera.SetFocalPoint(data.GetArray("FocalPoint").GetTuple3(0))
    camera.SetViewUp(data.GetArray("ViewUp").GetTuple3(0))
    camera.SetViewAngle(data.GetArray("ViewAngle").GetValue(0))
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(size, size)
    window.AddRenderer(renderer)
    window.Render()
    image = linear.GetColor().NewInstance()
    image.DeepCopy(linear.GetColor())
    window.Finalize()
    return image


def write(kind, producer, path):
    writer = kind()
    writer.SetInputConnection(producer.GetOutputPort()) if hasattr(producer, "GetOutputPort") \
        else writer.SetInputData(producer)
    writer.SetFileName(path)
    writer.Write()


def main(folder, edge=EDGE, tolerance=TOLERANCE, size=SIZE):
    os.makedirs(folder, exist_ok=True)
    surface, cameras = surface_in_three_bands(edge)
    in_bands, in_rgb = [radiosity(s, tolerance) for s in (in_76_bands(surface), surface)]
    spectral = vtkSpectrumToRGBFilter()
    spectral.SetInputConnection(in_bands.GetOutputPort(0))
    spectral.AddArrayName("Radiosity")
    images = [picture(spectral, "RadiosityRGB", cameras, size),
              picture(in_rgb, "Radiosity", cameras, size)]
    for image, name in zip(images, ("spectral.exr", "rgb.exr")):
        write(vtkOpenEXRWriter, image, os.path.join(folder, name))

    compare = vtkImageComparisonFilter()
    for port, image in enumerate(images):
        compare.SetInputData(port, image)
    compare.SetDifferenceGain(4.0)
    compare.Update()
    table = compare.GetOutputDataObject(1)
    for row in range(table.GetNumberOfRows()):
        print(table.GetColumnByName("Channel").GetValue(row), " ".join(
            "%s %.4g" % (name, table.GetColumnByName(name).GetValue(row))
            for name in ("MeanA", "MeanB", "RelativeRMSE", "MeanRelative", "PSNR")))
    exposure = vtkExposureFilter()
    exposure.SetInputConnection(compare.GetOutputPort(0))
    exposure.SetPercentile(97.0)
    shown = vtkOpenColorIOImageFilter()
    shown.SetInputConnection(exposure.GetOutputPort())
    shown.SetOutputScalarTypeToUnsignedChar()
    write(vtkPNGWriter, shown, os.path.join(folder, "comparison.png"))
    colours = vtkFalseColorImageFilter()
    colours.SetInputData(images[0])
    colours.IsoLinesOn()
    write(vtkPNGWriter, colours, os.path.join(folder, "luminance.png"))
    print(exposure.GetOutput().GetFieldData().GetAbstractArray("ExposureSummary").GetValue(0))
    return table


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "out")
