// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/PolygonTriangulation.h"

#include "radiometry/geometry/ConvexPolygon.h"
#include "radiometry/geometry/PolygonTriangles.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace radiometry
{
namespace
{

constexpr double Rounding = 1e-13; // of areas, relative to the square of the extent

struct Corner
{
  double u = 0.0; // in the polygon's plane, its extent being 1
  double v = 0.0;
};

double Turn(const Corner& a, const Corner& b, const Corner& c)
{
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}
/// The greatest area vector of the first corner with two others.
Vec3 WidestTurn(const std::vector<Vec3>& corners)
{
  Vec3 widest;
  for (std::size_t i = 1; i < corners.size(); ++i)
  {
    for (std::size_t j = i + 1; j < corners.size(); ++j)
    {
      const Vec3 c = Cross(corners[i] - corners[0], corners[j] - corners[0]);
      widest = LengthSquared(c) > LengthSquared(widest) ? c : widest;
    }
  }
  return widest;
}

/// True when the inner points of two edges cross (touching and overlapping edges do not).
bool Cross2(const Corner& a, const Corner& b, const Corner& c, const Corner& d)
{
  const double ac = Turn(a, b, c), ad = Turn(a, b, d), ca = Turn(c, d, a), cb = Turn(c, d, b);
  return ((ac > Rounding && ad < -Rounding) || (ac < -Rounding && ad > Rounding)) &&
    ((ca > Rounding && cb < -Rounding) || (ca < -Rounding && cb > Rounding));
}

} // namespace

std::vector<Triangle3> TriangulatePolygon(
  const std::vector<Vec3>& corners, const char* array, long long index)
{
  std::vector<Vec3> distinct;
  for (const Vec3& c : corners)
  {
    if (distinct.empty() || !(c == distinct.back()))
    {
      distinct.push_back(c);
    }
  }
  while (distinct.size() > 1 && distinct.front() == distinct.back())
  {
    distinct.pop_back();
  }
  if (distinct.size() < 3)
  {
    return {};
  }
  double extent = 0.0;
  for (const Vec3& c : distinct)
  {
    extent = std::max(extent, Length(c - distinct[0]));
  }
  const Vec3 area2 = AreaNormal2(distinct.data(), distinct.size()) / (extent * extent);
  const bool flat = Length(area2) > 1e-15;
  if (distinct.size() == 3)
  {
    return flat ? std::vector<Triangle3>{ { distinct[0], distinct[1], distinct[2] } }
                : std::vector<Triangle3>{};
  }
  // A figure of eight has no area vector, but a plane.
  const Vec3 n = Normalized(flat ? area2 : WidestTurn(distinct));
  if (n == Vec3{})
  {
    return {}; // all on one line
  }
  Vec3 s, t;
  Frame(n, s, t);
  std::vector<Corner> ring;
  for (const Vec3& corner : distinct)
  {
    const Vec3 p = (corner - distinct[0]) / extent;
    const double off = std::fabs(Dot(n, p));
    if (off > PolygonFlatness)
    {
      throw InputError(array, index, off, "a flat polygon: no corner off its plane by more than " +
          std::string("1e-4 of its extent"));
    }
    ring.push_back({ Dot(s, p), Dot(t, p) });
  }
  for (std::size_t i = 0; i < ring.size(); ++i)
  {
    for (std::size_t j = i + 1; j < ring.size(); ++j)
    {
      if (Cross2(
            ring[i], ring[(i + 1) % ring.size()], ring[j], ring[(j + 1) % ring.size()]))
      {
        throw InputError(array, index, static_cast<double>(i),
          "a polygon whose edges do not cross (the value is the first edge that does)");
      }
    }
  }

  if (!flat)
  {
    return {};
  }

  std::vector<Triangle3> triangles;
  double sum = 0.0;
  for (const auto& corner : PolygonTriangles(distinct))
  {
    triangles.push_back({ distinct[corner[0]], distinct[corner[1]], distinct[corner[2]] });
    sum += Length(AreaNormal2(triangles.back())) / (extent * extent);
  }
  if (std::fabs(sum - Length(area2)) > 1e-6 * Length(area2) + 100.0 * Rounding)
  {
    throw InputError(array, index, 0.5 * sum * extent * extent,
      "a polygon that does not overlap itself: triangles as large as its area vector");
  }
  return triangles;
}

} // namespace radiometry
