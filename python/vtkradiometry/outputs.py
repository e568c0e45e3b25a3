# SPDX-License-Identifier: BSD-3-Clause
"""Writes all the files of a run into an OutputFolder."""
import math
import os

import numpy as np
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from . import falsecolor, mesh, picture, plots, quantities, report
from .compute import field_facts
from .faults import Listener
from .image_file import write_exr
from .scales import Scale, format_number
from .versions import versions

RESULTS = ("Irradiance", "IrradianceError", "Radiosity", "RadiosityError", "IrradianceBack",
           "IrradianceBackError", "RadiosityBack", "RadiosityBackError", "DirectIrradiance",
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
            for name in ("Irradiance", "IrradianceError"):
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
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    if not writer.Write():
        raise OSError(f"{path} could not be written")


def option_values(options):
    """The options of the command line that bear on the result."""
    values = dict(vars(options))
    for name in ("output", "quiet", "version", "scene"):
        values.pop(name, None)
    return {key: value for key, value in sorted(values.items()) if value is not None}


def _false_colour(output, scene, smooth, surface, options, summary):
    photometric = bool(np.any(field_facts(scene.lights).get("Photometric", 1)))
    quantity, heading, unit = quantities.choose_quantity(options.quantity, photometric)
    values = quantities.total(quantities.per_cell(surface, "Irradiance"), quantity,
                              scene.efficacy())
    scale = Scale.choose(values, smooth.area, options.scale, options.range)
    field = smooth.polydata({"Quantity": smooth.to_points(values[:, None])[:, 0]})
    error = summary["error"]
    notes = [f"mean {format_number(summary['mean'][quantity])} {unit}",
             f"estimated error {quantities.format_percent(error)} of the mean"]
    where = output.path("falsecolor.png", f"{heading.lower()} in {unit} as false colour, with "
                        "legend, iso-lines and lights")
    falsecolor.write(where, field, scale, (heading, unit), notes, scene.lights, scene.camera,
                     options.size, culling=not scene.two_sided)
    return {"quantity": quantity, "unit": unit, "low": scale.low, "high": scale.high,
            "scale": "log" if scale.log else "linear", "iso-lines": scale.levels}


def _radiance(surface):
    """Radiance of what leaves the fronts diffusely; what arrives, where nothing else is known."""
    radiosity = quantities.per_cell(surface, "Radiosity")
    if radiosity is None:
        radiosity = quantities.per_cell(surface, "Irradiance")
        reflectance = mesh.cell_array(surface, "DiffuseReflectance")
        radiosity = radiosity * (0.5 if reflectance is None else reflectance)
        emitted = mesh.cell_array(surface, "EmittedExitance")
        if emitted is not None:
            radiosity = radiosity + emitted
    return radiosity / math.pi


def _pictures(output, scene, smooth, surface, options):
    drawn = picture.render(smooth, _radiance(surface), scene.camera, options.size,
                           culling=not scene.two_sided)
    layers = {}
    for name in RESULTS:
        values = quantities.per_cell(surface, name)
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
    return {"exposure in stops": round(exposure, 3), **shown,
            "size": "x".join(map(str, options.size)), "camera": scene.camera.origin}


def _summary(surface, areas, scene):
    irradiance = quantities.per_cell(surface, "Irradiance")
    errors = quantities.per_cell(surface, "IrradianceError")
    mean = {}
    for quantity in ("irradiance", "illuminance"):
        values = quantities.total(irradiance, quantity, scene.efficacy())
        mean[quantity] = float((values * areas).sum() / areas.sum())
    return {"mean": mean, "error": quantities.relative_error(irradiance, errors, areas)}


def write_all(output, scene, results, options, progress):
    """Writes every file; returns one sentence for the terminal."""
    surface = merge(results)
    areas = mesh.areas(surface)
    summary = _summary(surface, areas, scene)
    with progress.stage("Writing the surface"):
        path = output.path("scene.vtp", "the surface with every computed value and its error "
                           "(ParaView opens it)")
        _write_surface(path, surface, scene, options)
    with progress.stage("Drawing"):
        smooth = mesh.SmoothSurface(surface)
        pictures = _pictures(output, scene, smooth, surface, options)
    with progress.stage("False colour"):
        pictures["falsecolor.png"] = _false_colour(output, scene, smooth, surface, options, summary)
    with progress.stage("Convergence"):
        tables = [(result.name, result.convergence) for result in results]
        plots.write_png(output.path("convergence.png", "estimated error against seconds"), tables,
                        options.tolerance, os.path.basename(scene.path), options.size)
        plots.write_csv(output.path("convergence.csv", "the same as a table"), tables)
    with progress.stage("Statistics"), Listener() as listener:
        statistics = {}
        for name in ("Irradiance", "Radiosity"):
            if quantities.per_cell(surface, name) is not None:
                statistics[name] = quantities.statistics_rows(surface, name, listener)
        flux = quantities.flux_rows(surface, areas, scene.efficacy())
    sentence = (
        f"Mean illuminance {format_number(summary['mean']['illuminance'])} lx "
        f"({format_number(summary['mean']['irradiance'])} W/m2) over "
        f"{format_number(float(areas.sum()))} m2; estimated error "
        f"{quantities.format_percent(summary['error'])} of the mean.")
    document = {
        "summary": sentence,
        "scene": {
            "file": os.path.basename(scene.path),
            "cells": surface.GetNumberOfCells(),
            "cells in the file": scene.original_cells,
            "longest edge after refining in m": scene.max_edge or "not refined",
            "area in m2": float(areas.sum()),
            "lights": scene.light_rows(),
        },
        "assumptions": scene.assumptions,
        "computations": [
            {"name": result.name, "seconds": result.seconds, "facts": result.facts(),
             "effect_plan": result.plan_rows(), "convergence": result.convergence_rows(),
             "warnings": result.warnings}
            for result in results
        ],
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
    return sentence
