// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/OutgoingRadiance.h"
#include "tests/core/CalibrationSuite.h"
#include "tests/core/TestScenes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

/// Radiance toward an eye. The lobe is written out anew and integrated by bisection over the cell, over
/// the lamp or over the lobe.
namespace test
{
namespace
{

using namespace radiometry;

const double Pi = std::acos(-1.0);

/// rho (m + 2)/(2 pi) cos^m alpha on a floor, seen along `out` and lit along `in` (unit, both upward).
double Lobe(double rho, double m, const Vec3& in, const Vec3& out)
{
  const double c = -in.x * out.x - in.y * out.y + in.z * out.z;
  return in.z > 0.0 && out.z > 0.0 && c > 0.0 ? rho * (m + 2.0) / (2.0 * Pi) * std::pow(c, m) : 0.0;
}

/// Mean of f over a triangle: Gauss' rules of 4 x 4 points on parts, bisected until four agree with
/// their whole.
class TriangleMean
{
public:
  explicit TriangleMean(std::function<double(const Vec3&)> f)
    : F(std::move(f))
  {
  }

  Integral operator()(const Triangle3& t, double tolerance)
  {
    const double whole = this->Rule(t);
    double coarse = 0.0;
    for (const Triangle3& part : Parts(t))
    {
      coarse += 0.25 * this->Rule(part);
    }
    this->Least = tolerance * std::max(std::fabs(coarse), 1e-300);
    this->Doubt = 0.0;
    const double value = this->Divide(t, whole, 1.0, 0);
    return { value, this->Doubt + 1e-12 * value };
  }

private:
  static std::array<Triangle3, 4> Parts(const Triangle3& t)
  {
    const Vec3 a = 0.5 * (t[0] + t[1]), b = 0.5 * (t[1] + t[2]), c = 0.5 * (t[2] + t[0]);
    return { Triangle3{ t[0], a, c }, Triangle3{ a, t[1], b }, Triangle3{ c, b, t[2] },
      Triangle3{ a, b, c } };
  }
  double Rule(const Triangle3& t) const
  {
    static const double x[] = { 0.069431844202973712, 0.33000947820757187, 0.66999052179242813,
      0.93056815579702629 };
    static const double w[] = { 0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
      0.17392742256872693 };
    double sum = 0.0;
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < 4; ++j)
      {
        const Vec3 edge = (1.0 - x[j]) * t[1] + x[j] * t[2];
        sum += 2.0 * x[i] * w[i] * w[j] * this->F((1.0 - x[i]) * t[0] + x[i] * edge);
      }
    }
    return sum;
  }
  double Divide(const Triangle3& t, double whole, double share, int depth)
  {
    double values[4], sum = 0.0;
    const std::array<Triangle3, 4> parts = Parts(t);
    for (int k = 0; k < 4; ++k)
    {
      values[k] = this->Rule(parts[static_cast<std::size_t>(k)]);
      sum += 0.25 * values[k];
    }
    const double off = share * std::fabs(sum - whole);
    // Three levels at least: a highlight may hide between the points.
    if (depth >= 9 || (depth >= 3 && off <= share * this->Least))
    {
      this->Doubt += off;
      return sum;
    }
    sum = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      sum += 0.25 *
        this->Divide(parts[static_cast<std::size_t>(k)], values[k], 0.25 * share, depth + 1);
    }
    return sum;
  }
  std::function<double(const Vec3&)> F;
  double Least = 0.0, Doubt = 0.0;
};

struct Glossy
{
  CalibrationScene Scene;
  DiffuseLight Diffuse;
  Vec3 Eye;
  double Rho = 0.4, Exponent = 10.0;
  RadianceOptions Options;
};

