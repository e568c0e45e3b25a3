# SPDX-License-Identifier: BSD-3-Clause
"""What the hard cases share: meshes, lights of every kind as raw arrays, runs of the filters, and
oracles that use nothing of the project."""
import sys
import traceback
from math import pi

import numpy as np
from filters.checks import Errors, array, fails  # noqa: F401 (handed on to the tests)
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkradiometry import vtkIrradianceFilter, vtkRadiosityFilter

CELLS, POINTS = 0, 1
EPS = np.finfo(float).eps


# --- meshes ------------------------------------------------------------------------------------

def polydata(points, polygons=(), strips=(), verts=(), lines=()):
    """Polydata in double precision."""
    data = vtkPolyData()
    p = vtkPoints()
    p.SetDataTypeToDouble()
    points = np.asarray(points, float).reshape(-1, 3)
    p.SetData(numpy_to_vtk(points, deep=True))
    data.SetPoints(p)
    for cells, setter in ((verts, data.SetVerts), (lines, data.SetLines),
                          (polygons, data.SetPolys), (strips, data.SetStrips)):
        if len(cells):
            made = vtkCellArray()
            for cell in cells:
                made.InsertNextCell(len(cell), [int(i) for i in cell])
            setter(made)
    return data


def grid(origin, a, b, n=1, m=1):
    """Points and quads of a parallelogram; its front is along a x b."""
    o, a, b = (np.asarray(v, float) for v in (origin, a, b))
    points = [o + (i / n) * a + (j / m) * b for j in range(m + 1) for i in range(n + 1)]
    quads = [(j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i)
             for j in range(m) for i in range(n)]
    return np.array(points), quads


def box(low=(0, 0, 0), high=(1, 1, 1), n=1, inward=False, faces=range(6)):
    """Points and quads of a box, n x n quads a face; faces -z, +z, -y, +y, -x, +x."""
    lo, hi = np.asarray(low, float), np.asarray(high, float)
    x, y, z = np.diag(hi - lo)
    sides = [(lo, y, x), (lo + z, x, y), (lo, x, z), (lo + y, z, x), (lo, z, y), (lo + x, y, z)]
    return joined(*[grid(sides[f][0], *(sides[f][1:][::-1] if inward else sides[f][1:]), n, n)
                    for f in faces])


def joined(*meshes):
    """Several meshes (points, polygons) as one."""
    points, polygons, first = [], [], 0
    for p, q in meshes:
        points.append(np.asarray(p, float))
        polygons += [tuple(first + i for i in polygon) for polygon in q]
        first += len(p)
    return np.concatenate(points), polygons


def mesh(*meshes):
    return polydata(*joined(*meshes))


def rotation(seed):
    """A rotation that no axis survives; seed 0 is none."""
    if seed == 0:
        return np.eye(3)
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q if np.linalg.det(q) > 0 else -q


def sensors(points, normals):
    """A grid of sensors."""
    points = np.asarray(points, float).reshape(-1, 3)
    data = polydata(points, verts=[(i,) for i in range(len(points))])
    return with_points(data, Normals=np.broadcast_to(np.asarray(normals, float), points.shape))


def with_points(data, **arrays):
    return _with(data.GetPointData(), data, arrays)


def with_cells(data, **arrays):
    return _with(data.GetCellData(), data, arrays)


def _with(attributes, data, arrays):
    for name, values in arrays.items():
        a = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        a.SetName(name)
        attributes.AddArray(a)
    return data


# --- lights ------------------------------------------------------------------------------------

class Light:
    """One light as the arrays of docs/arrays.md say it, that can be turned, scaled and moved."""

    def __init__(self, kind, position=(0, 0, 0), intensity=1.0, **arrays):
        self.kind = kind
        self.position = np.atleast_2d(np.asarray(position, float))  # area lights: corners
        self.intensity = np.atleast_1d(np.asarray(intensity, float))
        self.arrays = arrays
        self.field = {}  # field arrays of a web or a map, "<k>" in their names for its number

    def moved(self, turn=np.eye(3), scale=1.0, shift=(0, 0, 0)):
        arrays = dict(self.arrays)
        for name in ("Direction", "ReferenceDirection", "SunDirection"):
            if name in arrays:
                arrays[name] = turn @ np.asarray(arrays[name], float)
        return self.like(scale * self.position @ turn.T + np.asarray(shift, float),
                         self.intensity, arrays)

    def times(self, factor):
        return self.like(self.position, factor * self.intensity, self.arrays)

    def like(self, position, intensity, arrays):
        other = Light(self.kind, position, intensity, **arrays)
        other.field = self.field
        return other


