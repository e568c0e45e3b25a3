// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/PairExchange.h"

#include "radiometry/geometry/ContourExchange.h"
#include "radiometry/geometry/PolygonFormFactor.h"
#include "radiometry/geometry/Quadrature.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double Epsilon = std::numeric_limits<double>::epsilon();
constexpr int Degrees[] = { 1, 2, 4, 5, 6, 8 };

/// Relative truncation of a rule of degree m on a patch of radius `ratio` times the distance. The
/// Taylor coefficients of 1/r^4 grow as (k+3 choose 3) and a rule keeps less than half of the
/// first it misses; the height over the other's plane, mean (1 + slope t), lifts each by a degree.
double Truncation(int degree, double ratio, double slope)
{
  const double k = degree;
  const double missed = (k + 4.0) * (k + 3.0) * (k + 2.0) / 6.0 * ratio;
  const double lifted = (k + 3.0) * (k + 2.0) * (k + 1.0) / 6.0 * slope;
  double power = 1.0;
  for (int n = 0; n < degree; ++n)
  {
    power *= ratio;
  }
  return 0.5 * (missed + lifted) * power / (1.0 - ratio);
}

/// The cheapest degree that keeps the bound, or 0 when none does.
int DegreeFor(double ratio, double slope, double tolerance)
{
  if (ratio < 0.5)
  {
    for (int degree : Degrees)
    {
      if (Truncation(degree, ratio, slope) <= tolerance)
      {
        return degree;
      }
    }
  }
  return 0;
}

/// Half the variation of the height of a polygon over a plane, relative to its mean: 0 to 1.
double Slope(const SmallPolygon& polygon, const Vec3& onPlane, const Vec3& n)
{
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (int k = 0; k < polygon.N; ++k)
  {
    const double h = std::max(0.0, Dot(n, polygon.P[k] - onPlane));
    low = std::min(low, h);
    high = std::max(high, h);
  }
  return high > 0.0 ? (high - low) / (high + low) : 1.0;
}

/// `top`: the greatest height of a corner over the plane.
SmallPolygon FrontPart(const ExchangePatch& p, const ExchangePatch& plane, double& top)
{
  double heights[3];
  for (int k = 0; k < 3; ++k)
  {
    heights[k] = HeightOverPlane(p.Corners[k], plane.Corners, plane.Normal);
  }
  top = std::max({ heights[0], heights[1], heights[2] });
  return ClipToPositive(SmallPolygon(p.Corners), heights);
}

/// Mean of f over a convex polygon times its area, by a triangle rule on its fan.
template <class F>
double Integrate(const SmallPolygon& polygon, int degree, F&& f)
{
  const TriangleRule& rule = TriangleRuleOfDegree(degree);
  double sum = 0.0;
  for (int k = 1; k + 1 < polygon.N; ++k)
  {
    const Vec3 e1 = polygon.P[k] - polygon.P[0];
    const Vec3 e2 = polygon.P[k + 1] - polygon.P[0];
    double part = 0.0;
    for (const auto& node : rule.Nodes)
    {
      part += node.Weight * f(polygon.P[0] + node.B1 * e1 + node.B2 * e2);
    }
    sum += part * 0.5 * Length(Cross(e1, e2));
  }
  return sum;
}

double ByRule(const SmallPolygon& a, const Vec3& na, int degreeA, const SmallPolygon& b,
  const Vec3& nb, int degreeB)
{
  return Integrate(a, degreeA,
           [&](const Vec3& x) {
             return Integrate(b, degreeB, [&](const Vec3& y) {
               const Vec3 r = y - x;
               const double r2 = LengthSquared(r);
               return std::max(0.0, Dot(na, r)) * std::max(0.0, -Dot(nb, r)) / (r2 * r2);
             });
           }) /
    Pi;
}

double SegmentDistance(const Vec3& p, const Vec3& a, const Vec3& b)
{
  const Vec3 ab = b - a;
  const double l2 = LengthSquared(ab);
  const double t = l2 > 0.0 ? std::clamp(Dot(p - a, ab) / l2, 0.0, 1.0) : 0.0;
  return Length(p - (a + t * ab));
}

/// Distance of a point from a convex planar polygon with unit normal n.
double PolygonDistance(const Vec3& p, const SmallPolygon& polygon, const Vec3& n)
{
  bool inside = true;
  double edge = std::numeric_limits<double>::infinity();
  for (int k = 0; k < polygon.N; ++k)
  {
    const Vec3& a = polygon.P[k];
    const Vec3& b = polygon.P[(k + 1) % polygon.N];
    inside = inside && Dot(Cross(b - a, p - a), n) >= 0.0;
    edge = std::min(edge, SegmentDistance(p, a, b));
  }
  return inside ? std::abs(Dot(p - polygon.P[0], n)) : edge;
}

