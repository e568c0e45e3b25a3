// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/WebRim.h"

#include "radiometry/geometry/Quadrature.h"
#include "radiometry/scene/Units.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double Pi = units::Pi;

/// The interval of ascending nodes that holds x: 0 below the first node, nodes.size() beyond the
/// last, else its upper node's index.
std::size_t Cell(const std::vector<double>& nodes, double x)
{
  return static_cast<std::size_t>(
    std::upper_bound(nodes.begin(), nodes.end(), x) - nodes.begin());
}

/// An angle brought into [0, 2 pi).
double Turned(double angle)
{
  return angle - 2.0 * Pi * std::floor(angle / (2.0 * Pi));
}

/// int f over [from, to], where f has no singularity nearer than `reach`: to rounding.
template <typename Function>
double GaussPieces(double from, double to, double reach, const Function& f)
{
  const int pieces = 1 + static_cast<int>((to - from) / (0.7 * reach));
  const double h = (to - from) / pieces;
  // The error falls by (4 reach/h)^2 with each point.
  const double ratio = std::max(4.0 * reach / std::max(h, 1e-300), 3.0);
  const int points = std::clamp(static_cast<int>(std::ceil(17.0 / std::log(ratio))), 2, 12);
  const LineRule& rule = GaussLegendre(points);
  double sum = 0.0;
  for (int p = 0; p < pieces; ++p)
  {
    for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
    {
      sum += rule.Weights[k] * f(from + (p + rule.Nodes[k]) * h);
    }
  }
  return sum * h;
}

} // namespace

WebEdge::WebEdge(const Vec3& start, const Vec3& normal, double length)
  : A(start)
  , T(Cross(normal, start))
  , Normal(normal)
  , Length(length)
  , Lift(normal.z)
  , Rise(std::hypot(A.z, T.z))
  , Closest(std::atan2(T.z, A.z))
  , Least(0.0)
  , Greatest(Pi)
{
}

Vec3 WebEdge::At(double s) const
{
  return std::cos(s) * this->A + std::sin(s) * this->T;
}

void WebEdge::Reach(double atStart, double atEnd)
{
  const double low = std::atan2(std::fabs(this->Lift), this->Rise);
  const bool first = Turned(this->Closest) < this->Length;
  const bool other = Turned(this->Closest + Pi) < this->Length;
  this->Least = first ? low : std::min(atStart, atEnd);
  this->Greatest = other ? Pi - low : std::max(atStart, atEnd);
}

void WebEdge::Cut(double s, std::vector<double>& cuts) const
{
  s = Turned(s);
  if (s > 0.0 && s < this->Length)
  {
    cuts.push_back(s);
  }
}

WebCorner WebRim::Locate(const Vec3& v) const
{
  WebCorner corner;
  const double r = std::hypot(v.x, v.y);
  corner.Theta = std::atan2(r, v.z);
  corner.Sine = r / std::hypot(r, v.z);
  corner.I = Cell(this->Grid.Theta, corner.Theta);
  corner.Psi = 0.0;
  corner.J = 1;
  if (this->Grid.Psis() > 1)
  {
    corner.Psi = std::atan2(v.y, v.x);
    if (this->Grid.Closed)
    {
      const double turn = 2.0 * Pi;
      corner.Psi -= turn * std::floor((corner.Psi - this->Grid.Psi.front()) / turn);
      corner.J = std::clamp(Cell(this->Grid.Psi, corner.Psi), std::size_t(1), this->Grid.Psis() - 1);
    }
    else
    {
      corner.J = Cell(this->Grid.Psi, corner.Psi);
    }
  }
  return corner;
}

