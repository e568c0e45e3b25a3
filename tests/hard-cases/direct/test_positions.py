# SPDX-License-Identifier: BSD-3-Clause
"""Where the light stands to the cell: in its plane, on its rim, almost on it, far, grazing; cells
that are huge, thin or both. Every value against a closed form."""
from math import cos, pi, radians, sin, sqrt

import numpy as np
from hardcases import (EPS, POINTS, Run, areas_of, cell, close, corner_above, grid, joined, mesh, point,
                       polydata, rotation, run_all, sensors, solid_angle, spot, square_above, sun)

SQUARE = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
# Spots as wide as this send everywhere that matters here, by another formula than a point light.
HALF_SPACE = dict(cutoff=90.0, exponent=0.0)


def square():
    return polydata(SQUARE, [(0, 1, 2, 3)])


def both_kinds(position, direction=(0, 0, -1), intensity=1.0):
    """A point light, and a spot whose cone holds the whole cell: the same answer by another road."""
    return (point(position, intensity), spot(position, direction, intensity=intensity, **HALF_SPACE),
            spot(position, direction, cutoff=180.0, intensity=intensity))


def test_light_in_the_plane_of_the_cell_gives_nothing():
    places = [(3, 0, 0), (1, 0.3, 0), (0.2, 0.3, 0), (1, 1, 0), (-5, 7, 0), (1e9, 0, 0), (0, 0, 0)]
    for place in places:
        for light in both_kinds(place) + (spot(place, (-1, 0, 0), 30), sun((1, 2, 0), 5)):
            assert cell(square(), light) == 0.0, (place, light.kind)


def test_light_in_the_plane_of_a_turned_cell_gives_rounding_at_most():
    for seed in range(1, 9):
        turn = rotation(seed)
        data = polydata(np.array(SQUARE) @ turn.T, [(0, 1, 2, 3)])
        for place in ((3, 0, 0), (-5, 7, 0), (1.5, -1.5, 0)):
            for light in both_kinds(place):
                # Off the plane by rounding: h/(r^2 pi)-like, far below any light that counts.
                assert cell(data, light.moved(turn)) <= 1e-15, (seed, place)
        assert cell(data, sun((1, 2, 0), 5).moved(turn)) <= 1e-14


def test_points_and_sensors_in_the_plane_of_the_light_get_nothing():
    grid_of_sensors = sensors([(0, 0, 0), (1, 2, 0), (0.5, 0.5, 0)], (0, 0, 1))
    for light in both_kinds((3, 0.5, 0)) + (sun((0, 1, 0)),):
        close(Run(grid_of_sensors, light).e, np.zeros((3, 1)))
        close(Run(square(), light, SampleLocation=POINTS).e, np.zeros((4, 1)))


def test_sensor_at_the_light_is_no_nan():
    for light in both_kinds((0.5, 0.5, 0)):
        run = Run(sensors([(0.5, 0.5, 0)], (0, 0, 1)), light)  # Run refuses what is not finite
        assert run.e.shape == (1, 1)


