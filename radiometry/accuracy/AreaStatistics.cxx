// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/accuracy/AreaStatistics.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{

void AreaStatisticsCollector::Sum::Add(double x)
{
  const double sum = this->Value + x;
  this->Rest += std::fabs(this->Value) >= std::fabs(x) ? (this->Value - sum) + x
                                                       : (x - sum) + this->Value;
  this->Value = sum;
}

void AreaStatisticsCollector::Widen(double value)
{
  this->Minimum = this->Pieces == 0 ? value : std::min(this->Minimum, value);
  this->Maximum = this->Pieces == 0 ? value : std::max(this->Maximum, value);
}

void AreaStatisticsCollector::AddConstant(double area, double value)
{
  this->Widen(value);
  ++this->Pieces;
  this->Area.Add(area);
  this->Flux.Add(area * value);
  if (value >= this->Threshold)
  {
    this->Above.Add(area);
  }
}

void AreaStatisticsCollector::AddLinear(double area, double a, double b, double c)
{
  this->Widen(std::min({ a, b, c }));
  this->Maximum = std::max(this->Maximum, std::max({ a, b, c }));
  ++this->Pieces;
  this->Area.Add(area);
  this->Flux.Add(area * (a / 3.0 + b / 3.0 + c / 3.0));
  this->Above.Add(area * LinearShareAbove(a, b, c, this->Threshold));
}

AreaStatistics AreaStatisticsCollector::Result() const
{
  AreaStatistics result;
  result.Pieces = this->Pieces;
  result.Area = this->Area.Total();
  result.Minimum = this->Minimum;
  result.Maximum = this->Maximum;
  result.Flux = this->Flux.Total();
  result.Mean = result.Area > 0.0 ? result.Flux / result.Area : 0.0;
  // A mean lies between the extremes; rounding must not put it outside.
  result.Mean = std::min(std::max(result.Mean, result.Minimum), result.Maximum);
  result.AreaAbove = this->Above.Total();
  return result;
}

void AreaQuantiles::AddLinear(double area, double a, double b, double c)
{
  this->Pieces.push_back({ area, { a, b, c } });
  this->Linear = this->Linear || a != b || b != c;
}

double AreaQuantiles::At(double share) const
{
  if (this->Pieces.empty())
  {
    return 0.0;
  }
  return this->Linear ? this->OfAll(share) : this->OfConstants(share);
}

double AreaQuantiles::OfConstants(double share) const
{
  std::vector<std::array<double, 2>> sorted; // value, area
  double total = 0.0;
  for (const Piece& piece : this->Pieces)
  {
    sorted.push_back({ piece.Values[0], piece.Area });
    total += piece.Area;
  }
  std::sort(sorted.begin(), sorted.end());
  // What is whole but for the rounding of the sums counts as whole.
  const double wanted = share * total * (1.0 - 1e-12);
  double area = 0.0;
  for (const auto& [value, weight] : sorted)
  {
    area += weight;
    if (area >= wanted)
    {
      return value;
    }
  }
  return sorted.back()[0];
}

double AreaQuantiles::OfAll(double share) const
{
  double low = this->Pieces.front().Values[0];
  double high = low;
  double total = 0.0;
  for (const Piece& piece : this->Pieces)
  {
    low = std::min({ low, piece.Values[0], piece.Values[1], piece.Values[2] });
    high = std::max({ high, piece.Values[0], piece.Values[1], piece.Values[2] });
    total += piece.Area;
  }
  for (int k = 0; k < 50; ++k)
  {
    const double middle = 0.5 * low + 0.5 * high;
    double above = 0.0;
    for (const Piece& piece : this->Pieces)
    {
      const auto& [a, b, c] = piece.Values;
      above += piece.Area * LinearShareAbove(a, b, c, middle);
    }
    (total - above >= share * total ? high : low) = middle;
  }
  return high;
}

double LinearShareAbove(double a, double b, double c, double threshold)
{
  double v[3] = { a, b, c };
  std::sort(v, v + 3);
  if (threshold <= v[0])
  {
    return 1.0;
  }
  if (threshold > v[2])
  {
    return 0.0;
  }
  // The iso-line cuts off a corner: the one below, or the one above the threshold.
  if (threshold <= v[1])
  {
    const double below =
      ((threshold - v[0]) / (v[1] - v[0])) * ((threshold - v[0]) / (v[2] - v[0]));
    return 1.0 - below;
  }
  return ((v[2] - threshold) / (v[2] - v[1])) * ((v[2] - threshold) / (v[2] - v[0]));
}

} // namespace radiometry
