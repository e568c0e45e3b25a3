# SPDX-License-Identifier: BSD-3-Clause
"""The example scenes: what their generators write, closed, turned the right way, with the published
numbers."""
import importlib.util
import math
import os
import subprocess
import sys
import tempfile

import numpy as np
from checks import SOURCE_DIR, array, close, points, run_all, triangles
from gltf_tools import areas
from vtkradiometry import (vtkDirectionalLightSource, vtkIrradianceFilter, vtkPointLightSource,
                           vtkRadiometricSceneReader)

EXAMPLES = {"gallery": "make_gallery.py", "cornell-box": "make_cornell_box.py",
            "office": "make_office.py"}
K = 683.002


def path_of(name):
    return os.path.join(SOURCE_DIR, "examples", name, name + ".glb")


def read(name):
    reader = vtkRadiometricSceneReader()
    reader.SetFileName(path_of(name))
    reader.Update()
    assert reader.GetOutput(0).GetNumberOfCells() > 0
    return reader


def corners(reader):
    return points(reader.GetOutput(0))[triangles(reader.GetOutput(0))]


def of_object(reader, name):
    names = array(reader.GetOutput(0).GetFieldData(), "ObjectNames")
    return array(reader.GetOutput(0).GetCellData(), "ObjectIndex") == names.index(name)


def test_generators_write_these_files():
    for name, script in EXAMPLES.items():
        with tempfile.TemporaryDirectory() as folder:
            new = os.path.join(folder, "new.glb")
            subprocess.run([sys.executable, os.path.join(SOURCE_DIR, "examples", name, script), new],
                           check=True, stdout=subprocess.DEVNULL)
            for kind in (".glb", ".ies"):
                made, kept = (os.path.splitext(p)[0] + kind for p in (new, path_of(name)))
                assert os.path.exists(made) == os.path.exists(kept), (name, kind)
                if os.path.exists(kept):
                    with open(made, "rb") as a, open(kept, "rb") as b:
                        assert a.read() == b.read(), (name, kind)


def test_triangles():
    for name in EXAMPLES:
        reader = read(name)
        three = corners(reader)
        assert len(three) <= 3000
        assert areas(three).min() > 1e-6, "no degenerate triangles"
        # Each front is where the normals point.
        front = np.cross(three[:, 1] - three[:, 0], three[:, 2] - three[:, 0])
        front /= np.linalg.norm(front, axis=1)[:, None]
        normals = array(reader.GetOutput(0).GetPointData(), "Normals")
        normals = normals[triangles(reader.GetOutput(0))]
        assert np.einsum("ij,ikj->ik", front, normals).min() > 0.5
        # None lies on another with the same corners.
        key = np.sort(np.round(three, 6).view("f8,f8,f8").reshape(-1, 3), axis=1)
        assert len(np.unique(key, axis=0)) == len(three)


def lit(reader, light):
    irradiance = vtkIrradianceFilter()
    irradiance.SetInputData(reader.GetOutput(0))
    irradiance.AddLightsConnection(light.GetOutputPort())
    irradiance.SetEmission(2)  # the scenes' own panels
    irradiance.Update()
    out = irradiance.GetOutputDataObject(0).GetCellData()
    return array(out, "Irradiance").reshape(out.GetNumberOfTuples(), -1)[:, 0]


def test_no_light_leaks_in():
    """Light behind a wall, in front of an edge or a corner, lights nothing inside."""
    gallery, box = read("gallery"), read("cornell-box")
    cases = [(gallery, direction) for direction in
             ((0, -1, 0), (0, 1, 0), (0, 0, 1), (0, 0, -1), (-1, 0, 0),
              (-1, -1, -1), (-1, 1, 1), (-1, -0.001, 0.002))]
    cases += [(box, d) for d in ((0, -1, 0), (0, 1, 0), (0, 0, -1), (1, 0, -0.01), (-1, -1, -1))]
    for reader, direction in cases:
        sun = vtkDirectionalLightSource()
        sun.SetDirection(direction)
        assert lit(reader, sun).max() == 0.0, direction
    for position in ((3, 3.0001, 2), (3, -0.0001, 2), (6.0001, 1, 2), (3, 1, 5.0001), (3, 1, -0.13),
                     (6.0001, 3.0001, 5.0001), (6.00001, 0.05, 2), (2, 0.1, 5.00001),
                     (4.4, 0.5, -0.12)):
        lamp = vtkPointLightSource()
        lamp.SetPosition(position)
        assert lit(gallery, lamp).max() == 0.0, position


