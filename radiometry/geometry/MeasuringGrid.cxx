// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/MeasuringGrid.h"

#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace radiometry
{

namespace
{

constexpr double GreatestSpacing = 10.0; // m, EN 12464-1

/// A quotient that is whole but for rounding counts as whole.
constexpr double WholeTolerance = 1e-9;

/// The side that decides how far apart points may be.
double DecidingSide(double side1, double side2)
{
  const double longer = std::max(side1, side2);
  const double shorter = std::min(side1, side2);
  return longer >= 2.0 * shorter ? shorter : longer;
}

void CheckSide(double side)
{
  if (!(side > 0.0) || !std::isfinite(side))
  {
    throw InputError("a side of the measuring grid", -1, side, "a finite length above 0");
  }
}

std::int64_t Whole(double quotient, GridRounding rounding)
{
  if (!(quotient <= 2.0 * static_cast<double>(MaximumSensors)))
  {
    return 2 * MaximumSensors; // refused by the caller
  }
  auto n = static_cast<std::int64_t>(rounding == GridRounding::Nearest
      ? std::floor(quotient + 0.5)
      : std::ceil(quotient * (1.0 - WholeTolerance)));
  n = std::max<std::int64_t>(n, 1);
  return rounding == GridRounding::Odd && n % 2 == 0 ? n + 1 : n;
}

void CheckCount(double count)
{
  if (!(count <= static_cast<double>(MaximumSensors)))
  {
    throw InputError("number of sensors", -1, count,
      "at most " + std::to_string(MaximumSensors) + ": a wider spacing or a smaller area");
  }
}

Vec3 Bilinear(const std::array<Vec3, 4>& c, double u, double v)
{
  return (1.0 - v) * ((1.0 - u) * c[0] + u * c[1]) + v * ((1.0 - u) * c[3] + u * c[2]);
}

void AddGrid(const std::array<Vec3, 4>& c, const Vec3& normal, std::int64_t n1, std::int64_t n2,
  std::vector<Sensor>& sensors)
{
  const auto place = [&](double i, double j) {
    return Bilinear(c, i / static_cast<double>(n1), j / static_cast<double>(n2));
  };
  for (std::int64_t j = 0; j < n2; ++j)
  {
    for (std::int64_t i = 0; i < n1; ++i)
    {
      const auto x = static_cast<double>(i);
      const auto y = static_cast<double>(j);
      sensors.push_back({ place(x + 0.5, y + 0.5), normal,
        { place(x, y), place(x + 1.0, y), place(x + 1.0, y + 1.0), place(x, y + 1.0) } });
    }
  }
}

} // namespace

double MeasuringGridSpacing(double side1, double side2)
{
  CheckSide(side1);
  CheckSide(side2);
  const double d = DecidingSide(side1, side2);
  return std::min(0.2 * std::pow(5.0, std::log10(d)), GreatestSpacing);
}

std::array<std::int64_t, 2> MeasuringGridCounts(
  double side1, double side2, double spacing, GridRounding rounding)
{
  CheckSide(side1);
  CheckSide(side2);
  if (!(spacing > 0.0) || !std::isfinite(spacing))
  {
    throw InputError("Spacing", -1, spacing, "a finite length above 0");
  }
  if (rounding == GridRounding::Nearest)
  {
    const double d = DecidingSide(side1, side2);
    spacing = d / static_cast<double>(Whole(d / spacing, rounding));
  }
  const std::array<std::int64_t, 2> counts{ Whole(side1 / spacing, rounding),
    Whole(side2 / spacing, rounding) };
  CheckCount(static_cast<double>(counts[0]) * static_cast<double>(counts[1]));
  return counts;
}

void AddSensors(const GridParallelogram& area, const std::array<std::int64_t, 2>& counts,
  std::vector<Sensor>& sensors)
{
  CheckCount(static_cast<double>(sensors.size()) +
    static_cast<double>(counts[0]) * static_cast<double>(counts[1]));
  const Vec3& o = area.Origin;
  AddGrid({ o, o + area.Side1, o + area.Side1 + area.Side2, o + area.Side2 },
    Normalized(Cross(Normalized(area.Side1), Normalized(area.Side2))), counts[0], counts[1],
    sensors);
}

void AddSensors(const Triangle3& triangle, double spacing, std::vector<Sensor>& sensors)
{
  const auto& [a, b, c] = triangle;
  const double longest = std::max({ Length(b - a), Length(c - b), Length(a - c) });
  if (!(Area(triangle) > 0.0))
  {
    return;
  }
  const Vec3 normal = Normalized(Cross(Normalized(b - a), Normalized(c - a)));
  const std::int64_t n = Whole(longest / spacing, GridRounding::Up);
  CheckCount(static_cast<double>(sensors.size()) + static_cast<double>(n) * static_cast<double>(n));
  const auto place = [&](std::int64_t i, std::int64_t j) {
    const double u = static_cast<double>(i) / static_cast<double>(n);
    const double v = static_cast<double>(j) / static_cast<double>(n);
    return (1.0 - u - v) * a + u * b + v * c;
  };
  const auto add = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
    sensors.push_back({ (p + q + r) / 3.0, normal, { p, q, r, r } });
  };
  for (std::int64_t j = 0; j < n; ++j)
  {
    for (std::int64_t i = 0; i + j < n; ++i)
    {
      add(place(i, j), place(i + 1, j), place(i, j + 1));
      if (i + j + 1 < n)
      {
        add(place(i + 1, j), place(i + 1, j + 1), place(i, j + 1));
      }
    }
  }
}

