// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/AreaStage.h"

#include "radiometry/effects/CompiledEffects.h"
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

/// True when panes let through the same in two bands.
bool SameTransmittance(const Scene& scene, std::size_t a, std::size_t b)
{
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  for (std::size_t t = 0; t < scene.Triangles.size(); ++t)
  {
    if (scene.TriangleTransmittance[t * bands + a] != scene.TriangleTransmittance[t * bands + b])
    {
      return false;
    }
  }
  return true;
}

} // namespace

AreaStage::AreaStage(const Scene& scene, const OcclusionScene& occluders,
  const AreaSources& sources, bool occlusion, bool transmission, std::uint64_t seed)
  : Geometry(scene)
  , Occluders(occluders)
  , Blocking(occlusion && !scene.Triangles.empty() && sources.Size() > 0
        ? std::make_unique<Blockers>(scene)
        : nullptr)
  , ViewOfBand(static_cast<std::size_t>(scene.Optics.Bands), 0)
  , Seed(seed)
{
  const bool panes =
    Compiled(Effect::Transmission) && this->Blocking && transmission && occluders.HasPanes();
  std::vector<std::size_t> first; // band of each view
  for (std::size_t b = 0; b < this->ViewOfBand.size() && panes; ++b)
  {
    std::size_t v = 0;
    while (v < first.size() && !SameTransmittance(scene, first[v], b))
    {
      ++v;
    }
    this->ViewOfBand[b] = v;
    if (v == first.size())
    {
      first.push_back(b);
      this->Views.push_back(std::make_unique<SourceView>(
        sources, this->Blocking.get(), occluders, static_cast<int>(b)));
    }
  }
  if (this->Views.empty())
  {
    this->Views.push_back(std::make_unique<SourceView>(sources, this->Blocking.get(), occluders));
  }
  for (const auto& view : this->Views)
  {
    this->Receivers.emplace_back(*view, Extent(scene));
  }
}

/// Puts the bands of all views together.
template <class Ask>
AreaLight AreaStage::Gather(const Ask& ask) const
{
  AreaLight light = ask(this->Receivers[0]);
  for (std::size_t v = 1; v < this->Receivers.size(); ++v)
  {
    const AreaLight other = ask(this->Receivers[v]);
    for (std::size_t b = 0; b < this->ViewOfBand.size(); ++b)
    {
      if (this->ViewOfBand[b] == v)
      {
        light.Value[b] = other.Value[b];
        light.Error[b] = other.Error[b];
      }
    }
    light.Rays += other.Rays;
    light.Dropped = std::max(light.Dropped, other.Dropped);
    light.Open = light.Open || other.Open;
    light.Improvable = light.Improvable || other.Improvable;
  }
  return light;
}

std::vector<ViewPoint> AreaStage::Places(const SurfacePoint& point) const
{
  std::vector<ViewPoint> places;
  if (!this->Blocking)
  {
    return places;
  }
  if (!point.Around.empty() && this->Blocking->FlatAt(point.Point, point.Normal))
  {
    // In the middle of a flat surface what the vertex itself sees is well defined.
    return { { point.Point, { point.Point, point.Around.front() }, point.Normal, {} } };
  }
  if (!point.Around.empty())
  {
    for (const PointStart& start : PointStarts(this->Geometry, this->Occluders, point))
    {
      places.push_back({ start.End.Point, start.End, point.Normal, start.Normal });
    }
    return places;
  }
  RayEnd end{ point.Point, point.Triangle };
  if (end.Triangle < 0)
  {
    end.Triangle = this->Occluders.Touching(end.Point, point.Normal, point.Rounding);
    end.Close = end.Triangle < 0 && this->Occluders.TooClose(end.Point);
  }
  Vec3 place = point.Point;
  if (point.Triangle < 0 && end.Triangle >= 0)
  {
    // Onto the triangle's plane, but not off its rim.
    const Vec3 n =
      Normalized(AreaNormal2(this->Geometry.TriangleAt(static_cast<std::size_t>(end.Triangle))));
    place += Dot(n, end.Point - place) * n;
  }
  places.push_back({ place, end, point.Normal, {} });
  return places;
}

AreaLight AreaStage::At(const Patch& patch, std::size_t index, const double* before,
  const AreaEffort& effort) const
{
  return this->Gather([&](const AreaReceiver& receiver) {
    return receiver.AtPatch(patch, Hash64(this->Seed ^ AreaSalt, index), before, effort);
  });
}
AreaLight AreaStage::At(const SurfacePoint& point, std::size_t index, const double* before,
  const AreaEffort& effort) const
{
  const std::vector<ViewPoint> places = this->Places(point);
  return this->Gather([&](const AreaReceiver& receiver) {
    return receiver.AtPoint(
      point, places, Hash64(this->Seed ^ AreaSalt ^ 1u, index), before, effort);
  });
}

} // namespace radiometry
