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
        double visible = 1.0;
        double doubt = 0.0;
        if (options.Occlusion && p.Around.empty())
        {
          ++rays;
          visible = lights.Cutters[k]->Hidden(from) ? 0.0 : 1.0;
        }
        else if (options.Occlusion)
        {
          int asked = 0;
          int lit = 0;
          for (const std::int32_t t : p.Around)
          {
            const Triangle3 around = scene.TriangleAt(t);
            const Vec3 start = p.Point + NudgeShare * (Centroid(around) - p.Point);
            const Vec3 n = AreaNormal2(around);
            if (lights.Sources[k]->InFront(start, Dot(n, p.Normal) >= 0.0 ? n : -n))
            {
              ++asked;
              lit += lights.Cutters[k]->Hidden({ start, t }) ? 0 : 1;
            }
          }
          rays += asked;
          visible = asked > 0 ? static_cast<double>(lit) / asked : 0.0;
          doubt = lit > 0 && lit < asked ? 0.5 : 0.0; // a shadow's edge runs through the vertex
        }
        for (int b = 0; b < bands; ++b)
        {
          result.Irradiance[i * bands + b] += light.Intensity[b] * e * visible;
          result.Error[i * bands + b] += light.Intensity[b] * e * (doubt + 16.0 * Epsilon * visible);
        }
      }
    },
    1e-6 * static_cast<double>(lights.Size()));
  result.Rays += rays;
  result.PeakUnshadowed += *std::max_element(unshadowed.begin(), unshadowed.end());
  RecordDirect(record, result, std::vector<double>(points.size(), 1.0), "direct light");
}

} // namespace radiometry
