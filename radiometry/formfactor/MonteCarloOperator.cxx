// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/MonteCarloOperator.h"

#include "radiometry/formfactor/LinkedSets.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double MiB = 1024.0 * 1024.0;

/// Adds what leaves the elements that were hit.
void SumHits(const std::int32_t* begin, const std::int32_t* end, const double* B, std::size_t bands,
  double* sum)
{
  for (const std::int32_t* hit = begin; hit != end; ++hit)
  {
    if (*hit >= 0)
    {
      const double* leaving = B + static_cast<std::size_t>(*hit) * bands;
      for (std::size_t b = 0; b < bands; ++b)
      {
        sum[b] += leaving[b];
      }
    }
  }
}

/// The same for a number of bands known when compiled: the sums stay in registers.
template <std::size_t Bands>
void SumHits(const std::int32_t* begin, const std::int32_t* end, const double* B, double* sum)
{
  double local[Bands] = {};
  for (const std::int32_t* hit = begin; hit != end; ++hit)
  {
    if (*hit >= 0)
    {
      const double* leaving = B + static_cast<std::size_t>(*hit) * Bands;
      for (std::size_t b = 0; b < Bands; ++b)
      {
        local[b] += leaving[b];
      }
    }
  }
  for (std::size_t b = 0; b < Bands; ++b)
  {
    sum[b] += local[b];
  }
}

} // namespace

MonteCarloOperator::MonteCarloOperator(const OcclusionScene& occluders, const ElementSet& elements,
  const ExchangeOptions& options, int rays, const StageProgress& stage)
  : Occluders(occluders)
  , Elements(elements)
  , Options(options)
  , RaysOf(elements.Size(), 0)
{
  const std::int32_t each = std::max(1, (rays + Batches - 1) / Batches) * Batches;
  this->Trace(std::vector<std::int32_t>(elements.Size(), each), stage);
}

void MonteCarloOperator::DoubleRays(
  const std::vector<std::uint8_t>& marked, const StageProgress& stage)
{
  std::vector<std::int32_t> rays(this->Size(), 0);
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    rays[i] = marked[i] ? this->RaysOf[i] : 0;
  }
  this->Trace(rays, stage);
}

void MonteCarloOperator::Trace(const std::vector<std::int32_t>& rays, const StageProgress& stage)
{
  Round round;
  round.Begin.assign(1, 0);
  for (const std::int32_t r : rays)
  {
    round.Begin.push_back(round.Begin.back() + static_cast<std::size_t>(r));
  }
  const std::size_t bytes = this->MemoryBytes() + round.Begin.back() * sizeof(std::int32_t);
  if (this->Options.MemoryLimit && bytes > this->Options.MemoryLimit)
  {
    throw InputError("MemoryLimit", -1, static_cast<double>(this->Options.MemoryLimit) / MiB,
      "at least " +
        std::to_string(static_cast<long long>(std::ceil(static_cast<double>(bytes) / MiB))) +
        " MiB for the rays of " + std::to_string(this->Size()) + " elements");
  }
  round.Hit.resize(round.Begin.back());
  ParallelFor(
    rays.size(), this->Options.Threads, stage,
    [&](std::size_t i) {
      if (rays[i] == 0)
      {
        return;
      }
      const Patch& patch = this->Elements.GetPatches()[i];
      const Vec3 normal = Normalized(AreaNormal2(patch.Corners));
      std::int32_t* hit = round.Hit.data() + round.Begin[i];
      const auto first = static_cast<std::uint32_t>(this->RaysOf[i] / Batches);
      const auto count = static_cast<std::uint32_t>(rays[i] / Batches);
      for (int batch = 0; batch < Batches; ++batch)
      {
        const SobolSequence sequence(
          Hash64(Hash64(this->Options.Seed, i), static_cast<std::uint64_t>(batch)));
        for (std::uint32_t k = first; k < first + count; ++k)
        {
          const auto u = sequence(k);
          const SurfaceHit met =
            this->Occluders.Closest({ TrianglePoint(patch.Corners, u[0], u[1]), patch.Triangle },
              CosineDirection(normal, u[2], u[3]));
          *hit++ = this->Elements.Find(met.Triangle, met.Front, met.U, met.V);
        }
      }
    },
    2e-6 * std::max(1, rays.empty() ? 1 : rays[0]));
  this->Rounds.push_back(std::move(round));
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    this->RaysOf[i] += rays[i];
    this->Total += rays[i];
  }
  this->Summarise();
}

