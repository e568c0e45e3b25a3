// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/HierarchicalOperator.h"

#include "radiometry/formfactor/ClusterLinks.h"
#include "radiometry/formfactor/ClusterNetwork.h"
#include "radiometry/formfactor/ClusterProbes.h"
#include "radiometry/formfactor/ConjugateGradients.h"
#include "radiometry/formfactor/CoveredElements.h"
#include "radiometry/irradiance/ClosedSurfaces.h"
#include "radiometry/scene/Collective.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/visibility/Convexity.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace radiometry
{
namespace
{

constexpr double MiB = 1024.0 * 1024.0;
// Links that leave in much the same direction miss alike: their errors grow together. Found from
// elements against all pairs (HierarchicalAgreementTest).
constexpr double Alike = 1.8;

StageProgress Part(StageProgress stage, double from, double to)
{
  const double length = stage.End - stage.Begin;
  stage.End = stage.Begin + to * length;
  stage.Begin += from * length;
  return stage;
}

std::string Mebibytes(double bytes)
{
  return std::to_string(static_cast<long long>(std::ceil(bytes / MiB))) + " MiB";
}

} // namespace

struct HierarchicalOperator::Internals
{
  std::size_t N = 0;
  std::vector<double> Areas;
  ClusterNetwork Network;
  CoveredElements Covered;
  std::vector<double> Scale;        // d of each element
  std::vector<double> Own;          // of closed rows that could not be scaled to one: what is missing,
                                    // taken from the element itself; empty: none
  std::vector<double> RowSums;      // of F, corrected: before covered elements receive from above
  std::vector<double> AllRowSums;   // of F
  std::vector<std::uint8_t> Closed; // rows brought to one
  double Loosened = 1.0;            // factor on the tolerance, for the memory limit
  ClosureReport Report;

  void Multiply(const double* B, double* out, int bands) const
  {
    this->Network.Multiply(this->Scale, B, out, bands);
    const auto nb = static_cast<std::size_t>(bands);
    for (std::size_t k = 0; k < this->Own.size() * nb; ++k)
    {
      out[k] += this->Own[k / nb] * B[k];
    }
  }
  void SumRows()
  {
    const std::vector<double> one(this->N, 1.0);
    this->Network.Multiply(this->Scale, one.data(), this->RowSums.data(), 1);
  }

  void Build(const OcclusionScene& occluders, const PatchBlockers* blockers,
    const ElementSet& elements, const std::vector<std::uint8_t>& covered,
    const ExchangeOptions& options, double open, double limit, const StageProgress& stage);
  std::vector<double> ScaleStep(const std::vector<std::uint8_t>& fixed, double goal) const;
  /// `fixed`: 1 for rows to be brought to one; becomes 2 for rows that were let go.
  void Close(std::vector<std::uint8_t>& fixed);
  void CloseRows(std::vector<std::uint8_t> closed);
  double WorstDefect(const std::vector<std::uint8_t>& closed) const;
  /// What a row that sees nothing but elements lacks to its whole.
  double Missing(std::size_t i) const { return this->Covered.Uncovered(i) - this->RowSums[i]; }
  void LetGo(std::size_t i)
  {
    const double whole = this->Covered.Uncovered(i);
    this->Scale[i] =
      this->RowSums[i] > 0.0 ? std::min(whole, this->Scale[i] * whole / this->RowSums[i]) : whole;
  }
};

void HierarchicalOperator::Internals::Build(const OcclusionScene& occluders,
  const PatchBlockers* blockers, const ElementSet& elements,
  const std::vector<std::uint8_t>& covered, const ExchangeOptions& options, double open,
  double limit, const StageProgress& stage)
{
  const auto start = std::chrono::steady_clock::now();
  const auto base = static_cast<double>(this->N * ClusterNetwork::BytesOfElement);
  const double room = std::max(0.0, (limit - base) / ClusterNetwork::BytesOfLink);
  const std::size_t most =
    room < 1e15 ? static_cast<std::size_t>(room) : std::numeric_limits<std::size_t>::max();
  double seconds = 0.0;
  const auto refiner = [&](double loosened) {
    return ClusterRefiner(
      this->Network.GetTree(), elements, occluders, blockers, options, loosened, covered);
  };
  const double coarsest = 64.0 / options.RelativeTolerance;
  for (this->Loosened = 1.0; room > 0.0; this->Loosened = std::min(coarsest, 3.0 * this->Loosened))
  {
    if (options.SecondsLeft > 0.0)
    {
      // A part is kept back for closing the rows.
      const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - start;
      seconds = std::max(1e-6, 0.7 * options.SecondsLeft - gone.count());
    }
    const double hasty = std::max(4.0 * this->Loosened, 0.3 / options.RelativeTolerance);
    if (this->Network.Link(refiner(this->Loosened * open), refiner(hasty), seconds, most, stage))
    {
      return;
    }
    if (this->Loosened >= coarsest)
    {
      break;
    }
  }
  const auto links = static_cast<double>(this->Network.Count(refiner(coarsest * open), stage));
  throw InputError("MemoryLimit", -1, limit / MiB,
    "at least " + Mebibytes(base + (links + 2.0) * ClusterNetwork::BytesOfLink) +
      " for the coarsest links of " + std::to_string(this->N) + " elements");
}

/// One step of Newton's method on d_i (S d)_i = A_i over the fixed rows: relative changes of d by
/// conjugate gradients, until the squared residual is below `goal` of its first value.
std::vector<double> HierarchicalOperator::Internals::ScaleStep(
  const std::vector<std::uint8_t>& fixed, double goal) const
{
  std::vector<double> diagonal(this->N, 0.0), right(this->N, 0.0);
  for (std::size_t i = 0; i < this->N; ++i)
  {
    diagonal[i] = fixed[i] == 1 ? this->RowSums[i] * this->Areas[i] : 0.0;
    right[i] = fixed[i] == 1 ? this->Areas[i] * this->Missing(i) : 0.0;
  }
  const auto product = [&](const std::vector<double>& p, std::vector<double>& out) {
    this->Network.Multiply(this->Scale, p.data(), out.data(), 1);
    for (std::size_t i = 0; i < this->N; ++i)
    {
      out[i] = fixed[i] == 1 ? this->Areas[i] * (out[i] + this->RowSums[i] * p[i]) : 0.0;
    }
  };
  return ConjugateGradients(product, diagonal, std::move(right), goal, 12);
}

/// Scales S by d on both sides so that the fixed rows sum to one. Rows that only a large change
/// would mend are let go: they are not what they seem.
void HierarchicalOperator::Internals::Close(std::vector<std::uint8_t>& fixed)
{
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 24; ++step)
  {
    this->SumRows();
    const double worst = this->WorstDefect(fixed);
    if (worst < 4e-15 || (worst < 1e-12 && worst > 0.5 * last))
    {
      return;
    }
    bool gone = false;
    for (std::size_t i = 0; i < this->N && step > 4 && worst > 0.3 * last; ++i)
    {
      // What does not come nearer: elements that see little but each other, say.
      if (fixed[i] == 1 && std::abs(this->Missing(i)) > 0.3 * worst)
      {
        fixed[i] = 2;
        this->LetGo(i);
        gone = true;
      }
    }
    last = worst;
    if (gone)
    {
      continue;
    }
    const std::vector<double> x = this->ScaleStep(fixed, 1e-4);
    for (std::size_t i = 0; i < this->N; ++i)
    {
      const double next = this->Scale[i] * (1.0 + x[i]) / this->Covered.Uncovered(i);
      if (fixed[i] == 1 && !(next > 0.8 && next < 1.25))
      {
        fixed[i] = 2;
        this->LetGo(i);
        gone = true;
      }
    }
    for (std::size_t i = 0; i < this->N && !gone; ++i)
    {
      this->Scale[i] *= 1.0 + x[i];
    }
  }
  this->SumRows();
}

