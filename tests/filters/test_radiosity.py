# SPDX-License-Identifier: BSD-3-Clause
"""The radiosity filter: closed forms of cavities and pairs, invariants, bad input refused."""
import math

import numpy as np
import vtkmodules.all as vtk
from checks import array, close, fails, run_all, simulation, strings, sun
from checks import cell_values as values
from rooms import areas, faces, grid, lamp, room, with_array
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkradiometry import vtkPointLightSource, vtkRadiosityFilter

AUTO, DENSE, HIERARCHICAL, MONTE_CARLO = range(4)
OFF = 2
K = 683.002


def radiosity(data, *lights, **properties):
    return simulation(vtkRadiosityFilter, data, *lights, **properties)


def mean(f, name="Irradiance"):
    v = values(f, name)
    a = areas(f.GetOutput(0))
    return (v * a).sum() / a.sum()


def test_cube_of_four_metres():
    # REFERENCES: Phi/(S (1 - rho)), 10 000 lm, S = 96 m^2.
    for rho in (0.0, 0.2, 0.5, 0.8, 0.9, 0.95):
        for n in (1, 3):
            f = radiosity(room(4, n), lamp((1.7, 2.1, 3.0), 10000), DiffuseReflectance=rho,
                          Photometric=True)
            close(mean(f, "Illuminance"), 10000 / 96 / (1 - rho), 1e-3)


def test_small_emitters_keep_the_time_budget():
    # A lamp of surfaces that emit, behind leaves: its light is asked for with far too small a tolerance.
    rng = np.random.default_rng(4)
    points = vtk.vtkPoints()
    polys = vtk.vtkCellArray()

    def add(corners):
        polys.InsertNextCell(len(corners), [points.InsertNextPoint(*c) for c in corners])

    for x in range(20):
        for y in range(20):
            add([(x, y, 0), (x + 1, y, 0), (x + 1, y + 1, 0), (x, y + 1, 0)])
    for x, y in ((9, 9), (10, 9), (9, 10), (10, 10)):
        add([(x, y, 6), (x, y + 1, 6), (x + 1, y + 1, 6), (x + 1, y, 6)])
    for center in rng.uniform((5, 5, 2), (15, 15, 5), (300, 3)):
        add(center + rng.uniform(-0.6, 0.6, (3, 3)))
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(polys)
    emitted = np.r_[np.zeros(400), np.full(4, 100.0), np.zeros(300)]
    data = with_array(data, "EmittedExitance", emitted)
    hasty = radiosity(data, RelativeTolerance=1e-6, TimeBudget=0.5)
    assert hasty.GetElapsedSeconds() < 2.0, hasty.GetElapsedSeconds()
    slow = radiosity(data, RelativeTolerance=0.05, Method=MONTE_CARLO)
    apart = np.abs(values(hasty, "Irradiance") - values(slow, "Irradiance"))
    within = np.hypot(values(hasty, "IrradianceError"), values(slow, "IrradianceError"))
    assert (apart <= within).mean() >= 0.93, (apart <= within).mean()


def test_nearly_white_cavity():
    for rho in (0.99, 0.9999, 0.999999):
        f = radiosity(room(1, 2), lamp((0.4, 0.5, 0.6), 100 * K), DiffuseReflectance=rho,
                      Refinement=OFF, Method=DENSE, RelativeTolerance=1e-8)
        close(mean(f), 100 / 6 / (1 - rho), 1e-6)


def test_sphere_interior():
    sphere = vtk.vtkSphereSource()
    sphere.SetThetaResolution(20)
    sphere.SetPhiResolution(12)
    inward = vtk.vtkReverseSense()
    inward.SetInputConnection(sphere.GetOutputPort())
    inward.Update()
    for rho in (0.0, 0.5, 0.9):
        data = with_array(inward.GetOutput(), "EmittedExitance", 3.0)
        f = radiosity(data, DiffuseReflectance=rho)
        b = values(f, "Radiosity")
        error = values(f, "RadiosityError")
        exact = 3.0 / (1 - rho)
        # Closed with uniform M and rho: B is the same everywhere, whatever the mesh.
        assert (np.abs(b - exact) <= np.maximum(error, 1e-9)).mean() >= 0.95
        close(b, np.full(len(b), exact), 0.01)
        close(values(f, "Radiance"), b / math.pi)


