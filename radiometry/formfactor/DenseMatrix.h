// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/SymmetricTiles.h"
#include "radiometry/formfactor/TileExchange.h"
#include "radiometry/scene/Communicator.h"
#include "radiometry/scene/Parallel.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace radiometry
{

/// The exchange of all pairs of elements and the errors of its sampled fractions, as DenseOperator
/// keeps it: by places in the order of ElementBlocks, one rank's tiles. Vectors handed over and
/// returned are by element.
class DenseMatrix
{
public:
  static constexpr std::size_t Edge = ElementBlocks::Edge;

  DenseMatrix() = default;
  /// Room for the order's elements, of which areas are given by element.
  DenseMatrix(std::vector<std::int32_t> order, const std::vector<double>& areas, bool wide,
    int threads, const Communicator* ranks);

  /// Computes this rank's tiles; collective. `truncation` gets each element's bound, m^2.
  void Build(const TileExchange& exchange, const StageProgress& stage,
    std::vector<double>& truncation);

  /// out = S x for `count` right-hand sides one after the other; collective.
  void Multiply(const double* x, double* out, int count = 1) const;
  /// squares[i] += sum of the variances of S_ij |x_j|; collective.
  void AddVariance(const double* x, double* squares) const;
  /// This rank's value; 0 where it belongs to another.
  double At(std::size_t i, std::size_t j) const;
  /// Labels of the sets that exchange light, from 0, with `further` links between elements;
  /// collective.
  std::vector<std::int32_t> Components(
    const std::vector<std::pair<std::int32_t, std::int32_t>>& further = {}) const;

  std::size_t Size() const { return this->N; }
  bool Wide() const { return this->Double; }
  std::size_t MemoryBytes() const;
  std::int64_t Pairs() const { return this->PairCount; }
  std::int64_t Rays() const { return this->RayCount; }

  void Save(ArchiveWriter& out) const;
  void Load(ArchiveReader& in, int threads, const Communicator* ranks);

private:
  bool Own(std::size_t tile) const
  {
    return !this->Ranks ||
      tile % static_cast<std::size_t>(this->Ranks->Size()) ==
      static_cast<std::size_t>(this->Ranks->Rank());
  }
  void Keep(std::size_t i, std::size_t j, const double* values, const TileResult& result);
  template <int W>
  void MultiplyBy(const double* x, double* out) const;
  double Value(std::size_t bi, std::size_t bj, std::size_t k) const;

  std::size_t N = 0;
  std::vector<std::int32_t> Order;  // the element at each place
  std::vector<std::int32_t> Places; // the place of each element
  std::vector<double> Roots;        // of the areas, by place, whole blocks
  bool Double = true;
  SymmetricTiles<double> Fine;
  SymmetricTiles<float> Coarse;
  SymmetricTiles<std::uint8_t> Errors; // of sampled pairs, see Keep
  std::vector<SampledBlock> Rough;
  std::int64_t PairCount = 0, RayCount = 0;
  int Threads = 0;
  const Communicator* Ranks = nullptr;
};

} // namespace radiometry
