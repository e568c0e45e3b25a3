// SPDX-License-Identifier: BSD-3-Clause
// The rays of MonteCarloOperator: traced block by block of neighbouring elements, in packets of
// rays that run in much the same direction.
#include "radiometry/formfactor/MonteCarloOperator.h"

#include "radiometry/formfactor/PathFollower.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/Collective.h"
#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace radiometry
{
namespace
{

constexpr double MiB = 1024.0 * 1024.0;
constexpr std::size_t BlockElements = 16; // a block has the same rays for any share of the ranks
constexpr std::size_t BundleRays = 2048;  // sorted by direction together
constexpr std::size_t DirectionCells = 256;

/// One of 16 x 16 cells of the sphere, neighbours mostly with near numbers: the octahedral map, its
/// bits interleaved.
std::size_t DirectionCell(const Vec3& d)
{
  const double scale = 1.0 / (std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z));
  double u = d.x * scale, v = d.y * scale;
  if (d.z < 0.0)
  {
    const double turned = (1.0 - std::fabs(v)) * (u < 0.0 ? -1.0 : 1.0);
    v = (1.0 - std::fabs(u)) * (v < 0.0 ? -1.0 : 1.0);
    u = turned;
  }
  const auto cell = [](double x) {
    return static_cast<std::size_t>(std::clamp(8.0 * (x + 1.0), 0.0, 15.0));
  };
  const auto spread = [](std::size_t x) {
    x = (x | (x << 2)) & 0x33;
    return (x | (x << 1)) & 0x55;
  };
  return spread(cell(u)) | (spread(cell(v)) << 1);
}

/// Rays that are traced together.
struct Bundle
{
  struct Ray
  {
    std::int32_t Row; // of this rank; below 0: not kept
    std::uint8_t Batch;
    std::uint32_t Index; // in the batch's sequence
    std::size_t Slot;
    std::uint64_t Key;
  };
  std::vector<RayEnd> From;
  std::vector<Vec3> Directions;
  std::vector<Ray> Rays;

  // In the order of tracing.
  std::vector<RayEnd> SortedFrom;
  std::vector<Vec3> SortedDirections;
  std::vector<std::uint32_t> Order;
  std::vector<SurfaceHit> Hits;

  void Add(const RayEnd& from, const Vec3& direction, const Ray& ray)
  {
    this->From.push_back(from);
    this->Directions.push_back(direction);
    this->Rays.push_back(ray);
  }
  void Clear()
  {
    this->From.clear();
    this->Directions.clear();
    this->Rays.clear();
  }
  void Trace(const OcclusionScene& occluders)
  {
    const std::size_t n = this->Rays.size();
    std::array<std::uint32_t, DirectionCells + 1> begin{};
    std::vector<std::uint8_t> cell(n);
    for (std::size_t k = 0; k < n; ++k)
    {
      cell[k] = static_cast<std::uint8_t>(DirectionCell(this->Directions[k]));
      ++begin[cell[k] + std::size_t(1)];
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    this->Order.resize(n);
    this->SortedFrom.resize(n);
    this->SortedDirections.resize(n);
    this->Hits.resize(n);
    for (std::size_t k = 0; k < n; ++k)
    {
      const std::uint32_t to = begin[cell[k]]++;
      this->Order[to] = static_cast<std::uint32_t>(k);
      this->SortedFrom[to] = this->From[k];
      this->SortedDirections[to] = this->Directions[k];
    }
    occluders.Closest(this->SortedFrom.data(), this->SortedDirections.data(), n, this->Hits.data());
  }
};

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

void MonteCarloOperator::Trace(const std::vector<std::int32_t>& rays, const StageProgress& stage)
{
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
  Collectively(this->Options.Ranks, [&] {
    if (this->Options.Paths && blocks > 0)
    {
      this->TraceBlock(firstBlock, rays, round, traced[0]);
      this->CheckTraced();
    }
    const std::size_t done = this->Options.Paths && blocks > 0 ? 1 : 0;
    ParallelFor(
      blocks - done, this->Options.Threads, part,
      [&](
        std::size_t k) { this->TraceBlock(firstBlock + k + done, rays, round, traced[k + done]); },
      5e-7 * BlockElements * std::max(1, most));
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
  this->Summarise(part);
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
  Bundle bundle;
  std::vector<double> weight(this->Width), counted(this->Width);

  const auto finish = [&] {
    bundle.Trace(*this->Occluders);
    for (std::size_t k = 0; k < bundle.Order.size(); ++k)
    {
      const Bundle::Ray& ray = bundle.Rays[bundle.Order[k]];
      if (ray.Row < 0)
      {
        continue;
      }
      const SurfaceHit& hit = bundle.Hits[k];
      const auto row = static_cast<std::size_t>(ray.Row);
      std::int32_t& slot = round.Hit[ray.Slot];
      if (!paths || !paths->GoesOn(hit))
      {
        slot = this->Elements->Find(hit.Triangle, hit.Front, hit.U, hit.V);
        this->Leaks[row] |= slot < 0;
        continue;
      }
      slot = Round::None;
      std::fill(weight.begin(), weight.end(), 1.0);
      const auto count = [&](std::int32_t element, const double* w) {
        if (slot == Round::None &&
          std::all_of(w, w + this->Width, [](double v) { return v > 1.0 - 1e-9; }))
        {
          slot = element;
          return;
        }
        traced.Parts.push_back(
          { ray.Row, ray.Batch, element, static_cast<std::uint32_t>(traced.Weights.size()) });
        traced.Weights.insert(traced.Weights.end(), w, w + this->Width);
      };
      const PathOutcome outcome =
        FollowPath(*this->Occluders, *this->Elements, *paths, hit, bundle.SortedDirections[k],
          Hash64(ray.Key, 0x70617468ull), ray.Index, weight.data(), counted.data(), count);
      this->Leaks[row] |= outcome.Leaks;
      this->CutOf[row] += outcome.Cut;
    }
    bundle.Clear();
  };

  for (int batch = 0; batch < Batches; ++batch)
  {
    for (std::size_t i = begin; i < end; ++i)
    {
      if (rays[i] == 0)
      {
        continue;
      }
      const Patch& patch = this->Elements->GetPatches()[i];
      const Vec3 normal = Normalized(AreaNormal2(patch.Corners));
      const auto first = static_cast<std::uint32_t>(this->RaysOf[i] / Batches);
      const auto count = static_cast<std::uint32_t>(rays[i] / Batches);
      const bool own = this->Share.Has(i);
      const std::size_t row = own ? i - this->Share.Begin : 0;
      const std::size_t slot = own ? round.Begin[row] + static_cast<std::size_t>(batch) * count : 0;
      const std::uint64_t key =
        Hash64(Hash64(this->Options.Seed, i), static_cast<std::uint64_t>(batch));
      const SobolSequence sequence(key);
      for (std::uint32_t k = 0; k < count; ++k)
      {
        const auto u = sequence(first + k);
        bundle.Add({ TrianglePoint(patch.Corners, u[0], u[1]), patch.Triangle },
          CosineDirection(normal, u[2], u[3]),
          { own ? static_cast<std::int32_t>(row) : -1, static_cast<std::uint8_t>(batch), first + k,
            slot + k, key });
        if (bundle.Rays.size() == BundleRays)
        {
          finish();
        }
      }
    }
  }
  if (!bundle.Rays.empty())
  {
    finish();
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
