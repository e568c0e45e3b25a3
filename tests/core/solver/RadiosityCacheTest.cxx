// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/RadiosityCache.h"

#include "radiometry/solver/ElementOverlap.h"
#include "radiometry/solver/RadiosityLevel.h"
#include "radiometry/solver/RadiositySimulation.h"
#include "tests/core/TestScenes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <string>

using namespace radiometry;

namespace
{

/// A room with a block in it, lit from `at`.
Scene LitRoom(const Vec3& at, double intensity = 20.0, double rho = 0.5)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 3, 3, 2 }, 2, true);
  mesh.AddBox({ 1.0, 1.2, 0.1 }, { 1.7, 1.9, 0.9 }, 1, false);
  Scene scene = mesh.ToScene(rho);
  Light light;
  light.Position = at - scene.Origin;
  light.Intensity = { intensity };
  scene.Lights.push_back(light);
  return scene;
}

RadiosityResult Simulate(
  const Scene& scene, RadiosityCache& cache, const RadiosityOptions& options = {})
{
  RadiositySimulation simulation(scene, options, cache);
  return simulation.Run();
}

RadiosityResult Fresh(const Scene& scene, const RadiosityOptions& options = {})
{
  RadiosityCache cache;
  return Simulate(scene, cache, options);
}

RadiosityOptions Options(RadiosityMethod method, double tolerance)
{
  RadiosityOptions options;
  options.Method = method;
  options.RelativeTolerance = tolerance;
  return options;
}

bool BeganFromKept(const RadiosityResult& r)
{
  return r.MethodWhy.find("kept from the run before") != std::string::npos;
}

bool Spent(const RadiosityResult& r, const char* stage)
{
  return std::any_of(r.Seconds.begin(), r.Seconds.end(),
    [stage](const auto& s) { return s.first == stage; });
}

double Covered(const RadiosityResult& tested, const RadiosityResult& reference)
{
  std::size_t inside = 0;
  const FieldValues& t = tested.Irradiance[0];
  for (std::size_t k = 0; k < t.Values.size(); ++k)
  {
    inside += std::abs(t.Values[k] - reference.Irradiance[0].Values[k]) <= t.Errors[k];
  }
  return static_cast<double>(inside) / static_cast<double>(t.Values.size());
}

bool SameBytes(const RadiosityResult& a, const RadiosityResult& b)
{
  for (int side = 0; side < 2; ++side)
  {
    for (const auto& [x, y] : { std::pair{ &a.Irradiance[side], &b.Irradiance[side] },
           std::pair{ &a.Radiosity[side], &b.Radiosity[side] } })
    {
      if (x->Values.size() != y->Values.size() ||
        std::memcmp(x->Values.data(), y->Values.data(), 8 * x->Values.size()) != 0 ||
        std::memcmp(x->Errors.data(), y->Errors.data(), 8 * x->Errors.size()) != 0)
      {
        return false;
      }
    }
  }
  return true;
}

const Vec3 Here{ 0.6, 0.7, 1.6 }, There{ 2.3, 1.1, 1.2 };

} // namespace

TEST(RadiosityCache, MovedLightIsSolvedOverTheSameOperator)
{
  const RadiosityResult reference = Fresh(LitRoom(There), Options(RadiosityMethod::Dense, 0.01));
  for (const auto method : { RadiosityMethod::Dense, RadiosityMethod::MonteCarlo })
  {
    const RadiosityOptions options = Options(method, 0.05);
    RadiosityCache cache;
    const RadiosityResult first = Simulate(LitRoom(Here), cache, options);
    EXPECT_FALSE(BeganFromKept(first));
    EXPECT_TRUE(Spent(first, "exchange"));
    EXPECT_GT(cache.MemoryBytes(), 0u);
    const RadiosityResult relit = Simulate(LitRoom(There), cache, options);
    EXPECT_TRUE(BeganFromKept(relit)) << relit.MethodWhy;
    if (relit.MetShare >= 0.95 && relit.Elements == first.Elements)
    {
      EXPECT_FALSE(Spent(relit, "exchange"));
    }
    EXPECT_GE(Covered(relit, reference), 0.95) << static_cast<int>(method);
    // A kept operator does where it leaves no more than 15 % of the cells open.
    EXPECT_GE(relit.MetShare, 0.8);
  }
}

