# SPDX-License-Identifier: BSD-3-Clause
"""Area lights in hard places: in the plane of the cell, on its edge, against it, edge-on, below the
horizon, far, thin, concave, bent, without area, flush with a wall. Against Lambert's contour formula
in 80 bits, view factors with closed forms, and energy."""
from math import pi

import numpy as np
from hardcases import (POINTS, Run, area, areas_of, box, cell, close, fails, grid, joined, light_data,
                       mesh, polydata, rotation, run_all, sensors, vector_area, with_points)
from vtkradiometry import vtkIrradianceFilter

SQUARE = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], float)
DOWN = SQUARE[::-1]  # the same, shining down
PARALLEL_AT_1 = 0.199824895698387   # unit squares facing at gap 1
SHARED_EDGE = 0.200043776075403     # unit squares at a right angle
# An error of 0 is not to be had where quadrature is needed: but 1e-6 is, when asked for.
FINE = dict(RelativeTolerance=1e-6)


def lambert(polygon, at, normal):
    """E/M at a point below which no corner is: Lambert's formula, in extended precision."""
    r = np.asarray(polygon, np.longdouble) - np.asarray(at, np.longdouble)
    n = np.asarray(normal, np.longdouble)
    total = np.longdouble(0)
    for a, b in zip(r, np.roll(r, -1, axis=0)):
        e = b - a
        c = np.array([a[1] * e[2] - a[2] * e[1], a[2] * e[0] - a[0] * e[2], a[0] * e[1] - a[1] * e[0]])
        s = np.sqrt((c * c).sum())
        if s > 0:
            total += np.arctan2(s, (a * b).sum()) * (c @ n) / s
    return abs(float(total)) / (2 * pi)


def surface(points=SQUARE):
    return polydata(points, [tuple(range(len(points)))])


def within(run, exact, relative=1e-5):
    """The value is within its error of the truth, and the error is small."""
    e, error = run.e[:, 0], run.error[:, 0]
    assert (np.abs(e - exact) <= error + 1e-9 * np.abs(exact)).all(), (e, exact, error)
    assert (error <= relative * np.abs(exact) + 1e-12).all(), (error, exact)


def test_a_light_in_the_plane_of_the_cell_gives_nothing():
    for seed in (0, 1, 2):
        turn = rotation(seed)
        for shift in ((1, 0, 0), (1.5, 0.2, 0), (0.3, 0.2, 0), (0, 0, 0), (1, 1, 0), (1e6, 0, 0)):
            for corners in (SQUARE, DOWN):
                light = area(corners + shift, 5.0, True).moved(turn)
                e = Run(polydata(SQUARE @ turn.T, [(0, 1, 2, 3)]), light).e[0, 0]
                assert e <= (0 if seed == 0 else 1e-14), (seed, shift, e)


def test_a_light_seen_edge_on_or_from_behind_gives_nothing():
    place = sensors([(0.5, 0.5, 0)], (0, 0, 1))
    for corners in ([(0.5, 0, 1), (0.5, 1, 1), (0.5, 1, 2), (0.5, 0, 2)],):  # its plane holds the place
        assert Run(place, area(corners, 1.0, True)).e[0, 0] <= 1e-16
    assert Run(place, area(SQUARE + (0, 0, 1))).e[0, 0] == 0.0  # shines up
    assert Run(place, area(DOWN + (0, 0, -1), 1.0, True)).e[0, 0] == 0.0  # below the horizon
    assert Run(surface(), area(SQUARE + (0, 0, 1))).e[0, 0] == 0.0


def test_view_factors_with_closed_forms():
    within(Run(surface(), area(DOWN + (0, 0, 1)), **FINE), PARALLEL_AT_1)
    wall = [(0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1)]  # shares the cell's edge x = 0; faces +x
    within(Run(surface(), area(wall), **FINE), SHARED_EDGE)
    # Half of it below the floor: that half is clipped, whatever the cell's centre sees.
    sunk = [(0, 0, -1), (0, 1, -1), (0, 1, 1), (0, 0, 1)]
    within(Run(surface(), area(sunk), **FINE), SHARED_EDGE)


