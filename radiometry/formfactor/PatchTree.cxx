// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/PatchTree.h"

#include "radiometry/geometry/ConvexPolygon.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr std::size_t MostCorners = 8;

/// Puts the half with the lower coordinates along the longest side of their box first; returns
/// where the other begins.
template <class Center>
std::size_t Halve(
  std::vector<std::int32_t>& items, std::size_t begin, std::size_t end, const Center& center)
{
  Box3 box;
  for (std::size_t k = begin; k < end; ++k)
  {
    box.Add(center(items[k]));
  }
  const Vec3 size = box.Size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t k) { return items.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(begin), at(middle), at(end), [&](std::int32_t a, std::int32_t b) {
    const double ca = center(a)[axis], cb = center(b)[axis];
    return ca < cb || (ca == cb && a < b);
  });
  return middle;
}

/// The greatest height of a box over the plane of a flat node.
double Highest(const Box3& box, const PatchTree::Node& plane)
{
  const Vec3& n = plane.Axis;
  const Vec3 corner{ n.x > 0 ? box.Max.x : box.Min.x, n.y > 0 ? box.Max.y : box.Min.y,
    n.z > 0 ? box.Max.z : box.Min.z };
  return Dot(n, corner - plane.Center);
}

} // namespace

PatchTree::PatchTree(
  const ElementSet& elements, const std::vector<std::int32_t>& group, std::size_t groups)
{
  // The elements of each group, one after the other.
  std::vector<std::int32_t> start(groups + 1, 0);
  for (const std::int32_t g : group)
  {
    if (g >= 0)
    {
      ++start[static_cast<std::size_t>(g) + 1];
    }
  }
  for (std::size_t g = 0; g < groups; ++g)
  {
    start[g + 1] += start[g];
  }
  std::vector<std::int32_t> members(static_cast<std::size_t>(start[groups]));
  std::vector<std::int32_t> next(start.begin(), start.end() - 1);
  for (std::size_t e = 0; e < group.size(); ++e)
  {
    if (group[e] >= 0)
    {
      members[static_cast<std::size_t>(next[group[e]]++)] = static_cast<std::int32_t>(e);
    }
  }
  if (members.empty())
  {
    return;
  }
  std::vector<Vec3> centers(groups);
  std::vector<std::int32_t> order;
  for (std::size_t g = 0; g < groups; ++g)
  {
    Box3 box;
    for (std::int32_t k = start[g]; k < start[g + 1]; ++k)
    {
      box.Add(Centroid(elements.GetPatches()[members[k]].Corners));
    }
    if (!box.Empty())
    {
      centers[g] = box.Center();
      order.push_back(static_cast<std::int32_t>(g));
    }
  }
  this->Nodes.reserve(2 * members.size());
  this->Shapes.reserve(members.size());
  this->Triangles.reserve(members.size());
  this->Roots.reserve(order.size());
  this->AreaBefore.assign(1, 0.0);
  this->AreaBefore.reserve(members.size() + 1);
  this->BuildGroups(centers, order, 0, order.size(), start, members, elements);
}

std::int32_t PatchTree::BuildGroups(const std::vector<Vec3>& centers,
  std::vector<std::int32_t>& order, std::size_t begin, std::size_t end,
  const std::vector<std::int32_t>& start, const std::vector<std::int32_t>& members,
  const ElementSet& elements)
{
  if (end - begin == 1)
  {
    const std::int32_t g = order[begin];
    std::vector<std::int32_t> own(members.begin() + start[g], members.begin() + start[g + 1]);
    this->Names.push_back(g);
    const std::int32_t node = this->BuildElements(own, 0, own.size(), elements);
    this->Roots.push_back(node);
    return node;
  }
  const auto at = static_cast<std::int32_t>(this->Nodes.size());
  this->Nodes.emplace_back();
  const std::size_t middle =
    Halve(order, begin, end, [&](std::int32_t g) { return centers[static_cast<std::size_t>(g)]; });
  const std::int32_t left =
    this->BuildGroups(centers, order, begin, middle, start, members, elements);
  const std::int32_t right =
    this->BuildGroups(centers, order, middle, end, start, members, elements);
  this->Join(at, left, right);
  return at;
}

std::int32_t PatchTree::BuildElements(std::vector<std::int32_t>& members, std::size_t begin,
  std::size_t end, const ElementSet& elements)
{
  const auto at = static_cast<std::int32_t>(this->Nodes.size());
  this->Nodes.emplace_back();
  if (end - begin == 1)
  {
    this->MakeLeaf(at, elements.GetPatches()[members[begin]]);
    return at;
  }
  const std::size_t middle = Halve(members, begin, end,
    [&](std::int32_t e) { return Centroid(elements.GetPatches()[e].Corners); });
  const std::int32_t left = this->BuildElements(members, begin, middle, elements);
  const std::int32_t right = this->BuildElements(members, middle, end, elements);
  this->Join(at, left, right);
  return at;
}

