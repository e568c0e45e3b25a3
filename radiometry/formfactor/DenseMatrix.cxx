// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/DenseMatrix.h"

#include "radiometry/formfactor/LinkedSets.h"
#include "radiometry/scene/Collective.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr std::size_t TileArea = ElementBlocks::Edge * ElementBlocks::Edge;
// Tiles computed at once before their bounds are summed.
constexpr std::size_t Batch = 4096;

/// An error as one byte: steps of a quarter octave below the greatest exchange that two areas allow.
std::uint8_t Encode(double error, double scale)
{
  if (!(error > 0.0))
  {
    return 0;
  }
  const double steps = 4.0 * std::log2(scale / error);
  return static_cast<std::uint8_t>(std::clamp(std::lround(steps), 0l, 254l) + 1);
}
/// What each byte stands for, squared and relative to the two areas' product.
const std::array<double, 256>& Decoded()
{
  static const std::array<double, 256> table = [] {
    std::array<double, 256> t{};
    for (int code = 1; code < 256; ++code)
    {
      t[static_cast<std::size_t>(code)] = std::exp2(-0.5 * (code - 1));
    }
    return t;
  }();
  return table;
}

} // namespace

DenseMatrix::DenseMatrix(std::vector<std::int32_t> order, const std::vector<double>& areas,
  bool wide, int threads, const Communicator* ranks)
  : N(order.size())
  , Order(std::move(order))
  , Places(this->N)
  , Roots(SymmetricTiles<double>::Blocks(this->N) * Edge, 0.0)
  , Double(wide)
  , Threads(threads)
  , Ranks(ranks && ranks->Size() > 1 ? ranks : nullptr)
{
  for (std::size_t k = 0; k < this->N; ++k)
  {
    const auto element = static_cast<std::size_t>(this->Order[k]);
    this->Places[element] = static_cast<std::int32_t>(k);
    this->Roots[k] = std::sqrt(areas[element]);
  }
  this->Double ? this->Fine.Resize(this->N) : this->Coarse.Resize(this->N);
  this->Errors.Resize(this->N);
}

void DenseMatrix::Build(
  const TileExchange& exchange, const StageProgress& stage, std::vector<double>& truncation)
{
  const std::size_t blocks = SymmetricTiles<double>::Blocks(this->N);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> tiles;
  std::size_t index = 0;
  for (std::uint32_t i = 0; i < blocks; ++i)
  {
    for (std::uint32_t j = i; j < blocks; ++j, ++index)
    {
      if (this->Own(index))
      {
        tiles.emplace_back(i, j);
      }
    }
  }
  truncation.assign(this->N, 0.0);
  Collectively(this->Ranks, [&] {
    for (std::size_t begin = 0; begin < tiles.size(); begin += Batch)
    {
      const std::size_t count = std::min(Batch, tiles.size() - begin);
      std::vector<TileResult> results(count);
      StageProgress part = stage;
      const double length = (stage.End - stage.Begin) / static_cast<double>(tiles.size());
      part.Begin = stage.Begin + length * static_cast<double>(begin);
      part.End = part.Begin + length * static_cast<double>(count);
      ParallelFor(
        count, this->Threads, part,
        [&](std::size_t k) {
          thread_local std::vector<double> values;
          values.assign(TileArea, 0.0);
          const auto [i, j] = tiles[begin + k];
          exchange(i, j, values.data(), results[k]);
          this->Keep(i, j, values.data(), results[k]);
          results[k].Sampled = {};
        },
        1e-3);
      for (std::size_t k = 0; k < count; ++k)
      {
        this->PairCount += results[k].Pairs;
        this->RayCount += results[k].Rays;
        this->Rough.insert(
          this->Rough.end(), results[k].Rough.begin(), results[k].Rough.end());
        for (std::size_t l = 0; l < 2 * Edge; ++l)
        {
          const std::size_t place = l < Edge ? tiles[begin + k].first * Edge + l
                                             : tiles[begin + k].second * Edge + l - Edge;
          if (place < this->N)
          {
            truncation[static_cast<std::size_t>(this->Order[place])] += results[k].Truncation[l];
          }
        }
      }
    }
  });
  if (this->Ranks)
  {
    std::int64_t counts[2] = { this->PairCount, this->RayCount };
    this->Ranks->Sum(counts, 2);
    this->PairCount = counts[0];
    this->RayCount = counts[1];
    this->Ranks->Sum(truncation.data(), this->N);
  }
}

