// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/PointGather.h"

#include "radiometry/formfactor/PathFollower.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/Collective.h"
#include "radiometry/visibility/PointStarts.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace radiometry
{
namespace
{

constexpr std::size_t Batches = 8;
constexpr std::uint32_t FewestRays = 32; // a batch
constexpr std::uint32_t MostRays = 512;
constexpr std::uint32_t LateRays = 4;

/// What all points know.
struct Surroundings
{
  const Scene& Geometry;
  const OcclusionScene& Occluders;
  const ElementSet& Elements;
  const std::vector<double>& RadiosityError;
  const ExchangeOptions& Options;
  std::size_t Bands;
  std::vector<double> Leaving; // as paths count it: divided by what is not sent on

  Surroundings(const Scene& scene, const OcclusionScene& occluders, const ElementSet& elements,
    const std::vector<double>& radiosity, const std::vector<double>& radiosityError,
    const ExchangeOptions& options, std::size_t bands)
    : Geometry(scene)
    , Occluders(occluders)
    , Elements(elements)
    , RadiosityError(radiosityError)
    , Options(options)
    , Bands(bands)
    , Leaving(radiosity)
  {
    for (std::size_t k = 0; options.Paths && k < this->Leaving.size(); ++k)
    {
      const double left = this->Left(k / bands, k % bands);
      this->Leaving[k] = left > 0.0 ? this->Leaving[k] / left : 0.0;
    }
  }
  double Left(std::size_t element, std::size_t band) const
  {
    const Patch& p = this->Elements.GetPatches()[element];
    return this->Options.Paths->Left(
      p.Triangle, p.Side == 0, this->Options.Paths->Width() > 1 ? band : 0);
  }
};

/// The rays of one point.
class Gather
{
public:
  Gather(const Surroundings& all, const SurfacePoint& point, std::size_t index)
    : All(all)
    , Point(point)
    , Starts(PointStarts(all.Geometry, all.Occluders, point))
    , Key(Hash64(all.Options.Seed ^ 0x676174686572ull, index))
    , Mean(all.Bands)
    , Error(all.Bands)
    , Before(all.Bands, 0.0)
    , Sums(Batches * all.Bands, 0.0)
    , Weight(all.Options.Paths ? all.Options.Paths->Width() : 1)
    , Part(this->Weight.size())
  {
  }

  /// Traces until the tolerance is met; values and standard errors of the point.
  /// `late`: whether time is up, when as few rays as tell an error have to do.
  template <class Late>
  void Run(double absoluteTolerance, const Late& late, double* values, double* errors)
  {
    std::uint32_t done = 0;
    for (std::uint32_t end = late() ? LateRays : FewestRays; end <= MostRays; end *= 2)
    {
      for (std::size_t batch = 0; batch < Batches; ++batch)
      {
        this->Trace(batch, done, end);
      }
      const bool fine = this->Estimate(absoluteTolerance) && done > 0;
      done = end;
      if (fine || late())
      {
        break;
      }
    }
    std::copy(this->Mean.begin(), this->Mean.end(), values);
    for (std::size_t b = 0; b < this->All.Bands; ++b)
    {
      errors[b] = std::pow(std::max(this->Error[b], this->Before[b]), 2);
    }
    this->AddElements(errors);
    for (std::size_t b = 0; b < this->All.Bands; ++b)
    {
      errors[b] = std::sqrt(errors[b]);
    }
  }

  std::int64_t Rays = 0;

private:
  /// The start that a ray can leave from, beginning with a sampled one; null: into the surface from
  /// everywhere.
  const PointStart* StartOf(const Vec3& direction, double choice) const
  {
    const auto first = static_cast<std::size_t>(choice * static_cast<double>(this->Starts.size()));
    for (std::size_t s = 0; s < this->Starts.size(); ++s)
    {
      const PointStart& candidate = this->Starts[(first + s) % this->Starts.size()];
      if (this->Point.Around.empty() || Dot(candidate.Normal, direction) > 0.0)
      {
        return &candidate;
      }
    }
    return nullptr;
  }

  void Trace(std::size_t batch, std::uint32_t begin, std::uint32_t end)
  {
    const std::uint64_t key = Hash64(this->Key, static_cast<std::uint64_t>(batch));
    const SobolSequence sequence(key);
    const auto count = [&](std::int32_t element, const double* weight) {
      const double* leaving =
        this->All.Leaving.data() + static_cast<std::size_t>(element) * this->All.Bands;
      for (std::size_t b = 0; b < this->All.Bands; ++b)
      {
        this->Sums[batch * this->All.Bands + b] +=
          weight[this->Weight.size() > 1 ? b : 0] * leaving[b];
      }
      this->Hits.emplace_back(element, *std::max_element(weight, weight + this->Weight.size()));
    };
    for (std::uint32_t k = begin; k < end; ++k)
    {
      const auto u = sequence(k);
      const Vec3 direction = CosineDirection(this->Point.Normal, u[0], u[1]);
      const PointStart* start = this->StartOf(direction, u[2]);
      if (!start)
      {
        continue; // not part of what it sees
      }
      ++this->Rays;
      this->Counted[batch] += 1.0;
      const SurfaceHit hit = this->All.Occluders.Closest(start->End, direction);
      std::fill(this->Weight.begin(), this->Weight.end(), 1.0);
      if (this->All.Options.Paths && this->All.Options.Paths->GoesOn(hit))
      {
        FollowPath(this->All.Occluders, this->All.Elements, *this->All.Options.Paths, hit,
          direction, Hash64(key, 0x70617468ull), k, this->Weight.data(), this->Part.data(), count);
        continue;
      }
      const std::int32_t met = this->All.Elements.Find(hit.Triangle, hit.Front, hit.U, hit.V);
      if (met >= 0)
      {
        count(met, this->Weight.data());
      }
    }
  }

  /// Two estimates of the error in turn must agree that it is small: one may be so by chance.
  bool Estimate(double absoluteTolerance)
  {
    bool fine = true;
    for (std::size_t b = 0; b < this->All.Bands; ++b)
    {
      this->Before[b] = this->Error[b] / std::sqrt(2.0);
      std::array<double, Batches> batches;
      this->Mean[b] = 0.0;
      for (std::size_t batch = 0; batch < Batches; ++batch)
      {
        batches[batch] =
          this->Sums[batch * this->All.Bands + b] / std::max(1.0, this->Counted[batch]);
        this->Mean[b] += batches[batch] / Batches;
      }
      double square = 0.0;
      for (const double v : batches)
      {
        square += (v - this->Mean[b]) * (v - this->Mean[b]);
      }
      this->Error[b] = std::sqrt(square / (Batches * (Batches - 1.0)));
      fine = fine &&
        2.0 * (this->Error[b] + this->Before[b]) <=
          std::max(absoluteTolerance, this->All.Options.RelativeTolerance * this->Mean[b]);
    }
    return fine;
  }

  /// Squares of the errors of the elements that were met, each by its share.
  void AddElements(double* squares)
  {
    std::sort(this->Hits.begin(), this->Hits.end());
    for (std::size_t h = 0; h < this->Hits.size();)
    {
      const auto element = static_cast<std::size_t>(this->Hits[h].first);
      double weight = 0.0;
      for (; h < this->Hits.size() && this->Hits[h].first == static_cast<std::int32_t>(element);
           ++h)
      {
        weight += this->Hits[h].second;
      }
      for (std::size_t b = 0; b < this->All.Bands; ++b)
      {
        const double left = this->All.Options.Paths ? this->All.Left(element, b) : 1.0;
        const double share = left > 0.0 ? weight / (left * static_cast<double>(this->Rays)) : 0.0;
        const double u = share * this->All.RadiosityError[element * this->All.Bands + b];
        squares[b] += u * u;
      }
    }
  }

  const Surroundings& All;
  const SurfacePoint& Point;
  std::vector<PointStart> Starts;
  std::uint64_t Key;
  std::vector<double> Mean, Error, Before;
  std::vector<double> Sums; // batches x bands
  std::array<double, Batches> Counted{};
  std::vector<double> Weight, Part; // of a path
  std::vector<std::pair<std::int32_t, double>> Hits;
};

} // namespace

GatherResult GatherAtPoints(const Scene& scene, const OcclusionScene& occluders,
  const ElementSet& elements, const std::vector<double>& radiosity,
  const std::vector<double>& radiosityError, int bands, const std::vector<SurfacePoint>& points,
  double absoluteTolerance, const ExchangeOptions& options, const StageProgress& stage)
{
  const auto nb = static_cast<std::size_t>(bands);
  const Surroundings all(scene, occluders, elements, radiosity, radiosityError, options, nb);
  GatherResult result;
  result.Irradiance.assign(points.size() * nb, 0.0);
  result.Error.assign(points.size() * nb, 0.0);
  occluders.PrepareRays(options.Threads);
  const RankShare share(options.Ranks, points.size());
  std::vector<std::int64_t> rays(share.End - share.Begin, 0);
  const auto start = std::chrono::steady_clock::now();
  const auto late = [&] {
    return options.SecondsLeft > 0.0 &&
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() >
      options.SecondsLeft;
  };
  Collectively(options.Ranks, [&] {
    ParallelFor(
      rays.size(), options.Threads, stage,
      [&](std::size_t own) {
        const std::size_t i = share.Begin + own;
        Gather gather(all, points[i], i);
        gather.Run(
          absoluteTolerance, late, result.Irradiance.data() + i * nb, result.Error.data() + i * nb);
        rays[own] = gather.Rays;
      },
      1e-4);
  });
  for (const std::int64_t r : rays)
  {
    result.Rays += r;
  }
  if (options.Ranks)
  {
    const std::vector<std::size_t> begin = RankShare::Begins(*options.Ranks, points.size(), nb);
    options.Ranks->Gather(result.Irradiance.data(), begin);
    options.Ranks->Gather(result.Error.data(), begin);
    options.Ranks->Sum(&result.Rays, 1);
  }
  return result;
}

} // namespace radiometry
