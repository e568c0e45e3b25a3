// SPDX-License-Identifier: BSD-3-Clause
#include "io/ExrColor.h"

#include "io/ExrHeader.h"

#include <ImathMatrix.h>
#include <algorithm>
#include <cmath>

namespace radiometry::io
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

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

/// The samples of a channel along one axis at every pixel from `min` on, where samples are at the
/// multiples of `sampling`.
class Interpolation
{
public:
  Interpolation(int sampling, int min, long long samples)
    : Sampling(sampling)
    , Offset(((min % sampling) + sampling) % sampling) // of the first pixel behind a sample's place
    , Samples(samples)
  {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const double angle = Pi * (2 * k + 1) / 2.0; // distances of 1/2, 3/2, 5/2 samples
      this->Weights[k] = std::sin(angle) / angle * std::sin(angle / 3.0) / (angle / 3.0);
      sum += 2.0 * this->Weights[k];
    }
    for (double& weight : this->Weights)
    {
      weight /= sum;
    }
  }

  template <typename Sample>
  double At(long long pixel, const Sample& sample) const
  {
    const long long place = pixel + this->Offset;
    // The first sample is the one at or after the first pixel.
    const long long below = place / this->Sampling - (this->Offset > 0 ? 1 : 0);
    const auto clamped = [&](long long i) { return sample(std::clamp(i, 0LL, this->Samples - 1)); };
    if (this->Sampling != 2 || place % 2 == 0)
    {
      return clamped(below);
    }
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      sum += this->Weights[k] * (clamped(below - k) + clamped(below + 1 + k));
    }
    return sum;
  }

private:
  const int Sampling;
  const long long Offset;
  const long long Samples;
  double Weights[3];
};

/// A channel at every pixel: first along the rows, then along the columns.
std::vector<float> FullSize(const ExrPart& part, const ExrChannel& channel)
{
  const ExrBox& w = part.DataWindow;
  const auto width = static_cast<std::size_t>(w.Width());
  const long long columns = CountSamples(channel.XSampling, w.XMin, w.XMax);
  const long long rows = CountSamples(channel.YSampling, w.YMin, w.YMax);
  const Interpolation across(channel.XSampling, w.XMin, columns);
  const Interpolation down(channel.YSampling, w.YMin, rows);
  std::vector<float> lines(width * static_cast<std::size_t>(rows));
  for (long long j = 0; j < rows; ++j)
  {
    for (std::size_t x = 0; x < width; ++x)
    {
      lines[static_cast<std::size_t>(j) * width + x] = static_cast<float>(across.At(
        static_cast<long long>(x), [&](long long i) { return channel.At(i, j); }));
    }
  }
  std::vector<float> full(width * static_cast<std::size_t>(w.Height()));
  for (std::size_t y = 0; y < static_cast<std::size_t>(w.Height()); ++y)
  {
    for (std::size_t x = 0; x < width; ++x)
    {
      full[y * width + x] = static_cast<float>(down.At(static_cast<long long>(y),
        [&](long long j) { return lines[static_cast<std::size_t>(j) * width + x]; }));
    }
  }
  return full;
}

} // namespace

void DecodeLuminanceChroma(const std::string& fileName, ExrPart& part)
{
  const ExrChannel* luminance = part.Find("Y");
  const ExrChannel* chroma[2] = { part.Find("RY"), part.Find("BY") };
  if (!luminance || !chroma[0] || !chroma[1] || part.Find("R"))
  {
    return;
  }
  const Imath::M33d toXyz = RgbToXyz(fileName, ChromaticitiesOf(part));
  const double weights[3] = { toXyz[0][1], toXyz[1][1], toXyz[2][1] };
  if (!(std::abs(weights[1]) > 1e-9))
  {
    throw FileError(fileName, "its chromaticities give green no luminance");
  }
  const std::vector<float> y = FullSize(part, *luminance);
  const std::vector<float> ry = FullSize(part, *chroma[0]);
  const std::vector<float> by = FullSize(part, *chroma[1]);
  auto values = std::array<std::shared_ptr<std::vector<float>>, 3>{};
  for (auto& v : values)
  {
    v = std::make_shared<std::vector<float>>(y.size());
  }
  for (std::size_t k = 0; k < y.size(); ++k)
  {
    const double red = (1.0 + ry[k]) * y[k];
    const double blue = (1.0 + by[k]) * y[k];
    (*values[0])[k] = static_cast<float>(red);
    (*values[1])[k] = static_cast<float>((y[k] - weights[0] * red - weights[2] * blue) / weights[1]);
    (*values[2])[k] = static_cast<float>(blue);
  }
  part.Channels.erase(std::remove_if(part.Channels.begin(), part.Channels.end(),
                        [](const ExrChannel& channel) {
                          return channel.Name == "Y" || channel.Name == "RY" ||
                            channel.Name == "BY";
                        }),
    part.Channels.end());
  for (int i = 0; i < 3; ++i)
  {
    ExrChannel channel = ExrChannel::View(std::string(1, "RGB"[i]), values[i]->data(),
      static_cast<int>(part.DataWindow.Width()));
    channel.Owner = values[i];
    part.Channels.push_back(channel);
  }
}

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
