# SPDX-License-Identifier: BSD-3-Clause
"""What is true on the scenes of accuracy/scenes.py, so that no program judges itself: closed forms in
numpy where there are any, checked by plain summation, else a long run of a peer (accuracy/reference.py).

Point light over a floor: the shadow of a convex body is the hull of its projected corners; a cell's flux
is I (solid angle of the cell - solid angle of its part inside the hull).
Panel at a point: Lambert's contour formula of the panel, less that of the part of the panel that is
inside the cone over the body (clipped by the planes through the point and its silhouette). Its average
over a cell: Gauss-Legendre of 4 x 4 points in each of 4 x 4 parts.
Many lights: each in closed form at the place, visible unless its segment crosses a convex body.
Crater: accuracy/bowl.py.
"""
import os
from dataclasses import dataclass

import numpy as np

from accuracy import reference
from accuracy.lamp import POINT


@dataclass
class Truth:
    values: np.ndarray           # cells x bands, W/m^2
    spread: np.ndarray           # their own standard error
    source: str                  # in words
    check: float = None          # greatest difference to another way, relative to the greatest value


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
    """Averages over the squares of a floor under a point light and at most one convex body."""
    lamp = scene.lamps[0]
    square, four = scene.corners, np.full(len(scene), 4)
    flux = solid_angle(square, four, lamp.position)
    lit = flux
    if scene.blockers:
        points = scene.blockers[0].points
        s = lamp.position[2] / (lamp.position[2] - points[:, 2:])
        shadow = hull((lamp.position + s * (points - lamp.position))[:, :2])
        part, count = square[:, :, :2], four
        for a, b in zip(shadow, np.roll(shadow, -1, 0)):
            normal = np.array([b[1] - a[1], a[0] - b[0]])
            part, count = clipped(part, count, np.broadcast_to(normal, (len(scene), 2)),
                                  np.full(len(scene), normal @ a))
        part = np.concatenate([part, np.zeros(part.shape[:2] + (1,))], 2)
        inside = solid_angle(part, count, lamp.position)
        # A cell all in shadow is dark: both terms are the same angle, by other ways.
        lit = np.where(np.abs(flux - inside) <= 1e-12 * flux, 0.0, flux - inside)
    return (lamp.intensity[0] * lit / scene.area)[:, None]


def point_points(lamp, blockers, points):
    """Irradiance of upward places."""
    way = lamp.position - points
    square = (way**2).sum(1)
    e = lamp.intensity[0] * np.maximum(way[:, 2], 0.0) / square**1.5
    for body in blockers:
        e = np.where(hidden(body, points, np.broadcast_to(lamp.position, points.shape)), 0.0, e)
    return e


def hidden(blocker, origins, ends):
    """Do segments meet a convex body? The part of each inside all of its half-spaces."""
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
    """Irradiance of upward places under a panel and at most one convex body."""
    n, lamp = len(points), scene.lamps[0]
    panel = np.broadcast_to(lamp.corners, (n, 4, 3))
    seen = contour(panel, np.full(n, 4), points)
    for body in scene.blockers:
        normals, offsets = body.planes()
        facing = points @ normals.T > offsets
        middle = body.points.mean(0)
        part, count = panel, np.full(n, 4)
        for (a, b), (f, g) in body.edges():
            p, q = body.points[a], body.points[b]
            normal = np.cross(p - points, q - points)
            offset = (normal * points).sum(1)
            normal = np.where((normal @ middle > offset)[:, None], -normal, normal)
            offset = (normal * points).sum(1)
            outline = facing[:, f] != facing[:, g]
            part, count = clipped(part, count, np.where(outline[:, None], normal, 0.0),
                                  np.where(outline, offset, 1.0))
        seen = seen - contour(part, count, points)
    return lamp.intensity[0] * np.where(seen < 1e-13, 0.0, seen)


def on_cells(scene, u):
    """A point of each parallelogram, cells x 3."""
    a, b, d = scene.corners[:, 0], scene.corners[:, 1], scene.corners[:, 3]
    return a + u[0] * (b - a) + u[1] * (d - a)


def panel_cells(scene, order=4, parts=4):
    x, w = np.polynomial.legendre.leggauss(order)
    x = (np.arange(parts)[:, None] + 0.5 * (x + 1)).ravel() / parts
    w = np.tile(0.5 * w / parts, parts)
    total = 0.0
    for u, wu in zip(x, w):
        for v, wv in zip(x, w):
            total = total + wu * wv * panel_points(scene, on_cells(scene, (u, v)))
    return total[:, None]


