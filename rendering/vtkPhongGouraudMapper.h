// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkPhongGouraudMapper_h
#define vtkPhongGouraudMapper_h
#include "vtkCompositePolyDataMapper2.h"
#include "vtkRadiometryRenderingModule.h"
class VTKRADIOMETRYRENDERING_EXPORT vtkPhongGouraudMapper : public vtkCompositePolyDataMapper2
{
public:
  static vtkPhongGouraudMapper* New();
  vtkTypeMacro(vtkPhongGouraudMapper, vtkCompositePolyDataMapper2);
protected:
  vtkPhongGouraudMapper() = default;
};
#endif
