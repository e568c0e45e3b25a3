// SPDX-License-Identifier: BSD-3-Clause
#include "io/ExrColor.h"

#include <ImathMatrix.h>
#include <cmath>

namespace radiometry::io
{
namespace
{

/// Columns: XYZ of red, green and blue, scaled so that they add up to white of Y = 1. (Imath's
/// vectors multiply from the left: its rows are these columns.)
Imath::M33d RgbToXyz(const std::string& file, const ExrChromaticities& xy)
{
  const auto fail = [&] {
    throw FileError(file, "its chromaticities make no colour space");
  };
  Imath::M33d primaries;
  for (int i = 0; i < 3; ++i)
  {
    const double x = xy[2 * i];
    const double y = xy[2 * i + 1];
    const double row[3] = { x, y, 1.0 - x - y };
    for (int j = 0; j < 3; ++j)
    {
      primaries[i][j] = row[j];
    }
  }
  const double wx = xy[6];
  const double wy = xy[7];
  const double determinant = primaries.determinant();
  if (!std::isfinite(determinant) || std::abs(determinant) < 1e-9 || !(std::abs(wy) > 1e-9) ||
    !std::isfinite(wx))
  {
    fail();
  }
  const Imath::V3d white(wx / wy, 1.0, (1.0 - wx - wy) / wy);
  const Imath::V3d scale = white * primaries.inverse();
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      primaries[i][j] *= scale[i];
    }
  }
  if (std::abs(primaries.determinant()) < 1e-12)
  {
    fail();
  }
  return primaries;
}

} // namespace

ExrChromaticities ChromaticitiesOf(const ExrPart& part)
{
  const auto found = part.Attributes.find("chromaticities");
  const auto* said = found == part.Attributes.end()
    ? nullptr
    : std::get_if<ExrChromaticities>(&found->second);
  return said ? *said : Rec709Chromaticities();
}

void ConvertToRec709(const std::string& fileName, ExrPart& part)
{
  ExrChannel* channels[3] = { nullptr, nullptr, nullptr };
  for (ExrChannel& channel : part.Channels)
  {
    for (int i = 0; i < 3; ++i)
    {
      channels[i] = channel.Name == std::string(1, "RGB"[i]) ? &channel : channels[i];
    }
  }
  const ExrChromaticities from = ChromaticitiesOf(part);
  const ExrChromaticities to = Rec709Chromaticities();
  for (const ExrChannel* channel : channels)
  {
    if (!channel || !channel->Data || channel->XSampling != 1 || channel->YSampling != 1)
    {
      return;
    }
  }
  bool same = true;
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    same = same && std::abs(from[i] - to[i]) < 1e-6f;
  }
  if (same)
  {
    return;
  }
  const Imath::M33d matrix = RgbToXyz(fileName, from) * RgbToXyz(fileName, to).inverse();
  const long long width = part.DataWindow.Width();
  const long long height = part.DataWindow.Height();
  std::shared_ptr<std::vector<float>> values[3];
  for (auto& v : values)
  {
    v = std::make_shared<std::vector<float>>();
    v->reserve(static_cast<std::size_t>(width * height));
  }
  for (long long y = 0; y < height; ++y)
  {
    for (long long x = 0; x < width; ++x)
    {
      const Imath::V3d rgb =
        Imath::V3d(channels[0]->At(x, y), channels[1]->At(x, y), channels[2]->At(x, y)) * matrix;
      for (int i = 0; i < 3; ++i)
      {
        values[i]->push_back(static_cast<float>(rgb[i]));
      }
    }
  }
  for (int i = 0; i < 3; ++i)
  {
    const std::string name = channels[i]->Name;
    *channels[i] = ExrChannel::View(name, values[i]->data(), static_cast<int>(width));
    channels[i]->Owner = values[i];
  }
  part.Attributes["chromaticities"] = to;
}

} // namespace radiometry::io
