# SPDX-License-Identifier: BSD-3-Clause
"""The versions of everything that had a part in a result."""
import platform

from vtkmodules.vtkCommonCore import vtkVersion


def versions():
    """{name: version}, for the report and for --version."""
    from . import __version__

    found = {
        "vtkRadiometry": __version__,
        "VTK": vtkVersion.GetVTKVersion(),
        "Python": platform.python_version(),
    }
    try:
        import numpy

        found["numpy"] = numpy.__version__
    except ImportError:
        pass
    found["System"] = f"{platform.system()} {platform.machine()}"
    return found
