// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/irradiance/ExchangeOptions.h"
#include "radiometry/formfactor/FormFactorOperator.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <memory>

namespace radiometry
{

/// All pairs: S_ij = A_i F_ij by PairExchange times the sampled visible fraction.
///   Reciprocity  exact: S is stored once for both directions
///   Closure      rows all of whose probes meet receiving elements are made to sum to one by the
///                least change sum dS^2/S that keeps S symmetric, to rounding; others are left
///   Memory       4 or 8 bytes a pair: double where the limit and the tolerance ask for it
///   Cost         n^2/2 pairs of 0.2 to 20 us, and some 4 rays for each pair that faces
///   Fails        InputError{"MemoryLimit"} naming the least that would do, before any work
class DenseOperator : public FormFactorOperator
{
public:
  DenseOperator(const Scene& scene, const OcclusionScene& occluders, const ElementSet& elements,
    const ExchangeOptions& options, const StageProgress& stage = {});
  ~DenseOperator() override;

  /// Bytes that n elements need at least.
  static std::size_t LeastBytes(std::size_t n);

  std::size_t Size() const override;
  const std::vector<double>& Areas() const override;
  void Apply(const double* B, double* out, int bands) const override;
  double RowSum(std::size_t i, int band = 0) const override;
  void ApplyError(
    const double* B, double* formFactor, double* visibility, int bands) const override;
  std::vector<std::int32_t> Components() const override;
  std::size_t MemoryBytes() const override;
  std::int64_t Samples() const override;
  ClosureReport Closure() const override;
  std::string Description() const override;

  /// S_ij = A_i F_ij, m^2, after correction.
  double Exchange(std::size_t i, std::size_t j) const;

private:
  struct Internals;
  std::unique_ptr<Internals> Impl;
};

} // namespace radiometry
