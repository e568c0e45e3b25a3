// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementBlocks.h"
#include "radiometry/irradiance/ExchangeOptions.h"
#include "radiometry/visibility/OcclusionScene.h"
#include "radiometry/visibility/PatchBlockers.h"

#include <chrono>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// A pair whose visible fraction was sampled: standard error of S_ij, m^2. Places in the order.
struct SampledPair
{
  std::int32_t I, J;
  float Error;
};

/// Pairs [I, I + Rows) x [J, J + Columns) that got one estimate of visibility together: standard
/// error relative to the sum of their exchange.
struct SampledBlock
{
  std::int32_t I, Rows, J, Columns;
  float Relative;
};

/// What became of a tile.
struct TileResult
{
  std::vector<SampledPair> Sampled;
  std::vector<SampledBlock> Rough;
  std::vector<double> Truncation; // bound of the error of the rows, then of the columns, m^2
  std::int64_t Pairs = 0;         // that exchange light
  std::int64_t Rays = 0;
};

/// The exchange of all pairs of two blocks of elements.
///   Method  groups that face away from each other, that nothing stands between or that are wholly
///           hidden are settled as a whole (ElementBlocks, PatchBlockers); what is left is halved,
///           down to pairs, whose visible fraction is sampled (PairVisibility)
///   Time    past the deadline groups are halved no more: 32 segments tell for all of their pairs,
///           whose exchange is taken between centroids
class TileExchange
{
public:
  static constexpr std::size_t Edge = ElementBlocks::Edge;

  /// Rows and columns may be one set of blocks, of which the tiles i <= j are then asked for.
  /// `blockers` null: nothing stands between any two elements.
  TileExchange(const ElementBlocks& rows, const ElementBlocks& columns,
    const OcclusionScene& occluders, const PatchBlockers* blockers,
    const ExchangeOptions& options);

  /// values[r * Edge + c] = S of the r-th element of block i and the c-th of block j; both halves
  /// for a block with itself. `values` comes zeroed. Thread-safe.
  void operator()(std::size_t i, std::size_t j, double* values, TileResult& result) const;

  /// True once the deadline made a group rough.
  bool Late() const;

private:
  struct Work;
  using Node = ElementBlocks::Node;
  void Divide(Work& work, std::size_t a, std::size_t b, int depth) const;
  void Same(Work& work, std::size_t a) const;
  PairExchangeResult Unblocked(const ExchangePatch& a, const ExchangePatch& b) const;
  void Open(Work& work, const Node& a, const Node& b) const;
  void Mixed(Work& work, const Node& a, const Node& b,
    const PatchBlockers::Candidates& between) const;
  void Single(Work& work, std::int32_t r, std::int32_t c,
    const PatchBlockers::Candidates& between) const;
  void Rough(Work& work, const Node& a, const Node& b) const;
  void Store(Work& work, std::int32_t r, std::int32_t c, double value, double error) const;

  const ElementBlocks& Rows;
  const ElementBlocks& Columns;
  const OcclusionScene& Occluders;
  const PatchBlockers* Blockers;
  ExchangeOptions Options;
  double Tolerance; // of a pair's geometry
  std::chrono::steady_clock::time_point Deadline;
};

} // namespace radiometry
