// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/BlindSides.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace radiometry
{
namespace
{

/// The points of receivers, those that lie farthest out first: a plane with any before it mostly has
/// one of them before it.
std::vector<Vec3> ReceiverPoints(const Scene& scene)
{
  std::vector<std::uint8_t> used(scene.Points.size(), 0);
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    for (const std::int32_t p : scene.Triangles[t])
    {
      used[static_cast<std::size_t>(p)] = 1;
    }
  }
  std::vector<Vec3> points;
  for (std::size_t p = 0; p < used.size(); ++p)
  {
    if (used[p])
    {
      points.push_back(scene.Points[p]);
    }
  }
  std::size_t front = 0;
  for (int k = 0; k < 27 && front < points.size(); ++k)
  {
    const Vec3 way{ k % 3 - 1.0, k / 3 % 3 - 1.0, k / 9 - 1.0 };
    const auto far = std::max_element(points.begin() + static_cast<std::ptrdiff_t>(front),
      points.end(), [&](const Vec3& a, const Vec3& b) { return Dot(way, a) < Dot(way, b); });
    std::swap(points[front++], *far);
  }
  return points;
}

} // namespace

std::vector<std::array<std::uint8_t, 2>> FindBlindSides(const Scene& scene)
{
  constexpr std::size_t most = 50000000; // looks at a point
  std::vector<std::array<std::uint8_t, 2>> blind(scene.ReceiverTriangles, { 0, 0 });
  const std::vector<Vec3> points = ReceiverPoints(scene);
  double extent = 0.0;
  for (const Vec3& p : points)
  {
    extent = std::max({ extent, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z) });
  }
  // A point counts as on a plane within rounding, which grows as its normal is less sure of itself.
  const double rounding = 1e-13 * extent;
  std::size_t looks = 0;
  Vec3 normal, origin;
  std::array<std::uint8_t, 2> last{ 0, 0 };
  for (std::size_t t = 0; t < scene.ReceiverTriangles && looks < most; ++t)
  {
    const Triangle3 v = scene.TriangleAt(t);
    const Vec3 n = Normalized(AreaNormal2(v));
    const bool same = t > 0 && Dot(n, normal) > 0.0 &&
      std::all_of(v.begin(), v.end(),
        [&](const Vec3& p) { return std::fabs(Dot(normal, p - origin)) <= rounding; });
    if (!same)
    {
      last = { 1, 1 };
      for (const Vec3& p : points)
      {
        ++looks;
        const double height = Dot(n, p - v[0]);
        last[0] = last[0] && height <= rounding;
        last[1] = last[1] && height >= -rounding;
        if (!last[0] && !last[1])
        {
          break;
        }
      }
      normal = n;
      origin = v[0];
    }
    blind[t] = last;
  }
  return blind;
}

bool AllBlind(const Scene& scene, const std::vector<std::array<std::uint8_t, 2>>& blind, bool backs)
{
  const std::vector<double>& through = scene.Optics.DiffuseTransmittance;
  const bool diffusing =
    std::any_of(through.begin(), through.end(), [](double tau) { return tau > 0.0; });
  const bool sided = diffusing ||
    (backs && std::any_of(scene.Optics.TwoSided.begin(), scene.Optics.TwoSided.end(),
                [](std::uint8_t two) { return two != 0; }));
  return std::all_of(blind.begin(), blind.end(),
    [sided](const std::array<std::uint8_t, 2>& b) { return b[0] && (!sided || b[1]); });
}

} // namespace radiometry