def point(position, intensity=1.0, **arrays):
    return Light(0, position, intensity, **arrays)


def spot(position, direction, cutoff=45.0, exponent=0.0, intensity=1.0, **arrays):
    return Light(1, position, intensity, Direction=np.asarray(direction, float),
                 SpotCutoff=float(cutoff), SpotExponent=float(exponent), **arrays)


def sun(direction, irradiance=1.0, **arrays):
    return Light(2, (0, 0, 0), irradiance, Direction=np.asarray(direction, float), **arrays)


def area(corners, exitance=1.0, two_sided=False, **arrays):
    return Light(3, corners, exitance, LightTwoSided=int(two_sided), **arrays)


def luminaire(position, horizontal, vertical, values, intensity=1.0, axis=(0, 0, -1),
              reference=(1, 0, 0)):
    """A light with a type C web: `values` are planes x vertical angles."""
    light = Light(0, position, intensity, Direction=np.asarray(axis, float),
                  ReferenceDirection=np.asarray(reference, float), PhotometricWeb=0)
    light.field = {"PhotometricWeb<k>": np.asarray(values, float).ravel(),
                   "PhotometricWeb<k>Horizontal": np.asarray(horizontal, float),
                   "PhotometricWeb<k>Vertical": np.asarray(vertical, float)}
    return light


def sky(radiance=1.0, model=0, down=(0, 0, -1), north=(0, 1, 0), pixels=None, **arrays):
    """An environment; `pixels`: rows x columns of a map."""
    light = Light(4, (0, 0, 0), radiance, Direction=np.asarray(down, float),
                  ReferenceDirection=np.asarray(north, float), SkyModel=model, **arrays)
    if pixels is not None:
        pixels = np.asarray(pixels, float)
        light.arrays["EnvironmentMap"] = 0
        light.field = {"EnvironmentMap<k>": pixels.reshape(pixels.shape[0] * pixels.shape[1], -1),
                       "EnvironmentMap<k>Size": np.array(pixels.shape[1::-1], np.int32)}
    return light


# Planes C = 0 to 315, gamma 0 to 180: lopsided, dark above.
LOPSIDED = (np.arange(0.0, 360.0, 45.0), np.arange(0.0, 181.0, 15.0),
            [[(2 + np.cos(np.radians(c))) * max(0.0, 1 - g / 120) for g in np.arange(0, 181, 15)]
             for c in np.arange(0, 360, 45)])


# One light of each kind, for cases that ask the same of all: over and beside the scene of `room`.
KINDS = {
    "point": lambda: point((0.31, 0.22, 1.71), 5.0),
    "spot": lambda: spot((0.31, 0.22, 1.71), (-0.2, 0.1, -1), 50.0, 1.5, 7.0),
    "smooth spot": lambda: spot((-0.7, 0.4, 1.9), (0.3, 0.1, -1), 40.0, 0.0, 9.0,
                                SpotInnerCutoff=20.0),
    "sun": lambda: sun((0.3, -0.2, -0.9), 3.0),
    "legacy": lambda: point((0.31, 0.22, 1.71), 5.0, Attenuation=(1.0, 0.5, 0.25)),
    "web": lambda: luminaire((0.31, 0.22, 1.71), *LOPSIDED, 6.0, (0.2, -0.1, -1), (0.3, 1, 0.2)),
    "area": lambda: area([(0.1, 0.1, 1.9), (0.1, 0.6, 1.9), (0.7, 0.6, 1.8), (0.7, 0.1, 1.8)], 8.0),
    "two-sided area": lambda: area([(-0.6, 0.2, 1.2), (0.0, 0.3, 1.5), (-0.2, 0.9, 1.3)], 6.0, True),
    "concave area": lambda: area([(0, 0, 1.9), (0.5, 1.0, 1.9), (1, 0, 1.9), (0.5, 0.3, 1.9)], 5.0),
    "uniform sky": lambda: sky(2.0),
    "overcast sky": lambda: sky(3.0, 3),
}
# E(s x) = s^p E(x) when the scene is scaled by s and the intensities stay.
SCALE_POWER = {"point": -2, "spot": -2, "smooth spot": -2, "sun": 0, "web": -2, "area": 0,
               "two-sided area": 0, "concave area": 0, "uniform sky": 0, "overcast sky": 0}


