# SPDX-License-Identifier: BSD-3-Clause
"""Mirrors, glossy surfaces and panes in the radiosity filter: closed forms, plan, bad input."""
import math

import numpy as np
import vtkmodules.all as vtk
from checks import array, cell_values, close, fails, run_all, simulation, square, strings, sun
from rooms import areas, faces, grid, lamp, room, with_array
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkradiometry import (vtkAreaLightSource, vtkIrradianceFilter, vtkPointLightSource,
                           vtkRadiosityFilter)

AUTO, DENSE, HIERARCHICAL, MONTE_CARLO = range(4)
ON, OFF = 1, 2
MIRROR = 1e9
K = 683.002


def radiosity(data, *lights, **properties):
    return simulation(vtkRadiosityFilter, data, *lights, **properties)


def bulb(position, intensity=100.0):
    source = vtkPointLightSource()
    source.SetPosition(position)
    source.SetIntensity(intensity)
    return source


def row(f, effect):
    f.Update()
    plan = f.GetOutputDataObject(1)
    k = strings(plan, "Effect").index(effect)
    return (strings(plan, "Decision")[k], strings(plan, "Why")[k],
            plan.GetColumnByName("Bound").GetValue(k))


def optics(data, diffuse, specular, shininess=MIRROR):
    with_array(data, "DiffuseReflectance", diffuse)
    with_array(data, "SpecularReflectance", specular)
    return with_array(data, "Shininess", shininess)


def method(f):
    return array(f.GetOutput(0).GetFieldData(), "RadiometryMethod")[0]


def mean(f, name="Irradiance"):
    v = cell_values(f, name)
    a = areas(f.GetOutput(0))
    return (v * a).sum() / a.sum()


def beside_a_wall(mirror, n=6):
    """A floor at a large wall x = 0, which is a mirror or is not there."""
    parts = [((0, 0, 0), (2, 0, 0), (0, 2, 0))]
    data = faces(parts, n)
    if not mirror:
        return optics(data, 0.0, 0.0), n * n
    wall = faces([((0, -4, 0), (0, 10, 0), (0, 0, 5))], 1)
    append = vtk.vtkAppendPolyData()
    append.AddInputData(optics(data, 0.0, 0.0))
    append.AddInputData(optics(wall, 0.0, 0.9))
    append.Update()
    return append.GetOutput(), n * n


def test_a_mirror_is_a_second_lamp():
    for place in ((1.1, 0.8, 1.3), (0.2, 1.5, 0.4)):
        with_mirror, n = beside_a_wall(True)
        without, _ = beside_a_wall(False)
        f = radiosity(with_mirror, bulb(place))
        e = cell_values(f, "Irradiance")[:n]
        error = cell_values(f, "IrradianceError")[:n]
        exact = (cell_values(radiosity(without, bulb(place)), "Irradiance") +
                 0.9 * cell_values(radiosity(without, bulb((-place[0], *place[1:]))), "Irradiance"))
        assert (np.abs(e - exact) <= error + 1e-9).mean() >= 0.95
        close(e, exact, 0.01)
        decision, why, bound = row(f, "SpecularTransport")
        assert decision == "simulated" and bound == 0 and "specularly up to 0.9" in why, (decision, why)


def test_a_panel_in_a_mirror():
    def panel(x):
        source = vtkAreaLightSource()
        source.SetPosition(x, 1.0, 1.5)
        source.SetWidth(0.6)
        source.SetHeight(0.6)
        source.SetDirection(0, 0, -1)
        source.SetIntensity(50.0)
        return source

    with_mirror, n = beside_a_wall(True)
    without, _ = beside_a_wall(False)
    f = radiosity(with_mirror, panel(0.8))
    exact = (cell_values(radiosity(without, panel(0.8)), "Irradiance") +
             0.9 * cell_values(radiosity(without, panel(-0.8)), "Irradiance"))
    close(cell_values(f, "Irradiance")[:n], exact, 0.01)


def test_cavity_of_paint_and_mirror():
    # Any cavity: what is absorbed is what came, E = Phi/(S (1 - rho_d - rho_s)).
    for diffuse, specular in ((0.5, 0.3), (0.1, 0.8), (0.39, 0.6)):
        f = radiosity(optics(room(4, 3), diffuse, specular), lamp((1.7, 2.1, 3.0), 1000 * K),
                      RelativeTolerance=0.1)
        close(mean(f), 1000 / 96 / (1 - diffuse - specular), 0.02)
        assert method(f).startswith("MonteCarlo"), method(f)


def test_a_lossless_cavity_is_an_error():
    light = lamp((1.7, 2.1, 3.0), 1000)
    message = fails(radiosity(optics(room(4, 2), 0.5, 0.5), light, RelativeTolerance=0.3),
                    "closed cavity")
    assert "absorbs none" in message or "no" in message
    fails(radiosity(optics(room(4, 2), 0.0, 1.0), light, RelativeTolerance=0.3),
          "SpecularReflectance")


