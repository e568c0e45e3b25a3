# SPDX-License-Identifier: BSD-3-Clause
"""Environments in hard places: a uniform sky over anything by its view of the sky, overcast and map
skies by their integrals, walls that hide exactly half, closed rooms that stay exactly dark, points just
above the horizon of something large, skies that are no skies."""
from math import inf, nan, pi

import numpy as np
from hardcases import (POINTS, Run, box, close, fails, grid, joined, light_data, mesh, polydata, room,
                       rotation, run_all, sensors, sky)
from vtkradiometry import vtkIrradianceFilter

SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
OVERCAST_LEVEL = 7 * pi / 9  # E/Lz of the overcast sky on a level plane


def flat():
    return polydata(SQUARE, [(0, 1, 2, 3)])


def covered(run, exact, relative=0.05):
    e, error = run.e[:, 0], run.error[:, 0]
    exact = np.broadcast_to(exact, e.shape)
    assert (np.abs(e - exact) <= error + 1e-9 * exact).mean() >= 0.95, (e, exact, error)
    assert (error <= relative * exact + 1e-12).all(), (error, exact)


def test_open_uniform_sky_is_pi_whatever_the_tilt():
    for seed in (0, 1, 2, 3):
        turn = rotation(seed)
        for location in (0, POINTS):
            run = Run(polydata(np.array(SQUARE) @ turn.T, [(0, 1, 2, 3)]), sky(2.0),
                      SampleLocation=location)
            close(run.e, np.full(run.e.shape, 2 * pi), 1e-9)
            assert (run.error <= 1e-9 * run.e).all(), run.error


def test_open_overcast_sky_on_level_vertical_and_downward_planes():
    for down in ((0, 0, -1), (0.48, 0.36, -0.8)):
        up = -np.array(down)
        side = np.cross(up, (0, 1, 0.3))
        side /= np.linalg.norm(side)
        run = Run(sensors(np.zeros((3, 3)), [up, side, -up]), sky(3.0, 3, down))
        # Level 7 pi/9; vertical: integral of (1 + 2 sin h)/3 cos h cos a: pi/6 + 4/9; from below 0.
        exact = 3.0 * np.array([OVERCAST_LEVEL, pi / 6 + 4 / 9, 0.0])
        assert (np.abs(run.e[:, 0] - exact) <= run.error[:, 0] + 1e-9).all(), (run.e, exact)
        assert (run.error[:, 0] <= 0.02 * 3.0).all()


def test_maps_of_constant_are_uniform_and_maps_of_nothing_dark():
    for size in ((1, 1), (2, 4), (64, 128)):
        run = Run(flat(), sky(2.0, 1, pixels=np.ones(size)))
        assert abs(run.e[0, 0] - 2 * pi) <= run.error[0, 0] + 1e-9
        assert run.error[0, 0] < 0.05 * 2 * pi
        dark = Run(flat(), sky(2.0, 1, pixels=np.zeros(size)))
        assert (dark.e == 0).all() and (dark.error == 0).all()


def test_a_map_with_one_bright_pixel_is_a_small_sun():
    pixels = np.zeros((90, 180))
    pixels[20, 30] = 1e6
    z = np.radians([40, 42])
    omega = np.radians(2) * (np.cos(z[0]) - np.cos(z[1]))
    mean_cosine = np.radians(2) * 0.5 * (np.sin(z[1]) ** 2 - np.sin(z[0]) ** 2) / omega
    run = Run(flat(), sky(1.0, 1, pixels=pixels))
    exact = 1e6 * omega * mean_cosine
    assert abs(run.e[0, 0] - exact) <= run.error[0, 0] + 1e-9 * exact, (run.e, exact, run.error)
    # And it is hidden by a plate the other way round the horizon only where the plate is.
    azimuth = np.radians((30.5 / 180 - 0.5) * 360)
    toward = np.array([np.sin(azimuth) * np.sin(z.mean()), np.cos(azimuth) * np.sin(z.mean()),
                       np.cos(z.mean())])
    for sign, lit in ((1, False), (-1, True)):
        middle = np.array((0.5, 0.5, 0)) + 20.0 * toward * (sign, sign, 1)
        shade = polydata(*grid(middle - (4, 4, 0), (8, 0, 0), (0, 8, 0)))
        e = Run(flat(), sky(1.0, 1, pixels=pixels), shade)
        assert abs(e.e[0, 0] - (exact if lit else 0.0)) <= e.error[0, 0] + 1e-9 * exact, (sign, e.e)


