// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkRadiometricFilter_h
#define vtkRadiometricFilter_h

#include "vtkDataObjectAlgorithm.h"
#include "vtkRadiometryFiltersModule.h"
#include "vtkSmartPointer.h"

#include <memory>
#include <string>
#include <vector>

class ControllerCommunicator;
class SceneAdapter;
class vtkMatrix4x4;
class vtkMultiProcessController;

/// What the simulating filters share: ports, switches, checks and the writing of results.
///   Ports   0 surface; 1 lights (repeatable, optional); 2 occluders (repeatable, optional).
///           Surface and occluders: polydata, composite data, or any dataset, whose outer surface
///           is then taken.
///   Outputs 0 the surface with its results; 1 EffectPlan; 2 Convergence (vtkTable)
///   Reads   the material and light arrays of docs/arrays.md
///   Writes  field data on output 0: RadiometryUnits, RadiometryVersion, RadiometryOptions,
///           RadiometryOutcome (what ended the run)
///   Fails   input that cannot be computed with: an error that names array, index and value, empty
///           outputs
class VTKRADIOMETRYFILTERS_EXPORT vtkRadiometricFilter : public vtkDataObjectAlgorithm
{
public:
  vtkTypeMacro(vtkRadiometricFilter, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The values of SampleLocation.
  enum SampleLocations
  {
    CELLS = 0,
    POINTS = 1
  };
  /// The values of the effect switches and of Refinement.
  enum Switches
  {
    AUTO = 0,
    ON = 1,
    OFF = 2
  };

  struct Job;    // RadiometricJob.h; not part of the public interface
  struct Result;

  /// Lights (input port 1, repeatable).
  void AddLightsConnection(vtkAlgorithmOutput* lights);
  void AddLightsData(vtkDataObject* lights);
  void RemoveLightsConnections();
  /// Further surfaces that only block light (input port 2, repeatable).
  void AddOccludersConnection(vtkAlgorithmOutput* occluders);
  void AddOccludersData(vtkDataObject* occluders);
  void RemoveOccludersConnections();

  ///@{
  /// Error that each value is computed to, relative to the value. Default 0.01. Range [0, 1].
  vtkSetMacro(RelativeTolerance, double);
  vtkGetMacro(RelativeTolerance, double);
  ///@}
  ///@{
  /// Error that is good enough whatever the value [W/m^2]. Default 0. At least 0.
  vtkSetMacro(AbsoluteTolerance, double);
  vtkGetMacro(AbsoluteTolerance, double);
  ///@}
  ///@{
  /// Seconds after which refinement stops, tolerance met or not; the result says which. Default 0,
  /// no limit. The first estimate of every value is always finished.
  vtkSetMacro(TimeBudget, double);
  vtkGetMacro(TimeBudget, double);
  ///@}
  ///@{
  /// Memory that the run may take [MiB]. Default 0: half of the machine's.
  vtkSetMacro(MemoryLimit, double);
  vtkGetMacro(MemoryLimit, double);
  ///@}
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
  /// Whether surfaces receive, emit and reflect on both sides. Default off: the front only (where
  /// points turn counter-clockwise). A cell array TwoSided overrides it cell by cell.
  vtkSetMacro(TwoSided, bool);
  vtkGetMacro(TwoSided, bool);
  vtkBooleanMacro(TwoSided, bool);
  ///@}
  ///@{
  /// Whether the solution may be computed on a finer mesh inside. 0 Auto (default), 1 On, 2 Off:
  /// one constant radiosity a cell.
  vtkSetClampMacro(Refinement, int, AUTO, OFF);
  vtkGetMacro(Refinement, int);
  ///@}
  ///@{
  /// Metres per unit of the coordinates, of surface, occluders and lights alike. Default 1. > 0.
  vtkSetMacro(MetersPerUnit, double);
  vtkGetMacro(MetersPerUnit, double);
  ///@}
  ///@{
  /// Threads to use; 0 (default): all, of each of several ranks its share of the machine's. The result has the same bytes for any number.
  vtkSetClampMacro(NumberOfThreads, int, 0, 4096);
  vtkGetMacro(NumberOfThreads, int);
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
  /// The processes that hold the pieces of the scene and compute it together (docs/scaling.md); all of
  /// them must update the filter. Default: the global controller, so the ranks of pvbatch and
  /// pvserver. Null: this process alone.
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
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
  /// What to simulate: 0 Auto (default; what the scene calls for), 1 On, 2 Off (left out, and the
  /// EffectPlan still bounds what that may change).
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
  ///@}

protected:
  vtkRadiometricFilter();
  ~vtkRadiometricFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  /// The subclass's physics: reads the job, calls the core, fills the result.
  virtual void Simulate(Job& job, Result& result) = 0;
  /// Cell arrays of the surface that it reads beside those of materials; of N bands.
  virtual std::vector<std::string> CellArraysRead() const { return {}; }
  /// Whether results are wanted at points.
  virtual bool WantsPoints(const SceneAdapter&) const { return this->SampleLocation == POINTS; }

  double RelativeTolerance = 0.01;
  double AbsoluteTolerance = 0.0;
  double TimeBudget = 0.0;
  double MemoryLimit = 0.0;
  int SampleLocation = CELLS;
  double FeatureAngle = 30.0;
  bool TwoSided = false;
  int Refinement = AUTO;
  double MetersPerUnit = 1.0;
  int NumberOfThreads = 0;
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
  vtkSmartPointer<vtkMultiProcessController> Controller;

private:
  /// The ranks of an execution; null: this process alone. Those of earlier controllers stay: what is
  /// kept between executions may refer to them.
  const ControllerCommunicator* Ranks();
  std::vector<std::unique_ptr<ControllerCommunicator>> Communicators;
  vtkMultiProcessController* CommunicatorsLast = nullptr; // to which the last one belongs

  vtkRadiometricFilter(const vtkRadiometricFilter&) = delete;
  void operator=(const vtkRadiometricFilter&) = delete;
};

#endif
