// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/imaging/FalseColor.h"

#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace radiometry
{
namespace imaging
{
namespace
{

constexpr int ContinuousColors = 256;

/// Anchors at equal distances. Viridis and Inferno: nine of the 256 colours of the palettes of that
/// name (van der Walt and Smith 2015, CC0), every 32nd.
std::vector<ByteColor> Anchors(Palette palette)
{
  switch (palette)
  {
    case Palette::Viridis:
      return { { { 68, 1, 84 } }, { { 71, 45, 123 } }, { { 59, 82, 139 } }, { { 44, 114, 142 } },
        { { 33, 145, 140 } }, { { 40, 174, 128 } }, { { 94, 201, 98 } }, { { 173, 220, 48 } },
        { { 253, 231, 37 } } };
    case Palette::Inferno:
      return { { { 0, 0, 4 } }, { { 33, 12, 74 } }, { { 87, 16, 110 } }, { { 138, 34, 106 } },
        { { 188, 55, 84 } }, { { 228, 90, 49 } }, { { 249, 142, 9 } }, { { 249, 203, 53 } },
        { { 252, 255, 164 } } };
    case Palette::Spectrum:
      return { { { 20, 20, 120 } }, { { 20, 70, 230 } }, { { 0, 180, 230 } }, { { 0, 190, 90 } },
        { { 150, 210, 0 } }, { { 250, 220, 0 } }, { { 250, 130, 0 } }, { { 225, 30, 20 } },
        { { 255, 200, 200 } } };
    default:
      return { { { 0, 0, 0 } }, { { 255, 255, 255 } } };
  }
}

void CheckScale(const FalseColorSettings& s)
{
  for (std::size_t i = 0; i < s.Levels.size(); ++i)
  {
    if (!std::isfinite(s.Levels[i]) || (i > 0 && !(s.Levels[i] > s.Levels[i - 1])))
    {
      throw InputError(
        "Levels", static_cast<long long>(i), s.Levels[i], "finite, ascending numbers");
    }
  }
  const bool logarithmic = s.Scale == ColorScale::Logarithmic;
  if (!std::isfinite(s.Minimum) || (logarithmic && !(s.Minimum > 0.0)))
  {
    throw InputError("Minimum", -1, s.Minimum,
      logarithmic ? "a finite number above 0 for a logarithmic scale" : "a finite number");
  }
  if (!std::isfinite(s.Maximum) || !(s.Maximum > s.Minimum))
  {
    throw InputError(
      "Maximum", -1, s.Maximum, "a finite number above the minimum, " + std::to_string(s.Minimum));
  }
  if (s.Steps < 0 || s.Steps > 1000)
  {
    throw InputError("Steps", -1, s.Steps, "0 to 1000");
  }
}

/// The greatest (up: the least) of 1, 2, 5 times powers of ten not above (not below) a number > 0.
double Round125(double value, bool up)
{
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  const double slack = 1e-9 * value;
  if (up)
  {
    for (double factor : { 1.0, 2.0, 5.0 })
    {
      if (factor * power >= value - slack)
      {
        return factor * power;
      }
    }
    return 10.0 * power;
  }
  for (double factor : { 10.0, 5.0, 2.0 })
  {
    if (factor * power <= value + slack)
    {
      return factor * power;
    }
  }
  return power;
}

std::vector<double> LogarithmicLevels(double minimum, double maximum, int wanted)
{
  const double decades = std::log10(maximum / minimum);
  const bool coarse = decades * 3.0 > 1.5 * wanted;
  const int every = std::max(1, static_cast<int>(std::ceil(decades / (1.5 * wanted))));
  std::vector<double> levels;
  const int first = static_cast<int>(std::floor(std::log10(minimum))) - 1;
  const int last = static_cast<int>(std::ceil(std::log10(maximum)));
  for (int p = first; p <= last; ++p)
  {
    for (double factor : { 1.0, 2.0, 5.0 })
    {
      const double level = factor * std::pow(10.0, p);
      const bool used = factor == 1.0 ? !coarse || (p - last) % every == 0 : !coarse;
      if (used && level >= minimum * (1 - 1e-9) && level <= maximum * (1 + 1e-9))
      {
        levels.push_back(level);
      }
    }
  }
  return levels;
}

} // namespace

ByteColor PaletteColor(Palette palette, double t)
{
  static const std::array<std::vector<ByteColor>, 4> all{ { Anchors(Palette::Viridis),
    Anchors(Palette::Inferno), Anchors(Palette::Spectrum), Anchors(Palette::Grey) } };
  const std::vector<ByteColor>& anchors = all[static_cast<std::size_t>(palette)];
  const double position = (t > 0.0 ? std::min(t, 1.0) : 0.0) * (anchors.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(position), anchors.size() - 2);
  const double f = position - static_cast<double>(k);
  ByteColor color;
  for (int c = 0; c < 3; ++c)
  {
    color[c] = static_cast<std::uint8_t>(
      std::lround(anchors[k][c] + f * (double(anchors[k + 1][c]) - anchors[k][c])));
  }
  return color;
}

FalseColorMap::FalseColorMap(const FalseColorSettings& settings)
  : Settings(settings)
{
  const auto& levels = settings.Levels;
  if (levels.size() >= 2) // they are the scale
  {
    this->Settings.Minimum = levels.front();
    this->Settings.Maximum = levels.back();
    this->Settings.Scale = levels.front() > 0.0 ? settings.Scale : ColorScale::Linear;
  }
  CheckScale(this->Settings);
  this->Continuous = levels.size() < 2 && settings.Steps == 0;
  if (levels.size() >= 2)
  {
    this->Limits = levels;
  }
  else
  {
    const int n = settings.Steps > 0 ? settings.Steps : ContinuousColors;
    for (int i = 0; i <= n; ++i)
    {
      this->Limits.push_back(this->Value(double(i) / n));
    }
  }
  const std::size_t colors = this->Limits.size() - 1;
  for (std::size_t i = 0; i < colors; ++i)
  {
    // The ends of a palette are the ends of the legend.
    const double t = colors > 1 ? double(i) / (colors - 1) : 0.5;
    this->Colors.push_back(PaletteColor(settings.Palette, t));
  }
}

double FalseColorMap::Position(double value) const
{
  const double low = this->Settings.Minimum;
  const double high = this->Settings.Maximum;
  double t = 0.0;
  if (this->Settings.Scale == ColorScale::Logarithmic)
  {
    t = value > 0.0 ? std::log(value / low) / std::log(high / low) : 0.0;
  }
  else
  {
    t = (value - low) / (high - low);
  }
  return t > 0.0 ? std::min(t, 1.0) : 0.0;
}

double FalseColorMap::Value(double position) const
{
  const double low = this->Settings.Minimum;
  const double high = this->Settings.Maximum;
  if (position <= 0.0 || position >= 1.0)
  {
    return position <= 0.0 ? low : high;
  }
  return this->Settings.Scale == ColorScale::Logarithmic ? low * std::pow(high / low, position)
                                                         : low + position * (high - low);
}

std::size_t FalseColorMap::Band(double value) const
{
  // The limits decide, so that a colour and its row of the legend never disagree.
  const auto above = std::upper_bound(this->Limits.begin(), this->Limits.end(), value);
  const auto i = static_cast<std::size_t>(above - this->Limits.begin());
  return std::min(i == 0 ? 0 : i - 1, this->Colors.size() - 1);
}

ByteColor FalseColorMap::Color(double value) const
{
  return std::isfinite(value) ? this->Colors[this->Band(value)] : this->Settings.NotFinite;
}

std::pair<double, double> ChooseRange(const std::vector<double>& values, ColorScale scale)
{
  const bool logarithmic = scale == ColorScale::Logarithmic;
  bool any = false;
  double least = 0.0;
  double greatest = 0.0;
  for (double v : values)
  {
    if (std::isfinite(v) && (v > 0.0 || !logarithmic))
    {
      least = any ? std::min(least, v) : v;
      greatest = any ? std::max(greatest, v) : v;
      any = true;
    }
  }
  if (logarithmic)
  {
    if (!any)
    {
      return { 0.1, 1.0 };
    }
    const double high = Round125(greatest, true);
    const double low = Round125(std::max(least, 1e-5 * greatest), false);
    return { low < high ? low : 0.1 * high, high };
  }
  if (!any || greatest - least <= 1e-12 * std::max(std::abs(least), std::abs(greatest)))
  {
    const double size = std::abs(least);
    return any && size > 0.0
      ? std::pair<double, double>(std::min(0.0, 2 * least), std::max(0.0, 2 * least))
      : std::pair<double, double>(0.0, 1.0);
  }
  const double step = Round125((greatest - least) / 10.0, true);
  return { std::floor(least / step + 1e-9) * step, std::ceil(greatest / step - 1e-9) * step };
}

std::vector<double> RoundLevels(double minimum, double maximum, ColorScale scale, int wanted)
{
  if (!(minimum < maximum) || wanted < 1 || !std::isfinite(maximum - minimum))
  {
    return {};
  }
  if (scale == ColorScale::Logarithmic && minimum > 0.0)
  {
    return LogarithmicLevels(minimum, maximum, wanted);
  }
  const double step = Round125((maximum - minimum) / wanted, true);
  std::vector<double> levels;
  const auto last = static_cast<long long>(std::floor(maximum / step + 1e-9));
  for (auto k = static_cast<long long>(std::ceil(minimum / step - 1e-9)); k <= last; ++k)
  {
    levels.push_back(static_cast<double>(k) * step);
  }
  return levels;
}

std::vector<std::uint8_t> IsoLinePixels(
  const std::vector<double>& values, int width, int height, const std::vector<double>& levels)
{
  std::vector<int> band(values.size());
  std::transform(values.begin(), values.end(), band.begin(), [&](double v) {
    return std::isfinite(v)
      ? static_cast<int>(std::upper_bound(levels.begin(), levels.end(), v) - levels.begin())
      : -1;
  });
  const auto differ = [&](std::size_t a, std::size_t b) {
    return band[a] >= 0 && band[b] >= 0 && band[a] != band[b];
  };
  std::vector<std::uint8_t> lines(values.size(), 0);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      const bool right = x + 1 < width && differ(i, i + 1);
      const bool above = y + 1 < height && differ(i, i + width);
      lines[i] = right || above ? 1 : 0;
    }
  }
  return lines;
}

} // namespace imaging
} // namespace radiometry
