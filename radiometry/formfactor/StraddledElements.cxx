// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/StraddledElements.h"

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/scene/Parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

namespace radiometry
{
namespace
{

constexpr double Rounding = 1e-12; // of the scene's coordinates
constexpr double Inside = 0.02;    // of an element's size: what is nearer to an edge lies along it

/// The line on a plane in which a triangle cuts through it or stands on it; false: there is none.
bool LineOn(const Vec3& place, const Vec3& n, const Triangle3& other, double rounding, Vec3 line[2])
{
  double h[3];
  for (int k = 0; k < 3; ++k)
  {
    h[k] = Dot(n, other[k] - place);
    h[k] = std::fabs(h[k]) <= rounding ? 0.0 : h[k];
  }
  if (h[0] == 0.0 && h[1] == 0.0 && h[2] == 0.0)
  {
    return false;
  }
  int count = 0;
  for (int k = 0; k < 3 && count < 2; ++k)
  {
    const int next = (k + 1) % 3;
    if (h[k] == 0.0)
    {
      line[count++] = other[k];
    }
    else if (h[k] * h[next] < 0.0)
    {
      line[count++] = other[k] + (h[k] / (h[k] - h[next])) * (other[next] - other[k]);
    }
  }
  return count == 2;
}

/// Whether a part of a segment lies inside a triangle, away from its edges.
bool Enters(const Triangle3& t, const Vec3& n, double size, const Vec3 line[2])
{
  double begin = 0.0, end = 1.0;
  for (int k = 0; k < 3; ++k)
  {
    const Vec3 side = t[(k + 1) % 3] - t[k];
    const Vec3 inward = Cross(n, side) / Length(side);
    const double a = Dot(inward, line[0] - t[k]) - Inside * size;
    const double b = Dot(inward, line[1] - t[k]) - Inside * size;
    if (a <= 0.0 && b <= 0.0)
    {
      return false;
    }
    begin = a < 0.0 ? std::max(begin, a / (a - b)) : begin;
    end = b < 0.0 ? std::min(end, a / (a - b)) : end;
  }
  return begin < end;
}

} // namespace

bool AnyStraddled(const Scene& scene, const ElementSet& elements, int threads)
{
  std::vector<Box3> boxes(scene.Triangles.size());
  double reach = 0.0;
  for (std::size_t t = 0; t < boxes.size(); ++t)
  {
    for (const Vec3& p : scene.TriangleAt(t))
    {
      boxes[t].Add(p);
      reach = std::max({ reach, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z) });
    }
  }
  const double rounding = Rounding * reach;
  const BoxTree tree(boxes);
  std::atomic<bool> any{ false };
  ParallelFor(
    elements.Size(), threads, {},
    [&](std::size_t e) {
      const Patch& patch = elements.GetPatches()[e];
      const Vec3 area2 = AreaNormal2(patch.Corners);
      const double size = std::sqrt(Length(area2));
      if (any || !(size > 0.0))
      {
        return;
      }
      const Vec3 n = Normalized(area2);
      Box3 own;
      for (const Vec3& p : patch.Corners)
      {
        own.Add(p);
      }
      const auto near = [&](const Box3& box) {
        for (int a = 0; a < 3; ++a)
        {
          if (box.Min[a] > own.Max[a] + rounding || box.Max[a] < own.Min[a] - rounding)
          {
            return false;
          }
        }
        return true;
      };
      tree.Visit(near, [&](std::int32_t t) {
        Vec3 line[2];
        if (t != patch.Triangle && near(boxes[static_cast<std::size_t>(t)]) &&
          LineOn(patch.Corners[0], n, scene.TriangleAt(static_cast<std::size_t>(t)), rounding, line) &&
          Enters(patch.Corners, n, size, line))
        {
          any = true;
        }
        return !any;
      });
    },
    1e-5);
  return any;
}

} // namespace radiometry
