// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <array>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// Cuts a polygon into triangles that turn as it does: convex or concave, with corners on straight
/// edges, keyholes and needles of any aspect; a polygon that is not quite flat keeps its rim.
/// Returns numbers of its corners; empty when the polygon has no area or crosses itself.
///   Method  ears by their shape, in the plane of the vector area; a quad along the diagonal that
///           makes the larger lesser triangle, the shorter one where that cannot be told. No
///           tolerance but rounding
///   Cost    O(n^2)
std::vector<std::array<std::int32_t, 3>> PolygonTriangles(const std::vector<Vec3>& corners);

/// The unit vector along a polygon's vector area; zero where it has none.
Vec3 PolygonNormal(const std::vector<Vec3>& corners);

} // namespace radiometry