def test_cornell_box():
    reader = read("cornell-box")
    cell = reader.GetOutput(0).GetCellData()
    area = areas(corners(reader))
    close(area[of_object(reader, "light")].sum(), 0.130 * 0.105, relative=1e-6)
    # The ceiling has a hole where the lamp is, the floor holes where the blocks stand.
    close(area[of_object(reader, "ceiling")].sum(), 0.556 * 0.5592 - 0.130 * 0.105, relative=1e-6)

    def shoelace(ring):
        x, z = np.array(ring, float).T
        return abs(np.sum(x * np.roll(z, -1) - z * np.roll(x, -1))) / 2

    short = shoelace([(130, 65), (82, 225), (240, 272), (290, 114)])
    tall = shoelace([(423, 247), (265, 296), (314, 456), (472, 406)])
    whole = shoelace([(552.8, 0), (0, 0), (0, 559.2), (549.6, 559.2)])
    close(area[of_object(reader, "floor")].sum(), (whole - short - tall) * 1e-6, relative=1e-6)
    # Red on the left as seen by the camera (at greater x), green on the right.
    rho = array(cell, "DiffuseReflectance")
    left, right = rho[of_object(reader, "left wall")][0], rho[of_object(reader, "right wall")][0]
    assert left[0] > 5 * left[1] and right[1] > 3 * right[0]
    assert corners(reader)[of_object(reader, "left wall")][..., 0].min() > 0.5
    # The lamp: luminance 12 000 cd/m^2, and nothing else emits.
    emitted = array(cell, "EmittedExitance")
    close(emitted[of_object(reader, "light")] @ [0.2126, 0.7152, 0.0722] * K / math.pi,
          [12000, 12000], relative=1e-6)
    assert emitted[~of_object(reader, "light")].max() == 0
    close(reader.GetCameraViewAngle(0), 2 * math.degrees(math.atan(12.5 / 35)))
    position = [0, 0, 0]
    reader.GetCameraPosition(0, position)
    close(position, [0.278, 0.273, -0.8])


def test_gallery():
    reader = read("gallery")
    lights = reader.GetOutput(1).GetPointData()
    assert array(lights, "LightType").tolist() == [0, 1, 2]
    area = areas(corners(reader))
    close(area[of_object(reader, "ceiling")].sum(), 30, relative=1e-6)
    close(area[of_object(reader, "south wall")].sum(), 6 * 2.9, relative=1e-6)
    cell = reader.GetOutput(0).GetCellData()
    weights = [0.2126, 0.7152, 0.0722]
    for name, low, high in (("ceiling", 0.8, 0.9), ("north wall", 0.7, 0.8), ("floor", 0.3, 0.4)):
        value = array(cell, "DiffuseReflectance")[of_object(reader, name)][0] @ weights
        assert low <= value <= high, (name, value)
    total = array(cell, "DiffuseReflectance") + array(cell, "SpecularReflectance")
    assert total.max() < 0.9
    # The sun comes in through the window: on the floor, and nowhere on the wall of the window.
    sun = vtkDirectionalLightSource()
    sun.SetDirection(array(lights, "Direction")[2])
    irradiance = lit(reader, sun)
    assert irradiance[of_object(reader, "floor")].max() > 0.1
    assert irradiance[of_object(reader, "north wall")].max() > 0
    assert irradiance[of_object(reader, "west wall")].max() == 0
    # The pendant does not light the ceiling; the shade does that from below.
    lamp = vtkPointLightSource()
    lamp.SetPosition(points(reader.GetOutput(1))[0])
    assert lit(reader, lamp)[of_object(reader, "ceiling")].max() == 0


def office():
    """The generator of the office as a module."""
    path = os.path.join(SOURCE_DIR, "examples", "office", "make_office.py")
    spec = importlib.util.spec_from_file_location("make_office", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_office_is_closed_but_for_its_window():
    reader = read("office")
    for direction in ((0, -1, 0), (0, 1, 0), (0, 0, -1), (0, 0, 1), (-1, 0, 0), (-1, -1, -1)):
        sun = vtkDirectionalLightSource()
        sun.SetDirection(direction)
        assert lit(reader, sun).max() == 0.0, direction
    sun = vtkDirectionalLightSource()
    sun.SetDirection((1, -1, 0))
    assert lit(reader, sun)[of_object(reader, "floor")].max() > 0.5


def test_office_figures():
    """What office.py prints, against the sum over its two luminaires by their own formula."""
    made = office()
    script = os.path.join(SOURCE_DIR, "examples", "office", "office.py")
    said = subprocess.run([sys.executable, script], check=True, capture_output=True,
                          text=True).stdout.split()
    figures = {name: float(said[said.index(name) + 1])
               for name in ("Mean", "Minimum", "Maximum", "U0", "Ud", "Cells")}
    side, zone = (made.X, made.Z), 0.5
    # 4.4 x 3.2 m: p = 0.2 * 5^log10(4.4) = 0.564 m, so 8 x 6 points.
    count = (8, 6)
    assert figures["Cells"] == 48
    values = []
    for i in range(count[0]):
        for j in range(count[1]):
            x, z = (zone + (side[k] - 2 * zone) * (n + 0.5) / count[k]
                    for k, n in enumerate((i, j)))
            total = 0.0
            for lamp_x, lamp_z in made.LUMINAIRES:
                dx, dz, drop = x - lamp_x, z - lamp_z, made.LUMINAIRE_BOTTOM - 0.005 - 0.8
                r = math.sqrt(dx * dx + dz * dz + drop * drop)
                plane = math.degrees(math.atan2(dz, dx))
                gamma = math.degrees(math.acos(drop / r))
                total += made.intensity(plane, gamma) * drop / r**3
            values.append(total * made.FLUX / (2 * math.pi * (0.5 + 2.1 / 4)))
    mean = sum(values) / len(values)
    for name, value in (("Mean", mean), ("Minimum", min(values)), ("Maximum", max(values)),
                        ("U0", min(values) / mean), ("Ud", min(values) / max(values))):
        # The file is linear between its angles (5 and 2.5 degrees), the figures have four digits.
        close(figures[name], value, relative=0.004)


if __name__ == "__main__":
    run_all(globals())
