// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <vector>

namespace radiometry
{

/// Corners of a polygon may lie that far off its plane, as a share of its extent: what files in
/// single precision and rounded coordinates need.
inline constexpr double PolygonFlatness = 1e-4;

/// Cuts a flat simple polygon, convex or concave, into triangles that turn as it does.
///   Method  ear clipping in the plane of the polygon's area vector (Newell). A bridge to a hole (two
///           edges on one line) is allowed
///   Empty   where the polygon has no area
///   Cost    O(n^2) for n corners
///   Source  Meisters (1975), polygons have ears
///   Fails   InputError{array, index}: corners off the plane by more than PolygonFlatness, or edges
///           that cross
std::vector<Triangle3> TriangulatePolygon(
  const std::vector<Vec3>& corners, const char* array, long long index);

} // namespace radiometry