double HierarchicalOperator::Internals::WorstDefect(const std::vector<std::uint8_t>& closed) const
{
  double worst = 0.0;
  for (std::size_t i = 0; i < this->N; ++i)
  {
    worst = std::max(worst, closed[i] == 1 ? std::abs(this->Missing(i)) : 0.0);
  }
  return worst;
}

void HierarchicalOperator::Internals::CloseRows(std::vector<std::uint8_t> closed)
{
  for (const std::uint8_t c : closed)
  {
    this->Report.ClosedRows += c;
  }
  this->Report.DefectBefore = this->WorstDefect(closed);
  const std::vector<std::uint8_t> closedAtFirst = closed;
  bool own = false;
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
    this->Close(fixed);
  }
  this->Report.ClosedRows = 0;
  for (std::size_t i = 0; i < this->N; ++i)
  {
    closed[i] = closed[i] && fixed[i] == 1;
    this->Report.ClosedRows += closed[i];
  }
  this->Report.DefectAfter = this->WorstDefect(closed);
  for (std::size_t i = 0; i < this->N; ++i)
  {
    this->Report.LargestChange = std::max(
      this->Report.LargestChange, 2.0 * std::abs(this->Scale[i] - this->Covered.Uncovered(i)));
    own = own || (closedAtFirst[i] && fixed[i] == 2);
    this->Closed[i] = fixed[i] == 1 && std::abs(1.0 - this->RowSums[i]) < 1e-9;
  }
  // What is seen more than once all the same: the exchange must not make light.
  bool above = false;
  for (std::size_t i = 0; i < this->N; ++i)
  {
    if (this->Missing(i) < -1e-12)
    {
      this->Scale[i] *= this->Covered.Uncovered(i) / this->RowSums[i];
      above = true;
    }
  }
  if (above)
  {
    this->SumRows();
  }
  // Closed rows that were let go must not lose light: in a white cavity it would be missed most.
  this->Own.assign(own ? this->N : 0, 0.0);
  for (std::size_t i = 0; i < this->Own.size(); ++i)
  {
    if (closedAtFirst[i] && fixed[i] == 2)
    {
      this->Own[i] = std::max(0.0, this->Missing(i));
      this->RowSums[i] += this->Own[i];
    }
  }
}

