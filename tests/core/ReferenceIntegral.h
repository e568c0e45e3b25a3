// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

/// Integrals over a plane region less the union of any number of convex shadows, by a route that
/// shares nothing with the engine: line by line, where what is lit is a set of intervals.
namespace test
{

struct Point2
{
  double x = 0.0;
  double y = 0.0;
};
using Convex2 = std::vector<Point2>; // a convex polygon, in any turning sense

struct Integral
{
  double Value = 0.0;
  double Error = 0.0; // sum of the last refinements, and rounding
};

struct RegionIntegrand
{
  /// f(x, y)
  std::function<double(double, double)> Value;
  /// The s at which the line o + s d meets curves on which f is not smooth (a cone's edge); may be
  /// empty.
  std::function<void(const Point2& o, const Point2& d, std::vector<double>& s)> OnLine;
  /// The y at which such curves begin and end.
  std::vector<double> Extremes;
};

/// Integral of f over the part of `region` that is in none of `shadows`; with `hidden`, over the
/// part that is in any of them.
///   Method  the lines through all corners and crossings of edges part the region into strips; in
///           each, Gauss-Legendre along y of exact intervals along x (Gauss-Legendre of f inside
///           each), the strip halved until two estimates agree to `tolerance` times the integral
Integral IntegrateRegion(const Convex2& region, const std::vector<Convex2>& shadows,
  const RegionIntegrand& f, double tolerance, bool hidden = false);

} // namespace test
