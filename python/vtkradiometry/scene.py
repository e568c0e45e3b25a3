# SPDX-License-Identifier: BSD-3-Clause
"""A scene from disk: surface, lights and camera, checked and made fine enough to compute on."""
import os
import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkPolyData

from . import added_lights, mesh, workplane
from .camera import Camera
from .faults import InputFault, Listener
from .lights import Lights
from .vtkRadiometryFilters import vtkRadiometricSceneReader

LIGHT_UNITS = {"auto": 0, "photometric": 1, "radiometric": 2}
EMISSIVE_UNITS = {"auto": 0, "luminance": 1, "radiance": 2, "exitance": 3}
EXAMPLES = ("gallery", "cornell-box", "office")


def _only_scene(folder):
    """The one scene file of a folder."""
    found = sorted(entry for entry in os.listdir(folder) if entry.endswith((".gltf", ".glb")))
    if len(found) == 1:
        return os.path.join(folder, found[0])
    held = "several scenes" if found else "no .gltf or .glb file"
    names = ", ".join((found or sorted(os.listdir(folder)))[:5])
    raise InputFault(f"{folder}: a folder with {held}" + (f" ({names})" if names else "")
                     + ": name a scene file")


def find(name):
    """The scene file that `name` means: a path, a folder with one scene, or a bundled example."""
    if name is not None and os.path.isdir(name):
        return _only_scene(name)
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

    UP = (0.0, 1.0, 0.0)  # of glTF
    NORTH = (0.0, 0.0, -1.0)

    def __init__(self, path, surface, lights, camera, assumptions):
        self.path = path
        self.surface = surface
        self.lights = lights
        self.work_plane = None  # the measuring grid
        self.camera = camera
        self.assumptions = assumptions
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
        return float(self.lights.fact("LuminousEfficacy", 683.002))

    def refine(self, max_edge):
        """Splits large triangles (mesh.refine)."""
        field = self.surface.GetFieldData()
        self.surface, self.max_edge = mesh.refine(self.surface, max_edge)
        if self.surface.GetFieldData().GetNumberOfArrays() == 0:
            self.surface.SetFieldData(field)


def _check(path, surface, lights):
    """Refuses what cannot be computed with; returns what the user should be warned of."""
    if surface.GetNumberOfCells() == 0:
        raise InputFault(f"{path}: no triangles in the scene")
    xyz = mesh.points(surface)
    bad = np.flatnonzero(~np.isfinite(xyz).all(axis=1))
    if len(bad):
        raise InputFault(f"{path}: point {bad[0]} is {tuple(xyz[bad[0]])}: expected finite numbers")
    exitance = mesh.cell_array(surface, "EmittedExitance")
    emits = exitance is not None and (exitance > 0.0).any()
    if not (lights.lit or emits):
        return ["Lights: nothing gives light, neither a light (KHR_lights_punctual) nor an emissive "
                "material: every value is 0."]
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
    surface, own = vtkPolyData(), vtkPolyData()
    surface.ShallowCopy(reader.GetOutputDataObject(0))
    own.ShallowCopy(reader.GetOutputDataObject(1))
    lights = Lights(own)
    assumptions = [reader.GetAssumption(k) for k in range(reader.GetNumberOfAssumptions())]
    with progress.stage("Lights"):
        assumptions += added_lights.add(lights, options, Scene.UP, Scene.NORTH)
    warnings = _check(path, surface, lights)
    for words in warnings:
        sys.stderr.write(f"run: warning: {path}: {words}\n")
    assumptions += warnings
    camera = _camera(reader, surface.GetBounds(), options.size[0] / options.size[1])
    if options.two_sided is not None:
        _set_two_sided(surface, options.two_sided)
        assumptions.append("Sides: every surface counts on "
                           + ("both sides" if options.two_sided else "its front only")
                           + ", as the command line says.")
    scene = Scene(path, surface, lights, camera, assumptions)
    if options.work_plane is not None:
        scene.work_plane = workplane.make(scene, options)
    with progress.stage("Refining"):
        try:
            scene.refine(options.max_edge)
        except ValueError as error:
            raise InputFault(f"--max-edge: {error}") from None
    return scene
