// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/WebFlux.h"

#include "radiometry/geometry/Quadrature.h"
#include "radiometry/geometry/SolidAngle.h"
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

/// A direction by its angles in the grid, with the cell that it lies in.
struct WebFlux::Corner
{
  double Theta, Psi, Sine;
  std::size_t I, J; // as Cell() counts; J is 1 where psi does not matter
};

/// A polygon as it is given, and in the grid's axes seen from the light.
struct WebFlux::View
{
  const Vec3* Polygon;
  const Vec3* Local;
  std::size_t Count;
  const Vec3& From;
};

/// A great-circle arc a cos s + t sin s, s in [0, Length], in the grid's axes.
struct WebFlux::Edge
{
  Vec3 A, T, Normal;
  double Length;
  double Lift;    // of the pole over the arc's plane: cosine to its normal
  double Rise;    // greatest cos(theta) on the circle
  double Closest; // s there
  double Least, Greatest; // theta on the arc

  Edge(const Vec3& start, const Vec3& normal, double length)
    : A(start)
    , T(Cross(normal, start))
    , Normal(normal)
    , Length(length)
    , Lift(normal.z)
    , Rise(std::hypot(A.z, T.z))
    , Closest(std::atan2(T.z, A.z))
  {
  }
  /// The theta that the arc reaches, from those of its ends and its nearest points to the poles.
  void Reach(double atStart, double atEnd)
  {
    const double low = std::atan2(std::fabs(this->Lift), this->Rise);
    const bool first = Turned(this->Closest) < this->Length;
    const bool other = Turned(this->Closest + Pi) < this->Length;
    this->Least = first ? low : std::min(atStart, atEnd);
    this->Greatest = other ? Pi - low : std::max(atStart, atEnd);
  }
  void Cut(double s, std::vector<double>& cuts) const
  {
    s = Turned(s);
    if (s > 0.0 && s < this->Length)
    {
      cuts.push_back(s);
    }
  }
  Vec3 At(double s) const { return std::cos(s) * this->A + std::sin(s) * this->T; }
};

/// The integral along the rim, and where G counts from: a theta near the polygon, or a pole.
struct WebFlux::Sum
{
  double Theta;
  std::size_t I; // its cell
  bool AtPole;   // Theta is 0 or pi
  double Flux = 0.0;
  double Gross = 0.0; // the sum of the pieces' sizes
  double Rounding = 0.0;
  double Peak = 0.0; // greatest value of the cells that the rim passes
};

WebFlux::WebFlux(std::shared_ptr<const CandelaWeb> web, const Vec3& axis, const Vec3& reference)
  : Web(std::move(web))
  , Grid(this->Web->Grid())
{
  const Vec3 x = reference;
  const Vec3 y = Cross(reference, axis);
  const auto toScene = [&](const Vec3& v) { return v.x * x + v.y * y - v.z * axis; };
  this->Rows[0] = toScene(this->Grid.AxisX);
  this->Rows[1] = toScene(this->Grid.AxisY);
  this->Rows[2] = toScene(this->Grid.Pole);
  this->Sign = this->Grid.Handedness;
}

Vec3 WebFlux::ToGrid(const Vec3& v) const
{
  return { Dot(v, this->Rows[0]), Dot(v, this->Rows[1]), Dot(v, this->Rows[2]) };
}

double WebFlux::Intensity(const Vec3& direction) const
{
  const Vec3 v = this->ToGrid(direction);
  return this->Web->Intensity(
    v.x * this->Grid.AxisX + v.y * this->Grid.AxisY + v.z * this->Grid.Pole);
}

