// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/imaging/Exposure.h"

#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

namespace radiometry
{
namespace imaging
{
namespace
{

double Positive(const char* name, double value, const char* unit)
{
  if (!(value > 0.0) || !std::isfinite(value))
  {
    throw InputError(name, -1, value, std::string("a finite number above 0") + unit);
  }
  return value;
}

double Finite(const char* name, double value, const char* unit)
{
  if (!std::isfinite(value))
  {
    throw InputError(name, -1, value, std::string("a finite number") + unit);
  }
  return value;
}

int Colors(int components) { return components >= 3 ? 3 : 1; }

bool HasAlpha(int components) { return components == 2 || components == 4; }

/// The gain that brings a measured luminance to a level; 0 without light.
double GainTo(double level, double perUnit, double measured)
{
  return measured > 0.0 ? level * perUnit / measured : 0.0;
}

double KeyGain(const std::vector<double>& luminances, double perUnit, const ExposureSettings& s)
{
  return GainTo(Positive("KeyValue", s.KeyValue, ""), perUnit, Summarise(luminances).GeometricMean);
}

double PercentileGain(
  const std::vector<double>& luminances, double perUnit, const ExposureSettings& s)
{
  return GainTo(Positive("PercentileLevel", s.PercentileLevel, ""), perUnit,
    LuminancePercentile(luminances, s.Percentile));
}

/// 0 where there is no light to measure.
double GainWithoutCompensation(
  const std::vector<double>& luminances, double perUnit, const ExposureSettings& s)
{
  switch (s.Mode)
  {
    case ExposureMode::ExposureValue:
      return perUnit /
        (SaturationLuminance * std::exp2(Finite("ExposureValue", s.ExposureValue, "")));
    case ExposureMode::Camera:
      return perUnit /
        (SaturationLuminance * std::exp2(ExposureValue(s.FNumber, s.ShutterTime, s.IsoSpeed)));
    case ExposureMode::KeyValue:
      return KeyGain(luminances, perUnit, s);
    case ExposureMode::Percentile:
      return PercentileGain(luminances, perUnit, s);
    case ExposureMode::Automatic:
    {
      const double key = KeyGain(luminances, perUnit, s);
      const double bright = PercentileGain(luminances, perUnit, s);
      return bright > 0.0 ? std::min(key, bright) : key; // a few lights in the dark
    }
    default:
      return 1.0;
  }
}

} // namespace

double ExposureValue(double fNumber, double shutterTime, double isoSpeed)
{
  const double n = Positive("FNumber", fNumber, "");
  const double t = Positive("ShutterTime", shutterTime, " of seconds");
  const double s = Positive("IsoSpeed", isoSpeed, "");
  return 2.0 * std::log2(n) - std::log2(t) + std::log2(100.0 / s);
}

double MeteredExposureValue(double luminance)
{
  return std::log2(Positive("Luminance", luminance, " of cd/m^2") * (100.0 / MeterConstant));
}

std::vector<double> PixelLuminances(
  const double* pixels, std::size_t count, int components, double perUnit)
{
  const std::vector<double> weights = units::LuminanceWeights(Colors(components));
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> luminances(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const double* p = pixels + i * components;
    const double alpha = HasAlpha(components) ? p[components - 1] : 1.0;
    double sum = 0.0;
    for (std::size_t c = 0; c < weights.size(); ++c)
    {
      sum += weights[c] * p[c];
    }
    const double luminance = perUnit * sum / alpha;
    luminances[i] = alpha > 0.0 && std::isfinite(luminance) ? luminance : nothing;
  }
  return luminances;
}

LuminanceSummary Summarise(const std::vector<double>& luminances)
{
  LuminanceSummary s;
  s.Pixels = luminances.size();
  double sum = 0.0;
  double logarithms = 0.0;
  std::size_t positive = 0;
  s.Maximum = -std::numeric_limits<double>::infinity();
  s.Minimum = std::numeric_limits<double>::infinity();
  for (double l : luminances)
  {
    if (!std::isfinite(l))
    {
      ++s.NonFinite;
      continue;
    }
    sum += l;
    s.Maximum = std::max(s.Maximum, l);
    if (l > 0.0)
    {
      ++positive;
      logarithms += std::log2(l);
      s.Minimum = std::min(s.Minimum, l);
    }
  }
  const std::size_t finite = s.Pixels - s.NonFinite;
  s.NotPositive = finite - positive;
  s.Mean = finite > 0 ? sum / finite : 0.0;
  s.Maximum = finite > 0 ? s.Maximum : 0.0;
  s.Minimum = positive > 0 ? s.Minimum : 0.0;
  s.GeometricMean = positive > 0 ? std::exp2(logarithms / positive) : 0.0;
  return s;
}

double LuminancePercentile(const std::vector<double>& luminances, double percent)
{
  if (!(percent >= 0.0 && percent <= 100.0))
  {
    throw InputError("Percentile", -1, percent, "a number of percent in [0, 100]");
  }
  std::vector<double> finite;
  std::copy_if(luminances.begin(), luminances.end(), std::back_inserter(finite),
    [](double l) { return std::isfinite(l); });
  if (finite.empty())
  {
    return 0.0;
  }
  const double position = percent / 100.0 * static_cast<double>(finite.size() - 1);
  const auto below = static_cast<std::ptrdiff_t>(position);
  const double fraction = position - static_cast<double>(below);
  std::nth_element(finite.begin(), finite.begin() + below, finite.end());
  const double low = finite[below];
  if (!(fraction > 0.0))
  {
    return low;
  }
  const double high = *std::min_element(finite.begin() + below + 1, finite.end());
  return low + fraction * (high - low);
}

ChosenExposure ChooseExposure(
  const std::vector<double>& luminances, double perUnit, const ExposureSettings& settings)
{
  Positive("LuminancePerUnit", perUnit, " of cd/m^2");
  ChosenExposure chosen;
  const double gain = GainWithoutCompensation(luminances, perUnit, settings);
  chosen.NoLight = gain == 0.0;
  chosen.Gain = (chosen.NoLight ? 1.0 : gain) *
    std::exp2(Finite("Compensation", settings.Compensation, " of stops"));
  if (!(chosen.Gain > 0.0) || !std::isfinite(chosen.Gain))
  {
    throw InputError("ExposureValue", -1, chosen.Gain, "a gain that is above 0 and finite");
  }
  chosen.Stops = std::log2(chosen.Gain);
  chosen.ExposureValue = std::log2(perUnit / (SaturationLuminance * chosen.Gain));
  return chosen;
}

std::size_t ApplyGain(double* pixels, std::size_t count, int components, double gain, bool repair)
{
  const int colors = Colors(components);
  double greatest = 0.0;
  for (std::size_t i = 0; i < count && repair; ++i)
  {
    for (int c = 0; c < colors; ++c)
    {
      const double v = pixels[i * components + c];
      greatest = std::isfinite(v) ? std::max(greatest, v) : greatest;
    }
  }
  std::size_t nonFinite = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    bool finite = true;
    for (int c = 0; c < colors; ++c)
    {
      double& v = pixels[i * components + c];
      if (!std::isfinite(v))
      {
        finite = false;
        v = repair ? (v > 0.0 ? greatest : 0.0) : v;
      }
      v *= gain;
    }
    nonFinite += finite ? 0 : 1;
  }
  return nonFinite;
}

} // namespace imaging
} // namespace radiometry
