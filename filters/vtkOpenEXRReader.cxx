// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenEXRReader.h"

#include "io/ExrColor.h"
#include "io/ExrReader.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkUnsignedIntArray.h"

#include <algorithm>
#include <vector>

namespace io = radiometry::io;

namespace
{

/// The channels that make up one array, in the order of its components.
struct Group
{
  std::string Name;
  std::vector<const io::ExrChannel*> Channels;
};

/// Takes the channels base + suffixes out of `left` if all are there and of one kind of number.
bool Take(std::vector<const io::ExrChannel*>& left, const std::string& base,
  const std::vector<std::string>& suffixes, std::vector<const io::ExrChannel*>& taken)
{
  taken.clear();
  for (const std::string& suffix : suffixes)
  {
    const auto found = std::find_if(left.begin(), left.end(),
      [&](const io::ExrChannel* channel) { return channel->Name == base + suffix; });
    if (found == left.end() || (!taken.empty() && taken[0]->Kind != (*found)->Kind))
    {
      return false;
    }
    taken.push_back(*found);
  }
  left.erase(std::remove_if(left.begin(), left.end(),
               [&](const io::ExrChannel* channel) {
                 return std::find(taken.begin(), taken.end(), channel) != taken.end();
               }),
    left.end());
  return true;
}

std::vector<Group> GroupChannels(const io::ExrPart& part)
{
  std::vector<const io::ExrChannel*> left;
  for (const io::ExrChannel& channel : part.Channels)
  {
    left.push_back(&channel);
  }
  std::vector<Group> groups;
  std::vector<const io::ExrChannel*> taken;
  if (Take(left, "", { "R", "G", "B", "A" }, taken))
  {
    groups.push_back({ "RGBA", taken });
  }
  else if (Take(left, "", { "R", "G", "B" }, taken))
  {
    groups.push_back({ "RGB", taken });
  }
  while (!left.empty())
  {
    const std::string name = left[0]->Name;
    const auto dot = name.rfind('.');
    const std::string base = name.substr(0, dot);
    bool grouped = false;
    if (dot != std::string::npos && dot > 0)
    {
      std::vector<std::string> numbers;
      while (part.Find(base + "." + std::to_string(numbers.size())))
      {
        numbers.push_back("." + std::to_string(numbers.size()));
      }
      for (const std::vector<std::string>& suffixes :
        { std::vector<std::string>{ ".R", ".G", ".B", ".A" }, { ".R", ".G", ".B" },
          { ".X", ".Y", ".Z" }, numbers })
      {
        const bool own = suffixes.size() > 1 &&
          std::find(suffixes.begin(), suffixes.end(), name.substr(dot)) != suffixes.end();
        if (own && Take(left, base, suffixes, taken))
        {
          groups.push_back({ base, taken });
          grouped = true;
          break;
        }
      }
    }
    if (!grouped)
    {
      groups.push_back({ name, { left[0] } });
      left.erase(left.begin());
    }
  }
  return groups;
}

template <typename T>
vtkSmartPointer<vtkDataArray> Fill(const Group& group, int width, int height)
{
  vtkSmartPointer<T> array = vtkSmartPointer<T>::New();
  const int n = static_cast<int>(group.Channels.size());
  array->SetName(group.Name.c_str());
  array->SetNumberOfComponents(n);
  array->SetNumberOfTuples(static_cast<vtkIdType>(width) * height);
  for (int c = 0; c < n; ++c)
  {
    const io::ExrChannel& channel = *group.Channels[c];
    const auto* from = static_cast<const typename T::ValueType*>(channel.Data);
    typename T::ValueType* to = array->GetPointer(c);
    for (int row = 0; row < height; ++row)
    {
      const auto* line = from + ((height - 1 - row) / channel.YSampling) * channel.YStride;
      for (int column = 0; column < width; ++column, to += n)
      {
        *to = line[(column / channel.XSampling) * channel.XStride];
      }
    }
  }
  return array;
}

/// An attribute as field data.
struct AsArray
{
  template <typename A, typename V>
  static vtkSmartPointer<vtkAbstractArray> Of(const V* values, std::size_t n)
  {
    vtkSmartPointer<A> array = vtkSmartPointer<A>::New();
    array->SetNumberOfComponents(1);
    array->SetNumberOfTuples(static_cast<vtkIdType>(n));
    for (std::size_t i = 0; i < n; ++i)
    {
      array->SetValue(static_cast<vtkIdType>(i), values[i]);
    }
    return array;
  }
  vtkSmartPointer<vtkAbstractArray> operator()(int v) const { return Of<vtkIntArray>(&v, 1); }
  vtkSmartPointer<vtkAbstractArray> operator()(float v) const { return Of<vtkFloatArray>(&v, 1); }
  vtkSmartPointer<vtkAbstractArray> operator()(double v) const { return Of<vtkDoubleArray>(&v, 1); }
  vtkSmartPointer<vtkAbstractArray> operator()(const std::string& v) const
  {
    return Of<vtkStringArray>(&v, 1);
  }
  vtkSmartPointer<vtkAbstractArray> operator()(const std::vector<std::string>& v) const
  {
    return Of<vtkStringArray>(v.data(), v.size());
  }
  vtkSmartPointer<vtkAbstractArray> operator()(const std::array<double, 3>& v) const
  {
    return Of<vtkDoubleArray>(v.data(), v.size());
  }
  template <typename Floats>
  vtkSmartPointer<vtkAbstractArray> operator()(const Floats& v) const
  {
    return Of<vtkFloatArray>(v.data(), v.size());
  }
};

void AddWindow(vtkFieldData* field, const char* name, const io::ExrBox& box)
{
  const int values[4] = { box.XMin, box.YMin, box.XMax, box.YMax };
  auto array = AsArray::Of<vtkIntArray>(values, 4);
  array->SetName(name);
  field->AddArray(array);
}

void AddText(vtkFieldData* field, const char* name, const std::string& text)
{
  if (!text.empty())
  {
    auto array = AsArray()(text);
    array->SetName(name);
    field->AddArray(array);
  }
}

/// The number of the part to read.
std::size_t Choose(
  const std::string& file, const io::ExrImage& image, int part, const std::string& name)
{
  std::string known;
  for (std::size_t i = 0; i < image.size(); ++i)
  {
    if (!name.empty() && image[i].Name == name)
    {
      return i;
    }
    known += (i ? ", '" : "'") + image[i].Name + "'";
  }
  if (!name.empty())
  {
    throw io::FileError(file, "PartName = '" + name + "': the parts are " + known);
  }
  if (part >= static_cast<int>(image.size()))
  {
    throw io::FileError(file,
      "Part = " + std::to_string(part) + ": expected 0 to " + std::to_string(image.size() - 1));
  }
  return static_cast<std::size_t>(part);
}

} // namespace

