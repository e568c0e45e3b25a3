// SPDX-License-Identifier: BSD-3-Clause
// The rays of MonteCarloOperator, traced block by block of neighbouring elements.
#include "radiometry/formfactor/MonteCarloOperator.h"

#include "radiometry/formfactor/PathFollower.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/Collective.h"
#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <tuple>

namespace radiometry
{
namespace
{

constexpr double MiB = 1024.0 * 1024.0;
constexpr std::size_t BlockElements = 16;

/// A step that goes round all of n, far from one to the next.
std::size_t Stride(std::size_t n)
{
  std::size_t step = std::max<std::size_t>(1, static_cast<std::size_t>(0.618 * static_cast<double>(n)));
  while (n > 1 && std::gcd(step, n) != 1)
  {
    ++step;
  }
  return step;
}

} // namespace

/// Counts of paths whose bands differ, of a block's elements.
struct MonteCarloOperator::TracedBlock
{
  struct Part
  {
    std::int32_t Row;
    std::int32_t Batch;
    std::int32_t Hit;
    std::uint32_t At; // of its weights
  };
  std::vector<Part> Parts;
  std::vector<float> Weights;
};

void MonteCarloOperator::CheckMemory(const std::vector<std::int32_t>& rays) const
{
  if (!this->Options.MemoryLimit)
  {
    return;
  }
  std::vector<std::size_t> begin{ 0, rays.size() };
  if (this->Options.Ranks)
  {
    begin = RankShare::Begins(*this->Options.Ranks, rays.size());
  }
  std::size_t most = 0;
  for (std::size_t r = 0; r + 1 < begin.size(); ++r)
  {
    std::size_t bytes = 0;
    for (std::size_t i = begin[r]; i < begin[r + 1]; ++i)
    {
      bytes += static_cast<std::size_t>(rays[i]) * sizeof(std::int32_t) + sizeof(std::size_t);
    }
    most = std::max(most, bytes);
  }
  const std::size_t bytes = this->MemoryBytes() + most;
  if (bytes > this->Options.MemoryLimit)
  {
    throw InputError("MemoryLimit", -1, static_cast<double>(this->Options.MemoryLimit) / MiB,
      "at least " +
        std::to_string(static_cast<long long>(std::ceil(static_cast<double>(bytes) / MiB))) +
        " MiB for the rays of " + std::to_string(this->Size()) + " elements");
  }
}

void MonteCarloOperator::Trace(const std::vector<std::int32_t>& wanted, const StageProgress& stage)
{
  std::vector<std::int32_t> rays = wanted;
  this->CheckMemory(rays);
  Round round;
  round.Begin.assign(1, 0);
  for (std::size_t i = this->Share.Begin; i < this->Share.End; ++i)
  {
    round.Begin.push_back(round.Begin.back() + static_cast<std::size_t>(rays[i]));
  }
  round.Hit.resize(round.Begin.back());
  const std::size_t firstBlock = this->Share.Begin / BlockElements;
  const std::size_t blocks = this->Share.End > this->Share.Begin
    ? (this->Share.End + BlockElements - 1) / BlockElements - firstBlock
    : 0;
  std::vector<TracedBlock> traced(blocks);
  const std::int32_t most = rays.empty() ? 1 : *std::max_element(rays.begin(), rays.end());
  StageProgress part = stage;
  part.End = stage.Begin + 0.9 * (stage.End - stage.Begin);
  this->Occluders->PrepareRays(this->Options.Threads);
  const auto start = std::chrono::steady_clock::now();
  Collectively(this->Options.Ranks, [&] {
    if (this->Options.Paths && blocks > 0)
    {
      this->TraceBlock(firstBlock, rays, round, traced[0]);
      this->CheckTraced();
    }
    const std::size_t done = this->Options.Paths && blocks > 0 ? 1 : 0;
    const bool timed = this->Options.SecondsLeft > 0.0 && !this->Options.Ranks;
    // Where time may end it, blocks are taken from all over the scene, so that what is left out lies
    // between others.
    const std::size_t step = timed ? Stride(blocks - done) : 1;
    std::vector<std::uint8_t> late(blocks, 0);
    ParallelFor(
      blocks - done, this->Options.Threads, part,
      [&](std::size_t k) {
        const std::size_t at = k * step % (blocks - done) + done;
        if (timed && k > 0 &&
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() >
            this->Options.SecondsLeft)
        {
          late[at] = 1;
          return;
        }
        this->TraceBlock(firstBlock + at, rays, round, traced[at]);
      },
      5e-7 * BlockElements * std::max(1, most));
    this->LeaveOut(late, rays, round);
    if (this->Width > 1)
    {
      Assemble(traced, this->Share.End - this->Share.Begin, this->Width, round);
    }
  });
  this->Rounds.push_back(std::move(round));
  std::size_t bytes = 0;
  for (const Round& r : this->Rounds)
  {
    bytes += r.Bytes();
  }
  auto largest = static_cast<double>(bytes);
  this->TotalCut = std::accumulate(this->CutOf.begin(), this->CutOf.end(), std::int64_t(0));
  if (this->Options.Ranks)
  {
    this->Options.Ranks->Largest(&largest, 1);
    this->Options.Ranks->Sum(&this->TotalCut, 1);
  }
  this->OwnBytes = static_cast<std::size_t>(largest);
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    this->RaysOf[i] += rays[i];
    this->Total += rays[i];
  }
  part.Begin = part.End;
  part.End = stage.End;
  this->FindRows();
  this->Summarise(part);
}

