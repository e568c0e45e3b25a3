// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceMaterialFilter.h"

#include "SurfaceBlocks.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/MaterialPresets.h"
#include "radiometry/scene/Units.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cmath>
#include <string>

vtkStandardNewMacro(vtkSurfaceMaterialFilter);

namespace names = radiometry::names;
using radiometry::InputError;
using radiometry::materialPresets;
using Color = std::array<double, 3>;

/// What the properties ask for, in SI.
struct vtkSurfaceMaterialFilter::Material
{
  Color Diffuse;
  Color Specular;
  Color Transmitted;
  Color Diffused;
  Color Exitance;
};

vtkSurfaceMaterialFilter::vtkSurfaceMaterialFilter()
  : LuminousEfficacy(radiometry::units::MaximumLuminousEfficacy)
{
}

vtkSurfaceMaterialFilter::~vtkSurfaceMaterialFilter()
{
  this->SetSelectionArray(nullptr);
  this->SetSelectionName(nullptr);
  this->SetBlockName(nullptr);
}

int vtkSurfaceMaterialFilter::GetNumberOfPresets()
{
  return static_cast<int>(materialPresets.size());
}

const char* vtkSurfaceMaterialFilter::GetPresetName(int preset)
{
  return preset >= 1 && preset <= GetNumberOfPresets() ? materialPresets[preset - 1].Name : nullptr;
}

const char* vtkSurfaceMaterialFilter::GetPresetSource(int preset)
{
  return preset >= 1 && preset <= GetNumberOfPresets() ? materialPresets[preset - 1].Source
                                                       : nullptr;
}

namespace
{

Color Checked(const double values[3], double most, const char* name)
{
  Color color;
  for (int b = 0; b < 3; ++b)
  {
    if (!(values[b] >= 0.0 && values[b] <= most))
    {
      throw InputError(
        name, b, values[b], most == 1.0 ? "a number in [0, 1]" : "a finite number, not negative");
    }
    color[b] = values[b];
  }
  return color;
}

/// A colour in N bands.
std::vector<double> InBands(const Color& color, int bands, const char* name)
{
  if (bands == 3)
  {
    return { color[0], color[1], color[2] };
  }
  if (bands == 1)
  {
    return { radiometry::units::Photometric(color.data(), 3, 1.0) };
  }
  if (color[0] != color[1] || color[1] != color[2])
  {
    throw InputError(name, -1, "a colour", "a grey where there are " + std::to_string(bands) +
        " bands");
  }
  return std::vector<double>(static_cast<std::size_t>(bands), color[0]);
}

/// Writes values on the chosen cells of an array; the others keep theirs, or get `standard`.
void SetArray(vtkDataSet* surface, const char* name, const std::vector<double>& values,
  double standard, const std::vector<bool>& chosen)
{
  const auto bands = static_cast<int>(values.size());
  vtkDataArray* old = surface->GetCellData()->GetArray(name);
  if (old && old->GetNumberOfComponents() != bands && old->GetNumberOfComponents() != 1)
  {
    throw InputError(name, -1, std::to_string(old->GetNumberOfComponents()) + " components",
      std::to_string(bands) + ", as Bands says");
  }
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(bands);
  array->SetNumberOfTuples(surface->GetNumberOfCells());
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i)
  {
    for (int b = 0; b < bands; ++b)
    {
      const double kept =
        old ? old->GetComponent(i, old->GetNumberOfComponents() == 1 ? 0 : b) : standard;
      array->SetComponent(i, b, chosen[i] ? values[b] : kept);
    }
  }
  surface->GetCellData()->AddArray(array);
}

int BandsOf(vtkDataSet* surface)
{
  for (const char* name : { names::DiffuseReflectance, names::SpecularReflectance,
         names::DiffuseTransmittance, names::EmittedExitance, names::Transmittance })
  {
    if (vtkDataArray* array = surface->GetCellData()->GetArray(name))
    {
      return array->GetNumberOfComponents();
    }
  }
  return 3;
}

} // namespace

