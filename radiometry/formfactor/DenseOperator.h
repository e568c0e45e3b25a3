// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/irradiance/ExchangeOptions.h"
#include "radiometry/formfactor/FormFactorOperator.h"
#include "radiometry/scene/Archive.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <memory>

namespace radiometry
{

/// All pairs: S_ij = A_i F_ij by PairExchange times the visible fraction (TileExchange).
///   Reciprocity  exact: S is stored once for both directions
///   Closure      rows all of whose probes meet receiving elements are made to sum to one by the
///                least change sum dS^2/S that keeps S symmetric, to rounding; others are left
///   Overlaps     of faces that lie in one another the one of the lower number is on top; what it
///                covers receives as it does and sends nothing (CoveredElements). Rows that see more
///                than a hemisphere all the same are scaled down
///   Memory       4 or 8 bytes a pair of i < j, and 1 where fractions were sampled; groups that
///                exchange nothing take none. Double where n <= 4096 or the tolerance is below 1e-4,
///                and the limit allows it for the whole matrix (so that ranks change no digit)
///   Cost         n^2/2 pairs: 1 ns where groups are settled as a whole, else 0.2 to 20 us
///   Time         options.SecondsLeft: past some nine tenths of it what remains is estimated by
///                groups, with an error that says so
///   Ranks        tiles are shared out in turn; values are the serial ones to rounding of sums
///   Fails        InputError{"MemoryLimit"} naming the least that would do, before any work
class DenseOperator : public FormFactorOperator
{
public:
  DenseOperator(const Scene& scene, const OcclusionScene& occluders, const ElementSet& elements,
    const ExchangeOptions& options, const StageProgress& stage = {});
  ~DenseOperator() override;

  /// Bytes that n elements need at most in single precision, over `ranks` on each of them.
  static std::size_t LeastBytes(std::size_t n, int ranks = 1);

  /// Everything but what belongs to the process. Over ranks each saves its own share.
  void Save(ArchiveWriter& out) const;
  /// Throws std::runtime_error where the archive is damaged or was saved by another number of ranks.
  static std::unique_ptr<DenseOperator> Load(
    ArchiveReader& in, int threads = 0, const Communicator* ranks = nullptr);

  std::size_t Size() const override;
  const std::vector<double>& Areas() const override;
  void Apply(const double* B, double* out, int bands) const override;
  double RowSum(std::size_t i, int band = 0) const override;
  void ApplyError(
    const double* B, double* formFactor, double* visibility, int bands) const override;
  std::vector<std::int32_t> Components() const override;
  /// Of this rank.
  std::size_t MemoryBytes() const override;
  std::int64_t Samples() const override;
  ClosureReport Closure() const override;
  std::string Description() const override;

  /// S_ij = A_i F_ij, m^2, after correction, of what is not covered. Over ranks 0 where another rank holds it.
  double Exchange(std::size_t i, std::size_t j) const;

private:
  DenseOperator();
  struct Internals;
  std::unique_ptr<Internals> Impl;
};

} // namespace radiometry
