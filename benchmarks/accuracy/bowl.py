# SPDX-License-Identifier: BSD-3-Clause
"""What the facets of a spherical bowl in sunlight really get (scene crater), without any of the programs.

A bowl of flat facets is convex seen from inside: all of its facets see each other. The sun's part of a
facet is F0 cos(incidence) times the share of it that is inside the rim's shadow line: the facet clipped by
the rim projected along the sun. The rest is B = rho (E_sun + F B), solved on the facets cut along that
line, with factors from points of one piece to the other piece's contour (closed form). It is checked by
the closed form of the smooth bowl (Ingersoll 1966), to which the facets converge.
"""
import numpy as np

POINTS = np.array([[4, 1, 1], [1, 4, 1], [1, 1, 4]]) / 6.0  # of a triangle, exact to degree 2


def lit_and_dark(corners, normals, rim, toward):
    """The facets cut along the shadow of the rim: polygons, the facet of each, and whether it is lit.
    `toward`: where the sun's light travels to."""
    from accuracy.truth import clipped
    pieces, owner, lit = [], [], []
    n = len(corners)
    part, count = corners, np.full(n, 3)
    facing = normals @ toward < 0.0
    outside = []
    for p, q in zip(rim, np.roll(rim, -1, 0)):
        normal = np.cross(q - p, toward)
        if normal @ (rim.mean(0) - p) > 0.0:
            normal = -normal
        normal = normal / np.linalg.norm(normal)
        away, number = clipped(part, count, np.broadcast_to(-normal, (n, 3)), np.full(n, -normal @ p))
        outside.append((away, number))
        part, count = clipped(part, count, np.broadcast_to(normal, (n, 3)), np.full(n, normal @ p))
    for polygons, numbers, shines in [(part, count, True), *((a, k, False) for a, k in outside)]:
        for facet in np.flatnonzero(numbers >= 3):
            polygon = polygons[facet, :numbers[facet]]
            pieces.append(polygon)
            owner.append(facet)
            lit.append(shines and facing[facet])
    return pieces, np.array(owner), np.array(lit)


def fan(polygon):
    return [(polygon[0], polygon[i], polygon[i + 1]) for i in range(1, len(polygon) - 1)]


def area_of(polygon):
    return 0.5 * np.linalg.norm(sum(np.cross(b - a, c - a) for a, b, c in fan(polygon)))


def places(polygon, near):
    """Points and weights on a polygon, weights sum to 1; four times as many when near."""
    points, weights = [], []
    triangles = fan(polygon)
    for _ in range(2 if near else 0):
        triangles = [t for a, b, c in triangles
                     for t in ((a, (a + b) / 2, (a + c) / 2), ((a + b) / 2, b, (b + c) / 2),
                               ((a + c) / 2, (b + c) / 2, c), ((a + b) / 2, (b + c) / 2, (a + c) / 2))]
    for a, b, c in triangles:
        size = np.linalg.norm(np.cross(b - a, c - a))
        points += list(POINTS @ np.array([a, b, c]))
        weights += [size] * 3
    weights = np.array(weights)
    return np.array(points), weights / weights.sum()


def factor_rows(points, normals, polygons):
    """Lambert's contour formula from each point to each polygon (padded by repeats of a corner)."""
    total = np.zeros((len(points), len(polygons)))
    v = polygons[None] - points[:, None, None, :]
    for i in range(polygons.shape[1]):
        a, b = v[:, :, i], v[:, :, (i + 1) % polygons.shape[1]]
        across = np.cross(a, b)
        length = np.linalg.norm(across, axis=2)
        angle = np.arctan2(length, (a * b).sum(2))
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where(length > 1e-14, angle / length, 0.0)
        total += share * (across * normals[:, None, :]).sum(2)
    return np.abs(total) / (2.0 * np.pi)


def exchange(pieces, owner, normals):
    """F from each piece to each: points of the first, contour of the second."""
    most = max(map(len, pieces))
    padded = np.array([np.concatenate([p, np.repeat(p[-1:], most - len(p), 0)]) for p in pieces])
    middles = np.array([p.mean(0) for p in pieces])
    reach = np.array([np.linalg.norm(p - m, axis=1).max() for p, m in zip(pieces, middles)])
    f = np.zeros((len(pieces), len(pieces)))
    for i, polygon in enumerate(pieces):
        near = np.linalg.norm(middles - middles[i], axis=1) < 2.0 * (reach + reach[i])
        for which, fine in ((np.flatnonzero(~near), False), (np.flatnonzero(near), True)):
            points, weights = places(polygon, fine)
            rows = factor_rows(points, np.broadcast_to(normals[owner[i]], points.shape), padded[which])
            f[i, which] = weights @ rows
        f[i, owner == owner[i]] = 0.0  # in one plane
    return f


def solved(scene, rim):
    """Irradiance of the facets."""
    lamp = scene.lamps[0]
    pieces, owner, lit = lit_and_dark(scene.corners, scene.normals, rim, lamp.direction)
    area = np.array([area_of(p) for p in pieces])
    keep = area > 1e-12 * scene.area[owner]
    pieces, owner, lit, area = [p for p, k in zip(pieces, keep) if k], owner[keep], lit[keep], area[keep]
    sun = np.where(lit, lamp.intensity[0] * np.maximum(0.0, -scene.normals[owner] @ lamp.direction), 0.0)
    f = exchange(pieces, owner, scene.normals)
    rho = scene.reflectance[owner, 0]
    b = np.linalg.solve(np.eye(len(f)) - rho[:, None] * f, rho * sun)
    e = sun + f @ b
    sums = np.bincount(owner, area * e, len(scene))
    return sums / np.bincount(owner, area, len(scene)), pieces, owner, lit


def smooth(crater):
    """Irradiance in the shadow of a smooth bowl (Ingersoll 1966)."""
    f = 0.5 * (1.0 - np.cos(crater["beta"]))
    rho, sun = crater["reflectance"], crater["solar"] * np.sin(crater["sun"])
    return rho * f * (1.0 - f) * sun / (1.0 - rho * f)


def exact_bowl(scene):
    from accuracy.scenes import CRATER
    from accuracy.shapes import bowl
    from accuracy.truth import Truth
    _, rim = bowl(CRATER["radius"], CRATER["beta"], CRATER["rings"], CRATER["around"])
    values, _, owner, lit = solved(scene, rim)
    shadow = np.ones(len(scene), bool)
    shadow[owner[lit]] = False
    mean = (values[shadow] * scene.area[shadow]).sum() / scene.area[shadow].sum()
    off = mean / smooth(CRATER) - 1.0
    return Truth(values[:, None], np.zeros((len(scene), 1)),
                 "radiosity of the facets cut along the rim's shadow, contour formula; its shadow gets "
                 f"{100 * off:+.2f} % of the smooth bowl's closed form (Ingersoll 1966)")
