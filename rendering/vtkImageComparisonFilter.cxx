// SPDX-License-Identifier: BSD-3-Clause
#include "vtkImageComparisonFilter.h"

#include "PicturePixels.h"
#include "radiometry/imaging/PictureDifference.h"
#include "radiometry/scene/InputError.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace imaging = radiometry::imaging;
using radiometry::InputError;
using Pipeline = vtkStreamingDemandDrivenPipeline;

vtkStandardNewMacro(vtkImageComparisonFilter);

namespace
{

/// Channels that are compared: of RGBA three.
int Channels(const PicturePixels& pixels) { return pixels.Components == 4 ? 3 : pixels.Components; }

/// The picture without its alpha.
PicturePixels WithoutAlpha(PicturePixels pixels)
{
  const int channels = Channels(pixels);
  std::vector<double> values;
  values.reserve(pixels.Count() * channels);
  for (std::size_t i = 0; i < pixels.Count(); ++i)
  {
    const double* p = &pixels.Values[i * pixels.Components];
    values.insert(values.end(), p, p + channels);
  }
  pixels.Components = channels;
  pixels.Values = std::move(values);
  return pixels;
}

/// Three channels of a pixel of 1 or more.
std::array<double, 3> Color(const PicturePixels& pixels, std::size_t i)
{
  const double* p = &pixels.Values[i * pixels.Components];
  return pixels.Components >= 3 ? std::array<double, 3>{ p[0], p[1], p[2] }
                                : std::array<double, 3>{ p[0], p[0], p[0] };
}

template <typename Array>
Array* AddColumn(vtkTable* table, const char* name)
{
  vtkNew<Array> column;
  column->SetName(name);
  table->AddColumn(column);
  return column; // kept alive by the table
}

std::string ChannelName(const PicturePixels& pixels, int channel)
{
  return pixels.Components == 1 ? (pixels.Name.empty() ? "value" : pixels.Name)
    : pixels.Components == 3    ? std::string(1, "RGB"[channel])
                                : std::to_string(channel);
}

} // namespace

vtkImageComparisonFilter::vtkImageComparisonFilter()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
}

int vtkImageComparisonFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkImageComparisonFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkTable" : "vtkImageData");
  return 1;
}

int vtkImageComparisonFilter::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* in = inputs[0]->GetInformationObject(0);
  int whole[6] = { 0, -1, 0, -1, 0, -1 };
  in->Get(Pipeline::WHOLE_EXTENT(), whole);
  int panels[6];
  std::copy(whole, whole + 6, panels);
  panels[1] += 2 * (whole[1] - whole[0] + 1 + this->Gap);
  for (int port : { 0, 2 })
  {
    vtkInformation* out = outputs->GetInformationObject(port);
    out->Set(Pipeline::WHOLE_EXTENT(), port == 0 ? panels : whole, 6);
    for (auto* key : { vtkDataObject::ORIGIN(), vtkDataObject::SPACING() })
    {
      if (in->Has(key))
      {
        out->Set(key, in->Get(key), 3);
      }
    }
    vtkDataObject::SetPointDataActiveScalarInfo(out, VTK_FLOAT, port == 0 ? 3 : -1);
  }
  return 1;
}

int vtkImageComparisonFilter::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  for (int port : { 0, 1 })
  {
    vtkInformation* in = inputs[port]->GetInformationObject(0);
    int whole[6];
    in->Get(Pipeline::WHOLE_EXTENT(), whole);
    in->Set(Pipeline::UPDATE_EXTENT(), whole, 6);
  }
  return 1;
}

void vtkImageComparisonFilter::CheckSettings() const
{
  if (!std::isfinite(this->DifferenceGain))
  {
    throw InputError("DifferenceGain", -1, this->DifferenceGain, "a finite number");
  }
  if (!(this->RelativeFloor >= 0.0) || !std::isfinite(this->RelativeFloor))
  {
    throw InputError("RelativeFloor", -1, this->RelativeFloor, "a finite number of at least 0");
  }
  if (!(this->Peak >= 0.0) || !std::isfinite(this->Peak))
  {
    throw InputError("Peak", -1, this->Peak, "a finite number of at least 0");
  }
}

