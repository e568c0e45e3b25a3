# SPDX-License-Identifier: BSD-3-Clause
"""A mesh for one picture: the computed surface, divided as finely as the camera can see.

Light that comes straight from the lamps has sharp shadows; it is computed anew on this mesh, by the
same filter. Light from other surfaces varies slowly; it is interpolated from the computed cells.
"""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from . import mesh

PIXELS = 3.0  # length of the shortest edges that are still divided, in pixels
LARGEST = 350000  # triangles
INHERITED = ("Transmittance",)


def _row_keys(*columns):
    """A 64-bit number for each row of these columns: the same for rows with the same bits."""
    keys = np.full(len(columns[0]), 0x9E3779B97F4A7C15, dtype=np.uint64)
    multiplier = np.uint64(0xBF58476D1CE4E5B9)
    for column in columns:
        bits = np.ascontiguousarray(column + 0.0 if column.dtype.kind == "f" else column)
        keys ^= bits.astype(np.float64 if bits.dtype.kind == "f" else np.int64).view(np.uint64)
        keys *= multiplier
        keys ^= keys >> np.uint64(29)
    return keys


def divide(corners, wanted, largest, rounds=14):
    """Splits triangles at the middles of edges until no edge is to be divided.

    corners: (T, 3, k), the first three columns positions; everything is interpolated linearly.
    wanted(a, b): whether the edges from a to b are divided; it must be symmetric, so that
    neighbours agree and no gaps appear. Returns the corners and the index of each triangle's
    origin, or None where more than `largest` triangles would come of it.
    """
    origin = np.arange(len(corners))
    done_corners, done_origin, done = [], [], 0
    for _ in range(rounds):
        a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
        marks = np.stack([wanted(a, b), wanted(b, c), wanted(c, a)], axis=1)
        number = marks.sum(axis=1)
        still = number == 0
        done_corners.append(corners[still])
        done_origin.append(origin[still])
        done += int(still.sum())
        if still.all():
            break
        if done + 2 * int((~still).sum()) > largest:
            return None
        pieces, sources = [], []

        def add(chosen, *triangles):
            for triangle in triangles:
                pieces.append(np.stack(triangle, axis=1))
                sources.append(origin[chosen])

        for first in range(3):  # one marked edge, from `first` to the next corner
            chosen = np.flatnonzero((number == 1) & marks[:, first])
            p, q, r = (corners[chosen, (first + k) % 3] for k in range(3))
            middle = 0.5 * (p + q)
            add(chosen, (p, middle, r), (middle, q, r))
            # two marked edges, the unmarked one ends at `first`
            chosen = np.flatnonzero((number == 2) & ~marks[:, (first + 2) % 3])
            p, q, r = (corners[chosen, (first + k) % 3] for k in range(3))
            pq, qr = 0.5 * (p + q), 0.5 * (q + r)
            add(chosen, (pq, q, qr), (p, pq, qr), (p, qr, r))
        chosen = np.flatnonzero(number == 3)
        p, q, r = (corners[chosen, k] for k in range(3))
        pq, qr, rp = 0.5 * (p + q), 0.5 * (q + r), 0.5 * (r + p)
        add(chosen, (p, pq, rp), (pq, q, qr), (rp, qr, r), (pq, qr, rp))
        corners, origin = np.concatenate(pieces), np.concatenate(sources)
    else:
        done_corners.append(corners)
        done_origin.append(origin)
    return np.concatenate(done_corners), np.concatenate(done_origin)


def _edge_test(camera, size, pixels):
    """Which edges look longer than `pixels` in a picture of this size (width, height).

    Column 6 of the corners is 1 at corners of cells that are seen: an edge is divided only if it is
    1 at both ends, which holds on all edges of such cells and on few others.
    """
    right, above, forward = camera.axes()
    width, height = size
    half_height = camera.half_height(width / height)
    half_width = half_height * width / height
    pixel = 2.0 * half_height / height

    def look(point):
        offset = point[:, :3] - camera.position
        return offset @ right, offset @ above, offset @ forward

    def wanted(a, b):
        seen = np.minimum(a[:, 6], b[:, 6]) == 1.0
        length = np.linalg.norm(a[:, :3] - b[:, :3], axis=1)
        x, y, z = look(0.5 * (a + b))
        reach = 0.5 * length
        if camera.parallel_height:
            near, scale = np.full(len(length), np.inf), np.ones(len(length))
        else:
            near = z + reach
            # The depth of the nearer part of the edge, but not less than a quarter of its length.
            scale = np.maximum(z - 0.5 * reach, 0.25 * length)
        edge = np.maximum(near, 0.0) if not camera.parallel_height else 1.0
        inside = ((near > 0.0) & (np.abs(x) - reach * 1.5 < half_width * edge)
                  & (np.abs(y) - reach * 1.5 < half_height * edge))
        return seen & inside & (length > pixels * pixel * scale)

    return wanted


def _smooth_faces(smooth):
    """A number for each computed cell: the same for cells that share smooth points."""
    corner = smooth.corner
    label = np.arange(len(corner))
    while True:
        lowest = np.full(smooth.number, len(corner))
        np.minimum.at(lowest, corner.reshape(-1), np.repeat(label, 3))
        new = lowest[corner].min(axis=1)
        new = new[new]
        if np.array_equal(new, label):
            return label
        label = new


def sides(surface, camera, two_sided):
    """For each cell, whether it is drawn, and whether the picture shows its back."""
    cross = mesh.cross_products(surface)
    corner = mesh.points(surface)[mesh.triangles(surface)]
    toward = (-np.broadcast_to(camera.axes()[2], cross.shape) if camera.parallel_height
              else camera.position - corner.mean(axis=1))
    facing = np.einsum("ij,ij->i", cross, toward) > 0.0
    return facing | two_sided, two_sided & ~facing


