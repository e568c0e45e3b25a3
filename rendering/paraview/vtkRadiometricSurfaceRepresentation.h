// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkRadiometricSurfaceRepresentation_h
#define vtkRadiometricSurfaceRepresentation_h
#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkRadiometryRenderingParaViewModule.h"
class VTKRADIOMETRYRENDERINGPARAVIEW_EXPORT vtkRadiometricSurfaceRepresentation
  : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkRadiometricSurfaceRepresentation* New();
  vtkTypeMacro(vtkRadiometricSurfaceRepresentation, vtkGeometryRepresentationWithFaces);
protected:
  vtkRadiometricSurfaceRepresentation() = default;
};
#endif
