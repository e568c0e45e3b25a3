// SPDX-License-Identifier: BSD-3-Clause
// What MonteCarloOperator knows of all its rays together: sums of rows, components, balance.
#include "radiometry/formfactor/MonteCarloOperator.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

namespace radiometry
{
namespace
{

constexpr double RaySeconds = 2e-9; // to look at one again

/// Sets that grow together, from many threads at once. The least number of a set stands for it, so
/// the answer depends on neither order nor threads.
class SharedSets
{
public:
  explicit SharedSets(std::size_t n)
    : Up(new std::atomic<std::int32_t>[n])
  {
    for (std::size_t k = 0; k < n; ++k)
    {
      this->Up[k].store(static_cast<std::int32_t>(k), std::memory_order_relaxed);
    }
  }

  std::int32_t Root(std::int32_t k)
  {
    for (;;)
    {
      std::int32_t up = this->Up[static_cast<std::size_t>(k)].load(std::memory_order_relaxed);
      if (up == k)
      {
        return k;
      }
      const std::int32_t next =
        this->Up[static_cast<std::size_t>(up)].load(std::memory_order_relaxed);
      if (next != up)
      {
        this->Up[static_cast<std::size_t>(k)].compare_exchange_weak(
          up, next, std::memory_order_relaxed);
      }
      k = next;
    }
  }

