// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/Blockers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace radiometry
{
namespace
{

/// On which side of a plane a polygon lies: 1, -1, or 0 where on both.
int Side(const ConvexPolygon& polygon, const Vec3& n, const Vec3& through, double tolerance)
{
  bool above = false;
  bool below = false;
  for (int k = 0; k < polygon.N; ++k)
  {
    const double h = Dot(n, polygon.P[k] - through);
    above = above || h > tolerance;
    below = below || h < -tolerance;
  }
  return above == below ? 0 : (above ? 1 : -1);
}

} // namespace

Blockers::Blockers(const Scene& scene)
{
  const std::size_t count = scene.Triangles.size();
  double extent =
    std::max({ std::fabs(scene.Origin.x), std::fabs(scene.Origin.y), std::fabs(scene.Origin.z) });
  for (const Vec3& p : scene.Points)
  {
    extent = std::max({ extent, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z) });
  }
  this->Tolerance = 4.0 * std::numeric_limits<double>::epsilon() * extent;
  this->Extent = extent;

  struct Side3
  {
    std::int32_t A, B, Triangle, Corner;
  };
  std::vector<Side3> sides;
  sides.reserve(3 * count);
  std::vector<Box3> boxes(count);
  this->Triangles.resize(count);
  this->Normals.resize(count);
  for (std::size_t t = 0; t < count; ++t)
  {
    this->Triangles[t] = scene.TriangleAt(t);
    this->Normals[t] = Normalized(AreaNormal2(this->Triangles[t]));
    for (std::int32_t k = 0; k < 3; ++k)
    {
      boxes[t].Add(this->Triangles[t][k]);
      const std::int32_t a = scene.Triangles[t][k];
      const std::int32_t b = scene.Triangles[t][(k + 1) % 3];
      sides.push_back({ std::min(a, b), std::max(a, b), static_cast<std::int32_t>(t), k });
    }
  }
  this->Tree = BoxTree(boxes);
  std::sort(sides.begin(), sides.end(), [](const Side3& l, const Side3& r) {
    return std::tie(l.A, l.B, l.Triangle, l.Corner) < std::tie(r.A, r.B, r.Triangle, r.Corner);
  });
  this->EdgeOf.resize(count);
  for (std::size_t s = 0; s < sides.size(); ++s)
  {
    if (s == 0 || sides[s].A != sides[s - 1].A || sides[s].B != sides[s - 1].B)
    {
      this->First.push_back(static_cast<std::int32_t>(s));
    }
    const Side3& side = sides[s];
    this->EdgeOf[side.Triangle][side.Corner] = static_cast<std::int32_t>(this->First.size()) - 1;
    this->Opposite.push_back(this->Triangles[side.Triangle][(side.Corner + 2) % 3]);
  }
  this->Groups =
    std::make_unique<ConvexGroups>(scene, this->EdgeOf, this->First.size(), this->Tolerance);
  this->First.push_back(static_cast<std::int32_t>(sides.size()));
}

std::vector<std::int32_t> Blockers::Casters(
  const std::vector<std::int32_t>& triangles, const Vec3& normal, const Vec3& through) const
{
  const auto before = [&](const ConvexGroup& group) {
    return std::all_of(group.Corners.begin(), group.Corners.end(),
      [&](const Vec3& p) { return Dot(normal, p - through) >= -this->Tolerance; });
  };
  std::vector<std::int32_t> casters;
  std::vector<std::int32_t> groups;  // those met, and
  std::vector<std::uint8_t> counted; // whether they stand for their members
  for (const std::int32_t t : triangles)
  {
    const std::int32_t g = this->Groups->Of(t);
    if (g < 0)
    {
      casters.push_back(t);
      continue;
    }
    auto at = static_cast<std::size_t>(
      std::find(groups.rbegin(), groups.rend(), g).base() - groups.begin());
    if (at == 0)
    {
      const ConvexGroup& group = (*this->Groups)[static_cast<std::size_t>(g)];
      groups.push_back(g);
      counted.push_back(!group.Rim.empty() || before(group) ? 1 : 0);
      at = groups.size();
      if (counted.back())
      {
        casters.push_back(g + static_cast<std::int32_t>(this->Triangles.size()));
      }
    }
    if (!counted[at - 1])
    {
      casters.push_back(t);
    }
  }
  return casters;
}

bool Blockers::AnyNear(const Box3& box) const
{
  const double reach = 1e-6 * this->Extent;
  return !this->Tree.Visit(
    [&](const Box3& b) {
      for (int a = 0; a < 3; ++a)
      {
        if (b.Min[a] > box.Max[a] + reach || b.Max[a] < box.Min[a] - reach)
        {
          return false;
        }
      }
      return true;
    },
    [](std::int32_t) { return false; });
}

bool Blockers::FlatAt(const Vec3& point, const Vec3& normal) const
{
  const double reach = 2.0 * this->Tolerance;
  return this->Tree.Visit(
    [&](const Box3& b) {
      for (int a = 0; a < 3; ++a)
      {
        if (b.Min[a] > point[a] + reach || b.Max[a] < point[a] - reach)
        {
          return false;
        }
      }
      return true;
    },
    [&](std::int32_t t) {
      const Triangle3& v = this->Triangles[t];
      const Vec3& n = this->Normals[t];
      if (std::fabs(Dot(n, normal)) > 1.0 - 1e-12)
      {
        return true;
      }
      bool touches = std::fabs(Dot(n, point - v[0])) <= reach;
      for (int k = 0; k < 3 && touches; ++k)
      {
        const Vec3 inward = Normalized(Cross(n, v[(k + 1) % 3] - v[k]));
        touches = Dot(inward, point - v[k]) >= -reach;
      }
      return !touches;
    });
}

