// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/PointGather.h"

#include "radiometry/geometry/Sampling.h"
#include "radiometry/visibility/PointStarts.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr std::size_t Batches = 8;
constexpr std::uint32_t FewestRays = 32; // a batch
constexpr std::uint32_t MostRays = 512;

} // namespace

GatherResult GatherAtPoints(const Scene& scene, const OcclusionScene& occluders,
  const ElementSet& elements, const std::vector<double>& radiosity,
  const std::vector<double>& radiosityError, int bands, const std::vector<SurfacePoint>& points,
  double absoluteTolerance, const ExchangeOptions& options, const StageProgress& stage)
{
  const auto nb = static_cast<std::size_t>(bands);
  GatherResult result;
  result.Irradiance.assign(points.size() * nb, 0.0);
  result.Error.assign(points.size() * nb, 0.0);
  std::vector<std::int64_t> rays(points.size(), 0);
  ParallelFor(
    points.size(), options.Threads, stage,
    [&](std::size_t i) {
      const SurfacePoint& point = points[i];
      const std::vector<PointStart> starts = PointStarts(scene, occluders, point);
      std::vector<double> sums(Batches * nb, 0.0);
      std::array<double, Batches> counted{};
      std::vector<double> mean(nb), error(nb), before(nb, 0.0);
      std::vector<std::int32_t> hits;
      std::uint32_t done = 0;
      for (std::uint32_t end = FewestRays; end <= MostRays; end *= 2)
      {
        for (std::size_t batch = 0; batch < Batches; ++batch)
        {
          const SobolSequence sequence(
            Hash64(Hash64(options.Seed ^ 0x676174686572ull, i), static_cast<std::uint64_t>(batch)));
          for (std::uint32_t k = done; k < end; ++k)
          {
            const auto u = sequence(k);
            const Vec3 direction = CosineDirection(point.Normal, u[0], u[1]);
            // The start that this ray can leave from, beginning with a sampled one.
            const auto first = static_cast<std::size_t>(u[2] * static_cast<double>(starts.size()));
            const PointStart* start = nullptr;
            for (std::size_t s = 0; s < starts.size() && !start; ++s)
            {
              const PointStart& candidate = starts[(first + s) % starts.size()];
              if (point.Around.empty() || Dot(candidate.Normal, direction) > 0.0)
              {
                start = &candidate;
              }
            }
            if (!start)
            {
              continue; // into the surface from everywhere: not part of what it sees
            }
            ++rays[i];
            counted[batch] += 1.0;
            const SurfaceHit hit = occluders.Closest(start->End, direction);
            const std::int32_t met = elements.Find(hit.Triangle, hit.Front, hit.U, hit.V);
            if (met >= 0)
            {
              hits.push_back(met);
            }
            for (std::size_t b = 0; met >= 0 && b < nb; ++b)
            {
              sums[batch * nb + b] += radiosity[static_cast<std::size_t>(met) * nb + b];
            }
          }
        }
        // Two estimates of the error in turn must agree that it is small: one may be so by chance.
        bool fine = done > 0;
        for (std::size_t b = 0; b < nb; ++b)
        {
          before[b] = error[b] / std::sqrt(2.0);
        }
        done = end;
        for (std::size_t b = 0; b < nb; ++b)
        {
          mean[b] = 0.0;
          double square = 0.0;
          for (std::size_t batch = 0; batch < Batches; ++batch)
          {
            mean[b] += sums[batch * nb + b] / std::max(1.0, counted[batch]) / Batches;
          }
          for (std::size_t batch = 0; batch < Batches; ++batch)
          {
            const double off = sums[batch * nb + b] / std::max(1.0, counted[batch]) - mean[b];
            square += off * off;
          }
          error[b] = std::sqrt(square / (Batches * (Batches - 1.0)));
          fine = fine &&
            2.0 * (error[b] + before[b]) <=
              std::max(absoluteTolerance, options.RelativeTolerance * mean[b]);
        }
        if (fine)
        {
          break;
        }
      }
      std::copy(mean.begin(), mean.end(), result.Irradiance.data() + i * nb);
      for (std::size_t b = 0; b < nb; ++b)
      {
        error[b] = std::pow(std::max(error[b], before[b]), 2);
      }
      std::sort(hits.begin(), hits.end());
      for (std::size_t h = 0; h < hits.size();)
      {
        std::size_t end = h;
        while (end < hits.size() && hits[end] == hits[h])
        {
          ++end;
        }
        const double weight = static_cast<double>(end - h) / static_cast<double>(rays[i]);
        for (std::size_t b = 0; b < nb; ++b)
        {
          const double u = radiosityError[static_cast<std::size_t>(hits[h]) * nb + b];
          error[b] += weight * weight * u * u;
        }
        h = end;
      }
      for (std::size_t b = 0; b < nb; ++b)
      {
        result.Error[i * nb + b] = std::sqrt(error[b]);
      }
    },
    1e-4);
  for (const std::int64_t r : rays)
  {
    result.Rays += r;
  }
  return result;
}

} // namespace radiometry
