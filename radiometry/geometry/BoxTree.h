// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace radiometry
{

/// An axis-aligned box; empty when just made.
struct Box3
{
  Vec3 Min{ std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::infinity() };
  Vec3 Max{ -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };

  void Add(const Vec3& p)
  {
    for (int a = 0; a < 3; ++a)
    {
      this->Min[a] = p[a] < this->Min[a] ? p[a] : this->Min[a];
      this->Max[a] = p[a] > this->Max[a] ? p[a] : this->Max[a];
    }
  }
  void Add(const Box3& b)
  {
    this->Add(b.Min);
    this->Add(b.Max);
  }
  bool Empty() const { return this->Min.x > this->Max.x; }
  Vec3 Center() const { return 0.5 * (this->Min + this->Max); }
  Vec3 Size() const { return this->Max - this->Min; }

  /// Narrows [begin, end] to the part of the ray start + s direction inside the box, widened by
  /// `margin`; false when there is none.
  bool Cut(const Vec3& start, const Vec3& direction, double margin, double& begin, double& end) const
  {
    for (int a = 0; a < 3; ++a)
    {
      const double lo = this->Min[a] - margin - start[a];
      const double hi = this->Max[a] + margin - start[a];
      if (direction[a] == 0.0)
      {
        if (lo > 0.0 || hi < 0.0)
        {
          return false;
        }
        continue;
      }
      const double inverse = 1.0 / direction[a];
      const double s = lo * inverse;
      const double t = hi * inverse;
      begin = s < t ? (s > begin ? s : begin) : (t > begin ? t : begin);
      end = s < t ? (t < end ? t : end) : (s < end ? s : end);
    }
    return begin <= end;
  }
};

/// A bounding volume hierarchy over boxes, in double: for conservative searches that single
/// precision must not decide. O(n log n) to build; the order of visits does not depend on threads.
class BoxTree
{
public:
  BoxTree() = default;
  explicit BoxTree(const std::vector<Box3>& boxes);

  bool Empty() const { return this->Nodes.empty(); }

  /// Visits every item whose box (and all boxes above it) passes `reaches(box)`. `visit(item)`
  /// returns false to end the search; then Visit returns false too.
  template <typename Reaches, typename VisitItem>
  bool Visit(const Reaches& reaches, const VisitItem& visit) const
  {
    return this->VisitNodes(
      [&](std::int32_t node) { return reaches(this->Nodes[node].Bounds); }, visit);
  }

  /// The same with `reaches(node)`, the number of a node in [0, Size()).
  template <typename Reaches, typename VisitItem>
  bool VisitNodes(const Reaches& reaches, const VisitItem& visit) const
  {
    if (this->Nodes.empty())
    {
      return true;
    }
    std::int32_t stack[64];
    int top = 0;
    stack[top++] = 0;
    while (top > 0)
    {
      const std::int32_t at = stack[--top];
      const Node& node = this->Nodes[at];
      if (!reaches(at))
      {
        continue;
      }
      if (node.Count > 0)
      {
        for (std::int32_t k = 0; k < node.Count; ++k)
        {
          if (!visit(this->Items[node.First + k]))
          {
            return false;
          }
        }
      }
      else
      {
        stack[top++] = node.First;
        stack[top++] = at + 1;
      }
    }
    return true;
  }

  struct Node
  {
    Box3 Bounds;
    std::int32_t First = 0; // leaf: first item; inner: the second child (the first is the next node)
    std::int32_t Count = 0; // leaf: items; inner: 0
  };
  std::size_t Size() const { return this->Nodes.size(); }
  const Node& At(std::int32_t node) const { return this->Nodes[node]; }
  static constexpr std::int32_t LeafSize = 4; // items in a leaf, at most
  /// The items in the order of the leaves: neighbours in space are neighbours in it. A leaf holds
  /// [First, First + Count).
  const std::vector<std::int32_t>& Order() const { return this->Items; }
  /// The greatest subtrees of at most `most` items, as ranges of Order: the first item of each,
  /// and the number of items at the end.
  std::vector<std::int32_t> Groups(std::int32_t most) const;

private:
  void Build(const std::vector<Box3>& boxes, std::int32_t begin, std::int32_t end, std::size_t at);

  std::vector<Node> Nodes;
  std::vector<std::int32_t> Items;
};

} // namespace radiometry