void vtkImageComparisonFilter::WriteTable(
  const PicturePixels& a, const PicturePixels& b, double floor, vtkTable* table) const
{
  auto* names = AddColumn<vtkStringArray>(table, "Channel");
  const auto whole = [&](const char* name) { return AddColumn<vtkIdTypeArray>(table, name); };
  const auto real = [&](const char* name) { return AddColumn<vtkDoubleArray>(table, name); };
  auto* pixels = whole("Pixels");
  std::array<vtkDoubleArray*, 9> numbers{ real("MeanA"), real("MeanB"), real("MeanDifference"),
    real("MeanAbsolute"), real("MeanRelative"), real("RMSE"), real("RelativeRMSE"), real("Maximum"),
    real("PSNR") };
  std::array<vtkIdTypeArray*, 5> counts{ whole("MaximumX"), whole("MaximumY"), whole("NonFiniteA"),
    whole("NonFiniteB"), whole("Unlike") };
  const auto add = [&](const std::string& name, const imaging::ChannelDifference& d, int divide) {
    names->InsertNextValue(name);
    pixels->InsertNextValue(static_cast<vtkIdType>(d.Pixels));
    const double values[] = { d.MeanA, d.MeanB, d.MeanDifference, d.MeanAbsolute, d.MeanRelative,
      d.RootMeanSquare, d.RelativeRootMeanSquare, d.Maximum, d.PeakSignalToNoise };
    for (std::size_t k = 0; k < numbers.size(); ++k)
    {
      numbers[k]->InsertNextValue(values[k]);
    }
    const long long at = d.MaximumAt < 0 ? -1 : d.MaximumAt / divide;
    const long long where[] = { at < 0 ? -1 : at % a.Width, at < 0 ? -1 : at / a.Width,
      static_cast<long long>(d.NonFiniteA), static_cast<long long>(d.NonFiniteB),
      static_cast<long long>(d.Unlike) };
    for (std::size_t k = 0; k < counts.size(); ++k)
    {
      counts[k]->InsertNextValue(static_cast<vtkIdType>(where[k]));
    }
  };
  for (int c = 0; c < a.Components; ++c)
  {
    add(ChannelName(a, c),
      imaging::CompareChannel(
        a.Values.data(), b.Values.data(), a.Count(), a.Components, c, floor, this->Peak),
      1);
  }
  if (a.Components > 1)
  {
    add("All",
      imaging::CompareChannel(
        a.Values.data(), b.Values.data(), a.Values.size(), 1, 0, floor, this->Peak),
      a.Components);
  }
}

void vtkImageComparisonFilter::WritePanels(
  const PicturePixels& a, const PicturePixels& b, double floor, vtkImageData* image) const
{
  const auto kind = static_cast<imaging::DifferenceKind>(this->DifferenceKind);
  vtkNew<vtkFloatArray> colors;
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(image->GetNumberOfPoints());
  colors->FillValue(0.0f);
  const vtkIdType row = 3 * static_cast<vtkIdType>(a.Width) + 2 * this->Gap;
  for (std::size_t i = 0; i < a.Count(); ++i)
  {
    const auto ca = Color(a, i);
    const auto cb = Color(b, i);
    std::array<double, 3> difference;
    for (int c = 0; c < 3; ++c)
    {
      const double d = imaging::Difference(ca[c], cb[c], kind, floor) * this->DifferenceGain;
      difference[c] = std::isfinite(d) ? d : 0.0;
    }
    if (kind == imaging::DifferenceKind::Signed)
    {
      const double mean = (difference[0] + difference[1] + difference[2]) / 3.0;
      difference = { std::max(mean, 0.0), 0.0, std::max(-mean, 0.0) };
    }
    const vtkIdType x = static_cast<vtkIdType>(i) % a.Width;
    const vtkIdType at = static_cast<vtkIdType>(i) / a.Width * row + x;
    const vtkIdType step = a.Width + this->Gap;
    colors->SetTuple(at, ca.data());
    colors->SetTuple(at + step, cb.data());
    colors->SetTuple(at + 2 * step, difference.data());
  }
  image->GetPointData()->SetScalars(colors);
}

