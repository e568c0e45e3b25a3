# SPDX-License-Identifier: BSD-3-Clause
"""What the mapper draws: polygons and strips by its own model; points, lines, edges by VTK's."""
import math

import numpy as np

from drawing import Errors, Window, add, lights, polydata, run, square
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals, vtkStripper, vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkPolyDataMapper, vtkProperty, vtkTexture

SHADINGS = ("Flat", "Gouraud", "Phong")
LIGHT = {"LightType": 0, "Position": (0.5, 0.7, 2.0), "Intensity": (20, 10, 5)}
SUN = {"LightType": 2, "Intensity": (math.pi,) * 3}  # E = pi: a white surface shows 1


def window(surface, *records, shading="Phong"):
    w = Window()
    w.mapper.SetInputDataObject(surface)
    w.mapper.SetLightData(lights(*(records or (LIGHT,))))
    getattr(w.mapper, "SetShadingTo" + shading)()
    return w


def radiance(x, y, z=0.0):
    """Of a white Lambertian plane through (x, y, z) that faces +z under LIGHT."""
    to_light = np.array(LIGHT["Position"]) - (x, y, z)
    r = np.linalg.norm(to_light)
    return np.array(LIGHT["Intensity"]) * to_light[2] / r ** 3 / math.pi


def bent_grid(n=6):
    """A grid with curved normals, as polygons of four corners."""
    ticks = np.linspace(-0.8, 0.8, n + 1)
    points = [(x, y, 0.2 * x * y) for y in ticks for x in ticks]
    normals = [np.array((-0.2 * y, -0.2 * x, 1)) / math.sqrt(1 + 0.04 * (x * x + y * y))
               for y in ticks for x in ticks]
    cells = [(j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i)
             for j in range(n) for i in range(n)]
    return polydata(points, cells, normals)


def through(algorithm, data):
    algorithm.SetInputDataObject(data)
    algorithm.Update()
    return algorithm.GetOutput()


def test_polygons_strips_and_triangles_look_alike():
    quads = bent_grid()
    triangles = through(vtkTriangleFilter(), quads)
    strips = through(vtkStripper(), triangles)
    assert strips.GetNumberOfStrips() > 0
    for shading in ("Gouraud", "Phong"):  # a bent quad is cut along one diagonal or the other
        ours, theirs = [window(data, shading=shading).draw() for data in (quads, triangles)]
        assert np.allclose(ours, theirs, rtol=0.02), shading
    for shading in SHADINGS:  # strips may turn their diagonals: the light is the same anyway
        ours, theirs = [window(data, shading=shading).draw() for data in (strips, triangles)]
        assert (ours[:, :, 3] == 1).sum() > 1500
        assert np.allclose(ours, theirs, rtol=2e-5), shading


def test_flat_takes_the_mean_of_the_polygons_own_points():
    h = 0.8
    corners = [(-h, -h, 0), (h, -h, 0), (h, 0, 0), (0, 0, 0), (0, h, 0), (-h, h, 0)]  # an L
    w = window(polydata(corners, [range(6)], [(0, 0, 1)] * 6), shading="Flat")
    picture = w.draw()
    center = np.mean(corners, axis=0)
    for x, y in ((-0.4, -0.4), (0.4, -0.4), (-0.4, 0.4)):
        assert np.allclose(w.at(x, y, picture), radiance(*center), rtol=1e-5)
    assert w.at(0.4, 0.4, picture).tolist() == [0, 0, 0]  # outside of the L
    w = window(polydata(corners, [range(6)], [(0, 0, 1)] * 6))
    picture = w.draw()
    step = 2 / w.size
    for i, j in ((18, 18), (42, 18), (18, 42)):
        x, y = (i + 0.5) * step - 1, (j + 0.5) * step - 1
        assert np.allclose(picture[j, i, :3], radiance(x, y), rtol=1e-5)


def stock_picture(w):
    """The same with VTK's own mapper."""
    stock = vtkPolyDataMapper()
    stock.SetInputDataObject(w.mapper.GetInputDataObject(0, 0))
    w.actor.SetMapper(stock)
    return w.draw()


