# SPDX-License-Identifier: BSD-3-Clause
"""Luminaires with a candela web in hard places. Oracles: a constant web is a point light; the bilinear
interpolant in the two angles written down here; all of its flux lands inside a closed room."""
from math import inf, nan, pi

import numpy as np
from hardcases import (LOPSIDED, Run, areas_of, box, cell, close, fails, grid, interpolant, light_data, luminaire,
                       point, polydata, rotation, run_all, sensors, solid_angle)
from vtkradiometry import vtkIrradianceFilter

SQUARE = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
CONSTANT = ([0.0], [0.0, 180.0], [[1.0, 1.0]])
# A hard edge at 60 degrees, and a narrow beam: steps of the web inside a cell.
NARROW = ([0.0], [0.0, 2.0, 2.001, 180.0], [[1.0, 1.0, 0.0, 0.0]])


def square():
    return polydata(SQUARE, [(0, 1, 2, 3)])


def test_a_constant_web_is_a_point_light_wherever_it_stands():
    for place in ((0, 0, 1), (0.3, -0.7, 1e-9), (1, 0.2, 1e-6), (-1, -1, 1e-3), (0.2, 0.1, 1e9),
                  (3, 0.5, 1e-6), (0.1, 0.2, 1e3)):
        for axis in ((0, 0, -1), (1, 0, 0), (0.3, -0.2, 0.9)):
            run = Run(square(), luminaire(place, *CONSTANT, 5.0, axis, (0.1, 1, 0.3)))
            exact = (5 * solid_angle(SQUARE, place) / 4 if place[2] > 1e-8 else
                     cell(square(), point(place, 5.0)))
            # Seen under next to no angle, what the rim integral loses is in its error.
            assert abs(run.e[0, 0] - exact) <= 1e-10 * exact + run.error[0, 0], (place, axis)
            assert run.error[0, 0] <= 1e-5 * exact, (place, axis, run.error)


def test_in_the_plane_of_the_cell_it_gives_nothing():
    for seed in (0, 1):
        turn = rotation(seed)
        for place in ((3, 0, 0), (0.2, 0.1, 0), (1, 1, 0), (1e9, 0, 0)):
            light = luminaire(place, *LOPSIDED, 5.0).moved(turn)
            e = cell(polydata(np.array(SQUARE) @ turn.T, [(0, 1, 2, 3)]), light)
            assert e <= (0 if seed == 0 else 1e-15), (place, e)


def test_sensors_get_the_interpolant():
    rng = np.random.default_rng(1)
    places = rng.uniform((-3, -3, 0), (3, 3, 4), (200, 3))
    lamp = np.array((0.2, 0.3, 1.7))
    for web in (LOPSIDED, CONSTANT, NARROW):
        for axis, reference in (((0, 0, -1), (1, 0, 0)), ((0.4, -0.3, -0.6), (0, 1, 0.2))):
            to = lamp - places
            r = np.linalg.norm(to, axis=1)
            exact = 4.0 * interpolant(web, -to, axis, reference) / r**2
            run = Run(sensors(places, to / r[:, None]), luminaire(lamp, *web, 4.0, axis, reference))
            close(run.e[:, 0], exact, 1e-9, 1e-12)


def test_all_flux_lands_inside_a_closed_room():
    for web in (LOPSIDED, NARROW):
        # The interpolant's own flux: Gauss-Legendre between its nodes.
        horizontal, vertical, _ = web
        x, w = np.polynomial.legendre.leggauss(24)
        total = 0.0
        planes = np.append(horizontal, 360.0) if len(horizontal) > 1 else np.array([0.0, 360.0])
        for c0, c1 in zip(planes, planes[1:]):
            for g0, g1 in zip(vertical, vertical[1:]):
                c = np.radians(0.5 * (c0 + c1) + 0.5 * (c1 - c0) * x)
                g = np.radians(0.5 * (g0 + g1) + 0.5 * (g1 - g0) * x)
                C, G = np.meshgrid(c, g)
                d = np.column_stack([(np.sin(G) * np.cos(C)).ravel(), (np.sin(G) * np.sin(C)).ravel(),
                                     -np.cos(G).ravel()])
                weight = np.outer(w, w) * np.radians(g1 - g0) * np.radians(c1 - c0) / 4
                total += (weight.ravel() * interpolant(web, d, (0, 0, -1), (1, 0, 0)) * np.sin(G).ravel()).sum()
        for seed, n in ((0, 1), (2, 3)):
            turn = rotation(seed)
            p, q = box(inward=True, n=n)
            for place in ((0.5, 0.5, 0.5), (0.3, 0.7, 1 - 1e-9), (1e-4, 1e-4, 0.4)):
                light = luminaire(place, *web, 3.0).moved(turn)
                run = Run(polydata(p @ turn.T, q), light, RelativeTolerance=1e-4)
                flux = (run.e[:, 0] * areas_of(p, q)).sum()
                doubt = (run.error[:, 0] * areas_of(p, q)).sum()
                assert abs(flux - 3 * total) <= doubt + 1e-7 * total, (seed, place, flux, 3 * total)


