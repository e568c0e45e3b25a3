// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/ShadowCutter.h"

#include "radiometry/geometry/DividePolygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

namespace radiometry
{
namespace
{

/// More lines than this in a shaft: quarter the patch before cutting.
constexpr std::size_t MostLines = 6;
/// Error bars in standard deviations: at least 95 % of values within them, with room to spare.
constexpr double Deviations = 2.5;
/// More candidates than this: quarter without listing them all.
constexpr std::size_t MostCandidates = 256;

struct Part
{
  Triangle3 Corners;
  std::vector<Segment3> Lines; // empty with Overfull: not yet listed
  bool Overfull = false;
  double Flux = 0.0;

  bool operator<(const Part& other) const { return this->Flux < other.Flux; }
};

} // namespace

ShadowCutter::ShadowCutter(const SourceFlux& source, const Silhouettes* silhouettes,
  const OcclusionScene& occluders, int bands)
  : Source(source)
  , Outline(silhouettes)
  , Occluders(occluders)
  , Close(!source.Directional() && occluders.TooClose(source.GetLight().Position))
  , Bands(static_cast<std::size_t>(bands))
{
}

void ShadowCutter::Passing(const RayEnd& from, double* shares) const
{
  const Light& light = this->Source.GetLight();
  const bool any = this->Source.Directional()
    ? this->Occluders.VisibleDirection(from, -light.Direction, shares)
    : this->Occluders.Visible(from, { light.Position, -1, this->Close }, shares);
  if (!any)
  {
    std::fill(shares, shares + this->Bands, 0.0);
  }
}

/// Adds what gets to a piece all over which the same is true as at one point.
void ShadowCutter::AddPiece(
  const RayEnd& from, double flux, double quadrature, LitFlux& result) const
{
  ++result.Rays;
  double greatest = 1.0;
  if (this->Bands == 0)
  {
    greatest = this->Hidden(from) ? 0.0 : 1.0;
    result.Value += greatest * flux;
  }
  else
  {
    static thread_local std::vector<double> shares;
    shares.resize(this->Bands);
    this->Passing(from, shares.data());
    for (std::size_t b = 0; b < this->Bands; ++b)
    {
      result.Bands[b] += shares[b] * flux;
    }
    greatest = *std::max_element(shares.begin(), shares.end());
  }
  result.Error += greatest * quadrature;
}

/// Adds an estimate of what gets to a part from a few well spread points of it; returns the
/// estimate's variance.
double ShadowCutter::AddSamples(
  const Triangle3& corners, std::int32_t triangle, double flux, LitFlux& result) const
{
  static constexpr double spots[4][2] = { { 1.0 / 3, 1.0 / 3 }, { 1.0 / 6, 1.0 / 6 },
    { 2.0 / 3, 1.0 / 6 }, { 1.0 / 6, 2.0 / 3 } };
  static thread_local std::vector<double> shares;
  shares.assign(4 * std::max<std::size_t>(1, this->Bands), 0.0);
  for (int s = 0; s < 4; ++s)
  {
    const Vec3 p = (1.0 - spots[s][0] - spots[s][1]) * corners[0] + spots[s][0] * corners[1] +
      spots[s][1] * corners[2];
    if (this->Bands == 0)
    {
      shares[s] = this->Hidden({ p, triangle }) ? 0.0 : 1.0;
    }
    else
    {
      this->Passing({ p, triangle }, &shares[s * this->Bands]);
    }
  }
  result.Rays += 4;
  result.Exact = false;
  const std::size_t bands = std::max<std::size_t>(1, this->Bands);
  double greatest = 0.0;
  for (std::size_t b = 0; b < bands; ++b)
  {
    double sum = 0.0;
    double least = 1.0;
    double most = 0.0;
    for (int s = 0; s < 4; ++s)
    {
      sum += shares[s * bands + b];
      least = std::min(least, shares[s * bands + b]);
      most = std::max(most, shares[s * bands + b]);
    }
    (this->Bands == 0 ? result.Value : result.Bands[b]) += flux * 0.25 * sum;
    // Of so many one value, the others another; four of a kind still leave room for what they did
    // not meet.
    const double range = most > least ? most - least : std::max(most, 1.0 - least);
    const double met = most > least ? (sum - 4.0 * least) / range : 4.0;
    const double share = (met + 0.5) / 5.0;
    greatest = std::max(greatest, range * range * share * (1.0 - share) / 4.0);
  }
  return flux * flux * greatest;
}

bool ShadowCutter::Hidden(const RayEnd& from) const
{
  const Light& light = this->Source.GetLight();
  return this->Source.Directional()
    ? this->Occluders.OccludedDirection(from, -light.Direction)
    : this->Occluders.Occluded(from, { light.Position, -1, this->Close });
}

void ShadowCutter::Hidden(
  const std::vector<RayEnd>& from, std::vector<std::uint8_t>& hidden) const
{
  const Light& light = this->Source.GetLight();
  hidden.resize(from.size());
  if (this->Source.Directional())
  {
    this->Occluders.OccludedDirection(from.data(), from.size(), -light.Direction, hidden.data());
  }
  else
  {
    this->Occluders.Occluded(
      from.data(), from.size(), { light.Position, -1, this->Close }, hidden.data());
  }
}

void ShadowCutter::Cut(const Patch& patch, const Triangle3& part,
  const std::vector<Segment3>& lines, const Vec3& normal, LitFlux& result) const
{
  const Light& light = this->Source.GetLight();
  std::vector<Polygon> pieces{ Polygon(part.begin(), part.end()) };
  std::vector<Polygon> next;
  Polygon front;
  Polygon back;
  double size = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    size = std::max(size, Length(part[(k + 1) % 3] - part[k]));
  }
  for (const Segment3& line : lines)
  {
    const Vec3 toLight = this->Source.Directional() ? light.Direction : light.Position - line.A;
    const Vec3 n = Normalized(Cross(toLight, line.B - line.A));
    if (n == Vec3{})
    {
      continue; // seen end on: its shadow is a point
    }
    next.clear();
    for (const Polygon& piece : pieces)
    {
      DivideConvex(piece, n, line.A, 1e-13 * size, front, back);
      if (!front.empty())
      {
        next.push_back(front);
      }
      if (!back.empty())
      {
        next.push_back(back);
      }
    }
    pieces.swap(next);
  }
  for (const Polygon& piece : pieces)
  {
    double quadrature = 0.0;
    const double flux = this->Source.OnPolygon(piece.data(), piece.size(), normal, quadrature);
    if (flux <= 0.0)
    {
      continue;
    }
    this->AddPiece({ MiddleOfConvex(piece), patch.Triangle }, flux, quadrature, result);
  }
}

