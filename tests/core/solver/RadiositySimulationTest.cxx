// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/RadiositySimulation.h"

#include "radiometry/scene/InputError.h"
#include "tests/core/TestScenes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>

using namespace radiometry;

namespace
{

const double Pi = std::acos(-1.0);

Light PointLight(const Scene& scene, const Vec3& at, double intensity)
{
  Light light;
  light.Position = at - scene.Origin;
  light.Intensity.assign(static_cast<std::size_t>(scene.Optics.Bands), intensity);
  return light;
}

Scene WithEmission(const test::Mesh& mesh, double rho, std::size_t from, std::size_t to, double m)
{
  Scene scene = mesh.ToScene(rho);
  scene.Optics.EmittedExitance[0].assign(scene.Cells, 0.0);
  for (std::size_t c = from; c < to; ++c)
  {
    scene.Optics.EmittedExitance[0][c] = m;
  }
  return scene;
}

RadiosityResult Simulate(const Scene& scene, const RadiosityOptions& options = {})
{
  const OcclusionScene occluders(scene);
  RadiositySimulation simulation(scene, occluders, options);
  return simulation.Run();
}

double CellArea(const Scene& scene, std::size_t cell)
{
  double area = 0.0;
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    area +=
      static_cast<std::size_t>(scene.TriangleCell[t]) == cell ? Area(scene.TriangleAt(t)) : 0.0;
  }
  return area;
}

double MeanIrradiance(
  const Scene& scene, const RadiosityResult& r, std::size_t from, std::size_t to)
{
  double area = 0.0, flux = 0.0;
  for (std::size_t c = from; c < to; ++c)
  {
    area += CellArea(scene, c);
    flux += CellArea(scene, c) * r.Irradiance[0].Values[c];
  }
  return flux / area;
}

/// Share of values whose error covers the difference from a reference, and the median of
/// error/difference.
void Honesty(
  const RadiosityResult& tested, const RadiosityResult& reference, double& covered, double& median)
{
  std::size_t inside = 0, all = 0;
  std::vector<double> ratio;
  for (std::size_t side = 0; side < 2; ++side)
  {
    const FieldValues& t = tested.Irradiance[side];
    const FieldValues& r = reference.Irradiance[side];
    for (std::size_t k = 0; k < t.Values.size(); ++k)
    {
      const double off = std::abs(t.Values[k] - r.Values[k]);
      if (t.Values[k] == 0.0 && r.Values[k] == 0.0)
      {
        continue;
      }
      ++all;
      inside += off <= std::hypot(t.Errors[k], r.Errors[k]); // the reference has its own
      ratio.push_back(t.Errors[k] / std::max(off, 1e-300));
    }
  }
  std::sort(ratio.begin(), ratio.end());
  covered = static_cast<double>(inside) / static_cast<double>(all);
  median = ratio[ratio.size() / 2];
}

} // namespace

TEST(RadiositySimulation, CubeOfReferences)
{
  // 4 m cube, 10 000 lm in its middle: the area mean is flux/(S (1 - rho)), whatever the mesh.
  for (double rho : { 0.0, 0.2, 0.5, 0.8, 0.9, 0.95, 0.99, 0.9999, 0.999999 })
  {
    for (int n : { 1, 3 })
    {
      test::Mesh mesh;
      mesh.AddBox({ 10, 20, 30 }, { 14, 24, 34 }, n, true);
      Scene scene = mesh.ToScene(rho);
      scene.Lights.push_back(PointLight(scene, { 12, 22, 32 }, 10000.0 / (4.0 * Pi)));
      RadiosityOptions options;
      options.RelativeTolerance = 0.05;
      const RadiosityResult r = Simulate(scene, options);
      const double exact = 10000.0 / (96.0 * (1.0 - rho));
      EXPECT_NEAR(MeanIrradiance(scene, r, 0, scene.Cells) / exact, 1.0, 1e-6) << rho << " " << n;
    }
  }
}