Glossy Draw(Random& random, int cells, int blockers, double exponent)
{
  Glossy g;
  g.Scene = MakeCalibrationScene(random, cells, blockers, 0.5);
  Scene& scene = g.Scene.Scene;
  g.Rho = Uniform(random, 0.1, 0.9);
  g.Exponent = exponent;
  for (auto& side : scene.Optics.DiffuseReflectance)
  {
    side.assign(scene.Cells, 0.0);
  }
  scene.Optics.SpecularReflectance[0].assign(scene.Cells, 0.0);
  scene.Optics.Shininess[0].assign(scene.Cells, 10.0);
  for (std::size_t c = 0; c < g.Scene.FloorTriangles; ++c)
  {
    scene.Optics.SpecularReflectance[0][c] = g.Rho;
    scene.Optics.Shininess[0][c] = exponent;
  }
  g.Diffuse.Exitance[0].assign(scene.Cells, 0.0);
  g.Eye = { Uniform(random, -2, 2), Uniform(random, -2, 2), Uniform(random, 0.5, 3) };
  constexpr double tolerances[] = { 0.2, 0.05, 0.01, 0.003 };
  g.Options.RelativeTolerance = tolerances[random() % 4];
  return g;
}

std::vector<Judged> Answers(const RadianceResult& result, std::size_t count)
{
  std::vector<Judged> values(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    values[k].Value = result.Values[k];
    values[k].Error = result.Errors[k];
    values[k].Scale = *std::max_element(result.Values.begin(), result.Values.end());
  }
  return values;
}

std::vector<Judged> OfFloor(const Glossy& g)
{
  const OcclusionScene occluders(g.Scene.Scene);
  std::vector<std::int32_t> cells(g.Scene.FloorTriangles);
  std::iota(cells.begin(), cells.end(), 0);
  Viewer viewer;
  viewer.Eye = g.Eye - g.Scene.Scene.Origin;
  return Answers(ComputeOutgoingRadiance(
                   g.Scene.Scene, occluders, g.Diffuse, viewer, cells, g.Options),
    cells.size());
}

/// At the middles of the floor's triangles.
std::vector<Judged> AtPoints(const Glossy& g)
{
  const OcclusionScene occluders(g.Scene.Scene);
  std::vector<SurfacePoint> points;
  for (std::size_t t = 0; t < g.Scene.FloorTriangles; ++t)
  {
    points.push_back({ Centroid(g.Scene.Scene.TriangleAt(t)), { 0, 0, 1 },
      static_cast<std::int32_t>(t), {}, 0.0 });
  }
  Viewer viewer;
  viewer.Eye = g.Eye - g.Scene.Scene.Origin;
  return Answers(ComputeOutgoingRadiance(
                   g.Scene.Scene, occluders, g.Diffuse, viewer, points, {}, g.Options),
    points.size());
}

double AnyExponent(Random& random) { return std::pow(10.0, Uniform(random, 0.0, 3.3)); }

double Highlight(const Glossy& g, const Vec3& lamp, double intensity, const Vec3& at)
{
  const Vec3 in = lamp - at;
  const double r2 = LengthSquared(in);
  const Vec3 unit = in / std::sqrt(r2);
  return Lobe(g.Rho, g.Exponent, unit, Normalized(g.Eye - at)) * intensity * unit.z / r2;
}

std::vector<Judged> JudgeHighlights(int blockers, bool cells, std::uint64_t seed)
{
  Random random(seed);
  const double exponent = blockers > 0 ? Uniform(random, 1.0, 60.0) : AnyExponent(random);
  Glossy g = Draw(random, 3, blockers, exponent);
  const Vec3 lamp{ Uniform(random, -2, 2), Uniform(random, -2, 2), Uniform(random, 1.9, 3) };
  Light light;
  light.Position = lamp - g.Scene.Scene.Origin;
  light.Intensity = { 50.0 };
  g.Scene.Scene.Lights = { light };
  std::vector<Judged> values = cells ? OfFloor(g) : AtPoints(g);
  std::vector<Convex2> shadows;
  for (const Triangle3& t : g.Scene.Blockers)
  {
    shadows.push_back(ShadowOn(0.0, t, lamp));
  }
  RegionIntegrand f;
  f.Value = [&](double x, double y) { return Highlight(g, lamp, 50.0, { x, y, 0.0 }); };
  TriangleMean mean([&](const Vec3& p) { return Highlight(g, lamp, 50.0, p); });
  for (std::size_t t = 0; t < values.size(); ++t)
  {
    const Triangle3& cell = g.Scene.Floor[t];
    if (!cells)
    {
      const Vec3 p = Centroid(cell);
      values[t].Exact = Blocked(g.Scene.Blockers, p, lamp) ? 0.0 : f.Value(p.x, p.y);
      values[t].ExactError = 1e-11 * f.Value(p.x, p.y);
      continue;
    }
    Integral exact = mean(cell, 1e-7);
    if (blockers > 0)
    {
      const Convex2 region{ { cell[0].x, cell[0].y }, { cell[1].x, cell[1].y },
        { cell[2].x, cell[2].y } };
      exact = IntegrateRegion(region, shadows, f, 1e-7);
      exact = { exact.Value / Area(cell), exact.Error / Area(cell) };
    }
    values[t].Exact = exact.Value;
    values[t].ExactError = exact.Error;
  }
  return values;
}

