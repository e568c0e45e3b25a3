#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How much sky does a street see? Houses along two streets that cross, the sky view factor of every
piece of ground and wall, and the view factors between the ground, the walls and the roofs:

    ./run --python examples/street/street.py [PICTURE.png]
"""
import sys

import numpy as np
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkradiometry import vtkViewFactorFilter

PIECE = 2.0                     # m, the side of the squares
STREET = 6.0                    # m wide
HOUSES = (((10, 12), 8), ((14, 12), 12), ((10, 8), 14), ((14, 8), 6))  # (width, depth), height
GROUND, WALLS, ROOFS = range(3)


def add(points, quads, kinds, corner, a, b, kind):
    """A rectangle with sides a and b, its front along a x b, in squares."""
    corner, a, b = (np.asarray(v, float) for v in (corner, a, b))
    n, m = (max(1, round(np.linalg.norm(v) / PIECE)) for v in (a, b))
    first = len(points)
    points += [corner + a * i / n + b * j / m for j in range(m + 1) for i in range(n + 1)]
    for j in range(m):
        for i in range(n):
            p = first + j * (n + 1) + i
            quads.append((p, p + 1, p + n + 2, p + n + 1))
            kinds.append(kind)


def town():
    """Four houses at a crossing; no ground under them."""
    points, quads, kinds = [], [], []
    half = STREET / 2
    widest = max(w for (w, _), _ in HOUSES)
    deepest = max(d for (_, d), _ in HOUSES)
    cuts_x = sorted({s * v for s in (-1, 1) for v in (half, *(half + w for (w, _), _ in HOUSES))}
                    | {-(half + widest + 2), half + widest + 2})
    cuts_y = sorted({s * v for s in (-1, 1) for v in (half, *(half + d for (_, d), _ in HOUSES))}
                    | {-(half + deepest + 2), half + deepest + 2})
    boxes = []
    for ((w, d), h), (sx, sy) in zip(HOUSES, ((-1, -1), (1, -1), (-1, 1), (1, 1))):
        x, y = sorted((sx * half, sx * (half + w))), sorted((sy * half, sy * (half + d)))
        boxes.append((x, y, h))
    for x0, x1 in zip(cuts_x, cuts_x[1:]):
        for y0, y1 in zip(cuts_y, cuts_y[1:]):
            if not any(bx[0] <= x0 < bx[1] and by[0] <= y0 < by[1] for bx, by, _ in boxes):
                add(points, quads, kinds, (x0, y0, 0), (x1 - x0, 0, 0), (0, y1 - y0, 0), GROUND)
    for (x0, x1), (y0, y1), h in boxes:
        x, y, z = (x1 - x0, 0, 0), (0, y1 - y0, 0), (0, 0, h)
        add(points, quads, kinds, (x0, y0, 0), x, z, WALLS)
        add(points, quads, kinds, (x0, y1, 0), z, x, WALLS)
        add(points, quads, kinds, (x0, y0, 0), z, y, WALLS)
        add(points, quads, kinds, (x1, y0, 0), y, z, WALLS)
        add(points, quads, kinds, (x0, y0, h), x, y, ROOFS)
    data = vtkPolyData()
    corners = vtkPoints()
    corners.SetData(numpy_to_vtk(np.array(points), deep=True))
    cells = vtkCellArray()
    for quad in quads:
        cells.InsertNextCell(4, quad)
    kind = numpy_to_vtk(np.array(kinds, np.int32), deep=True)
    kind.SetName("Kind")
    data.SetPoints(corners)
    data.SetPolys(cells)
    data.GetCellData().AddArray(kind)
    return data


def draw(surface, path):
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
    import vtkmodules.vtkRenderingFreeType  # noqa: F401
    from matplotlib import cm
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
    from vtkmodules.vtkRenderingCore import (vtkActor, vtkPolyDataMapper, vtkRenderer,
                                             vtkRenderWindow, vtkWindowToImageFilter)
    colors = vtkLookupTable()
    colors.SetNumberOfTableValues(256)
    for k in range(256):
        colors.SetTableValue(k, *cm.viridis(k / 255))
    colors.SetRange(0.0, 1.0)
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("SkyViewFactor")
    mapper.SetLookupTable(colors)
    mapper.SetScalarRange(0.0, 1.0)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()  # the legend's colours are the surface's
    actor.GetProperty().EdgeVisibilityOn()
    actor.GetProperty().SetEdgeColor(0.25, 0.25, 0.25)
    bar = vtkScalarBarActor()
    bar.SetLookupTable(colors)
    bar.SetTitle("sky view\nfactor")
    bar.SetNumberOfLabels(6)
    bar.SetLabelFormat("%.1f")
    bar.UnconstrainedFontSizeOn()
    bar.SetBarRatio(0.25)
    bar.SetVerticalTitleSeparation(14)
    bar.SetPosition(0.87, 0.15)
    bar.SetWidth(0.11)
    bar.SetHeight(0.7)
    for text, size in ((bar.GetTitleTextProperty(), 20), (bar.GetLabelTextProperty(), 18)):
        text.SetColor(0.1, 0.1, 0.1)
        text.SetFontSize(size)
        text.ItalicOff()
        text.ShadowOff()
        text.BoldOff()
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(actor)
    renderer.AddViewProp(bar)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(1200, 800)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(24, -36, 62)
    camera.SetFocalPoint(3, 0, 2)
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCamera()
    camera.Zoom(1.06)
    camera.SetWindowCenter(0.1, -0.02)
    window.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputConnection(picture.GetOutputPort())
    writer.Write()


def main(picture=None):
    """Prints the figures; with a path, draws the sky view factors there."""
    each = vtkViewFactorFilter()  # every square is a patch
    each.SetInputData(town())
    each.SetRelativeTolerance(0.03)
    each.SetAbsoluteTolerance(1e-3)
    each.Update()
    surface = each.GetOutputDataObject(0)
    kind = vtk_to_numpy(surface.GetCellData().GetArray("Kind"))
    sky = vtk_to_numpy(surface.GetCellData().GetArray("SkyViewFactor"))
    for name, k in (("ground", GROUND), ("walls", WALLS), ("roofs", ROOFS)):
        print(f"sky view factor of the {name}: {sky[kind == k].min():.2f} to "
              f"{sky[kind == k].max():.2f}")

    kinds = vtkViewFactorFilter()  # three patches
    kinds.SetInputData(town())
    kinds.SetPatchArray("Kind")
    kinds.EnvironmentRowsOn()
    kinds.Update()
    table = kinds.GetOutputDataObject(1)
    names = {GROUND: "ground", WALLS: "walls", ROOFS: "roofs", -1: "sky, ground beyond",
             -2: "backs"}
    for row in range(table.GetNumberOfRows()):
        i, j, f, error = (table.GetValue(row, c).ToDouble() for c in range(4))
        print(f"{names[i]:>7} -> {names[j]:19}{f:.4f} +- {error:.4f}")
    if picture:
        draw(surface, picture)
    return surface


if __name__ == "__main__":
    main(*sys.argv[1:2])