vtkStandardNewMacro(vtkOpenEXRReader);

//------------------------------------------------------------------------------
vtkOpenEXRReader::vtkOpenEXRReader() { this->SetNumberOfInputPorts(0); }

vtkOpenEXRReader::~vtkOpenEXRReader() { this->SetFileName(nullptr); }

//------------------------------------------------------------------------------
void vtkOpenEXRReader::SetPartName(const char* name)
{
  const std::string wanted = name ? name : "";
  if (wanted != this->WantedName)
  {
    this->WantedName = wanted;
    this->Modified();
  }
}

std::string vtkOpenEXRReader::GetPartName(int part) const
{
  return part >= 0 && part < this->GetNumberOfParts() ? this->PartNames[part] : std::string();
}

//------------------------------------------------------------------------------
int vtkOpenEXRReader::CanReadFile(const char* fileName)
{
  try
  {
    return fileName && !io::ReadExrHeaders(fileName).empty();
  }
  catch (const io::FileError&)
  {
    return 0;
  }
}

//------------------------------------------------------------------------------
int vtkOpenEXRReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  io::ExrReadOptions options;
  options.MemoryLimit = static_cast<std::uint64_t>(this->MemoryLimit) << 20;
  try
  {
    const std::string file = this->FileName ? this->FileName : "";
    const io::ExrImage image = io::ReadExrHeaders(file, options);
    this->PartNames.clear();
    for (const io::ExrPart& part : image)
    {
      this->PartNames.push_back(part.Name);
    }
    const io::ExrPart& part = image[Choose(file, image, this->Part, this->WantedName)];
    this->PartName = part.Name;
    const io::ExrBox& w = part.DataWindow;
    vtkInformation* info = outputs->GetInformationObject(0);
    int extent[6] = { 0, static_cast<int>(w.Width()) - 1, 0, static_cast<int>(w.Height()) - 1, 0,
      0 };
    info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
    info->Set(
      vtkDataObject::SPACING(), part.PixelAspectRatio > 0 ? part.PixelAspectRatio : 1.0, 1.0, 1.0);
    info->Set(vtkDataObject::ORIGIN(), double(w.XMin) - part.DisplayWindow.XMin,
      double(part.DisplayWindow.YMax) - w.YMax, 0.0);
    return 1;
  }
  catch (const io::FileError& e)
  {
    vtkErrorMacro(<< e.what());
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
    this->PartNames.clear();
    return 0;
  }
}