def room():
    """A floor under a box that stands on it, a plate and a ball that float above: points, quads."""
    ball = []
    n = 6
    for j in range(n + 1):
        for i in range(2 * n):
            t, f = pi * j / n, pi * i / n
            ball.append((0.9 + 0.3 * np.sin(t) * np.cos(f), 0.8 + 0.3 * np.sin(t) * np.sin(f),
                         0.7 + 0.3 * np.cos(t)))
    quads = [(j * 2 * n + i, (j + 1) * 2 * n + i, (j + 1) * 2 * n + (i + 1) % (2 * n),
              j * 2 * n + (i + 1) % (2 * n)) for j in range(n) for i in range(2 * n)]
    return joined(grid((-2, -2, 0), (4, 0, 0), (0, 4, 0), 5, 5),
                  box((-0.9, -0.8, 0), (-0.2, 0.1, 0.6), 2),
                  grid((0.1, -1.2, 1.0), (0.9, 0.1, 0), (0, 0.8, 0.2)), (ball, quads))


SAMPLED = ("area", "two-sided area", "concave area", "uniform sky", "overcast sky")

DEFAULTS = {"Direction": (0.0, 0.0, -1.0), "SpotCutoff": 180.0, "SpotExponent": 0.0,
            "SpotInnerCutoff": -1.0, "Attenuation": (0.0, 0.0, 1.0), "LightEnabled": 1,
            "AttachedTo": 0, "PhotometricWeb": -1, "LightTwoSided": 0,
            "ReferenceDirection": (1.0, 0.0, 0.0), "SkyModel": 0,
            "SkyCoefficients": (0.0, 0.0, 0.0, 0.0, 0.0), "SunDirection": (0.0, 0.0, 1.0),
            "EnvironmentMap": -1, "GroundRadiance": 0.0}
INTEGERS = ("LightEnabled", "AttachedTo", "PhotometricWeb", "LightTwoSided", "SkyModel",
            "EnvironmentMap")


def light_data(*lights, field=None):
    """Lights as one polydata."""
    points = np.concatenate([x.position for x in lights]) if lights else np.zeros((0, 3))
    verts, polygons, first = [], [], 0
    for x in lights:
        n = len(x.position)
        ids = tuple(range(first, first + n))
        (polygons if x.kind == 3 else verts).append(ids)
        first += n
    data = polydata(points, polygons, verts=verts)
    if not lights:
        return data

    def column(value_of):
        return np.array([value_of(x) for x in lights for _ in x.position])

    bands = max(len(x.intensity) for x in lights)
    arrays = {"LightType": column(lambda x: x.kind).astype(np.int32),
              "Intensity": column(lambda x: np.broadcast_to(x.intensity, bands))}
    for name in {n for x in lights for n in x.arrays}:
        values = column(lambda x: np.asarray(x.arrays.get(name, DEFAULTS[name]), float))
        arrays[name] = values.astype(np.int32) if name in INTEGERS else values
    with_points(data, **arrays)
    webs, fields = 0, dict(field or {})
    for x in [x for x in lights if x.field]:
        number = "PhotometricWeb" if "PhotometricWeb" in x.arrays else "EnvironmentMap"
        for name, values in x.field.items():
            fields[name.replace("<k>", str(webs))] = values
        x.arrays[number] = webs
        webs += 1
    if webs:
        for number in ("PhotometricWeb", "EnvironmentMap"):
            if number in arrays:
                with_points(data, **{number: column(
                    lambda x: x.arrays.get(number, -1)).astype(np.int32)})
    if fields:
        _with(data.GetFieldData(), data, fields)
    return data


