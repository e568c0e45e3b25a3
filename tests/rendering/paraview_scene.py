# SPDX-License-Identifier: BSD-3-Clause
"""What the tests inside ParaView share: the plugin, a view that looks along -z, pictures as arrays.

A render view shows linear values in 8 bits: a radiance of 0.5 reads 127 or 128.
"""
import atexit
import math
import os
import shutil
import sys
import tempfile

import numpy as np

import display

display.ensure()

from paraview import simple as pv  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGReader  # noqa: E402

PLUGIN = os.path.join(os.environ["RADIOMETRY_BUILD_DIR"],
                      "lib/paraview/plugins/Radiometry/Radiometry.so")
SIZE = 200
FOLDER = tempfile.mkdtemp()  # of this process
atexit.register(shutil.rmtree, FOLDER, True)


def check(condition, *what):
    if not condition:
        raise AssertionError(what)


def picture(view, name="picture"):
    path = os.path.join(FOLDER, name + ".png")
    pv.SaveScreenshot(path, view, ImageResolution=[SIZE, SIZE])
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    image = reader.GetOutput()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(SIZE, SIZE, -1)[:, :, :3].astype(int)


def new_view():
    pv._DisableFirstRenderCameraReset()
    view = pv.CreateView("RenderView")
    view.ViewSize = [SIZE, SIZE]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = [0.0, 0.0, 0.0]
    view.CameraParallelProjection = 1
    view.CameraPosition = [0, 0, 5]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 1, 0]
    view.CameraParallelScale = 1.0
    return view


def new_plane(cells=10):
    """The square [-0.9, 0.9]^2 with front and normals toward the camera."""
    return pv.Plane(Origin=[-0.9, -0.9, 0], Point1=[0.9, -0.9, 0], Point2=[-0.9, 0.9, 0],
                    XResolution=cells, YResolution=cells)


def show_surface(source, view):
    shown = pv.Show(source, view)
    shown.Representation = "Radiometric Surface"
    shown.ColorArrayName = ["POINTS", ""]
    shown.DiffuseColor = [1, 1, 1]
    shown.ShadingTimeShare = 1e6  # the same bytes each time
    return shown


def show_lights(source, view, glyph=0.0):
    shown = pv.Show(source, view)
    shown.Representation = "Radiometric Lights"
    shown.ShowGlyphs = int(glyph > 0)
    shown.LightGlyphSize = glyph
    return shown


def radiance(intensity, height, x=0.0, y=0.0):
    """Of a white matte floor at (x, y) under an isotropic light at (0, 0, height), W/(m^2 sr)."""
    return intensity * height / (height ** 2 + x * x + y * y) ** 1.5 / math.pi


def pixel(x, y):
    return int((y + 1) / 2 * SIZE), int((x + 1) / 2 * SIZE)


def expect(image, x, y, value, tolerance=1.0):
    got = image[pixel(x, y)]
    wanted = np.clip(np.asarray(value) * 255.0, 0, 255)
    check(np.all(np.abs(got - wanted) <= tolerance), (x, y), got, wanted)


def run(module_globals):
    """Loads the plugin and runs every function named test_..."""
    pv.LoadPlugin(PLUGIN, remote=False, ns=vars(pv))
    for name, test in list(module_globals.items()):
        if name.startswith("test_") and callable(test):
            test()
            print("passed", name)
            sys.stdout.flush()
