// SPDX-License-Identifier: BSD-3-Clause
//
// ShadowLines: where triangles cut through one another.
#include "radiometry/visibility/ShadowLines.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

bool Overlap(const Box3& a, const Box3& b)
{
  return a.Min.x <= b.Max.x && a.Max.x >= b.Min.x && a.Min.y <= b.Max.y && a.Max.y >= b.Min.y &&
    a.Min.z <= b.Max.z && a.Max.z >= b.Min.z;
}

/// The line at which `other` cuts through the plane of `receiver` or stands on it with an edge,
/// when that line touches the receiver and is there more than a point. `foot` gets the number of
/// that edge, or -1 where it is cut through.
bool CrossingLine(const Triangle3& receiver, const Vec3& n, const Triangle3& other, double rounding,
  int& foot, Segment3& line)
{
  double h[3];
  bool above = false;
  bool below = false;
  for (int k = 0; k < 3; ++k)
  {
    h[k] = Dot(n, other[k] - receiver[0]);
    above = above || h[k] > rounding;
    below = below || h[k] < -rounding;
  }
  const bool through = above && below;
  foot = -1;
  for (int k = 0; k < 3 && !through && (above || below); ++k)
  {
    foot = std::fabs(h[k]) <= rounding && std::fabs(h[(k + 1) % 3]) <= rounding ? k : foot;
  }
  if (!through && foot < 0)
  {
    return false; // beside the plane, or touching it in a point or all over
  }
  Vec3 ends[3];
  int count = 0;
  for (int k = 0; k < 3 && count < 2; ++k)
  {
    const double a = h[k];
    const double b = h[(k + 1) % 3];
    if (through && (a > 0.0) != (b > 0.0))
    {
      ends[count++] = other[k] + (a / (a - b)) * (other[(k + 1) % 3] - other[k]);
    }
    else if (!through && (k == foot || k == (foot + 1) % 3))
    {
      ends[count++] = other[k];
    }
  }
  if (count < 2)
  {
    return false;
  }
  line = { ends[0], ends[1] };
  // Within the receiver's sides, a little outside included; a mere point (a common corner) is none.
  SegmentPart part;
  for (int k = 0; k < 3; ++k)
  {
    const Vec3 side = receiver[(k + 1) % 3] - receiver[k];
    const Vec3 inward = Cross(n, side) / std::sqrt(LengthSquared(side));
    const double a = Dot(inward, line.A - receiver[k]) + 4.0 * rounding;
    const double b = Dot(inward, line.B - receiver[k]) + 4.0 * rounding;
    if (!part.Keep(a, b))
    {
      return false;
    }
  }
  return (part.End - part.Begin) * std::sqrt(LengthSquared(line.B - line.A)) > 32.0 * rounding;
}

/// The triangles of a leaf, gathered.
struct Leaf
{
  static constexpr int Most = BoxTree::LeafSize;
  std::int32_t Node = -1;
  int Count = 0;
  std::int32_t Id[Most];
  Triangle3 Triangles[Most];
  Box3 Boxes[Most];
  Vec3 Normals[Most]; // unit

  void Load(const Scene& scene, const BoxTree& tree, std::int32_t node)
  {
    if (node == this->Node)
    {
      return;
    }
    this->Node = node;
    this->Count = tree.At(node).Count;
    for (int k = 0; k < this->Count; ++k)
    {
      this->Id[k] = tree.Order()[tree.At(node).First + k];
      this->Triangles[k] = scene.TriangleAt(this->Id[k]);
      this->Boxes[k] = {};
      for (const Vec3& p : this->Triangles[k])
      {
        this->Boxes[k].Add(p);
      }
      const Vec3 area2 = AreaNormal2(this->Triangles[k]);
      const double l2 = LengthSquared(area2);
      this->Normals[k] =
        l2 > 1e-280 && l2 < 1e280 ? area2 / std::sqrt(l2) : Normalized(area2);
    }
  }
};

} // namespace

