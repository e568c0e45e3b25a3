// SPDX-License-Identifier: BSD-3-Clause
// Cells cut along the edges of shadows: area, flux, corners, and what is hard about it.
#include "radiometry/irradiance/IrradianceSimulation.h"
#include "radiometry/irradiance/PieceMerging.h"

#include "tests/core/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

using namespace radiometry;

namespace
{

Light PointLight(const Scene& scene, const Vec3& place, double intensity = 1.0)
{
  Light light;
  light.Position = place - scene.Origin;
  light.Intensity = { intensity };
  return light;
}

double PieceArea(const ShadowPieces& pieces, std::size_t i)
{
  Vec3 sum;
  const std::size_t first = pieces.First[i];
  for (std::size_t k = first + 2; k < pieces.First[i + 1]; ++k)
  {
    sum += Cross(pieces.Points[pieces.Corners[k - 1]] - pieces.Points[pieces.Corners[first]],
      pieces.Points[pieces.Corners[k]] - pieces.Points[pieces.Corners[first]]);
  }
  return 0.5 * Length(sum);
}

/// Pieces are convex, turn as their cell does, fill it, fit one another, and get its flux; their
/// values have rounding error only. Returns the refined run.
IrradianceResult Check(const Scene& scene, double relative = 1e-9)
{
  IrradianceOptions options;
  options.RelativeTolerance = 1e-9;
  const IrradianceResult whole = SimulateIrradiance(scene, {}, options);
  options.RefineShadowBoundaries = true;
  options.PiecesPerCell = 100000;
  IrradianceResult refined = SimulateIrradiance(scene, {}, options);
  const ShadowPieces& pieces = refined.Pieces;
  EXPECT_EQ(pieces.Full, 0u);
  std::vector<double> area(scene.Cells, 0.0);
  std::vector<double> flux(scene.Cells, 0.0);
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  double brightest = 0.0;
  for (std::size_t i = 0; i < pieces.Size(); ++i)
  {
    const std::int32_t cell = pieces.Cell[i];
    const Triangle3 t = scene.TriangleAt(static_cast<std::size_t>(cell)); // a cell each
    const Vec3 normal = Normalized(AreaNormal2(t));
    const double a = pieces.Whole[i] ? Area(t) : PieceArea(pieces, i);
    area[cell] += a;
    flux[cell] += a * refined.Cells[0].Values[i];
    brightest = std::max(brightest, refined.Cells[0].Values[i]);
    const std::size_t n = pieces.First[i + 1] - pieces.First[i];
    for (std::size_t k = 0; k < n; ++k)
    {
      const std::int32_t* c = &pieces.Corners[pieces.First[i]];
      const Vec3 in = pieces.Points[c[(k + 1) % n]] - pieces.Points[c[k]];
      const Vec3 out = pieces.Points[c[(k + 2) % n]] - pieces.Points[c[(k + 1) % n]];
      EXPECT_GT(Length(in), 0.0);
      EXPECT_GE(Dot(normal, Cross(in, out)), -1e-11 * Length(out) * (1.0 + Length(in)));
      ++edges[{ c[k], c[(k + 1) % n] }];
    }
  }
  for (const auto& [edge, count] : edges)
  {
    EXPECT_EQ(count, 1) << "an edge belongs to one piece on each side";
  }
  for (std::size_t c = 0; c < scene.Cells; ++c)
  {
    const double a = Area(scene.TriangleAt(c));
    EXPECT_NEAR(area[c], a, 1e-13 * a);
    EXPECT_NEAR(flux[c], whole.Cells[0].Values[c] * a,
      whole.Cells[0].Errors[c] * a + relative * brightest * a);
  }
  // Rounding only: small beside the light of the cell (of a sliver far from the origin it is a larger
  // share of its own).
  for (std::size_t i = 0; i < pieces.Size(); ++i)
  {
    const double cell = Area(scene.TriangleAt(static_cast<std::size_t>(pieces.Cell[i])));
    const double piece = pieces.Whole[i] ? cell : PieceArea(pieces, i);
    EXPECT_LE(refined.Cells[0].Errors[i] * piece, relative * brightest * cell);
  }
  return refined;
}

TEST(PieceMerging, JoinsAndFits)
{
  // A square cut into four along lines that do not meet in one corner (T-junctions), one state: one
  // square again; with one piece of another state: what is left stays convex.
  const auto piece = [](double x0, double y0, double x1, double y1, std::int64_t state) {
    return PlanePiece{ { { x0, y0, 0 }, { x1, y0, 0 }, { x1, y1, 0 }, { x0, y1, 0 } }, state };
  };
  std::vector<PlanePiece> pieces{ piece(0, 0, 0.5, 0.3, 0), piece(0, 0.3, 0.5, 1, 0),
    piece(0.5, 0, 1, 0.6, 0), piece(0.5, 0.6, 1, 1, 0) };
  const std::vector<Vec3> corners{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  PieceSet joined = JoinPieces(pieces, { 0, 0, 1 }, 1e-12, corners);
  ASSERT_EQ(joined.Loops.size(), 1u);
  EXPECT_EQ(joined.Loops[0].size(), 4u);
  pieces[3].State = 1;
  joined = JoinPieces(pieces, { 0, 0, 1 }, 1e-12, corners);
  EXPECT_EQ(joined.Loops.size(), 3u);
  std::size_t corner = 0; // the one of the odd piece that lies inside is one of its neighbours', too
  for (const auto& loop : joined.Loops)
  {
    for (const std::int32_t p : loop)
    {
      corner += joined.Points[p] == Vec3{ 0.5, 0.6, 0 } ? 1 : 0;
    }
  }
  EXPECT_GE(corner, 2u);
}

TEST(ShadowPieces, RandomBlockersKeepAreaAndFlux)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const Vec3& at : { Vec3{}, Vec3{ 5e5, 4e6, 12 } })
  {
    for (int trial = 0; trial < 6; ++trial)
    {
      test::Mesh mesh;
      mesh.AddGrid(at + Vec3{ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 1 + trial, 1);
      for (int k = 0; k < 12 + 4 * trial; ++k)
      {
        const Vec3 o = at + Vec3{ 1.5 * unit(random), 1.5 * unit(random), 0.8 + 0.7 * unit(random) };
        const auto first = static_cast<std::int32_t>(mesh.Points.size());
        for (int c = 0; c < 3; ++c)
        {
          mesh.Points.push_back(o + 0.4 * Vec3{ unit(random), unit(random), unit(random) });
        }
        mesh.Triangles.push_back({ first, first + 1, first + 2 });
      }
      Scene scene = mesh.ToScene();
      scene.Lights = { PointLight(scene, at + Vec3{ unit(random), unit(random), 2.0 }),
        PointLight(scene, at + Vec3{ unit(random), unit(random), 0.9 }) };
      const IrradianceResult refined = Check(scene, at.x > 0.0 ? 1e-7 : 1e-9);
      EXPECT_GT(refined.Pieces.Size(), 2 * scene.Cells);
    }
  }
}

TEST(ShadowPieces, HardPlacesOfTheLight)
{
  test::Mesh mesh;
  mesh.AddGrid({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 2, 2);
  mesh.AddBox({ 0.2, 0.3, 0.0 }, { 0.9, 1.1, 0.7 }, 1, false); // stands on the floor
  mesh.AddGrid({ -1.5, -1.2, 0.5 }, { 0.8, 0, 0 }, { 0, 0.9, 0 }, 1, 1);
  mesh.AddGrid({ -1.5, -1.2, 0.5 }, { 0.8, 0, 0 }, { 0, 0.9, 0 }, 1, 1); // the same again
  Scene scene = mesh.ToScene();
  // In the floor's plane, in the plane of a wall and above its edge, 1e-9 above a cell, on a vertex
  // of the floor, far away.
  for (const Vec3& place : { Vec3{ -1.7, 0.1, 0.0 }, Vec3{ 0.2, -1.0, 0.7 }, Vec3{ 0.9, 1.1, 2.0 },
         Vec3{ -0.7, -0.5, 1e-9 }, Vec3{ 0, 0, 1.5 }, Vec3{ -1.1, -0.75, 0.5 },
         Vec3{ 1e6, 2e6, 3e6 } })
  {
    scene.Lights = { PointLight(scene, place) };
    Check(scene);
  }
  Light sun;
  sun.Type = LightType::Directional;
  sun.Intensity = { 1.0 };
  for (const Vec3& way : { Vec3{ 0, 0, -1 }, Vec3{ 1, 0, -1 }, Vec3{ 1, 0.5, -1e-3 } })
  {
    sun.Direction = Normalized(way);
    scene.Lights = { sun };
    Check(scene);
  }
}

TEST(ShadowPieces, ClosedBoxesAreNotCut)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 2, 2, 2 }, 3, true);
  Scene scene = mesh.ToScene();
  for (const Vec3& place : { Vec3{ 1, 1.1, 0.9 }, Vec3{ 1, 1, 2.0002 }, Vec3{ 5, 6, 7 } })
  {
    scene.Lights = { PointLight(scene, place) };
    IrradianceOptions options;
    options.RefineShadowBoundaries = true;
    options.Switches[static_cast<int>(Effect::Occlusion)] = EffectSwitch::On;
    const IrradianceResult refined = SimulateIrradiance(scene, {}, options);
    EXPECT_EQ(refined.Pieces.Size(), scene.Cells);
    const bool inside = place.z < 2.0;
    for (const double e : refined.Cells[0].Values)
    {
      EXPECT_EQ(e > 0.0, inside);
    }
  }
}

