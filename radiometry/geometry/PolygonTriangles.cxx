// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/PolygonTriangles.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace radiometry
{
namespace
{

constexpr double Rounding = 8.0 * std::numeric_limits<double>::epsilon();
/// Choices closer than this are ties, so that turning or scaling a polygon does not change its cut.
constexpr double Tie = 1e-9;
/// With more corners than this the first ear is taken, not the best.
constexpr std::size_t Many = 2000;

using Triangles = std::vector<std::array<std::int32_t, 3>>;

struct Point2
{
  double X, Y;
};

Point2 operator-(const Point2& a, const Point2& b)
{
  return { a.X - b.X, a.Y - b.Y };
}
double Cross2(const Point2& a, const Point2& b)
{
  return a.X * b.Y - a.Y * b.X;
}
double Square(const Point2& a)
{
  return a.X * a.X + a.Y * a.Y;
}

/// The corners in the plane of the vector area; false when there is none.
bool Flatten(const std::vector<Vec3>& corners, std::vector<Point2>& flat)
{
  const std::size_t n = corners.size();
  Vec3 normal;
  double longest = 0.0;
  for (std::size_t k = 1; k < n; ++k)
  {
    const Vec3 a = corners[k] - corners[0];
    longest = std::max(longest, Length(a));
    normal += Cross(a, corners[(k + 1) % n] - corners[0]);
  }
  if (!(Length(normal) > Rounding * longest * longest))
  {
    return false;
  }
  normal = Normalized(normal);
  const Vec3 along = std::fabs(normal.x) < 0.6 ? Vec3{ 1, 0, 0 } : Vec3{ 0, 1, 0 };
  const Vec3 u = Normalized(Cross(along, normal));
  const Vec3 v = Cross(normal, u);
  for (const Vec3& p : corners)
  {
    flat.push_back({ Dot(u, p - corners[0]), Dot(v, p - corners[0]) });
  }
  return true;
}

/// Twice the signed area; what rounding cannot tell from zero is zero.
double Turn(const Point2& a, const Point2& b, const Point2& c)
{
  const Point2 ab = b - a;
  const Point2 ac = c - a;
  const double turn = Cross2(ab, ac);
  const double doubt = Rounding * (std::fabs(ab.X * ac.Y) + std::fabs(ab.Y * ac.X));
  return std::fabs(turn) <= doubt ? 0.0 : turn;
}

/// How often the rim turns round: 1 for a polygon that does not cross itself, and for one that walks
/// back on itself, of which nobody can say.
int Turns(const std::vector<Point2>& p)
{
  double sum = 0.0;
  Point2 before{ 0, 0 };
  for (std::size_t k = p.size(); k-- > 0 && Square(before) == 0.0;)
  {
    before = p[0] - p[k];
  }
  for (std::size_t k = 0; k < p.size(); ++k)
  {
    const Point2 edge = p[(k + 1) % p.size()] - p[k];
    if (Square(edge) > 0.0)
    {
      const double along = before.X * edge.X + before.Y * edge.Y;
      if (along < 0.0 && std::fabs(Cross2(before, edge)) <= -Rounding * along)
      {
        return 1;
      }
      sum += std::atan2(Cross2(before, edge), along);
      before = edge;
    }
  }
  constexpr double round = 6.283185307179586;
  return static_cast<int>(std::lround(sum / round));
}

Triangles Quad(const std::vector<Point2>& p)
{
  const double first = std::min(Turn(p[0], p[1], p[2]), Turn(p[0], p[2], p[3]));
  const double second = std::min(Turn(p[0], p[1], p[3]), Turn(p[1], p[2], p[3]));
  const double most = std::max(first, second);
  const double area = Turn(p[0], p[1], p[2]) + Turn(p[0], p[2], p[3]);
  if (!(most >= 0.0) || !(area > 0.0))
  {
    return {};
  }
  const bool shorter = Square(p[3] - p[1]) < (1.0 - Tie) * Square(p[2] - p[0]);
  const bool other = std::fabs(first - second) <= Tie * area ? shorter : second > first;
  return other ? Triangles{ { 0, 1, 3 }, { 1, 2, 3 } } : Triangles{ { 0, 1, 2 }, { 0, 2, 3 } };
}

bool Same(const Point2& a, const Point2& b)
{
  return a.X == b.X && a.Y == b.Y;
}

/// True when no other corner lies in the triangle before - ear - after.
bool Clear(const std::vector<Point2>& p, const std::vector<std::int32_t>& left,
  const std::vector<std::uint8_t>& reflex, const Point2& a, const Point2& b, const Point2& c)
{
  return std::none_of(left.begin(), left.end(), [&](std::int32_t k) {
    const Point2& q = p[k];
    return reflex[k] && !Same(q, a) && !Same(q, b) && !Same(q, c) && Turn(a, b, q) >= 0.0 &&
      Turn(b, c, q) >= 0.0 && Turn(c, a, q) >= 0.0;
  });
}

} // namespace

std::vector<std::array<std::int32_t, 3>> PolygonTriangles(const std::vector<Vec3>& corners)
{
  const std::size_t n = corners.size();
  if (n == 3)
  {
    return { { 0, 1, 2 } };
  }
  std::vector<Point2> p;
  if (n < 3 || !Flatten(corners, p) || Turns(p) != 1)
  {
    return {};
  }
  if (n == 4)
  {
    return Quad(p);
  }

  Triangles triangles;
  std::vector<std::int32_t> left(n);
  std::iota(left.begin(), left.end(), 0);
  std::vector<std::uint8_t> reflex(n);
  const auto turnAt = [&](std::size_t i) {
    const std::size_t m = left.size();
    return Turn(p[left[(i + m - 1) % m]], p[left[i]], p[left[(i + 1) % m]]);
  };
  for (std::size_t i = 0; i < n; ++i)
  {
    reflex[i] = turnAt(i) <= 0.0;
  }
  while (left.size() > 2)
  {
    const std::size_t m = left.size();
    std::size_t best = m;
    std::size_t straight = m;
    double worth = 0.0;
    for (std::size_t i = 0; i < m && (best == m || m < Many); ++i)
    {
      const double turn = turnAt(i);
      if (turn == 0.0)
      {
        straight = std::min(straight, i);
      }
      if (turn <= 0.0)
      {
        continue;
      }
      const Point2& a = p[left[(i + m - 1) % m]];
      const Point2& b = p[left[i]];
      const Point2& c = p[left[(i + 1) % m]];
      const double shape = turn / (Square(b - a) + Square(c - b) + Square(a - c));
      if (shape > worth * (1.0 + Tie) && Clear(p, left, reflex, a, b, c))
      {
        best = i;
        worth = shape;
      }
    }
    if (best == m && straight == m)
    {
      return {}; // crosses itself
    }
    const std::size_t i = best < m ? best : straight;
    if (best < m)
    {
      triangles.push_back({ left[(i + m - 1) % m], left[i], left[(i + 1) % m] });
    }
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
    for (const std::size_t k : { i % left.size(), (i + left.size() - 1) % left.size() })
    {
      reflex[left[k]] = turnAt(k) <= 0.0;
    }
  }
  return triangles;
}

Vec3 PolygonNormal(const std::vector<Vec3>& corners)
{
  Vec3 sum;
  for (std::size_t k = 2; k < corners.size(); ++k)
  {
    sum += Cross(corners[k - 1] - corners[0], corners[k] - corners[0]);
  }
  return Normalized(sum);
}

} // namespace radiometry
