// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/Silhouettes.h"

#include <algorithm>

namespace radiometry
{
Silhouettes::Silhouettes(const Scene& scene, const ShadowLines& lines, const Light& light)
  : Directional(light.Type == LightType::Directional)
  , Position(light.Position)
  , Direction(light.Direction)
  , Tolerance(lines.Tolerance())
{
  std::vector<Box3> boxes;
  for (const ShadowLines::Edge& e : lines.Edges)
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

} // namespace radiometry
