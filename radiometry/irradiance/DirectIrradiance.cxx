// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/DirectIrradiance.h"

#include "radiometry/effects/CompiledEffects.h"
#include "radiometry/irradiance/AreaIrradiance.h"
#include "radiometry/irradiance/BeamIrradiance.h"
#include "radiometry/irradiance/PatchClusters.h"
#include "radiometry/irradiance/ReceiverShare.h"
#include "radiometry/irradiance/SkyIrradiance.h"
#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <array>
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

/// What no double holds is an error and never an infinity handed on.
void CheckFinite(const DirectResult& result, const DirectOptions& options)
{
  for (std::size_t i = 0; i < result.Irradiance.size(); ++i)
  {
    if (!std::isfinite(result.Irradiance[i]) || !std::isfinite(result.Error[i]))
    {
      const std::size_t receiver = i / static_cast<std::size_t>(result.Bands);
      throw InputError("Irradiance", static_cast<long long>(options.NumberOf(receiver)),
        result.Irradiance[i], "a number below 1e308 W/m^2: less intensity, or lights less near");
    }
  }
}

constexpr int Kinds = 3; // beams, areas, skies

struct Components
{
  std::array<bool, Kinds> Present{};
  std::array<double, Kinds> Peaks{};       // unshadowed
  std::array<std::size_t, Kinds> Rounds{}; // of the result's
};

/// Adds the light of all kinds to the result.
template <typename Receivers>
Components AddAll(const Scene& scene, const OcclusionScene& occluders, const Receivers& receivers,
  const DirectOptions& options, const StageProgress& stage, ConvergenceRecord* record,
  DirectResult& result)
{
  const ConvergenceRecord clock;
  Components components;
  components.Present = { AnyBeam(scene, options), AnyArea(scene, options), AnySky(scene, options) };
  constexpr double weights[Kinds] = { 1.0, 3.0, 3.0 };
  double total = 0.0;
  for (int k = 0; k < Kinds; ++k)
  {
    total += components.Present[k] ? weights[k] : 0.0;
  }
  double done = 0.0;
  for (int k = 0; k < Kinds; ++k)
  {
    if (!components.Present[k])
    {
      continue;
    }
    StageProgress part = stage;
    part.Begin = stage.Begin + (stage.End - stage.Begin) * done / total;
    done += weights[k];
    part.End = stage.Begin + (stage.End - stage.Begin) * done / total;
    DirectOptions now = options;
    if (options.SecondsLeft > 0.0)
    {
      // Its share of what is left; the last one gets all of it.
      const double left = options.SecondsLeft - clock.Elapsed();
      now.SecondsLeft = std::max(1e-9, left * weights[k] / (total - done + weights[k]));
    }
    using Add = void (*)(const Scene&, const OcclusionScene&, const Receivers&,
      const DirectOptions&, const StageProgress&, ConvergenceRecord*, DirectResult&);
    static constexpr Add adders[Kinds] = { AddBeamIrradiance, AddAreaIrradiance, AddSkyIrradiance };
    const std::size_t rounds = result.Rounds.size();
    result.PeakUnshadowed = 0.0;
    adders[k](scene, occluders, receivers, now, part, record, result);
    components.Peaks[k] = result.PeakUnshadowed;
    components.Rounds[k] = result.Rounds.size() - rounds;
  }
  const auto bands = static_cast<std::size_t>(result.Bands);
  const bool ambient = Compiled(Effect::GlobalAmbient) && !scene.GlobalAmbient.empty() &&
    options.OnlyLight < 0;
  for (std::size_t i = 0; i < result.Irradiance.size() && ambient; ++i)
  {
    result.Irradiance[i] += scene.GlobalAmbient[i % bands];
  }
  CheckFinite(result, options);
  return components;
}

DirectResult Begin(const Scene& scene, std::size_t receivers)
{
  DirectResult result;
  result.Bands = scene.Optics.Bands;
  result.Irradiance.assign(receivers * static_cast<std::size_t>(result.Bands), 0.0);
  result.Error = result.Irradiance;
  return result;
}

double Total(const std::array<double, Kinds>& peaks)
{
  return peaks[0] + peaks[1] + peaks[2];
}

/// Groups of patches, or of points, that are computed together.
void Groups(const Scene& scene, const OcclusionScene& occluders, const std::vector<Patch>& patches,
  const DirectOptions& options, std::vector<std::uint32_t>& order,
  std::vector<std::uint32_t>& first)
{
  if (!AnyBeam(scene, options))
  {
    PlainGroups(patches.size(), order, first);
    return;
  }
  const PatchClusters clusters(scene, occluders, patches, options.Threads);
  for (std::size_t c = 0; c < clusters.Size(); ++c)
  {
    first.push_back(static_cast<std::uint32_t>(order.size()));
    order.insert(order.end(), clusters.Begin(c), clusters.End(c));
  }
  first.push_back(static_cast<std::uint32_t>(order.size()));
}
void Groups(const Scene&, const OcclusionScene&, const std::vector<SurfacePoint>& points,
  const DirectOptions&, std::vector<std::uint32_t>& order, std::vector<std::uint32_t>& first)
{
  PointGroups(points, order, first);
}

