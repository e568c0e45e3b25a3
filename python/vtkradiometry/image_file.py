# SPDX-License-Identifier: BSD-3-Clause
"""scene.exr: the scene-linear picture with depth, normals and the computed fields as channels."""
import os

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData

from .faults import Listener
from .vtkRadiometryFilters import vtkOpenEXRWriter

REC709 = (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290)
NOTHING_SEEN = 1.0e10  # Z where the picture shows nothing


def _add(image, name, values, unit):
    array = numpy_to_vtk(np.ascontiguousarray(values.reshape(-1, values.shape[-1]), np.float32),
                         deep=True)
    array.SetName(name)
    if unit:
        array.GetInformation().Set(array.UNITS_LABEL(), unit)
    image.GetPointData().AddArray(array)


def write_exr(path, drawn, layers, scene, exposure, version, options):
    """Writes the picture `drawn` (picture.Picture) and `layers` {array name: (h, w, bands)}.

    The attributes say units, colour space, light conversion, version and options.
    """
    height, width = drawn.cells.shape
    image = vtkImageData()
    image.SetDimensions(width, height, 1)
    alpha = (drawn.cells >= 0).astype(np.float32)
    _add(image, "RGBA", np.dstack([drawn.rgb, alpha]), "W/(m^2 sr)")
    depth = np.where(np.isfinite(drawn.depth), drawn.depth, NOTHING_SEEN)
    _add(image, "Z", depth[:, :, None], "m")
    _add(image, "N", drawn.normal, "1")
    for name, values in layers.items():
        _add(image, name, values, "W/m^2")
    writer = vtkOpenEXRWriter()
    writer.SetFileName(path)
    writer.SetInputData(image)
    writer.SetChromaticities(REC709)
    writer.SetWhiteLuminance(scene.efficacy())
    for name, value in {
        "software": f"vtkRadiometry {version}",
        "scene": os.path.basename(scene.path),
        "units": "RGB radiance in W/(m^2 sr) per band of linear Rec.709; Z in m along the view "
                 "axis; fields in W/m^2, one value a cell",
        "options": " ".join(f"{key}={value}" for key, value in options.items()),
        "normals": "world space, of the side that is seen",
    }.items():
        writer.AddAttribute(name, value)
    writer.AddAttribute("luminousEfficacy", scene.efficacy())
    writer.AddAttribute("displayExposure", float(exposure))
    with Listener() as listener:
        listener.observe(writer)
        written = writer.Write()
    if listener.errors or not written:
        raise OSError(listener.errors[0] if listener.errors else f"{path} could not be written")
