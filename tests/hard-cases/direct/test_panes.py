# SPDX-License-Identifier: BSD-3-Clause
"""Light through surfaces with Transmittance in hard places: seams and corners of panes, panes twice in
the file, a billionth apart, in a closed glass box, of 0 and 1, in 64 bands. What passes is an exact
power of the transmittance of what arrives without them."""
from math import nan

import numpy as np
from hardcases import (KINDS, POINTS, SAMPLED, Run, area, box, cell, close, fails, grid, joined, light_data, luminaire,
                       LOPSIDED, mesh, point, polydata, rotation, run_all, sensors, sky, spot, sun,
                       with_cells)
from vtkradiometry import vtkIrradianceFilter

T = 0.3
UTM = (5e5, 4e6, 0.0)
LIGHTS = {"point": point((0.31, 0.22, 2.0), 5.0), "spot": spot((0.31, 0.22, 2.0), (0, 0, -1), 80.0, 1.0, 7.0),
          "sun": sun((0.1, -0.2, -0.9), 3.0), "web": luminaire((0.31, 0.22, 2.0), *LOPSIDED, 6.0),
          "area": area([(0, 0, 2), (0, 0.5, 2), (0.6, 0.5, 2), (0.6, 0, 2)], 8.0)}


def glass(points, polygons, share=T, **more):
    data = polydata(points, polygons)
    share = np.asarray(share, float)
    values = np.full(len(polygons), share) if share.ndim == 0 else np.tile(share, (len(polygons), 1))
    return with_cells(data, Transmittance=values, DiffuseReflectance=np.zeros(len(polygons)), **more)


def floor(n=3):
    return grid((-1, -1, 0), (2, 0, 0), (0, 2, 0), n, n)


def agree(run, bare, factor):
    allowed = run.error + factor * bare.error + 1e-12 * bare.e.max()
    assert (np.abs(run.e - factor * bare.e) <= allowed).all(), np.abs(run.e - factor * bare.e).max()


def test_one_pane_passes_its_share_at_every_seam_and_corner():
    """Sensors below the pane's own edges, diagonals and corners: nothing counted twice or not at all."""
    for seed, shift in ((0, (0, 0, 0)), (1, (0, 0, 0)), (2, UTM)):
        turn = rotation(seed)
        p, q = grid((-3, -3, 1), (6, 0, 0), (0, 6, 0), 12, 12)
        pane = glass(p @ turn.T + shift, q)
        # Under the sun straight down: below corners (0.5 k), edges, diagonals and between.
        places = np.array([(x, y, 0) for x in (-1, -0.5, 0, 0.25, 0.31) for y in (-1, -0.25, 0, 0.25, 0.5)])
        grid_of_sensors = sensors(places @ turn.T + shift, turn @ (0, 0, 1))
        e = Run(grid_of_sensors, sun((0, 0, -1), 4.0).moved(turn), pane).e
        close(e, np.full(e.shape, 4.0 * T), 1e-12)
        for name, light in LIGHTS.items():
            moved = light.moved(turn, 1.0, shift)
            agree(Run(grid_of_sensors, moved, pane), Run(grid_of_sensors, moved), T)


def test_cells_below_a_pane_of_any_mesh():
    for n in (1, 2, 7):
        pane = glass(*grid((-9, -9, 1), (18, 0, 0), (0, 18, 0), n, n))
        for name, light in LIGHTS.items():
            for location in (0, POINTS):
                run = Run(polydata(*floor()), light, pane, SampleLocation=location)
                agree(run, Run(polydata(*floor()), light, SampleLocation=location), T)


def test_a_pane_twice_in_the_file_is_one_and_two_panes_are_two():
    sheet = grid((-9, -9, 1), (18, 0, 0), (0, 18, 0))
    back = (sheet[0], [c[::-1] for c in sheet[1]])
    other_diagonal = (sheet[0], [c[1:] + c[:1] for c in sheet[1]])
    for light in LIGHTS.values():
        bare = Run(polydata(*floor()), light)
        for twin in (sheet, back, other_diagonal):
            agree(Run(polydata(*floor()), light, glass(*joined(sheet, twin))), bare, T)
        for gap in (1e-3, 1e-6, 1e-9):
            apart = (sheet[0] + (0, 0, gap), sheet[1])
            agree(Run(polydata(*floor()), light, glass(*joined(sheet, apart))), bare, T * T)


def test_transmittance_0_is_opaque_and_1_is_not_there():
    sheet = grid((-0.5, -0.3, 1), (0.7, 0, 0), (0, 0.9, 0.1), 2, 2)
    for light in LIGHTS.values():
        bare = Run(polydata(*floor()), light)
        opaque = Run(polydata(*floor()), light, polydata(*sheet))
        none = Run(polydata(*floor()), light, glass(*sheet, 0.0))
        agree(none, opaque, 1.0)
        agree(Run(polydata(*floor()), light, glass(*sheet, 1.0)), bare, 1.0)
        # Between: what the shadow takes, times 1 - T.
        run = Run(polydata(*floor()), light, glass(*sheet), RelativeTolerance=1e-4)
        mixed = T * bare.e + (1 - T) * opaque.e
        allowed = run.error + bare.error + opaque.error + 1e-12
        assert (np.abs(run.e - mixed) <= allowed).all()
        assert opaque.e.sum() < 0.99 * bare.e.sum()


