// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ElementSet.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace radiometry
{
namespace
{

std::array<Triangle3, 4> Children(const Triangle3& t)
{
  const Vec3 a = 0.5 * (t[1] + t[2]);
  const Vec3 b = 0.5 * (t[0] + t[2]);
  const Vec3 c = 0.5 * (t[0] + t[1]);
  return { Triangle3{ t[0], c, b }, Triangle3{ c, t[1], a }, Triangle3{ b, a, t[2] },
    Triangle3{ a, b, c } };
}

/// Divisions that bring a triangle below the wanted area.
int Divisions(double area, double wanted)
{
  int depth = 0;
  while (area > wanted && depth < 12)
  {
    area *= 0.25;
    ++depth;
  }
  return depth;
}

/// Whether any band of a cell lets light through diffusely.
bool LetsThrough(const Materials& optics, std::size_t cell)
{
  const auto bands = static_cast<std::size_t>(optics.Bands);
  const std::vector<double>& tau = optics.DiffuseTransmittance;
  return tau.size() >= (cell + 1) * bands &&
    std::any_of(tau.begin() + static_cast<std::ptrdiff_t>(cell * bands),
      tau.begin() + static_cast<std::ptrdiff_t>((cell + 1) * bands),
      [](double share) { return share > 0.0; });
}

/// The triangles at each edge of a surface, found by the edge's lesser vertex.
class EdgeTriangles
{
public:
  using Entry = std::pair<std::int32_t, std::int32_t>; // greater vertex, triangle

  EdgeTriangles(const Scene& scene, std::size_t triangles)
    : Begin(scene.Points.size() + 1, 0)
    , Entries(3 * triangles)
  {
    const auto forEdges = [&](auto&& visit) {
      for (std::size_t t = 0; t < triangles; ++t)
      {
        const auto& v = scene.Triangles[t];
        for (std::size_t k = 0; k < 3; ++k)
        {
          const auto edge = std::minmax(v[k], v[(k + 1) % 3]);
          visit(static_cast<std::size_t>(edge.first), Entry{ edge.second, static_cast<std::int32_t>(t) });
        }
      }
    };
    forEdges([&](std::size_t vertex, const Entry&) { ++this->Begin[vertex + 1]; });
    std::partial_sum(this->Begin.begin(), this->Begin.end(), this->Begin.begin());
    std::vector<std::size_t> next(this->Begin.begin(), this->Begin.end() - 1);
    forEdges([&](std::size_t vertex, const Entry& e) { this->Entries[next[vertex]++] = e; });
    for (std::size_t v = 0; v + 1 < this->Begin.size(); ++v)
    {
      std::sort(this->At(v), this->At(v + 1));
    }
  }
  /// Calls visit(triangle) for each triangle at the edge, in ascending order.
  template <class Visit>
  void ForEach(std::int32_t a, std::int32_t b, Visit&& visit) const
  {
    const auto edge = std::minmax(a, b);
    const auto vertex = static_cast<std::size_t>(edge.first);
    auto it = std::lower_bound(this->At(vertex), this->At(vertex + 1), Entry{ edge.second, -1 });
    for (; it != this->At(vertex + 1) && it->first == edge.second; ++it)
    {
      visit(static_cast<std::size_t>(it->second));
    }
  }

private:
  std::vector<Entry>::iterator At(std::size_t v)
  {
    return this->Entries.begin() + static_cast<std::ptrdiff_t>(this->Begin[v]);
  }
  std::vector<Entry>::const_iterator At(std::size_t v) const
  {
    return this->Entries.begin() + static_cast<std::ptrdiff_t>(this->Begin[v]);
  }
  std::vector<std::size_t> Begin;
  std::vector<Entry> Entries;
};

bool SameRow(const std::vector<double>& values, std::size_t a, std::size_t b, int bands)
{
  if (values.empty())
  {
    return true;
  }
  const auto n = static_cast<std::size_t>(bands);
  return std::equal(values.begin() + static_cast<std::ptrdiff_t>(a * n),
    values.begin() + static_cast<std::ptrdiff_t>((a + 1) * n),
    values.begin() + static_cast<std::ptrdiff_t>(b * n));
}

} // namespace

ElementSet::ElementSet(const Scene& scene, bool backFaces)
{
  this->CellCount = scene.Cells;
  this->Roots.reserve(scene.ReceiverTriangles);
  this->RootCell.reserve(scene.ReceiverTriangles);
  this->Receives.reserve(scene.ReceiverTriangles);
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    const auto cell = static_cast<std::size_t>(scene.TriangleCell[t]);
    const bool back =
      (backFaces && cell < scene.Optics.TwoSided.size() && scene.Optics.TwoSided[cell]) ||
      LetsThrough(scene.Optics, cell);
    this->Roots.push_back(scene.TriangleAt(t));
    this->RootCell.push_back(scene.TriangleCell[t]);
    this->Receives.push_back({ true, back });
  }
  this->Nodes.resize(this->Roots.size());
  this->EmitAll();
}