bool AddSensors(const std::array<Vec3, 4>& quad, double spacing, std::vector<Sensor>& sensors)
{
  const Vec3 normal = Normalized(Cross(quad[2] - quad[0], quad[3] - quad[1]));
  const double size = std::max(Length(quad[2] - quad[0]), Length(quad[3] - quad[1]));
  std::array<double, 4> edges{};
  for (int k = 0; k < 4; ++k)
  {
    const Vec3 out = quad[(k + 1) % 4] - quad[k];
    const Vec3 in = quad[k] - quad[(k + 3) % 4];
    edges[k] = Length(out);
    const bool flat = std::abs(Dot(normal, quad[k] - quad[0])) <= 1e-13 * size;
    const bool convex = Dot(normal, Cross(in, out)) > 1e-9 * Length(in) * edges[k];
    if (!flat || !convex)
    {
      return false;
    }
  }
  const std::int64_t n1 = Whole(std::max(edges[0], edges[2]) / spacing, GridRounding::Up);
  const std::int64_t n2 = Whole(std::max(edges[1], edges[3]) / spacing, GridRounding::Up);
  CheckCount(
    static_cast<double>(sensors.size()) + static_cast<double>(n1) * static_cast<double>(n2));
  AddGrid(quad, normal, n1, n2, sensors);
  return true;
}

RoomExtent::RoomExtent(const Vec3& up)
{
  if (!IsFinite(up) || !(Length(up) > 0.0))
  {
    throw InputError("UpDirection", -1,
      "(" + std::to_string(up.x) + ", " + std::to_string(up.y) + ", " + std::to_string(up.z) + ")",
      "a finite direction, not zero");
  }
  const Vec3 z = Normalized(up);
  int main = 0;
  for (int k = 1; k < 3; ++k)
  {
    main = std::abs(z[k]) > std::abs(z[main]) ? k : main;
  }
  Vec3 next;
  next[(main + 1) % 3] = 1.0;
  const Vec3 x = Normalized(next - Dot(next, z) * z);
  this->Axes = { x, Cross(z, x), z };
}

void RoomExtent::Box::Add(const std::array<Vec3, 3>& axes, const Vec3& point)
{
  for (int k = 0; k < 3; ++k)
  {
    const double at = Dot(axes[k], point);
    this->Low[k] = this->Count == 0 ? at : std::min(this->Low[k], at);
    this->High[k] = this->Count == 0 ? at : std::max(this->High[k], at);
  }
  ++this->Count;
}

void RoomExtent::Add(const Vec3& point)
{
  this->Whole.Add(this->Axes, point);
}

bool RoomExtent::OnFloor(const Vec3& point) const
{
  return Dot(this->Axes[2], point) <= this->Whole.Low[2] + 1e-3 * this->Whole.Side(2);
}

void RoomExtent::AddFloor(const Vec3& point)
{
  this->Floor.Add(this->Axes, point);
}

GridParallelogram RoomExtent::Plane(double height, double margin) const
{
  const bool floor = this->Floor.Count > 0 &&
    this->Floor.Side(0) >= 0.5 * this->Whole.Side(0) &&
    this->Floor.Side(1) >= 0.5 * this->Whole.Side(1);
  const Box& box = floor ? this->Floor : this->Whole;
  Vec3 corner = (this->Whole.Low[2] + height) * this->Axes[2];
  std::array<double, 2> sides{};
  for (int k = 0; k < 2; ++k)
  {
    const double zone = std::min(margin, 0.25 * box.Side(k));
    sides[k] = box.Side(k) - 2.0 * zone;
    corner += (box.Low[k] + zone) * this->Axes[k];
  }
  return { corner, sides[0] * this->Axes[0], sides[1] * this->Axes[1] };
}

} // namespace radiometry