/// Circumscribed circle about the mean of the corners.
void Bound(const SmallPolygon& polygon, Vec3& center, double& radius)
{
  center = {};
  for (int k = 0; k < polygon.N; ++k)
  {
    center += polygon.P[k];
  }
  center = center / polygon.N;
  radius = 0.0;
  for (int k = 0; k < polygon.N; ++k)
  {
    radius = std::max(radius, LengthSquared(polygon.P[k] - center));
  }
  radius = std::sqrt(radius);
}

/// Without division.
PairExchangeResult Exchange(const SmallPolygon& a, const Vec3& na, const SmallPolygon& b,
  const Vec3& nb, double tolerance, double absolute)
{
  PairExchangeResult result;
  Vec3 ca, cb;
  double ra = 0.0, rb = 0.0;
  Bound(a, ca, ra);
  Bound(b, cb, rb);
  const double d = Length(ca - cb);
  const double slopeA = Slope(a, b.P[0], nb);
  const double slopeB = Slope(b, a.P[0], na);

  // Far: both small beside the distance.
  const double fromA = d - rb;
  const double fromB = d - ra;
  if (fromA > 0.0 && fromB > 0.0)
  {
    const int degreeA = DegreeFor(ra / fromA, slopeA, 0.5 * tolerance);
    const int degreeB = DegreeFor(rb / fromB, slopeB, 0.5 * tolerance);
    if (degreeA && degreeB)
    {
      result.Method = ExchangeMethod::Rule;
      result.Value = ByRule(a, na, degreeA, b, nb, degreeB);
      result.Error = (Truncation(degreeA, ra / fromA, slopeA) +
                       Truncation(degreeB, rb / fromB, slopeB) + 16.0 * Epsilon) *
        result.Value;
      result.Rounding = 16.0 * Epsilon * result.Value;
      return result;
    }
  }

  // One small beside its distance from the other.
  const bool smallerIsA = ra <= rb;
  const SmallPolygon& small = smallerIsA ? a : b;
  const SmallPolygon& large = smallerIsA ? b : a;
  const Vec3& ns = smallerIsA ? na : nb;
  const Vec3& nl = smallerIsA ? nb : na;
  const double rs = smallerIsA ? ra : rb;
  const double distance = PolygonDistance(smallerIsA ? ca : cb, large, nl);
  const double ratio = distance > 0.0 ? rs / distance : 1.0;
  const double slope = smallerIsA ? slopeA : slopeB;
  if (const int degree = DegreeFor(ratio, slope, tolerance))
  {
    result.Method = ExchangeMethod::Closed;
    result.Value =
      Integrate(small, degree, [&](const Vec3& x) { return PointToVisiblePolygon(x, ns, large); });
    result.Error = (Truncation(degree, ratio, slope) + 1e-13) * result.Value;
    result.Rounding = 1e-13 * result.Value;
    return result;
  }

  result.Method = ExchangeMethod::Contour;
  result.Value =
    std::max(0.0, ContourExchange(small, large, tolerance, absolute, result.Error, result.Rounding));
  return result;
}

/// Two polygons whose exchange is a part of that of two patches.
struct Piece
{
  SmallPolygon A, B;
  PairExchangeResult Result;
};

/// Divides the larger polygon of a piece about the middle of its longest edge.
void Divide(const Piece& piece, std::vector<Piece>& parts)
{
  Vec3 center;
  double ra = 0.0, rb = 0.0;
  Bound(piece.A, center, ra);
  Bound(piece.B, center, rb);
  const bool divideA = ra > rb;
  const SmallPolygon& large = divideA ? piece.A : piece.B;
  int longest = 0;
  double length = -1.0;
  for (int k = 0; k < large.N; ++k)
  {
    const double l = LengthSquared(large.P[(k + 1) % large.N] - large.P[k]);
    if (l > length)
    {
      length = l;
      longest = k;
    }
  }
  const Vec3 middle = 0.5 * (large.P[longest] + large.P[(longest + 1) % large.N]);
  for (int k = 1; k < large.N; ++k)
  {
    SmallPolygon part;
    part.N = 3;
    part.P[0] = middle;
    part.P[1] = large.P[(longest + k) % large.N];
    part.P[2] = large.P[(longest + k + 1) % large.N];
    parts.push_back({ divideA ? part : piece.A, divideA ? piece.B : part, {} });
  }
}

