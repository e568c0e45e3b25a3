// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/BoxTree.h"

#include <algorithm>
#include <numeric>
#include <tbb/parallel_invoke.h>
#include <utility>

namespace radiometry
{
namespace
{

constexpr std::int32_t LeafSize = BoxTree::LeafSize;
/// Smaller parts are not worth a task.
constexpr std::int32_t TaskSize = 8192;

/// The numbers of nodes of trees over n and n + 1 items.
std::pair<std::size_t, std::size_t> NodeCounts(std::int32_t n)
{
  if (n < LeafSize)
  {
    return { 1, 1 };
  }
  const auto [half, more] = NodeCounts(n / 2);
  const auto count = [&](std::int32_t m) -> std::size_t {
    if (m <= LeafSize)
    {
      return 1;
    }
    const auto of = [&](std::int32_t part) { return part == n / 2 ? half : more; };
    return 1 + of(m / 2) + of(m - m / 2);
  };
  return { count(n), count(n + 1) };
}

} // namespace

BoxTree::BoxTree(const std::vector<Box3>& boxes)
{
  if (boxes.empty())
  {
    return;
  }
  const auto count = static_cast<std::int32_t>(boxes.size());
  this->Items.resize(boxes.size());
  std::iota(this->Items.begin(), this->Items.end(), 0);
  this->Nodes.resize(NodeCounts(count).first);
  this->Build(boxes, 0, count, 0);
}

/// Writes the tree over items [begin, end) from node `at` on: a node, its first half, its second.
void BoxTree::Build(
  const std::vector<Box3>& boxes, std::int32_t begin, std::int32_t end, std::size_t at)
{
  Box3 bounds;
  Box3 centers;
  for (std::int32_t i = begin; i < end; ++i)
  {
    bounds.Add(boxes[this->Items[i]]);
    centers.Add(boxes[this->Items[i]].Center());
  }
  this->Nodes[at].Bounds = bounds;
  if (end - begin <= LeafSize)
  {
    this->Nodes[at].First = begin;
    this->Nodes[at].Count = end - begin;
    return;
  }
  // Halve along the longest extent of the centres: balanced, so the depth is at most log2(n).
  const Vec3 size = centers.Size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const std::int32_t middle = begin + (end - begin) / 2;
  std::nth_element(this->Items.begin() + begin, this->Items.begin() + middle,
    this->Items.begin() + end, [&](std::int32_t a, std::int32_t b) {
      const double ca = boxes[a].Min[axis] + boxes[a].Max[axis];
      const double cb = boxes[b].Min[axis] + boxes[b].Max[axis];
      return ca < cb || (ca == cb && a < b);
    });
  const std::size_t second = at + 1 + NodeCounts(middle - begin).first;
  this->Nodes[at].First = static_cast<std::int32_t>(second);
  const auto buildFirst = [&] { this->Build(boxes, begin, middle, at + 1); };
  const auto buildSecond = [&] { this->Build(boxes, middle, end, second); };
  if (end - begin > TaskSize)
  {
    tbb::parallel_invoke(buildFirst, buildSecond);
  }
  else
  {
    buildFirst();
    buildSecond();
  }
}

std::vector<std::int32_t> BoxTree::Groups(std::int32_t most) const
{
  std::vector<std::int32_t> first;
  const auto total = static_cast<std::int32_t>(this->Items.size());
  // Halves as Build makes them.
  const auto split = [&](const auto& self, std::int32_t begin, std::int32_t end) -> void {
    if (end - begin <= most || end - begin <= LeafSize)
    {
      first.push_back(begin);
      return;
    }
    const std::int32_t middle = begin + (end - begin) / 2;
    self(self, begin, middle);
    self(self, middle, end);
  };
  if (total > 0)
  {
    split(split, 0, total);
  }
  first.push_back(total);
  return first;
}

} // namespace radiometry
