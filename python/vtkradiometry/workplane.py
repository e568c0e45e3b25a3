# SPDX-License-Identifier: BSD-3-Clause
"""The measuring grid of --work-plane: its sensors, its numbers, its table and its picture."""
import csv

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .faults import Listener
from .lights import AREA, DIRECTIONAL, ENVIRONMENT
from .plots import rows_of
from .scales import Scale, format_number
from .vtkRadiometryFilters import vtkRadiometricStatistics, vtkWorkPlaneSource

LINES = "0.1"  # ink of the iso-lux lines


def make(scene, options):
    """The sensors over the scene, as vtkWorkPlaneSource gives them."""
    source = vtkWorkPlaneSource()
    source.SetInputDataObject(scene.surface)
    source.SetModeToRoom()
    source.SetUpDirection(scene.UP)
    source.SetHeight(options.work_plane)
    source.SetWallZone(options.wall_zone)
    if options.grid_spacing:
        source.SetSpacingRuleToFixedSpacing()
        source.SetSpacing(options.grid_spacing)
    with Listener() as listener:
        listener.observe(source)
        listener.observe(source.GetExecutive())
        source.Update()
        listener.check("work plane")
    sensors = vtkPolyData()
    sensors.ShallowCopy(source.GetOutput())
    return sensors


class WorkPlane:
    """The grid of a result with its statistics and lines of equal illuminance."""

    def __init__(self, sensors, up):
        self.sensors = sensors
        self.rule = sensors.GetFieldData().GetAbstractArray("SensorGridRule").GetValue(0)
        statistics = vtkRadiometricStatistics()
        statistics.SetInputDataObject(sensors)
        statistics.SetIsolineArray("Illuminance")
        for name in ("Illuminance", "Irradiance", "LuminousExposure", "Dose"):
            if sensors.GetPointData().HasArray(name):
                statistics.AddArrayName(name)
        with Listener() as listener:
            listener.observe(statistics)
            statistics.Update()
            listener.check("work plane")
        names, rows = rows_of(statistics.GetOutputDataObject(0))
        self.statistics = [dict(zip(names, row)) for row in rows]
        names, rows = rows_of(statistics.GetOutputDataObject(2))
        self.levels = [dict(zip(names, row)) for row in rows]
        self.lines = statistics.GetOutputDataObject(1)
        self.cells = statistics.GetOutputDataObject(3)
        self.axes = plan_axes(np.asarray(up, dtype=float))

    def values(self, name):
        """A result at each sensor, all bands together."""
        array = self.sensors.GetPointData().GetArray(name)
        values = vtk_to_numpy(array).reshape(self.sensors.GetNumberOfPoints(), -1)
        return values.mean(axis=1)

    def rows(self):
        """The report's lines: illuminance, irradiance and doses, all bands together."""
        units = {"Illuminance": "lx", "Irradiance": "W/m^2", "LuminousExposure": "lx s",
                 "Dose": "J/m^2"}
        found = []
        for row in self.statistics:
            several = any(other["Array"] == row["Array"] and other["Component"] == -1
                          for other in self.statistics)
            if several and row["Component"] != -1:
                continue
            found.append({"Quantity": row["Array"], "Unit": units[row["Array"]],
                          "Minimum": row["Minimum"], "Mean": row["Mean"],
                          "Maximum": row["Maximum"], "U0": row["U0"], "Ud": row["Ud"],
                          "Points": row["Cells"]})
        return found

    def sentence(self):
        """The one line for the terminal."""
        row = self.rows()[0]
        error = float(self.values("IlluminanceError").mean())
        return (f"Work plane: mean {format_number(row['Mean'])} lx, minimum "
                f"{format_number(row['Minimum'])}, maximum {format_number(row['Maximum'])}, U0 "
                f"{row['U0']:.2f}, Ud {row['Ud']:.2f} at {row['Points']} points; estimated error "
                f"{format_number(error)} lx." + self._dark())

    def _dark(self):
        """Points without light stand in something more often than not, and spoil U0 and Ud."""
        dark = int((self.values("Illuminance") == 0.0).sum())
        return f" {dark} of the points get no light: inside a body?" if dark else ""

    def plan(self, points):
        """Places of the scene as seen from above: (n, 2) in metres."""
        return np.asarray(points, dtype=float).reshape(-1, 3) @ self.axes.T


