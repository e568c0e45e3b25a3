// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/SourceView.h"

#include "radiometry/geometry/Sampling.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace radiometry
{
namespace
{

constexpr int RaysAPart = 8;
/// Less than this of a source is what rounding left between shadows.
constexpr double Crack = 1e-10;

/// What is left of `whole` past shadows, given the sum of the pieces.
double Left(double sum, double whole)
{
  return sum <= Crack * whole ? 0.0 : std::min(sum, whole);
}

} // namespace

struct SourceView::Part
{
  ConvexPolygon Piece;
  double Whole = 0.0;
  double Visible = 0.0;
  bool Decided = false;
  bool Touched = false;

  bool operator<(const Part& other) const { return this->Whole < other.Whole; }
};

SourceView::SourceView(
  const AreaSources& sources, const Blockers* blockers, const OcclusionScene& occluders, int band)
  : Sources(sources)
  , Blocking(blockers)
  , Occluders(occluders)
  , Panes(band >= 0 ? occluders.Panes() : nullptr)
  , Band(band)
  , NearSurface(sources.Size(), 0)
{
  for (std::size_t k = 0; k < sources.Size() && blockers; ++k)
  {
    Box3 box;
    const ConvexPolygon& outline = sources[k].Outline;
    for (int c = 0; c < outline.N; ++c)
    {
      box.Add(outline.P[c]);
    }
    this->NearSurface[k] = blockers->AnyNear(box) ? 1 : 0;
  }
}

std::size_t SourceView::CountPanes(const std::vector<std::int32_t>& triangles) const
{
  return !this->Panes ? 0
                      : static_cast<std::size_t>(std::count_if(triangles.begin(), triangles.end(),
                          [&](std::int32_t t) { return this->IsPane(t); }));
}

/// What of the light passes between a point and a place on a source.
double SourceView::Passing(const ViewPoint& from, std::size_t s, const Vec3& place) const
{
  RayEnd to{ place, this->Sources[s].Triangle };
  if (to.Triangle < 0 && this->NearSurface[s])
  {
    to.Triangle = this->Occluders.Touching(
      to.Point, this->Sources[s].Normal, this->Blocking->Rounding());
    to.Close = to.Triangle < 0 && this->Occluders.TooClose(to.Point);
  }
  if (!this->Panes)
  {
    return this->Occluders.Occluded(from.End, to) ? 0.0 : 1.0;
  }
  static thread_local std::vector<double> bands;
  bands.resize(static_cast<std::size_t>(this->Sources.Bands()));
  return this->Occluders.Visible(from.End, to, bands.data()) ? bands[this->Band] : 0.0;
}

/// Cuts the shadows of few triangles out of the pieces: what then gets from them. Within what panes
/// cut, one ray tells what all of a piece sends through. Returns whether anything was hidden.
bool SourceView::Cut(const ViewPoint& from, std::size_t s,
  const std::vector<std::int32_t>& triangles, std::vector<ConvexPolygon>& pieces, double& visible,
  std::int64_t& rays) const
{
  const Vec3& x = from.Place;
  if (this->CountPanes(triangles) == 0)
  {
    const bool touched =
      CutShadows(x, *this->Blocking, triangles.data(), triangles.size(), pieces);
    visible = touched ? Factor(x, from.Normal, pieces) : visible;
    return touched;
  }
  static thread_local Pieces under;
  bool touched = false;
  bool tinted = false;
  for (const bool pane : { false, true })
  {
    for (const std::int32_t t : triangles)
    {
      if (this->IsPane(t) != pane)
      {
        continue;
      }
      under.clear();
      const bool cut = CutShadows(x, *this->Blocking, &t, 1, pieces, pane ? &under : nullptr);
      touched = touched || cut;
      tinted = tinted || (cut && pane);
      pieces.insert(pieces.end(), under.begin(), under.end());
    }
  }
  if (!touched)
  {
    return false;
  }
  visible = 0.0;
  for (const ConvexPolygon& piece : pieces)
  {
    const double whole = PointToVisiblePolygon(x, from.Normal, piece);
    if (!(whole > 0.0))
    {
      continue;
    }
    Vec3 middle;
    double area = 0.0;
    for (int k = 2; k < piece.N && tinted; ++k)
    {
      const Triangle3 fan{ piece.P[0], piece.P[k - 1], piece.P[k] };
      middle += Area(fan) * Centroid(fan);
      area += Area(fan);
    }
    rays += tinted ? 1 : 0;
    visible += whole *
      (tinted ? this->Passing(from, s, area > 0.0 ? middle / area : piece.P[0]) : 1.0);
  }
  return true;
}

/// Decides a part from the triangles in the pyramid before it, where they are few or hide it.
void SourceView::Look(
  const ViewPoint& from, std::size_t s, Part& part, std::int64_t& rays) const
{
  const AreaSource& source = this->Sources[s];
  static thread_local std::vector<std::int32_t> inside;
  ConvexPolygon apex;
  apex.Add(from.Place);
  Shaft pyramid(apex, part.Piece, this->Blocking->Rounding());
  pyramid.Add(from.Normal, from.Place);
  // Before the source's own plane, exactly: a piece of it may be too thin to tell.
  pyramid.Add(source.Normal, source.Outline.P[0]);
  inside.clear();
  const bool all = this->Blocking->InShaft(pyramid, MostProof, inside);
  inside.erase(std::remove(inside.begin(), inside.end(), from.End.Triangle), inside.end());
  const std::vector<std::int32_t> casters = all
    ? this->Blocking->Casters(inside, source.Normal, source.Outline.P[0])
    : std::vector<std::int32_t>{};
  part.Decided = true;
  if (inside.empty())
  {
    part.Visible = part.Whole;
  }
  else if (all && this->Few(casters))
  {
    static thread_local Pieces pieces;
    pieces.assign(1, part.Piece);
    part.Visible = part.Whole;
    part.Touched = this->Cut(from, s, casters, pieces, part.Visible, rays);
    part.Visible = Left(part.Visible, part.Whole);
  }
  else if (all && this->CountPanes(inside) == 0 &&
    this->Blocking->HideAll(apex, part.Piece, pyramid, inside))
  {
    part.Touched = true;
  }
  else
  {
    part.Decided = false;
    part.Touched = true;
  }
}

void SourceView::Sample(const ViewPoint& from, std::size_t s, const ConvexPolygon& piece,
  double whole, std::uint64_t key, SeenSource& result) const
{
  const AreaSource& source = this->Sources[s];
  double areas[ConvexPolygon::Capacity] = {};
  double area = 0.0;
  for (int k = 2; k < piece.N; ++k)
  {
    areas[k] = Area({ piece.P[0], piece.P[k - 1], piece.P[k] });
    area += areas[k];
  }
  const SobolSequence sequence(key);
  double weights = 0.0;
  double seen = 0.0;
  double squares = 0.0; // of the kernels
  for (int i = 0; i < RaysAPart; ++i)
  {
    const auto u = sequence(static_cast<std::uint32_t>(i));
    double at = u[2] * area;
    int k = 2;
    while (k < piece.N - 1 && at > areas[k])
    {
      at -= areas[k++];
    }
    const Vec3 to = TrianglePoint({ piece.P[0], piece.P[k - 1], piece.P[k] }, u[0], u[1]);
    const Vec3 r = to - from.Place;
    const double r2 = LengthSquared(r);
    const double kernel =
      std::max(0.0, Dot(from.Normal, r)) * std::max(0.0, -Dot(source.Normal, r)) / (r2 * r2);
    if (!(kernel > 0.0))
    {
      continue;
    }
    ++result.Rays;
    weights += kernel;
    squares += kernel * kernel;
    seen += kernel * this->Passing(from, s, to);
  }
  if (!(weights > 0.0))
  {
    return; // below the horizon, within rounding
  }
  const double share = seen / weights;
  const double n = weights * weights / squares;
  result.Visible += whole * share;
  // Laplace's rule: also when all agree, something may have gone unnoticed.
  const double doubt = (share * n + 0.5) / (n + 1.0);
  result.Variance += whole * whole * doubt * (1.0 - doubt) / n;
}

SeenSource SourceView::See(const ViewPoint& from, std::size_t s,
  const std::vector<std::int32_t>* known, int work, std::uint64_t key) const
{
  static thread_local Pieces pieces;
  const AreaSource& source = this->Sources[s];
  const Vec3& x = from.Place;
  SeenSource result;
  PiecesAbove(x, from.Normal, from.Horizon, source, pieces);
  result.Whole = Factor(x, from.Normal, pieces);
  result.Visible = result.Whole;
  if (!this->Blocking || !(result.Whole > 0.0) || (known && known->empty()))
  {
    return result;
  }
  if (known)
  {
    result.Touched = this->Cut(from, s, *known, pieces, result.Visible, result.Rays);
    result.Visible = Left(result.Visible, result.Whole);
    return result;
  }

  std::priority_queue<Part> open;
  result.Visible = 0.0;
  int parts = 0;
  const auto look = [&](const ConvexPolygon& piece) {
    Part part;
    part.Piece = piece;
    part.Whole = PointToVisiblePolygon(x, from.Normal, piece);
    ++parts;
    this->Look(from, s, part, result.Rays);
    result.Touched = result.Touched || part.Touched;
    if (part.Decided)
    {
      result.Visible += part.Visible;
    }
    else
    {
      open.push(part);
    }
  };
  const Pieces whole = pieces;
  for (const ConvexPolygon& piece : whole)
  {
    look(piece);
  }
  while (!open.empty() && parts + 2 <= work)
  {
    const Part part = open.top();
    open.pop();
    ConvexPolygon halves[2];
    Halve(part.Piece, halves);
    look(halves[0]);
    look(halves[1]);
  }
  for (std::uint64_t k = 0; !open.empty(); open.pop(), ++k)
  {
    this->Sample(from, s, open.top().Piece, open.top().Whole, Hash64(key, k), result);
  }
  return result;
}

} // namespace radiometry
