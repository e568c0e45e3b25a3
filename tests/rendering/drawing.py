# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of this folder share: a window that is read back in float, lights as data."""
import sys

import numpy as np

import display

display.ensure()

from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonCore import vtkPoints  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData  # noqa: E402
from vtkmodules.vtkRenderingCore import (  # noqa: E402
    vtkActor,
    vtkRenderer,
    vtkRenderWindow,
)
import vtkmodules.vtkRenderingOpenGL2  # noqa: E402,F401
from vtkradiometry.vtkRadiometryRendering import (  # noqa: E402
    vtkLinearFloatPass,
    vtkPhongGouraudMapper,
)


class Errors:
    """Collects the error and warning events of an object."""

    def __init__(self, thing):
        self.texts = []
        for event in ("ErrorEvent", "WarningEvent"):
            thing.AddObserver(event, self.note)

    def note(self, thing, event, text=""):
        self.texts.append(text)

    note.CallDataType = "string0"


class Window:
    """A square window with one actor, seen from +z in a parallel projection of height 2."""

    def __init__(self, size=60, mapper=None):
        self.size = size
        self.mapper = mapper or vtkPhongGouraudMapper()
        self.actor = vtkActor()
        self.actor.SetMapper(self.mapper)
        self.renderer = vtkRenderer()
        self.renderer.AddActor(self.actor)
        self.target = vtkLinearFloatPass()
        self.renderer.SetPass(self.target)
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(0, 0, 5)
        camera.SetFocalPoint(0, 0, 0)
        camera.SetParallelProjection(True)
        camera.SetParallelScale(1.0)
        camera.SetClippingRange(1, 10)
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(size, size)
        self.window.AddRenderer(self.renderer)

    def draw(self):
        """The picture as (size, size, 4) float32, row 0 at the bottom."""
        self.window.Render()
        return self.read()

    def read(self):
        image = self.target.GetColor()
        values = vtk_to_numpy(image.GetPointData().GetScalars())
        return values.reshape(self.size, self.size, 4).copy()

    def at(self, x, y, picture=None):
        """The RGB at world coordinates in [-1, 1]."""
        picture = self.draw() if picture is None else picture
        i = int((x + 1) / 2 * self.size)
        j = int((y + 1) / 2 * self.size)
        return picture[j, i, :3]


def polydata(points, polygons, normals=None):
    """A surface from lists."""
    data = vtkPolyData()
    vertices = vtkPoints()
    vertices.SetDataTypeToDouble()
    for p in points:
        vertices.InsertNextPoint(p)
    cells = vtkCellArray()
    for polygon in polygons:
        cells.InsertNextCell(len(polygon))
        for i in polygon:
            cells.InsertCellPoint(i)
    data.SetPoints(vertices)
    data.SetPolys(cells)
    if normals is not None:
        add(data.GetPointData(), "Normals", normals, dtype=np.float32)
        data.GetPointData().SetActiveNormals("Normals")
    return data


def add(attributes, name, values, dtype=np.float64):
    values = np.array(values, dtype=dtype, ndmin=1)
    array = numpy_to_vtk(values, deep=True)
    array.SetName(name)
    attributes.AddArray(array)
    return array


def square(z=0.0, half=0.8):
    """One square that faces +z, with normals."""
    h = half
    return polydata([(-h, -h, z), (h, -h, z), (h, h, z), (-h, h, z)], [(0, 1, 2, 3)],
                    [(0, 0, 1)] * 4)


def lights(*records):
    """Lights as data: each a dict with Position and arrays by name."""
    data = vtkPolyData()
    points = vtkPoints()
    points.SetDataTypeToDouble()
    verts = vtkCellArray()
    for i, record in enumerate(records):
        points.InsertNextPoint(record.get("Position", (0, 0, 0)))
        verts.InsertNextCell(1)
        verts.InsertCellPoint(i)
    data.SetPoints(points)
    data.SetVerts(verts)
    defaults = {
        "LightType": 0, "Intensity": (1, 1, 1), "Direction": (0, 0, -1), "SpotCutoff": 180,
        "SpotInnerCutoff": -1, "SpotExponent": 0, "Attenuation": (0, 0, 1), "LightEnabled": 1,
    }
    names = set(defaults)
    for record in records:
        names |= set(record)
    names.discard("Position")
    for name in sorted(names):
        default = defaults.get(name, 0)
        add(data.GetPointData(), name, [record.get(name, default) for record in records])
    return data


def run(module_globals):
    """Runs every function named test_... of a test script; exit status 1 if any fails."""
    import traceback

    failed = 0
    tests = [(n, f) for n, f in module_globals.items() if n.startswith("test_") and callable(f)]
    assert tests
    for name, function in tests:
        try:
            function()
            print("passed", name)
        except Exception:  # noqa: BLE001
            failed += 1
            print("FAILED", name)
            traceback.print_exc()
    sys.stdout.flush()
    sys.exit(1 if failed else 0)
