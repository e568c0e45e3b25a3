// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/DirectRun.h"

#include "radiometry/effects/CompiledEffects.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/irradiance/AreaIrradiance.h"
#include "radiometry/irradiance/BeamIrradiance.h"
#include "radiometry/irradiance/SkyIrradiance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace radiometry
{
namespace
{

/// Seconds that a value takes which is only bounded, on one thread.
constexpr double BlindSeconds = 0.4e-6;
/// Seconds a receiver that tree and clusters take.
constexpr double GroupSeconds = 0.8e-6;
double WeightOf(const Patch& patch)
{
  return Area(patch.Corners);
}
double WeightOf(const SurfacePoint&)
{
  return 1.0;
}

} // namespace

template <typename Receiver>
DirectRun<Receiver>::DirectRun(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Receiver>& receivers, const DirectOptions& options,
  const StageProgress& stage, DirectState* kept, bool recorded)
  : Geometry(scene)
  , Occluders(occluders)
  , All(receivers)
  , Bands(static_cast<std::size_t>(scene.Optics.Bands))
  , Options(options)
  , State(kept ? kept : &this->Local)
  , Recorded(recorded)
{
  Report(stage.Listener, stage.Begin, stage.Name);
  this->RaysBefore = this->State->Rays;
  if (options.Ranks)
  {
    this->Groups = MakeReceiverGroups(scene, occluders, receivers, options);
    this->Share =
      std::make_unique<ReceiverShare>(*options.Ranks, this->Groups.Order, this->Groups.First);
    this->Own = this->Share->Take(receivers);
    this->Options.Numbers = this->Share->Begin();
    // Its own groups, in the order in which they were dealt.
    ReceiverGroups own;
    own.Order.resize(this->Own.size());
    std::iota(own.Order.begin(), own.Order.end(), 0u);
    const auto rank = static_cast<std::size_t>(options.Ranks->Rank());
    const auto size = static_cast<std::size_t>(options.Ranks->Size());
    std::uint32_t at = 0;
    own.First.push_back(0);
    for (std::size_t g = rank; g < this->Groups.Size(); g += size)
    {
      at += this->Groups.First[g + 1] - this->Groups.First[g];
      own.First.push_back(at);
    }
    this->Groups = std::move(own);
  }
  this->MakeKinds(stage);
}

template <typename Receiver>
DirectRun<Receiver>::~DirectRun() = default;

template <typename Receiver>
void DirectRun<Receiver>::MakeKinds(const StageProgress& stage)
{
  const std::vector<Receiver>& mine = this->Mine();
  DirectFields& fields = this->State->Fields;
  const bool needed[DirectKinds] = { AnyBeam(this->Geometry, this->Options),
    AnyArea(this->Geometry, this->Options), AnySky(this->Geometry, this->Options) };
  const int bands = this->Geometry.Optics.Bands;
  const bool together = this->Options.Ranks && this->Options.MeanShare > 0.0;
  for (int k = 0; k < DirectKinds; ++k)
  {
    DirectField& field = fields[static_cast<std::size_t>(k)];
    if (!needed[k] || (mine.empty() && !together))
    {
      field = {};
      continue;
    }
    if (!field.Empty() && field.State.size() != mine.size())
    {
      field = {};
    }
    if (!together && !DirectKind::AnyNeeded(fields, k, mine.size(), bands, this->Options))
    {
      continue; // all of it is there
    }
    const KindClock spent(this->Options, static_cast<std::size_t>(k));
    // What is built of it may take half of what is left.
    std::unique_ptr<DirectKind>& made = this->Kinds[static_cast<std::size_t>(k)];
    if (k == 0 && !this->Share)
    {
      const ConvergenceRecord clock;
      this->Groups = MakeReceiverGroups(this->Geometry, this->Occluders, mine, this->Options);
      const double usual = GroupSeconds * static_cast<double>(mine.size()) + 1e-3;
      this->Slowness = std::clamp(clock.Elapsed() / usual, 1.0, 20.0);
    }
    const double left = this->Options.SecondsLeft > 0.0
      ? std::max(1e-9, 0.5 * (this->Options.SecondsLeft - this->Clock.Elapsed()) / this->Slowness)
      : 0.0;
    if (k == 0)
    {
      made = MakeBeams(this->Geometry, this->Occluders, mine, this->Groups, this->Options, fields,
        stage, left);
    }
    else if (k == 1)
    {
      made = MakeAreas(this->Geometry, this->Occluders, mine, this->Options, fields, left);
    }
    else
    {
      made = MakeSkies(this->Geometry, this->Occluders, mine, this->Options, fields, stage, left);
    }
    if (!made)
    {
      field = {};
    }
  }
}

template <typename Receiver>
int DirectRun<Receiver>::Workers() const
{
  const int available = AvailableThreads();
  return this->Options.Threads > 0 ? std::min(this->Options.Threads, available) : available;
}

template <typename Receiver>
std::size_t DirectRun<Receiver>::Waiting() const
{
  std::size_t count = 0;
  for (const auto& kind : this->Kinds)
  {
    count += kind ? kind->Waiting().size() : 0;
  }
  return count;
}

template <typename Receiver>
void DirectRun<Receiver>::Finish(
  const StageProgress& stage, const ConvergenceRecord* record, double seconds)
{
  const ConvergenceRecord clock;
  double known = 0.0;
  double weights[DirectKinds] = { 1.0, 3.0, 3.0 };
  for (std::size_t k = 0; k < DirectKinds; ++k)
  {
    known += this->Kinds[k] ? this->Rest[k] : 0.0;
  }
  const bool piloted = known > 0.0;
  double total = 0.0;
  for (std::size_t k = 0; k < DirectKinds; ++k)
  {
    weights[k] = piloted ? std::max(this->Rest[k], 0.05 * known) : weights[k];
    total += this->Kinds[k] ? weights[k] : 0.0;
  }
  const double reserve = this->Slowness * BlindSeconds * static_cast<double>(this->Mine().size()) / this->Workers();
  const bool hurried = seconds > 0.0 && (!piloted || known > 0.8 * seconds);
  double done = 0.0;
  for (std::size_t k = 0; k < DirectKinds; ++k)
  {
    if (!this->Kinds[k])
    {
      continue;
    }
    const KindClock spent(this->Options, k);
    StageProgress part = stage;
    part.Begin = stage.Begin + (stage.End - stage.Begin) * done / total;
    done += weights[k];
    part.End = stage.Begin + (stage.End - stage.Begin) * done / total;
    DirectKind::Limits limits;
    limits.Clock = &clock;
    limits.Hurried = hurried;
    std::vector<std::uint32_t> items = this->Kinds[k]->Waiting();
    if (seconds > 0.0)
    {
      // Its share of what is left; the last one gets all of it.
      const double now = clock.Elapsed();
      const double left = seconds - now - reserve;
      limits.Until = std::max(1e-9, now + left * weights[k] / (total - done + weights[k]));
      // Spread over the scene, so that what is done in time is a picture of all of it.
      std::stable_sort(items.begin(), items.end(),
        [](std::uint32_t a, std::uint32_t b) { return Hash64(a) < Hash64(b); });
    }
    const double begun = record ? record->Elapsed() - clock.Elapsed() : 0.0;
    if (!this->Kinds[k]->Run(std::move(items), limits, part, nullptr, this->TallyOf(k)))
    {
      this->TimedOut = true;
    }
    if (record && this->Recorded)
    {
      this->AddUp(k, *record, begun);
    }
    DirectField& field = this->State->Fields[k];
    if (!this->TimedOut &&
      !(this->Options.RelativeTolerance >= field.RelativeTolerance &&
        this->Options.AbsoluteTolerance >= field.AbsoluteTolerance))
    {
      field.RelativeTolerance = this->Options.RelativeTolerance;
      field.AbsoluteTolerance = this->Options.AbsoluteTolerance;
    }
  }
}

template <typename Receiver>
int DirectRun<Receiver>::Present() const
{
  int count = 0;
  for (const DirectField& field : this->State->Fields)
  {
    count += field.Empty() ? 0 : 1;
  }
  return count;
}

/// Kinds' errors are independent, but for the bounds on what they left out: those add up.
template <typename Receiver>
void DirectRun<Receiver>::Combine(
  std::size_t receiver, std::size_t kinds, double* values, double* errors, double& dropped) const
{
  std::fill_n(values, this->Bands, 0.0);
  std::fill_n(errors, this->Bands, 0.0);
  dropped = 0.0;
  const bool several = this->Present() > 1;
  for (std::size_t k = 0; k < kinds; ++k)
  {
    const DirectField& field = this->State->Fields[k];
    if (field.Empty())
    {
      continue;
    }
    const double part =
      field.Dropped.empty() ? 0.0 : static_cast<double>(field.Dropped[receiver]);
    dropped += part;
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      const std::size_t at = receiver * this->Bands + b;
      values[b] += field.Value[at];
      const double own = several ? std::max(0.0, field.Error[at] - part) : field.Error[at];
      errors[b] = several ? std::hypot(errors[b], own) : own;
    }
  }
  for (std::size_t b = 0; b < this->Bands && several; ++b)
  {
    errors[b] += dropped;
  }
}

