// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/ClosedSurfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace radiometry
{
namespace
{

/// An edge of a triangle, its points in ascending order.
struct Edge
{
  std::int32_t Low, High, Triangle;
  bool Upward; // the triangle runs from Low to High

  bool operator<(const Edge& o) const
  {
    return Low != o.Low ? Low < o.Low : (High != o.High ? High < o.High : Triangle < o.Triangle);
  }
  bool Same(const Edge& o) const { return Low == o.Low && High == o.High; }
};

} // namespace

ClosedSurfaces::ClosedSurfaces(const Scene& scene)
  : Geometry(scene)
  , Inward(scene.Triangles.size(), 0)
{
  const std::size_t count = scene.Triangles.size();
  std::vector<Edge> edges;
  edges.reserve(3 * count);
  for (std::size_t t = 0; t < count; ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t a = scene.Triangles[t][k];
      const std::int32_t b = scene.Triangles[t][(k + 1) % 3];
      edges.push_back({ std::min(a, b), std::max(a, b), static_cast<std::int32_t>(t), a < b });
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::array<std::int32_t, 3>> neighbours(count, { -1, -1, -1 });
  std::vector<std::uint8_t> open(count, 0);
  for (std::size_t i = 0; i < edges.size();)
  {
    std::size_t j = i + 1;
    while (j < edges.size() && edges[j].Same(edges[i]))
    {
      ++j;
    }
    const bool shared = j == i + 2 && edges[i].Upward != edges[i + 1].Upward;
    for (std::size_t k = i; k < j; ++k)
    {
      const std::int32_t t = edges[k].Triangle;
      auto& around = neighbours[t];
      shared ? void(*std::find(around.begin(), around.end(), -1) = edges[k == i ? j - 1 : i].Triangle)
             : void(open[t] = 1);
    }
    i = j;
  }

  // Component by component: closed when none of its triangles is open.
  std::vector<std::uint8_t> seen(count, 0);
  std::vector<std::int32_t> members;
  for (std::size_t first = 0; first < count; ++first)
  {
    if (seen[first])
    {
      continue;
    }
    members.assign(1, static_cast<std::int32_t>(first));
    seen[first] = 1;
    bool closed = true;
    for (std::size_t k = 0; k < members.size(); ++k)
    {
      closed = closed && !open[members[k]];
      for (const std::int32_t next : neighbours[members[k]])
      {
        if (next >= 0 && !seen[next])
        {
          seen[next] = 1;
          members.push_back(next);
        }
      }
    }
    double volume = 0.0;
    double scale = 0.0;
    const Vec3 origin = scene.TriangleAt(first)[0];
    for (const std::int32_t t : members)
    {
      const Triangle3 v = scene.TriangleAt(static_cast<std::size_t>(t));
      const double part = Dot(v[0] - origin, Cross(v[1] - origin, v[2] - origin));
      volume += part;
      scale += std::fabs(part);
    }
    const bool flat = !(std::fabs(volume) > 1e-9 * scale);
    for (const std::int32_t t : members)
    {
      this->Inward[t] =
        static_cast<std::int8_t>(!closed || flat ? 0 : (volume < 0.0 ? 1 : -1));
    }
  }
}

bool ClosedSurfaces::Encloses(std::int32_t triangle, const Vec3& normal) const
{
  if (triangle < 0 || this->Inward[triangle] == 0)
  {
    return false;
  }
  const double side =
    Dot(AreaNormal2(this->Geometry.TriangleAt(static_cast<std::size_t>(triangle))), normal);
  return this->Inward[triangle] * side > 0.0;
}

bool ClosedSurfaces::Encloses(const Patch& patch) const
{
  return this->Encloses(patch.Triangle, AreaNormal2(patch.Corners));
}

bool ClosedSurfaces::Encloses(const SurfacePoint& point) const
{
  if (point.Around.empty())
  {
    return this->Encloses(point.Triangle, point.Normal);
  }
  return std::all_of(point.Around.begin(), point.Around.end(),
    [&](std::int32_t t) { return this->Encloses(t, point.Normal); });
}

} // namespace radiometry
