// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/formfactor/FormFactorOperator.h"
#include "radiometry/irradiance/ExchangeOptions.h"
#include "radiometry/irradiance/SpecularSurfaces.h"
#include "radiometry/scene/Archive.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <array>
#include <memory>

namespace radiometry
{

/// Rays traced once from each element, cosine-weighted, and kept as the elements that they met:
/// F_ij = rays from i that met j / rays from i. Each of eight batches is one scrambled Sobol
/// sequence over (point, direction) that later rays continue.
///   Paths    with options.Paths rays go on over mirrors, glossy surfaces and through panes: a path
///            from i that ends on j, of which the share alpha is not sent on, counts 1/alpha_j
///            (SpecularSurfaces.h). Where bands differ, paths carry a weight a band and count
///            wherever bands part. F_ij is then what of B_j arrives, however often it was reflected
///   Rows     sum_j F_ij alpha_j is the share of rays that met receiving sides: exactly one in a
///            closed scene, mirrors and panes included
///   Energy   components that lose no ray are also made to conserve energy: with a = A alpha,
///            G = F alpha^-1 (no paths: a = A, G = F), G + 1 w^T with w = (a - G^T a)/sum a, the
///            least change that gives a^T G = a^T and keeps row sums
///   Error    the spread of the batches, and what surfaces brighter than any met would give by half
///            a ray; paths given up after thousands of mirrors count with the greatest radiosity
///   Blockers rays that meet a side that does not receive are absorbed
///   Memory   4 bytes a ray; where the bands of a path differ, 4 more and 4 for each band
///   Cost     one ray each, times log(triangles), and one for each reflection
///   Time     options.SecondsLeft (one process alone): past them no element gets rays. One without
///            any takes the row of the nearest in number that has some, and differs from it by what
///            those before and behind it differ among themselves: its error
///   Bytes    keyed on the element's number: the same for any number of threads and ranks
///   Fails    InputError for mirrors between which light is caught for ever, an emitting surface
///            that reflects and lets through all, or a memory limit that is too small
class MonteCarloOperator : public FormFactorOperator
{
public:
  static constexpr int Batches = 8;

  /// `rays` from each element at first (rounded up to a multiple of the batches).
  MonteCarloOperator(std::shared_ptr<const OcclusionScene> occluders,
    std::shared_ptr<const ElementSet> elements, const ExchangeOptions& options, int rays,
    const StageProgress& stage = {});
  /// The same of things that outlive this.
  MonteCarloOperator(const OcclusionScene& occluders, const ElementSet& elements,
    const ExchangeOptions& options, int rays, const StageProgress& stage = {});
  ~MonteCarloOperator() override;

  /// Doubles the rays of the elements marked. Not thread-safe.
  void DoubleRays(const std::vector<std::uint8_t>& marked, const StageProgress& stage = {});
  /// Adds rays to each element, so many as stated (rounded down to a multiple of the batches). Not
  /// thread-safe.
  void AddRays(const std::vector<std::int32_t>& rays, const StageProgress& stage = {});
  /// Seconds that the next rays may take; 0: no limit.
  void SetSecondsLeft(double seconds) { this->Options.SecondsLeft = seconds; }
  /// Rays that an element's row is of: its own, or of the one whose row it takes.
  int Rays(std::size_t element) const { return this->RaysOf[this->RowOf(element)]; }
  int OwnRays(std::size_t element) const { return this->RaysOf[element]; }

  std::size_t Size() const override { return this->RaysOf.size(); }
  const std::vector<double>& Areas() const override;
  /// With Bands() > 0: so many right-hand sides, or one, for which each entry of F is the greatest of
  /// its bands.
  void Apply(const double* B, double* out, int bands) const override;
  int Bands() const override { return this->Width > 1 ? static_cast<int>(this->Width) : 0; }
  double RowSum(std::size_t i, int band = 0) const override
  {
    return this->RowSums[i * this->Width + (this->Width > 1 ? static_cast<std::size_t>(band) : 0)];
  }
  void ApplyError(
    const double* B, double* formFactor, double* visibility, int bands) const override;
  std::vector<std::int32_t> Components() const override { return this->Component; }
  /// Of the rank that needs most.
  std::size_t MemoryBytes() const override;
  std::int64_t Samples() const override { return this->Total; }
  ClosureReport Closure() const override { return this->Report; }
  std::string Description() const override;
  /// Rays that were given up between mirrors.
  std::int64_t CutPaths() const { return this->TotalCut; }