def test_perpendicular_squares():
    # A floor of reflectance 0.3 under 1000 W/m^2, a black wall on its edge.
    for n in (1, 4):
        data = faces([((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((0, 0, 0), (0, 1, 0), (0, 0, 1))], n)
        rho = np.where(np.arange(2 * n * n) < n * n, 0.3, 0.0)
        f = radiosity(with_array(data, "DiffuseReflectance", rho), sun((0, 0, -1), 1000.0))
        e = values(f, "Irradiance")
        close(e[:n * n], np.full(n * n, 1000.0), 1e-9)
        close(e[n * n:].mean(), 300 * 0.200043776075403, 1e-4)
        absorbed = (e - values(f, "Radiosity"))[:n * n].mean()
        close(absorbed, 700.0, 1e-9)


def test_blocked_plates_exchange_nothing():
    plates = faces([((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((0, 0, 2), (0, 1, 0), (1, 0, 0))], 2)
    data = with_array(plates, "EmittedExitance", np.r_[np.full(4, 5.0), np.zeros(4)])
    f = radiosity(data)
    open_ = values(f, "Irradiance")
    assert (open_[4:] > 0.1).all()
    f = radiosity(data)
    f.AddOccludersData(faces([((-5, -5, 1), (11, 0, 0), (0, 11, 0))], 1))
    close(values(f, "Irradiance"), np.zeros(8))


def test_methods_agree_within_their_errors():
    data = room(3, 4)
    rho = np.linspace(0.2, 0.8, data.GetNumberOfCells())
    with_array(data, "DiffuseReflectance", rho)
    box = vtk.vtkCubeSource()
    box.SetCenter(1.5, 1.5, 0.6)
    append = vtk.vtkAppendPolyData()
    append.AddInputData(data)
    box.Update()
    append.AddInputData(with_array(box.GetOutput(), "DiffuseReflectance", 0.5))
    append.Update()
    light = lamp((0.6, 0.8, 2.7), 1000 * K)
    runs = [radiosity(append.GetOutput(), light, Method=m, RelativeTolerance=0.04)
            for m in (DENSE, MONTE_CARLO)]
    e = [values(f, "Irradiance") for f in runs]
    error = [values(f, "IrradianceError") for f in runs]
    assert (np.abs(e[0] - e[1]) <= error[0] + error[1]).mean() >= 0.95
    close(mean(runs[0]), mean(runs[1]), 0.02)
    for f, word in zip(runs, ("ense", "onte")):
        assert word in array(f.GetOutput(0).GetFieldData(), "RadiometryMethod")[0]
        plan = f.GetOutputDataObject(1)
        assert [e for e in strings(plan, "Effect") if e.startswith("Error: ")] == [
            "Error: direct light", "Error: form factors", "Error: visibility",
            "Error: discretisation", "Error: solver"]


def test_interreflection_off_is_direct_light_and_bounded():
    data = room(2, 2)
    light = lamp((1, 1.2, 1.5), 1000)
    full = radiosity(data, light, DiffuseReflectance=0.6)
    direct = radiosity(data, light, DiffuseReflectance=0.6, Interreflection=OFF)
    change = np.abs(values(full, "Irradiance") - values(direct, "Irradiance")).max()
    plan = direct.GetOutputDataObject(1)
    row = strings(plan, "Effect").index("Interreflection")
    assert strings(plan, "Decision")[row] == "left out"
    assert 0 < change <= plan.GetColumnByName("Bound").GetValue(row)


def test_two_sided_plate_lights_both_rooms():
    # A two-sided black plate between two emitters receives on each side what that side sees.
    h = 0.5
    data = faces([((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((0, 0, h), (1, 0, 0), (0, 1, 0)),
                  ((0, 0, 2 * h), (0, 1, 0), (1, 0, 0))], 2)
    with_array(data, "EmittedExitance", np.r_[np.full(4, 1.0), np.zeros(4), np.full(4, 3.0)])
    with_array(data, "TwoSided", np.r_[np.zeros(4), np.ones(4), np.zeros(4)])
    f = radiosity(data, DiffuseReflectance=0.0)
    front, back = values(f, "Irradiance")[4:8], values(f, "IrradianceBack")[4:8]
    exact = 0.415253283577  # unit squares at half their side, the closed form
    # Each quarter of the plate sees the same by symmetry.
    for side, factor in ((front, 3.0), (back, 1.0)):
        close(side, np.full(4, factor * exact), 0.01)
    for name, factor in (("Irradiance", 3.0), ("IrradianceBack", 1.0)):
        error = values(f, name + "Error")[4:8]
        assert (np.abs(values(f, name)[4:8] - factor * exact) <= error).all(), (name, error)
        assert (error <= 0.01 * factor).all()


def test_threads_give_the_same_bytes():
    data = room(2, 3)
    for method in (DENSE, MONTE_CARLO):
        results = []
        for threads in (1, 2, 7):
            f = radiosity(data, lamp((1, 1.2, 1.5), 1000), Method=method, NumberOfThreads=threads,
                          RelativeTolerance=0.05)
            results.append(values(f, "Irradiance").tobytes() + values(f, "RadiosityError").tobytes())
        assert results[0] == results[1] == results[2], method


def test_degenerate_scenes():
    light = sun((0, 0, -1), 2.0)
    f = radiosity(vtk.vtkPolyData(), light)
    f.Update()
    assert f.GetOutput(0).GetNumberOfCells() == 0
    one = faces([((0, 0, 0), (1, 0, 0), (0, 1, 0))], 1)
    close(values(radiosity(one, light), "Radiosity"), [1.0])
    close(values(radiosity(one), "Radiosity"), [0.0])  # no light
    two = faces([((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((0, 0, -1), (1, 0, 0), (0, 1, 0))], 1)
    close(values(radiosity(two, light), "Irradiance"), [2.0, 0.0], 1e-12)
    close(values(radiosity(room(1, 2), DiffuseReflectance=0.0), "Radiosity"), np.zeros(24))


def test_points_are_smooth_and_agree_with_cells():
    data = room(2, 6)
    light = lamp((1.0, 1.0, 1.3), 1000 * K)
    cells = radiosity(data, light, DiffuseReflectance=0.5)
    f = radiosity(data, light, DiffuseReflectance=0.5, SampleLocation=1)
    f.Update()
    out = f.GetOutput(0)
    e = array(out.GetPointData(), "Irradiance")
    assert np.isfinite(e).all() and (e > 0).all()
    close(array(out.GetPointData(), "Radiosity"), 0.5 * e, 1e-12)
    # The mean of each cell's corner values is its average but for curvature.
    corners = [np.mean([e[out.GetCell(c).GetPointId(k)] for k in range(4)])
               for c in range(out.GetNumberOfCells())]
    close(np.array(corners), values(cells, "Irradiance"), 0.06)


def test_bad_input_is_named():
    light = lamp((0.5, 0.5, 0.5), 1000)
    fails(radiosity(room(1, 2), light, DiffuseReflectance=1.0), "losed")
    fails(radiosity(room(1, 8), light, MemoryLimit=0.01), "MemoryLimit", "MiB")
    fails(radiosity(with_array(room(1, 2), "DiffuseReflectance", math.nan), light),
          "DiffuseReflectance[0] = nan")
    # Open with reflectance 1 is fine.
    one = faces([((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((0, 0, 0), (0, 1, 0), (0, 0, 1))], 2)
    f = radiosity(one, sun((0, 0, -1), 1.0), DiffuseReflectance=1.0)
    assert np.isfinite(values(f, "Radiosity")).all()


def test_abort_leaves_nothing():
    f = radiosity(room(2, 8), lamp((1, 1, 1), 1000))
    f.AddObserver("ProgressEvent", lambda o, e: o.SetAbortExecute(1))
    f.Update()
    assert f.GetOutputDataObject(0).GetNumberOfCells() == 0


run_all(globals())