//------------------------------------------------------------------------------
int vtkOpenEXRReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkImageData* output = vtkImageData::GetData(outputs);
  vtkInformation* info = outputs->GetInformationObject(0);
  output->Initialize();
  io::ExrReadOptions options;
  options.MemoryLimit = static_cast<std::uint64_t>(this->MemoryLimit) << 20;
  options.KeepNonFinite = this->KeepNonFinite;
  io::ExrImage image;
  try
  {
    const std::string file = this->FileName ? this->FileName : "";
    image = io::ReadExr(file, options);
    image = { image[Choose(file, image, this->Part, this->WantedName)] };
    if (this->ColorSpace == LinearRec709)
    {
      io::ConvertToRec709(file, image[0]);
    }
  }
  catch (const io::FileError& e)
  {
    vtkErrorMacro(<< e.what());
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
    return 0;
  }
  const io::ExrPart& part = image[0];
  const int width = static_cast<int>(part.DataWindow.Width());
  const int height = static_cast<int>(part.DataWindow.Height());
  output->SetExtent(0, width - 1, 0, height - 1, 0, 0);
  output->SetSpacing(info->Get(vtkDataObject::SPACING()));
  output->SetOrigin(info->Get(vtkDataObject::ORIGIN()));

  vtkPointData* points = output->GetPointData();
  for (const Group& group : GroupChannels(part))
  {
    const bool whole = group.Channels[0]->Kind == io::ExrChannel::Memory::UInt32;
    const vtkSmartPointer<vtkDataArray> array = whole
      ? Fill<vtkUnsignedIntArray>(group, width, height)
      : Fill<vtkFloatArray>(group, width, height);
    const bool colour = group.Name == "RGB" || group.Name == "RGBA";
    const auto unit = part.Attributes.find((colour ? "RGB" : group.Name) + ".units");
    if (unit != part.Attributes.end() && std::holds_alternative<std::string>(unit->second))
    {
      array->GetInformation()->Set(
        vtkDataArray::UNITS_LABEL(), std::get<std::string>(unit->second).c_str());
    }
    points->AddArray(array);
    if (!points->GetScalars() && (colour || group.Name == "Y"))
    {
      points->SetActiveScalars(group.Name.c_str());
    }
  }
  if (!points->GetScalars() && points->GetNumberOfArrays() > 0)
  {
    points->SetActiveScalars(points->GetArrayName(0));
  }
  vtkFieldData* field = output->GetFieldData();
  for (const auto& [name, value] : part.Attributes)
  {
    const vtkSmartPointer<vtkAbstractArray> array = std::visit(AsArray(), value);
    array->SetName(name.c_str());
    field->AddArray(array);
  }
  AddWindow(field, "dataWindow", part.DataWindow);
  AddWindow(field, "displayWindow", part.DisplayWindow);
  AddText(field, "name", part.Name);
  AddText(field, "view", part.View);
  return 1;
}

//------------------------------------------------------------------------------
void vtkOpenEXRReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n"
     << indent << "Part: " << this->Part << "\n"
     << indent << "PartName: " << this->WantedName << "\n"
     << indent << "ColorSpace: " << this->ColorSpace << " (0 as stored, 1 linear Rec.709)\n"
     << indent << "KeepNonFinite: " << this->KeepNonFinite << "\n"
     << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
}