def test_half_the_sky_behind_an_endless_wall():
    """A wall of 1e6 m on the cell's edge hides half of a uniform sky, seen from its foot."""
    wall = polydata([(-1e6, 0, 0), (1e6, 0, 0), (1e6, 0, 1e6), (-1e6, 0, 1e6)], [(0, 1, 2, 3)])
    places = sensors([(0.5, 1e-3, 0), (0.1, 0.5, 0), (0, 10, 0)], (0, 0, 1))
    covered(Run(places, sky(2.0), wall), pi)
    covered(Run(flat(), sky(2.0), wall), pi)


def test_a_disc_overhead_takes_its_sine_squared():
    a = np.linspace(0, 2 * pi, 256, endpoint=False)
    for h in (0.01, 1.0, 100.0):
        disc = polydata(np.column_stack([np.cos(a), np.sin(a), np.full(256, h)]), [range(256)])
        exact = pi * (1 - 1 / (1 + h * h))
        run = Run(sensors([(0, 0, 0)], (0, 0, 1)), sky(1.0), disc)
        assert abs(run.e[0, 0] - exact) <= run.error[0, 0] + 3e-4 * pi, (h, run.e, exact, run.error)


def test_convex_bodies_are_lit_as_if_alone():
    """Nothing of a convex body faces itself: pi L on every cell, no acne, no dark rims."""
    for seed in (0, 1):
        turn = rotation(seed)
        for n in (1, 3):
            p, q = box(n=n)
            for location in (0, POINTS):
                run = Run(polydata(p @ turn.T, q), sky(1.0), SampleLocation=location)
                covered(run, pi)


def test_closed_boxes_stay_dark():
    for seed in (0, 2, 3):
        turn = rotation(seed)
        for n in (1, 4):
            p, q = box(inward=True, n=n)
            for light in (sky(1.0), sky(1.0, 3), sky(1.0, 1, pixels=np.ones((4, 8)))):
                for location in (0, POINTS):
                    run = Run(polydata(p @ turn.T, q), light, SampleLocation=location)
                    assert (run.e == 0).all(), (seed, n, light.arrays["SkyModel"], run.e.max())
            run = Run(sensors([turn @ (0.5, 0.5, 0.5), turn @ (1e-9, 0.3, 0.4)], turn @ (1, 0, 0)),
                      sky(1.0), polydata(p @ turn.T, q))
            assert (run.e == 0).all()


def test_under_a_table_top_that_touches():
    """A floor covered face to face by a plate: dark where covered (1e-9 above it), pi beside it far
    away."""
    plate = polydata(*grid((-50, -50, 1e-9), (100, 0, 0), (0, 100, 0)))
    run = Run(sensors([(0, 0, 0), (1e5, 0, 0)], (0, 0, 1)), sky(1.0), plate)
    assert run.e[0, 0] <= run.error[0, 0] and run.error[0, 0] < 0.01
    assert abs(run.e[1, 0] - pi) <= run.error[1, 0] + 1e-6


def test_below_bounds():
    """Never more than without blockers, in a scene with some."""
    data = polydata(*room())
    for light in (sky(1.0), sky(1.0, 3)):
        run, bare = Run(data, light), Run(data, light, Occlusion=2)
        assert (run.e <= bare.e + run.error + bare.error).all()


def test_bad_skies_are_refused():
    def refused(light, *words):
        f = vtkIrradianceFilter()
        f.SetInputData(flat())
        f.AddLightsData(light_data(light))
        fails(f, *words)

    for value in (nan, inf, -1.0):
        refused(sky(value), f"Intensity[0] = {value:g}")
        refused(sky(1.0, 1, pixels=[[1.0, value]]), "EnvironmentMap")
        refused(sky(1.0, 3, GroundRadiance=value), "GroundRadiance")
    refused(sky(1.0, 7), "SkyModel")
    refused(sky(1.0, 1), "EnvironmentMap")
    refused(sky(1.0, 2, SkyCoefficients=(nan, 0, 0, 0, 0), SunDirection=(0, 0, 1)), "SkyCoefficients")
    refused(sky(1.0, 2, SkyCoefficients=(-1, -0.5, 5, -3, 0.3), SunDirection=(0, 0, 0)), "SunDirection")
    refused(sky(1.0, 0, (0, 0, 0)), "Direction")
    refused(sky(1.0, 0, (0, nan, 0)), "Direction")
    light = sky(1.0, 1, pixels=np.ones((2, 4)))
    light.field["EnvironmentMap<k>Size"] = np.array([4, 3], np.int32)
    refused(light, "EnvironmentMap")


run_all(globals())
