// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/PointStarts.h"

namespace radiometry
{
namespace
{

/// How far towards the middle of its triangle a vertex's ray starts.
constexpr double NudgeShare = 1e-3;

} // namespace

std::vector<PointStart> PointStarts(
  const Scene& scene, const OcclusionScene& occluders, const SurfacePoint& point)
{
  std::vector<PointStart> starts;
  for (const std::int32_t t : point.Around)
  {
    const Triangle3 corners = scene.TriangleAt(static_cast<std::size_t>(t));
    const Vec3 n = Normalized(AreaNormal2(corners));
    starts.push_back({ { point.Point + NudgeShare * (Centroid(corners) - point.Point), t, false },
      Dot(n, point.Normal) >= 0.0 ? n : -n });
  }
  if (starts.empty())
  {
    starts.push_back(
      { { point.Point, point.Triangle, point.Triangle < 0 && occluders.TooClose(point.Point) },
        {} });
  }
  return starts;
}

} // namespace radiometry
