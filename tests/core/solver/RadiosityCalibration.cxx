// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/solver/RadiosityCalibration.h"

#include "tests/core/CalibrationSuite.h"
#include "tests/core/TestScenes.h"
#include "tests/core/formfactor/ReferenceExchange.h"

#include <algorithm>
#include <memory>

namespace test
{

using namespace radiometry;

const std::map<std::string, RadiosityMethod>& RadiosityMethods()
{
  static const std::map<std::string, RadiosityMethod> methods{ { "Dense", RadiosityMethod::Dense },
    { "Hierarchical", RadiosityMethod::Hierarchical },
    { "MonteCarlo", RadiosityMethod::MonteCarlo } };
  return methods;
}

namespace
{

/// A side of a field beside the references of the scene `name`.
void Compare(const std::string& name, const std::vector<RadiosityReference>& references, int side,
  std::size_t bands, const FieldValues& field, const std::vector<std::size_t>& rows,
  std::vector<Judged>& out)
{
  for (const RadiosityReference& reference : references)
  {
    if (reference.Scene != name || reference.Side != side)
    {
      continue;
    }
    const std::size_t k =
      rows[reference.Cell] * bands + static_cast<std::size_t>(reference.Band);
    Judged judged;
    judged.Value = field.Values[k];
    judged.Error = field.Errors[k];
    judged.Exact = reference.Irradiance;
    judged.ExactError = reference.Error;
    judged.Scale = *std::max_element(field.Values.begin(), field.Values.end());
    out.push_back(judged);
  }
}

} // namespace

std::vector<Judged> JudgeRadiosity(const RadiosityScene& scene,
  const std::vector<RadiosityReference>& references, const RadiosityOptions& options,
  RadiosityResult* result, std::vector<Judged>* gathered)
{
  const Scene& world = scene.World;
  const OcclusionScene occluders(world);
  RadiosityOptions all = options;
  all.SpecularTransport = all.PathTransmission = scene.Paths;
  RadiositySimulation simulation(world, occluders, all);
  const RadiosityResult& r = simulation.Run();
  if (result)
  {
    *result = r;
  }
  const auto bands = static_cast<std::size_t>(world.Optics.Bands);
  std::vector<std::size_t> rows(world.Cells);
  for (std::size_t c = 0; c < rows.size(); ++c)
  {
    rows[c] = c;
  }
  std::vector<Judged> out;
  for (int side = 0; side < 2; ++side)
  {
    Compare(scene.Name, references, side, bands, r.Irradiance[static_cast<std::size_t>(side)], rows, out);
    std::vector<SurfacePoint> points;
    std::vector<std::size_t> places(world.Cells);
    for (const RadiosityReference& reference : references)
    {
      if (gathered && reference.Scene == scene.Name + "@" && reference.Side == side &&
        reference.Band == 0)
      {
        // Every cell is one triangle.
        const Triangle3 t = world.TriangleAt(reference.Cell);
        const Vec3 n = Normalized(AreaNormal2(t));
        places[reference.Cell] = points.size();
        points.push_back({ Centroid(t), side == 0 ? n : -n,
          static_cast<std::int32_t>(reference.Cell), {}, 0.0 });
      }
    }
    if (!points.empty())
    {
      Compare(scene.Name + "@", references, side, bands, simulation.IrradianceAt(points), places,
        *gathered);
    }
  }
  return out;
}

std::vector<Judged> JudgePinhole(RadiosityMethod method, std::uint64_t seed)
{
  // A bright room whose walls all send B = M/(1 - rho) has a hole of size h in the wall to a black
  // room: what arrives there is B times the factor of the hole, but for the share of some h^2 of the
  // bright room that is lost.
  Random random(seed);
  const double h = 2.0 * std::pow(10.0, Uniform(random, -3.0, -1.0));
  const double y = Uniform(random, 0.2, 1.6), z = Uniform(random, 0.2, 1.6);
  Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 2, 2, 2 }, 2, true);
  const std::size_t black = mesh.Triangles.size();
  mesh.AddBox({ 2, 0, 0 }, { 4, 2, 2 }, 2, true);
  // The walls between them, of the bright room (its faces +x) and the black one (-x), about the hole.
  const auto face = [](const Mesh& m, const std::array<std::int32_t, 3>& t) {
    return m.Points[t[0]].x == 2.0 && m.Points[t[1]].x == 2.0 && m.Points[t[2]].x == 2.0;
  };
  std::vector<std::array<std::int32_t, 3>> bright, dark;
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    if (!face(mesh, mesh.Triangles[t]))
    {
      (t < black ? bright : dark).push_back(mesh.Triangles[t]);
    }
  }
  mesh.Triangles = bright;
  const auto wall = [&](double y0, double z0, double y1, double z1) {
    const Vec3 o{ 2, y0, z0 }, a{ 0, y1 - y0, 0 }, b{ 0, 0, z1 - z0 };
    mesh.AddGrid(o, b, a, 1, 1); // faces -x
  };
  wall(0, 0, 2, z);
  wall(0, z + h, 2, 2);
  wall(0, z, y, z + h);
  wall(y + h, z, 2, z + h);
  const std::size_t first = mesh.Triangles.size();
  mesh.Triangles.insert(mesh.Triangles.end(), dark.begin(), dark.end());
  Scene scene = mesh.ToScene(0.0);
  for (std::size_t c = 0; c < first; ++c)
  {
    scene.Optics.DiffuseReflectance[0][c] = 0.5;
  }
  scene.Optics.EmittedExitance[0].assign(scene.Cells, 0.0);
  std::fill_n(scene.Optics.EmittedExitance[0].begin(), first, 50.0);
  // The walls between are seen from both rooms; their backs are black.
  const OcclusionScene occluders(scene);
  RadiosityOptions options;
  options.Method = method;
  options.RelativeTolerance = 0.1;
  options.Seed = seed;
  RadiositySimulation simulation(scene, occluders, options);
  const RadiosityResult& r = simulation.Run();
  std::vector<Judged> out;
  const Vec3 corner{ 2, y, z };
  const Triangle3 hole[] = { { corner, corner + Vec3{ 0, h, 0 }, corner + Vec3{ 0, h, h } },
    { corner, corner + Vec3{ 0, h, h }, corner + Vec3{ 0, 0, h } } };
  for (std::size_t c = first; c < scene.Cells; ++c)
  {
    Triangle3 cell = scene.TriangleAt(c);
    for (Vec3& p : cell)
    {
      p = p + scene.Origin;
    }
    const double f =
      (reference::Exchange(hole[0], cell) + reference::Exchange(hole[1], cell)) / Area(cell);
    Judged one;
    one.Value = r.Irradiance[0].Values[c];
    one.Error = r.Irradiance[0].Errors[c];
    one.Scale = 100.0 * h * h;
    one.Exact = 100.0 * f;
    one.ExactError = one.Exact * h * h / 12.0; // lost light, reflected once more
    out.push_back(one);
  }
  return out;
}

