// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/Convexity.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{

Convexity FindConvexity(const Scene& scene)
{
  if (scene.Triangles.empty())
  {
    return Convexity::General;
  }
  // Pairs of a plane and a point: at most about 0.1 s, and of large meshes no more planes than take a
  // small part of what else such a scene costs.
  constexpr std::size_t usual = 100000000;
  constexpr std::size_t planes = 24;
  const std::size_t most = scene.Triangles.size() <= usual / scene.Points.size()
    ? usual
    : std::max(usual / 10, planes * scene.Points.size());
  std::size_t pairs = 0;
  double extent = 0.0;
  for (const Vec3& p : scene.Points)
  {
    extent = std::max({ extent, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z) });
  }
  const double rounding = 1e-12 * extent;
  bool body = true;
  bool room = true;
  Vec3 normal; // of the plane looked at last, and a point of it
  Vec3 origin;
  const auto onLastPlane = [&](const Triangle3& corners) {
    return std::all_of(corners.begin(), corners.end(),
      [&](const Vec3& p) { return std::fabs(Dot(normal, p - origin)) <= rounding; });
  };
  for (std::size_t t = 0; t < scene.Triangles.size(); ++t)
  {
    const Triangle3 corners = scene.TriangleAt(t);
    const Vec3 n = Normalized(AreaNormal2(corners));
    if (Dot(n, normal) > 0.0 && onLastPlane(corners))
    {
      continue; // a floor of many triangles is one plane
    }
    normal = n;
    origin = corners[0];
    bool before = false;
    bool behind = false;
    pairs += scene.Points.size();
    if (pairs > most)
    {
      return Convexity::General;
    }
    for (const Vec3& p : scene.Points)
    {
      const double height = Dot(n, p - corners[0]);
      before = before || height > rounding;
      behind = behind || height < -rounding;
      if (before && behind)
      {
        return Convexity::General;
      }
    }
    body = body && !before;
    room = room && !behind;
  }
  return body ? Convexity::Body : (room ? Convexity::Room : Convexity::Hull);
}

} // namespace radiometry
