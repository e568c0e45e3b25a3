// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ElementTree.h"

#include "radiometry/geometry/BoxTree.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <tbb/parallel_invoke.h>

namespace radiometry
{
namespace
{

constexpr double Aligned = 0.82; // cosine of the angle within which normals count as alike
constexpr int Deepest = 48;      // levels after which ranges are halved whatever they are

/// What of a node lies in front of planes about `axis` through the other's farthest point.
bool Behind(const ElementTree::Node& from, const ElementTree::Node& other, double rounding)
{
  const Vec3 d = other.Center - from.Center;
  if (from.Flat())
  {
    const double reach = std::abs(Dot(from.Axis, other.Axis)) * other.Thickness +
      Length(Cross(from.Axis, other.Axis)) * other.Radius;
    const double most =
      LengthSquared(other.Axis) > 0.0 ? std::min(reach, other.Radius) : other.Radius;
    return Dot(from.Axis, d) + most + from.Thickness <= rounding;
  }
  const double distance = Length(d);
  const double sine = (from.Radius + other.Radius) / distance;
  if (!(sine < 1.0) || !(from.Cone > 0.0))
  {
    return false;
  }
  // All directions lie within `spread` of d, all normals within the cone: behind when the angle
  // between d and the axis exceeds 90 degrees by both.
  const double cosine = std::sqrt(1.0 - sine * sine);
  const double coneSine = std::sqrt(1.0 - from.Cone * from.Cone);
  const double cosBoth = from.Cone * cosine - coneSine * sine;
  const double sinBoth = coneSine * cosine + from.Cone * sine;
  return cosBoth > 0.0 && Dot(from.Axis, d) <= -sinBoth * distance;
}

} // namespace

struct ElementTree::Builder
{
  const std::vector<Patch>& Patches;
  const std::vector<double>& Areas;
  std::vector<Vec3> Centers, Normals;
  std::vector<double> Radii;
  std::vector<std::uint8_t> Kinds;
  ElementTree& Tree;

  Builder(const ElementSet& elements, std::vector<std::uint8_t> kinds, ElementTree& tree)
    : Patches(elements.GetPatches())
    , Areas(elements.GetAreas())
    , Kinds(std::move(kinds))
    , Tree(tree)
  {
    const std::size_t n = this->Patches.size();
    this->Centers.resize(n);
    this->Normals.resize(n);
    this->Radii.resize(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      const Triangle3& t = this->Patches[i].Corners;
      this->Centers[i] = Centroid(t);
      this->Normals[i] = Normalized(AreaNormal2(t));
      double r2 = 0.0;
      for (const Vec3& c : t)
      {
        r2 = std::max(r2, LengthSquared(c - this->Centers[i]));
      }
      this->Radii[i] = std::sqrt(r2);
    }
  }

  std::size_t Item(std::int32_t k) const
  {
    return static_cast<std::size_t>(this->Tree.Items[static_cast<std::size_t>(k)]);
  }

  void Summarise(Node& node) const
  {
    const std::int32_t end = node.First + node.Count;
    Vec3 center, normal, plain;
    for (std::int32_t k = node.First; k < end; ++k)
    {
      const std::size_t i = this->Item(k);
      node.Area += this->Areas[i];
      center += this->Areas[i] * this->Centers[i];
      normal += this->Areas[i] * this->Normals[i];
      plain += this->Centers[i];
    }
    if (node.Count == 1)
    {
      node.Center = this->Centers[this->Item(node.First)];
      node.Normal = node.Axis = this->Normals[this->Item(node.First)];
    }
    else
    {
      node.Center = node.Area > 0.0 ? center / node.Area : plain / node.Count;
      node.Normal = node.Area > 0.0 ? normal / node.Area : Vec3{};
      const double length = Length(node.Normal);
      node.Axis = length > 1e-6 ? node.Normal / length : Vec3{};
    }
    double r2 = 0.0;
    for (std::int32_t k = node.First; k < end; ++k)
    {
      const std::size_t i = this->Item(k);
      for (const Vec3& c : this->Patches[i].Corners)
      {
        const Vec3 d = c - node.Center;
        r2 = std::max(r2, LengthSquared(d));
        node.Thickness = std::max(node.Thickness, std::abs(Dot(node.Axis, d)));
      }
      node.Bend = std::max(node.Bend, Length(this->Normals[i] - node.Normal));
      // Nearly equal normals: from the difference, which loses no digits.
      node.Cone = std::min(node.Cone, 1.0 - 0.5 * LengthSquared(this->Normals[i] - node.Axis));
    }
    node.Radius = std::sqrt(r2);
    if (LengthSquared(node.Axis) == 0.0)
    {
      node.Cone = -1.0;
      node.Thickness = node.Radius;
    }
  }

