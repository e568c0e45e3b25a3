// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/PolygonFormFactor.h"
#include "radiometry/scene/Vec3.h"

#include <vector>

namespace radiometry
{

/// A flat convex polygon of some corners, without allocation: what clipping makes of smaller ones.
struct ConvexPolygon
{
  static constexpr int Capacity = 32;
  Vec3 P[Capacity];
  int N = 0;

  ConvexPolygon() = default;
  ConvexPolygon(const ConvexPolygon& other) { *this = other; }
  /// Copies the corners that are there.
  ConvexPolygon& operator=(const ConvexPolygon& other)
  {
    this->N = other.N;
    for (int k = 0; k < other.N; ++k)
    {
      this->P[k] = other.P[k];
    }
    return *this;
  }
  explicit ConvexPolygon(const Triangle3& t)
    : P{ t[0], t[1], t[2] }
    , N(3)
  {
  }
  /// False where there is no room for one more.
  bool Add(const Vec3& p)
  {
    if (this->N == Capacity)
    {
      return false;
    }
    this->P[this->N++] = p;
    return true;
  }
};

/// Parts a polygon by the signed heights of its corners; a corner of height zero belongs to both
/// parts. A part that holds no corner off the plane is empty. False where a part has too many
/// corners: then neither is of use.
bool Split(
  const ConvexPolygon& polygon, const double* heights, ConvexPolygon& above, ConvexPolygon& below);

/// The part where the heights are positive, as above.
bool Clip(const ConvexPolygon& polygon, const double* heights, ConvexPolygon& above);

/// Two halves, from the middle of the longest edge to what lies opposite.
void Halve(const ConvexPolygon& piece, ConvexPolygon halves[2]);

/// Irradiance at x about n for unit exitance of the polygon's front, which x is known to see wholly
/// above its horizon (see PointToVisiblePolygon).
double PointToVisiblePolygon(const Vec3& x, const Vec3& n, const ConvexPolygon& polygon);

/// Twice the area times the unit normal (Newell).
Vec3 AreaNormal2(const Vec3* corners, std::size_t count);

/// The convex hull of flat corners with unit normal n, counter-clockwise about n; where it has more
/// than `most` (at least 4) corners, an equiangular polygon of that many sides about it.
std::vector<Vec3> Outline(const std::vector<Vec3>& corners, const Vec3& n, std::size_t most);

} // namespace radiometry
