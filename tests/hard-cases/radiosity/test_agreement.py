# SPDX-License-Identifier: BSD-3-Clause
"""The three operators agree within their stated errors on every scene: closed and open, furnished,
through doors and slots, random soup, two-sided, under a sky, lit by an emitter."""
import numpy as np
from hardcases import (METHODS, Solved, box, grid, joined, point, polydata, room, run_all, sky, spot,
                       sun, with_cells)

RNG = np.random.default_rng


def furnished():
    """A room with a table of a top and four legs, a shelf with boards, and a box."""
    parts = [box((0, 0, 0), (4, 3, 2.5), 4, True), box((1, 1, 0.7), (2.4, 1.8, 0.75), 2),
             box((3.2, 0.2, 0.0), (3.7, 0.9, 0.5), 2)]
    parts += [box((x, y, 0), (x + 0.06, y + 0.06, 0.7)) for x in (1.02, 2.3) for y in (1.02, 1.7)]
    parts += [box((0.1, 2.6, z), (1.3, 2.9, z + 0.03)) for z in (0.4, 0.9, 1.4)]
    return joined(*parts)


def two_rooms():
    """A wall with a door parts a lit room from one that only gets what comes through."""
    shell = box((0, 0, 0), (4, 2, 2), 3, True)
    wall = joined(grid((2, 0, 0), (0, 0, 2), (0, 0.7, 0), 2, 2), grid((2, 1.3, 0), (0, 0, 2), (0, 0.7, 0), 2, 2),
                  grid((2, 0.7, 1.4), (0, 0, 0.6), (0, 0.6, 0), 1, 1))
    return joined(shell, wall)


def soup():
    rng = RNG(5)
    parts = [grid((-2, -2, -2), (4, 0, 0), (0, 4, 0), 3, 3)]
    for _ in range(30):
        c, a, b = rng.uniform(-1.5, 1.5, (3, 3))
        parts.append((np.array([c, c + 0.4 * a, c + 0.4 * b]), [(0, 1, 2)]))
    return joined(*parts)


def slats():
    """Blinds between two plates: every exchange is partly blocked."""
    parts = [grid((0, 0, 0), (2, 0, 0), (0, 2, 0), 4, 4), grid((0, 0, 1), (0, 2, 0), (2, 0, 0), 4, 4)]
    parts += [grid((0.1 + 0.2 * k, -0.2, 0.45), (0.08, 0, 0.1), (0, 2.4, 0)) for k in range(9)]
    return joined(*parts)


SCENES = {
    "furnished": (furnished, lambda: [point((2.0, 1.5, 2.2), 5.0)], {}),
    "two rooms": (two_rooms, lambda: [spot((1.0, 1.0, 1.9), (0.2, 0, -1), 50.0, 1.0, 8.0)],
                  {"TwoSided": True}),
    "soup": (soup, lambda: [point((0.3, 0.2, 1.9), 4.0)], {"TwoSided": True}),
    "slats": (slats, lambda: [], {"emits": 16, "TwoSided": True}),
    "yard under the sun": (room, lambda: [sun((0.3, -0.2, -0.9), 3.0)], {}),
    "yard under a sky": (room, lambda: [sky(2.0)], {}),
}


PAIRS = [("Dense", "Hierarchical"), ("Dense", "MonteCarlo"), ("Hierarchical", "MonteCarlo")]


def test_all_pairs_of_methods():
    agree = {pair: [] for pair in PAIRS}
    for name, (shape, lights, options) in SCENES.items():
        points, cells = shape()
        options = dict(options)
        rho = RNG(3).uniform(0.1, 0.85, len(cells))
        arrays = {"DiffuseReflectance": rho}
        emits = options.pop("emits", 0)
        if emits:
            arrays["EmittedExitance"] = np.where(np.arange(len(cells)) < emits, 3.0, 0.0)
        runs = {}
        for method, number in METHODS.items():
            data = with_cells(polydata(points, cells), **arrays)
            runs[method] = Solved(data, lights(), Method=number, RelativeTolerance=0.03, **options)
            assert method in runs[method].method(), runs[method].method()
        for one, other in PAIRS:
            a, b = runs[one], runs[other]
            inside = np.abs(a.e - b.e) <= np.hypot(a.error, b.error)
            # Values of one scene err together; over all scenes the contract holds. Links through
            # slats are Hierarchical's weakest case (docs/hard-cases.md).
            least = 0.7 if name == "slats" else 0.9
            assert inside.mean() >= least, (name, one, other, inside.mean())
            agree[one, other].append(inside.mean())
        for method, run in runs.items():
            bright = run.e > 0.05 * run.e.mean()
            assert np.median(run.error[bright] / run.e[bright]) < 0.1, (name, method)
    for pair, shares in agree.items():
        print(pair, np.round(shares, 3))
        assert np.mean(shares) >= 0.95, (pair, shares)


run_all(globals())
