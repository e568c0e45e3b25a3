# SPDX-License-Identifier: BSD-3-Clause
"""Cells and data of every sort: without area, needles, not flat, concave, strips, coplanar and
duplicate, none at all, unstructured, composite. Under every kind of light whose answer has a closed
form on a polygon: point and spot by solid angles in 80 bits, the sun by the vector area."""
import numpy as np
import vtkmodules.all as vtk
from hardcases import (POINTS, Run, areas_of, array, cell, close, fails, grid, joined, light_data, mesh, point,
                       polydata, rotation, run_all, sensors, solid_angle, spot, sun, triangles_of,
                       vector_area, with_cells, with_points)
from vtkradiometry import vtkIrradianceFilter

LIGHT = (0.3, 0.4, 1.5)
SUN = np.array((0.2, -0.3, -0.8))
SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]


def beams(intensity=1.0):
    """Everywhere, in a half space, and in a cone too wide to matter: the same on what is below."""
    return (point(LIGHT, intensity), spot(LIGHT, (0, 0, -1), 90.0, 0.0, intensity),
            spot(LIGHT, (0.1, 0, -1), 180.0, 0.0, intensity))


def sun_on(loop, irradiance=1.0):
    """Flux of the sun on a loop all of whose parts face it."""
    return irradiance * -vector_area(loop) @ SUN / np.linalg.norm(SUN)


def test_cells_without_area_get_exactly_nothing():
    points = SQUARE + [(5, 5, 0), (6, 5, 0), (7, 5, 0), (8, 5, 0)]
    cells = [(0, 1, 2, 3), (4, 5, 6), (4, 5, 6, 7), (4, 4, 5), (4, 4, 4, 4), (4, 5, 4, 5), (4,) * 7,
             (4, 5), (4,)]
    for light in beams() + (sun(SUN, 2.0),):
        for location in (0, POINTS):
            run = Run(polydata(points, cells), light, SampleLocation=location)
            values = run.e if location == 0 else run.e[4:8]
            if location == 0:
                assert values[0, 0] > 0
                assert (run.e[1:] == 0).all() and (run.error[1:] == 0).all()
    text = array(Run(polydata(points, cells), sun(SUN)).output.GetFieldData(), "RadiometryOptions")[0]
    assert "CellsWithoutArea=8" in text, text


def test_a_cell_without_area_blocks_and_breaks_nothing():
    """Collapsed cells over the floor and on it leave it as it was."""
    for light in beams() + (sun(SUN),):
        clean = Run(mesh((SQUARE, [(0, 1, 2, 3)])), light)
        extra = [(0.2, 0.2, 0.5), (0.8, 0.2, 0.5), (0.5, 0.2, 0.5), (0.2, 0.5, 0), (0.7, 0.5, 0)]
        dirty = Run(polydata(SQUARE + extra, [(0, 1, 2, 3), (4, 5, 6), (4, 4, 5), (7, 8, 7)]), light)
        close(dirty.e[0], clean.e[0], 1e-14)


def test_needle_quads():
    for width in (1e-6, 1e-9):
        for seed in (0, 1):
            turn = rotation(seed)
            loop = np.array([(0, 0, 0), (1, 0, 0), (1, width, 0), (0, width, 0)])
            for light in beams():
                exact = solid_angle(loop @ turn.T, turn @ LIGHT) / width
                value = cell(polydata(loop @ turn.T, [(0, 1, 2, 3)]), light.moved(turn))
                close(value, exact, 1e-9 if seed == 0 else 1e-9 + 4e-16 / width)
            value = cell(polydata(loop @ turn.T, [(0, 1, 2, 3)]), sun(SUN).moved(turn))
            close(value, 0.8 / np.linalg.norm(SUN), 1e-12 if seed == 0 else 1e-12 + 4e-16 / width)


