// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/irradiance/ExchangeOptions.h"
#include "radiometry/formfactor/FormFactorOperator.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/visibility/OcclusionScene.h"

namespace radiometry
{

/// Rays traced once from each element, cosine-weighted, and kept as the elements that they met:
/// F_ij = rays from i that met j / rays from i. Each of eight batches is one scrambled Sobol
/// sequence over (point, direction) that later rays continue.
///   Rows     sum to the share of rays that met receiving sides: exactly one in a closed scene
///   Energy   components that lose no ray are also made to conserve energy: F + 1 w^T with
///            w = (A - F^T A)/sum A, the least change that gives A^T F = A^T and keeps row sums
///   Error    the spread of the batches
///   Blockers rays that meet a side that does not receive are absorbed
///   Memory   4 bytes a ray
///   Cost     one ray each, times log(triangles)
///   Bytes    keyed on the element's number: the same for any number of threads
class MonteCarloOperator : public FormFactorOperator
{
public:
  static constexpr int Batches = 8;

  /// `rays` from each element at first (rounded up to a multiple of the batches). `scene` objects
  /// must outlive this.
  MonteCarloOperator(const OcclusionScene& occluders, const ElementSet& elements,
    const ExchangeOptions& options, int rays, const StageProgress& stage = {});

  /// Doubles the rays of the elements marked. Not thread-safe.
  void DoubleRays(const std::vector<std::uint8_t>& marked, const StageProgress& stage = {});
  int Rays(std::size_t element) const { return this->RaysOf[element]; }

  std::size_t Size() const override { return this->RaysOf.size(); }
  const std::vector<double>& Areas() const override;
  void Apply(const double* B, double* out, int bands) const override;
  double RowSum(std::size_t i, int = 0) const override { return this->RowSums[i]; }
  void ApplyError(
    const double* B, double* formFactor, double* visibility, int bands) const override;
  std::vector<std::int32_t> Components() const override { return this->Component; }
  std::size_t MemoryBytes() const override;
  std::int64_t Samples() const override { return this->Total; }
  ClosureReport Closure() const override { return this->Report; }
  std::string Description() const override;

private:
  struct Round
  {
    std::vector<std::size_t> Begin; // of each element's hits; batch by batch, equal shares
    std::vector<std::int32_t> Hit;  // element met, or -1
  };
  void Trace(const std::vector<std::int32_t>& rays, const StageProgress& stage);
  void Summarise();

  const OcclusionScene& Occluders;
  const ElementSet& Elements;
  ExchangeOptions Options;
  std::vector<Round> Rounds;
  std::vector<std::int32_t> RaysOf;
  std::vector<double> RowSums;
  std::vector<std::int32_t> Component;
  std::vector<double> Balance;       // w times the component's area; 0 where not closed
  std::vector<double> ComponentArea; // 0 where not closed
  ClosureReport Report;
  std::int64_t Total = 0;
};

} // namespace radiometry
