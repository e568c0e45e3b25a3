// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSpectrumToRGBFilter.h"

#include "PhotometricNames.h"
#include "radiometry/imaging/ColorMatching.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>

namespace imaging = radiometry::imaging;
namespace names = radiometry::names;
using radiometry::InputError;

vtkStandardNewMacro(vtkSpectrumToRGBFilter);

namespace
{

bool EndsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool IsShare(const std::string& name)
{
  return EndsWith(name, "Reflectance") || EndsWith(name, "Transmittance") ||
    EndsWith(name, names::Ambient);
}

const char* UnitOf(vtkDataArray* array)
{
  vtkInformation* info = array->GetInformation();
  return info->Has(vtkDataArray::UNITS_LABEL()) ? info->Get(vtkDataArray::UNITS_LABEL()) : "";
}

vtkSmartPointer<vtkDataArray> Beside(
  vtkDataArray* array, const std::string& name, int components, const char* unit)
{
  const int type = array->GetDataType() == VTK_DOUBLE ? VTK_DOUBLE : VTK_FLOAT;
  auto result = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(type));
  result->SetName(name.c_str());
  result->SetNumberOfComponents(components);
  result->SetNumberOfTuples(array->GetNumberOfTuples());
  if (*unit)
  {
    result->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit);
  }
  return result;
}

/// One tuple, all of whose values are finite.
void Take(vtkDataArray* array, vtkIdType tuple, std::vector<double>& values)
{
  array->GetTuple(tuple, values.data());
  for (double value : values)
  {
    if (!std::isfinite(value))
    {
      throw InputError(array->GetName(), tuple, value, "finite values");
    }
  }
}

} // namespace

void vtkSpectrumToRGBFilter::AddArrayName(const char* name)
{
  if (name && *name)
  {
    this->ArrayNames.emplace_back(name);
    this->Modified();
  }
}

void vtkSpectrumToRGBFilter::ClearArrayNames()
{
  this->ArrayNames.clear();
  this->Modified();
}

void vtkSpectrumToRGBFilter::SetArrayName(const char* name)
{
  this->ClearArrayNames();
  this->AddArrayName(name);
}

void vtkSpectrumToRGBFilter::AddWavelength(double nanometres)
{
  this->Wavelengths.push_back(nanometres);
  this->Modified();
}

void vtkSpectrumToRGBFilter::ClearWavelengths()
{
  this->Wavelengths.clear();
  this->Modified();
}

int vtkSpectrumToRGBFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

std::vector<double> vtkSpectrumToRGBFilter::WavelengthsOf(
  vtkDataObject* data, vtkDataObject* around) const
{
  std::vector<double> list = this->Wavelengths;
  for (vtkDataObject* object : { data, around })
  {
    vtkDataArray* array =
      object && list.empty() ? object->GetFieldData()->GetArray(names::Wavelengths) : nullptr;
    for (vtkIdType i = 0; array && i < array->GetNumberOfTuples() * array->GetNumberOfComponents();
         ++i)
    {
      const int components = array->GetNumberOfComponents();
      list.push_back(array->GetComponent(i / components, static_cast<int>(i % components)));
    }
  }
  return list;
}

bool vtkSpectrumToRGBFilter::IsWanted(vtkDataArray* array, int bands) const
{
  if (!array || !array->GetName())
  {
    return false;
  }
  const std::string name = array->GetName();
  if (this->ArrayNames.empty())
  {
    return array->GetNumberOfComponents() == bands && !EndsWith(name, names::ErrorSuffix);
  }
  if (std::find(this->ArrayNames.begin(), this->ArrayNames.end(), name) == this->ArrayNames.end())
  {
    return false;
  }
  if (array->GetNumberOfComponents() != bands)
  {
    throw InputError(name, -1, std::to_string(array->GetNumberOfComponents()) + " components",
      "one for each of the " + std::to_string(bands) + " wavelengths");
  }
  return true;
}

