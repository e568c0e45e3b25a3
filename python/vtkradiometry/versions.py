# SPDX-License-Identifier: BSD-3-Clause
"""The versions of everything that had a part in a result."""
import platform

from vtkmodules.vtkCommonCore import vtkVersion

from ._build import LIBRARIES, VERSION


def versions():
    """{name: version}, for the report and for --version."""
    found = {
        "vtkRadiometry": VERSION,
        "VTK": vtkVersion.GetVTKVersion(),
        "Python": platform.python_version(),
    }
    try:
        import numpy

        found["numpy"] = numpy.__version__
    except ImportError:
        pass
    found.update((name, version) for name, version in LIBRARIES.items() if version)
    found["System"] = f"{platform.system()} {platform.machine()}"
    return found
