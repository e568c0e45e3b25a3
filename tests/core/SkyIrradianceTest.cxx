// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/SkyIrradiance.h"

#include "radiometry/geometry/Sampling.h"
#include "radiometry/irradiance/IrradianceSimulation.h"
#include "radiometry/scene/SkyRadiance.h"
#include "tests/core/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace radiometry;
using test::SkyLight;

namespace
{

const double Pi = std::acos(-1.0);

DirectResult Compute(const Scene& scene, DirectOptions options = {})
{
  return ComputeDirectIrradiance(scene, OcclusionScene(scene), MakePatches(scene, 0), options);
}

TEST(SkyIrradiance, ConvexBodyUnderUniformSkyHasNoNoise)
{
  test::Mesh mesh;
  mesh.AddSphere({ 1, 2, 3 }, 1.5, 12, false);
  Scene scene = mesh.ToScene();
  scene.Lights = { SkyLight(SkyRadiance::Uniform(), { 2.0 }) };
  const DirectResult r = Compute(scene);
  EXPECT_EQ(r.Rays, 0);
  for (std::size_t t = 0; t < r.Irradiance.size(); ++t)
  {
    EXPECT_NEAR(r.Irradiance[t], 2.0 * Pi, 1e-13);
    EXPECT_LE(r.Error[t], 1e-12);
  }
}

TEST(SkyIrradiance, GroundDoesNotHideASkyThatIsDarkBelow)
{
  // A cube on a large floor, overcast: nothing hides the sky from the cube's faces, and the
  // vertical ones get 0.396 of the roof's. The floor is hidden by the cube here and there.
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 1, false);
  mesh.AddGrid({ -10, -10, 0 }, { 20, 0, 0 }, { 0, 20, 0 }, 4, 4);
  Scene scene = mesh.ToScene();
  scene.Lights = { SkyLight(SkyRadiance::Overcast()) };
  const DirectResult r = Compute(scene);
  for (std::size_t t = 0; t < 12; ++t)
  {
    const double z = Normalized(AreaNormal2(scene.TriangleAt(t))).z;
    const double exact = z > 0.5 ? 7 * Pi / 9 : (z < -0.5 ? 0.0 : Pi / 6 + 4.0 / 9.0);
    EXPECT_NEAR(r.Irradiance[t], exact, 1e-12);
    EXPECT_LE(r.Error[t], 1e-12);
  }
  for (std::size_t t = 12; t < r.Irradiance.size(); ++t)
  {
    EXPECT_LE(r.Irradiance[t], 7 * Pi / 9);
    EXPECT_LE(r.Error[t], 0.011 * r.Irradiance[t]);
  }
}

TEST(SkyIrradiance, ClosedBoxIsDarkAtEveryScaleAndPlace)
{
  for (const double size : { 1.0, 1e-6, 1e9 })
  {
    for (const Vec3 at : { Vec3{ 0, 0, 0 }, Vec3{ 5e5, 4e6, 100 } })
    {
      if (size < 1.0 && at.x > 0.0)
      {
        continue; // the coordinates themselves cannot hold that box
      }
      test::Mesh mesh;
      mesh.AddBox(at, at + Vec3{ size, size, size }, 2, true);
      Scene scene = mesh.ToScene();
      scene.Lights = { SkyLight(SkyRadiance::Uniform()), SkyLight(SkyRadiance::Overcast()) };
      const DirectResult r = Compute(scene);
      for (std::size_t k = 0; k < r.Irradiance.size(); ++k)
      {
        EXPECT_EQ(r.Irradiance[k], 0.0);
        EXPECT_EQ(r.Error[k], 0.0);
      }
      EXPECT_LT(r.Rays, 48 * 2 * 400);
    }
  }
}

TEST(SkyIrradiance, AlmostClosedIsNotClosed)
{
  // A box with a slit of a thousandth of its roof: not every cell's rays need find it, so what finds
  // nothing has an error that covers it.
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 1, true);
  mesh.Triangles.erase(mesh.Triangles.begin() + 2, mesh.Triangles.begin() + 4); // the roof
  mesh.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 0.999, 0, 0 }, 1, 1);
  Scene scene = mesh.ToScene();
  scene.Lights = { SkyLight(SkyRadiance::Uniform()) };
  const DirectResult r = Compute(scene);
  for (std::size_t t = 0; t < r.Irradiance.size(); ++t)
  {
    EXPECT_GT(r.Error[t], 0.0);
    EXPECT_LT(r.Irradiance[t], 0.05);
  }
}

