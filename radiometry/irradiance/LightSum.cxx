// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/LightSum.h"

#include "radiometry/geometry/Sampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace radiometry
{
namespace
{

/// The share of a value's tolerance that lights left out may use up.
constexpr double DroppedShare = 0.25;
/// ... and the error of samples.
constexpr double SampledShare = 0.7;
/// So many samples are drawn at most, and at least before their spread means much.
constexpr std::size_t MostSamples = 4096;
constexpr std::size_t LeastSamples = 64;
/// Independent systematic samples: their spread tells the error.
constexpr int Sets = 8;
/// Error bars in standard deviations. That is more than 95 % of a normal distribution would want:
/// the deviation is known from eight sets only, what rare strong lights give is skewed, and an
/// estimate is taken where its spread happens to be small.
constexpr double Deviations = 3.3;

} // namespace

LightSum::LightSum(const LightTree& tree, int bands)
  : Tree(tree)
  , Bands(static_cast<std::size_t>(bands))
{
}

void LightSum::Push(std::int32_t entry, const ReceiverBounds& bounds)
{
  const double gain = this->Tree.Gain(entry, bounds);
  const double bound = gain * this->Tree.Strength(entry);
  if (bound > 0.0)
  {
    this->Heap.push_back({ bound, gain, entry });
    std::push_heap(this->Heap.begin(), this->Heap.end());
  }
}

std::int64_t LightSum::Compute(ReceiverBlock& block, const ReceiverBounds& bounds,
  std::size_t count, const std::uint8_t* active, const LightEffort& effort, std::uint64_t key)
{
  this->Count = count;
  this->Active.assign(active, active + count);
  this->Value.assign(count * this->Bands, 0.0);
  this->Error.assign(count * this->Bands, 0.0);
  this->Variance.assign(count * this->Bands, 0.0);
  this->Open.assign(count * this->Bands, 0.0);
  this->Dropped.assign(count, 0.0);
  this->Strong.assign(count, 0.0);
  this->Basis.resize(count);
  this->Shares.resize(count);
  this->Rest.assign(this->Bands, 0.0);
  this->PeakUnshadowed = 0.0;
  this->Sampled = false;
  this->Rays = 0;
  this->Heap.clear();
  for (const std::int32_t entry : this->Tree.Roots())
  {
    this->Push(entry, bounds);
  }
  std::size_t asked = 0;
  std::size_t next = 1; // when to see next whether the rest can be dropped
  std::size_t look = std::max<std::size_t>(1, effort.FirstLook);
  bool settled = false;
  while (!this->Heap.empty() && !settled)
  {
    const Entry top = this->Heap.front();
    if (this->Tree.IsLight(top.Id))
    {
      if (asked >= next)
      {
        settled = this->Settle(effort);
        next = asked + 1 + asked / 4;
        if (settled)
        {
          break;
        }
      }
      if (asked >= std::min(look, effort.Lights) && std::isfinite(top.Bound))
      {
        const bool last = asked >= effort.Lights;
        settled = this->Sample(block, bounds, effort, asked, last, key);
        look = 4 * asked;
        if (settled)
        {
          break;
        }
      }
    }
    std::pop_heap(this->Heap.begin(), this->Heap.end());
    this->Heap.pop_back();
    if (this->Tree.IsLight(top.Id))
    {
      this->AskOne(block, this->Tree.LightOf(top.Id));
      ++asked;
      continue;
    }
    for (int k = 0; k < 2; ++k)
    {
      this->Push(this->Tree.Children(top.Id)[k], bounds);
    }
  }
  this->Finish();
  return this->Rays;
}

void LightSum::AskOne(ReceiverBlock& block, std::size_t light)
{
  const auto entry = static_cast<std::int32_t>(this->Tree.Nodes() + light);
  const double strength = this->Tree.Strength(entry);
  for (std::size_t i = 0; i < this->Count; ++i)
  {
    this->Shares[i] = {};
    this->Basis[i] = this->Strong[i] / strength;
  }
  this->Rays += block.Ask(light, this->Active.data(), this->Basis.data(), this->Shares.data());
  const double* tints = block.Tints();
  for (std::size_t i = 0; i < this->Count; ++i)
  {
    const LightShare& share = this->Shares[i];
    if (this->Active[i] == 0 || !(share.Open > 0.0))
    {
      continue;
    }
    this->Strong[i] += strength * share.Lit;
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      const std::size_t at = i * this->Bands + b;
      const double intensity = this->Tree.Intensity(entry, static_cast<int>(b));
      const double passing = tints ? intensity * tints[at] : intensity;
      this->Value[at] += passing * share.Lit;
      this->Open[at] += intensity * share.Open;
      this->Error[at] += passing * share.Systematic;
      const double doubt = intensity * share.Doubt;
      this->Variance[at] += doubt * doubt;
    }
  }
}