void ElementSet::Save(ArchiveWriter& archive) const
{
  archive.Put(static_cast<std::uint64_t>(this->CellCount));
  archive.Put(this->Roots);
  archive.Put(this->RootCell);
  archive.Put(this->Receives);
  std::vector<std::int32_t> child;
  child.reserve(this->Nodes.size());
  for (const Node& node : this->Nodes)
  {
    child.push_back(node.Child);
  }
  archive.Put(child);
}

ElementSet ElementSet::Load(ArchiveReader& archive)
{
  ElementSet out;
  out.CellCount = static_cast<std::size_t>(archive.Get<std::uint64_t>());
  archive.Get(out.Roots);
  archive.Get(out.RootCell);
  std::vector<std::array<std::uint8_t, 2>> receives;
  archive.Get(receives);
  std::vector<std::int32_t> child;
  archive.Get(child);
  const std::size_t roots = out.Roots.size();
  bool sound = out.RootCell.size() == roots && receives.size() == roots &&
    child.size() >= roots && (child.size() - roots) % 4 == 0;
  for (const std::int32_t cell : out.RootCell)
  {
    sound = sound && cell >= 0 && static_cast<std::size_t>(cell) < out.CellCount;
  }
  for (const auto& sides : receives)
  {
    sound = sound && sides[0] <= 1 && sides[1] <= 1;
    out.Receives.push_back({ sides[0] != 0, sides[1] != 0 });
  }
  // Every node but the roots is the child of one earlier node.
  out.Nodes.resize(child.size());
  std::vector<std::uint8_t> depth(child.size(), 0);
  std::size_t children = 0;
  for (std::size_t k = 0; k < child.size() && sound; ++k)
  {
    if (child[k] < 0)
    {
      continue;
    }
    const auto first = static_cast<std::size_t>(child[k]);
    sound = first >= roots && first > k && first + 4 <= child.size() && depth[k] < 255 &&
      (first - roots) % 4 == 0 && out.Nodes[first].Parent < 0;
    for (std::size_t c = first; c < first + 4 && sound; ++c)
    {
      out.Nodes[c].Parent = static_cast<std::int32_t>(k);
      depth[c] = static_cast<std::uint8_t>(depth[k] + 1);
      ++children;
    }
    out.Nodes[k].Child = child[k];
  }
  if (!sound || children != child.size() - roots)
  {
    throw std::runtime_error("is damaged: its elements are no divisions of triangles");
  }
  out.EmitAll();
  return out;
}

void ElementSet::EmitAll()
{
  const std::size_t leaves = this->Roots.size() + 3 * (this->Nodes.size() - this->Roots.size()) / 4;
  this->Patches.clear();
  this->Areas.clear();
  this->Depths.clear();
  this->Leaves.clear();
  this->Patches.reserve(leaves);
  this->Areas.reserve(leaves);
  this->Depths.reserve(leaves);
  this->Leaves.reserve(leaves);
  for (std::size_t t = 0; t < this->Roots.size(); ++t)
  {
    const auto triangle = static_cast<std::int32_t>(t);
    this->Emit(triangle, this->Roots[t], triangle, this->RootCell[t], 0);
  }
}

