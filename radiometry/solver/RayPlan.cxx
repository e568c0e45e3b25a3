// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/RayPlan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace radiometry
{
namespace
{

/// Of the cells and of their area, finished when a run ends; rays are spent on a few more, for some
/// will fail.
constexpr double Finished = 0.965;
/// What neighbours need counts that much.
constexpr double Neighbourhood = 0.6;
/// Of the mean over all, what each gets: cells that meet the tolerance by light that is sure should not
/// be the worst of all.
constexpr double Everywhere = 0.3;
/// What rays may take of what is allowed, where nothing is known of the rest.
constexpr double RoughRoom = 0.85;
constexpr double MostRays = 32768.0; // of an element
constexpr double LeastMore = 1.2; // fewer are not worth a step
constexpr double FewRays = 256.0, FewStep = 8.0, ManyStep = 64.0;

struct Candidate
{
  double Need;
  std::size_t Side, Cell;
};

/// By what factor each cell needs more rays; infinite where no number that is to be had will do.
std::array<std::vector<double>, 2> Needs(const RadiosityLevel& level, const CellStates& states)
{
  std::array<std::vector<double>, 2> needs;
  for (std::size_t side = 0; side < 2; ++side)
  {
    for (const CellState& s : states[side])
    {
      needs[side].push_back(s.RayNeed());
    }
  }
  const std::vector<Patch>& patches = level.Elements.GetPatches();
  for (std::size_t e = 0; e < patches.size(); ++e)
  {
    double& need = needs[patches[e].Side][static_cast<std::size_t>(patches[e].Cell)];
    if (need > 1.0 && need * level.Carlo->Rays(e) > MostRays)
    {
      need = std::numeric_limits<double>::infinity();
    }
  }
  return needs;
}

/// Marks the cells to finish, cheapest first; `most` gets what the dearest of them needs. Returns the
/// share that is beyond rays.
double Choose(const CellStates& states, const std::array<std::vector<double>, 2>& needs,
  std::array<std::vector<std::uint8_t>, 2>& chosen, double& most)
{
  std::vector<Candidate> candidates;
  double area = 0.0, count = 0.0, openArea = 0.0, open = 0.0;
  for (std::size_t side = 0; side < 2; ++side)
  {
    chosen[side].assign(states[side].size(), 0);
    for (std::size_t c = 0; c < states[side].size(); ++c)
    {
      const CellState& s = states[side][c];
      if (!(s.Area > 0.0f))
      {
        continue;
      }
      area += s.Area;
      count += 1.0;
      const double need = needs[side][c];
      if (std::isfinite(need))
      {
        candidates.push_back({ need, side, c });
        continue;
      }
      open += 1.0;
      openArea += s.Area;
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
    [](const Candidate& a, const Candidate& b) { return a.Need < b.Need; });
  double doneArea = 0.0, done = 0.0;
  for (const Candidate& c : candidates)
  {
    if (done >= Finished * count && doneArea >= Finished * area)
    {
      break;
    }
    done += 1.0;
    doneArea += states[c.Side][c.Cell].Area;
    chosen[c.Side][c.Cell] = 1;
    most = c.Need;
  }
  return count > 0.0 ? std::max(open / count, openArea / area) : 0.0;
}

} // namespace

RayPlan PlanRays(
  const RadiosityContext& context, const RadiosityLevel& level, const CellStates& states)
{
  RayPlan plan;
  std::array<std::vector<std::uint8_t>, 2> chosen;
  const std::array<std::vector<double>, 2> needs = Needs(level, states);
  double most = 1.0;
  plan.Open = Choose(states, needs, chosen, most);
  const std::size_t n = level.Elements.Size();
  const std::vector<Patch>& patches = level.Elements.GetPatches();
  std::vector<double> need(n, 0.0);
  std::size_t count = 0;
  const std::vector<std::int32_t> group = level.Elements.Groups(context.Geometry, 2, count);
  std::vector<double> together(count, 0.0), members(count, 0.0);
  double all = 0.0;
  for (std::size_t e = 0; e < n; ++e)
  {
    const Patch& p = patches[e];
    const auto c = static_cast<std::size_t>(p.Cell);
    // The others get what the dearest of these do: they are wrong, too.
    need[e] = chosen[p.Side][c] ? needs[p.Side][c] : std::min(most, needs[p.Side][c]);
    all += need[e] * level.Carlo->Rays(e);
    const auto g = static_cast<std::size_t>(group[e]);
    together[g] += need[e] * level.Carlo->Rays(e);
    members[g] += 1.0;
  }
  plan.Rays.assign(n, 0);
  for (std::size_t e = 0; e < n; ++e)
  {
    const auto g = static_cast<std::size_t>(group[e]);
    const double has = std::max(1, level.Carlo->Rays(e));
    const double own = need[e] > 1.0 ? std::max(LeastMore, need[e]) : need[e];
    const double wanted = std::min(MostRays,
      std::max({ own * has, Neighbourhood * together[g] / members[g],
        Everywhere * all / static_cast<double>(n) }));
    plan.Wanted += std::max(has, wanted);
    const CellState& cell = states[patches[e].Side][static_cast<std::size_t>(patches[e].Cell)];
    plan.Rough +=
      std::max(has, std::min(std::pow(cell.Visibility / RoughRoom, 2) * has, MostRays));
    if (wanted >= LeastMore * has)
    {
      const double more = std::min(wanted, (has < FewRays ? FewStep : ManyStep) * has) -
        level.Carlo->OwnRays(e);
      plan.Rays[e] = static_cast<std::int32_t>(
        MonteCarloOperator::Batches * std::ceil(more / MonteCarloOperator::Batches));
      plan.Total += plan.Rays[e];
    }
  }
  // Too few to tell what they are good for: more of all.
  for (std::size_t e = 0; e < n && !(plan.Total > 0.0); ++e)
  {
    const bool few = level.F->Samples() < static_cast<std::int64_t>(FewRays * static_cast<double>(n));
    plan.Rays[e] = few ? static_cast<std::int32_t>((FewStep - 1.0) * level.Carlo->Rays(e)) : 0;
  }
  if (!(plan.Total > 0.0))
  {
    plan.Total = std::accumulate(plan.Rays.begin(), plan.Rays.end(), 0.0);
    plan.Wanted = static_cast<double>(level.F->Samples()) + plan.Total;
  }
  return plan;
}

} // namespace radiometry
