# SPDX-License-Identifier: BSD-3-Clause
"""Area lights where digits run out: lights of next to no width."""
from math import pi

import numpy as np
from hardcases import Run, area, rotation, run_all, sensors


def test_thin_lights():
    """Tubes of 1 by 1e-6 and 1e-9 m: Lambert's formula keeps its digits."""
    places = np.array([(0.5, 0.3, 0), (0.1, 0, 0), (-2, 1, 0)])
    for width in (1e-6, 1e-9):
        for seed in (0, 1):
            turn = rotation(seed)
            tube = np.array([(0, 0, 1), (0, width, 1), (1, width, 1), (1, 0, 1)])
            run = Run(sensors(places @ turn.T, turn @ (0, 0, 1)), area(tube, 1 / width).moved(turn))
            # Length of the line times cos cos / pi r^2, integrated along it.
            x, w = np.polynomial.legendre.leggauss(60)
            s = 0.5 * (x + 1)
            exact = [(0.5 * w / (pi * ((s - p[0]) ** 2 + p[1] ** 2 + 1) ** 2)).sum() for p in places]
            # The oracle is the line's: to the order of the width; turned corners are rounded.
            known = 3 * width + 1e-12 + (0 if seed == 0 else 8e-16 / width)
            allowed = run.error[:, 0] + known * np.array(exact)
            assert (np.abs(run.e[:, 0] - exact) <= allowed).all(), (width, run.e, exact, run.error)
            assert (run.error[:, 0] <= 1e-13 / width * np.array(exact)).all(), (width, run.error)


run_all(globals())