/// What came too late has no rays in this round.
void MonteCarloOperator::LeaveOut(
  const std::vector<std::uint8_t>& late, std::vector<std::int32_t>& rays, Round& round) const
{
  if (std::none_of(late.begin(), late.end(), [](std::uint8_t l) { return l != 0; }))
  {
    return;
  }
  std::size_t kept = 0;
  for (std::size_t row = 0; row + 1 < round.Begin.size(); ++row)
  {
    const std::size_t i = this->Share.Begin + row;
    const std::size_t from = round.Begin[row], to = from + static_cast<std::size_t>(rays[i]);
    round.Begin[row] = kept;
    if (late[i / BlockElements - this->Share.Begin / BlockElements])
    {
      rays[i] = 0;
      continue;
    }
    std::copy(round.Hit.begin() + static_cast<std::ptrdiff_t>(from),
      round.Hit.begin() + static_cast<std::ptrdiff_t>(to),
      round.Hit.begin() + static_cast<std::ptrdiff_t>(kept));
    kept += to - from;
  }
  round.Begin.back() = kept;
  round.Hit.resize(kept);
}

void MonteCarloOperator::FindRows()
{
  const std::size_t n = this->Size();
  this->Around.clear();
  if (std::all_of(this->RaysOf.begin(), this->RaysOf.end(), [](std::int32_t r) { return r > 0; }))
  {
    return;
  }
  this->Around.assign(n, { -1, -1 });
  for (std::size_t side = 0; side < 2; ++side)
  {
    std::int32_t last = -1;
    for (std::size_t k = 0; k < n; ++k)
    {
      const std::size_t i = side == 0 ? k : n - 1 - k;
      last = this->RaysOf[i] > 0 ? static_cast<std::int32_t>(i) : last;
      this->Around[i][side] = last;
    }
  }
  for (auto& around : this->Around)
  {
    around[0] = around[0] < 0 ? around[1] : around[0];
    around[1] = around[1] < 0 ? around[0] : around[1];
  }
}

std::size_t MonteCarloOperator::Nearest(std::size_t element) const
{
  const auto before = static_cast<std::size_t>(this->Around[element][0]);
  const auto behind = static_cast<std::size_t>(this->Around[element][1]);
  const auto distance = [element](std::size_t i) {
    return i > element ? i - element : element - i;
  };
  return distance(behind) < distance(before) ? behind : before;
}

void MonteCarloOperator::CheckTraced() const
{
  // The first elements of a rank: where nearly all their paths are caught, so will be most.
  std::int64_t cut = 0, counted = 0;
  for (std::size_t row = 0; row < std::min(BlockElements, this->CutOf.size()); ++row)
  {
    cut += this->CutOf[row];
    counted += this->Leaks[row] ? 1 : 0;
  }
  if (counted == 0 && cut > 0 && 2 * cut > static_cast<std::int64_t>(BlockElements) * Batches)
  {
    const Patch& p = this->Elements->GetPatches()[this->Share.Begin];
    throw InputError("SpecularReflectance", p.Cell,
      this->Options.Paths->Reflectance(p.Triangle, p.Side == 0, 0),
      "less than 1 somewhere around: light between these mirrors is caught for ever (more than " +
        std::to_string(MostBounces) + " reflections)");
  }
}

