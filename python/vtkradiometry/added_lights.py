# SPDX-License-Identifier: BSD-3-Clause
"""The lights of the command line: luminaires from files."""
import os

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .faults import InputFault, Listener
from .vtkRadiometryFilters import vtkPhotometricFileReader

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


def add(lights, options, up, north):
    """Adds the command line's lights to those of the scene; returns what was assumed, in words."""
    return _luminaires(lights, options, up)
