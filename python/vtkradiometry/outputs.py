# SPDX-License-Identifier: BSD-3-Clause
"""Writes all the files of a run into an OutputFolder."""
import math
import os

import numpy as np
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from . import falsecolor, mesh, picture, plots, quantities, report, sky, view_mesh, workplane
from .faults import Listener
from .image_file import write_exr
from .plan import plan_lines
from .scales import Scale, format_number
from .versions import versions
from .vtkRadiometryFilters import vtkIrradianceFilter

RESULTS = ("Irradiance", "IrradianceError", "Radiosity", "RadiosityError", "DirectIrradiance",
           "DirectIrradianceError")


def _field_string(data, name, values):
    array = vtkStringArray()
    array.SetName(name)
    for value in [values] if isinstance(values, str) else values:
        array.InsertNextValue(str(value))
    data.GetFieldData().AddArray(array)


def merge(results):
    """One surface with the arrays of all results.

    The last result is the most complete one; what an earlier one calls Irradiance is the light
    that comes straight from the lamps, and is kept as DirectIrradiance.
    """
    surface = results[-1].surface.NewInstance()
    surface.ShallowCopy(results[-1].surface)
    for result in results[:-1]:
        for data, target in ((result.surface.GetCellData(), surface.GetCellData()),
                             (result.surface.GetPointData(), surface.GetPointData())):
            for name in ("Irradiance", "IrradianceError", "IrradianceBack",
                         "IrradianceBackError"):
                array = data.GetArray(name)
                if array is None:
                    continue
                copy = array.NewInstance()
                copy.DeepCopy(array)
                if target.HasArray(name):
                    copy.SetName("Direct" + name)
                target.AddArray(copy)
    return surface


def _write_surface(path, surface, scene, options):
    _field_string(surface, "Scene", os.path.basename(scene.path))
    _field_string(surface, "Version", versions()["vtkRadiometry"])
    _field_string(surface, "Options",
                  [f"{key}={value}" for key, value in option_values(options).items()])
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(path)
    writer.SetInputData(surface)
    # Not raw appended data: VTK 9.2 cannot read it with an expat that defers parsing (2.6, and the
    # security update of 2.5 in Debian 12).
    writer.SetDataModeToBinary()
    if not writer.Write():
        raise OSError(f"{path} could not be written")


def option_values(options):
    """The options of the command line that bear on the result."""
    values = dict(vars(options))
    for name in ("output", "quiet", "version", "scene", "study_tolerance"):
        values.pop(name, None)
    return {key: value for key, value in sorted(values.items()) if value is not None}


def _seen(surface, name, back):
    """The result `name` per cell on the side that the picture shows."""
    front = quantities.per_cell(surface, name)
    stem, error = (name[:-5], "Error") if name.endswith("Error") else (name, "")
    rear = quantities.per_cell(surface, stem + "Back" + error) if back.any() else None
    if front is None or rear is None:
        return front
    return np.where(back[:, None], rear, front)


class View:
    """Irradiance and radiance at the points of a mesh made for the picture (view_mesh.py)."""

    def __init__(self, scene, surface, options, progress):
        self.smooth = mesh.SmoothSurface(surface)
        drawn, back = view_mesh.sides(surface, scene.camera,
                                      scene.two_sided(surface, options.two_sided))
        self.drawn = drawn
        # falsecolor.png is narrower, so it shows more above and below.
        size = options.size[0], round(options.size[1] / (1.0 - falsecolor.LEGEND_SHARE))
        seen = picture.seen_cells(view_mesh.coarse_polydata(surface, drawn), scene.camera, size)
        self.mesh = view_mesh.ViewMesh(surface, self.smooth, scene.camera, size, drawn, back, seen)
        rest = self._rest(scene, surface, back, options, progress)
        self.irradiance = self._total(rest, scene, surface, options, progress)
        if scene.lights:  # shadows have edges
            self.mesh.sharpen(self.irradiance)
            self.irradiance = self._total(rest, scene, surface, options, progress)
        reflectance = mesh.cell_array(surface, "DiffuseReflectance")
        if reflectance is None:
            reflectance = np.full((len(back), 1), 0.5)
        emitted = mesh.cell_array(surface, "EmittedExitance")
        radiosity = self.mesh.from_computed(self.smooth.to_points(reflectance)) * self.irradiance
        if emitted is not None:
            radiosity = radiosity + self.mesh.from_computed(self.smooth.to_points(emitted))
        self.radiance = radiosity / math.pi

    def _rest(self, scene, surface, back, options, progress):
        """What varies slowly enough for the computed cells: light of other surfaces, of areas and
        of the sky; None where there is nothing of it."""
        direct = _seen(surface, "DirectIrradiance", back)
        if scene.emits or scene.lights.soft:
            direct = _seen(self._sharp(scene, surface, options, progress), "Irradiance", back)
        if direct is None:
            return None
        return self.smooth.to_points(
            np.maximum(_seen(surface, "Irradiance", back) - direct, 0.0))

    @staticmethod
    def _sharp(scene, receiver, options, progress):
        """The light with sharp shadows alone on a surface."""
        direct = vtkIrradianceFilter()
        direct.SetInputDataObject(0, receiver)
        scene.lights.sharp().connect(direct)
        direct.SetEmission(2)
        direct.SetRelativeTolerance(max(options.tolerance, 0.02))
        direct.SetNumberOfThreads(options.threads)
        with progress.filter(direct), Listener() as listener:
            listener.observe(direct)
            direct.Update()
            listener.check("picture")
        progress.check()
        return direct.GetOutputDataObject(0)

    def _total(self, rest, scene, surface, options, progress):
        direct = self._direct(scene, surface, options, progress)
        return direct if rest is None else direct + self.mesh.from_computed(rest)

    def _direct(self, scene, surface, options, progress):
        if not scene.lights:
            return np.zeros((len(self.mesh.xyz), 1))
        return self.mesh.from_cells(quantities.per_cell(
            self._sharp(scene, self.mesh.receiver(surface), options, progress), "Irradiance"))


