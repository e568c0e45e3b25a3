# SPDX-License-Identifier: BSD-3-Clause
"""Ten thousand lights: the light tree's sums beside brute force in numpy, within the stated errors."""
import numpy as np
from hardcases import (POINTS, Light, Run, close, grid, hidden, joined, light_data, mesh, point, polydata,
                       rotation, run_all, sensors, solid_angle, triangles_of, with_points)

N = 10000


def lamps(rng, positions, intensity):
    """Point lights as one polydata."""
    data = polydata(positions, verts=[(i,) for i in range(len(positions))])
    return with_points(data, LightType=np.zeros(len(positions), np.int32),
                       Intensity=np.asarray(intensity, float))


def judge(run, exact, most):
    e, error = run.e[:, 0], run.error[:, 0]
    inside = np.abs(e - exact) <= error + 1e-9 * exact
    assert inside.mean() >= 0.95, (inside.mean(), np.abs(e - exact)[~inside], error[~inside])
    assert (np.abs(e - exact) <= 3 * error + 1e-9 * exact).all()
    assert (error <= most * exact + 1e-300).all(), (error / exact).max()


def test_open_sensors_beside_a_plain_sum():
    rng = np.random.default_rng(1)
    where = rng.uniform((-50, -50, 1), (50, 50, 3), (N, 3))
    strong = 10.0 ** rng.uniform(-4, 1, N)
    places = rng.uniform((-50, -50, 0), (50, 50, 0), (60, 3))
    to = where[None] - places[:, None]
    r = np.linalg.norm(to, axis=2)
    exact = (strong * np.clip(to[:, :, 2], 0, None) / r**3).sum(axis=1)
    for tolerance in (0.01, 0.1):
        judge(Run(sensors(places, (0, 0, 1)), lamps(rng, where, strong), RelativeTolerance=tolerance),
              exact, tolerance)


def test_cells_beside_solid_angles():
    rng = np.random.default_rng(2)
    where = rng.uniform((-20, -20, 0.5), (20, 20, 3), (N, 3))
    strong = 10.0 ** rng.uniform(-3, 1, N)
    p, q = grid((-20, -20, 0), (40, 0, 0), (0, 40, 0), 4, 4)
    run = Run(polydata(p, q), lamps(rng, where, strong))
    exact = []
    for cell in q:
        (x0, y0), (x1, y1) = p[cell[0]][:2], p[cell[2]][:2]
        omega = 0.0
        for sx, x in ((-1, x0), (1, x1)):
            for sy, y in ((-1, y0), (1, y1)):
                a, b = x - where[:, 0], y - where[:, 1]
                omega = omega + sx * sy * np.arctan2(a * b, where[:, 2] * np.sqrt(
                    a * a + b * b + where[:, 2] ** 2))
        exact.append((strong * omega).sum() / 100.0)
    judge(run, np.array(exact), 0.01)


def test_behind_blockers_beside_brute_force():
    rng = np.random.default_rng(3)
    where = rng.uniform((-10, -10, 2), (10, 10, 3), (N, 3))
    strong = rng.uniform(0, 1, N)
    plates = joined(*[grid(c, (1.5, 0, 0), (0, 1.5, 0.3)) for c in rng.uniform((-9, -9, 0.5), (8, 8, 1.5), (12, 3))])
    places = rng.uniform((-9, -9, 0), (9, 9, 0), (20, 3))
    run = Run(sensors(places, (0, 0, 1)), lamps(rng, where, strong), polydata(*plates),
              RelativeTolerance=0.02)
    shade = triangles_of(*plates)
    exact = []
    for place in places:
        to = where - place
        r = np.linalg.norm(to, axis=1)
        seen = ~hidden(np.broadcast_to(place, where.shape), where, shade)
        exact.append((strong * np.clip(to[:, 2], 0, None) / r**3 * seen).sum())
    judge(run, np.array(exact), 0.02)