/// Value and error of a receiver by the kinds up to this one, times its weight.
template <typename Receiver>
DirectKind::Tally DirectRun<Receiver>::TallyOf(std::size_t kind) const
{
  if (!this->Recorded)
  {
    return {};
  }
  return [this, kind](std::uint32_t i, double& value, double& error) {
    static thread_local std::vector<double> values, errors;
    values.resize(this->Bands);
    errors.resize(this->Bands);
    double dropped = 0.0;
    this->Combine(i, kind + 1, values.data(), errors.data(), dropped);
    const double weight = WeightOf(this->Mine()[i]);
    value = weight * std::accumulate(values.begin(), values.end(), 0.0);
    error = weight * std::accumulate(errors.begin(), errors.end(), 0.0);
  };
}

/// Rows for the rounds that a kind has made: what there was when all items had gone that far.
template <typename Receiver>
void DirectRun<Receiver>::AddUp(std::size_t kind, const ConvergenceRecord& clock, double begun)
{
  DirectRound last;
  const DirectKind::Tally tally = this->TallyOf(kind);
  const std::vector<Receiver>& mine = this->Mine();
  for (std::size_t i = 0; i < mine.size(); ++i)
  {
    double value = 0.0, error = 0.0;
    tally(static_cast<std::uint32_t>(i), value, error);
    last.Value += value;
    last.Error += error;
    last.Weight += WeightOf(mine[i]) * static_cast<double>(this->Bands);
  }
  const std::vector<DirectKind::Change>& changes = this->Kinds[kind]->Changes();
  std::vector<DirectRound> rounds(changes.size(), last);
  for (std::size_t r = changes.size(); r-- > 1;)
  {
    rounds[r - 1].Value = rounds[r].Value - changes[r].Value;
    rounds[r - 1].Error = rounds[r].Error - changes[r].Error;
  }
  double seconds = 0.0;
  for (std::size_t r = 0; r < rounds.size(); ++r)
  {
    this->RaysSoFar += changes[r].Rays;
    rounds[r].Rays = this->RaysSoFar;
    rounds[r].Value = std::max(0.0, rounds[r].Value);
    rounds[r].Error = std::max(0.0, rounds[r].Error);
    // Rounds that the pilot alone had to make ended long ago: the rows' seconds rise.
    const double ended = begun + changes[r].Seconds;
    rounds[r].Seconds = ended > seconds && changes[r].Seconds > 0.0 ? ended : clock.Elapsed();
    seconds = std::max(seconds, rounds[r].Seconds);
  }
  this->Rounds[kind] = std::move(rounds);
}