void DenseMatrix::Keep(
  std::size_t i, std::size_t j, const double* values, const TileResult& result)
{
  if (std::any_of(values, values + TileArea, [](double v) { return v != 0.0; }))
  {
    if (this->Double)
    {
      std::copy(values, values + TileArea, this->Fine.Make(i, j));
    }
    else
    {
      std::transform(values, values + TileArea, this->Coarse.Make(i, j),
        [](double v) { return static_cast<float>(v); });
    }
  }
  if (result.Sampled.empty())
  {
    return;
  }
  std::uint8_t* errors = this->Errors.Make(i, j);
  std::fill(errors, errors + TileArea, std::uint8_t(0));
  for (const SampledPair& pair : result.Sampled)
  {
    const auto p = static_cast<std::size_t>(pair.I), q = static_cast<std::size_t>(pair.J);
    const std::uint8_t code = Encode(pair.Error, this->Roots[p] * this->Roots[q]);
    errors[p % Edge * Edge + q % Edge] = code;
    if (i == j)
    {
      errors[q % Edge * Edge + p % Edge] = code;
    }
  }
}

template <int W>
void DenseMatrix::MultiplyBy(const double* x, double* out) const
{
  const std::size_t blocks = SymmetricTiles<double>::Blocks(this->N);
  const std::size_t stride = blocks * Edge;
  std::vector<double> padded(stride * W, 0.0);
  for (std::size_t w = 0; w < W; ++w)
  {
    for (std::size_t k = 0; k < this->N; ++k)
    {
      padded[w * stride + k] = x[w * this->N + static_cast<std::size_t>(this->Order[k])];
    }
  }
  ParallelFor(
    blocks, this->Threads, {},
    [&](std::size_t block) {
      double sums[W * Edge] = {};
      this->Double ? this->Fine.MultiplyBlock<W>(block, padded.data(), stride, sums)
                   : this->Coarse.MultiplyBlock<W>(block, padded.data(), stride, sums);
      const std::size_t first = block * Edge;
      for (std::size_t r = 0; r < std::min(Edge, this->N - first); ++r)
      {
        for (std::size_t w = 0; w < W; ++w)
        {
          out[w * this->N + static_cast<std::size_t>(this->Order[first + r])] = sums[w * Edge + r];
        }
      }
    },
    1e-9 * static_cast<double>(this->N * Edge));
}

void DenseMatrix::Multiply(const double* x, double* out, int count) const
{
  for (int done = 0; done < count; done += 4)
  {
    const double* from = x + static_cast<std::size_t>(done) * this->N;
    double* to = out + static_cast<std::size_t>(done) * this->N;
    switch (std::min(4, count - done))
    {
      case 1:
        this->MultiplyBy<1>(from, to);
        break;
      case 2:
        this->MultiplyBy<2>(from, to);
        break;
      case 3:
        this->MultiplyBy<3>(from, to);
        break;
      default:
        this->MultiplyBy<4>(from, to);
    }
  }
  if (this->Ranks)
  {
    this->Ranks->Sum(out, static_cast<std::size_t>(count) * this->N);
  }
}

double DenseMatrix::Value(std::size_t bi, std::size_t bj, std::size_t k) const
{
  if (this->Double)
  {
    const double* tile = this->Fine.Tile(bi, bj);
    return tile ? tile[k] : 0.0;
  }
  const float* tile = this->Coarse.Tile(bi, bj);
  return tile ? static_cast<double>(tile[k]) : 0.0;
}