vtkSurfaceMaterialFilter::Material vtkSurfaceMaterialFilter::MakeMaterial() const
{
  if (this->Preset < 0 || this->Preset > GetNumberOfPresets())
  {
    throw InputError("Preset", -1, this->Preset,
      "0 (none) to " + std::to_string(GetNumberOfPresets()));
  }
  if (!(this->Shininess >= 0.0) || !std::isfinite(this->Shininess))
  {
    throw InputError("Shininess", -1, this->Shininess, "a finite number, not negative");
  }
  if (this->Bands < 0 || this->Bands > 4096)
  {
    throw InputError("Bands", -1, this->Bands, "0 (automatic) to 4096");
  }
  Material m;
  m.Diffuse = Checked(this->DiffuseReflectance, 1.0, "DiffuseReflectance");
  m.Specular = Checked(this->SpecularReflectance, 1.0, "SpecularReflectance");
  m.Transmitted = Checked(this->Transmittance, 1.0, "Transmittance");
  m.Diffused = Checked(this->DiffuseTransmittance, 1.0, "DiffuseTransmittance");
  if (this->Preset > 0)
  {
    m.Diffuse = materialPresets[this->Preset - 1].Diffuse;
    m.Specular = m.Transmitted = m.Diffused = { 0.0, 0.0, 0.0 };
  }
  for (int b = 0; b < 3; ++b)
  {
    const double sum = m.Diffuse[b] + m.Specular[b] + m.Transmitted[b] + m.Diffused[b];
    if (sum > 1.0 + 1e-12) // three decimal numbers that add up to 1 may do so with rounding
    {
      throw InputError(
        "DiffuseReflectance + SpecularReflectance + Transmittance + DiffuseTransmittance", b, sum,
        "at most 1 in each band");
    }
  }
  m.Exitance = Checked(this->EmissionColor, 1e300, "EmissionColor");
  if (!(this->Emission >= 0.0) || !std::isfinite(this->Emission))
  {
    throw InputError("Emission", -1, this->Emission, "a finite number, not negative");
  }
  if (this->EmissionUnit < WattPerSquareMeter || this->EmissionUnit > CandelaPerSquareMeter)
  {
    throw InputError("EmissionUnit", -1, this->EmissionUnit,
      "0 W/m^2, 1 lm/m^2, 2 W/(m^2 sr) or 3 cd/m^2");
  }
  const bool photometric =
    this->EmissionUnit == LumenPerSquareMeter || this->EmissionUnit == CandelaPerSquareMeter;
  const bool perSteradian = this->EmissionUnit == WattPerSquareMeterSteradian ||
    this->EmissionUnit == CandelaPerSquareMeter;
  double factor = this->Emission * (perSteradian ? radiometry::units::Pi : 1.0);
  factor =
    photometric ? radiometry::units::Radiometric(factor, this->LuminousEfficacy) : factor;
  for (double& band : m.Exitance)
  {
    band *= factor;
  }
  return m;
}

bool vtkSurfaceMaterialFilter::Choose(vtkDataSet* surface, std::vector<bool>& chosen) const
{
  const auto n = static_cast<std::size_t>(surface->GetNumberOfCells());
  const std::string selection = this->SelectionArray ? this->SelectionArray : "";
  if (selection.empty() || selection == "None") // what ParaView's list calls it
  {
    chosen.assign(n, true);
    return true;
  }
  chosen.assign(n, false);
  vtkDataArray* array = surface->GetCellData()->GetArray(this->SelectionArray);
  if (!array && n > 0)
  {
    throw InputError(this->SelectionArray, -1, "missing", "an integer cell array of the surface");
  }
  const std::string wanted = this->SelectionName ? this->SelectionName : "";
  bool any = false;
  for (std::size_t i = 0; i < n; ++i)
  {
    const auto value = static_cast<long long>(array->GetComponent(static_cast<vtkIdType>(i), 0));
    chosen[i] = wanted.empty() ? value == this->SelectionValue
                               : ValueName(surface, this->SelectionArray, value) == wanted;
    any = any || chosen[i];
  }
  return any;
}

/// Throws when a selection chose no cell at all.
void vtkSurfaceMaterialFilter::CheckFound(bool found) const
{
  if (!found)
  {
    const bool named = this->SelectionName && *this->SelectionName;
    throw InputError(this->SelectionArray, -1,
      named ? std::string(this->SelectionName) : std::to_string(this->SelectionValue),
      named ? "the name of a value that some cell has" : "a value that some cell has");
  }
}

