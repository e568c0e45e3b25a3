// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/PolygonFormFactor.h"

#include "radiometry/geometry/Quadrature.h"

#include <algorithm>
#include <limits>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double Epsilon = std::numeric_limits<double>::epsilon();

/// Below this ratio of size to distance the 16-point rule is exact to rounding.
constexpr double SmallRatio = 0.02;

/// Fan of the polygon by the rule of degree 8: int cos cos / (pi r^2) dA without cancellation.
double SmallPolygonFactor(const Vec3& x, const Vec3& n, const SmallPolygon& polygon)
{
  const TriangleRule& rule = TriangleRuleOfDegree(8);
  const Vec3 r0 = polygon.P[0] - x;
  double sum = 0.0;
  for (int k = 1; k + 1 < polygon.N; ++k)
  {
    const Vec3 e1 = polygon.P[k] - polygon.P[0];
    const Vec3 e2 = polygon.P[k + 1] - polygon.P[0];
    const Vec3 normal2 = Cross(e1, e2);
    const double height = -0.5 * Dot(normal2, r0); // cos(emitter) r times the area: constant
    double inner = 0.0;
    for (const auto& node : rule.Nodes)
    {
      const Vec3 r = r0 + node.B1 * e1 + node.B2 * e2;
      const double r2 = LengthSquared(r);
      inner += node.Weight * std::max(0.0, Dot(n, r)) / (r2 * r2);
    }
    sum += height * inner;
  }
  return std::max(0.0, sum / Pi);
}

} // namespace

SmallPolygon ClipToPositive(const SmallPolygon& polygon, const double* heights)
{
  SmallPolygon out;
  bool above = false;
  for (int k = 0; k < polygon.N; ++k)
  {
    const int next = k + 1 < polygon.N ? k + 1 : 0;
    const double a = heights[k];
    const double b = heights[next];
    above = above || a > 0.0;
    if (a >= 0.0 && out.N < SmallPolygon::Capacity)
    {
      out.P[out.N++] = polygon.P[k];
    }
    if (((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0)) && out.N < SmallPolygon::Capacity)
    {
      out.P[out.N++] = polygon.P[k] + (a / (a - b)) * (polygon.P[next] - polygon.P[k]);
    }
  }
  if (!above || out.N < 3)
  {
    out.N = 0;
  }
  return out;
}

double HeightOverPlane(const Vec3& p, const Triangle3& t, const Vec3& n)
{
  // From the nearest corner: fewest digits lost.
  int nearest = 0;
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
  {
    const double l = LengthSquared(p - t[k]);
    if (l < best)
    {
      best = l;
      nearest = k;
    }
  }
  const auto largest = [](const Vec3& v) {
    return std::max({ std::abs(v.x), std::abs(v.y), std::abs(v.z) });
  };
  const Vec3 d = p - t[nearest];
  const double height = Dot(d, n);
  const double coordinate = largest(p) + largest(d);
  if (best == 0.0 || std::abs(height) > 1e-9 * coordinate)
  {
    return best == 0.0 ? 0.0 : height;
  }
  // Decide with the rounding of the determinant and that of the coordinates themselves.
  const Vec3 a = t[(nearest + 1) % 3] - t[nearest];
  const Vec3 b = t[(nearest + 2) % 3] - t[nearest];
  const Vec3 c = Cross(a, b);
  const double determinant = Dot(d, c);
  const double la = largest(a), lb = largest(b), ld = largest(d);
  const double permanent = std::abs(d.x) * (std::abs(a.y * b.z) + std::abs(a.z * b.y)) +
    std::abs(d.y) * (std::abs(a.z * b.x) + std::abs(a.x * b.z)) +
    std::abs(d.z) * (std::abs(a.x * b.y) + std::abs(a.y * b.x));
  const double rounding =
    Epsilon * (8.0 * permanent + 4.0 * coordinate * (la * lb + ld * la + ld * lb));
  return std::abs(determinant) <= rounding ? 0.0 : determinant / Length(c);
}

double PointToVisiblePolygon(const Vec3& x, const Vec3& n, const SmallPolygon& polygon)
{
  Vec3 r[SmallPolygon::Capacity];
  double nearest = std::numeric_limits<double>::infinity();
  double size = 0.0;
  for (int k = 0; k < polygon.N; ++k)
  {
    r[k] = polygon.P[k] - x;
    nearest = std::min(nearest, LengthSquared(r[k]));
    size = std::max(size, LengthSquared(polygon.P[k] - polygon.P[0]));
  }
  if (size <= SmallRatio * SmallRatio * nearest)
  {
    return SmallPolygonFactor(x, n, polygon);
  }
  double sum = 0.0;
  for (int k = 0; k < polygon.N; ++k)
  {
    const int next = k + 1 < polygon.N ? k + 1 : 0;
    const Vec3 c = Cross(r[k], polygon.P[next] - polygon.P[k]);
    const double length = std::sqrt(LengthSquared(c));
    if (length > 0.0)
    {
      sum += std::atan2(length, Dot(r[k], r[next])) * (Dot(n, c) / length);
    }
  }
  return std::max(0.0, -sum / (2.0 * Pi));
}

double PointToPolygonRounding(const Vec3& x, const Vec3* corners, int count)
{
  double nearest = std::numeric_limits<double>::infinity();
  double size = 0.0;
  double angles = 0.0;
  for (int k = 0; k < count; ++k)
  {
    const Vec3 a = corners[k] - x;
    const Vec3 b = corners[k + 1 < count ? k + 1 : 0] - x;
    nearest = std::min(nearest, LengthSquared(a));
    size = std::max(size, LengthSquared(corners[k] - corners[0]));
    angles += std::atan2(Length(Cross(a, b - a)), Dot(a, b));
  }
  return size <= SmallRatio * SmallRatio * nearest ? 0.0 : Epsilon * angles / Pi;
}

double PointToPolygon(const Vec3& x, const Vec3& n, const SmallPolygon& polygon)
{
  if (polygon.N < 3)
  {
    return 0.0;
  }
  // Behind the polygon or in its plane: nothing.
  Vec3 normal2;
  for (int k = 1; k + 1 < polygon.N; ++k)
  {
    normal2 += Cross(polygon.P[k] - polygon.P[0], polygon.P[k + 1] - polygon.P[0]);
  }
  const Triangle3 corners{ polygon.P[0], polygon.P[1], polygon.P[2] };
  if (!(HeightOverPlane(x, corners, Normalized(normal2)) > 0.0))
  {
    return 0.0;
  }
  double heights[SmallPolygon::Capacity];
  bool clip = false;
  for (int k = 0; k < polygon.N; ++k)
  {
    heights[k] = Dot(n, polygon.P[k] - x);
    clip = clip || heights[k] < 0.0;
  }
  if (!clip)
  {
    return PointToVisiblePolygon(x, n, polygon);
  }
  const SmallPolygon visible = ClipToPositive(polygon, heights);
  return visible.N ? PointToVisiblePolygon(x, n, visible) : 0.0;
}

} // namespace radiometry
