#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pictures of docs/rendering/field.md.

    PYTHONPATH=build/lib/python3/dist-packages:tests /usr/bin/python3 benchmarks/figures_field.py

Writes docs/images/field-highlights.png, field-lights.png and field-false-color.png.
"""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "tests"))
import display  # noqa: E402

display.ensure()

import matplotlib  # noqa: E402
import numpy as np  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import vtkmodules.all as vtk  # noqa: E402
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # noqa: E402
from vtkradiometry import (  # noqa: E402
    vtkAreaLightSource,
    vtkDirectionalLightSource,
    vtkEnvironmentLightSource,
    vtkLinearFloatPass,
    vtkPhongGouraudMapper,
    vtkPointLightSource,
    vtkRadiosityFilter,
)

IMAGES = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "docs", "images")
WIDTH, HEIGHT = 480, 360


def named(name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values, dtype=float), deep=True)
    array.SetName(name)
    return array


def piece(source, diffuse, specular, shininess):
    """Triangles with normals and a material."""
    chain = vtk.vtkTriangleFilter()
    chain.SetInputConnection(source.GetOutputPort())
    chain.Update()
    data = vtk.vtkPolyData()
    data.ShallowCopy(chain.GetOutput())
    count = data.GetNumberOfCells()
    data.GetPointData().RemoveArray("TextureCoordinates")
    data.GetCellData().AddArray(named("DiffuseReflectance", [diffuse] * count))
    data.GetCellData().AddArray(named("SpecularReflectance", [[specular] * 3] * count))
    data.GetCellData().AddArray(named("Shininess", [shininess] * count))
    return data


def floor(n):
    source = vtk.vtkPlaneSource()
    source.SetOrigin(-3, -3, 0)
    source.SetPoint1(3, -3, 0)
    source.SetPoint2(-3, 3, 0)
    source.SetResolution(n, n)
    return source


def ball(x, y, r):
    source = vtk.vtkSphereSource()
    source.SetCenter(x, y, r)
    source.SetRadius(r)
    source.SetThetaResolution(32)
    source.SetPhiResolution(20)
    return source


def scene(n=110):
    append = vtk.vtkAppendPolyData()
    append.AddInputData(piece(floor(n), (0.6, 0.58, 0.55), 0.08, 60.0))
    append.AddInputData(piece(ball(-0.9, 0.2, 0.7), (0.6, 0.15, 0.1), 0.12, 80.0))
    append.AddInputData(piece(ball(0.9, -0.5, 0.5), (0.1, 0.25, 0.6), 0.12, 30.0))
    append.AddInputData(piece(ball(0.4, 1.3, 0.6), (0.5, 0.5, 0.1), 0.05, 10.0))
    append.Update()
    return append.GetOutput()


def lamps(*sources):
    append = vtk.vtkAppendPolyData()
    for source in sources:
        append.AddInputConnection(source.GetOutputPort())
    append.Update()
    return append.GetOutput()


def three_lamps():
    key = vtkPointLightSource()
    key.SetPosition(-2.5, -2.0, 4.0)
    key.SetIntensity(60.0)
    fill = vtkPointLightSource()
    fill.SetPosition(3.0, -1.5, 2.5)
    fill.SetIntensity(15.0)
    return lamps(key, fill)


def solved(data, lights):
    f = vtkRadiosityFilter()
    f.SetInputData(data)
    f.AddLightsData(lights)
    f.SetSampleLocation(1)
    f.SetLightVisibility(True)
    f.SetRelativeTolerance(0.1)
    f.SetTimeBudget(15)
    f.Update()
    return f.GetOutputDataObject(0)


class Stage:
    def __init__(self, data):
        self.mapper = vtkPhongGouraudMapper()
        self.mapper.SetInputDataObject(data)
        self.mapper.SetScalarVisibility(False)
        self.mapper.SetFieldModeToMaterials()
        self.actor = vtk.vtkActor()
        self.actor.SetMapper(self.mapper)
        self.renderer = vtk.vtkRenderer()
        self.renderer.AddActor(self.actor)
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(0, -6.0, 3.4)
        camera.SetFocalPoint(0, 0.1, 0.35)
        camera.SetViewUp(0, 0, 1)
        camera.SetViewAngle(32)
        self.window = vtk.vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(WIDTH, HEIGHT)
        self.window.AddRenderer(self.renderer)

    def light(self):
        """The picture in linear light, the first row on top."""
        target = vtkLinearFloatPass()
        target.SetSamples(2)
        self.renderer.SetPass(target)
        self.window.Render()
        values = vtk_to_numpy(target.GetColor().GetPointData().GetScalars())
        return values.reshape(HEIGHT, WIDTH, 4)[::-1, :, :3].copy()

    def bytes(self):
        self.renderer.SetPass(None)
        self.window.Render()
        out = vtk.vtkUnsignedCharArray()
        self.window.GetPixelData(0, 0, WIDTH - 1, HEIGHT - 1, 0, out, 0)
        return vtk_to_numpy(out).reshape(HEIGHT, WIDTH, 3)[::-1].copy()


def displayed(light, exposure):
    x = np.clip(light * exposure, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def save(name, pictures, columns):
    rows = (len(pictures) + columns - 1) // columns
    figure, axes = plt.subplots(rows, columns, figsize=(4.6 * columns, 3.75 * rows))
    for axis, (title, image) in zip(np.ravel(axes), pictures):
        axis.imshow(image)
        axis.set_title(title, fontsize=11)
        axis.axis("off")
    figure.tight_layout()
    figure.savefig(os.path.join(IMAGES, name), dpi=100)


def highlights():
    lights = three_lamps()
    stage = Stage(SURFACE)
    stage.mapper.SetLightData(lights)
    stage.mapper.UseLightVisibilityOff()
    bare = stage.light()
    exposure = 0.85 / np.quantile(bare, 0.97)
    pictures = [("Lit by the lights", displayed(bare, exposure))]
    stage.mapper.UseLightVisibilityOn()
    pictures.append(("... with LightVisibility", displayed(stage.light(), exposure)))
    stage.mapper.SetFieldModeToOn()
    stage.mapper.SetFieldArrayName("Radiosity")
    stage.mapper.SetFieldScale(1 / math.pi)
    stage.mapper.HighlightsOff()
    pictures.append(("Radiosity as radiance", displayed(stage.light(), exposure)))
    stage.mapper.HighlightsOn()
    pictures.append(("... with highlights, in the same shadows", displayed(stage.light(), exposure)))
    save("field-highlights.png", pictures, 2)


def luminaire():
    """A web of two wings, as of a wall washer, drawn from a formula."""
    source = vtkPointLightSource()
    source.SetPosition(0, 0, 2.2)
    source.SetIntensity(14.0)
    source.Update()
    data = vtk.vtkPolyData()
    data.DeepCopy(source.GetOutput())
    horizontal, vertical = np.linspace(0, 360, 37), np.linspace(0, 90, 46)
    c, g = np.meshgrid(np.radians(horizontal), np.radians(vertical), indexing="ij")
    wings = np.cos(c) ** 2 * np.exp(-((g - 0.85) / 0.25) ** 2) + 0.35 * np.exp(-((g / 0.3) ** 2))
    for suffix, values in (("", wings.ravel()), ("Horizontal", horizontal), ("Vertical", vertical)):
        data.GetFieldData().AddArray(named("PhotometricWeb0" + suffix, values))
    vtk_to_numpy(data.GetPointData().GetArray("PhotometricWeb"))[:] = 0
    return data


def kinds_of_lights():
    panel = vtkAreaLightSource()
    panel.SetPosition(-0.6, -0.3, 2.4)
    panel.SetDirection(0, 0, -1)
    panel.SetWidth(2.4)
    panel.SetHeight(0.5)
    panel.SetIntensity(20.0)
    sky = vtkEnvironmentLightSource()
    sun = vtkDirectionalLightSource()
    sun.SetDirection(0.6, 0.4, -0.8)
    sun.SetIntensity(1.0)
    pictures = []
    for title, lights in (("A luminaire with its candela web", luminaire()),
                          ("An area light, 2.4 m x 0.5 m", lamps(panel)),
                          ("A sky (Environment Light)", lamps(sky))):
        stage = Stage(scene(16))
        stage.mapper.SetLightData(lights)
        light = stage.light()
        pictures.append((title, displayed(light, 0.85 / np.quantile(light, 0.97))))
    save("field-lights.png", pictures, 3)


def false_colors():
    surface = SURFACE
    table = vtk.vtkDiscretizableColorTransferFunction()
    for t, color in ((0.0, (0.05, 0.03, 0.3)), (0.35, (0.75, 0.2, 0.35)), (0.7, (0.98, 0.65, 0.2)),
                     (1.0, (1.0, 1.0, 0.75))):
        table.AddRGBPoint(0.1 * 100 ** t, *color)
    table.SetUseLogScale(True)
    table.DiscretizeOn()
    table.SetNumberOfValues(12)
    table.Build()
    irradiance = vtk_to_numpy(surface.GetPointData().GetArray("Irradiance")).mean(axis=1)
    surface.GetPointData().AddArray(named("E", irradiance))
    stage = Stage(surface)
    stage.mapper.SetScalarVisibility(True)
    stage.mapper.SetFieldModeToFalseColor()
    stage.mapper.SetScalarModeToUsePointFieldData()
    stage.mapper.SelectColorArray("E")
    stage.mapper.SetLookupTable(table)
    stage.mapper.SetUseLookupTableScalarRange(True)
    stage.renderer.SetBackground(1, 1, 1)
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle("E [W/m2]")
    bar.SetNumberOfLabels(3)
    bar.SetLabelFormat("%-#.2g")
    bar.SetPosition(0.83, 0.12)
    bar.SetPosition2(0.14, 0.76)
    bar.UnconstrainedFontSizeOn()
    for style, size in ((bar.GetTitleTextProperty(), 15), (bar.GetLabelTextProperty(), 14)):
        style.SetColor(0, 0, 0)
        style.SetItalic(False)
        style.SetShadow(False)
        style.SetFontSize(size)
    stage.renderer.AddActor2D(bar)
    save("field-false-color.png", [("Irradiance in false colour", stage.bytes())], 1)


SURFACE = solved(scene(), three_lamps())
highlights()
kinds_of_lights()
false_colors()
