# SPDX-License-Identifier: BSD-3-Clause
"""The scene-linear picture (scene.exr) and what the display transform makes of it (scene.png)."""
import math

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (the renderer)

from .vtkRadiometryRendering import (
    vtkFalseColorImageFilter,
    vtkLinearFloatPass,
    vtkOpenColorIOImageFilter,
    vtkPhongGouraudMapper,
)
from .faults import Listener

SAMPLES = 3  # of a pixel in each direction; averaged in scene-linear light
LUMINANCE = np.array([0.2126390, 0.7151687, 0.0721923])  # Y of linear Rec.709


def as_rgb(values):
    """Values with 1 or 3 bands as RGB; any other number of bands becomes the grey of its mean."""
    values = np.asarray(values, dtype=np.float64)
    if values.shape[1] == 3:
        return values
    return np.repeat(values.mean(axis=1, keepdims=True), 3, axis=1)


class Drawing:
    """One surface drawn again and again with other arrays, into a float frame buffer."""

    def __init__(self, surface, camera):
        self.camera = camera
        self.mapper = vtkPhongGouraudMapper()
        self.mapper.SetInputDataObject(surface)
        self.mapper.SetFieldModeToOn()
        self.mapper.ScalarVisibilityOff()
        actor = vtkActor()
        actor.SetMapper(self.mapper)
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(0.0, 0.0, 0.0)
        self.renderer.AddActor(actor)
        self.target = vtkLinearFloatPass()
        self.renderer.SetPass(self.target)
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.AddRenderer(self.renderer)

    def draw(self, name, association, width, height, samples):
        """The array `name` as (height, width, 4) floats, row 0 at the bottom."""
        self.target.SetSamples(samples)
        self.mapper.SetFieldArrayName(name)
        self.mapper.SetFieldAssociation(association)
        self.window.SetSize(width, height)
        self.camera.apply(self.renderer, width / height)
        self.window.Render()
        return self.read(width, height)

    def read(self, width, height):
        """The float frame buffer as an array."""
        image = self.target.GetColor()
        if image is None:
            raise OSError("the graphics driver offers no float frame buffer")
        values = vtk_to_numpy(image.GetPointData().GetScalars())
        return values.reshape(height, width, -1).astype(np.float32)

    def close(self):
        """Frees the graphics memory."""
        self.window.Finalize()


class Picture:
    """The linear picture and, for each pixel, the computed cell seen at its centre (-1: none)."""

    def __init__(self, rgb, cells, depth, normal):
        self.rgb, self.cells, self.depth, self.normal = rgb, cells, depth, normal

    def of_cells(self, values):
        """Values per computed cell (T, n) as (height, width, n); 0 where nothing is seen."""
        values = np.asarray(values, dtype=np.float32).reshape(-1, np.shape(values)[-1])
        image = values[np.maximum(self.cells, 0)]
        image[self.cells < 0] = 0.0
        return image


def seen_cells(surface, camera, size):
    """The numbers (TriangleNumber - 1) of the cells that show at a pixel's centre."""
    drawing = Drawing(surface, camera)
    try:
        number = drawing.draw("TriangleNumber", 1, *size, 1)[:, :, 0]
    finally:
        drawing.close()
    found = np.unique(np.rint(number).astype(np.int64)) - 1
    return found[found >= 0]


def render(view, radiance, camera, size, background=None):
    """Draws the radiance (at the points of the view mesh), and finds the computed cell, depth and
    normal of each pixel. background: the radiance from (n, 3) directions, where no surface is."""
    width, height = size
    surface = view.polydata({"Radiance": as_rgb(radiance).astype(np.float32)})
    drawing = Drawing(surface, camera)
    try:
        drawn = drawing.draw("Radiance", 0, width, height, SAMPLES)
        number = drawing.draw("TriangleNumber", 1, width, height, 1)[:, :, 0]
    finally:
        drawing.close()
    fine = np.rint(number).astype(np.int64) - 1
    rgb = _with_background(drawn, camera, background)
    depth, normal = _geometry(view, fine, camera)
    cells = np.where(fine >= 0, view.origin[np.maximum(fine, 0)], -1)
    return Picture(rgb, cells, depth, normal)


