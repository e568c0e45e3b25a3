// SPDX-License-Identifier: BSD-3-Clause
#include "PicturePixels.h"

#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkPointData.h"

using radiometry::InputError;

namespace
{

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

} // namespace

vtkDataArray* FindPicture(vtkImageData* image, const std::string& name, vtkDataArray* chosen)
{
  vtkPointData* data = image->GetPointData();
  if (!name.empty())
  {
    if (vtkDataArray* array = data->GetArray(name.c_str()))
    {
      return array;
    }
    throw InputError(name, -1, "no such array", "a point array of the image");
  }
  for (vtkDataArray* array : { chosen, data->GetScalars(), data->GetArray("RGB"),
         data->GetArray("RGBA"), data->GetArray(0) })
  {
    if (array && array->GetNumberOfTuples() == image->GetNumberOfPoints())
    {
      return array;
    }
  }
  throw InputError("Colors", -1, "no point array", "an image with one");
}

PicturePixels ReadPicture(
  vtkImageData* image, const std::string& name, vtkDataArray* chosen, int mostComponents)
{
  PicturePixels pixels;
  int size[3];
  image->GetDimensions(size);
  if (size[2] != 1 || size[0] < 1 || size[1] < 1)
  {
    throw InputError("Dimensions", 2, double(size[2]), "a picture: one layer of x and y");
  }
  vtkDataArray* array = FindPicture(image, name, chosen);
  pixels.Name = array->GetName() ? array->GetName() : "";
  pixels.Width = size[0];
  pixels.Height = size[1];
  pixels.Components = array->GetNumberOfComponents();
  if (pixels.Components > mostComponents)
  {
    throw InputError(pixels.Name, -1, std::to_string(pixels.Components) + " components",
      "at most " + std::to_string(mostComponents));
  }
  vtkInformation* info = array->GetInformation();
  if (info->Has(vtkDataArray::UNITS_LABEL()))
  {
    pixels.Unit = info->Get(vtkDataArray::UNITS_LABEL());
  }
  const double one = UnitOf(array->GetDataType());
  pixels.Values.resize(pixels.Count() * pixels.Components);
  for (std::size_t i = 0; i < pixels.Count(); ++i)
  {
    array->GetTuple(static_cast<vtkIdType>(i), &pixels.Values[i * pixels.Components]);
  }
  for (double& value : pixels.Values)
  {
    value /= one;
  }
  return pixels;
}

double LuminancePerUnit(const std::string& unit)
{
  for (const char* word : { "cd", "lx", "lm" })
  {
    if (unit.compare(0, 2, word) == 0)
    {
      return 1.0;
    }
  }
  return radiometry::units::MaximumLuminousEfficacy;
}
