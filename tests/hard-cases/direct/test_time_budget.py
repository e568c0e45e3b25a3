# SPDX-License-Identifier: BSD-3-Clause
"""A budget of next to no time, under a thousand leaves: the result says that time ended it, its values
are numbers between nothing and all, and their errors cover what a run without a budget finds."""
import numpy as np
from hardcases import KINDS, POINTS, Run, array, grid, polydata, run_all, sensors

OUTCOME = "RadiometryOutcome"


def scene():
    rng = np.random.default_rng(2)
    c = rng.uniform((-2, -2, 0.8), (2, 2, 1.3), (1500, 1, 3))
    leaves = c + rng.uniform(-0.1, 0.1, (1500, 3, 3))
    return (polydata(*grid((-2, -2, 0), (4, 0, 0), (0, 4, 0), 8, 8)),
            polydata(leaves.reshape(-1, 3), np.arange(4500).reshape(-1, 3)))


def check(data, shade, kinds, **options):
    for name in kinds:
        hasty = Run(data, KINDS[name](), shade, RelativeTolerance=1e-7, TimeBudget=1e-6, **options)
        assert "time budget" in array(hasty.output.GetFieldData(), OUTCOME)[0], name
        bare = Run(data, KINDS[name](), Occlusion=2, **options)
        assert (hasty.e <= bare.e + bare.error + hasty.error + 1e-12 * bare.e).all(), name
        slow = Run(data, KINDS[name](), shade, RelativeTolerance=0.05, **options)
        inside = np.abs(hasty.e - slow.e) <= hasty.error + slow.error + 1e-12 * bare.e
        assert inside.mean() >= 0.95, (name, inside.mean())


def test_cells():
    check(*scene(), [k for k in KINDS if k not in ("concave area", "smooth spot")])


def test_points_under_lights_that_need_many_rays():
    check(*scene(), ("area", "uniform sky", "overcast sky"), SampleLocation=POINTS)


def test_sensors_under_lights_that_need_many_rays():
    places = np.random.default_rng(3).uniform((-2, -2, 0), (2, 2, 0.5), (60, 3))
    check(sensors(places, (0, 0, 1)), scene()[1], ("area", "uniform sky", "overcast sky"))


run_all(globals())
