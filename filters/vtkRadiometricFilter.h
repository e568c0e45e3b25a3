// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkRadiometricFilter_h
#define vtkRadiometricFilter_h

#include "vtkRadiometricAlgorithm.h"

#include <string>
#include <vector>

namespace radiometry
{
enum class EffectSwitch;
}
class ControllerCommunicator;
class SceneAdapter;
class vtkMatrix4x4;
class vtkMultiProcessController;

/// What the filters of lights share: lights, switches, checks and the writing of results.
///   Ports   0 surface; 1 lights (repeatable, optional); 2 occluders (repeatable, optional).
///           Surface and occluders: polydata, composite data, or any dataset, whose outer surface
///           is then taken.
///   Outputs 0 the surface with its results; 1 EffectPlan; 2 Convergence (vtkTable)
///   Reads   the material and light arrays of docs/arrays.md
///   Writes  field data on output 0: RadiometryUnits, RadiometryVersion, RadiometryOptions,
///           RadiometryOutcome (what ended the run), EffectPlan (a sentence an effect)
///   Fails   input that cannot be computed with: an error that names array, index and value, empty
///           outputs
class VTKRADIOMETRYFILTERS_EXPORT vtkRadiometricFilter : public vtkRadiometricAlgorithm
{
public:
  vtkTypeMacro(vtkRadiometricFilter, vtkRadiometricAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The values of SampleLocation.
  enum SampleLocations
  {
    CELLS = 0,
    POINTS = 1
  };
  struct Job;    // RadiometricJob.h; not part of the public interface
  struct Result;

  /// Lights (input port 1, repeatable).
  void AddLightsConnection(vtkAlgorithmOutput* lights);
  void AddLightsData(vtkDataObject* lights);
  void RemoveLightsConnections();
  ///@{
  /// Where results are wanted: averages over cells (0, default) or values at points (1), about
  /// point normals, points split where faces meet at more than FeatureAngle.
  vtkSetClampMacro(SampleLocation, int, CELLS, POINTS);
  vtkGetMacro(SampleLocation, int);
  ///@}
  ///@{
  /// Angle between faces [degrees] above which a point on their common edge is split. Default 30.
  vtkSetClampMacro(FeatureAngle, double, 0.0, 180.0);
  vtkGetMacro(FeatureAngle, double);
  ///@}
  ///@{
  /// Whether the solution may be computed on a finer mesh inside. 0 Auto (default), 1 On, 2 Off:
  /// one constant radiosity a cell.
  vtkSetClampMacro(Refinement, int, AUTO, OFF);
  vtkGetMacro(Refinement, int);
  ///@}
  ///@{
  /// Diffuse reflectance of surfaces without the array DiffuseReflectance. Default 0.5. [0, 1].
  vtkSetMacro(DiffuseReflectance, double);
  vtkGetMacro(DiffuseReflectance, double);
  ///@}
  ///@{
  /// Whether photometric arrays are written too: Illuminance [lx], LuminousExitance [lm/m^2] and
  /// Luminance [cd/m^2], of one component. Default off.
  vtkSetMacro(Photometric, bool);
  vtkGetMacro(Photometric, bool);
  vtkBooleanMacro(Photometric, bool);
  ///@}
  ///@{
  /// Luminous efficacy [lm/W] by which they are computed; with three bands, the bands' shares are
  /// those of linear Rec.709. Default 683.002. > 0.
  vtkSetMacro(LuminousEfficacy, double);
  vtkGetMacro(LuminousEfficacy, double);
  ///@}

  ///@{
  /// Time that the surface is exposed to the light [s]. Above 0, the radiant exposure (dose)
  /// Dose = Irradiance times this time [J/m^2] is written with its error, and in photometric mode
  /// LuminousExposure [lx s]. Default 0: none. Finite, at least 0.
  vtkSetMacro(ExposureTime, double);
  vtkGetMacro(ExposureTime, double);
  ///@}
  ///@{
  /// Whether LightVisibility is written: cells or points x lights in the order of their inputs, at
  /// most 64, the share in [0, 1] of each light's unoccluded irradiance that arrives; LightVisibilityBack
  /// where surfaces are two-sided; and field data LightVisibilityLights, which lights they are. The
  /// mapper shadows lights and highlights by it. Costs a run with each light alone. Default off.
  vtkSetMacro(LightVisibility, bool);
  vtkGetMacro(LightVisibility, bool);
  vtkBooleanMacro(LightVisibility, bool);
  ///@}
  ///@{
  /// Irradiance that every point gets from all around, in each band, never in shadow [W/m^2].
  /// Default 0. At least 0. Field arrays GlobalAmbient of the lights add to it.
  vtkSetMacro(GlobalAmbient, double);
  vtkGetMacro(GlobalAmbient, double);
  ///@}
  ///@{
  /// Where the surface stands, as a 4 x 4 matrix row by row: moves the lights that are attached to
  /// it (AttachedTo 1), whose data is in the object's own coordinates. The points of the surface are
  /// taken as moved already: they stay where they are. Default: the identity. The last row is
  /// 0 0 0 1 and the matrix has an inverse. A field array ObjectTransform (16 numbers) of the surface
  /// goes before it.
  vtkSetVectorMacro(ObjectTransform, double, 16);
  vtkGetVectorMacro(ObjectTransform, double, 16);
  void SetObjectTransform(vtkMatrix4x4* matrix);
  ///@}
  ///@{
  /// The eye of the lights that are attached to the camera (AttachedTo 2), whose data is in eye
  /// coordinates (the eye at the origin, x right, y up, -z into the picture), in the unit of the
  /// surface's coordinates. Default: CameraPosition and CameraFocalPoint both (0, 0, 0), no camera,
  /// with which such lights are an error; CameraViewUp (0, 1, 0).
  vtkSetVector3Macro(CameraPosition, double);
  vtkGetVector3Macro(CameraPosition, double);
  vtkSetVector3Macro(CameraFocalPoint, double);
  vtkGetVector3Macro(CameraFocalPoint, double);
  vtkSetVector3Macro(CameraViewUp, double);
  vtkGetVector3Macro(CameraViewUp, double);
  ///@}

  ///@{
  /// What to simulate: 0 Auto (default; what the scene calls for and what can matter beside the
  /// tolerance), 1 On, 2 Off (left out, and the EffectPlan still bounds what that may change).
  /// What each of them is, and how its bound comes about: docs/filters/effect-plan.md.
  vtkSetClampMacro(Occlusion, int, AUTO, OFF);
  vtkGetMacro(Occlusion, int);
  vtkSetClampMacro(Interreflection, int, AUTO, OFF);
  vtkGetMacro(Interreflection, int);
  vtkSetClampMacro(SpecularTransport, int, AUTO, OFF);
  vtkGetMacro(SpecularTransport, int);
  vtkSetClampMacro(Transmission, int, AUTO, OFF);
  vtkGetMacro(Transmission, int);
  vtkSetClampMacro(BackFaces, int, AUTO, OFF);
  vtkGetMacro(BackFaces, int);
  vtkSetClampMacro(Emission, int, AUTO, OFF);
  vtkGetMacro(Emission, int);
  vtkSetClampMacro(Environment, int, AUTO, OFF);
  vtkGetMacro(Environment, int);
  vtkSetClampMacro(SpotShape, int, AUTO, OFF);
  vtkGetMacro(SpotShape, int);
  vtkSetClampMacro(Attenuation, int, AUTO, OFF);
  vtkGetMacro(Attenuation, int);
  vtkSetClampMacro(PointLights, int, AUTO, OFF);
  vtkGetMacro(PointLights, int);
  vtkSetClampMacro(SpotLights, int, AUTO, OFF);
  vtkGetMacro(SpotLights, int);
  vtkSetClampMacro(DirectionalLights, int, AUTO, OFF);
  vtkGetMacro(DirectionalLights, int);
  vtkSetClampMacro(AreaLights, int, AUTO, OFF);
  vtkGetMacro(AreaLights, int);
  vtkSetClampMacro(CandelaWebs, int, AUTO, OFF);
  vtkGetMacro(CandelaWebs, int);
  vtkSetClampMacro(Mirrors, int, AUTO, OFF);
  vtkGetMacro(Mirrors, int);
  vtkSetClampMacro(SpectralBands, int, AUTO, OFF);
  vtkGetMacro(SpectralBands, int);
  ///@}

protected:
  vtkRadiometricFilter();
  ~vtkRadiometricFilter() override;

  void Compute(const ControllerCommunicator* ranks, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

  void CopyMembers(vtkRadiometricAlgorithm* from) override;
  /// The subclass's physics: reads the job, calls the core, fills the result.
  virtual void Simulate(Job& job, Result& result) = 0;
  /// Cell arrays of the surface that it reads beside those of materials; of N bands.
  virtual std::vector<std::string> CellArraysRead() const { return {}; }
  /// Whether results are wanted at points.
  virtual bool WantsPoints(const SceneAdapter&) const { return this->SampleLocation == POINTS; }

  int SampleLocation = CELLS;
  double FeatureAngle = 30.0;
  int Refinement = AUTO;
  double DiffuseReflectance = 0.5;
  bool Photometric = false;
  double LuminousEfficacy = 683.002;
  double ExposureTime = 0.0;
  double GlobalAmbient = 0.0;
  bool LightVisibility = false;
  double ObjectTransform[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
  double CameraPosition[3] = { 0.0, 0.0, 0.0 };
  double CameraFocalPoint[3] = { 0.0, 0.0, 0.0 };
  double CameraViewUp[3] = { 0.0, 1.0, 0.0 };
  int Occlusion = AUTO;
  int Interreflection = AUTO;
  int SpecularTransport = AUTO;
  int Transmission = AUTO;
  int BackFaces = AUTO;
  int Emission = AUTO;
  int Environment = AUTO;
  int SpotShape = AUTO;
  int Attenuation = AUTO;
  int PointLights = AUTO;
  int SpotLights = AUTO;
  int DirectionalLights = AUTO;
  int AreaLights = AUTO;
  int CandelaWebs = AUTO;
  int Mirrors = AUTO;
  int SpectralBands = AUTO;

private:
  /// The switches by effect.
  std::vector<radiometry::EffectSwitch> EffectSwitches() const;

  vtkRadiometricFilter(const vtkRadiometricFilter&) = delete;
  void operator=(const vtkRadiometricFilter&) = delete;
};

#endif
