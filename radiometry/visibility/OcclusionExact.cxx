// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/OcclusionInternals.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiometry
{
namespace
{

/// Rays that leave a surface at less than this sine are decided in double: where hits are no longer
/// judged one by one (EndMargin away) they would be within rounding of their own plane.
constexpr double GrazingSine = 1e-7 / EndMargin;
/// Of coordinates in the unit box.
constexpr double Rounding = 1e-14;

/// The length, without the cost of guarding against overflow where there is none.
double Norm(const Vec3& a)
{
  const double l2 = LengthSquared(a);
  return l2 > 1e-280 && l2 < 1e280 ? std::sqrt(l2) : std::max(Length(a), 1e-300);
}

} // namespace

bool OcclusionScene::Internals::Clip(const RayQuery& q, double& begin, double& end) const
{
  begin = 0.0;
  end = q.Length;
  return this->Bounds.Cut(q.Start, q.Direction, EndMargin, begin, end);
}

SurfaceHit OcclusionScene::Internals::ExactClosest(const RayQuery& q, double begin, double end) const
{
  SurfaceHit best;
  best.Distance = std::numeric_limits<double>::infinity();
  const auto reaches = [&](const Box3& box) {
    double lo = begin;
    double hi = end;
    return box.Cut(q.Start, q.Direction, 1e-12, lo, hi);
  };
  this->Tree.Visit(reaches, [&](std::int32_t t) {
    double distance = 0.0;
    if (Judge(q, t, true, distance) == Verdict::Hit &&
      (distance < best.Distance || (distance == best.Distance && t < best.Triangle)))
    {
      best.Triangle = t;
      best.Distance = distance;
    }
    return true;
  });
  return best;
}

bool OcclusionScene::Internals::NearRim(const Vec3& p, std::int32_t t) const
{
  const Triangle3& v = this->Triangles[t];
  for (int k = 0; k < 3; ++k)
  {
    const Vec3 edge = v[(k + 1) % 3] - v[k];
    const Vec3 across = Cross(edge, p - v[k]);
    if (LengthSquared(across) < Closeness * Closeness * LengthSquared(edge))
    {
      return true;
    }
  }
  return false;
}

std::uint8_t OcclusionScene::Internals::FindCrowded(std::int32_t t) const
{
  const Triangle3& own = this->Triangles[t];
  const Vec3& n = this->Normals[t];
  if (n == Vec3{})
  {
    return 3;
  }
  Box3 near;
  for (const Vec3& p : own)
  {
    near.Add(p - Vec3{ FreeStart, FreeStart, FreeStart });
    near.Add(p + Vec3{ FreeStart, FreeStart, FreeStart });
  }
  const auto meets = [&near](const Box3& box) {
    for (int a = 0; a < 3; ++a)
    {
      if (box.Min[a] > near.Max[a] || box.Max[a] < near.Min[a])
      {
        return false;
      }
    }
    return true;
  };
  // True where a line along an edge of `a` (seen along n) parts it from `b`.
  const auto parted = [&n](const Triangle3& a, const Triangle3& b) {
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 across = Normalized(Cross(a[(k + 1) % 3] - a[k], n));
      const double third = Dot(across, a[(k + 2) % 3] - a[k]);
      const double side = third > 0.0 ? -1.0 : 1.0;
      if (across == Vec3{} || third == 0.0)
      {
        continue;
      }
      if (side * Dot(across, b[0] - a[k]) >= -Rounding &&
        side * Dot(across, b[1] - a[k]) >= -Rounding &&
        side * Dot(across, b[2] - a[k]) >= -Rounding)
      {
        return true;
      }
    }
    return false;
  };
  std::uint8_t crowded = 0;
  this->Tree.Visit(meets, [&](std::int32_t other) {
    const Triangle3& v = this->Triangles[other];
    Box3 box;
    std::uint8_t sides = 0;
    for (const Vec3& p : v)
    {
      box.Add(p);
      const double height = Dot(n, p - own[0]);
      sides = static_cast<std::uint8_t>(
        sides | (height > Rounding ? 1 : 0) | (height < -Rounding ? 2 : 0));
    }
    if (other != t && (sides & ~crowded) != 0 && meets(box) && !parted(own, v) && !parted(v, own))
    {
      crowded = static_cast<std::uint8_t>(crowded | sides);
    }
    return crowded != 3;
  });
  return crowded;
}

bool OcclusionScene::Internals::StartsFree(const RayQuery& q) const
{
  if (q.FromTriangle < 0 || !this->KnowsCrowded.load(std::memory_order_acquire))
  {
    return false;
  }
  const double sine = Dot(q.Direction, this->Normals[q.FromTriangle]);
  if (std::fabs(sine) < FreeSine ||
    (this->Crowded[static_cast<std::size_t>(q.FromTriangle)] & (sine > 0.0 ? 1 : 2)) != 0)
  {
    return false;
  }
  const Triangle3& v = this->Triangles[q.FromTriangle];
  for (int k = 0; k < 3; ++k)
  {
    const Vec3 edge = v[(k + 1) % 3] - v[k];
    if (LengthSquared(Cross(edge, q.Start - v[k])) <
      FreeStart * FreeStart * LengthSquared(edge))
    {
      return false;
    }
  }
  return true;
}

bool OcclusionScene::Internals::Grazes(const Vec3& direction, std::int32_t t) const
{
  return std::fabs(Dot(direction, this->Normals[t])) < GrazingSine;
}

RayQuery OcclusionScene::Internals::MakeQuery(const RayEnd& from, const Vec3& direction) const
{
  this->Ready();
  RayQuery q;
  q.Start = this->ToBox(from.Point);
  q.Direction = direction / Norm(direction);
  q.Length = std::numeric_limits<double>::infinity();
  q.FromTriangle = from.Triangle;
  q.Triangles = &this->Triangles;
  q.Normals = &this->Normals;
  q.Free = this->StartsFree(q); // then it neither lies at the rim nor grazes
  q.Exact = from.Close ||
    (from.Triangle >= 0 && !q.Free &&
      (this->NearRim(q.Start, from.Triangle) || this->Grazes(q.Direction, from.Triangle)));
  return q;
}

RayQuery OcclusionScene::Internals::MakeQuery(const RayEnd& from, const RayEnd& to) const
{
  const Vec3 way = to.Point - from.Point;
  RayQuery q = this->MakeQuery(from, way);
  q.Length = this->Scale * Norm(way);
  q.ToTriangle = to.Triangle;
  q.Exact = q.Exact || to.Close ||
    (to.Triangle >= 0 &&
      (this->NearRim(this->ToBox(to.Point), to.Triangle) ||
        this->Grazes(q.Direction, to.Triangle)));
  return q;
}

void OcclusionScene::Internals::Complete(const RayQuery& q, SurfaceHit& hit) const
{
  const Triangle3& v = this->Triangles[hit.Triangle];
  const Vec3 n = AreaNormal2(v);
  const double rate = Dot(n, q.Direction);
  hit.Front = rate < 0.0;
  hit.Distance = -Dot(n, q.Start - v[0]) / rate;
  const Vec3 p = q.Start + hit.Distance * q.Direction - v[0];
  const double nn = Dot(n, n);
  hit.U = std::clamp(Dot(n, Cross(p, v[2] - v[0])) / nn, 0.0, 1.0);
  hit.V = std::clamp(Dot(n, Cross(v[1] - v[0], p)) / nn, 0.0, 1.0 - hit.U);
}

} // namespace radiometry
