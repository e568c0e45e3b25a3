# SPDX-License-Identifier: BSD-3-Clause
"""1, 2 and 7 threads give the same bytes: every kind of light, cells, points and sensors."""
import numpy as np
from hardcases import KINDS, POINTS, Run, polydata, room, run_all, sensors


def same_bytes(make):
    one, two, seven = (make(threads) for threads in (1, 2, 7))
    assert one.bytes() == two.bytes()
    assert one.bytes() == seven.bytes()
    assert one.e.max() > 0
    assert make(7).bytes() == seven.bytes()  # and again


def test_cells():
    for name in KINDS:
        same_bytes(lambda threads: Run(polydata(*room()), KINDS[name](), RelativeTolerance=0.1, NumberOfThreads=threads))


def test_points():
    for name in KINDS:
        same_bytes(lambda threads: Run(polydata(*room()), KINDS[name](), SampleLocation=POINTS,
                                       RelativeTolerance=0.1, NumberOfThreads=threads))


def test_sensors():
    places = np.random.default_rng(1).uniform((-2, -2, 0.5), (2, 2, 0.9), (500, 3))
    for name in KINDS:
        same_bytes(lambda threads: Run(sensors(places, (0, 0, 1)), KINDS[name](),
                                       polydata(*room()), RelativeTolerance=0.1, NumberOfThreads=threads))


def test_all_kinds_together_on_both_sides():
    p, q = room()
    for back in (False, True):
        turned = polydata(p, [polygon[::-1] if back else polygon for polygon in q])
        same_bytes(lambda threads: Run(turned, [make() for make in KINDS.values()],
                                       back=back, TwoSided=True, RelativeTolerance=0.1, NumberOfThreads=threads))


def test_sampled_shadows():
    """Under hundreds of leaves, where what is not cut is sampled."""
    rng = np.random.default_rng(2)
    c = rng.uniform((-2, -2, 0.8), (2, 2, 1.3), (700, 1, 3))
    leaves = c + rng.uniform(-0.05, 0.05, (700, 3, 3))
    shade = polydata(leaves.reshape(-1, 3), np.arange(2100).reshape(-1, 3))
    for name in KINDS:
        same_bytes(lambda threads: Run(polydata(*room()), KINDS[name](), shade,
                                       RelativeTolerance=0.1, NumberOfThreads=threads))


run_all(globals())
