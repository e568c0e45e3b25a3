// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenEXRWriter.h"

#include "OpenEXRAssembly.h"
#include "io/ExrWriter.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <cstdio>
#include <vector>

namespace io = radiometry::io;

namespace
{

/// The text of a field array of one string; empty where there is none.
std::string FieldText(vtkDataObject* data, const char* name)
{
  auto* array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
  return array && array->GetNumberOfValues() > 0 ? std::string(array->GetValue(0)) : std::string();
}

} // namespace

/// An image that becomes a part, and the name that its place in composite data gives it.
struct vtkOpenEXRWriter::Picture
{
  vtkImageData* Image;
  std::string Name;
};

vtkStandardNewMacro(vtkOpenEXRWriter);

//------------------------------------------------------------------------------
vtkOpenEXRWriter::vtkOpenEXRWriter()
{
  const io::ExrChromaticities xy = io::Rec709Chromaticities();
  // By way of text: 0.64f as a double is 0.63999998.
  for (int i = 0; i < 8; ++i)
  {
    char number[16];
    std::snprintf(number, sizeof number, "%.4f", xy[i]);
    this->Chromaticities[i] = std::stod(number);
  }
}

vtkOpenEXRWriter::~vtkOpenEXRWriter() { this->SetFileName(nullptr); }

//------------------------------------------------------------------------------
int vtkOpenEXRWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return 1;
}

vtkImageData* vtkOpenEXRWriter::GetImageInput()
{
  return vtkImageData::SafeDownCast(this->GetInput());
}

//------------------------------------------------------------------------------
void vtkOpenEXRWriter::SetArrayPixelType(const char* array, int type)
{
  if (!array || type < Half || type > UInt)
  {
    vtkErrorMacro("SetArrayPixelType: type " << type << ": expected Half, Float or UInt");
    return;
  }
  this->ArrayPixelTypes[array] = type;
  this->Modified();
}

void vtkOpenEXRWriter::ClearArrayPixelTypes()
{
  this->ArrayPixelTypes.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkOpenEXRWriter::AddAttribute(const char* name, const char* value)
{
  if (name && value)
  {
    this->NumberAttributes.erase(name);
    this->TextAttributes[name] = value;
    this->Modified();
  }
}

void vtkOpenEXRWriter::AddAttribute(const char* name, double value)
{
  if (name)
  {
    this->TextAttributes.erase(name);
    this->NumberAttributes[name] = value;
    this->Modified();
  }
}

void vtkOpenEXRWriter::ClearAttributes()
{
  this->TextAttributes.clear();
  this->NumberAttributes.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkOpenEXRWriter::SetPartName(int part, const char* name)
{
  this->PartNames[part] = name ? name : "";
  this->Modified();
}

void vtkOpenEXRWriter::SetPartView(int part, const char* view)
{
  this->PartViews[part] = view ? view : "";
  this->Modified();
}

void vtkOpenEXRWriter::ClearPartNames()
{
  this->PartNames.clear();
  this->PartViews.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
std::vector<vtkOpenEXRWriter::Picture> vtkOpenEXRWriter::GetPictures()
{
  std::vector<Picture> pictures;
  for (int i = 0; i < this->GetNumberOfInputConnections(0); ++i)
  {
    vtkDataObject* data = this->GetInputDataObject(0, i);
    auto* composite = vtkCompositeDataSet::SafeDownCast(data);
    if (!composite)
    {
      pictures.push_back({ vtkImageData::SafeDownCast(data), "" });
      continue;
    }
    const auto iterator = vtk::TakeSmartPointer(composite->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      const char* name = iterator->HasCurrentMetaData()
        ? iterator->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME())
        : nullptr;
      pictures.push_back(
        { vtkImageData::SafeDownCast(iterator->GetCurrentDataObject()), name ? name : "" });
    }
  }
  return pictures;
}

//------------------------------------------------------------------------------
void vtkOpenEXRWriter::WriteData()
{
  const std::vector<Picture> pictures = this->GetPictures();
  std::vector<Assembly> assemblies;
  io::ExrImage image;
  for (const Picture& picture : pictures)
  {
    int dimensions[3] = { 0, 0, 0 };
    if (picture.Image)
    {
      picture.Image->GetDimensions(dimensions);
    }
    if (dimensions[0] < 1 || dimensions[1] < 1 || dimensions[2] != 1)
    {
      vtkErrorMacro("part " << image.size() << ": an image of " << dimensions[0] << " x "
                            << dimensions[1] << " x " << dimensions[2]
                            << " points: expected images of one slice in x and y");
      this->SetErrorCode(vtkErrorCode::FileFormatError);
      return;
    }
    Assembly assembly{ this, {}, {} };
    assembly.Place(picture.Image);
    assembly.AddArrays(picture.Image);
    assembly.AddAttributes(picture.Image);
    const int number = static_cast<int>(image.size());
    const auto given = [number](const std::map<int, std::string>& from) {
      const auto found = from.find(number);
      return found == from.end() ? std::string() : found->second;
    };
    io::ExrPart& part = assembly.Part;
    for (const std::string& name :
      { given(this->PartNames), picture.Name, FieldText(picture.Image, "name"),
        pictures.size() > 1 ? "part" + std::to_string(number) : std::string() })
    {
      part.Name = part.Name.empty() ? name : part.Name;
    }
    part.View = given(this->PartViews);
    part.View = part.View.empty() ? FieldText(picture.Image, "view") : part.View;
    image.push_back(part);
    assemblies.push_back(std::move(assembly));
  }
  try
  {
    io::ExrWriteOptions options;
    options.KeepNonFinite = this->KeepNonFinite;
    io::WriteExr(this->FileName ? this->FileName : "", image, options);
  }
  catch (const io::FileError& e)
  {
    vtkErrorMacro(<< e.what());
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
  }
}

//------------------------------------------------------------------------------
void vtkOpenEXRWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n"
     << indent << "PixelType: " << this->PixelType << "\n"
     << indent << "Compression: " << this->Compression << "\n"
     << indent << "DwaCompressionLevel: " << this->DwaCompressionLevel << "\n"
     << indent << "TileSize: " << this->TileSize << "\n"
     << indent << "WhiteLuminance: " << this->WhiteLuminance << "\n"
     << indent << "WriteFieldData: " << this->WriteFieldData << "\n"
     << indent << "KeepNonFinite: " << this->KeepNonFinite << "\n";
}
