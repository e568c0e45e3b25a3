// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/Creases.h"

#include "radiometry/geometry/PolygonTriangles.h"

#include <algorithm>
#include <numeric>

namespace radiometry
{
namespace
{

/// A corner of a cell, seen from its point, along one of its two edges there.
struct Spoke
{
  std::int64_t Other; // the point at the edge's other end
  std::size_t Leaf;   // which of the point's corners
};

std::size_t Root(std::vector<std::size_t>& parent, std::size_t k)
{
  while (parent[k] != k)
  {
    parent[k] = parent[parent[k]];
    k = parent[k];
  }
  return k;
}

} // namespace

SplitSurface SplitAtCreases(const std::vector<Vec3>& points,
  const std::vector<std::int64_t>& offsets, const std::vector<std::int64_t>& corners,
  double cosine)
{
  const std::size_t cells = offsets.empty() ? 0 : offsets.size() - 1;
  std::vector<Vec3> normals(cells);
  std::vector<std::int64_t> cellOf(corners.size());
  std::vector<Vec3> polygon;
  for (std::size_t c = 0; c < cells; ++c)
  {
    polygon.clear();
    for (std::int64_t k = offsets[c]; k < offsets[c + 1]; ++k)
    {
      polygon.push_back(points[corners[k]]);
      cellOf[k] = static_cast<std::int64_t>(c);
    }
    normals[c] = PolygonNormal(polygon);
  }

  // The corners at each point, in the cells' order.
  std::vector<std::size_t> first(points.size() + 1, 0);
  for (const std::int64_t p : corners)
  {
    ++first[p + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::size_t> at(corners.size());
  std::vector<std::size_t> fill(first.begin(), first.end() - 1);
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    at[fill[corners[k]]++] = k;
  }

  SplitSurface split;
  split.Source.resize(points.size());
  std::iota(split.Source.begin(), split.Source.end(), std::int64_t{ 0 });
  split.Normals.resize(points.size());
  split.Corners = corners;
  std::vector<Spoke> spokes;
  std::vector<std::size_t> parent;
  std::vector<std::int64_t> pointOf;
  for (std::size_t p = 0; p < points.size(); ++p)
  {
    const std::size_t count = first[p + 1] - first[p];
    const auto cellAt = [&](std::size_t leaf) { return cellOf[at[first[p] + leaf]]; };
    spokes.clear();
    parent.resize(count);
    std::iota(parent.begin(), parent.end(), std::size_t{ 0 });
    for (std::size_t leaf = 0; leaf < count; ++leaf)
    {
      const auto k = static_cast<std::int64_t>(at[first[p] + leaf]);
      const std::int64_t c = cellAt(leaf);
      if (normals[c] == Vec3{})
      {
        continue;
      }
      const std::int64_t next = k + 1 < offsets[c + 1] ? k + 1 : offsets[c];
      const std::int64_t before = k > offsets[c] ? k - 1 : offsets[c + 1] - 1;
      spokes.push_back({ corners[next], leaf });
      spokes.push_back({ corners[before], leaf });
    }
    std::stable_sort(spokes.begin(), spokes.end(),
      [](const Spoke& a, const Spoke& b) { return a.Other < b.Other; });
    for (std::size_t i = 0; i < spokes.size();)
    {
      std::size_t j = i + 1;
      while (j < spokes.size() && spokes[j].Other == spokes[i].Other)
      {
        ++j;
      }
      if (j - i == 2 &&
        Dot(normals[cellAt(spokes[i].Leaf)], normals[cellAt(spokes[i + 1].Leaf)]) > cosine)
      {
        const std::size_t a = Root(parent, spokes[i].Leaf);
        const std::size_t b = Root(parent, spokes[i + 1].Leaf);
        parent[std::max(a, b)] = std::min(a, b);
      }
      i = j;
    }
    // The first sheet keeps the point, the others get copies.
    pointOf.assign(count, -1);
    bool kept = false;
    for (std::size_t leaf = 0; leaf < count; ++leaf)
    {
      const Vec3& normal = normals[cellAt(leaf)];
      if (normal == Vec3{})
      {
        continue;
      }
      std::int64_t& mine = pointOf[Root(parent, leaf)];
      if (mine < 0)
      {
        mine = kept ? static_cast<std::int64_t>(split.Source.size()) : static_cast<std::int64_t>(p);
        if (kept)
        {
          split.Source.push_back(static_cast<std::int64_t>(p));
          split.Normals.push_back({});
        }
        kept = true;
      }
      split.Normals[mine] += normal;
      split.Corners[at[first[p] + leaf]] = mine;
    }
  }
  for (Vec3& normal : split.Normals)
  {
    normal = Normalized(normal);
  }
  return split;
}

} // namespace radiometry