bool Blockers::InShaft(
  const Shaft& shaft, std::size_t most, std::vector<std::int32_t>& found) const
{
  std::size_t count = 0;
  return this->Tree.Visit([&](const Box3& box) { return shaft.Reaches(box); },
    [&](std::int32_t t) {
      if (shaft.Touches(this->Triangles[t]))
      {
        if (count++ == most)
        {
          return false;
        }
        found.push_back(t);
      }
      return true;
    });
}

bool Blockers::Parts(
  std::int32_t t, const ConvexPolygon& receiver, const ConvexPolygon& light) const
{
  const Vec3& n = this->Normals[t];
  const Vec3& through = this->Triangles[t][0];
  return Side(receiver, n, through, this->Tolerance) * Side(light, n, through, this->Tolerance) < 0;
}

/// True where the triangle passes through the inside of a polygon, or stands on it with an edge.
bool Blockers::Cuts(std::int32_t t, const ConvexPolygon& polygon) const
{
  const Vec3 n = Normalized(AreaNormal2(polygon.P, static_cast<std::size_t>(polygon.N)));
  const Triangle3& v = this->Triangles[t];
  Segment3 cut;
  int ends = 0;
  for (int k = 0; k < 3; ++k)
  {
    const double a = Dot(n, v[k] - polygon.P[0]);
    const double b = Dot(n, v[(k + 1) % 3] - polygon.P[0]);
    if ((a > this->Tolerance && b <= this->Tolerance) ||
      (b > this->Tolerance && a <= this->Tolerance))
    {
      // Where an edge leaves the side above: at most two do.
      const Vec3 p = v[k] + std::clamp(a / (a - b), 0.0, 1.0) * (v[(k + 1) % 3] - v[k]);
      (ends++ == 0 ? cut.A : cut.B) = p;
    }
  }
  if (ends < 2 || Length(cut.B - cut.A) <= this->Tolerance)
  {
    return false;
  }
  SegmentPart part;
  for (int k = 0; k < polygon.N; ++k)
  {
    const Vec3 inward = Normalized(Cross(n, polygon.P[(k + 1) % polygon.N] - polygon.P[k]));
    const double a = Dot(inward, cut.A - polygon.P[k]) - this->Tolerance;
    const double b = Dot(inward, cut.B - polygon.P[k]) - this->Tolerance;
    if (!part.Keep(a, b))
    {
      return false;
    }
  }
  return part.Any();
}

bool Blockers::Covers(
  std::int32_t t, const ConvexPolygon& receiver, const ConvexPolygon& light) const
{
  const Triangle3& v = this->Triangles[t];
  double beyond = 0.0; // the light's height over the triangle's plane
  for (int j = 0; j < light.N; ++j)
  {
    beyond += Dot(this->Normals[t], light.P[j] - v[0]);
  }
  const double side = beyond > 0.0 ? 1.0 : -1.0;
  for (int i = 0; i < receiver.N; ++i)
  {
    const Vec3& x = receiver.P[i];
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 n = side * Cross(v[k] - x, v[(k + 1) % 3] - v[k]);
      const double margin = this->Tolerance * std::sqrt(LengthSquared(n));
      for (int j = 0; j < light.N; ++j)
      {
        if (Dot(n, light.P[j] - x) < -margin)
        {
          return false;
        }
      }
    }
  }
  return true;
}

bool Blockers::Closed(
  std::int32_t edge, const Segment3& s, const ConvexPolygon& receiver) const
{
  // The height of a corner over the plane through x and the edge, times its area vector, is linear
  // in x: its signs at the receiver's corners tell for all of it.
  bool left = false;
  bool right = false;
  for (std::int32_t o = this->First[edge]; o < this->First[edge + 1]; ++o)
  {
    const Vec3 normal = Cross(s.B - s.A, this->Opposite[o] - s.A);
    const double margin = this->Tolerance * std::sqrt(LengthSquared(normal));
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (int i = 0; i < receiver.N; ++i)
    {
      const double volume = Dot(Cross(s.B - s.A, receiver.P[i] - s.A), this->Opposite[o] - s.A);
      low = std::min(low, volume);
      high = std::max(high, volume);
    }
    left = left || (low >= -margin && high > margin);
    right = right || (high <= margin && low < -margin);
  }
  return left && right;
}

bool Blockers::HideAll(const ConvexPolygon& receiver, const ConvexPolygon& light,
  const Shaft& shaft, const std::vector<std::int32_t>& inside) const
{
  // Among so many, one that covers all is not worth looking for.
  constexpr std::size_t mostCovers = 64;
  const bool some = inside.size() <= mostCovers;
  bool closed = !inside.empty();
  for (const std::int32_t t : inside)
  {
    if (!closed && !some)
    {
      return false;
    }
    if (this->Parts(t, receiver, light))
    {
      if (some && this->Covers(t, receiver, light))
      {
        return true;
      }
    }
    else if (closed)
    {
      closed = (receiver.N < 3 || !this->Cuts(t, receiver)) && !this->Cuts(t, light);
    }
    for (int k = 0; k < 3 && closed; ++k)
    {
      const Segment3 s{ this->Triangles[t][k], this->Triangles[t][(k + 1) % 3] };
      closed = !shaft.Touches(s) || this->Closed(this->EdgeOf[t][k], s, receiver);
    }
  }
  return closed;
}

} // namespace radiometry
