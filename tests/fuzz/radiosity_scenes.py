# SPDX-License-Identifier: BSD-3-Clause
"""Random polygon soups of random reflectance under random lights: no NaN, nothing negative, no light out
of nothing, the same bytes for any number of threads, light goes both ways between emitters, more
reflectance never makes it darker, and the methods agree within their errors.

radiosity_scenes.py [--first SEED] [--count N]    any seed again: --first SEED --count 1
"""
import argparse
import time

import numpy as np
from direct_scenes import lamp, soup
from hardcases import METHODS, Solved, areas_of, polydata, with_cells


class Tally:
    """Values judged by their errors: at least 95 % must hold."""

    def __init__(self):
        self.asked = self.missed = 0

    def __call__(self, good):
        self.asked += good.size
        self.missed += np.count_nonzero(~good)


def distinct(p, q):
    """Each polygon once: light that meets a face and its copy is told of both."""
    kept = {tuple(sorted(map(tuple, np.round(p[list(c)], 12)))): c for c in q}
    return p, list(kept.values())


def scene(seed):
    rng = np.random.default_rng(seed)
    p, q = soup(rng)
    if seed % 4:
        p, q = distinct(p, q)
    rho = rng.uniform(0.0, rng.choice([0.3, 0.7, 0.95]), len(q))
    if rng.random() < 0.2:
        rho[:] = 0.9
    lights = [lamp(rng) for _ in range(rng.integers(1, 3))]
    emitted = np.where(rng.random(len(q)) < 0.15, 10.0 ** rng.uniform(-1, 1), 0.0)
    options = dict(TwoSided=bool(rng.integers(2)), RelativeTolerance=float(rng.choice([0.05, 0.15])))
    return rng, p, q, rho, lights, emitted, options


def both_sides(run):
    """Irradiance and error of fronts and backs; backs that do not receive are nothing."""
    if run.output.GetCellData().HasArray("IrradianceBack"):
        back, error = run.values(run.output, back=True)
        return np.vstack([run.e, back])[:, 0], np.vstack([run.error, error])[:, 0]
    return run.e[:, 0], run.error[:, 0]


def check_energy(run, direct, areas, rho, emitted, sides):
    """What is absorbed is no more than what the lights sent to surfaces and what these emit."""
    e, error = both_sides(run)
    first, first_error = both_sides(direct)
    a, r = np.tile(areas, len(e) // len(areas)), np.tile(rho, len(e) // len(areas))
    sent = a @ first + sides * areas @ emitted
    slack = a @ ((1 - r) * error) + a @ first_error
    absorbed = a @ ((1 - r) * e)
    assert absorbed <= sent + slack + 1e-9 * sent, ("energy", absorbed, sent, slack)


def check_scene(seed, agree, reciprocal):
    rng, p, q, rho, lights, emitted, options = scene(seed)
    areas = areas_of(p, q)
    sides = 2 if options["TwoSided"] else 1

    def solve(rho=rho, emitted=emitted, lights=lights, **more):
        data = with_cells(polydata(p, q), DiffuseReflectance=rho, EmittedExitance=emitted)
        return Solved(data, lights, **(options | more))

    # Direct light of the lamps alone: nothing reflects, nothing emits.
    direct = solve(rho=np.zeros(len(q)), emitted=np.zeros(len(q)))
    runs = {}
    for name, method in METHODS.items():
        runs[name] = solve(Method=method)
        if seed % 4:
            check_energy(runs[name], direct, areas, rho, emitted, sides)
    one = list(METHODS)[seed % len(METHODS)]
    assert runs[one].bytes() == solve(Method=METHODS[one], NumberOfThreads=3).bytes(), "threads"
    names = list(runs)
    for k, a in enumerate(names):
        for b in names[k + 1:]:
            (ea, da), (eb, db) = both_sides(runs[a]), both_sides(runs[b])
            agree(np.abs(ea - eb) <= np.hypot(da, db) + 1e-12 * max(ea.max(), eb.max(), 1e-300))
    # More reflectance, more light everywhere.
    e, error = both_sides(runs[one])
    brighter, more_error = both_sides(solve(rho=0.5 + 0.5 * rho, Method=METHODS[one]))
    agree(brighter + more_error + error >= e)
    # What i sends arrives at j as what j sends arrives at i: A_j E_j = A_i E_i for a unit of exitance.
    i, j = rng.choice(len(q), 2, replace=False)
    if min(areas[i], areas[j]) > 1e-9:
        there = solve(emitted=np.eye(len(q))[i], lights=(), TwoSided=False)
        back = solve(emitted=np.eye(len(q))[j], lights=(), TwoSided=False)
        difference = areas[j] * there.e[j, 0] - areas[i] * back.e[i, 0]
        reciprocal(np.array([abs(difference) <= np.hypot(areas[j] * there.error[j, 0],
                                                         areas[i] * back.error[i, 0]) + 1e-13]))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--first", type=int, default=5)
    parser.add_argument("--count", type=int, default=6)
    chosen = parser.parse_args()
    failed, agree, reciprocal = [], Tally(), Tally()
    start = time.perf_counter()
    for seed in range(chosen.first, chosen.first + chosen.count):
        try:
            check_scene(seed, agree, reciprocal)
        except AssertionError as problem:
            failed.append(seed)
            print(f"seed {seed}: {problem}", flush=True)
    for name, tally in (("methods", agree), ("both ways", reciprocal)):
        print(f"{name}: {tally.asked} compared, {tally.missed} beyond their errors")
        if tally.missed > 0.05 * tally.asked + 2.0 * (tally.asked < 60):
            failed.append(name)
    print(f"{chosen.count} scenes, failed {failed}, {time.perf_counter() - start:.1f} s")
    return 1 if failed else 0


if __name__ == "__main__":
    raise SystemExit(main())
