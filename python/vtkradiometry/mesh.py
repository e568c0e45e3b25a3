# SPDX-License-Identifier: BSD-3-Clause
"""Preparing the surface: finer triangles for the computation, shared points for the picture."""
import math

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkTriangleFilter

from .subdivide import divide, row_keys

AUTOMATIC_TRIANGLES = 2500  # what --max-edge auto aims at
LARGEST = 3000000  # triangles that refining may make
MATERIAL = ("DiffuseReflectance", "SpecularReflectance", "Shininess", "EmittedExitance",
            "DiffuseTransmittance", "Transmittance", "TwoSided", "BackDiffuseReflectance")


def triangles(surface):
    """(T, 3) point ids of a surface that has triangles only."""
    connectivity = surface.GetPolys().GetConnectivityArray()
    return vtk_to_numpy(connectivity).reshape(-1, 3)


def points(surface):
    """(P, 3) coordinates in double."""
    return vtk_to_numpy(surface.GetPoints().GetData()).astype(np.float64)


def cross_products(surface):
    """Per triangle (p1 - p0) x (p2 - p0): twice the area, along the front's normal."""
    corner = points(surface)[triangles(surface)]
    return np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])


def areas(surface):
    """Area of each triangle, m2."""
    return 0.5 * np.linalg.norm(cross_products(surface), axis=1)


def cell_array(surface, name):
    """The cell array as (cells, components) in double, or None."""
    array = surface.GetCellData().GetArray(name)
    if array is None:
        return None
    return vtk_to_numpy(array).astype(np.float64).reshape(surface.GetNumberOfCells(), -1)


def triangulate(surface):
    """Triangles only; cell arrays go with them."""
    triangle = vtkTriangleFilter()
    triangle.SetInputData(surface)
    triangle.PassVertsOff()
    triangle.PassLinesOff()
    triangle.Update()
    return triangle.GetOutput()


def automatic_edge(surface, wanted=AUTOMATIC_TRIANGLES):
    """The edge length that splits this surface into about `wanted` triangles.

    Splitting at length h leaves edges between h/2 and h, so triangles of about 0.21 h^2.
    """
    total = float(areas(surface).sum())
    return math.sqrt(total / (0.21 * wanted))


def refine(surface, max_edge):
    """`surface` with no edge longer than `max_edge` (auto: from its size; 0: as it is).

    Neighbours are split alike, so there are no gaps; cell arrays are inherited, point arrays
    interpolated. Returns the surface and the edge length that was used (0 if none).
    """
    surface = triangulate(surface)
    if max_edge == "auto":
        max_edge = automatic_edge(surface)
    if not max_edge:
        return surface, 0.0
    expected = float(areas(surface).sum()) / (0.21 * max_edge * max_edge)
    if expected > LARGEST:
        raise ValueError(f"a longest edge of {max_edge:g} m would make about {expected:.2g} "
                         f"triangles; at most {LARGEST} are made")
    names, columns = _point_columns(surface)
    divided = divide(columns[triangles(surface)],
                     lambda a, b: np.linalg.norm(a[:, :3] - b[:, :3], axis=1) > max_edge,
                     largest=8 * LARGEST, rounds=40)
    if divided is None:
        raise ValueError(f"a longest edge of {max_edge:g} m would make too many triangles")
    corners, origin = divided
    flat = corners.reshape(-1, corners.shape[2])
    _, chosen, index = np.unique(row_keys(*flat.T), return_index=True, return_inverse=True)
    kept = flat[chosen]
    fine = make_polydata(kept[:, :3], index.reshape(-1, 3))
    first = 3
    for name, width in names:
        values = kept[:, first:first + width]
        first += width
        if name == "Normals":
            length = np.linalg.norm(values, axis=1, keepdims=True)
            values = values / np.maximum(length, np.finfo(float).tiny)
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        array.SetName(name)
        fine.GetPointData().AddArray(array)
    if any(name == "Normals" for name, _ in names):
        fine.GetPointData().SetActiveNormals("Normals")
    data = surface.GetCellData()
    for k in range(data.GetNumberOfArrays()):
        values = vtk_to_numpy(data.GetArray(k))[origin]
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        array.SetName(data.GetArray(k).GetName())
        fine.GetCellData().AddArray(array)
    fine.SetFieldData(surface.GetFieldData())
    return fine, max_edge


def _point_columns(surface):
    """Coordinates and all point arrays beside each other, in double."""
    names, columns = [], [points(surface)]
    data = surface.GetPointData()
    for k in range(data.GetNumberOfArrays()):
        values = vtk_to_numpy(data.GetArray(k)).astype(np.float64)
        values = values.reshape(surface.GetNumberOfPoints(), -1)
        names.append((data.GetArray(k).GetName(), values.shape[1]))
        columns.append(values)
    return names, np.hstack(columns)


