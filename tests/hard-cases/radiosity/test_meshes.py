# SPDX-License-Identifier: BSD-3-Clause
"""Meshes as they come: slivers, duplicated faces, mixed orientation, T-junctions, parts that see nothing
of each other, next to nothing at all; and a memory limit that nothing fits in."""
import re

import numpy as np
from hardcases import (METHODS, Errors, Solved, areas_of, box, close, fails, grid, joined, light_data, mesh, point,
                       polydata, run_all, sun, with_cells)
from vtkradiometry import vtkRadiosityFilter

LAMP = (0.4, 0.45, 0.6)
FLUX = 4.0 * np.pi


def test_a_box_of_slivers():
    """Walls cut into strips of 1 : 1e5 among wide ones: energy is kept, and the mean is the lamp's."""
    def wall(o, a, b):
        cuts = np.array([0.0, 1e-5, 0.3, 0.3 + 1e-5, 0.7, 1.0])
        o, a, b = (np.asarray(v, float) for v in (o, a, b))
        points = np.array([o + s * a + t * b for t in (0.0, 1.0) for s in cuts])
        n = len(cuts)
        return points, [(i, i + 1, n + i + 1, n + i) for i in range(n - 1)]

    x, y, z = np.eye(3)
    o = np.zeros(3)
    points, cells = joined(wall(o, x, y), wall(z, y, x), wall(o, z, x), wall(y, x, z), wall(o, y, z),
                           wall(x, z, y))
    areas = areas_of(points, cells)
    for rho in (0.5, 0.99):
        for method in METHODS.values():
            run = Solved(polydata(points, cells), point(LAMP), Method=method, Refinement=2,
                         DiffuseReflectance=rho, RelativeTolerance=0.02)
            close(run.mean(areas), FLUX / 6.0 / (1.0 - rho), 1e-6)


def test_duplicated_faces_make_no_light():
    """Every wall twice: whatever is told of each copy, no light is made: what a cavity of total area S
    absorbs is what the lamp sends, on at most twice that."""
    points, cells = box(n=2, inward=True)
    twice = cells + cells
    areas = areas_of(points, twice)
    for rho in (0.5, 0.99):
        for method in METHODS.values():
            run = Solved(polydata(points, twice), point(LAMP), Method=method, Refinement=2,
                         DiffuseReflectance=rho, RelativeTolerance=0.05)
            absorbed = (1.0 - rho) * (areas @ run.e[:, 0])
            slack = (1.0 - rho) * (areas @ run.error[:, 0])
            # MonteCarlo balances no energy where faces share what is sent to them.
            rays = method == METHODS["MonteCarlo"]
            made = 0.05 if rays else 1e-6
            assert absorbed <= 2.0 * FLUX * (1 + made) + slack, (rho, method, absorbed / FLUX)
            if rays and rho > 0.9:
                continue  # its small imbalance, times a hundred reflections, is not in its error
            single = Solved(polydata(points, cells), point(LAMP), Method=method, Refinement=2,
                            DiffuseReflectance=rho, RelativeTolerance=0.05)
            n = len(cells)
            for copy in (slice(0, n), slice(n, 2 * n)):
                off = np.abs(run.e[copy] - single.e)
                assert (off <= run.error[copy] + single.error).mean() >= 0.95, (rho, method)


def test_two_sided_faces_that_lie_turned_on_others():
    """A sheet across a box, given once as it is and once turned: front and back trade names."""
    room = box(n=2, inward=True)
    sheet = grid((0.5, 0.1, 0.1), (0, 0.8, 0), (0, 0, 0.8), 2, 2)
    points, cells = joined(room, sheet)
    n, m = len(room[1]), len(sheet[1])
    turned = cells + [c[::-1] for c in cells[n:]]
    two = np.r_[np.zeros(n), np.ones(m)]
    for method in METHODS.values():
        options = dict(Method=method, DiffuseReflectance=0.6, RelativeTolerance=0.05)
        once = Solved(with_cells(polydata(points, cells), TwoSided=two), point(LAMP), **options)
        twice = Solved(with_cells(polydata(points, turned), TwoSided=np.r_[two, np.ones(m)]),
                       point(LAMP), **options)
        (back, back_error), (back2, back2_error) = (
            run.values(run.output, back=True) for run in (once, twice))
        for e, error, as_e, as_error in (
                (twice.e[n:n + m], twice.error[n:n + m], once.e[n:], once.error[n:]),
                (twice.e[n + m:], twice.error[n + m:], back[n:], back_error[n:]),
                (back2[n + m:], back2_error[n + m:], once.e[n:], once.error[n:])):
            assert (np.abs(e - as_e) <= error + as_error).all(), (method, e, as_e)


