# SPDX-License-Identifier: BSD-3-Clause
"""Light through panes in the filters: Transmittance of surface and occluders, plan, bad input."""
import numpy as np
import vtkmodules.all as vtk
from checks import array, cell_values, close, fails, run_all, simulation, square, strings, sun
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkradiometry import vtkIrradianceFilter, vtkPointLightSource, vtkRadiosityFilter


def plane(resolution=1, size=2.0, z=0.0, center=(0.0, 0.0)):
    return square(resolution, size, (*center, z))


def add(data, name, values):
    a = numpy_to_vtk(np.asarray(values, float), deep=True)
    a.SetName(name)
    data.AddArray(a)


def pane(share, **place):
    """A pane whose whole block lets `share` through (field data)."""
    data = plane(**place)
    add(data.GetFieldData(), "Transmittance", [share])
    return data


def lamp(position=(0.2, 0.1, 3.0), intensity=10.0):
    source = vtkPointLightSource()
    source.SetPosition(position)
    source.SetIntensity(intensity)
    return source


def run(data, *lights, occluders=(), kind=vtkIrradianceFilter, **properties):
    f = simulation(kind, data, *lights, **properties)
    for o in occluders:
        f.AddOccludersData(o)
    return f


def values(*arguments, **properties):
    return cell_values(run(*arguments, **properties), "Irradiance").copy()


def row(f, effect):
    plan = f.GetOutputDataObject(1)
    k = strings(plan, "Effect").index(effect)
    return (strings(plan, "Decision")[k], strings(plan, "Why")[k],
            plan.GetColumnByName("Bound").GetValue(k))


def test_occluders_let_their_share_through():
    data = plane(4)
    bare = values(data, lamp())
    close(values(data, lamp(), occluders=[pane(0.25, size=8.0, z=1.0)]), 0.25 * bare, 1e-12)
    close(values(data, lamp(), occluders=[pane(0.25, size=8.0, z=1.0), pane(0.5, size=8.0, z=2.0)]),
          0.125 * bare, 1e-12)
    # By cell, and of three bands; the bands of the panes are those of the results.
    tinted = plane(2, size=8.0, z=1.0)
    add(tinted.GetCellData(), "Transmittance", [[0.5, 0.25, 0.0]] * 4)
    got = values(data, lamp(), occluders=[tinted])
    assert got.shape == (16, 3)
    close(got, bare[:, None] * np.array([0.5, 0.25, 0.0]), 1e-12)
    # A block among others without the array.
    blocks = vtk.vtkMultiBlockDataSet()
    blocks.SetBlock(0, plane(size=0.5, z=0.5))
    blocks.SetBlock(1, pane(0.25, size=8.0, z=1.0))
    got = values(data, lamp(), occluders=[blocks])
    close(got, 0.25 * values(data, lamp(), occluders=[plane(size=0.5, z=0.5)]), 1e-12)


def test_panes_of_the_surface_receive_and_transmit():
    # Floor and pane in one block: the pane gets all of the light on its front, the floor its rest.
    both = vtk.vtkAppendPolyData()
    both.AddInputData(plane(1))
    both.AddInputData(plane(1, size=8.0, z=1.0))
    both.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
    both.Update()
    data = both.GetOutput()
    add(data.GetCellData(), "Transmittance", [0.0, 0.4])
    add(data.GetCellData(), "DiffuseReflectance", [0.5, 0.1])
    f = run(data, lamp())
    got = cell_values(f, "Irradiance")
    close(got, [0.4 * values(plane(1), lamp())[0], values(plane(1, size=8.0, z=1.0), lamp())[0]],
          1e-12)
    decision, why, bound = row(f, "Transmission")
    assert decision == "simulated" and "0.4" in why and bound == 0.0, (decision, why, bound)
    off = run(data, lamp(), Transmission=vtkIrradianceFilter.OFF)
    assert cell_values(off, "Irradiance")[0] == 0.0
    decision, why, bound = row(off, "Transmission")
    assert decision == "left out" and bound >= got[0], (decision, why, bound)
    opaque = run(plane(), lamp())
    opaque.Update()
    assert row(opaque, "Transmission")[0] == "not needed"


