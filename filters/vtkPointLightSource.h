// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkPointLightSource_h
#define vtkPointLightSource_h

#include "vtkRadiometricLightSource.h"

/// A point light: the same intensity in all directions.
///   Writes  as vtkRadiometricLightSource; LightType 0
///   Model   E = I cos(theta)/r^2; flux = 4 pi I: 100 lm give 100/(4 pi) = 7.9577 lx at 1 m
///   Fails   as vtkRadiometricLightSource
class VTKRADIOMETRYFILTERS_EXPORT vtkPointLightSource : public vtkRadiometricLightSource
{
public:
  static vtkPointLightSource* New();
  vtkTypeMacro(vtkPointLightSource, vtkRadiometricLightSource);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Values of IntensityUnit.
  enum Units
  {
    WattPerSteradian = 0,
    Watt = 1,
    Candela = 2,
    Lumen = 3
  };
  void SetIntensityUnitToWattPerSteradian() { this->SetIntensityUnit(WattPerSteradian); }
  void SetIntensityUnitToWatt() { this->SetIntensityUnit(Watt); }
  void SetIntensityUnitToCandela() { this->SetIntensityUnit(Candela); }
  void SetIntensityUnitToLumen() { this->SetIntensityUnit(Lumen); }

  ///@{
  /// a, b, c of the fall-off 1/(a + b r + c r^2), r in metres. Default (0, 0, 1): physics.
  /// Anything else is the legacy model. None below 0, not all 0.
  vtkSetVector3Macro(Attenuation, double);
  vtkGetVector3Macro(Attenuation, double);
  ///@}

protected:
  vtkPointLightSource() = default;
  ~vtkPointLightSource() override = default;
  double Describe(radiometry::LightRecord& light, bool& photometric) override;

  double Attenuation[3] = { 0.0, 0.0, 1.0 };

private:
  vtkPointLightSource(const vtkPointLightSource&) = delete;
  void operator=(const vtkPointLightSource&) = delete;
};

#endif
