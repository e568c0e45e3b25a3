// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// Area-weighted statistics of one number over a surface.
struct AreaStatistics
{
  std::int64_t Pieces = 0;  // triangles or cells with area that were added
  double Area = 0.0;        // m^2
  double Minimum = 0.0;
  double Mean = 0.0;        // flux / area
  double Maximum = 0.0;
  double Flux = 0.0;        // integral over the area
  double AreaAbove = 0.0;   // m^2 where the value is at least the threshold

  /// Uniformity U0 = minimum / mean; 0 where the mean is 0.
  double U0() const { return this->Mean != 0.0 ? this->Minimum / this->Mean : 0.0; }
  /// Diversity Ud = minimum / maximum; 0 where the maximum is 0.
  double Ud() const { return this->Maximum != 0.0 ? this->Minimum / this->Maximum : 0.0; }
  double ShareAbove() const { return this->Area > 0.0 ? this->AreaAbove / this->Area : 0.0; }
};

/// Collects AreaStatistics piece by piece, with compensated sums.
///   Model   a cell's value counts for its whole area; a value given at a triangle's corners is
///           linear in between, and mean, flux and area above the threshold are exact integrals
///   Source  EN 12665:2018, 3.2 (U0 and Ud)
class AreaStatisticsCollector
{
public:
  explicit AreaStatisticsCollector(double threshold)
    : Threshold(threshold)
  {
  }
  /// A piece of that area (> 0) with one value.
  void AddConstant(double area, double value);
  /// A triangle of that area (> 0) with values at its corners.
  void AddLinear(double area, double a, double b, double c);
  AreaStatistics Result() const;

private:
  struct Sum // Neumaier's compensated sum
  {
    double Value = 0.0;
    double Rest = 0.0;
    void Add(double x);
    double Total() const { return this->Value + this->Rest; }
  };
  void Widen(double value);

  double Threshold;
  std::int64_t Pieces = 0;
  double Minimum = 0.0;
  double Maximum = 0.0;
  Sum Area;
  Sum Flux;
  Sum Above;
};

/// Keeps the pieces of a surface and gives the value that a share of its area does not exceed.
///   Model   the smallest v for which the area with values up to v is at least that share of the
///           whole; a value at corners is linear in between
///   Exact   constant pieces: one of their values; linear ones: to 1e-12 of the range
///   Cost    32 bytes a piece; O(n log n) where all are constant, else 50 passes a quantile
class AreaQuantiles
{
public:
  void AddConstant(double area, double value)
  {
    this->Pieces.push_back({ area, { value, value, value } });
  }
  void AddLinear(double area, double a, double b, double c);
  /// `share` in [0, 1]; 0 where there is no piece.
  double At(double share) const;

private:
  struct Piece
  {
    double Area;
    std::array<double, 3> Values;
  };
  double OfConstants(double share) const;
  double OfAll(double share) const;

  std::vector<Piece> Pieces;
  bool Linear = false;
};

/// Share of a triangle in which a linear function with these corner values is at least `threshold`.
double LinearShareAbove(double a, double b, double c, double threshold);

} // namespace radiometry
