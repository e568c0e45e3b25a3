// SPDX-License-Identifier: BSD-3-Clause
#include "OpenEXRAssembly.h"

#include "FieldAttributes.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkPointData.h"
#include "vtkUnsignedIntArray.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

namespace io = radiometry::io;

namespace
{

bool IsReal(vtkDataArray* array)
{
  return array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
}

/// A copy with the same name in an array of type T.
template <typename T>
vtkSmartPointer<vtkDataArray> CopyAs(vtkDataArray* array, double divisor)
{
  vtkSmartPointer<T> copy = vtkSmartPointer<T>::New();
  copy->DeepCopy(array);
  copy->SetName(array->GetName());
  for (vtkIdType i = 0; divisor != 1.0 && i < copy->GetNumberOfValues(); ++i)
  {
    copy->SetValue(i, static_cast<typename T::ValueType>(copy->GetValue(i) / divisor));
  }
  return copy;
}

bool FitsUInt(vtkDataArray* array)
{
  double range[2];
  for (int c = 0; c < array->GetNumberOfComponents(); ++c)
  {
    array->GetRange(range, c);
    if (range[0] < 0.0 || range[1] > std::numeric_limits<std::uint32_t>::max())
    {
      return false;
    }
  }
  return true;
}

std::string ComponentSuffix(vtkDataArray* array, int component, bool normals)
{
  if (normals)
  {
    return std::string(".") + "XYZ"[component];
  }
  if (const char* name = array->GetComponentName(component))
  {
    return std::string(".") + name;
  }
  return array->GetNumberOfComponents() == 3 ? std::string(".") + "RGB"[component]
                                             : "." + std::to_string(component);
}

/// A window in the field data, as the reader makes it; empty where there is none.
io::ExrBox FieldWindow(vtkDataObject* data, const char* name)
{
  vtkDataArray* array = data->GetFieldData()->GetArray(name);
  if (!array || array->GetNumberOfValues() != 4)
  {
    return {};
  }
  const auto value = [&](int i) {
    const int c = array->GetNumberOfComponents();
    return static_cast<int>(array->GetComponent(i / c, i % c));
  };
  return { value(0), value(1), value(2), value(3) };
}

/// The array whose components are R, G, B (, A): "RGB", "RGBA" or else the active scalars.
vtkDataArray* PictureArray(vtkPointData* points)
{
  for (vtkDataArray* candidate :
    { points->GetArray("RGB"), points->GetArray("RGBA"), points->GetScalars() })
  {
    if (candidate &&
      (candidate->GetNumberOfComponents() == 3 || candidate->GetNumberOfComponents() == 4))
    {
      return candidate;
    }
  }
  return nullptr;
}

} // namespace

//------------------------------------------------------------------------------
void vtkOpenEXRWriter::Assembly::AddArray(vtkDataArray* array, bool picture)
{
  const std::string name = array->GetName() ? array->GetName() : "";
  const int components = array->GetNumberOfComponents();
  vtkSmartPointer<vtkDataArray> data = array;
  io::ExrPixelType type =
    this->Self->PixelType == Half ? io::ExrPixelType::Half : io::ExrPixelType::Float;
  const bool bytes = array->GetDataType() == VTK_UNSIGNED_CHAR;
  const bool shorts = array->GetDataType() == VTK_UNSIGNED_SHORT;
  if (picture && (bytes || shorts))
  {
    data = CopyAs<vtkDoubleArray>(array, bytes ? 255.0 : 65535.0);
  }
  else if (!IsReal(array) && FitsUInt(array))
  {
    data = CopyAs<vtkUnsignedIntArray>(array, 1.0);
    type = io::ExrPixelType::UInt;
  }
  else if (!IsReal(array) || !array->HasStandardMemoryLayout())
  {
    data = CopyAs<vtkDoubleArray>(array, 1.0);
    // 11 bits would merge the numbers of things.
    type = IsReal(array) ? type : io::ExrPixelType::Float;
  }
  const auto chosen = this->Self->ArrayPixelTypes.find(name);
  if (chosen != this->Self->ArrayPixelTypes.end())
  {
    type = static_cast<io::ExrPixelType>(chosen->second);
  }
  this->Kept.push_back(data);

  const long long width = this->Part.DataWindow.Width();
  const long long height = this->Part.DataWindow.Height();
  const bool normals = (name == "N" || name == "Normals") && components == 3;
  for (int c = 0; c < components; ++c)
  {
    io::ExrChannel channel;
    channel.Name = picture
      ? std::string(1, "RGBA"[c])
      : (components == 1 ? name : (normals ? "N" : name) + ComponentSuffix(array, c, normals));
    channel.Type = type;
    channel.XStride = components;
    channel.YStride = -components * width; // the last row of VTK is the first of OpenEXR
    const long long first = components * width * (height - 1) + c;
    switch (data->GetDataType())
    {
      case VTK_FLOAT:
        channel.Kind = io::ExrChannel::Memory::Float32;
        channel.Data = static_cast<const float*>(data->GetVoidPointer(0)) + first;
        break;
      case VTK_DOUBLE:
        channel.Kind = io::ExrChannel::Memory::Float64;
        channel.Data = static_cast<const double*>(data->GetVoidPointer(0)) + first;
        break;
      default:
        channel.Kind = io::ExrChannel::Memory::UInt32;
        channel.Data = static_cast<const std::uint32_t*>(data->GetVoidPointer(0)) + first;
    }
    this->Part.Channels.push_back(channel);
  }
  vtkInformation* information = array->HasInformation() ? array->GetInformation() : nullptr;
  if (information && information->Has(vtkDataArray::UNITS_LABEL()))
  {
    this->Part.Attributes[(picture ? std::string("RGB") : (normals ? "N" : name)) + ".units"] =
      std::string(information->Get(vtkDataArray::UNITS_LABEL()));
  }
}