std::size_t HierarchicalOperator::LeastBytes(std::size_t n, int ranks)
{
  return n * ClusterNetwork::BytesOfElement +
    8 * n / static_cast<std::size_t>(ranks) * ClusterNetwork::BytesOfLink;
}

HierarchicalOperator::HierarchicalOperator()
  : Impl(new Internals)
{
}

HierarchicalOperator::HierarchicalOperator(const Scene& scene, const OcclusionScene& occluders,
  const ElementSet& elements, const ExchangeOptions& options, const StageProgress& stage)
  : Impl(new Internals)
{
  Internals& m = *this->Impl;
  m.N = elements.Size();
  m.Areas = elements.GetAreas();
  // The least of the ranks' limits decides for all.
  double limit = options.MemoryLimit ? -static_cast<double>(options.MemoryLimit) : -1e300;
  if (options.Ranks)
  {
    options.Ranks->Largest(&limit, 1);
  }
  limit = -limit;
  m.Scale.assign(m.N, 1.0);
  m.RowSums.assign(m.N, 0.0);
  m.Closed.assign(m.N, 0);
  if (m.N == 0)
  {
    return;
  }
  std::unique_ptr<ClusterProbes> probes;
  if (options.Occlusion)
  {
    probes = std::make_unique<ClusterProbes>(occluders, elements, options, Part(stage, 0.0, 0.05));
  }
  std::vector<std::uint8_t> covered;
  std::unique_ptr<PatchBlockers> blockers;
  Collectively(options.Ranks, [&] {
    if (options.Occlusion && FindConvexity(scene) == Convexity::General)
    {
      covered = probes->Covered;
      blockers = std::make_unique<PatchBlockers>(scene);
    }
    m.Covered = CoveredElements(elements.GetPatches(), options.Threads);
    m.Network = ClusterNetwork(ElementTree(elements, covered), options.Threads, options.Ranks);
  });
  // Errors of many links add by squares: what is wanted of rows that receive little is finer.
  const double open = probes ? std::sqrt(std::max(0.04, probes->Share)) : 1.0;
  m.Build(
    occluders, blockers.get(), elements, covered, options, open, limit, Part(stage, 0.05, 0.95));
  for (std::size_t i = 0; i < m.N; ++i)
  {
    m.Scale[i] = m.Covered.Uncovered(i);
  }
  m.SumRows();
  if (options.Occlusion)
  {
    std::vector<std::uint8_t> closed = probes->Closed(m.Network.GetTree());
    const ClosedSurfaces shells(scene);
    const std::vector<double> one(m.N, 1.0);
    std::vector<double> form(m.N), sight(m.N);
    this->ApplyError(one.data(), form.data(), sight.data(), 1);
    for (std::size_t i = 0; i < m.N; ++i)
    {
      // A row that misses more than its own error explains sees an opening the probes did not, unless
      // it looks into a closed surface.
      closed[i] = closed[i] && m.Covered.Uncovered(i) > 0.0 &&
        (std::abs(m.Missing(i)) <= 5.0 * (form[i] + sight[i]) + 1e-7 ||
          shells.Encloses(elements.GetPatches()[i]));
    }
    m.CloseRows(std::move(closed));
  }
  m.AllRowSums = m.RowSums;
  m.Covered.Receive(m.AllRowSums.data(), 1);
}

HierarchicalOperator::~HierarchicalOperator() = default;

