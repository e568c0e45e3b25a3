// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/scene/Archive.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// A binary tree over elements, for exchange between clusters of them: alike in orientation first
/// (until normals differ by less than some 35 degrees), then in kind, in size, and in place.
///   Nodes    in preorder: the first child follows its parent; a cluster of m elements fills
///            2 m - 1 nodes; leaves are single elements
///   Cost     O(n log n), some 2 s for a million elements
class ElementTree
{
public:
  struct Node
  {
    Vec3 Center; // centroid, weighted by area
    Vec3 Normal; // mean of the unit normals, weighted by area; shorter than 1 where they differ
    Vec3 Axis;   // Normal, unit; zero where normals cancel
    double Area = 0.0;      // m^2
    double Radius = 0.0;    // greatest distance of a corner from Center
    double Thickness = 0.0; // greatest distance of a corner from the plane about Axis
    double Cone = 1.0;      // least cosine between Axis and a normal
    double Bend = 0.0;      // greatest |normal - Normal|
    std::int32_t First = 0; // its elements: [First, First + Count) of Order
    std::int32_t Count = 0;
    std::int32_t Second = -1; // the second child; -1: a leaf
    std::int32_t Parent = -1;

    bool Leaf() const { return this->Second < 0; }
    bool Flat() const { return this->Cone > 1.0 - 1e-12; }
  };

  ElementTree() = default;
  /// `kinds`: elements of different kinds are kept apart below the division by orientation.
  explicit ElementTree(const ElementSet& elements, std::vector<std::uint8_t> kinds = {});

  std::size_t Size() const { return this->Nodes.size(); }
  const Node& operator[](std::int32_t node) const
  {
    return this->Nodes[static_cast<std::size_t>(node)];
  }
  const std::vector<Node>& GetNodes() const { return this->Nodes; }
  /// Elements in the order of the leaves.
  const std::vector<std::int32_t>& Order() const { return this->Items; }
  /// Subtrees of at most some hundreds of elements, in preorder: what is worked on independently.
  const std::vector<std::int32_t>& Subtrees() const { return this->Small; }
  /// The nodes above them, in preorder.
  const std::vector<std::int32_t>& Upper() const { return this->Large; }
  void Save(ArchiveWriter& out) const;
  /// Throws std::runtime_error where the archive is damaged.
  void Load(ArchiveReader& in);
  std::size_t MemoryBytes() const
  {
    return this->Nodes.size() * sizeof(Node) +
      (this->Items.size() + this->Small.size() + this->Large.size()) * sizeof(std::int32_t);
  }
  /// How far rounding of coordinates moves a point, m.
  double Rounding() const { return this->Tolerance; }

  /// False only where proven that no element of one can see any of the other from its front.
  bool MayFace(std::int32_t a, std::int32_t b) const;

private:
  struct Builder;
  void FindSubtrees();

  std::vector<Node> Nodes;
  std::vector<std::int32_t> Items, Small, Large;
  double Tolerance = 0.0;
};

} // namespace radiometry
