// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentPicture.h"

#include "io/ExrColor.h"
#include "io/ExrEnvironment.h"
#include "io/ExrReader.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#include <vector>

namespace io = radiometry::io;
using radiometry::InputError;
using radiometry::SkyRadiance;

namespace
{

std::shared_ptr<const SkyRadiance> MakeMap(
  int width, int height, int bands, std::vector<double> values, bool grey)
{
  // Checked with the bands as they are in the picture.
  auto map = SkyRadiance::Map(width, height, bands, values);
  if (!grey || bands == 1)
  {
    return map;
  }
  std::vector<double> luminance(static_cast<std::size_t>(width) * height);
  for (std::size_t p = 0; p < luminance.size(); ++p)
  {
    luminance[p] = radiometry::units::Photometric(&values[p * bands], bands, 1.0);
  }
  return SkyRadiance::Map(width, height, 1, std::move(luminance));
}

} // namespace

std::shared_ptr<const SkyRadiance> ReadPicture(const std::string& file, bool grey)
{
  io::ExrImage image;
  try
  {
    image = io::ReadExr(file);
    if (!image.empty())
    {
      image[0] = io::ToLatLong(file, image[0]);
      io::ConvertToRec709(file, image[0]);
    }
  }
  catch (const io::FileError& error)
  {
    throw InputError("FileName", -1, error.what(), "an OpenEXR picture, lat-long or a cube map");
  }
  if (image.empty() || image[0].Channels.empty())
  {
    throw InputError("FileName", -1, file, "a picture with a channel");
  }
  const io::ExrPart& part = image[0];
  std::vector<const io::ExrChannel*> channels{ part.Find("R"), part.Find("G"), part.Find("B") };
  if (!channels[0] || !channels[1] || !channels[2])
  {
    channels = { part.Find("Y") ? part.Find("Y") : &part.Channels.front() };
  }
  const auto width = static_cast<int>(part.DataWindow.Width());
  const auto height = static_cast<int>(part.DataWindow.Height());
  const auto bands = static_cast<int>(channels.size());
  std::vector<double> values(static_cast<std::size_t>(width) * height * bands);
  std::size_t at = 0;
  for (int j = 0; j < height; ++j)
  {
    for (int i = 0; i < width; ++i)
    {
      for (const io::ExrChannel* channel : channels)
      {
        values[at++] = channel->At(i / channel->XSampling, j / channel->YSampling);
      }
    }
  }
  return MakeMap(width, height, bands, std::move(values), grey);
}

std::shared_ptr<const SkyRadiance> PictureOf(vtkImageData* image, bool grey)
{
  auto* kind = vtkStringArray::SafeDownCast(image->GetFieldData()->GetAbstractArray("envmap"));
  if (kind && kind->GetNumberOfValues() > 0 && kind->GetValue(0) == "cube")
  {
    throw InputError("Input", -1, "a cube map", "a lat-long picture (or FileName)");
  }
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  int size[3];
  image->GetDimensions(size);
  if (!scalars || size[2] != 1)
  {
    throw InputError("Input", -1, scalars ? "a volume" : "no point scalars",
      "a flat picture with point scalars");
  }
  const int components = scalars->GetNumberOfComponents();
  const int bands = components == 4 ? 3 : components;
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(size[0]) * size[1] * bands);
  for (int j = size[1] - 1; j >= 0; --j)
  {
    for (int i = 0; i < size[0]; ++i)
    {
      for (int b = 0; b < bands; ++b)
      {
        values.push_back(scalars->GetComponent(static_cast<vtkIdType>(j) * size[0] + i, b));
      }
    }
  }
  return MakeMap(size[0], size[1], bands, std::move(values), grey);
}
