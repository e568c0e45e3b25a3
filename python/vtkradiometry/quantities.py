# SPDX-License-Identifier: BSD-3-Clause
"""From computed arrays to what people read: illuminance, radiance, flux, statistics."""
import math

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from . import mesh
from .picture import LUMINANCE
from .plots import rows_of
from .vtkRadiometryFilters import vtkRadiometricStatistics

UNITS = {"Irradiance": "W/m^2", "Radiosity": "W/m^2", "Radiance": "W/(m^2 sr)",
         "Illuminance": "lx", "LuminousExitance": "lm/m^2", "Luminance": "cd/m^2"}


def per_cell(surface, name):
    """The result `name` per cell as (cells, bands); point results are averaged over each cell."""
    values = mesh.cell_array(surface, name)
    if values is not None:
        return values
    array = surface.GetPointData().GetArray(name)
    if array is None:
        return None
    at_points = vtk_to_numpy(array).astype(np.float64).reshape(surface.GetNumberOfPoints(), -1)
    return at_points[mesh.triangles(surface)].mean(axis=1)


def total(values, quantity, efficacy):
    """All bands as one number: W/m^2 summed over the bands, or lx.

    Three bands are linear Rec.709 whose white is the band's common value, so that (E, E, E) stands
    for E watts: the irradiance is their luminance-weighted mean, the illuminance efficacy times it.
    """
    if values.shape[1] == 3:
        mean = values @ LUMINANCE
    else:
        mean = values.mean(axis=1)
    return mean * efficacy if quantity == "illuminance" else mean


def choose_quantity(wanted, photometric):
    """What falsecolor.png shows: (quantity, heading, unit)."""
    if wanted == "auto":
        wanted = "illuminance" if photometric else "irradiance"
    return (wanted, "Illuminance", "lx") if wanted == "illuminance" else (
        wanted, "Irradiance", "W/m\u00b2")


def relative_error(values, errors, areas):
    """Area-weighted mean error over area-weighted mean value, all bands together."""
    if errors is None:
        return None
    mean = float((values.mean(axis=1) * areas).sum())
    return float((errors.mean(axis=1) * areas).sum()) / mean if mean > 0.0 else 0.0


def flux_rows(surface, areas, efficacy):
    """Flux that falls on the surfaces and that leaves them, per band."""
    rows = []
    for name, words in (("Irradiance", "in (falls on the fronts)"),
                        ("IrradianceBack", "in (falls on the backs)"),
                        ("Radiosity", "out (leaves the fronts)"),
                        ("RadiosityBack", "out (leaves the backs)")):
        values = per_cell(surface, name)
        if values is None:
            continue
        watts = (values * areas[:, None]).sum(axis=0)
        row = {"Flux": words, "Array": name, "W per band": watts.tolist()}
        row["lm"] = float(total(watts[None, :], "illuminance", efficacy)[0])
        rows.append(row)
    return rows


PHOTOMETRIC = {"Irradiance": ("lx", "lm"), "IrradianceBack": ("lx", "lm"),
               "Radiosity": ("lm/m^2", "lm"), "RadiosityBack": ("lm/m^2", "lm")}
LARGEST_GROUPS = 40


def statistics_rows(surface, name, efficacy, listener):
    """vtkRadiometricStatistics of one array as dictionaries: the whole surface in photometric and
    radiometric units, then each object of the file in photometric units."""
    rows = []
    groups = surface.GetCellData().GetArray("ObjectIndex")
    for group in (None, "ObjectIndex" if groups else None):
        if group is None and rows:
            continue
        statistics = vtkRadiometricStatistics()
        statistics.GenerateIsolinesOff()
        listener.observe(statistics)
        statistics.SetInputDataObject(surface)
        statistics.SetArrayName(name)
        statistics.SetGroupArray(group)
        statistics.Update()
        names, found = rows_of(statistics.GetOutputDataObject(0))
        found = [dict(zip(names, row)) for row in found]
        whole = [row for row in found if row["Group"] == -1]
        single = max(row["Component"] for row in whole) == 0
        if group is None:
            rows += [_row("all", row, name, efficacy) for row in whole
                     if row["Component"] == -1 or single]
            rows += [_row("all", row, name, None, "" if single else "RGB"[row["Component"]])
                     for row in whole if row["Component"] >= 0 and (single or len(whole) == 4)]
        else:
            parts = [row for row in found if row["Group"] >= 0
                     and (row["Component"] == -1 or single)]
            if 1 < len(parts) <= LARGEST_GROUPS:
                rows += [_row(row.get("GroupName") or str(row["Group"]), row, name, efficacy)
                         for row in parts]
    return rows


def _row(part, row, name, efficacy, band=""):
    """One line of the report: with an efficacy in photometric units, else as computed."""
    unit, flux_unit = PHOTOMETRIC[name] if efficacy else ("W/m^2", "W")
    factor = efficacy or 1.0
    return {"Part": part, "Unit": unit + (f" {band}" if band else ""),
            "Minimum": row["Minimum"] * factor, "Mean": row["Mean"] * factor,
            "Maximum": row["Maximum"] * factor, "U0": row["U0"], "Ud": row["Ud"],
            "Flux": row["Flux"] * factor, "Flux unit": flux_unit, "Area in m^2": row["Area"],
            "Cells": row["Cells"]}


def format_percent(fraction):
    """0.00812 -> '0.81 %', tiny values as '< 0.001 %'."""
    if fraction is None or not math.isfinite(fraction):
        return "unknown"
    if 0.0 < fraction < 1e-5:
        return "less than 0.001 %"
    return f"{100.0 * fraction:.2g} %"
