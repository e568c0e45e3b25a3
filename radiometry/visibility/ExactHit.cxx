// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/ExactHit.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace radiometry
{
namespace
{

// An end closer than this to a triangle's plane lies on it: rounding of coordinates in [-1, 1].
constexpr double OnPlane = 1e-14;
// A ray closer than this to a triangle's rim meets it: the same rounding.
constexpr double OnRim = 1e-14;
// How far outside a triangle, relative to its edge functions, a hit near an end may be before
// single precision cannot have meant one of its neighbours.
constexpr double NeighbourMargin = 4e-6;

} // namespace

EdgeFunctions FindEdgeFunctions(const RayQuery& ray, const Triangle3& triangle)
{
  double volumes[3];
  double longest = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    Vec3 a = triangle[k];
    Vec3 b = triangle[(k + 1) % 3];
    const bool swap = std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z);
    if (swap)
    {
      std::swap(a, b);
    }
    const double volume = Dot(ray.Direction, Cross(a - ray.Start, b - a));
    longest = std::max(longest, Length(b - a));
    volumes[k] = swap ? -volume : volume;
  }
  const auto [least, most] = std::minmax({ volumes[0], volumes[1], volumes[2] });
  const double middle = std::max(std::min(volumes[0], volumes[1]),
    std::min(std::max(volumes[0], volumes[1]), volumes[2]));
  return { least, middle, most, longest };
}

Verdict Judge(const RayQuery& ray, std::int32_t t, bool strict, double& distance)
{
  if (t == ray.FromTriangle || t == ray.ToTriangle || (ray.Passed && (*ray.Passed)[t]))
  {
    return Verdict::Miss;
  }
  const Triangle3& v = (*ray.Triangles)[t];
  const Vec3& n = (*ray.Normals)[t];
  const double h0 = Dot(n, ray.Start - v[0]);
  const double rate = Dot(n, ray.Direction);
  if (std::fabs(h0) <= OnPlane || h0 * rate >= 0.0)
  {
    return Verdict::Miss; // starts on the plane or moves away from it
  }
  distance = -h0 / rate;
  if (std::isfinite(ray.Length))
  {
    const double h1 = Dot(n, ray.Start + ray.Length * ray.Direction - v[0]);
    if (std::fabs(h1) <= OnPlane || (h0 > 0.0) == (h1 > 0.0))
    {
      return Verdict::Miss;
    }
  }
  if (!strict)
  {
    return Verdict::Hit;
  }
  // What rounding cannot tell from the rim meets it: closed bodies have no cracks.
  const EdgeFunctions f = FindEdgeFunctions(ray, v);
  if (f.Least >= -OnRim * f.Scale || f.Most <= OnRim * f.Scale)
  {
    return Verdict::Hit;
  }
  const double outside = std::min(-f.Least, f.Most);
  return outside < NeighbourMargin * f.Scale ? Verdict::RimMiss : Verdict::Miss;
}

} // namespace radiometry