/// int I sin from about.Theta to theta in column j; theta lies in cell i (as Cell() counts).
double WebRim::Column(std::size_t j, std::size_t i, double theta, const WebSum& about) const
{
  const std::size_t n = this->Grid.Thetas();
  const double* value = &this->Grid.Value[j * n];
  const double* below = &this->Grid.Below[j * n];
  // From `a` to `b` inside one cell of the grid; nothing outside it.
  const auto within = [&](std::size_t cell, double a, double b) {
    if (cell == 0 || cell >= n)
    {
      return 0.0;
    }
    const double* v = value + cell - 1;
    const double* t = &this->Grid.Theta[cell - 1];
    const double slope = (v[1] - v[0]) / (t[1] - t[0]);
    return CandelaWeb::SineIntegral(a, b, v[0] + slope * (a - t[0]), slope);
  };
  if (about.AtPole)
  {
    if (about.Theta == 0.0)
    {
      return i == 0 ? 0.0 : below[std::min(i, n) - 1] + within(i, this->Grid.Theta[i - 1], theta);
    }
    const double all = below[n - 1];
    return i == 0 ? -all
                  : (i >= n ? 0.0 : -within(i, theta, this->Grid.Theta[i]) - (all - below[i]));
  }
  if (i == about.I)
  {
    return within(i, about.Theta, theta);
  }
  const bool up = i > about.I;
  const std::size_t low = up ? about.I : i;
  const std::size_t high = up ? i : about.I;
  // From the lower of the two thetas to the upper.
  double sum = low == 0 ? 0.0
                        : (low >= n ? 0.0 : within(low, up ? about.Theta : theta, this->Grid.Theta[low]));
  sum += high >= n ? 0.0 : within(high, this->Grid.Theta[high - 1], up ? theta : about.Theta);
  const std::size_t first = low;              // node above the lower theta
  const std::size_t last = std::min(high, n) - 1; // node below the upper one
  if (last > first + 12)
  {
    sum += below[last] - below[first];
  }
  else
  {
    for (std::size_t k = first; k < last; ++k)
    {
      sum += this->Grid.CellFlux[j * (n - 1) + k];
    }
  }
  return up ? sum : -sum;
}

/// Adds int G d psi over a piece of an arc that crosses no line of the grid.
void WebRim::AddPiece(const WebEdge& edge, double from, double to, WebSum& sum) const
{
  const WebCorner middle = this->Locate(edge.At(0.5 * (from + to)));
  const std::size_t n = this->Grid.Thetas();
  const std::size_t m = this->Grid.Psis();
  if (middle.J == 0 || (m > 1 && middle.J >= m))
  {
    return; // outside the grid's planes
  }
  const std::size_t j = middle.J - 1;
  const double psi0 = this->Grid.Psi[j];
  const double perPsi = m > 1 ? 1.0 / (this->Grid.Psi[j + 1] - psi0) : 0.0;
  if (middle.I > 0 && middle.I < n)
  {
    const double* v = &this->Grid.Value[j * n + middle.I - 1];
    sum.Peak = std::max({ sum.Peak, v[0], v[1], m > 1 ? v[n] : 0.0, m > 1 ? v[n + 1] : 0.0 });
  }
  const auto g = [&](double theta, double psi) {
    const double first = this->Column(j, middle.I, theta, sum);
    if (m == 1)
    {
      return first;
    }
    const double t = (middle.Psi + std::remainder(psi - middle.Psi, 2.0 * Pi) - psi0) * perPsi;
    return first + t * (this->Column(j + 1, middle.I, theta, sum) - first);
  };
  const double mid = std::remainder(0.5 * (from + to) - edge.Closest, 2.0 * Pi);
  const bool low = std::fabs(edge.Lift) < 0.7; // else the arc stays away from both poles
  const bool nearFirst = low && std::fabs(mid) < 0.25 * Pi;
  const bool nearOther = low && std::fabs(mid) > 0.75 * Pi;
  double piece = 0.0;
  if (!sum.AtPole || (!nearFirst && !nearOther))
  {
    // d psi = (pole . normal)/sin^2(theta) ds
    const double reach =
      sum.AtPole ? 0.7 : std::max(middle.Sine - 0.5 * (to - from), 0.1 * middle.Sine);
    piece = edge.Lift * GaussPieces(from, to, reach, [&](double s) {
      const Vec3 d = edge.At(s);
      const double r2 = d.x * d.x + d.y * d.y;
      return r2 > 0.0 ? g(std::atan2(std::sqrt(r2), d.z), std::atan2(d.y, d.x)) / r2 : 0.0;
    });
  }
  else
  {
    // With tan s = sin(delta) sinh t from where the arc passes a pole at an angle delta:
    // tan theta = tan(delta) cosh t, psi = psi there +- atan(sinh t), d psi = +- dt/cosh t: what is
    // crowded at the pole is spread evenly.
    // The same number for every piece of the arc: their ends must meet.
    const double centre =
      edge.Closest + Pi * std::round((0.5 * (from + to) - edge.Closest) / Pi);
    const double delta = std::max(std::fabs(edge.Lift), 1e-20);
    const double tangent = delta / edge.Rise;
    const double turn = std::copysign(1.0, edge.Lift);
    const double toward = nearFirst ? -turn : turn;
    const double psiThere = std::atan2(toward * edge.Normal.y, toward * edge.Normal.x);
    const double t0 = std::asinh(std::tan(from - centre) / delta);
    const double t1 = std::asinh(std::tan(to - centre) / delta);
    piece = turn * GaussPieces(t0, t1, 0.5 * Pi, [&](double t) {
      const double cosh = std::cosh(t);
      const double fromPole = std::atan(tangent * cosh);
      return g(nearFirst ? fromPole : Pi - fromPole, psiThere + turn * std::atan(std::sinh(t))) / cosh;
    });
  }
  sum.Flux += piece;
  sum.Gross += std::fabs(piece);
  if (nearFirst || nearOther)
  {
    // Rounding turns what the arc crosses by 1e-16/delta about the pole: of second order where the
    // web is continuous.
    const double turned = std::min(4e-16 / std::max(std::fabs(edge.Lift), 4e-16), 1.0);
    sum.Rounding += std::fabs(piece) * (this->Grid.Seamless ? turned * turned : turned);
  }
}

