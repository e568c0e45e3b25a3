# SPDX-License-Identifier: BSD-3-Clause
"""Interreflection on surfaces in parts, beside the same of one process. Run by test_ranks_radiosity.py
in pvbatch --sym: every rank goes through all checks."""
import numpy as np
import vtkmodules.all as vtk
from checks import Errors, array, simulation
from rank_parts import Alone, Scene, in_ranks, rank, set_array, size
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkradiometry import vtkPointLightSource, vtkRadiosityFilter

DENSE, HIERARCHICAL, MONTE_CARLO = 1, 2, 3
OFF = 2


def cavity(n=4):
    """A closed box with a smaller one inside."""
    scene = Scene()
    scene.add_box((0.7, 0.6, 0.0), (1.2, 1.3, 1.0), max(1, n // 2), DiffuseReflectance=0.7)
    inside = Scene().add_box((0, 0, 0), (2, 2, 2), n, DiffuseReflectance=0.5)
    first = len(scene.points)
    scene.points += inside.points
    scene.polygons += [[first + p for p in reversed(cell)] for cell in inside.polygons]
    scene.arrays["DiffuseReflectance"] += [0.3 + 0.1 * (c % 5) for c in range(len(inside.polygons))]
    return scene


CAVITY = cavity()
CELLS = len(CAVITY.polygons)
MIXED = np.array([(7 * c + c // 5) % size() for c in range(CELLS)])
LAST = np.minimum(MIXED, max(0, size() - 2))  # nothing is left for the last rank


def lamp(x=1.5, intensity=3.0):
    light = vtkPointLightSource()
    light.SetPosition(x, 0.5, 1.6)
    light.SetIntensity(intensity)
    return light


def radiosity(data, *lights, alone=False, **properties):
    f = simulation(vtkRadiosityFilter, data, *lights, **{"RelativeTolerance": 0.1, **properties})
    return Alone(f) if alone else f


def result(f, name="Irradiance", points=False):
    f.Update()
    out = f.GetOutputDataObject(0)
    return array(out.GetPointData() if points else out.GetCellData(), name)


def agree(value, expected, relative=1e-12):
    assert value.shape == expected.shape, (value.shape, expected.shape)
    if relative == 0.0:
        assert value.tobytes() == expected.tobytes(), np.abs(value - expected).max()
    scale = np.abs(expected).max(initial=0.0)
    assert scale > 0.0 or expected.size == 0
    worst = np.abs(value - expected).max(initial=0.0)
    assert worst <= relative * scale, (worst / scale, relative)


def method(number, **properties):
    owner = LAST if number == DENSE else MIXED
    part, cells = CAVITY.part(owner, rank())
    properties = dict(Method=number, **properties)
    whole = radiosity(CAVITY.whole(), lamp(), alone=True, **properties)
    f = radiosity(part, lamp(), **properties)
    relative = 0.0 if number == MONTE_CARLO else 1e-12
    for name in ("Irradiance", "Radiosity"):
        agree(result(f, name), result(whole, name)[cells], relative)
    # The error is a bound that rests on more sums.
    agree(result(f, "IrradianceError"), result(whole, "IrradianceError")[cells],
          0.0 if number == MONTE_CARLO else 1e-9)
    # Another light, on what was kept.
    other = lamp(0.3, 5.0)
    for g in (f, whole):
        g.RemoveLightsConnections()
        g.AddLightsConnection(other.GetOutputPort())
    agree(result(f), result(whole)[cells], relative)


def check_dense():
    method(DENSE, Refinement=OFF)


def check_hierarchical():
    method(HIERARCHICAL, Refinement=OFF)


def check_monte_carlo():
    method(MONTE_CARLO, Refinement=OFF)


def check_refinement_as_the_method_likes():
    part, cells = CAVITY.part(MIXED, rank())
    whole = radiosity(CAVITY.whole(), lamp(), alone=True)
    f = radiosity(part, lamp())
    agree(result(f), result(whole)[cells])
    agree(result(f, "IrradianceError"), result(whole, "IrradianceError")[cells], 1e-9)
    for port in (1, 2):
        rows = f.GetOutputDataObject(port).GetNumberOfRows()
        assert (rows > 0) == (rank() == 0), (rank(), rows)


def check_points():
    properties = dict(SampleLocation=1, Method=DENSE, Refinement=OFF)
    whole = radiosity(CAVITY.whole(), lamp(), alone=True, **properties)
    expected = result(whole, points=True)
    polygons = whole.GetOutputDataObject(0).GetPolys()
    at, offsets = (vtk_to_numpy(a) for a in (polygons.GetConnectivityArray(),
                                             polygons.GetOffsetsArray()))
    part, cells = CAVITY.part(MIXED, rank())
    f = radiosity(part, lamp(), **properties)
    values = result(f, points=True)
    mine = vtk_to_numpy(f.GetOutputDataObject(0).GetPolys().GetConnectivityArray())
    agree(values[mine], expected[np.concatenate([at[offsets[c]:offsets[c + 1]] for c in cells])])


def check_emitters_and_no_lights():
    scene = cavity()
    scene.arrays["EmittedExitance"] = [10.0 if c == 3 else 0.0 for c in range(CELLS)]
    part, cells = scene.part(MIXED, rank())
    whole = radiosity(scene.whole(), alone=True, Method=DENSE, Refinement=OFF)
    agree(result(radiosity(part, Method=DENSE, Refinement=OFF)), result(whole)[cells])


def check_mirrors_and_panes():
    """What rays follow over surfaces; the plan decides for MonteCarlo."""
    scene = cavity(3)
    count = len(scene.polygons)
    scene.arrays["SpecularReflectance"] = [0.15 if c % 3 == 0 else 0.0 for c in range(count)]
    scene.arrays["Transmittance"] = [0.1 if c < 12 else 0.0 for c in range(count)]
    part, cells = scene.part([(7 * c) % size() for c in range(count)], rank())
    properties = dict(Method=MONTE_CARLO, Refinement=OFF)
    whole = radiosity(scene.whole(), lamp(), alone=True, **properties)
    agree(result(radiosity(part, lamp(), **properties)), result(whole)[cells], 0.0)


def check_errors_end_all():
    scene = Scene().add_box((0, 0, 0), (2, 2, 2), 3)
    scene.polygons = [list(reversed(cell)) for cell in scene.polygons]
    scene.arrays["DiffuseReflectance"] = [1.0] * len(scene.polygons)  # closed, nothing is lost
    MIXED = [(7 * c + c // 5) % size() for c in range(len(scene.polygons))]
    part, _ = scene.part(MIXED, rank())
    for data, words in ((part, "reflectance"), (part, "rank 0: MemoryLimit")):
        f = radiosity(data, lamp())
        if "Memory" in words and rank() == 0:
            f.SetMemoryLimit(-1.0)
        errors = Errors(f)
        f.Update()
        assert len(errors.messages) == 1 and words in errors.messages[0], errors.messages
        assert f.GetOutputDataObject(0).GetNumberOfCells() == 0


def check_a_time_budget():
    part, _ = CAVITY.part(MIXED, rank())
    f = radiosity(part, lamp(), TimeBudget=0.3, RelativeTolerance=1e-3)
    assert np.isfinite(result(f)).all()


in_ranks(globals())