/// Rows of the record from what all ranks had when each of their rounds ended.
void RecordRounds(const Communicator& ranks, const Components& components,
  const std::vector<DirectRound>& rounds, ConvergenceRecord& record)
{
  static constexpr const char* stages[Kinds] = { "direct light", "area lights", "sky" };
  double most[Kinds] = {};
  std::copy(components.Rounds.begin(), components.Rounds.end(), most);
  ranks.Largest(most, Kinds);
  std::size_t at = 0;
  for (int k = 0; k < Kinds; ++k)
  {
    const std::size_t own = components.Rounds[k];
    for (std::size_t r = 0; r < static_cast<std::size_t>(most[k]); ++r)
    {
      // A rank that has finished keeps what it has.
      const DirectRound round = own > 0 ? rounds[at + std::min(r, own - 1)] : DirectRound();
      double sums[4] = { round.Value, round.Error, round.Weight, round.Rays };
      double seconds = round.Seconds;
      ranks.Sum(sums, 4);
      ranks.Largest(&seconds, 1);
      record.Rows.push_back({ seconds, sums[0] > 0.0 ? sums[1] / sums[0] : 0.0,
        sums[2] > 0.0 ? sums[1] / sums[2] : 0.0, static_cast<std::int64_t>(sums[3]), stages[k],
        {} });
    }
    at += own;
  }
}

/// Each rank its share of the groups; then all have all.
template <typename Receivers>
DirectResult ComputeShare(const Scene& scene, const OcclusionScene& occluders,
  const Receivers& receivers, const DirectOptions& options, const StageProgress& stage,
  ConvergenceRecord* record)
{
  const Communicator& ranks = *options.Ranks;
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  std::vector<std::uint32_t> order, first;
  Groups(scene, occluders, receivers, options, order, first);
  const ReceiverShare share(ranks, order, first);
  const Receivers mine = share.Take(receivers);
  DirectOptions own = options;
  own.Numbers = share.Begin();
  DirectResult part = Begin(scene, mine.size());
  part.KeepRounds = record != nullptr;
  Components components = AddAll(scene, occluders, mine, own, stage, record, part);

  DirectResult result;
  result.Bands = part.Bands;
  result.Irradiance = share.Gather(part.Irradiance, bands);
  result.Error = share.Gather(part.Error, bands);
  double most[Kinds + 3] = { components.Peaks[0], components.Peaks[1], components.Peaks[2],
    part.DroppedPeak, part.TimedOut ? 1.0 : 0.0, part.Dropped.empty() ? 0.0 : 1.0 };
  ranks.Largest(most, Kinds + 3);
  result.PeakUnshadowed = Total({ most[0], most[1], most[2] });
  result.DroppedPeak = most[Kinds];
  result.TimedOut = most[Kinds + 1] > 0.0;
  if (most[Kinds + 2] > 0.0)
  {
    std::vector<double> dropped(part.Dropped.begin(), part.Dropped.end());
    dropped.resize(mine.size(), 0.0);
    dropped = share.Gather(dropped, 1);
    result.Dropped.assign(dropped.begin(), dropped.end());
  }
  double mean = part.DroppedMean * static_cast<double>(mine.size());
  ranks.Sum(&mean, 1);
  result.DroppedMean = receivers.empty() ? 0.0 : mean / static_cast<double>(receivers.size());
  result.Rays = part.Rays;
  ranks.Sum(&result.Rays, 1);
  if (record)
  {
    RecordRounds(ranks, components, part.Rounds, *record);
  }
  return result;
}

template <typename Receivers>
DirectResult Compute(const Scene& scene, const OcclusionScene& occluders,
  const Receivers& receivers, const DirectOptions& options, const StageProgress& stage,
  ConvergenceRecord* record)
{
  DirectResult result = Begin(scene, receivers.size());
  if (receivers.empty())
  {
    return result;
  }
  if (options.Ranks)
  {
    result = ComputeShare(scene, occluders, receivers, options, stage, record);
  }
  else
  {
    result.PeakUnshadowed =
      Total(AddAll(scene, occluders, receivers, options, stage, record, result).Peaks);
  }
  Report(stage.Listener, stage.End, stage.Name);
  return result;
}

} // namespace

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

void RecordDirect(ConvergenceRecord* record, DirectResult& result,
  const std::vector<double>& weights, const char* stage)
{
  if (!record)
  {
    return;
  }
  DirectRound round;
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    round.Weight += weights[i];
    for (int b = 0; b < result.Bands; ++b)
    {
      round.Value += weights[i] * result.Irradiance[i * result.Bands + b];
      round.Error += weights[i] * result.Error[i * result.Bands + b];
    }
  }
  round.Weight *= result.Bands;
  if (result.KeepRounds)
  {
    round.Seconds = record->Elapsed();
    round.Rays = static_cast<double>(result.Rays);
    result.Rounds.push_back(round);
    return;
  }
  const double mean = round.Weight > 0.0 ? round.Error / round.Weight : 0.0;
  record->Add(stage, round.Value > 0.0 ? round.Error / round.Value : 0.0, mean, result.Rays);
}

} // namespace radiometry
