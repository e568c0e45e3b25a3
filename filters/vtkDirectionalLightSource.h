// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkDirectionalLightSource_h
#define vtkDirectionalLightSource_h

#include "vtkRadiometricLightSource.h"

/// A directional light: parallel rays from infinitely far, such as the sun's.
///   Writes  as vtkRadiometricLightSource; LightType 2
///   Model   E = E_n cos(theta), E_n the irradiance normal to the beam
///   Fails   as vtkRadiometricLightSource
class VTKRADIOMETRYFILTERS_EXPORT vtkDirectionalLightSource : public vtkRadiometricLightSource
{
public:
  static vtkDirectionalLightSource* New();
  vtkTypeMacro(vtkDirectionalLightSource, vtkRadiometricLightSource);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Values of IntensityUnit, normal to the beam.
  enum Units
  {
    WattPerSquareMeter = 0,
    Lux = 1
  };
  void SetIntensityUnitToWattPerSquareMeter() { this->SetIntensityUnit(WattPerSquareMeter); }
  void SetIntensityUnitToLux() { this->SetIntensityUnit(Lux); }

  ///@{
  /// Where the light travels to. Default (0, 0, -1). Any length but zero.
  vtkSetVector3Macro(Direction, double);
  vtkGetVector3Macro(Direction, double);
  ///@}

protected:
  vtkDirectionalLightSource() = default;
  ~vtkDirectionalLightSource() override = default;
  double Describe(radiometry::LightRecord& light, bool& photometric) override;

  double Direction[3] = { 0.0, 0.0, -1.0 };

private:
  vtkDirectionalLightSource(const vtkDirectionalLightSource&) = delete;
  void operator=(const vtkDirectionalLightSource&) = delete;
};

#endif
