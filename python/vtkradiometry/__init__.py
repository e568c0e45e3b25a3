"""Radiometric lighting for VTK: the wrapped classes in one place."""
from .vtkRadiometryFilters import *
from .vtkRadiometryRendering import *