def _false_colour(output, scene, view, surface, options, summary):
    quantity, heading, unit = quantities.choose_quantity(options.quantity,
                                                         scene.lights.photometric)
    shown = quantities.total(_seen(surface, "Irradiance", view.mesh.back), quantity,
                             scene.efficacy())
    scale = Scale.choose(shown, view.smooth.area, options.scale, options.range)
    field = view.mesh.polydata(
        {"Quantity": quantities.total(view.irradiance, quantity, scene.efficacy())})
    notes = [f"mean of all fronts {format_number(summary['mean'][quantity])} {unit}",
             f"estimated error {quantities.format_percent(summary['error'])} of it"]
    where = output.path("falsecolor.png", f"{heading.lower()} in {unit} as false colour, with "
                        "legend, iso-lines and lights")
    emitted = mesh.cell_array(surface, "EmittedExitance")
    emitters = None if emitted is None else view_mesh.coarse_polydata(
        surface, view.drawn & (emitted > 0.0).any(axis=1))
    falsecolor.write(where, field, view.smooth.polydata({}), scale, (heading, unit), notes,
                     scene.lights, emitters, scene.camera, options.size)
    return {"falsecolor.png": f"{heading} in {unit}, {'logarithmic' if scale.log else 'linear'} "
            f"from {format_number(scale.low)} to {format_number(scale.high)}",
            "iso-lines": [float(level) for level in scale.levels]}


def _pictures(output, scene, view, surface, options):
    drawn = picture.render(view.mesh, view.radiance, scene.camera, options.size,
                           lambda toward: sky.radiance(scene.lights, toward))
    layers = {}
    for name in RESULTS:
        values = _seen(surface, name, view.mesh.back)
        if values is not None:
            layers[name] = drawn.of_cells(values)
    exposure = options.exposure
    if exposure is None:
        exposure = picture.automatic_exposure(drawn.rgb, drawn.cells >= 0)
    path = output.path("scene.exr", "the picture in scene-linear light (W/(m2 sr)), with depth, "
                       "normals and the computed fields as channels")
    write_exr(path, drawn, layers, scene, exposure, versions()["vtkRadiometry"],
              option_values(options))
    path = output.path("scene.png", "the same picture through OpenColorIO's display transform")
    shown = picture.write_png(path, drawn.rgb, exposure, options.display, options.view)
    path = output.path("luminance.png", "luminance of the same picture in cd/m2 as false colour, "
                       "logarithmic, with legend")
    picture.write_luminance(path, drawn, scene.efficacy())
    return {"exposure in stops": round(exposure, 3), **shown,
            "size": "x".join(map(str, options.size)), "camera": scene.camera.origin,
            "triangles in the picture's mesh": len(view.mesh.origin)}


def _summary(surface, areas, scene):
    irradiance = quantities.per_cell(surface, "Irradiance")
    errors = quantities.per_cell(surface, "IrradianceError")
    mean = {}
    for quantity in ("irradiance", "illuminance"):
        values = quantities.total(irradiance, quantity, scene.efficacy())
        mean[quantity] = float((values * areas).sum() / areas.sum())
    return {"mean": mean, "error": quantities.relative_error(irradiance, errors, areas)}