# --- runs --------------------------------------------------------------------------------------

class Run:
    """Irradiance and error of one run, values x bands; front, or back."""

    FILTER = vtkIrradianceFilter

    def __init__(self, surface, lights=(), occluders=(), back=False, **properties):
        f = self.FILTER()
        f.SetInputData(surface)
        lights = [lights] if isinstance(lights, (Light, vtkPolyData)) else list(lights)
        if lights and isinstance(lights[0], Light):
            lights = [light_data(*lights)]
        for data in lights:
            f.AddLightsData(data)
        for data in occluders if isinstance(occluders, (list, tuple)) else [occluders]:
            f.AddOccludersData(data)
        for name, value in properties.items():
            getattr(f, "Set" + name)(value)
        self.filter = f
        self.errors = Errors(f)
        f.Update()
        assert not self.errors.messages, self.errors.messages
        self.output = f.GetOutputDataObject(0)
        if self.output.IsA("vtkPolyData"):
            self.e, self.error = self.values(self.output, back)

    @staticmethod
    def values(data, back=False):
        name = "IrradianceBack" if back else "Irradiance"
        attributes = data.GetPointData() if data.GetPointData().HasArray(name) else data.GetCellData()
        e, error = array(attributes, name), array(attributes, name + "Error")
        e, error = e.reshape(len(e), -1), error.reshape(len(error), -1)
        assert np.isfinite(e).all() and (e >= 0).all(), e[~(np.isfinite(e) & (e >= 0))]
        assert np.isfinite(error).all() and (error >= 0).all(), error
        return e, error

    def bytes(self):
        return self.e.tobytes() + self.error.tobytes()


DENSE, HIERARCHICAL, MONTE_CARLO = 1, 2, 3
METHODS = {"Dense": DENSE, "Hierarchical": HIERARCHICAL, "MonteCarlo": MONTE_CARLO}


class Solved(Run):
    """The same of the radiosity filter."""

    FILTER = vtkRadiosityFilter

    def mean(self, areas):
        """Area-weighted mean irradiance of the first band."""
        return (self.e[:, 0] * areas).sum() / areas.sum()

    def method(self):
        return array(self.output.GetFieldData(), "RadiometryMethod")[0]


def cell(surface, lights, **properties):
    """The one value of a one-cell surface."""
    e = Run(surface, lights, **properties).e
    assert e.shape == (1, 1), e.shape
    return e[0, 0]


def close(value, expected, relative=1e-12, absolute=0.0):
    """Asserts that value(s) agree with expected one(s), and tells the worst; NaN never does."""
    value, expected = np.asarray(value, float), np.asarray(expected, float)
    assert value.shape == expected.shape, (value.shape, expected.shape)
    allowed = relative * np.abs(expected) + absolute
    bad = ~(np.abs(value - expected) <= allowed)
    if bad.any():
        at = np.unravel_index(np.argmax(np.where(bad, np.abs(value - expected) / (allowed + 1e-300),
                                                 -1)), bad.shape) if bad.shape else ()
        raise AssertionError(f"{bad.sum()} of {bad.size} differ; at {at} {value[at]!r} is not "
                             f"{expected[at]!r} (relative {relative}, absolute {absolute})")


# --- oracles -----------------------------------------------------------------------------------

def triangles_of(points, polygons):
    """Corners (n, 3, 3) of fans; for convex polygons."""
    points = np.asarray(points, float)
    return np.array([[points[q[0]], points[q[k - 1]], points[q[k]]]
                     for q in polygons for k in range(2, len(q))])


def areas_of(points, polygons):
    """Areas of flat polygons, concave ones too: the length of the vector area."""
    points = np.asarray(points, float)
    return np.array([np.linalg.norm(vector_area(points[list(q)])) for q in polygons])


def vector_area(loop):
    loop = np.asarray(loop, float)
    a = loop - loop[0]
    return 0.5 * np.cross(a, np.roll(a, -1, axis=0)).sum(axis=0)