void vtkSpectrumToRGBFilter::AddColors(vtkDataArray* array, const std::vector<double>& wavelengths,
  vtkDataSetAttributes* attributes) const
{
  const std::string name = array->GetName();
  const int bands = static_cast<int>(wavelengths.size());
  int kind = this->BandValues;
  if (kind == AUTOMATIC)
  {
    kind = IsShare(name) ? REFLECTANCE : POWER_IN_BAND;
  }
  const imaging::SpectralColor color(wavelengths.data(), bands,
    static_cast<imaging::BandValues>(kind - POWER_IN_BAND),
    static_cast<imaging::Illuminant>(this->Illuminant));
  const auto rgb = Beside(array, name + "RGB", 3, UnitOf(array));
  vtkSmartPointer<vtkDataArray> photometric;
  if (this->Photometric && kind != REFLECTANCE)
  {
    std::string renamed;
    const Photometry* p = Counterpart(name, renamed);
    photometric =
      p ? Beside(array, renamed, 1, p->Unit) : Beside(array, name + "Photometric", 1, "");
  }
  std::vector<double> values(wavelengths.size());
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    Take(array, i, values);
    const imaging::Triple c =
      imaging::FitGamut(color.ToRgb(values.data()), static_cast<imaging::Gamut>(this->Gamut));
    rgb->SetTuple3(i, c[0], c[1], c[2]);
    if (photometric)
    {
      photometric->SetTuple1(i, color.ToPhotometric(values.data()));
    }
  }
  attributes->AddArray(rgb);
  if (photometric)
  {
    attributes->AddArray(photometric);
  }
}

void vtkSpectrumToRGBFilter::ConvertSet(
  vtkDataSet* data, vtkDataObject* around, std::vector<std::string>& done) const
{
  const std::vector<double> wavelengths = this->WavelengthsOf(data, around);
  if (wavelengths.empty())
  {
    throw InputError(names::Wavelengths, -1, "no values",
      "the centres of the bands in nanometres, as field data or as the filter's own list");
  }
  for (vtkDataSetAttributes* attributes :
    { static_cast<vtkDataSetAttributes*>(data->GetPointData()),
      static_cast<vtkDataSetAttributes*>(data->GetCellData()) })
  {
    for (int i = attributes->GetNumberOfArrays() - 1; i >= 0; --i)
    {
      vtkDataArray* array = attributes->GetArray(i);
      if (this->IsWanted(array, static_cast<int>(wavelengths.size())))
      {
        this->AddColors(array, wavelengths, attributes);
        done.emplace_back(array->GetName());
      }
    }
  }
}

void vtkSpectrumToRGBFilter::Convert(
  vtkDataObject* input, vtkDataObject* output, std::vector<std::string>& done) const
{
  output->ShallowCopy(input);
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  if (!composite)
  {
    this->ConvertSet(vtkDataSet::SafeDownCast(output), nullptr, done);
    return;
  }
  auto* result = vtkCompositeDataSet::SafeDownCast(output);
  auto iterator = vtk::TakeSmartPointer(composite->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    vtkDataObject* leaf = iterator->GetCurrentDataObject();
    const auto copy = vtk::TakeSmartPointer(leaf->NewInstance());
    copy->ShallowCopy(leaf);
    if (auto* data = vtkDataSet::SafeDownCast(copy))
    {
      this->ConvertSet(data, composite, done);
    }
    result->SetDataSet(iterator, copy);
  }
}

int vtkSpectrumToRGBFilter::RequestData(
  vtkInformation*, vtkInformationVector** in, vtkInformationVector* out)
{
  vtkDataObject* input = vtkDataObject::GetData(in[0]);
  vtkDataObject* output = vtkDataObject::GetData(out);
  output->Initialize();
  try
  {
    std::vector<std::string> done;
    this->Convert(input, output, done);
    for (const std::string& name : this->ArrayNames)
    {
      if (std::find(done.begin(), done.end(), name) == done.end())
      {
        throw InputError(name, -1, "no such array", "a point or cell array of the input");
      }
    }
    if (done.empty() && input->GetNumberOfElements(vtkDataObject::POINT) > 0)
    {
      throw InputError("Arrays", -1, "none with a component for each wavelength",
        "one at least, of points or cells");
    }
  }
  catch (const InputError& error)
  {
    vtkErrorMacro(<< error.what());
    output->Initialize();
    return 0;
  }
  return 1;
}

void vtkSpectrumToRGBFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ArrayNames:";
  for (const std::string& name : this->ArrayNames)
  {
    os << " " << name;
  }
  os << "\n" << indent << "Wavelengths:";
  for (double wavelength : this->Wavelengths)
  {
    os << " " << wavelength;
  }
  os << " nm\n"
     << indent << "BandValues: " << this->BandValues << "\n"
     << indent << "Illuminant: " << this->Illuminant << "\n"
     << indent << "Gamut: " << this->Gamut << "\n"
     << indent << "Photometric: " << this->Photometric << "\n";
}
