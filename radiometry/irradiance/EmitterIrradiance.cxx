// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/EmitterIrradiance.h"

#include "radiometry/geometry/PairExchange.h"
#include "radiometry/geometry/PolygonFormFactor.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/visibility/PairVisibility.h"
#include "radiometry/visibility/PointStarts.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

/// Keys of pairs with an emitter differ from those of other pairs of the run.
constexpr std::uint64_t EmitterSalt = 0x656d6974746572ull;
constexpr int MostRays = 4096;

/// The brightest band of each emitter.
std::vector<double> Strengths(const EmitterSet& emitters)
{
  std::vector<double> strength(emitters.Patches.size(), 0.0);
  for (std::size_t k = 0; k < emitters.Exitance.size(); ++k)
  {
    auto& s = strength[k / static_cast<std::size_t>(emitters.Bands)];
    s = std::max(s, emitters.Exitance[k]);
  }
  return strength;
}

/// Adds one emitter's part to the sums of a receiver.
void Accumulate(const EmitterSet& emitters, std::size_t j, double factor, double geometry,
  double visibility, std::size_t i, EmitterResult& result)
{
  const auto nb = static_cast<std::size_t>(emitters.Bands);
  for (std::size_t b = 0; b < nb; ++b)
  {
    const double m = emitters.Exitance[j * nb + b];
    result.Irradiance[i * nb + b] += factor * m;
    result.GeometryError[i * nb + b] += geometry * m;
    result.VisibilityError[i * nb + b] +=
      visibility * visibility * m * m; // variances until the end
  }
}

EmitterResult Sized(std::size_t receivers, const EmitterSet& emitters)
{
  EmitterResult result;
  const std::size_t values = receivers * static_cast<std::size_t>(emitters.Bands);
  result.Irradiance.assign(values, 0.0);
  result.GeometryError.assign(values, 0.0);
  result.VisibilityError.assign(values, 0.0);
  return result;
}

void Finish(const std::vector<std::int64_t>& rays, EmitterResult& result)
{
  for (double& v : result.VisibilityError)
  {
    v = std::sqrt(v);
  }
  for (const std::int64_t r : rays)
  {
    result.Rays += r;
  }
}

/// Visible fraction of one emitter from a point, as PairVisibility.
PairVisibilityResult PointVisibility(const OcclusionScene& scene, const SurfacePoint& point,
  const std::vector<PointStart>& starts, const ExchangePatch& emitter, std::int32_t triangle,
  std::uint64_t key, double wanted)
{
  constexpr int sets = 4;
  PairVisibilityResult result;
  double weight[sets] = {}, visible[sets] = {}, all = 0.0, sum = 0.0, spread = 0.0;
  int done = 0;
  const auto sampleTo = [&](int count) {
    for (; done < count; ++done)
    {
      for (int set = 0; set < sets; ++set)
      {
        const auto u = SobolSequence(Hash64(key, static_cast<std::uint64_t>(set)))(
          static_cast<std::uint32_t>(done));
        const Vec3 y = TrianglePoint(emitter.Corners, u[0], u[1]);
        const Vec3 r = y - point.Point;
        const double r2 = LengthSquared(r);
        const double kernel =
          std::max(0.0, Dot(point.Normal, r)) * std::max(0.0, -Dot(emitter.Normal, r)) / (r2 * r2);
        const auto first = static_cast<std::size_t>(u[2] * static_cast<double>(starts.size()));
        const PointStart* start = nullptr;
        for (std::size_t s = 0; s < starts.size() && !start; ++s)
        {
          const PointStart& candidate = starts[(first + s) % starts.size()];
          if (point.Around.empty() || Dot(candidate.Normal, y - candidate.End.Point) > 0.0)
          {
            start = &candidate;
          }
        }
        if (!(kernel > 0.0) || !start)
        {
          continue;
        }
        ++result.Rays;
        weight[set] += kernel;
        all += kernel;
        if (!scene.Occluded(start->End, { y, triangle }))
        {
          visible[set] += kernel;
          sum += kernel;
        }
      }
    }
    result.Fraction = all > 0.0 ? sum / all : 0.0; // nothing of it above the surface
    spread = 0.0;
    for (int set = 0; set < sets && all > 0.0; ++set)
    {
      const double off = (visible[set] - result.Fraction * weight[set]) / all;
      spread += off * off * sets / (sets - 1.0);
    }
  };
  sampleTo(4);
  while (sets * done < MostRays && spread > wanted * wanted)
  {
    sampleTo(2 * done);
  }
  result.Error = std::sqrt(spread);
  return result;
}

} // namespace