TEST(RadiositySimulation, CubeByMonteCarloConservesEnergy)
{
  for (double rho : { 0.5, 0.95, 0.999999 })
  {
    test::Mesh mesh;
    mesh.AddBox({ 0, 0, 0 }, { 4, 4, 4 }, 2, true);
    Scene scene = mesh.ToScene(rho);
    scene.Lights.push_back(PointLight(scene, { 1, 2, 3 }, 10000.0 / (4.0 * Pi)));
    RadiosityOptions options;
    options.RelativeTolerance = 0.1;
    options.Method = RadiosityMethod::MonteCarlo;
    const RadiosityResult r = Simulate(scene, options);
    EXPECT_EQ(r.Method, RadiosityMethod::MonteCarlo);
    EXPECT_NEAR(MeanIrradiance(scene, r, 0, scene.Cells) * 96.0 * (1.0 - rho) / 10000.0, 1.0, 1e-6)
      << rho;
  }
}

TEST(RadiositySimulation, InsideOfASphere)
{
  test::Mesh mesh;
  mesh.AddSphere({ 0, 0, 0 }, 2.0, 6, true);
  for (double rho : { 0.0, 0.5, 0.9, 0.999999 })
  {
    const Scene scene = WithEmission(mesh, rho, 0, mesh.Triangles.size(), 3.0);
    for (const auto method :
      { RadiosityMethod::Dense, RadiosityMethod::Hierarchical, RadiosityMethod::MonteCarlo })
    {
      RadiosityOptions options;
      options.Method = method;
      options.RelativeTolerance = 0.05;
      const RadiosityResult r = Simulate(scene, options);
      for (std::size_t c = 0; c < scene.Cells; ++c)
      {
        EXPECT_NEAR(r.Radiosity[0].Values[c] * (1.0 - rho) / 3.0, 1.0, 1e-6) << rho;
        EXPECT_NEAR(r.Irradiance[0].Values[c] * (1.0 - rho) / 3.0, 1.0, 1e-6) << rho;
      }
    }
  }
}

TEST(RadiositySimulation, PerpendicularSquares)
{
  // A floor of 0.3 under 1000 W/m^2 and a black wall: 700 absorbed, 60.013 received. The sheet
  // is lit from above: the wall gets nothing directly.
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  mesh.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 1, 1);
  Scene scene = mesh.ToScene(0.3);
  scene.Optics.DiffuseReflectance[0][2] = scene.Optics.DiffuseReflectance[0][3] = 0.0;
  Light sun;
  sun.Type = LightType::Directional;
  sun.Direction = { 0, 0, -1 };
  sun.Intensity = { 1000.0 };
  scene.Lights.push_back(sun);
  for (const auto refinement : { RefinementMode::Off, RefinementMode::Auto })
  {
    RadiosityOptions options;
    options.Refinement = refinement;
    const RadiosityResult r = Simulate(scene, options);
    EXPECT_NEAR(MeanIrradiance(scene, r, 0, 2), 1000.0, 1e-6);
    EXPECT_NEAR(MeanIrradiance(scene, r, 0, 2) * 0.7, 700.0, 1e-6);
    EXPECT_NEAR(MeanIrradiance(scene, r, 2, 4), 300.0 * 0.200043776075403, 0.001);
  }
}

TEST(RadiositySimulation, ErrorsCoverAndAreNotTimid)
{
  struct Case
  {
    const char* Name;
    Scene World;
  };
  std::vector<Case> cases;
  {
    test::Mesh mesh;
    mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 3, true);
    cases.push_back({ "cube with a bright wall", WithEmission(mesh, 0.5, 0, 18, 100.0) });
  }
  {
    test::Mesh mesh;
    mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 4, 4);
    mesh.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 4, 4);
    Scene scene = mesh.ToScene(0.3);
    scene.Lights.push_back(PointLight(scene, { 0.5, 0.5, 1.0 }, 10.0));
    cases.push_back({ "plates that share an edge", scene });
  }
  {
    // A screen that stands on the floor between a lit half and a dark one.
    test::Mesh mesh;
    mesh.AddGrid({ 0, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, 4, 2);
    mesh.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 2, 0, 0 }, 2, 4);
    mesh.AddGrid({ 1, 0, 0 }, { 0, 0.7, 0 }, { 0, 0, 0.6 }, 2, 2);
    Scene scene = mesh.ToScene(0.7);
    for (std::size_t c = 32; c < scene.Cells; ++c)
    {
      scene.Optics.TwoSided[c] = 1;
    }
    scene.Lights.push_back(PointLight(scene, { 0.4, 0.5, 0.8 }, 10.0));
    cases.push_back({ "screen on a floor", scene });
  }
  for (const Case& c : cases)
  {
    RadiosityOptions options;
    options.Method = RadiosityMethod::Dense;
    options.RelativeTolerance = 0.005;
    options.Seed = 77;
    const RadiosityResult reference = Simulate(c.World, options);
    for (const auto method : { RadiosityMethod::Auto, RadiosityMethod::MonteCarlo })
    {
      RadiosityOptions coarse;
      coarse.Method = method;
      coarse.RelativeTolerance = 0.05;
      const RadiosityResult r = Simulate(c.World, coarse);
      double covered = 0.0, median = 0.0;
      Honesty(r, reference, covered, median);
      EXPECT_GE(covered, 0.95) << c.Name << " method " << static_cast<int>(method);
      if (r.Elements < reference.Elements || r.Method == RadiosityMethod::MonteCarlo)
      {
        EXPECT_LT(median, 10.0) << c.Name << " method " << static_cast<int>(method);
      }
    }
  }
}