void MonteCarloOperator::Summarise()
{
  const std::size_t n = this->Size();
  const std::vector<double>& areas = this->Areas();
  LinkedSets sets(n);
  std::vector<std::int64_t> met(n, 0);
  std::vector<double> column(n, 0.0);
  for (const Round& round : this->Rounds)
  {
    for (std::size_t i = 0; i < n; ++i)
    {
      for (std::size_t k = round.Begin[i]; k < round.Begin[i + 1]; ++k)
      {
        const std::int32_t hit = round.Hit[k];
        if (hit >= 0)
        {
          ++met[i];
          column[static_cast<std::size_t>(hit)] += areas[i] / this->RaysOf[i];
          sets.Join(static_cast<std::int32_t>(i), hit);
        }
      }
    }
  }
  this->RowSums.resize(n);
  this->Component.resize(n);
  std::vector<std::int32_t> number(n, -1);
  std::vector<std::uint8_t> closed;
  this->ComponentArea.clear();
  for (std::size_t i = 0; i < n; ++i)
  {
    this->RowSums[i] = static_cast<double>(met[i]) / std::max(1, this->RaysOf[i]);
    auto& label = number[static_cast<std::size_t>(sets.Root(static_cast<std::int32_t>(i)))];
    if (label < 0)
    {
      label = static_cast<std::int32_t>(closed.size());
      closed.push_back(1);
      this->ComponentArea.push_back(0.0);
    }
    this->Component[i] = label;
    const auto c = static_cast<std::size_t>(label);
    closed[c] = closed[c] && met[i] == this->RaysOf[i];
    this->ComponentArea[c] += areas[i];
  }
  this->Balance.assign(n, 0.0);
  this->Report = {};
  double reciprocity = 0.0;
  for (std::size_t i = 0; i < n; ++i)
  {
    const auto c = static_cast<std::size_t>(this->Component[i]);
    if (closed[c])
    {
      this->Balance[i] = areas[i] - column[i];
      ++this->Report.ClosedRows;
      reciprocity = std::max(reciprocity, std::abs(this->Balance[i]) / areas[i]);
    }
  }
  this->Report.ReciprocityDefect = reciprocity;
  for (std::size_t c = 0; c < closed.size(); ++c)
  {
    this->ComponentArea[c] = closed[c] ? this->ComponentArea[c] : 0.0;
  }
}

const std::vector<double>& MonteCarloOperator::Areas() const { return this->Elements.GetAreas(); }

void MonteCarloOperator::Apply(const double* B, double* out, int bands) const
{
  const auto nb = static_cast<std::size_t>(bands);
  const std::size_t n = this->Size();
  std::vector<double> shift(this->ComponentArea.size() * nb, 0.0);
  for (std::size_t i = 0; i < n; ++i)
  {
    for (std::size_t b = 0; b < nb; ++b)
    {
      shift[static_cast<std::size_t>(this->Component[i]) * nb + b] +=
        this->Balance[i] * B[i * nb + b];
    }
  }
  ParallelFor(
    n, this->Options.Threads, {},
    [&](std::size_t i) {
      double* sum = out + i * nb;
      std::fill(sum, sum + nb, 0.0);
      for (const Round& round : this->Rounds)
      {
        const std::int32_t* begin = round.Hit.data() + round.Begin[i];
        const std::int32_t* end = round.Hit.data() + round.Begin[i + 1];
        switch (nb)
        {
          case 1:
            SumHits<1>(begin, end, B, sum);
            break;
          case 3:
            SumHits<3>(begin, end, B, sum);
            break;
          default:
            SumHits(begin, end, B, nb, sum);
        }
      }
      const auto c = static_cast<std::size_t>(this->Component[i]);
      for (std::size_t b = 0; b < nb; ++b)
      {
        sum[b] /= std::max(1, this->RaysOf[i]);
        if (this->ComponentArea[c] > 0.0)
        {
          sum[b] += shift[c * nb + b] / this->ComponentArea[c];
        }
      }
    },
    3e-9 * static_cast<double>(n ? this->Total / static_cast<std::int64_t>(n) + 1 : 1));
}

void MonteCarloOperator::ApplyError(
  const double* B, double* formFactor, double* visibility, int bands) const
{
  const auto nb = static_cast<std::size_t>(bands);
  ParallelFor(this->Size(), this->Options.Threads, {}, [&](std::size_t i) {
    std::vector<double> sums(Batches * nb, 0.0);
    for (const Round& round : this->Rounds)
    {
      const std::size_t count = (round.Begin[i + 1] - round.Begin[i]) / Batches;
      for (std::size_t k = round.Begin[i]; k < round.Begin[i + 1]; ++k)
      {
        if (round.Hit[k] >= 0)
        {
          const std::size_t batch = (k - round.Begin[i]) / count;
          for (std::size_t b = 0; b < nb; ++b)
          {
            sums[batch * nb + b] += B[static_cast<std::size_t>(round.Hit[k]) * nb + b];
          }
        }
      }
    }
    const double perBatch = std::max(1, this->RaysOf[i]) / static_cast<double>(Batches);
    for (std::size_t b = 0; b < nb; ++b)
    {
      double mean = 0.0, square = 0.0;
      for (std::size_t batch = 0; batch < Batches; ++batch)
      {
        mean += sums[batch * nb + b] / perBatch / Batches;
      }
      for (std::size_t batch = 0; batch < Batches; ++batch)
      {
        const double off = sums[batch * nb + b] / perBatch - mean;
        square += off * off;
      }
      formFactor[i * nb + b] = 0.0; // rays sample both at once
      visibility[i * nb + b] = std::sqrt(square / (Batches * (Batches - 1.0)));
    }
  });
}

std::size_t MonteCarloOperator::MemoryBytes() const
{
  std::size_t bytes = this->Size() * 48;
  for (const Round& round : this->Rounds)
  {
    bytes += round.Hit.size() * sizeof(std::int32_t) + round.Begin.size() * sizeof(std::size_t);
  }
  return bytes;
}

std::string MonteCarloOperator::Description() const
{
  const std::int64_t n = static_cast<std::int64_t>(std::max<std::size_t>(1, this->Size()));
  return "Monte Carlo, " + std::to_string(this->Size()) + " elements, " +
    std::to_string(this->Total) + " rays (" + std::to_string(this->Total / n) + " an element)";
}

} // namespace radiometry
