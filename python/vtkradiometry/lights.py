# SPDX-License-Identifier: BSD-3-Clause
"""The lights of a run: those of the scene and those of the command line, each a polydata."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList

from .compute import field_facts

POINT, SPOT, DIRECTIONAL, AREA, ENVIRONMENT = range(5)
KINDS = {POINT: "point", SPOT: "spot", DIRECTIONAL: "directional", AREA: "area",
         ENVIRONMENT: "environment"}
UNITS = {POINT: "W/sr", SPOT: "W/sr", DIRECTIONAL: "W/m^2", AREA: "W/m^2 leaving",
         ENVIRONMENT: "W/(m^2 sr)"}


class Light:
    """One light as its arrays say: `points` are the corners of an area light, else its place."""

    def __init__(self, data, index, points, name):
        self.data, self.index, self.name = data, index, name
        self.points = np.array([data.GetPoint(k) for k in points])
        self.kind = int(self.value("LightType", POINT))
        self.enabled = bool(self.value("LightEnabled", 1))
        self.direction = np.asarray(self.value("Direction", (0.0, 0.0, -1.0)), dtype=float)
        self.reference = np.asarray(self.value("ReferenceDirection", (1.0, 0.0, 0.0)), dtype=float)
        self.two_sided = bool(self.value("LightTwoSided", 0))
        web = int(self.value("PhotometricWeb", -1))
        self.web = web if self.kind == POINT and web >= 0 else None

    def value(self, name, fallback):
        """This light's tuple of a point array."""
        array = self.data.GetPointData().GetArray(name)
        return fallback if array is None else vtk_to_numpy(array)[self.index]

    @property
    def words(self):
        """What kind of light it is."""
        return "luminaire" if self.web is not None else KINDS.get(self.kind, str(self.kind))

    def web_array(self, suffix=""):
        """An array of the candela web in field data, flat; None where it is missing."""
        array = self.data.GetFieldData().GetAbstractArray(f"PhotometricWeb{self.web}{suffix}")
        return None if array is None else vtk_to_numpy(array).reshape(-1)

    def row(self):
        """The light as a dictionary for the report."""
        aimed = self.kind != POINT or self.web is not None
        placed = self.kind not in (DIRECTIONAL, ENVIRONMENT)
        return {
            "Name": self.name,
            "Kind": self.words,
            "Intensity": np.atleast_1d(self.value("Intensity", 0.0)).tolist(),
            "Unit": UNITS.get(self.kind, ""),
            "Enabled": self.enabled,
            "Position": self.points.mean(axis=0).tolist() if placed else None,
            "Direction": self.direction.tolist() if aimed and self.kind != AREA else None,
            "Cutoff": float(self.value("SpotCutoff", 180.0)) if self.kind == SPOT else None,
        }


def _lights_of(data):
    """The lights in the order of their (first) points, which is that of LightNames."""
    names = data.GetFieldData().GetAbstractArray("LightNames")
    known = names.GetNumberOfValues() if names else 0
    kinds = data.GetPointData().GetArray("LightType")
    kinds = vtk_to_numpy(kinds) if kinds else np.zeros(data.GetNumberOfPoints())
    places = [[int(index)] for index in np.flatnonzero(kinds != AREA)]
    corners = vtkIdList()
    for cell in range(data.GetNumberOfCells()):
        data.GetCellPoints(cell, corners)
        points = [corners.GetId(k) for k in range(corners.GetNumberOfIds())]
        if len(points) >= 3 and kinds[points[0]] == AREA:
            places.append(points)
    places.sort()
    found = []
    for number, points in enumerate(places):
        name = names.GetValue(number) if number < known else ""
        found.append(Light(data, points[0], points, name or str(number)))
    return found


class Lights:
    """All lights, in as many polydata as there are sources of them."""

    def __init__(self, *parts):
        self.parts = [part for part in parts if part is not None and part.GetNumberOfPoints() > 0]

    def add(self, part):
        """A further polydata of lights."""
        if part.GetNumberOfPoints() > 0:
            self.parts.append(part)

    def __bool__(self):
        return bool(self.parts)

    def __iter__(self):
        for part in self.parts:
            yield from _lights_of(part)

    def connect(self, algorithm):
        """Hands them to a simulating filter."""
        for part in self.parts:
            algorithm.AddInputDataObject(1, part)

    @property
    def soft(self):
        """Whether any light casts soft shadows: an area or the sky."""
        return any(light.enabled and light.kind in (AREA, ENVIRONMENT) for light in self)

    def sharp(self):
        """These lights with those of soft shadows switched off."""
        parts = []
        for part in self.parts:
            kinds = vtk_to_numpy(part.GetPointData().GetArray("LightType"))
            enabled = part.GetPointData().GetArray("LightEnabled")
            on = np.ones(len(kinds)) if enabled is None else vtk_to_numpy(enabled)
            flags = numpy_to_vtk(((on != 0) & (kinds < AREA)).astype(np.int32), deep=True)
            flags.SetName("LightEnabled")
            copy = part.NewInstance()
            copy.ShallowCopy(part)
            copy.GetPointData().AddArray(flags)
            parts.append(copy)
        return Lights(*parts)

    def fact(self, name, fallback):
        """Field data of the lights: the first part that says something."""
        for part in self.parts:
            value = field_facts(part).get(name)
            if value is not None:
                return value[0] if isinstance(value, list) else value
        return fallback

    @property
    def lit(self):
        """Whether any of them shines."""
        return any(light.enabled for light in self)

    @property
    def photometric(self):
        """Whether intensities were given in lm, cd or lx."""
        return not self.parts or any(
            np.any(field_facts(part).get("Photometric", 1)) for part in self.parts)

    def rows(self):
        """The lights as dictionaries for the report."""
        return [light.row() for light in self]
