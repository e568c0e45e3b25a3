// SPDX-License-Identifier: BSD-3-Clause
// Direct light that goes on from what an earlier run left, that says what it will take, that costs
// nothing where nothing arrives, and that ends in time.
#include "radiometry/irradiance/IrradianceCache.h"
#include "radiometry/irradiance/IrradianceSimulation.h"
#include "radiometry/scene/SkyRadiance.h"
#include "tests/core/TestScenes.h"
#include "tests/core/ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace radiometry;

namespace
{

Light PointLight(const Scene& scene, const Vec3& at, double intensity)
{
  Light light;
  light.Position = at - scene.Origin;
  light.Intensity = { intensity };
  return light;
}

Light Panel(const Scene& scene, double exitance)
{
  Light light;
  light.Type = LightType::Area;
  light.Polygon = { Vec3{ -0.5, -0.4, 2.5 }, Vec3{ -0.5, 0.4, 2.5 }, Vec3{ 0.5, 0.4, 2.5 },
    Vec3{ 0.5, -0.4, 2.5 } };
  for (Vec3& p : light.Polygon)
  {
    p = p - scene.Origin;
  }
  light.Intensity = { exitance };
  return light;
}

/// A floor of 2 n^2 triangles, and on it a box where wanted.
Scene Floor(int n, bool box)
{
  test::Mesh mesh;
  mesh.AddGrid({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, n, n);
  if (box)
  {
    mesh.AddBox({ -0.4, -0.3, 0.0 }, { 0.5, 0.4, 1.1 }, 1, false);
  }
  return mesh.ToScene();
}

/// All three kinds of light, and shadows of each.
Scene AllKinds(int n)
{
  Scene scene = Floor(n, true);
  scene.Lights = { PointLight(scene, { 1.2, 0.7, 2.0 }, 10.0), Panel(scene, 20.0),
    test::SkyLight(SkyRadiance::Overcast(), { 1.0 }) };
  return scene;
}

IrradianceOptions At(double tolerance, int threads = 2)
{
  IrradianceOptions options;
  options.RelativeTolerance = tolerance;
  options.Threads = threads;
  return options;
}

IrradianceResult Simulate(
  const Scene& scene, const IrradianceOptions& options, IrradianceCache* cache = nullptr)
{
  return SimulateIrradiance(scene, {}, options, nullptr, cache);
}

/// The share of values of `a` within its errors and those of `b`.
double Agreeing(const FieldValues& a, const FieldValues& b)
{
  std::size_t good = 0;
  for (std::size_t i = 0; i < a.Values.size(); ++i)
  {
    good += std::fabs(a.Values[i] - b.Values[i]) <= a.Errors[i] + b.Errors[i] + 1e-12 ? 1 : 0;
  }
  return static_cast<double>(good) / static_cast<double>(a.Values.size());
}

} // namespace

TEST(DirectDrops, NothingIsBuiltOrTracedWhereNothingCanHide)
{
  Scene scene = Floor(20, false);
  scene.Lights = { PointLight(scene, { 0.2, 0.1, 1.0 }, 5.0), Panel(scene, 3.0) };
  EXPECT_EQ(Simulate(scene, At(0.01)).Cost.Samples, 0);
  const OcclusionScene occluders(scene);
  DirectOptions open;
  open.Occlusion = false;
  ComputeDirectIrradiance(scene, occluders, MakePatches(scene, 0), open);
  EXPECT_FALSE(occluders.HasRays());
}

TEST(DirectDrops, LightsThatReachNothingBuildNothing)
{
  Scene scene = Floor(10, true);
  scene.Lights = { PointLight(scene, { 0.2, 0.1, 3.0 }, 0.0),
    PointLight(scene, { 0.2, 0.1, 3.0 }, 5.0), PointLight(scene, { 0.0, 0.0, 3.0 }, 5.0) };
  scene.Lights[1].Enabled = false;
  Light& spot = scene.Lights[2]; // up and away
  spot.Type = LightType::Spot;
  spot.Direction = { 0.0, 0.0, 1.0 };
  spot.CosCutoff = std::cos(0.5);
  const OcclusionScene occluders(scene);
  const std::vector<Patch> patches = MakePatches(scene, 0);
  const DirectResult none = ComputeDirectIrradiance(scene, occluders, patches, {});
  EXPECT_FALSE(occluders.HasRays());
  EXPECT_EQ(none.Rays, 0);
  EXPECT_EQ(*std::max_element(none.Irradiance.begin(), none.Irradiance.end()), 0.0);
  spot.Direction = { 0.0, 0.0, -1.0 };
  EXPECT_GT(ComputeDirectIrradiance(scene, occluders, patches, {}).Rays, 0);
  EXPECT_TRUE(occluders.HasRays());
}

TEST(DirectDrops, SkyThatCannotMatterIsLeftOutValueByValue)
{
  Scene scene = Floor(12, true);
  scene.Lights = { PointLight(scene, { 1.2, 0.7, 2.0 }, 1000.0) };
  const OcclusionScene occluders(scene);
  const std::vector<Patch> patches = MakePatches(scene, 0);
  DirectOptions options;
  const DirectResult without = ComputeDirectIrradiance(scene, occluders, patches, options);
  scene.Lights.push_back(test::SkyLight(SkyRadiance::Uniform(), { 0.01 }));
  const DirectResult dropped = ComputeDirectIrradiance(scene, occluders, patches, options);
  options.DropSky = false;
  const DirectResult whole = ComputeDirectIrradiance(scene, occluders, patches, options);
  std::size_t left = 0;
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    const bool leaves = dropped.Irradiance[i] == without.Irradiance[i] && whole.Irradiance[i] > 0.0;
    left += leaves ? 1 : 0;
    EXPECT_LE(std::fabs(dropped.Irradiance[i] - whole.Irradiance[i]),
      dropped.Error[i] + whole.Error[i]);
    if (leaves)
    {
      EXPECT_LE(whole.Irradiance[i] - dropped.Irradiance[i], dropped.Error[i] + 1e-12);
      EXPECT_LE(dropped.Dropped[i], 0.25 * options.RelativeTolerance * dropped.Irradiance[i] * 1.0001);
    }
  }
  // Most of the floor is lit; what the lamp does not reach asks for the sky.
  EXPECT_GT(left, patches.size() / 2);
  EXPECT_GE(whole.Rays - dropped.Rays, static_cast<std::int64_t>(200 * left));
}