TEST(RadiositySimulation, SmallThingsOnALargeTable)
{
  // A bowl of 2 cm triangles on a sheet of two: the sheet is dark beneath and bright beside, and
  // one radiosity on it would light the bowl's underside.
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 4, 4, 3 }, 1, true);
  const std::size_t bowl = mesh.Triangles.size();
  mesh.AddBox({ 1.9, 1.9, 0.01 }, { 2.1, 2.1, 0.1 }, 4, false);
  Scene scene = mesh.ToScene(0.6);
  scene.Lights.push_back(PointLight(scene, { 2.3, 2.2, 2.5 }, 10.0));
  RadiosityOptions options;
  options.RelativeTolerance = 0.025;
  options.Seed = 5;
  const RadiosityResult reference = Simulate(scene, options);
  options.RelativeTolerance = 0.1;
  options.Seed = 0;
  const RadiosityResult r = Simulate(scene, options);
  double covered = 0.0, median = 0.0;
  Honesty(r, reference, covered, median);
  EXPECT_GE(covered, 0.95);
  EXPECT_LT(median, 10.0);
  // The underside, 1 cm over the sheet, sees little but the dark beneath it.
  double underside = 0.0, sides = 0.0;
  for (std::size_t c = bowl; c < bowl + 32; ++c)
  {
    underside += r.Irradiance[0].Values[c] / 32.0;
    sides += r.Irradiance[0].Values[c + 64] / 32.0;
  }
  EXPECT_LT(underside, 0.3 * sides);
}

TEST(RadiositySimulation, SameBytesForAnyNumberOfThreads)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 2, 2, 2 }, 2, true);
  mesh.AddBox({ 0.4, 0.5, 0.1 }, { 1.1, 1.2, 0.9 }, 1, false);
  const std::size_t lamp = mesh.Triangles.size();
  mesh.AddGrid({ 0.9, 0.9, 1.9 }, { 0, 0.2, 0 }, { 0.2, 0, 0 }, 1, 1);
  Scene scene = WithEmission(mesh, 0.6, lamp, lamp + 2, 1000.0);
  scene.Lights.push_back(PointLight(scene, { 1.5, 1.5, 1.5 }, 5.0));
  for (const auto method :
      { RadiosityMethod::Dense, RadiosityMethod::Hierarchical, RadiosityMethod::MonteCarlo })
  {
    std::vector<double> first;
    for (int threads : { 1, 2, 7 })
    {
      RadiosityOptions options;
      options.Method = method;
      options.RelativeTolerance = 0.2;
      options.Threads = threads;
      const RadiosityResult r = Simulate(scene, options);
      std::vector<double> values = r.Irradiance[0].Values;
      for (const auto* more :
        { &r.Irradiance[0].Errors, &r.Radiosity[0].Values, &r.Radiosity[0].Errors })
      {
        values.insert(values.end(), more->begin(), more->end());
      }
      if (first.empty())
      {
        first = values;
      }
      EXPECT_EQ(std::memcmp(first.data(), values.data(), values.size() * sizeof(double)), 0)
        << threads;
    }
  }
}