def test_points_lines_and_wireframe_are_vtks():
    surface = square()
    lines = vtkCellArray()
    for a, b in ((0, 2), (1, 3)):
        lines.InsertNextCell(2)
        lines.InsertCellPoint(a)
        lines.InsertCellPoint(b)
    verts = vtkCellArray()
    for i in range(4):
        verts.InsertNextCell(1)
        verts.InsertCellPoint(i)
    thin = vtkPolyData()
    thin.SetPoints(surface.GetPoints())
    thin.SetLines(lines)
    thin.SetVerts(verts)
    for representation, data in (("Surface", thin), ("Wireframe", surface), ("Points", surface)):
        w = window(data)
        w.target.AllSceneLinearOn()  # lines and points are no light: the target would leave them out
        getattr(w.actor.GetProperty(), "SetRepresentationTo" + representation)()
        w.actor.GetProperty().SetColor(0.25, 0.5, 1.0)
        w.actor.GetProperty().SetPointSize(5)
        ours = w.draw()
        assert (ours[:, :, 3] == 1).sum() > 3
        assert np.array_equal(ours, stock_picture(w)), representation


def test_lines_beside_polygons():
    surface = square(half=0.4)
    points = surface.GetPoints()
    ends = points.InsertNextPoint(-0.9, 0.7, 0), points.InsertNextPoint(0.9, 0.7, 0)
    add(surface.GetPointData(), "Normals", [(0, 0, 1)] * 6, dtype=np.float32)
    surface.GetPointData().SetActiveNormals("Normals")
    lines = vtkCellArray()
    lines.InsertNextCell(2)
    for end in ends:
        lines.InsertCellPoint(end)
    surface.SetLines(lines)
    w = window(surface, SUN, shading="Flat")  # its cell numbers count the line first
    w.actor.GetProperty().SetLineWidth(3)
    picture = w.draw()
    assert np.allclose(w.at(0, 0, picture), 1, rtol=1e-6)
    assert w.at(0, 0.7, picture)[0] > 0


def test_vertices_shown_on_a_surface():
    w = window(square(), SUN)
    w.actor.GetProperty().VertexVisibilityOn()
    w.actor.GetProperty().SetVertexColor(1, 0, 0)
    w.actor.GetProperty().SetPointSize(9)
    picture = w.draw()
    assert w.at(-0.78, -0.78, picture).tolist() == [1, 0, 0]
    assert np.allclose(w.at(0, 0, picture), 1, rtol=1e-6)


def test_edges_lie_on_the_finished_light():
    for shading in SHADINGS:
        w = window(bent_grid(2), dict(LIGHT, Intensity=(200, 100, 50)), shading=shading)
        w.actor.GetProperty().EdgeVisibilityOn()
        w.actor.GetProperty().SetEdgeColor(0, 0, 1)
        w.actor.GetProperty().SetLineWidth(2)
        edged = w.draw()
        w.actor.GetProperty().EdgeVisibilityOff()
        plain = w.draw()
        assert plain[:, :, 0].max() > 5
        # VTK's geometry shader makes a triangle half a line wider and stretches what is in it.
        assert np.allclose(w.at(0.4, 0.4, edged), w.at(0.4, 0.4, plain), rtol=0.01), shading
        line = w.at(0.4, 0.01, edged)  # beside the middle line: the edge's blue and no light
        assert line[2] > 0.5 and line[0] < 0.5 * w.at(0.4, 0.01, plain)[0], (shading, line)


def test_interpolation_flat_takes_the_cells_normals():
    """VTK's property wins where it says that there are no smooth normals."""
    surface = bent_grid()
    bare = vtkPolyData()
    bare.SetPoints(surface.GetPoints())
    bare.SetPolys(surface.GetPolys())
    for shading in SHADINGS:
        w = window(surface, shading=shading)
        smooth = w.draw()
        w.actor.GetProperty().SetInterpolationToFlat()
        assert np.array_equal(w.draw(), window(bare, shading=shading).draw()), shading
        w.actor.GetProperty().SetInterpolationToGouraud()
        assert np.array_equal(w.draw(), smooth), shading


def test_culling_and_lighting_off():
    w = window(square(), SUN)
    w.actor.GetProperty().SetColor(0.5, 0.25, 0.125)
    w.actor.GetProperty().FrontfaceCullingOn()
    assert w.draw()[:, :, 3].max() == 0
    w.actor.GetProperty().FrontfaceCullingOff()
    w.actor.GetProperty().BackfaceCullingOn()
    assert np.allclose(w.at(0, 0), (0.5, 0.25, 0.125), rtol=1e-6)
    w.actor.RotateY(180)
    assert w.draw()[:, :, 3].max() == 0
    w.actor.GetProperty().BackfaceCullingOff()
    w.mapper.SetLightData(lights(dict(SUN, Intensity=(1, 1, 1))))
    w.actor.GetProperty().LightingOff()  # the plain colour, as with every mapper
    assert np.allclose(w.at(0, 0), (0.5, 0.25, 0.125), rtol=1e-6)


