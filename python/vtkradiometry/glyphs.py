# SPDX-License-Identifier: BSD-3-Clause
"""Lights as small shapes: a ball (point), a cone (spot), an arrow (directional), the solid of its
distribution (luminaire), its own polygon (area), a dome (environment)."""
import math

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkPolyDataNormals
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersSources import vtkArrowSource, vtkConeSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkActor2D,
    vtkPolyDataMapper,
    vtkPolyDataMapper2D,
)

from .lights import AREA, DIRECTIONAL, ENVIRONMENT, POINT, SPOT

COLOUR = (0.90, 0.23, 0.10)
LUMINAIRE, EMITTER = 10, 11
WORDS = {POINT: "point light", SPOT: "spot light", DIRECTIONAL: "directional light",
         LUMINAIRE: "luminaire", AREA: "area light", ENVIRONMENT: "sky"}


def _shape(kind):
    """The shape of a kind that has one, along the x axis and of about unit size."""
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
    shape.Update()
    return shape.GetOutput()


def _dome():
    """A vault about the x axis, open away from it."""
    sphere = vtkSphereSource()
    sphere.SetThetaResolution(24)
    sphere.SetPhiResolution(8)
    sphere.SetRadius(0.5)
    sphere.SetEndPhi(90.0)
    turn = vtkTransform()
    turn.RotateY(90.0)
    move = vtkTransformPolyDataFilter()
    move.SetInputConnection(sphere.GetOutputPort())
    move.SetTransform(turn)
    move.Update()
    return move.GetOutput()


def _grid_surface(places):
    """Polydata of a (rows, columns, 3) grid of places."""
    rows, columns = places.shape[:2]
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(places.reshape(-1, 3)), deep=True))
    quads = vtkCellArray()
    for j in range(rows - 1):
        for i in range(columns - 1):
            k = j * columns + i
            quads.InsertNextCell(4, [k, k + 1, k + columns + 1, k + columns])
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(quads)
    normals = vtkPolyDataNormals()
    normals.SetInputData(data)
    normals.SetFeatureAngle(80.0)
    normals.Update()
    return normals.GetOutput()


def _web_solid(light):
    """The distribution of a luminaire about the origin, its greatest intensity of length 1; None
    where the web is incomplete. Angles as in radiometry/scene/CandelaWeb.h."""
    values, horizontal, vertical = (light.web_array(suffix)
                                    for suffix in ("", "Horizontal", "Vertical"))
    if values is None or horizontal is None or vertical is None:
        return None
    values = values.astype(float).reshape(len(horizontal), len(vertical))
    kind = light.web_array("Type")
    kind = 1 if kind is None else int(kind[0])
    if len(horizontal) == 1:  # the same in every plane
        horizontal = np.linspace(0.0, 360.0, 37)
        values = np.repeat(values, len(horizontal), axis=0)
    h, v = np.meshgrid(np.radians(horizontal), np.radians(vertical), indexing="ij")
    if kind == 1:
        x, y, z = np.sin(v) * np.cos(h), np.sin(v) * np.sin(h), -np.cos(v)
    elif kind == 2:
        x, y, z = np.cos(h) * np.sin(v), -np.sin(h), -np.cos(h) * np.cos(v)
    else:
        x, y, z = np.sin(v), -np.cos(v) * np.sin(h), -np.cos(v) * np.cos(h)
    axis = _unit(light.direction)
    first = light.reference - light.reference.dot(axis) * axis
    first = _unit(first if np.linalg.norm(first) > 1e-9 else np.roll(axis, 1))
    second = np.cross(-axis, first)
    lengths = (values / values.max())[..., None]
    return _grid_surface(lengths * (x[..., None] * first + y[..., None] * second
                                    - z[..., None] * axis))


def _polygon(points):
    """One polygon as polydata."""
    places = vtkPoints()
    for point in points:
        places.InsertNextPoint(*point)
    cells = vtkCellArray()
    cells.InsertNextCell(len(points), range(len(points)))
    data = vtkPolyData()
    data.SetPoints(places)
    data.SetPolys(cells)
    return data


