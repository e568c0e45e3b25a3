# SPDX-License-Identifier: BSD-3-Clause
"""The front end's own numerics: refining, smoothing, scales, camera, output folder."""
import os
import tempfile

import numpy as np
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkRenderer
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401

from front_end import listing, require
from vtkradiometry import (glyphs, mesh, view_mesh, vtkAreaLightSource, vtkEnvironmentLightSource,
                           vtkPointLightSource)
from vtkradiometry.camera import Camera
from vtkradiometry.files import OutputFolder
from vtkradiometry.lights import Lights
from vtkradiometry.scales import Scale, nice_step, weighted_quantile

# Refining keeps the area, respects the edge length and leaves no gaps.
cube = vtkCubeSource()
cube.SetXLength(4.0)
cube.SetYLength(3.0)
cube.SetZLength(2.5)
cube.Update()
fine, edge = mesh.refine(cube.GetOutput(), 0.5)
corner = mesh.points(fine)[mesh.triangles(fine)]
longest = max(np.linalg.norm(corner[:, k] - corner[:, k - 1], axis=1).max() for k in range(3))
require(edge == 0.5 and longest <= 0.5 + 1e-12, "edge", longest)
require(abs(mesh.areas(fine).sum() - 59.0) < 1e-12 * 59.0, "area", mesh.areas(fine).sum())
kept, edge = mesh.refine(cube.GetOutput(), 0.0)
require(edge == 0.0 and kept.GetNumberOfCells() == 12, "max edge 0 must keep the mesh")
automatic, edge = mesh.refine(cube.GetOutput(), "auto")
require(0.5 < automatic.GetNumberOfCells() / mesh.AUTOMATIC_TRIANGLES < 2.0,
        "automatic refinement gave", automatic.GetNumberOfCells())



def open_edges(triangles):
    """Edges that do not belong to exactly two triangles: none in a closed mesh."""
    edges = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2))
    return int((np.unique(edges, axis=0, return_counts=True)[1] != 2).sum())


closed = vtkSphereSource()
closed.SetThetaResolution(11)
closed.SetPhiResolution(7)
closed.Update()
for edge in (0.3, 0.07, 0.031):
    divided, _ = mesh.refine(closed.GetOutput(), edge)
    require(open_edges(mesh.triangles(divided)) == 0, "refining opens gaps at", edge)

# The picture's mesh: closed, of the same area, fine where it is seen, exact for linear fields.
ball, _ = mesh.refine(closed.GetOutput(), 0.2)
viewer = Camera((0.0, 0.3, 2.0), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), 30.0, 1.5)
drawn, rear = view_mesh.sides(ball, viewer, np.zeros(ball.GetNumberOfCells(), bool))
require(0 < drawn.sum() < len(drawn) and not rear.any(), "sides of a ball", drawn.sum())
rounded = mesh.SmoothSurface(ball)
fine_mesh = view_mesh.ViewMesh(ball, rounded, viewer, (300, 200), drawn, rear,
                               np.flatnonzero(drawn))
require(len(fine_mesh.origin) > 5 * len(drawn), "the picture's mesh is not fine")
require(open_edges(fine_mesh.index) == 0, "the picture's mesh has gaps")
require(abs(fine_mesh.area.sum() / mesh.areas(ball).sum() - 1.0) < 1e-12, "area")
linear = rounded.xyz @ np.array([[0.3], [-1.0], [2.0]]) + 4.0
exact = fine_mesh.xyz @ np.array([[0.3], [-1.0], [2.0]]) + 4.0
require(np.abs(fine_mesh.from_computed(linear) - exact).max() < 1e-12, "linear fields")
require(np.allclose(fine_mesh.from_cells(np.full((len(fine_mesh.origin), 1), 2.5)), 2.5), "constant")
inside = np.ones(ball.GetNumberOfCells(), bool)
both, rear = view_mesh.sides(ball, viewer, inside)
require(both.all() and rear.sum() == (~drawn).sum(), "two-sided cells show their backs")
turned = view_mesh.ViewMesh(ball, rounded, viewer, (300, 200), both, rear, np.arange(len(both)))
receiver = turned.receiver(ball)
toward = viewer.position - mesh.points(receiver)[mesh.triangles(receiver)].mean(axis=1)
front = np.einsum("ij,ij->i", mesh.cross_products(receiver), toward)
require((front > -1e-9 * np.abs(front).max()).all(), "every front turns to the camera")

# Smoothing: the cube's faces stay apart, the sphere becomes one smooth surface.
smooth = mesh.SmoothSurface(kept)
require(smooth.number == 24, "a cube has 24 smooth points, not", smooth.number)
outward = np.abs(smooth.normal).max(axis=1)
require(np.allclose(outward, 1.0), "normals of a cube lie along the axes")
values = np.arange(12.0)[:, None]
require(np.isclose((smooth.to_points(np.ones((12, 1))) - 1.0).max(), 0.0), "a constant stays")
back = smooth.to_points(values)
require(back.min() >= 0.0 and back.max() <= 11.0, "averages lie between the values")
ball = vtkSphereSource()
ball.SetThetaResolution(32)
ball.SetPhiResolution(24)
ball.Update()
sphere = mesh.SmoothSurface(mesh.triangulate(ball.GetOutput()))
require(sphere.number == ball.GetOutput().GetNumberOfPoints(), sphere.number)
require(((sphere.normal * sphere.xyz).sum(axis=1) / 0.5 > 0.999).all(), "normals of a sphere")
total = (sphere.polydata({}).GetNumberOfCells(), len(sphere.area))
require(total[0] == total[1], "cells", total)

