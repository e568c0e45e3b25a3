// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/DenseOperator.h"

#include "radiometry/formfactor/ClosedElements.h"
#include "radiometry/formfactor/ClosureCorrection.h"
#include "radiometry/formfactor/CoveredElements.h"
#include "radiometry/formfactor/DenseMatrix.h"
#include "radiometry/scene/Collective.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/visibility/Convexity.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double MiB = 1024.0 * 1024.0;

StageProgress Part(const StageProgress& stage, double from, double to)
{
  StageProgress part = stage;
  part.Begin = stage.Begin + from * (stage.End - stage.Begin);
  part.End = stage.Begin + to * (stage.End - stage.Begin);
  return part;
}

} // namespace

struct DenseOperator::Internals
{
  std::size_t N = 0;
  std::vector<double> Areas;
  DenseMatrix Matrix;
  CoveredElements Covered;
  std::vector<double> Lambda;  // closure correction: S_ij (1 + Lambda_i + Lambda_j); empty: none
  std::vector<double> Cap;     // last resort: S_ij Cap_i Cap_j, none above 1; empty: none
  std::vector<double> RowSums; // of S/A, corrected: before covered elements receive from above
  std::vector<double> AllRowSums;      // of F
  std::vector<double> TruncationShare; // of a row's exchange
  ClosureReport Report;

  /// out = S x for what is not covered; `count` right-hand sides one after the other.
  void MultiplyUncovered(const double* x, double* out, int count = 1) const
  {
    if (this->Covered.Empty())
    {
      this->Matrix.Multiply(x, out, count);
      return;
    }
    const auto all = this->N * static_cast<std::size_t>(count);
    std::vector<double> seen(x, x + all);
    for (std::size_t k = 0; k < all; ++k)
    {
      seen[k] *= this->Covered.Uncovered(k % this->N);
    }
    this->Matrix.Multiply(seen.data(), out, count);
    for (std::size_t k = 0; k < all; ++k)
    {
      out[k] *= this->Covered.Uncovered(k % this->N);
    }
  }
  /// The same for the corrected S.
  void Multiply(const double* x, double* out, int count = 1) const
  {
    const auto all = this->N * static_cast<std::size_t>(count);
    const auto scale = [&](const std::vector<double>& by, const double* from) {
      std::vector<double> scaled(all);
      for (std::size_t k = 0; k < all; ++k)
      {
        scaled[k] = by[k % this->N] * from[k];
      }
      return scaled;
    };
    std::vector<double> capped;
    if (!this->Cap.empty())
    {
      capped = scale(this->Cap, x);
      x = capped.data();
    }
    if (this->Lambda.empty())
    {
      this->MultiplyUncovered(x, out, count);
    }
    else
    {
      // Both products in one pass over the matrix.
      std::vector<double> both = scale(this->Lambda, x), product(2 * all);
      both.insert(both.end(), x, x + all);
      this->MultiplyUncovered(both.data(), product.data(), 2 * count);
      for (std::size_t k = 0; k < all; ++k)
      {
        out[k] = (1.0 + this->Lambda[k % this->N]) * product[all + k] + product[k];
      }
    }
    for (std::size_t k = 0; k < all && !this->Cap.empty(); ++k)
    {
      out[k] *= this->Cap[k % this->N];
    }
  }
  void SumRows()
  {
    const std::vector<double> one(this->N, 1.0);
    this->RowSums.resize(this->N);
    this->Multiply(one.data(), this->RowSums.data());
    for (std::size_t i = 0; i < this->N; ++i)
    {
      this->RowSums[i] /= this->Areas[i];
    }
  }
  /// What a row that sees nothing but elements lacks to its whole.
  double Missing(std::size_t i) const
  {
    return this->Covered.Uncovered(i) - this->RowSums[i];
  }
  double WorstDefect(const std::vector<std::uint8_t>& closed) const
  {
    double worst = 0.0;
    for (std::size_t i = 0; i < this->N; ++i)
    {
      worst = closed[i] ? std::max(worst, std::abs(this->Missing(i))) : worst;
    }
    return worst;
  }
  void Close(std::vector<std::uint8_t> closed, const std::vector<double>& error);
  void CapRows();
};

