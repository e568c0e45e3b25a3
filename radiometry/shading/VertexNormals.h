// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <array>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// What a face counts at one of its corners.
enum class NormalWeight
{
  Angle = 0, // the corner's angle: the result does not depend on how a face is cut into triangles
  Area = 1   // the triangle's area: cheap, and biased toward large triangles
};

/// Vertex normals of a triangle mesh: the weighted mean of the unit normals (p1-p0)x(p2-p0) of the
/// triangles at each point, unit length.
///   Points with no triangle, only degenerate or non-finite ones, or whose mean cancels out: {0,0,0}
///   Cost    O(triangles)
///   Source  Thuermer and Wuethrich 1998 (by angle)
std::vector<Vec3> ComputeVertexNormals(const std::vector<Vec3>& points,
  const std::vector<std::array<std::int32_t, 3>>& triangles,
  NormalWeight weight = NormalWeight::Angle);

/// The linear part of a transform, row by row.
using Matrix3 = std::array<std::array<double, 3>, 3>;

/// A normal carried along by a linear transform of its surface: the inverse transpose applied and
/// the length made one. Done by cofactors, so singular transforms (a squashed surface) work where
/// the normal still has a meaning; a mirror keeps the normal on the side of the surface it was on.
/// Zero where no normal is left, or for input that is not finite.
Vec3 TransformNormal(const Matrix3& transform, const Vec3& normal);

} // namespace radiometry
