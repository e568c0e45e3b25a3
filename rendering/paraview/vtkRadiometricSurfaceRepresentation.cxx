#include "vtkRadiometricSurfaceRepresentation.h"
#include "vtkObjectFactory.h"
vtkStandardNewMacro(vtkRadiometricSurfaceRepresentation);
