// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace radiometry
{

/// A point of a quadrature rule on triangles, in barycentric coordinates; weights sum to one.
struct TrianglePoint
{
  double A, B, C, Weight;
};

/// Twelve points, exact for polynomials of degree 7.
///   Source  Gatermann 1988, "The construction of symmetric cubature formulas for the square and
///           the triangle", Computing 40: four orbits of three points.
inline constexpr std::array<TrianglePoint, 12> DegreeSevenRule = [] {
  constexpr TrianglePoint orbit[4] = {
    { 0.06238226509439084, 0.06751786707392436, 0.87009986783168480, 2.0 * 0.02651702815743450 },
    { 0.05522545665692000, 0.32150249385198184, 0.62327204949109816, 2.0 * 0.04388140871444604 },
    { 0.03432430294509709, 0.66094919618673564, 0.30472650086816727, 2.0 * 0.02877504278498159 },
    { 0.51584233435359177, 0.27771616697639178, 0.20644149867001645, 2.0 * 0.06749318700980879 }
  };
  std::array<TrianglePoint, 12> rule{};
  for (int k = 0; k < 4; ++k)
  {
    const TrianglePoint& o = orbit[k];
    rule[3 * k] = o;
    rule[3 * k + 1] = { o.B, o.C, o.A, o.Weight };
    rule[3 * k + 2] = { o.C, o.A, o.B, o.Weight };
  }
  return rule;
}();

} // namespace radiometry