TEST(ShadowPieces, LimitKeepsTheFlux)
{
  test::Mesh mesh;
  mesh.AddGrid({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 1, 1);
  mesh.AddSphere({ 0.1, 0.2, 1.0 }, 0.5, 12, false);
  Scene scene = mesh.ToScene();
  scene.Lights = { PointLight(scene, { 0.3, 0.1, 3.0 }) };
  IrradianceOptions options;
  options.RelativeTolerance = 1e-9;
  const IrradianceResult whole = SimulateIrradiance(scene, {}, options);
  options.RefineShadowBoundaries = true;
  for (const std::size_t most : { 1u, 4u, 10u })
  {
    options.PiecesPerCell = most;
    const IrradianceResult refined = SimulateIrradiance(scene, {}, options);
    EXPECT_GE(refined.Pieces.Full, 1u);
    std::vector<double> flux(scene.Cells, 0.0);
    std::vector<std::size_t> count(scene.Cells, 0);
    for (std::size_t i = 0; i < refined.Pieces.Size(); ++i)
    {
      const auto cell = static_cast<std::size_t>(refined.Pieces.Cell[i]);
      ++count[cell];
      flux[cell] += refined.Cells[0].Values[i] *
        (refined.Pieces.Whole[i] ? Area(scene.TriangleAt(cell)) : PieceArea(refined.Pieces, i));
    }
    for (std::size_t c = 0; c < scene.Cells; ++c)
    {
      EXPECT_LE(count[c], most);
      const double a = Area(scene.TriangleAt(c));
      EXPECT_NEAR(flux[c], whole.Cells[0].Values[c] * a, 1e-6 * whole.Cells[0].Values[c] * a + 1e-15);
    }
    EXPECT_NE(refined.Outcome.find("limit of pieces"), std::string::npos) << refined.Outcome;
  }
}

} // namespace
