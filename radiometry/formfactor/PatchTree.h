// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/geometry/BoxTree.h"
#include "radiometry/geometry/PairExchange.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// The elements of a surface (sides of triangles) in a binary tree in which those of one group
/// stand together: a node holds elements of one group, or whole groups.
///
/// Groups and elements are numbered anew by their places in the tree: neighbours in space are
/// neighbours in it. `Name` leads back.
class PatchTree
{
public:
  struct Node
  {
    std::int32_t Begin = 0, End = 0;            // elements
    std::int32_t FirstGroup = 0, LastGroup = 0; // groups, both included
    std::int32_t Left = -1, Right = -1;         // -1: a single element
    std::int32_t Corners = 0, CornersEnd = 0;   // of the outline, where flat
    Box3 Box;
    Vec3 Center;
    double Radius = 0.0;
    Vec3 Axis;           // unit; the normals lie within Spread of it
    double Spread = 0.0; // radians; pi: anywhere
    double Area = 0.0;
    bool Flat = false; // all on one plane (to rounding), fronts the same way
    bool Single() const { return this->Left < 0; }
    bool OneGroup() const { return this->FirstGroup == this->LastGroup; }
    std::int32_t Size() const { return this->End - this->Begin; }
  };

  /// `group` of each element, -1: left out. Groups without elements get no place.
  PatchTree(const ElementSet& elements, const std::vector<std::int32_t>& group, std::size_t groups);

  bool Empty() const { return this->Nodes.empty(); }
  const Node& operator[](std::int32_t node) const { return this->Nodes[node]; }
  /// The node of a group, by its place.
  std::int32_t Root(std::int32_t place) const { return this->Roots[place]; }
  std::size_t Groups() const { return this->Roots.size(); }
  /// The caller's number of the group at a place.
  std::int32_t Name(std::int32_t place) const { return this->Names[place]; }

  /// By the element's place.
  const ExchangePatch& Shape(std::int32_t element) const { return this->Shapes[element]; }
  std::int32_t Triangle(std::int32_t element) const { return this->Triangles[element]; }
  /// The element of a node in which a share of its area in [0, 1) lies; `share` becomes that of the
  /// element.
  std::int32_t Pick(const Node& node, double& share) const;

  /// The convex outline of a flat node (of at most eight corners; it may be larger than the node).
  std::vector<Vec3> Outline(const Node& node) const
  {
    return { this->Corners.begin() + node.Corners, this->Corners.begin() + node.CornersEnd };
  }

  /// False only where no element of one can see an element of the other.
  bool MayFace(const Node& a, const Node& b) const;

private:
  std::int32_t BuildGroups(const std::vector<Vec3>& centers, std::vector<std::int32_t>& order,
    std::size_t begin, std::size_t end, const std::vector<std::int32_t>& start,
    const std::vector<std::int32_t>& members, const ElementSet& elements);
  std::int32_t BuildElements(std::vector<std::int32_t>& members, std::size_t begin, std::size_t end,
    const ElementSet& elements);
  void Join(std::int32_t at, std::int32_t left, std::int32_t right);
  void MakeLeaf(std::int32_t at, const Patch& patch);

  std::vector<Node> Nodes;
  std::vector<std::int32_t> Roots;
  std::vector<std::int32_t> Names;
  std::vector<ExchangePatch> Shapes;
  std::vector<std::int32_t> Triangles;
  std::vector<double> AreaBefore; // of the elements before each
  std::vector<Vec3> Corners;
};

} // namespace radiometry
