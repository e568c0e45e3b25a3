# SPDX-License-Identifier: BSD-3-Clause
"""What is true on the scenes of direct/scenes.py, in numpy and from closed forms, so that no program
judges itself; and the same by plain summation over very many points, which checks the closed forms.

Point light: the shadow of a convex body is the hull of its projected corners; a cell's flux is
I (solid angle of the cell - solid angle of its part inside the hull).
Area light at a point: Lambert's contour formula of the panel, less that of the part of the panel
that is inside the cone over the body (clipped by the planes through the point and its silhouette).
Its average over a cell: Gauss-Legendre of 4 x 4 points in each of 4 x 4 parts.
"""
import numpy as np


def hull(points):
    """Convex hull of points of the plane, counter-clockwise (monotone chain)."""
    points = sorted(map(tuple, points))

    def half(sequence):
        chain = []
        for p in sequence:
            while len(chain) > 1 and ((chain[-1][0] - chain[-2][0]) * (p[1] - chain[-2][1])
                                      - (chain[-1][1] - chain[-2][1]) * (p[0] - chain[-2][0])) <= 0:
                chain.pop()
            chain.append(p)
        return chain[:-1]

    return np.array(half(points) + half(reversed(points)))


def clipped(polygon, count, normal, offset):
    """Convex polygons (n x k x d, of `count` corners each) less what lies beyond n.x > offset."""
    n, k, _ = polygon.shape
    index = np.arange(k)[None, :]
    exists = index < count[:, None]
    after = np.where(index + 1 < count[:, None], index + 1, 0)
    height = np.einsum("nkd,nd->nk", polygon, normal) - offset[:, None]
    following = np.take_along_axis(height, after, 1)
    corner = np.take_along_axis(polygon, after[:, :, None], 1)
    keep = exists & (height <= 0)
    cross = exists & ((height <= 0) != (following <= 0))
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(cross, height / (height - following), 0.0)
    met = polygon + share[:, :, None] * (corner - polygon)
    place = np.cumsum(keep.astype(int) + cross, 1)
    total = place[:, -1]
    result = np.zeros((n, max(int(total.max(initial=0)), 1), polygon.shape[2]))
    row = np.broadcast_to(np.arange(n)[:, None], (n, k))
    result[row[keep], (place - cross - 1)[keep]] = polygon[keep]
    result[row[cross], (place - 1)[cross]] = met[cross]
    return result, total


def solid_angle(polygon, count, apex):
    """Solid angle of plane convex polygons from a point (Van Oosterom and Strackee 1983)."""
    v = polygon - apex
    length = np.linalg.norm(v, axis=2)
    total = np.zeros(len(v))
    for i in range(1, polygon.shape[1] - 1):
        a, b, c = v[:, 0], v[:, i], v[:, i + 1]
        la, lb, lc = length[:, 0], length[:, i], length[:, i + 1]
        triple = np.abs((a * np.cross(b - a, c - a)).sum(1))
        below = la * lb * lc + (a * b).sum(1) * lc + (b * c).sum(1) * la + (c * a).sum(1) * lb
        total += np.where(i + 1 < count, 2 * np.arctan2(triple, below), 0.0)
    return total


def contour(polygon, count, point):
    """(1/2 pi) of Lambert's sum over the edges, for upward surfaces: the form factor of polygons."""
    v = polygon - point[:, None, :]
    total = np.zeros(len(v))
    for i in range(polygon.shape[1]):
        j = np.where(i + 1 < count, i + 1, 0)
        a, b = v[:, i], v[np.arange(len(v)), np.minimum(j, polygon.shape[1] - 1)]
        across = np.cross(a, b)
        length = np.linalg.norm(across, axis=1)
        angle = np.arctan2(length, (a * b).sum(1))
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where(length > 0, angle / length, 0.0) * across[:, 2]
        total += np.where(i < count, share, 0.0)
    return np.abs(total) / (2 * np.pi)


def point_cells(scene):
    low, w = scene.low(), scene.width()
    square = low[:, None, :] + w * np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    four = np.full(len(low), 4)

    def lifted(p):
        return np.concatenate([p, np.zeros(p.shape[:2] + (1,))], 2)

    flux = solid_angle(lifted(square), four, scene.point)
    s = scene.point[2] / (scene.point[2] - scene.blocker.points[:, 2:])
    shadow = hull((scene.point + s * (scene.blocker.points - scene.point))[:, :2])
    part, count = square, four
    for a, b in zip(shadow, np.roll(shadow, -1, 0)):
        normal = np.array([b[1] - a[1], a[0] - b[0]])
        part, count = clipped(part, count, np.broadcast_to(normal, (len(low), 2)),
                              np.full(len(low), normal @ a))
    inside = solid_angle(lifted(part), count, scene.point)
    # A cell all in shadow is dark: both terms are the same angle, by other ways.
    lit = np.where(np.abs(flux - inside) <= 1e-12 * flux, 0.0, flux - inside)
    return scene.intensity * lit / w**2


