// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <vector>

namespace radiometry
{

/// Corners of a flat light about `center`, counter-clockwise about the unit vector `direction` in which
/// it shines. `reference`: the direction of its width (its part square to `direction`; any one where
/// it has none).
std::vector<Vec3> RectangleCorners(const Vec3& center, const Vec3& direction, const Vec3& reference,
  double width, double height);

/// A disc as a regular polygon of its area; its first corner lies along `reference`.
std::vector<Vec3> DiscCorners(const Vec3& center, const Vec3& direction, const Vec3& reference,
  double radius, int sides);

/// Area of a polygon, convex or concave. Fails as TriangulatePolygon.
double PolygonArea(const std::vector<Vec3>& corners, const char* array, long long index);

} // namespace radiometry