def test_panes_pass_what_surfaces_send():
    # Two plates and a pane between: the lower shines, the upper gets tau of it.
    plates = faces([((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((0, 0, 1), (0, 1, 0), (1, 0, 0))], 4)
    glow = np.r_[np.full(16, 7.0), np.zeros(16)]
    data = with_array(optics(plates, 0.0, 0.0), "EmittedExitance", glow)
    bare = cell_values(radiosity(data, RelativeTolerance=0.02), "Irradiance")
    pane = with_array(faces([((-9, -9, 0.5), (19, 0, 0), (0, 19, 0))], 1), "Transmittance", 0.6)
    f = radiosity(data, RelativeTolerance=0.02)
    f.AddOccludersData(pane)
    e = cell_values(f, "Irradiance")
    close(e[16:].mean(), 0.6 * bare[16:].mean(), 0.02)
    decision, why, bound = row(f, "Transmission")
    assert decision == "simulated" and bound == 0 and "surfaces send" in why, (decision, why, bound)
    f = radiosity(data, Method=DENSE)
    f.AddOccludersData(pane)
    _, why, bound = row(f, "Transmission")
    assert bound > 0 and "MonteCarlo" in why, (why, bound)


def test_off_bounds_what_mirrors_add():
    with_mirror, n = beside_a_wall(True)
    light = bulb((0.3, 1.0, 0.5))
    full = cell_values(radiosity(with_mirror, light), "Irradiance")
    f = radiosity(with_mirror, light, SpecularTransport=OFF)
    less = cell_values(f, "Irradiance")
    decision, why, bound = row(f, "SpecularTransport")
    assert decision != "simulated" and "switched off" in why
    assert bound >= (full - less).max() > 1.0, (bound, (full - less).max())
    assert math.isfinite(bound)
    # The direct filter never follows them, and says by how much that may matter.
    direct = simulation(vtkIrradianceFilter, with_mirror, light)
    assert row(direct, "SpecularTransport")[2] >= (full - less).max()
    # Methods of pairs do not either.
    dense = radiosity(with_mirror, light, Method=DENSE)
    decision, why, bound = row(dense, "SpecularTransport")
    assert "MonteCarlo" in why and bound >= (full - less).max(), why
    close(cell_values(dense, "Irradiance"), less, 1e-6)


def test_a_hollow_mirror_gathers_light_within_the_bound():
    # A bowl that throws a beam on a small plate: far more than the beam itself.
    points, cells = [], []
    rings, around, focus = 8, 24, 1.0
    for j in range(rings + 1):
        r = 0.05 + 0.95 * j / rings
        for i in range(around):
            a = 2 * math.pi * i / around
            points.append((r * math.cos(a), r * math.sin(a), r * r / (4 * focus)))
    for j in range(rings):
        for i in range(around):
            p, q = j * around + i, j * around + (i + 1) % around
            cells.append((p, p + around, q + around))
            cells.append((p, q + around, q))
    bowl = optics(grid(points, cells), 0.0, 0.8)
    plate = optics(faces([((-0.1, -0.1, 1.0), (0, 0.2, 0), (0.2, 0, 0))], 2), 0.0, 0.0)
    append = vtk.vtkAppendPolyData()
    append.AddInputData(plate)
    append.AddInputData(bowl)
    append.Update()
    light = sun((0, 0, -1), 100.0)
    f = radiosity(append.GetOutput(), light, RelativeTolerance=0.05)
    gathered = (cell_values(f, "Irradiance") * areas(f.GetOutput(0)))[:4].sum()
    # The bowl's opening less the hole in it and the shadow of the plate.
    power = 0.8 * 100.0 * (12 * math.sin(math.pi / 12) * (1.0 - 0.05 ** 2) - (0.04 - 12 * math.sin(math.pi / 12) * 0.05 ** 2))
    close(gathered, power, 0.15)
    off = radiosity(append.GetOutput(), light, SpecularTransport=OFF)
    change = np.abs(cell_values(f, "Irradiance") - cell_values(off, "Irradiance")).max()
    assert change > 500.0
    assert row(off, "SpecularTransport")[2] >= change


def test_faint_gloss_is_left_out():
    data = optics(room(4, 2), 0.3, 1e-5, 20.0)
    light = lamp((1.7, 2.1, 3.0), 1000)
    decision, why, bound = row(radiosity(data, light), "SpecularTransport")
    assert decision == "dropped" and bound > 0 and "beside the tolerance" in why
    decision, why, bound = row(radiosity(data, light, SpecularTransport=ON), "SpecularTransport")
    assert decision == "simulated" and bound == 0


def test_points_and_sensors_see_mirrors():
    with_mirror, n = beside_a_wall(True)
    place = (1.1, 0.8, 1.3)
    f = radiosity(with_mirror, bulb(place), SampleLocation=1)
    f.Update()
    out = f.GetOutputDataObject(0)
    e = array(out.GetPointData(), "Irradiance")
    xyz = np.array([out.GetPoint(i) for i in range(out.GetNumberOfPoints())])
    floor = (xyz[:, 2] == 0) & (xyz[:, 0] > 0.2) & (np.arange(len(xyz)) < 49)
    exact = np.zeros(len(xyz))
    for share, x in ((1.0, place[0]), (0.9, -place[0])):
        way = np.array((x, *place[1:])) - xyz
        exact += share * 100.0 * way[:, 2] / np.linalg.norm(way, axis=1) ** 3
    close(e[floor], exact[floor], 0.01)


def test_bad_shininess_is_refused():
    light = bulb((1, 1, 1))
    for name in ("Shininess", "BackShininess"):
        for bad in (math.nan, -1.0):
            data = with_array(square(2), name, [1.0, 2.0, bad, 3.0])
            fails(radiosity(data, light), f"{name}[2] = {bad:g}", "at least 0")
    two = square(1)
    a = numpy_to_vtk(np.ones((1, 2)), deep=True)
    a.SetName("Shininess")
    two.GetCellData().AddArray(a)
    fails(radiosity(two, light), "Shininess", "2 components")
    # Infinite, huge and nothing at all are mirrors, and gloss.
    for fine in (math.inf, 1e300, 0.0):
        cell_values(radiosity(with_array(square(1), "Shininess", fine), light), "Irradiance")


if __name__ == "__main__":
    run_all(globals())