def coarse_polydata(surface, drawn):
    """The drawn cells as they are, with the cell array TriangleNumber (from 1)."""
    return _numbered(mesh.points(surface), mesh.triangles(surface), drawn)


class ViewMesh:
    """The fine mesh, its origin in the computed cells, and which of it the camera may see.

    drawn, back: what `sides` says; seen: numbers of the computed cells that show in the picture.
    One-sided cells that turn away from the camera are not drawn.
    """

    def __init__(self, surface, smooth, camera, size, drawn, back, seen):
        self.smooth = smooth
        self.back = back
        corner = mesh.points(surface)[mesh.triangles(surface)]
        weights = np.broadcast_to(np.eye(3), corner.shape)
        place = np.unique(_row_keys(*corner.reshape(-1, 3).T), return_inverse=True)[1]
        place = place.reshape(-1, 3)
        at_place = np.zeros(place.max() + 1)
        at_place[place[seen]] = 1.0
        start = np.concatenate([corner, weights, at_place[place][:, :, None]], axis=2)
        pixels = PIXELS
        while True:
            divided = divide(start, _edge_test(camera, size, pixels),
                             max(LARGEST, 3 * len(corner)))
            if divided is not None:
                break
            pixels *= 1.3
        fine, origin = divided
        self.weights = fine[:, :, 3:6].copy()
        self.origin = origin
        self.drawn = drawn[origin]
        face = _smooth_faces(smooth)[origin] * 2 + self.back[origin]
        flat = fine[:, :, :3].reshape(-1, 3)
        keys = _row_keys(*flat.T)
        _, chosen, index = np.unique(keys, return_index=True, return_inverse=True)
        self.place = flat[chosen]
        self.index = index.reshape(-1, 3)
        flip = self.back[origin]
        self.index[flip] = self.index[flip][:, ::-1]
        self.weights[flip] = self.weights[flip][:, ::-1]
        # Points for interpolation: one for each place and smooth face.
        joint = _row_keys(self.index.reshape(-1), np.repeat(face, 3))
        _, chosen, corner = np.unique(joint, return_index=True, return_inverse=True)
        self.corner = corner.reshape(-1, 3)
        self.xyz = self.place[self.index.reshape(-1)[chosen]]
        edges = self.place[self.index]
        self.area = 0.5 * np.linalg.norm(
            np.cross(edges[:, 1] - edges[:, 0], edges[:, 2] - edges[:, 0]), axis=1)
        self._chosen = chosen
        normal = self.from_computed(smooth.normal)
        normal[np.repeat(flip, 3)[chosen]] *= -1.0
        length = np.linalg.norm(normal, axis=1, keepdims=True)
        self.normal = normal / np.maximum(length, np.finfo(float).tiny)

    def from_computed(self, at_points):
        """Values at the computed surface's smooth points as values at this mesh's points."""
        values = at_points[self.smooth.corner[self.origin]]
        values = np.einsum("tij,tjn->tin", self.weights, values)
        return values.reshape(-1, values.shape[2])[self._chosen]

    def from_cells(self, values):
        """Values per fine triangle (F, n) as values at this mesh's points, weighted with areas."""
        number = len(self.xyz)
        index = self.corner.reshape(-1)
        weight = np.bincount(index, np.repeat(self.area, 3), minlength=number)
        columns = [np.bincount(index, np.repeat(values[:, k] * self.area, 3), minlength=number)
                   for k in range(values.shape[1])]
        return np.stack(columns, axis=1) / np.maximum(weight, np.finfo(float).tiny)[:, None]

    def receiver(self, surface):
        """The whole fine mesh as a surface to compute on: fronts are the sides that are seen."""
        fine = _polydata(self.place, self.index)
        for name in INHERITED:
            values = mesh.cell_array(surface, name)
            if values is not None:
                array = numpy_to_vtk(np.ascontiguousarray(values[self.origin]), deep=True)
                array.SetName(name)
                fine.GetCellData().AddArray(array)
        return fine

    def polydata(self, point_arrays):
        """What is drawn, with these point arrays {name: values}, normals, and the cell array
        TriangleNumber (from 1)."""
        fine = _numbered(self.xyz, self.corner, self.drawn)
        normals = numpy_to_vtk(self.normal.astype(np.float32), deep=True)
        normals.SetName("Normals")
        fine.GetPointData().SetNormals(normals)
        for name, values in point_arrays.items():
            array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
            array.SetName(name)
            fine.GetPointData().AddArray(array)
        return fine


def _numbered(xyz, triangles, drawn):
    surface = _polydata(xyz, triangles[drawn])
    number = numpy_to_vtk((np.flatnonzero(drawn) + 1).astype(np.float32), deep=True)
    number.SetName("TriangleNumber")
    surface.GetCellData().AddArray(number)
    return surface


def _polydata(xyz, triangles):
    surface = vtkPolyData()
    location = vtkPoints()
    location.SetDataTypeToDouble()
    location.SetData(numpy_to_vtk(np.ascontiguousarray(xyz), deep=True))
    surface.SetPoints(location)
    cells = vtkCellArray()
    cells.SetData(
        numpy_to_vtkIdTypeArray(np.arange(0, triangles.size + 1, 3, dtype=np.int64), deep=True),
        numpy_to_vtkIdTypeArray(np.ascontiguousarray(triangles.reshape(-1), dtype=np.int64),
                                deep=True))
    surface.SetPolys(cells)
    return surface
