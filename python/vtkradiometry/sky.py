# SPDX-License-Identifier: BSD-3-Clause
"""What a picture shows where it shows no surface: the radiance of the environment lights, by the
formulas and arrays of docs/arrays.md."""
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from .lights import ENVIRONMENT

UNIFORM, MAP, GENERAL, OVERCAST = range(4)


def _frame(light):
    """East, north and up as rows."""
    up = -light.direction / np.linalg.norm(light.direction)
    north = light.reference - light.reference.dot(up) * up
    north /= np.linalg.norm(north)
    return np.stack([np.cross(north, up), north, up])


def _general(light, up, sunward):
    """The CIE general sky relative to its zenith (ISO 15469:2004, eq. 1 to 6)."""
    a, b, c, d, e = light.value("SkyCoefficients", (0.0,) * 5)

    def gradation(sine):
        return 1.0 + a * np.exp(b / np.maximum(sine, 1e-6))

    def indicatrix(cosine):
        chi = np.arccos(np.clip(cosine, -1.0, 1.0))
        return 1.0 + c * (np.exp(d * chi) - np.exp(d * np.pi / 2.0)) + e * np.cos(chi)**2

    zenith = gradation(np.array(1.0)) * indicatrix(light.value("SunDirection", (0, 0, 1)) @ up)
    return indicatrix(sunward), gradation, zenith


def _map(light, local):
    """The picture's pixel in each direction, (n, bands)."""
    index = int(light.value("EnvironmentMap", 0))
    field = light.data.GetFieldData()
    pixels = vtk_to_numpy(field.GetAbstractArray(f"EnvironmentMap{index}"))
    width, height = vtk_to_numpy(field.GetAbstractArray(f"EnvironmentMap{index}Size")).reshape(-1)
    row = np.arccos(np.clip(local[:, 2], -1.0, 1.0)) / np.pi * height
    column = (0.5 + np.arctan2(local[:, 0], local[:, 1]) / (2.0 * np.pi)) * width
    place = (np.minimum(row.astype(int), height - 1) * width
             + np.clip(column.astype(int), 0, width - 1))
    return pixels.reshape(width * height, -1)[place]


def _relative(light, directions):
    """Radiance relative to the light's Intensity, (n, 1 or bands)."""
    model = int(light.value("SkyModel", UNIFORM))
    local = directions @ _frame(light).T
    sine = local[:, 2]
    if model == MAP:
        return _map(light, local)
    if model == UNIFORM:
        return np.ones((len(directions), 1))
    if model == OVERCAST:
        values = (1.0 + 2.0 * sine) / 3.0
    else:
        sun = np.asarray(light.value("SunDirection", (0.0, 0.0, 1.0)), dtype=float)
        around, gradation, zenith = _general(light, _frame(light)[2], directions @ sun)
        values = around * gradation(sine) / zenith
    ground = float(light.value("GroundRadiance", 0.0))
    return np.where(sine < 0.0, ground, values)[:, None]


def radiance(lights, directions):
    """W/(m^2 sr) from each of the (n, 3) unit directions, (n, 1 or bands); None without a sky."""
    total = None
    for light in lights:
        if light.kind == ENVIRONMENT and light.enabled:
            intensity = np.atleast_1d(np.asarray(light.value("Intensity", 0.0), dtype=float))
            part = _relative(light, directions) * intensity
            total = part if total is None else total + part
    return total
