// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/EmitterIrradiance.h"

#include "radiometry/irradiance/AreaStage.h"
#include "radiometry/irradiance/ReceiverShare.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>

namespace radiometry
{
namespace
{

/// Parts that a receiver may be cut into.
constexpr int MostParts = 256;

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
  ParallelFor(
    share ? share->Size() : receivers.size(), options.Threads, stage,
    [&](std::size_t k) {
      const std::size_t i = share ? share->Begin()[k] : k;
      const AreaLight light = area.At(receivers[i], i, nothing.data(), effort);
      std::copy(light.Value.begin(), light.Value.end(), &result.Irradiance[k * bands]);
      std::copy(light.Error.begin(), light.Error.end(), &result.Error[k * bands]);
      rays[k] = light.Rays;
    },
    1e-4);
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
