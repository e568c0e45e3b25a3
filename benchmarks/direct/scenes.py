# SPDX-License-Identifier: BSD-3-Clause
"""The scenes on which direct light is compared: a floor of square cells on z = 0, a light, and a convex
blocker or none. Everything is plain numpy, so that each program is given the same numbers."""
from dataclasses import dataclass, field

import numpy as np

HALF = 3.0  # m, half of the floor's side


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
        return [(edge, sides) for edge, sides in found.items()]


def box(centre, size, turn):
    """A box turned about the vertical."""
    corner = np.array([[x, y, z] for z in (-0.5, 0.5) for y in (-0.5, 0.5) for x in (-0.5, 0.5)])
    c, s = np.cos(turn), np.sin(turn)
    points = (corner * size) @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + centre
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return Convex(points, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]))


def ball(centre, radius, bands):
    """A ball of triangles, all of them on its hull."""
    around = 2 * bands
    theta = np.pi * np.arange(1, bands) / bands
    phi = 2 * np.pi * np.arange(around) / around
    ring = np.stack(np.broadcast_arrays(np.sin(theta)[:, None] * np.cos(phi),
                                        np.sin(theta)[:, None] * np.sin(phi),
                                        np.cos(theta)[:, None]), -1).reshape(-1, 3)
    points = np.concatenate([ring, [[0, 0, 1], [0, 0, -1]]]) * radius + centre
    top, bottom = len(ring), len(ring) + 1
    triangles = []
    for i in range(around):
        j = (i + 1) % around
        triangles += [(top, i, j), (bottom, len(ring) - around + j, len(ring) - around + i)]
        for row in range(bands - 2):
            a, b = row * around + i, row * around + j
            triangles += [(a, a + around, b), (b, a + around, b + around)]
    return Convex(points, np.array(triangles))


@dataclass
class Scene:
    name: str
    blocker: Convex
    cells: int                     # a side
    point: np.ndarray = None       # m, an isotropic point light
    intensity: float = 100.0       # W/sr, of the point light
    panel: np.ndarray = None       # m, corners of a rectangle that lights downward
    exitance: float = 100.0        # W/m^2, of the panel

    def edges(self):
        return np.linspace(-HALF, HALF, self.cells + 1)

    def low(self):
        """The least corner of each cell, cells x 2."""
        x = self.edges()[:-1]
        return np.stack(np.meshgrid(x, x, indexing="xy"), -1).reshape(-1, 2)

    def width(self):
        return 2.0 * HALF / self.cells

    def on_cells(self, u):
        """Points of the unit square, put into each cell: cells x points x 3."""
        place = self.low()[:, None, :] + self.width() * u
        return np.concatenate([place, np.zeros(place.shape[:2] + (1,))], -1)

    def centres(self):
        return self.on_cells(np.full((1, 2), 0.5))[:, 0]


def scenes(cells):
    lamp = np.array([0.31, 0.17, 3.0])
    panel = np.array([[-0.4, -0.6, 3.0], [-0.4, 0.6, 3.0], [0.6, 0.6, 3.0], [0.6, -0.6, 3.0]])
    turned = box(np.array([-0.1, 0.2, 1.3]), np.array([1.3, 0.7, 0.5]), 0.4)
    return [
        Scene("point light, box", turned, cells, point=lamp),
        Scene("point light, ball", ball(np.array([0.0, 0.1, 1.2]), 0.6, 24), cells, point=lamp),
        Scene("area light, nothing in the way", Convex(), cells, panel=panel),
        Scene("area light, box", turned, cells, panel=panel),
    ]