def test_needles_throw_shadows():
    """A wire of 1e-6 by 1 m over the floor takes what falls on it."""
    floor = grid((-3, -3, 0), (6, 0, 0), (0, 6, 0), 3, 3)
    wire = ([(-0.4, 0.2, 0.5), (0.6, 0.2, 0.5), (0.6, 0.2 + 1e-6, 0.5), (-0.4, 0.2 + 1e-6, 0.5)],
            [(0, 1, 2, 3)])
    for light in beams():
        lost = (Run(mesh(floor), light).e - Run(mesh(floor, wire), light).e[:9]).sum() * 4.0
        assert abs(lost - solid_angle(wire[0], LIGHT)) <= 1e-14, lost


def test_quads_that_are_not_flat_keep_the_flux_of_their_rim():
    """Whichever way a bent quad is cut, its flux is that of its rim: a solid angle, a vector area."""
    for bend in (1e-12, 1e-6, 0.01, 0.2):
        for seed in (0, 3):
            turn = rotation(seed)
            loop = np.array([(0, 0, bend), (1, 0, 0), (1, 1, bend), (0, 1, 0)])
            data = polydata(loop @ turn.T, [(0, 1, 2, 3)])
            areas = [np.linalg.norm(vector_area(loop[list(a)])) + np.linalg.norm(vector_area(loop[list(b)]))
                     for a, b in (((0, 1, 2), (0, 2, 3)), ((0, 1, 3), (1, 2, 3)))]
            for light in beams() + (sun(SUN),):
                flux = sun_on(loop) if light.kind == 2 else solid_angle(loop, LIGHT)
                value = cell(data, light.moved(turn))
                assert min(abs(value * a / flux - 1) for a in areas) < 1e-11, (bend, light.kind)


def test_bent_quads_shadow_their_neighbours_without_cracks():
    """A closed tent of bent quads over a floor: beneath it, nothing at all."""
    rng = np.random.default_rng(4)
    p, q = grid((-1, -1, 0.7), (2, 0, 0), (0, 2, 0), 9, 9)
    p[:, 2] += 0.1 * rng.random(len(p))
    inside = (np.abs(p[:, :2]) < 1).all(axis=1)
    p[~inside, 2] = 0.7
    walls = joined(grid((-1, -1, 0), (2, 0, 0), (0, 0, 0.7), 9, 4), grid((-1, 1, 0), (2, 0, 0), (0, 0, 0.7), 9, 4),
                   grid((-1, -1, 0), (0, 2, 0), (0, 0, 0.7), 9, 4), grid((1, -1, 0), (0, 2, 0), (0, 0, 0.7), 9, 4))
    floor = grid((-1, -1, 0), (2, 0, 0), (0, 2, 0), 9, 9)
    for light in beams() + (sun(SUN), point((0.11, 0.07, 0.85)), sun((1, 1, -1e-3)), sun((0, 0, -1))):
        run = Run(mesh(floor, (p, q), walls), light)
        assert (run.e[:81] == 0).all(), (light.kind, run.e[:81].max())


def concave():
    """An arrow, a comb, a star, and a square ring walked as a keyhole."""
    yield [(0, 0), (4, 0), (4, 4), (2, 1), (0, 4)]
    yield [(0, 0), (5, 0), (5, 2), (4, 2), (4, 0.1), (3, 0.1), (3, 2), (2, 2), (2, 0.1), (1, 0.1),
           (1, 2), (0, 2)]
    a = np.arange(14) * np.pi / 7
    r = np.where(np.arange(14) % 2, 0.4, 2.0)
    yield list(zip(r * np.cos(a), r * np.sin(a)))
    yield [(0, 0), (3, 0), (3, 3), (0, 3), (0, 0), (1, 1), (1, 2), (2, 2), (2, 1), (1, 1)]


def test_concave_polygons():
    for corners in concave():
        for seed in (0, 2):
            turn = rotation(seed)
            loop = np.array([(x, y, 0.0) for x, y in corners])
            # The keyhole's repeated corners as the same points, and as others at the same place.
            data = polydata(loop @ turn.T, [range(len(loop))])
            area = np.linalg.norm(vector_area(loop))
            for light in beams():
                close(cell(data, light.moved(turn)), solid_angle(loop, LIGHT) / area, 1e-12)
            close(cell(data, sun(SUN).moved(turn)), 0.8 / np.linalg.norm(SUN), 1e-12)