void DenseMatrix::AddVariance(const double* x, double* squares) const
{
  const std::size_t blocks = SymmetricTiles<double>::Blocks(this->N);
  std::vector<double> own(this->N, 0.0);
  const auto& decoded = Decoded();
  const auto element = [&](std::size_t place) {
    return static_cast<std::size_t>(this->Order[place]);
  };
  // Each row by itself: sums in one order for any threads.
  ParallelFor(
    blocks, this->Threads, {},
    [&](std::size_t block) {
      for (std::size_t other = 0; other < blocks; ++other)
      {
        const bool turned = other < block;
        const std::uint8_t* codes =
          turned ? this->Errors.Tile(other, block) : this->Errors.Tile(block, other);
        for (std::size_t k = 0; codes && k < TileArea; ++k)
        {
          const std::size_t i = block * Edge + (turned ? k % Edge : k / Edge);
          const std::size_t j = other * Edge + (turned ? k / Edge : k % Edge);
          if (codes[k])
          {
            const double share = this->Roots[i] * this->Roots[j] * x[element(j)];
            own[element(i)] += decoded[codes[k]] * share * share;
          }
        }
      }
    },
    1e-9 * static_cast<double>(this->N * Edge));
  for (const SampledBlock& rough : this->Rough)
  {
    // One error for all of a row's share of it.
    const auto add = [&](std::int32_t row, std::int32_t rows, std::int32_t column,
                       std::int32_t columns, bool turned) {
      for (std::int32_t r = row; r < row + rows; ++r)
      {
        double sum = 0.0;
        for (std::int32_t c = column; c < column + columns; ++c)
        {
          const auto i = static_cast<std::size_t>(turned ? c : r);
          const auto j = static_cast<std::size_t>(turned ? r : c);
          sum += this->Value(i / Edge, j / Edge, i % Edge * Edge + j % Edge) *
            std::abs(x[element(static_cast<std::size_t>(c))]);
        }
        own[element(static_cast<std::size_t>(r))] +=
          static_cast<double>(rough.Relative) * rough.Relative * sum * sum;
      }
    };
    add(rough.I, rough.Rows, rough.J, rough.Columns, false);
    add(rough.J, rough.Columns, rough.I, rough.Rows, true);
  }
  if (this->Ranks)
  {
    this->Ranks->Sum(own.data(), this->N);
  }
  for (std::size_t i = 0; i < this->N; ++i)
  {
    squares[i] += own[i];
  }
}

double DenseMatrix::At(std::size_t i, std::size_t j) const
{
  auto p = static_cast<std::size_t>(this->Places[i]);
  auto q = static_cast<std::size_t>(this->Places[j]);
  if (p > q)
  {
    std::swap(p, q);
  }
  return this->Value(p / Edge, q / Edge, p % Edge * Edge + q % Edge);
}

std::vector<std::int32_t> DenseMatrix::Components(
  const std::vector<std::pair<std::int32_t, std::int32_t>>& further) const
{
  const std::size_t blocks = SymmetricTiles<double>::Blocks(this->N);
  LinkedSets sets(this->N);
  for (const auto& link : further)
  {
    sets.Join(link.first, link.second);
  }
  for (std::size_t bi = 0; bi < blocks; ++bi)
  {
    for (std::size_t bj = bi; bj < blocks; ++bj)
    {
      if (!(this->Double ? this->Fine.Tile(bi, bj) != nullptr
                         : this->Coarse.Tile(bi, bj) != nullptr))
      {
        continue;
      }
      for (std::size_t k = 0; k < TileArea; ++k)
      {
        if (this->Value(bi, bj, k) > 0.0)
        {
          sets.Join(this->Order[bi * Edge + k / Edge], this->Order[bj * Edge + k % Edge]);
        }
      }
    }
  }
  // Over ranks: until all know the least element of each set.
  std::vector<double> least(this->N);
  for (double changed = this->Ranks ? 1.0 : 0.0; changed > 0.0;)
  {
    for (std::size_t i = 0; i < this->N; ++i)
    {
      least[i] = -static_cast<double>(sets.Root(static_cast<std::int32_t>(i)));
    }
    this->Ranks->Largest(least.data(), this->N);
    changed = 0.0;
    for (std::size_t i = 0; i < this->N; ++i)
    {
      const auto own = static_cast<std::int32_t>(i), other = static_cast<std::int32_t>(-least[i]);
      changed = sets.Root(own) != sets.Root(other) ? 1.0 : changed;
      sets.Join(own, other);
    }
    this->Ranks->Largest(&changed, 1);
  }
  std::vector<std::int32_t> number(this->N, -1), label(this->N);
  std::int32_t next = 0;
  for (std::size_t i = 0; i < this->N; ++i)
  {
    auto& n = number[static_cast<std::size_t>(sets.Root(static_cast<std::int32_t>(i)))];
    n = n < 0 ? next++ : n;
    label[i] = n;
  }
  return label;
}

