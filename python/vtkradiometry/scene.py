# SPDX-License-Identifier: BSD-3-Clause
"""A scene from disk: surface, lights and camera, checked and made fine enough to compute on."""
import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

from . import mesh
from .camera import Camera
from .compute import field_facts
from .faults import InputFault, Listener
from .vtkRadiometryFilters import vtkRadiometricSceneReader

LIGHT_UNITS = {"auto": 0, "photometric": 1, "radiometric": 2}
EMISSIVE_UNITS = {"auto": 0, "luminance": 1, "radiance": 2, "exitance": 3}
LIGHT_KINDS = {0: "point", 1: "spot", 2: "directional", 3: "area", 4: "environment"}
EXAMPLES = ("gallery", "cornell-box")


def find(name):
    """The scene file that `name` means: a path, or one of the bundled examples."""
    if name is not None and not (name in EXAMPLES and not os.path.exists(name)):
        return name
    folder = os.environ.get("VTKRADIOMETRY_EXAMPLES")
    if not folder:
        here = os.path.dirname(os.path.realpath(__file__))
        folder = os.path.join(here, "..", "..", "examples")
    name = name or "gallery"
    for candidate in (f"{name}/{name}.gltf", f"{name}/{name}.glb", f"{name}/scene.gltf",
                      f"{name}.gltf", f"{name}.glb"):
        path = os.path.join(folder, candidate)
        if os.path.isfile(path):
            return os.path.normpath(path)
    raise InputFault(f"the bundled example {name} is not under {os.path.normpath(folder)}")


class Scene:
    """What was read. `surface` is what is computed on; `original_cells` counts the file's own."""

    def __init__(self, path, surface, lights, camera, assumptions, names):
        self.path = path
        self.surface = surface
        self.lights = lights
        self.camera = camera
        self.assumptions = assumptions
        self.light_names = names
        self.original_cells = surface.GetNumberOfCells()
        self.max_edge = 0.0

    @property
    def emits(self):
        """Whether any surface emits."""
        exitance = mesh.cell_array(self.surface, "EmittedExitance")
        return exitance is not None and bool((exitance > 0.0).any())

    def two_sided(self, surface, chosen):
        """For each cell, whether it counts on both sides; `chosen`: the user's option, or None."""
        flags = mesh.cell_array(surface, "TwoSided")
        if flags is not None:
            return flags[:, 0] != 0.0
        return np.full(surface.GetNumberOfCells(), bool(chosen))

    def efficacy(self):
        """lm/W by which the reader turned photometric values into radiometric ones."""
        facts = field_facts(self.lights)
        value = facts.get("LuminousEfficacy", 683.002)
        return float(value[0] if isinstance(value, list) else value)

    def refine(self, max_edge):
        """Splits large triangles (mesh.refine)."""
        field = self.surface.GetFieldData()
        self.surface, self.max_edge = mesh.refine(self.surface, max_edge)
        if self.surface.GetFieldData().GetNumberOfArrays() == 0:
            self.surface.SetFieldData(field)

    def light_rows(self):
        """The lights as dictionaries for the report."""
        rows = []
        data = self.lights.GetPointData()

        def values(name):
            array = data.GetArray(name)
            return None if array is None else vtk_to_numpy(array)

        kinds, intensity, enabled = values("LightType"), values("Intensity"), values("LightEnabled")
        direction, cutoff = values("Direction"), values("SpotCutoff")
        for index in range(self.lights.GetNumberOfPoints()):
            kind = int(kinds[index])
            row = {
                "Name": self.light_names[index] if index < len(self.light_names) else str(index),
                "Kind": LIGHT_KINDS.get(kind, str(kind)),
                "Intensity": np.atleast_1d(intensity[index]).tolist(),
                "Unit": "W/m^2" if kind == 2 else "W/sr",
                "Enabled": bool(enabled is None or enabled[index]),
                "Position": None if kind == 2 else list(self.lights.GetPoint(index)),
                "Direction": None if kind == 0 or direction is None else direction[index].tolist(),
                "Cutoff": float(cutoff[index]) if kind == 1 and cutoff is not None else None,
            }
            rows.append(row)
        return rows