def test_a_light_against_the_cell_gives_its_exitance():
    """Parallel squares at a small gap: F = 1 - 2 gap/side (perimeter) to first order."""
    for gap in (1e-3, 1e-6, 1e-9):
        run = Run(surface(), area(DOWN + (0, 0, gap), 3.0), **FINE)
        x = 1.0 / gap
        exact = 2 / (pi * x * x) * (0.5 * np.log((1 + x * x) ** 2 / (1 + 2 * x * x)) + 2 * x * np.sqrt(
            1 + x * x) * np.arctan(x / np.sqrt(1 + x * x)) - 2 * x * np.arctan(x))
        assert abs(run.e[0, 0] - 3 * exact) <= run.error[0, 0] + 1e-9, (gap, run.e, exact)
        assert abs(run.e[0, 0] - 3.0) <= 3 * 4 * gap + run.error[0, 0] + 1e-9
        middle = Run(sensors([(0.5, 0.5, 0)], (0, 0, 1)), area(DOWN + (0, 0, gap), 3.0)).e[0, 0]
        close(middle, 3 * lambert(DOWN + (0, 0, gap), (0.5, 0.5, 0), (0, 0, 1)), 1e-12)


def test_sensors_against_lamberts_formula():
    rng = np.random.default_rng(1)
    for h in (1e-9, 1e-3, 1.0, 1e3):
        panel = DOWN + (0, 0, h)
        places = np.column_stack([rng.uniform(-2, 3, (40, 2)), np.zeros(40)])
        run = Run(sensors(places, (0, 0, 1)), area(panel, 7.0))
        exact = np.array([7 * lambert(panel, p, (0, 0, 1)) for p in places])
        # Angles of a rim seen under next to no height add up to rounding of 2 pi, as it says.
        allowed = 1e-9 * exact + run.error[:, 0] + 7 * 1e-16
        assert (np.abs(run.e[:, 0] - exact) <= allowed).all(), (h, run.e, exact)
        assert (run.error[:, 0] <= 1e-9 * exact + 7e-14).all()


def test_on_an_edge_and_on_a_corner_of_the_light():
    """At the foot of a wall that shines, in the middle and at its end: half, a quarter of its plane
    angles. E/M = (1 - 1/sqrt(1 + h^2))/2-like closed forms come from Lambert's formula at 1e-9."""
    wall = np.array([(0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1)], float)
    for y in (0.5, 0.0, 1.0, 0.25):
        on = Run(sensors([(0, y, 0)], (0, 0, 1)), area(wall)).e[0, 0]
        near = lambert(wall, (1e-9, y, 0), (0, 0, 1))
        # In its plane it is not seen: 0; a hair before it, the formula. Either, and nothing else.
        assert on == 0 or abs(on - near) < 1e-6, (y, on, near)
        close(Run(sensors([(1e-9, y, 0)], (0, 0, 1)), area(wall)).e[0, 0], near, 1e-6)


def test_far_away():
    for r in (1e3, 1e6, 1e9):
        panel = DOWN - (0.5, 0.5, 0)
        run = Run(surface(SQUARE - (0.5, 0.5, 0)), area(panel + (0, 0, r), r * r * pi))
        close(run.e[0, 0], 1.0, 4 / r**2 + 1e-9)
        oblique = area(panel + (0.6 * r, 0, 0.8 * r), r * r * pi)
        close(Run(surface(SQUARE - (0.5, 0.5, 0)), oblique).e[0, 0], 0.64, 10 / r + 1e-9)


def test_a_million_times_larger_than_its_distance():
    huge = area(1e6 * (DOWN - (0.5, 0.5, 0)) + (0, 0, 1), 2.0)
    close(Run(sensors([(0, 0, 0)], (0, 0, 1)), huge).e[0, 0],
          2 * lambert(huge.position, (0, 0, 0), (0, 0, 1)), 1e-12)
    close(Run(surface(), huge, **FINE).e[0, 0], 2.0, 1e-5)


def test_concave_lights_are_the_sum_of_their_parts():
    arrow = np.array([(0, 0, 1), (0.5, 1, 1), (1, 0, 1), (0.5, 0.3, 1)], float)
    parts = [arrow[[0, 1, 3]], arrow[[1, 2, 3]]]
    for location in (0, POINTS):
        for two_sided in (False, True):
            whole = Run(surface(), area(arrow, 4.0, two_sided), SampleLocation=location, **FINE)
            halves = Run(surface(), [area(p, 4.0, two_sided) for p in parts],
                         SampleLocation=location, **FINE)
            allowed = whole.error + halves.error + 1e-9 * whole.e
            assert (np.abs(whole.e - halves.e) <= allowed).all() and whole.e.max() > 0
    places = sensors(np.random.default_rng(2).uniform(-1, 2, (30, 3)) * (1, 1, 0), (0, 0, 1))
    close(Run(places, area(arrow)).e, Run(places, [area(p) for p in parts]).e, 1e-10)