void MonteCarloOperator::TraceBlock(
  std::size_t block, const std::vector<std::int32_t>& rays, Round& round, TracedBlock& traced)
{
  const std::size_t begin = block * BlockElements;
  const std::size_t end = std::min(begin + BlockElements, rays.size());
  const SpecularSurfaces* paths = this->Options.Paths.get();
  std::vector<double> weight(this->Width), counted(this->Width);
  for (std::size_t i = std::max(begin, this->Share.Begin); i < std::min(end, this->Share.End); ++i)
  {
    if (rays[i] == 0)
    {
      continue;
    }
    const Patch& patch = this->Elements->GetPatches()[i];
    const Vec3 normal = Normalized(AreaNormal2(patch.Corners));
    Vec3 s, t;
    Frame(normal, s, t);
    const auto first = static_cast<std::uint32_t>(this->RaysOf[i] / Batches);
    const auto count = static_cast<std::uint32_t>(rays[i] / Batches);
    const std::size_t row = i - this->Share.Begin;
    std::int32_t* slot = round.Hit.data() + round.Begin[row];
    for (int batch = 0; batch < Batches; ++batch)
    {
      const std::uint64_t key =
        Hash64(Hash64(this->Options.Seed, i), static_cast<std::uint64_t>(batch));
      const SobolSequence sequence(key);
      for (std::uint32_t k = first; k < first + count; ++k, ++slot)
      {
        const auto u = sequence(k);
        const Vec3 direction = CosineDirection(normal, s, t, u[2], u[3]);
        const SurfaceHit hit = this->Occluders->Closest(
          { TrianglePoint(patch.Corners, u[0], u[1]), patch.Triangle }, direction);
        if (!paths || !paths->GoesOn(hit))
        {
          *slot = this->Elements->Find(hit.Triangle, hit.Front, hit.U, hit.V);
          this->Leaks[row] |= *slot < 0;
          continue;
        }
        *slot = Round::None;
        std::fill(weight.begin(), weight.end(), 1.0);
        const auto met = [&](std::int32_t element, const double* w) {
          if (*slot == Round::None &&
            std::all_of(w, w + this->Width, [](double v) { return v > 1.0 - 1e-9; }))
          {
            *slot = element;
            return;
          }
          traced.Parts.push_back({ static_cast<std::int32_t>(row), batch, element,
            static_cast<std::uint32_t>(traced.Weights.size()) });
          traced.Weights.insert(traced.Weights.end(), w, w + this->Width);
        };
        const PathOutcome outcome = FollowPath(*this->Occluders, *this->Elements, *paths, hit,
          direction, Hash64(key, 0x70617468ull), k, weight.data(), counted.data(), met);
        this->Leaks[row] |= outcome.Leaks;
        this->CutOf[row] += outcome.Cut;
      }
    }
  }
}

/// Puts the parts of all blocks in order, those of one batch on one element together.
void MonteCarloOperator::Assemble(
  std::vector<TracedBlock>& blocks, std::size_t rows, std::size_t width, Round& round)
{
  bool any = false;
  for (TracedBlock& block : blocks)
  {
    any = any || !block.Parts.empty();
    std::stable_sort(block.Parts.begin(), block.Parts.end(), [](const auto& a, const auto& b) {
      return std::tie(a.Row, a.Batch, a.Hit) < std::tie(b.Row, b.Batch, b.Hit);
    });
  }
  if (!any)
  {
    return;
  }
  round.PartBegin.reserve(rows * Batches + 1);
  round.PartBegin.assign(1, 0);
  for (TracedBlock& block : blocks)
  {
    for (std::size_t k = 0; k < block.Parts.size(); ++k)
    {
      const TracedBlock::Part& part = block.Parts[k];
      const auto batch = static_cast<std::size_t>(part.Row * Batches + part.Batch);
      const bool same = k > 0 && block.Parts[k - 1].Row == part.Row &&
        block.Parts[k - 1].Batch == part.Batch && block.Parts[k - 1].Hit == part.Hit;
      if (!same)
      {
        round.PartBegin.resize(batch + 1, round.PartHit.size());
        round.PartHit.push_back(part.Hit);
        round.PartWeight.resize(round.PartWeight.size() + width, 0.0f);
      }
      float* sum = round.PartWeight.data() + round.PartWeight.size() - width;
      for (std::size_t b = 0; b < width; ++b)
      {
        sum[b] += block.Weights[part.At + b];
      }
    }
    block = {};
  }
  round.PartBegin.resize(rows * Batches + 1, round.PartHit.size());
}

} // namespace radiometry
