// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <cstddef>

namespace radiometry
{

/// Signed solid angle of the triangle (a, b, c) seen from the origin, in steradians, in
/// (-2 pi, 2 pi]: positive when the origin is on its front side.
///   Model   tan(Omega/2) = -a.(b x c) / (|a||b||c| + (a.b)|c| + (b.c)|a| + (c.a)|b|)
///   Source  Van Oosterom and Strackee 1983, eq. 8; the triple product is taken as
///           a.((b-a) x (c-a)), which keeps its digits for small and for grazing triangles.
double SolidAngle(const Vec3& a, const Vec3& b, const Vec3& c);

/// The same for a flat convex polygon of `count` corners.
double SolidAngle(const Vec3* polygon, std::size_t count);

/// The same seen from `from`. Edges are taken from the corners as they are given: slivers and cells
/// that graze a far point keep their digits, which corners shifted to it would have lost.
double SolidAngle(const Vec3* polygon, std::size_t count, const Vec3& from);

} // namespace radiometry