std::size_t HierarchicalOperator::Size() const { return this->Impl->N; }
const std::vector<double>& HierarchicalOperator::Areas() const { return this->Impl->Areas; }
double HierarchicalOperator::RowSum(std::size_t i, int) const { return this->Impl->AllRowSums[i]; }
std::size_t HierarchicalOperator::Links() const
{
  return static_cast<std::size_t>(this->Impl->Network.Links());
}

void HierarchicalOperator::Apply(const double* B, double* out, int bands) const
{
  this->Impl->Multiply(B, out, bands);
  this->Impl->Covered.Receive(out, bands);
}

void HierarchicalOperator::ApplyError(
  const double* B, double* formFactor, double* visibility, int bands) const
{
  const Internals& m = *this->Impl;
  const auto nb = static_cast<std::size_t>(bands);
  std::vector<double> received(m.N * nb), sent(B, B + m.N * nb);
  for (std::size_t k = 0; k < sent.size(); ++k)
  {
    sent[k] *= m.Covered.Uncovered(k / nb);
  }
  m.Multiply(B, received.data(), bands);
  m.Network.SquareErrors(sent.data(), received.data(), m.Closed, formFactor, visibility, bands);
  for (std::size_t k = 0; k < received.size(); ++k)
  {
    // Kernels are kept in single precision. What is left of a covered element need not see the same
    // as all of it.
    const double left = m.Covered.Uncovered(k / nb);
    formFactor[k] = left * Alike * std::sqrt(formFactor[k]) +
      (6e-8 + 0.25 * (left > 0.0 ? 1.0 - left : 0.0)) * std::abs(received[k]) +
      (m.Own.empty() ? 0.0 : m.Own[k / nb] * std::abs(B[k] - received[k]));
    visibility[k] = left * std::sqrt(visibility[k]);
  }
  m.Covered.Receive(formFactor, bands);
  m.Covered.Receive(visibility, bands);
}

std::vector<std::int32_t> HierarchicalOperator::Components() const
{
  return this->Impl->Network.Components();
}

std::size_t HierarchicalOperator::MemoryBytes() const
{
  return this->Impl->Network.MemoryBytes() + this->Impl->N * (4 * sizeof(double) + 1) +
    this->Impl->Covered.MemoryBytes();
}
std::int64_t HierarchicalOperator::Samples() const
{
  return this->Impl->Network.Pairs() + this->Impl->Network.Rays();
}
ClosureReport HierarchicalOperator::Closure() const { return this->Impl->Report; }
std::string HierarchicalOperator::Description() const
{
  const Internals& m = *this->Impl;
  std::string text = "hierarchical, " + std::to_string(m.N) + " elements, " +
    std::to_string(m.Network.Links()) + " links, " + std::to_string(m.Network.Rays()) + " rays";
  if (m.Loosened > 1.0)
  {
    text += ", coarser than asked (memory limit)";
  }
  if (m.Network.Hasty())
  {
    text += ", in part coarser than asked (time budget)";
  }
  return text;
}

void HierarchicalOperator::Save(ArchiveWriter& out) const
{
  const Internals& m = *this->Impl;
  out.Put(m.Areas);
  m.Network.Save(out);
  out.Put(m.Scale);
  out.Put(m.Own);
  out.Put(m.RowSums);
  out.Put(m.AllRowSums);
  m.Covered.Save(out);
  out.Put(m.Closed);
  out.Put(m.Loosened);
  out.Put(m.Report);
}

std::unique_ptr<HierarchicalOperator> HierarchicalOperator::Load(
  ArchiveReader& in, int threads, const Communicator* ranks)
{
  std::unique_ptr<HierarchicalOperator> loaded(new HierarchicalOperator());
  Internals& m = *loaded->Impl;
  in.Get(m.Areas);
  m.N = m.Areas.size();
  m.Network.Load(in, threads, ranks);
  in.Get(m.Scale);
  in.Get(m.Own);
  in.Get(m.RowSums);
  in.Get(m.AllRowSums);
  m.Covered.Load(in, m.N);
  in.Get(m.Closed);
  m.Loosened = in.Get<double>();
  m.Report = in.Get<ClosureReport>();
  if ((!m.Own.empty() && m.Own.size() != m.N) || m.Network.GetTree().Order().size() != m.N || m.Scale.size() != m.N ||
    m.RowSums.size() != m.N || m.AllRowSums.size() != m.N || m.Closed.size() != m.N)
  {
    throw std::runtime_error("is damaged: rows are missing");
  }
  return loaded;
}

} // namespace radiometry
