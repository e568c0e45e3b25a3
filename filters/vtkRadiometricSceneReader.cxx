// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiometricSceneReader.h"

#include "LightPolyData.h"
#include "ScenePolyData.h"
#include "io/GltfScene.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cctype>
#include <fstream>

vtkStandardNewMacro(vtkRadiometricSceneReader);

vtkRadiometricSceneReader::vtkRadiometricSceneReader()
  : LuminousEfficacy(radiometry::units::MaximumLuminousEfficacy)
  , Scene(new radiometry::io::GltfScene)
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(3);
}

vtkRadiometricSceneReader::~vtkRadiometricSceneReader()
{
  this->SetFileName(nullptr);
}

int vtkRadiometricSceneReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* out)
{
  vtkPolyData* surface = vtkPolyData::GetData(out, 0);
  vtkPolyData* lights = vtkPolyData::GetData(out, 1);
  vtkPolyData* cameras = vtkPolyData::GetData(out, 2);
  for (vtkPolyData* output : { surface, lights, cameras })
  {
    output->Initialize();
  }
  *this->Scene = {};
  try
  {
    if (!this->FileName || !*this->FileName)
    {
      throw radiometry::InputError("FileName", -1, "none", "the name of a .gltf or .glb file");
    }
    using Options = radiometry::io::GltfOptions;
    Options options;
    options.Lights = static_cast<Options::LightUnits>(this->LightUnits);
    options.Emission = static_cast<Options::EmissiveUnits>(this->EmissiveUnits);
    options.LuminousEfficacy = this->LuminousEfficacy;
    options.SpecularAsDiffuse = this->SpecularAsDiffuse;
    options.UnreferencedLights = this->UnreferencedLights;
    *this->Scene = radiometry::io::ReadGltf(this->FileName, options);
  }
  catch (const radiometry::InputError& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  WriteSurface(*this->Scene, surface);
  WriteLights(this->Scene->Lights, 3, this->Scene->PhotometricLights, this->LuminousEfficacy, lights);
  WriteCameras(*this->Scene, cameras);
  for (vtkPolyData* output : { surface, lights, cameras })
  {
    AddStrings("Assumptions", this->Scene->Assumptions, output);
  }
  return 1;
}

int vtkRadiometricSceneReader::CanReadFile(const char* fileName)
{
  const std::string name = fileName ? fileName : "";
  const std::size_t dot = name.rfind('.');
  std::string extension = dot == std::string::npos ? "" : name.substr(dot);
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return (extension == ".gltf" || extension == ".glb") &&
    std::ifstream(name, std::ios::binary).good();
}

int vtkRadiometricSceneReader::GetNumberOfAssumptions()
{
  return static_cast<int>(this->Scene->Assumptions.size());
}

const char* vtkRadiometricSceneReader::GetAssumption(int i)
{
  return i >= 0 && i < this->GetNumberOfAssumptions() ? this->Scene->Assumptions[i].c_str()
                                                      : nullptr;
}

int vtkRadiometricSceneReader::GetNumberOfCameras()
{
  return static_cast<int>(this->Scene->Cameras.size());
}

namespace
{

/// The camera of that index; one of zeros when there is none.
radiometry::io::GltfCamera CameraAt(const radiometry::io::GltfScene& scene, int i)
{
  if (i >= 0 && static_cast<std::size_t>(i) < scene.Cameras.size())
  {
    return scene.Cameras[i];
  }
  radiometry::io::GltfCamera none;
  none.Direction = none.ViewUp = {};
  none.ViewAngle = none.ParallelScale = 0.0;
  return none;
}

void Copy(const radiometry::Vec3& from, double to[3])
{
  to[0] = from.x;
  to[1] = from.y;
  to[2] = from.z;
}

} // namespace

const char* vtkRadiometricSceneReader::GetCameraName(int i)
{
  return i >= 0 && i < this->GetNumberOfCameras() ? this->Scene->Cameras[i].Name.c_str() : nullptr;
}

void vtkRadiometricSceneReader::GetCameraPosition(int i, double position[3])
{
  Copy(CameraAt(*this->Scene, i).Position, position);
}

void vtkRadiometricSceneReader::GetCameraDirection(int i, double direction[3])
{
  Copy(CameraAt(*this->Scene, i).Direction, direction);
}

void vtkRadiometricSceneReader::GetCameraFocalPoint(int i, double focalPoint[3])
{
  Copy(FocalPoint(*this->Scene, CameraAt(*this->Scene, i)), focalPoint);
}

void vtkRadiometricSceneReader::GetCameraViewUp(int i, double viewUp[3])
{
  Copy(CameraAt(*this->Scene, i).ViewUp, viewUp);
}

double vtkRadiometricSceneReader::GetCameraViewAngle(int i)
{
  return CameraAt(*this->Scene, i).ViewAngle;
}

bool vtkRadiometricSceneReader::GetCameraParallelProjection(int i)
{
  return CameraAt(*this->Scene, i).Parallel;
}

double vtkRadiometricSceneReader::GetCameraParallelScale(int i)
{
  return CameraAt(*this->Scene, i).ParallelScale;
}

double vtkRadiometricSceneReader::GetCameraAspectRatio(int i)
{
  return CameraAt(*this->Scene, i).AspectRatio;
}

void vtkRadiometricSceneReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "LightUnits: " << this->LightUnits << "\n";
  os << indent << "EmissiveUnits: " << this->EmissiveUnits << "\n";
  os << indent << "LuminousEfficacy: " << this->LuminousEfficacy << " lm/W\n";
  os << indent << "SpecularAsDiffuse: " << this->SpecularAsDiffuse << "\n";
  os << indent << "UnreferencedLights: " << this->UnreferencedLights << "\n";
}
