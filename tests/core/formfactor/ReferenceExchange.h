// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

/// The exchange of two triangles in extended precision, by a route of its own: clipped by each other's
/// planes, then the double contour integral, its inner one in closed form and its outer one by
/// bisection with Gauss rules of 16 points until nothing changes. Slow.
namespace reference
{

using Real = long double;
using Point = std::array<Real, 3>;
using Polygon = std::vector<Point>;

inline Point operator-(const Point& a, const Point& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}
inline Point Along(const Point& a, Real s, const Point& d)
{
  return { a[0] + s * d[0], a[1] + s * d[1], a[2] + s * d[2] };
}
inline Real Dot(const Point& a, const Point& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point Cross(const Point& a, const Point& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}
inline Real Length(const Point& a)
{
  return std::sqrt(Dot(a, a));
}

inline Polygon Of(const radiometry::Triangle3& t)
{
  Polygon polygon;
  for (const radiometry::Vec3& p : t)
  {
    polygon.push_back({ p.x, p.y, p.z });
  }
  return polygon;
}

/// The part of a polygon before the plane of a triangle; corners that rounding of doubles cannot tell
/// from the plane lie on it.
inline Polygon Before(const Polygon& polygon, const Polygon& plane)
{
  Point n = Cross(plane[1] - plane[0], plane[2] - plane[0]);
  const Real l = Length(n);
  Real size = 0;
  for (const Point& p : polygon)
  {
    size = std::max({ size, std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2]) });
  }
  std::vector<Real> h;
  for (const Point& p : polygon)
  {
    const Real height = Dot(n, p - plane[0]) / l;
    h.push_back(std::fabs(height) < 1e-16L * size ? 0 : height);
  }
  Polygon part;
  for (std::size_t k = 0; k < polygon.size(); ++k)
  {
    const std::size_t next = (k + 1) % polygon.size();
    if (h[k] >= 0)
    {
      part.push_back(polygon[k]);
    }
    if ((h[k] > 0 && h[next] < 0) || (h[k] < 0 && h[next] > 0))
    {
      part.push_back(Along(polygon[k], h[k] / (h[k] - h[next]), polygon[next] - polygon[k]));
    }
  }
  return *std::max_element(h.begin(), h.end()) > 0 ? part : Polygon();
}

/// int_0^L ln |d + t u| dt.
inline Real Inner(const Point& d, const Point& u, Real length)
{
  const Real t0 = Dot(d, u), t1 = t0 + length;
  const Real h = Length(Cross(d, u));
  const auto at = [&](Real t) {
    const Real r2 = t * t + h * h;
    return r2 > 0 ? t * std::log(r2) / 2 : 0;
  };
  return at(t1) - at(t0) - length +
    (h > 0 ? h * (std::atan2(t1, h) - std::atan2(t0, h)) : 0);
}

template <class F>
Real Gauss(F&& f, Real a, Real b)
{
  static const auto rule = [] {
    // Newton's method on the Legendre polynomial.
    std::vector<std::pair<Real, Real>> r;
    const int n = 16;
    for (int k = 0; k < n; ++k)
    {
      Real x = std::cos(3.14159265358979323846L * (k + 0.75L) / (n + 0.5L)), d = 0;
      for (int step = 0; step < 8; ++step)
      {
        Real p0 = 1, p1 = x;
        for (int m = 2; m <= n; ++m)
        {
          const Real p2 = ((2 * m - 1) * x * p1 - (m - 1) * p0) / m;
          p0 = p1;
          p1 = p2;
        }
        d = n * (x * p1 - p0) / (x * x - 1);
        x -= p1 / d;
      }
      r.emplace_back(x, 2 / ((1 - x * x) * d * d));
    }
    return r;
  }();
  Real sum = 0;
  for (const auto& [x, w] : rule)
  {
    sum += w * f((a + b) / 2 + (b - a) / 2 * x);
  }
  return sum * (b - a) / 2;
}

template <class F>
Real Bisect(F&& f, Real a, Real b, Real whole, Real least, int depth)
{
  const Real middle = (a + b) / 2;
  const Real left = Gauss(f, a, middle), right = Gauss(f, middle, b);
  if (depth > 60 || std::fabs(left + right - whole) <= least)
  {
    return left + right;
  }
  return Bisect(f, a, middle, left, least, depth + 1) +
    Bisect(f, middle, b, right, least, depth + 1);
}

/// A_i F_ij.
inline double Exchange(const radiometry::Triangle3& i, const radiometry::Triangle3& j)
{
  Polygon a = Before(Of(i), Of(j)), b = Before(Of(j), Of(i));
  if (a.size() < 3 || b.size() < 3)
  {
    return 0.0;
  }
  const auto size = [](const Polygon& polygon) {
    Real most = 0;
    for (const Point& p : polygon)
    {
      most = std::max(most, Length(p - polygon[0]));
    }
    return most;
  };
  // In units of the smaller polygon about one of its corners.
  if (size(b) < size(a))
  {
    std::swap(a, b);
  }
  const Real unit = size(a);
  const auto scaled = [&](const Point& p) {
    const Point d = p - a[0];
    return Point{ d[0] / unit, d[1] / unit, d[2] / unit };
  };
  Real sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    const Point p = scaled(a[k]), e = scaled(a[(k + 1) % a.size()]) - p;
    const Real length = Length(e);
    for (std::size_t l = 0; l < b.size() && length > 0; ++l)
    {
      const Point q = scaled(b[l]), g = scaled(b[(l + 1) % b.size()]) - q;
      const Real inner = Length(g);
      if (!(inner > 0))
      {
        continue;
      }
      const Point u{ g[0] / inner, g[1] / inner, g[2] / inner };
      const auto f = [&](Real s) { return Inner(q - Along(p, s, e), u, inner); };
      sum += Dot(e, u) * Bisect(f, 0, 1, Gauss(f, 0, 1), 1e-16L, 0);
    }
  }
  return static_cast<double>(sum * unit * unit / (2 * 3.14159265358979323846L));
}

} // namespace reference