def test_mixed_orientation_receives_on_fronts_only():
    """Every other cell turned: it shows its dark back. Its front sees nothing, and it gets nothing."""
    points, cells = box(n=2, inward=True)
    turned = [c[::-1] if k % 2 else c for k, c in enumerate(cells)]
    for method in METHODS.values():
        run = Solved(polydata(points, turned), point(LAMP), Method=method, DiffuseReflectance=0.5,
                     RelativeTolerance=0.05)
        assert (run.e[1::2] == 0.0).all() and (run.e[0::2] > 0.0).all()
        # Two-sided, the turning changes nothing: front and back trade names.
        flat = Solved(polydata(points, cells), point(LAMP), Method=method, DiffuseReflectance=0.5,
                      TwoSided=True, RelativeTolerance=0.05)
        both = Solved(polydata(points, turned), point(LAMP), Method=method, DiffuseReflectance=0.5,
                      TwoSided=True, RelativeTolerance=0.05)
        back, back_error = both.values(both.output, back=True)
        e = np.where(np.arange(len(cells))[:, None] % 2 == 1, back, both.e)
        error = np.where(np.arange(len(cells))[:, None] % 2 == 1, back_error, both.error)
        assert (np.abs(e - flat.e) <= error + flat.error).mean() >= 0.95, method


def test_t_junctions_leak_no_more_than_the_error_says():
    """A dark room beside a lit one; their wall is cut 3 x 3 on one half and 2 x 5 on the other, so that
    edges do not meet. Nothing may come through."""
    lit = box((0, 0, 0), (1, 1, 1), 2, True, faces=(0, 1, 2, 3, 4))
    wall = joined(grid((1, 0, 0), (0, 0, 1), (0, 0.437, 0), 3, 3),
                  grid((1, 0.437, 0), (0, 0, 1), (0, 0.563, 0), 2, 5))
    dark = box((1, 0, 0), (2, 1, 1), 2, True, faces=(0, 1, 2, 3, 5))
    points, cells = joined(lit, wall, dark)
    first = len(lit[1]) + len(wall[1])
    for method in METHODS.values():
        run = Solved(polydata(points, cells), point(LAMP), Method=method, DiffuseReflectance=0.7,
                     RelativeTolerance=0.02, Occlusion=1)
        leak = run.e[first:, 0]
        bright = run.e[:first, 0].mean()
        assert (leak <= run.error[first:, 0]).all(), (method, leak.max(), run.error[first:, 0].min())
        assert leak.max() <= 1e-3 * bright, (method, leak.max() / bright)


def test_isolated_components():
    """Three boxes far apart, one lamp: what has no light stays black, what has is as if alone."""
    parts = [box((k * 5.0, 0, 0), (k * 5.0 + 1, 1, 1), 2, True) for k in range(3)]
    points, cells = joined(*parts)
    n = len(parts[0][1])
    for method in METHODS.values():
        alone = Solved(polydata(*parts[0]), point(LAMP), Method=method, Refinement=2,
                       DiffuseReflectance=0.8, RelativeTolerance=0.02)
        run = Solved(polydata(points, cells), point(LAMP), Method=method, Refinement=2,
                     DiffuseReflectance=0.8, RelativeTolerance=0.02)
        assert (run.e[n:] == 0.0).all(), method
        close(run.mean(np.r_[areas_of(*parts[0]), np.zeros(2 * n)]), alone.mean(areas_of(*parts[0])),
              1e-6)
        assert (np.abs(run.e[:n] - alone.e) <= run.error[:n] + alone.error).mean() >= 0.95


