# SPDX-License-Identifier: BSD-3-Clause
"""falsecolor.png: a quantity on the geometry, with legend, iso-lines and the lights."""
import numpy as np
from matplotlib import colormaps
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkContourFilter, vtkFeatureEdges
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkActor2D,
    vtkPolyDataMapper,
    vtkPolyDataMapper2D,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
    vtkWindowToImageFilter,
)
import vtkmodules.vtkRenderingFreeType  # noqa: F401  (text)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (the renderer)

from . import glyphs
from .scales import format_number

PAPER = (1.0, 1.0, 1.0)
INK = (0.10, 0.10, 0.12)
LEGEND_SHARE = 0.21  # of the picture's width
OVERSAMPLING = 2


def lookup_table(scale, colours="viridis"):
    """A perceptually even colour map over the scale."""
    table = vtkLookupTable()
    rgba = (colormaps[colours](np.linspace(0.0, 1.0, 256)) * 255.0 + 0.5).astype(np.uint8)
    table.SetTable(numpy_to_vtk(rgba, deep=True))
    if scale.log:
        table.SetScaleToLog10()
    table.SetRange(scale.low, scale.high)
    return table


def _text(text, x, y, size, bold=False, vertical="Bottom"):
    actor = vtkTextActor()
    actor.SetInput(text)
    actor.SetPosition(x, y)
    style = actor.GetTextProperty()
    style.SetFontSize(int(size))
    style.SetColor(INK)
    style.SetBold(bold)
    getattr(style, f"SetVerticalJustificationTo{vertical}")()
    return actor


def _surface_actor(field, table):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(field)
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("Quantity")
    mapper.InterpolateScalarsBeforeMappingOn()
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    mapper.SetRelativeCoincidentTopologyPolygonOffsetParameters(1.0, 1.0)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()  # the colour is the value, not a shade of it
    return actor


def _line_actor(algorithm, colour, width):
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(algorithm.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    style = actor.GetProperty()
    style.LightingOff()
    style.SetColor(colour)
    style.SetLineWidth(width)
    return actor


def _iso_lines(field, levels):
    contour = vtkContourFilter()
    contour.SetInputData(field)
    contour.SetInputArrayToProcess(0, 0, 0, 0, "Quantity")
    for index, level in enumerate(levels):
        contour.SetValue(index, level)
    contour.Update()
    return contour


def _creases(field):
    edges = vtkFeatureEdges()
    edges.SetInputData(field)
    edges.BoundaryEdgesOn()
    edges.FeatureEdgesOn()
    edges.SetFeatureAngle(40.0)
    edges.NonManifoldEdgesOff()
    edges.ManifoldEdgesOff()
    edges.ColoringOff()
    return edges


def _rectangles(boxes, colours):
    """Filled boxes (x0, y0, x1, y1) in pixels, each with its RGB colour (0 to 255)."""
    place = vtkPoints()
    quads = vtkCellArray()
    for x0, y0, x1, y1 in boxes:
        first = place.GetNumberOfPoints()
        for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1)):
            place.InsertNextPoint(x, y, 0.0)
        quads.InsertNextCell(4, [first, first + 1, first + 2, first + 3])
    flat = vtkPolyData()
    flat.SetPoints(place)
    flat.SetPolys(quads)
    flat.GetCellData().SetScalars(numpy_to_vtk(np.asarray(colours, dtype=np.uint8), deep=True))
    mapper = vtkPolyDataMapper2D()
    mapper.SetInputData(flat)
    actor = vtkActor2D()
    actor.SetMapper(mapper)
    return actor


def _legend(renderer, table, scale, left, bottom, right, top):
    """The colour bar with a tick and a number at each level, exactly where its colour is.

    (vtkScalarBarActor moves its outer labels inwards, by up to half a line.)
    """
    steps = 256
    colours = np.array([[255.0 * c for c in table.GetTableValue(k)[:3]] for k in range(steps)])
    edges = bottom + (top - bottom) * np.arange(steps + 1) / steps
    renderer.AddActor2D(_rectangles(
        [(left, edges[k], right, edges[k + 1]) for k in range(steps)], colours + 0.5))
    ticks = []
    for level in scale.levels:
        height = bottom + (top - bottom) * scale.fraction(level)
        ticks.append((right, height - 0.5 * OVERSAMPLING, right + 6 * OVERSAMPLING,
                      height + 0.5 * OVERSAMPLING))
        renderer.AddActor2D(_text(scale.label(level), right + 11 * OVERSAMPLING, height,
                                  15 * OVERSAMPLING, vertical="Centered"))
    renderer.AddActor2D(_rectangles(ticks, [[255.0 * c for c in INK]] * len(ticks)))


