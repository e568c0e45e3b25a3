// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPhotometricFileReader.h"

#include "LightPolyData.h"
#include "ScenePolyData.h"
#include "io/PhotometricFile.h"
#include "io/PhotometricShapes.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>

vtkStandardNewMacro(vtkPhotometricFileReader);

using radiometry::InputError;
using radiometry::io::LuminaireMesh;
using radiometry::io::LuminairePlacement;
using radiometry::io::PhotometricFile;

namespace
{

radiometry::Vec3 Vector(const double v[3])
{
  return { v[0], v[1], v[2] };
}

void CheckNumber(const char* name, double value, bool zero)
{
  if (!std::isfinite(value) || value < 0.0 || (!zero && value == 0.0))
  {
    throw InputError(name, -1, value, zero ? "a finite number, not negative" : "a finite number above 0");
  }
}

/// What the bands of a light are multiplied by.
std::vector<double> BandFactors(const double color[3], int bands)
{
  for (int k = 0; k < 3; ++k)
  {
    CheckNumber("Color", color[k], true);
  }
  const bool grey = color[0] == color[1] && color[1] == color[2];
  if (bands == 1)
  {
    return { radiometry::units::Photometric(color, 3, 1.0) };
  }
  if (bands == 0 && grey)
  {
    return { color[0] };
  }
  return bands == 0 || bands == 3 ? std::vector<double>{ color[0], color[1], color[2] }
                                  : std::vector<double>(static_cast<std::size_t>(bands), 1.0);
}

void WriteMesh(const LuminaireMesh& mesh, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const radiometry::Vec3& p : mesh.Points)
  {
    points->InsertNextPoint(p.x, p.y, p.z);
  }
  vtkNew<vtkCellArray> polygons;
  for (const auto& polygon : mesh.Polygons)
  {
    polygons->InsertNextCell(static_cast<int>(polygon.size()));
    for (const std::int32_t id : polygon)
    {
      polygons->InsertCellPoint(id);
    }
  }
  output->SetPoints(points);
  output->SetPolys(polygons);
}

void AddValues(const char* name, const std::vector<double>& values, double factor, vtkPolyData* output)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (const double value : values)
  {
    array->InsertNextValue(factor * value);
  }
  output->GetPointData()->AddArray(array);
}

void AddNumbers(const char* name, const std::vector<double>& values, vtkPolyData* output)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (const double value : values)
  {
    array->InsertNextValue(value);
  }
  output->GetFieldData()->AddArray(array);
}

const char* ShapeName(radiometry::io::LuminousOpening::Shapes shape)
{
  static const char* const names[] = { "point", "rectangle", "ellipse", "ellipsoid",
    "cylinder along C = 0", "cylinder along C = 90", "upright ellipse" };
  return names[shape];
}

} // namespace

vtkPhotometricFileReader::vtkPhotometricFileReader()
  : LuminousEfficacy(radiometry::units::MaximumLuminousEfficacy)
  , File(new PhotometricFile)
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(3);
}

vtkPhotometricFileReader::~vtkPhotometricFileReader()
{
  this->SetFileName(nullptr);
}

void vtkPhotometricFileReader::CheckProperties() const
{
  CheckNumber("LightLossFactor", this->LightLossFactor, true);
  CheckNumber("Dimming", this->Dimming, true);
  CheckNumber("SolidScale", this->SolidScale, false);
  for (const int count : this->AreaSamples)
  {
    if (count < 1 || count > 1000)
    {
      throw InputError("AreaSamples", -1, count, "1 to 1000 in each direction");
    }
  }
  if (!std::isfinite(this->Rotation))
  {
    throw InputError("Rotation", -1, this->Rotation, "a finite number of degrees");
  }
}

LuminairePlacement vtkPhotometricFileReader::Placement() const
{
  radiometry::LightRecord record;
  record.Position = Vector(this->Position);
  record.Direction = Vector(this->Direction);
  record.Reference = Vector(this->ReferenceDirection);
  record.Web = this->File->Web;
  record.AttachedTo = this->AttachedTo;
  radiometry::Validate(record);
  const radiometry::Light light = radiometry::ToLight(record, 1.0, {}, 0);
  LuminairePlacement placement;
  placement.Position = record.Position;
  placement.Axis = light.Direction;
  placement.Reference = light.Reference;
  if (this->Rotation != 0.0)
  {
    placement.Turn(this->Rotation);
  }
  return placement;
}