TEST(RadiositySimulation, EnergyOfAFurnishedRoom)
{
  // Everything closed: what lamp and light give is absorbed, by either operator.
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 2, 2, 2 }, 3, true);
  mesh.AddBox({ 0.4, 0.5, 0.3 }, { 1.1, 1.2, 0.9 }, 2, false);
  const std::size_t lamp = mesh.Triangles.size();
  mesh.AddGrid({ 0.9, 0.9, 1.9 }, { 0, 0.2, 0 }, { 0.2, 0, 0 }, 1, 1);
  mesh.AddGrid({ 0.9, 0.9, 1.9 }, { 0.2, 0, 0 }, { 0, 0.2, 0 }, 1, 1); // its back
  Scene scene = WithEmission(mesh, 0.6, lamp, lamp + 2, 1000.0);
  const double power = 1000.0 * 0.04;
  for (const auto method :
      { RadiosityMethod::Dense, RadiosityMethod::Hierarchical, RadiosityMethod::MonteCarlo })
  {
    RadiosityOptions options;
    options.Method = method;
    options.RelativeTolerance = 0.03;
    const RadiosityResult r = Simulate(scene, options);
    double absorbed = 0.0;
    for (std::size_t c = 0; c < scene.Cells; ++c)
    {
      absorbed += CellArea(scene, c) * 0.4 * r.Irradiance[0].Values[c];
    }
    // Visibility of the lamp is sampled: that part is as good as its error.
    EXPECT_NEAR(absorbed / power, 1.0, 0.01) << static_cast<int>(method);
  }
}

TEST(RadiositySimulation, PointsByFinalGather)
{
  test::Mesh mesh;
  mesh.AddSphere({ 0, 0, 0 }, 1.0, 8, true);
  const Scene sphere = WithEmission(mesh, 0.5, 0, mesh.Triangles.size(), 2.0);
  std::vector<SurfacePoint> points;
  for (std::size_t t = 0; t < sphere.ReceiverTriangles; t += 9)
  {
    const Triangle3 corners = sphere.TriangleAt(t);
    points.push_back(
      { Centroid(corners), Normalized(AreaNormal2(corners)), static_cast<std::int32_t>(t), {} });
  }
  points.push_back({ Vec3{ 0.1, 0.2, 0.3 } - sphere.Origin, { 0, 0, 1 }, -1, {} }); // a sensor
  {
    const OcclusionScene occluders(sphere);
    RadiositySimulation simulation(sphere, occluders, {});
    simulation.Run();
    const FieldValues at = simulation.IrradianceAt(points);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      EXPECT_NEAR(at.Values[k], 4.0, 1e-6);
      EXPECT_LT(at.Errors[k], 0.05);
    }
  }
  // Above the middle of a lit floor of 0.3: 300 F from the floor to a sensor that looks down.
  test::Mesh floor;
  floor.AddGrid({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 4, 4);
  Scene scene = floor.ToScene(0.3);
  Light sun;
  sun.Type = LightType::Directional;
  sun.Direction = { 0, 0, -1 };
  sun.Intensity = { 1000.0 };
  scene.Lights.push_back(sun);
  const OcclusionScene occluders(scene);
  RadiositySimulation simulation(scene, occluders, {});
  simulation.Run();
  const FieldValues at =
    simulation.IrradianceAt({ { Vec3{ 0, 0, 1 } - scene.Origin, { 0, 0, -1 }, -1, {} },
      { Vec3{ 0, 0, 1 } - scene.Origin, { 0, 0, 1 }, -1, {} } });
  const double x = 1.0, r = std::sqrt(1.0 + x * x);
  const double f = 4.0 * (2.0 * x / r * std::atan(x / r)) / (2.0 * Pi);
  EXPECT_NEAR(at.Values[0], 300.0 * f, 0.01 * 300.0 * f);
  EXPECT_LE(std::abs(at.Values[0] - 300.0 * f), at.Errors[0]);
  EXPECT_NEAR(at.Values[1], 1000.0, 1e-9);
}

TEST(RadiositySimulation, SwitchesAndMethods)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 1, true);
  Scene scene = WithEmission(mesh, 0.5, 0, 2, 10.0);
  scene.Lights.push_back(PointLight(scene, { 0.5, 0.5, 0.5 }, 1.0));
  RadiosityOptions options;
  options.Interreflection = false;
  const RadiosityResult single = Simulate(scene, options);
  // The light's flux of 4 pi over 6 walls, and a fifth of the floor's emission on the ceiling.
  EXPECT_NEAR(MeanIrradiance(scene, single, 0, 2), 4.0 * Pi / 6.0, 1e-9);
  EXPECT_NEAR(MeanIrradiance(scene, single, 2, 4), 4.0 * Pi / 6.0 + 1.99824895698387, 1e-4);
  EXPECT_NEAR(single.Radiosity[0].Values[0], 10.0 + 0.5 * single.Irradiance[0].Values[0], 1e-9);
  options.Emission = false;
  const RadiosityResult direct = Simulate(scene, options);
  EXPECT_NEAR(MeanIrradiance(scene, direct, 2, 4), 4.0 * Pi / 6.0, 1e-9);

  options = {};
  options.Method = RadiosityMethod::MonteCarlo;
  options.Occlusion = false;
  EXPECT_THROW(Simulate(scene, options), InputError);
  options = {};
  options.MemoryLimit = 1000;
  EXPECT_THROW(Simulate(scene, options), InputError);
}

