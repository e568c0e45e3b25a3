// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/scene/CandelaWeb.h"

#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

/// Files give angles with a few decimals; a circle that closes to this many degrees is closed.
constexpr double SameAngle = 1e-3;

bool Same(double a, double b)
{
  return std::fabs(a - b) <= SameAngle;
}

void CheckAngles(const std::string& name, const std::vector<double>& angles, double low,
  double high, std::size_t least)
{
  if (angles.size() < least)
  {
    throw InputError(name, -1, static_cast<double>(angles.size()),
      "at least " + std::to_string(least) + " angle" + (least == 1 ? "" : "s"));
  }
  for (std::size_t k = 0; k < angles.size(); ++k)
  {
    if (!std::isfinite(angles[k]) || angles[k] < low - SameAngle || angles[k] > high + SameAngle)
    {
      throw InputError(name, static_cast<long long>(k), angles[k],
        "degrees from " + std::to_string(static_cast<int>(low)) + " to " +
          std::to_string(static_cast<int>(high)));
    }
    if (k > 0 && !(angles[k] > angles[k - 1]))
    {
      throw InputError(
        name, static_cast<long long>(k), angles[k], "more than the angle before it");
    }
  }
}

/// Where `x` lies between ascending nodes: the interval's index and the fraction in it.
std::size_t Interval(const std::vector<double>& nodes, double x, double& fraction)
{
  const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
  const std::size_t i = static_cast<std::size_t>(above - nodes.begin()) - 1;
  fraction = (x - nodes[i]) / (nodes[i + 1] - nodes[i]);
  return i;
}

/// Planes in a list that grows at either end, each an angle with its own column of values.
struct Planes
{
  std::vector<double> Angles;
  std::vector<std::size_t> Source; // the given plane that has its values

  /// Appends the mirror images of the planes about `mirror` (the last angle), up to `end`.
  void MirrorAbove(double mirror, double end)
  {
    for (std::size_t k = this->Angles.size(); k-- > 0;)
    {
      const double image = 2.0 * mirror - this->Angles[k];
      if (image > this->Angles.back() + SameAngle && image <= end + SameAngle)
      {
        this->Angles.push_back(image);
        this->Source.push_back(this->Source[k]);
      }
    }
  }
};

} // namespace

double CandelaWeb::SineIntegral(double from, double to, double a, double b)
{
  const double middle = 0.5 * (from + to);
  const double h = 0.5 * (to - from);
  const double sine = std::sin(h);
  // sin h - h cos h loses digits for a small h: its series there.
  const double h2 = h * h;
  const double moment = std::fabs(h) > 0.2
    ? sine - h * std::cos(h)
    : h * h2 * (1.0 / 3.0 - h2 * (1.0 / 30.0 - h2 * (1.0 / 840.0 - h2 * (1.0 / 45360.0 - h2 / 3991680.0))));
  return 2.0 * ((a + b * h) * std::sin(middle) * sine + b * std::cos(middle) * moment);
}

CandelaWeb::CandelaWeb(WebType type, std::vector<double> horizontal, std::vector<double> vertical,
  std::vector<double> values, const std::string& name)
  : Type(type)
  , Horizontal(std::move(horizontal))
  , Vertical(std::move(vertical))
  , Values(std::move(values))
{
  this->Check(name);
  this->Greatest = *std::max_element(this->Values.begin(), this->Values.end());
  for (double& value : this->Values)
  {
    value /= this->Greatest;
  }
  this->Complete(name);
  this->MakePolar();
}

void CandelaWeb::Check(const std::string& name) const
{
  if (this->Type != WebType::C && this->Type != WebType::B && this->Type != WebType::A)
  {
    throw InputError(name + "Type", -1, static_cast<double>(this->Type), "1 C, 2 B or 3 A");
  }
  const bool c = this->Type == WebType::C;
  CheckAngles(name + "Horizontal", this->Horizontal, c ? -360.0 : -180.0, c ? 360.0 : 180.0, c ? 1 : 2);
  CheckAngles(name + "Vertical", this->Vertical, c ? 0.0 : -180.0, 180.0, 2);
  const std::vector<double>& latitude =
    this->Type == WebType::B ? this->Horizontal : this->Vertical;
  if (!c)
  {
    CheckAngles(name + (this->Type == WebType::B ? "Horizontal" : "Vertical"), latitude, -90.0, 90.0, 2);
  }
  const std::size_t expected = this->Horizontal.size() * this->Vertical.size();
  if (this->Values.size() != expected)
  {
    throw InputError(name, -1, std::to_string(this->Values.size()) + " values",
      std::to_string(expected) + " (horizontal by vertical angles)");
  }
  bool any = false;
  for (std::size_t k = 0; k < this->Values.size(); ++k)
  {
    if (!std::isfinite(this->Values[k]) || this->Values[k] < 0.0)
    {
      throw InputError(
        name, static_cast<long long>(k), this->Values[k], "a finite number, not negative");
    }
    any = any || this->Values[k] > 0.0;
  }
  if (!any)
  {
    throw InputError(name, -1, "no value above 0", "a distribution that sends light");
  }
}