TEST(RadiosityCache, DimmedLightDimsAll)
{
  for (const auto method :
    { RadiosityMethod::Dense, RadiosityMethod::Hierarchical, RadiosityMethod::MonteCarlo })
  {
    const RadiosityOptions options = Options(method, 0.1);
    RadiosityCache cache;
    const RadiosityResult bright = Simulate(LitRoom(Here, 20.0), cache, options);
    const RadiosityResult dim = Simulate(LitRoom(Here, 5.0), cache, options);
    EXPECT_FALSE(Spent(dim, "exchange"));
    EXPECT_FALSE(Spent(dim, "rays"));
    for (std::size_t k = 0; k < dim.Irradiance[0].Values.size(); ++k)
    {
      EXPECT_NEAR(4.0 * dim.Irradiance[0].Values[k] / bright.Irradiance[0].Values[k], 1.0, 1e-4);
    }
    // No light at all, and light again.
    const RadiosityResult dark = Simulate(LitRoom(Here, 0.0), cache, options);
    EXPECT_EQ(*std::max_element(dark.Irradiance[0].Values.begin(), dark.Irradiance[0].Values.end()), 0.0);
    EXPECT_TRUE(BeganFromKept(Simulate(LitRoom(Here, 1.0), cache, options)));
  }
}

TEST(RadiosityCache, ReflectanceUpAndDown)
{
  // In a closed room the light's flux is absorbed, whatever the run began from; and the solver's
  // error still bounds what a tight solve of the same operator says.
  const RadiosityOptions options = Options(RadiosityMethod::Dense, 0.05);
  RadiosityCache cache;
  for (const double rho : { 0.5, 0.95, 0.2, 0.999 })
  {
    const Scene scene = LitRoom(Here, 20.0, rho);
    const RadiosityResult r = Simulate(scene, cache, options);
    double absorbed = 0.0;
    for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
    {
      absorbed += Area(scene.TriangleAt(t)) * (1.0 - rho) *
        r.Irradiance[0].Values[static_cast<std::size_t>(scene.TriangleCell[t])];
    }
    const double power = 4.0 * std::acos(-1.0) * 20.0;
    EXPECT_NEAR(absorbed / power, 1.0, 1e-4) << rho;
  }
}

TEST(RadiosityCache, WhatChangesTheExchangeDropsIt)
{
  const RadiosityOptions options = Options(RadiosityMethod::MonteCarlo, 0.2);
  const Scene before = LitRoom(Here);
  const auto dropped = [&](const Scene& after, const RadiosityOptions& now) {
    RadiosityCache cache;
    Simulate(before, cache, options);
    const RadiosityResult r = Simulate(after, cache, now);
    EXPECT_TRUE(SameBytes(r, Fresh(after, now)));
    return !BeganFromKept(r);
  };
  Scene moved = before;
  moved.Points[3].x += 1e-12;
  EXPECT_TRUE(dropped(moved, options));
  Scene turned = before;
  std::swap(turned.Triangles[5][0], turned.Triangles[5][1]);
  EXPECT_TRUE(dropped(turned, options));
  Scene joined = before;
  joined.TriangleCell[1] = joined.TriangleCell[0];
  EXPECT_TRUE(dropped(joined, options));
  Scene sided = before;
  sided.Optics.TwoSided.assign(sided.Cells, 0);
  sided.Optics.TwoSided[50] = 1;
  sided.Optics.DiffuseReflectance[1].assign(sided.Cells, 0.5);
  EXPECT_TRUE(dropped(sided, options));
  Scene pane = before;
  pane.TriangleTransmittance.assign(pane.Triangles.size(), 0.0);
  pane.TriangleTransmittance[50] = 0.5;
  EXPECT_TRUE(dropped(pane, options));
  RadiosityOptions seed = options;
  seed.Seed = 3;
  EXPECT_TRUE(dropped(before, seed));
  RadiosityOptions other = options;
  other.Method = RadiosityMethod::Dense;
  EXPECT_TRUE(dropped(before, other));
}