TEST(RadiositySimulation, BadOpticsAreNamed)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 1, true);
  const auto fails = [&](double rho, double m, const char* array) {
    Scene scene = WithEmission(mesh, 0.5, 0, 2, 10.0);
    scene.Optics.DiffuseReflectance[0][7] = rho;
    scene.Optics.EmittedExitance[0][7] = m;
    try
    {
      Simulate(scene);
      ADD_FAILURE() << "no error for " << rho << " " << m;
    }
    catch (const InputError& error)
    {
      EXPECT_EQ(error.Array, array);
      EXPECT_EQ(error.Index, 7);
    }
  };
  fails(-0.1, 0.0, "DiffuseReflectance");
  fails(1.1, 0.0, "DiffuseReflectance");
  fails(std::numeric_limits<double>::quiet_NaN(), 0.0, "DiffuseReflectance");
  fails(0.5, -1.0, "EmittedExitance");
  fails(0.5, std::numeric_limits<double>::infinity(), "EmittedExitance");
}

TEST(RadiositySimulation, WhiteCavities)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 2, true);
  Scene closed = mesh.ToScene(1.0);
  closed.Lights.push_back(PointLight(closed, { 0.5, 0.5, 0.5 }, 1.0));
  for (const auto method :
      { RadiosityMethod::Dense, RadiosityMethod::Hierarchical, RadiosityMethod::MonteCarlo })
  {
    RadiosityOptions options;
    options.Method = method;
    options.RelativeTolerance = 0.2;
    EXPECT_THROW(Simulate(closed, options), InputError);
    // Without its ceiling there is an answer: all that does not leave directly leaves in the end.
    Scene open = closed;
    open.ReceiverTriangles -= 8;
    open.Triangles.resize(open.ReceiverTriangles);
    open.TriangleCell.resize(open.ReceiverTriangles);
    const RadiosityResult r = Simulate(open, options);
    for (std::size_t c = 0; c < 40; ++c)
    {
      EXPECT_TRUE(std::isfinite(r.Irradiance[0].Values[c]));
      EXPECT_GT(r.Irradiance[0].Values[c], 4.0 * Pi / 6.0 / 4.0);
      EXPECT_LT(r.Irradiance[0].Values[c], 40.0);
    }
  }
}

TEST(RadiositySimulation, EmptyDarkAndBlack)
{
  EXPECT_TRUE(Simulate(Scene{}).Irradiance[0].Values.empty());
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 1, true);
  const RadiosityResult dark = Simulate(mesh.ToScene(0.5));
  EXPECT_EQ(dark.Irradiance[0].Values, std::vector<double>(12, 0.0));
  EXPECT_EQ(dark.Irradiance[0].Errors, std::vector<double>(12, 0.0));
  Scene black = mesh.ToScene(0.0);
  black.Lights.push_back(PointLight(black, { 0.5, 0.5, 0.5 }, 1.0));
  const RadiosityResult r = Simulate(black);
  EXPECT_NEAR(MeanIrradiance(black, r, 0, 12), 4.0 * Pi / 6.0, 1e-9);
  EXPECT_EQ(r.Radiosity[0].Values, std::vector<double>(12, 0.0));
  // One triangle and a light: nothing to exchange with.
  test::Mesh one;
  one.Points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  one.Triangles = { { 0, 1, 2 } };
  Scene alone = one.ToScene(0.5);
  alone.Lights.push_back(PointLight(alone, { 0, 0, 1 }, 1.0));
  for (const auto method :
      { RadiosityMethod::Dense, RadiosityMethod::Hierarchical, RadiosityMethod::MonteCarlo })
  {
    RadiosityOptions options;
    options.Method = method;
    const RadiosityResult a = Simulate(alone, options);
    EXPECT_NEAR(a.Irradiance[0].Values[0], (Pi / 2.0 - 4.0 * std::atan(0.5)) * -2.0, 1.5);
    EXPECT_GT(a.Irradiance[0].Values[0], 0.3);
    EXPECT_NEAR(a.Radiosity[0].Values[0], 0.5 * a.Irradiance[0].Values[0], 1e-12);
  }
}

