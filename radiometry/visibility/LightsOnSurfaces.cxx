// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/LightsOnSurfaces.h"

#include "radiometry/geometry/BoxTree.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

/// Which way a light shines, unit; zero for those that stay where they are.
Vec3 Facing(const Light& light)
{
  switch (light.Type)
  {
    case LightType::Area:
    {
      Vec3 normal;
      for (std::size_t k = 2; k < light.Polygon.size(); ++k)
      {
        normal += Cross(light.Polygon[k - 1] - light.Polygon[0], light.Polygon[k] - light.Polygon[0]);
      }
      return light.TwoSided ? Vec3{} : Normalized(normal);
    }
    case LightType::Spot:
      return light.CosCutoff >= 0.0 ? light.Direction : Vec3{};
    case LightType::Point:
      return light.Web ? light.Direction : Vec3{};
    default:
      return {};
  }
}

/// How far the light has to go along `normal` to come to the plane of a triangle in front of it;
/// 0 where it is there, beyond, or farther than `most`.
double Behind(const std::vector<Vec3>& corners, const Triangle3& t, const Vec3& normal, double most)
{
  double depth = 0.0;
  for (const Vec3& corner : corners)
  {
    const double d = Dot(normal, t[0] - corner);
    if (std::fabs(d) > most)
    {
      return 0.0;
    }
    depth = std::max(depth, d);
  }
  return depth;
}

} // namespace

void BringLightsForward(Scene& scene, double rounding)
{
  if (!(rounding > 0.0))
  {
    return;
  }
  struct Candidate
  {
    Light* Moved;
    Vec3 Axis;
    std::vector<Vec3> Corners;
    Vec3 Move;
    double Farthest = 0.0;
  };
  std::vector<Candidate> candidates;
  std::vector<Box3> boxes;
  const double most = 2.0 * rounding;
  const Vec3 margin{ most, most, most };
  for (Light& light : scene.Lights)
  {
    const Vec3 axis = light.Enabled ? Facing(light) : Vec3{};
    if (axis == Vec3{})
    {
      continue;
    }
    candidates.push_back({ &light, axis,
      light.Type == LightType::Area ? light.Polygon : std::vector<Vec3>{ light.Position }, {} });
    boxes.emplace_back();
    for (const Vec3& corner : candidates.back().Corners)
    {
      boxes.back().Add(corner - margin);
      boxes.back().Add(corner + margin);
    }
  }
  // Lights are few, triangles many: the tree is over the lights.
  const BoxTree tree(boxes);
  for (std::size_t t = 0; t < scene.Triangles.size() && !tree.Empty(); ++t)
  {
    const Triangle3 triangle = scene.TriangleAt(t);
    Box3 bounds;
    for (const Vec3& p : triangle)
    {
      bounds.Add(p);
    }
    const auto meets = [&bounds](const Box3& box) {
      for (int a = 0; a < 3; ++a)
      {
        if (box.Min[a] > bounds.Max[a] || box.Max[a] < bounds.Min[a])
        {
          return false;
        }
      }
      return true;
    };
    tree.Visit(meets, [&](std::int32_t k) {
      Candidate& light = candidates[k];
      if (!meets(boxes[k]))
      {
        return true; // a leaf holds several lights
      }
      const Vec3 n = Normalized(AreaNormal2(triangle));
      const double cosine = Dot(n, light.Axis);
      const double least = light.Moved->Type == LightType::Area ? 1.0 - 1e-6 : 0.5;
      const Vec3 normal = cosine < 0.0 ? -n : n;
      const double depth =
        std::fabs(cosine) >= least ? Behind(light.Corners, triangle, normal, most) : 0.0;
      if (depth > light.Farthest)
      {
        light.Farthest = depth;
        light.Move = depth * normal;
      }
      return true;
    });
  }
  for (const Candidate& light : candidates)
  {
    light.Moved->Position += light.Move;
    for (Vec3& corner : light.Moved->Polygon)
    {
      corner += light.Move;
    }
  }
}

} // namespace radiometry