def test_concave_polygons_throw_their_own_shadow():
    """What a concave plate takes from the floor is what falls on it, notches left out."""
    floor = grid((-9, -9, 0), (22, 0, 0), (0, 22, 0), 2, 2)
    for corners in concave():
        loop = np.array([(0.3 * x, 0.3 * y, 0.6) for x, y in corners])
        plate = (loop, [tuple(range(len(loop)))])
        for light in (point(LIGHT), sun((0, 0, -1))):
            lost = (Run(mesh(floor), light).e - Run(mesh(floor, plate), light).e[:4]).sum() * 121.0
            taken = np.linalg.norm(vector_area(loop)) if light.kind == 2 else solid_angle(loop, LIGHT)
            close(lost, taken, 1e-9)


def test_polygons_that_cross_themselves_get_nothing_and_are_counted():
    bow_tie = [(0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 1, 0)]
    run = Run(mesh((SQUARE, [(0, 1, 2, 3)]), (np.array(bow_tie) + (3, 0, 0), [(0, 1, 2, 3)])), sun(SUN))
    assert run.e[0, 0] > 0 and run.e[1, 0] == 0
    text = array(run.output.GetFieldData(), "RadiometryOptions")[0]
    assert "CellsWithoutArea=1" in text, text


def test_triangle_strips():
    p, q = grid((0, 0, 0), (4, 0, 0), (0, 1, 0), 4, 1)
    strip = [i for k in range(5) for i in (k, k + 5)]  # 0 5 1 6 ...: turns clockwise, front down
    for order, front in ((strip, False), (strip[1:], True)):
        data = polydata(p, strips=[order])
        tris = [tuple(order[k:k + 3]) if k % 2 == 0 else (order[k + 1], order[k], order[k + 2])
                for k in range(len(order) - 2)]
        for light in beams() + (sun(SUN),):
            value = cell(data, light)
            parts = Run(polydata(p, tris), light).e[:, 0] @ areas_of(p, tris) / areas_of(p, tris).sum()
            close(value, parts, 1e-12)
            assert (value > 0) == front


def test_duplicate_faces_receive_alike_and_hide_nothing_of_one_another():
    for light in beams() + (sun(SUN),):
        alone = cell(polydata(SQUARE, [(0, 1, 2, 3)]), light)
        twice = Run(polydata(SQUARE, [(0, 1, 2, 3)] * 3), light).e[:, 0]
        close(twice, [alone] * 3, 1e-14)
        # By other points at the same places, cut along the other diagonal, and upside down.
        other = Run(mesh((SQUARE, [(0, 1, 2, 3)]), (SQUARE, [(1, 2, 3, 0)]), (SQUARE, [(3, 2, 1, 0)])),
                    light).e[:, 0]
        close(other, [alone, alone, 0.0], 1e-12)
        back = Run(mesh((SQUARE, [(0, 1, 2, 3)]), (SQUARE, [(3, 2, 1, 0)])), light, TwoSided=True,
                   back=True).e[:, 0]
        close(back, [0.0, alone], 1e-12)


def test_duplicate_blockers_hide_as_much_as_one():
    floor = grid((-2, -2, 0), (4, 0, 0), (0, 4, 0), 4, 4)
    plate = grid((0.1, 0.2, 0.5), (0.7, 0, 0), (0, 0.6, 0.1))
    for light in beams() + (sun(SUN),):
        one = Run(mesh(floor, plate), light)
        for extra in ([plate], [plate, plate], [(plate[0], [plate[1][0][::-1]])]):
            run = Run(mesh(floor, plate, *extra), light)
            close(run.e[:16], one.e[:16], 1e-12)
            assert (run.error[:16] < 1e-9).all()