//------------------------------------------------------------------------------
void vtkOpenEXRWriter::Assembly::AddAttributes(vtkImageData* image)
{
  auto& attributes = this->Part.Attributes;
  if (this->Part.Find("R") && this->Part.Find("G") && this->Part.Find("B"))
  {
    io::ExrChromaticities xy;
    std::copy(this->Self->Chromaticities, this->Self->Chromaticities + 8, xy.begin());
    attributes["chromaticities"] = xy;
  }
  vtkFieldData* field = image->GetFieldData();
  for (int i = 0; this->Self->WriteFieldData && i < field->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = field->GetAbstractArray(i);
    io::ExrAttribute value;
    if (array->GetName() && *array->GetName() && !io::IsStructuralAttribute(array->GetName()) &&
      Describe(array, value))
    {
      attributes[array->GetName()] = value;
    }
  }
  if (this->Self->WhiteLuminance > 0.0)
  {
    attributes["whiteLuminance"] = static_cast<float>(this->Self->WhiteLuminance);
  }
  if (this->Self->AdoptedNeutral[1] > 0.0)
  {
    attributes["adoptedNeutral"] =
      std::array<float, 2>{ static_cast<float>(this->Self->AdoptedNeutral[0]),
        static_cast<float>(this->Self->AdoptedNeutral[1]) };
  }
  for (const auto& [name, value] : this->Self->TextAttributes)
  {
    attributes[name] = value;
  }
  for (const auto& [name, value] : this->Self->NumberAttributes)
  {
    attributes[name] = value;
  }
}

//------------------------------------------------------------------------------
/// Windows, packing, aspect.
void vtkOpenEXRWriter::Assembly::Place(vtkImageData* image)
{
  int dimensions[3];
  image->GetDimensions(dimensions);
  const int* origin = this->Self->DataWindowOrigin;
  const int* display = this->Self->DisplayWindow;
  this->Part.DataWindow = { origin[0], origin[1], origin[0] + dimensions[0] - 1,
    origin[1] + dimensions[1] - 1 };
  const io::ExrBox was = FieldWindow(image, "dataWindow");
  if (origin[0] == 0 && origin[1] == 0 && was.Width() == dimensions[0] &&
    was.Height() == dimensions[1])
  {
    this->Part.DataWindow = was;
  }
  this->Part.DisplayWindow = { display[0], display[1], display[2], display[3] };
  if (this->Part.DisplayWindow.Width() < 1 || this->Part.DisplayWindow.Height() < 1)
  {
    this->Part.DisplayWindow = FieldWindow(image, "displayWindow");
  }
  this->Part.Compression = static_cast<io::ExrCompression>(this->Self->Compression);
  this->Part.DwaLevel = static_cast<float>(this->Self->DwaCompressionLevel);
  this->Part.TileWidth = this->Part.TileHeight = this->Self->TileSize;
  double spacing[3];
  image->GetSpacing(spacing);
  this->Part.PixelAspectRatio =
    spacing[0] > 0.0 && spacing[1] > 0.0 ? static_cast<float>(spacing[0] / spacing[1]) : 1.0f;
}

//------------------------------------------------------------------------------
void vtkOpenEXRWriter::Assembly::AddArrays(vtkImageData* image)
{
  vtkPointData* points = image->GetPointData();
  vtkDataArray* picture = PictureArray(points);
  for (int i = 0; i < points->GetNumberOfArrays(); ++i)
  {
    if (vtkDataArray* array = points->GetArray(i))
    {
      this->AddArray(array, array == picture);
    }
  }
}
