# SPDX-License-Identifier: BSD-3-Clause
"""A mesh for one picture: the computed surface, divided as finely as the camera can see.

Light that comes straight from the lamps has sharp shadows; it is computed anew on this mesh, by the
same filter. Light from other surfaces varies slowly; it is interpolated from the computed cells.
"""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk

from . import mesh
from .subdivide import divide, row_keys

PIXELS = 8.0  # length of the shortest edges that are still divided, in pixels
SHARP_PIXELS = 1.5  # the same where the light changes abruptly
CONTRAST = 0.12  # what counts as abrupt: change within a triangle, relative to the value
LARGEST = 250000  # triangles
INHERITED = ("Transmittance",)


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
        place = np.unique(row_keys(*corner.reshape(-1, 3).T), return_inverse=True)[1]
        place = place.reshape(-1, 3)
        at_place = np.zeros(place.max() + 1)
        at_place[place[seen]] = 1.0
        start = np.concatenate([corner, weights, at_place[place][:, :, None]], axis=2)
        self._view = camera, size, drawn
        self._divide(start, np.arange(len(start)), PIXELS)

    def sharpen(self, values):
        """Divides on where `values` (at this mesh's points, any unit) change abruptly."""
        value = values.mean(axis=1)[self.corner]
        high, low = value.max(axis=1), value.min(axis=1)
        typical = float(np.median(high[self.drawn])) if self.drawn.any() else 0.0
        abrupt = self.drawn & (high - low > CONTRAST * (high + 0.1 * typical))
        at_place = np.zeros(len(self.place))
        at_place[self._places[abrupt]] = 1.0
        start = self._fine.copy()
        start[:, :, 6] = at_place[self._places]
        self._divide(start, self.origin, SHARP_PIXELS)

    def _divide(self, start, origin, pixels):
        camera, size, drawn = self._view
        while True:
            divided = divide(start, _edge_test(camera, size, pixels),
                             max(LARGEST, 3 * len(self.back), len(start)))
            if divided is not None:
                break
            pixels *= 1.3
        self._build(divided[0], origin[divided[1]], drawn)

    def _build(self, fine, origin, drawn):
        smooth = self.smooth
        self._fine = fine
        self.weights = fine[:, :, 3:6].copy()
        self.origin = origin
        self.drawn = drawn[origin]
        face = _smooth_faces(smooth)[origin] * 2 + self.back[origin]
        flat = fine[:, :, :3].reshape(-1, 3)
        keys = row_keys(*flat.T)
        _, chosen, index = np.unique(keys, return_index=True, return_inverse=True)
        self.place = flat[chosen]
        self._places = index.reshape(-1, 3)
        self.index = self._places.copy()
        flip = self.back[origin]
        self.index[flip] = self.index[flip][:, ::-1]
        self.weights[flip] = self.weights[flip][:, ::-1]
        # Points for interpolation: one for each place and smooth face.
        joint = row_keys(self.index.reshape(-1), np.repeat(face, 3))
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
        fine = mesh.make_polydata(self.place, self.index)
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
    surface = mesh.make_polydata(xyz, triangles[drawn])
    number = numpy_to_vtk((np.flatnonzero(drawn) + 1).astype(np.float32), deep=True)
    number.SetName("TriangleNumber")
    surface.GetCellData().AddArray(number)
    return surface