/// Rows that seem closed, and miss no more than their error explains, are made to sum to one.
void DenseOperator::Internals::Close(
  std::vector<std::uint8_t> closed, const std::vector<double>& error)
{
  for (std::size_t i = 0; i < this->N; ++i)
  {
    // A row that misses more than its own error explains sees an opening the probes did not.
    const double explained = 5.0 * error[i] + this->TruncationShare[i];
    closed[i] = closed[i] && this->Covered.Uncovered(i) > 0.0 &&
      std::abs(this->Missing(i)) <= explained;
    this->Report.ClosedRows += closed[i];
  }
  this->Report.DefectBefore = this->WorstDefect(closed);
  // Nothing sees more than a whole hemisphere: rows above one are brought to one as well.
  std::vector<std::uint8_t> fixed = closed;
  for (int round = 0; round < 4; ++round)
  {
    bool any = round == 0 && this->Report.ClosedRows;
    for (std::size_t i = 0; i < this->N; ++i)
    {
      if (!fixed[i] && this->Missing(i) < -1e-14)
      {
        fixed[i] = 1;
        any = true;
      }
    }
    if (!any)
    {
      break;
    }
    std::vector<double> seen = this->Areas;
    for (std::size_t i = 0; i < this->N; ++i)
    {
      seen[i] *= this->Covered.Uncovered(i);
    }
    this->Lambda =
      LeastClosure([this](const double* x, double* out) { this->MultiplyUncovered(x, out); }, seen,
        fixed, this->Report.LargestChange);
    this->SumRows();
  }
  this->Report.DefectAfter = this->WorstDefect(closed);
}

/// Where faces lie in one another what is seen may be counted more than once, and no small change
/// mends that. Rows are then scaled down: the exchange must not make light.
void DenseOperator::Internals::CapRows()
{
  bool any = false;
  for (std::size_t i = 0; i < this->N; ++i)
  {
    any = any || this->Missing(i) < -1e-12;
  }
  if (any)
  {
    this->Cap.resize(this->N);
    for (std::size_t i = 0; i < this->N; ++i)
    {
      const double whole = this->Covered.Uncovered(i);
      this->Cap[i] = this->RowSums[i] > whole ? whole / this->RowSums[i] : 1.0;
    }
    const std::vector<double> before = this->RowSums;
    this->SumRows();
    // What was taken away may have been right.
    for (std::size_t i = 0; i < this->N; ++i)
    {
      this->TruncationShare[i] +=
        this->RowSums[i] > 0.0 ? std::max(0.0, before[i] / this->RowSums[i] - 1.0) : 0.0;
    }
  }
}

std::size_t DenseOperator::LeastBytes(std::size_t n, int ranks)
{
  // The matrix and the errors of its sampled pairs; elements in their order, while it is built.
  const std::size_t tiles =
    SymmetricTiles<float>::Bytes(n) + SymmetricTiles<std::uint8_t>::Bytes(n);
  return tiles / static_cast<std::size_t>(ranks) + n * 1024;
}

DenseOperator::DenseOperator()
  : Impl(new Internals)
{
}

