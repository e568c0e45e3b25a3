// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/OpenSides.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace radiometry
{
namespace
{

double Highest(const Box3& box, const Vec3& direction)
{
  double sum = 0.0;
  for (int a = 0; a < 3; ++a)
  {
    sum += direction[a] > 0.0 ? direction[a] * box.Max[a] : direction[a] * box.Min[a];
  }
  return sum;
}

} // namespace

OpenSides::OpenSides(const Scene& scene)
  : Geometry(scene)
{
  std::vector<Box3> boxes(scene.Triangles.size());
  double extent = Length(scene.Origin);
  for (std::size_t t = 0; t < boxes.size(); ++t)
  {
    for (const Vec3& corner : scene.TriangleAt(t))
    {
      boxes[t].Add(corner);
      extent = std::max({ extent, std::fabs(corner.x), std::fabs(corner.y), std::fabs(corner.z) });
    }
  }
  this->Tree = BoxTree(boxes);
  this->Rounding = 8.0 * std::numeric_limits<double>::epsilon() * extent;
}

bool OpenSides::Open(
  const Vec3* points, std::size_t count, const Vec3& normal, const Vec3* up) const
{
  const double plane = Dot(normal, points[0]) + this->Rounding;
  double low = -std::numeric_limits<double>::infinity();
  if (up)
  {
    low = Dot(*up, points[0]);
    for (std::size_t k = 1; k < count; ++k)
    {
      low = std::min(low, Dot(*up, points[k]));
    }
    low += this->Rounding;
  }
  const auto reaches = [&](const Box3& box) {
    return Highest(box, normal) > plane && (!up || Highest(box, *up) > low);
  };
  return this->Tree.Visit(reaches, [&](std::int32_t item) {
    const Triangle3 t = this->Geometry.TriangleAt(static_cast<std::size_t>(item));
    double above[3];
    for (int k = 0; k < 3; ++k)
    {
      above[k] = Dot(normal, t[k]) - plane;
    }
    for (int k = 0; k < 3; ++k)
    {
      const int next = (k + 1) % 3;
      if (above[k] > 0.0 && (!up || Dot(*up, t[k]) > low))
      {
        return false;
      }
      // Where an edge crosses the plane.
      if (up && (above[k] > 0.0) != (above[next] > 0.0))
      {
        const double share = above[k] / (above[k] - above[next]);
        if (Dot(*up, t[k] + share * (t[next] - t[k])) > low)
        {
          return false;
        }
      }
    }
    return true;
  });
}

} // namespace radiometry