  void Join(std::int32_t a, std::int32_t b)
  {
    for (;;)
    {
      a = this->Root(a);
      b = this->Root(b);
      if (a == b)
      {
        return;
      }
      if (a < b)
      {
        std::swap(a, b);
      }
      std::int32_t expected = a;
      if (this->Up[static_cast<std::size_t>(a)].compare_exchange_strong(
            expected, b, std::memory_order_relaxed))
      {
        return;
      }
    }
  }

private:
  std::unique_ptr<std::atomic<std::int32_t>[]> Up;
};

StageProgress Part(const StageProgress& stage, double from, double to)
{
  StageProgress part = stage;
  part.Begin = stage.Begin + from * (stage.End - stage.Begin);
  part.End = stage.Begin + to * (stage.End - stage.Begin);
  return part;
}

} // namespace

void MonteCarloOperator::Summarise(const StageProgress& stage)
{
  this->FindRowSums(Part(stage, 0.0, 0.3));
  this->FindComponents(Part(stage, 0.3, 0.6));
  this->FindBalance(Part(stage, 0.6, 1.0));
}

void MonteCarloOperator::FindRowSums(const StageProgress& stage)
{
  const std::size_t n = this->Size();
  const std::size_t width = this->Width;
  const std::vector<double> one(n * width, 1.0);
  const std::vector<double> scaled = this->Scaled(one.data(), width);
  this->RowSums.assign(n * width, 0.0);
  const std::size_t rows = this->Share.End - this->Share.Begin;
  ParallelFor(
    rows, this->Options.Threads, stage,
    [&](std::size_t row) {
      double* sum = this->RowSums.data() + (this->Share.Begin + row) * width;
      for (const Round& round : this->Rounds)
      {
        this->SumRow(round, row, -1, scaled.data(), width, sum);
      }
      for (std::size_t b = 0; b < width; ++b)
      {
        sum[b] /= std::max(1, this->RaysOf[this->Share.Begin + row]);
      }
    },
    RaySeconds * static_cast<double>(this->Total / static_cast<std::int64_t>(n + 1) + 1));
  if (this->Options.Ranks)
  {
    this->Options.Ranks->Gather(
      this->RowSums.data(), RankShare::Begins(*this->Options.Ranks, n, width));
  }
  for (std::size_t i = 0; i < this->Around.size(); ++i)
  {
    std::copy_n(
      this->RowSums.data() + this->RowOf(i) * width, width, this->RowSums.data() + i * width);
  }
}

void MonteCarloOperator::FindComponents(const StageProgress& stage)
{
  const std::size_t n = this->Size();
  SharedSets sets(n);
  ParallelFor(
    this->Share.End - this->Share.Begin, this->Options.Threads, stage,
    [&](std::size_t row) {
      const auto i = static_cast<std::int32_t>(this->Share.Begin + row);
      for (const Round& round : this->Rounds)
      {
        std::int32_t last = -1;
        for (std::size_t k = round.Begin[row]; k < round.Begin[row + 1]; ++k)
        {
          if (round.Hit[k] >= 0 && round.Hit[k] != last)
          {
            last = round.Hit[k];
            sets.Join(i, last);
          }
        }
        for (std::size_t k = round.PartBegin.empty() ? 0 : round.PartBegin[row * Batches];
             !round.PartBegin.empty() && k < round.PartBegin[(row + 1) * Batches]; ++k)
        {
          sets.Join(i, round.PartHit[k]);
        }
      }
    },
    5.0 * RaySeconds * static_cast<double>(this->Total / static_cast<std::int64_t>(n + 1) + 1));
  for (std::size_t i = 0; i < this->Around.size(); ++i)
  {
    sets.Join(static_cast<std::int32_t>(i), static_cast<std::int32_t>(this->RowOf(i)));
  }
  // Over ranks: each knows its own links; the least number known of a set goes round until no rank
  // knows better.
  std::vector<double> least(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    least[i] = -static_cast<double>(sets.Root(static_cast<std::int32_t>(i)));
  }
  for (bool open = this->Options.Ranks != nullptr; open;)
  {
    this->Options.Ranks->Largest(least.data(), n);
    for (std::size_t i = 0; i < n; ++i)
    {
      sets.Join(static_cast<std::int32_t>(i), static_cast<std::int32_t>(-least[i]));
    }
    double better = 0.0;
    for (std::size_t i = 0; i < n; ++i)
    {
      const double now = -static_cast<double>(sets.Root(static_cast<std::int32_t>(i)));
      better = now > least[i] ? 1.0 : better;
      least[i] = now;
    }
    this->Options.Ranks->Largest(&better, 1);
    open = better > 0.0;
  }
  // Numbered from 0 in the order of their first elements, which stand for them.
  this->Component.assign(n, -1);
  std::int32_t next = 0;
  for (std::size_t i = 0; i < n; ++i)
  {
    const auto root = static_cast<std::size_t>(-least[i]);
    this->Component[i] = root == i ? next++ : this->Component[root];
  }
}

void MonteCarloOperator::FindBalance(const StageProgress& stage)
{
  const std::size_t n = this->Size();
  const std::size_t width = this->Width;
  const std::vector<double>& areas = this->Areas();
  std::vector<double> leaks(n, 0.0);
  for (std::size_t row = 0; row < this->Leaks.size(); ++row)
  {
    leaks[this->Share.Begin + row] = this->Leaks[row];
  }
  if (this->Options.Ranks)
  {
    this->Options.Ranks->Gather(leaks.data(), RankShare::Begins(*this->Options.Ranks, n));
  }
  for (std::size_t i = 0; i < this->Around.size(); ++i)
  {
    leaks[i] = leaks[this->RowOf(i)];
  }
  const std::size_t components = n == 0
    ? 0
    : static_cast<std::size_t>(*std::max_element(this->Component.begin(), this->Component.end())) +
      1;
  std::vector<std::uint8_t> closed(components, 1);
  for (std::size_t i = 0; i < n; ++i)
  {
    closed[static_cast<std::size_t>(this->Component[i])] &= leaks[i] == 0.0;
  }
  this->Report = {};
  this->Balance.clear();
  this->ComponentArea.assign(components * width, 0.0);
  if (std::none_of(closed.begin(), closed.end(), [](std::uint8_t c) { return c != 0; }))
  {
    return;
  }
  // a = A alpha, and the sums of its columns as whole numbers of a small share of its total, so that
  // they depend on the order of addition neither among threads nor among ranks.
  std::vector<double> weight(n * width);
  std::vector<double> total(width, 0.0);
  for (std::size_t k = 0; k < weight.size(); ++k)
  {
    const double gain = this->Gain.empty() ? 1.0 : this->Gain[k];
    weight[k] = gain > 0.0 ? areas[k / width] / gain : 0.0;
    total[k % width] += weight[k];
  }
  std::vector<double> rowWeight = weight; // of all elements that take a row
  for (std::size_t i = 0; i < this->Around.size(); ++i)
  {
    for (std::size_t b = 0; b < width && this->RowOf(i) != i; ++b)
    {
      rowWeight[this->RowOf(i) * width + b] += weight[i * width + b];
    }
  }
  constexpr double Unit = 0x1p-62;
  std::vector<std::int64_t> column(n * width, 0);
  {
    const std::unique_ptr<std::atomic<std::int64_t>[]> sums(
      new std::atomic<std::int64_t>[n * width]);
    for (std::size_t k = 0; k < n * width; ++k)
    {
      sums[k].store(0, std::memory_order_relaxed);
    }
    ParallelFor(
      this->Share.End - this->Share.Begin, this->Options.Threads, stage,
      [&](std::size_t row) {
        const std::size_t i = this->Share.Begin + row;
        std::vector<double> each(width);
        std::vector<std::int64_t> whole(width);
        for (std::size_t b = 0; b < width; ++b)
        {
          each[b] = total[b] > 0.0
            ? rowWeight[i * width + b] / (total[b] * Unit * std::max(1, this->RaysOf[i]))
            : 0.0;
          whole[b] = std::llround(each[b]);
        }
        const auto add = [&](std::int32_t hit, const float* share) {
          for (std::size_t b = 0; b < width; ++b)
          {
            const std::int64_t units =
              share ? std::llround(each[b] * static_cast<double>(share[b])) : whole[b];
            sums[static_cast<std::size_t>(hit) * width + b].fetch_add(
              units, std::memory_order_relaxed);
          }
        };
        for (const Round& round : this->Rounds)
        {
          for (std::size_t k = round.Begin[row]; k < round.Begin[row + 1]; ++k)
          {
            if (round.Hit[k] >= 0)
            {
              add(round.Hit[k], nullptr);
            }
          }
          for (std::size_t k = round.PartBegin.empty() ? 0 : round.PartBegin[row * Batches];
               !round.PartBegin.empty() && k < round.PartBegin[(row + 1) * Batches]; ++k)
          {
            add(round.PartHit[k], round.PartWeight.data() + k * width);
          }
        }
      },
      5.0 * RaySeconds * static_cast<double>(this->Total / static_cast<std::int64_t>(n + 1) + 1));
    for (std::size_t k = 0; k < n * width; ++k)
    {
      column[k] = sums[k].load(std::memory_order_relaxed);
    }
  }
  if (this->Options.Ranks)
  {
    this->Options.Ranks->Sum(column.data(), column.size());
  }
  const auto missing = [&](std::size_t k) {
    return weight[k] - static_cast<double>(column[k]) * Unit * total[k % width];
  };
  // Sampling alone makes columns miss by some square root of their hits. Where they miss by more,
  // faces lie on others and share what is sent to them: there is nothing to balance.
  std::vector<double> ray(components * width, 0.0), unlikely(components * width, 0.0);
  std::vector<double> members(components, 0.0);
  for (std::size_t k = 0; k < n * width; ++k)
  {
    auto& greatest = ray[static_cast<std::size_t>(this->Component[k / width]) * width + k % width];
    greatest = std::max(greatest,
      this->OwnRays(k / width) > 0 ? rowWeight[k] / this->RaysOf[k / width] : 0.0);
  }
  for (std::size_t k = 0; k < n * width; ++k)
  {
    const auto c = static_cast<std::size_t>(this->Component[k / width]);
    const std::size_t at = c * width + k % width;
    members[c] += k % width == 0 ? 1.0 : 0.0;
    const double spread = ray[at] * std::max(weight[k], ray[at]);
    unlikely[at] += spread > 0.0 ? missing(k) * missing(k) / spread : 0.0;
  }
  for (std::size_t at = 0; at < unlikely.size(); ++at)
  {
    closed[at / width] &= unlikely[at] <= 2.0 * members[at / width];
  }
  this->Balance.assign(n * width, 0.0);
  for (std::size_t i = 0; i < n; ++i)
  {
    const auto c = static_cast<std::size_t>(this->Component[i]);
    if (!closed[c])
    {
      continue;
    }
    ++this->Report.ClosedRows;
    for (std::size_t b = 0; b < width; ++b)
    {
      const std::size_t k = i * width + b;
      this->ComponentArea[c * width + b] += weight[k];
      this->Balance[k] = missing(k);
      this->Report.ReciprocityDefect = std::max(this->Report.ReciprocityDefect,
        weight[k] > 0.0 ? std::abs(this->Balance[k]) / weight[k] : 0.0);
    }
  }
}

} // namespace radiometry
