// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/DividePolygon.h"

#include <tuple>

namespace radiometry
{

void DivideConvex(const std::vector<Vec3>& polygon, const Vec3& normal, const Vec3& through,
  double tolerance, std::vector<Vec3>& front, std::vector<Vec3>& back)
{
  front.clear();
  back.clear();
  bool anyFront = false;
  bool anyBack = false;
  const std::size_t n = polygon.size();
  for (std::size_t k = 0; k < n; ++k)
  {
    const Vec3& a = polygon[k];
    const Vec3& b = polygon[(k + 1) % n];
    const double ha = Dot(normal, a - through);
    const double hb = Dot(normal, b - through);
    if (ha >= -tolerance)
    {
      front.push_back(a);
    }
    if (ha <= tolerance)
    {
      back.push_back(a);
    }
    anyFront = anyFront || ha > tolerance;
    anyBack = anyBack || ha < -tolerance;
    if ((ha > tolerance && hb < -tolerance) || (ha < -tolerance && hb > tolerance))
    {
      const bool swap = std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z);
      const Vec3 cut = swap ? b + (hb / (hb - ha)) * (a - b) : a + (ha / (ha - hb)) * (b - a);
      front.push_back(cut);
      back.push_back(cut);
    }
  }
  if (!anyFront)
  {
    front.clear();
  }
  if (!anyBack)
  {
    back.clear();
  }
}

Vec3 AreaNormal2(const std::vector<Vec3>& polygon)
{
  Vec3 sum;
  for (std::size_t k = 2; k < polygon.size(); ++k)
  {
    sum += Cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  }
  return sum;
}

Vec3 MiddleOfConvex(const std::vector<Vec3>& polygon)
{
  Vec3 sum;
  double weights = 0.0;
  for (std::size_t k = 2; k < polygon.size(); ++k)
  {
    const Triangle3 t{ polygon[0], polygon[k - 1], polygon[k] };
    const double area = Area(t);
    sum += area * Centroid(t);
    weights += area;
  }
  return weights > 0.0 ? sum / weights : polygon[0];
}

} // namespace radiometry
