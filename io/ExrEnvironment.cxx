// SPDX-License-Identifier: BSD-3-Clause
#include "io/ExrEnvironment.h"

#include <ImfEnvmap.h>
#include <algorithm>
#include <cmath>

namespace radiometry::io
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/// Where a direction lies in a cube map: four pixels and their weights.
struct Lookup
{
  std::ptrdiff_t At[4];
  double Weight[4];
};

/// Bilinear within the face; a place beyond the middles of its outermost pixels has theirs.
Lookup Find(const Imath::V3f& direction, const Imath::Box2i& window, int face)
{
  Imf::CubeMapFace which = Imf::CUBEFACE_POS_X;
  Imath::V2f at;
  Imf::CubeMap::faceAndPixelPosition(direction, window, which, at);
  const double x = std::clamp<double>(at.x, 0.0, face - 1);
  const double y = std::clamp<double>(at.y, 0.0, face - 1);
  const int x0 = std::min(static_cast<int>(x), std::max(face - 2, 0));
  const int y0 = std::min(static_cast<int>(y), std::max(face - 2, 0));
  Lookup lookup;
  for (int k = 0; k < 4; ++k)
  {
    const int i = std::min(x0 + (k & 1), face - 1);
    const int j = std::min(y0 + (k >> 1), face - 1);
    const Imath::V2f pixel = Imf::CubeMap::pixelPosition(
      which, window, Imath::V2f(static_cast<float>(i), static_cast<float>(j)));
    lookup.At[k] = static_cast<std::ptrdiff_t>(std::lround(pixel.y)) * face + std::lround(pixel.x);
    lookup.Weight[k] = ((k & 1) ? x - x0 : 1.0 - (x - x0)) * ((k >> 1) ? y - y0 : 1.0 - (y - y0));
  }
  return lookup;
}

} // namespace

std::string EnvironmentKind(const ExrPart& part)
{
  const auto found = part.Attributes.find("envmap");
  const auto* kind =
    found == part.Attributes.end() ? nullptr : std::get_if<std::string>(&found->second);
  return kind ? *kind : "";
}

ExrPart ToLatLong(const std::string& fileName, const ExrPart& part)
{
  if (EnvironmentKind(part) != "cube")
  {
    return part;
  }
  const long long side = part.DataWindow.Width();
  if (part.DataWindow.Height() != 6 * side || side > 8192)
  {
    throw FileError(fileName,
      "a cube map of " + std::to_string(side) + " x " + std::to_string(part.DataWindow.Height()) +
        " pixels: expected six square faces below each other, of at most 8192");
  }
  const int face = static_cast<int>(side);
  const Imath::Box2i cube{ { 0, 0 }, { face - 1, 6 * face - 1 } };
  const int width = 4 * face;
  const int height = 2 * face;

  ExrPart result = part;
  result.DataWindow = ExrBox::OfSize(width, height);
  result.DisplayWindow = {};
  result.Attributes["envmap"] = std::string("latlong");
  std::vector<std::shared_ptr<std::vector<float>>> values;
  for (ExrChannel& channel : result.Channels)
  {
    if (channel.XSampling != 1 || channel.YSampling != 1)
    {
      throw FileError(fileName, "channel '" + channel.Name + "' of a cube map is sub-sampled");
    }
    values.push_back(std::make_shared<std::vector<float>>(
      static_cast<std::size_t>(width) * static_cast<std::size_t>(height)));
  }
  const int sub = face >= 512 ? 2 : 4;
  std::vector<double> sums(values.size());
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      std::fill(sums.begin(), sums.end(), 0.0);
      for (int s = 0; s < sub * sub; ++s)
      {
        const double latitude = Pi * (0.5 - (y + (s / sub + 0.5) / sub) / height);
        const double longitude = Pi * (1.0 - 2.0 * (x + (s % sub + 0.5) / sub) / width);
        const Lookup lookup = Find(
          Imath::V3f(static_cast<float>(std::sin(longitude) * std::cos(latitude)),
            static_cast<float>(std::sin(latitude)),
            static_cast<float>(std::cos(longitude) * std::cos(latitude))),
          cube, face);
        for (std::size_t c = 0; c < sums.size(); ++c)
        {
          for (int k = 0; k < 4; ++k)
          {
            if (lookup.Weight[k] > 0.0) // an infinity beside it is none of its business
            {
              sums[c] +=
                lookup.Weight[k] * part.Channels[c].At(lookup.At[k] % face, lookup.At[k] / face);
            }
          }
        }
      }
      for (std::size_t c = 0; c < sums.size(); ++c)
      {
        (*values[c])[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
          static_cast<std::size_t>(x)] = static_cast<float>(sums[c] / (sub * sub));
      }
    }
  }
  for (std::size_t c = 0; c < values.size(); ++c)
  {
    const std::string name = result.Channels[c].Name;
    result.Channels[c] = ExrChannel::View(name, values[c]->data(), width);
    result.Channels[c].Owner = values[c];
  }
  return result;
}

} // namespace radiometry::io
