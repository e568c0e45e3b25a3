# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of any name, type, length and content on surfaces, lights and sensors, and properties of any
value: a simulating filter gives a result that is a number everywhere, or one error of one line and
empty outputs. It never crashes and never gives NaN or less than nothing.

nonsense.py FILTER [--first SEED] [--count N] [--timed]    any seed again: --first SEED --count 1
With --timed, on a quiet machine, a run must also keep its time budget within half a second.
"""
import argparse
import faulthandler
import time
from math import inf, nan

import numpy as np
from hardcases import KINDS, Errors, array, light_data, polydata, room, sensors
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkradiometry import vtkIrradianceFilter, vtkRadiosityFilter

NAMES = ["DiffuseReflectance", "SpecularReflectance", "Shininess", "EmittedExitance", "Transmittance",
         "Ambient", "TwoSided", "BackDiffuseReflectance", "BackEmittedExitance", "LightType",
         "Intensity", "Direction", "SpotCutoff", "SpotInnerCutoff", "SpotExponent", "Attenuation",
         "LightEnabled", "AmbientColor", "SpecularColor", "PhotometricWeb", "AttachedTo", "Normals",
         "ReferenceDirection", "LightTwoSided", "SkyModel", "SkyCoefficients", "SunDirection",
         "EnvironmentMap", "Irradiance", "IrradianceError", "PhotometricWeb0",
         "PhotometricWeb0Horizontal", "PhotometricWeb0Vertical", "EnvironmentMap0",
         "EnvironmentMap0Size", "LuminousEfficacy", "Photometric", "BackSpecularReflectance",
         "DiffuseTransmittance", "vtkGhostType"]
TYPES = [np.float64, np.float32, np.int32, np.int8, np.uint8, np.int64, np.uint64]
NUMBERS = [0.0, 1.0, -1.0, 0.5, 2.0, 3.0, 4.0, 45.0, 90.0, 180.0, 1e-300, 5e-324, 1e30, 1e300, -1e300,
           nan, inf, -inf]


def numbers(rng, shape):
    """Mostly numbers between 0 and 1, sometimes anything."""
    values = rng.random(shape)
    if rng.random() < 0.6:
        wild = rng.random(shape) < rng.choice([0.02, 0.5, 1.0])
        values = np.where(wild, rng.choice(NUMBERS, shape), values)
    return values


def add_nonsense(rng, data):
    for _ in range(rng.integers(0, 4)):
        where = rng.integers(0, 3)
        attributes = (data.GetPointData(), data.GetCellData(), data.GetFieldData())[where]
        right = (data.GetNumberOfPoints(), data.GetNumberOfCells(), 1)[where]
        tuples = int(max(0, rng.choice([right] * 6 + [0, 1, right - 1, right + 1, 2 * right])))
        name = str(rng.choice(NAMES))
        if rng.random() < 0.05:
            words = vtkStringArray()
            words.SetName(name)
            words.SetNumberOfValues(tuples)
            attributes.AddArray(words)
            continue
        shape = (tuples, int(rng.choice([1, 1, 1, 2, 3, 3, 4, 9])))
        with np.errstate(invalid="ignore", over="ignore"):
            values = numbers(rng, shape).astype(rng.choice(TYPES))
        made = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        made.SetName(name)
        made.SetNumberOfComponents(shape[1])
        attributes.AddArray(made)


def surface(rng):
    p, q = room()
    kind = rng.integers(0, 6)
    if kind == 0:
        places = rng.uniform(-1.5, 1.5, (6, 3))
        return sensors(places, rng.normal(size=(6, 3)))
    if kind == 1:  # few points, cells that repeat and collapse them
        n = int(rng.integers(1, 6))
        cells = [rng.integers(0, n, rng.integers(1, 7)) for _ in range(rng.integers(1, 6))]
        which = dict(zip(("polygons", "strips", "lines", "verts"), ([], [], [], [])))
        for cell in cells:
            which[str(rng.choice(list(which)))].append(cell)
        return polydata(numbers(rng, (n, 3)), **which)
    if kind == 2:
        return polydata(numbers(rng, (4, 3)) * rng.choice([1, 1e-30, 1e30, 1e59]), [(0, 1, 2), (0, 2, 3)])
    keep = rng.integers(0, len(q), 30)
    return polydata(p, [q[k] for k in keep])


PROPERTIES = {
    "RelativeTolerance": lambda rng: rng.choice([0.01, 0.1, 0.0, 1.0, -1.0, 2.0, nan, inf]),
    "AbsoluteTolerance": lambda rng: rng.choice([0.0, 1e-3, 1e30, -1.0, nan, inf]),
    "TimeBudget": lambda rng: rng.choice([0.0, 1e-6, 0.2, -1.0, nan, inf]),
    "MemoryLimit": lambda rng: rng.choice([0.0, 1e-6, 100.0, -1.0, nan]),
    "MetersPerUnit": lambda rng: rng.choice([1.0, 1e-3, 1e9, 0.0, -1.0, nan, inf, 1e-300, 1e300]),
    "NumberOfThreads": lambda rng: int(rng.choice([0, 1, 2, 7, -3, 100000])),
    "SampleLocation": lambda rng: int(rng.choice([0, 1, 2, -1])),
    "TwoSided": lambda rng: bool(rng.integers(2)),
    "FeatureAngle": lambda rng: rng.choice([0.0, 30.0, 180.0, -10.0, 400.0, nan, inf]),
    "DiffuseReflectance": lambda rng: rng.choice([0.0, 0.5, 1.0, -0.1, nan]),
    "LuminousEfficacy": lambda rng: rng.choice([683.002, 1.0, 0.0, -5.0, nan, inf]),
    "Photometric": lambda rng: bool(rng.integers(2)),
    "Occlusion": lambda rng: int(rng.choice([0, 1, 2, 3, -1])),
    "SpotShape": lambda rng: int(rng.choice([0, 1, 2, 7])),
    "Attenuation": lambda rng: int(rng.choice([0, 1, 2])),
    "BackFaces": lambda rng: int(rng.choice([0, 1, 2])),
    "Emission": lambda rng: int(rng.choice([0, 1, 2])),
    "Environment": lambda rng: int(rng.choice([0, 1, 2])),
    "Transmission": lambda rng: int(rng.choice([0, 1, 2])),
}
RADIOSITY_PROPERTIES = {
    "Method": lambda rng: int(rng.choice([0, 1, 2, 3, 7, -1])),
    "Refinement": lambda rng: int(rng.choice([0, 1, 2, 5])),
    "Interreflection": lambda rng: int(rng.choice([0, 1, 2])),
    "SpecularTransport": lambda rng: int(rng.choice([0, 1, 2])),
}
# The filter, its further properties, and the tolerance it starts from.
FILTERS = {"irradiance": (vtkIrradianceFilter, {}, 0.01),
           "radiosity": (vtkRadiosityFilter, RADIOSITY_PROPERTIES, 0.2)}
RESULTS = [name + side + error for name in ("Irradiance", "Illuminance", "Radiosity", "Radiance")
           for side in ("", "Back") for error in ("", "Error")]


def check(seed, kind, timed):
    """True when the filter had an answer, False when it refused."""
    rng = np.random.default_rng(seed)
    made, further, tolerance = FILTERS[kind]
    f = made()
    f.SetRelativeTolerance(tolerance)
    data = surface(rng)
    names = [make() for make in KINDS.values()]
    lights = light_data(*[names[k] for k in rng.integers(0, len(names), rng.integers(0, 4))])
    shade = polydata(*room())
    given = set()
    for d in (data, lights, shade):
        if rng.random() < 0.6:
            add_nonsense(rng, d)
            given |= {d.GetCellData().GetArrayName(k)
                      for k in range(d.GetCellData().GetNumberOfArrays())}
            given |= {d.GetPointData().GetArrayName(k)
                      for k in range(d.GetPointData().GetNumberOfArrays())}
    f.SetInputData(data)
    f.AddLightsData(lights)
    if rng.random() < 0.4:
        f.AddOccludersData(shade)
    for name, value_of in (PROPERTIES | further).items():
        if rng.random() < 0.12:
            getattr(f, "Set" + name)(value_of(rng))
    errors = Errors(f)
    start = time.perf_counter()
    f.Update()
    seconds = time.perf_counter() - start
    budget = f.GetTimeBudget()
    assert not timed or seconds < (budget if 0 < budget < 10 else 5.0) + 0.5, f"{seconds} s"
    out = f.GetOutputDataObject(0)
    if errors.messages:
        assert len(errors.messages) == 1, errors.messages
        message = errors.messages[0].split("): ", 1)[1].strip()
        assert message and "\n" not in message, message
        for port in range(3):
            assert f.GetOutputDataObject(port).GetNumberOfElements(0) == 0, message
        return False
    for attributes in (out.GetPointData(), out.GetCellData()):
        for name in RESULTS:
            if attributes.HasArray(name) and name not in given:
                values = array(attributes, name)
                assert np.isfinite(values).all(), name
                assert (values >= 0).all(), name
    return True


def main():
    faulthandler.enable()
    parser = argparse.ArgumentParser()
    parser.add_argument("filter", choices=FILTERS)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--count", type=int, default=0)
    parser.add_argument("--timed", action="store_true")
    chosen = parser.parse_args()
    chosen.count = chosen.count or {"irradiance": 600, "radiosity": 150}[chosen.filter]
    failed, answered = [], 0
    for seed in range(chosen.first, chosen.first + chosen.count):
        try:
            answered += check(seed, chosen.filter, chosen.timed)
        except AssertionError as problem:
            failed.append(seed)
            print(f"seed {seed}: {problem}", flush=True)
    print(f"{chosen.count} runs, {answered} answered, {len(failed)} failed {failed}")
    # Both happen: else nothing was tried.
    assert 0.1 * chosen.count < answered < 0.9 * chosen.count or chosen.count < 50
    return 1 if failed else 0


if __name__ == "__main__":
    raise SystemExit(main())
