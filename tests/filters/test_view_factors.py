# SPDX-License-Identifier: BSD-3-Clause
"""The view factor filter: closed forms, View3D's street canyon, invariants, bad input refused."""
import importlib.util
import json
import math
import os

import numpy as np
import vtkmodules.all as vtk
from checks import SOURCE_DIR, array, close, fails, run_all, shared, strings
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkradiometry import vtkViewFactorFilter

AUTO, DENSE, HIERARCHICAL, MONTE_CARLO = range(4)
OFF = 2


def mesh(points, cells):
    data = vtk.vtkPolyData()
    p = vtk.vtkPoints()
    p.SetDataTypeToDouble()
    for x in points:
        p.InsertNextPoint(x)
    polygons = vtk.vtkCellArray()
    for cell in cells:
        polygons.InsertNextCell(len(cell), cell)
    data.SetPoints(p)
    data.SetPolys(polygons)
    return data


def faces(corner_a_b, n=1):
    """Parallelograms (corner, a, b) of n x n quads each; fronts along a x b."""
    points, cells = [], []
    for corner, a, b in corner_a_b:
        corner, a, b = map(np.asarray, (corner, a, b))
        first = len(points)
        for j in range(n + 1):
            for i in range(n + 1):
                points.append(tuple(corner + a * i / n + b * j / n))
        for j in range(n):
            for i in range(n):
                p = first + j * (n + 1) + i
                cells.append((p, p + 1, p + n + 2, p + n + 1))
    return mesh(points, cells)


def box(lo, hi, n=1, inward=False):
    s = np.asarray(hi, float) - lo
    x, y, z = np.diag(s)
    lo = np.asarray(lo, float)
    sides = [(lo, y, x), (lo + z, x, y), (lo, x, z), (lo + y, z, x), (lo, z, y), (lo + x, y, z)]
    return faces([(o, b, a) if inward else (o, a, b) for o, a, b in sides], n)


def tagged(data, values, name="Patch", dtype=np.int32):
    values = np.broadcast_to(np.asarray(values, dtype), (data.GetNumberOfCells(),)).copy()
    a = numpy_to_vtk(values, deep=True)
    a.SetName(name)
    data.GetCellData().AddArray(a)
    return data


def joined(*parts):
    """Meshes as one, each a patch of its own in the array Patch."""
    append = vtk.vtkAppendPolyData()
    append.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
    for k, part in enumerate(parts):
        append.AddInputData(tagged(part, k))
    append.Update()
    return append.GetOutput()


def view_factors(data, *occluders, **properties):
    f = vtkViewFactorFilter()
    f.SetInputData(data)
    for occluder in occluders:
        f.AddOccludersData(occluder)
    for name, value in properties.items():
        getattr(f, "Set" + name)(value)
    return f


def table(f):
    """{(from, to): (F, error)}"""
    f.Update()
    t = f.GetOutputDataObject(1)
    columns = [vtk_to_numpy(t.GetColumnByName(n))
               for n in ("From", "To", "ViewFactor", "ViewFactorError")]
    rows = {(int(i), int(j)): (v, e) for i, j, v, e in zip(*columns)}
    assert len(rows) == t.GetNumberOfRows()
    return rows


def cells(f, name):
    f.Update()
    return array(f.GetOutputDataObject(0).GetCellData(), name)


def field(f, name, port=1):
    f.Update()
    return array(f.GetOutputDataObject(port).GetFieldData(), name)


