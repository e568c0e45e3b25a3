// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/AxialFlux.h"

#include "radiometry/geometry/Quadrature.h"
#include "radiometry/geometry/SolidAngle.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace radiometry
{
namespace
{

const double Pi = std::acos(-1.0);

template <typename Function>
double Gauss(double a, double b, const Function& f)
{
  static const LineRule& rule = GaussLegendre(10);
  double sum = 0.0;
  for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
  {
    sum += rule.Weights[k] * f(a + (b - a) * rule.Nodes[k]);
  }
  return (b - a) * sum;
}

/// int of x^(n-1) from c to 1, from the versine 1 - c: exact near the axis.
double PowerIntegral(double n, double versine)
{
  return versine >= 1.0 ? 1.0 / n : -std::expm1(n * std::log1p(-versine)) / n;
}

/// A great-circle arc u(s) = a cos s + t sin s, s in [0, Length].
struct Arc
{
  Vec3 A;
  Vec3 T;
  Vec3 Normal; // A x T
  double Length;

  /// `edge` is to - from, from the coordinates as they were given: keeps its digits for short arcs.
  Arc(const Vec3& from, const Vec3& to, const Vec3& edge)
    : A(Normalized(from))
  {
    const Vec3 m = Cross(from, edge);
    const double sine = radiometry::Length(m);
    this->Length = std::atan2(sine, Dot(from, to));
    this->Normal = sine > 0.0 ? m / sine : Vec3{};
    this->T = Cross(this->Normal, this->A);
  }
  Vec3 At(double s) const { return std::cos(s) * this->A + std::sin(s) * this->T; }

  /// Appends where the arc crosses the cone of this versine about the axis.
  void Crossings(const Vec3& axis, double versine, std::vector<double>& at) const
  {
    // cos s (A.w) + sin s (T.w) = 1 - versine; (A.w)^2 + (T.w)^2 = 1 - (Normal.w)^2
    const double x = Dot(this->A, axis);
    const double y = Dot(this->T, axis);
    const double sine = std::sqrt(std::max(0.0, versine * (2.0 - versine)));
    const double lift = std::fabs(Dot(this->Normal, axis));
    if (lift >= sine)
    {
      return;
    }
    const double peak = std::atan2(y, x);
    const double spread = std::atan2(std::sqrt((sine - lift) * (sine + lift)), 1.0 - versine);
    for (const double s : { peak - spread, peak + spread, peak - spread + 2.0 * Pi,
           peak + spread - 2.0 * Pi })
    {
      if (s > 0.0 && s < this->Length)
      {
        at.push_back(s);
      }
    }
  }
};

/// The azimuth swept about the axis between two directions of one great-circle arc shorter than pi.
double AzimuthSwept(const Vec3& from, const Vec3& to, const Vec3& axis)
{
  const Vec3 p = Cross(axis, from);
  const Vec3 q = Cross(axis, to);
  return std::atan2(Dot(axis, Cross(p, q)), Dot(p, q));
}

/// The mean intensity by a rule of degree 7, weighted by the solid angle's density, times the exact
/// solid angle.
double SmallPolygon(const Vec3* polygon, std::size_t count, const Vec3& axis,
  const AxialDistribution& distribution, const Vec3& from)
{
  const TriangleRule& rule = TriangleRuleOfDegree(7);
  double sum = 0.0;
  for (std::size_t k = 2; k < count; ++k)
  {
    const Vec3 triangle[3] = { polygon[0], polygon[k - 1], polygon[k] };
    double weighted = 0.0;
    double weights = 0.0;
    for (const TriangleRule::Node& q : rule.Nodes)
    {
      const Vec3 p = q.B0 * triangle[0] + q.B1 * triangle[1] + q.B2 * triangle[2] - from;
      const double l = Length(p);
      const double density = q.Weight / (l * l * l);
      weighted += density * distribution.IntensityAt(Versine(p / l, axis));
      weights += density;
    }
    sum += SolidAngle(triangle, 3, from) * (weighted / weights);
  }
  return sum;
}

} // namespace

AxialDistribution::AxialDistribution(
  double exponent, double cosOuter, bool smooth, double cosInner)
{
  *this = FromVersines(exponent, 1.0 - cosOuter, smooth, 1.0 - cosInner);
}

AxialDistribution AxialDistribution::FromVersines(
  double exponent, double outer, bool smooth, double inner)
{
  AxialDistribution made;
  made.Exponent = exponent;
  made.Outer = exponent > 0.0 ? std::min(outer, 1.0) : outer;
  made.SmoothEdge = smooth && inner < made.Outer;
  made.Inner = made.SmoothEdge ? inner : made.Outer;
  return made;
}

double AxialDistribution::IntensityAt(double versine) const
{
  const double v = std::max(versine, 0.0);
  if (v > this->Outer || (this->Exponent > 0.0 && v >= 1.0))
  {
    return 0.0;
  }
  double value = this->Exponent > 0.0 ? std::exp(this->Exponent * std::log1p(-v)) : 1.0;
  if (this->SmoothEdge && v > this->Inner)
  {
    const double t = (this->Outer - v) / (this->Outer - this->Inner);
    value *= t * t;
  }
  return value;
}

double AxialDistribution::Cumulative(double versine) const
{
  const double n = this->Exponent + 1.0;
  const double v = std::min(versine, this->Outer);
  const double inner = this->Inner;
  if (!this->SmoothEdge || v <= inner)
  {
    return this->Exponent == 0.0 ? v : PowerIntegral(n, v);
  }
  const double width = this->Outer - inner;
  double band = 0.0;
  if (this->Exponent == 0.0)
  {
    const double t = (this->Outer - v) / width;
    band = width * (1.0 - t * t * t) / 3.0;
  }
  else
  {
    // int of (1 - u)^e ((outer - u)/width)^2 du over [inner, v]: by Gauss, because the
    // antiderivatives would cancel where the band is narrow.
    const auto density = [&](double u) {
      const double t = (this->Outer - u) / width;
      return t * t * std::pow(std::max(1.0 - u, 0.0), this->Exponent);
    };
    const int panels = 1 + static_cast<int>((v - inner) * (2.0 + this->Exponent));
    for (int k = 0; k < panels; ++k)
    {
      const double h = (v - inner) / panels;
      band += Gauss(inner + k * h, inner + (k + 1) * h, density);
    }
  }
  return (this->Exponent == 0.0 ? inner : PowerIntegral(n, inner)) + band;
}

double AxialDistribution::TotalFlux() const
{
  return 2.0 * Pi * this->Cumulative(2.0);
}

double AxialFlux(const Vec3* polygon, std::size_t count, const Vec3& axis,
  const AxialDistribution& distribution, const Vec3& from, double* rounding)
{
  if (rounding)
  {
    *rounding = 0.0; // relative to the flux: the caller knows
  }
  if (count < 3)
  {
    return 0.0;
  }
  if (distribution.Isotropic())
  {
    return SolidAngle(polygon, count, from);
  }

  // How far the polygon reaches, and whether a cone's edge may cross it.
  const double whole = SolidAngle(polygon, count, from);
  if (whole == 0.0)
  {
    return 0.0;
  }
  std::vector<Arc> arcs;
  double size = 0.0;
  for (std::size_t k = 0; k < count; ++k)
  {
    const Vec3& next = polygon[(k + 1) % count];
    arcs.emplace_back(polygon[k] - from, next - from, next - polygon[k]);
    size = std::max(size, arcs.back().Length);
  }
  const double coneEdges[2] = { distribution.VersineLimit(), distribution.VersineInner() };
  std::vector<double> cuts;
  bool crossed = false;
  for (const Arc& arc : arcs)
  {
    for (const double versine : coneEdges)
    {
      cuts.clear();
      arc.Crossings(axis, versine, cuts);
      crossed = crossed || !cuts.empty();
    }
  }
  const bool within = std::all_of(arcs.begin(), arcs.end(), [&](const Arc& arc) {
    return Versine(arc.A, axis) < distribution.VersineInner();
  });
  if (distribution.GetExponent() == 0.0 && within && !crossed && distribution.VersineInner() <= 1.0)
  {
    return whole; // all of it inside a convex cone of constant intensity
  }
  // A cone smaller than the polygon may lie inside it without crossing its rim.
  const double nearest = Versine(arcs[0].A, axis);
  const double coneAngle =
    2.0 * std::asin(std::min(1.0, std::sqrt(0.5 * distribution.VersineInner())));
  const bool coneInside = 2.0 * std::asin(std::min(1.0, std::sqrt(0.5 * nearest))) < size &&
    coneAngle < 2.0 * size;
  if (!crossed && !coneInside && size * (1.0 + distribution.GetExponent()) < 0.02)
  {
    return SmallPolygon(polygon, count, axis, distribution, from);
  }

  const double outer = distribution.VersineLimit();
  const double beyond = distribution.Cumulative(2.0);
  double sum = 0.0;      // int of G d psi over the parts inside the cone
  double swept = 0.0;    // azimuth swept by the parts outside it
  double winding = 0.0;  // azimuth swept by the whole rim
  double terms = 2.0 * Pi * beyond; // what is added up, without signs
  bool anyInside = false;
  for (const Arc& arc : arcs)
  {
    if (arc.Length == 0.0)
    {
      continue;
    }
    const double lift = Dot(axis, arc.Normal);
    winding += AzimuthSwept(arc.At(0.0), arc.At(0.5 * arc.Length), axis) +
      AzimuthSwept(arc.At(0.5 * arc.Length), arc.At(arc.Length), axis);
    cuts.assign(1, 0.0);
    for (const double versine : coneEdges)
    {
      arc.Crossings(axis, versine, cuts);
    }
    cuts.push_back(arc.Length);
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    {
      const double a = cuts[k];
      const double b = cuts[k + 1];
      if (b <= a)
      {
        continue;
      }
      if (Versine(arc.At(0.5 * (a + b)), axis) >= outer)
      {
        swept += AzimuthSwept(arc.At(a), arc.At(b), axis);
        continue;
      }
      anyInside = true;
      // d psi = (axis . normal) / sin^2(phi) ds
      const auto integrand = [&](double s) {
        const double v = Versine(arc.At(s), axis);
        return v > 0.0 ? distribution.Cumulative(v) / (v * (2.0 - v)) : 0.5;
      };
      const int panels =
        1 + static_cast<int>(4.0 * (b - a) * (1.0 + std::sqrt(distribution.GetExponent())));
      const double h = (b - a) / panels;
      double part = 0.0;
      for (int p = 0; p < panels; ++p)
      {
        part += Gauss(a + p * h, a + (p + 1) * h, integrand);
      }
      sum += lift * part;
      terms += std::fabs(lift * part);
    }
  }
  // Seen from the source, the front's counter-clockwise turns against the azimuth about the axis,
  // and with it about the opposite pole.
  const double facing = whole > 0.0 ? 1.0 : -1.0;
  if (!anyInside)
  {
    // The rim never enters the cone: all of the cone falls through the polygon, or none.
    return winding * facing < -Pi ? facing * 2.0 * Pi * beyond : 0.0;
  }
  if (rounding)
  {
    *rounding = 4.0 * std::numeric_limits<double>::epsilon() * terms;
  }
  const double pole = winding * facing > Pi ? facing * 2.0 * Pi * beyond : 0.0;
  const double flux = pole - (sum + beyond * swept);
  return whole > 0.0 ? std::max(flux, 0.0) : std::min(flux, 0.0);
}

} // namespace radiometry
