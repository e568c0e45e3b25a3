// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/DirectKind.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace radiometry
{
namespace
{

double Allowed(const DirectOptions& options, double value)
{
  return std::max(options.RelativeTolerance * value, options.AbsoluteTolerance);
}

} // namespace

double ItemCost::Doubt() const
{
  if (this->Items < 2 || !(this->Sum > 0.0))
  {
    return 1.0;
  }
  const auto n = static_cast<double>(this->Items);
  const double mean = this->Sum / n;
  const double variance = std::max(0.0, this->Squares / n - mean * mean) * n / (n - 1.0);
  return std::sqrt(variance / n) / mean;
}

DirectKind::DirectKind(int kind, std::size_t receivers, int bands, const DirectOptions& options,
  DirectFields& fields, const ReceiverGroups* groups)
  : Options(options)
  , Bands(static_cast<std::size_t>(bands))
  , Groups(groups)
  , Kind(kind)
  , Fields(fields)
  , Pending(receivers)
{
  DirectField& own = fields[static_cast<std::size_t>(kind)];
  for (std::size_t i = 0; i < receivers; ++i)
  {
    this->Pending[i] = Needed(fields, kind, i, bands, options) ? 1 : 0;
  }
  own.Begin(receivers, this->Bands);
}

bool DirectKind::Needed(const DirectFields& fields, int kind, std::size_t receiver, int bands,
  const DirectOptions& options)
{
  const DirectField& own = fields[static_cast<std::size_t>(kind)];
  if (own.State.empty() || (own.State[receiver] & DirectField::Computed) == 0 ||
    (own.State[receiver] & DirectField::Unfinished) != 0)
  {
    return true;
  }
  // What met its tolerance is left as it is unless a finer one is asked for.
  if ((own.State[receiver] & DirectField::Improvable) == 0 ||
    (options.RelativeTolerance >= own.RelativeTolerance &&
      options.AbsoluteTolerance >= own.AbsoluteTolerance))
  {
    return false;
  }
  for (std::size_t b = 0; b < static_cast<std::size_t>(bands); ++b)
  {
    const std::size_t at = receiver * static_cast<std::size_t>(bands) + b;
    double value = 0.0;
    for (int k = 0; k <= kind; ++k)
    {
      const std::vector<double>& values = fields[static_cast<std::size_t>(k)].Value;
      value += values.empty() ? 0.0 : values[at];
    }
    if (own.Error[at] > Allowed(options, value))
    {
      return true;
    }
  }
  return false;
}

bool DirectKind::AnyNeeded(const DirectFields& fields, int kind, std::size_t receivers, int bands,
  const DirectOptions& options)
{
  const DirectField& own = fields[static_cast<std::size_t>(kind)];
  if (own.State.empty())
  {
    return receivers > 0;
  }
  for (std::size_t i = 0; i < receivers; ++i)
  {
    if (Needed(fields, kind, i, bands, options))
    {
      return true;
    }
  }
  return false;
}

bool DirectKind::HasWaiting(std::size_t item) const
{
  bool any = false;
  this->ForReceivers(item, [&](std::uint32_t i) { any = any || this->Pending[i] != 0; });
  return any;
}

bool DirectKind::HasFresh(std::size_t item) const
{
  bool any = false;
  this->ForReceivers(item, [&](std::uint32_t i) { any = any || this->Fresh(i); });
  return any;
}

std::vector<std::uint32_t> DirectKind::Waiting() const
{
  std::vector<std::uint32_t> items;
  const std::size_t count = this->Groups ? this->Groups->Size() : this->Pending.size();
  for (std::size_t k = 0; k < count; ++k)
  {
    if (this->HasWaiting(k))
    {
      items.push_back(static_cast<std::uint32_t>(k));
    }
  }
  return items;
}

bool DirectKind::Run(std::vector<std::uint32_t> items, const Limits& limits,
  const StageProgress& stage, ItemCost* cost, const Tally& tally)
{
  DirectField& own = this->Own();
  std::atomic<bool> expired{ false };
  const bool timed = limits.Until > 0.0 && limits.Clock;
  const int rounds = this->Rounds(limits.Hurried);
  std::vector<double> seconds(cost ? items.size() : 0, 0.0);
  std::vector<std::uint32_t> places(items.size()); // of those that go on
  std::iota(places.begin(), places.end(), 0u);
  std::vector<std::uint32_t> todo = items;
  std::vector<std::uint8_t> again;
  std::vector<Change> changes;
  double done = 0.0;
  for (int round = 0; round < rounds && this->GoesOn(!todo.empty(), expired); ++round)
  {
    StageProgress part = stage;
    const double next = done + 0.5 * (1.0 - done);
    part.Begin = stage.Begin + done * (stage.End - stage.Begin);
    part.End = stage.Begin + next * (stage.End - stage.Begin);
    done = next;
    again.assign(todo.size(), 0);
    changes.assign(tally ? todo.size() : 0, {});
    const std::int64_t raysBefore = this->RayCount;
    const auto work = [&](std::size_t k, Haste haste) {
      const auto add = [&](double sign) {
        this->ForReceivers(todo[k], [&](std::uint32_t i) {
          double value = 0.0, error = 0.0;
          tally(i, value, error);
          changes[k].Value += sign * value;
          changes[k].Error += sign * error;
        });
      };
      if (tally)
      {
        add(-1.0);
      }
      again[k] = this->Work(todo[k], round, haste) ? 1 : 0;
      if (tally)
      {
        add(1.0);
      }
    };
    ParallelFor(
      todo.size(), this->Options.Threads, part,
      [&](std::size_t k) {
        if (timed && !expired && limits.Clock->Elapsed() > limits.Until)
        {
          expired = true;
        }
        if ((expired || this->NoTime) && round > 0)
        {
          again[k] = 1;
          return;
        }
        const Haste haste =
          expired || this->NoTime ? Haste::Blind : (limits.Hurried ? Haste::Some : Haste::None);
        if (haste == Haste::Blind && !this->HasFresh(todo[k]))
        {
          again[k] = 1; // what an earlier run left is better
          return;
        }
        if (!cost)
        {
          work(k, haste);
          return;
        }
        const ConvergenceRecord clock;
        work(k, haste);
        seconds[places[k]] += clock.Elapsed();
      },
      this->Guess(round, limits.Hurried));
    this->Between(round, todo, again);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < todo.size(); ++k)
    {
      todo[kept] = todo[k];
      places[kept] = places[k];
      kept += again[k] != 0 ? 1 : 0;
    }
    todo.resize(kept);
    places.resize(kept);
    if (tally)
    {
      this->Made.resize(std::max(this->Made.size(), static_cast<std::size_t>(round) + 1));
      Change& made = this->Made[static_cast<std::size_t>(round)];
      for (const Change& change : changes)
      {
        made.Value += change.Value;
        made.Error += change.Error;
      }
      made.Rays += static_cast<double>(this->RayCount - raysBefore);
      made.Seconds = limits.Clock ? limits.Clock->Elapsed() : 0.0;
    }
  }
  // Whatever is left then was as far as rounds go, unless the time was over.
  for (const std::uint32_t item : items)
  {
    this->ForReceivers(item, [&](std::uint32_t i) { this->Pending[i] = 0; });
  }
  const bool timedOut = expired || this->NoTime;
  for (const std::uint32_t item : todo)
  {
    this->ForReceivers(item, [&](std::uint32_t i) {
      if (!timedOut)
      {
        own.State[i] = static_cast<std::uint8_t>(own.State[i] & ~DirectField::Unfinished);
      }
      else if ((own.State[i] & DirectField::Unfinished) != 0 || this->Fresh(i))
      {
        this->Pending[i] = 1;
      }
    });
  }
  for (const double s : seconds)
  {
    cost->Items += 1;
    cost->Sum += s;
    cost->Squares += s * s;
  }
  return !timedOut;
}

double DirectKind::Before(std::size_t receiver, std::size_t band) const
{
  double sum = 0.0;
  for (int k = 0; k < this->Kind; ++k)
  {
    const std::vector<double>& values = this->Fields[static_cast<std::size_t>(k)].Value;
    sum += values.empty() ? 0.0 : values[receiver * this->Bands + band];
  }
  return sum;
}

double DirectKind::DroppedBefore(std::size_t receiver) const
{
  double sum = this->Options.Dropped;
  for (int k = 0; k < this->Kind; ++k)
  {
    const std::vector<float>& dropped = this->Fields[static_cast<std::size_t>(k)].Dropped;
    sum += dropped.empty() ? 0.0 : static_cast<double>(dropped[receiver]);
  }
  return sum;
}

double DirectKind::MayDrop(std::size_t receiver, double value) const
{
  constexpr double share = 0.25;
  return std::max(0.0, share * Allowed(this->Options, value) - this->DroppedBefore(receiver));
}

} // namespace radiometry