bool vtkSurfaceMaterialFilter::Apply(
  const Material& material, vtkDataSet* input, vtkDataSet* output) const
{
  output->ShallowCopy(input);
  std::vector<bool> chosen;
  const bool any = this->Choose(input, chosen);
  const int bands = this->Bands > 0 ? this->Bands : BandsOf(input);
  const auto set = [&](const char* name, const Color& color, double standard) {
    SetArray(output, name, InBands(color, bands, name), standard, chosen);
  };
  set(names::DiffuseReflectance, material.Diffuse, 0.5);
  set(names::SpecularReflectance, material.Specular, 0.0);
  set(names::EmittedExitance, material.Exitance, 0.0);
  const bool transmits = material.Transmitted != Color{ 0.0, 0.0, 0.0 };
  if (transmits || input->GetCellData()->GetArray(names::Transmittance))
  {
    set(names::Transmittance, material.Transmitted, 0.0);
  }
  const bool diffuses = material.Diffused != Color{ 0.0, 0.0, 0.0 };
  if (diffuses || input->GetCellData()->GetArray(names::DiffuseTransmittance))
  {
    set(names::DiffuseTransmittance, material.Diffused, 0.0);
  }
  SetArray(output, names::Shininess, { this->Shininess }, 10.0, chosen);

  vtkDataArray* old = input->GetCellData()->GetArray(names::TwoSided);
  auto twoSided = vtkSmartPointer<vtkIntArray>::New();
  twoSided->SetName(names::TwoSided);
  twoSided->SetNumberOfTuples(input->GetNumberOfCells());
  for (vtkIdType i = 0; i < input->GetNumberOfCells(); ++i)
  {
    const int kept = old ? static_cast<int>(old->GetComponent(i, 0)) : 0;
    twoSided->SetValue(i, chosen[i] ? (this->TwoSided ? 1 : 0) : kept);
  }
  output->GetCellData()->AddArray(twoSided);
  return any || input->GetNumberOfCells() == 0;
}

int vtkSurfaceMaterialFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

int vtkSurfaceMaterialFilter::RequestData(
  vtkInformation*, vtkInformationVector** in, vtkInformationVector* out)
{
  vtkDataObject* input = vtkDataObject::GetData(in[0]);
  vtkDataObject* output = vtkDataObject::GetData(out);
  output->Initialize();
  try
  {
    const Material material = this->MakeMaterial();
    auto* composite = vtkCompositeDataSet::SafeDownCast(input);
    if (!composite)
    {
      this->CheckFound(this->Apply(
        material, vtkDataSet::SafeDownCast(input), vtkDataSet::SafeDownCast(output)));
      return 1;
    }
    auto* result = vtkCompositeDataSet::SafeDownCast(output);
    result->CopyStructure(composite);
    auto iterator = vtk::TakeSmartPointer(composite->NewIterator());
    const std::string wanted = this->BlockName ? this->BlockName : "";
    bool found = wanted.empty();
    bool chosen = false;
    bool any = false;
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      vtkDataObject* leaf = iterator->GetCurrentDataObject();
      const auto copy = vtk::TakeSmartPointer(leaf->NewInstance());
      copy->ShallowCopy(leaf);
      const char* name = iterator->HasCurrentMetaData()
        ? iterator->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME())
        : nullptr;
      auto* surface = vtkDataSet::SafeDownCast(leaf);
      if (surface && (wanted.empty() || (name && wanted == name)))
      {
        found = any = true;
        chosen = this->Apply(material, surface, vtkDataSet::SafeDownCast(copy)) || chosen;
      }
      result->SetDataSet(iterator, copy);
    }
    if (!found)
    {
      throw InputError("BlockName", -1, wanted, "the name of a block of the input");
    }
    this->CheckFound(chosen || !any);
  }
  catch (const InputError& error)
  {
    vtkErrorMacro(<< error.what());
    output->Initialize();
    return 0;
  }
  return 1;
}

void vtkSurfaceMaterialFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto color = [&](const char* name, const double v[3]) {
    os << indent << name << ": " << v[0] << " " << v[1] << " " << v[2] << "\n";
  };
  const auto text = [](const char* value) { return value ? value : "(none)"; };
  os << indent << "Preset: " << this->Preset << "\n";
  color("DiffuseReflectance", this->DiffuseReflectance);
  color("SpecularReflectance", this->SpecularReflectance);
  os << indent << "Shininess: " << this->Shininess << "\n";
  color("Transmittance", this->Transmittance);
  color("DiffuseTransmittance", this->DiffuseTransmittance);
  os << indent << "Emission: " << this->Emission << " (unit " << this->EmissionUnit << ")\n";
  color("EmissionColor", this->EmissionColor);
  os << indent << "LuminousEfficacy: " << this->LuminousEfficacy << " lm/W\n";
  os << indent << "TwoSided: " << this->TwoSided << "\n";
  os << indent << "Bands: " << this->Bands << "\n";
  os << indent << "SelectionArray: " << text(this->SelectionArray) << "\n";
  os << indent << "SelectionValue: " << this->SelectionValue << "\n";
  os << indent << "SelectionName: " << text(this->SelectionName) << "\n";
  os << indent << "BlockName: " << text(this->BlockName) << "\n";
}
