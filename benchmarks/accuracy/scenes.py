# SPDX-License-Identifier: BSD-3-Clause
"""The scenes on which accuracy and its cost are measured (docs/accuracy.md).

Each is plain numbers (numpy), so that every program is given the same; `Scene.filter()` gives
vtkIrradianceFilter or vtkRadiosityFilter with the scene as its input and default settings:

    from accuracy.scenes import scenes
    for scene in scenes():                  # or scene("cornell-box")
        run = scene.filter()
        run.SetRelativeTolerance(0.01)
        run.Update()

What is true on each: accuracy/truth.py.
"""
import os
from dataclasses import dataclass, field

import numpy as np

from accuracy.lamp import PANEL, POINT, SKY, SUN, Lamp
from accuracy.shapes import bowl, box, divided, plane

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
HALF = 3.0         # m, half of the side of the floors
CRATER = {"radius": 100.0, "beta": np.radians(60.0), "sun": np.radians(20.0), "reflectance": 0.3,
          "solar": 1000.0, "rings": 12, "around": 48}


@dataclass
class Scene:
    """corners: cells x 3 or 4 x 3 [m], triangles or parallelograms whose front is where their corners
    turn counter-clockwise; or `sensors`, points with `normals`, and no cells. Reflectance and exitance:
    a row a cell, a column a band. Blockers hide light and are not computed."""
    key: str
    name: str
    bands: int = 1
    corners: np.ndarray = field(default_factory=lambda: np.zeros((0, 3, 3)))
    sensors: np.ndarray = None
    normals: np.ndarray = None
    reflectance: np.ndarray = None
    exitance: np.ndarray = None
    two_sided: np.ndarray = None
    lamps: list = field(default_factory=list)
    blockers: list = field(default_factory=list)  # Convex
    uncut: list = field(default_factory=list)     # what emits before it was cut: (corners, exitance), for
                                                  # programs in which each polygon is a lamp by itself
    indirect: bool = False                        # reflections too: vtkRadiosityFilter
    open: bool = False                            # nothing hides anything, nothing sees another

    def __post_init__(self):
        count = len(self.corners)
        if self.reflectance is None:
            self.reflectance = np.zeros((count, self.bands))
        if self.exitance is None:
            self.exitance = np.zeros((count, self.bands))
        if self.two_sided is None:
            self.two_sided = np.zeros(count, bool)
        if count:
            a, b, d = self.corners[:, 0], self.corners[:, 1], self.corners[:, -1]
            cross = np.cross(b - a, d - a)
            length = np.linalg.norm(cross, axis=1)
            self.area = length * (0.5 if self.corners.shape[1] == 3 else 1.0)
            self.normals = cross / length[:, None]

    def __len__(self):
        """Values that are computed, in each band."""
        return len(self.corners) if self.sensors is None else len(self.sensors)

    def filter(self, method=0, indirect=None):
        """The filter of the project, with the scene as its input; `indirect`: which of the two, if
        not that of the scene."""
        from accuracy.vtkdata import scene_filter
        return scene_filter(self, method, self.indirect if indirect is None else indirect)


def lamp_over_floor():
    return Lamp(POINT, np.array([100.0]), position=np.array([0.31, 0.17, 3.0]))


def panel_over_floor():
    corners = [[-0.4, -0.6, 3.0], [-0.4, 0.6, 3.0], [0.6, 0.6, 3.0], [0.6, -0.6, 3.0]]
    return Lamp(PANEL, np.array([100.0]), corners=np.array(corners))


def box_over_floor():
    return box(np.array([-0.1, 0.2, 1.3]), np.array([1.3, 0.7, 0.5]), 0.4)


def floor(key, name, lamp, blockers, cells=64):
    return Scene(key, name, corners=plane(HALF, cells), reflectance=np.full((cells**2, 1), 0.5),
                 lamps=[lamp], blockers=blockers, open=not blockers)


def from_file(key, name, path, edge=None, kinds=(POINT, SUN)):
    """The diffuse part of a glTF scene with its lights of `kinds`; `edge`: cut into triangles with
    edges of at most that many metres."""
    import vtkradiometry as vr
    from vtkmodules.util.numpy_support import vtk_to_numpy

    reader = vr.vtkRadiometricSceneReader()
    reader.SetFileName(os.path.join(ROOT, "examples", path))
    reader.Update()
    surface, lights = reader.GetOutput(0), reader.GetOutputDataObject(1)
    cells = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    corners = vtk_to_numpy(surface.GetPoints().GetData())[cells].astype(float)
    get = surface.GetCellData().GetArray
    optics = np.concatenate([vtk_to_numpy(get("DiffuseReflectance")),
                             vtk_to_numpy(get("EmittedExitance")),
                             vtk_to_numpy(get("TwoSided"))[:, None]], 1)
    shining = [(c, o[3:6]) for c, o in zip(corners, optics) if o[3:6].any()]
    if edge:
        parts = [divided(triangle, edge) for triangle in corners]
        corners = np.concatenate(parts)
        optics = np.repeat(optics, [len(part) for part in parts], 0)
    lamps = []
    for i in range(lights.GetNumberOfPoints()):
        value = {name: vtk_to_numpy(lights.GetPointData().GetArray(name))[i]
                 for name in ("LightType", "Intensity", "Direction")}
        if value["LightType"] in kinds:
            toward = value["Direction"] / np.linalg.norm(value["Direction"])
            lamps.append(Lamp(int(value["LightType"]), np.array(value["Intensity"]),
                              np.array(lights.GetPoint(i)), toward))
    return Scene(key, name, 3, corners, reflectance=optics[:, :3], exitance=optics[:, 3:6],
                 two_sided=optics[:, 6] != 0, lamps=lamps, uncut=shining, indirect=True)


