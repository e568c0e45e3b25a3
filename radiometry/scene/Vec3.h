// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

namespace radiometry
{

/// A point or a direction in double precision.
struct Vec3
{
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  constexpr double operator[](int i) const { return i == 0 ? x : (i == 1 ? y : z); }
  constexpr double& operator[](int i) { return i == 0 ? x : (i == 1 ? y : z); }
  constexpr Vec3& operator+=(const Vec3& o)
  {
    x += o.x;
    y += o.y;
    z += o.z;
    return *this;
  }
};

constexpr Vec3 operator+(const Vec3& a, const Vec3& b)
{
  return { a.x + b.x, a.y + b.y, a.z + b.z };
}
constexpr Vec3 operator-(const Vec3& a, const Vec3& b)
{
  return { a.x - b.x, a.y - b.y, a.z - b.z };
}
constexpr Vec3 operator-(const Vec3& a)
{
  return { -a.x, -a.y, -a.z };
}
constexpr Vec3 operator*(double s, const Vec3& a)
{
  return { s * a.x, s * a.y, s * a.z };
}
constexpr Vec3 operator*(const Vec3& a, double s)
{
  return s * a;
}
constexpr Vec3 operator/(const Vec3& a, double s)
{
  return { a.x / s, a.y / s, a.z / s };
}
constexpr bool operator==(const Vec3& a, const Vec3& b)
{
  return a.x == b.x && a.y == b.y && a.z == b.z;
}
constexpr double Dot(const Vec3& a, const Vec3& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 Cross(const Vec3& a, const Vec3& b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}
constexpr double LengthSquared(const Vec3& a)
{
  return Dot(a, a);
}
/// Euclidean length; does not overflow or underflow for any finite vector.
inline double Length(const Vec3& a)
{
  return std::hypot(a.x, a.y, a.z);
}
/// Unit vector along a; the zero vector stays zero.
inline Vec3 Normalized(const Vec3& a)
{
  const double l = Length(a);
  return l > 0.0 ? a / l : Vec3{};
}
inline bool IsFinite(const Vec3& a)
{
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// A triangle by its corners; its front is where they turn counter-clockwise.
using Triangle3 = std::array<Vec3, 3>;

/// Twice the area times the unit normal: (p1 - p0) x (p2 - p0).
inline Vec3 AreaNormal2(const Triangle3& t)
{
  return Cross(t[1] - t[0], t[2] - t[0]);
}
inline double Area(const Triangle3& t)
{
  return 0.5 * Length(AreaNormal2(t));
}
inline Vec3 Centroid(const Triangle3& t)
{
  return (t[0] + t[1] + t[2]) / 3.0;
}

} // namespace radiometry
