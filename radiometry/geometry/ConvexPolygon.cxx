// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/ConvexPolygon.h"

#include "radiometry/geometry/Sampling.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace radiometry
{
namespace
{

struct Flat
{
  double u = 0.0;
  double v = 0.0;
};

double Turn(const Flat& a, const Flat& b, const Flat& c)
{
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

/// Andrew's monotone chain; collinear corners are left out.
std::vector<Flat> Hull(std::vector<Flat> points)
{
  std::sort(points.begin(), points.end(),
    [](const Flat& a, const Flat& b) { return a.u < b.u || (a.u == b.u && a.v < b.v); });
  std::vector<Flat> hull(2 * points.size());
  std::size_t k = 0;
  const auto add = [&](const Flat& p, std::size_t least) {
    while (k >= least && Turn(hull[k - 2], hull[k - 1], p) <= 0.0)
    {
      --k;
    }
    hull[k++] = p;
  };
  for (const Flat& p : points)
  {
    add(p, 2);
  }
  const std::size_t lower = k + 1;
  for (std::size_t i = points.size() - 1; i-- > 0;)
  {
    add(points[i], lower);
  }
  hull.resize(k > 1 ? k - 1 : k);
  return hull;
}

/// The polygon of `sides` equiangular sides that each touch the hull.
std::vector<Flat> Circumscribed(const std::vector<Flat>& hull, std::size_t sides)
{
  std::vector<double> reach(sides);
  std::vector<Flat> normals(sides);
  for (std::size_t k = 0; k < sides; ++k)
  {
    const double angle = 2.0 * std::acos(-1.0) * static_cast<double>(k) / static_cast<double>(sides);
    normals[k] = { std::cos(angle), std::sin(angle) };
    reach[k] = normals[k].u * hull[0].u + normals[k].v * hull[0].v;
    for (const Flat& p : hull)
    {
      reach[k] = std::max(reach[k], normals[k].u * p.u + normals[k].v * p.v);
    }
  }
  std::vector<Flat> corners;
  for (std::size_t k = 0; k < sides; ++k)
  {
    const std::size_t next = (k + 1) % sides;
    const double d = normals[k].u * normals[next].v - normals[k].v * normals[next].u;
    corners.push_back({ (reach[k] * normals[next].v - reach[next] * normals[k].v) / d,
      (reach[next] * normals[k].u - reach[k] * normals[next].u) / d });
  }
  return corners;
}

} // namespace

bool Split(
  const ConvexPolygon& polygon, const double* heights, ConvexPolygon& above, ConvexPolygon& below)
{
  above.N = 0;
  below.N = 0;
  bool anyAbove = false;
  bool anyBelow = false;
  bool room = true;
  for (int k = 0; k < polygon.N; ++k)
  {
    const int next = k + 1 < polygon.N ? k + 1 : 0;
    const double a = heights[k];
    const double b = heights[next];
    anyAbove = anyAbove || a > 0.0;
    anyBelow = anyBelow || a < 0.0;
    if (a >= 0.0)
    {
      room = above.Add(polygon.P[k]) && room;
    }
    if (a <= 0.0)
    {
      room = below.Add(polygon.P[k]) && room;
    }
    if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0))
    {
      const Vec3 p = polygon.P[k] + (a / (a - b)) * (polygon.P[next] - polygon.P[k]);
      room = above.Add(p) && below.Add(p) && room;
    }
  }
  if (!anyAbove || above.N < 3)
  {
    above.N = 0;
  }
  if (!anyBelow || below.N < 3)
  {
    below.N = 0;
  }
  return room;
}

bool Clip(const ConvexPolygon& polygon, const double* heights, ConvexPolygon& above)
{
  ConvexPolygon below;
  return Split(polygon, heights, above, below);
}

void Halve(const ConvexPolygon& piece, ConvexPolygon halves[2])
{
  // From the middle of the longest edge to the corner or edge opposite.
  int longest = 0;
  double length = -1.0;
  for (int k = 0; k < piece.N; ++k)
  {
    const double l = LengthSquared(piece.P[(k + 1) % piece.N] - piece.P[k]);
    if (l > length)
    {
      length = l;
      longest = k;
    }
  }
  const auto at = [&](int k) { return piece.P[(longest + 1 + k) % piece.N]; };
  const Vec3 start = 0.5 * (at(-1 + piece.N) + at(0));
  const int steps = piece.N - 1; // edges from the longest's end around to its begin
  const int middle = steps / 2;
  const Vec3 end = steps % 2 == 0 ? at(middle) : 0.5 * (at(middle) + at(middle + 1));
  halves[0].Add(start);
  for (int k = 0; k <= middle; ++k)
  {
    halves[0].Add(at(k));
  }
  if (steps % 2 == 1)
  {
    halves[0].Add(end);
  }
  halves[1].Add(end);
  for (int k = middle + 1; k <= steps; ++k)
  {
    halves[1].Add(at(k));
  }
  halves[1].Add(start);
}

double PointToVisiblePolygon(const Vec3& x, const Vec3& n, const ConvexPolygon& polygon)
{
  double sum = 0.0;
  SmallPolygon part;
  for (int first = 1; first + 1 < polygon.N; first += SmallPolygon::Capacity - 2)
  {
    // A fan of pieces about the first corner.
    part.N = 0;
    part.P[part.N++] = polygon.P[0];
    for (int k = first; k < polygon.N && part.N < SmallPolygon::Capacity; ++k)
    {
      part.P[part.N++] = polygon.P[k];
    }
    sum += PointToVisiblePolygon(x, n, part);
  }
  return sum;
}

Vec3 AreaNormal2(const Vec3* corners, std::size_t count)
{
  Vec3 sum;
  for (std::size_t k = 1; k + 1 < count; ++k)
  {
    sum += Cross(corners[k] - corners[0], corners[k + 1] - corners[0]);
  }
  return sum;
}

std::vector<Vec3> Outline(const std::vector<Vec3>& corners, const Vec3& n, std::size_t most)
{
  Vec3 s, t;
  Frame(n, s, t);
  Vec3 middle;
  for (const Vec3& c : corners)
  {
    middle += c / static_cast<double>(corners.size());
  }
  std::vector<Flat> flat;
  for (const Vec3& c : corners)
  {
    flat.push_back({ Dot(s, c - middle), Dot(t, c - middle) });
  }
  std::vector<Flat> hull = Hull(flat);
  if (hull.size() > most)
  {
    hull = Circumscribed(hull, most);
  }
  std::vector<Vec3> outline;
  for (const Flat& p : hull)
  {
    // The given corner where it is one: its coordinates carry no rounding of this function's.
    Vec3 corner = middle + p.u * s + p.v * t;
    for (std::size_t k = 0; k < flat.size(); ++k)
    {
      if (flat[k].u == p.u && flat[k].v == p.v)
      {
        corner = corners[k];
      }
    }
    outline.push_back(corner);
  }
  return outline;
}

} // namespace radiometry
