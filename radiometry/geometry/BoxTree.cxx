// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/BoxTree.h"

#include <algorithm>
#include <numeric>

namespace radiometry
{

BoxTree::BoxTree(const std::vector<Box3>& boxes)
{
  if (boxes.empty())
  {
    return;
  }
  this->Items.resize(boxes.size());
  std::iota(this->Items.begin(), this->Items.end(), 0);
  this->Nodes.reserve(boxes.size());
  this->Build(boxes, 0, static_cast<std::int32_t>(boxes.size()));
}

void BoxTree::Build(const std::vector<Box3>& boxes, std::int32_t begin, std::int32_t end)
{
  constexpr std::int32_t leafSize = 4;
  const std::size_t at = this->Nodes.size();
  this->Nodes.emplace_back();
  Box3 bounds;
  Box3 centers;
  for (std::int32_t i = begin; i < end; ++i)
  {
    bounds.Add(boxes[this->Items[i]]);
    centers.Add(boxes[this->Items[i]].Center());
  }
  this->Nodes[at].Bounds = bounds;
  if (end - begin <= leafSize)
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
  this->Build(boxes, begin, middle);
  this->Nodes[at].First = static_cast<std::int32_t>(this->Nodes.size());
  this->Build(boxes, middle, end);
}

} // namespace radiometry