void AddRadiosityParts(std::vector<SuitePart>& parts)
{
  const std::string group = "radiosity";
  const auto references = std::make_shared<const std::vector<RadiosityReference>>(RadiosityReferences());
  for (const RadiosityScene& scene : RadiosityScenes())
  {
    const auto shared = std::make_shared<const RadiosityScene>(scene);
    for (const auto& [name, method] : RadiosityMethods())
    {
      if (scene.Paths && method != RadiosityMethod::MonteCarlo)
      {
        continue;
      }
      for (const double tolerance : { 0.1, 0.03 })
      {
        for (const bool points : { false, true })
        {
          const auto run = [shared, references, points, m = method, tolerance](std::uint64_t seed) {
            RadiosityOptions options;
            options.Method = m;
            options.RelativeTolerance = tolerance;
            options.Seed = seed;
            std::vector<Judged> gathered;
            const std::vector<Judged> cells =
              JudgeRadiosity(*shared, *references, options, nullptr, points ? &gathered : nullptr);
            return points ? gathered : cells;
          };
          if (!points || tolerance == 0.1)
          {
            parts.push_back({ group, scene.Effect, name + (points ? ", points by final gather" : ", cells"),
              run, tolerance == 0.1 ? 1.0 : 20.0 });
          }
        }
      }
    }
  }
  for (const auto& [name, method] : RadiosityMethods())
  {
    parts.push_back({ group, "light through a pinhole", name + ", cells",
      [m = method](std::uint64_t seed) { return JudgePinhole(m, seed); }, 1.0 });
  }
}

} // namespace test