/// Drops what is left for those receivers to which it cannot matter; true when that is all of them.
bool LightSum::Settle(const LightEffort& effort)
{
  std::fill(this->Rest.begin(), this->Rest.end(), 0.0);
  double together = 0.0;
  for (const Entry& entry : this->Heap)
  {
    together += entry.Bound;
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      this->Rest[b] += entry.Gain * this->Tree.Intensity(entry.Id, static_cast<int>(b));
    }
  }
  bool all = true;
  for (std::size_t i = 0; i < this->Count; ++i)
  {
    if (this->Active[i] == 0)
    {
      continue;
    }
    bool fits = std::isfinite(together);
    for (std::size_t b = 0; b < this->Bands && fits; ++b)
    {
      fits = this->Rest[b] + effort.Dropped <= DroppedShare *
          std::max(effort.RelativeTolerance * this->Value[i * this->Bands + b],
            effort.AbsoluteTolerance);
    }
    if (!fits)
    {
      all = false;
      continue;
    }
    this->Active[i] = 0;
    this->Dropped[i] = *std::max_element(this->Rest.begin(), this->Rest.end());
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      this->Error[i * this->Bands + b] += this->Rest[b];
      this->Open[i * this->Bands + b] += this->Rest[b];
    }
  }
  return all;
}

/// Follows a place in [0, 1) down to a light; returns the probability of that way and leaves the
/// light in `entry`.
double LightSum::Draw(const ReceiverBounds& bounds, double at, Entry& entry) const
{
  double probability = 1.0;
  while (!this->Tree.IsLight(entry.Id))
  {
    Entry child[2];
    for (int k = 0; k < 2; ++k)
    {
      child[k].Id = this->Tree.Children(entry.Id)[k];
      child[k].Gain = this->Tree.Gain(child[k].Id, bounds);
      child[k].Bound = child[k].Gain * this->Tree.Strength(child[k].Id);
    }
    double first = 0.5;
    if (std::isfinite(child[0].Bound) && std::isfinite(child[1].Bound))
    {
      const double sum = child[0].Bound + child[1].Bound;
      if (!(sum > 0.0))
      {
        return 0.0; // the closer look finds that none of these matters
      }
      first = child[0].Bound / sum;
    }
    const int k = at < first ? 0 : 1;
    const double share = k == 0 ? first : 1.0 - first;
    at = std::min((k == 0 ? at : at - first) / share, 1.0 - 1e-12);
    probability *= share;
    entry = child[k];
  }
  return probability;
}

/// Estimates what is left; true when that did for all receivers, or had to (`last`).
bool LightSum::Sample(ReceiverBlock& block, const ReceiverBounds& bounds,
  const LightEffort& effort, std::size_t asked, bool last, std::uint64_t key)
{
  std::size_t left = 0;
  for (const Entry& entry : this->Heap)
  {
    left += static_cast<std::size_t>(this->Tree.Count(entry.Id));
  }
  if (this->Settle(effort))
  {
    return true;
  }
  // In haste as many as were asked one by one.
  std::size_t samples =
    last && asked < LeastSamples ? std::max<std::size_t>(Sets, asked) : std::max(LeastSamples, asked);
  if (!last && 4 * samples > left)
  {
    return false; // not worth it: as well ask them all
  }
  for (;;)
  {
    const std::size_t each = std::max<std::size_t>(1, samples / Sets);
    this->DrawSamples(bounds, each, Hash64(key, asked * 65537 + each));
    this->AskSamples(block);
    this->Sampled = true;
    const double excess = this->TakeEstimates(effort, Sets * each, last);
    if (!(excess > 1.0))
    {
      return true;
    }
    // The error of systematic samples falls at least with the root of their number.
    const double wanted = 1.2 * static_cast<double>(samples) * excess * excess;
    // Many more than were asked so far: asking the next strongest leaves less to estimate.
    const std::size_t most = std::min({ MostSamples, left / 2, 8 * std::max(LeastSamples, asked) });
    if (!(wanted < static_cast<double>(most)))
    {
      return false;
    }
    samples = std::max(2 * samples, static_cast<std::size_t>(wanted));
  }
}

void LightSum::DrawSamples(const ReceiverBounds& bounds, std::size_t each, std::uint64_t key)
{
  // In the order of the tree, which is one of space: systematic samples then spread evenly.
  std::vector<Entry> rest = this->Heap;
  std::sort(
    rest.begin(), rest.end(), [](const Entry& a, const Entry& b) { return a.Id < b.Id; });
  double total = 0.0;
  for (const Entry& e : rest)
  {
    total += e.Bound;
  }
  this->Samples.clear();
  for (int set = 0; set < Sets; ++set)
  {
    const double offset =
      static_cast<double>(Hash64(key, static_cast<std::uint64_t>(set)) >> 11) * 0x1p-53;
    std::size_t at = 0;
    double below = 0.0; // the bounds of the entries before `at`
    for (std::size_t j = 0; j < each; ++j)
    {
      const double place = (static_cast<double>(j) + offset) / static_cast<double>(each) * total;
      while (at + 1 < rest.size() && below + rest[at].Bound <= place)
      {
        below += rest[at++].Bound;
      }
      Entry entry = rest[at];
      const double within = std::clamp((place - below) / rest[at].Bound, 0.0, 1.0 - 1e-12);
      const double probability = rest[at].Bound / total * this->Draw(bounds, within, entry);
      if (probability > 0.0)
      {
        this->Samples.push_back({ this->Tree.LightOf(entry.Id), set,
          1.0 / (probability * static_cast<double>(each)) });
      }
    }
  }
  std::stable_sort(this->Samples.begin(), this->Samples.end(),
    [](const Drawn& a, const Drawn& b) { return a.Light < b.Light; });
}

