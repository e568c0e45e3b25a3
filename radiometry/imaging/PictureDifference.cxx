// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/imaging/PictureDifference.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiometry
{
namespace imaging
{
namespace
{

bool SameKind(double a, double b) { return (std::isnan(a) && std::isnan(b)) || a == b; }

double Root(double sum, std::size_t n) { return n > 0 ? std::sqrt(sum / n) : 0.0; }

double Mean(double sum, std::size_t n) { return n > 0 ? sum / n : 0.0; }

} // namespace

ChannelDifference CompareChannel(const double* a, const double* b, std::size_t count,
  int components, int channel, double floor, double peak)
{
  ChannelDifference d;
  double squares = 0.0;
  double squaresA = 0.0;
  double greatest = 0.0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double va = a[i * components + channel];
    const double vb = b[i * components + channel];
    const bool finite = std::isfinite(va) && std::isfinite(vb);
    d.NonFiniteA += std::isfinite(va) ? 0 : 1;
    d.NonFiniteB += std::isfinite(vb) ? 0 : 1;
    if (!finite)
    {
      d.Unlike += SameKind(va, vb) ? 0 : 1;
      continue;
    }
    const double difference = vb - va;
    ++d.Pixels;
    d.MeanA += va;
    d.MeanB += vb;
    d.MeanDifference += difference;
    d.MeanAbsolute += std::abs(difference);
    d.MeanRelative += Difference(va, vb, DifferenceKind::Relative, floor);
    squares += difference * difference;
    squaresA += va * va;
    greatest = std::max(greatest, std::abs(va));
    if (std::abs(difference) > d.Maximum)
    {
      d.Maximum = std::abs(difference);
      d.MaximumAt = static_cast<long long>(i);
    }
  }
  for (double* mean : { &d.MeanA, &d.MeanB, &d.MeanDifference, &d.MeanAbsolute, &d.MeanRelative })
  {
    *mean = Mean(*mean, d.Pixels);
  }
  d.RootMeanSquare = Root(squares, d.Pixels);
  const double size = Root(squaresA, d.Pixels);
  d.RelativeRootMeanSquare = d.RootMeanSquare > 0.0 ? d.RootMeanSquare / size : 0.0;
  const double top = peak > 0.0 ? peak : greatest;
  d.PeakSignalToNoise = d.RootMeanSquare > 0.0 ? 20.0 * std::log10(top / d.RootMeanSquare)
                                               : std::numeric_limits<double>::infinity();
  return d;
}

double Difference(double a, double b, DifferenceKind kind, double floor)
{
  if (!std::isfinite(a) || !std::isfinite(b))
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  switch (kind)
  {
    case DifferenceKind::Signed:
      return b - a;
    case DifferenceKind::Relative:
      return std::abs(b - a) / std::max(std::abs(a), floor);
    default:
      return std::abs(b - a);
  }
}

double RelativeFloor(const double* a, std::size_t values)
{
  double sum = 0.0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < values; ++i)
  {
    if (std::isfinite(a[i]))
    {
      sum += std::abs(a[i]);
      ++n;
    }
  }
  return std::max(1e-3 * Mean(sum, n), 1e-30);
}

} // namespace imaging
} // namespace radiometry
