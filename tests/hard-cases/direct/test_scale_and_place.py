# SPDX-License-Identifier: BSD-3-Clause
"""The same scene in other units, far from the origin or turned gives the same answer, up to the
exact power of the scale: 1e-6 relative. Where shadows are sampled or fitted (area lights, skies) a
decision may fall otherwise in other units: there the answers may differ by their own errors."""
import numpy as np
from hardcases import KINDS, POINTS, SAMPLED, SCALE_POWER, Run, close, polydata, room, rotation, run_all, sensors

UTM = (5e5, 4e6, 0.0)
WORK_PLANE = np.array([(x, y, 0.85) for x in np.linspace(-1.9, 1.9, 9)
                       for y in np.linspace(-1.8, 1.8, 7)])


def surface(turn=np.eye(3), scale=1.0, shift=(0, 0, 0)):
    p, q = room()
    return polydata(scale * p @ turn.T + np.asarray(shift, float), q)


def same(run, reference, factor=1.0, sampled=False):
    """1e-6 of each value; values far below what others get may differ by 1e-10 of those, where a
    shadow's edge has moved by the rounding of the new coordinates."""
    allowed = 1e-6 * reference.e + 1e-10 * reference.e.max()
    if sampled:
        allowed = allowed + np.hypot(run.error / factor, reference.error)
    assert run.e.shape == reference.e.shape
    difference = np.abs(run.e / factor - reference.e)
    bad = ~(difference <= allowed)
    if sampled:  # error bars hold for 95 % of values, and are not far off for the others
        assert bad.mean() <= 0.05 and (difference <= 3 * allowed).all(), (bad.sum(), difference[bad])
    else:
        assert not bad.any(), (run.e[bad] / factor, reference.e[bad], allowed[bad])


def everywhere(check, kinds=KINDS):
    for name in kinds:
        for location in (0, POINTS):
            check(name, dict(SampleLocation=location,
                             RelativeTolerance=0.1 if name in SAMPLED else 1e-4))


def test_scaled_by_a_millionth_and_a_billion():
    def check(name, options):
        reference = Run(surface(), KINDS[name](), **options)
        assert reference.e.max() > 0
        for scale in (1e-6, 1e9, 3.0):
            run = Run(surface(scale=scale), KINDS[name]().moved(scale=scale), **options)
            same(run, reference, scale ** SCALE_POWER[name], name in SAMPLED)

    everywhere(check, SCALE_POWER)


def test_units_of_a_millionth_and_a_billion_metres():
    def check(name, options):
        reference = Run(surface(), KINDS[name](), **options)
        for unit in (1e-6, 1e9):
            run = Run(surface(), KINDS[name](), MetersPerUnit=unit, **options)
            same(run, reference, unit ** SCALE_POWER[name], name in SAMPLED)

    everywhere(check, SCALE_POWER)


def test_in_utm_metres():
    def check(name, options):
        reference = Run(surface(), KINDS[name](), **options)
        run = Run(surface(shift=UTM), KINDS[name]().moved(shift=UTM), **options)
        same(run, reference, 1.0, name in SAMPLED)

    everywhere(check)


def test_turned():
    def check(name, options):
        reference = Run(surface(), KINDS[name](), **options)
        for seed in (1, 2):
            turn = rotation(seed)
            run = Run(surface(turn), KINDS[name]().moved(turn), **options)
            same(run, reference, 1.0, name in SAMPLED)

    everywhere(check)


def test_turned_scaled_and_in_utm_at_once():
    def check(name, options):
        reference = Run(surface(), KINDS[name](), **options)
        turn = rotation(3)
        run = Run(surface(turn, 30.0, UTM), KINDS[name]().moved(turn, 30.0, UTM), **options)
        same(run, reference, 30.0 ** SCALE_POWER[name], name in SAMPLED)

    everywhere(check, SCALE_POWER)


def test_sensors_scaled_in_utm_and_turned():
    for name in SCALE_POWER:
        reference = Run(sensors(WORK_PLANE, (0, 0, 1)), KINDS[name](), surface())
        for turn, scale, shift in ((np.eye(3), 1e-6, (0, 0, 0)), (np.eye(3), 1e9, (0, 0, 0)),
                                   (np.eye(3), 1.0, UTM), (rotation(4), 1.0, (0, 0, 0)),
                                   (rotation(5), 20.0, UTM)):
            grid = sensors(scale * WORK_PLANE @ turn.T + shift, turn @ (0, 0, 1))
            run = Run(grid, KINDS[name]().moved(turn, scale, shift), surface(turn, scale, shift))
            same(run, reference, scale ** SCALE_POWER[name], name in SAMPLED)


def test_shadows_are_there_in_utm():
    """Not only alike: the shadow that other programs lose at (5e5, 4e6) is in the numbers."""
    for name in ("point", "sun", "spot", "web", "area"):
        light = KINDS[name]().moved(shift=UTM)
        with_shadows = Run(surface(shift=UTM), light).e[:25].sum()
        without = Run(surface(shift=UTM), light, Occlusion=2).e[:25].sum()
        assert with_shadows < 0.9 * without, name


run_all(globals())
