// SPDX-License-Identifier: BSD-3-Clause
#include "io/PhotometricShapes.h"

#include "radiometry/scene/Units.h"

#include <algorithm>
#include <cmath>

namespace radiometry::io
{
namespace
{

constexpr int Corners = 48;
constexpr double LargestStep = 5.0; // degrees

/// The angles with steps above the largest one cut.
std::vector<double> Refined(const std::vector<double>& angles)
{
  std::vector<double> fine{ angles.front() };
  for (std::size_t k = 1; k < angles.size(); ++k)
  {
    const double step = angles[k] - angles[k - 1];
    const int parts = std::max(1, static_cast<int>(std::ceil(step / LargestStep - 1e-9)));
    for (int p = 1; p <= parts; ++p)
    {
      fine.push_back(p == parts ? angles[k] : angles[k - 1] + step * p / parts);
    }
  }
  return fine;
}

class MeshBuilder
{
public:
  explicit MeshBuilder(const LuminairePlacement& placement)
    : Placement(placement)
  {
  }
  std::int32_t Add(const Vec3& local)
  {
    this->Mesh.Points.push_back(this->Placement.Point(local));
    return static_cast<std::int32_t>(this->Mesh.Points.size()) - 1;
  }
  void Face(const std::vector<Vec3>& corners)
  {
    std::vector<std::int32_t> ids;
    for (const Vec3& corner : corners)
    {
      ids.push_back(this->Add(corner));
    }
    this->Mesh.Polygons.push_back(ids);
  }

  LuminaireMesh Mesh;

private:
  const LuminairePlacement& Placement;
};

/// Angles round a circle: counter-clockwise seen from above.
double Turn(int k)
{
  return 2.0 * units::Pi * k / Corners;
}

void AddRectangle(const LuminousOpening& opening, MeshBuilder& out)
{
  const Vec3 h = 0.5 * opening.Size;
  out.Face({ { -h.x, -h.y, -h.z }, { -h.x, h.y, -h.z }, { h.x, h.y, -h.z }, { h.x, -h.y, -h.z } });
  const auto side = [&](const Vec3& a, const Vec3& b, double height) {
    if (height > 0.0)
    {
      const Vec3 up{ 0.0, 0.0, height };
      out.Face({ a, b, b + up, a + up });
    }
  };
  const double z = -h.z;
  side({ h.x, -h.y, z }, { h.x, h.y, z }, opening.Sides[0]);
  side({ h.x, h.y, z }, { -h.x, h.y, z }, opening.Sides[1]);
  side({ -h.x, h.y, z }, { -h.x, -h.y, z }, opening.Sides[2]);
  side({ -h.x, -h.y, z }, { h.x, -h.y, z }, opening.Sides[3]);
}

void AddEllipse(const LuminousOpening& opening, MeshBuilder& out)
{
  const Vec3 h = 0.5 * opening.Size;
  std::vector<Vec3> rim;
  for (int k = 0; k < Corners; ++k)
  {
    rim.push_back({ h.x * std::cos(Turn(k)), h.y * std::sin(Turn(k)), -h.z });
  }
  out.Face({ rim.rbegin(), rim.rend() });
  const double height = *std::max_element(opening.Sides.begin(), opening.Sides.end());
  for (int k = 0; k < Corners && height > 0.0; ++k)
  {
    const Vec3 up{ 0.0, 0.0, height };
    const Vec3& a = rim[k];
    const Vec3& b = rim[(k + 1) % Corners];
    out.Face({ a, b, b + up, a + up });
  }
}

/// A cylinder lying along x (or y), without its ends.
void AddCylinder(const LuminousOpening& opening, bool alongX, MeshBuilder& out)
{
  const Vec3 h = 0.5 * opening.Size;
  const auto at = [&](double end, int k) {
    const double c = std::cos(Turn(k));
    const double s = std::sin(Turn(k));
    return alongX ? Vec3{ end * h.x, h.y * c, h.z * s } : Vec3{ h.x * c, end * h.y, h.z * s };
  };
  for (int k = 0; k < Corners; ++k)
  {
    const double end = alongX ? 1.0 : -1.0;
    out.Face({ at(-end, k), at(end, k), at(end, k + 1), at(-end, k + 1) });
  }
}

void AddEllipsoid(const LuminousOpening& opening, MeshBuilder& out)
{
  const Vec3 h = 0.5 * opening.Size;
  constexpr int rows = Corners / 2;
  const auto at = [&](int i, int k) {
    const double theta = units::Pi * i / rows;
    const double s = i == 0 || i == rows ? 0.0 : std::sin(theta);
    return Vec3{ h.x * s * std::cos(Turn(k)), h.y * s * std::sin(Turn(k)), h.z * std::cos(theta) };
  };
  for (int i = 0; i < rows; ++i)
  {
    for (int k = 0; k < Corners; ++k)
    {
      if (i == 0)
      {
        out.Face({ at(0, 0), at(1, k), at(1, k + 1) });
      }
      else if (i == rows - 1)
      {
        out.Face({ at(i, k), at(rows, 0), at(i, k + 1) });
      }
      else
      {
        out.Face({ at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1) });
      }
    }
  }
}

void AddUprightEllipse(const LuminousOpening& opening, MeshBuilder& out)
{
  std::vector<Vec3> rim;
  for (int k = 0; k < Corners; ++k)
  {
    rim.push_back({ 0.0, 0.5 * opening.Size.y * std::cos(Turn(k)),
      0.5 * opening.Size.z * std::sin(Turn(k)) });
  }
  out.Face(rim);
}

} // namespace

