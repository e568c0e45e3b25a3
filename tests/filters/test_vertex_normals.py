# SPDX-License-Identifier: BSD-3-Clause
"""Vertex Normals: weights, creases, seams between blocks, what is carried along, errors."""
import math

import numpy as np
from checks import array, close, fails, points, run_all
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray, vtkMultiBlockDataSet, vtkPolyData, vtkUnstructuredGrid)
from vtkmodules.vtkFiltersCore import vtkStripper, vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource
from vtkradiometry import vtkIrradianceFilter, vtkPointLightSource, vtkVertexNormalsFilter


def surface(coordinates, cells, lines=()):
    data = vtkPolyData()
    where = vtkPoints()
    where.SetDataTypeToDouble()
    for p in coordinates:
        where.InsertNextPoint(p)
    data.SetPoints(where)
    for setter, kind in ((data.SetPolys, cells), (data.SetLines, lines)):
        made = vtkCellArray()
        for cell in kind:
            made.InsertNextCell(len(cell), cell)
        setter(made)
    return data


def named(data, attributes, name, values):
    found = numpy_to_vtk(np.asarray(values, float), deep=True)
    found.SetName(name)
    getattr(data, attributes)().AddArray(found)
    return data


def normals_of(data, **properties):
    f = vtkVertexNormalsFilter()
    f.SetInputDataObject(data)
    for name, value in properties.items():
        getattr(f, "Set" + name)(value)
    f.Update()
    return f.GetOutputDataObject(0)


CORNERS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
QUADS = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def test_cube_without_splitting():
    out = normals_of(surface(CORNERS, QUADS), Splitting=False)
    assert out.GetNumberOfPoints() == 8
    close(array(out.GetPointData(), "Normals"), (np.array(CORNERS) - 0.5) * 2 / math.sqrt(3),
          absolute=1e-15)
    assert out.GetPointData().GetNormals().GetName() == "Normals"


def test_cube_is_split_at_its_edges():
    data = surface(CORNERS, QUADS)
    named(data, "GetPointData", "Number", range(8))
    named(data, "GetCellData", "Side", range(6))
    out = normals_of(data, ComputeCellNormals=True)
    assert out.GetNumberOfPoints() == 24 and out.GetNumberOfCells() == 6
    close(array(out.GetCellData(), "Side"), range(6))
    number = array(out.GetPointData(), "Number")
    close(points(out), np.array(CORNERS, float)[number.astype(int)])
    expected = {0: (0, 0, -1), 1: (0, 0, 1), 2: (0, -1, 0), 3: (0, 1, 0), 4: (-1, 0, 0), 5: (1, 0, 0)}
    n = array(out.GetPointData(), "Normals")
    cell_normals = array(out.GetCellData(), "Normals")
    for c in range(6):
        close(cell_normals[c], expected[c], absolute=1e-16)
        ids = out.GetCell(c).GetPointIds()
        assert [int(number[ids.GetId(k)]) for k in range(4)] == list(QUADS[c])
        for k in range(4):
            close(n[ids.GetId(k)], expected[c], absolute=1e-16)
    # Only edges of at least the feature angle are creases.
    assert normals_of(data, FeatureAngle=89.9).GetNumberOfPoints() == 24
    assert normals_of(data, FeatureAngle=90.1).GetNumberOfPoints() == 8


def test_weights():
    # Of one edge: an area of 1 that looks along z, one of 3 that looks along x, cut in two.
    data = surface([(0, 0, 0), (0, 1, 0), (-2, 0, 0), (0, 0, -6), (0, 0, -3)],
                   [(0, 1, 2), (1, 4, 3), (1, 0, 4)])
    a = math.atan2(6, 1)  # the angle of both parts at point 1
    b = math.atan2(2, 1)
    for weighting, (x, z) in enumerate(((a, b), (3, 1), (2, 1))):
        n = array(normals_of(data, Weighting=weighting, Splitting=False).GetPointData(), "Normals")
        close(n[1], np.array([x, 0, z]) / math.hypot(x, z), relative=1e-14, absolute=1e-16)


def test_same_points_as_the_simulation():
    """Uniform weights are those by which Irradiance finds its points."""
    sphere = vtkSphereSource()
    sphere.SetThetaResolution(12)
    sphere.SetPhiResolution(7)
    sphere.Update()
    light = vtkPointLightSource()
    light.SetPosition(3, 0, 0)
    irradiance = vtkIrradianceFilter()
    irradiance.SetInputData(sphere.GetOutput())
    irradiance.AddLightsConnection(light.GetOutputPort())
    irradiance.SetSampleLocation(1)
    irradiance.SetFeatureAngle(35)
    irradiance.Update()
    out = normals_of(sphere.GetOutput(), Weighting=2, FeatureAngle=35)
    known = irradiance.GetOutputDataObject(0)
    assert out.GetNumberOfPoints() == known.GetNumberOfPoints()
    close(points(out), points(known))
    close(array(out.GetPointData(), "Normals"), array(known.GetPointData(), "Normals"),
          absolute=1e-6)


def halves():
    """A wavy strip in two blocks, and as one."""
    x = np.linspace(0, 3, 13)
    rows = [[(u, v, 0.2 * math.sin(2 * u)) for v in (0.0, 1.0)] for u in x]

    def part(i, j):
        flat = [p for row in rows[i:j + 1] for p in row]
        return surface(flat, [(2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1) for k in range(j - i)])

    blocks = vtkMultiBlockDataSet()
    blocks.SetBlock(0, part(0, 6))
    blocks.SetBlock(2, part(6, 12))
    return part(0, 12), blocks


