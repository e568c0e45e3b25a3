# SPDX-License-Identifier: BSD-3-Clause
"""Meshes on which view factors are compared, with the exact value of each pair of cells.

Cells are parallel or perpendicular rectangles, for which the factor is closed (Howell, C-11 and C-16, in
the form of Ehlert and Smith, 1993: sums over the corners); behind a plate the factor is the closed one
of point to rectangle, less the plate's shadow, integrated over the cell.
"""
from dataclasses import dataclass

import numpy as np


@dataclass
class Meshed:
    name: str
    points: np.ndarray        # m
    quads: np.ndarray         # cells x 4
    exact: np.ndarray = None  # F of each cell to each
    blocker: np.ndarray = None  # cells that hide others, as numbers; None: nothing hides anything
    truth: float = 1e-10      # relative error of `exact`


def grid(origin, a, b, n):
    """n x n quads with their front along a x b."""
    t = np.linspace(0.0, 1.0, n + 1)
    v, u = np.meshgrid(t, t, indexing="ij")
    points = origin + u[..., None] * a + v[..., None] * b
    first = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    return points.reshape(-1, 3), first[:, None] + np.array([0, 1, n + 2, n + 1])


def joined(parts):
    points, quads, count = [], [], 0
    for p, q in parts:
        points.append(p)
        quads.append(q + count)
        count += len(p)
    return np.concatenate(points), np.concatenate(quads)


def corner_sum(function, x, xi, y, eta):
    """Sum over the 16 corners with sign (-1)^(i+j+k+l)."""
    total = 0.0
    for i in range(2):
        for j in range(2):
            for k in range(2):
                for l in range(2):
                    total = total + (-1.0)**(i + j + k + l) * function(x[i], xi[j], y[k], eta[l])
    return total


def parallel(x, xi, y, eta, z):
    """A F between rectangles x by y on z = 0 and xi by eta on a plane at z."""
    def g(x, xi, y, eta):
        u, v = x - xi, y - eta
        p, q = np.sqrt(u * u + z * z), np.sqrt(v * v + z * z)
        return (v * p * np.arctan(v / p) + u * q * np.arctan(u / q)
                - 0.5 * z * z * np.log(u * u + v * v + z * z)) / (2.0 * np.pi)
    return corner_sum(g, x, xi, y, eta)


def perpendicular(x, xi, y, eta):
    """A F between a rectangle x by y on z = 0 and one of xi (height) by eta (along y) on x = 0."""
    def g(x, xi, y, eta):
        k2 = x * x + xi * xi
        k = np.sqrt(k2)
        d = y - eta
        s = k2 + d * d
        with np.errstate(divide="ignore", invalid="ignore"):
            angle = np.where(k > 0.0, d * k * np.arctan2(d, k), 0.0)
            log = np.where(s > 0.0, (k2 - d * d) * np.log(np.where(s > 0.0, s, 1.0)), 0.0)
        return (angle - 0.25 * log) / (2.0 * np.pi)
    return corner_sum(g, x, xi, y, eta)


def limits(points, quads):
    corners = points[quads]
    return corners.min(1), corners.max(1)


def exact_of_box(points, quads):
    """F of the cells of a closed axis-parallel box seen from inside."""
    low, high = limits(points, quads)
    flat = np.argmin(high - low, axis=1)
    area = np.sort(high - low, axis=1)[:, 1:].prod(1)
    f = np.zeros((len(quads), len(quads)))
    for a in range(3):
        for b in range(3):
            rows, columns = np.flatnonzero(flat == a), np.flatnonzero(flat == b)
            i, j = (v.ravel() for v in np.meshgrid(rows, columns, indexing="ij"))
            if a == b:
                s, t = [c for c in range(3) if c != a]
                z = np.abs(low[i, a] - low[j, a])
                faces = z > 1e-12
                i, j, z = i[faces], j[faces], z[faces]
                value = parallel((low[i, s], high[i, s]), (low[j, s], high[j, s]),
                                 (low[i, t], high[i, t]), (low[j, t], high[j, t]), z)
            else:
                t = 3 - a - b
                x = np.sort(np.abs([low[i, b] - low[j, b], high[i, b] - low[j, b]]), axis=0)
                xi = np.sort(np.abs([low[j, a] - low[i, a], high[j, a] - low[i, a]]), axis=0)
                value = perpendicular(x, xi, (low[i, t], high[i, t]), (low[j, t], high[j, t]))
            f[i, j] = value / area[i]
    return f