def test_coplanar_faces_that_overlap_do_not_shadow_each_other():
    """A rug in the plane of the floor, partly over it; and a table top that meets a wall's edge."""
    floor = grid((0, 0, 0), (2, 0, 0), (0, 2, 0), 2, 2)
    rug = grid((0.5, 0.3, 0), (2.2, 0, 0), (0, 1.3, 0))
    for seed in (0, 5):
        turn = rotation(seed)
        for light in beams() + (sun(SUN),):
            floor_alone = Run(polydata(floor[0] @ turn.T, floor[1]), light.moved(turn)).e
            rug_alone = Run(polydata(rug[0] @ turn.T, rug[1]), light.moved(turn)).e
            p, q = joined(floor, rug)
            run = Run(polydata(p @ turn.T, q), light.moved(turn))
            close(run.e, np.concatenate([floor_alone, rug_alone]), 1e-12)


def test_a_sheet_that_touches_another_along_a_line():
    """A vertical wall stands on the middle of one floor cell and in another's plane: its shadow is
    all on its far side, up to its foot."""
    floor = grid((-1, -1, 0), (2, 0, 0), (0, 2, 0))
    wall = ([(0, -2, 0), (0, 2, 0), (0, 2, 5), (0, -2, 5)], [(0, 1, 2, 3)])
    for x in (0.3, 1e-3, 1e-9):
        lit = solid_angle([(0, -1, 0), (1, -1, 0), (1, 1, 0), (0, 1, 0)], (x, 0.1, 1.0))
        close(Run(mesh(floor, wall), point((x, 0.1, 1.0))).e[0, 0], lit / 4, 1e-10)
    close(Run(mesh(floor, wall), sun((-1, 0, -1e-3))).e[0, 0], 0.5 * 1e-3 / np.sqrt(1 + 1e-6), 1e-9)


def test_empty_input():
    for light in beams() + (sun(SUN),):
        for data in (vtk.vtkPolyData(), vtk.vtkUnstructuredGrid(), polydata(SQUARE)):
            f = vtkIrradianceFilter()
            f.SetInputData(data)
            f.AddLightsData(light_data(light))
            f.Update()
            assert f.GetOutputDataObject(0).GetNumberOfCells() == 0
        for data in (vtk.vtkMultiBlockDataSet(), vtk.vtkPartitionedDataSet()):
            f = vtkIrradianceFilter()
            f.SetInputData(data)
            f.AddLightsData(light_data(light))
            f.Update()
            assert f.GetOutputDataObject(0).IsA(data.GetClassName())
        run = Run(mesh((SQUARE, [(0, 1, 2, 3)])), light, vtk.vtkPolyData())  # no blockers either
        close(run.e, Run(mesh((SQUARE, [(0, 1, 2, 3)])), light).e)


def test_only_verts_or_lines():
    for kinds in (dict(verts=[(0,), (1, 2)]), dict(lines=[(0, 1), (1, 2, 3)]),
                  dict(verts=[(0,)], lines=[(0, 1)])):
        for light in beams() + (sun(SUN),):
            run = Run(polydata(SQUARE, **kinds), light)
            assert (run.e == 0).all() and (run.error == 0).all()
            assert len(run.e) == sum(len(v) for v in kinds.values())
            # They block nothing, and do not disturb the numbering of the cells after them.
            both = Run(polydata(SQUARE, [(0, 1, 2, 3)], **kinds), light)
            assert (both.e[:-1] == 0).all()
            close(both.e[-1], Run(polydata(SQUARE, [(0, 1, 2, 3)]), light).e[0])