EmitterResult ComputeEmitterIrradiance(const OcclusionScene& occluders,
  const std::vector<Patch>& receivers, const EmitterSet& emitters, const ExchangeOptions& options,
  const StageProgress& stage)
{
  EmitterResult result = Sized(receivers.size(), emitters);
  std::vector<ExchangePatch> shapes;
  for (const Patch& p : emitters.Patches)
  {
    shapes.emplace_back(p.Corners);
  }
  const std::vector<double> strength = Strengths(emitters);
  const double tolerance = std::clamp(0.05 * options.RelativeTolerance, 1e-9, 1e-3);
  std::vector<std::int64_t> rays(receivers.size(), 0);
  ParallelFor(
    receivers.size(), options.Threads, stage,
    [&](std::size_t i) {
      const Patch& receiver = receivers[i];
      const ExchangePatch shape(receiver.Corners);
      std::vector<PairExchangeResult> pairs(shapes.size());
      double total = 0.0; // what would arrive if nothing hid
      for (std::size_t j = 0; j < shapes.size(); ++j)
      {
        if (emitters.Patches[j].Triangle != receiver.Triangle)
        {
          pairs[j] = PairExchange(shape, shapes[j], tolerance);
          total += pairs[j].Value * strength[j];
        }
      }
      for (std::size_t j = 0; j < shapes.size(); ++j)
      {
        if (!(pairs[j].Value > 0.0))
        {
          continue;
        }
        PairVisibilityResult v;
        if (options.Occlusion)
        {
          // Even parts of half the tolerance over the emitters, by their share.
          const double share = pairs[j].Value * strength[j] / total;
          const double wanted = 0.5 * options.RelativeTolerance / std::sqrt(share);
          const std::uint64_t key =
            Hash64(options.Seed ^ EmitterSalt, (static_cast<std::uint64_t>(i) << 32) | j);
          v = PairVisibility(occluders, shape, receiver.Triangle, shapes[j],
            emitters.Patches[j].Triangle, key, share > 0.05 ? 32 : 8, MostRays, wanted);
          rays[i] += v.Rays;
        }
        Accumulate(emitters, j, pairs[j].Value * v.Fraction / shape.Area,
          pairs[j].Error / shape.Area, v.Error * pairs[j].Value / shape.Area, i, result);
      }
    },
    1e-5 * static_cast<double>(shapes.size() + 1));
  Finish(rays, result);
  return result;
}

EmitterResult ComputeEmitterIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const EmitterSet& emitters,
  const ExchangeOptions& options, const StageProgress& stage)
{
  EmitterResult result = Sized(points.size(), emitters);
  std::vector<ExchangePatch> shapes;
  for (const Patch& p : emitters.Patches)
  {
    shapes.emplace_back(p.Corners);
  }
  const std::vector<double> strength = Strengths(emitters);
  std::vector<std::int64_t> rays(points.size(), 0);
  ParallelFor(
    points.size(), options.Threads, stage,
    [&](std::size_t i) {
      const SurfacePoint& point = points[i];
      const std::vector<PointStart> starts = PointStarts(scene, occluders, point);
      std::vector<double> factors(shapes.size(), 0.0);
      double total = 0.0;
      for (std::size_t j = 0; j < shapes.size(); ++j)
      {
        if (point.Triangle < 0 || emitters.Patches[j].Triangle != point.Triangle)
        {
          factors[j] = PointToPolygon(point.Point, point.Normal, SmallPolygon(shapes[j].Corners));
          total += factors[j] * strength[j];
        }
      }
      for (std::size_t j = 0; j < shapes.size(); ++j)
      {
        if (!(factors[j] > 0.0))
        {
          continue;
        }
        PairVisibilityResult v;
        if (options.Occlusion)
        {
          const double share = factors[j] * strength[j] / total;
          const std::uint64_t key = Hash64(options.Seed ^ EmitterSalt ^ 0x706f696e74ull,
            (static_cast<std::uint64_t>(i) << 32) | j);
          v = PointVisibility(occluders, point, starts, shapes[j], emitters.Patches[j].Triangle,
            key, 0.5 * options.RelativeTolerance / std::sqrt(share));
          rays[i] += v.Rays;
        }
        Accumulate(emitters, j, factors[j] * v.Fraction, 1e-12 * factors[j], v.Error * factors[j],
          i, result);
      }
    },
    1e-5 * static_cast<double>(shapes.size() + 1));
  Finish(rays, result);
  return result;
}

} // namespace radiometry