DenseOperator::DenseOperator(const Scene& scene, const OcclusionScene& occluders,
  const ElementSet& elements, const ExchangeOptions& options, const StageProgress& stage)
  : Impl(new Internals)
{
  const auto start = std::chrono::steady_clock::now();
  Internals& m = *this->Impl;
  m.N = elements.Size();
  m.Areas = elements.GetAreas();
  // The least of the ranks' limits decides for all.
  double limit = options.MemoryLimit ? static_cast<double>(options.MemoryLimit) : 1e300;
  if (options.Ranks)
  {
    limit = -limit;
    options.Ranks->Largest(&limit, 1);
    limit = -limit;
  }
  const auto least =
    static_cast<double>(LeastBytes(m.N, options.Ranks ? options.Ranks->Size() : 1));
  if (least > limit)
  {
    throw InputError("MemoryLimit", -1, limit / MiB,
      "at least " + std::to_string(static_cast<long long>(std::ceil(least / MiB))) +
        " MiB for all pairs of " + std::to_string(m.N) + " elements");
  }
  // As for one rank: the digits must not depend on their number.
  const double wide =
    static_cast<double>(LeastBytes(m.N) + SymmetricTiles<float>::Bytes(m.N));
  const bool inDouble =
    wide <= limit && (m.N <= 4096 || options.RelativeTolerance < 1e-4);

  std::vector<double> truncation;
  {
    std::unique_ptr<PatchBlockers> blockers;
    std::unique_ptr<ElementBlocks> blocks;
    Collectively(options.Ranks, [&] {
      if (options.Occlusion && FindConvexity(scene) == Convexity::General)
      {
        blockers = std::make_unique<PatchBlockers>(scene);
      }
      blocks = std::make_unique<ElementBlocks>(elements.GetPatches(), blockers.get());
      m.Covered = CoveredElements(elements.GetPatches(), options.Threads);
    });
    m.Matrix = DenseMatrix(blocks->Order(), m.Areas, inDouble, options.Threads, options.Ranks);
    ExchangeOptions timed = options;
    if (options.SecondsLeft > 0.0)
    {
      // Closing the rows takes what is kept back.
      const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - start;
      timed.SecondsLeft = std::max(1e-6, 0.85 * options.SecondsLeft - gone.count());
    }
    m.Matrix.Build(TileExchange(*blocks, *blocks, occluders, blockers.get(), timed),
      Part(stage, 0.0, 0.95), truncation);
  }
  m.SumRows();
  m.TruncationShare.resize(m.N);
  for (std::size_t i = 0; i < m.N; ++i)
  {
    const double exchange = m.RowSums[i] * m.Areas[i];
    // What is left of a covered element need not see the same as all of it.
    const double left = m.Covered.Uncovered(i);
    m.TruncationShare[i] = (exchange > 0.0 ? truncation[i] * left / exchange : 0.0) +
      (inDouble ? 1e-15 : 6e-8) + 0.25 * (left > 0.0 ? 1.0 - left : 0.0);
  }
  if (m.N > 0 && options.Occlusion)
  {
    const std::vector<double> one(m.N, 1.0);
    std::vector<double> error(m.N), none(m.N);
    this->ApplyError(one.data(), none.data(), error.data(), 1);
    m.Close(FindClosedElements(occluders, elements, options, Part(stage, 0.95, 1.0)), error);
  }
  m.CapRows();
  m.AllRowSums = m.RowSums;
  m.Covered.Receive(m.AllRowSums.data(), 1);
}

DenseOperator::~DenseOperator() = default;

std::size_t DenseOperator::Size() const { return this->Impl->N; }
const std::vector<double>& DenseOperator::Areas() const { return this->Impl->Areas; }

void DenseOperator::Apply(const double* B, double* out, int bands) const
{
  const Internals& m = *this->Impl;
  const auto nb = static_cast<std::size_t>(bands);
  std::vector<double> x(m.N * nb), y(m.N * nb);
  for (std::size_t i = 0; i < m.N; ++i)
  {
    for (std::size_t b = 0; b < nb; ++b)
    {
      x[b * m.N + i] = B[i * nb + b];
    }
  }
  m.Multiply(x.data(), y.data(), bands);
  for (std::size_t i = 0; i < m.N; ++i)
  {
    for (std::size_t b = 0; b < nb; ++b)
    {
      out[i * nb + b] = y[b * m.N + i] / m.Areas[i];
    }
  }
  m.Covered.Receive(out, bands);
}

double DenseOperator::RowSum(std::size_t i, int) const { return this->Impl->AllRowSums[i]; }

