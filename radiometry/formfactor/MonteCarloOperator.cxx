// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/MonteCarloOperator.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace radiometry
{
namespace
{

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

/// What does not belong to the operator that is made of it.
template <class T>
std::shared_ptr<const T> NotOwned(const T& object)
{
  return std::shared_ptr<const T>(std::shared_ptr<const T>(), &object);
}

} // namespace

MonteCarloOperator::MonteCarloOperator(std::shared_ptr<const OcclusionScene> occluders,
  std::shared_ptr<const ElementSet> elements, const ExchangeOptions& options)
  : Occluders(std::move(occluders))
  , Elements(std::move(elements))
  , Options(options)
  , Share(options.Ranks, Elements->Size())
  , RaysOf(Elements->Size(), 0)
  , Leaks(Share.End - Share.Begin, 0)
  , CutOf(Share.End - Share.Begin, 0)
{
  if (options.Paths && options.Paths->Empty())
  {
    this->Options.Paths.reset();
  }
  this->Width = this->Options.Paths ? this->Options.Paths->Width() : 1;
  this->FindGains();
}

MonteCarloOperator::MonteCarloOperator(std::shared_ptr<const OcclusionScene> occluders,
  std::shared_ptr<const ElementSet> elements, const ExchangeOptions& options, int rays,
  const StageProgress& stage)
  : MonteCarloOperator(std::move(occluders), std::move(elements), options)
{
  const std::int32_t each = std::max(1, (rays + Batches - 1) / Batches) * Batches;
  this->Trace(std::vector<std::int32_t>(this->Size(), each), stage);
}

MonteCarloOperator::MonteCarloOperator(const OcclusionScene& occluders, const ElementSet& elements,
  const ExchangeOptions& options, int rays, const StageProgress& stage)
  : MonteCarloOperator(NotOwned(occluders), NotOwned(elements), options, rays, stage)
{
}

MonteCarloOperator::~MonteCarloOperator() = default;

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

void MonteCarloOperator::AddRays(
  const std::vector<std::int32_t>& rays, const StageProgress& stage)
{
  std::vector<std::int32_t> whole = rays;
  for (std::int32_t& each : whole)
  {
    each -= each % Batches;
  }
  this->Trace(whole, stage);
}

void MonteCarloOperator::FindGains()
{
  if (!this->Options.Paths)
  {
    return;
  }
  const std::vector<Patch>& patches = this->Elements->GetPatches();
  this->Gain.assign(patches.size() * this->Width, 1.0);
  for (std::size_t k = 0; k < this->Gain.size(); ++k)
  {
    const Patch& p = patches[k / this->Width];
    const double left = this->Options.Paths->Left(p.Triangle, p.Side == 0, k % this->Width);
    this->Gain[k] = left > 0.0 ? 1.0 / left : 0.0;
  }
}

std::vector<double> MonteCarloOperator::Scaled(const double* B, std::size_t bands) const
{
  std::vector<double> scaled(B, B + this->Size() * bands);
  for (std::size_t k = 0; k < scaled.size() && !this->Gain.empty(); ++k)
  {
    const double* gain = this->Gain.data() + k / bands * this->Width;
    scaled[k] *= this->Width == 1 ? gain[0]
      : bands == this->Width      ? gain[k % bands]
                                  : *std::max_element(gain, gain + this->Width);
  }
  return scaled;
}

void MonteCarloOperator::SumRow(const Round& round, std::size_t row, int batch,
  const double* scaled, std::size_t bands, double* sum) const
{
  std::size_t from = round.Begin[row], to = round.Begin[row + 1];
  if (batch >= 0)
  {
    const std::size_t each = (to - from) / Batches;
    from += static_cast<std::size_t>(batch) * each;
    to = from + each;
  }
  const std::int32_t* begin = round.Hit.data() + from;
  const std::int32_t* end = round.Hit.data() + to;
  switch (bands)
  {
    case 1:
      SumHits<1>(begin, end, scaled, sum);
      break;
    case 3:
      SumHits<3>(begin, end, scaled, sum);
      break;
    default:
      SumHits(begin, end, scaled, bands, sum);
  }
  if (round.PartBegin.empty())
  {
    return;
  }
  const std::size_t first = row * Batches + static_cast<std::size_t>(std::max(batch, 0));
  const std::size_t last = batch >= 0 ? first + 1 : first + Batches;
  for (std::size_t k = round.PartBegin[first]; k < round.PartBegin[last]; ++k)
  {
    const float* weight = round.PartWeight.data() + k * this->Width;
    const double* leaving = scaled + static_cast<std::size_t>(round.PartHit[k]) * bands;
    if (bands == this->Width)
    {
      for (std::size_t b = 0; b < bands; ++b)
      {
        sum[b] += static_cast<double>(weight[b]) * leaving[b];
      }
    }
    else
    {
      const double most = *std::max_element(weight, weight + this->Width);
      for (std::size_t b = 0; b < bands; ++b)
      {
        sum[b] += most * leaving[b];
      }
    }
  }
}

const std::vector<double>& MonteCarloOperator::Areas() const { return this->Elements->GetAreas(); }

/// The values of the elements that have no rays: those of the rows they take. `spread`: with how these
/// differ from each other.
void MonteCarloOperator::TakeRows(
  std::size_t nb, const std::vector<double>& mean, double* values, bool spread) const
{
  for (std::size_t i = 0; i < this->Around.size(); ++i)
  {
    const std::size_t row = this->RowOf(i);
    if (row == i)
    {
      continue;
    }
    const auto before = static_cast<std::size_t>(this->Around[i][0]);
    const auto behind = static_cast<std::size_t>(this->Around[i][1]);
    for (std::size_t b = 0; b < nb; ++b)
    {
      const double off = spread ? mean[before * nb + b] - mean[behind * nb + b] : 0.0;
      values[i * nb + b] = spread ? std::hypot(values[row * nb + b], off) : values[row * nb + b];
    }
  }
}

void MonteCarloOperator::Apply(const double* B, double* out, int bands) const
{
  const auto nb = static_cast<std::size_t>(bands);
  const std::size_t n = this->Size();
  const bool alike = this->Width == nb;
  const std::vector<double> copy = this->Gain.empty() ? std::vector<double>() : this->Scaled(B, nb);
  const double* scaled = this->Gain.empty() ? B : copy.data();
  std::vector<double> shift;
  if (!this->Balance.empty())
  {
    shift.assign(this->ComponentArea.size() / this->Width * nb, 0.0);
    for (std::size_t i = 0; i < n; ++i)
    {
      const double* balance = this->Balance.data() + i * this->Width;
      double* sum = shift.data() + static_cast<std::size_t>(this->Component[i]) * nb;
      for (std::size_t b = 0; b < nb; ++b)
      {
        sum[b] += balance[alike ? b : 0] * scaled[i * nb + b];
      }
    }
  }
  ParallelFor(
    this->Share.End - this->Share.Begin, this->Options.Threads, {},
    [&](std::size_t row) {
      const std::size_t i = this->Share.Begin + row;
      double* sum = out + i * nb;
      std::fill(sum, sum + nb, 0.0);
      for (const Round& round : this->Rounds)
      {
        this->SumRow(round, row, -1, scaled, nb, sum);
      }
      const auto c = static_cast<std::size_t>(this->Component[i]);
      for (std::size_t b = 0; b < nb; ++b)
      {
        sum[b] /= std::max(1, this->RaysOf[i]);
        const double area =
          shift.empty() ? 0.0 : this->ComponentArea[c * this->Width + (alike ? b : 0)];
        if (area > 0.0)
        {
          sum[b] += shift[c * nb + b] / area;
        }
      }
    },
    3e-9 * static_cast<double>(n ? this->Total / static_cast<std::int64_t>(n) + 1 : 1));
  this->TakeRows(nb, {}, out, false);
  if (this->Options.Ranks)
  {
    this->Options.Ranks->Gather(out, RankShare::Begins(*this->Options.Ranks, n, nb));
  }
}

namespace
{

/// How bright what an element's rays did not meet may be: of each component and band, what is exceeded
/// on a half, a quarter ... of its area.
class UnmetLight
{
public:
  UnmetLight(const std::vector<double>& B, std::size_t bands, const std::vector<std::int32_t>& component,
    const std::vector<double>& areas)
    : Component(component)
    , Bands(bands)
  {
    const auto n = areas.size();
    std::vector<std::int32_t> order(n);
    std::iota(order.begin(), order.end(), 0);
    const std::size_t count =
      n == 0 ? 0 : static_cast<std::size_t>(*std::max_element(component.begin(), component.end())) + 1;
    std::vector<double> whole(count, 0.0), above(count);
    for (std::size_t i = 0; i < n; ++i)
    {
      whole[static_cast<std::size_t>(component[i])] += areas[i];
    }
    this->Level.assign(count * bands * Levels, 0.0);
    for (std::size_t b = 0; b < bands; ++b)
    {
      const auto of = [&](std::int32_t i) { return B[static_cast<std::size_t>(i) * bands + b]; };
      std::sort(order.begin(), order.end(),
        [&](std::int32_t i, std::int32_t j) { return of(i) > of(j) || (of(i) == of(j) && i < j); });
      std::fill(above.begin(), above.end(), 0.0);
      for (const std::int32_t i : order)
      {
        const auto c = static_cast<std::size_t>(component[static_cast<std::size_t>(i)]);
        const double before = above[c];
        above[c] += areas[static_cast<std::size_t>(i)];
        double share = 0.5 * whole[c];
        for (std::size_t k = 0; k < Levels; ++k, share *= 0.5)
        {
          if (before < share && above[c] >= share)
          {
            this->Level[(c * bands + b) * Levels + k] = of(i);
          }
        }
      }
    }
  }

  /// What arrives of surfaces brighter than any that was met, half a ray being one that would have
  /// met them; a part of the area is seen under no more than twice its share.
  double Of(std::size_t element, std::size_t band, double met, double rays) const
  {
    const auto c = static_cast<std::size_t>(this->Component[element]);
    const double* level = this->Level.data() + (c * this->Bands + band) * Levels;
    double most = 0.0, share = 0.5;
    for (std::size_t k = 0; k < Levels; ++k, share *= 0.5)
    {
      most = std::max(most, (level[k] - met) * std::min(0.5 / rays, 2.0 * share));
    }
    return most;
  }

private:
  static constexpr std::size_t Levels = 14;
  const std::vector<std::int32_t>& Component;
  std::size_t Bands;
  std::vector<double> Level;
};

} // namespace

double MonteCarloOperator::GreatestMet(
  std::size_t row, const double* scaled, std::size_t bands, std::size_t band) const
{
  double most = 0.0;
  for (const Round& round : this->Rounds)
  {
    for (std::size_t k = round.Begin[row]; k < round.Begin[row + 1]; ++k)
    {
      most = round.Hit[k] < 0
        ? most
        : std::max(most, scaled[static_cast<std::size_t>(round.Hit[k]) * bands + band]);
    }
    for (std::size_t k = round.PartBegin.empty() ? 0 : round.PartBegin[row * Batches],
                     end = round.PartBegin.empty() ? 0 : round.PartBegin[(row + 1) * Batches];
         k < end; ++k)
    {
      most = std::max(most, scaled[static_cast<std::size_t>(round.PartHit[k]) * bands + band]);
    }
  }
  return most;
}

void MonteCarloOperator::ApplyError(
  const double* B, double* formFactor, double* visibility, int bands) const
{
  const auto nb = static_cast<std::size_t>(bands);
  const std::size_t n = this->Size();
  const std::vector<double> scaled = this->Scaled(B, nb);
  std::vector<double> greatest(nb, 0.0);
  for (std::size_t k = 0; this->TotalCut > 0 && k < scaled.size(); ++k)
  {
    greatest[k % nb] = std::max(greatest[k % nb], std::abs(scaled[k]));
  }
  std::fill(formFactor, formFactor + n * nb, 0.0); // rays sample both at once
  std::vector<double> means(this->Around.empty() ? 0 : n * nb, 0.0);
  // Of differences of light nothing is known to be bright.
  const bool light = std::none_of(scaled.begin(), scaled.end(), [](double v) { return v < 0.0; });
  const UnmetLight unmet(scaled, light ? nb : 0, this->Component, this->Areas());
  ParallelFor(
    this->Share.End - this->Share.Begin, this->Options.Threads, {},
    [&](std::size_t row) {
      const std::size_t i = this->Share.Begin + row;
      std::vector<double> sums(Batches * nb, 0.0);
      for (const Round& round : this->Rounds)
      {
        for (int batch = 0; batch < Batches; ++batch)
        {
          this->SumRow(round, row, batch, scaled.data(), nb,
            sums.data() + static_cast<std::size_t>(batch) * nb);
        }
      }
      const double perBatch = std::max(1, this->RaysOf[i]) / static_cast<double>(Batches);
      const double cut = this->CutOf[row] / static_cast<double>(std::max(1, this->RaysOf[i]));
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
        const double missed = !light
          ? 0.0
          : unmet.Of(i, b, this->GreatestMet(row, scaled.data(), nb, b),
              static_cast<double>(std::max(1, this->RaysOf[i])));
        visibility[i * nb + b] =
          std::sqrt(square / (Batches * (Batches - 1.0)) + missed * missed) + cut * greatest[b];
        if (!means.empty())
        {
          means[i * nb + b] = mean;
        }
      }
    },
    1e-8 * static_cast<double>(n ? this->Total / static_cast<std::int64_t>(n) + 1 : 1));
  this->TakeRows(nb, means, visibility, true);
  if (this->Options.Ranks)
  {
    this->Options.Ranks->Gather(visibility, RankShare::Begins(*this->Options.Ranks, n, nb));
  }
}

std::size_t MonteCarloOperator::Round::Bytes() const
{
  return (this->Begin.size() + this->PartBegin.size()) * sizeof(std::size_t) +
    (this->Hit.size() + this->PartHit.size()) * sizeof(std::int32_t) +
    this->PartWeight.size() * sizeof(float);
}

std::size_t MonteCarloOperator::MemoryBytes() const
{
  return this->OwnBytes + this->Size() * (40 + 24 * this->Width);
}

std::string MonteCarloOperator::Description() const
{
  const std::int64_t n = static_cast<std::int64_t>(std::max<std::size_t>(1, this->Size()));
  return "Monte Carlo, " + std::to_string(this->Size()) + " elements, " +
    std::to_string(this->Total) + " rays (" + std::to_string(this->Total / n) + " an element)" +
    (this->Options.Paths ? ", followed over mirrors and through panes" : "");
}

} // namespace radiometry
