// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/AreaLightShapes.h"

#include "radiometry/geometry/PolygonTriangulation.h"
#include "radiometry/geometry/Sampling.h"

#include <cmath>

namespace radiometry
{
namespace
{

/// Unit vectors along width and height: u x v = direction.
void Axes(const Vec3& direction, const Vec3& reference, Vec3& u, Vec3& v)
{
  const Vec3 square = reference - Dot(direction, reference) * direction;
  if (Length(square) > 1e-12 * Length(reference))
  {
    u = Normalized(square);
    v = Cross(direction, u);
    return;
  }
  Frame(direction, u, v);
}

} // namespace

std::vector<Vec3> RectangleCorners(const Vec3& center, const Vec3& direction, const Vec3& reference,
  double width, double height)
{
  Vec3 u, v;
  Axes(direction, reference, u, v);
  u = 0.5 * width * u;
  v = 0.5 * height * v;
  return { center - u - v, center + u - v, center + u + v, center - u + v };
}

std::vector<Vec3> DiscCorners(const Vec3& center, const Vec3& direction, const Vec3& reference,
  double radius, int sides)
{
  Vec3 u, v;
  Axes(direction, reference, u, v);
  const double step = 2.0 * std::acos(-1.0) / sides;
  const double around = radius * std::sqrt(step / std::sin(step)); // n/2 R^2 sin(2 pi/n) = pi r^2
  std::vector<Vec3> corners;
  for (int k = 0; k < sides; ++k)
  {
    corners.push_back(
      center + around * (std::cos(step * k) * u + std::sin(step * k) * v));
  }
  return corners;
}

double PolygonArea(const std::vector<Vec3>& corners, const char* array, long long index)
{
  double area = 0.0;
  for (const Triangle3& t : TriangulatePolygon(corners, array, index))
  {
    area += Area(t);
  }
  return area;
}

} // namespace radiometry