def test_light_on_a_vertex_of_a_room_lights_the_opposite_walls_alike():
    """From a corner of a cube an eighth of the sphere is seen, shared evenly by three faces."""
    from hardcases import box
    for seed in (0, 3, 4):
        turn = rotation(seed)
        p, q = box(inward=True)
        data = polydata(p @ turn.T, q)
        for place in ((0, 0, 0), (1, 1, 0), (1, 0, 1)):
            for light in (point(place, 6.0), spot(place, 0.5 - np.array(place), 180, intensity=6.0)):
                e = Run(data, light.moved(turn)).e[:, 0]
                expected = [pi if (place[2 - f // 2] != f % 2) else 0.0 for f in range(6)]
                # Turned, the walls that hold the light are off it by rounding: either side is right.
                if seed == 0:
                    close(e, expected, 1e-12)
                else:
                    close(e[np.array(expected) > 0], [pi] * 3, 1e-12)


def test_light_on_an_edge_and_on_a_face_of_a_room():
    from hardcases import box
    data = polydata(*box(inward=True, n=2))
    for place, share in (((0.3, 0, 0), 0.25), ((0.3, 0.4, 0), 0.5), ((0.5, 0.5, 0), 0.5),
                         ((0.5, 0, 1), 0.25), ((1, 0.5, 0.5), 0.5)):
        e = Run(data, point(place, 3.0)).e[:, 0]
        close(e.sum() * 0.25, 3.0 * 4 * pi * share, 1e-12)


def test_light_close_above_interior_edge_and_vertex():
    for h in (1e-9, 1e-12, 1e-6, 1e-3):
        # Above a point at (x, y): four corner rectangles, by their closed form.
        for x, y in ((0, 0), (0.3, -0.7), (1, 0.2), (-1, -1), (1, 1)):
            exact = sum(np.copysign(corner_above(h, abs(a), abs(b)), a * b)
                        for a in (1 - x, 1 + x) for b in (1 - y, 1 + y) if a * b != 0)
            for light in both_kinds((x, y, h), intensity=7.0):
                close(cell(square(), light), 7.0 * exact / 4.0, 1e-12)


def test_light_just_outside_the_rim_and_close():
    """The light stands 1e-9 above the plane and 1e-9 to 1 beyond an edge: signed rectangles."""
    for h in (1e-9, 1e-6):
        for gap in (2.0**-30, 2.0**-23, 2.0**-10, 1.0):  # 1 + gap is exact
            # Two signed corner rectangles, by the complements of their angles: near and far.
            near = np.arctan2(h * np.sqrt(gap * gap + 1 + h * h), gap)
            far = np.arctan2(h * np.sqrt((2 + gap) ** 2 + 1 + h * h), 2 + gap)
            for light in both_kinds((1 + gap, 0, h)):
                # The angle `near - far` is what is left of pi/2: rounding of pi/2 is allowed.
                close(cell(square(), light), 2 * (near - far) / 4.0, 1e-12, EPS)


def test_light_close_to_a_fine_mesh():
    """1e-9 m above a mesh of 400 cells: each gets its rectangle, together nearly half the sphere."""
    p, q = grid((-1, -1, 0), (2, 0, 0), (0, 2, 0), 20, 20)
    for x, y in ((0.05, 0.05), (0.1, 0.1), (0.1, 0.05), (0.0333, 0.071)):
        e = Run(polydata(p, q), point((x, y, 1e-9), 2.0)).e[:, 0]
        exact = [2.0 / 0.01 * sum(
            sx * sy * np.sign(ax) * np.sign(ay) * corner_above(1e-9, abs(ax), abs(ay))
            for sx, ax in ((-1, p[c[0]][0] - x), (1, p[c[1]][0] - x))
            for sy, ay in ((-1, p[c[0]][1] - y), (1, p[c[2]][1] - y))) for c in q]
        # Corner coordinates differ from x by rounding of 1: that over a cell's 0.1, times 1/h.
        near = np.abs(np.array(e) - exact) <= 1e-10 * np.array(exact) + 1e-9 * np.max(exact)
        assert near.all(), np.abs(e - exact).max()
        close(e.sum() * 0.01, 2.0 * square_above(1e-9), 1e-6)


def test_light_far_away():
    for r in (1e9, 1e12, 1e15):
        for direction in ((0, 0, 1), (0.6, 0, 0.8), (0.36, 0.48, 0.8)):
            place = r * np.array(direction)
            for light in both_kinds(place, -place, intensity=r * r):
                close(cell(square(), light), direction[2], 1e-9 if r < 1e10 else 1e-12)


def test_far_light_behind_a_near_blocker():
    """1e9 m away over the edge of a plate: half of the cell, as the sun would light it."""
    data = mesh(grid((-1, -1, 0), (2, 0, 0), (0, 2, 0)), grid((-3, -3, 1), (3, 0, 0), (0, 6, 0)))
    for light in both_kinds((0, 0, 1e9), intensity=1e18) + (sun((0, 0, -1)),):
        close(Run(data, light).e[0, 0], 0.5, 1e-9)


def test_grazing_direction():
    angle = radians(89.9999)
    for turn in (rotation(0), rotation(5)):
        data = polydata(np.array(SQUARE) @ turn.T, [(0, 1, 2, 3)])
        for azimuth in (0.0, 0.3, 2.0):
            d = np.array([sin(angle) * cos(azimuth), sin(angle) * sin(azimuth), -cos(angle)])
            # A direction of doubles holds cos(89.9999 deg) = 1.7e-6 to 1e-16/1.7e-6.
            close(cell(data, sun(d, 9.0).moved(turn)), 9.0 * cos(angle), 1e-9)
            far = point(-1e6 * d, 9e12).moved(turn)
            close(cell(data, far), 9.0 * cos(angle), 2e-6 if azimuth else 1e-6)


def test_grazing_point_light_against_extended_precision():
    for h in (1e-6, 1e-9):
        for x in (1.5, 3.0, 1e3, 1e6):
            loop = np.array(SQUARE, float)
            for light in both_kinds((x, 0.25, h), (-1, 0, 0)):
                exact = solid_angle(loop, (x, 0.25, h)) / 4.0
                run = Run(square(), light)
                if h / x > 1e-14:
                    close(run.e[0, 0], exact, 1e-10)
                else:  # not to be told from the plane, to eps of what would fall in squarely
                    assert abs(run.e[0, 0] - exact) <= 8 * EPS / x**2, run.e


def test_grazing_shadow_of_a_low_wall():
    """At 89.9999 degrees a wall of 1e-6 throws a shadow of 1e-6 tan(89.9999 deg) = 0.573."""
    angle = radians(89.9999)
    wall = ([(-1, -1, 0), (-1, 1, 0), (-1, 1, 1e-6), (-1, -1, 1e-6)], [(0, 1, 2, 3)])
    data = mesh((SQUARE, [(0, 1, 2, 3)]), wall)
    d = (sin(angle), 0.0, -cos(angle))
    lit = (2.0 - 1e-6 * np.tan(angle)) / 2.0
    close(Run(data, sun(d, 1.0)).e[0, 0], lit * cos(angle), 1e-8)


def test_cell_a_million_times_larger_than_its_distance():
    for size in (1e6, 1e9):
        data = polydata(size * np.array(SQUARE), [(0, 1, 2, 3)])
        for light in both_kinds((0, 0, 1.0), intensity=size * size):
            close(cell(data, light), size * size * square_above(1.0, size) / (2 * size) ** 2, 1e-12)
        off = point((0.3 * size, -0.9 * size, 1.0), 1.0)
        exact = solid_angle(size * np.array(SQUARE), off.position[0]) / (2 * size) ** 2
        close(cell(data, off), exact, 1e-12)


def test_sliver_triangles_of_aspect_a_million():
    x, w = np.polynomial.legendre.leggauss(80)
    for width in (1e-6, 1e-9):
        for seed in (0, 2):
            turn = rotation(seed)
            p = np.array([(0, 0, 0), (1, 0, 0), (0.4, width, 0)])
            data = polydata(p @ turn.T, [(0, 1, 2)])
            for place in ((0.3, 0.2, 0.5), (0.3, 0, 1e-3), (2, 1, 0.01), (0.3, 0.1 * width, 0.5)):
                for light in both_kinds(place):
                    moved = light.moved(turn)
                    exact = solid_angle(p @ turn.T, moved.position[0])
                    # A normal of turned coordinates is good to eps/width.
                    tilt = 0 if seed == 0 else 4 * EPS / width * np.hypot(*place[:2]) / place[2]
                    close(cell(data, moved), exact / (0.5 * width), 1e-10 + tilt)  # the oracle: eps/width of 80 bits
                # Where the intensity varies over it, what the rim integral loses is in its error.
                axis = np.array((0.45, 0, 0)) - place
                run = Run(data, spot(place, axis, 90.0, 2.0).moved(turn))
                mean = 0.0
                for a, b in ((0, 0.28), (0.28, 0.3), (0.3, 0.32), (0.32, 0.4), (0.4, 1)):
                    s = a + (b - a) * 0.5 * (x + 1)
                    local = np.where(s < 0.4, s / 0.4, (1 - s) / 0.6)
                    to = np.stack([s, 0.5 * local * width, 0 * s], axis=1) - place
                    r = np.linalg.norm(to, axis=1)
                    cosine = to @ (axis / np.linalg.norm(axis)) / r
                    mean += (w * 2 * local * cosine**2 * (cosine > 0) * place[2] / r**3).sum() \
                        * 0.5 * (b - a)
                known = 1e-4 if place[2] < 0.01 else 1e-6  # of this rule
                assert abs(run.e[0, 0] - mean) <= run.error[0, 0] + known * mean, (place, run.e, mean)
            tilt = (0.3, 0.2, -0.9)
            close(cell(data, sun(tilt, 2.0).moved(turn)), 2 * 0.9 / sqrt(0.94), 1e-12 + 8 * EPS / width)


def test_floor_of_slivers_takes_what_the_floor_takes():
    """A square cut into needles of aspect 1e6, half of it under a plate: their sum is the half's."""
    n = 40
    y = np.concatenate([[0], np.cumsum(np.where(np.arange(2 * n) % 2, 1e-6, 1 / n - 1e-6))])
    points = [(x, v, 0) for v in y for x in (0, 1)]
    quads = [(2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2) for k in range(2 * n)]
    needles = (points, quads)
    plate = grid((-4, -4, 0.5), (4.5, 0, 0), (0, 9, 0))  # covers x < 0.5
    area = areas_of(*needles)
    for light in both_kinds((0.5, 0.5, 1.0), intensity=2.0):
        run = Run(mesh(needles, plate), light)
        half = solid_angle([(0.5, 0, 0), (1, 0, 0), (1, 1, 0), (0.5, 1, 0)], (0.5, 0.5, 1.0))
        close((run.e[:len(quads), 0] * area).sum(), 2.0 * half, 1e-9)
    run = Run(mesh(needles, plate), sun((0, 0, -1), 2.0))
    close(run.e[:len(quads), 0], np.full(len(quads), 1.0), 1e-9)


def test_needle_that_blocks():
    """A needle of aspect 1e6 takes from a floor what falls on the needle itself."""
    needle = ([(-0.5, 0.1, 1), (0.5, 0.1, 1), (0.5, 0.1 + 1e-6, 1)], [(0, 1, 2)])
    floor = grid((-4, -4, 0), (8, 0, 0), (0, 8, 0), 5, 5)
    for light in both_kinds((0.1, 0.2, 2.0)):
        run = Run(mesh(floor, needle), light)
        bare = Run(mesh(floor), light)
        lost = ((bare.e - run.e[:25]) * (8 / 5) ** 2).sum()
        taken = solid_angle(needle[0], (0.1, 0.2, 2.0))
        # A difference of two numbers near 5: rounding of 5 against 4e-7.
        assert abs(lost - taken) <= 1e-13, (lost, taken)


def test_spot_axis_grazes_the_cell():
    """Axis in the plane of the cell: half of the cone's light falls on the plane (cutoff 30)."""
    p, q = grid((0, -60, 0), (100, 0, 0), (0, 120, 0), 5, 6)
    data, area = polydata(p, q), areas_of(p, q)
    for h in (1e-3, 1e-6, 1e-9):
        e = Run(data, spot((0, 0, h), (1, 0, 0), 30.0, 0.0, 2.0)).e[:, 0]
        whole = 2.0 * 2 * pi * (1 - cos(radians(30)))
        # What passes over the far rim of the floor at 100 m: below h/100 times the cone's width.
        missed = 2.0 * (h / 100) * 2 * radians(30)
        total = (e * area).sum()
        assert whole / 2 - 2 * missed <= total <= whole / 2 * (1 + 1e-9), (total, whole / 2)


def test_spot_narrow_cone_far_and_near():
    """All of a cone's flux lands on what it hits, from 1e-6 to 89.9 degrees."""
    p, q = grid((-1, -1, 0), (2, 0, 0), (0, 2, 0), 3, 3)
    data, area = polydata(p, q), areas_of(p, q)
    for cutoff in (1e-6, 1e-3, 1.0, 30.0, 60.0):
        h = min(0.9 / np.tan(radians(cutoff)), 1e9)
        e = Run(data, spot((0.01, 0.02, h), (0, 0, -1), cutoff, 0.0, 1.0)).e[:, 0]
        # A unit axis of doubles is known to eps: against the cone's half-angle.
        close((e * area).sum(), 4 * pi * sin(radians(cutoff) / 2) ** 2,
              1e-9 + 4 * EPS / radians(cutoff))


run_all(globals())