TEST(RadiositySimulation, FacesInOneAnotherMakeNoLight)
{
  // Every face of a closed box three times over, nearly white: what is seen is counted thrice, and
  // the exchange must be held to what a hemisphere can hold.
  test::Mesh mesh;
  for (int copy = 0; copy < 3; ++copy)
  {
    mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 2, true);
  }
  Scene scene = mesh.ToScene(0.99);
  scene.Lights.push_back(PointLight(scene, { 0.4, 0.5, 0.6 }, 1.0));
  for (const RadiosityMethod method :
         { RadiosityMethod::Dense, RadiosityMethod::Hierarchical, RadiosityMethod::MonteCarlo })
  {
    RadiosityOptions options;
    options.RelativeTolerance = 0.05;
    options.TimeBudget = 2.0;
    options.Method = method;
    const RadiosityResult r = Simulate(scene, options);
    for (std::size_t k = 0; k < r.Irradiance[0].Values.size(); ++k)
    {
      EXPECT_TRUE(std::isfinite(r.Irradiance[0].Values[k]));
      EXPECT_TRUE(std::isfinite(r.Irradiance[0].Errors[k]));
      EXPECT_GE(r.Irradiance[0].Values[k], 0.0);
    }
  }
}

TEST(RadiositySimulation, BudgetAndAbort)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 2, 2, 2 }, 6, true);
  mesh.AddBox({ 0.4, 0.5, 0.1 }, { 1.1, 1.2, 0.9 }, 4, false);
  Scene scene = mesh.ToScene(0.7);
  scene.Lights.push_back(PointLight(scene, { 1.5, 1.5, 1.5 }, 5.0));
  RadiosityOptions options;
  options.RelativeTolerance = 1e-4;
  options.TimeBudget = 1.0;
  const RadiosityResult r = Simulate(scene, options);
  EXPECT_NE(r.Outcome.find("time budget"), std::string::npos) << r.Outcome;
  EXPECT_GT(r.Convergence.Rows.size(), 0u);

  class Stop : public Monitor
  {
  public:
    bool Progress(double fraction, const char*) override
    {
      EXPECT_GE(fraction, this->Last - 1e-9);
      EXPECT_LE(fraction, 1.0 + 1e-9);
      this->Last = fraction;
      return ++this->Calls < 20;
    }
    int Calls = 0;
    double Last = 0.0;
  } stop;
  const OcclusionScene occluders(scene);
  RadiositySimulation simulation(scene, occluders, {});
  StageProgress stage;
  stage.Listener = &stop;
  EXPECT_THROW(simulation.Run(stage), Aborted);
}

TEST(RadiositySimulation, TwoSidedScreen)
{
  // A sheet across a cube, lit on one side: its back gets nothing, and is reported.
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 2, 1, 1 }, 1, true);
  mesh.AddGrid({ 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 1, 1); // front towards +x
  Scene scene = mesh.ToScene(0.5);
  scene.Optics.TwoSided[12] = scene.Optics.TwoSided[13] = 1;
  scene.Lights.push_back(PointLight(scene, { 1.5, 0.5, 0.5 }, 1.0));
  RadiosityOptions options;
  options.RelativeTolerance = 0.05;
  const RadiosityResult r = Simulate(scene, options);
  ASSERT_EQ(r.Irradiance[1].Values.size(), 14u);
  EXPECT_GT(r.Irradiance[0].Values[12], 1.0);
  EXPECT_LT(r.Irradiance[1].Values[12], 1e-9);
  EXPECT_EQ(r.Irradiance[1].Values[0], 0.0);
  // The lit half is a closed cube of 6 m^2.
  double absorbed = 0.0;
  for (std::size_t c = 0; c < 14; ++c)
  {
    absorbed += CellArea(scene, c) * 0.5 * r.Irradiance[0].Values[c];
  }
  EXPECT_NEAR(absorbed, 4.0 * Pi, 0.01 * 4.0 * Pi);
}
