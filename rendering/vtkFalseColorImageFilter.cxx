// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFalseColorImageFilter.h"

#include "LegendStrip.h"
#include "PicturePixels.h"
#include "radiometry/imaging/Exposure.h"
#include "radiometry/imaging/FalseColor.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
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
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace imaging = radiometry::imaging;
namespace names = radiometry::names;
using radiometry::InputError;
using Pipeline = vtkStreamingDemandDrivenPipeline;

vtkStandardNewMacro(vtkFalseColorImageFilter);

/// What was drawn and what explains it.
struct vtkFalseColorImageFilter::Drawing
{
  imaging::FalseColorMap Map;
  std::vector<double> IsoLevels;
  std::string Title;
  std::string Unit;
  vtkIdType NonFinite = 0;
};

namespace
{

/// Where nothing was drawn.
constexpr imaging::ByteColor NothingThere{ { 224, 224, 224 } };

bool IsNothing(const PicturePixels& pixels, std::size_t i)
{
  return pixels.Components == 4 && pixels.Values[4 * i + 3] == 0.0;
}

/// What a picture's values are in the legend's unit.
struct Quantity
{
  std::vector<double> Values;
  std::string Name;
  std::string Unit;
};

/// Of a colour: luminance, or what the array's name is in photometry.
Quantity PhotometricQuantity(const PicturePixels& pixels, double perUnit)
{
  Quantity q;
  const bool given = perUnit != 0.0;
  q.Values = imaging::PixelLuminances(pixels.Values.data(), pixels.Count(), pixels.Components,
    given ? perUnit : LuminancePerUnit(pixels.Unit));
  const auto is = [&](const char* name) { return pixels.Name.rfind(name, 0) == 0; };
  q.Name = "Luminance";
  q.Unit = "cd/m\xC2\xB2";
  if (is(names::Irradiance) || is(names::Illuminance))
  {
    q.Name = "Illuminance";
    q.Unit = "lx";
  }
  else if (is(names::Radiosity) || is(names::LuminousExitance))
  {
    q.Name = "Luminous exitance";
    q.Unit = "lm/m\xC2\xB2";
  }
  return q;
}

Quantity QuantityOf(const PicturePixels& pixels, double perUnit)
{
  if (pixels.IsColor())
  {
    return PhotometricQuantity(pixels, perUnit);
  }
  if (pixels.Components != 1)
  {
    throw InputError(
      pixels.Name, -1, std::to_string(pixels.Components) + " components", "1, or 3 or 4: a colour");
  }
  return { pixels.Values, pixels.Name.empty() ? "Value" : pixels.Name, pixels.Unit };
}

/// A line that shows on the colour: black on light ones, white on dark ones.
imaging::ByteColor LineOn(const imaging::ByteColor& color)
{
  const double light = 0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2];
  const std::uint8_t ink = light > 110 ? 0 : 255;
  return { { ink, ink, ink } };
}

void AddWords(vtkFieldData* field, const char* name, const std::string& words)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->InsertNextValue(words);
  field->AddArray(array);
}

void AddNumbers(vtkFieldData* field, const char* name, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (double value : values)
  {
    array->InsertNextValue(value);
  }
  field->AddArray(array);
}

} // namespace

vtkFalseColorImageFilter::vtkFalseColorImageFilter() { this->SetNumberOfOutputPorts(2); }

void vtkFalseColorImageFilter::AddLevel(double level)
{
  this->Levels.push_back(level);
  this->Modified();
}

void vtkFalseColorImageFilter::ClearLevels()
{
  this->Levels.clear();
  this->Modified();
}

int vtkFalseColorImageFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkImageData" : "vtkTable");
  return 1;
}

int vtkFalseColorImageFilter::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* in = inputs[0]->GetInformationObject(0);
  vtkInformation* out = outputs->GetInformationObject(0);
  int whole[6] = { 0, -1, 0, -1, 0, -1 };
  in->Get(Pipeline::WHOLE_EXTENT(), whole);
  whole[1] += this->Legend ? LegendStripWidth(whole[3] - whole[2] + 1) : 0;
  out->Set(Pipeline::WHOLE_EXTENT(), whole, 6);
  for (auto* key : { vtkDataObject::ORIGIN(), vtkDataObject::SPACING() })
  {
    if (in->Has(key))
    {
      out->Set(key, in->Get(key), 3);
    }
  }
  vtkDataObject::SetPointDataActiveScalarInfo(out, VTK_UNSIGNED_CHAR, 3);
  return 1;
}

int vtkFalseColorImageFilter::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  vtkInformation* in = inputs[0]->GetInformationObject(0);
  int whole[6];
  in->Get(Pipeline::WHOLE_EXTENT(), whole);
  in->Set(Pipeline::UPDATE_EXTENT(), whole, 6);
  return 1;
}