TEST(SkyIrradiance, OpenBoxUnderUniformSkyByViewFactors)
{
  // The floor of an open cube sees the opening by the factor of parallel unit squares, a wall by
  // that of perpendicular ones (REFERENCES): what arrives is pi L F.
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 2, true);
  // The roof is the second face: 8 triangles from 8 on.
  mesh.Triangles.erase(mesh.Triangles.begin() + 8, mesh.Triangles.begin() + 16);
  Scene scene = mesh.ToScene();
  scene.Lights = { SkyLight(SkyRadiance::Uniform()) };
  DirectOptions options;
  options.RelativeTolerance = 0.01;
  const DirectResult r = Compute(scene, options);
  double floor = 0.0, wall = 0.0, floorError = 0.0;
  for (std::size_t t = 0; t < 16; ++t)
  {
    (t < 8 ? floor : wall) += r.Irradiance[t] / 8.0;
    floorError += t < 8 ? r.Error[t] / 8.0 : 0.0;
    EXPECT_LE(r.Error[t], 0.0101 * r.Irradiance[t]);
  }
  EXPECT_NEAR(floor, Pi * 0.199824895698387, 0.003 * floor);
  EXPECT_NEAR(wall, Pi * 0.200043776075403, 0.003 * wall);
  EXPECT_LT(floorError, 0.0101 * floor);
}

TEST(SkyIrradiance, InfiniteCanyon)
{
  // Walls of height h at both sides of a street of width w, 1e4 long: points in the middle of the
  // street see pi L sin(atan(w/2/h)) of a uniform sky; a canyon's wall at height z looks up by
  // (1 - cos(angle))/2 of it.
  const double w = 2.0, h = 3.0, l = 1e4;
  test::Mesh mesh;
  mesh.AddGrid({ -w / 2, -l, 0 }, { w, 0, 0 }, { 0, 2 * l, 0 }, 1, 1);
  mesh.AddGrid({ -w / 2, -l, 0 }, { 0, 2 * l, 0 }, { 0, 0, h }, 1, 1);
  mesh.AddGrid({ w / 2, -l, 0 }, { 0, 0, h }, { 0, 2 * l, 0 }, 1, 1);
  Scene scene = mesh.ToScene();
  const Light even = SkyLight(SkyRadiance::General(SkyRadiance::TypeCoefficients(5), { 0, 0, 1 }));
  scene.Lights = { even };
  std::vector<SurfacePoint> points;
  std::vector<double> exact;
  for (int k = 0; k < 40; ++k)
  {
    const double x = (k - 19.5) / 20.0 * 0.49 * w;
    points.push_back({ Vec3{ x, 0.1 * k, 0 } - scene.Origin, { 0, 0, 1 }, -1, {}, 0.0 });
    const auto side = [&](double d) { return d / std::hypot(d, h); };
    exact.push_back(Pi * 0.5 * (side(w / 2 + x) + side(w / 2 - x)));
  }
  for (int k = 0; k < 40; ++k)
  {
    const double z = (k + 0.5) / 40.0 * h;
    points.push_back({ Vec3{ -w / 2, 0.1 * k, z } - scene.Origin, { 1, 0, 0 }, -1, {}, 0.0 });
    exact.push_back(Pi * 0.5 * (1.0 - (h - z) / std::hypot(w, h - z)));
  }
  const DirectResult r = ComputeDirectIrradiance(scene, OcclusionScene(scene), points, {});
  int covered = 0;
  std::vector<double> ratio;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const double off = std::fabs(r.Irradiance[k] - exact[k]);
    covered += off <= r.Error[k] ? 1 : 0;
    ratio.push_back(r.Error[k] / std::max(off, 1e-300));
    EXPECT_LE(r.Error[k], 0.0101 * r.Irradiance[k]);
  }
  EXPECT_GE(covered, 76);
  std::nth_element(ratio.begin(), ratio.begin() + 40, ratio.end());
  EXPECT_LT(ratio[40], 10.0);
}

