// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/Silhouettes.h"

#include <algorithm>

namespace radiometry
{
namespace
{

/// Rounding in the unit box, with room.
constexpr double TreeRounding = 1e-13;

} // namespace

Silhouettes::Silhouettes(const Scene& scene, const ShadowLines& lines, const Light& light)
  : Geometry(scene)
  , Lines(lines)
  , Source(light)
  , Directional(light.Type == LightType::Directional)
  , InTree(this->Directional ? -light.Direction
                             : lines.Scale * (light.Position - lines.Center))
  , Margin(this->Directional ? TreeRounding
                             : TreeRounding * (1.0 + std::sqrt(LengthSquared(this->InTree))))
{
}

/// True when the light sees all folds below a node from their fronts, or all from their backs: then
/// none of them is a silhouette.
///   n . (p - v) >= cos(spread) a . (p - v) - sin(spread) |p - v| for each normal n in the cone
bool Silhouettes::OneSided(std::int32_t node) const
{
  const ShadowLines::Cone& cone = this->Lines.Cones[node];
  if (cone.CosSpread < 0.0f)
  {
    return false;
  }
  const Vec3 axis{ cone.Axis[0], cone.Axis[1], cone.Axis[2] };
  if (this->Directional)
  {
    return std::fabs(Dot(axis, this->InTree)) * cone.CosSpread - cone.SinSpread > this->Margin;
  }
  const Box3& box = this->Lines.Tree.At(node).Bounds;
  const Vec3 half = 0.5 * box.Size();
  const Vec3 d = this->InTree - box.Center();
  const double reach = std::fabs(axis.x) * half.x + std::fabs(axis.y) * half.y +
    std::fabs(axis.z) * half.z;
  const double least = std::fabs(Dot(axis, d)) - reach;
  if (!(least > 0.0))
  {
    return false;
  }
  const double furthest = std::sqrt(LengthSquared(d)) + std::sqrt(LengthSquared(half));
  return least * cone.CosSpread - cone.SinSpread * furthest > this->Margin;
}

bool Silhouettes::Bounds(std::size_t edge) const
{
  const std::int32_t twin = this->Lines.Across(edge);
  if (twin < 0)
  {
    return twin == ShadowLines::Always;
  }
  // The plane through the light and the edge; silhouette unless it parts the two triangles.
  const Scene& scene = this->Geometry;
  const auto& mine = scene.Triangles[edge / 3];
  const Vec3& a = scene.Points[mine[edge % 3]];
  const Vec3& b = scene.Points[mine[(edge % 3 + 1) % 3]];
  const Vec3 toLight = this->Directional ? -this->Source.Direction : this->Source.Position - a;
  const Vec3 n = Normalized(Cross(b - a, toLight));
  const double tolerance = this->Lines.Tolerance();
  const double s0 = Dot(n, scene.Points[mine[(edge % 3 + 2) % 3]] - a);
  const double s1 = Dot(n, scene.Points[scene.Triangles[twin / 3][(twin % 3 + 2) % 3]] - a);
  const bool parted = (s0 > tolerance && s1 < -tolerance) || (s0 < -tolerance && s1 > tolerance);
  return !parted;
}

bool Silhouettes::InShaft(
  const LightShaft& shaft, std::size_t most, std::vector<Segment3>& found) const
{
  const LightShaft inTree = shaft.Scaled(this->Lines.Center, this->Lines.Scale);
  const Scene& scene = this->Geometry;
  std::size_t count = 0;
  return this->Lines.Tree.VisitNodes(
    [&](std::int32_t node) {
      return inTree.Reaches(this->Lines.Tree.At(node).Bounds) && !this->OneSided(node);
    },
    [&](std::int32_t t) {
      for (std::size_t k = 0; k < 3; ++k)
      {
        const std::size_t edge = 3 * static_cast<std::size_t>(t) + k;
        if (!this->Lines.Owns(edge))
        {
          continue;
        }
        const Segment3 segment{ scene.Points[scene.Triangles[t][k]],
          scene.Points[scene.Triangles[t][(k + 1) % 3]] };
        if (shaft.Touches(segment) && this->Bounds(edge))
        {
          if (count++ == most)
          {
            return false;
          }
          found.push_back(segment);
        }
      }
      return true;
    });
}

bool Silhouettes::InShaft(
  const Triangle3& triangle, std::size_t most, std::vector<Segment3>& found) const
{
  return this->InShaft(
    LightShaft::OfTriangle(triangle, this->Source, this->Lines.Tolerance()), most, found);
}

void Silhouettes::Narrow(const Triangle3& triangle, const std::vector<Segment3>& candidates,
  std::vector<Segment3>& found) const
{
  if (candidates.empty())
  {
    return;
  }
  const LightShaft shaft = LightShaft::OfTriangle(triangle, this->Source, this->Lines.Tolerance());
  for (const Segment3& s : candidates)
  {
    if (shaft.Touches(s))
    {
      found.push_back(s);
    }
  }
}

} // namespace radiometry
