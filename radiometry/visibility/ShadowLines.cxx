// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/ShadowLines.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>
#include <tuple>

namespace radiometry
{
namespace
{

/// Rounding of coordinates of size one, with a little room.
constexpr double RoundingUnits = 2e-14;
/// What single precision may turn an axis by.
constexpr double AxisRounding = 3e-7;

using Cone = ShadowLines::Cone;

constexpr Cone Everything{ { 0.0f, 0.0f, 1.0f }, -1.0f, 0.0f };

Vec3 Axis(const Cone& c)
{
  return { c.Axis[0], c.Axis[1], c.Axis[2] };
}

/// A cone about `axis` with this spread, a little wider; spreads of 90 degrees and more are
/// Everything.
Cone MakeCone(const Vec3& axis, double cosine, double sine)
{
  const double c = cosine - AxisRounding;
  const double s = sine + AxisRounding;
  if (!(c > 1e-3))
  {
    return Everything;
  }
  return { { static_cast<float>(axis.x), static_cast<float>(axis.y), static_cast<float>(axis.z) },
    static_cast<float>(c), static_cast<float>(s) };
}

/// The cone that holds two.
Cone Join(const Cone& a, const Cone& b)
{
  if (a.CosSpread < 0.0f || b.CosSpread < 0.0f)
  {
    return Everything;
  }
  const Vec3 sum = Axis(a) + Axis(b);
  const double length = std::sqrt(LengthSquared(sum));
  if (!(length > 0.5))
  {
    return Everything;
  }
  const Vec3 axis = sum / length;
  double cosine = 1.0;
  double sine = 0.0;
  for (const Cone* c : { &a, &b })
  {
    const double turned = std::min(1.0, Dot(axis, Axis(*c)));
    const double away = std::sqrt(std::max(0.0, 1.0 - turned * turned));
    const double both = turned * c->CosSpread - away * c->SinSpread;
    if (both < cosine)
    {
      cosine = both;
      sine = turned * c->SinSpread + away * c->CosSpread;
    }
  }
  return MakeCone(axis, cosine, sine);
}

template <typename Body>
void ForAll(std::size_t n, int threads, const Body& body)
{
  const int available = tbb::this_task_arena::max_concurrency();
  tbb::task_arena arena(threads > 0 ? std::min(threads, available) : available);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 1024), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i)
      {
        body(i);
      }
    });
  });
}

} // namespace

ShadowLines::ShadowLines(
  const Scene& scene, const BoxTree& tree, const Vec3& center, double scale, int threads,
  const StageProgress& stage)
  : Tree(tree)
  , Center(center)
  , Scale(scale)
{
  double extent = 0.0;
  for (const Vec3& p : scene.Points)
  {
    extent = std::max({ extent, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z) });
  }
  this->Rounding = RoundingUnits * extent;
  this->FindTwins(scene, threads);
  Report(stage.Listener, stage.Begin, stage.Name);
  this->FindCones(scene);
  Report(stage.Listener, stage.Begin, stage.Name);
  this->FindCrossings(scene, threads, stage);
}

/// Edges are gathered at their corner of lower number, then paired there.
void ShadowLines::FindTwins(const Scene& scene, int threads)
{
  const auto& triangles = scene.Triangles;
  const std::size_t points = scene.Points.size();
  const auto corner = [&](std::size_t edge, std::size_t step) {
    return triangles[edge / 3][(edge % 3 + step) % 3];
  };
  std::vector<std::atomic<std::int32_t>> counts(points + 1);
  ForAll(triangles.size(), threads, [&](std::size_t t) {
    for (std::size_t e = 3 * t; e < 3 * t + 3; ++e)
    {
      counts[std::min(corner(e, 0), corner(e, 1))].fetch_add(1, std::memory_order_relaxed);
    }
  });
  std::vector<std::int32_t> first(points + 1, 0);
  for (std::size_t p = 0; p < points; ++p)
  {
    first[p + 1] = first[p] + counts[p].load(std::memory_order_relaxed);
  }
  std::vector<std::int32_t> edges(3 * triangles.size());
  ForAll(triangles.size(), threads, [&](std::size_t t) {
    for (std::size_t e = 3 * t; e < 3 * t + 3; ++e)
    {
      const std::int32_t p = std::min(corner(e, 0), corner(e, 1));
      edges[first[p] + counts[p].fetch_sub(1, std::memory_order_relaxed) - 1] =
        static_cast<std::int32_t>(e);
    }
  });

  const std::vector<double>& clear = scene.TriangleTransmittance;
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  const auto differ = [&](std::int32_t a, std::int32_t b) {
    return !clear.empty() &&
      !std::equal(clear.begin() + a / 3 * bands, clear.begin() + (a / 3 + 1) * bands,
        clear.begin() + b / 3 * bands);
  };
  this->Twins.assign(3 * triangles.size(), Elsewhere);
  ForAll(points, threads, [&](std::size_t p) {
    const auto key = [&](std::int32_t e) {
      const auto edge = static_cast<std::size_t>(e);
      return std::tuple(std::max(corner(edge, 0), corner(edge, 1)), corner(edge, 2), e);
    };
    const auto begin = edges.begin() + first[p];
    const auto end = edges.begin() + first[p + 1];
    // The order in which threads gathered them does not matter after this.
    std::sort(begin, end, [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); });
    for (auto e = begin; e != end;)
    {
      // Duplicate triangles count once: their shadow is one.
      std::int32_t other = -1;
      bool many = false;
      auto next = e + 1;
      for (; next != end && std::get<0>(key(*next)) == std::get<0>(key(*e)); ++next)
      {
        if (std::get<1>(key(*next)) != std::get<1>(key(*(next - 1))))
        {
          many = other >= 0;
          other = other < 0 ? *next : other;
          if (many)
          {
            break;
          }
        }
      }
      while (next != end && std::get<0>(key(*next)) == std::get<0>(key(*e)))
      {
        ++next;
      }
      if (other >= 0 && !many && !differ(*e, other))
      {
        this->Twins[*e] = other;
        this->Twins[other] = *e;
      }
      else
      {
        this->Twins[*e] = Always;
      }
      e = next;
    }
  });
}