void PatchTree::MakeLeaf(std::int32_t at, const Patch& patch)
{
  const auto place = static_cast<std::int32_t>(this->Shapes.size());
  this->Shapes.emplace_back(patch.Corners);
  this->Triangles.push_back(patch.Triangle);
  const ExchangePatch& shape = this->Shapes.back();
  this->AreaBefore.push_back(this->AreaBefore.back() + shape.Area);
  Node& node = this->Nodes[at];
  node.Begin = place;
  node.End = place + 1;
  node.FirstGroup = node.LastGroup = static_cast<std::int32_t>(this->Names.size()) - 1;
  node.Corners = static_cast<std::int32_t>(this->Corners.size());
  for (const Vec3& c : patch.Corners)
  {
    node.Box.Add(c);
    this->Corners.push_back(c);
  }
  node.CornersEnd = static_cast<std::int32_t>(this->Corners.size());
  node.Center = shape.Center;
  node.Radius = shape.Radius;
  node.Axis = shape.Normal;
  node.Area = shape.Area;
  node.Flat = true;
}

void PatchTree::Join(std::int32_t at, std::int32_t left, std::int32_t right)
{
  const Node& a = this->Nodes[left];
  const Node& b = this->Nodes[right];
  Node& node = this->Nodes[at];
  node.Left = left;
  node.Right = right;
  node.Begin = a.Begin;
  node.End = b.End;
  node.FirstGroup = a.FirstGroup;
  node.LastGroup = b.LastGroup;
  node.Box = a.Box;
  node.Box.Add(b.Box);
  node.Center = node.Box.Center();
  node.Radius = 0.5 * Length(node.Box.Size());
  node.Area = a.Area + b.Area;
  const double size = 2.0 * node.Radius;
  node.Flat = a.Flat && b.Flat && Dot(a.Axis, b.Axis) > 1.0 - 1e-14 &&
    std::abs(Dot(a.Axis, b.Center - a.Center)) <= 1e-13 * size &&
    std::abs(Dot(b.Axis, b.Center - a.Center)) <= 1e-13 * size;
  if (node.Flat)
  {
    node.Axis = a.Area >= b.Area ? a.Axis : b.Axis;
    node.Center = a.Center + (b.Area / node.Area) * (b.Center - a.Center);
    std::vector<Vec3> corners = this->Outline(a);
    const std::vector<Vec3> more = this->Outline(b);
    corners.insert(corners.end(), more.begin(), more.end());
    corners = radiometry::Outline(corners, node.Axis, MostCorners);
    node.Flat = corners.size() >= 3;
    node.Radius = 0.0;
    node.Corners = static_cast<std::int32_t>(this->Corners.size());
    for (const Vec3& c : corners)
    {
      this->Corners.push_back(c);
      node.Radius = std::max(node.Radius, Length(c - node.Center));
    }
    node.CornersEnd = static_cast<std::int32_t>(this->Corners.size());
  }
  if (!node.Flat)
  {
    node.Center = node.Box.Center();
    node.Radius = 0.5 * Length(node.Box.Size());
    const Vec3 sum = a.Area * a.Axis + b.Area * b.Axis;
    node.Axis = Normalized(sum);
    const auto reach = [&](const Node& child) {
      return child.Spread + std::acos(std::clamp(Dot(node.Axis, child.Axis), -1.0, 1.0));
    };
    node.Spread = node.Axis == Vec3{} ? Pi : std::min(Pi, std::max(reach(a), reach(b)));
  }
}

std::int32_t PatchTree::Pick(const Node& node, double& share) const
{
  if (node.Single())
  {
    return node.Begin;
  }
  const auto first = this->AreaBefore.begin();
  const double before = this->AreaBefore[node.Begin];
  const double target = before + share * (this->AreaBefore[node.End] - before);
  const auto found = std::upper_bound(first + node.Begin + 1, first + node.End, target);
  const auto element = static_cast<std::int32_t>(found - first) - 1;
  const double width = this->AreaBefore[element + 1] - this->AreaBefore[element];
  share =
    width > 0.0 ? std::clamp((target - this->AreaBefore[element]) / width, 0.0, 1.0 - 1e-12) : 0.5;
  return element;
}

bool PatchTree::MayFace(const Node& a, const Node& b) const
{
  if (a.Flat && Highest(b.Box, a) <= 1e-13 * (a.Radius + b.Radius))
  {
    return false;
  }
  if (b.Flat && Highest(a.Box, b) <= 1e-13 * (a.Radius + b.Radius))
  {
    return false;
  }
  if (a.Flat && b.Flat)
  {
    return true;
  }
  const Vec3 d = b.Center - a.Center;
  const double distance = Length(d);
  const double reach = a.Radius + b.Radius;
  if (!(distance > reach))
  {
    return true;
  }
  const double beta = std::asin(std::min(1.0, reach / distance)) + 1e-9;
  const auto away = [&](const Node& node, double sign) {
    const double angle = std::acos(std::clamp(sign * Dot(node.Axis, d) / distance, -1.0, 1.0));
    return angle - node.Spread - beta >= 0.5 * Pi;
  };
  return !away(a, 1.0) && !away(b, -1.0);
}

} // namespace radiometry