def check_floor(scene, values, count=40, fine=512):
    """The greatest difference to plain summation on some cells, as a share of the greatest value: of
    point lights over 512 x 512 places of the cell, of panels over as many places of the panel, seen
    from the cell's middle."""
    some = np.flatnonzero(values[:, 0] < 0.999 * values.max())
    chosen = np.random.default_rng(7).choice(some, min(count, len(some)), replace=False)
    u = (np.arange(fine) + 0.5) / fine
    u = np.stack(np.meshgrid(u, u, indexing="xy"), -1).reshape(-1, 2)
    lamp, middles = scene.lamps[0], on_cells(scene, (0.5, 0.5))
    exact = values[:, 0] if lamp.kind == POINT else panel_points(scene, middles)
    worst = 0.0
    for cell in chosen:
        a, b, _, d = scene.corners[cell] if lamp.kind == POINT else lamp.corners
        place = a + u[:, :1] * (b - a) + u[:, 1:] * (d - a)
        if lamp.kind == POINT:
            sums = point_points(lamp, scene.blockers, place).mean()
        else:
            middle = np.broadcast_to(middles[cell], place.shape)
            way = place - middle
            kernel = (way[:, 2] / (way**2).sum(1))**2 * np.linalg.norm(np.cross(b - a, d - a)) / np.pi
            for body in scene.blockers:
                kernel = np.where(hidden(body, middle, place), 0.0, kernel)
            sums = lamp.intensity[0] * kernel.mean()
        worst = max(worst, abs(sums - exact[cell]))
    return float(worst / values.max())


def many(scene):
    """All lights at all sensors, sensor by sensor; a body is asked for the segments that pass its
    circle seen from above."""
    lamps = np.array([lamp.position for lamp in scene.lamps])
    power = np.array([lamp.intensity[0] for lamp in scene.lamps])
    bodies = scene.blockers
    planes = [body.planes() for body in bodies]
    normals, offsets = np.array([p[0] for p in planes]), np.array([p[1] for p in planes])
    middles = np.array([body.points.mean(0) for body in bodies])[:, :2]
    radii = np.array([np.linalg.norm(body.points[:, :2] - m, axis=1).max()
                      for body, m in zip(bodies, middles)])
    total = np.zeros(len(scene))
    for number, sensor in enumerate(scene.sensors):
        way = lamps - sensor
        length = np.maximum(np.linalg.norm(way[:, :2], axis=1), 1e-12)
        e = power * way[:, 2] / (length**2 + way[:, 2]**2)**1.5
        unit, to = way[:, :2] / length[:, None], middles - sensor[:2]
        along = np.clip(unit @ to.T, 0.0, length[:, None])
        square = along**2 - 2.0 * along * (unit @ to.T) + (to**2).sum(1)
        lamp, body = np.nonzero(square < radii**2 * (1.0 + 1e-9))
        slope = np.einsum("kfc,kc->kf", normals[body], way[lamp])
        above = normals[body] @ sensor - offsets[body]
        with np.errstate(divide="ignore", invalid="ignore"):
            t = -above / slope
        enter = np.where(slope < 0, t, 0.0).max(1, initial=0.0)
        leave = np.where(slope > 0, t, 1.0).min(1, initial=1.0)
        outside = ((slope == 0) & (above > 0)).any(1)
        e[lamp[(enter < leave) & ~outside]] = 0.0
        total[number] = e.sum()
    return total[:, None]


def truth(scene):
    """None where there is no reference yet. What takes long is kept in the build folder."""
    path = os.path.join(reference.ROOT, "build", "accuracy",
                        f"{scene.key}-{reference.fingerprint(scene)}.npz")
    if os.path.exists(path):
        with np.load(path, allow_pickle=False) as data:
            check = float(data["check"])
            return Truth(data["values"], data["spread"], str(data["source"]),
                         check if check >= 0.0 else None)
    found = computed(scene)
    if found is not None and not found.spread.any():
        os.makedirs(os.path.dirname(path), exist_ok=True)
        np.savez(path, values=found.values, spread=found.spread, source=found.source,
                 check=-1.0 if found.check is None else found.check)
    return found


def computed(scene):
    if scene.key == "crater":
        from accuracy.bowl import exact_bowl
        return exact_bowl(scene)
    if scene.indirect:
        found = reference.reference(scene)
        if found is None:
            return None
        mean, spread, samples, program = found
        return Truth(mean, spread, f"{program}, {samples:.1e} samples "
                     f"{'a cell' if 'paths' in program else 'in all'}".replace("e+0", "e").replace("e+", "e"))
    if scene.key == "many-lights":
        values = many(scene)
        return Truth(values, np.zeros_like(values), "every light in closed form")
    point = scene.lamps[0].kind == POINT
    values = point_cells(scene) if point else panel_cells(scene)
    words = ("closed form: solid angles" if point
             else "closed form at points (Lambert's contour formula), Gauss-Legendre over the cell")
    return Truth(values, np.zeros_like(values), words, check_floor(scene, values))
