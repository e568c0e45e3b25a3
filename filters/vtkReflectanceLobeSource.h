// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkReflectanceLobeSource_h
#define vtkReflectanceLobeSource_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkRadiometryFiltersModule.h"

/// A BRDF as geometry, for light from one direction: the surface whose distance from Center in each
/// direction is f_r (or f_r cos(theta)) of light that leaves there.
///   Writes  polydata: the lobe (polygons), where wanted the ray of the light and the normal (lines).
///           Point data BRDF [1/sr], BRDFCosine (BRDF cos(theta) [1/sr]), OutgoingDirection (unit), 0 on
///           lines. Cell data Part (0 lobe, 1 incident ray, 2 normal). Field data
///           DirectionalHemisphericalReflectance, by its closed form where there is one, else by
///           integration; DirectionalHemisphericalReflectanceIntegrated, the same by integration, and
///           its Error; Albedo (of light from everywhere alike) and AlbedoError; MaximumBRDF [1/sr];
///           IncidentAngle [degrees]
///   Model   Lambert rho_d/pi; PhysicalPhong + rho_s (n + 2)/(2 pi) cos^n(R, V); LegacyPhong
///           (rho_d + rho_s cos^n(R, V)/cos(theta_in))/pi and LegacyBlinn with cos^n(N, H), which
///           keep neither energy nor reciprocity: their reflectance may exceed 1
///   Cost    2 Resolution^2 evaluations, and some 1e5 for the integrals
///   Source  radiometry/shading/Reflectance.h; docs/physics/shading.md
///   Fails   reflectances out of range or, of the physical models, above 1 together; a perfect mirror
///           (Shininess 1e6), which has no finite BRDF; light from below
class VTKRADIOMETRYFILTERS_EXPORT vtkReflectanceLobeSource : public vtkPolyDataAlgorithm
{
public:
  static vtkReflectanceLobeSource* New();
  vtkTypeMacro(vtkReflectanceLobeSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The values of ReflectionModel.
  enum Models
  {
    LAMBERT = 0,
    PHYSICAL_PHONG = 1,
    LEGACY_PHONG = 2,
    LEGACY_BLINN = 3
  };

  ///@{
  /// 0 Lambert (no lobe), 1 PhysicalPhong (default; what is simulated), 2 LegacyPhong, 3 LegacyBlinn.
  vtkSetClampMacro(ReflectionModel, int, LAMBERT, LEGACY_BLINN);
  vtkGetMacro(ReflectionModel, int);
  ///@}
  ///@{
  /// rho_d, or k_d of the legacy models. Default 0.3. At least 0.
  vtkSetMacro(DiffuseReflectance, double);
  vtkGetMacro(DiffuseReflectance, double);
  ///@}
  ///@{
  /// rho_s, or k_s of the legacy models. Default 0.3. At least 0; of PhysicalPhong rho_d + rho_s <= 1.
  vtkSetMacro(SpecularReflectance, double);
  vtkGetMacro(SpecularReflectance, double);
  ///@}
  ///@{
  /// The exponent n. Default 20. Range [0, 1e6).
  vtkSetMacro(Shininess, double);
  vtkGetMacro(Shininess, double);
  ///@}
  ///@{
  /// Angle between the normal and the way the light comes [degrees]. Default 45. Range [0, 90).
  vtkSetMacro(IncidentAngle, double);
  vtkGetMacro(IncidentAngle, double);
  ///@}
  ///@{
  /// Where the light travels to, in place of the angle: any length; (0, 0, 0), the default: the angle
  /// counts, and the light comes from the side of x (or, where the normal is x, of y).
  vtkSetVector3Macro(IncidentDirection, double);
  vtkGetVector3Macro(IncidentDirection, double);
  ///@}
  ///@{
  /// Normal of the surface. Default (0, 0, 1). Any length but 0.
  vtkSetVector3Macro(Normal, double);
  vtkGetVector3Macro(Normal, double);
  ///@}
  ///@{
  /// The point of the surface. Default (0, 0, 0).
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}
  ///@{
  /// Whether the distance is by f_r cos(theta), the radiant intensity of a small piece, instead of
  /// f_r, its radiance. Default off.
  vtkSetMacro(CosineWeighted, bool);
  vtkGetMacro(CosineWeighted, bool);
  vtkBooleanMacro(CosineWeighted, bool);
  ///@}
  ///@{
  /// Whether the distance is by the logarithm. Default off.
  vtkSetMacro(LogScale, bool);
  vtkGetMacro(LogScale, bool);
  vtkBooleanMacro(LogScale, bool);
  ///@}
  ///@{
  /// With LogScale: the distance is 0 that many powers of ten below the greatest value. Default 3. > 0.
  vtkSetMacro(Decades, double);
  vtkGetMacro(Decades, double);
  ///@}
  ///@{
  /// The greatest distance. Default 1. 0: a distance of 1 stands for 1/sr (without LogScale).
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}
  ///@{
  /// Rings of cells from the mirror direction to the horizon; half of them are spent on the lobe,
  /// however sharp it is; twice as many cells lie around. Default 64. Range [4, 2000].
  vtkSetClampMacro(Resolution, int, 4, 2000);
  vtkGetMacro(Resolution, int);
  ///@}
  ///@{
  /// Whether the ray of the light and the normal are there as lines, 1.2 times as long as the lobe.
  /// Default on.
  vtkSetMacro(ShowRays, bool);
  vtkGetMacro(ShowRays, bool);
  vtkBooleanMacro(ShowRays, bool);
  ///@}

protected:
  vtkReflectanceLobeSource();
  ~vtkReflectanceLobeSource() override = default;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  int ReflectionModel = PHYSICAL_PHONG;
  double DiffuseReflectance = 0.3;
  double SpecularReflectance = 0.3;
  double Shininess = 20.0;
  double IncidentAngle = 45.0;
  double IncidentDirection[3] = { 0.0, 0.0, 0.0 };
  double Normal[3] = { 0.0, 0.0, 1.0 };
  double Center[3] = { 0.0, 0.0, 0.0 };
  bool CosineWeighted = false;
  bool LogScale = false;
  double Decades = 3.0;
  double Radius = 1.0;
  int Resolution = 64;
  bool ShowRays = true;

private:
  vtkReflectanceLobeSource(const vtkReflectanceLobeSource&) = delete;
  void operator=(const vtkReflectanceLobeSource&) = delete;
};

#endif
