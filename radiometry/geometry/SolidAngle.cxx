// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/SolidAngle.h"

namespace radiometry
{

namespace
{

/// Numerator and denominator of tan(Omega/2), the latter relative to |a||b||c|.
struct HalfTangent
{
  double Triple;
  double Sum;
  double Scale;
};

/// The length, without the cost of guarding against overflow where there is none.
double Norm(const Vec3& a)
{
  const double l2 = LengthSquared(a);
  return l2 > 1e-280 && l2 < 1e280 ? std::sqrt(l2) : Length(a);
}

/// atan(x): the series for small x.
double Atan(double x)
{
  const double x2 = x * x;
  return x2 < 1e-4
    ? x * (1.0 - x2 * (1.0 / 3.0 - x2 * (1.0 / 5.0 - x2 * (1.0 / 7.0 - x2 * (1.0 / 9.0)))))
    : std::atan(x);
}

/// `normal` is that of the triangle, of any length: (b - a) x (c - a).
HalfTangent MakeHalfTangent(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal)
{
  const double la = Norm(a);
  const double lb = Norm(b);
  const double lc = Norm(c);
  return { -Dot(a, normal),
    la * lb * lc + Dot(a, b) * lc + Dot(b, c) * la + Dot(c, a) * lb, la * lb * lc };
}

/// For an origin close to the polygon compared with its size:
///   Omega = sum over edges of [psi - asin(h sin psi / sqrt(h^2 + p^2))]
/// with psi the azimuth about the foot of the perpendicular (height h) and p the edge line's
/// distance from the foot. The psi sum to 2 pi, or to nothing where the foot is outside: no
/// difference of nearly equal numbers, wherever the foot lies.
double NearSolidAngle(const Vec3* polygon, std::size_t count, const Vec3& from)
{
  Vec3 normal;
  for (std::size_t k = 2; k < count; ++k)
  {
    normal += Cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  }
  normal = Normalized(normal);
  const double height = Dot(normal, from - polygon[0]);
  if (height == 0.0)
  {
    return 0.0;
  }
  const double h = std::fabs(height);
  double sum = 0.0;
  double winding = 0.0;
  bool outside = false;
  for (std::size_t k = 0; k < count; ++k)
  {
    const Vec3& first = polygon[k];
    const Vec3& second = polygon[(k + 1) % count];
    const Vec3 a = first - from + height * normal; // in the plane, from the foot
    const Vec3 b = second - from + height * normal;
    const Vec3 along = Normalized(second - first);
    const double side = Dot(normal, Cross(a, along));
    const double p = std::fabs(side);
    outside = outside || side < 0.0;
    winding += std::atan2(Dot(normal, Cross(a, second - first)), Dot(a, b));
    const double hp = std::hypot(h, p);
    const auto part = [&](const Vec3& v) {
      // asin(h sin psi / hp), as an atan2 of h s and p sqrt(h^2 + p^2 + s^2)
      const double s = Dot(v, along);
      return std::atan2(h * s, p * std::hypot(hp, s));
    };
    sum += std::copysign(part(b) - part(a), side);
  }
  return std::copysign((outside ? 0.0 : winding) - sum, height);
}

/// Below this cosine-like number the half tangent loses digits.
constexpr double NearLimit = 0.2;

} // namespace

double SolidAngle(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 triangle[3] = { a, b, c };
  return SolidAngle(triangle, 3);
}

double SolidAngle(const Vec3* polygon, std::size_t count)
{
  return SolidAngle(polygon, count, Vec3{});
}

double SolidAngle(const Vec3* polygon, std::size_t count, const Vec3& from)
{
  double sum = 0.0;
  for (std::size_t k = 2; k < count; ++k)
  {
    const Vec3& a = polygon[0];
    const Vec3& b = polygon[k - 1];
    const Vec3& c = polygon[k];
    const HalfTangent t =
      MakeHalfTangent(a - from, b - from, c - from, Cross(b - a, c - a));
    const double half =
      t.Sum > NearLimit * t.Scale ? Atan(t.Triple / t.Sum) : std::atan2(t.Triple, t.Sum);
    // Both lose digits there: this form of its denominator's, the other of pi's (a sliver).
    if (t.Sum < NearLimit * t.Scale && std::fabs(half) * t.Scale > std::hypot(t.Sum, t.Triple))
    {
      return NearSolidAngle(polygon, count, from);
    }
    sum += 2.0 * half;
  }
  return sum;
}

} // namespace radiometry