def _check(path, surface, lights, radiosity):
    """Refuses what cannot be computed with; returns what the user should be warned of."""
    if surface.GetNumberOfCells() == 0:
        raise InputFault(f"{path}: no triangles in the scene")
    xyz = mesh.points(surface)
    bad = np.flatnonzero(~np.isfinite(xyz).all(axis=1))
    if len(bad):
        raise InputFault(f"{path}: point {bad[0]} is {tuple(xyz[bad[0]])}: expected finite numbers")
    exitance = mesh.cell_array(surface, "EmittedExitance")
    emits = exitance is not None and (exitance > 0.0).any()
    enabled = lights.GetPointData().GetArray("LightEnabled")
    lit = lights.GetNumberOfPoints() > 0 and (enabled is None or vtk_to_numpy(enabled).any())
    if not (lit or emits):
        return ["Lights: nothing gives light, neither a light (KHR_lights_punctual) nor an emissive "
                "material: every value is 0."]
    if emits and not radiosity:
        return ["Emission: --no-radiosity leaves out what surfaces emit; the effect plan bounds it."]
    return []


def _set_two_sided(surface, value):
    """Replaces what the materials say about their sides."""
    flags = numpy_to_vtk(np.full(surface.GetNumberOfCells(), int(value), np.uint8), deep=True)
    flags.SetName("TwoSided")
    surface.GetCellData().AddArray(flags)


def _camera(reader, bounds, aspect):
    if reader.GetNumberOfCameras() == 0:
        return Camera.three_quarter(bounds, aspect=aspect)

    def vector(get):
        values = [0.0, 0.0, 0.0]
        get(0, values)
        return values

    parallel = reader.GetCameraParallelProjection(0)
    return Camera(
        vector(reader.GetCameraPosition), vector(reader.GetCameraFocalPoint),
        vector(reader.GetCameraViewUp), reader.GetCameraViewAngle(0),
        reader.GetCameraAspectRatio(0) or aspect,
        2.0 * reader.GetCameraParallelScale(0) if parallel else None, origin="scene")


def read(path, options, progress):
    """Reads and refines the scene; raises InputFault with one line when it cannot be used."""
    if not os.path.exists(path):
        raise InputFault(f"{path}: no such file")
    if not os.path.isfile(path):
        raise InputFault(f"{path}: not a file")
    reader = vtkRadiometricSceneReader()
    reader.SetFileName(path)
    reader.SetLightUnits(LIGHT_UNITS[options.light_units])
    reader.SetEmissiveUnits(EMISSIVE_UNITS[options.emissive_units])
    reader.SetSpecularAsDiffuse(options.specular_as_diffuse)
    with progress.stage("Reading"), Listener() as listener:
        listener.observe(reader)
        listener.observe(reader.GetExecutive())
        reader.Update()
        if listener.errors:
            words = listener.errors[0]
            raise InputFault(words if path in words else f"{path}: {words}")
    surface, lights = vtkPolyData(), vtkPolyData()
    surface.ShallowCopy(reader.GetOutputDataObject(0))
    lights.ShallowCopy(reader.GetOutputDataObject(1))
    warnings = _check(path, surface, lights, options.radiosity)
    for words in warnings:
        sys.stderr.write(f"run: warning: {path}: {words}\n")
    assumptions = [reader.GetAssumption(k) for k in range(reader.GetNumberOfAssumptions())]
    assumptions += warnings
    names = lights.GetFieldData().GetAbstractArray("LightNames")
    names = [names.GetValue(k) for k in range(names.GetNumberOfValues())] if names else []
    camera = _camera(reader, surface.GetBounds(), options.size[0] / options.size[1])
    if options.two_sided is not None:
        _set_two_sided(surface, options.two_sided)
        assumptions.append("Sides: every surface counts on "
                           + ("both sides" if options.two_sided else "its front only")
                           + ", as the command line says.")
    scene = Scene(path, surface, lights, camera, assumptions, names)
    with progress.stage("Refining"):
        try:
            scene.refine(options.max_edge)
        except ValueError as error:
            raise InputFault(f"--max-edge: {error}") from None
    return scene