/// The normals of a triangle and of those beyond the edges that it stands for.
ShadowLines::Cone ShadowLines::TriangleCone(const Scene& scene, std::int32_t t) const
{
  const Vec3 area2 = AreaNormal2(scene.TriangleAt(t));
  const double length = std::sqrt(LengthSquared(area2));
  const Triangle3 corners = scene.TriangleAt(t);
  Cone cone = Everything;
  const auto uncertain = [&](const Triangle3& c, double twiceArea) {
    double longest = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      longest = std::max(longest, LengthSquared(c[(k + 1) % 3] - c[k]));
    }
    // The angle by which rounding may turn the normal: rounding over the least height.
    return 2.0 * this->Rounding * std::sqrt(longest) / twiceArea;
  };
  double doubt = uncertain(corners, length);
  if (!(length > 0.0) || !(doubt < 1e-3))
  {
    return Everything;
  }
  const Vec3 normal = area2 / length;
  cone = MakeCone(normal, 1.0 - doubt, doubt);
  for (std::size_t e = 3 * static_cast<std::size_t>(t); e < 3 * static_cast<std::size_t>(t) + 3; ++e)
  {
    const std::int32_t twin = this->Twins[e];
    if (twin == Always)
    {
      return Everything;
    }
    if (!this->Owns(e))
    {
      continue;
    }
    const auto& mine = scene.Triangles[t];
    const auto& theirs = scene.Triangles[twin / 3];
    const Triangle3 other = scene.TriangleAt(twin / 3);
    const Vec3 otherArea2 = AreaNormal2(other);
    const double otherLength = std::sqrt(LengthSquared(otherArea2));
    doubt = uncertain(other, otherLength);
    if (!(otherLength > 0.0) || !(doubt < 1e-3))
    {
      return Everything;
    }
    // Neighbours of one orientation run through their common edge in opposite ways.
    const double sign = mine[e % 3] == theirs[(twin % 3 + 1) % 3] ? 1.0 : -1.0;
    cone = Join(cone, MakeCone((sign / otherLength) * otherArea2, 1.0 - doubt, doubt));
  }
  return cone;
}

void ShadowLines::FindCones(const Scene& scene)
{
  this->Cones.resize(this->Tree.Size());
  const auto build = [&](const auto& self, std::int32_t at, int depth) -> void {
    const BoxTree::Node& node = this->Tree.At(at);
    if (node.Count > 0)
    {
      Cone cone = this->TriangleCone(scene, this->Tree.Order()[node.First]);
      for (std::int32_t k = 1; k < node.Count; ++k)
      {
        cone = Join(cone, this->TriangleCone(scene, this->Tree.Order()[node.First + k]));
      }
      this->Cones[at] = cone;
      return;
    }
    const auto first = [&] { self(self, at + 1, depth + 1); };
    const auto second = [&] { self(self, node.First, depth + 1); };
    if (depth < 8)
    {
      tbb::parallel_invoke(first, second);
    }
    else
    {
      first();
      second();
    }
    this->Cones[at] = Join(this->Cones[at + 1], this->Cones[node.First]);
  };
  if (!this->Tree.Empty())
  {
    build(build, 0, 0);
  }
}

} // namespace radiometry