def box(n):
    e = np.eye(3)
    parts = []
    for k in range(3):
        a, b = e[(k + 1) % 3], e[(k + 2) % 3]
        parts += [grid(np.zeros(3), a, b, n), grid(e[k], b, a, n)]
    points, quads = joined(parts)
    return Meshed(f"closed cube, {6 * n * n} squares", points, quads, exact_of_box(points, quads))


def point_to_rectangle(p, x0, x1, y0, y1, z):
    """Factor of the up-facing points p (x, y) to rectangles at height z."""
    def g(u, v):
        a, b = np.sqrt(u * u + z * z), np.sqrt(v * v + z * z)
        return (u / a * np.arctan(v / a) + v / b * np.arctan(u / b)) / (2.0 * np.pi)
    x, y = p
    return (g(x1 - x, y1 - y) - g(x0 - x, y1 - y) - g(x1 - x, y0 - y) + g(x0 - x, y0 - y))


def plates(n, places=32):
    """Two unit squares one apart and a square of 0.4 half way between, two-sided by two sheets."""
    e = np.eye(3)
    low, size = 0.23, 0.4
    below = grid(np.zeros(3), e[0], e[1], n)
    above = grid(e[2], e[1], e[0], n)
    corner = np.array([low, low + 0.07, 0.5])
    sheet = grid(corner, size * e[0], size * e[1], 1)
    back = grid(corner, size * e[1], size * e[0], 1)
    points, quads = joined([below, above, sheet, back])
    lo, hi = limits(points, quads)
    rows, columns = np.arange(n * n), np.arange(n * n, 2 * n * n)
    f = np.zeros((n * n, n * n))
    t = (np.arange(places) + 0.5) / places
    for u in t:
        for v in t:
            x = lo[rows, 0] + u * (hi[rows, 0] - lo[rows, 0])
            y = lo[rows, 1] + v * (hi[rows, 1] - lo[rows, 1])
            p = (x[:, None], y[:, None])
            target = [lo[columns, 0], hi[columns, 0], lo[columns, 1], hi[columns, 1]]
            shadow = [2 * corner[0] - x, 2 * (corner[0] + size) - x,
                      2 * corner[1] - y, 2 * (corner[1] + size) - y]
            x0 = np.maximum(target[0], shadow[0][:, None])
            x1 = np.maximum(x0, np.minimum(target[1], shadow[1][:, None]))
            y0 = np.maximum(target[2], shadow[2][:, None])
            y1 = np.maximum(y0, np.minimum(target[3], shadow[3][:, None]))
            f += (point_to_rectangle(p, *target, 1.0) - point_to_rectangle(p, x0, x1, y0, y1, 1.0))
    exact = np.full((len(quads), len(quads)), np.nan)  # pairs with the sheet are not compared
    exact[:n * n, n * n:2 * n * n] = f / places**2
    exact[n * n:2 * n * n, :n * n] = (f / places**2).T
    return Meshed(f"squares behind a plate, {2 * n * n} squares", points, quads, exact,
                  np.arange(2 * n * n, len(quads)), 4e-4)


def tube(radius, height, around, up, inward=False):
    """A cylinder's side in quads about z; fronts outward."""
    phi = 2 * np.pi * np.arange(around) / around
    z = np.linspace(-0.5 * height, 0.5 * height, up + 1)
    points = np.array([[radius * np.cos(p), radius * np.sin(p), h] for h in z for p in phi])
    quads = []
    for j in range(up):
        for i in range(around):
            a, b = j * around + i, j * around + (i + 1) % around
            quads.append([a, b, b + around, a + around])
    quads = np.array(quads)
    return points, quads[:, ::-1] if inward else quads


def globe(radius, bands):
    """A sphere seen from inside; quads, at the poles with two equal corners moved apart as triangles."""
    around = 2 * bands
    theta = np.pi * np.arange(bands + 1) / bands
    phi = 2 * np.pi * np.arange(around) / around
    points = np.array([[radius * np.sin(t) * np.cos(p), radius * np.sin(t) * np.sin(p),
                        radius * np.cos(t)] for t in theta for p in phi])
    quads = []
    for j in range(bands):
        for i in range(around):
            a, b = j * around + i, j * around + (i + 1) % around
            quads.append([a, b, b + around, a + around])
    return points, np.array(quads)


EXACT_TUBE = 0.089131566992252  # cylinder 0.125 to sphere 3 behind cylinder 0.25, heights 1