def point_points(scene, points):
    way = scene.point - points
    square = (way**2).sum(1)
    e = scene.intensity * way[:, 2] / square**1.5
    return np.where(hidden(scene.blocker, points, np.broadcast_to(scene.point, points.shape)), 0.0, e)


def hidden(blocker, origins, ends):
    """Do segments meet a convex body? The part of each inside all of its half-spaces."""
    if not len(blocker.points):
        return np.zeros(len(origins), bool)
    enter, leave = np.zeros(len(origins)), np.ones(len(origins))
    for normal, offset in zip(*blocker.planes()):
        along = (ends - origins) @ normal
        above = origins @ normal - offset
        with np.errstate(divide="ignore", invalid="ignore"):
            t = -above / along
        enter = np.where(along < 0, np.maximum(enter, t), enter)
        leave = np.where(along > 0, np.minimum(leave, t), leave)
        leave = np.where((along == 0) & (above > 0), -1.0, leave)
    return enter < leave


def panel_points(scene, points):
    n = len(points)
    panel = np.broadcast_to(scene.panel, (n, 4, 3))
    seen = contour(panel, np.full(n, 4), points)
    if len(scene.blocker.points):
        normals, offsets = scene.blocker.planes()
        facing = points @ normals.T > offsets
        middle = scene.blocker.points.mean(0)
        part, count = panel, np.full(n, 4)
        for (a, b), (f, g) in scene.blocker.edges():
            p, q = scene.blocker.points[a], scene.blocker.points[b]
            normal = np.cross(p - points, q - points)
            offset = (normal * points).sum(1)
            normal = np.where((normal @ middle > offset)[:, None], -normal, normal)
            offset = (normal * points).sum(1)
            outline = facing[:, f] != facing[:, g]
            part, count = clipped(part, count, np.where(outline[:, None], normal, 0.0),
                                  np.where(outline, offset, 1.0))
        seen = seen - contour(part, count, points)
    return scene.exitance * np.where(seen < 1e-13, 0.0, seen)


def gauss(order, parts):
    x, w = np.polynomial.legendre.leggauss(order)
    x = (np.arange(parts)[:, None] + 0.5 * (x + 1)).ravel() / parts
    w = np.tile(0.5 * w / parts, parts)
    u = np.stack(np.meshgrid(x, x, indexing="xy"), -1).reshape(-1, 2)
    return u, np.outer(w, w).ravel()


def panel_cells(scene, order=4, parts=4):
    u, w = gauss(order, parts)
    return sum(weight * panel_points(scene, scene.on_cells(u[i:i + 1])[:, 0])
               for i, weight in enumerate(w))


def truth(scene):
    """Averages of the cells and values at their centres, W/m^2."""
    if scene.point is not None:
        return point_cells(scene), point_points(scene, scene.centres())
    return panel_cells(scene), panel_points(scene, scene.centres())


def check(scene, cells, centres, count=40):
    """The greatest difference, as a share of the greatest value, between the closed forms and plain
    summation on some cells: 512 x 512 points of the cell, or of the panel (128 x 128 on a few cells
    for a body of many faces)."""
    fine = 512
    if len(scene.blocker.triangles) > 100:
        count, fine = 10, 128
    rng = np.random.default_rng(7)
    lit = np.flatnonzero(cells < 0.999 * cells.max())
    chosen = rng.choice(lit, min(count, len(lit)), replace=False)
    u = (np.arange(fine) + 0.5) / fine
    u = np.stack(np.meshgrid(u, u, indexing="xy"), -1).reshape(-1, 2)
    worst = 0.0
    for cell in chosen:
        if scene.point is not None:
            place = np.concatenate([scene.low()[cell] + scene.width() * u, np.zeros((len(u), 1))], 1)
            worst = max(worst, abs(point_points(scene, place).mean() - cells[cell]))
            continue
        a, b, _, d = scene.panel
        light = a + u[:, :1] * (b - a) + u[:, 1:] * (d - a)
        point = scene.centres()[cell]
        way = light - point
        square = (way**2).sum(1)
        area = np.linalg.norm(np.cross(b - a, d - a))
        kernel = scene.exitance / np.pi * area * (way[:, 2] / square)**2
        kernel = np.where(hidden(scene.blocker, np.broadcast_to(point, light.shape), light), 0, kernel)
        worst = max(worst, abs(kernel.mean() - centres[cell]))
    return worst / cells.max()
