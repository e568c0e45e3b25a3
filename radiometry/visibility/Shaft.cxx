// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/Shaft.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

/// The least height of a polygon's corners over a plane.
double Lowest(const ConvexPolygon& polygon, const Vec3& n, const Vec3& through)
{
  double least = Dot(n, polygon.P[0] - through);
  for (int k = 1; k < polygon.N; ++k)
  {
    least = std::min(least, Dot(n, polygon.P[k] - through));
  }
  return least;
}

} // namespace

Shaft::Shaft(const ConvexPolygon& receiver, const ConvexPolygon& light, double rounding)
  : Rounding(rounding)
{
  double size = 0.0;
  for (int k = 0; k < light.N; ++k)
  {
    size = std::max(size, LengthSquared(light.P[k] - receiver.P[0]));
  }
  for (int k = 1; k < receiver.N; ++k)
  {
    size = std::max(size, LengthSquared(receiver.P[k] - receiver.P[0]));
  }
  size = std::sqrt(size);
  for (const ConvexPolygon* end : { &receiver, &light })
  {
    if (end->N < 3)
    {
      continue;
    }
    // Each end's own plane, where the other lies wholly before it.
    const ConvexPolygon& other = end == &receiver ? light : receiver;
    const Vec3 n = Normalized(AreaNormal2(end->P, static_cast<std::size_t>(end->N)));
    if (n == Vec3{} || Lowest(other, n, end->P[0]) < -rounding - 1e-13 * size)
    {
      continue;
    }
    this->Add(n, end->P[0]);
  }
  this->AddSides(light, receiver, size);
  this->AddSides(receiver, light, size);
}

void Shaft::AddSides(const ConvexPolygon& edges, const ConvexPolygon& tips, double size)
{
  if (edges.N < 2)
  {
    return;
  }
  const double tolerance = this->Rounding + 1e-13 * size;
  for (int k = 0; k < edges.N; ++k)
  {
    const Vec3& a = edges.P[k];
    const Vec3 edge = edges.P[(k + 1) % edges.N] - a;
    for (int t = 0; t < tips.N; ++t)
    {
      const Vec3 toTip = tips.P[t] - a;
      Vec3 n = Cross(edge, toTip);
      const double length = std::sqrt(LengthSquared(n));
      if (!(length > 1e-12 * size * std::sqrt(LengthSquared(edge))))
      {
        continue; // the tip is on the edge's line: no plane
      }
      n = n / length;
      double low = std::min(Lowest(edges, n, a), Lowest(tips, n, a));
      if (low < -tolerance)
      {
        n = -n;
        low = std::min(Lowest(edges, n, a), Lowest(tips, n, a));
      }
      if (low >= -tolerance)
      {
        this->Add(n, a);
      }
    }
  }
}

void Shaft::Add(const Vec3& normal, const Vec3& through)
{
  const double offset = -Dot(normal, through) - this->Rounding;
  for (int k = 0; k < this->Planes; ++k)
  {
    if (Dot(normal, this->Normals[k]) > 1.0 - 1e-14 &&
      std::fabs(offset - this->Offsets[k]) <= this->Rounding)
    {
      return;
    }
  }
  if (this->Planes < Capacity)
  {
    this->Normals[this->Planes] = normal;
    this->Offsets[this->Planes++] = offset;
  }
}

bool Shaft::Reaches(const Box3& box) const
{
  for (int k = 0; k < this->Planes; ++k)
  {
    const Vec3& n = this->Normals[k];
    const double most = n.x * (n.x > 0 ? box.Max.x : box.Min.x) +
      n.y * (n.y > 0 ? box.Max.y : box.Min.y) + n.z * (n.z > 0 ? box.Max.z : box.Min.z);
    if (most + this->Offsets[k] <= 0.0)
    {
      return false;
    }
  }
  return true;
}

bool Shaft::Touches(const Triangle3& triangle) const
{
  ConvexPolygon parts[2];
  parts[0] = ConvexPolygon(triangle);
  int at = 0;
  for (int k = 0; k < this->Planes; ++k)
  {
    const ConvexPolygon& p = parts[at];
    double heights[ConvexPolygon::Capacity];
    double least = 1.0;
    for (int c = 0; c < p.N; ++c)
    {
      heights[c] = Dot(this->Normals[k], p.P[c]) + this->Offsets[k];
      least = std::min(least, heights[c]);
    }
    if (least >= 0.0)
    {
      continue;
    }
    if (!Clip(p, heights, parts[1 - at]))
    {
      return true; // too many corners to tell
    }
    at = 1 - at;
    if (parts[at].N == 0)
    {
      return false;
    }
  }
  return true;
}

bool Shaft::Touches(const Segment3& s) const
{
  SegmentPart part;
  for (int k = 0; k < this->Planes; ++k)
  {
    const double a = Dot(this->Normals[k], s.A) + this->Offsets[k];
    const double b = Dot(this->Normals[k], s.B) + this->Offsets[k];
    if (!part.Keep(a, b))
    {
      return false;
    }
  }
  return part.Any();
}

} // namespace radiometry
