// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <vector>

namespace radiometry
{

/// Corners of a polygon may lie that far off its plane, as a share of its extent: what files in
/// single precision and rounded coordinates need.
inline constexpr double PolygonFlatness = 1e-4;

/// PolygonTriangles of a polygon that has to be flat and simple: an area light's. A bridge to a hole
/// (two edges on one line) is allowed.
///   Empty   where the polygon has no area
///   Cost    O(n^2) for n corners
///   Fails   InputError{array, index}: corners off the plane by more than PolygonFlatness, or edges
///           that cross
std::vector<Triangle3> TriangulatePolygon(
  const std::vector<Vec3>& corners, const char* array, long long index);

} // namespace radiometry