def test_closed_boxes_stay_dark():
    rng = np.random.default_rng(2)
    for seed in (0, 3, 4):
        turn = rotation(seed)
        for n in (1, 5):
            p, q = box(inward=True, n=n)
            for gap in (1e-4, 1e-9):
                for _ in range(5):
                    place = rng.random(3)
                    a = rng.integers(3)
                    place[a] = 1 + gap if rng.random() < 0.5 else -gap
                    light = luminaire(place, *LOPSIDED, 1.0, 0.5 - place, (1, 2, 3)).moved(turn)
                    assert (Run(polydata(p @ turn.T, q), light).e == 0).all(), (seed, n, gap)


def test_a_step_of_the_web_inside_a_shadowed_cell():
    """The beam of a narrow web, half of it behind a plate: half of its flux."""
    floor = grid((-1, -1, 0), (2, 0, 0), (0, 2, 0))
    plate = grid((-3, -3, 1), (3, 0, 0), (0, 6, 0))  # covers x < 0
    light = luminaire((0, 0, 2.0), *NARROW, 10.0)
    whole = Run(polydata(*floor), light, RelativeTolerance=1e-5)
    half = Run(polydata(*floor), light, polydata(*plate), RelativeTolerance=1e-5)
    assert abs(half.e - 0.5 * whole.e)[0, 0] <= half.error[0, 0] + whole.error[0, 0] + 1e-9
    # The beam's flux: the cap of 2 degrees and next to nothing of the step.
    cap = 10 * 2 * pi * 2 * np.sin(np.radians(1.0)) ** 2
    assert 0 < whole.e[0, 0] * 4 - cap < 2e-3 * cap


def test_bad_webs_are_refused():
    def refused(horizontal, vertical, values, *words):
        f = vtkIrradianceFilter()
        f.SetInputData(square())
        f.AddLightsData(light_data(luminaire((0, 0, 1), horizontal, vertical, values)))
        fails(f, *words)

    refused([0.0], [0.0, 90.0], [[1.0, nan]], "PhotometricWeb0", "nan")
    refused([0.0], [0.0, 90.0], [[1.0, inf]], "PhotometricWeb0", "inf")
    refused([0.0], [0.0, 90.0], [[1.0, -1.0]], "PhotometricWeb0", "-1")
    refused([0.0], [0.0, 90.0], [[0.0, 0.0]], "PhotometricWeb0")
    refused([0.0], [90.0, 0.0], [[1.0, 1.0]], "PhotometricWeb0")
    refused([0.0], [0.0, 200.0], [[1.0, 1.0]], "PhotometricWeb0")
    refused([0.0], [0.0, 90.0], [[1.0, 1.0, 1.0]], "PhotometricWeb0")
    refused([0.0], [0.0], [[1.0]], "PhotometricWeb0")
    light = luminaire((0, 0, 1), *CONSTANT)
    data = light_data(light)
    data.GetFieldData().RemoveArray("PhotometricWeb0Vertical")
    f = vtkIrradianceFilter()
    f.SetInputData(square())
    f.AddLightsData(data)
    fails(f, "PhotometricWeb0")
    for bad in ((0, 0, 0), (nan, 0, 0)):
        f = vtkIrradianceFilter()
        f.SetInputData(square())
        f.AddLightsData(light_data(luminaire((0, 0, 1), *LOPSIDED, 1.0, bad)))
        fails(f, "Direction[0]")


run_all(globals())