def street():
    """The crossing of examples/street, under a bright haze from all around and a sun."""
    import importlib.util
    from vtkmodules.util.numpy_support import vtk_to_numpy

    path = os.path.join(ROOT, "examples", "street", "street.py")
    spec = importlib.util.spec_from_file_location("street", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    town = module.town()
    cells = vtk_to_numpy(town.GetPolys().GetConnectivityArray()).reshape(-1, 4)
    corners = vtk_to_numpy(town.GetPoints().GetData())[cells].astype(float)
    kind = vtk_to_numpy(town.GetCellData().GetArray("Kind"))
    reflectance = np.array([0.2, 0.5, 0.3])[kind][:, None]
    toward = -np.array([np.cos(0.7) * np.cos(0.6), np.cos(0.7) * np.sin(0.6), np.sin(0.7)])
    lamps = [Lamp(SKY, np.array([100.0 / np.pi])), Lamp(SUN, np.array([800.0]), direction=toward)]
    return Scene("street-canyon", "street canyon", 1, corners, reflectance=reflectance, lamps=lamps,
                 indirect=True)


def crater():
    """A bowl of a sphere under a low sun (Ingersoll 1966): part of it gets reflected light alone."""
    c = CRATER
    cells, _ = bowl(c["radius"], c["beta"], c["rings"], c["around"])
    toward = np.array([np.cos(c["sun"]), 0.0, -np.sin(c["sun"])])
    return Scene("crater", "crater", 1, cells,
                 reflectance=np.full((len(cells), 1), c["reflectance"]),
                 lamps=[Lamp(SUN, np.array([c["solar"]]), direction=toward)], indirect=True)


def many_lights(count=10000, side=1000.0, sensors=32, houses=64):
    """Street lamps on a square kilometre between houses, one in 100 m2; what the ground gets at 1024
    places. No lamp and no sensor stands in a house."""
    rng = np.random.default_rng(20260)

    def scattered(n):
        """One random place in each of n x n squares."""
        i = np.stack(np.meshgrid(np.arange(n), np.arange(n), indexing="ij"), -1).reshape(-1, 2)
        return (i + rng.random((n * n, 2))) * (side / n) - 0.5 * side

    rows = int(np.sqrt(houses))
    bodies, middles, sizes, turns = [], [], [], []
    for i in range(rows):
        for j in range(rows):
            middle = (np.array([i, j]) + 0.5 + 0.2 * (rng.random(2) - 0.5)) * (side / rows) - 0.5 * side
            size = np.array([*(20.0 + 30.0 * rng.random(2)), 8.0 + 22.0 * rng.random()])
            turn = np.pi * rng.random()
            bodies.append(box(np.array([*middle, 0.5 * size[2]]), size, turn))
            middles.append(middle)
            sizes.append(size[:2])
            turns.append(turn)

    def outside(places):
        """Moved out of the houses, to the side of the one that they were in."""
        places = places.copy()
        for middle, size, turn in zip(middles, sizes, turns):
            axes = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
            local = (places - middle) @ axes.T
            inside = (np.abs(local) < 0.5 * size + 0.5).all(1)
            local[inside, 0] = np.sign(local[inside, 0]) * (0.5 * size[0] + 0.5 + rng.random(inside.sum()))
            places[inside] = middle + local[inside] @ axes
        return places

    lamps = outside(scattered(int(np.sqrt(count))))
    power = 20.0 * 10.0**rng.random(len(lamps))
    places = outside(scattered(sensors))
    return Scene("many-lights", "10,000 lights",
                 sensors=np.column_stack([places, np.zeros(len(places))]),
                 normals=np.tile([0.0, 0.0, 1.0], (len(places), 1)), blockers=bodies,
                 lamps=[Lamp(POINT, np.array([p]), position=np.array([*place, 6.0]))
                        for place, p in zip(lamps, power)])


MAKERS = {
    "open-plane": lambda: floor("open-plane", "open plane, point light", lamp_over_floor(), []),
    "open-plane-panel": lambda: floor("open-plane-panel", "open plane, panel", panel_over_floor(), []),
    "blocked-plane": lambda: floor("blocked-plane", "blocked plane, point light", lamp_over_floor(),
                                   [box_over_floor()]),
    "blocked-plane-panel": lambda: floor("blocked-plane-panel", "blocked plane, panel",
                                         panel_over_floor(), [box_over_floor()]),
    "gallery": lambda: from_file("gallery", "gallery", "gallery/gallery.glb"),
    "cornell-box": lambda: from_file("cornell-box", "Cornell box", "cornell-box/cornell-box.glb", 0.08),
    "street-canyon": street,
    "crater": crater,
    "many-lights": many_lights,
}


def scene(key):
    return MAKERS[key]()


def scenes(keys=None):
    return [scene(key) for key in (keys or MAKERS)]