/// True when a surface that stands on a plane with this edge goes on beyond the plane: then it may be
/// neither seen to cut through the plane nor a silhouette. (What ends there is one always.)
bool ShadowLines::GoesOn(
  const Scene& scene, const Vec3& through, const Vec3& normal, std::int32_t edge) const
{
  const std::int32_t twin = this->Twins[edge];
  if (twin < 0 || !this->Owns(static_cast<std::size_t>(edge)))
  {
    return false;
  }
  const auto height = [&](std::int32_t e) {
    return Dot(normal, scene.Points[scene.Triangles[e / 3][(e % 3 + 2) % 3]] - through);
  };
  const double here = height(edge);
  const double beyond = height(twin);
  return (here > 0.0) != (beyond > 0.0) && std::fabs(beyond) > this->Rounding;
}

/// The tree against itself: each of its parts of some hundred triangles against all of it.
void ShadowLines::FindCrossings(
  const Scene& scene, int threads, const StageProgress& stage)
{
  const BoxTree& tree = this->Tree;
  if (tree.Empty())
  {
    return;
  }
  std::vector<std::int32_t> parts;
  const auto collect = [&](const auto& self, std::int32_t at, int depth) -> void {
    const BoxTree::Node& node = tree.At(at);
    if (node.Count > 0 || depth == 11)
    {
      parts.push_back(at);
      return;
    }
    self(self, at + 1, depth + 1);
    self(self, node.First, depth + 1);
  };
  collect(collect, 0, 0);

  struct Found
  {
    std::int32_t Receiver;
    Segment3 Line;
  };
  std::vector<std::vector<Found>> found(parts.size());
  const auto search = [&](std::size_t part) {
    Leaf receivers; // kept while the search goes through what may cut them
    // Of the others each is met some ten times, by neighbours one after the other.
    constexpr std::int32_t kept = 256;
    static thread_local std::vector<Leaf> cache(kept);
    for (Leaf& leaf : cache)
    {
      leaf.Node = -1; // of another scene, maybe
    }
    const auto pair = [&](const auto& self, std::int32_t a, std::int32_t b) -> void {
      const BoxTree::Node& na = tree.At(a);
      const BoxTree::Node& nb = tree.At(b);
      if (!Overlap(na.Bounds, nb.Bounds))
      {
        return;
      }
      const bool split = na.Count == 0 &&
        (nb.Count > 0 || LengthSquared(na.Bounds.Size()) > LengthSquared(nb.Bounds.Size()));
      if (split)
      {
        self(self, a + 1, b);
        self(self, na.First, b);
        return;
      }
      if (nb.Count == 0)
      {
        self(self, a, b + 1);
        self(self, a, nb.First);
        return;
      }
      receivers.Load(scene, tree, a);
      Leaf& others = cache[b / 2 % kept];
      others.Load(scene, tree, b);
      for (int i = 0; i < receivers.Count; ++i)
      {
        const std::int32_t r = receivers.Id[i];
        if (static_cast<std::size_t>(r) >= scene.ReceiverTriangles)
        {
          continue;
        }
        const Vec3& n = receivers.Normals[i];
        for (int j = 0; j < others.Count; ++j)
        {
          const std::int32_t t = others.Id[j];
          Segment3 line;
          int foot = -1;
          if (t != r && Overlap(receivers.Boxes[i], others.Boxes[j]) &&
            CrossingLine(
              receivers.Triangles[i], n, others.Triangles[j], this->Rounding, foot, line) &&
            (foot < 0 || this->GoesOn(scene, receivers.Triangles[i][0], n, 3 * t + foot)))
          {
            found[part].push_back({ r, line });
          }
        }
      }
    };
    pair(pair, parts[part], 0);
  };
  ParallelFor(parts.size(), threads, stage, search, 1e-4);
  for (std::vector<Found>& list : found)
  {
    for (const Found& f : list)
    {
      this->Cut[f.Receiver].push_back(f.Line);
    }
  }
  if (!this->Cut.empty())
  {
    this->IsCut.assign(scene.Triangles.size(), 0);
  }
  for (const auto& cut : this->Cut)
  {
    this->IsCut[cut.first] = 1;
  }
}

} // namespace radiometry