def _with_background(drawn, camera, background):
    """The picture with the background where surfaces leave (part of) a pixel free."""
    rgb, free = drawn[:, :, :3], 1.0 - drawn[:, :, 3]
    if background is None:
        return rgb
    height, width = free.shape
    _, directions = camera.rays(width, height)
    open_ = free > 0.0
    toward = directions[open_] / np.linalg.norm(directions[open_], axis=1, keepdims=True)
    behind = background(toward)
    if behind is None:
        return rgb
    rgb = rgb.copy()
    rgb[open_] += free[open_][:, None] * as_rgb(behind)
    return rgb


def _geometry(view, fine, camera):
    """Depth along the view axis (infinite where nothing is seen) and the smooth normal."""
    height, width = fine.shape
    origin, direction = camera.rays(width, height)
    seen = fine >= 0
    depth = np.full(fine.shape, np.inf)
    normal = np.zeros(fine.shape + (3,))
    chosen = view.corner[fine[seen]]
    corner = view.xyz[chosen]
    o, d = origin[seen], direction[seen]
    edge1, edge2 = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    p = np.cross(d, edge2)
    determinant = np.einsum("ij,ij->i", edge1, p)
    determinant[determinant == 0.0] = np.finfo(float).tiny
    s = o - corner[:, 0]
    u = np.einsum("ij,ij->i", s, p) / determinant
    q = np.cross(s, edge1)
    v = np.einsum("ij,ij->i", d, q) / determinant
    # A pixel's centre may fall a rounding error outside the triangle that was drawn there.
    weight = np.clip(np.stack([1.0 - u - v, u, v], axis=1), 0.0, 1.0)
    weight /= weight.sum(axis=1, keepdims=True)
    place = np.einsum("ij,ijk->ik", weight, corner)
    depth[seen] = (place - camera.position) @ camera.axes()[2]
    smooth_normal = np.einsum("ij,ijk->ik", weight, view.normal[chosen])
    length = np.linalg.norm(smooth_normal, axis=1, keepdims=True)
    normal[seen] = smooth_normal / np.maximum(length, np.finfo(float).tiny)
    return depth, normal


def automatic_exposure(rgb, seen):
    """The exposure, in stops, that brings the picture's typical brightness to middle grey and keeps
    all but the brightest 2 % of it below white."""
    luminance = (rgb @ LUMINANCE)[seen]
    luminance = luminance[luminance > 0.0]
    if not len(luminance):
        return 0.0
    typical = math.exp(float(np.mean(np.log(luminance))))
    bright = float(np.quantile(luminance, 0.98))
    return math.log2(min(0.25 / typical, 1.0 / bright) if bright > 0.0 else 0.25 / typical)


def to_image(values):
    """(height, width, n) floats as vtkImageData."""
    height, width = values.shape[:2]
    image = vtkImageData()
    image.SetDimensions(width, height, 1)
    array = numpy_to_vtk(np.ascontiguousarray(values.reshape(height * width, -1)), deep=True)
    image.GetPointData().SetScalars(array)
    return image


def write_luminance(path, drawn, efficacy):
    """The picture's luminance through a logarithmic colour map, with its legend."""
    alpha = (drawn.cells >= 0)[:, :, None]
    colour = vtkFalseColorImageFilter()
    colour.SetInputData(to_image(np.concatenate([drawn.rgb, alpha], axis=2).astype(np.float32)))
    colour.SetLuminancePerUnit(efficacy)
    with Listener() as listener:
        listener.observe(colour)
        colour.Update()
        listener.check("luminance")
    _write_image(path, colour.GetOutput())


def _write_image(path, image):
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputData(image)
    writer.Write()


def write_png(path, rgb, exposure, display, view):
    """The picture through OpenColorIO's display transform; returns what was used."""
    transform = vtkOpenColorIOImageFilter()
    transform.SetInputData(to_image(rgb.astype(np.float32)))
    transform.SetExposure(exposure)
    if display:
        transform.SetDisplay(display)
    if view:
        transform.SetView(view)
    transform.SetOutputScalarTypeToUnsignedChar()
    with Listener() as listener:
        listener.observe(transform)
        transform.Update()
        listener.check("display transform")
    shown = vtk_to_numpy(transform.GetOutput().GetPointData().GetScalars())
    _write_image(path, to_image(shown.reshape(rgb.shape[0], rgb.shape[1], -1)[:, :, :3]))
    return {"display": transform.GetUsedDisplay(), "view": transform.GetUsedView(),
            "OpenColorIO config": transform.GetUsedConfig()}
