// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkRadiosityFilter_h
#define vtkRadiosityFilter_h

#include "vtkRadiometricFilter.h"

/// Direct light, emission and interreflection on a surface: irradiance and radiosity.
///   Reads   material arrays DiffuseReflectance, EmittedExitance, TwoSided; the light arrays
///           (docs/arrays.md)
///   Writes  Irradiance, Radiosity [W/m^2] and Radiance = Radiosity/pi [W/(m^2 sr)], each with its
///           Error; the same with Back where surfaces are two-sided   cell or point, N bands.
///           Field data RadiometryMethod: the operator used and why.
///           EffectPlan has five further rows with the parts of the error.
///   Model   B = M + rho E, E = E_lights + int F dB (diffuse)
///   Cost    Dense O(n^2) pairs, MonteCarlo O(n) rays; n elements
///   Fails   as vtkIrradianceFilter; a lossless closed cavity with light (no solution); a memory
///           limit too small for any method; Method Hierarchical (not in this version)
class VTKRADIOMETRYFILTERS_EXPORT vtkRadiosityFilter : public vtkRadiometricFilter
{
public:
  static vtkRadiosityFilter* New();
  vtkTypeMacro(vtkRadiosityFilter, vtkRadiometricFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The values of Method.
  enum Methods
  {
    METHOD_AUTO = 0,
    DENSE = 1,
    HIERARCHICAL = 2,
    MONTE_CARLO = 3
  };

  ///@{
  /// How light is exchanged between elements: 0 Auto (default), 1 Dense (all pairs, for some
  /// thousands of elements), 2 Hierarchical (not in this version), 3 MonteCarlo (rays, for any
  /// number).
  vtkSetClampMacro(Method, int, METHOD_AUTO, MONTE_CARLO);
  vtkGetMacro(Method, int);
  ///@}

protected:
  vtkRadiosityFilter() = default;
  ~vtkRadiosityFilter() override = default;

  void Simulate(Job& job, Result& result) override;

  int Method = METHOD_AUTO;

private:
  vtkRadiosityFilter(const vtkRadiosityFilter&) = delete;
  void operator=(const vtkRadiosityFilter&) = delete;
};

#endif
