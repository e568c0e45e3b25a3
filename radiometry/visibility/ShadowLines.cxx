// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/ShadowLines.h"

#include <algorithm>
#include <mutex>
#include <tbb/parallel_sort.h>
#include <tuple>

namespace radiometry
{
namespace
{

/// Rounding of coordinates of size one, with a little room.
constexpr double RoundingUnits = 2e-14;

} // namespace

ShadowLines::ShadowLines(
  const Scene& scene, const BoxTree& tree, const Vec3& center, double scale, int threads,
  const StageProgress& stage)
{
  double extent = 0.0;
  for (const Vec3& p : scene.Points)
  {
    extent = std::max({ extent, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z) });
  }
  this->Rounding = RoundingUnits * extent;
  this->FindEdges(scene);
  Report(stage.Listener, stage.Begin, stage.Name);
  this->FindCrossings(scene, tree, center, scale, threads, stage);
}

void ShadowLines::FindEdges(const Scene& scene)
{
  struct Half
  {
    std::int32_t A, B, Opposite;
  };
  std::vector<Half> halves(3 * scene.Triangles.size());
  for (std::size_t i = 0; i < scene.Triangles.size(); ++i)
  {
    const auto& t = scene.Triangles[i];
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t a = t[k];
      const std::int32_t b = t[(k + 1) % 3];
      halves[3 * i + k] = { std::min(a, b), std::max(a, b), t[(k + 2) % 3] };
    }
  }
  tbb::parallel_sort(halves.begin(), halves.end(), [](const Half& x, const Half& y) {
    return std::tie(x.A, x.B, x.Opposite) < std::tie(y.A, y.B, y.Opposite);
  });
  // Duplicate triangles count once: their shadow is one.
  halves.erase(std::unique(halves.begin(), halves.end(),
                 [](const Half& x, const Half& y) {
                   return x.A == y.A && x.B == y.B && x.Opposite == y.Opposite;
                 }),
    halves.end());
  this->Edges.reserve(halves.size() / 2 + 1);
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

void ShadowLines::FindCrossings(
  const Scene& scene, const BoxTree& tree, const Vec3& center, double scale, int threads,
  const StageProgress& stage)
{
  std::mutex guard; // taken only where something crosses
  const auto search = [&](std::size_t r) {
    const Triangle3 receiver = scene.TriangleAt(r);
    const Vec3 n = Normalized(AreaNormal2(receiver));
    Box3 mine;
    for (const Vec3& p : receiver)
    {
      mine.Add(scale * (p - center));
    }
    std::vector<Segment3> found;
    const auto overlaps = [&](const Box3& box) {
      return box.Min.x <= mine.Max.x && box.Max.x >= mine.Min.x && box.Min.y <= mine.Max.y &&
        box.Max.y >= mine.Min.y && box.Min.z <= mine.Max.z && box.Max.z >= mine.Min.z;
    };
    tree.Visit(overlaps, [&](std::int32_t t) {
      const Triangle3 other = scene.TriangleAt(t);
      double h[3];
      bool above = false;
      bool below = false;
      for (int k = 0; k < 3; ++k)
      {
        h[k] = Dot(n, other[k] - receiver[0]);
        above = above || h[k] > this->Rounding;
        below = below || h[k] < -this->Rounding;
      }
      if (!above || !below)
      {
        return true; // beside the plane or only touching it: an edge marks the place
      }
      Vec3 ends[3];
      int count = 0;
      for (int k = 0; k < 3 && count < 2; ++k)
      {
        const double a = h[k];
        const double b = h[(k + 1) % 3];
        if ((a > 0.0) != (b > 0.0))
        {
          ends[count++] = other[k] + (a / (a - b)) * (other[(k + 1) % 3] - other[k]);
        }
      }
      if (count == 2)
      {
        found.push_back({ ends[0], ends[1] });
      }
      return true;
    });
    if (!found.empty())
    {
      const std::lock_guard<std::mutex> lock(guard);
      this->Cut.emplace(static_cast<std::int32_t>(r), std::move(found));
    }
  };
  ParallelFor(scene.ReceiverTriangles, threads, stage, search, 1e-6);
}

} // namespace radiometry
