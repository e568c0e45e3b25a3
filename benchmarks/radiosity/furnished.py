# SPDX-License-Identifier: BSD-3-Clause
"""The furnished scene (benchmarks/FurnishedScene.h) in Python: arrays, VTK data and lights."""
import json
import os
import subprocess
import tempfile

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from accuracy.lamp import POINT, Lamp
from accuracy.scenes import ROOT, Scene

BANDS = 3


class Furnished:
    """corners, normal, area, reflectance, exitance: a row a cell; lamps: of `intensity` W/sr each."""

    def __init__(self, count, build="build"):
        program = os.path.join(ROOT, build, "bin", "furnished_scene")
        if not os.path.exists(program):
            raise SystemExit(f"{program} is not there: configure with "
                             "-DVTKRADIOMETRY_BUILD_BENCHMARKS=ON and build")
        with tempfile.NamedTemporaryFile() as made:
            subprocess.run([program, str(count), made.name], check=True)
            with open(made.name, "rb") as file:
                head = json.loads(file.readline())
                points = np.fromfile(file, np.float64, 3 * head["points"]).reshape(-1, 3)
                cells = np.fromfile(file, np.int32, 3 * head["triangles"]).reshape(-1, 3)
                kinds = np.fromfile(file, np.uint8, head["triangles"])
                self.lamps = np.fromfile(file, np.float64, 3 * head["lamps"]).reshape(-1, 3)
        order = np.argsort(kinds, kind="stable")  # kinds are consecutive
        self.points, self.cells, kinds = points, cells[order], kinds[order]
        self.intensity = head["lampIntensity"]
        self.reflectance = np.array(head["reflectance"])[kinds]
        self.exitance = np.repeat(np.array(head["exitance"])[kinds][:, None], BANDS, 1)
        self.corners = points[self.cells]
        ends = [0, *(np.flatnonzero(np.diff(kinds)) + 1).tolist(), len(kinds)]
        self.kinds = list(zip(ends[:-1], ends[1:]))
        cross = np.cross(self.corners[:, 1] - self.corners[:, 0],
                         self.corners[:, 2] - self.corners[:, 0])
        self.area = 0.5 * np.linalg.norm(cross, axis=1)
        self.normal = cross / (2.0 * self.area[:, None])

    def __len__(self):
        return len(self.cells)

    def plain(self):
        """The same as plain numbers for other programs."""
        lamps = [Lamp(POINT, np.full(BANDS, self.intensity), position=place) for place in self.lamps]
        return Scene("furnished", "furnished rooms", BANDS, self.corners, reflectance=self.reflectance,
                     exitance=self.exitance, lamps=lamps, indirect=True)

    def surface(self):
        data = vtkPolyData()
        places = vtkPoints()
        places.SetData(numpy_to_vtk(self.points, deep=True))
        data.SetPoints(places)
        cells = vtkCellArray()
        cells.SetData(
            numpy_to_vtkIdTypeArray(np.arange(0, 3 * len(self) + 1, 3, dtype=np.int64), deep=True),
            numpy_to_vtkIdTypeArray(self.cells.ravel().astype(np.int64), deep=True))
        data.SetPolys(cells)
        named(data.GetCellData(), "DiffuseReflectance", self.reflectance)
        named(data.GetCellData(), "EmittedExitance", self.exitance)
        return data

    def lights(self, shift=(0.0, 0.0, 0.0), factor=(1.0, 1.0, 1.0)):
        """The point lights, moved and recoloured."""
        data = vtkPolyData()
        places = vtkPoints()
        places.SetData(numpy_to_vtk(self.lamps + np.array(shift), deep=True))
        data.SetPoints(places)
        count = len(self.lamps)
        verts = vtkCellArray()
        verts.SetData(numpy_to_vtkIdTypeArray(np.arange(count + 1, dtype=np.int64), deep=True),
                      numpy_to_vtkIdTypeArray(np.arange(count, dtype=np.int64), deep=True))
        data.SetVerts(verts)
        named(data.GetPointData(), "LightType", np.zeros(count, np.int32))
        named(data.GetPointData(), "Intensity", np.tile(self.intensity * np.array(factor), (count, 1)))
        return data


def named(data, name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    data.AddArray(array)