def test_sensors_points_and_the_sun():
    data = plane(3)
    cover = pane(0.3, size=9.0, z=0.5)
    light = sun((0.2, 0.1, -1.0), 4.0)
    bare = values(data, light)
    close(values(data, light, occluders=[cover]), 0.3 * bare, 1e-12)
    f = run(data, light, occluders=[cover], SampleLocation=1)
    f.Update()
    got = array(f.GetOutputDataObject(0).GetPointData(), "Irradiance")
    close(got, np.full(16, 0.3 * bare[0]), 1e-12)
    grid = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    verts = vtk.vtkCellArray()
    for z in (0.0, 1.0):
        verts.InsertNextCell(1, [points.InsertNextPoint(0.1, 0.2, z)])
    grid.SetPoints(points)
    grid.SetVerts(verts)
    add(grid.GetPointData(), "Normals", [[0, 0, 1]] * 2)
    f = run(grid, light, occluders=[cover])
    f.Update()
    got = array(f.GetOutputDataObject(0).GetPointData(), "Irradiance")
    close(got, [0.3 * bare[0], bare[0]], 1e-12)


def test_edges_of_panes_can_be_made_geometry():
    data = plane(1, size=4.0)
    f = run(data, lamp((0, 0, 3)), occluders=[pane(0.25, size=1.0, z=1.0)],
            RefineShadowBoundaries=True)
    got = cell_values(f, "Irradiance")
    bare = run(data, lamp((0, 0, 3)), occluders=[plane(size=1.0, z=1.0)],
               RefineShadowBoundaries=True)
    dark = cell_values(bare, "Irradiance")
    assert len(got) == len(dark) and (dark == 0.0).sum() == 1
    shade = dark == 0.0
    close(got[~shade], dark[~shade], 1e-12)
    # The piece under the pane: its share of the square's light, the projected 1.5 m square.
    square = values(plane(1, size=1.5), lamp((0, 0, 3)))
    close(got[shade], 0.25 * square, 1e-12)


def test_methods_of_pairs_pass_the_lights_light_only():
    # Floor under a pane; the pane sends no light back: the floor's irradiance is direct.
    data = plane(2)
    f = run(data, lamp(), occluders=[pane(0.5, size=8.0, z=1.0)], kind=vtkRadiosityFilter,
            DiffuseReflectance=0.4, Method=1)
    close(cell_values(f, "Irradiance"), 0.5 * values(data, lamp()), 1e-9)
    decision, why, bound = row(f, "Transmission")
    assert decision == "simulated" and "does not pass" in why and bound > 0.0, (decision, why, bound)
    # Rays pass it both ways (test_specular.py), and nothing is left out.
    f = run(data, lamp(), occluders=[pane(0.5, size=8.0, z=1.0)], kind=vtkRadiosityFilter,
            DiffuseReflectance=0.4)
    close(cell_values(f, "Irradiance"), 0.5 * values(data, lamp()), 1e-9)
    assert row(f, "Transmission")[2] == 0.0


def test_what_cannot_be_a_transmittance():
    data = plane()
    for bad in (-0.1, 1.1, float("nan")):
        fails(run(data, lamp(), occluders=[pane(bad, z=1.0)]), "Transmittance", "occluder")
    two = pane(0.5, z=1.0)
    add(two.GetFieldData(), "Transmittance", [0.5, 0.5])
    fails(run(data, lamp(), occluders=[two]), "Transmittance", "one tuple")
    wrong = plane(2, z=1.0)
    add(wrong.GetCellData(), "Transmittance", [0.5])
    fails(run(data, lamp(), occluders=[wrong]), "Transmittance", "4, one a cell")
    sheet = plane()
    add(sheet.GetCellData(), "Transmittance", [0.7])
    add(sheet.GetCellData(), "DiffuseReflectance", [0.5])
    fails(run(sheet, lamp()), "Transmittance", "at most 1")


if __name__ == "__main__":
    run_all(globals())
