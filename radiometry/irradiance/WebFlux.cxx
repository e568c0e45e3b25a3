// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/WebFlux.h"

#include "radiometry/geometry/Quadrature.h"
#include "radiometry/geometry/SolidAngle.h"
#include "radiometry/irradiance/WebRim.h"
#include "radiometry/scene/Units.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{

/// A polygon as it is given, and in the grid's axes seen from the light.
struct WebFlux::View
{
  const Vec3* Polygon;
  const Vec3* Local;
  std::size_t Count;
  const Vec3& From;
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

/// A small polygon inside one cell, clear of the poles.
double WebFlux::InCell(
  const View& view, const WebCorner& cell, double size, double sine, double& error) const
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
        psi -= psi > units::Pi ? 2.0 * units::Pi : 0.0;
        psi += psi < -units::Pi ? 2.0 * units::Pi : 0.0;
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
  const WebRim rim(this->Grid);
  thread_local std::vector<Vec3> local;
  thread_local std::vector<WebCorner> corners;
  thread_local std::vector<WebEdge> edges;
  thread_local std::vector<std::vector<double>> cuts;
  local.clear();
  corners.clear();
  edges.clear();
  cuts.resize(std::max(cuts.size(), count));
  for (std::size_t k = 0; k < count; ++k)
  {
    local.push_back(this->ToGrid(polygon[k] - from));
    corners.push_back(rim.Locate(local[k]));
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
    rim.FindCuts(edges[k], corners[k], corners[k + 1 < count ? k + 1 : 0], clear, cuts[k]);
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
  WebSum sum = rim.StartOf(edges.data(), count, corners[0], clear, this->Sign * facing);
  for (std::size_t k = 0; k < count; ++k)
  {
    // Psi does not change along a meridian, and at the pole it may pass G is 0.
    double at = edges[k].Lift == 0.0 ? edges[k].Length : 0.0;
    for (std::size_t c = 0; c <= cuts[k].size(); ++c)
    {
      const double to = c < cuts[k].size() ? cuts[k][c] : edges[k].Length;
      if (to > at)
      {
        rim.AddPiece(edges[k], at, to, sum);
        at = to;
      }
    }
  }
  error += 2e-13 * sum.Gross + sum.Rounding + 1e-15 * around * sum.Peak;
  const double flux = -this->Sign * sum.Flux;
  return flux * facing > 0.0 ? flux : 0.0;
}

} // namespace radiometry