void ElementSet::Emit(
  std::int32_t node, const Triangle3& corners, std::int32_t triangle, std::int32_t cell, int depth)
{
  const std::int32_t first = this->Nodes[static_cast<std::size_t>(node)].Child;
  if (first >= 0)
  {
    const auto children = Children(corners);
    for (int k = 0; k < 4; ++k)
    {
      this->Emit(first + k, children[static_cast<std::size_t>(k)], triangle, cell, depth + 1);
    }
    return;
  }
  for (std::uint8_t side = 0; side < 2; ++side)
  {
    auto& element = this->Nodes[static_cast<std::size_t>(node)].Element[side];
    element = -1;
    if (!this->Receives[static_cast<std::size_t>(triangle)][side])
    {
      continue;
    }
    element = static_cast<std::int32_t>(this->Patches.size());
    Patch patch;
    patch.Corners = side == 0 ? corners : Triangle3{ corners[0], corners[2], corners[1] };
    patch.Triangle = triangle;
    patch.Cell = cell;
    patch.Side = side;
    this->Patches.push_back(patch);
    this->Areas.push_back(Area(corners));
    this->Depths.push_back(static_cast<std::uint8_t>(depth));
    this->Leaves.push_back(node);
  }
}

void ElementSet::DivideNode(std::int32_t node)
{
  this->Nodes[static_cast<std::size_t>(node)].Child = static_cast<std::int32_t>(this->Nodes.size());
  Node child;
  child.Parent = node;
  this->Nodes.resize(this->Nodes.size() + 4, child);
}

ElementSet ElementSet::DividedToArea(double area) const
{
  ElementSet out = *this;
  for (;;)
  {
    std::vector<std::uint8_t> marked(out.Size());
    bool any = false;
    for (std::size_t e = 0; e < out.Size(); ++e)
    {
      marked[e] = out.Areas[e] > area && out.Depths[e] < 12;
      any = any || marked[e];
    }
    if (!any)
    {
      return out;
    }
    out = out.Divided(marked);
  }
}

ElementSet ElementSet::Divided(const std::vector<std::uint8_t>& marked) const
{
  ElementSet out = *this;
  std::int32_t last = -1;
  for (std::size_t e = 0; e < this->Size(); ++e)
  {
    if (marked[e] && this->Leaves[e] != last)
    {
      last = this->Leaves[e];
      if (out.Nodes[static_cast<std::size_t>(last)].Child < 0)
      {
        out.DivideNode(last);
      }
    }
  }
  out.EmitAll();
  return out;
}

std::size_t ElementSet::CountAtArea(double area) const
{
  std::size_t count = 0;
  for (std::size_t e = 0; e < this->Size(); ++e)
  {
    count += std::size_t(1) << (2 * std::min(12, Divisions(this->Areas[e], area)));
  }
  return count;
}

std::int32_t ElementSet::Find(std::int32_t triangle, bool front, double u, double v) const
{
  if (triangle < 0 || static_cast<std::size_t>(triangle) >= this->Roots.size())
  {
    return -1;
  }
  auto node = static_cast<std::size_t>(triangle);
  double w = 1.0 - u - v;
  while (this->Nodes[node].Child >= 0)
  {
    std::size_t child = 3;
    if (w > 0.5)
    {
      child = 0;
      w = 2.0 * w - 1.0;
      u *= 2.0;
      v *= 2.0;
    }
    else if (u > 0.5)
    {
      child = 1;
      w *= 2.0;
      u = 2.0 * u - 1.0;
      v *= 2.0;
    }
    else if (v > 0.5)
    {
      child = 2;
      w *= 2.0;
      u *= 2.0;
      v = 2.0 * v - 1.0;
    }
    else
    {
      w = 1.0 - 2.0 * w;
      u = 1.0 - 2.0 * u;
      v = 1.0 - 2.0 * v;
    }
    node = static_cast<std::size_t>(this->Nodes[node].Child) + child;
  }
  return this->Nodes[node].Element[front ? 0 : 1];
}