/// A panel in the lobes of points.
std::vector<Judged> JudgePanels(std::uint64_t seed)
{
  Random random(seed);
  Glossy g = Draw(random, 3, 0, std::pow(10.0, Uniform(random, 0.0, 2.5)));
  const double z = Uniform(random, 1.0, 3.0), w = Uniform(random, 0.2, 1.5), h = Uniform(random, 0.2, 1.5);
  const Vec3 o{ Uniform(random, -2, 1), Uniform(random, -2, 1), z };
  const std::array<Vec3, 4> corners{ o, o + Vec3{ 0, h, 0 }, o + Vec3{ w, h, 0 }, o + Vec3{ w, 0, 0 } };
  Light light;
  light.Type = LightType::Area;
  light.Intensity = { 20.0 };
  light.Direction = { 0, 0, -1 };
  for (const Vec3& p : corners)
  {
    light.Polygon.push_back(p - g.Scene.Scene.Origin);
  }
  light.Position = light.Polygon[0];
  g.Scene.Scene.Lights = { light };
  std::vector<Judged> values = AtPoints(g);
  for (std::size_t t = 0; t < values.size(); ++t)
  {
    const Vec3 at = Centroid(g.Scene.Floor[t]), out = Normalized(g.Eye - at);
    TriangleMean mean([&](const Vec3& on) {
      const Vec3 in = on - at;
      const double r2 = LengthSquared(in);
      return Lobe(g.Rho, g.Exponent, in / std::sqrt(r2), out) * z * z / (r2 * r2);
    });
    const double scale = 20.0 / Pi * 0.5 * w * h;
    for (const Triangle3& half :
      { Triangle3{ corners[0], corners[1], corners[2] }, Triangle3{ corners[0], corners[2], corners[3] } })
    {
      const Integral one = mean(half, 1e-7);
      values[t].Exact += scale * one.Value;
      values[t].ExactError += scale * one.Error;
    }
  }
  return values;
}

/// Directional-hemispherical reflectance by midpoints over the lobe.
double LobeShare(double rho, double m, double cosine)
{
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  constexpr int steps = 300;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i)
  {
    const double c = std::pow((i + 0.5) / steps, 1.0 / (m + 1.0));
    const double s = std::sqrt(1.0 - c * c);
    for (int j = 0; j < steps; ++j)
    {
      sum += std::max(0.0, c * cosine + s * sine * std::cos(Pi * (j + 0.5) / steps));
    }
  }
  return rho * (m + 2.0) / (m + 1.0) * sum / (steps * steps);
}

