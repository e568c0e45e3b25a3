// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <vector>

namespace radiometry
{

/// Divides a flat convex polygon by a plane: what lies before it and behind it, in the same turn.
/// Corners within `tolerance` of the plane belong to both; a half without area inside is empty.
/// An edge is always divided from the same end: two polygons that share it get the same corner.
void DivideConvex(const std::vector<Vec3>& polygon, const Vec3& normal, const Vec3& through,
  double tolerance, std::vector<Vec3>& front, std::vector<Vec3>& back);

/// The centroid by area, so that it is well inside also where corners crowd together.
Vec3 MiddleOfConvex(const std::vector<Vec3>& polygon);

/// Twice the area times the normal.
Vec3 AreaNormal2(const std::vector<Vec3>& polygon);

} // namespace radiometry
