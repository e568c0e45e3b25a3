# SPDX-License-Identifier: BSD-3-Clause
"""Bodies and meshes of the scenes on which accuracy is measured, in plain numpy."""
from dataclasses import dataclass, field

import numpy as np


@dataclass
class Convex:
    """A closed convex polyhedron: outward faces of triangles."""
    points: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    triangles: np.ndarray = field(default_factory=lambda: np.zeros((0, 3), int))

    def planes(self):
        """Outward normals and offsets of the faces: n.x <= d inside."""
        corners = self.points[self.triangles]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        return normal, (normal * corners[:, 0]).sum(1)

    def edges(self):
        """Each edge once: its two points and its two triangles."""
        found = {}
        for number, (a, b, c) in enumerate(self.triangles):
            for edge in ((a, b), (b, c), (c, a)):
                found.setdefault(tuple(sorted(edge)), []).append(number)
        return list(found.items())


def box(centre, size, turn):
    """A box turned about the vertical."""
    corner = np.array([[x, y, z] for z in (-0.5, 0.5) for y in (-0.5, 0.5) for x in (-0.5, 0.5)])
    c, s = np.cos(turn), np.sin(turn)
    points = (corner * size) @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + centre
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return Convex(points, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]))


def joined(bodies):
    """Points and triangles of several bodies in one mesh."""
    points, triangles, count = [np.zeros((0, 3))], [np.zeros((0, 3), int)], 0
    for body in bodies:
        points.append(body.points)
        triangles.append(body.triangles + count)
        count += len(body.points)
    return np.concatenate(points), np.concatenate(triangles)


def plane(half, n):
    """Corners of the n x n squares of a floor on z = 0 from -half to half, front up."""
    x = np.linspace(-half, half, n + 1)
    low = np.stack(np.meshgrid(x[:-1], x[:-1], indexing="xy"), -1).reshape(-1, 1, 2)
    square = low + (x[1] - x[0]) * np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    return np.concatenate([square, np.zeros(square.shape[:2] + (1,))], 2)


def divided(triangle, edge):
    """Similar triangles with edges of at most `edge`."""
    a, b, c = triangle
    longest = max(np.linalg.norm(b - a), np.linalg.norm(c - b), np.linalg.norm(a - c))
    n = max(1, int(np.ceil(longest / edge)))

    def at(i, j):
        return a + (b - a) * (i / n) + (c - a) * (j / n)

    out = []
    for i in range(n):
        for j in range(n - i):
            out.append([at(i, j), at(i + 1, j), at(i, j + 1)])
            if i + j < n - 1:
                out.append([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])
    return np.array(out)


def bowl(radius, beta, rings, around):
    """Triangles of a spherical bowl whose rim, on z = 0, is seen from the sphere's centre under the
    half-angle beta; corners on the sphere, fronts toward its centre."""
    centre = np.array([0.0, 0.0, radius * np.cos(beta)])
    theta = beta * np.arange(1, rings + 1) / rings
    phi = 2.0 * np.pi * np.arange(around) / around
    points = centre + radius * np.stack(
        [np.sin(theta)[:, None] * np.cos(phi), np.sin(theta)[:, None] * np.sin(phi),
         np.broadcast_to(-np.cos(theta)[:, None], (rings, around))], -1)
    points[-1, :, 2] = 0.0
    bottom = centre - [0.0, 0.0, radius]
    following = np.roll(points, -1, 1)
    cells = [np.stack([np.broadcast_to(bottom, (around, 3)), points[0], following[0]], 1)]
    for r in range(rings - 1):
        cells += [np.stack([points[r], points[r + 1], following[r + 1]], 1),
                  np.stack([points[r], following[r + 1], following[r]], 1)]
    return np.concatenate(cells), points[-1]
