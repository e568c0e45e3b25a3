# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of benchmarks/radiosity_prediction.py: name -> (surface, lights, occluder or None)."""
import importlib.util
import os

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData

import vtkradiometry as vr
from vtkradiometry import mesh

from .furnished import Furnished, named

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def grid(corner, a, b, n, m):
    """A rectangle with sides a and b in n x m pairs of triangles, its front along a x b."""
    corner, a, b = (np.asarray(v, float) for v in (corner, a, b))
    xyz = np.array([corner + a * i / n + b * j / m for j in range(m + 1) for i in range(n + 1)])
    cells = []
    for j in range(m):
        for i in range(n):
            p = j * (n + 1) + i
            cells += [(p, p + 1, p + n + 2), (p, p + n + 2, p + n + 1)]
    return xyz, np.array(cells)


def joined(parts):
    points, cells, first = [], [], 0
    for xyz, corner in parts:
        points.append(xyz)
        cells.append(corner + first)
        first += len(xyz)
    return mesh.make_polydata(np.concatenate(points), np.concatenate(cells))


def with_reflectance(surface, value, bands=1):
    named(surface.GetCellData(), "DiffuseReflectance",
          np.full((surface.GetNumberOfCells(), bands), value))
    return surface


def point_light(position, intensity):
    light = vr.vtkPointLightSource()
    light.SetPosition(*position)
    light.SetIntensity(intensity)
    return light


def output(source):
    source.Update()
    out = vtkPolyData()
    out.ShallowCopy(source.GetOutputDataObject(0))
    return out


def plane(n):
    return with_reflectance(joined([grid((-5, -5, 0), (10, 0, 0), (0, 10, 0), n, n)]), 0.6)


def open_plane():
    return plane(70), [output(point_light((0, 0, 3), 100.0))], None


def blocked_plane():
    plate = joined([grid((-1, -1, 1.5), (2, 0, 0), (0, 2, 0), 4, 4)])
    return plane(70), [output(point_light((0, 0, 3), 100.0))], plate


def read(name, triangles):
    reader = vr.vtkRadiometricSceneReader()
    reader.SetFileName(os.path.join(ROOT, "examples", name, name + ".glb"))
    reader.Update()
    surface, lights = vtkPolyData(), vtkPolyData()
    surface.ShallowCopy(reader.GetOutputDataObject(0))
    lights.ShallowCopy(reader.GetOutputDataObject(1))
    surface = mesh.triangulate(surface)
    surface, _ = mesh.refine(surface, mesh.automatic_edge(surface, triangles))
    return surface, [lights], None


def street():
    path = os.path.join(ROOT, "examples", "street", "street.py")
    spec = importlib.util.spec_from_file_location("street", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    sun = vr.vtkDirectionalLightSource()
    sun.SetDirection(0.5, 0.3, -0.8)
    sun.SetIntensity(800.0)
    sky = vr.vtkEnvironmentLightSource()
    sky.SetIntensityUnit(2)
    sky.SetIntensity(100.0)
    surface = with_reflectance(mesh.triangulate(module.town()), 0.4)
    return surface, [output(sun), output(sky)], None


def crater(rings=24, sectors=60):
    """A bowl of 25 degrees (Ingersoll) under a sun at 10 degrees."""
    beta = np.radians(25.0)
    xyz, cells = [(0.0, 0.0, -1.0)], []
    for r in range(1, rings + 1):
        t = beta * r / rings
        for s in range(sectors):
            p = 2 * np.pi * s / sectors
            xyz.append((np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), -np.cos(t)))
    for s in range(sectors):
        cells.append((0, 1 + s, 1 + (s + 1) % sectors))
    for r in range(1, rings):
        a, b = 1 + (r - 1) * sectors, 1 + r * sectors
        for s in range(sectors):
            t = (s + 1) % sectors
            cells += [(a + s, b + s, b + t), (a + s, b + t, a + t)]
    sun = vr.vtkDirectionalLightSource()
    sun.SetDirection(np.cos(np.radians(10)), 0.0, -np.sin(np.radians(10)))
    sun.SetIntensity(1000.0)
    surface = with_reflectance(mesh.make_polydata(np.array(xyz), np.array(cells)), 0.3)
    return surface, [output(sun)], None


def room(cells):
    n = max(2, int(round((cells / 12.0) ** 0.5)))
    x, y, z = (4, 0, 0), (0, 5, 0), (0, 0, 3)
    parts = [grid((0, 0, 0), x, y, n, n), grid((0, 0, 3), y, x, n, n), grid((0, 0, 0), z, x, n, n),
             grid((0, 5, 0), x, z, n, n), grid((0, 0, 0), y, z, n, n), grid((4, 0, 0), z, y, n, n)]
    box = joined([grid((1.5, 2, 0.5), (1, 0, 0), (0, 1, 0), 4, 4)])
    return with_reflectance(joined(parts), 0.5), [output(point_light((2.5, 2.5, 2.5), 50.0))], box


def furnished(cells):
    scene = Furnished(cells)
    return scene.surface(), [scene.lights()], None


SCENES = {
    "open plane": open_plane,
    "blocked plane": blocked_plane,
    "Cornell box": lambda: read("cornell-box", 2500),
    "gallery": lambda: read("gallery", 2500),
    "street": street,
    "crater": crater,
    "room 1e4": lambda: room(1e4),
    "room 1e5": lambda: room(1e5),
    "furnished 1e4": lambda: furnished(10000),
    "furnished 1e5": lambda: furnished(100000),
    "furnished 1e6": lambda: furnished(1000000),
}
