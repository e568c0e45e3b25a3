// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/EmitterIrradiance.h"

#include "radiometry/irradiance/AreaStage.h"

#include <algorithm>

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
  ParallelFor(
    receivers.size(), options.Threads, stage,
    [&](std::size_t i) {
      const AreaLight light = area.At(receivers[i], i, nothing.data(), effort);
      std::copy(light.Value.begin(), light.Value.end(), &result.Irradiance[i * bands]);
      std::copy(light.Error.begin(), light.Error.end(), &result.Error[i * bands]);
      rays[i] = light.Rays;
    },
    1e-4);
  for (const std::int64_t r : rays)
  {
    result.Rays += r;
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