  /// This rank's rays, to be continued by Load on the same elements.
  void Save(ArchiveWriter& out) const;
  /// Throws std::runtime_error where the file is damaged or was made of other elements.
  static std::unique_ptr<MonteCarloOperator> Load(ArchiveReader& in,
    std::shared_ptr<const OcclusionScene> occluders, std::shared_ptr<const ElementSet> elements,
    const ExchangeOptions& options);

private:
  /// What was traced at one time, of this rank's elements.
  struct Round
  {
    std::vector<std::size_t> Begin; // of each element's rays; batch by batch, equal shares
    std::vector<std::int32_t> Hit;  // element on which a ray's path ended with weight 1, or one of:
    static constexpr std::int32_t None = -1;
    // Counts of paths whose bands differ: of each element, batch by batch.
    std::vector<std::size_t> PartBegin; // elements x batches + 1; empty: none
    std::vector<std::int32_t> PartHit;
    std::vector<float> PartWeight; // x bands
    std::size_t Bytes() const;
  };
  struct TracedBlock;
  MonteCarloOperator(std::shared_ptr<const OcclusionScene> occluders,
    std::shared_ptr<const ElementSet> elements, const ExchangeOptions& options);

  void Trace(const std::vector<std::int32_t>& rays, const StageProgress& stage);
  void TraceBlock(
    std::size_t first, const std::vector<std::int32_t>& rays, Round& round, TracedBlock& traced);
  void CheckTraced() const;
  void LeaveOut(
    const std::vector<std::uint8_t>& late, std::vector<std::int32_t>& rays, Round& round) const;
  void FindRows();
  /// The element whose rays an element's row is of.
  std::size_t RowOf(std::size_t element) const
  {
    return this->Around.empty() ? element : this->Nearest(element);
  }
  std::size_t Nearest(std::size_t element) const;
  void TakeRows(
    std::size_t nb, const std::vector<double>& mean, double* values, bool spread) const;
  static void Assemble(
    std::vector<TracedBlock>& blocks, std::size_t rows, std::size_t width, Round& round);
  void CheckMemory(const std::vector<std::int32_t>& rays) const;
  void Summarise(const StageProgress& stage);
  void FindRowSums(const StageProgress& stage);
  void FindComponents(const StageProgress& stage);
  void FindBalance(const StageProgress& stage);
  void FindGains();
  /// B/alpha, as the rays count it.
  std::vector<double> Scaled(const double* B, std::size_t bands) const;
  /// Adds what leaves the elements met in a batch (-1: all) of row r of this rank.
  void SumRow(const Round& round, std::size_t row, int batch, const double* scaled,
    std::size_t bands, double* sum) const;

  /// The greatest of what row r's paths ended on.
  double GreatestMet(
    std::size_t row, const double* scaled, std::size_t bands, std::size_t band) const;

  std::shared_ptr<const OcclusionScene> Occluders;
  std::shared_ptr<const ElementSet> Elements;
  ExchangeOptions Options;
  RankShare Share;
  std::size_t Width = 1; // weights of a path
  std::vector<Round> Rounds;
  std::vector<std::int32_t> RaysOf; // of all elements
  /// Of each element the nearest before and behind it that have rays, itself where it has some; empty:
  /// all have.
  std::vector<std::array<std::int32_t, 2>> Around;
  std::vector<std::uint8_t> Leaks;  // 1: a path of this rank's element lost something
  std::vector<std::int32_t> CutOf;  // ... and how many were given up
  std::vector<double> Gain;         // 1/alpha, elements x Width; empty: all 1
  std::vector<double> RowSums;      // elements x Width
  std::vector<std::int32_t> Component;
  std::vector<double> Balance;       // w sum(a) of each element and width; empty: none is closed
  std::vector<double> ComponentArea; // sum(a); 0 where not closed
  ClosureReport Report;
  std::int64_t Total = 0;
  std::int64_t TotalCut = 0;
  std::size_t OwnBytes = 0; // of the rank that has most
};

} // namespace radiometry
