// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/AreaStage.h"

#include "radiometry/geometry/Sampling.h"
#include "radiometry/visibility/PointStarts.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

/// Keys of area lights differ from those of other samples of a run.
constexpr std::uint64_t AreaSalt = 0x61726561ull;

/// The largest coordinate that the scene's numbers were computed with.
double Extent(const Scene& scene)
{
  double extent = Length(scene.Origin);
  for (const Vec3& p : scene.Points)
  {
    extent = std::max({ extent, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z) });
  }
  return extent;
}

} // namespace

AreaStage::AreaStage(const Scene& scene, const OcclusionScene& occluders,
  const AreaSources& sources, bool occlusion,
  std::uint64_t seed)
  : Geometry(scene)
  , Occluders(occluders)
  , Blocking(occlusion && !scene.Triangles.empty() && sources.Size() > 0
        ? std::make_unique<Blockers>(scene)
        : nullptr)
  , View(sources, Blocking.get(), occluders)
  , Receiver(View, Extent(scene))
  , Seed(seed)
{
}

std::vector<ViewPoint> AreaStage::Places(const SurfacePoint& point) const
{
  std::vector<ViewPoint> places;
  if (!this->Blocking)
  {
    return places;
  }
  if (!point.Around.empty())
  {
    for (const PointStart& start : PointStarts(this->Geometry, this->Occluders, point))
    {
      places.push_back({ start.End, point.Normal, start.Normal });
    }
    return places;
  }
  RayEnd end{ point.Point, point.Triangle };
  if (end.Triangle < 0)
  {
    end.Triangle = this->Occluders.Touching(end.Point, point.Normal, point.Rounding);
    end.Close = end.Triangle < 0 && this->Occluders.TooClose(end.Point);
  }
  places.push_back({ end, point.Normal, {} });
  return places;
}

AreaLight AreaStage::At(const Patch& patch, std::size_t index, const double* before,
  const AreaEffort& effort) const
{
  return this->Receiver.AtPatch(patch, Hash64(this->Seed ^ AreaSalt, index), before, effort);
}
AreaLight AreaStage::At(const SurfacePoint& point, std::size_t index, const double* before,
  const AreaEffort& effort) const
{
  return this->Receiver.AtPoint(
    point, this->Places(point), Hash64(this->Seed ^ AreaSalt ^ 1u, index), before, effort);
}

} // namespace radiometry