void vtkImageComparisonFilter::WriteDifference(const PicturePixels& a, const PicturePixels& b,
  double floor, vtkImageData* like, vtkImageData* image) const
{
  image->CopyStructure(like);
  const struct
  {
    const char* Suffix;
    imaging::DifferenceKind Kind;
  } arrays[] = { { "RelativeDifference", imaging::DifferenceKind::Relative },
    { "Difference", imaging::DifferenceKind::Signed } };
  for (const auto& wanted : arrays)
  {
    vtkNew<vtkFloatArray> array;
    array->SetName((a.Name + wanted.Suffix).c_str());
    array->SetNumberOfComponents(a.Components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(a.Count()));
    for (std::size_t i = 0; i < a.Values.size(); ++i)
    {
      array->SetValue(static_cast<vtkIdType>(i),
        static_cast<float>(imaging::Difference(a.Values[i], b.Values[i], wanted.Kind, floor)));
    }
    image->GetPointData()->AddArray(array);
    image->GetPointData()->SetActiveScalars(array->GetName());
  }
}

int vtkImageComparisonFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* panels = vtkImageData::GetData(outputs, 0);
  vtkTable* table = vtkTable::GetData(outputs, 1);
  vtkImageData* difference = vtkImageData::GetData(outputs, 2);
  for (vtkDataObject* output : { static_cast<vtkDataObject*>(panels),
         static_cast<vtkDataObject*>(table), static_cast<vtkDataObject*>(difference) })
  {
    output->Initialize();
  }
  try
  {
    this->CheckSettings();
    vtkImageData* first = vtkImageData::GetData(inputs[0]);
    vtkImageData* second = vtkImageData::GetData(inputs[1]);
    const int most = 1 << 20;
    const PicturePixels a = WithoutAlpha(ReadPicture(first, this->ArrayName, nullptr, most));
    const PicturePixels b = WithoutAlpha(ReadPicture(second, this->ArrayName, nullptr, most));
    const auto size = [](const PicturePixels& p) {
      return std::to_string(p.Width) + " x " + std::to_string(p.Height) + " pixels of " +
        std::to_string(p.Components) + " channels";
    };
    if (a.Width != b.Width || a.Height != b.Height || a.Components != b.Components)
    {
      throw InputError(b.Name, -1, size(b), size(a) + ", as in the reference");
    }
    const double floor = this->RelativeFloor > 0.0
      ? this->RelativeFloor
      : imaging::RelativeFloor(a.Values.data(), a.Values.size());
    int extent[6];
    first->GetExtent(extent);
    extent[1] += 2 * (a.Width + this->Gap);
    panels->SetExtent(extent);
    panels->SetOrigin(first->GetOrigin());
    panels->SetSpacing(first->GetSpacing());
    this->WritePanels(a, b, floor, panels);
    this->WriteTable(a, b, floor, table);
    this->WriteDifference(a, b, floor, first, difference);
  }
  catch (const InputError& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkImageComparisonFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ArrayName: " << this->ArrayName << "\n"
     << indent << "DifferenceKind: " << this->DifferenceKind << "\n"
     << indent << "DifferenceGain: " << this->DifferenceGain << "\n"
     << indent << "RelativeFloor: " << this->RelativeFloor << "\n"
     << indent << "Peak: " << this->Peak << "\n"
     << indent << "Gap: " << this->Gap << "\n";
}