def test_all_light_lands_inside_a_closed_room():
    """M A per side, wherever the panel hangs: free, by a wall, in a corner, flush with the ceiling."""
    panels = {"free": DOWN * 0.4 + (0.3, 0.25, 0.7), "by a wall": DOWN * 0.4 + (1e-9, 0.25, 0.7),
              "in a corner": DOWN * 0.4 + (0, 0, 0.999), "below the ceiling": DOWN * 0.4 + (0.3, 0.3, 1 - 1e-9),
              "flush": DOWN * 0.4 + (0.3, 0.3, 1.0), "whole ceiling": DOWN + (0, 0, 1)}
    for n, seed in ((1, 0), (3, 1)):
        turn = rotation(seed)
        p, q = box(inward=True, n=n)
        p = p @ turn.T
        for name, corners in panels.items():
            if name in ("flush", "whole ceiling") and seed:
                continue  # turned, it is before or behind the ceiling by rounding
            a = np.linalg.norm(vector_area(corners))
            run = Run(polydata(p, q), area(corners, 5.0).moved(turn), RelativeTolerance=1e-3)
            flux = (run.e[:, 0] * areas_of(p, q)).sum()
            doubt = np.sqrt(((run.error[:, 0] * areas_of(p, q)) ** 2).sum())
            assert abs(flux - 5.0 * a) <= doubt + 1e-6 * a, (name, n, flux, 5 * a, doubt)
            assert doubt < 0.01 * a


def test_both_sides_send():
    p, q = box(inward=True, n=2)
    corners = DOWN * 0.3 + (0.3, 0.2, 0.45)
    one = Run(polydata(p, q), area(corners, 5.0), RelativeTolerance=1e-3)
    two = Run(polydata(p, q), area(corners, 5.0, True), RelativeTolerance=1e-3)
    up = Run(polydata(p, q), area(corners[::-1], 5.0), RelativeTolerance=1e-3)
    assert (np.abs(two.e - one.e - up.e) <= two.error + one.error + up.error + 1e-12).all()


def test_closed_boxes_stay_dark():
    rng = np.random.default_rng(3)
    for seed, n in ((0, 1), (0, 4), (4, 4), (5, 1)):
        turn = rotation(seed)
        p, q = box(inward=True, n=n)
        data = polydata(p @ turn.T, q)
        for gap in (1e-4, 1e-9):
            x, y = rng.uniform(0, 0.5, 2)
            around = [DOWN * 0.5 + (x, y, -gap), DOWN * 3 + (-1, -1, 1 + gap),
                      [(1 + gap, x, y), (1 + gap, x, y + 0.4), (1 + gap, x + 0.4, y)],
                      [(1 + gap, 1 + gap, 0), (1 + gap, 1 + gap, 1), (2, 2, 0.5)],
                      [(-gap, -0.5, 0.2), (-gap, 1.5, 0.2), (-gap, 1.5, 0.8)]]
            lights = [area(corners, 1.0, True).moved(turn) for corners in around]
            for location in (0, POINTS):  # any light that leaks shows in the sum
                run = Run(data, lights, SampleLocation=location)
                assert (run.e == 0).all(), (seed, n, gap, location, run.e.max())


def test_reciprocity_with_a_blocker():
    """What a shining square sends to another is what that one would send to it."""
    a = np.array([(0, 0, 0), (1, 0, 0), (1, 0.7, 0), (0, 0.7, 0)])
    b = np.array([(0.2, 1.1, 0.3), (1.3, 1.0, 0.4), (0.7, 0.9, 1.5)])
    blocker = polydata(*grid((0.3, 0.75, 0.1), (0.4, 0.1, 0), (0, 0, 0.5)))
    for corners in ((a, b), (a, b[::-1])):
        for shade in ([], [blocker]):
            one = Run(surface(corners[0]), area(corners[1]), shade, RelativeTolerance=1e-4)
            other = Run(surface(corners[1]), area(corners[0]), shade, RelativeTolerance=1e-4)
            areas = [np.linalg.norm(vector_area(c)) for c in corners]
            difference = abs(one.e[0, 0] * areas[0] - other.e[0, 0] * areas[1])
            assert difference <= (one.error[0, 0] * areas[0] + other.error[0, 0] * areas[1] + 1e-12)


