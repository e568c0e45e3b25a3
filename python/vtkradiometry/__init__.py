# SPDX-License-Identifier: BSD-3-Clause
"""Radiometric lighting for VTK: the wrapped classes in one place.

    import vtkradiometry as vr
    light = vr.vtkPointLightSource()

With plain VTK there is no `vtkRadiometryRenderingParaView`; everything else is the same.
"""
from .vtkRadiometryFilters import *
from .vtkRadiometryRendering import *

__version__ = "0.1.0"
