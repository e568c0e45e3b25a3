# SPDX-License-Identifier: BSD-3-Clause
"""The lights of the command line: luminaires from files, the sky and the sun."""
import math
import os

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .faults import InputFault, Listener
from .vtkRadiometryFilters import (vtkDirectionalLightSource, vtkEnvironmentLightSource,
                                   vtkPhotometricFileReader)

SKIES = {"uniform": vtkEnvironmentLightSource.Uniform,
         "overcast": vtkEnvironmentLightSource.Overcast,
         "clear": vtkEnvironmentLightSource.Clear,
         "intermediate": vtkEnvironmentLightSource.Intermediate}
SUNNY = ("clear", "intermediate")
SUN_ILLUMINANCE = {"uniform": 0.0, "overcast": 0.0, "intermediate": 20000.0}  # lx; else 80 000

def _made(source, where):
    """The output of a source; its errors as an InputFault, its warnings returned."""
    with Listener() as listener:
        listener.observe(source)
        listener.observe(source.GetExecutive())
        source.Update()
        listener.check(where)
        warnings = list(dict.fromkeys(listener.warnings))
    data = vtkPolyData()
    data.ShallowCopy(source.GetOutput())
    return data, warnings


def _luminaires(lights, options, up):
    words = []
    for luminaire in options.luminaires or []:
        path, name = luminaire["file"], os.path.basename(luminaire["file"])
        if not os.path.isfile(path):
            raise InputFault(f"{path}: no such file")
        if not luminaire["at"]:
            raise InputFault(f"--luminaire {path}: --at X,Y,Z must say where it hangs")
        for place, toward in zip(luminaire["at"], luminaire["toward"]):
            reader = vtkPhotometricFileReader()
            reader.SetFileName(path)
            reader.SetPosition(place)
            direction = -np.asarray(up) if toward is None else np.subtract(toward, place)
            if not np.linalg.norm(direction) > 0.0:
                raise InputFault(f"--toward {','.join(map(str, toward))}: is where --at is")
            reader.SetDirection(direction)
            data, warnings = _made(reader, path)
            lights.add(data)
        words += [f"Luminaire {name}: {text}" for text in dict.fromkeys(
            [*warnings, *(reader.GetAssumption(k)
                          for k in range(reader.GetNumberOfAssumptions()))])]
        words.append(f"Luminaire {name}: {reader.GetFluxFromWeb():.5g} {reader.GetFluxUnit()} by its "
                     "intensities.")
    return words


def _toward_sun(sun, up, north):
    """The direction toward a sun of this altitude and azimuth (from north over east)."""
    altitude, azimuth = (math.radians(angle) for angle in sun)
    up, north = np.asarray(up), np.asarray(north)
    level = math.cos(azimuth) * north + math.sin(azimuth) * np.cross(north, up)
    return math.sin(altitude) * up + math.cos(altitude) * level


def _daylight(lights, options, up, north):
    if options.sky in SUNNY and options.sun is None:
        raise InputFault(f"--sky {options.sky}: --sun ALTITUDE,AZIMUTH must say where the sun is")
    if options.sky and options.sky_map:
        raise InputFault("--sky-map: there is a --sky already")
    words = []
    if options.sky or options.sky_map:
        sky = vtkEnvironmentLightSource()
        sky.SetUpDirection(up)
        sky.SetNorthDirection(north)
        sky.SetLightName("sky")
        if options.sky_map:
            sky.SetPreset(vtkEnvironmentLightSource.Map)
            sky.SetFileName(options.sky_map)
            sky.SetIntensityUnit(vtkEnvironmentLightSource.WattPerSquareMeterSteradian)
            sky.SetIntensity(1.0)
            words.append(f"Sky: {os.path.basename(options.sky_map)}, north in its middle.")
        else:
            sky.SetPreset(SKIES[options.sky])
            sky.SetIntensityUnit(vtkEnvironmentLightSource.HorizontalLux)
            sky.SetIntensity(options.sky_illuminance)
            words.append(f"Sky: {options.sky}, {options.sky_illuminance:g} lx on open level ground.")
            if options.sky != "uniform":
                sky.SetGroundReflectance(options.ground_reflectance)
                words[-1] += f" The ground outside reflects {options.ground_reflectance:g} of it."
        if options.sun:
            sky.SetSunPosition(vtkEnvironmentLightSource.ByAngles)
            sky.SetSunAltitude(options.sun[0])
            sky.SetSunAzimuth(options.sun[1])
        lux = _sun_illuminance(options)
        if lux > 0.0:
            sky.SunOn()
            sky.SetSunUnit(vtkEnvironmentLightSource.NormalLux)
            sky.SetSunIntensity(lux)
        data, _ = _made(sky, "--sky")
        lights.add(data)
    elif options.sun:
        sun = vtkDirectionalLightSource()
        sun.SetDirection(-_toward_sun(options.sun, up, north))
        sun.SetIntensityUnit(1)  # lx
        sun.SetIntensity(_sun_illuminance(options))
        sun.SetLightName("sun")
        lights.add(_made(sun, "--sun")[0])
    if options.sun:
        words.append(f"Sun: {options.sun[0]:g} degrees high, {options.sun[1]:g} degrees from north "
                     f"over east, {_sun_illuminance(options):g} lx facing it.")
    return words


def _sun_illuminance(options):
    """lx on a surface that faces the sun."""
    if options.sun is None:
        return 0.0
    if options.sun_illuminance is not None:
        return options.sun_illuminance
    return SUN_ILLUMINANCE.get(options.sky, 80000.0)


def add(lights, options, up, north):
    """Adds the command line's lights to those of the scene; returns what was assumed, in words."""
    return _luminaires(lights, options, up) + _daylight(lights, options, up, north)