TEST(DirectRefinement, AFinerToleranceGoesOnFromWhatThereIs)
{
  const Scene scene = AllKinds(6);
  IrradianceCache cache;
  std::int64_t rays = 0;
  IrradianceResult last, fresh;
  for (const double tolerance : { 0.1, 0.03, 0.01 })
  {
    last = Simulate(scene, At(tolerance), &cache);
    fresh = Simulate(scene, At(tolerance));
    rays += last.Cost.Samples;
    const FieldValues& v = last.Cells[0];
    for (std::size_t i = 0; i < v.Values.size(); ++i)
    {
      // Three kinds of light, each within its tolerance of what there is by then, or as fine as can be.
      EXPECT_LE(v.Errors[i],
        std::max(1.8 * tolerance * v.Values[i], 1.5 * fresh.Cells[0].Errors[i]) + 1e-6)
        << tolerance << " " << i;
    }
  }
  EXPECT_GE(Agreeing(last.Cells[0], fresh.Cells[0]), 0.97);
  // Rays grow with a power of 1/tolerance: the last step is nearly all of it.
  EXPECT_LT(static_cast<double>(rays), 1.6 * static_cast<double>(fresh.Cost.Samples));
  EXPECT_GT(static_cast<double>(rays), 0.6 * static_cast<double>(fresh.Cost.Samples));
}

TEST(DirectRefinement, ACoarserToleranceReturnsWhatThereIs)
{
  const Scene scene = AllKinds(6);
  IrradianceCache cache;
  const IrradianceResult fine = Simulate(scene, At(0.01), &cache);
  const IrradianceResult coarse = Simulate(scene, At(0.1), &cache);
  EXPECT_GT(fine.Cost.Samples, 0);
  EXPECT_EQ(coarse.Cost.Samples, 0);
  EXPECT_EQ(fine.Cells[0].Values, coarse.Cells[0].Values);
  EXPECT_EQ(fine.Cells[0].Errors, coarse.Cells[0].Errors);
  // ... and again at the first one: nothing either.
  EXPECT_EQ(Simulate(scene, At(0.01), &cache).Cost.Samples, 0);
}

TEST(DirectRefinement, ASequenceGivesTheSameBytesForAnyThreadsAndRanks)
{
  const Scene scene = AllKinds(8);
  const auto sequence = [&](int threads, const Communicator* ranks) {
    IrradianceCache cache;
    IrradianceOptions options = At(0.1, threads);
    options.Ranks = ranks;
    Simulate(scene, options, &cache);
    options.RelativeTolerance = 0.02;
    return Simulate(scene, options, &cache).Cells[0];
  };
  const FieldValues one = sequence(1, nullptr);
  const FieldValues three = sequence(3, nullptr);
  EXPECT_EQ(one.Values, three.Values);
  EXPECT_EQ(one.Errors, three.Errors);
  test::ThreadRanks(3).Run([&](const Communicator& ranks) {
    const FieldValues shared = sequence(1, &ranks);
    EXPECT_EQ(one.Values, shared.Values);
    EXPECT_EQ(one.Errors, shared.Errors);
  });
}

