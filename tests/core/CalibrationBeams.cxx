// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/CalibrationBeams.h"

#include <algorithm>
#include <array>
#include <cmath>

/// Lights that reach a point from one direction each: shadows on the floor are projections, so the
/// reference for a cell is an integral of the light's formula over the cell less their union.
namespace test
{
namespace
{

using namespace radiometry;

const double Degree = std::acos(-1.0) / 180.0;

/// What a light gives a point of an upward surface, by the formulas of docs/arrays.md.
double Formula(const Light& light, const Vec3& at)
{
  if (light.Type == LightType::Directional)
  {
    return light.Intensity[0] * std::max(0.0, -light.Direction.z);
  }
  const Vec3 way = light.Position - at;
  const double r = Length(way);
  double intensity = light.Intensity[0];
  if (light.Web)
  {
    return intensity * WebIntensity(light, -way) * (way.z / r) / (r * r);
  }
  if (light.Type == LightType::Spot)
  {
    const double c = -Dot(way, light.Direction) / r;
    if (c < light.CosCutoff || (light.Exponent > 0.0 && c <= 0.0))
    {
      return 0.0;
    }
    intensity *= light.Exponent > 0.0 ? std::pow(c, light.Exponent) : 1.0;
    if (light.SmoothEdge && c < light.CosInnerCutoff)
    {
      const double f = (c - light.CosCutoff) / (light.CosInnerCutoff - light.CosCutoff);
      intensity *= f * f;
    }
  }
  const double* a = light.Attenuation;
  return intensity * (way.z / r) / (a[0] + a[1] * r + a[2] * r * r);
}

/// How far o + s d of the floor is inside the cone of half-angle arccos(cosine) about a light's axis,
/// as a quadratic q0 + q1 s + q2 s^2 of s; it is 0 on the cone.
std::array<double, 3> ConeAlong(
  const Light& light, double cosine, const Point2& o, const Point2& d)
{
  const Vec3 from = Vec3{ o.x, o.y, 0.0 } - light.Position;
  const Vec3 way{ d.x, d.y, 0.0 };
  const double c2 = cosine * cosine;
  const double f = Dot(from, light.Direction);
  const double w = Dot(way, light.Direction);
  return { f * f - c2 * Dot(from, from), 2.0 * (f * w - c2 * Dot(from, way)),
    w * w - c2 * Dot(way, way) };
}

void Roots(const std::array<double, 3>& q, std::vector<double>& roots)
{
  const double inside = q[1] * q[1] - 4.0 * q[2] * q[0];
  if (inside >= 0.0 && q[2] != 0.0)
  {
    roots.push_back((-q[1] - std::sqrt(inside)) / (2.0 * q[2]));
    roots.push_back((-q[1] + std::sqrt(inside)) / (2.0 * q[2]));
  }
}

/// The y at which the cone's curve on the floor begins and ends: where the discriminant along x, a
/// quadratic in y, is 0.
void Extremes(const Light& light, double cosine, std::vector<double>& lines)
{
  const auto inside = [&](double y) {
    const auto q = ConeAlong(light, cosine, { light.Position.x, y }, { 1.0, 0.0 });
    return q[1] * q[1] - 4.0 * q[2] * q[0];
  };
  const double y = light.Position.y;
  const double low = inside(y - 1.0);
  const double middle = inside(y);
  const double high = inside(y + 1.0);
  std::vector<double> roots;
  Roots({ middle, 0.5 * (high - low), 0.5 * (high + low) - middle }, roots);
  for (const double r : roots)
  {
    lines.push_back(y + r);
  }
}

RegionIntegrand Integrand(const Light& light)
{
  RegionIntegrand f;
  f.Value = [light](double x, double y) { return Formula(light, { x, y, 0.0 }); };
  std::vector<double> cosines;
  std::vector<Vec3> planes;
  if (light.Web)
  {
    AddWebBreaks(light, cosines, planes);
  }
  if (light.Type == LightType::Spot && light.CosCutoff > -1.0)
  {
    cosines.push_back(light.CosCutoff);
  }
  if (light.SmoothEdge)
  {
    cosines.push_back(light.CosInnerCutoff);
  }
  if (light.Exponent > 0.0)
  {
    cosines.push_back(0.0);
  }
  if (cosines.empty() && planes.empty())
  {
    return f;
  }
  for (const double cosine : cosines)
  {
    Extremes(light, cosine, f.Extremes);
  }
  if (light.Direction.z < 0.0) // where the axis meets the floor all planes meet
  {
    f.Extremes.push_back(light.Position.y - light.Position.z / light.Direction.z * light.Direction.y);
  }
  f.OnLine = [light, cosines, planes](const Point2& o, const Point2& d, std::vector<double>& s) {
    for (const double cosine : cosines)
    {
      Roots(ConeAlong(light, cosine, o, d), s);
    }
    for (const Vec3& n : planes)
    {
      s.push_back(-Dot(n, Vec3{ o.x, o.y, 0.0 } - light.Position) / Dot(n, Vec3{ d.x, d.y, 0.0 }));
    }
  };
  return f;
}

Convex2 Shadow(const Light& light, const Triangle3& blocker)
{
  if (light.Type != LightType::Directional)
  {
    return ShadowOn(0.0, blocker, light.Position);
  }
  Convex2 shadow;
  for (const Vec3& p : blocker)
  {
    const double s = -p.z / light.Direction.z;
    shadow.push_back({ p.x + s * light.Direction.x, p.y + s * light.Direction.y });
  }
  return shadow;
}

Light Above(Random& random)
{
  Light light;
  light.Position = { Uniform(random, -2, 2), Uniform(random, -2, 2), Uniform(random, 1.9, 4) };
  light.Intensity = { Uniform(random, 1, 100) };
  return light;
}

Light Spot(Random& random, double exponent, double cutoff)
{
  Light light = Above(random);
  light.Type = LightType::Spot;
  light.Direction =
    Normalized(Vec3{ Uniform(random, -0.7, 0.7), Uniform(random, -0.7, 0.7), -1.0 });
  light.Exponent = exponent;
  light.CosCutoff = cutoff < 180.0 ? std::cos(cutoff * Degree) : -1.0;
  return light;
}

} // namespace

std::vector<BeamKind> BeamKinds()
{
  std::vector<BeamKind> kinds{
    { "point", Above },
    { "directional",
      [](Random& random) {
        Light light = Above(random);
        light.Type = LightType::Directional;
        light.Direction =
          Normalized(Vec3{ Uniform(random, -1.5, 1.5), Uniform(random, -1.5, 1.5), -1.0 });
        return light;
      } },
    { "spot, whole exponent",
      [](Random& random) {
        return Spot(random, static_cast<double>(random() % 40), Uniform(random, 10, 90));
      } },
    { "spot, any exponent",
      [](Random& random) { return Spot(random, Uniform(random, 0.1, 30), Uniform(random, 10, 90)); } },
    { "spot, no cone", [](Random& random) { return Spot(random, Uniform(random, 1, 8), 180); } },
    { "spot, smooth edge",
      [](Random& random) {
        Light light = Spot(random, random() % 2 ? 0.0 : 2.0, Uniform(random, 20, 80));
        light.SmoothEdge = true;
        light.CosInnerCutoff =
          std::cos(Uniform(random, 0.2, 0.95) * std::acos(light.CosCutoff));
        return light;
      } },
    { "point, legacy attenuation",
      [](Random& random) {
        Light light = Above(random);
        light.Attenuation[0] = Uniform(random, 0, 1);
        light.Attenuation[1] = Uniform(random, 0, 1);
        light.Attenuation[2] = Uniform(random, 0.1, 1);
        return light;
      } },
  };
  const std::vector<BeamKind> webs = WebKinds();
  kinds.insert(kinds.end(), webs.begin(), webs.end());
  return kinds;
}

Integral BeamOverCell(const Light& light, const Triangle3& cell,
  const std::vector<Triangle3>& blockers, double tolerance)
{
  std::vector<Convex2> shadows;
  for (const Triangle3& t : blockers)
  {
    shadows.push_back(Shadow(light, t));
  }
  const Convex2 region{ { cell[0].x, cell[0].y }, { cell[1].x, cell[1].y },
    { cell[2].x, cell[2].y } };
  return IntegrateRegion(region, shadows, Integrand(light), tolerance);
}

double BeamAt(const Light& light, const Vec3& point, const std::vector<Triangle3>& blockers)
{
  const Vec3 to =
    light.Type == LightType::Directional ? point - 100.0 * light.Direction : light.Position;
  return Blocked(blockers, point, to) ? 0.0 : Formula(light, point);
}

namespace
{

struct Blocking
{
  const char* Name;
  int Count;
  double Size;
  int FloorCells;
  double ReferenceTolerance;
};

void Draw(CalibrationScene& scene, Light& light, Random& random, const BeamKind& kind, const Blocking& b)
{
  scene = MakeCalibrationScene(random, b.FloorCells, b.Count, b.Size);
  light = kind.Make(random);
  Light placed = light;
  placed.Position = light.Position - scene.Scene.Origin;
  scene.Scene.Lights = { placed };
}

std::vector<Judged> JudgeCells(const BeamKind& kind, const Blocking& b, std::uint64_t seed)
{
  Random random(seed);
  CalibrationScene scene;
  Light light;
  Draw(scene, light, random, kind, b);
  std::vector<Judged> values = ComputeCells(scene);
  for (std::size_t t = 0; t < values.size(); ++t)
  {
    const Triangle3& cell = scene.Floor[t];
    const Integral exact = BeamOverCell(light, cell, scene.Blockers, b.ReferenceTolerance);
    values[t].Exact = exact.Value / Area(cell);
    values[t].ExactError = exact.Error / Area(cell);
  }
  return values;
}

void JudgeAt(const CalibrationScene& scene, const Light& light, const std::vector<Vec3>& points,
  std::vector<Judged>& values)
{
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    values[i].Exact = BeamAt(light, points[i], scene.Blockers);
    values[i].ExactError = 1e-13 * Formula(light, points[i]);
  }
}

std::vector<Judged> JudgePoints(const BeamKind& kind, const Blocking& b, std::uint64_t seed)
{
  Random random(seed);
  CalibrationScene scene;
  Light light;
  Draw(scene, light, random, kind, b);
  std::vector<Vec3> points;
  for (int k = 0; k < 64; ++k)
  {
    points.push_back({ Uniform(random, -2, 2), Uniform(random, -2, 2), 0.0 });
  }
  std::vector<Judged> values = ComputePoints(scene, points);
  JudgeAt(scene, light, points, values);
  return values;
}

std::vector<Judged> JudgeVertices(const BeamKind& kind, const Blocking& b, std::uint64_t seed)
{
  Random random(seed);
  CalibrationScene scene;
  Light light;
  Blocking finer = b;
  finer.FloorCells = 12;
  Draw(scene, light, random, kind, finer);
  std::vector<Vec3> vertices;
  for (int j = 1; j < finer.FloorCells; ++j)
  {
    for (int i = 1; i < finer.FloorCells; ++i)
    {
      vertices.push_back(scene.Floor[2 * (j * finer.FloorCells + i)][0]);
    }
  }
  std::vector<Judged> values = ComputeVertices(scene, vertices);
  JudgeAt(scene, light, vertices, values);
  return values;
}

} // namespace

