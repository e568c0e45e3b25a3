// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/DirectIrradiance.h"

#include "radiometry/effects/CompiledEffects.h"
#include "radiometry/irradiance/DirectRun.h"
#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

/// Whether the lights of a kind, or emitting surfaces, take part, and so need time.
template <typename Kind>
bool AnyLight(const Scene& scene, const DirectOptions& options, const Kind& isOfKind)
{
  for (std::size_t k = 0; k < scene.Lights.size(); ++k)
  {
    if (options.Takes(k) && scene.Lights[k].Enabled && isOfKind(scene.Lights[k].Type))
    {
      return true;
    }
  }
  return false;
}
} // namespace

bool AnyBeam(const Scene& scene, const DirectOptions& options)
{
  return AnyLight(scene, options, [](LightType type) {
    return (Compiled(Effect::PointLights) && type == LightType::Point) ||
      (Compiled(Effect::SpotLights) && type == LightType::Spot) ||
      (Compiled(Effect::DirectionalLights) && type == LightType::Directional);
  });
}
bool AnyArea(const Scene& scene, const DirectOptions& options)
{
  const auto lit = [](const std::vector<double>& exitance) {
    return std::any_of(exitance.begin(), exitance.end(), [](double m) { return m > 0.0; });
  };
  return (Compiled(Effect::AreaLights) &&
           AnyLight(scene, options, [](LightType type) { return type == LightType::Area; })) ||
    (Compiled(Effect::Emission) && options.Emission &&
      (lit(scene.Optics.EmittedExitance[0]) || lit(scene.Optics.EmittedExitance[1])));
}
bool AnySky(const Scene& scene, const DirectOptions& options)
{
  return Compiled(Effect::Environment) && options.Environment &&
    AnyLight(scene, options, [](LightType type) { return type == LightType::Environment; });
}

namespace
{

template <typename Receiver>
DirectResult Compute(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Receiver>& receivers, const DirectOptions& options,
  const StageProgress& stage, ConvergenceRecord* record)
{
  if (receivers.empty())
  {
    DirectResult nothing;
    nothing.Bands = scene.Optics.Bands;
    return nothing;
  }
  const ConvergenceRecord clock;
  StageProgress making = stage;
  making.End = stage.Begin + 0.1 * (stage.End - stage.Begin);
  StageProgress running = stage;
  running.Begin = making.End;
  DirectRun<Receiver> run(
    scene, occluders, receivers, options, making, nullptr, record != nullptr);
  run.Finish(running, record,
    options.SecondsLeft > 0.0 ? std::max(1e-9, options.SecondsLeft - clock.Elapsed()) : 0.0);
  DirectResult result = run.Result(record);
  CheckFinite(result);
  Report(stage.Listener, stage.End, stage.Name);
  return result;
}

} // namespace

void CheckFinite(const DirectResult& result)
{
  for (std::size_t i = 0; i < result.Irradiance.size(); ++i)
  {
    if (!std::isfinite(result.Irradiance[i]) || !std::isfinite(result.Error[i]))
    {
      throw InputError("Irradiance", static_cast<long long>(i / static_cast<std::size_t>(result.Bands)),
        result.Irradiance[i], "a number below 1e308 W/m^2: less intensity, or lights less near");
    }
  }
}

void AddRounds(const Communicator* ranks, const std::vector<DirectRound>& rounds,
  const char* stage, ConvergenceRecord& record)
{
  double most = static_cast<double>(rounds.size());
  if (ranks)
  {
    ranks->Largest(&most, 1);
  }
  for (std::size_t r = 0; r < static_cast<std::size_t>(most); ++r)
  {
    // A rank that has finished keeps what it has.
    const DirectRound round =
      rounds.empty() ? DirectRound() : rounds[std::min(r, rounds.size() - 1)];
    double sums[4] = { round.Value, round.Error, round.Weight, round.Rays };
    double seconds = round.Seconds;
    if (ranks)
    {
      ranks->Sum(sums, 4);
      ranks->Largest(&seconds, 1);
    }
    record.Rows.push_back({ seconds, sums[0] > 0.0 ? sums[1] / sums[0] : 0.0,
      sums[2] > 0.0 ? sums[1] / sums[2] : 0.0, static_cast<std::int64_t>(sums[3]), stage, {} });
  }
}

DirectResult ComputeDirectIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const DirectOptions& options, const StageProgress& stage,
  ConvergenceRecord* record)
{
  return Compute(scene, occluders, patches, options, stage, record);
}

DirectResult ComputeDirectIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const DirectOptions& options,
  const StageProgress& stage, ConvergenceRecord* record)
{
  return Compute(scene, occluders, points, options, stage, record);
}

} // namespace radiometry
