// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/Sampling.h"
#include "radiometry/solver/RadiosityRun.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace radiometry
{
namespace
{

using Values = RadiosityLevel::Values;

/// Share of all first light, times the tolerance, that an element may put in the wrong place.
constexpr double UnevenShare = 3e-3;
constexpr int FinerRounds = 8;
/// Of the harm that uneven elements do, what those that are divided do.
constexpr double BulkShare = 0.75;

} // namespace

std::vector<std::uint8_t> RadiosityLevel::Uneven(
  const RadiosityContext& context, std::size_t most) const
{
  const std::size_t n = this->Elements.Size();
  const std::size_t nb = context.Bands;
  const std::vector<double>& areas = this->Elements.GetAreas();
  std::size_t count = 0;
  const std::vector<std::int32_t> group = this->Elements.Groups(context.Geometry, 1, count);
  Values mean(count * nb, 0.0), groupArea(count, 0.0), flux(nb, 0.0);
  double area = 0.0;
  Values sent;
  this->Optics.Leave(this->First, false, sent);
  for (std::size_t e = 0; e < n; ++e)
  {
    const auto g = static_cast<std::size_t>(group[e]);
    groupArea[g] += areas[e];
    area += areas[e];
    for (std::size_t b = 0; b < nb; ++b)
    {
      const double reflected = areas[e] * sent[e * nb + b];
      mean[g * nb + b] += reflected;
      flux[b] += reflected;
    }
  }
  std::vector<std::pair<double, std::size_t>> uneven;
  for (std::size_t e = 0; e < n; ++e)
  {
    if (areas[e] < 1e-6 * area)
    {
      continue;
    }
    const auto g = static_cast<std::size_t>(group[e]);
    double worst = 0.0;
    for (std::size_t b = 0; b < nb; ++b)
    {
      const double reflected = sent[e * nb + b];
      if (flux[b] > 0.0)
      {
        worst = std::max(
          worst, areas[e] * std::abs(reflected - mean[g * nb + b] / groupArea[g]) / flux[b]);
      }
    }
    if (worst > UnevenShare * context.Options.RelativeTolerance)
    {
      uneven.emplace_back(-worst, e);
    }
  }
  std::sort(uneven.begin(), uneven.end());
  std::vector<std::uint8_t> marked(n, 0);
  for (std::size_t k = 0; k < std::min(most, uneven.size()); ++k)
  {
    marked[uneven[k].second] = 1;
  }
  return marked;
}

std::vector<std::uint8_t> RadiosityLevel::Harmful(const RadiosityContext& context,
  const std::vector<std::uint8_t>& unfinished, std::size_t most) const
{
  const std::size_t n = this->Elements.Size();
  const std::size_t nb = context.Bands;
  const std::vector<double>& areas = this->Elements.GetAreas();
  std::size_t count = 0;
  const std::vector<std::int32_t> group = this->Elements.Groups(context.Geometry, 1, count);
  Values mean(count * nb, 0.0), groupArea(count, 0.0), wanting(n), seen(n);
  for (std::size_t e = 0; e < n; ++e)
  {
    const auto g = static_cast<std::size_t>(group[e]);
    groupArea[g] += areas[e];
    wanting[e] = unfinished[e];
    for (std::size_t b = 0; b < nb; ++b)
    {
      mean[g * nb + b] += areas[e] * this->Leaving[e * nb + b];
    }
  }
  // By reciprocity, what would reach an element from the unfinished ones is what of its own would
  // reach them.
  this->F->Apply(wanting.data(), seen.data(), 1);
  double all = 0.0;
  std::vector<std::pair<double, std::size_t>> harm;
  for (std::size_t e = 0; e < n; ++e)
  {
    const auto g = static_cast<std::size_t>(group[e]);
    double off = 0.0;
    for (std::size_t b = 0; b < nb; ++b)
    {
      off = std::max(off, std::abs(this->Leaving[e * nb + b] - mean[g * nb + b] / groupArea[g]));
    }
    const double h = areas[e] * off * std::max(0.0, seen[e]);
    all += h;
    if (h > 0.0)
    {
      harm.emplace_back(-h, e);
    }
  }
  std::sort(harm.begin(), harm.end());
  std::vector<std::uint8_t> marked(n, 0);
  double done = 0.0;
  for (std::size_t k = 0; k < std::min(most, harm.size()) && done < BulkShare * all; ++k)
  {
    done -= harm[k].first;
    marked[harm[k].second] = 1;
  }
  return marked;
}

std::vector<std::uint8_t> RadiosityLevel::Crowded(
  const RadiosityContext& context, std::size_t most, const StageProgress& stage) const
{
  constexpr std::uint32_t rays = 16;
  const std::size_t n = this->Elements.Size();
  const std::vector<double>& areas = this->Elements.GetAreas();
  std::vector<std::int32_t> near(n * rays, -1);
  ParallelFor(
    n, context.Options.Threads, stage,
    [&](std::size_t i) {
      const Patch& patch = this->Elements.GetPatches()[i];
      const Vec3 normal = Normalized(AreaNormal2(patch.Corners));
      const SobolSequence sequence(Hash64(Hash64(context.Options.Seed, 0x6e656172ull), i));
      for (std::uint32_t k = 0; k < rays; ++k)
      {
        const auto u = sequence(k);
        const SurfaceHit hit =
          context.Occluders.Closest({ TrianglePoint(patch.Corners, u[0], u[1]), patch.Triangle },
            CosineDirection(normal, u[2], u[3]));
        const std::int32_t met = this->Elements.Find(hit.Triangle, hit.Front, hit.U, hit.V);
        if (met >= 0)
        {
          const double area = areas[static_cast<std::size_t>(met)];
          if (area > 3.0 * areas[i] && hit.Distance * hit.Distance < 0.5 * area)
          {
            near[i * rays + k] = met;
          }
        }
      }
    },
    2e-5);
  std::vector<std::int32_t> seen(n, 0);
  for (const std::int32_t met : near)
  {
    if (met >= 0)
    {
      ++seen[static_cast<std::size_t>(met)];
    }
  }
  std::vector<std::pair<std::int32_t, std::size_t>> crowded;
  for (std::size_t e = 0; e < n; ++e)
  {
    if (seen[e] > 0)
    {
      crowded.emplace_back(-seen[e], e);
    }
  }
  std::sort(crowded.begin(), crowded.end());
  std::vector<std::uint8_t> marked(n, 0);
  for (std::size_t k = 0; k < std::min(most, crowded.size()); ++k)
  {
    marked[crowded[k].second] = 1;
  }
  return marked;
}

std::unique_ptr<RadiosityLevel> RadiosityRun::RefineByLight(ElementSet elements, std::size_t room,
  std::size_t uneven, const RadiosityLevel* earlier, bool& complete, const StageProgress& stage)
{
  const double width = stage.End - stage.Begin;
  std::unique_ptr<RadiosityLevel> before;
  for (int round = 0;; ++round)
  {
    StageProgress part = stage;
    part.Begin = stage.Begin + width * (1.0 - std::pow(0.5, round));
    part.End = 0.5 * (part.Begin + stage.End);
    auto level = std::make_unique<RadiosityLevel>(this->Context, elements);
    this->Timed("direct light", [&] {
      level->Illuminate(this->Context, this->Left(), before ? before.get() : earlier, part);
    });
    const std::size_t n = elements.Size();
    if (this->Context.Options.Refinement == RefinementMode::Off || round == FinerRounds ||
      room <= n + 6 || level->TimedOut || this->Left() < 0.0)
    {
      return level;
    }
    const auto share = [n](std::size_t most) { return most > n ? (most - n) / 6 : 0; };
    std::vector<std::uint8_t> finer = level->Uneven(this->Context, share(uneven));
    this->Timed("refinement", [&] {
      part.Begin = part.End;
      part.Name = "refinement";
      const std::vector<std::uint8_t> crowded = level->Crowded(this->Context, n, part);
      std::size_t allowed = share(room);
      for (std::size_t e = 0; e < n; ++e)
      {
        complete = complete && !(crowded[e] && allowed == 0);
        if (crowded[e] && allowed > 0)
        {
          finer[e] = 1;
          --allowed;
        }
      }
    });
    if (std::none_of(finer.begin(), finer.end(), [](std::uint8_t m) { return m != 0; }))
    {
      return level;
    }
    elements = elements.Divided(finer);
    before = std::move(level);
  }
}

} // namespace radiometry