void AddBeamCases(std::vector<CalibrationCase>& cases)
{
  static const Blocking open{ "none", 0, 0.0, 2, 1e-11 };
  static const Blocking few{ "12 triangles", 12, 0.5, 3, 1e-9 };
  static const Blocking many{ "400 triangles", 400, 0.12, 3, 1e-6 };
  static const Blocking dense{ "3000 triangles", 3000, 0.05, 3, 1e-5 };
  for (const BeamKind& kind : BeamKinds())
  {
    for (const Blocking& b : { open, few, many, dense })
    {
      const auto run = [kind, b](auto judge) {
        return [kind, b, judge](std::uint64_t seed) { return judge(kind, b, seed); };
      };
      Random any(1);
      const Light light = kind.Make(any);
      const bool crowded = b.Count > 1000;
      if (!crowded || !light.Web) // a web bends at many curves: its reference would take a minute
      {
        cases.push_back({ kind.Name, b.Name, "cells", run(JudgeCells),
          light.Web ? b.Count > 100 : crowded && light.Type == LightType::Spot });
      }
      cases.push_back({ kind.Name, b.Name, "points", run(JudgePoints) });
      if (b.Count > 0)
      {
        cases.push_back({ kind.Name, b.Name, "vertices", run(JudgeVertices) });
      }
    }
  }
}

} // namespace test
