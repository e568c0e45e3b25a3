# SPDX-License-Identifier: BSD-3-Clause
"""Closed cavities of uniform reflectance up to 0.999999: what stays inside has a closed form, whatever
the mesh: the area-mean irradiance is Phi / (S (1 - rho)), and B = M / (1 - rho) everywhere when all
emit alike."""
import numpy as np
from hardcases import (METHODS, Solved, areas_of, box, close, fails, joined, light_data, mesh, point,
                       polydata, run_all, with_cells)
from vtkradiometry import vtkRadiosityFilter

REFLECTANCES = (0.0, 0.5, 0.9, 0.99, 0.9999, 0.999999)
FLUX = 4.0 * np.pi  # of a point light of 1 W/sr


def ball(n=10, radius=1.0, inward=True):
    """Points and quads of a sphere; triangles at the poles are quads that lost a corner."""
    points = [(0, 0, radius)]
    points += [(radius * np.sin(t) * np.cos(f), radius * np.sin(t) * np.sin(f), radius * np.cos(t))
               for t in np.pi * np.arange(1, n) / n for f in np.pi * np.arange(2 * n) / n]
    points.append((0, 0, -radius))
    m, last, cells = 2 * n, len(points) - 1, []
    for i in range(m):
        j = (i + 1) % m
        cells.append((0, 1 + i, 1 + j))
        for r in range(n - 2):
            a = 1 + r * m
            cells.append((a + i, a + m + i, a + m + j, a + j))
        cells.append((last, 1 + (n - 2) * m + j, 1 + (n - 2) * m + i))
    return np.array(points), [c[::-1] if inward else c for c in cells]


SHAPES = {"cube": lambda: box(n=3, inward=True), "sphere": ball}


def test_a_lamp_inside_lights_the_mean_by_energy_alone():
    for name, shape in SHAPES.items():
        points, cells = shape()
        areas = areas_of(points, cells)
        centre = np.mean(points, axis=0) + (0.05, -0.08, 0.1)
        for method in METHODS.values():
            for rho in REFLECTANCES:
                run = Solved(polydata(points, cells), point(centre), Method=method, Refinement=2,
                             DiffuseReflectance=rho, RelativeTolerance=0.02)
                close(run.mean(areas), FLUX / areas.sum() / (1.0 - rho), 1e-6)
                assert (run.error[:, 0] > 0).all() or rho == 0.0, (name, method, rho)


def test_refined_cavities_lose_nothing():
    """Elements in the corners of a fine mesh see their neighbours at every distance: none may lose."""
    points, cells = box(n=2, inward=True)
    areas = areas_of(points, cells)
    for method in METHODS.values():
        for rho in (0.9999, 0.999999):
            run = Solved(polydata(points, cells), point((0.4, 0.45, 0.6)), Method=method,
                         DiffuseReflectance=rho, RelativeTolerance=0.02)
            close(run.mean(areas), FLUX / 6.0 / (1.0 - rho), 1e-6)


def test_uniform_emission_has_no_shape():
    for shape in SHAPES.values():
        points, cells = shape()
        for method in METHODS.values():
            for rho in REFLECTANCES:
                data = with_cells(polydata(points, cells), EmittedExitance=np.full(len(cells), 2.0))
                run = Solved(data, Method=method, Refinement=2, DiffuseReflectance=rho,
                             RelativeTolerance=0.02, Emission=1)
                b = run.e[:, 0] * rho + 2.0
                exact = 2.0 / (1.0 - rho)
                assert (np.abs(b - exact) <= rho * run.error[:, 0] + 1e-9 * exact).mean() >= 0.95
                close(b @ areas_of(points, cells) / areas_of(points, cells).sum(), exact, 1e-6)


def test_bands_of_every_reflectance_at_once():
    points, cells = box(n=2, inward=True)
    areas = areas_of(points, cells)
    rho = np.array(REFLECTANCES)
    data = with_cells(polydata(points, cells),
                      DiffuseReflectance=np.tile(rho, (len(cells), 1)))
    for method in METHODS.values():
        run = Solved(data, point((0.4, 0.5, 0.6), np.ones(len(rho))), Method=method, Refinement=2,
                     RelativeTolerance=0.05)
        close(areas @ run.e / areas.sum(), FLUX / 6.0 / (1.0 - rho), 1e-6)


def test_a_white_closed_cavity_with_light_explains_itself():
    for method in METHODS.values():
        f = vtkRadiosityFilter()
        f.SetInputData(mesh(box(n=2, inward=True)))
        f.AddLightsData(light_data(point((0.4, 0.5, 0.6))))
        f.SetDiffuseReflectance(1.0)
        f.SetMethod(method)
        fails(f, "DiffuseReflectance", "losed")
    # Without light there is a solution: nothing.
    for method in METHODS.values():
        run = Solved(mesh(box(n=2, inward=True)), Method=method, DiffuseReflectance=1.0)
        assert (run.e == 0.0).all()


def test_a_white_open_box_is_fine():
    """Five white sides: all that comes in leaves by the mouth. With a black lid it is what the lid
    absorbs: the flux of the lamp."""
    points, cells = box(n=3, inward=True)
    rho = np.ones(len(cells))
    lid = np.arange(9, 18)  # +z
    rho[lid] = 0.0
    areas = areas_of(points, cells)
    data = with_cells(polydata(points, cells), DiffuseReflectance=rho)
    for method in METHODS.values():
        run = Solved(data, point((0.4, 0.5, 0.6)), Method=method, Refinement=2,
                     RelativeTolerance=0.02)
        close(areas[lid] @ run.e[lid, 0], FLUX, 1e-6)
        open_box = Solved(mesh(box(n=3, inward=True, faces=(0, 2, 3, 4, 5))),
                          point((0.4, 0.5, 0.6)), Method=method, DiffuseReflectance=1.0,
                          RelativeTolerance=0.1)
        assert np.isfinite(open_box.e).all() and (open_box.e > 0).all()


def test_two_white_rooms_and_a_pinhole():
    """Each room is closed but for the hole: two slow modes. All that the lamp sends is absorbed."""
    left = box((0, 0, 0), (1, 1, 1), 3, True)
    right = box((1, 0, 0), (2, 1, 1), 3, True, faces=(0, 1, 2, 3, 5))
    points, cells = joined(left, right)
    wall = [k for k, c in enumerate(cells) if all(abs(points[i][0] - 1.0) < 1e-12 for i in c)]
    hole = wall[4]
    kept = [c for k, c in enumerate(cells) if k != hole]
    areas = areas_of(points, kept)
    for method in METHODS.values():
        for rho in (0.9, 0.9999):
            run = Solved(polydata(points, kept), point((0.4, 0.3, 0.6)), Method=method, Refinement=2,
                         TwoSided=True, DiffuseReflectance=rho, RelativeTolerance=0.05, Occlusion=1)
            back, _ = run.values(run.output, back=True)
            # Nothing leaves: each face absorbs on both sides (the walls' outsides are dark).
            absorbed = (1.0 - rho) * (areas @ run.e[:, 0] + areas @ back[:, 0])
            close(absorbed, FLUX, 1e-6)


run_all(globals())
