// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/CalibrationExtended.h"

#include <algorithm>
#include <cmath>

/// Area lights and emitting surfaces. The reference integrates M/pi cos(theta) cos(theta')/r^2 over
/// the source less the blockers' shadows on its plane as seen from the point.
namespace test
{
namespace
{

using namespace radiometry;

const double Pi = std::acos(-1.0);

/// A plane source as convex pieces in the coordinates of its plane.
struct Source
{
  Vec3 Origin;
  Vec3 X{ 1, 0, 0 };
  Vec3 Y{ 0, 1, 0 };
  Vec3 Front; // unit
  std::vector<Convex2> Pieces;
  double Exitance = 1.0;
  bool TwoSided = false;

  Vec3 At(const Point2& p) const { return this->Origin + p.x * this->X + p.y * this->Y; }
};

Integral FromSource(const Source& source, const Vec3& at, const std::vector<Triangle3>& blockers,
  double tolerance)
{
  RegionIntegrand f;
  f.Value = [&](double x, double y) {
    const Vec3 way = source.At({ x, y }) - at;
    const double r2 = Dot(way, way);
    const double leaving = -Dot(way, source.Front);
    const double sent = source.TwoSided ? std::fabs(leaving) : std::max(leaving, 0.0);
    return source.Exitance / Pi * std::max(way.z, 0.0) * sent / (r2 * r2);
  };
  std::vector<Convex2> shadows;
  const double height = Dot(source.Origin - at, source.Front);
  for (const Triangle3& blocker : blockers)
  {
    Convex2 shadow;
    for (const Vec3& v : blocker)
    {
      const double s = height / Dot(v - at, source.Front);
      const Vec3 on = at + s * (v - at) - source.Origin;
      shadow.push_back({ Dot(on, source.X), Dot(on, source.Y) });
    }
    shadows.push_back(shadow);
  }
  Integral sum;
  for (const Convex2& piece : source.Pieces)
  {
    const Integral one = IntegrateRegion(piece, shadows, f, tolerance);
    sum.Value += one.Value;
    sum.Error += one.Error;
  }
  return sum;
}

Light AreaLight(const CalibrationScene& scene, const Source& source, const Convex2& outline)
{
  Light light;
  light.Type = LightType::Area;
  light.Intensity = { source.Exitance };
  light.TwoSided = source.TwoSided;
  for (const Point2& p : outline)
  {
    light.Polygon.push_back(source.At(p) - scene.Scene.Origin);
  }
  light.Position = light.Polygon[0];
  // Corners turn counter-clockwise seen from where it lights.
  const Vec3 turn = Cross(light.Polygon[1] - light.Polygon[0], light.Polygon[2] - light.Polygon[0]);
  if (Dot(turn, source.Front) < 0.0)
  {
    std::reverse(light.Polygon.begin(), light.Polygon.end());
  }
  light.Direction = source.Front;
  return light;
}

PointReference Reference(const Source& source)
{
  return [source](const Vec3& at, const std::vector<Triangle3>& blockers, double tolerance) {
    return FromSource(source, at, blockers, tolerance);
  };
}

/// A source that hangs level above everything, at a place and of a size drawn.
Source Ceiling(Random& random)
{
  Source source;
  source.Origin = { Uniform(random, -2, 2), Uniform(random, -2, 2), Uniform(random, 1.9, 3.5) };
  source.Front = { 0, 0, -1 };
  const double turn = Uniform(random, 0, 2 * Pi);
  source.X = { std::cos(turn), std::sin(turn), 0 };
  source.Y = { -std::sin(turn), std::cos(turn), 0 };
  source.Exitance = Uniform(random, 1, 100);
  return source;
}

PointReference Rectangle(CalibrationScene& scene, Random& random)
{
  Source source = Ceiling(random);
  const double w = Uniform(random, 0.1, 1.5);
  const double h = Uniform(random, 0.1, 1.5);
  source.Pieces = { { { 0, 0 }, { w, 0 }, { w, h }, { 0, h } } };
  scene.Scene.Lights = { AreaLight(scene, source, source.Pieces[0]) };
  return Reference(source);
}

PointReference Concave(CalibrationScene& scene, Random& random)
{
  Source source = Ceiling(random);
  const double w = Uniform(random, 0.3, 1.5);
  const double h = Uniform(random, 0.3, 1.5);
  const double a = w * Uniform(random, 0.2, 0.8);
  const double b = h * Uniform(random, 0.2, 0.8);
  source.Pieces = { { { 0, 0 }, { w, 0 }, { w, b }, { 0, b } },
    { { 0, b }, { a, b }, { a, h }, { 0, h } } };
  scene.Scene.Lights = { AreaLight(
    scene, source, { { 0, 0 }, { w, 0 }, { w, b }, { a, b }, { a, h }, { 0, h } }) };
  return Reference(source);
}

PointReference Tilted(CalibrationScene& scene, Random& random)
{
  Source source = Ceiling(random);
  source.Front = Normalized(Vec3{ Uniform(random, -1, 1), Uniform(random, -1, 1), -1.0 });
  source.X = Normalized(Cross(source.Front, Vec3{ 0, 1, 0 }));
  source.Y = Cross(source.Front, source.X);
  source.TwoSided = random() % 2 == 0;
  const double w = Uniform(random, 0.1, 0.8);
  const double h = Uniform(random, 0.1, 0.8);
  source.Pieces = { { { 0, 0 }, { w, 0 }, { w, h }, { 0, h } } };
  scene.Scene.Lights = { AreaLight(scene, source, source.Pieces[0]) };
  return Reference(source);
}

/// Upright beside the floor, from below its plane to above it.
PointReference ThroughHorizon(CalibrationScene& scene, Random& random)
{
  Source source;
  source.Origin = { Uniform(random, 2.1, 3), Uniform(random, -2, 1), 0 };
  source.X = { 0, 1, 0 };
  source.Y = { 0, 0, 1 };
  source.Front = { -1, 0, 0 };
  source.Exitance = Uniform(random, 1, 100);
  const double w = Uniform(random, 0.2, 1);
  const double top = Uniform(random, 0.2, 2);
  const double bottom = -Uniform(random, 0.1, 1);
  source.Pieces = { { { 0, 0 }, { w, 0 }, { w, top }, { 0, top } } };
  scene.Scene.Lights = { AreaLight(
    scene, source, { { 0, bottom }, { w, bottom }, { w, top }, { 0, top } }) };
  return Reference(source);
}

} // namespace

std::vector<ExtendedKind> AreaKinds()
{
  return { { "area, rectangle", true, Rectangle }, { "area, concave", true, Concave },
      { "area, tilted", false, Tilted }, { "area, through the horizon", false, ThroughHorizon } };
}

void AddAreaCases(std::vector<CalibrationCase>& cases)
{
  AddExtendedCases(cases, AreaKinds());
}

} // namespace test
