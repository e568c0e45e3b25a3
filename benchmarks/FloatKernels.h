// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

/// The core's closed forms for any number type, as radiometry/geometry has them in double: without
/// what the core does beside them (clipping, forms for near points).
namespace kernels
{

template <class Real>
struct Vec
{
  Real x{}, y{}, z{};

  Vec operator+(const Vec& b) const { return { x + b.x, y + b.y, z + b.z }; }
  Vec operator-(const Vec& b) const { return { x - b.x, y - b.y, z - b.z }; }
  Vec operator*(Real s) const { return { x * s, y * s, z * s }; }
};

template <class Real>
Real Dot(const Vec<Real>& a, const Vec<Real>& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
Vec<Real> Cross(const Vec<Real>& a, const Vec<Real>& b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}
template <class Real>
Real Length(const Vec<Real>& a)
{
  return std::sqrt(Dot(a, a));
}

/// Of a triangle seen from the origin; `normal` is (b - a) x (c - a).
template <class Real>
Real SolidAngle(const Vec<Real>& a, const Vec<Real>& b, const Vec<Real>& c, const Vec<Real>& normal)
{
  const Real la = Length(a);
  const Real lb = Length(b);
  const Real lc = Length(c);
  return 2 *
    std::atan2(std::fabs(Dot(a, normal)),
      la * lb * lc + Dot(a, b) * lc + Dot(b, c) * la + Dot(c, a) * lb);
}

/// The angle between two directions and the unit normal of their plane.
template <class Real>
Real Arc(const Vec<Real>& a, const Vec<Real>& b, Vec<Real>& normal)
{
  const Vec<Real> cross = Cross(a, b - a);
  const Real length = Length(cross);
  normal = length > 0 ? cross * (1 / length) : Vec<Real>{};
  return std::atan2(length, Dot(a, b));
}

/// Lambert: |sum over edges of angle times the cosine of the edge's plane|/2 over pi, normal z.
template <class Real>
Real Contour(const Vec<Real>& a, const Vec<Real>& b, const Vec<Real>& c)
{
  const Vec<Real> corners[3] = { a, b, c };
  Real sum = 0;
  for (int k = 0; k < 3; ++k)
  {
    Vec<Real> normal;
    const Real angle = Arc(corners[k], corners[(k + 1) % 3], normal);
    sum += angle * normal.z;
  }
  return std::fabs(sum) / (2 * static_cast<Real>(3.14159265358979323846264L));
}

/// int cos^4 over the directions of the triangle about z: 5 m4 = 3 m2 + sum of edges, 3 m2 = m0 +
/// sum of edges, m0 the solid angle; over an edge's arc cos = a cos t + b sin t.
template <class Real>
Real FourthMoment(
  const Vec<Real>& p, const Vec<Real>& q, const Vec<Real>& r, const Vec<Real>& normal)
{
  const Vec<Real> corners[3] = { p, q, r };
  const Real sign = Dot(p, normal) < 0 ? Real(-1) : Real(1);
  Real first = 0;
  Real third = 0;
  for (int k = 0; k < 3; ++k)
  {
    const Vec<Real>& s = corners[k];
    Vec<Real> n;
    const Real angle = Arc(s, corners[(k + 1) % 3], n);
    const Vec<Real> along = Cross(n, s * (1 / Length(s)));
    const Real a = s.z / Length(s);
    const Real b = along.z;
    const Real sine = std::sin(angle);
    const Real half = std::sin(angle / 2);
    const Real versine = 2 * half * half; // 1 - cos
    const Real line = a * sine + b * versine;
    // (a cos + b sin)^3 by its primitive, with c^2 = a^2 + b^2 and the derivative at both ends.
    const Real c2 = a * a + b * b;
    const Real d0 = -b; // a sin(0) - b cos(0)
    const Real d1 = a * sine - b * (1 - versine);
    const Real cube = c2 * (d1 - d0) - (d1 * d1 * d1 - d0 * d0 * d0) / 3;
    first += n.z * line;
    third += n.z * cube;
  }
  const Real m0 = SolidAngle(p, q, r, normal);
  const Real m2 = (m0 + sign * first) / 3;
  return (3 * m2 + sign * third) / 5;
}

/// int over s in [0, 1] of ln|x - (a + s (b - a))| d l, along the edge, per unit of it.
template <class Real>
Real LogAlong(const Vec<Real>& x, const Vec<Real>& a, const Vec<Real>& b)
{
  const Vec<Real> e = b - a;
  const Real length = Length(e);
  const Vec<Real> u = e * (1 / length);
  const Real s0 = Dot(a - x, u);
  const Real s1 = s0 + length;
  const Vec<Real> foot = (a - x) - u * s0;
  const Real h = Length(foot);
  const auto primitive = [&](Real s) {
    const Real r2 = h * h + s * s;
    return r2 > 0 ? s * std::log(r2) / 2 - s + (h > 0 ? h * std::atan2(s, h) : Real(0)) : Real(0);
  };
  return (primitive(s1) - primitive(s0)) / length;
}

/// F from the triangle t[3..5] to t[0..2]: 1/(2 pi A) of the double contour integral of ln r dx.dy.
template <class Real>
Real FormFactor(const std::array<Vec<Real>, 6>& t)
{
  static const long double nodes[4] = { 0.1834346424956498049395L, 0.5255324099163289858177L,
    0.7966664774136267395916L, 0.9602898564975362316836L };
  static const long double weights[4] = { 0.3626837833783619829652L, 0.3137066458778872873380L,
    0.2223810344533744705444L, 0.1012285362903762591525L };
  Real sum = 0;
  for (int i = 0; i < 3; ++i)
  {
    const Vec<Real>& a = t[3 + i];
    const Vec<Real>& b = t[3 + (i + 1) % 3];
    for (int j = 0; j < 3; ++j)
    {
      const Vec<Real>& c = t[j];
      const Vec<Real>& d = t[(j + 1) % 3];
      Real inner = 0;
      for (int k = 0; k < 8; ++k)
      {
        const Real x = static_cast<Real>(k < 4 ? 0.5L - nodes[k] / 2 : 0.5L + nodes[k - 4] / 2);
        inner += static_cast<Real>(weights[k % 4] / 2) * LogAlong(a + (b - a) * x, c, d);
      }
      sum += inner * Dot(b - a, d - c);
    }
  }
  const Real area = Length(Cross(t[4] - t[3], t[5] - t[3])) / 2;
  return std::fabs(sum) / (2 * static_cast<Real>(3.14159265358979323846264L) * area);
}

} // namespace kernels