def _work_plane(output, scene, result, options, progress):
    """The measuring grid's picture and table; None where none was asked for."""
    if result.work_plane is None:
        return None
    with progress.stage("Work plane"):
        plane = workplane.WorkPlane(result.work_plane, scene.UP)
        workplane.write_png(output.path("workplane.png", "illuminance on the work plane, with "
                                        "iso-lux lines"), plane, scene, options)
        workplane.write_csv(output.path("workplane.csv", "the same as a table, a row for each "
                                        "measuring point"), plane)
    return plane


def _study(output, study, scene, options):
    """The table and the plot of an accuracy study."""
    from .study import write_csv, write_png

    write_csv(output.path("study.csv", "what accuracy costs: a row for each run of the study"), study)
    write_png(output.path("study.png", "the same as a plot: error against seconds"), study,
              os.path.basename(scene.path), options.size)


def write_all(output, scene, results, options, progress, study=None):
    """Writes every file; returns what the terminal is told."""
    surface = merge(results)
    areas = mesh.areas(surface)
    summary = _summary(surface, areas, scene)
    with progress.stage("Writing the surface"):
        path = output.path("scene.vtp", "the surface with every computed value and its error "
                           "(ParaView opens it)")
        _write_surface(path, surface, scene, options)
    with progress.stage("Drawing"):
        view = View(scene, surface, options, progress)
        pictures = _pictures(output, scene, view, surface, options)
    with progress.stage("False colour"):
        pictures.update(_false_colour(output, scene, view, surface, options, summary))
    with progress.stage("Convergence"):
        tables = [(result.name, result.convergence) for result in results]
        plots.write_png(output.path("convergence.png", "estimated error against seconds"), tables,
                        options.tolerance, os.path.basename(scene.path), options.size)
        plots.write_csv(output.path("convergence.csv", "the same as a table"), tables)
    if study is not None:
        with progress.stage("Study"):
            _study(output, study, scene, options)
    plane = _work_plane(output, scene, results[-1], options, progress)
    with progress.stage("Statistics"), Listener() as listener:
        statistics = {}
        for name in ("Irradiance", "IrradianceBack", "Radiosity", "RadiosityBack"):
            if quantities.per_cell(surface, name) is not None:
                rows = quantities.statistics_rows(surface, name, scene.efficacy(), listener)
                statistics[name] = [row for row in rows
                                    if row["Maximum"] > 0.0 or not name.endswith("Back")]
        flux = quantities.flux_rows(surface, areas, scene.efficacy())
    sentence = (
        f"Mean illuminance {format_number(summary['mean']['illuminance'])} lx "
        f"({format_number(summary['mean']['irradiance'])} W/m2) over "
        f"{format_number(float(areas.sum()))} m2; estimated error "
        f"{quantities.format_percent(summary['error'])} of the mean.")
    if options.time_budget > 0.0:
        sentence += f" {results[-1].name}: {results[-1].facts().get('Outcome', 'done')}."
    if not (scene.lights.lit or scene.emits):
        sentence += (" Nothing gives light, so all is black: --luminaire, --sky and --sun add lights.")
    if plane is not None:
        sentence += "\n" + plane.sentence()
    said = [sentence]
    if study is not None:
        said.append("\n".join(study.lines()))
    said.append("\n".join(plan_lines(results[-1].name, results[-1].plan_rows())))
    document = {
        "summary": sentence,
        "scene": {
            "file": os.path.basename(scene.path),
            "cells": surface.GetNumberOfCells(),
            "cells in the file": scene.original_cells,
            "longest edge after refining in m": scene.max_edge or "not refined",
            "area in m2": float(areas.sum()),
            "lights": scene.lights.rows(),
        },
        "assumptions": scene.assumptions,
        "computations": [
            {"name": result.name, "seconds": result.seconds, "facts": result.facts(),
             "effect_plan": result.plan_rows(), "convergence": result.convergence_rows(),
             "warnings": result.warnings}
            for result in results
        ],
        "work_plane": plane and {"grid": plane.rule, "statistics": plane.rows(),
                                 "levels": plane.levels},
        "study": study and {"name": study.name, "text": study.lines(), "runs": study.runs,
                            "summary": study.summary, "seconds": study.seconds,
                            "warnings": study.warnings},
        "statistics": statistics,
        "flux": flux,
        "pictures": pictures,
        "seconds": dict(progress.seconds),
        "options": option_values(options),
        "versions": versions(),
    }
    report.write_text(output.path("report.txt", "effect plan, statistics and times, for reading"),
                      document)
    report.write_json(output.path("report.json", "the same for programs"), document)
    return "\n\n".join(words for words in said if words)
