// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkRadiometricSceneReader_h
#define vtkRadiometricSceneReader_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkRadiometryFiltersModule.h"

#include <memory> // for Scene

namespace radiometry
{
namespace io
{
struct GltfScene;
}
}

/// Reads a scene to simulate from a .gltf or .glb file.
///   Writes  port 0: the surface, triangles in metres. Cell arrays, three bands of linear Rec.709:
///           DiffuseReflectance, SpecularReflectance, Shininess, EmittedExitance [W/m^2], TwoSided,
///           MaterialIndex, ObjectIndex; point array Normals when a mesh has normals.
///           port 1: the lights (docs/arrays.md). port 2: the cameras, one vertex each, with
///           point arrays Direction, ViewUp, FocalPoint, ViewAngle [degrees, vertical],
///           ParallelProjection, ParallelScale, AspectRatio, ClippingRange.
///           Field data of each: Assumptions; port 0 also MaterialNames and ObjectNames, port 1
///           LightNames, Photometric and LuminousEfficacy, port 2 CameraNames
///   Model   node transforms composed in double; a mirrored mesh keeps its fronts; candela and lux
///           divided by LuminousEfficacy. Materials: io/GltfScene.h
///   Cost    O(size of the file)
///   Fails   a missing or damaged file, a vertex that is not finite, a light or a material out of
///           range: an error that says where, empty outputs
class VTKRADIOMETRYFILTERS_EXPORT vtkRadiometricSceneReader : public vtkPolyDataAlgorithm
{
public:
  static vtkRadiometricSceneReader* New();
  vtkTypeMacro(vtkRadiometricSceneReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The file, .gltf or .glb.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  enum LightUnitChoice
  {
    LightUnitsAuto = 0,        // as glTF says: photometric
    LightUnitsPhotometric = 1, // cd and lx
    LightUnitsRadiometric = 2  // W/sr and W/m^2
  };
  ///@{
  /// What the file's light intensities are. Default LightUnitsAuto.
  vtkSetClampMacro(LightUnits, int, LightUnitsAuto, LightUnitsRadiometric);
  vtkGetMacro(LightUnits, int);
  ///@}

  enum EmissiveUnitChoice
  {
    EmissiveUnitsAuto = 0,      // radiance when Blender wrote the file, else luminance
    EmissiveUnitsLuminance = 1, // cd/m^2, as glTF says
    EmissiveUnitsRadiance = 2,  // W/(m^2 sr), Blender's emission strength
    EmissiveUnitsExitance = 3   // W/m^2
  };
  ///@{
  /// What the file's emissive factor times strength is. Default EmissiveUnitsAuto.
  vtkSetClampMacro(EmissiveUnits, int, EmissiveUnitsAuto, EmissiveUnitsExitance);
  vtkGetMacro(EmissiveUnits, int);
  ///@}

  ///@{
  /// Luminous efficacy [lm/W] by which photometric values are divided. Default 683.002 (Blender's
  /// exporter multiplies watts by 683). Finite, > 0.
  vtkSetMacro(LuminousEfficacy, double);
  vtkGetMacro(LuminousEfficacy, double);
  ///@}

  ///@{
  /// Add specular reflectance to the diffuse one instead of writing a lobe: right energy, without
  /// highlights, for solvers that are diffuse only. Default off.
  vtkSetMacro(SpecularAsDiffuse, bool);
  vtkGetMacro(SpecularAsDiffuse, bool);
  vtkBooleanMacro(SpecularAsDiffuse, bool);
  ///@}

  ///@{
  /// Put lights that no node of the scene refers to at the origin, along -Z, instead of leaving
  /// them out. Default off.
  vtkSetMacro(UnreferencedLights, bool);
  vtkGetMacro(UnreferencedLights, bool);
  vtkBooleanMacro(UnreferencedLights, bool);
  ///@}

  ///@{
  /// After an update: what was assumed about the file, in whole sentences.
  int GetNumberOfAssumptions();
  const char* GetAssumption(int i);
  ///@}

  ///@{
  /// After an update: the cameras, so that vtkCamera's SetPosition, SetFocalPoint, SetViewUp,
  /// SetViewAngle, SetParallelProjection and SetParallelScale can be given these values. An index
  /// out of range gives zeros (and a null name). FocalPoint lies at the depth of the centre of the
  /// scene's bounds, or 1 m ahead where that is behind the camera.
  int GetNumberOfCameras();
  const char* GetCameraName(int i);
  void GetCameraPosition(int i, double position[3]);
  void GetCameraDirection(int i, double direction[3]);
  void GetCameraFocalPoint(int i, double focalPoint[3]);
  void GetCameraViewUp(int i, double viewUp[3]);
  double GetCameraViewAngle(int i);
  bool GetCameraParallelProjection(int i);
  double GetCameraParallelScale(int i);
  double GetCameraAspectRatio(int i);
  ///@}

  /// True when the file's name ends in .gltf or .glb and it can be opened.
  static int CanReadFile(VTK_FILEPATH const char* fileName);

protected:
  vtkRadiometricSceneReader();
  ~vtkRadiometricSceneReader() override;

  int RequestData(
    vtkInformation* request, vtkInformationVector** in, vtkInformationVector* out) override;

  char* FileName = nullptr;
  int LightUnits = LightUnitsAuto;
  int EmissiveUnits = EmissiveUnitsAuto;
  double LuminousEfficacy;
  bool SpecularAsDiffuse = false;
  bool UnreferencedLights = false;

private:
  vtkRadiometricSceneReader(const vtkRadiometricSceneReader&) = delete;
  void operator=(const vtkRadiometricSceneReader&) = delete;

  std::unique_ptr<radiometry::io::GltfScene> Scene;
};

#endif
