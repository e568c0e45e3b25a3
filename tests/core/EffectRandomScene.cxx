// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/EffectRandomScene.h"

#include "radiometry/geometry/SolidAngle.h"
#include "radiometry/scene/CandelaWeb.h"
#include "radiometry/scene/SkyRadiance.h"
#include "tests/core/EffectRandomDice.h"
#include "tests/core/EffectRandomLight.h"
#include "tests/core/TestScenes.h"

#include <algorithm>
#include <cmath>

namespace test
{
namespace
{

using namespace radiometry;

/// A mesh inside [-1, 1]^3 or so, and which of its triangles only block light.
struct Shape
{
  Mesh Surface;
  Mesh Blockers;
  std::string Name;
};

Mesh Soup(Dice& dice, int triangles)
{
  Mesh mesh;
  for (int k = 0; k < triangles; ++k)
  {
    const auto first = static_cast<std::int32_t>(mesh.Points.size());
    const Vec3 center = dice.InBox(1.0);
    const double size = dice.Chance(0.2) ? 0.02 : 0.6;
    for (int i = 0; i < 3; ++i)
    {
      mesh.Points.push_back(center + dice.InBox(size));
    }
    mesh.Triangles.push_back({ first, first + 1, first + 2 });
  }
  return mesh;
}

void AddSheet(Dice& dice, Mesh& mesh, int n)
{
  const Vec3 a = dice.InBox(0.8);
  const Vec3 b = dice.InBox(0.8);
  mesh.AddGrid(dice.InBox(0.8), a, b, n, 1);
}

Shape MakeShape(Dice& dice, RandomSize size)
{
  const bool tiny = size == RandomSize::Radiosity;
  Shape shape;
  Mesh& mesh = shape.Surface;
  const int n = tiny ? 1 : 1 + dice.Below(2);
  switch (dice.Below(6))
  {
    case 0:
      shape.Name = "body";
      dice.Chance(0.5) ? mesh.AddBox({ -0.7, -0.5, -0.3 }, { 0.2, 0.6, 0.5 }, n, false)
                       : mesh.AddSphere({ 0, 0, 0 }, 0.8, tiny ? 2 : 4, false);
      break;
    case 1:
      shape.Name = "room";
      mesh.AddBox({ -1, -1, -1 }, { 1, 0.8, 0.6 }, n, true);
      break;
    case 2:
      shape.Name = "hall";
      mesh.AddGrid({ -1, -1, -0.5 }, { 2, 0, 0 }, { 0, 2, 0 }, tiny ? 2 : 5, tiny ? 1 : 5);
      mesh.AddBox({ -0.4, -0.3, -0.5 }, { 0.1, 0.3, 0.2 }, 1, false);
      break;
    case 3:
      shape.Name = "soup";
      mesh = Soup(dice, tiny ? 8 : 24);
      break;
    case 4:
      shape.Name = "sheets";
      for (int k = tiny ? 2 : 4; k > 0; --k)
      {
        AddSheet(dice, mesh, n);
      }
      break;
    default:
      shape.Name = "body in a room";
      mesh.AddBox({ -1, -1, -1 }, { 1, 1, 1 }, n, true);
      mesh.AddBox({ -0.3, -0.4, -0.6 }, { 0.2, 0.1, 0.1 }, 1, false);
  }
  if (dice.Chance(0.3))
  {
    shape.Name += ", blockers";
    shape.Blockers = Soup(dice, 2);
  }
  return shape;
}

Scene Build(const Shape& shape, double scale, const Vec3& place)
{
  SceneBuilder builder;
  const auto add = [&](const Mesh& mesh, SceneBuilder::Role role) {
    std::vector<Vec3> points = mesh.Points;
    for (Vec3& p : points)
    {
      p = scale * p + place;
    }
    std::vector<std::int32_t> cell(mesh.Triangles.size());
    for (std::size_t t = 0; t < cell.size(); ++t)
    {
      cell[t] = static_cast<std::int32_t>(t / 2); // cells of two triangles
    }
    builder.AddMesh(role, points, mesh.Triangles, cell, 1.0);
  };
  add(shape.Surface, SceneBuilder::Role::Receiver);
  if (!shape.Blockers.Triangles.empty())
  {
    add(shape.Blockers, SceneBuilder::Role::Occluder);
  }
  return builder.Finish((shape.Surface.Triangles.size() + 1) / 2);
}

/// Fills cells x bands: each cell has the property with probability `share`, up to `most`.
std::vector<double> Property(
  Dice& dice, const Bands& bands, std::size_t cells, double share, double most)
{
  std::vector<double> values;
  for (std::size_t c = 0; c < cells; ++c)
  {
    const std::vector<double> v =
      bands.Spectrum(dice, dice.Chance(share) ? dice.Uniform(0.0, most) : 0.0);
    values.insert(values.end(), v.begin(), v.end());
  }
  return values;
}

/// What a cell sends away together stays below `most` of what it gets, by scaling all shares of it.
void Conserve(Materials& optics, std::size_t values, double most)
{
  for (std::size_t k = 0; k < values; ++k)
  {
    double factor = 1.0;
    for (int side = 0; side < 2; ++side)
    {
      double sum = 0.0;
      for (const std::vector<double>* v : { &optics.DiffuseReflectance[side],
             &optics.SpecularReflectance[side], &optics.Transmittance, &optics.DiffuseTransmittance })
      {
        sum += v->empty() ? 0.0 : (*v)[k];
      }
      factor = sum > most ? std::min(factor, most / sum) : factor;
    }
    for (std::vector<double>* v : { &optics.DiffuseReflectance[0], &optics.DiffuseReflectance[1],
           &optics.SpecularReflectance[0], &optics.SpecularReflectance[1], &optics.Transmittance,
           &optics.DiffuseTransmittance })
    {
      if (!v->empty())
      {
        (*v)[k] *= factor;
      }
    }
  }
}

void AddMaterials(Dice& dice, const Bands& bands, Scene& scene, std::string& what)
{
  Materials& optics = scene.Optics;
  const std::size_t cells = scene.Cells;
  const auto some = [&](double share, double most) {
    return Property(dice, bands, cells, share, most);
  };
  optics.Bands = bands.Count();
  const double reflectance = dice.Chance(0.15) ? 0.0 : (dice.Chance(0.2) ? 1e-4 : 0.7);
  for (int side = 0; side < 2; ++side)
  {
    optics.DiffuseReflectance[side] = some(0.9, reflectance);
  }
  if (dice.Chance(0.2))
  {
    what += ", specular";
    const double most = dice.Chance(0.4) ? 1e-5 : 0.5;
    for (int side = 0; side < 2; ++side)
    {
      optics.SpecularReflectance[side] = some(0.4, most);
      optics.Shininess[side].assign(cells, dice.Chance(0.5) ? 2 * MirrorShininess : 12.0);
    }
  }
  if (dice.Chance(0.2))
  {
    what += ", emission";
    const double most = dice.Chance(0.3) ? 1e-6 : 3.0;
    optics.EmittedExitance = { some(0.3, most), some(0.3, most) };
  }
  if (dice.Chance(0.2))
  {
    what += ", panes";
    optics.Transmittance = some(0.5, dice.Chance(0.3) ? 1e-6 : 0.9);
  }
  if (dice.Chance(0.12))
  {
    what += ", diffusing";
    optics.DiffuseTransmittance = some(0.4, dice.Chance(0.3) ? 1e-6 : 0.5);
  }
  optics.TwoSided.assign(cells, 0);
  if (dice.Chance(0.3))
  {
    what += ", two-sided";
    std::generate(optics.TwoSided.begin(), optics.TwoSided.end(),
      [&] { return static_cast<std::uint8_t>(dice.Chance(0.5)); });
  }
  Conserve(optics, cells * static_cast<std::size_t>(bands.Count()), 0.85);
  if (!optics.Transmittance.empty())
  {
    const auto count = static_cast<std::size_t>(bands.Count());
    for (std::size_t t = 0; t < scene.Triangles.size(); ++t)
    {
      for (std::size_t b = 0; b < count; ++b)
      {
        const std::int32_t cell = scene.TriangleCell[t];
        scene.TriangleTransmittance.push_back(
          cell < 0 ? 0.0 : optics.Transmittance[static_cast<std::size_t>(cell) * count + b]);
      }
    }
  }
}

/// A vertex with the triangles that meet there in one smooth sheet about one of them.
SurfacePoint Vertex(Dice& dice, const Scene& scene)
{
  const auto t = static_cast<std::size_t>(dice.Below(static_cast<int>(scene.ReceiverTriangles)));
  const std::int32_t v = scene.Triangles[t][static_cast<std::size_t>(dice.Below(3))];
  const Vec3 normal = Normalized(AreaNormal2(scene.TriangleAt(t)));
  SurfacePoint point;
  point.Point = scene.Points[static_cast<std::size_t>(v)];
  point.Triangle = static_cast<std::int32_t>(t);
  Vec3 sum;
  for (std::size_t k = 0; k < scene.ReceiverTriangles; ++k)
  {
    const auto& c = scene.Triangles[k];
    const Vec3 n = Normalized(AreaNormal2(scene.TriangleAt(k)));
    if ((c[0] == v || c[1] == v || c[2] == v) && Dot(n, normal) > std::cos(0.5))
    {
      sum = sum + n;
      point.Around.push_back(static_cast<std::int32_t>(k));
    }
  }
  point.Normal = Normalized(sum);
  return point;
}

} // namespace

RandomScene MakeRandomScene(std::uint64_t seed, RandomSize size)
{
  Dice dice(seed);
  RandomScene out;
  const bool tiny = size == RandomSize::Radiosity;
  const Shape shape = MakeShape(dice, size);
  const double scale = dice.Chance(0.7) ? 1.0 : std::pow(10.0, dice.Uniform(-3.0, 3.0));
  const Vec3 place = dice.Chance(0.2) ? Vec3{ 5e5, 4e6, 100.0 } : Vec3{};
  out.Scene = Build(shape, place == Vec3{} ? scale : 1.0, place);
  out.What = "seed " + std::to_string(seed) + ": " + shape.Name;

  const Bands bands(dice);
  out.What += ", " + bands.Words();
  AddMaterials(dice, bands, out.Scene, out.What);
  const Placement here{ place - out.Scene.Origin, place == Vec3{} ? scale : 1.0 };
  const int lights = dice.Below(tiny ? 4 : 5);
  for (int k = lights == 0 && dice.Chance(0.8) ? 1 : lights; k > 0; --k)
  {
    out.Scene.Lights.push_back(RandomLight(dice, bands, here, out.What));
    out.Scene.Lights.back().Index = static_cast<long long>(out.Scene.Lights.size()) - 1;
  }
  if (dice.Chance(0.2))
  {
    out.What += ", ambient";
    out.Scene.GlobalAmbient = bands.Spectrum(dice, dice.Chance(0.5) ? 0.2 : 1e-7);
  }

  for (int k = dice.Chance(0.7) ? (tiny ? 2 : 6) : 0; k > 0; --k)
  {
    out.Points.push_back(Vertex(dice, out.Scene));
  }
  for (int k = dice.Chance(0.4) ? (tiny ? 2 : 6) : 0; k > 0; --k)
  {
    SurfacePoint sensor;
    sensor.Point = here.Point(dice.InBox(1.2));
    sensor.Normal = dice.Direction();
    out.Points.push_back(sensor);
  }
  // What rays sample gets a tolerance that a small test can pay.
  const bool sampled = tiny ||
    std::any_of(out.Scene.Lights.begin(), out.Scene.Lights.end(),
      [](const Light& light) { return light.Type == LightType::Environment; });
  const double relative[] = { 0.0, 1e-3, 1e-2, 0.1 };
  out.RelativeTolerance = sampled ? dice.Uniform(0.05, 0.2) : relative[dice.Below(4)];
  out.AbsoluteTolerance = dice.Chance(0.3) || out.RelativeTolerance == 0.0
    ? std::pow(10.0, dice.Uniform(-3.0, -1.0))
    : 0.0;
  return out;
}

} // namespace test