TEST(SkyIrradiance, HotPixelIsASun)
{
  // One bright pixel of half a degree against the same as a directional light: a plate's shadow.
  const int w = 720, h = 360, row = 80, column = 500;
  std::vector<double> values(static_cast<std::size_t>(w) * h, 0.0);
  values[static_cast<std::size_t>(row) * w + column] = 1e5;
  test::Mesh mesh;
  mesh.AddGrid({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 8, 8);
  mesh.AddGrid({ -0.5, -0.5, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  Scene scene = mesh.ToScene();
  scene.Lights = { SkyLight(SkyRadiance::Map(w, h, 1, values)) };
  const DirectResult map = Compute(scene);
  const double elevation = Pi * (0.5 - (row + 0.5) / h);
  const double azimuth = 2 * Pi * ((column + 0.5) / w - 0.5);
  const double solidAngle = 2 * Pi / w * 2 * std::cos(elevation) * std::sin(0.5 * Pi / h);
  Light sun;
  sun.Type = LightType::Directional;
  sun.Direction = -Vec3{ std::cos(elevation) * std::sin(azimuth),
    std::cos(elevation) * std::cos(azimuth), std::sin(elevation) };
  sun.Intensity = { 1e5 * solidAngle };
  scene.Lights = { sun };
  const DirectResult beam = Compute(scene);
  int shadowed = 0;
  for (std::size_t t = 0; t < map.Irradiance.size(); ++t)
  {
    // The penumbra of half a degree and a distance of 1.3 m is 1 cm wide: 3 % of a cell of 0.5 m.
    EXPECT_NEAR(map.Irradiance[t], beam.Irradiance[t], 0.02 * sun.Intensity[0] + 2 * map.Error[t]);
    shadowed += beam.Irradiance[t] < 0.1 * sun.Intensity[0] ? 1 : 0;
  }
  EXPECT_GE(shadowed, 2);
}

TEST(SkyIrradiance, TurningSkyAndSceneTogetherChangesNothing)
{
  const auto build = [](const Vec3& x, const Vec3& y, const Vec3& z) {
    test::Mesh mesh;
    mesh.AddGrid(-2.0 * x - 2.0 * y, 4.0 * x, 4.0 * y, 3, 3);
    mesh.AddGrid(0.3 * x - y, 2.0 * y, 1.5 * z, 1, 1);
    Scene scene = mesh.ToScene();
    Light light = SkyLight(
      SkyRadiance::General(SkyRadiance::TypeCoefficients(12), { 0.5, -0.3, 0.35 }));
    light.Direction = -z;
    light.Reference = y;
    scene.Lights = { light };
    return scene;
  };
  DirectOptions options;
  options.RelativeTolerance = 0.003;
  const DirectResult a = Compute(build({ 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }), options);
  const DirectResult b = Compute(build({ 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 0 }), options);
  for (std::size_t t = 0; t < a.Irradiance.size(); ++t)
  {
    EXPECT_NEAR(a.Irradiance[t], b.Irradiance[t], a.Error[t] + b.Error[t]);
  }
}

TEST(SkyIrradiance, ScaleAndPlaceChangeNothing)
{
  const auto build = [](double size, const Vec3& at) {
    test::Mesh mesh;
    mesh.AddGrid(at, { 4 * size, 0, 0 }, { 0, 4 * size, 0 }, 4, 4);
    mesh.AddBox(at + Vec3{ size, size, 0 }, at + Vec3{ 2 * size, 2.5 * size, 1.5 * size }, 2, false);
    Scene scene = mesh.ToScene();
    scene.Lights = { SkyLight(
      SkyRadiance::General(SkyRadiance::TypeCoefficients(12), { 0.5, -0.3, 0.35 })) };
    return scene;
  };
  const DirectResult one = Compute(build(1.0, {}));
  for (const auto& [size, at] : { std::pair<double, Vec3>{ 1e-6, {} }, { 1e9, {} },
         { 1.0, { 5e5, 4e6, 100 } } })
  {
    const DirectResult other = Compute(build(size, at));
    for (std::size_t t = 0; t < one.Irradiance.size(); ++t)
    {
      EXPECT_NEAR(other.Irradiance[t], one.Irradiance[t], 1e-6 * one.Irradiance[t]) << size << " " << t;
    }
  }
}

TEST(SkyIrradiance, EdgeOnAndDegenerate)
{
  // A cell that the horizon of the sky lies in, one that looks down, one without area, a needle.
  test::Mesh mesh;
  mesh.Points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 5 }, { 1, 0, 5 }, { 0, 1e-7, 5 },
    { 0, 0, 9 }, { 0, 1, 9 }, { 0, 0, 10 } };
  mesh.Triangles = { { 0, 2, 1 }, { 3, 4, 5 }, { 6, 7, 8 } };
  Scene scene = mesh.ToScene();
  for (const auto& sky : { SkyRadiance::Overcast(),
         SkyRadiance::General(SkyRadiance::TypeCoefficients(12), { 0.5, -0.3, 0.35 }) })
  {
    scene.Lights = { SkyLight(sky) };
    const DirectResult r = Compute(scene);
    EXPECT_EQ(r.Irradiance[0], 0.0);
    EXPECT_GT(r.Irradiance[1], 1.0);
    EXPECT_GT(r.Irradiance[2], 0.3);
    EXPECT_LE(r.Error[1], 0.01 * r.Irradiance[1]);
    EXPECT_LE(r.Error[2], 0.01 * r.Irradiance[2]);
  }
}

TEST(SkyIrradiance, VerticesOfASmoothBodyHaveNoTerminator)
{
  // A convex body, values at its vertices: the uniform sky gives pi everywhere, rays or none.
  test::Mesh mesh;
  mesh.AddSphere({ 0, 0, 0 }, 1.0, 8, false);
  Scene scene = mesh.ToScene();
  scene.Lights = { SkyLight(SkyRadiance::Uniform()) };
  std::vector<SurfacePoint> points;
  for (std::size_t v = 0; v < scene.Points.size(); ++v)
  {
    SurfacePoint p{ scene.Points[v], Normalized(scene.Points[v]), -1, {}, 0.0 };
    for (std::size_t t = 0; t < scene.Triangles.size(); ++t)
    {
      for (const std::int32_t corner : scene.Triangles[t])
      {
        if (corner == static_cast<std::int32_t>(v))
        {
          p.Around.push_back(static_cast<std::int32_t>(t));
        }
      }
    }
    points.push_back(p);
  }
  const DirectResult r = ComputeDirectIrradiance(scene, OcclusionScene(scene), points, {});
  for (std::size_t v = 0; v < points.size(); ++v)
  {
    EXPECT_NEAR(r.Irradiance[v], Pi, 1e-12);
  }
}

TEST(SkyIrradiance, StopsWhenAskedAndWhenTimeIsUp)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 4, true);
  mesh.Triangles.erase(mesh.Triangles.begin() + 32, mesh.Triangles.begin() + 64);
  Scene scene = mesh.ToScene();
  scene.Lights = { SkyLight(SkyRadiance::Uniform()) };
  struct Stop : Monitor
  {
    int Calls = 0;
    bool Progress(double, const char*) override { return ++this->Calls < 4; }
  } stop;
  EXPECT_THROW(ComputeDirectIrradiance(scene, OcclusionScene(scene), MakePatches(scene, 0), {},
                 { &stop, 0.0, 1.0, "sky" }),
    Aborted);
  EXPECT_EQ(stop.Calls, 4);
  DirectOptions options;
  options.SecondsLeft = 1e-9;
  const DirectResult r = Compute(scene, options);
  EXPECT_TRUE(r.TimedOut);
  for (std::size_t t = 0; t < r.Irradiance.size(); ++t)
  {
    EXPECT_NEAR(r.Irradiance[t], 0.5 * Pi, 0.5 * Pi); // nothing known: half, with an error of half
    EXPECT_GE(r.Irradiance[t] + r.Error[t], Pi * 0.1);
  }
}

