// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/DirectIrradiance.h"
#include "radiometry/irradiance/IrradianceSimulation.h"

#include "radiometry/geometry/SolidAngle.h"
#include "tests/core/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace radiometry;

namespace
{

const double Pi = std::acos(-1.0);

Light PointLight(const Scene& scene, const Vec3& position, double intensity)
{
  Light light;
  light.Position = position - scene.Origin;
  light.Intensity = { intensity };
  return light;
}

Light DirectionalLight(const Vec3& direction, double irradiance)
{
  Light light;
  light.Type = LightType::Directional;
  light.Direction = Normalized(direction);
  light.Intensity = { irradiance };
  return light;
}

DirectResult Compute(const Scene& scene, DirectOptions options = {})
{
  return ComputeDirectIrradiance(scene, OcclusionScene(scene), MakePatches(scene, 0), options);
}

TEST(DirectIrradiance, PointLightGivesSolidAngleOverArea)
{
  // 1e-9 m above a cell, on an edge, on a vertex, far away.
  for (const Vec3 where : { Vec3{ 0.3, 0.4, 1 }, Vec3{ 0.3, 0.4, 1e-9 }, Vec3{ 0.5, 0.5, 1e-3 },
         Vec3{ 0, 0, 1e-6 }, Vec3{ 0.2, 0.1, 1e9 } })
  {
    test::Mesh mesh;
    mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
    Scene scene = mesh.ToScene();
    scene.Lights.push_back(PointLight(scene, where, 2.0));
    const DirectResult r = Compute(scene);
    double flux = 0.0;
    for (std::size_t t = 0; t < 2; ++t)
    {
      flux += r.Irradiance[t] * Area(scene.TriangleAt(t));
      EXPECT_GE(r.Error[t], 0.0);
      EXPECT_LE(r.Error[t], 1e-6 * r.Irradiance[t]);
    }
    const Vec3 p = scene.Lights[0].Position;
    const Vec3 square[4] = { Vec3{ -0.5, -0.5, 0 } - p, Vec3{ 0.5, -0.5, 0 } - p,
      Vec3{ 0.5, 0.5, 0 } - p, Vec3{ -0.5, 0.5, 0 } - p };
    const double exact = 2.0 * SolidAngle(square, 4);
    EXPECT_NEAR(flux / exact, 1.0, 1e-12) << where.z;
  }
}

TEST(DirectIrradiance, TenThousandLumenThreeMetresAbove)
{
  // REFERENCES: 88.419, 75.494, 50.933, 31.261, 19.099, 12.042 lx at r = 0..5 m.
  const double exact[] = { 88.419, 75.494, 50.933, 31.261, 19.099, 12.042 };
  test::Mesh mesh;
  mesh.AddGrid({ -10, -10, 0 }, { 20, 0, 0 }, { 0, 20, 0 }, 1, 1);
  Scene scene = mesh.ToScene();
  scene.Lights.push_back(PointLight(scene, { 0, 0, 3 }, 10000.0 / (4 * Pi)));
  std::vector<SurfacePoint> points;
  for (int r = 0; r < 6; ++r)
  {
    points.push_back({ Vec3{ static_cast<double>(r), 0, 0 } - scene.Origin, { 0, 0, 1 }, -1, {}, 0.0 });
  }
  const DirectResult result = ComputeDirectIrradiance(scene, OcclusionScene(scene), points, {});
  for (int r = 0; r < 6; ++r)
  {
    EXPECT_NEAR(result.Irradiance[r], exact[r], 5e-4);
  }
}

TEST(DirectIrradiance, SpotAndDirectionalClosedForms)
{
  // A cone of 30 degrees straight down on a large floor: all of its flux lands.
  test::Mesh mesh;
  mesh.AddGrid({ -5, -5, 0 }, { 10, 0, 0 }, { 0, 10, 0 }, 7, 7);
  Scene scene = mesh.ToScene();
  Light spot = PointLight(scene, { 0.123, 0.077, 2 }, 10.0);
  spot.Type = LightType::Spot;
  spot.CosCutoff = std::cos(Pi / 6);
  spot.Exponent = 1.7;
  scene.Lights = { spot };
  const DirectResult r = Compute(scene);
  double flux = 0.0;
  for (std::size_t t = 0; t < scene.Triangles.size(); ++t)
  {
    flux += r.Irradiance[t] * Area(scene.TriangleAt(t));
  }
  const double exact = 10.0 * 2 * Pi * (1 - std::pow(std::cos(Pi / 6), 2.7)) / 2.7;
  EXPECT_NEAR(flux / exact, 1.0, 1e-11);

  scene.Lights = { DirectionalLight({ 1, 0, -1 }, 100.0) };
  for (const double e : Compute(scene).Irradiance)
  {
    EXPECT_NEAR(e, 100.0 / std::sqrt(2.0), 1e-12);
  }
  scene.Lights = { DirectionalLight({ 1, 0, 1e-6 }, 100.0) }; // from below
  for (const double e : Compute(scene).Irradiance)
  {
    EXPECT_EQ(e, 0.0);
  }
  // Grazing, 89.9999 degrees from the normal.
  const double grazing = 89.9999 * Pi / 180;
  scene.Lights = { DirectionalLight({ std::sin(grazing), 0.1, -std::cos(grazing) }, 1.0) };
  const double expected = std::cos(grazing) / std::sqrt(1 + 0.01);
  for (const double e : Compute(scene).Irradiance)
  {
    EXPECT_NEAR(e / expected, 1.0, 1e-9);
  }
}

TEST(DirectIrradiance, LegacyAttenuation)
{
  // With a = 1, b = c = 0 the irradiance is I cos(theta): on a far small cell, I.
  test::Mesh mesh;
  mesh.AddGrid({ -0.5e-3, -0.5e-3, 0 }, { 1e-3, 0, 0 }, { 0, 1e-3, 0 }, 1, 1);
  Scene scene = mesh.ToScene();
  Light light = PointLight(scene, { 0, 0, 5 }, 3.0);
  light.Attenuation[0] = 2.0;
  light.Attenuation[1] = 0.5;
  light.Attenuation[2] = 0.25;
  scene.Lights = { light };
  const DirectResult r = Compute(scene);
  EXPECT_NEAR(r.Irradiance[0], 3.0 / (2.0 + 2.5 + 6.25), 1e-6);
}

TEST(DirectIrradiance, HalfCoveredCellIsExact)
{
  // A plate at half height whose edge lies over the middle: the shadow covers x < 0 of the cell.
  test::Mesh mesh;
  mesh.AddGrid({ -0.5, -0.5, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  mesh.AddGrid({ -3, -3, 1 }, { 3, 0, 0 }, { 0, 6, 0 }, 1, 1);
  Scene scene = mesh.ToScene();
  scene.Lights = { DirectionalLight({ 0, 0, -1 }, 8.0) };
  const DirectResult r = Compute(scene);
  const double mean = 0.5 * (r.Irradiance[0] + r.Irradiance[1]);
  EXPECT_NEAR(mean, 4.0, 1e-11);
  EXPECT_LT(r.Error[0], 1e-10);
  // The same with a point light over the edge.
  scene.Lights = { PointLight(scene, { 0, 0, 2 }, 8.0) };
  const DirectResult p = Compute(scene);
  const Vec3 o = scene.Lights[0].Position;
  const Vec3 half[4] = { Vec3{ 0, -0.5, 0 } - scene.Origin - o, Vec3{ 0.5, -0.5, 0 } - scene.Origin - o,
    Vec3{ 0.5, 0.5, 0 } - scene.Origin - o, Vec3{ 0, 0.5, 0 } - scene.Origin - o };
  EXPECT_NEAR(0.5 * (p.Irradiance[0] + p.Irradiance[1]), 8.0 * SolidAngle(half, 4), 1e-11);
}

/// A box of `n` quads a side that is closed.
void ClosedBox(const Vec3& corner, double size, bool inward)
{
  for (const int n : { 1, 3 })
  {
    test::Mesh mesh;
    mesh.AddBox(corner, corner + Vec3{ size, size, size }, n, inward);
    for (const Vec3 f : { Vec3{ 0.5, 0.5, 0.5 }, Vec3{ 0.01, 0.7, 0.99 }, Vec3{ -1e-4, 0.4, 0.5 },
           Vec3{ 1.3, 1.4, 1.5 }, Vec3{ 0.3, 0.4, 1.0 + 1e-4 } })
    {
      Scene scene = mesh.ToScene();
      const bool inside = f.x > 0 && f.x < 1 && f.y < 1 && f.z < 1;
      scene.Lights = { PointLight(scene, corner + size * f, 1.0) };
      const DirectResult r = Compute(scene);
      double flux = 0.0;
      for (std::size_t t = 0; t < scene.Triangles.size(); ++t)
      {
        flux += r.Irradiance[t] * Area(scene.TriangleAt(t));
        if (inside != inward)
        {
          EXPECT_EQ(r.Irradiance[t], 0.0) << n << " " << f.x;
        }
      }
      if (inside && inward)
      {
        EXPECT_NEAR(flux, 4 * Pi, 1e-9);
      }
    }
  }
}

TEST(DirectIrradiance, ClosedBox)
{
  ClosedBox({ 0, 0, 0 }, 1.0, true);
  ClosedBox({ 0, 0, 0 }, 1.0, false);
}
TEST(DirectIrradiance, ClosedBoxAtOtherScalesAndPlaces)
{
  ClosedBox({ 5e5, 4e6, 0 }, 8.0, true);
  ClosedBox({ 5e5, 4e6, 0 }, 8.0, false);
  ClosedBox({ 0, 0, 0 }, 1e-6, true);
  ClosedBox({ 0, 0, 0 }, 1e9, false);
}

TEST(DirectIrradiance, BoxOnFloorCastsItsShadow)
{
  // A unit box standing on a floor cell much larger than it, sun at 45 degrees along x: shadow of
  // the box on the floor is its 1 x 1 foot and 1 x 1 beside it.
  test::Mesh mesh;
  mesh.AddGrid({ -4, -4, 0 }, { 8, 0, 0 }, { 0, 8, 0 }, 1, 1);
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 1, false);
  Scene scene = mesh.ToScene();
  scene.Lights = { DirectionalLight({ 1, 0, -1 }, std::sqrt(2.0)) };
  const DirectResult r = Compute(scene);
  EXPECT_NEAR(r.Irradiance[0] * 32 + r.Irradiance[1] * 32, 64.0 - 2.0, 1e-9);
  EXPECT_LT(r.Error[0], 1e-9);
  // Sunk into the floor by a third: the shadow is 1 x (2/3) and the foot.
  test::Mesh sunk;
  sunk.AddGrid({ -4, -4, 0 }, { 8, 0, 0 }, { 0, 8, 0 }, 1, 1);
  sunk.AddBox({ 0, 0, -1.0 / 3 }, { 1, 1, 2.0 / 3 }, 1, false);
  Scene second = sunk.ToScene();
  second.Lights = scene.Lights;
  const DirectResult s = Compute(second);
  EXPECT_NEAR(s.Irradiance[0] * 32 + s.Irradiance[1] * 32, 64.0 - 1.0 - 2.0 / 3, 1e-9);
}

TEST(DirectIrradiance, RoundOccluderIsCutOutExactly)
{
  // The flux that a convex polyhedron takes from the floor is what falls on its lit faces.
  test::Mesh mesh;
  mesh.AddGrid({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 6, 6);
  mesh.AddSphere({ 0.1, 0.05, 1 }, 0.4, 24, false);
  Scene scene = mesh.ToScene();
  scene.Lights = { PointLight(scene, { 0, 0, 2.5 }, 1.0) };
  const DirectResult r = Compute(scene);
  DirectOptions bare;
  bare.Occlusion = false;
  const DirectResult open = Compute(scene, bare);
  double lost = 0.0;
  double taken = 0.0;
  for (std::size_t t = 0; t < scene.Triangles.size(); ++t)
  {
    const double area = Area(scene.TriangleAt(t));
    t < 72 ? lost += (open.Irradiance[t] - r.Irradiance[t]) * area : taken += r.Irradiance[t] * area;
  }
  EXPECT_NEAR(lost / taken, 1.0, 1e-9);
}

TEST(DirectIrradiance, ErrorCoversTheTruthUnderFoliage)
{
  // Forty thousand small leaves over a floor: too many edges in each shaft to cut along them all
  // at this tolerance.
  test::Mesh mesh;
  mesh.AddGrid({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 8, 8);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 40000; ++k)
  {
    const Vec3 c{ 2 * unit(random), 2 * unit(random), 1.2 + 0.5 * unit(random) };
    mesh.AddGrid(c, 0.02 * Vec3{ unit(random), unit(random), unit(random) },
      0.02 * Vec3{ unit(random), unit(random), unit(random) }, 1, 1);
  }
  Scene scene = mesh.ToScene();
  scene.Lights = { PointLight(scene, { 0, 0, 2.5 }, 1.0) };
  std::vector<Patch> floor = MakePatches(scene, 0);
  floor.resize(128);
  const OcclusionScene occluders(scene);
  DirectOptions options;
  options.RelativeTolerance = 0.05;
  const DirectResult coarse = ComputeDirectIrradiance(scene, occluders, floor, options);
  // Reference: every cell cut along all of its lines, which the test above holds to a closed form.
  options.RelativeTolerance = 1e-7;
  const DirectResult fine = ComputeDirectIrradiance(scene, occluders, floor, options);
  int covered = 0;
  int estimated = 0;
  std::vector<double> ratios;
  for (std::size_t t = 0; t < floor.size(); ++t)
  {
    const double difference = std::fabs(coarse.Irradiance[t] - fine.Irradiance[t]);
    EXPECT_LE(fine.Error[t], 1e-5 * fine.Irradiance[t]);
    EXPECT_LE(coarse.Error[t], 0.05 * fine.Irradiance[t]);
    estimated += coarse.Error[t] > 1e-6 * fine.Irradiance[t] ? 1 : 0;
    covered += difference <= coarse.Error[t] ? 1 : 0;
    ratios.push_back(coarse.Error[t] / std::max(difference, 1e-12));
  }
  EXPECT_GE(covered, 122); // 95 % of 128
  EXPECT_GE(estimated, 100); // the rest was cut along all of its lines
  std::nth_element(ratios.begin(), ratios.begin() + 64, ratios.end());
  EXPECT_LT(ratios[64], 10.0);
}

TEST(DirectIrradiance, SameBytesForAnyNumberOfThreads)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 4, 4, 3 }, 12, true);
  mesh.AddSphere({ 1, 2, 1 }, 0.5, 16, false);
  Scene scene = mesh.ToScene();
  scene.Lights = { PointLight(scene, { 2, 2, 2.5 }, 100.0),
    PointLight(scene, { 1, 1, 2.9 }, 30.0), DirectionalLight({ 0.3, 0.1, -1 }, 5.0) };
  DirectOptions options;
  options.Threads = 1;
  const DirectResult one = Compute(scene, options);
  for (const int threads : { 2, 7 })
  {
    options.Threads = threads;
    const DirectResult many = Compute(scene, options);
    EXPECT_EQ(one.Irradiance, many.Irradiance);
    EXPECT_EQ(one.Error, many.Error);
    EXPECT_EQ(one.Rays, many.Rays);
  }
}

TEST(DirectIrradiance, AbortIsSeen)
{
  struct Stopper : Monitor
  {
    bool Progress(double, const char*) override { return false; }
  } stopper;
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 4, 4, 3 }, 2, true);
  Scene scene = mesh.ToScene();
  scene.Lights = { PointLight(scene, { 2, 2, 2.5 }, 100.0) };
  EXPECT_THROW(ComputeDirectIrradiance(scene, OcclusionScene(scene), MakePatches(scene, 0), {},
                 { &stopper, 0.0, 1.0, "direct" }),
    Aborted);
}

} // namespace
