// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/DenseOperator.h"

#include "radiometry/formfactor/ClosedElements.h"
#include "radiometry/formfactor/ClosureCorrection.h"
#include "radiometry/formfactor/LinkedSets.h"
#include "radiometry/visibility/PairVisibility.h"
#include "radiometry/formfactor/SymmetricTiles.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/visibility/Convexity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiometry
{
namespace
{

constexpr std::size_t Edge = SymmetricTiles<double>::Edge;
constexpr double MiB = 1024.0 * 1024.0;

/// A pair whose rays disagreed: standard error of S_ij, m^2.
struct MixedPair
{
  std::int32_t I, J;
  float Error;
};

} // namespace

struct DenseOperator::Internals
{
  std::size_t N = 0;
  std::vector<double> Areas;
  bool Double = true;
  SymmetricTiles<double> Fine;
  SymmetricTiles<float> Coarse;
  std::vector<double> Lambda;  // closure correction: S_ij (1 + Lambda_i + Lambda_j); empty: none
  std::vector<double> Cap;     // last resort: S_ij Cap_i Cap_j, none above 1; empty: none
  std::vector<double> RowSums; // of F, corrected
  std::vector<double> TruncationShare; // of a row's exchange
  std::vector<MixedPair> Mixed;
  std::int64_t Pairs = 0, Rays = 0;
  int Threads = 0;
  ClosureReport Report;

  std::size_t Blocks() const { return SymmetricTiles<double>::Blocks(this->N); }

  /// out = S x for the uncorrected S; one right-hand side.
  void Multiply(const double* x, double* out) const
  {
    std::vector<double> padded(this->Blocks() * Edge, 0.0);
    std::copy(x, x + this->N, padded.begin());
    ParallelFor(
      this->Blocks(), this->Threads, {},
      [&](std::size_t block) {
        double sums[Edge] = {};
        this->Double ? this->Fine.MultiplyBlock(block, padded.data(), sums)
                     : this->Coarse.MultiplyBlock(block, padded.data(), sums);
        const std::size_t first = block * Edge;
        std::copy(sums, sums + std::min(Edge, this->N - first), out + first);
      },
      1e-9 * static_cast<double>(this->N * Edge));
  }
  /// out = S x for the corrected S.
  void MultiplyCorrected(const double* x, double* out) const
  {
    if (this->Cap.empty())
    {
      this->MultiplyClosed(x, out);
      return;
    }
    std::vector<double> capped(this->N);
    for (std::size_t i = 0; i < this->N; ++i)
    {
      capped[i] = this->Cap[i] * x[i];
    }
    this->MultiplyClosed(capped.data(), out);
    for (std::size_t i = 0; i < this->N; ++i)
    {
      out[i] *= this->Cap[i];
    }
  }
  /// out = S x with the closure correction.
  void MultiplyClosed(const double* x, double* out) const
  {
    this->Multiply(x, out);
    if (this->Lambda.empty())
    {
      return;
    }
    std::vector<double> scaled(this->N), more(this->N);
    for (std::size_t i = 0; i < this->N; ++i)
    {
      scaled[i] = this->Lambda[i] * x[i];
    }
    this->Multiply(scaled.data(), more.data());
    for (std::size_t i = 0; i < this->N; ++i)
    {
      out[i] = (1.0 + this->Lambda[i]) * out[i] + more[i];
    }
  }
  double At(std::size_t i, std::size_t j) const
  {
    if (i > j)
    {
      std::swap(i, j);
    }
    const std::size_t offset = (i % Edge) * Edge + j % Edge;
    const double s = this->Double ? this->Fine.Tile(i / Edge, j / Edge)[offset]
                                  : this->Coarse.Tile(i / Edge, j / Edge)[offset];
    const double cap = this->Cap.empty() ? 1.0 : this->Cap[i] * this->Cap[j];
    return cap * (this->Lambda.empty() ? s : s * (1.0 + this->Lambda[i] + this->Lambda[j]));
  }

  void Build(const OcclusionScene& occluders, const ElementSet& elements,
    const ExchangeOptions& options, bool occlusion, const StageProgress& stage);
  void Close(const std::vector<std::uint8_t>& closed)
  {
    this->Lambda = LeastClosure([this](const double* x, double* out) { this->Multiply(x, out); },
      this->Areas, closed, this->Report.LargestChange);
  }
  double WorstDefect(const std::vector<std::uint8_t>& closed) const;
};

void DenseOperator::Internals::Build(const OcclusionScene& occluders, const ElementSet& elements,
  const ExchangeOptions& options, bool occlusion, const StageProgress& stage)
{
  const auto& patches = elements.GetPatches();
  std::vector<ExchangePatch> shape;
  shape.reserve(this->N);
  for (const Patch& p : patches)
  {
    shape.emplace_back(p.Corners);
  }
  const double tolerance = std::clamp(0.05 * options.RelativeTolerance, 1e-9, 1e-3);

  struct TileResult
  {
    std::vector<MixedPair> Mixed;
    std::vector<double> Truncation; // of the tile's rows and columns
    std::int64_t Pairs = 0, Rays = 0;
  };
  const std::size_t blocks = this->Blocks();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> tiles;
  for (std::uint32_t i = 0; i < blocks; ++i)
  {
    for (std::uint32_t j = i; j < blocks; ++j)
    {
      tiles.emplace_back(i, j);
    }
  }
  std::vector<TileResult> results(tiles.size());
  ParallelFor(
    tiles.size(), options.Threads, stage,
    [&](std::size_t index) {
      const std::size_t bi = tiles[index].first, bj = tiles[index].second;
      TileResult& result = results[index];
      result.Truncation.assign(2 * Edge, 0.0);
      for (std::size_t r = 0; r < Edge; ++r)
      {
        const std::size_t i = bi * Edge + r;
        for (std::size_t c = bi == bj ? r + 1 : 0; c < Edge; ++c)
        {
          const std::size_t j = bj * Edge + c;
          if (i >= this->N || j >= this->N)
          {
            break;
          }
          if (patches[i].Triangle == patches[j].Triangle)
          {
            continue; // one plane
          }
          const PairExchangeResult pair = PairExchange(shape[i], shape[j], tolerance);
          if (!(pair.Value > 0.0))
          {
            continue;
          }
          ++result.Pairs;
          double value = pair.Value;
          if (occlusion)
          {
            // Even parts: (V error) F <= tolerance sqrt(F)/2 makes a row's error that tolerance.
            const double factor = pair.Value / std::min(shape[i].Area, shape[j].Area);
            const double wanted = 0.5 * options.RelativeTolerance / std::sqrt(factor);
            const double rays = std::clamp(0.125 / (wanted * wanted), 4.0, 64.0);
            const int first = static_cast<int>(std::exp2(std::ceil(std::log2(rays))));
            const std::uint64_t key =
              Hash64(options.Seed, (static_cast<std::uint64_t>(i) << 32) | j);
            const PairVisibilityResult v = PairVisibility(occluders, shape[i], patches[i].Triangle,
              shape[j], patches[j].Triangle, key, first, 4096, wanted);
            result.Rays += v.Rays;
            value *= v.Fraction;
            if (v.Error > 0.0)
            {
              result.Mixed.push_back({ static_cast<std::int32_t>(i), static_cast<std::int32_t>(j),
                static_cast<float>(v.Error * pair.Value) });
            }
          }
          result.Truncation[r] += pair.Error;
          result.Truncation[Edge + c] += pair.Error;
          const auto store = [&](auto* tile) {
            using T = std::remove_reference_t<decltype(*tile)>;
            tile[r * Edge + c] = static_cast<T>(value);
            if (bi == bj)
            {
              tile[c * Edge + r] = static_cast<T>(value);
            }
          };
          this->Double ? store(this->Fine.Tile(bi, bj)) : store(this->Coarse.Tile(bi, bj));
        }
      }
    },
    5e-3);

  this->TruncationShare.assign(this->N, 0.0);
  for (std::size_t index = 0; index < tiles.size(); ++index)
  {
    const TileResult& result = results[index];
    this->Pairs += result.Pairs;
    this->Rays += result.Rays;
    this->Mixed.insert(this->Mixed.end(), result.Mixed.begin(), result.Mixed.end());
    for (std::size_t k = 0; k < 2 * Edge && !result.Truncation.empty(); ++k)
    {
      const std::size_t i =
        k < Edge ? tiles[index].first * Edge + k : tiles[index].second * Edge + k - Edge;
      if (i < this->N)
      {
        this->TruncationShare[i] += result.Truncation[k];
      }
    }
  }
}

double DenseOperator::Internals::WorstDefect(const std::vector<std::uint8_t>& closed) const
{
  double worst = 0.0;
  for (std::size_t i = 0; i < this->N; ++i)
  {
    if (closed[i])
    {
      worst = std::max(worst, std::abs(1.0 - this->RowSums[i]));
    }
  }
  return worst;
}

std::size_t DenseOperator::LeastBytes(std::size_t n)
{
  // The matrix, the pairs found partly visible (some tenth), and rows.
  return SymmetricTiles<float>::Bytes(n) + n * n / 20 * sizeof(MixedPair) + n * 64 * 8;
}

DenseOperator::DenseOperator(const Scene& scene, const OcclusionScene& occluders,
  const ElementSet& elements, const ExchangeOptions& options, const StageProgress& stage)
  : Impl(new Internals)
{
  Internals& m = *this->Impl;
  m.N = elements.Size();
  m.Areas = elements.GetAreas();
  m.Threads = options.Threads;
  const std::size_t least = LeastBytes(m.N);
  if (options.MemoryLimit && least > options.MemoryLimit)
  {
    throw InputError("MemoryLimit", -1, static_cast<double>(options.MemoryLimit) / MiB,
      "at least " +
        std::to_string(static_cast<long long>(std::ceil(static_cast<double>(least) / MiB))) +
        " MiB for all pairs of " + std::to_string(m.N) + " elements");
  }
  const std::size_t wide = least + SymmetricTiles<float>::Bytes(m.N);
  m.Double = (!options.MemoryLimit || wide <= options.MemoryLimit) &&
    (m.N <= 4096 || options.RelativeTolerance < 1e-4);
  m.Double ? m.Fine.Resize(m.N) : m.Coarse.Resize(m.N);

  const bool occlusion = options.Occlusion && FindConvexity(scene) == Convexity::General;
  const auto part = [&](double from, double to) {
    StageProgress p = stage;
    p.Begin = stage.Begin + from * (stage.End - stage.Begin);
    p.End = stage.Begin + to * (stage.End - stage.Begin);
    return p;
  };
  m.Build(occluders, elements, options, occlusion, part(0.0, 0.95));

  const std::vector<double> one(m.N, 1.0);
  m.RowSums.resize(m.N);
  const auto sumRows = [&] {
    m.MultiplyCorrected(one.data(), m.RowSums.data());
    for (std::size_t i = 0; i < m.N; ++i)
    {
      m.RowSums[i] /= m.Areas[i];
    }
  };
  sumRows();
  for (std::size_t i = 0; i < m.N; ++i)
  {
    const double exchange = m.RowSums[i] * m.Areas[i];
    m.TruncationShare[i] =
      (exchange > 0.0 ? m.TruncationShare[i] / exchange : 0.0) + (m.Double ? 1e-15 : 6e-8);
  }
  if (options.Occlusion)
  {
    std::vector<std::uint8_t> closed =
      FindClosedElements(occluders, elements, options, part(0.95, 1.0));
    // A row that misses more than its own error explains sees an opening the probes did not.
    std::vector<double> error(m.N), none(m.N);
    this->ApplyError(one.data(), none.data(), error.data(), 1);
    for (std::size_t i = 0; i < m.N; ++i)
    {
      const double explained = 5.0 * error[i] + m.TruncationShare[i];
      closed[i] = closed[i] && std::abs(1.0 - m.RowSums[i]) <= explained;
      m.Report.ClosedRows += closed[i];
    }
    m.Report.DefectBefore = m.WorstDefect(closed);
    // Nothing sees more than a whole hemisphere: rows above one are brought to one as well.
    std::vector<std::uint8_t> fixed = closed;
    for (int round = 0; round < 4; ++round)
    {
      bool any = round == 0 && m.Report.ClosedRows;
      for (std::size_t i = 0; i < m.N; ++i)
      {
        if (!fixed[i] && m.RowSums[i] > 1.0 + 1e-14)
        {
          fixed[i] = 1;
          any = true;
        }
      }
      if (!any)
      {
        break;
      }
      m.Close(fixed);
      sumRows();
    }
    m.Report.DefectAfter = m.WorstDefect(closed);
  }
  // Where faces lie in one another (duplicates, say) what is seen is counted more than once, and no
  // small change mends that. Rows are then scaled down: the exchange must not make light.
  const double worst = *std::max_element(m.RowSums.begin(), m.RowSums.end());
  if (worst > 1.0 + 1e-12)
  {
    m.Cap.resize(m.N);
    for (std::size_t i = 0; i < m.N; ++i)
    {
      m.Cap[i] = 1.0 / std::max(1.0, m.RowSums[i]);
    }
    sumRows();
  }
}

DenseOperator::~DenseOperator() = default;

std::size_t DenseOperator::Size() const { return this->Impl->N; }
const std::vector<double>& DenseOperator::Areas() const { return this->Impl->Areas; }

void DenseOperator::Apply(const double* B, double* out, int bands) const
{
  const Internals& m = *this->Impl;
  const auto nb = static_cast<std::size_t>(bands);
  std::vector<double> x(m.N), y(m.N);
  for (std::size_t b = 0; b < nb; ++b)
  {
    for (std::size_t i = 0; i < m.N; ++i)
    {
      x[i] = B[i * nb + b];
    }
    m.MultiplyCorrected(x.data(), y.data());
    for (std::size_t i = 0; i < m.N; ++i)
    {
      out[i * nb + b] = y[i] / m.Areas[i];
    }
  }
}

double DenseOperator::RowSum(std::size_t i, int) const { return this->Impl->RowSums[i]; }

void DenseOperator::ApplyError(
  const double* B, double* formFactor, double* visibility, int bands) const
{
  const Internals& m = *this->Impl;
  const auto nb = static_cast<std::size_t>(bands);
  std::vector<double> magnitude(m.N * nb);
  for (std::size_t k = 0; k < magnitude.size(); ++k)
  {
    magnitude[k] = std::abs(B[k]);
    visibility[k] = 0.0;
  }
  this->Apply(magnitude.data(), formFactor, bands);
  for (std::size_t k = 0; k < magnitude.size(); ++k)
  {
    formFactor[k] *= m.TruncationShare[k / nb];
  }
  for (const MixedPair& pair : m.Mixed)
  {
    const auto i = static_cast<std::size_t>(pair.I);
    const auto j = static_cast<std::size_t>(pair.J);
    for (std::size_t b = 0; b < nb; ++b)
    {
      const double atI = pair.Error * B[j * nb + b] / m.Areas[i];
      const double atJ = pair.Error * B[i * nb + b] / m.Areas[j];
      visibility[i * nb + b] += atI * atI;
      visibility[j * nb + b] += atJ * atJ;
    }
  }
  for (std::size_t k = 0; k < magnitude.size(); ++k)
  {
    visibility[k] = std::sqrt(visibility[k]);
  }
}

std::vector<std::int32_t> DenseOperator::Components() const
{
  const Internals& m = *this->Impl;
  LinkedSets sets(m.N);
  for (std::size_t bi = 0; bi < m.Blocks(); ++bi)
  {
    for (std::size_t bj = bi; bj < m.Blocks(); ++bj)
    {
      for (std::size_t k = 0; k < Edge * Edge; ++k)
      {
        const bool linked =
          m.Double ? m.Fine.Tile(bi, bj)[k] > 0.0 : m.Coarse.Tile(bi, bj)[k] > 0.0f;
        if (linked)
        {
          sets.Join(static_cast<std::int32_t>(bi * Edge + k / Edge),
            static_cast<std::int32_t>(bj * Edge + k % Edge));
        }
      }
    }
  }
  std::vector<std::int32_t> number(m.N, -1), label(m.N);
  std::int32_t next = 0;
  for (std::size_t i = 0; i < m.N; ++i)
  {
    auto& n = number[static_cast<std::size_t>(sets.Root(static_cast<std::int32_t>(i)))];
    if (n < 0)
    {
      n = next++;
    }
    label[i] = n;
  }
  return label;
}

std::size_t DenseOperator::MemoryBytes() const
{
  const Internals& m = *this->Impl;
  return (m.Double ? SymmetricTiles<double>::Bytes(m.N) : SymmetricTiles<float>::Bytes(m.N)) +
    m.Mixed.size() * sizeof(MixedPair) + 4 * m.N * sizeof(double);
}
std::int64_t DenseOperator::Samples() const { return this->Impl->Pairs + this->Impl->Rays; }
ClosureReport DenseOperator::Closure() const { return this->Impl->Report; }
std::string DenseOperator::Description() const
{
  const Internals& m = *this->Impl;
  return "dense, " + std::to_string(m.N) + " elements, " + std::to_string(m.Pairs) +
    " exchanging pairs, " + std::to_string(m.Rays) + " rays, " + (m.Double ? "double" : "single") +
    " precision";
}
double DenseOperator::Exchange(std::size_t i, std::size_t j) const { return this->Impl->At(i, j); }

} // namespace radiometry
