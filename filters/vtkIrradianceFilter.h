// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIrradianceFilter_h
#define vtkIrradianceFilter_h
#include "vtkPolyDataAlgorithm.h"
#include "vtkRadiometryFiltersModule.h"
class VTKRADIOMETRYFILTERS_EXPORT vtkIrradianceFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkIrradianceFilter* New();
  vtkTypeMacro(vtkIrradianceFilter, vtkPolyDataAlgorithm);
protected:
  vtkIrradianceFilter() = default;
};
#endif
