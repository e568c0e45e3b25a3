// SPDX-License-Identifier: BSD-3-Clause
// What a run costs and says of that before, where it goes on, and how often light is reflected.
#include "radiometry/solver/PlannedRadiosity.h"
#include "radiometry/solver/RadiosityCache.h"
#include "radiometry/solver/RadiositySimulation.h"
#include "tests/core/TestScenes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <string>
#include <vector>

using namespace radiometry;

namespace
{

/// A room, perhaps with a block in it, lit by a point.
Scene Room(double rho, bool block = true, int n = 2)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 3, 3, 2 }, n, true);
  if (block)
  {
    mesh.AddBox({ 1.0, 1.2, 0.1 }, { 1.7, 1.9, 0.9 }, 1, false);
  }
  Scene scene = mesh.ToScene(rho);
  Light light;
  light.Position = Vec3{ 0.6, 0.7, 1.6 } - scene.Origin;
  light.Intensity = { 20.0 };
  scene.Lights.push_back(light);
  return scene;
}

RadiosityOptions Options(RadiosityMethod method, double tolerance)
{
  RadiosityOptions options;
  options.Method = method;
  options.RelativeTolerance = tolerance;
  return options;
}

double Spent(const RadiosityResult& r, const char* stage)
{
  for (const auto& [name, seconds] : r.Seconds)
  {
    if (name == stage)
    {
      return seconds;
    }
  }
  return 0.0;
}

double MeanIrradiance(const Scene& scene, const RadiosityResult& r)
{
  double flux = 0.0, area = 0.0;
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    const double a = Area(scene.TriangleAt(t));
    flux += a * r.Irradiance[0].Values[static_cast<std::size_t>(scene.TriangleCell[t])];
    area += a;
  }
  return flux / area;
}

class Listener : public Monitor
{
public:
  bool Progress(double, const char*) override { return true; }
  void Predicted(double seconds) override { this->Said.push_back(seconds); }
  std::vector<double> Said;
};

} // namespace

TEST(RadiosityBounces, AreThoseOfTheSeries)
{
  // In a closed room of one reflectance each bounce leaves the share rho of the one before: the mean
  // irradiance after n of them is that of direct light times 1 + rho + ... + rho^n.
  constexpr double rho = 0.6;
  const Scene scene = Room(rho, false);
  const double direct = 4.0 * std::acos(-1.0) * 20.0 / 42.0;
  for (const auto method :
    { RadiosityMethod::Dense, RadiosityMethod::Hierarchical, RadiosityMethod::MonteCarlo })
  {
    for (const auto refinement : { RefinementMode::Auto, RefinementMode::Off })
    {
      RadiosityCache cache;
      for (const int bounces : { 1, 2, 5 })
      {
        RadiosityOptions options = Options(method, 0.05);
        options.Refinement = refinement;
        options.MaximumBounces = bounces;
        RadiositySimulation simulation(scene, options, cache);
        const RadiosityResult r = simulation.Run();
        const double share = (1.0 - std::pow(rho, bounces + 1)) / (1.0 - rho);
        const double tolerance = method == RadiosityMethod::Hierarchical ? 1e-3 : 1e-6;
        EXPECT_NEAR(MeanIrradiance(scene, r) / (share * direct), 1.0, tolerance)
          << MethodName(method) << bounces;
        EXPECT_GE(r.BouncesLeftOut, direct * (1.0 / (1.0 - rho) - share)) << bounces;
      }
    }
  }
}

TEST(RadiosityBounces, RestIsBoundedForEveryCell)
{
  const Scene scene = Room(0.7);
  RadiosityOptions options = Options(RadiosityMethod::Dense, 0.1);
  options.Refinement = RefinementMode::Off;
  RadiosityCache cache;
  RadiosityResult all;
  {
    RadiositySimulation simulation(scene, options, cache);
    all = simulation.Run();
  }
  EXPECT_EQ(all.BouncesLeftOut, 0.0);
  EXPECT_GT(all.BouncesThatMatter, 1.0);
  double last = std::numeric_limits<double>::infinity();
  for (const int bounces : { 1, 3, 9, 30 })
  {
    options.MaximumBounces = bounces;
    RadiositySimulation simulation(scene, options, cache);
    const RadiosityResult r = simulation.Run();
    double greatest = 0.0;
    for (std::size_t k = 0; k < r.Irradiance[0].Values.size(); ++k)
    {
      const double missing = all.Irradiance[0].Values[k] - r.Irradiance[0].Values[k];
      EXPECT_GE(missing, -1e-3 * all.Irradiance[0].Values[k]);
      greatest = std::max(greatest, missing);
    }
    EXPECT_LE(greatest, r.BouncesLeftOut * (1.0 + 1e-6) + 1e-4) << bounces;
    EXPECT_LT(r.BouncesLeftOut, last);
    last = r.BouncesLeftOut;
  }
}