std::size_t DenseMatrix::MemoryBytes() const
{
  return (this->Double ? this->Fine.MemoryBytes() : this->Coarse.MemoryBytes()) +
    this->Errors.MemoryBytes() + this->Rough.size() * sizeof(SampledBlock) +
    this->N * (2 * sizeof(std::int32_t) + sizeof(double));
}

void DenseMatrix::Save(ArchiveWriter& out) const
{
  out.Put(static_cast<std::int32_t>(this->Ranks ? this->Ranks->Rank() : 0));
  out.Put(static_cast<std::int32_t>(this->Ranks ? this->Ranks->Size() : 1));
  out.Put(this->Order);
  out.Put(this->Places);
  out.Put(this->Roots);
  out.Put(static_cast<std::uint8_t>(this->Double));
  this->Double ? this->Fine.Save(out) : this->Coarse.Save(out);
  this->Errors.Save(out);
  out.Put(this->Rough);
  out.Put(this->PairCount);
  out.Put(this->RayCount);
}

void DenseMatrix::Load(ArchiveReader& in, int threads, const Communicator* ranks)
{
  this->Threads = threads;
  this->Ranks = ranks && ranks->Size() > 1 ? ranks : nullptr;
  const auto rank = in.Get<std::int32_t>();
  const auto size = in.Get<std::int32_t>();
  if (rank != (this->Ranks ? this->Ranks->Rank() : 0) ||
    size != (this->Ranks ? this->Ranks->Size() : 1))
  {
    throw std::runtime_error("was saved by another number of ranks");
  }
  in.Get(this->Order);
  in.Get(this->Places);
  in.Get(this->Roots);
  this->N = this->Order.size();
  const auto valid = [&](const std::vector<std::int32_t>& values) {
    return values.size() == this->N &&
      std::all_of(values.begin(), values.end(),
        [&](std::int32_t v) { return v >= 0 && static_cast<std::size_t>(v) < this->N; });
  };
  if (!valid(this->Order) || !valid(this->Places) ||
    this->Roots.size() != SymmetricTiles<double>::Blocks(this->N) * Edge)
  {
    throw std::runtime_error("is damaged: the order of the elements");
  }
  this->Double = in.Get<std::uint8_t>() != 0;
  this->Double ? this->Fine.Load(in, this->N) : this->Coarse.Load(in, this->N);
  this->Errors.Load(in, this->N);
  in.Get(this->Rough);
  const auto inside = [&](std::int32_t first, std::int32_t count) {
    return first >= 0 && count >= 0 &&
      static_cast<std::size_t>(first) + static_cast<std::size_t>(count) <= this->N;
  };
  for (const SampledBlock& b : this->Rough)
  {
    if (!inside(b.I, b.Rows) || !inside(b.J, b.Columns))
    {
      throw std::runtime_error("is damaged: a block outside the matrix");
    }
  }
  this->PairCount = in.Get<std::int64_t>();
  this->RayCount = in.Get<std::int64_t>();
}

} // namespace radiometry
