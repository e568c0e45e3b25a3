// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/BeamIrradiance.h"

#include "radiometry/irradiance/BeamLights.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace radiometry
{
namespace
{

/// How far inside its triangles a vertex asks for the light, as a share of the way to the centroid.
constexpr double NudgeShare = 1.0 / 64.0;

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

/// True when rounding hides on which side of a point's plane the light is.
bool InPlane(const SourceFlux& source, const SurfacePoint& p, double extent)
{
  const Light& light = source.GetLight();
  const double height = source.Directional() ? -Dot(p.Normal, light.Direction)
                                             : Dot(p.Normal, light.Position - p.Point);
  const double reach = source.Directional() ? 1.0 : Length(light.Position - p.Point) + extent;
  return height <= 4.0 * Epsilon * reach;
}

/// What of a light reaches a point.
struct Sight
{
  explicit Sight(std::size_t bands)
    : Share(bands, 1.0)
    , Least(bands)
    , Most(bands)
    , One(bands)
  {
  }
  std::vector<double> Share; // of each band
  double Doubt = 0.0;        // of the share
  int Rays = 0;
  std::vector<double> Least, Most, One; // room
};

/// What one place sees of a light.
void Ask(const ShadowCutter& cutter, const RayEnd& from, std::vector<double>& shares)
{
  if (cutter.Transmits())
  {
    cutter.Passing(from, shares.data());
  }
  else
  {
    std::fill(shares.begin(), shares.end(), cutter.Hidden(from) ? 0.0 : 1.0);
  }
}

void See(const Scene& scene, const SourceFlux& source, const ShadowCutter& cutter,
  const SurfacePoint& p, const RayEnd& from, Sight& sight)
{
  sight.Doubt = 0.0;
  sight.Rays = 1;
  if (p.Around.empty())
  {
    Ask(cutter, from, sight.Share);
    return;
  }
  const std::size_t bands = sight.Share.size();
  std::fill(sight.Share.begin(), sight.Share.end(), 0.0);
  std::fill(sight.Least.begin(), sight.Least.end(), 1.0);
  std::fill(sight.Most.begin(), sight.Most.end(), 0.0);
  sight.Rays = 0;
  for (const std::int32_t t : p.Around)
  {
    const Triangle3 around = scene.TriangleAt(t);
    const Vec3 start = p.Point + NudgeShare * (Centroid(around) - p.Point);
    const Vec3 n = AreaNormal2(around);
    if (source.InFront(start, Dot(n, p.Normal) >= 0.0 ? n : -n))
    {
      ++sight.Rays;
      Ask(cutter, { start, t }, sight.One);
      for (std::size_t b = 0; b < bands; ++b)
      {
        sight.Share[b] += sight.One[b];
        sight.Least[b] = std::min(sight.Least[b], sight.One[b]);
        sight.Most[b] = std::max(sight.Most[b], sight.One[b]);
      }
    }
  }
  for (std::size_t b = 0; b < bands && sight.Rays > 0; ++b)
  {
    sight.Share[b] /= sight.Rays;
    // A shadow's edge runs through the vertex.
    sight.Doubt = std::max(sight.Doubt, 0.5 * (sight.Most[b] - sight.Least[b]));
  }
}

} // namespace

void AddBeamIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const DirectOptions& options,
  const StageProgress& stage, ConvergenceRecord* record, DirectResult& result)
{
  const int bands = result.Bands;
  const BeamLights lights(scene, occluders, options, false, {});
  if (lights.Size() == 0 || points.empty())
  {
    return;
  }
  const double extent = Extent(scene);
  std::atomic<std::int64_t> rays{ 0 };
  std::vector<double> unshadowed(points.size(), 0.0);
  ParallelFor(
    points.size(), options.Threads, stage,
    [&](std::size_t i) {
      const SurfacePoint& p = points[i];
      Sight sight(static_cast<std::size_t>(bands));
      RayEnd from{ p.Point, p.Triangle };
      if (p.Triangle < 0 && options.Occlusion)
      {
        from.Triangle = occluders.Touching(from.Point, p.Normal, p.Rounding);
        from.Close = from.Triangle < 0 && occluders.TooClose(from.Point);
      }
      for (std::size_t k = 0; k < lights.Size(); ++k)
      {
        const Light& light = lights.Sources[k]->GetLight();
        const double e = lights.Sources[k]->AtPoint(p.Point, p.Normal);
        if (!(e > 0.0) || InPlane(*lights.Sources[k], p, extent))
        {
          continue;
        }
        unshadowed[i] += e * Magnitude(light);
        if (options.Occlusion)
        {
          See(scene, *lights.Sources[k], *lights.Cutters[k], p, from, sight);
          rays += sight.Rays;
        }
        for (int b = 0; b < bands; ++b)
        {
          const double visible = sight.Share[b];
          result.Irradiance[i * bands + b] += light.Intensity[b] * e * visible;
          result.Error[i * bands + b] +=
            light.Intensity[b] * e * (sight.Doubt + 16.0 * Epsilon * visible);
        }
      }
    },
    1e-6 * static_cast<double>(lights.Size()));
  result.Rays += rays;
  result.PeakUnshadowed += *std::max_element(unshadowed.begin(), unshadowed.end());
  RecordDirect(record, result, std::vector<double>(points.size(), 1.0), "direct light");
}

} // namespace radiometry
