# SPDX-License-Identifier: BSD-3-Clause
"""Lights as small shapes: a ball (point), a cone (spot), an arrow (directional)."""
import math

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkFeatureEdges
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersSources import vtkArrowSource, vtkConeSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkActor2D,
    vtkPolyDataMapper,
    vtkPolyDataMapper2D,
)

COLOUR = (0.90, 0.23, 0.10)
POINT, SPOT, DIRECTIONAL, EMITTER = 0, 1, 2, 3
WORDS = {POINT: "point light", SPOT: "spot light", DIRECTIONAL: "directional light"}


def _shape(kind):
    if kind == SPOT:  # the tip is the lamp, the opening shows where it points
        shape = vtkConeSource()
        shape.SetResolution(32)
        shape.SetHeight(1.0)
        shape.SetRadius(0.45)
        shape.SetDirection(-1.0, 0.0, 0.0)
        shape.SetCenter(0.5, 0.0, 0.0)
    elif kind == DIRECTIONAL:
        shape = vtkArrowSource()
        shape.SetTipResolution(24)
        shape.SetShaftResolution(24)
        shape.SetTipLength(0.28)
        shape.SetTipRadius(0.09)
        shape.SetShaftRadius(0.03)
    else:
        shape = vtkSphereSource()
        shape.SetThetaResolution(24)
        shape.SetPhiResolution(16)
        shape.SetRadius(0.42)
    return shape


def _along(direction):
    """A transform that turns the x axis into `direction`."""
    transform = vtkTransform()
    transform.PostMultiply()
    x, y, z = direction
    angle = math.degrees(math.acos(max(-1.0, min(1.0, x))))
    axis = (0.0, -z, y)
    if math.hypot(y, z) < 1e-12:
        axis = (0.0, 0.0, 1.0)
    transform.RotateWXYZ(angle, *axis)
    return transform


def _column(lights, name, fallback):
    array = lights.GetPointData().GetArray(name)
    if array is None:
        return np.array([fallback] * lights.GetNumberOfPoints())
    return vtk_to_numpy(array)


def add(renderer, lights, bounds, camera, aspect):
    """Adds a glyph for each enabled light and returns the legend: [(kind, words)].

    aspect: width/height of the picture, to place what has no place of its own.
    """
    if lights is None or lights.GetNumberOfPoints() == 0:
        return []
    low, high = np.array(bounds[0::2]), np.array(bounds[1::2])
    size = float(np.linalg.norm(high - low))
    kinds = _column(lights, "LightType", POINT)
    enabled = _column(lights, "LightEnabled", 1)
    directions = _column(lights, "Direction", (0.0, 0.0, -1.0))
    counts = {}
    for index in range(lights.GetNumberOfPoints()):
        kind = int(kinds[index])
        if not enabled[index] or kind not in WORDS:
            continue
        counts[kind] = counts.get(kind, 0) + 1
        direction = np.asarray(directions[index], dtype=float)
        length = np.linalg.norm(direction)
        direction = direction / length if length > 0.0 else np.array([0.0, 0.0, -1.0])
        transform = _along(direction if kind != POINT else (1.0, 0.0, 0.0))
        if kind == DIRECTIONAL:  # has no place: an arrow in the upper left of the picture
            middle, scale = camera.corner(aspect, -0.84 + 0.2 * (counts[kind] - 1), 0.78, 0.14)
            place = middle - 0.5 * scale * direction
        else:
            place = np.array(lights.GetPoint(index))
            scale = 0.05 * min(size, camera.distance_to(place))
        transform.Scale(scale, scale, scale)
        transform.Translate(*place)
        shape = _shape(kind)
        move = vtkTransformPolyDataFilter()
        move.SetInputConnection(shape.GetOutputPort())
        move.SetTransform(transform)
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(move.GetOutputPort())
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(COLOUR)
        actor.GetProperty().SetAmbient(0.35)
        actor.GetProperty().SetDiffuse(0.75)
        renderer.AddActor(actor)
    return [(kind, WORDS[kind] + (f"s ({count})" if count > 1 else ""))
            for kind, count in sorted(counts.items())]


def outline(renderer, emitters, width):
    """Draws the outline of the emitting surfaces and returns their line of the legend."""
    if emitters is None or emitters.GetNumberOfCells() == 0:
        return []
    edges = vtkFeatureEdges()
    edges.SetInputData(emitters)
    edges.BoundaryEdgesOn()
    edges.FeatureEdgesOff()
    edges.NonManifoldEdgesOff()
    edges.ManifoldEdgesOff()
    edges.ColoringOff()
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(edges.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(COLOUR)
    actor.GetProperty().SetLineWidth(width)
    actor.GetProperty().LightingOff()
    renderer.AddActor(actor)
    return [(EMITTER, "emitting surface")]


def key(kind, x, y, radius):
    """The flat sign of a kind of light for the legend, around pixel (x, y)."""
    if kind == SPOT:
        corners = [(0.0, 1.0), (0.8, -0.9), (-0.8, -0.9)]
    elif kind == DIRECTIONAL:
        corners = [(-1.0, 0.2), (0.2, 0.2), (0.2, 0.65), (1.0, 0.0), (0.2, -0.65), (0.2, -0.2),
                   (-1.0, -0.2)]
    elif kind == EMITTER:
        corners = [(-0.9, -0.6), (0.9, -0.6), (0.9, 0.6), (-0.9, 0.6)]
    else:
        steps = np.linspace(0.0, 2.0 * math.pi, 24, endpoint=False)
        corners = [(0.8 * math.cos(a), 0.8 * math.sin(a)) for a in steps]
    places = vtkPoints()
    fan = vtkCellArray()
    places.InsertNextPoint(x, y, 0.0)
    for dx, dy in corners:
        places.InsertNextPoint(x + radius * dx, y + radius * dy, 0.0)
    for k in range(len(corners)):
        fan.InsertNextCell(3, [0, 1 + k, 1 + (k + 1) % len(corners)])
    flat = vtkPolyData()
    flat.SetPoints(places)
    flat.SetPolys(fan)
    mapper = vtkPolyDataMapper2D()
    mapper.SetInputData(flat)
    actor = vtkActor2D()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(COLOUR)
    return actor
