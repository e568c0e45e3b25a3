// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/Silhouettes.h"

#include "radiometry/scene/Parallel.h"

#include <algorithm>
#include <tuple>

namespace radiometry
{
namespace
{

/// Greatest coordinate of the scene in its recentred frame.
double Extent(const Scene& scene)
{
  double extent = 0.0;
  for (const Vec3& p : scene.Points)
  {
    extent = std::max({ extent, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z) });
  }
  return extent;
}

/// Rounding of coordinates that large, with a little room.
constexpr double RoundingUnits = 2e-14;

} // namespace

MeshEdges::MeshEdges(const Scene& scene)
{
  struct Half
  {
    std::int32_t A, B, Opposite;
  };
  std::vector<Half> halves;
  halves.reserve(3 * scene.Triangles.size());
  for (const auto& t : scene.Triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t a = t[k];
      const std::int32_t b = t[(k + 1) % 3];
      halves.push_back({ std::min(a, b), std::max(a, b), t[(k + 2) % 3] });
    }
  }
  std::sort(halves.begin(), halves.end(), [](const Half& x, const Half& y) {
    return std::tie(x.A, x.B, x.Opposite) < std::tie(y.A, y.B, y.Opposite);
  });
  // Duplicate triangles count once: their shadow is one.
  halves.erase(std::unique(halves.begin(), halves.end(),
                 [](const Half& x, const Half& y) {
                   return x.A == y.A && x.B == y.B && x.Opposite == y.Opposite;
                 }),
    halves.end());
  for (std::size_t i = 0; i < halves.size();)
  {
    std::size_t j = i + 1;
    while (j < halves.size() && halves[j].A == halves[i].A && halves[j].B == halves[i].B)
    {
      ++j;
    }
    this->Edges.push_back({ halves[i].A, halves[i].B,
      { halves[i].Opposite, j - i > 1 ? halves[i + 1].Opposite : -1 }, j - i <= 2 });
    i = j;
  }
}

Silhouettes::Silhouettes(const Scene& scene, const MeshEdges& edges, const Light& light)
  : Directional(light.Type == LightType::Directional)
  , Position(light.Position)
  , Direction(light.Direction)
  , Tolerance(RoundingUnits * Extent(scene))
{
  std::vector<Box3> boxes;
  for (const MeshEdges::Edge& e : edges.Edges)
  {
    const Vec3& a = scene.Points[e.A];
    const Vec3& b = scene.Points[e.B];
    bool silhouette = !e.Manifold || e.Opposite[1] < 0;
    if (!silhouette)
    {
      // The plane through the light and the edge; silhouette unless it parts the two triangles.
      const Vec3 toLight = this->Directional ? -this->Direction : this->Position - a;
      const Vec3 n = Normalized(Cross(b - a, toLight));
      const double s0 = Dot(n, scene.Points[e.Opposite[0]] - a);
      const double s1 = Dot(n, scene.Points[e.Opposite[1]] - a);
      const bool parted = (s0 > this->Tolerance && s1 < -this->Tolerance) ||
        (s0 < -this->Tolerance && s1 > this->Tolerance);
      silhouette = !parted;
    }
    if (silhouette)
    {
      Box3 box;
      box.Add(a);
      box.Add(b);
      boxes.push_back(box);
      this->Segments.push_back({ a, b });
    }
  }
  this->Tree = BoxTree(boxes);
}

/// The convex hull of a triangle and the light: inside where every plane is positive.
struct Silhouettes::Shaft
{
  Vec3 Normal[4];
  double Offset[4]; // inside: Normal . x + Offset > threshold
  int Planes = 0;

  void Add(const Vec3& normal, const Vec3& through, double threshold)
  {
    this->Normal[this->Planes] = normal;
    this->Offset[this->Planes] = -Dot(normal, through) - threshold;
    ++this->Planes;
  }
  bool Reaches(const Box3& box) const
  {
    for (int k = 0; k < this->Planes; ++k)
    {
      const Vec3& n = this->Normal[k];
      const double most = n.x * (n.x > 0 ? box.Max.x : box.Min.x) +
        n.y * (n.y > 0 ? box.Max.y : box.Min.y) + n.z * (n.z > 0 ? box.Max.z : box.Min.z);
      if (most + this->Offset[k] <= 0.0)
      {
        return false;
      }
    }
    return true;
  }
  bool Touches(const Segment3& s) const
  {
    double lo = 0.0;
    double hi = 1.0;
    for (int k = 0; k < this->Planes; ++k)
    {
      const double a = Dot(this->Normal[k], s.A) + this->Offset[k];
      const double b = Dot(this->Normal[k], s.B) + this->Offset[k];
      if (a <= 0.0 && b <= 0.0)
      {
        return false;
      }
      if (a <= 0.0)
      {
        lo = std::max(lo, a / (a - b));
      }
      else if (b <= 0.0)
      {
        hi = std::min(hi, a / (a - b));
      }
    }
    return lo < hi;
  }
};