TEST(RadiosityBounces, ThePlanTellsWhatFurtherOnesWouldAdd)
{
  const Scene scene = Room(0.5);
  RadiosityOptions options = Options(RadiosityMethod::Dense, 0.1);
  const std::vector<EffectSwitch> all(EffectCount);
  const PlannedRadiosity whole = SimulatePlannedRadiosity(scene, {}, true, all, options);
  const auto& row = whole.Effects[static_cast<std::size_t>(Effect::Interreflection)];
  EXPECT_NE(row.Why.find("at the tolerance"), std::string::npos) << row.Why;
  options.MaximumBounces = 2;
  const PlannedRadiosity two = SimulatePlannedRadiosity(scene, {}, true, all, options);
  const auto& cut = two.Effects[static_cast<std::size_t>(Effect::Interreflection)];
  EXPECT_NE(cut.Why.find("2 bounces as asked"), std::string::npos) << cut.Why;
  EXPECT_GT(cut.Bound, 0.0);
  EXPECT_TRUE(std::isfinite(cut.Bound));
}

TEST(RadiosityCourse, SaysOnceWhatItTakes)
{
  for (const auto method :
    { RadiosityMethod::Dense, RadiosityMethod::Hierarchical, RadiosityMethod::MonteCarlo })
  {
    Listener listener;
    const PlannedRadiosity r = SimulatePlannedRadiosity(Room(0.5), {}, true,
      std::vector<EffectSwitch>(EffectCount), Options(method, 0.05), &listener);
    ASSERT_EQ(listener.Said.size(), 1u) << MethodName(method);
    EXPECT_EQ(listener.Said[0], r.Cost.PredictedSeconds);
    EXPECT_GE(r.Cost.PredictedSeconds, r.Cost.PredictedAt);
    EXPECT_GT(r.Cost.PredictedAt, 0.0);
    EXPECT_LE(r.Cost.PredictedAt, r.Cost.Seconds);
  }
}

TEST(RadiosityCourse, PilotIsAPartOfTheRun)
{
  const Scene scene = Room(0.5, true, 8);
  RadiosityOptions options = Options(RadiosityMethod::MonteCarlo, 0.03);
  RadiosityCache cache;
  options.PilotOnly = true;
  RadiosityResult pilot;
  {
    RadiositySimulation simulation(scene, options, cache);
    pilot = simulation.Run();
  }
  EXPECT_GE(pilot.Cost.PredictedSeconds, 0.0);
  EXPECT_LT(pilot.MetShare, 0.95);
  options.PilotOnly = false;
  RadiositySimulation simulation(scene, options, cache);
  const RadiosityResult whole = simulation.Run();
  EXPECT_GE(whole.MetShare, 0.95);
  EXPECT_EQ(Spent(whole, "exchange"), 0.0); // its rays were kept
  EXPECT_GT(whole.Samples, pilot.Samples);
}

TEST(RadiosityCourse, TighterGoesOnAndLooserReturnsAtOnce)
{
  for (const auto method :
    { RadiosityMethod::Dense, RadiosityMethod::Hierarchical, RadiosityMethod::MonteCarlo })
  {
    const Scene scene = Room(0.5);
    RadiosityCache cache;
    const auto run = [&](double tolerance) {
      RadiositySimulation simulation(scene, Options(method, tolerance), cache);
      return simulation.Run();
    };
    const RadiosityResult coarse = run(0.2);
    const RadiosityResult fine = run(0.05);
    EXPECT_NE(fine.MethodWhy.find("goes on from there"), std::string::npos) << fine.MethodWhy;
    EXPECT_GE(fine.MetShare, 0.95) << MethodName(method);
    EXPECT_GE(fine.Elements, coarse.Elements);
    const RadiosityResult again = run(0.2);
    EXPECT_EQ(Spent(again, "exchange") + Spent(again, "rays") + Spent(again, "solve"), 0.0);
    EXPECT_EQ(again.Elements, fine.Elements);
    ASSERT_EQ(again.Irradiance[0].Values.size(), fine.Irradiance[0].Values.size());
    EXPECT_EQ(std::memcmp(again.Irradiance[0].Values.data(), fine.Irradiance[0].Values.data(),
                8 * fine.Irradiance[0].Values.size()),
      0);
    EXPECT_GE(again.MetShare, 0.95);
  }
}