void WebRim::FindCuts(
  const WebEdge& edge, const WebCorner& a, const WebCorner& b, bool clear, std::vector<double>& cuts) const
{
  cuts.clear();
  const std::vector<double>& thetas = this->Grid.Theta;
  const std::vector<double>& psis = this->Grid.Psi;
  for (auto at = std::lower_bound(thetas.begin(), thetas.end(), edge.Least);
       at != thetas.end() && *at <= edge.Greatest; ++at)
  {
    const double c = std::cos(*at);
    if (std::fabs(c) < edge.Rise)
    {
      const double spread = std::acos(c / edge.Rise);
      edge.Cut(edge.Closest - spread, cuts);
      edge.Cut(edge.Closest + spread, cuts);
    }
  }
  if (psis.size() > 1 && (a.J != b.J || !clear))
  {
    // Psi runs one way along an arc, less than half a turn: only the planes between its ends.
    const double turn = std::remainder(b.Psi - a.Psi, 2.0 * Pi);
    const bool sure = std::fabs(turn) < 3.0;
    for (const double psi : psis)
    {
      const double away = std::remainder(psi - (a.Psi + 0.5 * turn), 2.0 * Pi);
      if (sure && std::fabs(away) > 0.5 * std::fabs(turn) + 1e-9)
      {
        continue;
      }
      const Vec3 square{ -std::sin(psi), std::cos(psi), 0.0 };
      double s = std::atan2(-Dot(edge.A, square), Dot(edge.T, square));
      s += Cross(square, edge.At(s)).z < 0.0 ? 0.0 : Pi; // the plane's half on this side
      edge.Cut(s, cuts);
    }
  }
  if (!clear)
  {
    for (const double s : { -0.75, -0.25, 0.25, 0.75 })
    {
      edge.Cut(edge.Closest + s * Pi, cuts);
    }
  }
  std::sort(cuts.begin(), cuts.end());
}

WebSum WebRim::StartOf(
  const WebEdge* edges, std::size_t count, const WebCorner& corner, bool clear, double facing) const
{
  if (clear)
  {
    return { corner.Theta, corner.I, false };
  }
  bool holdsFirst = true;
  bool holdsOther = true;
  double least = Pi;
  double greatest = 0.0;
  for (std::size_t k = 0; k < count; ++k)
  {
    const WebEdge& e = edges[k];
    if (e.Length > 0.0)
    {
      // Edges of a polygon that faces the light turn clockwise about what lies inside.
      holdsFirst = holdsFirst && e.Lift * facing <= 0.0;
      holdsOther = holdsOther && e.Lift * facing >= 0.0;
      least = std::min(least, e.Least);
      greatest = std::max(greatest, e.Greatest);
    }
  }
  const bool other = holdsOther || (!holdsFirst && Pi - greatest < least);
  return { other ? Pi : 0.0, 0, true };
}

} // namespace radiometry