WebFlux::Corner WebFlux::Locate(const Vec3& v) const
{
  Corner corner;
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

/// A small polygon inside one cell, clear of the poles.
double WebFlux::InCell(
  const View& view, const Corner& cell, double size, double sine, double& error) const
{
  const std::size_t n = this->Grid.Thetas();
  const std::size_t m = this->Grid.Psis();
  if (cell.I == 0 || cell.I >= n || cell.J == 0 || (m > 1 && cell.J >= m))
  {
    return 0.0; // outside the grid
  }
  const std::size_t i = cell.I - 1;
  const std::size_t j = cell.J - 1;
  const double* low = &this->Grid.Value[j * n + i];
  const double* high = m > 1 ? low + n : low;
  if (low[0] == 0.0 && low[1] == 0.0 && high[0] == 0.0 && high[1] == 0.0)
  {
    return 0.0;
  }
  const double theta0 = this->Grid.Theta[i];
  const double perTheta = 1.0 / (this->Grid.Theta[i + 1] - theta0);
  const double psi0 = m > 1 ? this->Grid.Psi[j] : 0.0;
  const double perPsi = m > 1 ? 1.0 / (this->Grid.Psi[j + 1] - psi0) : 0.0;
  const TriangleRule& rule = TriangleRuleOfDegree(5);
  double flux = 0.0;
  double whole = 0.0;
  for (std::size_t k = 2; k < view.Count; ++k)
  {
    double weighted = 0.0;
    double weights = 0.0;
    for (const TriangleRule::Node& q : rule.Nodes)
    {
      const Vec3 p = q.B0 * view.Local[0] + q.B1 * view.Local[k - 1] + q.B2 * view.Local[k];
      const double l2 = Dot(p, p);
      const double density = q.Weight / (l2 * std::sqrt(l2));
      const double s = (std::atan2(std::sqrt(p.x * p.x + p.y * p.y), p.z) - theta0) * perTheta;
      double value = low[0] + s * (low[1] - low[0]);
      if (m > 1)
      {
        double psi = std::atan2(p.y, p.x) - psi0;
        psi -= psi > Pi ? 2.0 * Pi : 0.0;
        psi += psi < -Pi ? 2.0 * Pi : 0.0;
        value += psi * perPsi * (high[0] + s * (high[1] - high[0]) - value);
      }
      weighted += density * value;
      weights += density;
    }
    const Vec3 triangle[3] = { view.Polygon[0], view.Polygon[k - 1], view.Polygon[k] };
    const double omega = SolidAngle(triangle, 3, view.From);
    whole += omega;
    flux += omega * (weighted / weights);
  }
  const double greatest = std::max({ low[0], low[1], high[0], high[1] });
  const double ratio = size / sine;
  const double ratio3 = ratio * ratio * ratio;
  error += std::fabs(whole) * greatest * (0.3 * ratio3 * ratio3 + 1e-14);
  return flux;
}

/// int I sin from about.Theta to theta in column j; theta lies in cell i (as Cell() counts).
double WebFlux::Column(std::size_t j, std::size_t i, double theta, const Sum& about) const
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
void WebFlux::AddPiece(const Edge& edge, double from, double to, Sum& sum) const
{
  const Corner middle = this->Locate(edge.At(0.5 * (from + to)));
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

/// Where the arc crosses lines of the grid (and, near a pole, changes its way of integration).
void WebFlux::FindCuts(
  const Edge& edge, const Corner& a, const Corner& b, bool clear, std::vector<double>& cuts) const
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

/// Where G had best count from: it must not be 0 at a pole that the polygon holds or nearly touches.
WebFlux::Sum WebFlux::StartOf(
  const Edge* edges, std::size_t count, const Corner& corner, bool clear, double facing) const
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
    const Edge& e = edges[k];
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

/// A polygon far smaller than what rounding leaves of differences of angles, across lines of the
/// grid: the mean intensity, which varies by next to nothing.
double WebFlux::AcrossCells(const View& view, double& error) const
{
  double flux = 0.0;
  double whole = 0.0;
  double least = 1.0;
  double greatest = 0.0;
  for (std::size_t k = 2; k < view.Count; ++k)
  {
    const Vec3 triangle[3] = { view.Polygon[0], view.Polygon[k - 1], view.Polygon[k] };
    const double omega = SolidAngle(triangle, 3, view.From);
    double mean = 0.0;
    for (const TriangleRule::Node& q : TriangleRuleOfDegree(5).Nodes)
    {
      const Vec3 p = q.B0 * view.Local[0] + q.B1 * view.Local[k - 1] + q.B2 * view.Local[k];
      const double value = this->Web->Intensity(
        p.x * this->Grid.AxisX + p.y * this->Grid.AxisY + p.z * this->Grid.Pole);
      mean += q.Weight * value;
      least = std::min(least, value);
      greatest = std::max(greatest, value);
    }
    flux += omega * mean;
    whole += omega;
  }
  error += std::fabs(whole) * ((greatest - least) + 1e-14 * greatest);
  return flux;
}

double WebFlux::OnPolygon(
  const Vec3* polygon, std::size_t count, double& error, const Vec3& from) const
{
  if (count < 3)
  {
    return 0.0;
  }
  thread_local std::vector<Vec3> local;
  thread_local std::vector<Corner> corners;
  thread_local std::vector<Edge> edges;
  thread_local std::vector<std::vector<double>> cuts;
  local.clear();
  corners.clear();
  edges.clear();
  cuts.resize(std::max(cuts.size(), count));
  for (std::size_t k = 0; k < count; ++k)
  {
    local.push_back(this->ToGrid(polygon[k] - from));
    corners.push_back(this->Locate(local[k]));
  }
  double around = 0.0;
  double sine = 1.0;
  bool oneCell = true;
  for (std::size_t k = 0; k < count; ++k)
  {
    // In the scene's axes, where coordinates may be exact: short and nearly straight arcs keep their
    // digits.
    const std::size_t next = k + 1 < count ? k + 1 : 0;
    const Vec3 start = polygon[k] - from;
    const Vec3 m = Cross(start, polygon[next] - polygon[k]);
    const double area = Length(m);
    const Vec3 normal = area > 0.0 ? this->Sign * this->ToGrid(m / area) : Vec3{};
    edges.emplace_back(
      Normalized(local[k]), normal, std::atan2(area, Dot(start, polygon[next] - from)));
    edges[k].Reach(corners[k].Theta, corners[next].Theta);
    around += edges[k].Length;
    sine = std::min(sine, corners[k].Sine);
    oneCell = oneCell && corners[k].I == corners[0].I && corners[k].J == corners[0].J;
  }
  const double size = 0.5 * around; // no two points are further apart
  const bool clear = sine > 2.0 * size;
  bool crossed = !oneCell;
  for (std::size_t k = 0; k < count; ++k)
  {
    this->FindCuts(edges[k], corners[k], corners[k + 1 < count ? k + 1 : 0], clear, cuts[k]);
    crossed = crossed || !cuts[k].empty();
  }
  const View view{ polygon, local.data(), count, from };
  if (clear && !crossed && size < 0.03 * sine)
  {
    return this->InCell(view, corners[0], size, sine, error);
  }
  if (clear && size < 1e-8 * sine)
  {
    return this->AcrossCells(view, error);
  }
  const double facing = SolidAngle(polygon, count, from) < 0.0 ? -1.0 : 1.0;
  Sum sum = this->StartOf(edges.data(), count, corners[0], clear, this->Sign * facing);
  for (std::size_t k = 0; k < count; ++k)
  {
    // Psi does not change along a meridian, and at the pole it may pass G is 0.
    double at = edges[k].Lift == 0.0 ? edges[k].Length : 0.0;
    for (std::size_t c = 0; c <= cuts[k].size(); ++c)
    {
      const double to = c < cuts[k].size() ? cuts[k][c] : edges[k].Length;
      if (to > at)
      {
        this->AddPiece(edges[k], at, to, sum);
        at = to;
      }
    }
  }
  error += 2e-13 * sum.Gross + sum.Rounding + 1e-15 * around * sum.Peak;
  const double flux = -this->Sign * sum.Flux;
  return flux * facing > 0.0 ? flux : 0.0;
}

} // namespace radiometry