/// Too many digits were lost (a nearly flat wedge, a sliver, a far pair at a fine tolerance): what
/// has the greatest error is divided, while that helps; what is then far from the other part goes to
/// the rules, which lose none.
PairExchangeResult Refined(const Piece& whole, const Vec3& na, const Vec3& nb, double tolerance,
  double absolute)
{
  constexpr int mostPieces = 48;
  std::vector<Piece> pieces{ whole }, parts;
  PairExchangeResult total = whole.Result;
  int evaluated = 0;
  while (evaluated < mostPieces &&
    total.Error > std::max(tolerance * total.Value, absolute))
  {
    const auto worst = std::max_element(pieces.begin(), pieces.end(),
      [](const Piece& l, const Piece& r) { return l.Result.Error < r.Result.Error; });
    parts.clear();
    Divide(*worst, parts);
    double error = 0.0;
    for (Piece& part : parts)
    {
      part.Result = Exchange(part.A, na, part.B, nb, tolerance, 0.1 * absolute);
      error += part.Result.Error;
      ++evaluated;
    }
    if (error >= 0.9 * worst->Result.Error)
    {
      break;
    }
    *worst = parts[0];
    pieces.insert(pieces.end(), parts.begin() + 1, parts.end());
    total = {};
    for (const Piece& piece : pieces)
    {
      total.Value += piece.Result.Value;
      total.Error += piece.Result.Error;
      total.Rounding += piece.Result.Rounding;
    }
    total.Method = ExchangeMethod::Divided;
  }
  return total;
}

/// What rounding of the corners may make of an exchange, relative: areas that swell, and planes that
/// turn and shift under what stands up to `topA` and `topB` over them, a third of that in the mean.
double CornersRounding(const ExchangePatch& a, const ExchangePatch& b, double topA, double topB)
{
  const double reach = Length(a.Center - b.Center) + a.Radius + b.Radius;
  const double shift = a.Rounding + b.Rounding;
  return a.Swelling + b.Swelling +
    3.0 * ((shift + b.Turn * reach) / topA + (shift + a.Turn * reach) / topB);
}

} // namespace

ExchangePatch::ExchangePatch(const Triangle3& corners)
  : Corners(corners)
  , Normal(Normalized(AreaNormal2(corners)))
  , Center(Centroid(corners))
  , Radius(0.0)
  , Area(radiometry::Area(corners))
  , Turn(0.0)
  , Swelling(0.0)
{
  double reach = 0.0, around = 0.0;
  Vec3 last = corners[2];
  for (const Vec3& c : corners)
  {
    this->Radius = std::max(this->Radius, Length(c - this->Center));
    reach = std::max(reach, LengthSquared(c));
    around += Length(c - last);
    last = c;
  }
  this->Rounding = Epsilon * std::sqrt(reach);
  if (this->Area > 0.0)
  {
    this->Swelling = this->Rounding * around / this->Area;
    this->Turn = 0.5 * this->Swelling; // at least the shift over the least height
  }
}

PairExchangeResult PairExchange(
  const ExchangePatch& i, const ExchangePatch& j, double relativeTolerance, double absolute)
{
  // Wholly behind: the usual case in a scene, decided from two heights.
  const Vec3 ij = j.Center - i.Center;
  if (!(i.Area > 0.0) || !(j.Area > 0.0) || Dot(i.Normal, ij) <= -(j.Radius) ||
    -Dot(j.Normal, ij) <= -(i.Radius))
  {
    return {};
  }
  double topA = 0.0, topB = 0.0;
  const SmallPolygon a = FrontPart(i, j, topA);
  if (a.N == 0)
  {
    return {};
  }
  const SmallPolygon b = FrontPart(j, i, topB);
  if (b.N == 0)
  {
    return {};
  }
  const double tolerance = std::clamp(relativeTolerance, 1e-14, 0.1);
  PairExchangeResult result = Exchange(a, i.Normal, b, j.Normal, tolerance, absolute);
  if (result.Method == ExchangeMethod::Contour &&
    result.Error > std::max(tolerance * result.Value, absolute))
  {
    result = Refined({ a, b, result }, i.Normal, j.Normal, tolerance, absolute);
  }
  const double corners =
    result.Value > 0.0 ? result.Value * CornersRounding(i, j, topA, topB) : 0.0;
  result.Error += corners;
  result.Rounding += corners;
  return result;
}

PairExchangeResult PairExchange(
  const std::vector<Triangle3>& i, const std::vector<Triangle3>& j, double relativeTolerance)
{
  std::vector<ExchangePatch> from, to;
  for (const Triangle3& t : i)
  {
    from.emplace_back(t);
  }
  for (const Triangle3& t : j)
  {
    to.emplace_back(t);
  }
  // What is small beside the sum need not have its digits: a first, coarse sum tells.
  PairExchangeResult sum;
  double coarse = 0.0;
  for (const ExchangePatch& p : from)
  {
    for (const ExchangePatch& q : to)
    {
      coarse += PairExchange(p, q, 0.1).Value;
    }
  }
  const double absolute =
    0.5 * relativeTolerance * coarse / std::max<double>(1.0, from.size() * to.size());
  for (const ExchangePatch& p : from)
  {
    for (const ExchangePatch& q : to)
    {
      const PairExchangeResult pair = PairExchange(p, q, 0.5 * relativeTolerance, absolute);
      sum.Value += pair.Value;
      sum.Error += pair.Error;
      sum.Rounding += pair.Rounding;
      sum.Method = std::max(sum.Method, pair.Method);
    }
  }
  return sum;
}

} // namespace radiometry
