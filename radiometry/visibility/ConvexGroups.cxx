// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/ConvexGroups.h"

#include "radiometry/geometry/ConvexPolygon.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace radiometry
{
namespace
{

/// Of a body's size: single precision.
constexpr double SinglePrecision = 3e-7;
constexpr std::size_t MostWork = 100000000;

/// Sets that are joined; the least member stands for each.
class Sets
{
public:
  explicit Sets(std::size_t n)
    : Parent(n)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), 0);
  }
  std::int32_t Find(std::int32_t i)
  {
    while (this->Parent[i] != i)
    {
      this->Parent[i] = this->Parent[this->Parent[i]];
      i = this->Parent[i];
    }
    return i;
  }
  void Join(std::int32_t a, std::int32_t b)
  {
    a = this->Find(a);
    b = this->Find(b);
    this->Parent[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<std::int32_t> Parent;
};

bool Opaque(const Scene& scene, std::size_t t)
{
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  for (std::size_t b = 0; b < bands && !scene.TriangleTransmittance.empty(); ++b)
  {
    if (scene.TriangleTransmittance[t * bands + b] > 0.0)
    {
      return false;
    }
  }
  return true;
}

/// Calls make(members) for each set of at least two.
template <class F>
void ForEachSet(Sets& sets, std::size_t n, F&& make)
{
  std::vector<std::pair<std::int32_t, std::int32_t>> members(n); // set, triangle
  for (std::size_t t = 0; t < n; ++t)
  {
    members[t] = { sets.Find(static_cast<std::int32_t>(t)), static_cast<std::int32_t>(t) };
  }
  std::sort(members.begin(), members.end());
  std::vector<std::int32_t> triangles;
  for (std::size_t first = 0; first < n;)
  {
    std::size_t last = first;
    triangles.clear();
    for (; last < n && members[last].first == members[first].first; ++last)
    {
      triangles.push_back(members[last].second);
    }
    if (triangles.size() > 1)
    {
      make(triangles);
    }
    first = last;
  }
}

void Describe(const Scene& scene, ConvexGroup& group)
{
  for (const std::int32_t t : group.Triangles)
  {
    for (const std::int32_t p : scene.Triangles[t])
    {
      group.Corners.push_back(scene.Points[p]);
      group.Box.Add(scene.Points[p]);
    }
  }
  const auto less = [](const Vec3& a, const Vec3& b) {
    return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
  };
  std::sort(group.Corners.begin(), group.Corners.end(), less);
  group.Corners.erase(
    std::unique(group.Corners.begin(), group.Corners.end()), group.Corners.end());
  for (const Vec3& c : group.Corners)
  {
    group.Middle += c / static_cast<double>(group.Corners.size());
  }
}

} // namespace