def make_polydata(xyz, corner):
    """A vtkPolyData of triangles: points (P, 3), point numbers (T, 3)."""
    surface = vtkPolyData()
    location = vtkPoints()
    location.SetDataTypeToDouble()
    location.SetData(numpy_to_vtk(np.ascontiguousarray(xyz), deep=True))
    surface.SetPoints(location)
    cells = vtkCellArray()
    offsets = np.arange(0, corner.size + 1, 3, dtype=np.int64)
    cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True), numpy_to_vtkIdTypeArray(
        np.ascontiguousarray(corner.reshape(-1), dtype=np.int64), deep=True))
    surface.SetPolys(cells)
    return surface


def _unique_rows(rows):
    """A number for each row, the same for equal rows."""
    return np.unique(rows, axis=0, return_inverse=True)[1].reshape(-1)


def _material_ids(surface):
    columns = [cell_array(surface, name) for name in MATERIAL]
    columns = [column for column in columns if column is not None]
    if not columns:
        return np.zeros(surface.GetNumberOfCells(), dtype=np.int64)
    return _unique_rows(np.hstack(columns))


class SmoothSurface:
    """The surface with one point wherever neighbouring triangles belong to one smooth, uniform face.

    Triangles that meet at an edge share its points if they have the same material and their normals
    differ by less than `feature_angle` degrees. Values given per cell become values per point by
    averaging over the sharing cells, weighted with their areas: what is needed to draw a field
    without facets and without bleeding over creases.
    """

    def __init__(self, surface, feature_angle=40.0):
        self.cells = surface
        tri = triangles(surface)
        xyz = points(surface)
        cross = cross_products(surface)
        self.area = 0.5 * np.linalg.norm(cross, axis=1)
        unit = cross / np.maximum(2.0 * self.area, np.finfo(float).tiny)[:, None]
        material = _material_ids(surface)
        corner = self._join(_unique_rows(xyz)[tri], unit, material,
                            math.cos(math.radians(feature_angle)))
        chosen, self.corner = np.unique(corner, return_inverse=True)
        self.corner = self.corner.reshape(-1, 3)
        self.xyz = xyz[tri.reshape(-1)[chosen]]
        self.number = len(chosen)
        self.weight = np.maximum(np.bincount(
            self.corner.reshape(-1), np.repeat(self.area, 3), minlength=self.number),
            np.finfo(float).tiny)
        normal = self.to_points(unit)
        length = np.linalg.norm(normal, axis=1)
        self.normal = normal / np.maximum(length, np.finfo(float).tiny)[:, None]

    @staticmethod
    def _join(tri, unit, material, cosine):
        """Labels for the 3 T corners; corners with the same label become one point."""
        count = len(tri)
        start, end = tri.reshape(-1), np.roll(tri, -1, axis=1).reshape(-1)
        owner = np.repeat(np.arange(count), 3)
        key = np.sort(np.stack([start, end], axis=1), axis=1)
        order = np.lexsort((key[:, 1], key[:, 0]))
        key = key[order]
        same = np.flatnonzero((key[1:] == key[:-1]).all(axis=1))
        first, second = order[same], order[same + 1]  # half-edges on one edge
        a, b = owner[first], owner[second]
        smooth = (np.einsum("ij,ij->i", unit[a], unit[b]) > cosine) & (material[a] == material[b])
        first, second = first[smooth], second[smooth]
        # Half-edge 3 t + k starts at corner 3 t + k and ends at corner 3 t + (k + 1) mod 3.
        after = np.arange(3 * count).reshape(-1, 3)
        after = np.roll(after, -1, axis=1).reshape(-1)
        flipped = start[first] == end[second]
        pairs = np.concatenate([
            np.stack([first, np.where(flipped, after[second], second)], axis=1),
            np.stack([after[first], np.where(flipped, second, after[second])], axis=1),
        ])
        label = np.arange(3 * count)
        while True:  # the smallest number spreads around each point
            smaller = np.minimum(label[pairs[:, 0]], label[pairs[:, 1]])
            new = label.copy()
            np.minimum.at(new, pairs[:, 0], smaller)
            np.minimum.at(new, pairs[:, 1], smaller)
            if np.array_equal(new, label):
                return label
            label = new

    def to_points(self, values):
        """Values per cell (T, n) as values per point."""
        values = np.asarray(values, dtype=np.float64).reshape(len(self.corner), -1)
        weighted = np.repeat(values * self.area[:, None], 3, axis=0)
        index = self.corner.reshape(-1)
        summed = [np.bincount(index, weighted[:, c], minlength=self.number)
                  for c in range(values.shape[1])]
        return np.stack(summed, axis=1) / self.weight[:, None]

    def polydata(self, point_arrays, cell_arrays=None):
        """A vtkPolyData with these arrays {name: values} and point normals."""
        surface = make_polydata(self.xyz, self.corner)
        normals = numpy_to_vtk(self.normal.astype(np.float32), deep=True)
        normals.SetName("Normals")
        surface.GetPointData().SetNormals(normals)
        for data, arrays in ((surface.GetPointData(), point_arrays),
                             (surface.GetCellData(), cell_arrays or {})):
            for name, values in arrays.items():
                array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
                array.SetName(name)
                data.AddArray(array)
        return surface