def test_blocks_have_no_seam():
    whole, blocks = halves()
    expected = array(normals_of(whole).GetPointData(), "Normals")
    out = normals_of(blocks)
    assert out.IsA("vtkMultiBlockDataSet") and out.GetNumberOfBlocks() == 3
    close(array(out.GetBlock(0).GetPointData(), "Normals"), expected[:14], absolute=1e-15)
    close(array(out.GetBlock(2).GetPointData(), "Normals"), expected[12:], absolute=1e-15)
    apart = normals_of(blocks, MergePoints=False)
    difference = array(apart.GetBlock(0).GetPointData(), "Normals")[12:] - expected[12:14]
    assert np.abs(difference).max() > 0.01


def test_facets_of_their_own_points_become_smooth():
    """As STL files have them: each triangle has three points of its own."""
    sphere = vtkSphereSource()
    sphere.SetThetaResolution(24)
    sphere.SetPhiResolution(12)
    sphere.Update()
    joined = sphere.GetOutput()
    ids = [[joined.GetCell(c).GetPointId(k) for k in range(3)]
           for c in range(joined.GetNumberOfCells())]
    facets = surface([joined.GetPoint(i) for cell in ids for i in cell],
                     [(3 * c, 3 * c + 1, 3 * c + 2) for c in range(len(ids))])
    n = array(normals_of(joined).GetPointData(), "Normals")
    out = array(normals_of(facets).GetPointData(), "Normals")
    close(out, n[np.array(ids).ravel()], absolute=1e-14)


def test_strips_lines_and_lonely_points():
    data = surface([(0, 0, 0), (1, 0, 0), (0, 1, 0), (9, 9, 9), (2, 0, 0), (3, 0, 0)],
                   [(0, 1, 2), (0, 1, 4)], lines=[(3, 4)])
    named(data, "GetCellData", "Id", [10, 11, 12])
    out = normals_of(data)
    n = array(out.GetPointData(), "Normals")
    close(n, [(0, 0, 1)] * 3 + [(0, 0, 0)] * 3)  # one cell without area, one line, one alone
    assert out.GetNumberOfLines() == 1
    close(array(out.GetCellData(), "Id"), [10, 11, 12])
    close(array(normals_of(data, ComputeCellNormals=True).GetCellData(), "Normals"),
          [(0, 0, 0), (0, 0, 1), (0, 0, 0)])

    sphere = vtkSphereSource()
    sphere.SetThetaResolution(16)
    sphere.SetPhiResolution(9)
    stripper = vtkStripper()
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(sphere.GetOutputPort())
    stripper.SetInputConnection(triangles.GetOutputPort())
    stripper.Update()
    assert stripper.GetOutput().GetNumberOfStrips() > 0
    triangles.Update()
    close(array(normals_of(stripper.GetOutput()).GetPointData(), "Normals"),
          array(normals_of(triangles.GetOutput()).GetPointData(), "Normals"), absolute=1e-14)


def test_far_away_and_empty():
    cube = vtkCubeSource()
    cube.Update()
    near = array(normals_of(cube.GetOutput()).GetPointData(), "Normals")
    moved = surface([np.array(cube.GetOutput().GetPoint(i)) + (5e5, 4e6, 100)
                     for i in range(24)], [[cube.GetOutput().GetCell(c).GetPointId(k)
                                            for k in range(4)] for c in range(6)])
    close(array(normals_of(moved).GetPointData(), "Normals"), near, absolute=1e-9)
    assert normals_of(vtkPolyData()).GetNumberOfPoints() == 0
    assert normals_of(vtkMultiBlockDataSet()).GetNumberOfBlocks() == 0


def test_input_stays_as_it_was():
    data = named(surface(CORNERS, QUADS), "GetPointData", "Normals", [(1, 0, 0)] * 8)
    out = normals_of(data, Splitting=False)
    close(array(data.GetPointData(), "Normals"), [(1, 0, 0)] * 8)
    assert abs(array(out.GetPointData(), "Normals")[0][0] + 1 / math.sqrt(3)) < 1e-12


def test_errors():
    for bad, word in ((float("nan"), "nan"), (float("inf"), "inf")):
        f = vtkVertexNormalsFilter()
        f.SetInputData(surface([(0, 0, 0), (1, bad, 0), (0, 1, 0)], [(0, 1, 2)]))
        fails(f, "Points[1]", word)
    blocks = vtkMultiBlockDataSet()
    blocks.SetBlock(0, surface(CORNERS, QUADS))
    blocks.SetBlock(1, vtkUnstructuredGrid())
    f = vtkVertexNormalsFilter()
    f.SetInputData(blocks)
    f_messages = fails_composite(f)
    assert "vtkUnstructuredGrid" in f_messages


def fails_composite(f):
    messages = []

    def collect(caller, event, text=""):
        messages.append(text)

    collect.CallDataType = "string0"
    f.AddObserver("ErrorEvent", collect)
    f.Update()
    assert len(messages) == 1, messages
    assert f.GetOutputDataObject(0).GetNumberOfBlocks() == 0
    return messages[0]


if __name__ == "__main__":
    run_all(globals())
