// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

namespace radiometry
{

/// A convex polygon of few corners, without allocation.
struct SmallPolygon
{
  static constexpr int Capacity = 8;
  Vec3 P[Capacity];
  int N = 0;

  SmallPolygon() = default;
  explicit SmallPolygon(const Triangle3& t)
    : P{ t[0], t[1], t[2] }
    , N(3)
  {
  }
};

/// The part of a polygon where the signed heights given for its corners are positive. A corner
/// whose height is zero belongs to the boundary and stays. Empty (N = 0) when nothing is above.
SmallPolygon ClipToPositive(const SmallPolygon& polygon, const double* heights);

/// Height of p over the plane of a triangle, along its unit normal n. Exactly zero for a corner of
/// that triangle and for points that the rounding of the coordinates cannot tell from the plane.
double HeightOverPlane(const Vec3& p, const Triangle3& t, const Vec3& n);

/// Configuration factor from a small surface at x with unit normal n to a polygon: the irradiance
/// there for unit exitance of the polygon's front; 0 behind it.
///   Model   F = -(1/2pi) sum_k angle(r_k, r_k+1) n.(r_k x r_k+1)/|r_k x r_k+1|, after clipping
///           at the horizon of x; angles from atan2. For polygons that are small beside their
///           distance the sum cancels, and a 16-point rule on the polygon takes its place
///   Limits  x in the plane of the polygon gives 0. The relative error is some 1e-13, times
///           1e-16/F for a polygon that is nearly edge-on and near
///   Source  Lambert (1760); Baum, Rushmeier and Winget (1989), eq. 6
double PointToPolygon(const Vec3& x, const Vec3& n, const SmallPolygon& polygon);

/// The same for a polygon known to be above the horizon of x and to face it.
double PointToVisiblePolygon(const Vec3& x, const Vec3& n, const SmallPolygon& polygon);

/// What rounding may change in that: of the sum over the rim, eps of its terms without their signs
/// (a sliver keeps few digits); 0 where the rule on the polygon is used.
double PointToPolygonRounding(const Vec3& x, const Vec3* corners, int count);

} // namespace radiometry