void vtkFalseColorImageFilter::Draw(
  vtkImageData* input, vtkImageData* output, vtkTable* table) const
{
  const PicturePixels pixels = ReadPicture(input, this->ArrayName, nullptr, 1 << 20);
  const Quantity quantity = QuantityOf(pixels, this->LuminancePerUnit);
  imaging::FalseColorSettings settings;
  settings.Palette = static_cast<imaging::Palette>(this->Palette);
  settings.Scale = this->LogScale ? imaging::ColorScale::Logarithmic : imaging::ColorScale::Linear;
  const bool automatic = this->ScalarRange[0] == 0.0 && this->ScalarRange[1] == 0.0;
  std::tie(settings.Minimum, settings.Maximum) = automatic
    ? imaging::ChooseRange(quantity.Values, settings.Scale)
    : std::pair<double, double>(this->ScalarRange[0], this->ScalarRange[1]);
  settings.Steps = this->Steps;
  settings.Levels = this->Levels;
  for (int c = 0; c < 3; ++c)
  {
    const double v = this->NonFiniteColor[c];
    settings.NotFinite[c] =
      static_cast<std::uint8_t>(std::lround(255.0 * (v > 0.0 ? std::min(v, 1.0) : 0.0)));
  }
  Drawing drawing{ imaging::FalseColorMap(settings), {}, this->Title, quantity.Unit };
  drawing.Title = drawing.Title.empty() ? quantity.Name : drawing.Title;
  const auto& limits = drawing.Map.GetLimits();
  drawing.IsoLevels = drawing.Map.IsContinuous()
    ? imaging::RoundLevels(limits.front(), limits.back(), settings.Scale, 10)
    : limits;

  const int columns = pixels.Width + (this->Legend ? LegendStripWidth(pixels.Height) : 0);
  std::vector<unsigned char> rgb(3 * static_cast<std::size_t>(columns) * pixels.Height, 0);
  std::vector<std::uint8_t> lines(pixels.Count(), 0);
  if (this->IsoLines)
  {
    lines = imaging::IsoLinePixels(quantity.Values, pixels.Width, pixels.Height, drawing.IsoLevels);
  }
  for (std::size_t i = 0; i < pixels.Count(); ++i)
  {
    const bool nothing = IsNothing(pixels, i);
    imaging::ByteColor color = nothing ? NothingThere : drawing.Map.Color(quantity.Values[i]);
    color = lines[i] ? LineOn(color) : color;
    const std::size_t at = i / pixels.Width * columns + i % pixels.Width;
    std::copy(color.begin(), color.end(), &rgb[3 * at]);
    drawing.NonFinite += nothing || std::isfinite(quantity.Values[i]) ? 0 : 1;
  }
  if (this->Legend)
  {
    DrawLegendStrip(rgb, columns, pixels.Height, pixels.Width, drawing.Map,
      LegendTicks(drawing.Map, settings.Scale, pixels.Height), drawing.Title, drawing.Unit);
    int extent[6];
    input->GetExtent(extent);
    extent[1] += columns - pixels.Width;
    output->SetExtent(extent);
    output->SetOrigin(input->GetOrigin());
    output->SetSpacing(input->GetSpacing());
    output->GetFieldData()->ShallowCopy(input->GetFieldData());
  }
  else
  {
    output->ShallowCopy(input);
  }
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("FalseColor");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(static_cast<vtkIdType>(rgb.size() / 3));
  std::copy(rgb.begin(), rgb.end(), colors->GetPointer(0));
  output->GetPointData()->AddArray(colors);
  output->GetPointData()->SetActiveScalars(colors->GetName());
  this->Describe(drawing, output, table);
}

void vtkFalseColorImageFilter::Describe(
  const Drawing& drawing, vtkImageData* output, vtkTable* table) const
{
  vtkFieldData* field = output->GetFieldData();
  const auto& limits = drawing.Map.GetLimits();
  const auto& colors = drawing.Map.GetColors();
  AddNumbers(field, "LegendLimits", limits);
  AddNumbers(field, "IsoLineLevels", drawing.IsoLevels);
  AddWords(field, "LegendTitle", drawing.Title);
  AddWords(field, "LegendUnit", drawing.Unit);
  vtkNew<vtkIdTypeArray> count;
  count->SetName("NonFinitePixels");
  count->InsertNextValue(drawing.NonFinite);
  field->AddArray(count);
  vtkNew<vtkUnsignedCharArray> bytes;
  bytes->SetName("LegendColors");
  bytes->SetNumberOfComponents(3);
  for (const imaging::ByteColor& color : colors)
  {
    bytes->InsertNextTypedTuple(color.data());
  }
  field->AddArray(bytes);

  for (int k = 0; k < 2; ++k)
  {
    vtkNew<vtkDoubleArray> column;
    column->SetName(k == 0 ? "Lower" : "Upper");
    for (std::size_t i = 0; i < colors.size(); ++i)
    {
      column->InsertNextValue(limits[i + k]);
    }
    table->AddColumn(column);
  }
  const char* channels[] = { "Red", "Green", "Blue" };
  for (int c = 0; c < 3; ++c)
  {
    vtkNew<vtkUnsignedCharArray> column;
    column->SetName(channels[c]);
    for (const imaging::ByteColor& color : colors)
    {
      column->InsertNextValue(color[c]);
    }
    table->AddColumn(column);
  }
}

int vtkFalseColorImageFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* output = vtkImageData::GetData(outputs, 0);
  vtkTable* table = vtkTable::GetData(outputs, 1);
  output->Initialize();
  table->Initialize();
  try
  {
    this->Draw(vtkImageData::GetData(inputs[0]), output, table);
  }
  catch (const InputError& error)
  {
    output->Initialize();
    table->Initialize();
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkFalseColorImageFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ArrayName: " << this->ArrayName << "\n"
     << indent << "LogScale: " << this->LogScale << "\n"
     << indent << "ScalarRange: " << this->ScalarRange[0] << " " << this->ScalarRange[1] << "\n"
     << indent << "Steps: " << this->Steps << "\n"
     << indent << "Levels:";
  for (double level : this->Levels)
  {
    os << " " << level;
  }
  os << "\n"
     << indent << "IsoLines: " << this->IsoLines << "\n"
     << indent << "Palette: " << this->Palette << "\n"
     << indent << "NonFiniteColor: " << this->NonFiniteColor[0] << " " << this->NonFiniteColor[1]
     << " " << this->NonFiniteColor[2] << "\n"
     << indent << "Legend: " << this->Legend << "\n"
     << indent << "Title: " << this->Title << "\n"
     << indent << "LuminancePerUnit: " << this->LuminancePerUnit << " cd/m^2\n";
}