def test_a_closed_glass_box_from_outside_and_from_inside():
    for seed in (0, 3):
        turn = rotation(seed)
        for n in (1, 4):
            p, q = box((-2, -2, -1), (2, 2, 1.5), n)
            shell = glass(p @ turn.T, q)
            inside = polydata(floor()[0] @ turn.T, floor()[1])
            for name, light in LIGHTS.items():
                moved = light.moved(turn)
                agree(Run(inside, moved, shell), Run(inside, moved), T)
            bare = Run(inside, sky(2.0))
            run = Run(inside, sky(2.0), shell, RelativeTolerance=0.05)
            assert (np.abs(run.e - T * bare.e) <= run.error + 1e-9).mean() >= 0.9, run.e
            # A light inside sees a sensor outside through one wall, whichever wall it is.
            places = np.array([(3, 0.1, 0.2), (-3, 1, 0), (0, 0, 4), (0.4, -3, 0.1), (3, 3, 3)])
            normals = -places / np.linalg.norm(places, axis=1)[:, None]
            grid_of_sensors = sensors(places @ turn.T, normals @ turn.T)
            lamp = point((0, 0, 0), 5.0)
            close(Run(grid_of_sensors, lamp, shell).e, T * Run(grid_of_sensors, lamp).e, 1e-12)


def test_a_glass_box_hides_nothing_behind_opaque_walls():
    """Opaque box in a glass box: exactly nothing inside."""
    for n in (1, 3):
        room = polydata(*box(inward=True, n=n))
        shell = glass(*box((-0.5, -0.5, -0.5), (1.5, 1.5, 1.5), n))
        for light in (point((-1e-4, 0.3, 0.4)), point((0.2, 1 + 1e-4, 0.5)), sun((1, 1, -1)), sky(1.0)):
            run = Run(room, light, shell)
            assert (run.e == 0).all(), run.e.max()


def test_panes_of_64_bands():
    shares = np.linspace(0.0, 1.0, 64)
    sheet = grid((-9, -9, 1), (18, 0, 0), (0, 18, 0))
    for name, light in LIGHTS.items():
        run = Run(polydata(*floor()), light, glass(*sheet, shares))
        bare = Run(polydata(*floor()), light)
        agree(run, type("R", (), dict(e=np.repeat(bare.e, 64, 1), error=np.repeat(bare.error, 64, 1))),
              shares[None, :])


def test_a_cell_that_is_glass_receives_all_itself():
    """A pane does not shadow itself, nor do cells of its plane."""
    p, q = floor(4)
    for light in LIGHTS.values():
        close(Run(glass(p, q), light).e, Run(polydata(p, q), light).e, 1e-12, 1e-12)


def test_many_sheets():
    """Twenty panes: T^20, though each ray crosses twenty."""
    sheets = joined(*[grid((-9, -9, 0.1 + 0.05 * k), (18, 0, 0), (0, 18, 0)) for k in range(20)])
    for name in ("point", "sun", "spot"):
        run = Run(polydata(*floor()), LIGHTS[name], glass(*sheets, 0.9))
        close(run.e, 0.9**20 * Run(polydata(*floor()), LIGHTS[name]).e, 1e-11)


def test_bad_transmittance_is_refused():
    for value in (-0.1, 1.5, nan):
        f = vtkIrradianceFilter()
        f.SetInputData(glass(*floor(1), value))
        f.AddLightsData(light_data(LIGHTS["sun"]))
        fails(f, "Transmittance[0]")
        f = vtkIrradianceFilter()  # of a blocker too
        f.SetInputData(polydata(*floor(1)))
        f.AddOccludersData(glass(*floor(1), value))
        f.AddLightsData(light_data(LIGHTS["sun"]))
        fails(f, "Transmittance[0]")
    data = glass(*floor(1), 0.6)
    with_cells(data, DiffuseReflectance=np.array([0.5]))
    f = vtkIrradianceFilter()
    f.SetInputData(data)
    f.AddLightsData(light_data(LIGHTS["sun"]))
    fails(f, "at most 1")


def test_threads():
    p, q = grid((-0.5, -0.3, 1), (0.7, 0, 0), (0, 0.9, 0.1), 2, 2)
    pane = glass(p, q)
    for light in LIGHTS.values():
        runs = [Run(polydata(*floor()), light, pane, NumberOfThreads=t).bytes() for t in (1, 2, 7)]
        assert runs[0] == runs[1] == runs[2]


run_all(globals())