  /// Where to divide [begin, end): the second part's first place.
  std::int32_t Divide(const Node& node, int depth) const
  {
    const auto first = this->Tree.Items.begin() + node.First;
    const auto last = first + node.Count;
    const auto place = [&](auto it) {
      return static_cast<std::int32_t>(it - this->Tree.Items.begin());
    };
    const auto at = [](std::int32_t i) { return static_cast<std::size_t>(i); };
    if (depth < Deepest && node.Cone < Aligned)
    {
      Vec3 mean, square;
      for (auto it = first; it != last; ++it)
      {
        const Vec3& n = this->Normals[at(*it)];
        mean += n;
        square += { n.x * n.x, n.y * n.y, n.z * n.z };
      }
      mean = mean / node.Count;
      const Vec3 spread{ square.x / node.Count - mean.x * mean.x,
        square.y / node.Count - mean.y * mean.y, square.z / node.Count - mean.z * mean.z };
      const int axis = Widest(spread);
      const auto cut = std::partition(
        first, last, [&](std::int32_t i) { return this->Normals[at(i)][axis] < mean[axis]; });
      if (cut != first && cut != last && spread[axis] > 1e-6)
      {
        return place(cut);
      }
    }
    if (!this->Kinds.empty() && depth < Deepest)
    {
      const std::uint8_t kind = this->Kinds[at(*first)];
      const auto cut =
        std::partition(first, last, [&](std::int32_t i) { return this->Kinds[at(i)] == kind; });
      if (cut != last)
      {
        return place(cut);
      }
    }
    double largest = 0.0;
    Box3 box;
    for (auto it = first; it != last; ++it)
    {
      largest = std::max(largest, this->Radii[at(*it)]);
      box.Add(this->Centers[at(*it)]);
    }
    if (depth < Deepest && largest > 0.4 * node.Radius)
    {
      const auto cut = std::partition(
        first, last, [&](std::int32_t i) { return this->Radii[at(i)] < 0.4 * largest; });
      if (cut != first && cut != last)
      {
        return place(cut);
      }
    }
    const int axis = Widest(box.Size());
    if (depth < Deepest)
    {
      const double middle = box.Center()[axis];
      const auto cut = std::partition(
        first, last, [&](std::int32_t i) { return this->Centers[at(i)][axis] < middle; });
      if (std::min(cut - first, last - cut) * 16 >= node.Count)
      {
        return place(cut);
      }
    }
    const auto middle = first + node.Count / 2;
    std::nth_element(first, middle, last, [&](std::int32_t i, std::int32_t j) {
      const double ci = this->Centers[at(i)][axis], cj = this->Centers[at(j)][axis];
      return ci < cj || (ci == cj && i < j);
    });
    return place(middle);
  }

  static int Widest(const Vec3& v) { return v.x >= v.y && v.x >= v.z ? 0 : (v.y >= v.z ? 1 : 2); }

  void Build(
    std::int32_t at, std::int32_t parent, std::int32_t first, std::int32_t count, int depth)
  {
    Node& node = this->Tree.Nodes[static_cast<std::size_t>(at)];
    node.First = first;
    node.Count = count;
    node.Parent = parent;
    this->Summarise(node);
    if (count == 1)
    {
      return;
    }
    const std::int32_t middle = this->Divide(node, depth);
    node.Second = at + 2 * (middle - first);
    const auto below = [this, at, first, middle, depth] {
      this->Build(at + 1, at, first, middle - first, depth + 1);
    };
    const auto above = [this, at, second = node.Second, middle, end = first + count, depth] {
      this->Build(second, at, middle, end - middle, depth + 1);
    };
    if (count > 4096)
    {
      tbb::parallel_invoke(below, above);
    }
    else
    {
      below();
      above();
    }
  }
};

ElementTree::ElementTree(const ElementSet& elements, std::vector<std::uint8_t> kinds)
{
  const std::size_t n = elements.Size();
  if (n == 0)
  {
    return;
  }
  this->Items.resize(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    this->Items[i] = static_cast<std::int32_t>(i);
  }
  this->Nodes.resize(2 * n - 1);
  Builder builder(elements, std::move(kinds), *this);
  builder.Build(0, -1, 0, static_cast<std::int32_t>(n), 0);
  double extent = 0.0;
  for (const Patch& p : elements.GetPatches())
  {
    for (const Vec3& c : p.Corners)
    {
      extent = std::max({ extent, std::abs(c.x), std::abs(c.y), std::abs(c.z) });
    }
  }
  this->Tolerance = 8.0 * std::numeric_limits<double>::epsilon() * extent;
  this->FindSubtrees();
}

void ElementTree::FindSubtrees()
{
  for (std::size_t k = 0; k < this->Nodes.size();)
  {
    const bool small = this->Nodes[k].Count <= 512;
    (small ? this->Small : this->Large).push_back(static_cast<std::int32_t>(k));
    k += small ? 2 * static_cast<std::size_t>(this->Nodes[k].Count) - 1 : 1;
  }
}

void ElementTree::Save(ArchiveWriter& out) const
{
  out.Put(this->Nodes);
  out.Put(this->Items);
  out.Put(this->Tolerance);
}

void ElementTree::Load(ArchiveReader& in)
{
  in.Get(this->Nodes);
  in.Get(this->Items);
  this->Tolerance = in.Get<double>();
  const std::size_t n = this->Items.size();
  bool sound = this->Nodes.size() == (n > 0 ? 2 * n - 1 : 0);
  for (std::size_t k = 0; sound && k < this->Nodes.size(); ++k)
  {
    const Node& node = this->Nodes[k];
    const auto at = static_cast<std::int32_t>(k);
    sound = node.First >= 0 && node.Count >= 1 &&
      static_cast<std::size_t>(node.First) + static_cast<std::size_t>(node.Count) <= n &&
      node.Parent < at && (node.Parent >= 0 || k == 0) && node.Leaf() == (node.Count == 1) &&
      (node.Leaf() ||
        (node.Second > at + 1 && static_cast<std::size_t>(node.Second) < this->Nodes.size())) &&
      k + 2 * static_cast<std::size_t>(node.Count) - 1 <= this->Nodes.size();
  }
  for (const std::int32_t item : this->Items)
  {
    sound = sound && item >= 0 && static_cast<std::size_t>(item) < n;
  }
  if (!sound)
  {
    throw std::runtime_error("is damaged: its tree does not hold together");
  }
  this->FindSubtrees();
}

bool ElementTree::MayFace(std::int32_t a, std::int32_t b) const
{
  const Node& p = (*this)[a];
  const Node& q = (*this)[b];
  return p.Area > 0.0 && q.Area > 0.0 && !Behind(p, q, this->Tolerance) &&
    !Behind(q, p, this->Tolerance);
}

} // namespace radiometry