def test_no_cell_one_cell_two_cells():
    down = sun((0, 0, -1), 2.0)
    for method in METHODS.values():
        none = vtkRadiosityFilter()
        none.SetInputData(polydata([]))
        none.AddLightsData(light_data(down))
        none.SetMethod(method)
        watch = Errors(none)
        none.Update()
        assert not watch.messages and none.GetOutputDataObject(0).GetNumberOfCells() == 0
        one = Solved(mesh(grid((0, 0, 0), (1, 0, 0), (0, 1, 0))), down, Method=method)
        close(one.e, [[2.0]], 1e-12)
        corner = with_cells(mesh(grid((0, 0, 0), (1, 0, 0), (0, 1, 0)),
                                 grid((0, 0, 0), (0, 1, 0), (0, 0, 1))),
                            DiffuseReflectance=np.array([0.3, 0.0]))
        two = Solved(corner, down, Method=method, RelativeTolerance=0.01)
        expected = 0.6 * 0.200043776075403  # a black wall that shares the floor's edge
        assert abs(two.e[1, 0] - expected) <= two.error[1, 0], (method, two.e, two.error)
        assert abs(two.e[1, 0] - expected) <= 0.05 * expected


def test_black_and_unlit():
    for method in METHODS.values():
        data = mesh(box(n=2, inward=True))
        black = Solved(data, point(LAMP), Method=method, DiffuseReflectance=0.0)
        close((areas_of(*box(n=2, inward=True)) @ black.e).sum(), FLUX, 1e-9)
        unlit = Solved(data, Method=method, DiffuseReflectance=0.9)
        assert (unlit.e == 0.0).all() and (unlit.error == 0.0).all()


def test_a_memory_limit_too_small_names_what_would_do():
    points, cells = joined(box(n=12, inward=True), box((0.3, 0.3, 0.3), (0.6, 0.6, 0.6), 6))
    lights = light_data(point((0.2, 0.2, 0.8)))

    def limited(mebibytes, method):
        f = vtkRadiosityFilter()
        f.SetInputData(polydata(points, cells))
        f.AddLightsData(lights)
        f.SetMethod(method)
        f.SetRelativeTolerance(0.1)
        f.SetMemoryLimit(mebibytes)
        return f

    for method in (0, *METHODS.values()):
        text = fails(limited(0.001, method), "MemoryLimit", "at least", "MiB")
        least = float(re.search(r"at least ([0-9.]+) MiB", text).group(1))
        assert 0.001 < least < 1000.0, text
        f = limited(1.02 * least, method)
        f.Update()
        assert f.GetOutput(0).GetCellData().GetArray("Irradiance") is not None, (method, least)
        if least > 1.0:
            fails(limited(0.5 * least, method), "MemoryLimit")


def test_emission_off_the_mesh_of_a_lamp_shade():
    """A small emitter in a shade that is open below: the light that leaves is what is not absorbed."""
    shade = box((0.4, 0.4, 0.7), (0.6, 0.6, 0.9), 1, True, faces=(1, 2, 3, 4, 5))
    lamp = box((0.48, 0.48, 0.78), (0.52, 0.52, 0.82), 1)
    room = box(n=3, inward=True)
    points, cells = joined(room, shade, lamp)
    n, s = len(room[1]), len(shade[1])
    emitted = np.zeros(len(cells))
    emitted[n + s:] = 10.0
    rho = np.full(len(cells), 0.5)
    rho[n + s:] = 0.0
    areas = areas_of(points, cells)
    for method in METHODS.values():
        data = with_cells(polydata(points, cells), EmittedExitance=emitted, DiffuseReflectance=rho,
                          TwoSided=np.r_[np.zeros(n), np.ones(s), np.zeros(len(lamp[1]))])
        run = Solved(data, Method=method, RelativeTolerance=0.05)
        back, back_error = run.values(run.output, back=True)
        gone = ((1 - rho) * areas) @ (run.e[:, 0] + back[:, 0])
        allowed = ((1 - rho) * areas) @ (run.error[:, 0] + back_error[:, 0])
        sent = 10.0 * areas[n + s:].sum()
        assert abs(gone - sent) <= allowed, (method, gone, sent, allowed)
        assert abs(gone - sent) <= 0.05 * sent, (method, gone, sent)


run_all(globals())
