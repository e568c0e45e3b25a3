// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/VisibleFactor.h"

#include <cmath>

namespace radiometry
{
namespace
{

/// Heights of the corners over the plane through x, those within rounding of it taken as on it.
/// Returns 1 where none is below, -1 where none is above, else 0.
int Heights(const ConvexPolygon& p, const Vec3& x, const Vec3& n, double margin, double* heights)
{
  bool above = false;
  bool below = false;
  for (int k = 0; k < p.N; ++k)
  {
    const double h = Dot(n, p.P[k] - x);
    heights[k] = std::fabs(h) <= margin ? 0.0 : h;
    above = above || heights[k] > 0.0;
    below = below || heights[k] < 0.0;
  }
  return above && below ? 0 : (above ? 1 : -1);
}

/// The shadow of a triangle on what lies beyond it: inside where all heights are positive.
struct Shadow
{
  Vec3 Normal[4];
  Vec3 Through[4];
  double Margin[4];

  /// False where x lies on the triangle's plane: then it hides nothing.
  bool Make(const Vec3& x, const Triangle3& v, const Vec3& n, double rounding)
  {
    const double height = Dot(n, x - v[0]);
    if (std::fabs(height) <= rounding)
    {
      return false;
    }
    const double side = height < 0.0 ? 1.0 : -1.0; // so that inside and beyond are positive
    for (int k = 0; k < 3; ++k)
    {
      this->Normal[k] = side * Cross(v[k] - x, v[(k + 1) % 3] - v[k]);
      this->Through[k] = x;
      this->Margin[k] = rounding * std::sqrt(LengthSquared(this->Normal[k]));
    }
    this->Normal[3] = side * n;
    this->Through[3] = v[0];
    this->Margin[3] = rounding;
    return true;
  }

  /// Adds to `rest` what of `piece` is not in the shadow, and to `hidden` (or null) what is. False
  /// where all of it is lit.
  bool Cut(const ConvexPolygon& piece, Pieces& rest, Pieces* hidden) const
  {
    ConvexPolygon inside = piece;
    ConvexPolygon outside[4];
    int cuts = 0;
    double heights[ConvexPolygon::Capacity];
    for (int k = 0; k < 4; ++k)
    {
      const int side = Heights(inside, this->Through[k], this->Normal[k], this->Margin[k], heights);
      if (side < 0)
      {
        return false;
      }
      if (side > 0)
      {
        continue;
      }
      ConvexPolygon next;
      if (!Split(inside, heights, next, outside[cuts]))
      {
        return this->CutHalves(piece, rest, hidden);
      }
      if (next.N == 0)
      {
        return false;
      }
      cuts += outside[cuts].N > 0 ? 1 : 0;
      inside = next;
    }
    rest.insert(rest.end(), outside, outside + cuts);
    if (hidden)
    {
      hidden->push_back(inside);
    }
    return true;
  }

  /// The same, where the corners were too many at once.
  bool CutHalves(const ConvexPolygon& piece, Pieces& rest, Pieces* hidden) const
  {
    ConvexPolygon halves[2];
    const int middle = piece.N / 2;
    for (int k = 0; k <= middle; ++k)
    {
      halves[0].Add(piece.P[k]);
    }
    for (int k = middle; k <= piece.N; ++k)
    {
      halves[1].Add(piece.P[k % piece.N]);
    }
    bool any = false;
    for (const ConvexPolygon& half : halves)
    {
      if (this->Cut(half, rest, hidden))
      {
        any = true;
      }
      else
      {
        rest.push_back(half);
      }
    }
    return any;
  }
};

} // namespace

double Factor(const Vec3& x, const Vec3& n, const Pieces& pieces)
{
  double sum = 0.0;
  for (const ConvexPolygon& p : pieces)
  {
    sum += PointToVisiblePolygon(x, n, p);
  }
  return sum;
}

void PiecesAbove(
  const Vec3& x, const Vec3& n, const Vec3& horizon, const AreaSource& source, Pieces& pieces)
{
  pieces.clear();
  if (!(HeightOverPlane(x, source.Triangles[0].Corners, source.Normal) > 0.0))
  {
    return;
  }
  for (const ConvexPolygon& part : source.Parts)
  {
    ConvexPolygon now = part;
    for (const Vec3* plane : { &n, &horizon })
    {
      double heights[ConvexPolygon::Capacity];
      const int side = *plane == Vec3{} ? 1 : Heights(now, x, *plane, 0.0, heights);
      if (side == 0)
      {
        ConvexPolygon above;
        Clip(now, heights, above); // parts have room for two more corners
        now = above;
      }
      now.N = side < 0 ? 0 : now.N;
      if (now.N == 0)
      {
        break;
      }
    }
    if (now.N > 0)
    {
      pieces.push_back(now);
    }
  }
}

bool CutShadows(const Vec3& x, const Blockers& blockers, const std::int32_t* triangles,
  std::size_t count, Pieces& pieces, Pieces* hidden)
{
  static thread_local Pieces rest;
  bool touched = false;
  for (std::size_t k = 0; k < count && !pieces.empty(); ++k)
  {
    Shadow shadow;
    const std::int32_t t = triangles[k];
    if (!shadow.Make(x, blockers[t], blockers.Normal(t), blockers.Rounding()))
    {
      continue;
    }
    rest.clear();
    bool cut = false;
    for (const ConvexPolygon& piece : pieces)
    {
      if (shadow.Cut(piece, rest, hidden))
      {
        cut = true;
      }
      else
      {
        rest.push_back(piece);
      }
    }
    if (cut)
    {
      touched = true;
      pieces.swap(rest);
    }
  }
  return touched;
}

} // namespace radiometry
