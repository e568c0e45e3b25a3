# SPDX-License-Identifier: BSD-3-Clause
"""Two parallel plates from a millionth to a million times their size apart. One constant radiosity a
plate (Refinement Off) has a closed form: E2 = F (M + rho E1 ...), a geometric series."""
import numpy as np
from hardcases import METHODS, Solved, close, grid, mesh, rotation, polydata, joined, run_all, with_cells

GAPS = (1e-6, 1e-3, 0.1, 1.0, 10.0, 1e3, 1e6)


def plates_factor(gap):
    """F of opposite unit squares: the closed form near (extended precision), a smooth double integral
    over differences of coordinates far away."""
    if gap >= 1.0:
        x, w = np.polynomial.legendre.leggauss(40)
        x, w = 0.5 * (x + 1.0), 0.5 * w
        u, v = np.meshgrid(x, x)
        kernel = (1 - u) * (1 - v) * gap**2 / (np.pi * (gap**2 + u**2 + v**2) ** 2)
        return float(4.0 * (np.outer(w, w) * kernel).sum())
    x = np.longdouble(1.0) / np.longdouble(gap)
    root = np.sqrt(1 + x * x)
    total = 0.5 * np.log((1 + x * x) ** 2 / (1 + 2 * x * x)) + 2 * x * root * np.arctan(x / root)
    total -= 2 * x * np.arctan(x)
    pi = np.longdouble("3.14159265358979323846264338327950288")
    return float(2 * total / (pi * x * x))


def plates(gap, seed=0, shift=(0, 0, 0), scale=1.0):
    points, cells = joined(grid((0, 0, 0), (1, 0, 0), (0, 1, 0)),
                           grid((0, 0, gap), (0, 1, 0), (1, 0, 0)))
    return polydata(scale * points @ rotation(seed).T + shift, cells)


def test_the_oracle_itself():
    close(plates_factor(1.0), 0.199824895698387, 1e-12)
    close(plates_factor(0.999999), plates_factor(1.0), 1e-5)
    close(plates_factor(0.5), 0.415253283577, 1e-11)


def exact(gap, rho1, rho2):
    """Irradiance of both plates when the first emits 1."""
    f = plates_factor(gap)
    loop = 1.0 / (1.0 - rho1 * rho2 * f * f)
    return np.array([rho2 * f * f * loop, f * loop])


def test_one_radiosity_a_plate():
    for gap in GAPS:
        for seed in (0, 1):
            if seed and gap < 1e-3:
                continue  # turning rounds a gap of 1e-6 by 1e-10 of itself; see the next test
            data = with_cells(plates(gap, seed), EmittedExitance=np.array([1.0, 0.0]),
                              DiffuseReflectance=np.array([0.6, 0.8]))
            run = Solved(data, Method=METHODS["Dense"], Refinement=2, RelativeTolerance=1e-6)
            e = exact(gap, 0.6, 0.8)
            close(run.e[:, 0], e, 2e-6, 1e-12 * e.max())  # E1 is of second order: 1e-13 of E2 far off
            assert (np.abs(run.e[:, 0] - e) <= run.error[:, 0] + 1e-12 * e.max()).all()


def test_every_method_within_its_error():
    for gap in GAPS:
        for method in METHODS.values():
            data = with_cells(plates(gap, 1), EmittedExitance=np.array([1.0, 0.0]),
                              DiffuseReflectance=np.array([0.6, 0.8]))
            run = Solved(data, Method=method, Refinement=2, RelativeTolerance=0.01)
            e = exact(gap, 0.6, 0.8)
            off = np.abs(run.e[:, 0] - e)
            # What gets out at the rim of the nearest pairs no ray of MonteCarlo meets, and far plates
            # neither (a known weakness, docs/hard-cases.md): it is held to the tolerance there, and left
            # out where it may see nothing at all.
            unseen = 1e-5 * (gap < 1e-5)
            if method == METHODS["MonteCarlo"]:
                if gap > 1.0:
                    continue
                unseen = 0.01
            assert (off <= run.error[:, 0] + unseen * e).all(), (gap, method, run.e, e, run.error)


def test_plates_of_every_size():
    for scale in (1e-6, 1e6):
        for gap in (1e-3, 1.0, 1e3):
            data = with_cells(plates(gap, 2, scale=scale), EmittedExitance=np.array([1.0, 0.0]),
                              DiffuseReflectance=np.array([0.6, 0.8]))
            run = Solved(data, Method=METHODS["Dense"], Refinement=2, RelativeTolerance=1e-6)
            e = exact(gap, 0.6, 0.8)
            close(run.e[:, 0], e, 2e-6, 1e-12 * e.max())


def test_back_to_back_and_coplanar_see_nothing():
    away = joined(grid((0, 0, 0), (0, 1, 0), (1, 0, 0)), grid((0, 0, 1e-9), (1, 0, 0), (0, 1, 0)),
                  grid((1, 0, 0), (0, 1, 0), (1, 0, 0)))
    for method in METHODS.values():
        data = with_cells(polydata(*away), EmittedExitance=np.array([1.0, 0.0, 0.0]))
        run = Solved(data, Method=method)
        assert (run.e[1:] == 0.0).all(), (method, run.e)


def test_a_sheet_between_hides_all():
    for gap in (1e-3, 1.0, 1e3):
        sheet = grid((-9, -9, gap / 2), (19, 0, 0), (0, 19, 0))
        size = 1.0 if gap <= 1.0 else 1e4
        sheet = grid((-9 * size, -9 * size, gap / 2), (19 * size, 0, 0), (0, 19 * size, 0))
        for method in METHODS.values():
            data = with_cells(plates(gap), EmittedExitance=np.array([1.0, 0.0]),
                              DiffuseReflectance=np.array([0.6, 0.8]))
            run = Solved(data, (), [mesh(sheet)], Method=method)
            assert (run.e == 0.0).all(), (gap, method, run.e)


run_all(globals())