void LuminairePlacement::Turn(double degrees)
{
  const double a = units::Radians(degrees);
  const Vec3 y = Cross(this->Reference, this->Axis);
  this->Reference = Normalized(std::cos(a) * this->Reference + std::sin(a) * y);
}

Vec3 LuminairePlacement::Direction(const Vec3& local) const
{
  return local.x * this->Reference + local.y * Cross(this->Reference, this->Axis) -
    local.z * this->Axis;
}

LuminaireMesh DistributionSolid(
  const CandelaWeb& web, const LuminairePlacement& placement, double scale)
{
  MeshBuilder out(placement);
  std::vector<double> planes = web.GetHorizontal();
  if (planes.size() == 1)
  {
    planes = { 0.0, 360.0 }; // the same all round
  }
  planes = Refined(planes);
  const std::vector<double> rows = Refined(web.GetVertical());
  for (const double horizontal : planes)
  {
    for (const double vertical : rows)
    {
      const Vec3 direction = web.DirectionOf(horizontal, vertical);
      const double value = web.Intensity(direction);
      out.Add(scale * value * direction);
      out.Mesh.Value.push_back(value);
    }
  }
  const auto n = static_cast<std::int32_t>(rows.size());
  const auto id = [&](std::size_t j, std::size_t i) {
    return static_cast<std::int32_t>(j) * n + static_cast<std::int32_t>(i);
  };
  // Which way round the angles turn differs with the type.
  const Vec3 a = web.DirectionOf(10.0, 40.0);
  const Vec3 across = web.DirectionOf(11.0, 40.0) - a;
  const Vec3 along = web.DirectionOf(10.0, 41.0) - a;
  const bool outward = Dot(Cross(across, along), a) > 0.0;
  for (std::size_t j = 0; j + 1 < planes.size(); ++j)
  {
    for (std::size_t i = 0; i + 1 < rows.size(); ++i)
    {
      std::vector<std::int32_t> quad{ id(j, i), id(j + 1, i), id(j + 1, i + 1), id(j, i + 1) };
      if (!outward)
      {
        std::reverse(quad.begin(), quad.end());
      }
      out.Mesh.Polygons.push_back(quad);
    }
  }
  return out.Mesh;
}

LuminaireMesh OpeningSurface(const LuminousOpening& opening, const LuminairePlacement& placement)
{
  MeshBuilder out(placement);
  switch (opening.Shape)
  {
    case LuminousOpening::Point:
      break;
    case LuminousOpening::Rectangle:
      AddRectangle(opening, out);
      break;
    case LuminousOpening::Ellipse:
      AddEllipse(opening, out);
      break;
    case LuminousOpening::Ellipsoid:
      AddEllipsoid(opening, out);
      break;
    case LuminousOpening::CylinderX:
      AddCylinder(opening, true, out);
      break;
    case LuminousOpening::CylinderY:
      AddCylinder(opening, false, out);
      break;
    case LuminousOpening::UprightEllipse:
      AddUprightEllipse(opening, out);
      break;
  }
  return out.Mesh;
}

std::vector<Vec3> OpeningSamples(
  const LuminousOpening& opening, const LuminairePlacement& placement, int n, int m)
{
  std::vector<Vec3> places;
  const bool upright = opening.Shape == LuminousOpening::UprightEllipse;
  const bool round = upright || opening.Shape == LuminousOpening::Ellipse ||
    opening.Shape == LuminousOpening::Ellipsoid;
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < m; ++j)
    {
      double x = (i + 0.5) / n - 0.5;
      double y = (j + 0.5) / m - 0.5;
      if (round && (n > 1 || m > 1))
      {
        // n rings of equal area, of m places each; a ring's places stand between its neighbour's.
        const double r = 0.5 * std::sqrt((i + 0.5) / n);
        const double turn = 2.0 * units::Pi * (j + (i % 2 ? 0.5 : 0.0)) / m;
        x = r * std::cos(turn);
        y = r * std::sin(turn);
      }
      places.push_back(placement.Point(upright
          ? Vec3{ 0.0, x * opening.Size.y, y * opening.Size.z }
          : Vec3{ x * opening.Size.x, y * opening.Size.y, 0.0 }));
    }
  }
  return places;
}

} // namespace radiometry::io
