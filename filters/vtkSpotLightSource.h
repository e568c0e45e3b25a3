// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkSpotLightSource_h
#define vtkSpotLightSource_h

#include "vtkRadiometricLightSource.h"

/// A spot light: a cone about an axis.
///   Writes  as vtkRadiometricLightSource; LightType 1
///   Model   I(phi) = I0 cos^e(phi) f(phi) for phi < Cutoff, 0 outside; f = 1 (hard edge), or with
///           InnerCutoff >= 0 glTF's smooth edge
///           f = min(1, ((cos phi - cos Cutoff)/(cos InnerCutoff - cos Cutoff))^2).
///           A flux becomes I0 by the closed integral of this distribution: hard edge
///           2 pi (1 - cos^{e+1} Cutoff)/(e + 1). Cutoff 90, Exponent 1 is a Lambertian emitter:
///           100 lm give 100/pi = 31.831 lx at 1 m on the axis
///   Source  KHR_lights_punctual (smooth edge); OpenGL 2.1 specification, section 2.14.1 (exponent)
///   Fails   as vtkRadiometricLightSource
class VTKRADIOMETRYFILTERS_EXPORT vtkSpotLightSource : public vtkRadiometricLightSource
{
public:
  static vtkSpotLightSource* New();
  vtkTypeMacro(vtkSpotLightSource, vtkRadiometricLightSource);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Values of IntensityUnit. W/sr and cd are on the axis, W and lm over the whole cone.
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
  /// Where the light travels to. Default (0, 0, -1). Any length but zero.
  vtkSetVector3Macro(Direction, double);
  vtkGetVector3Macro(Direction, double);
  ///@}

  ///@{
  /// With UseTarget on (default off) the light points from Position to Target [m] instead of
  /// along Direction. Default (0, 0, -1).
  vtkSetVector3Macro(Target, double);
  vtkGetVector3Macro(Target, double);
  vtkSetMacro(UseTarget, bool);
  vtkGetMacro(UseTarget, bool);
  vtkBooleanMacro(UseTarget, bool);
  ///@}

  ///@{
  /// Half-angle of the cone [degrees]: (0, 90], or 180 for no cone. Default 45.
  vtkSetMacro(Cutoff, double);
  vtkGetMacro(Cutoff, double);
  ///@}

  ///@{
  /// Half-angle inside which the edge of the cone has no effect [degrees]: [0, Cutoff), or below 0
  /// for a hard edge. Default -1.
  vtkSetMacro(InnerCutoff, double);
  vtkGetMacro(InnerCutoff, double);
  ///@}

  ///@{
  /// e in I0 cos^e(phi). Default 0. Finite, >= 0; 0 where Cutoff is 180.
  vtkSetMacro(Exponent, double);
  vtkGetMacro(Exponent, double);
  ///@}

  ///@{
  /// a, b, c of the fall-off 1/(a + b r + c r^2), r in metres. Default (0, 0, 1): physics.
  /// Anything else is the legacy model. None below 0, not all 0.
  vtkSetVector3Macro(Attenuation, double);
  vtkGetVector3Macro(Attenuation, double);
  ///@}

protected:
  vtkSpotLightSource() = default;
  ~vtkSpotLightSource() override = default;
  double Describe(radiometry::LightRecord& light, bool& photometric) override;

  double Direction[3] = { 0.0, 0.0, -1.0 };
  double Target[3] = { 0.0, 0.0, -1.0 };
  bool UseTarget = false;
  double Cutoff = 45.0;
  double InnerCutoff = -1.0;
  double Exponent = 0.0;
  double Attenuation[3] = { 0.0, 0.0, 1.0 };

private:
  vtkSpotLightSource(const vtkSpotLightSource&) = delete;
  void operator=(const vtkSpotLightSource&) = delete;
};

#endif