std::vector<std::int32_t> ElementSet::RootClusters(
  const Scene& scene, std::size_t side, std::size_t size) const
{
  const std::size_t n = this->Roots.size();
  std::vector<Vec3> normals(n);
  for (std::size_t t = 0; t < n; ++t)
  {
    normals[t] = Normalized(AreaNormal2(this->Roots[t]));
  }
  const EdgeTriangles ofEdge(scene, n);
  const Materials& optics = scene.Optics;
  const double aligned = size <= 4 ? 0.94 : 0.8;
  const auto alike = [&](std::size_t a, std::size_t b) {
    const auto ca = static_cast<std::size_t>(this->RootCell[a]);
    const auto cb = static_cast<std::size_t>(this->RootCell[b]);
    return this->Receives[a][side] == this->Receives[b][side] &&
      Dot(normals[a], normals[b]) > aligned &&
      SameRow(optics.DiffuseReflectance[side], ca, cb, optics.Bands) &&
      SameRow(optics.DiffuseTransmittance, ca, cb, optics.Bands) &&
      SameRow(optics.EmittedExitance[side], ca, cb, optics.Bands);
  };
  std::vector<std::int32_t> cluster(n, -1);
  std::int32_t next = 0;
  std::vector<std::size_t> members;
  for (std::size_t t = 0; t < n; ++t)
  {
    if (cluster[t] >= 0)
    {
      continue;
    }
    members.assign(1, t);
    cluster[t] = next;
    for (std::size_t m = 0; m < members.size() && members.size() < size; ++m)
    {
      const auto& v = scene.Triangles[members[m]];
      for (std::size_t k = 0; k < 3 && members.size() < size; ++k)
      {
        ofEdge.ForEach(v[k], v[(k + 1) % 3], [&](std::size_t o) {
          if (cluster[o] < 0 && members.size() < size && alike(t, o))
          {
            cluster[o] = next;
            members.push_back(o);
          }
        });
      }
    }
    ++next;
  }
  return cluster;
}

std::vector<std::int32_t> ElementSet::Groups(
  const Scene& scene, int levels, std::size_t& count) const
{
  // Clusters of triangles for every number of divisions that is missing. Numbers are given as keys
  // are met: nodes and, for each missing number, clusters, apart for the two sides.
  std::vector<std::array<std::vector<std::int32_t>, 2>> clusters(
    static_cast<std::size_t>(levels) + 1);
  const std::size_t span = 2 * this->Nodes.size();
  std::vector<std::vector<std::int32_t>> number(static_cast<std::size_t>(levels) + 1);
  std::vector<std::int32_t> group(this->Size());
  std::int32_t next = 0;
  for (std::size_t e = 0; e < this->Size(); ++e)
  {
    const std::size_t side = this->Patches[e].Side;
    const auto missing = static_cast<std::size_t>(std::max(0, levels - this->Depths[e]));
    std::int32_t key = this->Leaves[e];
    if (missing == 0)
    {
      for (int k = 0; k < levels; ++k)
      {
        key = this->Nodes[static_cast<std::size_t>(key)].Parent;
      }
    }
    else
    {
      auto& cluster = clusters[missing][side];
      if (cluster.empty())
      {
        cluster = this->RootClusters(scene, side, std::size_t(1) << (2 * missing));
      }
      key = cluster[static_cast<std::size_t>(this->Patches[e].Triangle)];
    }
    number[missing].resize(span, -1);
    std::int32_t& slot = number[missing][2 * static_cast<std::size_t>(key) + side];
    if (slot < 0)
    {
      slot = next++;
    }
    group[e] = slot;
  }
  count = static_cast<std::size_t>(next);
  return group;
}

std::vector<std::int32_t> ElementSet::CellGroups(std::size_t& count) const
{
  std::vector<std::int32_t> number(2 * this->CellCount, -1);
  std::vector<std::int32_t> group(this->Size());
  std::int32_t next = 0;
  for (std::size_t e = 0; e < this->Size(); ++e)
  {
    auto& slot =
      number[2 * static_cast<std::size_t>(this->Patches[e].Cell) + this->Patches[e].Side];
    if (slot < 0)
    {
      slot = next++;
    }
    group[e] = slot;
  }
  count = static_cast<std::size_t>(next);
  return group;
}

} // namespace radiometry
