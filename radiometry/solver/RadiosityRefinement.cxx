// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/Sampling.h"
#include "radiometry/solver/RadiosityLevel.h"

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
  for (std::size_t e = 0; e < n; ++e)
  {
    const auto g = static_cast<std::size_t>(group[e]);
    groupArea[g] += areas[e];
    area += areas[e];
    for (std::size_t b = 0; b < nb; ++b)
    {
      const double reflected =
        areas[e] * this->Optics.Reflectance[e * nb + b] * this->First[e * nb + b];
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
      const double reflected = this->Optics.Reflectance[e * nb + b] * this->First[e * nb + b];
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

} // namespace radiometry