def test_one_of_ten_thousand_matters():
    """The rest is far and weak: what they add is within the error, and the one is right."""
    rng = np.random.default_rng(4)
    where = np.vstack([rng.uniform((1e3, 1e3, 1), (2e3, 2e3, 3), (N - 1, 3)), [(0.3, 0.2, 1.0)]])
    strong = np.append(np.full(N - 1, 1e-3), 5.0)
    square = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
    run = Run(polydata(square, [(0, 1, 2, 3)]), lamps(rng, where, strong))
    one = 5.0 * solid_angle(square, where[-1]) / 4
    others = (1e-3 * where[:-1, 2] / np.linalg.norm(where[:-1], axis=1) ** 3).sum()
    assert abs(run.e[0, 0] - one - others) <= run.error[0, 0] + 1e-9 * one
    assert run.error[0, 0] <= 0.01 * one


def test_all_at_one_place_are_one():
    rng = np.random.default_rng(5)
    where = np.tile((0.3, 0.2, 1.5), (N, 1))
    floor, plate = grid((-2, -2, 0), (4, 0, 0), (0, 4, 0), 3, 3), grid((0, 0, 0.7), (0.6, 0, 0), (0, 0.5, 0))
    many = Run(mesh(floor, plate), lamps(rng, where, np.full(N, 1e-4)), RelativeTolerance=1e-3)
    one = Run(mesh(floor, plate), point((0.3, 0.2, 1.5), 1.0), RelativeTolerance=1e-3)
    assert (np.abs(many.e - one.e) <= many.error + one.error + 1e-9 * one.e).all()


def test_closed_box_keeps_out_ten_thousand():
    rng = np.random.default_rng(6)
    from hardcases import box
    for seed in (0, 2):
        turn = rotation(seed)
        p, q = box(inward=True, n=3)
        where = rng.uniform(-2, 3, (N, 3))
        a = rng.integers(0, 3, N)
        where[np.arange(N), a] = np.where(rng.random(N) < 0.5, -1e-4, 1 + 1e-4)
        for location in (0, POINTS):
            run = Run(polydata(p @ turn.T, q), lamps(rng, where @ turn.T, np.ones(N)), SampleLocation=location)
            assert (run.e == 0).all(), (seed, location, run.e.max())


def test_extremes_of_strength_beside_each_other():
    """From 1e-300 to 1e30, and zeros: the strong ones decide; none becomes NaN."""
    rng = np.random.default_rng(7)
    where = rng.uniform((-5, -5, 1), (5, 5, 3), (2000, 3))
    strong = np.concatenate([10.0 ** rng.uniform(-300, 30, 1900), np.zeros(100)])
    places = rng.uniform((-5, -5, 0), (5, 5, 0), (20, 3))
    run = Run(sensors(places, (0, 0, 1)), lamps(rng, where, strong))
    to = where[None] - places[:, None]
    exact = (strong * to[:, :, 2] / np.linalg.norm(to, axis=2) ** 3).sum(axis=1)
    judge(run, exact, 0.01)


def test_threads_and_order():
    """The same bytes for 1, 2 and 7 threads; another order of lights within the errors."""
    rng = np.random.default_rng(8)
    where = rng.uniform((-10, -10, 1), (10, 10, 3), (3000, 3))
    strong = rng.uniform(0, 1, 3000)
    data = mesh(grid((-10, -10, 0), (20, 0, 0), (0, 20, 0), 6, 6), grid((0, 0, 0.7), (3, 0, 0), (0, 2, 0)))
    runs = [Run(data, lamps(rng, where, strong), NumberOfThreads=t) for t in (1, 2, 7)]
    assert runs[0].bytes() == runs[1].bytes() == runs[2].bytes()
    order = rng.permutation(3000)
    other = Run(data, lamps(rng, where[order], strong[order]))
    difference = np.abs(other.e - runs[0].e)
    assert (difference <= 2 * (other.error + runs[0].error)).all()


run_all(globals())
