// SPDX-License-Identifier: BSD-3-Clause
//
// DirectRun: the pilot that says what the rest of a run will take.
#include "radiometry/irradiance/DirectRun.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

/// Of the items, and at least so many, are looked at by a pilot, of few items no more than a third ...
constexpr double PilotShare = 0.08;
constexpr std::size_t LeastPilot = 32;
/// ... unless what it says is sure enough before: standard deviation of the mean, relative.
constexpr double EnoughDoubt = 0.12;
constexpr std::size_t FewestPilot = 4;
constexpr double FewDoubt = 0.3;
constexpr double LeastSeconds = 0.02;
/// Of the clock's time in a pilot: threads end small chunks one after the other.
constexpr double ClockShare = 0.8;

/// Places in [0, n), each once, spread over all of it from the first on.
class SpreadOrder
{
public:
  explicit SpreadOrder(std::size_t n)
    : Count(n)
    , Taken(n, 0)
  {
  }
  bool Next(std::size_t& place)
  {
    if (this->Used == this->Count)
    {
      return false;
    }
    constexpr double golden = 0.6180339887498949;
    this->At += golden;
    this->At -= std::floor(this->At);
    place = std::min(
      this->Count - 1, static_cast<std::size_t>(this->At * static_cast<double>(this->Count)));
    while (this->Taken[place] != 0)
    {
      place = place + 1 < this->Count ? place + 1 : 0;
    }
    this->Taken[place] = 1;
    ++this->Used;
    return true;
  }

private:
  std::size_t Count;
  std::size_t Used = 0;
  double At = 0.5;
  std::vector<std::uint8_t> Taken;
};

} // namespace

/// Items of a kind that may come next: all that counts for them has been computed.
template <typename Receiver>
std::vector<std::uint32_t> DirectRun<Receiver>::Candidates(std::size_t kind) const
{
  std::vector<std::uint32_t> items = this->Kinds[kind]->Waiting();
  for (std::size_t k = 0; k < kind; ++k)
  {
    if (this->Kinds[k])
    {
      items.erase(std::remove_if(items.begin(), items.end(),
                    [&](std::uint32_t i) { return this->Kinds[k]->Waits(i); }),
        items.end());
    }
  }
  return items;
}

template <typename Receiver>
void DirectRun<Receiver>::PilotOf(std::size_t kind, const StageProgress& stage, double most)
{
  const KindClock spent(this->Options, kind);
  DirectKind& work = *this->Kinds[kind];
  const std::vector<std::uint32_t> all = work.Waiting();
  const std::vector<std::uint32_t> items =
    kind == 0 ? all : this->Candidates(kind);
  const ConvergenceRecord clock;
  SpreadOrder order(items.size());
  const auto some = [&](std::size_t count) {
    std::vector<std::uint32_t> chunk;
    std::size_t place = 0;
    while (chunk.size() < count && order.Next(place))
    {
      chunk.push_back(items[place]);
    }
    std::sort(chunk.begin(), chunk.end());
    return chunk;
  };
  const auto workers = static_cast<std::size_t>(this->Workers());
  DirectKind::Limits limits;
  limits.Clock = &clock;
  limits.Until = most;
  bool late = false; // some items could not be brought to the tolerance in that time
  const DirectKind::Tally tally = this->TallyOf(kind);
  std::size_t done = 0;
  ItemCost warm; // what the first ones take is not what the others do
  for (const std::size_t count : { std::size_t{ 1 }, 2 * workers })
  {
    if (items.size() > 20 * count)
    {
      const std::vector<std::uint32_t> chunk = some(count);
      done += chunk.size();
      late = !work.Run(chunk, limits, stage, &warm, tally) || late;
    }
  }
  ItemCost cost;
  double wall = 0.0;
  const std::size_t enough = std::min((items.size() + 2) / 3,
    std::max(LeastPilot, static_cast<std::size_t>(PilotShare * static_cast<double>(items.size()))));
  const auto sure = [&] {
    // Of few and costly items fewer must do.
    const bool tenth = cost.Items >= FewestPilot && 10 * done >= items.size() &&
      cost.Doubt() < FewDoubt && clock.Elapsed() > LeastSeconds;
    return cost.Items >= enough || tenth ||
      (cost.Items >= LeastPilot && cost.Doubt() < EnoughDoubt) ||
      (most > 0.0 && cost.Items > 0 && clock.Elapsed() > most);
  };
  std::size_t next = std::max<std::size_t>(4, workers);
  while (done < items.size() && !sure())
  {
    const std::vector<std::uint32_t> chunk = some(std::min(next, enough - cost.Items));
    done += chunk.size();
    const ConvergenceRecord round;
    late = !work.Run(chunk, limits, stage, &cost, tally) || late;
    wall += round.Elapsed();
    next *= 2;
  }
  if (cost.Items == 0)
  {
    cost = warm;
  }
  const std::size_t left = all.size() - std::min(all.size(), done);
  // By the time of each thread, or by the clock where threads wait for processors that others use.
  const double byThreads = cost.Mean() * static_cast<double>(left) /
    static_cast<double>(std::max<std::size_t>(1, std::min(workers, left)));
  const double byClock = ClockShare * wall * static_cast<double>(left) /
    static_cast<double>(std::max<std::size_t>(1, cost.Items));
  this->Rest[kind] = std::max(byThreads, byClock);
  if (late)
  {
    // Costlier than can be told: more than there is time for.
    constexpr double pilots = 100.0;
    this->Rest[kind] = std::max(this->Rest[kind], pilots * most);
  }
}

template <typename Receiver>
double DirectRun<Receiver>::Pilot(const StageProgress& stage, double most)
{
  double rest = 0.0;
  for (std::size_t k = 0; k < DirectKinds; ++k)
  {
    if (this->Kinds[k])
    {
      StageProgress part = stage;
      part.Begin = part.End = stage.Begin;
      this->PilotOf(k, part, most / DirectKinds);
      rest += this->Rest[k];
    }
  }
  Report(stage.Listener, stage.End, stage.Name);
  return rest;
}

template double DirectRun<Patch>::Pilot(const StageProgress& stage, double most);
template double DirectRun<SurfacePoint>::Pilot(const StageProgress& stage, double most);

} // namespace radiometry
