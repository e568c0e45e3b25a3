// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/shading/VertexNormals.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{

std::vector<Vec3> ComputeVertexNormals(const std::vector<Vec3>& points,
  const std::vector<std::array<std::int32_t, 3>>& triangles, NormalWeight weight)
{
  std::vector<Vec3> normals(points.size());
  for (const auto& corners : triangles)
  {
    const Triangle3 t{ points[corners[0]], points[corners[1]], points[corners[2]] };
    const Vec3 product = AreaNormal2(t);
    const double twiceArea = Length(product);
    if (!(twiceArea > 0.0) || !std::isfinite(twiceArea))
    {
      continue;
    }
    const Vec3 unit = product / twiceArea;
    for (int i = 0; i < 3; ++i)
    {
      double share = twiceArea;
      if (weight == NormalWeight::Angle)
      {
        const Vec3 a = t[(i + 1) % 3] - t[i];
        const Vec3 b = t[(i + 2) % 3] - t[i];
        share = std::atan2(twiceArea, Dot(a, b)); // |a x b| is twice the area at every corner
      }
      normals[corners[i]] += share * unit;
    }
  }
  for (Vec3& n : normals)
  {
    n = Normalized(n);
  }
  return normals;
}

Vec3 TransformNormal(const Matrix3& m, const Vec3& normal)
{
  const auto finite = [](const std::array<double, 3>& row) {
    return std::isfinite(row[0]) && std::isfinite(row[1]) && std::isfinite(row[2]);
  };
  if (!IsFinite(normal) || !std::all_of(m.begin(), m.end(), finite))
  {
    return {};
  }
  // Columns of the matrix; the cofactor matrix has their cross products as columns and is
  // det(M) M^-T.
  const Vec3 x{ m[0][0], m[1][0], m[2][0] };
  const Vec3 y{ m[0][1], m[1][1], m[2][1] };
  const Vec3 z{ m[0][2], m[1][2], m[2][2] };
  const Vec3 carried =
    normal.x * Cross(y, z) + normal.y * Cross(z, x) + normal.z * Cross(x, y);
  const double determinant = Dot(x, Cross(y, z));
  return Normalized(determinant < 0.0 ? -carried : carried);
}

} // namespace radiometry