def plan_axes(up):
    """Right and up on the plan, seen against the up direction: in glTF +X and -Z (north)."""
    up = up / np.linalg.norm(up)
    start = np.array([1.0, 0.0, 0.0]) if abs(up[0]) < 0.9 else np.array([0.0, 1.0, 0.0])
    right = start - start.dot(up) * up
    right /= np.linalg.norm(right)
    return np.stack([right, np.cross(up, right)])


def write_csv(path, plane):
    """A line a sensor: place, illuminance and irradiance with their errors, doses."""
    names = [name for name in ("Illuminance", "IlluminanceError", "Irradiance", "IrradianceError",
                               "LuminousExposure", "Dose")
             if plane.sensors.GetPointData().HasArray(name)]
    places = vtk_to_numpy(plane.sensors.GetPoints().GetData())
    with open(path, "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        writer.writerow(["X", "Y", "Z", *names])
        columns = [plane.values(name) for name in names]
        for index, place in enumerate(places):
            writer.writerow([*place.tolist(), *(float(column[index]) for column in columns)])


def _polygons(data, plane):
    """The cells of polydata as (n, corner, 2) plan coordinates."""
    corners = plane.plan(vtk_to_numpy(data.GetPoints().GetData()))
    ids, found = vtkIdList(), []
    for cell in range(data.GetNumberOfCells()):
        data.GetCellPoints(cell, ids)
        found.append(corners[[ids.GetId(k) for k in range(ids.GetNumberOfIds())]])
    return found


def _at(line, way, length):
    """The place on a polyline at this length of way."""
    return np.array([np.interp(length, way, line[:, k]) for k in range(2)])


def _label_place(line, taken, room):
    """A place on a polyline for its label, `room` away from the labels there are, with the slope in
    degrees (never upside down); None where there is none."""
    steps = np.linalg.norm(np.diff(line, axis=0), axis=1)
    way = np.concatenate([[0.0], np.cumsum(steps)])
    for share in (0.5, 0.35, 0.65, 0.2, 0.8, 0.42, 0.58, 0.28, 0.72):
        place = _at(line, way, share * way[-1])
        if all(np.linalg.norm(place - other) >= room for other in taken):
            before, after = (_at(line, way, share * way[-1] + s * room) for s in (-0.4, 0.4))
            slope = np.degrees(np.arctan2(*(after - before)[::-1]))
            return place, (slope + 90.0) % 180.0 - 90.0
    return None


def _draw_lines(axes, plane, halo):
    extent = np.ptp(plane.plan(vtk_to_numpy(plane.sensors.GetPoints().GetData())), axis=0).max()
    labels = plane.lines.GetCellData().GetAbstractArray("Label")
    lines = _polygons(plane.lines, plane)
    for line in lines:
        axes.plot(line[:, 0], line[:, 1], color=LINES, linewidth=1.1, zorder=5)
    taken, room = [], 0.11 * extent
    lengths = [np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in lines]
    for index in np.argsort(lengths)[::-1]:  # the longest choose first
        found = _label_place(lines[index], taken, room) if lengths[index] > 1.5 * room else None
        if found is None:
            continue
        place, slope = found
        taken.append(place)
        axes.text(*place, labels.GetValue(int(index)), rotation=slope, fontsize=9, color=LINES,
                  horizontalalignment="center", verticalalignment="center", zorder=7,
                  path_effects=halo, rotation_mode="anchor")


def _draw_walls(axes, plane, surface, collections):
    """The room's outline from above: what stands upright."""
    up = np.cross(*plane.axes)
    walls = []
    for corner, flat in zip(_corners(surface), _polygons(surface, plane)):
        normal = np.cross(corner[1] - corner[0], corner[2] - corner[0])
        length = np.linalg.norm(normal)
        if length > 0.0 and abs(normal @ up) < 0.05 * length:
            walls.append(np.vstack([flat, flat[:1]]))
    axes.add_collection(collections.LineCollection(walls, colors="0.55", linewidths=0.8, zorder=3))


def _corners(surface):
    places = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    ids, found = vtkIdList(), []
    for cell in range(surface.GetNumberOfCells()):
        surface.GetCellPoints(cell, ids)
        found.append(places[[ids.GetId(k) for k in range(ids.GetNumberOfIds())]])
    return found


def _draw_lights(axes, plane, lights):
    """Where lights with a place hang."""
    drawn = False
    for light in lights:
        if not light.enabled or light.kind in (DIRECTIONAL, ENVIRONMENT):
            continue
        flat = plane.plan(light.points)
        if light.kind == AREA:
            flat = np.vstack([flat, flat[:1]])
            axes.plot(flat[:, 0], flat[:, 1], color="#d4380d", linewidth=2.0, zorder=6,
                      label=None if drawn else "lights")
        else:
            axes.plot(*flat[0], "o", color="#d4380d", markersize=6, markeredgecolor="white",
                      zorder=6, label=None if drawn else "lights")
        drawn = True
    return drawn


def _bounds(plane, surface):
    """The scene's extent on the plan."""
    bounds = np.array(surface.GetBounds()).reshape(3, 2)
    corners = plane.plan(np.array(np.meshgrid(*bounds)).reshape(3, -1).T)
    return corners.min(axis=0), corners.max(axis=0)


def write_png(path, plane, scene, options):
    """The plane from above in false colour, with labelled iso-lux lines, walls and lights."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import collections, patheffects, pyplot

    size = options.size
    shown = plane.values("Illuminance")
    scale = Scale.choose(shown, np.ones(len(shown)), "linear")
    low, high = _bounds(plane, scene.surface)
    # At most as wide as the other pictures, and no wider than the room wants.
    tall = max(10.0 * size[1] / size[0], 4.0)
    wide = min(max((tall - 1.6) * (high - low)[0] / (high - low)[1] + 2.4, 7.0), 10.0)
    figure, axes = pyplot.subplots(figsize=(wide, tall), dpi=size[0] / 10.0, layout="constrained")
    cells = collections.PolyCollection(_polygons(plane.cells, plane), array=shown, cmap="viridis",
                                       edgecolors="face", linewidths=0.3, zorder=2)
    cells.set_clim(scale.low, scale.high)
    axes.add_collection(cells)
    _draw_walls(axes, plane, scene.surface, collections)
    halo = [patheffects.withStroke(linewidth=3.0, foreground="white")]
    _draw_lines(axes, plane, halo)
    places = plane.plan(vtk_to_numpy(plane.sensors.GetPoints().GetData()))
    axes.plot(places[:, 0], places[:, 1], "o", color="white", markersize=2.6, zorder=4,
              markeredgecolor="0.3", markeredgewidth=0.4, label=f"{len(places)} measuring points")
    _draw_lights(axes, plane, scene.lights)
    margin = 0.03 * (high - low).max()
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - margin, high[1] + margin)
    axes.set_aspect("equal")
    axes.set_xlabel("m")
    axes.set_ylabel("m")
    row = plane.rows()[0]
    axes.set_title(f"Illuminance {options.work_plane:g} m above the floor: mean "
                   f"{format_number(row['Mean'])} lx, U0 {row['U0']:.2f}, Ud {row['Ud']:.2f}",
                   fontsize=11)
    figure.colorbar(cells, ax=axes, label="lx", fraction=0.046, pad=0.03)
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.08), ncol=2, fontsize=9, frameon=False)
    figure.savefig(path, format="png")
    pyplot.close(figure)
