// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/accuracy/ErrorCurve.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace radiometry
{

namespace
{

/// Of the longest run to the shortest: below it, times differ by chance.
constexpr double LeastSpan = 1.5;
constexpr std::size_t LeastPoints = 3; // through two there is always a line
constexpr double FlattestExponent = -0.15;
constexpr double LeastExplained = 0.5;
constexpr double FarthestExtrapolation = 100.0; // times the longest run

} // namespace

ErrorCurve ErrorCurve::InTime() const
{
  std::vector<std::size_t> order(this->Seconds.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return this->Seconds[a] < this->Seconds[b]; });
  ErrorCurve sorted;
  for (const std::size_t k : order)
  {
    sorted.Seconds.push_back(this->Seconds[k]);
    sorted.Errors.push_back(this->Errors[k]);
  }
  return sorted;
}

bool PowerLaw::Falls() const
{
  return this->Known && this->Points >= LeastPoints && this->Exponent <= FlattestExponent && this->Explained >= LeastExplained;
}

double PowerLaw::SecondsTo(double error) const
{
  if (!this->Falls() || !(error > 0.0))
  {
    return -1.0;
  }
  const double seconds = std::exp(std::log(error / this->Factor) / this->Exponent);
  return seconds <= FarthestExtrapolation * this->Longest ? seconds : -1.0;
}

PowerLaw FitPowerLaw(const ErrorCurve& curve)
{
  PowerLaw law;
  std::vector<double> x, y;
  double meanX = 0.0;
  double meanY = 0.0;
  for (std::size_t k = 0; k < curve.Seconds.size(); ++k)
  {
    if (curve.Seconds[k] > 0.0 && curve.Errors[k] > 0.0)
    {
      x.push_back(std::log(curve.Seconds[k]));
      y.push_back(std::log(curve.Errors[k]));
      meanX += x.back();
      meanY += y.back();
    }
  }
  law.Points = x.size();
  if (x.empty())
  {
    return law;
  }
  const auto [shortest, longest] = std::minmax_element(x.begin(), x.end());
  const bool spread = *longest - *shortest >= std::log(LeastSpan);
  meanX /= static_cast<double>(x.size());
  meanY /= static_cast<double>(x.size());
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    xx += (x[k] - meanX) * (x[k] - meanX);
    xy += (x[k] - meanX) * (y[k] - meanY);
    yy += (y[k] - meanY) * (y[k] - meanY);
  }
  const double exponent = spread ? xy / xx : 0.0;
  const double factor = std::exp(meanY - exponent * meanX);
  law.Known = spread && std::isfinite(exponent) && std::isfinite(factor) && factor > 0.0;
  if (law.Known)
  {
    law.Exponent = exponent;
    law.Factor = factor;
    law.Explained = yy > 0.0 ? xy * xy / (xx * yy) : 0.0;
    law.Longest = std::exp(*longest);
  }
  return law;
}

Arrival ArriveAt(double error, const ErrorCurve& points)
{
  const ErrorCurve curve = points.InTime();
  for (std::size_t k = 0; k < curve.Errors.size(); ++k)
  {
    const double here = curve.Errors[k];
    const double seconds = curve.Seconds[k];
    if (here > error)
    {
      continue;
    }
    if (k == 0)
    {
      return { Arrival::Already, seconds };
    }
    // The run before has a greater error. Where no logarithm can be taken, it took this run.
    const double before = curve.Seconds[k - 1];
    if (!(here > 0.0) || !(before > 0.0) || !(seconds > before))
    {
      return { Arrival::Between, seconds };
    }
    const double way = std::log(curve.Errors[k - 1] / error) / std::log(curve.Errors[k - 1] / here);
    return { Arrival::Between, before * std::pow(seconds / before, way) };
  }
  return {};
}

} // namespace radiometry