def test_a_back_property_alone():
    """Seen from behind, with no ambient light anywhere (VTK then sets none of its uniforms)."""
    for shading in SHADINGS:
        w = window(square(), dict(SUN, Intensity=(2 * math.pi,) * 3, AttachedTo=2),
                   shading=shading)
        back = vtkProperty()
        back.SetColor(0.5, 0.75, 1.0)
        back.SetAmbient(0.0)
        w.actor.SetBackfaceProperty(back)
        assert np.allclose(w.at(0, 0), 2, rtol=1e-6)
        w.actor.RotateY(180)
        assert np.allclose(w.at(0, 0), (1.0, 1.5, 2.0), rtol=1e-6), shading
        add(w.mapper.GetInputDataObject(0, 0).GetCellData(), "F", [0.25])
        w.mapper.SetFieldArrayName("F")
        w.mapper.SetFieldModeToReflectance()
        assert np.allclose(w.at(0, 0), 0.5, rtol=1e-6), shading
        w.mapper.SetFieldModeToOn()
        assert np.allclose(w.at(0, 0), 0.25, rtol=1e-6), shading


def test_a_texture_multiplies_the_light():
    surface = square()
    add(surface.GetPointData(), "st", [(0, 0), (1, 0), (1, 1), (0, 1)], dtype=np.float32)
    surface.GetPointData().SetActiveTCoords("st")
    image = vtkImageData()
    image.SetDimensions(2, 1, 1)
    texels = numpy_to_vtk(np.array([(255, 51, 0), (0, 102, 255)], dtype=np.uint8), deep=True)
    image.GetPointData().SetScalars(texels)
    texture = vtkTexture()
    texture.SetInputData(image)
    texture.InterpolateOff()
    for shading in SHADINGS:
        w = window(surface, dict(SUN, Intensity=(4 * math.pi,) * 3), shading=shading)
        w.actor.SetTexture(texture)
        picture = w.draw()
        assert np.allclose(w.at(-0.4, 0, picture), (4, 0.8, 0), rtol=1e-5), shading
        assert np.allclose(w.at(0.4, 0, picture), (0, 1.6, 4), rtol=1e-5), shading


def test_normals_that_are_no_normals():
    for bad in (0.0, math.nan, math.inf):
        for shading in SHADINGS:
            surface = square()
            add(surface.GetPointData(), "Normals", [(bad,) * 3] * 4, dtype=np.float32)
            surface.GetPointData().SetActiveNormals("Normals")
            w = window(surface, SUN, shading=shading)
            w.mapper.SetEmission(0.25, 0.5, 0.75)
            seen = w.at(0, 0)
            flat = np.add((0.25, 0.5, 0.75), 1)  # the cell's own normal is good
            expected = flat if shading == "Flat" else (0.25, 0.5, 0.75)
            assert np.allclose(seen, expected, rtol=1e-6), (bad, shading, seen)


def test_nothing_to_draw():
    for empty in (vtkPolyData(), polydata([(0, 0, 0)], []), polydata([(0, 0, 0)] * 3, [(0, 1, 2)])):
        for shading in SHADINGS:
            w = window(empty, shading=shading)
            errors = Errors(w.mapper)
            assert w.draw().max() == 0
            w.mapper.SetInputDataObject(square())  # and something later
            w.mapper.SetLightData(lights(SUN))
            assert np.allclose(w.at(0, 0), 1, rtol=1e-6)
            assert not errors.texts, errors.texts


def test_a_sphere_of_each_shading():
    """A mesh as filters give it: the middle of its disc against the light from the eye."""
    source = vtkSphereSource()
    source.SetRadius(0.8)
    source.SetThetaResolution(60)
    source.SetPhiResolution(60)
    source.Update()
    normals = through(vtkPolyDataNormals(), source.GetOutput())
    for shading in SHADINGS:
        w = window(normals, SUN, shading=shading)
        picture = w.draw()
        assert abs(w.at(0, 0, picture)[0] - 1) < 0.01, shading
        # Lambert: radiance = cos = sqrt(1 - rho^2) at the distance rho of the centre
        cosine = math.sqrt(1 - (0.5 / 0.8) ** 2)
        assert abs(w.at(0.5, 0, picture)[0] - cosine) < (0.06 if shading == "Flat" else 0.02), shading


run(globals())