/// W/sr per relative intensity, factors applied.
double vtkPhotometricFileReader::RadiantFactor() const
{
  using radiometry::io::IntensityUnits;
  const double greatest = this->File->Greatest * this->LightLossFactor * this->Dimming;
  const double candela = radiometry::units::Radiometric(greatest, this->LuminousEfficacy);
  switch (this->File->Units)
  {
    case IntensityUnits::MilliwattPerSteradian:
      return 1e-3 * greatest;
    case IntensityUnits::WattPerSteradian:
      return greatest;
    default:
      return candela;
  }
}

void vtkPhotometricFileReader::MakeLights(
  const LuminairePlacement& placement, vtkPolyData* output) const
{
  const PhotometricFile& file = *this->File;
  radiometry::LightRecord light;
  light.Name = file.Luminaire.empty() ? file.Catalogue : file.Luminaire;
  light.Direction = placement.Axis;
  light.Reference = placement.Reference;
  light.Web = file.Web;
  light.Enabled = this->LightEnabled;
  light.AttachedTo = this->AttachedTo;
  const std::vector<radiometry::Vec3> places = radiometry::io::OpeningSamples(
    file.Opening, placement, this->AreaSamples[0], this->AreaSamples[1]);
  light.Intensity = BandFactors(this->Color, this->Bands);
  for (double& band : light.Intensity)
  {
    band *= this->RadiantFactor() / static_cast<double>(places.size());
  }
  std::vector<radiometry::LightRecord> lights;
  for (const radiometry::Vec3& place : places)
  {
    light.Position = place;
    lights.push_back(light);
  }
  radiometry::Validate(light);
  WriteLights(lights, static_cast<int>(light.Intensity.size()),
    file.Units == radiometry::io::IntensityUnits::Candela, this->LuminousEfficacy, output);
  this->Describe(output);
}

void vtkPhotometricFileReader::Describe(vtkPolyData* output) const
{
  const PhotometricFile& file = *this->File;
  const auto words = [&](const char* name, const std::string& text) {
    AddStrings(name, { text }, output);
  };
  words("LuminaireName", file.Luminaire);
  words("Manufacturer", file.Manufacturer);
  words("CatalogueNumber", file.Catalogue);
  words("LampName", file.Lamp);
  words("PhotometricFormat", file.Format);
  std::vector<std::string> keywords;
  for (const auto& [key, value] : file.Keywords)
  {
    keywords.push_back("[" + key + "] " + value);
  }
  AddStrings("PhotometricKeywords", keywords, output);
  AddStrings("Assumptions", file.Assumptions, output);
  AddStrings("Warnings", file.Warnings, output);
  words("FluxUnit", file.FluxUnit());
  AddNumbers("FluxFromWeb", { file.FluxFromWeb }, output);
  AddNumbers("FluxStated", { file.FluxStated }, output);
  AddNumbers("LampFlux", { file.LampFlux }, output);
  AddNumbers(
    "LightOutputRatio", { file.LampFlux > 0.0 ? file.FluxFromWeb / file.LampFlux : -1.0 }, output);
  words("FileIntensityUnit", file.IntensityUnit());
  AddNumbers("GreatestIntensity", { file.Greatest }, output);
  AddNumbers("InputPower", { file.InputWatts }, output);
  words("LuminousOpeningShape", ShapeName(file.Opening.Shape));
  AddNumbers("LuminousOpeningSize",
    { file.Opening.Size.x, file.Opening.Size.y, file.Opening.Size.z }, output);
}

void vtkPhotometricFileReader::MakeSolid(
  const LuminairePlacement& placement, vtkPolyData* output) const
{
  const LuminaireMesh mesh =
    radiometry::io::DistributionSolid(*this->File->Web, placement, this->SolidScale);
  WriteMesh(mesh, output);
  AddValues("RelativeIntensity", mesh.Value, 1.0, output);
  AddValues("Intensity", mesh.Value, this->RadiantFactor(), output);
  if (this->File->Units == radiometry::io::IntensityUnits::Candela)
  {
    AddValues("LuminousIntensity", mesh.Value,
      this->File->Greatest * this->LightLossFactor * this->Dimming, output);
  }
}

int vtkPhotometricFileReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* out)
{
  vtkPolyData* outputs[3];
  for (int port = 0; port < 3; ++port)
  {
    outputs[port] = vtkPolyData::GetData(out, port);
    outputs[port]->Initialize();
  }
  *this->File = {};
  try
  {
    if (!this->FileName || !*this->FileName)
    {
      throw InputError("FileName", -1, "none", "the name of a .ies or .ldt file");
    }
    this->CheckProperties();
    radiometry::io::PhotometricOptions options;
    options.Units = static_cast<radiometry::io::IntensityUnits>(this->IntensityUnits);
    options.LampSet = this->LampSet;
    options.TiltAngle = this->TiltAngle;
    *this->File = radiometry::io::ReadPhotometricFile(this->FileName, options);
    const LuminairePlacement placement = this->Placement();
    this->MakeLights(placement, outputs[0]);
    this->MakeSolid(placement, outputs[1]);
    WriteMesh(radiometry::io::OpeningSurface(this->File->Opening, placement), outputs[2]);
  }
  catch (const std::runtime_error& error) // InputError or FileError
  {
    vtkErrorMacro(<< error.what());
    for (vtkPolyData* output : outputs)
    {
      output->Initialize();
    }
    *this->File = {};
    return 0;
  }
  for (const std::string& warning : this->File->Warnings)
  {
    vtkWarningMacro(<< this->FileName << ": " << warning);
  }
  return 1;
}

int vtkPhotometricFileReader::CanReadFile(const char* fileName)
{
  const std::string name = fileName ? fileName : "";
  const std::size_t dot = name.rfind('.');
  std::string extension = dot == std::string::npos ? "" : name.substr(dot);
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return (extension == ".ies" || extension == ".ldt") &&
    std::ifstream(name, std::ios::binary).good();
}

double vtkPhotometricFileReader::GetFluxFromWeb()
{
  return this->File->FluxFromWeb;
}

double vtkPhotometricFileReader::GetFluxStated()
{
  return this->File->FluxStated;
}

const char* vtkPhotometricFileReader::GetFluxUnit()
{
  return this->File->FluxUnit();
}

int vtkPhotometricFileReader::GetNumberOfWarnings()
{
  return static_cast<int>(this->File->Warnings.size());
}

const char* vtkPhotometricFileReader::GetWarning(int i)
{
  return i >= 0 && i < this->GetNumberOfWarnings() ? this->File->Warnings[i].c_str() : nullptr;
}

int vtkPhotometricFileReader::GetNumberOfAssumptions()
{
  return static_cast<int>(this->File->Assumptions.size());
}

const char* vtkPhotometricFileReader::GetAssumption(int i)
{
  return i >= 0 && i < this->GetNumberOfAssumptions() ? this->File->Assumptions[i].c_str()
                                                      : nullptr;
}

void vtkPhotometricFileReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto vector = [&](const char* name, const double v[3]) {
    os << indent << name << ": " << v[0] << " " << v[1] << " " << v[2] << "\n";
  };
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "IntensityUnits: " << this->IntensityUnits << "\n";
  os << indent << "LuminousEfficacy: " << this->LuminousEfficacy << " lm/W\n";
  vector("Position", this->Position);
  vector("Direction", this->Direction);
  vector("ReferenceDirection", this->ReferenceDirection);
  os << indent << "Rotation: " << this->Rotation << "\n";
  os << indent << "LightLossFactor: " << this->LightLossFactor << "\n";
  os << indent << "Dimming: " << this->Dimming << "\n";
  os << indent << "LampSet: " << this->LampSet << "\n";
  os << indent << "TiltAngle: " << this->TiltAngle << "\n";
  vector("Color", this->Color);
  os << indent << "Bands: " << this->Bands << "\n";
  os << indent << "AreaSamples: " << this->AreaSamples[0] << " " << this->AreaSamples[1] << "\n";
  os << indent << "SolidScale: " << this->SolidScale << "\n";
  os << indent << "LightEnabled: " << this->LightEnabled << "\n";
  os << indent << "AttachedTo: " << this->AttachedTo << "\n";
}
