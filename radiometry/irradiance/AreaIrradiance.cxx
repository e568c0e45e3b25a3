// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/AreaIrradiance.h"

#include "radiometry/effects/CompiledEffects.h"
#include "radiometry/irradiance/AreaStage.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <numeric>

namespace radiometry
{
namespace
{

std::vector<double> Weights(const std::vector<Patch>& patches)
{
  std::vector<double> weights;
  for (const Patch& p : patches)
  {
    weights.push_back(Area(p.Corners));
  }
  return weights;
}
std::vector<double> Weights(const std::vector<SurfacePoint>& points)
{
  return std::vector<double>(points.size(), 1.0);
}

template <class Receivers>
void Add(const Scene& scene, const OcclusionScene& occluders, const Receivers& receivers,
  const DirectOptions& options, const StageProgress& stage, ConvergenceRecord* record,
  DirectResult& result)
{
  const ConvergenceRecord clock;
  const AreaSources sources(
    scene, Compiled(Effect::Emission) && options.Emission, options.OnlyLight);
  if (sources.Size() == 0 || receivers.empty())
  {
    return;
  }
  Report(stage.Listener, stage.Begin, stage.Name);
  const AreaStage area(scene, occluders, sources, options.Occlusion, options.Transmission);
  const std::vector<double> weights = Weights(receivers);
  const auto bands = static_cast<std::size_t>(result.Bands);
  const std::vector<double> before = result.Irradiance;
  const std::vector<double> beforeError = result.Error;
  std::vector<std::uint8_t> open(receivers.size(), 1);
  std::vector<double> unshadowed(receivers.size(), 0.0);
  std::atomic<std::int64_t> rays{ 0 };
  std::atomic<bool> expired{ false };
  const std::int64_t raysBefore = result.Rays;

  const auto compute = [&](std::size_t i, int work, bool hasty) {
    AreaEffort effort;
    effort.RelativeTolerance = options.RelativeTolerance;
    effort.AbsoluteTolerance = options.AbsoluteTolerance;
    effort.Work = work;
    effort.Hasty = hasty;
    const AreaLight light = area.At(receivers[i], options.NumberOf(i), before.data() + i * bands, effort);
    for (std::size_t b = 0; b < bands; ++b)
    {
      result.Irradiance[i * bands + b] = before[i * bands + b] + light.Value[b];
      result.Error[i * bands + b] = std::hypot(beforeError[i * bands + b], light.Error[b]);
      unshadowed[i] = std::max(unshadowed[i], light.Unshadowed[b]);
    }
    rays += light.Rays;
    open[i] = light.Open ? 1 : 0;
  };

  // Rounds of growing effort on what is not yet good enough.
  constexpr int efforts[] = { 4, 64, 1024 };
  constexpr int rounds = static_cast<int>(std::size(efforts));
  std::vector<std::size_t> todo(receivers.size());
  std::iota(todo.begin(), todo.end(), std::size_t{ 0 });
  for (int round = 0; round < rounds && !todo.empty() && !expired; ++round)
  {
    StageProgress part = stage;
    part.Begin = stage.Begin + round * (stage.End - stage.Begin) / rounds;
    part.End = stage.Begin + (round + 1) * (stage.End - stage.Begin) / rounds;
    ParallelFor(
      todo.size(), options.Threads, part,
      [&](std::size_t k) {
        if (options.SecondsLeft > 0.0 && clock.Elapsed() > options.SecondsLeft)
        {
          expired = true;
        }
        if (round == 0 || !expired)
        {
          compute(todo[k], efforts[round], expired);
        }
      },
      1e-4);
    todo.erase(
      std::remove_if(todo.begin(), todo.end(), [&](std::size_t i) { return open[i] == 0; }),
      todo.end());
    result.Rays = raysBefore + rays;
    RecordDirect(record, result, weights, "area lights");
  }
  result.TimedOut = result.TimedOut || expired;
  result.PeakUnshadowed += *std::max_element(unshadowed.begin(), unshadowed.end());
}

} // namespace

void AddAreaIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const DirectOptions& options, const StageProgress& stage,
  ConvergenceRecord* record, DirectResult& result)
{
  Add(scene, occluders, patches, options, stage, record, result);
}

void AddAreaIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const DirectOptions& options,
  const StageProgress& stage, ConvergenceRecord* record, DirectResult& result)
{
  Add(scene, occluders, points, options, stage, record, result);
}

} // namespace radiometry