def test_half_behind_a_wall():
    """A wall through the middle of light and cell, from one to the other: half with half."""
    wall = polydata([(0.5, -1, -1), (0.5, 2, -1), (0.5, 2, 2), (0.5, -1, 2)], [(0, 1, 2, 3)])
    halves = [polydata(*grid((x, 0, 0), (0.5, 0, 0), (0, 1, 0))) for x in (0, 0.5)]
    mine = [Run(h, area(DOWN * (0.5, 1, 1) + (x, 0, 1)), **FINE).e[0, 0]
            for h, x in zip(halves, (0, 0.5))]
    run = Run(surface(), area(DOWN + (0, 0, 1)), [wall], RelativeTolerance=1e-4)
    exact = 0.5 * sum(mine)
    assert abs(run.e[0, 0] - exact) <= run.error[0, 0] + 1e-6, (run.e, exact, run.error)


def test_a_screen_that_stands_inside_a_cell():
    """A tall screen of two faces on the middle of a floor cell, the lamp aside: its half of the floor is
    lit as without the screen, the other half is dark."""
    lamp = DOWN * (0.5, 0.5, 0) + (0.9, 0.25, 1.6)
    front = grid((0.5, -9, 0), (0, 19, 0), (0, 0, 9))
    back = grid((0.5, -9, 0), (0, 0, 9), (0, 19, 0))
    for floor in ([(0, 1, 2, 3)], [(0, 1, 2), (0, 2, 3)]):
        scene = mesh((SQUARE, floor), front, back)
        run = Run(scene, area(lamp), RelativeTolerance=1e-3)
        size = areas_of(SQUARE, floor)
        half = Run(surface(SQUARE * (0.5, 1, 1) + (0.5, 0, 0)), area(lamp), **FINE)
        flux, error = size @ run.e[:len(floor), 0], size @ run.error[:len(floor), 0]
        assert abs(flux - 0.5 * half.e[0, 0]) <= error + 0.5 * half.error[0, 0], (flux, half.e)
        assert error <= 0.01 * flux, (flux, error)


def test_lights_without_area_and_bent_ones():
    """No area: nothing, or an error that says so; a number is never made up."""
    for corners in ([(0, 0, 1), (1, 0, 1), (2, 0, 1)], [(0, 0, 1)] * 3,
                    [(0, 0, 1), (1, 1, 1), (1, 0, 1), (0, 1, 1)]):
        f = vtkIrradianceFilter()
        f.SetInputData(surface())
        f.AddLightsData(light_data(area(corners, 1.0, True)))
        errors = __import__("hardcases").Errors(f)
        f.Update()
        if not errors.messages:
            assert Run(surface(), area(corners, 1.0, True)).e[0, 0] == 0.0
        else:
            assert len(errors.messages) == 1 and "Polygons[0]" in errors.messages[0], errors.messages
    # Bent by less than rounding of its coordinates: as flat.
    bent = DOWN + (0, 0, 1) + np.array([(0, 0, 1e-15), (0, 0, 0), (0, 0, 1e-15), (0, 0, 0)])
    within(Run(surface(), area(bent), **FINE), PARALLEL_AT_1)


def test_points_of_no_polygon_are_an_error():
    data = light_data(area(DOWN + (0, 0, 1)))
    data.SetPolys(__import__("vtkmodules.vtkCommonDataModel", fromlist=["x"]).vtkCellArray())
    f = vtkIrradianceFilter()
    f.SetInputData(surface())
    f.AddLightsData(data)
    fails(f, "LightType[0] = 3")


def test_it_does_not_block_by_itself():
    with_panel = Run(surface(), [area(DOWN * 0.4 + (0.3, 0.3, 0.5)), area(DOWN + (0, 0, 1))], **FINE)
    alone = [Run(surface(), x, **FINE) for x in (area(DOWN * 0.4 + (0.3, 0.3, 0.5)), area(DOWN + (0, 0, 1)))]
    assert abs(with_panel.e - alone[0].e - alone[1].e) <= with_panel.error + sum(r.error for r in alone) + 1e-9


def test_emitting_surfaces_are_area_lights():
    """A surface with EmittedExitance shines like an area light of its shape, and blocks."""
    from hardcases import with_cells
    data = mesh((SQUARE, [(0, 1, 2, 3)]), (DOWN + (0, 0, 1), [(0, 1, 2, 3)]))
    with_cells(data, EmittedExitance=np.array([0.0, 6.0]))
    run = Run(data, [], **FINE)
    within(type("R", (), dict(e=run.e[:1], error=run.error[:1])), 6 * PARALLEL_AT_1)
    assert run.e[1, 0] == 0.0


run_all(globals())