void DenseOperator::ApplyError(
  const double* B, double* formFactor, double* visibility, int bands) const
{
  const Internals& m = *this->Impl;
  const auto nb = static_cast<std::size_t>(bands);
  std::vector<double> magnitude(m.N * nb), exchange(m.N * nb);
  for (std::size_t i = 0; i < m.N; ++i)
  {
    for (std::size_t b = 0; b < nb; ++b)
    {
      magnitude[b * m.N + i] = std::abs(B[i * nb + b]) * m.Covered.Uncovered(i);
    }
  }
  m.Matrix.Multiply(magnitude.data(), exchange.data(), bands);
  std::vector<double> squares(m.N);
  for (std::size_t b = 0; b < nb; ++b)
  {
    std::fill(squares.begin(), squares.end(), 0.0);
    m.Matrix.AddVariance(magnitude.data() + b * m.N, squares.data());
    for (std::size_t i = 0; i < m.N; ++i)
    {
      const double share = m.Covered.Uncovered(i) / m.Areas[i];
      formFactor[i * nb + b] = exchange[b * m.N + i] * share * m.TruncationShare[i];
      visibility[i * nb + b] = std::sqrt(squares[i]) * share;
    }
  }
  m.Covered.Receive(formFactor, bands);
  m.Covered.Receive(visibility, bands);
}

std::vector<std::int32_t> DenseOperator::Components() const
{
  std::vector<std::pair<std::int32_t, std::int32_t>> further;
  for (const CoveredElements::Cover& cover : this->Impl->Covered.All())
  {
    further.emplace_back(cover.Element, cover.Top);
  }
  return this->Impl->Matrix.Components(further);
}

std::size_t DenseOperator::MemoryBytes() const
{
  return this->Impl->Matrix.MemoryBytes() + this->Impl->Covered.MemoryBytes() +
    6 * this->Impl->N * sizeof(double);
}
std::int64_t DenseOperator::Samples() const
{
  return this->Impl->Matrix.Pairs() + this->Impl->Matrix.Rays();
}
ClosureReport DenseOperator::Closure() const { return this->Impl->Report; }
std::string DenseOperator::Description() const
{
  const Internals& m = *this->Impl;
  return "dense, " + std::to_string(m.N) + " elements, " + std::to_string(m.Matrix.Pairs()) +
    " exchanging pairs, " + std::to_string(m.Matrix.Rays()) + " segments asked, " +
    (m.Matrix.Wide() ? "double" : "single") + " precision";
}
double DenseOperator::Exchange(std::size_t i, std::size_t j) const
{
  const Internals& m = *this->Impl;
  const double cap = (m.Cap.empty() ? 1.0 : m.Cap[i] * m.Cap[j]) * m.Covered.Uncovered(i) *
    m.Covered.Uncovered(j);
  const double change = m.Lambda.empty() ? 1.0 : 1.0 + m.Lambda[i] + m.Lambda[j];
  return cap * change * m.Matrix.At(i, j);
}

void DenseOperator::Save(ArchiveWriter& out) const
{
  const Internals& m = *this->Impl;
  out.Put(m.Areas);
  m.Matrix.Save(out);
  m.Covered.Save(out);
  out.Put(m.Lambda);
  out.Put(m.Cap);
  out.Put(m.RowSums);
  out.Put(m.AllRowSums);
  out.Put(m.TruncationShare);
  out.Put(m.Report);
}

std::unique_ptr<DenseOperator> DenseOperator::Load(
  ArchiveReader& in, int threads, const Communicator* ranks)
{
  std::unique_ptr<DenseOperator> loaded(new DenseOperator());
  Internals& m = *loaded->Impl;
  in.Get(m.Areas);
  m.N = m.Areas.size();
  m.Matrix.Load(in, threads, ranks);
  m.Covered.Load(in, m.N);
  in.Get(m.Lambda);
  in.Get(m.Cap);
  in.Get(m.RowSums);
  in.Get(m.AllRowSums);
  in.Get(m.TruncationShare);
  m.Report = in.Get<ClosureReport>();
  const auto fits = [&](const std::vector<double>& v, bool mayBeEmpty) {
    return v.size() == m.N || (mayBeEmpty && v.empty());
  };
  if (m.Matrix.Size() != m.N || !fits(m.Lambda, true) || !fits(m.Cap, true) ||
    !fits(m.RowSums, false) || !fits(m.AllRowSums, false) || !fits(m.TruncationShare, false))
  {
    throw std::runtime_error("is damaged: rows are missing");
  }
  return loaded;
}

} // namespace radiometry
