// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenColorIOImageFilter.h"

#include "color/ColorTransform.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace color = radiometry::color;

namespace
{

bool IsColour(vtkDataArray* array)
{
  return array && (array->GetNumberOfComponents() == 3 || array->GetNumberOfComponents() == 4);
}

/// The value that counts as 1.
double UnitOf(int type)
{
  switch (type)
  {
    case VTK_UNSIGNED_CHAR:
      return 255.0;
    case VTK_UNSIGNED_SHORT:
      return 65535.0;
    default:
      return 1.0;
  }
}

vtkSmartPointer<vtkFloatArray> AsFloat(vtkDataArray* array)
{
  vtkNew<vtkFloatArray> result;
  result->DeepCopy(array);
  result->SetName(array->GetName());
  const double unit = UnitOf(array->GetDataType());
  if (unit != 1.0)
  {
    float* values = result->GetPointer(0);
    std::transform(values, values + result->GetNumberOfValues(), values,
      [unit](float v) { return static_cast<float>(v / unit); });
  }
  return result;
}

/// f(P / a) a where there is alpha; pixels of alpha 0 stay.
void Convert(const color::ColorTransform& transform, vtkFloatArray* array, int threads)
{
  const int components = array->GetNumberOfComponents();
  const auto n = static_cast<std::size_t>(array->GetNumberOfTuples());
  float* pixels = array->GetPointer(0);
  if (components == 3)
  {
    transform.Apply(pixels, n, 3, threads);
    return;
  }
  const std::vector<float> before(pixels, pixels + 4 * n);
  for (std::size_t i = 0; i < n; ++i)
  {
    float* p = pixels + 4 * i;
    for (int c = 0; c < 3 && p[3] > 0.0f; ++c)
    {
      p[c] /= p[3];
    }
  }
  transform.Apply(pixels, n, 4, threads);
  for (std::size_t i = 0; i < n; ++i)
  {
    float* p = pixels + 4 * i;
    for (int c = 0; c < 3; ++c)
    {
      p[c] = p[3] > 0.0f ? p[c] * p[3] : before[4 * i + c];
    }
  }
}

vtkSmartPointer<vtkDataArray> AsBytes(vtkFloatArray* array)
{
  vtkNew<vtkUnsignedCharArray> bytes;
  bytes->SetName(array->GetName());
  bytes->SetNumberOfComponents(array->GetNumberOfComponents());
  bytes->SetNumberOfTuples(array->GetNumberOfTuples());
  const float* from = array->GetPointer(0);
  std::transform(from, from + array->GetNumberOfValues(), bytes->GetPointer(0), [](float v) {
    // A NaN is not above 0: it becomes black.
    return static_cast<unsigned char>(v > 0.0f ? std::lround(std::min(v, 1.0f) * 255.0f) : 0);
  });
  return bytes;
}

} // namespace

vtkStandardNewMacro(vtkOpenColorIOImageFilter);

//------------------------------------------------------------------------------
vtkOpenColorIOImageFilter::vtkOpenColorIOImageFilter() = default;
vtkOpenColorIOImageFilter::~vtkOpenColorIOImageFilter() = default;

//------------------------------------------------------------------------------
void vtkOpenColorIOImageFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ConfigFileName: " << this->ConfigFileName << "\n"
     << indent << "SourceColorSpace: " << this->SourceColorSpace << "\n"
     << indent << "TargetColorSpace: " << this->TargetColorSpace << "\n"
     << indent << "Display: " << this->Display << "\n"
     << indent << "View: " << this->View << "\n"
     << indent << "Look: " << this->Look << "\n"
     << indent << "Exposure: " << this->Exposure << "\n"
     << indent << "OutputScalarType: " << this->OutputScalarType << "\n"
     << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}