template <typename Receiver>
DirectResult DirectRun<Receiver>::Result(ConvergenceRecord* record)
{
  static constexpr const char* stages[DirectKinds] = { "direct light", "area lights", "sky" };
  DirectResult result;
  result.Bands = static_cast<int>(this->Bands);
  const std::size_t n = this->Mine().size();
  result.Irradiance.assign(n * this->Bands, 0.0);
  result.Error = result.Irradiance;
  std::vector<double> dropped(n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
  {
    this->Combine(i, DirectKinds, &result.Irradiance[i * this->Bands],
      &result.Error[i * this->Bands], dropped[i]);
    result.DroppedPeak = std::max(result.DroppedPeak, dropped[i]);
    result.DroppedMean += dropped[i];
  }
  for (std::size_t k = 0; k < DirectKinds; ++k)
  {
    this->State->Rays += this->Kinds[k] ? this->Kinds[k]->Rays() : 0;
    this->Kinds[k].reset();
  }
  result.Rays = this->State->Rays - this->RaysBefore;
  const Communicator* ranks = this->Options.Ranks;
  double most[DirectKinds + 2] = { this->State->Fields[0].Peak, this->State->Fields[1].Peak,
    this->State->Fields[2].Peak, result.DroppedPeak, this->TimedOut ? 1.0 : 0.0 };
  if (ranks)
  {
    result.Irradiance = this->Share->Gather(result.Irradiance, this->Bands);
    result.Error = this->Share->Gather(result.Error, this->Bands);
    dropped = this->Share->Gather(dropped, 1);
    ranks->Largest(most, DirectKinds + 2);
    ranks->Sum(&result.DroppedMean, 1);
    ranks->Sum(&result.Rays, 1);
  }
  result.PeakUnshadowed = most[0] + most[1] + most[2];
  result.DroppedPeak = most[DirectKinds];
  result.TimedOut = most[DirectKinds + 1] > 0.0;
  result.DroppedMean /= static_cast<double>(std::max<std::size_t>(1, this->All.size()));
  if (result.DroppedPeak > 0.0)
  {
    result.Dropped.assign(dropped.begin(), dropped.end());
  }
  const bool ambient = Compiled(Effect::GlobalAmbient) && !this->Geometry.GlobalAmbient.empty() && this->Options.OnlyLight < 0;
  for (std::size_t at = 0; at < result.Irradiance.size() && ambient; ++at)
  {
    result.Irradiance[at] += this->Geometry.GlobalAmbient[at % this->Bands];
  }
  for (std::size_t k = 0; k < DirectKinds && record; ++k)
  {
    AddRounds(ranks, this->Rounds[k], stages[k], *record);
  }
  return result;
}

template class DirectRun<Patch>;
template class DirectRun<SurfacePoint>;

} // namespace radiometry
