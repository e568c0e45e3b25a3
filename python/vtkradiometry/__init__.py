# SPDX-License-Identifier: BSD-3-Clause
"""Radiometric lighting for VTK: the wrapped classes in one place.

    import vtkradiometry as vr
    light = vr.vtkPointLightSource()

With plain VTK there is no `vtkRadiometryRenderingParaView`; everything else is the same.
"""
from ._build import VERSION as __version__
from .vtkRadiometryFilters import *
from .vtkRadiometryRendering import *