//------------------------------------------------------------------------------
int vtkOpenColorIOImageFilter::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (!this->Superclass::RequestInformation(request, inputs, outputs))
  {
    return 0;
  }
  // What the array will have is known when it is found; the type is known now.
  vtkDataObject::SetPointDataActiveScalarInfo(
    outputs->GetInformationObject(0), this->OutputScalarType, -1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkOpenColorIOImageFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* input = vtkImageData::GetData(inputs[0]);
  vtkImageData* output = vtkImageData::GetData(outputs);
  output->ShallowCopy(input);
  this->UsedConfig = this->UsedSourceColorSpace = this->UsedDisplay = this->UsedView = "";

  vtkDataArray* colours = this->GetInputArrayToProcess(0, inputs);
  for (const char* name : { "RGB", "RGBA" })
  {
    if (!IsColour(colours))
    {
      colours = input->GetPointData()->GetArray(name);
    }
  }
  if (!IsColour(colours) || colours->GetNumberOfTuples() != input->GetNumberOfPoints())
  {
    vtkErrorMacro("no point array of 3 or 4 components to convert; the image is unchanged");
    return 1;
  }
  if (this->OutputScalarType != VTK_FLOAT && this->OutputScalarType != VTK_UNSIGNED_CHAR)
  {
    vtkErrorMacro("OutputScalarType = " << this->OutputScalarType
                                        << ": expected VTK_FLOAT or VTK_UNSIGNED_CHAR; the image "
                                           "is unchanged");
    return 1;
  }
  try
  {
    const color::TransformOptions options{ this->SourceColorSpace, this->TargetColorSpace,
      this->Display, this->View, this->Look, this->Exposure };
    const color::ColorConfig config = color::ColorConfig::Open(this->ConfigFileName);
    const color::ColorTransform transform(config, options);
    const vtkSmartPointer<vtkFloatArray> converted = AsFloat(colours);
    Convert(transform, converted, std::max(0, this->NumberOfThreads));
    vtkSmartPointer<vtkDataArray> result = converted;
    if (this->OutputScalarType == VTK_UNSIGNED_CHAR)
    {
      result = AsBytes(converted);
    }
    // Not SetScalars for a named one: it would drop other active scalars.
    if (result->GetName())
    {
      output->GetPointData()->AddArray(result);
      output->GetPointData()->SetActiveScalars(result->GetName());
    }
    else
    {
      output->GetPointData()->SetScalars(result);
    }
    this->UsedConfig = config.Origin();
    this->UsedSourceColorSpace = transform.Used().SourceColorSpace;
    this->UsedDisplay = transform.Used().Display;
    this->UsedView = transform.Used().View;
  }
  catch (const color::ColorError& e)
  {
    vtkErrorMacro(<< e.what() << "; the image is unchanged");
  }
  return 1;
}

//------------------------------------------------------------------------------
namespace
{

/// What `list` gives for the config, with commas; empty and an error event where there is none.
std::string Listed(vtkOpenColorIOImageFilter* self,
  const std::function<std::vector<std::string>(const color::ColorConfig&)>& list)
{
  std::string text;
  try
  {
    for (const std::string& name : list(color::ColorConfig::Open(self->GetConfigFileName())))
    {
      text += (text.empty() ? "" : ", ") + name;
    }
  }
  catch (const color::ColorError& e)
  {
    vtkErrorWithObjectMacro(self, << e.what());
  }
  return text;
}

} // namespace

std::string vtkOpenColorIOImageFilter::GetConfigDisplays()
{
  return Listed(this, [](const color::ColorConfig& config) { return config.Displays(); });
}

std::string vtkOpenColorIOImageFilter::GetConfigViews(const char* display)
{
  return Listed(this, [display](const color::ColorConfig& config) {
    return config.Views(display && *display ? display : config.DefaultDisplay());
  });
}

std::string vtkOpenColorIOImageFilter::GetConfigColorSpaces()
{
  return Listed(this, [](const color::ColorConfig& config) { return config.ColorSpaces(); });
}

std::string vtkOpenColorIOImageFilter::GetConfigLooks()
{
  return Listed(this, [](const color::ColorConfig& config) { return config.Looks(); });
}
