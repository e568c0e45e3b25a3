// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ViewFactorRays.h"

#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/GatherRecords.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr std::uint32_t TaskRays = 2048;
constexpr double Student = 2.131; // 95 % at fifteen degrees of freedom

} // namespace

ViewFactorRays::ViewFactorRays(const PatchTree& tree, const OcclusionScene& occluders,
  const std::vector<std::int32_t>& groupOfSide, const ViewFactorOptions& options, bool count)
  : Tree(tree)
  , Occluders(occluders)
  , GroupOfSide(groupOfSide)
  , Options(options)
  , Up(Normalized(options.Up))
  , Count(count)
  , Done(tree.Groups(), 0)
  , Tallies(tree.Groups())
  , Met(tree.Groups())
{
}

void ViewFactorRays::Run(const Task& task, Outcome& outcome) const
{
  const PatchTree::Node& node = this->Tree[this->Tree.Root(task.Group)];
  const SobolSequence sequence(
    Hash64(Hash64(this->Options.Seed, 0x7261797376660000ull + static_cast<std::uint64_t>(task.Set)),
      static_cast<std::uint64_t>(this->Tree.Name(task.Group))));
  std::vector<std::int32_t> met;
  for (std::uint32_t k = task.Begin; k < task.End; ++k)
  {
    const auto u = sequence(k);
    double share = u[0];
    const std::int32_t element = this->Tree.Pick(node, share);
    const ExchangePatch& shape = this->Tree.Shape(element);
    const Vec3 direction = CosineDirection(shape.Normal, u[2], u[3]);
    const SurfaceHit hit = this->Occluders.Closest(
      { TrianglePoint(shape.Corners, share, u[1]), this->Tree.Triangle(element) }, direction);
    const bool high = Dot(direction, this->Up) > 0.0;
    if (hit.Triangle < 0)
    {
      ++outcome.Tally[high ? Sky : Ground];
      continue;
    }
    ++outcome.Tally[high ? HitHigh : HitLow];
    const std::int32_t group =
      this->GroupOfSide[2 * static_cast<std::size_t>(hit.Triangle) + (hit.Front ? 0 : 1)];
    if (group < 0)
    {
      ++outcome.Tally[Blocked];
    }
    else if (this->Count)
    {
      met.push_back(group);
    }
  }
  std::sort(met.begin(), met.end());
  for (std::size_t k = 0; k < met.size();)
  {
    std::size_t end = k;
    while (end < met.size() && met[end] == met[k])
    {
      ++end;
    }
    outcome.Hits.emplace_back(met[k], static_cast<std::int32_t>(end - k));
    k = end;
  }
}

void ViewFactorRays::Merge(const Task& task, const Outcome& outcome)
{
  const auto set = static_cast<std::size_t>(task.Set);
  for (int f = 0; f < Fates; ++f)
  {
    this->Tallies[task.Group][set][f] += outcome.Tally[f];
  }
  std::vector<Hits>& met = this->Met[task.Group];
  const std::size_t old = met.size();
  for (const auto& [group, count] : outcome.Hits)
  {
    const auto at = std::lower_bound(met.begin(), met.begin() + static_cast<std::ptrdiff_t>(old),
      group, [](const Hits& h, std::int32_t g) { return h.first < g; });
    if (at != met.begin() + static_cast<std::ptrdiff_t>(old) && at->first == group)
    {
      at->second[set] += count;
    }
    else
    {
      met.push_back({ group, {} });
      met.back().second[set] = count;
    }
  }
  std::inplace_merge(met.begin(), met.begin() + static_cast<std::ptrdiff_t>(old), met.end(),
    [](const Hits& a, const Hits& b) { return a.first < b.first; });
}

void ViewFactorRays::Trace(const std::vector<std::uint32_t>& rays, const StageProgress& stage)
{
  std::vector<Task> tasks;
  for (std::size_t g = 0; g < rays.size(); ++g)
  {
    const std::uint32_t until = (rays[g] + Sets - 1) / Sets;
    for (int set = 0; set < Sets && until > this->Done[g]; ++set)
    {
      for (std::uint32_t k = this->Done[g]; k < until; k += TaskRays)
      {
        tasks.push_back({ static_cast<std::int32_t>(g), set, k, std::min(until, k + TaskRays) });
      }
      this->TotalRays += until - this->Done[g];
    }
    this->Done[g] = std::max(this->Done[g], until);
  }
  const RankShare share(this->Options.Ranks, tasks.size());
  std::vector<Outcome> outcomes(tasks.size());
  ParallelFor(
    share.End - share.Begin, this->Options.Threads, stage,
    [&](std::size_t k) { this->Run(tasks[share.Begin + k], outcomes[share.Begin + k]); }, 1e-4);
  this->ShareOutcomes(share, outcomes);
  for (std::size_t k = 0; k < tasks.size(); ++k)
  {
    this->Merge(tasks[k], outcomes[k]);
  }
}

/// Every rank gets what the others' tasks met.
void ViewFactorRays::ShareOutcomes(const RankShare& share, std::vector<Outcome>& outcomes) const
{
  if (!this->Options.Ranks)
  {
    return;
  }
  struct TaskHits
  {
    std::int32_t Task, Group, Count;
  };
  std::vector<std::array<std::int32_t, Fates>> tallies;
  std::vector<TaskHits> met;
  for (std::size_t k = share.Begin; k < share.End; ++k)
  {
    tallies.push_back(outcomes[k].Tally);
    for (const auto& [group, count] : outcomes[k].Hits)
    {
      met.push_back({ static_cast<std::int32_t>(k), group, count });
    }
    outcomes[k].Hits.clear();
  }
  GatherRecords(this->Options.Ranks, tallies);
  GatherRecords(this->Options.Ranks, met);
  for (std::size_t k = 0; k < outcomes.size(); ++k)
  {
    outcomes[k].Tally = tallies[k];
  }
  for (const TaskHits& m : met)
  {
    outcomes[static_cast<std::size_t>(m.Task)].Hits.emplace_back(m.Group, m.Count);
  }
}

RayShare ViewFactorRays::Share(std::int32_t group, const std::array<double, Sets>& hits) const
{
  RayShare share;
  const double n = this->Done[group];
  if (!(n > 0.0))
  {
    return { 0.0, 1.0 };
  }
  double spread = 0.0;
  for (const double h : hits)
  {
    share.Value += h / n / Sets;
  }
  for (const double h : hits)
  {
    const double off = h / n - share.Value;
    spread += off * off;
  }
  const double unnoticed = 1.0 / (Sets * n + 2.0);
  share.Error =
    std::sqrt(Student * Student * spread / (Sets * (Sets - 1.0)) + unnoticed * unnoticed);
  return share;
}

bool ViewFactorRays::SeesGroupsOnly(std::int32_t group) const
{
  for (const auto& set : this->Tallies[group])
  {
    if (set[Sky] + set[Ground] + set[Blocked] > 0.0)
    {
      return false;
    }
  }
  return this->Done[group] > 0;
}

} // namespace radiometry
