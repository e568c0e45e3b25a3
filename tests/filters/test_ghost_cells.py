# SPDX-License-Identifier: BSD-3-Clause
"""Cells that are marked as copies of others (vtkGhostType), in one process."""
import numpy as np
import vtkmodules.all as vtk
from checks import array, cell_values, run_all, simulation
from rank_parts import Scene, room, set_array
from vtkradiometry import vtkIrradianceFilter, vtkPointLightSource, vtkRadiosityFilter

DUPLICATE = 1


def lamp():
    light = vtkPointLightSource()
    light.SetPosition(0.9, -1.1, 2.2)
    light.SetIntensity(3.0)
    return light


def with_copies(scene, copies, shift=0.0):
    """The scene and some of its cells once more, marked; the copies begin at another corner."""
    more = Scene()
    more.points = list(scene.points) + [np.asarray(p) + (0, 0, shift) for p in scene.points]
    n = len(scene.points)
    more.polygons = list(scene.polygons) + [
        [n + p for p in scene.polygons[c][1:] + scene.polygons[c][:1]] for c in copies]
    more.arrays = {name: values + [values[c] for c in copies]
                   for name, values in scene.arrays.items()}
    data = more.whole()
    set_array(data.GetCellData(), "vtkGhostType",
              np.array([0] * len(scene.polygons) + [DUPLICATE] * len(copies), np.uint8))
    return data


def test_copies_are_no_receivers_and_no_occluders_and_get_their_originals_values():
    scene, copies = room(3), [3, 40, 41, 7]
    light = lamp()
    for kind, properties in ((vtkIrradianceFilter, {}),
                             (vtkRadiosityFilter, dict(Method=1, Refinement=2,
                                                       RelativeTolerance=0.1))):
        expected = cell_values(simulation(kind, scene.whole(), light, **properties), "Irradiance")
        f = simulation(kind, with_copies(scene, copies), light, **properties)
        values = cell_values(f, "Irradiance")
        n = len(scene.polygons)
        assert values[:n].tobytes() == expected.tobytes()
        assert values[n:].tobytes() == expected[copies].tobytes()


def test_a_copy_of_nothing_gets_0_and_casts_no_shadow():
    scene, light = room(3), lamp()
    expected = cell_values(simulation(vtkIrradianceFilter, scene.whole(), light), "Irradiance")
    f = simulation(vtkIrradianceFilter, with_copies(scene, [0, 1, 2], shift=0.5), light)
    values = cell_values(f, "Irradiance")
    assert values[:-3].tobytes() == expected.tobytes()
    assert (values[-3:] == 0.0).all()


def test_copies_of_another_block():
    floor = Scene().add_grid((-2, -2, 0), (4, 0, 0), (0, 4, 0), 4)
    left, right = [c for c in range(20) if c % 5 < 2], [c for c in range(20) if c % 5 >= 2]
    light = lamp()
    expected = cell_values(simulation(vtkIrradianceFilter, floor.whole(), light), "Irradiance")
    blocks = vtk.vtkMultiBlockDataSet()
    owner = [0 if c in left else 1 for c in range(20)]
    numbers = []
    for k in (0, 1):
        part, cells = floor.part(owner, k, ids=False)
        blocks.SetBlock(k, part)
        numbers.append(cells)
    assert len(numbers[0]) > len(left) and len(numbers[1]) > len(right)
    f = simulation(vtkIrradianceFilter, blocks, light)
    f.Update()
    for k in (0, 1):
        values = array(f.GetOutputDataObject(0).GetBlock(k).GetCellData(), "Irradiance")
        assert np.allclose(values, expected[numbers[k]], rtol=1e-12, atol=0.0)


def test_occluders_that_are_copies_block_nothing():
    floor = Scene().add_grid((-2, -2, 0), (4, 0, 0), (0, 4, 0), 4)
    roof = Scene().add_grid((-1, -1, 1), (2, 0, 0), (0, 2, 0), 2).whole()
    set_array(roof.GetCellData(), "vtkGhostType",
              np.full(roof.GetNumberOfCells(), DUPLICATE, np.uint8))
    light = lamp()
    expected = cell_values(simulation(vtkIrradianceFilter, floor.whole(), light), "Irradiance")
    f = simulation(vtkIrradianceFilter, floor.whole(), light)
    f.AddOccludersData(roof)
    assert cell_values(f, "Irradiance").tobytes() == expected.tobytes()


def test_an_empty_part_in_single_precision_moves_no_light():
    floor = Scene().add_grid((-2, -2, 0), (4, 0, 0), (0, 4, 0), 4)
    empty = vtk.vtkPolyData()
    empty.SetPoints(vtk.vtkPoints())  # float, and without bounds
    light = lamp()
    expected = cell_values(simulation(vtkIrradianceFilter, floor.whole(), light), "Irradiance")
    f = simulation(vtkIrradianceFilter, floor.whole(), light)
    f.AddOccludersData(empty)
    assert cell_values(f, "Irradiance").tobytes() == expected.tobytes()


run_all(globals())
