// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <vector>

/// Shapes made of triangles for the tests of exchange and solve.
namespace shapes
{
using radiometry::Triangle3;
using radiometry::Vec3;

/// A parallelogram from a corner and two edges as two triangles; the front is that of e1 x e2.
inline std::vector<Triangle3> Quad(const Vec3& corner, const Vec3& e1, const Vec3& e2)
{
  const Vec3 p1 = corner + e1, p2 = corner + e1 + e2, p3 = corner + e2;
  return { { corner, p1, p2 }, { corner, p2, p3 } };
}
/// The same cut along the other diagonal.
inline std::vector<Triangle3> QuadOther(const Vec3& corner, const Vec3& e1, const Vec3& e2)
{
  const Vec3 p1 = corner + e1, p2 = corner + e1 + e2, p3 = corner + e2;
  return { { corner, p1, p3 }, { p1, p2, p3 } };
}
/// Every triangle cut into four.
inline std::vector<Triangle3> Divided(const std::vector<Triangle3>& in)
{
  std::vector<Triangle3> out;
  for (const Triangle3& t : in)
  {
    const Vec3 a = 0.5 * (t[0] + t[1]), b = 0.5 * (t[1] + t[2]), c = 0.5 * (t[2] + t[0]);
    out.push_back({ t[0], a, c });
    out.push_back({ a, t[1], b });
    out.push_back({ c, b, t[2] });
    out.push_back({ a, b, c });
  }
  return out;
}
} // namespace shapes