void CandelaWeb::Complete(const std::string& name)
{
  const std::size_t given = this->Vertical.size();
  Planes planes;
  planes.Angles = this->Horizontal;
  for (std::size_t k = 0; k < this->Horizontal.size(); ++k)
  {
    planes.Source.push_back(k);
  }
  const double first = this->Horizontal.front();
  const double last = this->Horizontal.back();
  if (this->Type == WebType::C)
  {
    const bool half = Same(last - first, 180.0);
    if (this->Horizontal.size() == 1)
    {
      planes.Angles = { 0.0 };
    }
    else if (Same(first, 0.0) && Same(last, 90.0))
    {
      planes.MirrorAbove(90.0, 180.0);
      planes.MirrorAbove(180.0, 360.0);
    }
    else if (half && (Same(first, 0.0) || Same(first, 90.0) || Same(first, -90.0)))
    {
      planes.MirrorAbove(last, first + 360.0);
    }
    else if (last - first > 360.0 + SameAngle)
    {
      throw InputError(name + "Horizontal", static_cast<long long>(this->Horizontal.size()) - 1,
        last, "at most 360 degrees after the first");
    }
    else if (!Same(last - first, 360.0))
    {
      if (last - first <= 180.0 + SameAngle)
      {
        throw InputError(name + "Horizontal", static_cast<long long>(this->Horizontal.size()) - 1,
          last, "0 alone, or up to 90, 180, 270 (from 90) or more than 180");
      }
      planes.Angles.push_back(first + 360.0); // the first plane closes the circle
      planes.Source.push_back(0);
    }
    if (planes.Angles.size() > 1)
    {
      planes.Angles.back() = planes.Angles.front() + 360.0;
    }
  }
  const auto mirrorBelow = [](Planes& p) {
    Planes all;
    for (std::size_t k = p.Angles.size(); k-- > 1;)
    {
      all.Angles.push_back(-p.Angles[k]);
      all.Source.push_back(p.Source[k]);
    }
    all.Angles.insert(all.Angles.end(), p.Angles.begin(), p.Angles.end());
    all.Source.insert(all.Source.end(), p.Source.begin(), p.Source.end());
    p = all;
  };
  Planes rows;
  rows.Angles = this->Vertical;
  for (std::size_t k = 0; k < given; ++k)
  {
    rows.Source.push_back(k);
  }
  if (this->Type != WebType::C)
  {
    for (Planes* p : { &planes, &rows })
    {
      if (Same(p->Angles.front(), 0.0))
      {
        p->Angles.front() = 0.0;
        mirrorBelow(*p);
      }
    }
  }
  std::vector<double> values;
  values.reserve(planes.Angles.size() * rows.Angles.size());
  for (const std::size_t plane : planes.Source)
  {
    for (const std::size_t row : rows.Source)
    {
      values.push_back(this->Values[plane * given + row]);
    }
  }
  this->Horizontal = std::move(planes.Angles);
  this->Vertical = std::move(rows.Angles);
  this->Values = std::move(values);
}