def write(path, field, outline, scale, heading, notes, lights, emitters, camera, size):
    """Draws `field` (polydata with the point array Quantity) and writes the PNG.

    outline: the surface whose creases are drawn; heading: quantity and unit; notes: lines under
    the legend; lights: the light polydata; emitters: the surfaces that emit, or None.
    """
    pixels = [side * OVERSAMPLING for side in size]
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(4)
    window.SetSize(*pixels)
    window.SetNumberOfLayers(2)

    main, above, side = vtkRenderer(), vtkRenderer(), vtkRenderer()
    main.SetViewport(0.0, 0.0, 1.0 - LEGEND_SHARE, 1.0)
    above.SetViewport(0.0, 0.0, 1.0 - LEGEND_SHARE, 1.0)
    side.SetViewport(1.0 - LEGEND_SHARE, 0.0, 1.0, 1.0)
    above.SetLayer(1)  # lights are seen through walls
    for renderer in (main, side, above):
        renderer.SetBackground(PAPER)
        window.AddRenderer(renderer)
    main.SetBackground(0.86, 0.87, 0.89)

    table = lookup_table(scale)
    main.AddActor(_surface_actor(field, table))
    inner = [level for level in scale.levels if scale.low < level < scale.high]
    if inner:
        main.AddActor(_line_actor(_iso_lines(field, inner), (1.0, 1.0, 1.0), 1.1 * OVERSAMPLING))
    creases = _line_actor(_creases(outline), INK, 0.9 * OVERSAMPLING)
    creases.GetProperty().SetOpacity(0.7)
    main.AddActor(creases)

    aspect = pixels[0] * (1.0 - LEGEND_SHARE) / pixels[1]
    camera.apply(main, aspect)
    above.SetActiveCamera(main.GetActiveCamera())
    legend = glyphs.add(above, lights, field.GetBounds(), camera, aspect)
    legend += glyphs.outline(above, emitters, 2.5 * OVERSAMPLING)
    main.ResetCameraClippingRange()

    width, height = pixels[0] * LEGEND_SHARE, pixels[1]
    unit = OVERSAMPLING
    side.AddActor2D(_text(heading[0], 0.08 * width, 0.95 * height, 19 * unit, True, "Top"))
    side.AddActor2D(_text(heading[1], 0.08 * width, 0.95 * height - 28 * unit, 14 * unit,
                          vertical="Top"))
    values = field.GetPointData().GetArray("Quantity").GetRange()
    _legend(side, table, scale, 0.08 * width, 0.345 * height, 0.28 * width, 0.845 * height)
    words = ["white lines at the legend's values",
             f"values from {format_number(values[0])} to {format_number(values[1])}"]
    if values[1] > scale.high * 1.000001:
        words.append(f"above {format_number(scale.high)}: the last colour")
    if values[0] < scale.low * 0.999999:
        words.append(f"below {format_number(scale.low)}: the first colour")
    text = _text("\n".join(words + list(notes)), 0.08 * width, 0.315 * height, 12 * unit,
                 vertical="Top")
    text.GetTextProperty().SetLineSpacing(1.35)
    side.AddActor2D(text)
    for index, (shape, words) in enumerate(legend):
        y = (0.15 * height) - index * 24 * unit
        side.AddActor2D(glyphs.key(shape, 0.08 * width + 9 * unit, y, 8 * unit))
        side.AddActor2D(_text(words, 0.08 * width + 26 * unit, y - 7 * unit, 13 * unit))

    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.SetInputBufferTypeToRGB()
    grab.ReadFrontBufferOff()
    grab.Update()
    _write_reduced(path, grab.GetOutput(), size)
    window.Finalize()


def _write_reduced(path, image, size):
    """Averages blocks of OVERSAMPLING x OVERSAMPLING pixels and writes the PNG."""
    width, height = size
    data = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(
        height, OVERSAMPLING, width, OVERSAMPLING, 3)
    data = data.astype(np.float32).mean(axis=(1, 3))
    small = vtkImageData()
    small.SetDimensions(width, height, 1)
    array = numpy_to_vtk((data + 0.5).astype(np.uint8).reshape(-1, 3), deep=True)
    small.GetPointData().SetScalars(array)
    writer = vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputData(small)
    writer.Write()
