# SPDX-License-Identifier: BSD-3-Clause
"""Scenes with a published or closed answer: a crater under a low sun, the Globillum room, plates and
walls that share an edge."""
import numpy as np
from hardcases import (METHODS, Solved, areas_of, array, box, close, grid, joined, polydata, run_all, sensors, sun,
                       with_cells)


def crater(beta, rings, sectors):
    """The bowl of a sphere of radius 1 seen from above: points and cells, fronts inward."""
    theta = np.linspace(0.0, beta, rings + 1)
    points = [(0, 0, -1)]
    points += [(np.sin(t) * np.cos(f), np.sin(t) * np.sin(f), -np.cos(t)) for t in theta[1:]
               for f in 2 * np.pi * np.arange(sectors) / sectors]
    cells = []
    for i in range(sectors):
        j = (i + 1) % sectors
        cells.append((0, 1 + i, 1 + j))
        for r in range(rings - 1):
            a = 1 + r * sectors
            cells.append((a + i, a + sectors + i, a + sectors + j, a + j))
    return np.array(points), cells


def test_shadow_of_a_spherical_crater():
    """Ingersoll 1966: in a bowl every part sees every other alike, so the shadow is evenly lit:
    rho f (1 - f) F0 sin e0 / (1 - rho f), f = (1 - cos beta)/2, for a Lambertian bowl."""
    beta, elevation, rho, f0 = np.radians(25.0), np.radians(10.0), 0.3, 1000.0
    f = 0.5 * (1.0 - np.cos(beta))
    exact = rho * f * (1.0 - f) * f0 * np.sin(elevation) / (1.0 - rho * f)
    close(exact, 2.35925459, 1e-8)
    points, cells = crater(beta, 14, 56)
    light = sun((np.cos(elevation), 0.0, -np.sin(elevation)), f0)
    for method in METHODS.values():
        run = Solved(polydata(points, cells), light, Method=method, DiffuseReflectance=rho,
                     RelativeTolerance=0.01, Refinement=2, Occlusion=1)
        direct = Solved(polydata(points, cells), light, DiffuseReflectance=0.0)
        dark = direct.e[:, 0] == 0.0
        assert dark.sum() > 100
        areas = areas_of(points, cells)[dark]
        mean = areas @ run.e[dark, 0] / areas.sum()
        # Flat cells of an edge of h radii miss of the bowl (a share f of what they see) some h^2.
        facets = (beta / 14) ** 2 / f
        close(mean, exact, 1e-2)
        off = np.abs(run.e[dark, 0] - exact)
        assert (off <= run.error[dark, 0] + facets * exact).mean() >= 0.95, (method, off.max() / exact)


def test_globillum():
    """Ward and Rushmeier 1990: a room of 10 x 6 x 3 m, a square source of 0.5 m in the ceiling;
    radiosity of the ceiling along a wall, published to 1 to 5 %."""
    published = np.array([0.0113, 0.0131, 0.0140, 0.0149, 0.0151, 0.0155])
    hole = [(4.75, 2.75), (5.25, 3.25)]
    (x0, y0), (x1, y1) = hole
    ceiling = [((0, 0), (x0, 6)), ((x1, 0), (10, 6)), ((x0, 0), (x1, y0)), ((x0, y1), (x1, 6))]
    parts = [box((0, 0, 0), (10, 6, 3), 8, True, faces=(0, 2, 3, 4, 5))]
    parts += [grid((a[0], a[1], 3), (0, b[1] - a[1], 0), (b[0] - a[0], 0, 0), 6, 4) for a, b in ceiling]
    parts += [grid((x0, y0, 3), (0, y1 - y0, 0), (x1 - x0, 0, 0))]
    points, cells = joined(*parts)
    count = [len(part[1]) for part in parts]
    rho = np.full(len(cells), 0.5)
    rho[:64] = 0.3
    rho[count[0]:] = 0.7
    rho[-1] = 0.0
    emitted = np.zeros(len(cells))
    emitted[-1] = 31.416
    places = np.column_stack([np.full(6, 0.25), 0.25 + 0.5 * np.arange(6), np.full(6, 3.0)])
    data = with_cells(polydata(points, cells), DiffuseReflectance=rho, EmittedExitance=emitted)
    for method in METHODS.values():
        run = Solved(data, Method=method, RelativeTolerance=0.02)
        b = array(run.output.GetCellData(), "Radiosity")
        middle = np.array([np.mean(points[list(c)], axis=0) for c in cells])
        on_ceiling = np.arange(len(cells)) >= count[0]
        near = [np.flatnonzero(on_ceiling & (np.abs(middle[:, 0] - p[0]) < 0.7) &
                               (np.abs(middle[:, 1] - p[1]) < 0.8)) for p in places]
        for value, which in zip(published, near):
            found = b[which].mean()
            # The table's places lie between cells' centres, where the ceiling brightens inward.
            assert 0.85 * value <= found <= 1.2 * value, (method, value, found)


def test_squares_that_touch_are_right_on_the_coarsest_mesh():
    """OpenViewFactor needs 3.45e9 pairs for 0.17 % of squares that share an edge; one pair will do."""
    data = with_cells(polydata(*joined(grid((0, 0, 0), (1, 0, 0), (0, 1, 0)),
                                       grid((0, 0, 0), (0, 1, 0), (0, 0, 1)))),
                      EmittedExitance=np.array([1.0, 0.0]), DiffuseReflectance=np.zeros(2))
    for method in (METHODS["Dense"], METHODS.get("Hierarchical")):
        if method:
            run = Solved(data, Method=method, Refinement=2, RelativeTolerance=1e-6)
            close(run.e[1, 0], 0.200043776075403, 1e-6)


run_all(globals())