def plates(gap=1.0, n=1):
    return faces([((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((0, 0, gap), (0, 1, 0), (1, 0, 0))], n)


def test_parallel_squares_are_right_on_the_coarsest_mesh():
    for n, cut in ((1, False), (1, True), (3, False)):
        data = tagged(plates(n=n), np.repeat([5, 9], n * n))
        if cut:
            triangles = vtk.vtkTriangleFilter()
            triangles.SetInputData(data)
            triangles.Update()
            data = triangles.GetOutput()
        rows = table(view_factors(data, PatchArray="Patch"))
        assert set(rows) == {(5, 9), (9, 5)}
        for f, error in rows.values():
            assert abs(f - 0.199824895698387) <= error <= 1e-6, (f, error)


def test_every_cell_is_a_patch_when_no_array_is_named():
    f = view_factors(plates(n=2))
    rows = table(f)
    assert set(rows) == {(i, j) for i in range(8) for j in range(8) if (i < 4) != (j < 4)}
    total = sum(v for (i, _), (v, _) in rows.items() if i < 4) / 4
    close(total, 0.199824895698387, 1e-6)
    close(cells(f, "ViewFactorSum"), [sum(v for (i, _), (v, _) in rows.items() if i == c)
                                      for c in range(8)], 1e-12)


def test_closed_forms():
    x, y, z = np.eye(3)
    o = np.zeros(3)
    cases = [
        ((o, x, y), (o + 1 * z, y, x), 0.199824895698387),
        ((o, 2 * x, y), (z, y, 2 * x), 0.28587538485),
        ((o, x, y), (o, y, z), 0.200043776075403),
    ]
    for a, b, exact in cases:
        (v, e) = table(view_factors(faces([a, b])))[0, 1]
        assert abs(v - exact) <= max(e, 1e-10) and e < 1e-6, (v, e, exact)


def test_concave_polygon():
    # An L below a square: the difference of two rectangles, by additivity.
    l_shape = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0), (1, 2, 0), (0, 2, 0)]
    lid = [(0, 0, 1), (0, 1, 1), (1, 1, 1), (1, 0, 1)]
    (v, e) = table(view_factors(mesh(l_shape + lid, [range(6), range(6, 10)])))[1, 0]
    parts = [((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((1, 0, 0), (1, 0, 0), (0, 1, 0)),
             ((0, 1, 0), (1, 0, 0), (0, 1, 0)), ((0, 0, 1), (0, 1, 0), (1, 0, 0))]
    rows = table(view_factors(faces(parts)))
    close(v, sum(rows[3, k][0] for k in range(3)), 1e-8)
    assert e < 1e-6


def test_blocked_plates_see_nothing_of_each_other():
    occluder = faces([((-5, -5, 0.5), (11, 0, 0), (0, 11, 0))], 3)
    for method in (AUTO, DENSE, HIERARCHICAL, MONTE_CARLO):
        f = view_factors(tagged(plates(n=4), np.repeat([0, 1], 16)), occluder, PatchArray="Patch",
                         Method=method)
        assert table(f) == {}
        close(cells(f, "ViewFactorSum"), np.zeros(32))
        blocked, error = cells(f, "BlockedViewFactor"), cells(f, "BlockedViewFactorError")
        assert (blocked + error > 0.98).all() and (blocked < 1).all()
    # Left out when asked, and bounded.
    f = view_factors(tagged(plates(n=4), np.repeat([0, 1], 16)), occluder, PatchArray="Patch",
                     Occlusion=OFF)
    close(table(f)[0, 1][0], 0.199824895698387, 1e-6)
    plan = f.GetOutputDataObject(2)
    row = strings(plan, "Effect").index("Occlusion")
    assert strings(plan, "Decision")[row] == "left out"
    assert plan.GetColumnByName("Bound").GetValue(row) >= 0.1998


def half_blocked(n):
    """Parallel unit squares 1 apart, an opaque half-plane between them up to x = 0.5: by symmetry
    and Sparrow's rule its own closed form is a sum of exchanges of strips; here by brute force."""
    return plates(n=n), faces([((-9, -9, 0.5), (9.5, 0, 0), (0, 19, 0))], 1)


def test_partly_blocked_within_the_stated_error():
    # Brute force on a fine grid of both squares: a segment is blocked where it crosses z = 1/2 at
    # x < 1/2.
    m = 48
    c = (np.arange(m) + 0.5) / m
    xs = c[:, None]
    weight = np.zeros((m, m))  # over pairs of x, integrated over y
    dy = c[:, None] - c[None, :]
    for i in range(m):
        r2 = (c[i] - c)[:, None, None] ** 2 + dy[None] ** 2 + 1.0
        weight[i] = (1.0 / (math.pi * r2 ** 2)).sum(axis=(1, 2)) / m ** 4
    middle = 0.5 * (xs + xs.T)
    exact = weight[middle > 0.5].sum() + 0.5 * weight[np.isclose(middle, 0.5)].sum()
    for method in (DENSE, HIERARCHICAL, MONTE_CARLO):
        data, occluder = half_blocked(4)
        tagged(data, np.repeat([0, 1], 16))
        v, e = table(view_factors(data, occluder, PatchArray="Patch", Method=method,
                                  RelativeTolerance=0.005))[0, 1]
        assert abs(v - exact) <= e + 2e-4 and e <= 0.006 * v, (method, v, e, exact)


def test_cube_in_cube_and_closure():
    for method in (DENSE, HIERARCHICAL, MONTE_CARLO):
        f = view_factors(joined(box((1, 1, 1), (2, 2, 2)), box((0, 0, 0), (3, 3, 3), inward=True)),
                         PatchArray="Patch", Method=method)
        rows = table(f)
        assert set(rows) == {(0, 1), (1, 0), (1, 1)}
        close(rows[0, 1][0], 1.0, 1e-12)
        close(rows[1, 0][0], 1 / 9, 1e-12)
        close(rows[1, 1][0], 8 / 9, 1e-12)
        close(cells(f, "ViewFactorSum"), np.ones(12), 1e-12)
        assert (cells(f, "EnvironmentViewFactor") <= cells(f, "EnvironmentViewFactorError")).all()
        assert field(f, "ClosureDefectAfter")[0] < 1e-12
        assert field(f, "ClosureDefectBefore")[0] < 0.02
        close(np.abs(cells(f, "ClosureDefect")).max(), field(f, "ClosureDefectBefore")[0], 1e-12)
    # Uncorrected, what was measured stays.
    f = view_factors(joined(box((1, 1, 1), (2, 2, 2)), box((0, 0, 0), (3, 3, 3), inward=True)),
                     PatchArray="Patch", Correction=False)
    close(field(f, "ClosureDefectAfter"), field(f, "ClosureDefectBefore"))


def test_sphere_interior():
    # F_ij = A_j/(4 pi R^2) as the mesh gets finer; sums to one on any.
    sphere = vtk.vtkSphereSource()
    sphere.SetThetaResolution(16)
    sphere.SetPhiResolution(10)
    sphere.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
    inward = vtk.vtkReverseSense()
    inward.SetInputConnection(sphere.GetOutputPort())
    inward.Update()
    f = view_factors(inward.GetOutput())
    rows = table(f)
    n = inward.GetOutput().GetNumberOfCells()
    close(cells(f, "ViewFactorSum"), np.ones(n), 1e-9)
    areas = field(f, "PatchAreas")
    mean = np.mean([v / areas[j] for (_, j), (v, _) in rows.items()])
    close(mean, 1 / areas.sum(), 0.05)
    # Reciprocity, to rounding.
    for (i, j), (v, _) in rows.items():
        assert abs(areas[i] * v - areas[j] * rows[j, i][0]) <= 1e-15


def test_street_canyon_of_view3d():
    path = shared("mesh/canyon/canyon_view3d.vs3")
    if path is None:
        print("no shared data: not run")
        return
    points, triangles, names = {}, [], []
    with open(path) as lines:
        for line in lines:
            word = line.split()
            if word[:1] == ["v"]:
                points[int(word[1])] = tuple(map(float, word[2:5]))
            elif word[:1] == ["s"]:
                triangles.append([int(w) - 1 for w in word[2:5]])
                names.append(word[-1])
    walls = sorted({n.rsplit("_", 1)[0] for n in names})
    patch = [walls.index(n.rsplit("_", 1)[0]) for n in names]
    data = tagged(mesh([points[k + 1] for k in range(len(points))], triangles), patch)
    with open(shared("mesh/canyon/canyon_view3d_base.json")) as file:
        wanted = json.load(file)
    with open(shared("mesh/canyon/canyon_view3d_raw.json")) as file:
        raw = json.load(file)
    view3d = 1e-5  # its integrals (eps=0.0001) are that far from the exact ones
    rows = table(view_factors(data, PatchArray="Patch"))
    close(rows[walls.index("road"), walls.index("east_side_2")][0], 0.026118, 1e-3)
    for i, a in enumerate(walls):
        for j, b in enumerate(walls):
            v, e = rows.get((i, j), (0.0, 0.0))
            assert abs(v - wanted[a][b]) <= e + view3d, (a, b, v, e, wanted[a][b])
    rows = table(view_factors(data))
    for i, a in enumerate(names):
        for j, b in enumerate(names):
            v, e = rows.get((i, j), (0.0, 0.0))
            assert abs(v - raw[a][b]) <= e + view3d, (a, b, v, e, raw[a][b])


def test_urban_scene_runs():
    path = shared("mesh/built/built_envmt.vtk")
    if path is None:
        print("no shared data: not run")
        return
    reader = vtk.vtkUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    f = view_factors(reader.GetOutput())
    rows = table(f)
    assert len(rows) > 100
    values = np.array([v for v, _ in rows.values()])
    errors = np.array([e for _, e in rows.values()])
    assert np.isfinite(values).all() and (values > 0).all() and (values < 1).all()
    assert (errors <= np.maximum(0.0101 * values, 1.01e-4)).mean() > 0.95
    everything = sum(cells(f, n) for n in ("ViewFactorSum", "EnvironmentViewFactor",
                                           "BlockedViewFactor"))
    close(everything, np.ones(len(everything)), 0, 0.02)
    sky, ground = cells(f, "SkyViewFactor"), cells(f, "GroundViewFactor")
    close(sky + ground, cells(f, "EnvironmentViewFactor"), 0, 0.02)


def test_sky_and_ground():
    # An open floor sees the sky alone, a ceiling the ground, a wall half of each.
    x, y, z = np.eye(3)
    for (a, b), sky in (((x, y), 1.0), ((y, x), 0.0), ((x, z), 0.5)):
        f = view_factors(faces([(np.zeros(3), a, b)]))
        assert table(f) == {}
        close(cells(f, "SkyViewFactor"), [sky], 1e-12)
        close(cells(f, "GroundViewFactor"), [1 - sky], 1e-12)
        close(cells(f, "EnvironmentViewFactor"), [1.0], 1e-12)
    close(cells(view_factors(faces([(np.zeros(3), x, z)]), SkyUp=(0, -2, 0)), "SkyViewFactor"),
          [1.0], 1e-12)
    # In an endless street of height = width the floor's middle sees 1/sqrt(5) ... of a long one.
    floor = faces([((-0.01, -0.01, 0), 0.02 * x, 0.02 * y)])
    walls = faces([((-0.5, -200, 0), 400 * y, z), ((0.5, -200, 0), z, 400 * y)])
    f = view_factors(joined(floor, walls), PatchArray="Patch", RelativeTolerance=1e-3)
    close(cells(f, "SkyViewFactor")[0], 1 / math.sqrt(5), 2e-4)
    rows = table(view_factors(joined(floor, walls), PatchArray="Patch", EnvironmentRows=True))
    close(rows[0, 1][0] + rows[0, -1][0], 1.0, 1e-6)


def test_two_sided_cells():
    # A two-sided plate between two one-sided ones sees each with one side: half of its area.
    x, y, z = np.eye(3)
    data = faces([(0 * x, x, y), (0.5 * z, x, y), (z, y, x)])
    tagged(data, [0, 1, 0], "TwoSided", np.int8)
    rows = table(view_factors(data))
    v = 0.415253283577  # unit squares at half their side
    close(rows[0, 1][0], v, 1e-6)
    close(rows[1, 0][0], v / 2, 1e-6)
    close(rows[1, 2][0], v / 2, 1e-6)
    close(rows[2, 1][0], v, 1e-6)
    assert (0, 2) not in rows  # what crosses half way crosses the plate
    f = view_factors(data, BackFaces=OFF)
    assert (0, 1) not in table(f) and (1, 2) in table(f)
    assert cells(f, "BlockedViewFactor")[0] > 0.3
    plan = f.GetOutputDataObject(2)
    assert strings(plan, "Decision")[strings(plan, "Effect").index("BackFaces")] == "left out"


def test_negative_patches_only_block():
    data = faces([((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((0, 0, 1), (0, 1, 0), (1, 0, 0)),
                  ((-5, -5, 0.5), (11, 0, 0), (0, 11, 0))])
    f = view_factors(tagged(data, [3, 4, -7]), PatchArray="Patch")
    assert table(f) == {}
    assert list(field(f, "PatchIds")) == [3, 4]
    close(cells(f, "ViewFactorSum"), np.zeros(3))


def test_composite_surface_keeps_its_blocks():
    blocks = vtk.vtkMultiBlockDataSet()
    for k, part in enumerate((plates(), faces([((0, 0, 0), (0, 1, 0), (0, 0, 1))]))):
        blocks.SetBlock(k, part)
    f = view_factors(blocks)
    rows = table(f)
    assert {i for i, _ in rows} == {0, 1, 2}
    out = f.GetOutputDataObject(0)
    assert out.GetNumberOfBlocks() == 2 and out.GetBlock(1).GetNumberOfCells() == 1
    close(array(out.GetBlock(1).GetCellData(), "ViewFactorSum"),
          [rows[2, 0][0] + rows[2, 1][0]], 1e-12)


def test_degenerate_scenes():
    f = view_factors(vtk.vtkPolyData())
    assert table(f) == {} and f.GetOutputDataObject(0).GetNumberOfCells() == 0
    one = faces([((0, 0, 0), (1, 0, 0), (0, 1, 0))])
    assert table(view_factors(one)) == {}
    apart = faces([((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((3, 0, 0), (1, 0, 0), (0, 1, 0))])
    assert table(view_factors(apart)) == {}
    # A cell without area is a patch that sees nothing.
    line = mesh([(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 0, 1), (0, 1, 1), (1, 0, 1)],
                [(0, 1, 2), (3, 4, 5)])
    f = view_factors(line)
    assert table(f) == {}
    close(cells(f, "EnvironmentViewFactor"), [0.0, 1.0], 1e-12)


def test_duplicates_are_told_and_scaled():
    data = joined(*(box((0, 0, 0), (1, 1, 1), inward=True) for _ in range(2)))
    f = view_factors(data, PatchArray="Patch")
    rows = table(f)
    assert field(f, "LargestViewFactorSum")[0] > 1.9
    assert "duplicates" in field(f, "RadiometryOutcome")[0]
    for i in (0, 1):
        assert rows[i, 0][0] + rows[i, 1][0] <= 1 + 1e-12
    assert (np.abs(cells(f, "ClosureDefect")) > 0.9).all()


def test_far_from_the_origin_and_any_scale():
    exact = 0.200043776075403
    for scale, shift in ((1.0, (5e5, 4e6, 0)), (1e-6, (0, 0, 0)), (1e6, (0, 0, 0))):
        x, y, z = np.eye(3) * scale
        o = np.asarray(shift, float)
        data = tagged(faces([(o, x, y), (o, y, z)], 2), np.repeat([0, 1], 4))
        v, _ = table(view_factors(data, PatchArray="Patch"))[0, 1]
        close(v, exact, 1e-7)


def test_threads_give_the_same_bytes():
    data, occluder = half_blocked(4)
    for method in (DENSE, HIERARCHICAL, MONTE_CARLO):
        results = []
        for threads in (1, 2, 7):
            f = view_factors(data, occluder, Method=method, NumberOfThreads=threads,
                             RelativeTolerance=0.05, AbsoluteTolerance=1e-3)
            rows = table(f)
            results.append((np.array(list(rows.values())).tobytes(), tuple(rows),
                            cells(f, "SkyViewFactor").tobytes()))
        assert results[0] == results[1] == results[2], method


def test_field_data_explain_the_result():
    f = view_factors(plates())
    f.Update()
    for port in (0, 1):
        assert "Dense" in field(f, "RadiometryMethod", port)[0]
        assert "Tolerance met" in field(f, "RadiometryOutcome", port)[0]
        assert "RelativeTolerance=0.01" in field(f, "RadiometryOptions", port)[0]
        for name in ("ClosureDefectBefore", "ClosureDefectAfter", "ReciprocityDefectBefore",
                     "ReciprocityDefectAfter", "LargestCorrection"):
            assert np.isfinite(field(f, name, port)).all()
    convergence = f.GetOutputDataObject(3)
    assert convergence.GetNumberOfRows() >= 2
    close(strings(convergence, "Seconds"), sorted(strings(convergence, "Seconds")))


def test_plan_says_what_was_left_out():
    data, occluder = half_blocked(4)
    f = view_factors(tagged(data, np.repeat([0, 1], 16)), occluder, PatchArray="Patch",
                     Occlusion=2)
    f.Update()
    plan = f.GetOutputDataObject(2)
    names = [plan.GetColumnName(k) for k in range(plan.GetNumberOfColumns())]
    assert names == ["Effect", "Switch", "Decision", "Bound", "Unit", "Seconds", "Why"]
    row = strings(plan, "Effect").index("Occlusion")
    assert strings(plan, "Decision")[row] == "left out" and strings(plan, "Switch")[row] == "Off"
    with_shadow = view_factors(tagged(data, np.repeat([0, 1], 16)), occluder, PatchArray="Patch")
    change = table(f)[0, 1][0] - table(with_shadow)[0, 1][0]
    assert 0.0 < change <= strings(plan, "Bound")[row]
    assert "Occlusion is left out" in f.Explain()
    assert f.Explain().splitlines() == list(field(f, "EffectPlan"))


def test_predicts_its_time_and_keeps_its_budget():
    data, occluder = half_blocked(4)
    f = view_factors(tagged(data, np.repeat([0, 1], 16)), occluder, PatchArray="Patch",
                     RelativeTolerance=1e-5, AbsoluteTolerance=0, TimeBudget=1)
    assert f.PredictSeconds() > 0
    assert f.GetOutputDataObject(1).GetNumberOfRows() == 0  # a pilot has no results
    f.Update()
    cost = field(f, "RadiometryCost")[0]
    assert cost[2] < cost[0] and 0.2 < cost[1] / cost[0] < 5, cost  # a loaded machine
    assert f.GetPredictedSeconds() == cost[1]
    assert f.GetElapsedSeconds() < 2.5, cost  # rounds that would not fit are not begun


def test_time_budget_ends_the_run_and_says_so():
    data, occluder = half_blocked(4)
    f = view_factors(tagged(data, np.repeat([0, 1], 16)), occluder, PatchArray="Patch",
                     RelativeTolerance=1e-7, AbsoluteTolerance=0, TimeBudget=0.2)
    v, e = table(f)[0, 1]
    assert e > 1e-7 * v
    assert "Time budget" in field(f, "RadiometryOutcome")[0]


def test_bad_input_is_named():
    data = tagged(plates(), [0, 1])
    fails(view_factors(data, PatchArray="Nothing"), "Nothing", "missing")
    fails(view_factors(tagged(data, [0, math.nan], "A", float), PatchArray="A"), "A[1]", "nan")
    fails(view_factors(tagged(data, [0, 0.5], "A", float), PatchArray="A"), "A[1]", "0.5", "integer")
    points = numpy_to_vtk(np.zeros(8), deep=True)
    points.SetName("P")
    data.GetPointData().AddArray(points)
    fails(view_factors(data, PatchArray="P"), "P", "point data")
    three = numpy_to_vtk(np.zeros((2, 3), np.int32), deep=True)
    three.SetName("T")
    data.GetCellData().AddArray(three)
    fails(view_factors(data, PatchArray="T"), "T", "3 components")
    words = vtk.vtkStringArray()
    words.SetName("W")
    words.SetNumberOfValues(2)
    data.GetCellData().AddArray(words)
    fails(view_factors(data, PatchArray="W"), "W", "not of numbers")
    fails(view_factors(data, RelativeTolerance=-1), "RelativeTolerance")
    fails(view_factors(data, SkyUp=(0, 0, 0)), "SkyUp")
    fails(view_factors(data, MetersPerUnit=0), "MetersPerUnit")
    fails(view_factors(plates(n=12), MemoryLimit=1e-3), "MemoryLimit", "MiB")
    # Whole numbers are integers, whatever they are stored as.
    assert set(table(view_factors(tagged(data, [0, 1], "D", float), PatchArray="D"))) == {
        (0, 1), (1, 0)}


def test_example_street():
    path = os.path.join(SOURCE_DIR, "examples", "street", "street.py")
    spec = importlib.util.spec_from_file_location("street", path)
    street = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(street)
    out = street.main().GetCellData()
    kind, sky = array(out, "Kind"), array(out, "SkyViewFactor")
    ground = array(out, "GroundViewFactor")
    assert (ground[kind != street.WALLS] == 0).all()
    walls = kind == street.WALLS
    assert (sky[walls] <= 0.5 + array(out, "SkyViewFactorError")[walls]).all()
    assert sky[kind == street.ROOFS].min() > 0.8 > sky[kind == street.GROUND].mean()
    everything = sum(array(out, n) for n in ("ViewFactorSum", "EnvironmentViewFactor",
                                             "BlockedViewFactor"))
    close(everything, np.ones(len(sky)), 0, 0.03)


def test_abort_leaves_nothing():
    f = view_factors(plates(n=6))
    f.AddObserver("ProgressEvent", lambda o, e: o.SetAbortExecute(1))
    f.Update()
    assert f.GetOutputDataObject(0).GetNumberOfCells() == 0
    assert f.GetOutputDataObject(1).GetNumberOfRows() == 0


run_all(globals())