ConvexGroups::ConvexGroups(const Scene& scene,
  const std::vector<std::array<std::int32_t, 3>>& edges, std::size_t edgeCount, double rounding)
  : GroupOf(scene.Triangles.size(), -1)
{
  const std::size_t n = scene.Triangles.size();
  // The two triangles of each edge; more or fewer: the edge joins nothing.
  std::vector<std::array<std::int32_t, 2>> sides(edgeCount, { -1, -1 });
  std::vector<std::uint8_t> uses(edgeCount, 0);
  for (std::size_t t = 0; t < n; ++t)
  {
    for (const std::int32_t e : edges[t])
    {
      if (uses[e] < 2)
      {
        sides[e][uses[e]] = static_cast<std::int32_t>(t);
      }
      uses[e] = static_cast<std::uint8_t>(std::min(3, uses[e] + 1));
    }
  }
  Sets bodies(n);
  std::vector<std::uint8_t> closed(n, 1);
  for (std::size_t e = 0; e < edgeCount; ++e)
  {
    if (uses[e] == 2)
    {
      bodies.Join(sides[e][0], sides[e][1]);
    }
  }
  for (std::size_t t = 0; t < n; ++t)
  {
    bool whole = Opaque(scene, t);
    for (const std::int32_t e : edges[t])
    {
      whole = whole && uses[e] == 2;
    }
    if (!whole)
    {
      closed[bodies.Find(static_cast<std::int32_t>(t))] = 0;
    }
  }
  const auto keep = [&](ConvexGroup&& group) {
    for (const std::int32_t t : group.Triangles)
    {
      this->GroupOf[t] = static_cast<std::int32_t>(this->Groups.size());
    }
    this->Groups.push_back(std::move(group));
  };
  std::size_t work = 0;
  ForEachSet(bodies, n, [&](const std::vector<std::int32_t>& triangles) {
    work += triangles.size() * triangles.size() / 2;
    if (!closed[bodies.Find(triangles[0])] || triangles.size() < 4 || work > MostWork)
    {
      work -= triangles.size() * triangles.size() / 2;
      return;
    }
    ConvexGroup group;
    group.Triangles = triangles;
    Describe(scene, group);
    for (std::size_t f = 0; f < triangles.size(); ++f)
    {
      for (int k = 0; k < 3; ++k)
      {
        const std::int32_t e = edges[triangles[f]][k];
        if (sides[e][0] == triangles[f])
        {
          const auto other =
            std::lower_bound(triangles.begin(), triangles.end(), sides[e][1]) - triangles.begin();
          const auto& v = scene.Triangles[triangles[f]];
          group.Edges.push_back({ scene.Points[v[k]], scene.Points[v[(k + 1) % 3]],
            { static_cast<std::int32_t>(f), static_cast<std::int32_t>(other) } });
        }
      }
    }
    if (this->MakeBody(scene, group))
    {
      keep(std::move(group));
    }
  });

  // Sheets: neighbours in one plane, not folded over.
  Sets flat(n);
  for (std::size_t e = 0; e < edgeCount; ++e)
  {
    const std::int32_t a = sides[e][0], b = sides[e][1];
    if (uses[e] != 2 || this->GroupOf[a] >= 0 || this->GroupOf[b] >= 0 ||
      !Opaque(scene, static_cast<std::size_t>(a)) || !Opaque(scene, static_cast<std::size_t>(b)))
    {
      continue;
    }
    const Triangle3 ta = scene.TriangleAt(a), tb = scene.TriangleAt(b);
    const Vec3 na = Normalized(AreaNormal2(ta));
    bool level = true;
    for (const Vec3& p : tb)
    {
      level = level && std::fabs(Dot(na, p - ta[0])) <= rounding;
    }
    if (level)
    {
      flat.Join(a, b);
    }
  }
  ForEachSet(flat, n, [&](const std::vector<std::int32_t>& triangles) {
    ConvexGroup group;
    group.Triangles = triangles;
    Describe(scene, group);
    if (this->MakeSheet(scene, rounding, group))
    {
      keep(std::move(group));
    }
  });
}

/// True where all corners lie behind all faces.
bool ConvexGroups::MakeBody(const Scene& scene, ConvexGroup& group) const
{
  const Vec3 size = group.Box.Size();
  const double allowed = SinglePrecision * std::max({ size.x, size.y, size.z });
  const auto plane = [&](std::int32_t t, Vec3& through) {
    const Triangle3 v = scene.TriangleAt(static_cast<std::size_t>(t));
    through = v[0];
    return Normalized(AreaNormal2(v));
  };
  Vec3 through;
  const Vec3 first = plane(group.Triangles[0], through);
  const double outward = Dot(first, group.Middle - through) < 0.0 ? 1.0 : -1.0;
  for (const std::int32_t t : group.Triangles)
  {
    const Vec3 n = outward * plane(t, through);
    if (!(Dot(n, group.Middle - through) < -allowed))
    {
      return false;
    }
    for (const Vec3& p : group.Corners)
    {
      if (Dot(n, p - through) > allowed)
      {
        return false;
      }
    }
    group.Faces.push_back({ n, Dot(n, through) });
  }
  return true;
}

/// True where the hull of the corners has the area of the triangles.
bool ConvexGroups::MakeSheet(const Scene& scene, double rounding, ConvexGroup& group) const
{
  double area = 0.0;
  double largest = 0.0;
  Vec3 through;
  for (const std::int32_t t : group.Triangles)
  {
    const Triangle3 v = scene.TriangleAt(static_cast<std::size_t>(t));
    const Vec3 n = AreaNormal2(v);
    const double a = 0.5 * Length(n);
    area += a;
    if (a > largest)
    {
      largest = a;
      group.Normal = Normalized(n);
      through = v[0];
    }
  }
  for (const Vec3& p : group.Corners)
  {
    if (std::fabs(Dot(group.Normal, p - through)) > 2.0 * rounding)
    {
      return false;
    }
  }
  const std::vector<Vec3> rim = Outline(group.Corners, group.Normal, group.Corners.size());
  constexpr std::size_t mostCorners = 12;
  if (rim.size() < 3 || rim.size() > mostCorners ||
    std::fabs(0.5 * Length(AreaNormal2(rim.data(), rim.size())) - area) > 1e-10 * area)
  {
    return false;
  }
  group.Rim = rim;
  return true;
}

} // namespace radiometry
