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
  const auto moves = [](const Light& light) { return light.Enabled && !(Facing(light) == Vec3{}); };
  if (!(rounding > 0.0) || std::none_of(scene.Lights.begin(), scene.Lights.end(), moves))
  {
    return;
  }
  std::vector<Box3> boxes(scene.Triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
  {
    for (const Vec3& p : scene.TriangleAt(t))
    {
      boxes[t].Add(p);
    }
  }
  const BoxTree tree(boxes);
  const double most = 2.0 * rounding;
  const Vec3 margin{ most, most, most };
  for (Light& light : scene.Lights)
  {
    if (!moves(light))
    {
      continue;
    }
    const bool area = light.Type == LightType::Area;
    const Vec3 facing = Facing(light);
    const std::vector<Vec3> corners =
      area ? light.Polygon : std::vector<Vec3>{ light.Position };
    Box3 bounds;
    for (const Vec3& corner : corners)
    {
      bounds.Add(corner - margin);
      bounds.Add(corner + margin);
    }
    const double least = area ? 1.0 - 1e-6 : 0.5; // cosine between the light's axis and the normal
    Vec3 move;
    double farthest = 0.0;
    tree.Visit(
      [&](const Box3& box) {
        for (int a = 0; a < 3; ++a)
        {
          if (box.Min[a] > bounds.Max[a] || box.Max[a] < bounds.Min[a])
          {
            return false;
          }
        }
        return true;
      },
      [&](std::int32_t t) {
        const Triangle3 triangle = scene.TriangleAt(static_cast<std::size_t>(t));
        const Vec3 n = Normalized(AreaNormal2(triangle));
        const double cosine = Dot(n, facing);
        const Vec3 normal = cosine < 0.0 ? -n : n;
        const double depth =
          std::fabs(cosine) >= least ? Behind(corners, triangle, normal, most) : 0.0;
        if (depth > farthest)
        {
          farthest = depth;
          move = depth * normal;
        }
        return true;
      });
    light.Position += move;
    for (Vec3& corner : light.Polygon)
    {
      corner += move;
    }
  }
}

} // namespace radiometry