void LightSum::AskSamples(ReceiverBlock& block)
{
  this->Sums.assign(this->Count * this->Bands * Sets, 0.0);
  this->SampleVariance.assign(this->Count * this->Bands, 0.0);
  this->SampleError.assign(this->Count * this->Bands, 0.0);
  for (std::size_t s = 0; s < this->Samples.size(); ++s)
  {
    const Drawn& sample = this->Samples[s];
    const auto entry = static_cast<std::int32_t>(this->Tree.Nodes() + sample.Light);
    if (s == 0 || sample.Light != this->Samples[s - 1].Light)
    {
      for (std::size_t i = 0; i < this->Count; ++i)
      {
        this->Shares[i] = {};
        this->Basis[i] = this->Strong[i] / this->Tree.Strength(entry);
      }
      this->Rays +=
        block.Ask(sample.Light, this->Active.data(), this->Basis.data(), this->Shares.data());
    }
    const double* tints = block.Tints();
    for (std::size_t i = 0; i < this->Count; ++i)
    {
      const LightShare& share = this->Shares[i];
      if (this->Active[i] == 0 || !(share.Open > 0.0))
      {
        continue;
      }
      for (std::size_t b = 0; b < this->Bands; ++b)
      {
        const double weight =
          sample.Weight * this->Tree.Intensity(entry, static_cast<int>(b)) / Sets;
        const std::size_t at = i * this->Bands + b;
        const double passing = tints ? weight * tints[at] : weight;
        this->Sums[at * Sets + static_cast<std::size_t>(sample.Set)] += Sets * passing * share.Lit;
        this->SampleError[at] += passing * share.Systematic;
        this->SampleVariance[at] += weight * share.Doubt * (weight * share.Doubt);
      }
    }
  }
}

/// Takes the estimate for the receivers for which it is good enough, with `last` for all. Returns
/// the greatest ratio of the others' errors to what would do.
double LightSum::TakeEstimates(const LightEffort& effort, std::size_t drawn, bool last)
{
  // What samples that all agree may have missed: half a light of the bound's average strength.
  const double missed = Deviations * std::sqrt(0.5) / static_cast<double>(drawn);
  double worst = 0.0;
  std::vector<double>& mean = this->Mean;
  std::vector<double>& error = this->Spread;
  mean.resize(this->Bands);
  error.resize(this->Bands);
  for (std::size_t i = 0; i < this->Count; ++i)
  {
    if (this->Active[i] == 0)
    {
      continue;
    }
    double excess = 0.0;
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      const double* sums = &this->Sums[(i * this->Bands + b) * Sets];
      mean[b] = std::accumulate(sums, sums + Sets, 0.0) / Sets;
      double spread = 0.0;
      for (int set = 0; set < Sets; ++set)
      {
        spread += (sums[set] - mean[b]) * (sums[set] - mean[b]);
      }
      error[b] = std::max(Deviations * std::sqrt(spread / (Sets * (Sets - 1.0))),
        missed * this->Rest[b]);
      const double allowed = SampledShare *
        std::max(effort.RelativeTolerance * (this->Value[i * this->Bands + b] + mean[b]),
          effort.AbsoluteTolerance);
      if (error[b] > 0.0)
      {
        excess = std::max(excess, allowed > 0.0 ? error[b] / allowed : 1e6);
      }
    }
    if (excess > 1.0 && !last)
    {
      worst = std::max(worst, excess);
      continue;
    }
    this->Active[i] = 0;
    this->Dropped[i] += *std::max_element(error.begin(), error.end());
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      const std::size_t at = i * this->Bands + b;
      this->Value[at] += mean[b];
      this->Open[at] += this->Rest[b];
      this->Error[at] += this->SampleError[at];
      this->Variance[at] += this->SampleVariance[at] + error[b] * error[b];
    }
  }
  return worst;
}

void LightSum::Finish()
{
  this->Uncertain.assign(this->Count, 0);
  for (std::size_t at = 0; at < this->Value.size(); ++at)
  {
    this->Error[at] += std::sqrt(this->Variance[at]);
    this->Uncertain[at / this->Bands] |= this->Variance[at] > 0.0 ? 1 : 0;
    this->PeakUnshadowed = std::max(this->PeakUnshadowed, this->Open[at]);
  }
}

} // namespace radiometry