def _unit(vector):
    length = np.linalg.norm(vector)
    return vector / length if length > 0.0 else np.array([0.0, 0.0, -1.0])


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


def _actor(renderer, data, transform=None, opacity=1.0):
    """Draws polydata in the colour of lights, moved by the transform."""
    if transform is not None:
        move = vtkTransformPolyDataFilter()
        move.SetInputData(data)
        move.SetTransform(transform)
        move.Update()
        data = move.GetOutput()
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    style = actor.GetProperty()
    style.SetColor(COLOUR)
    style.SetAmbient(0.35)
    style.SetDiffuse(0.75)
    style.SetOpacity(opacity)
    renderer.AddActor(actor)
    return actor


def _placed(direction, scale, place):
    transform = _along(direction)
    transform.Scale(scale, scale, scale)
    transform.Translate(*place)
    return transform


def _add_area(renderer, light, scale):
    """The polygon with its outline, and an arrow to each side that it shines to."""
    shape = _polygon(light.points)
    _actor(renderer, shape, opacity=0.55).GetProperty().LightingOff()
    outline(renderer, shape, 3.0)
    corners = light.points - light.points[0]
    normal = _unit(np.cross(corners[1:-1], corners[2:]).sum(axis=0))
    for side in (1.0, -1.0) if light.two_sided else (1.0,):
        _actor(renderer, _shape(DIRECTIONAL),
               _placed(side * normal, 1.6 * scale, light.points.mean(axis=0)))


def add(renderer, lights, bounds, camera, aspect):
    """Adds a glyph for each enabled light and returns the legend: [(kind, words)].

    aspect: width/height of the picture, to place what has no place of its own.
    """
    low, high = np.array(bounds[0::2]), np.array(bounds[1::2])
    size = float(np.linalg.norm(high - low))
    counts = {}
    unplaced = 0
    for light in lights:
        kind = LUMINAIRE if light.web is not None else light.kind
        if not light.enabled or kind not in WORDS:
            continue
        counts[kind] = counts.get(kind, 0) + 1
        direction = _unit(light.direction)
        if kind in (DIRECTIONAL, ENVIRONMENT):  # no place: in the upper left of the picture
            middle, scale = camera.corner(aspect, -0.84 + 0.2 * unplaced, 0.78, 0.14)
            unplaced += 1
            if kind == DIRECTIONAL:
                _actor(renderer, _shape(kind),
                       _placed(direction, scale, middle - 0.5 * scale * direction))
            else:
                _actor(renderer, _dome(), _placed(-direction, 0.8 * scale, middle))
            continue
        place = light.points.mean(axis=0)
        scale = 0.05 * min(size, camera.distance_to(place))
        solid = _web_solid(light) if kind == LUMINAIRE else None
        if kind == AREA:
            _add_area(renderer, light, scale)
        elif solid is not None:
            transform = vtkTransform()
            transform.Translate(*place)
            transform.Scale(2.0 * scale, 2.0 * scale, 2.0 * scale)
            _actor(renderer, solid, transform)
        else:
            _actor(renderer, _shape(kind),
                   _placed(direction if kind == SPOT else (1.0, 0.0, 0.0), scale, place))
    return [(kind, WORDS[kind] + (f"s ({count})" if count > 1 and kind != ENVIRONMENT else ""))
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
    elif kind == LUMINAIRE:  # a drop that hangs
        steps = np.linspace(0.0, math.pi, 24)
        corners = [(1.1 * math.sin(2.0 * a) * math.sin(a), 1.0 - 2.0 * math.sin(a)**2)
                   for a in steps]
    elif kind == ENVIRONMENT:
        steps = np.linspace(0.0, math.pi, 16)
        corners = [(math.cos(a), 1.3 * math.sin(a) - 0.6) for a in steps]
    elif kind in (EMITTER, AREA):
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
