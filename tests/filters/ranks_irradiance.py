# SPDX-License-Identifier: BSD-3-Clause
"""Direct light on surfaces in parts, beside the same of one process. Run by test_ranks_irradiance.py
in pvbatch --sym: every rank goes through all checks."""
import numpy as np
import vtkmodules.all as vtk
from checks import Errors, array, simulation
from rank_parts import Alone, Scene, in_ranks, rank, room, set_array, size, surface
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkradiometry import (vtkAreaLightSource, vtkEnvironmentLightSource, vtkIrradianceFilter,
                           vtkPointLightSource, vtkSpotLightSource, vtkViewFactorFilter)

ROOM = room(4)
CELLS = len(ROOM.polygons)
MIXED = np.array([(7 * c + c // 5) % size() for c in range(CELLS)])  # parts that interlock
RUNS = np.array([c * size() // CELLS for c in range(CELLS)])  # one after the other
LAST = np.minimum(MIXED, max(0, size() - 2))  # nothing is left for the last rank


def lamps():
    point = vtkPointLightSource()
    point.SetPosition(0.9, -1.1, 2.2)
    point.SetIntensity(3.0)
    spot = vtkSpotLightSource()
    spot.SetPosition(-1.5, -1.5, 2.5)
    spot.SetDirection(1.5, 1.6, -2.4)
    spot.SetCutoff(30.0)
    spot.SetIntensity(4.0)
    return [point, spot]


def extended():
    panel = vtkAreaLightSource()
    panel.SetPosition(0.2, -0.3, 2.8)
    panel.SetDirection(0.0, 0.0, -1.0)
    panel.SetIntensity(5.0)
    sky = vtkEnvironmentLightSource()
    return [panel, sky]


def light_data(sources):
    append = vtk.vtkAppendPolyData()
    for source in sources:
        append.AddInputConnection(source.GetOutputPort())
    append.Update()
    return append.GetOutput()


def irradiance(data, *lights, alone=False, **properties):
    f = simulation(vtkIrradianceFilter, data, *lights, **{"RelativeTolerance": 0.1, **properties})
    return Alone(f) if alone else f


def result(f, name="Irradiance", points=False):
    f.Update()
    out = f.GetOutputDataObject(0)
    return array(out.GetPointData() if points else out.GetCellData(), name)


def same(a, b):
    assert a.dtype == b.dtype and a.shape == b.shape, (a.shape, b.shape)
    assert a.tobytes() == b.tobytes(), (np.abs(a - b).max(), (a != b).sum(), a.size)


def check_ids_give_the_bytes_of_one_process():
    """Every rank has all lights, as a source in each of them gives: each counts once."""
    for lights in (lamps(), extended()):
        whole = irradiance(ROOM.whole(), *lights, alone=True)
        expected, error = result(whole), result(whole, "IrradianceError")
        back = result(whole, "IrradianceBack")
        assert expected.max() > 0.1 and expected.min() < 0.1 * expected.max()
        for owner in (MIXED, LAST):
            part, cells = ROOM.part(owner, rank())
            f = irradiance(part, *lights)
            same(result(f), expected[cells])  # ghosts too
            same(result(f, "IrradianceError"), error[cells])
            same(result(f, "IrradianceBack"), back[cells])


def check_lights_of_the_first_rank_only():
    expected = result(irradiance(ROOM.whole(), *lamps(), alone=True))
    part, cells = ROOM.part(MIXED, rank())
    f = irradiance(part)
    f.AddLightsData(light_data(lamps()) if rank() == 0 else vtk.vtkPolyData())
    same(result(f), expected[cells])


def check_lights_dealt_out():
    """Different lights on different ranks, one of them on all."""
    every = [vtkPointLightSource() for _ in range(2 * size())]
    for k, light in enumerate(every):
        light.SetPosition(np.cos(k), np.sin(k), 1.5 + 0.2 * k)
    part, cells = ROOM.part(MIXED, rank())
    f = irradiance(part)
    f.AddLightsData(light_data([every[0]] + every[1 + rank()::size()]))
    order = [every[0]] + [light for r in range(size()) for light in every[1 + r::size()]]
    same(result(f), result(irradiance(ROOM.whole(), alone=True, *order))[cells])


def check_without_ids():
    """The scene is the parts one after the other; ghosts are known by their corners."""
    for owner in (RUNS, LAST):
        order = [c for r in range(size()) for c in range(CELLS) if owner[c] == r]
        place = np.argsort(order)
        expected = result(irradiance(ROOM.whole(order), *lamps(), *extended(), alone=True))
        part, cells = ROOM.part(owner, rank(), ids=False)
        f = irradiance(part, *lamps(), *extended())
        same(result(f), expected[place[cells]])


def check_ids_that_tell_nothing_apart():
    part, cells = ROOM.part(RUNS, rank(), ids=False)
    part.GetCellData().SetGlobalIds(
        set_array(part.GetCellData(), "GlobalCellIds", np.zeros(len(cells), np.int64)))
    expected = result(irradiance(ROOM.whole(), *lamps(), alone=True))
    same(result(irradiance(part, *lamps())), expected[cells])


def check_the_whole_surface_on_every_rank():
    """Data that was not divided counts once."""
    whole = ROOM.whole()
    same(result(irradiance(whole, *lamps())), result(irradiance(whole, *lamps(), alone=True)))


def check_occluders_of_another_rank():
    floor = Scene().add_grid((-2, -2, 0), (4, 0, 0), (0, 4, 0), 8)
    roof = Scene().add_grid((-1, -1, 1), (2, 0, 0), (0, 2, 0), 2)
    whole = irradiance(floor.whole(), *lamps(), alone=True)
    whole.AddOccludersData(roof.whole())
    part, cells = floor.part([c % size() for c in range(len(floor.polygons))], rank())
    f = irradiance(part, *lamps())
    f.AddOccludersData(roof.whole() if rank() == size() - 1 else vtk.vtkPolyData())
    same(result(f), result(whole)[cells])


def check_points_and_creases():
    properties = dict(SampleLocation=1, FeatureAngle=40.0)
    # Without ids the points are in another order, and so other samples are taken of extended lights.
    for ids, lights in ((True, [*lamps(), *extended()]), (False, lamps())):
        whole = irradiance(ROOM.whole(), *lights, alone=True, **properties)
        expected, normals = result(whole, points=True), result(whole, "Normals", points=True)
        corners = whole.GetOutputDataObject(0).GetPolys()
        at = vtk_to_numpy(corners.GetConnectivityArray())
        offsets = vtk_to_numpy(corners.GetOffsetsArray())
        part, cells = ROOM.part(RUNS, rank(), ids=ids)
        f = irradiance(part, *lights, **properties)
        values, own = result(f, points=True), result(f, "Normals", points=True)
        polygons = f.GetOutputDataObject(0).GetPolys()
        mine = vtk_to_numpy(polygons.GetConnectivityArray())
        whole_at = np.concatenate([at[offsets[c]:offsets[c + 1]] for c in cells]
                                  or [np.zeros(0, int)])
        same(values[mine], expected[whole_at])
        same(own[mine], normals[whole_at])


def check_sensors():
    rng = np.random.default_rng(5)
    places = rng.uniform(-1.8, 1.8, (60, 3)) * (1, 1, 0) + (0, 0, 0.05)
    directions = rng.normal(size=(60, 3)) + (0, 0, 2)

    def grid(which, ghosts=None):
        data = surface(places[which], [])
        verts = vtk.vtkCellArray()
        for k in range(len(which)):
            verts.InsertNextCell(1, [k])
        data.SetVerts(verts)
        set_array(data.GetPointData(), "Normals", directions[which])
        if ghosts is not None:
            set_array(data.GetPointData(), "vtkGhostType", np.array(ghosts, np.uint8))
        return data

    def scene(sensors, walls):
        blocks = vtk.vtkMultiBlockDataSet()
        blocks.SetBlock(0, sensors)
        blocks.SetBlock(1, walls)
        return blocks

    def at_sensors(f):
        f.Update()
        return array(f.GetOutputDataObject(0).GetBlock(0).GetPointData(), "Irradiance")

    lights = [*lamps(), *extended()]
    expected = at_sensors(irradiance(scene(grid(np.arange(60)), ROOM.whole()), *lights, alone=True))
    own = np.arange(60) * size() // 60 == rank()
    which = np.concatenate([np.nonzero(own)[0], np.nonzero(~own)[0][:5]])
    part, _ = ROOM.part(MIXED, rank())
    f = irradiance(scene(grid(which, [0] * own.sum() + [1] * (len(which) - own.sum())), part),
                   *lights)
    same(at_sensors(f), expected[which])


def check_blocks_that_some_ranks_lack():
    """Materials as field data of blocks; a block that one rank only has; colours."""
    def blocks(of_floor, of_wall):
        data = vtk.vtkMultiBlockDataSet()
        data.SetNumberOfBlocks(3)
        for k, (block, emitted) in enumerate(((of_floor, None), (None, None),
                                              (of_wall, (1.0, 2.0, 0.5)))):
            if block:
                data.SetBlock(k, block)
                if emitted:
                    set_array(block.GetFieldData(), "EmittedExitance", np.array([emitted]))
        return data

    floor = Scene().add_grid((-2, -2, 0), (4, 0, 0), (0, 4, 0), 6)
    wall = Scene().add_grid((-2, 2, 0), (4, 0, 0), (0, 0, 3), 3)
    whole = irradiance(blocks(floor.whole(), wall.whole()), *lamps(), alone=True)
    whole.Update()
    part, cells = floor.part([c % size() for c in range(len(floor.polygons))], rank())
    last = rank() == size() - 1
    f = irradiance(blocks(part, wall.whole() if last else None), *lamps())
    f.Update()
    out, expected = f.GetOutputDataObject(0), whole.GetOutputDataObject(0)
    values = array(expected.GetBlock(0).GetCellData(), "Irradiance")
    assert values.shape[1] == 3 and values[:, 1].max() > values[:, 0].max()
    same(array(out.GetBlock(0).GetCellData(), "Irradiance"), values[cells])
    assert (out.GetBlock(2) is not None) == last
    if last:
        same(array(out.GetBlock(2).GetCellData(), "Irradiance"),
             array(expected.GetBlock(2).GetCellData(), "Irradiance"))


def check_cells_cut_along_shadows():
    whole = irradiance(ROOM.whole(), *lamps(), alone=True, RefineShadowBoundaries=True)
    expected, of = result(whole), result(whole, "OriginalCellIds")
    assert len(expected) > CELLS
    part, cells = ROOM.part(MIXED, rank())
    f = irradiance(part, *lamps(), RefineShadowBoundaries=True)
    values, own = result(f), result(f, "OriginalCellIds")
    for k, cell in enumerate(cells):
        same(values[own == k], expected[of == cell])


def check_visibility_of_lights():
    lights = lamps() + extended()[:1]
    whole = irradiance(ROOM.whole(), *lights, alone=True, LightVisibility=True)
    expected = result(whole, "LightVisibility")
    assert expected.shape == (CELLS, 3) and expected.max() == 1.0 and expected.min() == 0.0
    part, cells = ROOM.part(MIXED, rank())
    same(result(irradiance(part, *lights, LightVisibility=True), "LightVisibility"), expected[cells])


def check_bad_input_of_one_rank_ends_all():
    part, cells = ROOM.part(RUNS, rank(), ids=False, ghosts=False)
    if rank() == size() - 1:
        part.GetPoints().SetPoint(1, float("nan"), 0.0, 0.0)
    for lights, word in ((lamps(), "Points"), ([vtkPointLightSource()], "Points")):
        f = irradiance(part, *lights)
        errors = Errors(f)
        f.Update()
        assert len(errors.messages) == 1 and word in errors.messages[0], errors.messages
        assert f"rank {size() - 1}" in errors.messages[0], errors.messages
        assert f.GetOutputDataObject(0).GetNumberOfCells() == 0
    # What no other rank can know: a number that is out of range on one of them.
    part, cells = ROOM.part(RUNS, rank())
    f = irradiance(part, *lamps(), RelativeTolerance=-1.0 if rank() == 0 else 0.01)
    errors = Errors(f)
    f.Update()
    assert len(errors.messages) == 1 and "rank 0: RelativeTolerance" in errors.messages[0], \
        errors.messages
    f.SetRelativeTolerance(0.1)  # and the next run is well
    f.Modified()
    same(result(f), result(irradiance(ROOM.whole(), *lamps(), alone=True))[cells])


def check_an_abort_on_one_rank_ends_all():
    part, _ = ROOM.part(RUNS, rank())
    f = irradiance(part, *lamps(), *extended())
    if rank() == size() - 1:
        f.AddObserver("ProgressEvent", lambda caller, event: caller.SetAbortExecute(1))
    f.Update()
    assert f.GetOutputDataObject(0).GetNumberOfCells() == 0


def check_tables_have_their_rows_once():
    part, _ = ROOM.part(RUNS, rank())
    f = irradiance(part, *lamps(), *extended())
    f.Update()
    whole = irradiance(ROOM.whole(), *lamps(), *extended(), alone=True)
    whole.Update()
    for port in (1, 2):
        rows = f.GetOutputDataObject(port).GetNumberOfRows()
        assert rows == (whole.GetOutputDataObject(port).GetNumberOfRows() if rank() == 0 else 0)
    if rank() == 0:
        for name in ("EstimatedError", "AbsoluteError", "Samples"):
            mine, one = (vtk_to_numpy(g.GetOutputDataObject(2).GetColumnByName(name))
                         for g in (f, whole))
            assert np.allclose(mine, one, rtol=1e-9, atol=0.0), (name, mine, one)


def check_solids_without_ghosts():
    """A block of cubes in slices: the faces between them are no surface."""
    def cubes(first, end):
        data = vtk.vtkUnstructuredGrid()
        points = vtk.vtkPoints()
        for i in range(first, end):
            for corner in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1),
                           (1, 1, 1), (0, 1, 1)):
                points.InsertNextPoint(i + corner[0], corner[1], corner[2])
        data.SetPoints(points)
        for i in range(end - first):
            data.InsertNextCell(12, 8, list(range(8 * i, 8 * i + 8)))
        clean = vtk.vtkStaticCleanUnstructuredGrid()
        clean.SetInputData(data)
        clean.Update()
        return clean.GetOutput()

    def by_place(f):
        f.Update()
        out = f.GetOutputDataObject(0)
        centers = vtk.vtkCellCenters()
        centers.SetInputData(out)
        centers.Update()
        places = np.round(vtk_to_numpy(centers.GetOutput().GetPoints().GetData()), 3)
        return dict(zip(map(tuple, places.tolist()), array(out.GetCellData(), "Irradiance")))

    count = 3 * size()
    light = vtkPointLightSource()
    light.SetPosition(0.4 * count, -2.0, 3.0)
    light.SetIntensity(10.0)
    expected = by_place(irradiance(cubes(0, count), light, alone=True))
    mine = by_place(irradiance(cubes(3 * rank(), 3 * rank() + 3), light))
    outside = [place for place in mine if place in expected]
    assert len(outside) >= 12 and max(expected.values()) > 0.1
    for place, value in mine.items():
        assert abs(value - expected.get(place, 0.0)) <= 1e-12, (place, value)


def check_view_factors():
    """The same of groups of cells that several ranks have parts of."""
    scene = room(2)
    scene.arrays["Group"] = [c * 5 // len(scene.polygons) for c in range(len(scene.polygons))]
    part, cells = scene.part([(7 * c) % size() for c in range(len(scene.polygons))], rank())
    out = []
    for data, alone in ((part, False), (scene.whole(), True)):
        f = vtkViewFactorFilter()
        f.SetInputData(data)
        f.SetPatchArray("Group")
        f.SetRelativeTolerance(0.1)
        f = Alone(f) if alone else f
        f.Update()
        out.append(f)
    f, whole = out
    for name in ("SkyViewFactor", "ViewFactorSum", "SkyViewFactorError"):
        mine, one = (array(g.GetOutputDataObject(0).GetCellData(), name) for g in out)
        assert np.abs(one).max() > 0.0
        assert np.abs(mine - one[cells]).max(initial=0.0) <= 1e-12, name
    for port in (1, 2, 3):
        rows = whole.GetOutputDataObject(port).GetNumberOfRows()
        assert f.GetOutputDataObject(port).GetNumberOfRows() == (rows if rank() == 0 else 0)
    f.SetPatchArray("missing")
    errors = Errors(f)
    f.Update()
    assert len(errors.messages) == 1 and "missing" in errors.messages[0], errors.messages


def check_a_time_budget():
    part, cells = ROOM.part(RUNS, rank())
    f = irradiance(part, *extended(), TimeBudget=0.05, RelativeTolerance=1e-4)
    assert np.isfinite(result(f)).all()
    assert "time budget" in array(f.GetOutputDataObject(0).GetFieldData(), "RadiometryOutcome")[0]


in_ranks(globals())