# Scales: rounded, and the legend's positions are those of VTK's own lookup.
require([nice_step(s, 5) for s in (1.0, 7.0, 23.0, 0.04)] == [0.2, 2.0, 5.0, 0.01], "steps")
linear = Scale.choose(np.linspace(0.0, 870.0, 100), np.ones(100))
require((linear.low, linear.high, linear.log) == (0.0, 900.0, False), linear.__dict__)
wide = Scale.choose(np.geomspace(1.0, 4000.0, 100), np.ones(100))
require(wide.log and wide.low <= 2.0 and wide.high == 5000.0, wide.__dict__)
require(Scale.choose(np.zeros(5), np.ones(5)).high > 0.0, "all dark")
flat = Scale.choose(np.full(5, 3.0), np.ones(5))
require(flat.low < 3.0 < flat.high or flat.low <= 3.0 <= flat.high, flat.__dict__)
require(flat.high > flat.low, flat.__dict__)
for scale in (linear, wide):
    table = vtkLookupTable()
    table.SetNumberOfTableValues(256)
    if scale.log:
        table.SetScaleToLog10()
    table.SetRange(scale.low, scale.high)
    for level in scale.levels[:-1]:
        index = table.GetIndex(level * 1.000001)
        require(abs(index - 256.0 * scale.fraction(level)) <= 1.01, level, index)
require(weighted_quantile([1.0, 2.0, 3.0], [1.0, 1.0, 98.0], [0.5])[0] == 3.0, "weights count")

# Camera: the rays through pixels agree with VTK's projection.
camera = Camera((3.0, 2.0, 5.0), (0.5, 0.2, -0.3), (0.0, 1.0, 0.0), 35.0, 1.5)
renderer = vtkRenderer()
for width, height in ((300, 200), (160, 200), (400, 100)):
    camera.apply(renderer, width / height)
    origin, direction = camera.rays(width, height)
    matrix = renderer.GetActiveCamera().GetCompositeProjectionTransformMatrix(
        width / height, -1.0, 1.0)
    for row, column in ((0, 0), (height - 1, width - 1), (height // 3, width // 5)):
        place = origin[row, column] + 4.0 * direction[row, column]
        x, y, _, w = matrix.MultiplyPoint((*place, 1.0))
        require(abs((x / w + 1.0) / 2.0 * width - (column + 0.5)) < 1e-6 * width, "x", x / w)
        require(abs((y / w + 1.0) / 2.0 * height - (row + 0.5)) < 1e-6 * height, "y", y / w)
        depth = float((place - camera.position) @ camera.axes()[2])
        require(abs(depth - 4.0) < 1e-12, "depth", depth)
box = (-1.0, 3.0, 0.0, 2.5, -2.0, 2.0)
whole = Camera.three_quarter(box, aspect=1.6)
right, above, forward = whole.axes()
half = np.tan(np.radians(0.5 * whole.height_angle))
for corner in np.array(np.meshgrid(box[:2], box[2:4], box[4:])).T.reshape(-1, 3):
    offset = corner - whole.position
    require(abs(offset @ above) <= half * (offset @ forward) * 1.0001
            and abs(offset @ right) <= 1.6 * half * (offset @ forward) * 1.0001, "cut off", corner)

# Output folder: all or nothing.
with tempfile.TemporaryDirectory() as where:
    out = os.path.join(where, "a", "b")
    try:
        with OutputFolder(out) as output:
            with open(output.path("one.txt", "one"), "w", encoding="utf-8") as stream:
                stream.write("half")
            raise KeyError
    except KeyError:
        pass
    require(listing(where) == [], "an error leaves", listing(where))
    with OutputFolder(out) as output:
        with open(output.path("one.txt", "one"), "w", encoding="utf-8") as stream:
            stream.write("whole")
        require([p for p in listing(out) if not os.path.basename(os.path.dirname(p)).startswith(".")]
                == [output.aside], "visible before it was published")
        output.publish()
    require([os.path.basename(p) for p in listing(out)] == ["one.txt"], listing(out))

# Lights of every kind: names, kinds, places; glyphs and legend; soft ones switched off.
panel, heaven, bulb = vtkAreaLightSource(), vtkEnvironmentLightSource(), vtkPointLightSource()
panel.SetLightName("panel")
panel.SetPosition(0.0, 0.0, 2.0)
heaven.SetLightName("sky")
heaven.SunOn()
bulb.SetLightName("bulb")
for source in (panel, heaven, bulb):
    source.Update()
everything = Lights(*(source.GetOutput() for source in (panel, heaven, bulb)))
require([light.words for light in everything] == ["area", "environment", "directional", "point"],
        [light.words for light in everything])
require([light.name for light in everything] == ["panel", "sky", "sky sun", "bulb"],
        [light.name for light in everything])
rows = everything.rows()
require(np.allclose(rows[0]["Position"], [0.0, 0.0, 2.0]), rows[0])
require(rows[1]["Position"] is None and rows[1]["Unit"] == "W/(m^2 sr)", rows[1])
require(everything.soft and everything.lit, "soft and lit")
sharp = everything.sharp()
require(not sharp.soft and [light.enabled for light in sharp] == [False, False, True, True],
        [light.enabled for light in sharp])
require(all(light.enabled for light in everything), "sharp() changes the lights themselves")
stage = vtkRenderer()
legend = glyphs.add(stage, everything, (0.0, 1.0, 0.0, 1.0, 0.0, 2.0), viewer, 1.5)
require([words for _, words in legend] == ["point light", "directional light", "area light", "sky"],
        legend)
require(stage.GetActors().GetNumberOfItems() >= 6, "a polygon, its outline, an arrow and three more")