void CandelaWeb::MakePolar()
{
  PolarGrid& grid = this->Polar;
  const bool b = this->Type == WebType::B;
  const std::vector<double>& theta = b ? this->Horizontal : this->Vertical;
  const std::vector<double>& psi = b ? this->Vertical : this->Horizontal;
  const double shift = this->Type == WebType::C ? 0.0 : 90.0;
  for (const double angle : theta)
  {
    grid.Theta.push_back(units::Radians(std::clamp(angle + shift, 0.0, 180.0)));
  }
  for (const double angle : psi)
  {
    grid.Psi.push_back(units::Radians(angle));
  }
  grid.Closed = psi.size() == 1 || Same(psi.back() - psi.front(), 360.0);
  if (grid.Closed && psi.size() > 1)
  {
    grid.Psi.back() = grid.Psi.front() + 2.0 * units::Pi;
  }
  switch (this->Type)
  {
    case WebType::C:
      grid.AxisX = { 1.0, 0.0, 0.0 };
      grid.AxisY = { 0.0, 1.0, 0.0 };
      grid.Pole = { 0.0, 0.0, -1.0 };
      break;
    case WebType::B:
      grid.AxisX = { 0.0, 0.0, -1.0 };
      grid.AxisY = { 1.0, 0.0, 0.0 };
      grid.Pole = { 0.0, 1.0, 0.0 };
      break;
    case WebType::A:
      grid.AxisX = { 0.0, 0.0, -1.0 };
      grid.AxisY = { 0.0, -1.0, 0.0 };
      grid.Pole = { -1.0, 0.0, 0.0 };
      break;
  }
  grid.Handedness = Dot(Cross(grid.AxisX, grid.AxisY), grid.Pole);

  const std::size_t n = grid.Thetas();
  const std::size_t m = grid.Psis();
  grid.Value.resize(n * m);
  grid.Below.resize(n * m);
  grid.CellFlux.resize((n - 1) * m);
  for (std::size_t j = 0; j < m; ++j)
  {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i)
    {
      grid.Value[j * n + i] = b ? this->Values[i * m + j] : this->Values[j * n + i];
    }
    for (std::size_t i = 0; i + 1 < n; ++i)
    {
      const double* v = &grid.Value[j * n + i];
      const double width = grid.Theta[i + 1] - grid.Theta[i];
      const double cell =
        SineIntegral(grid.Theta[i], grid.Theta[i + 1], v[0], (v[1] - v[0]) / width);
      grid.Below[j * n + i] = sum;
      grid.CellFlux[j * (n - 1) + i] = cell;
      sum += cell;
    }
    grid.Below[j * n + n - 1] = sum;
  }
  grid.Seamless = grid.Closed &&
    std::equal(grid.Value.begin(), grid.Value.begin() + static_cast<std::ptrdiff_t>(n),
      grid.Value.end() - static_cast<std::ptrdiff_t>(n));
  this->Flux = m == 1 ? 2.0 * units::Pi * grid.Below[n - 1] : 0.0;
  for (std::size_t j = 0; j + 1 < m; ++j)
  {
    this->Flux += 0.5 * (grid.Psi[j + 1] - grid.Psi[j]) *
      (grid.Below[j * n + n - 1] + grid.Below[(j + 1) * n + n - 1]);
  }
}

Vec3 CandelaWeb::DirectionOf(double horizontal, double vertical) const
{
  const bool b = this->Type == WebType::B;
  const double shift = this->Type == WebType::C ? 0.0 : 90.0;
  const double theta = units::Radians((b ? horizontal : vertical) + shift);
  const double psi = units::Radians(b ? vertical : horizontal);
  const PolarGrid& grid = this->Polar;
  return std::sin(theta) * (std::cos(psi) * grid.AxisX + std::sin(psi) * grid.AxisY) +
    std::cos(theta) * grid.Pole;
}

double CandelaWeb::Intensity(const Vec3& direction) const
{
  const PolarGrid& grid = this->Polar;
  const double x = Dot(direction, grid.AxisX);
  const double y = Dot(direction, grid.AxisY);
  const double theta = std::atan2(std::hypot(x, y), Dot(direction, grid.Pole));
  // Directions on the rim of the grid, by rounding just outside, belong to it.
  constexpr double rim = 4e-16;
  if (theta < grid.Theta.front() - rim || theta > grid.Theta.back() + rim)
  {
    return 0.0;
  }
  double s = 0.0;
  const std::size_t i = Interval(grid.Theta, theta, s);
  s = std::clamp(s, 0.0, 1.0);
  const std::size_t n = grid.Thetas();
  const auto column = [&](std::size_t j) {
    const double* v = &grid.Value[j * n + i];
    return v[0] + s * (v[1] - v[0]);
  };
  if (grid.Psis() == 1)
  {
    return column(0);
  }
  double psi = std::atan2(y, x);
  if (grid.Closed)
  {
    psi -= 2.0 * units::Pi * std::floor((psi - grid.Psi.front()) / (2.0 * units::Pi));
  }
  else if (psi < grid.Psi.front() - rim || psi > grid.Psi.back() + rim)
  {
    return 0.0;
  }
  double t = 0.0;
  const std::size_t j = Interval(grid.Psi, psi, t);
  t = std::clamp(t, 0.0, 1.0);
  return column(j) + t * (column(j + 1) - column(j));
}

double CandelaWeb::IntensityAt(double horizontal, double vertical) const
{
  return this->Intensity(this->DirectionOf(horizontal, vertical));
}

} // namespace radiometry
