// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/PairExchange.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/visibility/PatchBlockers.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// Elements in an order in which neighbours in place and direction stand together: in blocks of 64,
/// each halved down to single elements, so that one test can tell for all pairs of two groups.
///   Order   halved at multiples of the block along the longest extent, be it of the centres or of the
///           normals (times a quarter of the size); ties by number: the same for any threads
///   Cost    O(n log n)
class ElementBlocks
{
public:
  static constexpr std::size_t Edge = 64;

  /// `blockers` gives the coordinates of the groups; null: the patches' own.
  ElementBlocks(const std::vector<Patch>& patches, const PatchBlockers* blockers);
  ElementBlocks(const ElementBlocks&) = delete;
  ElementBlocks& operator=(const ElementBlocks&) = delete;

  /// A group of a block's elements: node 1 is the block, 2 k and 2 k + 1 the halves of k, 64 + e
  /// element e.
  struct Node
  {
    PatchGroup Group;
    Vec3 Center; // of a sphere about the corners
    double Radius = 0.0;
    Vec3 Axis; // of a cone about the normals
    double HalfAngle = 0.0;
    std::int32_t First = 0; // within the block
  };
  const Node& At(std::size_t block, std::size_t node) const
  {
    return this->Nodes[block * 2 * Edge + node];
  }
  std::size_t Size() const { return this->Elements.size(); }
  std::size_t Blocks() const { return (this->Size() + Edge - 1) / Edge; }
  /// The element at each place of the order.
  const std::vector<std::int32_t>& Order() const { return this->Elements; }
  /// By place in the order.
  const ExchangePatch& Shape(std::size_t place) const { return this->Shapes[place]; }
  const PlacedPatch& Placed(std::size_t place) const { return this->Patches[place]; }

  /// True only where every patch of b lies behind every patch of a, or the other way round.
  static bool BackFacing(const Node& a, const Node& b);

private:
  void Sort(const std::vector<Vec3>& centers, const std::vector<Vec3>& normals, std::size_t begin,
    std::size_t end);
  void Bound(std::size_t block, std::size_t node);

  std::vector<std::int32_t> Elements;
  std::vector<ExchangePatch> Shapes;
  std::vector<PlacedPatch> Patches;
  std::vector<Node> Nodes;
};

} // namespace radiometry