TEST(RadiosityCache, SameBytesForTheSameSequence)
{
  std::vector<RadiosityResult> first;
  for (const int threads : { 1, 3 })
  {
    RadiosityOptions options = Options(RadiosityMethod::Auto, 0.1);
    options.Threads = threads;
    RadiosityCache cache;
    std::vector<RadiosityResult> results;
    for (const Vec3& at : { Here, There, Here })
    {
      results.push_back(Simulate(LitRoom(at), cache, options));
    }
    if (first.empty())
    {
      first = std::move(results);
      continue;
    }
    for (std::size_t k = 0; k < first.size(); ++k)
    {
      EXPECT_TRUE(SameBytes(first[k], results[k])) << k;
    }
  }
}

TEST(RadiosityCache, ReleaseFreesAll)
{
  const RadiosityOptions options = Options(RadiosityMethod::MonteCarlo, 0.2);
  RadiosityCache cache;
  const RadiosityResult first = Simulate(LitRoom(Here), cache, options);
  EXPECT_GE(cache.MemoryBytes(), first.OperatorBytes);
  cache.Release();
  EXPECT_EQ(cache.MemoryBytes(), 0u);
  EXPECT_TRUE(SameBytes(Simulate(LitRoom(Here), cache, options), first));
}

TEST(ElementOverlap, OriginsOfDividedElements)
{
  const Scene scene = LitRoom(Here);
  const ElementSet coarse(scene, true);
  std::vector<std::uint8_t> some(coarse.Size(), 0);
  for (std::size_t e = 0; e < some.size(); e += 3)
  {
    some[e] = 1;
  }
  const ElementSet finer = coarse.Divided(some);
  some.assign(finer.Size(), 0);
  for (std::size_t e = 0; e < some.size(); e += 4)
  {
    some[e] = 1;
  }
  const ElementSet finest = finer.Divided(some);
  for (const auto& [to, from] : { std::pair{ &finest, &finer }, std::pair{ &finest, &coarse },
         std::pair{ &finer, &finest }, std::pair{ &finest, &finest } })
  {
    const std::vector<ElementOrigin> origin = FindOrigins(*to, *from);
    for (std::size_t e = 0; e < to->Size(); ++e)
    {
      // By brute force: the element with the same corners, else the one that holds the middle.
      const Patch& patch = to->GetPatches()[e];
      std::int32_t same = -1;
      for (std::size_t o = 0; o < from->Size(); ++o)
      {
        const Patch& other = from->GetPatches()[o];
        if (other.Triangle == patch.Triangle && other.Side == patch.Side &&
          Length(other.Corners[0] - patch.Corners[0]) == 0.0 &&
          from->GetAreas()[o] == to->GetAreas()[e] &&
          Length(Centroid(other.Corners) - Centroid(patch.Corners)) == 0.0)
        {
          same = static_cast<std::int32_t>(o);
        }
      }
      ASSERT_EQ(origin[e].Same, same >= 0) << e;
      ASSERT_GE(origin[e].Element, 0);
      const auto o = static_cast<std::size_t>(origin[e].Element);
      EXPECT_EQ(from->GetPatches()[o].Triangle, patch.Triangle);
      EXPECT_EQ(from->GetPatches()[o].Side, patch.Side);
      if (same >= 0)
      {
        EXPECT_EQ(origin[e].Element, same);
      }
    }
  }
}