def solid_angle(loop, at):
    """Signed solid angle of any closed loop (positive seen from its front), in extended precision:
    Van Oosterom and Strackee 1983 over a fan, as a sum of complex arguments that may wind."""
    r = np.asarray(loop, np.longdouble) - np.asarray(at, np.longdouble)
    length = np.sqrt((r * r).sum(axis=1))
    total = np.longdouble(0)
    for k in range(2, len(r)):
        a, b, c = r[0], r[k - 1], r[k]
        la, lb, lc = length[0], length[k - 1], length[k]
        n = np.array([(b - a)[1] * (c - a)[2] - (b - a)[2] * (c - a)[1],
                      (b - a)[2] * (c - a)[0] - (b - a)[0] * (c - a)[2],
                      (b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0]])
        triple = -(a * n).sum()
        total += 2 * np.arctan2(triple, la * lb * lc + (a * b).sum() * lc + (b * c).sum() * la +
                                (c * a).sum() * lb)
    return float(total)


def square_above(h, half=1.0):
    """Solid angle of a square of half side `half` from h above its centre."""
    return 4.0 * np.arctan2(half * half, h * np.sqrt(2.0 * half * half + h * h))


def corner_above(h, a, b):
    """Solid angle of an a x b rectangle from h above one of its corners; exact for any h > 0."""
    return np.arctan2(a * b, h * np.sqrt(a * a + b * b + h * h))


def hidden(points, toward, triangles, skip=None):
    """Whether the open segments from `points` to `toward` (a place; or with shape (n, 3) places)
    cross any triangle: Moeller and Trumbore's test in double, everything against everything. What
    lies on a triangle within rounding at the far end is not hidden by it (a lamp on a ceiling).
    `skip`: index of the triangle that each point lies on."""
    d = np.broadcast_to(toward, points.shape) - points
    blocked = np.zeros(len(points), bool)
    for t, (a, b, c) in enumerate(triangles):
        e1, e2 = b - a, c - a
        p = np.cross(d, e2)
        det = p @ e1
        s = points - a
        with np.errstate(divide="ignore", invalid="ignore"):
            u = np.einsum("ij,ij->i", s, p) / det
            q = np.cross(s, e1)
            v = np.einsum("ij,ij->i", d, q) / det
            w = (q @ e2) / det
            hit = (u >= 0) & (v >= 0) & (u + v <= 1) & (w > 0) & (w < 1 - 1e-9) & (det != 0)
        if skip is not None:
            hit &= skip != t
        blocked |= hit
    return blocked


def interpolant(web, directions, axis, reference):
    """Relative intensity of a type C web toward directions: gamma from the axis, C from the reference."""
    horizontal, vertical, values = (np.asarray(v, float) for v in web)
    down = np.asarray(axis, float) / np.linalg.norm(axis)
    x = np.asarray(reference, float) - np.dot(reference, down) * down
    x /= np.linalg.norm(x)
    y = np.cross(-down, x)
    d = directions / np.linalg.norm(directions, axis=1)[:, None]
    gamma = np.degrees(np.arctan2(np.linalg.norm(np.cross(d, down), axis=1), d @ down))
    values = values / values.max()
    if len(horizontal) == 1:
        return np.interp(gamma, vertical, values[0])
    c = np.degrees(np.arctan2(d @ y, d @ x)) % 360.0
    around = np.append(horizontal, horizontal[0] + 360.0)
    k = np.clip(np.searchsorted(around, c, side="right") - 1, 0, len(horizontal) - 1)
    t = (c - around[k]) / (around[k + 1] - around[k])
    planes = np.array([np.interp(gamma, vertical, v) for v in np.vstack([values, values[:1]])])
    i = np.arange(len(c))
    return (1 - t) * planes[k, i] + t * planes[k + 1, i]


def run_all(namespace):
    """Runs every test_* function, all of them, and tells which failed."""
    failed, done = [], 0
    for name, function in list(namespace.items()):
        if name.startswith("test_") and callable(function):
            done += 1
            try:
                function()
                print("passed", name, flush=True)
            except Exception:  # the next case is another matter
                traceback.print_exc()
                failed.append(name)
                print("FAILED", name, flush=True)
    assert done, "no tests"
    if failed:
        print(f"{len(failed)} of {done} failed:", *failed)
    sys.exit(1 if failed else 0)