LitFlux ShadowCutter::Flux(const Patch& patch, const Vec3& normal, double unoccluded,
  const std::vector<Segment3>& crossings, double allowed, int work,
  const std::vector<Segment3>* candidates) const
{
  LitFlux result;
  if (!this->Outline)
  {
    result.Value = unoccluded;
    return result;
  }
  result.Bands.assign(this->Bands, 0.0);
  const auto finish = [&]() -> LitFlux& {
    if (this->Bands > 0)
    {
      result.Value = *std::max_element(result.Bands.begin(), result.Bands.end());
    }
    return result;
  };

  const auto list = [&](Part& part, const Part* parent) {
    if (parent && !parent->Overfull)
    {
      this->Outline->Narrow(part.Corners, parent->Lines, part.Lines);
      return;
    }
    if (candidates)
    {
      this->Outline->Narrow(part.Corners, *candidates, part.Lines);
    }
    else
    {
      part.Overfull = !this->Outline->InShaft(part.Corners, MostCandidates, part.Lines);
    }
    this->Outline->Narrow(part.Corners, crossings, part.Lines);
  };

  Part whole;
  whole.Corners = patch.Corners;
  whole.Flux = unoccluded;
  list(whole, nullptr);
  if (whole.Lines.empty() && !whole.Overfull)
  {
    // Nothing begins or ends in the shaft: one ray tells for all of the patch.
    this->AddPiece({ Centroid(patch.Corners), patch.Triangle }, unoccluded, 0.0, result);
    return finish();
  }

  std::priority_queue<Part> open;
  open.push(std::move(whole));
  double undecided = unoccluded * unoccluded; // sum of squares of the open parts' fluxes
  int parts = 1;
  while (!open.empty())
  {
    Part part = open.top();
    if (!part.Overfull && part.Lines.size() <= MostLines)
    {
      open.pop();
      undecided -= part.Flux * part.Flux;
      this->Cut(patch, part.Corners, part.Lines, normal, result);
      continue;
    }
    // A part of unknown visibility is wrong by flux/sqrt(12) (one standard deviation).
    const bool met = Deviations * std::sqrt(std::max(0.0, undecided) / 12.0) <= allowed;
    if (met || parts + 4 > work)
    {
      break;
    }
    open.pop();
    undecided -= part.Flux * part.Flux;
    const Triangle3& c = part.Corners;
    const Vec3 m[3] = { 0.5 * (c[0] + c[1]), 0.5 * (c[1] + c[2]), 0.5 * (c[2] + c[0]) };
    const std::array<Triangle3, 4> quarters{ Triangle3{ c[0], m[0], m[2] },
      Triangle3{ m[0], c[1], m[1] }, Triangle3{ m[2], m[1], c[2] }, Triangle3{ m[0], m[1], m[2] } };
    for (const Triangle3& q : quarters)
    {
      Part quarter;
      quarter.Corners = q;
      double quadrature = 0.0;
      quarter.Flux = this->Source.OnPolygon(q.data(), 3, normal, quadrature);
      if (quarter.Flux <= 0.0)
      {
        continue;
      }
      list(quarter, &part);
      undecided += quarter.Flux * quarter.Flux;
      open.push(std::move(quarter));
      ++parts;
    }
  }

  // What is left: a few well spread points of each part.
  double variance = 0.0;
  for (; !open.empty(); open.pop())
  {
    const Part& part = open.top();
    if (!part.Overfull && part.Lines.size() <= MostLines)
    {
      this->Cut(patch, part.Corners, part.Lines, normal, result);
      continue;
    }
    variance += this->AddSamples(part.Corners, patch.Triangle, part.Flux, result);
  }
  result.Error += Deviations * std::sqrt(variance);
  return finish();
}

} // namespace radiometry