TEST(SkyIrradiance, PanesLetTheirShareThrough)
{
  // A glass plate over all of a small plate: what it lets through of everything that crosses it.
  test::Mesh mesh;
  mesh.AddGrid({ -0.5, -0.5, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  mesh.AddGrid({ -1e4, -1e4, 1 }, { 2e4, 0, 0 }, { 0, 2e4, 0 }, 1, 1);
  Scene scene = mesh.ToScene();
  scene.Optics.Bands = 2;
  scene.TriangleTransmittance = { 0, 0, 0, 0, 0.8, 0.25, 0.8, 0.25 };
  scene.Lights = { SkyLight(SkyRadiance::Overcast(), { 1.0, 2.0 }) };
  const DirectResult r = Compute(scene);
  for (std::size_t t = 0; t < 2; ++t)
  {
    EXPECT_NEAR(r.Irradiance[2 * t], 0.8 * 7 * Pi / 9, r.Error[2 * t]);
    EXPECT_NEAR(r.Irradiance[2 * t + 1], 0.5 * 7 * Pi / 9, r.Error[2 * t + 1]);
    EXPECT_LE(r.Error[2 * t], 0.01 * r.Irradiance[2 * t]);
  }
  DirectOptions opaque;
  opaque.Transmission = false;
  EXPECT_LE(Compute(scene, opaque).Irradiance[0], 0.01);
}

TEST(SkyIrradiance, SumOfTwoSkiesAndBands)
{
  test::Mesh mesh;
  mesh.AddGrid({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 2, 2);
  mesh.AddGrid({ -1, 0, 0.5 }, { 2, 0, 0 }, { 0, 1, 0 }, 1, 1);
  Scene scene = mesh.ToScene();
  scene.Optics.Bands = 3;
  for (auto& side : scene.Optics.DiffuseReflectance)
  {
    side.assign(scene.Cells * 3, 0.5);
  }
  const Light a = SkyLight(SkyRadiance::Uniform(), { 1, 0, 2 });
  const Light b = SkyLight(SkyRadiance::Map(2, 2, 3, { 0, 1, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0 }), { 1, 2, 3 });
  scene.Lights = { a };
  const DirectResult first = Compute(scene);
  scene.Lights = { b };
  const DirectResult second = Compute(scene);
  scene.Lights = { a, b };
  const DirectResult both = Compute(scene);
  for (std::size_t k = 0; k < both.Irradiance.size(); ++k)
  {
    EXPECT_NEAR(both.Irradiance[k], first.Irradiance[k] + second.Irradiance[k],
      1e-12 + both.Error[k] + first.Error[k] + second.Error[k]);
  }
  EXPECT_EQ(first.Irradiance[1], 0.0);
  EXPECT_GT(second.Irradiance[1], 0.0);
}

TEST(SkyIrradiance, SameBytesForAnyNumberOfThreads)
{
  test::Mesh mesh;
  mesh.AddGrid({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 6, 6);
  mesh.AddSphere({ 0, 0, 0.6 }, 0.4, 6, false);
  Scene scene = mesh.ToScene();
  scene.Lights = { SkyLight(SkyRadiance::Overcast()) };
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

TEST(SkyIrradiance, ErrorsCoverOnRandomScenes)
{
  // Triangles strewn over a floor; brute force by 2^20 plain cosine rays a cell.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  test::Mesh mesh;
  mesh.AddGrid({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 3, 3);
  for (int k = 0; k < 25; ++k)
  {
    const Vec3 c{ 2 * uniform(random), 2 * uniform(random), 1.1 + uniform(random) };
    const auto first = static_cast<std::int32_t>(mesh.Points.size());
    for (int i = 0; i < 3; ++i)
    {
      mesh.Points.push_back(
        c + 0.5 * Vec3{ uniform(random), uniform(random), uniform(random) });
    }
    mesh.Triangles.push_back({ first, first + 1, first + 2 });
  }
  Scene scene = mesh.ToScene();
  const OcclusionScene occluders(scene);
  const auto sky = SkyRadiance::General(SkyRadiance::TypeCoefficients(12), { 0.5, -0.3, 0.35 });
  scene.Lights = { SkyLight(sky) };
  const std::vector<Patch> patches = MakePatches(scene, 0);
  const DirectResult r = ComputeDirectIrradiance(scene, occluders, patches, {});
  int covered = 0;
  std::vector<double> ratio;
  const int rays = 1 << 16;
  for (std::size_t t = 0; t < patches.size(); ++t)
  {
    double sum = 0.0;
    const Vec3 n = Normalized(AreaNormal2(patches[t].Corners));
    const SobolSequence sequence(Hash64(99, t));
    for (int k = 0; k < rays; ++k)
    {
      const auto u = sequence(static_cast<std::uint32_t>(k));
      const Vec3 w = CosineDirection(n, u[0], u[1]);
      if (w.z > 0.0 &&
        !occluders.OccludedDirection({ TrianglePoint(patches[t].Corners, u[2], u[3]), patches[t].Triangle }, w))
      {
        sum += sky->At(w);
      }
    }
    const double exact = Pi * sum / rays;
    const double off = std::fabs(r.Irradiance[t] - exact);
    covered += off <= r.Error[t] + 5e-4 * exact ? 1 : 0;
    ratio.push_back(r.Error[t] / std::max(off, 1e-12));
  }
  EXPECT_GE(covered, static_cast<int>(0.95 * patches.size()));
  std::nth_element(ratio.begin(), ratio.begin() + ratio.size() / 2, ratio.end());
  EXPECT_LT(ratio[ratio.size() / 2], 10.0);
}

} // namespace
