// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIrradianceFilter_h
#define vtkIrradianceFilter_h

#include "vtkRadiometricFilter.h"

/// Direct irradiance on each cell (or point) of a surface.
///   Reads   lights: LightType, Intensity [W/sr or W/m^2], Direction, ...   (docs/arrays.md)
///   Writes  Irradiance, IrradianceError; where surfaces are two-sided also IrradianceBack,
///           IrradianceBackError   cell or point, N bands   [W/m^2]
///   Model   E = sum_k V_k I_k(w) cos(theta_k) / r_k^2, averaged over the cell
///   Cost    O(cells x lights) closed forms and rays, times log(occluders)
///   Source  Van Oosterom and Strackee 1983 (solid angle); Arvo 1995 (axial moments)
///   Fails   non-finite points, lights or materials: an error with array, index and value;
///           nothing is written
class VTKRADIOMETRYFILTERS_EXPORT vtkIrradianceFilter : public vtkRadiometricFilter
{
public:
  static vtkIrradianceFilter* New();
  vtkTypeMacro(vtkIrradianceFilter, vtkRadiometricFilter);

protected:
  vtkIrradianceFilter() = default;
  ~vtkIrradianceFilter() override = default;

  void Simulate(Job& job, Result& result) override;

private:
  vtkIrradianceFilter(const vtkIrradianceFilter&) = delete;
  void operator=(const vtkIrradianceFilter&) = delete;
};

#endif
