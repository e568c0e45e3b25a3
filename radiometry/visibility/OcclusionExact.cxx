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

bool OcclusionScene::Internals::Grazes(const Vec3& direction, std::int32_t t) const
{
  return std::fabs(Dot(direction, this->Normals[t])) < GrazingSine;
}

RayQuery OcclusionScene::Internals::MakeQuery(const RayEnd& from, const Vec3& direction) const
{
  RayQuery q;
  q.Start = this->ToBox(from.Point);
  q.Direction = direction / Norm(direction);
  q.Length = std::numeric_limits<double>::infinity();
  q.FromTriangle = from.Triangle;
  q.Triangles = &this->Triangles;
  q.Normals = &this->Normals;
  q.Exact = from.Close ||
    (from.Triangle >= 0 &&
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