TEST(DirectRefinement, APilotIsAPartOfTheRun)
{
  const Scene scene = AllKinds(12);
  const IrradianceResult fresh = Simulate(scene, At(0.02));
  EXPECT_GT(fresh.Cost.PredictedSeconds, 0.0);
  EXPECT_LE(fresh.Cost.PredictedAt, fresh.Cost.Seconds);
  IrradianceCache cache;
  IrradianceOptions options = At(0.02);
  options.PilotOnly = true;
  const IrradianceResult pilot = Simulate(scene, options, &cache);
  EXPECT_TRUE(pilot.Cells[0].Values.empty());
  EXPECT_GT(pilot.Cost.PredictedSeconds, 0.0);
  options.PilotOnly = false;
  const IrradianceResult rest = Simulate(scene, options, &cache);
  EXPECT_EQ(rest.Cells[0].Values, fresh.Cells[0].Values);
  EXPECT_EQ(rest.Cells[0].Errors, fresh.Cells[0].Errors);
  EXPECT_LT(rest.Cost.Samples, fresh.Cost.Samples);
  EXPECT_GT(rest.Cost.Samples, fresh.Cost.Samples / 2);
}

TEST(DirectRefinement, WhatIsKeptBelongsToItsContent)
{
  Scene scene = AllKinds(6);
  IrradianceCache cache;
  const OcclusionScene* first = &cache.Occluders(scene);
  Simulate(scene, At(0.05), &cache);
  EXPECT_EQ(Simulate(scene, At(0.05), &cache).Cost.Samples, 0);
  scene.Lights[0].Position.x += 0.1; // another light, the same geometry
  const IrradianceResult moved = Simulate(scene, At(0.05), &cache);
  EXPECT_EQ(&cache.Occluders(scene), first);
  EXPECT_EQ(moved.Cells[0].Values, Simulate(scene, At(0.05)).Cells[0].Values);
  scene.Optics.TwoSided.assign(scene.Cells, 1); // other receivers
  const IrradianceResult both = Simulate(scene, At(0.05), &cache);
  EXPECT_EQ(both.Cells[1].Values, Simulate(scene, At(0.05)).Cells[1].Values);
  scene.Points[0].z += 0.01; // other geometry
  EXPECT_EQ(Simulate(scene, At(0.05), &cache).Cells[0].Values, Simulate(scene, At(0.05)).Cells[0].Values);
  EXPECT_GT(cache.MemoryBytes(), 0u);
  cache.Release();
  EXPECT_EQ(cache.MemoryBytes(), 0u);
}

TEST(DirectRefinement, MemoryLimitCountsWhatIsKept)
{
  const Scene scene = AllKinds(6);
  IrradianceCache cache;
  IrradianceOptions options = At(0.1);
  options.MemoryLimit = 1000;
  Simulate(scene, options, &cache);
  EXPECT_EQ(cache.MemoryBytes(), 0u);
}

TEST(DirectRefinement, ABudgetLeavesHonestValuesThatALaterRunMakesFine)
{
  const Scene scene = AllKinds(8);
  const IrradianceResult fine = Simulate(scene, At(0.02));
  for (const double budget : { 1e-6, 0.02 })
  {
    IrradianceCache cache;
    IrradianceOptions options = At(0.02);
    options.TimeBudget = budget;
    const IrradianceResult hasty = Simulate(scene, options, &cache);
    EXPECT_LE(hasty.Cost.PredictedSeconds, budget);
    EXPECT_GE(Agreeing(hasty.Cells[0], fine.Cells[0]), 0.95) << budget;
    if (budget < 0.001)
    {
      EXPECT_NE(hasty.Outcome.find("time budget"), std::string::npos);
    }
    const IrradianceResult later = Simulate(scene, At(0.02), &cache);
    EXPECT_EQ(later.Outcome.find("time budget"), std::string::npos);
    EXPECT_GE(Agreeing(later.Cells[0], fine.Cells[0]), 0.97) << budget;
    for (std::size_t i = 0; i < later.Cells[0].Values.size(); ++i)
    {
      EXPECT_LE(later.Cells[0].Errors[i],
        std::max(0.036 * later.Cells[0].Values[i], 1.5 * fine.Cells[0].Errors[i]) + 1e-6)
        << i;
    }
  }
}

TEST(DirectRefinement, AStoppedRunIsGoneOnWith)
{
  class Stops : public Monitor
  {
  public:
    bool Progress(double fraction, const char*) override { return fraction < 0.5; }
  };
  const Scene scene = AllKinds(10);
  IrradianceCache cache;
  Stops stops;
  EXPECT_THROW(SimulateIrradiance(scene, {}, At(0.02), &stops, &cache), Aborted);
  const IrradianceResult rest = Simulate(scene, At(0.02), &cache);
  const IrradianceResult fresh = Simulate(scene, At(0.02));
  EXPECT_LT(rest.Cost.Samples, fresh.Cost.Samples);
  EXPECT_GE(Agreeing(rest.Cells[0], fresh.Cells[0]), 0.97);
}
