// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/VisibleFactor.h"

#include <cmath>

namespace radiometry
{
namespace
{

/// More would be needed only for a shadow that is too small for its rounding.
constexpr int MostHalvings = 40;

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

/// A convex shadow on what lies beyond its caster: inside where all heights are positive.
struct Shadow
{
  struct Plane
  {
    Vec3 Normal;
    Vec3 Through;
    double Margin;
  };
  std::vector<Plane> Planes;
  std::vector<std::uint8_t> Seen; // faces of a body

  /// The planes through x and the rim of a flat caster, and its own. False where x lies on its plane:
  /// then it hides nothing.
  bool OfSheet(
    const Vec3& x, const Vec3* rim, std::size_t count, const Vec3& n, double rounding)
  {
    this->Planes.clear();
    const double height = Dot(n, x - rim[0]);
    if (std::fabs(height) <= rounding)
    {
      return false;
    }
    const double side = height < 0.0 ? 1.0 : -1.0; // so that inside and beyond are positive
    for (std::size_t k = 0; k < count; ++k)
    {
      const Vec3 normal = side * Cross(rim[k] - x, rim[(k + 1) % count] - rim[k]);
      this->Planes.push_back({ normal, x, rounding * std::sqrt(LengthSquared(normal)) });
    }
    this->Planes.push_back({ side * n, rim[0], rounding });
    return true;
  }

  /// The planes through x and the edges between the faces of a body that x sees and those that it
  /// does not. False where it sees none: x is inside or on the body.
  bool OfBody(const Vec3& x, const ConvexGroup& body, const Blockers& blockers)
  {
    this->Planes.clear();
    this->Seen.resize(body.Faces.size());
    std::uint8_t* seen = this->Seen.data();
    const double rounding = blockers.Rounding();
    int any = 0;
    for (std::size_t f = 0; f < body.Faces.size(); ++f)
    {
      const ConvexGroup::Face& face = body.Faces[f];
      seen[f] = Dot(face.Normal, x) - face.Height > rounding ? 1 : 0;
      any += seen[f];
    }
    for (const ConvexGroup::Edge& e : body.Edges)
    {
      if (seen[e.Faces[0]] != seen[e.Faces[1]])
      {
        Vec3 normal = Cross(e.A - x, e.B - e.A);
        normal = Dot(normal, body.Middle - x) < 0.0 ? -normal : normal;
        this->Planes.push_back({ normal, x, rounding * std::sqrt(LengthSquared(normal)) });
      }
    }
    return any > 0;
  }

  /// Adds to `rest` what of `piece` is not in the shadow, and to `hidden` (or null) what is. False
  /// where all of it is lit.
  bool Cut(const ConvexPolygon& piece, Pieces& rest, Pieces* hidden, int depth = 0) const
  {
    ConvexPolygon inside = piece;
    const std::size_t before = rest.size();
    ConvexPolygon next;
    ConvexPolygon outside;
    double heights[ConvexPolygon::Capacity];
    for (const Plane& plane : this->Planes)
    {
      const int side = Heights(inside, plane.Through, plane.Normal, plane.Margin, heights);
      if (side < 0)
      {
        rest.resize(before);
        return false;
      }
      if (side > 0)
      {
        continue;
      }
      if (!Split(inside, heights, next, outside))
      {
        rest.resize(before);
        return depth < MostHalvings && this->CutHalves(piece, rest, hidden, depth + 1);
      }
      if (next.N == 0)
      {
        rest.resize(before);
        return false;
      }
      if (outside.N > 0)
      {
        rest.push_back(outside);
      }
      inside = next;
    }
    if (hidden)
    {
      hidden->push_back(inside);
    }
    return true;
  }

  /// The same, where the corners were too many at once.
  bool CutHalves(const ConvexPolygon& piece, Pieces& rest, Pieces* hidden, int depth) const
  {
    ConvexPolygon halves[2];
    Halve(piece, halves);
    bool any = false;
    for (const ConvexPolygon& half : halves)
    {
      if (this->Cut(half, rest, hidden, depth))
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

bool CutShadows(const Vec3& x, const Blockers& blockers, const std::int32_t* casters,
  std::size_t count, Pieces& pieces, Pieces* hidden)
{
  static thread_local Pieces rest;
  static thread_local Shadow shadow;
  bool touched = false;
  for (std::size_t k = 0; k < count && !pieces.empty(); ++k)
  {
    const std::int32_t c = casters[k];
    if (!blockers.IsGroup(c))
    {
      if (!shadow.OfSheet(x, blockers[c].data(), 3, blockers.Normal(c), blockers.Rounding()))
      {
        continue;
      }
    }
    else
    {
      const ConvexGroup& group = blockers.Group(c);
      if (!group.Rim.empty())
      {
        if (!shadow.OfSheet(
              x, group.Rim.data(), group.Rim.size(), group.Normal, blockers.Rounding()))
        {
          continue;
        }
      }
      else if (!shadow.OfBody(x, group, blockers))
      {
        touched = CutShadows(x, blockers, group.Triangles.data(), group.Triangles.size(), pieces,
                    hidden) ||
          touched;
        continue;
      }
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