def test_unstructured_cells():
    """A hexahedron, a wedge and a quad as one unstructured grid: the outer surface is what receives."""
    cube = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    ug = vtk.vtkUnstructuredGrid()
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    for p in cube:
        points.InsertNextPoint(p)
    ug.SetPoints(points)
    ug.InsertNextCell(vtk.VTK_HEXAHEDRON, 8, [0, 1, 3, 2, 4, 5, 7, 6])
    for light in (point((0.5, 0.5, 2.0), 3.0), sun((0, 0, -1), 3.0)):
        run = Run(ug, light)
        lit = run.e[run.e > 0]
        flux = 3.0 * solid_angle([(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], (0.5, 0.5, 2)) \
            if light.kind == 0 else 3.0
        close(lit, [flux], 1e-12)
    # From inside only the backs are lit: all of the sphere.
    run = Run(ug, point((0.5, 0.4, 0.3), 1.0), TwoSided=True, back=True)
    close(run.e.sum(), 4 * np.pi, 1e-12)


def test_structured_and_image_data():
    image = vtk.vtkImageData()
    image.SetDimensions(4, 4, 1)
    reference = Run(polydata(*grid((0, 0, 0), (3, 0, 0), (0, 3, 0), 3, 3)), sun((0, 0, -1))).e
    e = Run(image, sun((0, 0, -1)), TwoSided=True).e + Run(image, sun((0, 0, -1)), TwoSided=True, back=True).e
    close(e, reference, 1e-12)


def test_composite_blocks_keep_their_values_and_shadow_each_other():
    blocks = vtk.vtkMultiBlockDataSet()
    floor = polydata(*grid((-2, -2, 0), (4, 0, 0), (0, 4, 0), 4, 4))
    plate = polydata(*grid((0.1, 0.2, 0.5), (0.7, 0, 0), (0, 0.6, 0.1)))
    inner = vtk.vtkMultiBlockDataSet()
    inner.SetBlock(1, plate)
    blocks.SetBlock(0, floor)
    blocks.SetBlock(2, inner)
    blocks.SetBlock(3, vtk.vtkPolyData())
    one = mesh(grid((-2, -2, 0), (4, 0, 0), (0, 4, 0), 4, 4), grid((0.1, 0.2, 0.5), (0.7, 0, 0), (0, 0.6, 0.1)))
    for light in beams() + (sun(SUN),):
        flat = Run(one, light)
        out = Run(blocks, light).output
        assert out.GetNumberOfBlocks() == 4 and out.GetBlock(1) is None
        close(Run.values(out.GetBlock(0))[0], flat.e[:16], 1e-13)
        close(Run.values(out.GetBlock(2).GetBlock(1))[0], flat.e[16:], 1e-13)


def test_sensors_and_surfaces_in_one_composite():
    blocks = vtk.vtkMultiBlockDataSet()
    places = [(0.5, 0.5, 0.0), (1.5, 0.3, 0.2)]
    blocks.SetBlock(0, polydata(SQUARE, [(0, 1, 2, 3)]))
    blocks.SetBlock(1, sensors(places, (0, 0, 1)))
    for light in beams() + (sun(SUN),):
        out = Run(blocks, light).output
        close(Run.values(out.GetBlock(1))[0], Run(sensors(places, (0, 0, 1)), light).e, 1e-13)
        close(Run.values(out.GetBlock(0))[0], Run(polydata(SQUARE, [(0, 1, 2, 3)]), light).e, 1e-13)


def test_shared_and_repeated_points_are_one_surface():
    """Seams (each cell with points of its own) make no cracks and no shadow lines."""
    p, q = grid((-1, -1, 0), (2, 0, 0), (0, 2, 0), 6, 6)
    roof = (p + (0, 0, 1.0), q)
    seams = joined(*[(roof[0][list(c)], [(0, 1, 2, 3)]) for c in roof[1]])
    for light in (point((0.05, 0.1, 1.5)), sun((0.1, 0.2, -1))):
        a, b = Run(mesh((p, q), roof), light), Run(mesh((p, q), seams), light)
        close(b.e, a.e, 1e-12)


def test_input_of_single_precision():
    data = vtk.vtkPlaneSource()
    data.SetOutputPointsPrecision(vtk.vtkAlgorithm.SINGLE_PRECISION)
    data.Update()
    close(cell(data.GetOutput(), point((0, 0, 1))), solid_angle(
        [(-.5, -.5, 0), (.5, -.5, 0), (.5, .5, 0), (-.5, .5, 0)], (0, 0, 1)), 1e-12)


def test_normals_that_are_no_directions_are_refused():
    for bad in ((0, 0, 0), (float("nan"), 0, 1), (0, float("inf"), 1)):
        f = vtkIrradianceFilter()
        f.SetInputData(sensors([(0, 0, 0), (1, 0, 0)], [(0, 0, 1), bad]))
        fails(f, "Normals[1]")


run_all(globals())
