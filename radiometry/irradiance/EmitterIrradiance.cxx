// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/EmitterIrradiance.h"

#include "radiometry/accuracy/ConvergenceRecord.h"
#include "radiometry/irradiance/AreaStage.h"
#include "radiometry/irradiance/ReceiverShare.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <numeric>

namespace radiometry
{
namespace
{

/// Parts that a receiver may be cut into; at first, where time is short.
constexpr int MostParts = 256;
constexpr int FewParts = 4;

template <class Receivers>
EmitterResult Compute(const Scene& scene, const OcclusionScene& occluders,
  const Receivers& receivers, const EmitterSet& emitters, const ExchangeOptions& options,
  const StageProgress& stage)
{
  const auto bands = static_cast<std::size_t>(emitters.Bands);
  EmitterResult result;
  result.Irradiance.assign(receivers.size() * bands, 0.0);
  result.Error = result.Irradiance;
  const AreaSources sources(emitters);
  const AreaStage area(scene, occluders, sources, options.Occlusion, false, options.Seed);
  const std::vector<double> nothing(bands, 0.0);
  std::vector<std::int64_t> rays(receivers.size(), 0);
  AreaEffort effort;
  effort.RelativeTolerance = options.RelativeTolerance;
  effort.Work = MostParts;
  // Of several ranks each computes its share, at the places that these have in it.
  std::vector<std::uint32_t> order, first;
  std::unique_ptr<ReceiverShare> share;
  if (options.Ranks)
  {
    PlainGroups(receivers.size(), order, first);
    share = std::make_unique<ReceiverShare>(*options.Ranks, order, first);
  }
  const std::size_t count = share ? share->Size() : receivers.size();
  const ConvergenceRecord clock;
  std::vector<std::uint8_t> open(options.SecondsLeft > 0.0 ? count : 0, 0); // could be more exact
  std::atomic<bool> late{ false };
  const auto take = [&](std::size_t k, const AreaLight& light) {
    std::copy(light.Value.begin(), light.Value.end(), &result.Irradiance[k * bands]);
    std::copy(light.Error.begin(), light.Error.end(), &result.Error[k * bands]);
    rays[k] += light.Rays;
  };
  const auto number = [&](std::size_t k) { return share ? share->Begin()[k] : k; };
  StageProgress last = stage;
  if (options.SecondsLeft > 0.0)
  {
    AreaEffort little = effort;
    little.Work = FewParts;
    StageProgress part = stage;
    part.End = last.Begin = 0.5 * (stage.Begin + stage.End);
    ParallelFor(
      count, options.Threads, part,
      [&](std::size_t k) {
        const std::size_t i = number(k);
        const bool blind = clock.Elapsed() > 0.5 * options.SecondsLeft;
        const AreaLight light = blind ? BoundArea(sources, receivers[i])
                                      : area.At(receivers[i], i, nothing.data(), little);
        take(k, light);
        open[k] = blind || light.Open;
      },
      1e-5);
  }
  ParallelFor(
    count, options.Threads, last,
    [&](std::size_t k) {
      if (!open.empty())
      {
        if (!open[k])
        {
          return;
        }
        if (clock.Elapsed() > options.SecondsLeft)
        {
          late = true;
          return;
        }
      }
      take(k, area.At(receivers[number(k)], number(k), nothing.data(), effort));
    },
    1e-4);
  result.TimedOut = late;
  result.Rays = std::accumulate(rays.begin(), rays.end(), std::int64_t{ 0 });
  if (share)
  {
    result.Irradiance.resize(share->Size() * bands);
    result.Error.resize(share->Size() * bands);
    result.Irradiance = share->Gather(result.Irradiance, bands);
    result.Error = share->Gather(result.Error, bands);
    options.Ranks->Sum(&result.Rays, 1);
  }
  return result;
}

} // namespace

EmitterResult ComputeEmitterIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& receivers, const EmitterSet& emitters, const ExchangeOptions& options,
  const StageProgress& stage)
{
  return Compute(scene, occluders, receivers, emitters, options, stage);
}

EmitterResult ComputeEmitterIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const EmitterSet& emitters,
  const ExchangeOptions& options, const StageProgress& stage)
{
  return Compute(scene, occluders, points, emitters, options, stage);
}

} // namespace radiometry