/// The same light from everywhere: of a sky, or of a large dome of surfaces around.
std::vector<Judged> JudgeSurroundings(bool sky, std::uint64_t seed)
{
  Random random(seed);
  Glossy g = Draw(random, 3, 0, AnyExponent(random));
  const double l = Uniform(random, 1.0, 10.0);
  if (sky)
  {
    g.Scene.Scene.Lights = { SkyLight(SkyRadiance::Uniform(), { l }) };
  }
  else
  {
    // Four walls and a ceiling that close over the floor.
    const std::size_t floor = g.Scene.FloorTriangles;
    std::vector<Triangle3> walls;
    Mesh box;
    box.AddBox({ -2, -2, 0 }, { 2, 2, 4 }, 1, true);
    for (std::size_t t = 2; t < box.Triangles.size(); ++t)
    {
      const auto& v = box.Triangles[t];
      walls.push_back({ box.Points[v[0]], box.Points[v[1]], box.Points[v[2]] });
    }
    const Materials optics = g.Scene.Scene.Optics;
    g.Scene.Scene = WithTriangles(g.Scene, walls);
    Scene& scene = g.Scene.Scene;
    scene.Optics.SpecularReflectance[0] = optics.SpecularReflectance[0];
    scene.Optics.Shininess[0] = optics.Shininess[0];
    scene.Optics.SpecularReflectance[0].resize(scene.Cells, 0.0);
    scene.Optics.Shininess[0].resize(scene.Cells, 10.0);
    g.Diffuse.Exitance[0].assign(scene.Cells, Pi * l);
    std::fill_n(g.Diffuse.Exitance[0].begin(), floor, 0.0);
  }
  std::vector<Judged> values = AtPoints(g);
  for (std::size_t t = 0; t < values.size(); ++t)
  {
    const Vec3 out = Normalized(g.Eye - Centroid(g.Scene.Floor[t]));
    values[t].Exact = l * LobeShare(g.Rho, g.Exponent, out.z);
    values[t].ExactError = 1e-4 * values[t].Exact;
  }
  return values;
}

/// Walls that send l and mirror rho of what comes: l/(1 - rho) everywhere.
std::vector<Judged> JudgeMirrors(std::uint64_t seed)
{
  Random random(seed);
  Mesh mesh;
  mesh.AddBox({ -1, -1, -1 }, { 1, 1, 1 }, 2, true);
  Scene scene = mesh.ToScene(0.0);
  const double rho = Uniform(random, 0.2, 0.9);
  scene.Optics.SpecularReflectance[0].assign(scene.Cells, rho);
  scene.Optics.Shininess[0].assign(scene.Cells, MirrorShininess);
  DiffuseLight diffuse;
  diffuse.Exitance[0].assign(scene.Cells, Pi);
  const OcclusionScene occluders(scene);
  std::vector<std::int32_t> cells(scene.Cells);
  std::iota(cells.begin(), cells.end(), 0);
  Viewer viewer;
  viewer.Eye = { Uniform(random, -0.9, 0.9), Uniform(random, -0.9, 0.9), Uniform(random, -0.9, 0.9) };
  RadianceOptions options;
  options.RelativeTolerance = random() % 2 ? 0.1 : 0.01;
  std::vector<Judged> values = Answers(
    ComputeOutgoingRadiance(scene, occluders, diffuse, viewer, cells, options), cells.size());
  for (Judged& one : values)
  {
    one.Exact = 1.0 / (1.0 - rho);
  }
  return values;
}

} // namespace

void AddRadianceParts(std::vector<SuitePart>& parts)
{
  const std::string group = "radiance";
  parts.push_back({ group, "highlight of a point light", "cells",
    [](std::uint64_t seed) { return JudgeHighlights(0, true, seed); }, 0.1 });
  parts.push_back({ group, "highlight of a point light", "points",
    [](std::uint64_t seed) { return JudgeHighlights(0, false, seed); }, 0.01 });
  parts.push_back({ group, "highlight, shadows", "cells",
    [](std::uint64_t seed) { return JudgeHighlights(8, true, seed); }, 0.1 });
  parts.push_back({ group, "highlight, shadows", "points",
    [](std::uint64_t seed) { return JudgeHighlights(8, false, seed); }, 0.01 });
  parts.push_back({ group, "area light in a lobe", "points", JudgePanels, 0.1 });
  parts.push_back({ group, "sky in a lobe", "points",
    [](std::uint64_t seed) { return JudgeSurroundings(true, seed); }, 0.1 });
  parts.push_back({ group, "surfaces in a lobe", "points",
    [](std::uint64_t seed) { return JudgeSurroundings(false, seed); }, 0.1 });
  parts.push_back({ group, "mirrors", "cells", JudgeMirrors, 0.2 });
}

} // namespace test