Silhouettes::Shaft Silhouettes::MakeShaft(const Triangle3& t) const
{
  Shaft shaft;
  const Vec3 normal = Normalized(AreaNormal2(t));
  // What lies on the receiver's own plane inside the triangle counts (a box standing on a floor),
  // what lies along the shaft's sides does not (the receiver's own rim).
  shaft.Add(normal, t[0], -this->Tolerance);
  for (int k = 0; k < 3; ++k)
  {
    const Vec3& a = t[k];
    const Vec3& b = t[(k + 1) % 3];
    const Vec3 toLight = this->Directional ? -this->Direction : this->Position - a;
    shaft.Add(Normalized(Cross(toLight, b - a)), a, this->Tolerance);
  }
  return shaft;
}

bool Silhouettes::InShaft(
  const Triangle3& triangle, std::size_t most, std::vector<Segment3>& found) const
{
  const Shaft shaft = this->MakeShaft(triangle);
  std::size_t count = 0;
  return this->Tree.Visit([&](const Box3& box) { return shaft.Reaches(box); },
    [&](std::int32_t s) {
      if (shaft.Touches(this->Segments[s]))
      {
        if (count++ == most)
        {
          return false;
        }
        found.push_back(this->Segments[s]);
      }
      return true;
    });
}

void Silhouettes::Narrow(const Triangle3& triangle, const std::vector<Segment3>& candidates,
  std::vector<Segment3>& found) const
{
  const Shaft shaft = this->MakeShaft(triangle);
  for (const Segment3& s : candidates)
  {
    if (shaft.Touches(s))
    {
      found.push_back(s);
    }
  }
}

std::vector<std::vector<Segment3>> FindIntersections(
  const Scene& scene, int threads, const StageProgress& stage)
{
  const std::size_t count = scene.Triangles.size();
  std::vector<Box3> boxes(count);
  for (std::size_t t = 0; t < count; ++t)
  {
    for (const Vec3& p : scene.TriangleAt(t))
    {
      boxes[t].Add(p);
    }
  }
  const BoxTree tree(boxes);
  const double tolerance = RoundingUnits * Extent(scene);

  std::vector<std::vector<Segment3>> result(scene.ReceiverTriangles);
  ParallelFor(
    scene.ReceiverTriangles, threads, stage,
    [&](std::size_t r) {
      const Triangle3 receiver = scene.TriangleAt(r);
      const Vec3 n = Normalized(AreaNormal2(receiver));
      const Box3& mine = boxes[r];
      tree.Visit(
        [&](const Box3& box) {
          for (int a = 0; a < 3; ++a)
          {
            if (box.Min[a] > mine.Max[a] || box.Max[a] < mine.Min[a])
            {
              return false;
            }
          }
          return true;
        },
        [&](std::int32_t t) {
          if (static_cast<std::size_t>(t) == r)
          {
            return true;
          }
          const Triangle3 other = scene.TriangleAt(t);
          double h[3];
          bool above = false;
          bool below = false;
          for (int k = 0; k < 3; ++k)
          {
            h[k] = Dot(n, other[k] - receiver[0]);
            above = above || h[k] > tolerance;
            below = below || h[k] < -tolerance;
          }
          if (!above || !below)
          {
            return true; // beside the plane or only touching it: an edge marks the place
          }
          Vec3 ends[3];
          int found = 0;
          for (int k = 0; k < 3 && found < 2; ++k)
          {
            const double a = h[k];
            const double b = h[(k + 1) % 3];
            if ((a > 0.0) != (b > 0.0))
            {
              ends[found++] = other[k] + (a / (a - b)) * (other[(k + 1) % 3] - other[k]);
            }
          }
          if (found == 2)
          {
            result[r].push_back({ ends[0], ends[1] });
          }
          return true;
        });
    },
    2e-6);
  return result;
}

} // namespace radiometry
