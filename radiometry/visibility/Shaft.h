// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/geometry/ConvexPolygon.h"
#include "radiometry/visibility/ShadowLines.h"

namespace radiometry
{

/// The convex hull of a receiver (a polygon or a point) and a light's outline: what stands between
/// them touches its inside. Planes come from the corners in double; what lies along the hull's own
/// sides, within `rounding` (m), does not count.
class Shaft
{
public:
  /// Both flat, with fronts toward each other. A receiver of one corner is a point.
  Shaft(const ConvexPolygon& receiver, const ConvexPolygon& light, double rounding);
  /// Narrows the shaft to the side of a plane to which `normal` (unit) points.
  void Add(const Vec3& normal, const Vec3& through);

  /// False only where the box lies outside.
  bool Reaches(const Box3& box) const;
  /// True where some of the triangle lies inside.
  bool Touches(const Triangle3& triangle) const;
  bool Touches(const Segment3& segment) const;

private:
  void AddSides(const ConvexPolygon& edges, const ConvexPolygon& tips, double size);

  static constexpr int Capacity = 32;
  Vec3 Normals[Capacity];
  double Offsets[Capacity]; // inside: Normal . x + Offset > 0
  int Planes = 0;
  double Rounding;
};

} // namespace radiometry
