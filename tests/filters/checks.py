# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the scene's filters share."""
import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkradiometry import vtkDirectionalLightSource

SHARED_DATA = os.environ.get("RADIOMETRY_SHARED_DATA", "")
SOURCE_DIR = os.environ.get("RADIOMETRY_SOURCE_DIR", "")


def shared(path):
    """A file of the shared data; None where the folder is absent."""
    full = os.path.join(SHARED_DATA, path)
    return full if os.path.exists(full) else None


def close(value, expected, relative=1e-12, absolute=0.0):
    """Asserts that value(s) agree with expected one(s); NaN never does."""
    value, expected = np.asarray(value, float), np.asarray(expected, float)
    assert value.shape == expected.shape, (value.shape, expected.shape)
    bad = ~(np.abs(value - expected) <= relative * np.abs(expected) + absolute)
    assert not bad.any(), f"{value} is not {expected} (relative {relative}, absolute {absolute})"


def array(data, name):
    """An array of point, cell or field data as numpy."""
    found = data.GetAbstractArray(name)
    assert found is not None, f"no array {name}"
    if found.IsA("vtkStringArray"):
        return [found.GetValue(i) for i in range(found.GetNumberOfValues())]
    return vtk_to_numpy(found)


def points(data):
    return vtk_to_numpy(data.GetPoints().GetData())


def triangles(data):
    cells = vtk_to_numpy(data.GetPolys().GetConnectivityArray())
    return cells.reshape(-1, 3)


def square(resolution=1, size=2.0, center=(0.0, 0.0, 0.0)):
    """A level square of resolution x resolution cells in double precision, its front up."""
    source = vtkPlaneSource()
    x, y, z = center
    h = 0.5 * size
    source.SetOrigin(x - h, y - h, z)
    source.SetPoint1(x + h, y - h, z)
    source.SetPoint2(x - h, y + h, z)
    source.SetResolution(resolution, resolution)
    source.SetOutputPointsPrecision(vtkAlgorithm.DOUBLE_PRECISION)
    source.Update()
    data = vtkPolyData()
    data.ShallowCopy(source.GetOutput())
    return data


def sun(direction, intensity):
    """A directional light of so many W/m^2."""
    source = vtkDirectionalLightSource()
    source.SetDirection(direction)
    source.SetIntensity(intensity)
    return source


def simulation(kind, data, *lights, **properties):
    """A simulating filter on data under lights, with its properties set."""
    f = kind()
    f.SetInputData(data)
    for light in lights:
        f.AddLightsConnection(light.GetOutputPort())
    for name, value in properties.items():
        getattr(f, "Set" + name)(value)
    return f


def cell_values(f, name):
    f.Update()
    return array(f.GetOutputDataObject(0).GetCellData(), name)


def strings(table, name):
    """A column of words."""
    column = table.GetColumnByName(name)
    return [column.GetValue(i) for i in range(column.GetNumberOfValues())]


class Errors:
    """Collects the error events of an algorithm and of its executive."""

    def __init__(self, algorithm):
        self.messages = []
        self.executive = []
        algorithm.AddObserver("ErrorEvent", self._collect(self.messages))
        algorithm.GetExecutive().AddObserver("ErrorEvent", self._collect(self.executive))

    @staticmethod
    def _collect(into):
        def collect(caller, event, text=""):
            into.append(text)

        collect.CallDataType = "string0"
        return collect


def fails(algorithm, *words):
    """Asserts that an update fails with one error of one line that has all the words in it, and
    leaves every output empty. Returns the message."""
    errors = Errors(algorithm)
    algorithm.Update()
    assert len(errors.messages) == 1, errors.messages
    message = errors.messages[0].split("): ", 1)[1].strip()
    assert "\n" not in message, message
    for word in words:
        assert word in message, f"{word!r} not in {message!r}"
    for port in range(algorithm.GetNumberOfOutputPorts()):
        data = algorithm.GetOutputDataObject(port)
        assert data.GetNumberOfElements(0) == 0, (port, data.GetNumberOfElements(0))
        if data.IsA("vtkDataSet"):
            assert data.GetNumberOfCells() == 0
    assert errors.executive, "RequestData did not return 0"
    return message


def run_all(namespace):
    """Runs every function whose name starts with test_; the first failure ends the run."""
    done = 0
    for name, function in list(namespace.items()):
        if name.startswith("test_") and callable(function):
            function()
            print("passed", name)
            done += 1
    assert done, "no tests"
    sys.exit(0)
