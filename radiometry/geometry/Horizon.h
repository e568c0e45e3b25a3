// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

namespace radiometry
{

/// Where a light stands to the plane of a triangle, as far as rounding lets it be known.
enum class PlaneSide
{
  Known,   // clearly before or behind
  Unknown, // beside the triangle, in its plane within rounding
  Touching // on the triangle itself within rounding
};

/// A light whose side is not known counts as in the plane and sends nothing onto the triangle, so
/// that the walls of a turned closed box stay dark.
///   Model   |height| <= 4 eps (r + extent (1 + d/size)): r the light's distance from a corner, d that
///           from the triangle itself, size the triangle's least height, extent that of the
///           coordinates: the tilt of a plane through corners that are each rounded by eps extent
PlaneSide FindSide(
  const Triangle3& triangle, const Vec3& normal, const Vec3& point, double extent);

/// The same for a direction that makes this cosine with the normal.
PlaneSide FindSide(const Triangle3& triangle, double cosine, double extent);

/// The least of a triangle's three heights.
double LeastHeight(const Triangle3& triangle);

} // namespace radiometry