TEST(RadiosityCourse, WhatChangesTheLightIsSolvedAgain)
{
  Scene scene = Room(0.5);
  RadiosityCache cache;
  const RadiosityOptions options = Options(RadiosityMethod::Dense, 0.1);
  const auto run = [&] {
    RadiositySimulation simulation(scene, options, cache);
    return simulation.Run();
  };
  run();
  EXPECT_EQ(Spent(run(), "solve"), 0.0);
  scene.Lights[0].Intensity = { 21.0 };
  EXPECT_GT(Spent(run(), "solve"), 0.0);
  EXPECT_EQ(Spent(run(), "solve"), 0.0);
  scene.Optics.DiffuseReflectance[0][3] = 0.51;
  EXPECT_GT(Spent(run(), "solve"), 0.0);
  scene.GlobalAmbient = { 1.0 };
  EXPECT_GT(Spent(run(), "solve"), 0.0);
  scene.Lights[0].Position.x += 1e-9;
  EXPECT_GT(Spent(run(), "solve"), 0.0);
}

TEST(RadiosityCourse, NothingIsBuiltWhereNoSurfaceFacesAnother)
{
  // A floor under a body that only blocks light: what is reflected meets nothing that receives.
  test::Mesh mesh;
  mesh.AddGrid({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 6, 6);
  Scene scene = mesh.ToScene(0.8);
  Light light;
  light.Position = Vec3{ 0.3, 0.2, 2.0 } - scene.Origin;
  light.Intensity = { 20.0 };
  scene.Lights.push_back(light);
  const auto first = static_cast<std::int32_t>(scene.Points.size());
  for (const Vec3& p : { Vec3{ -0.5, -0.5, 1.0 }, Vec3{ 0.5, -0.5, 1.0 }, Vec3{ 0.0, 0.5, 1.2 } })
  {
    scene.Points.push_back(p - scene.Origin);
  }
  scene.Triangles.push_back({ first, first + 2, first + 1 });
  scene.TriangleCell.push_back(-1);
  for (const auto method :
    { RadiosityMethod::Dense, RadiosityMethod::Hierarchical, RadiosityMethod::MonteCarlo })
  {
    const OcclusionScene occluders(scene);
    RadiosityOptions options = Options(method, 0.02);
    options.SurfaceOnly = true;
    RadiositySimulation simulation(scene, occluders, options);
    const RadiosityResult r = simulation.Run();
    EXPECT_EQ(r.Samples, 0);
    EXPECT_EQ(r.OperatorBytes, 0u);
    EXPECT_NE(r.MethodWhy.find("faces another"), std::string::npos) << r.MethodWhy;
    EXPECT_GT(MeanIrradiance(scene, r), 0.0);
  }
}

TEST(RadiosityCourse, WhatNoRayMetHasABound)
{
  // A small lit plate far above the end of a long black floor: few rays from the floor meet it.
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 40, 0, 0 }, { 0, 2, 0 }, 20, 1);
  mesh.AddGrid({ 0, 1, 2.0 }, { 0, 0.2, 0 }, { 0.2, 0, 0 }, 1, 1);
  Scene scene = mesh.ToScene(0.5);
  Light light;
  light.Position = Vec3{ 0.1, 1.1, 1.5 } - scene.Origin;
  light.Intensity = { 5.0 };
  scene.Lights.push_back(light);
  const OcclusionScene occluders(scene);
  RadiosityOptions options = Options(RadiosityMethod::MonteCarlo, 0.5);
  options.Refinement = RefinementMode::Off;
  RadiositySimulation sampled(scene, occluders, options);
  const RadiosityResult rays = sampled.Run();
  RadiosityOptions sure = Options(RadiosityMethod::Dense, 0.01);
  RadiositySimulation exact(scene, occluders, sure);
  const RadiosityResult pairs = exact.Run();
  std::size_t held = 0;
  for (std::size_t k = 0; k < pairs.Irradiance[0].Values.size(); ++k)
  {
    EXPECT_GT(rays.Irradiance[0].Errors[k], 0.0) << k;
    held += std::abs(rays.Irradiance[0].Values[k] - pairs.Irradiance[0].Values[k]) <=
      rays.Irradiance[0].Errors[k] + pairs.Irradiance[0].Errors[k];
  }
  EXPECT_GE(static_cast<double>(held), 0.95 * static_cast<double>(pairs.Irradiance[0].Values.size()));
}
