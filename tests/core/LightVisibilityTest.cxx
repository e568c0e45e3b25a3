// SPDX-License-Identifier: BSD-3-Clause
// How much of each light arrives: closed forms, invariants, ranks.
#include "radiometry/irradiance/LightVisibility.h"

#include "radiometry/irradiance/IrradianceSimulation.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/SkyRadiance.h"
#include "radiometry/solver/PlannedRadiosity.h"
#include "tests/core/TestScenes.h"
#include "tests/core/ThreadRanks.h"

#include <gtest/gtest.h>

#include <mutex>

using namespace radiometry;

namespace
{

Light Sun(const Vec3& direction)
{
  Light light;
  light.Type = LightType::Directional;
  light.Direction = Normalized(direction);
  light.Intensity = { 2.0 };
  return light;
}

Light Lamp(const Scene& scene, const Vec3& position)
{
  Light light;
  light.Position = position - scene.Origin;
  light.Intensity = { 3.0 };
  return light;
}

Light Panel(const Scene& scene, const Vec3& corner)
{
  Light light;
  light.Type = LightType::Area;
  light.Intensity = { 1.0 };
  for (const Vec3 d : { Vec3{ 0, 0, 0 }, Vec3{ 0, 1, 0 }, Vec3{ 1, 1, 0 }, Vec3{ 1, 0, 0 } })
  {
    light.Polygon.push_back(corner + d - scene.Origin); // shines down
  }
  return light;
}

/// A floor [0, 4]^2 of 4 x 4 squares (a cell a triangle) below a lid over x < `edge`, at z = 1.
Scene LidScene(double edge)
{
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 4, 4);
  mesh.AddGrid({ -9, -9, 1 }, { 9 + edge, 0, 0 }, { 0, 22, 0 }, 1, 1);
  return mesh.ToScene();
}

std::array<LightShares, 2> OfCells(const Scene& scene, DirectOptions options = {})
{
  return FindLightVisibility(
    scene, OcclusionScene(scene), MakePatches(scene, 0), scene.Cells, options);
}

/// The share of triangle t that lies at x > edge, in closed form.
double AreaBeyond(const Scene& scene, std::size_t t, double edge)
{
  // The integral of the piecewise linear width over x, by exact clipping.
  const Triangle3 corners = scene.TriangleAt(t);
  std::vector<Vec3> kept;
  for (int k = 0; k < 3; ++k)
  {
    const Vec3 a = corners[k] + scene.Origin;
    const Vec3 b = corners[(k + 1) % 3] + scene.Origin;
    if (a.x >= edge)
    {
      kept.push_back(a);
    }
    if ((a.x < edge) != (b.x < edge))
    {
      kept.push_back(a + ((edge - a.x) / (b.x - a.x)) * (b - a));
    }
  }
  double area = 0.0;
  for (std::size_t k = 0; k < kept.size(); ++k)
  {
    const Vec3& a = kept[k];
    const Vec3& b = kept[(k + 1) % kept.size()];
    area += 0.5 * (a.x * b.y - b.x * a.y);
  }
  return area / Area(corners);
}

TEST(LightVisibility, HalfInTheShadowOfTheSunIsTheLitShareOfTheArea)
{
  // The lid's edge at x = 0.3, the sun at 45 degrees: the shadow ends at x = 1.3.
  Scene scene = LidScene(0.3);
  scene.Lights.push_back(Sun({ 1, 0, -1 }));
  const LightShares shares = OfCells(scene)[0];
  int partly = 0;
  for (std::size_t t = 0; t < 32; ++t)
  {
    const double exact = AreaBeyond(scene, t, 1.3);
    EXPECT_NEAR(shares[t], exact, 1e-6) << t; // of a float
    partly += exact > 0.0 && exact < 1.0 ? 1 : 0;
    if (exact == 0.0 || exact == 1.0)
    {
      EXPECT_EQ(shares[t], static_cast<float>(exact)) << t;
    }
  }
  EXPECT_EQ(partly, 8);
}

TEST(LightVisibility, HiddenUnhiddenDisabledAndOutOfReach)
{
  Scene scene = LidScene(2.0);
  scene.Lights.push_back(Sun({ 0, 0, -1 }));            // x < 2 in shadow
  scene.Lights.push_back(Sun({ 0, 0, -1 }));            // off
  scene.Lights.back().Enabled = false;
  scene.Lights.push_back(Sun({ 0, 0, 1 }));             // from below
  scene.Lights.push_back(Lamp(scene, { 2, 2, 0.5 }));   // below the lid: all lit
  scene.Lights.push_back(Panel(scene, { 2, 1, 0.6 }));  // the same
  scene.Lights.push_back(Lamp(scene, { 2, 2, 0.5 }));   // its legacy fall-off is refined, not exact
  scene.Lights.back().Attenuation[0] = 0.5;
  scene.Lights.push_back(Lamp(scene, { 2, 2, 0.5 }));   // no light at all
  scene.Lights.back().Intensity = { 0.0 };
  const LightShares shares = OfCells(scene)[0];
  ASSERT_EQ(shares.size(), scene.Cells * 7);
  for (std::size_t t = 0; t < 32; ++t)
  {
    const double x = Centroid(scene.TriangleAt(t)).x + scene.Origin.x;
    const float* s = &shares[t * 7];
    EXPECT_EQ(s[0], x < 2.0 ? 0.0f : 1.0f) << t;
    EXPECT_EQ(s[1], 0.0f);
    EXPECT_EQ(s[2], 0.0f);
    EXPECT_EQ(s[3], 1.0f);
    EXPECT_EQ(s[4], 1.0f);
    EXPECT_EQ(s[5], 1.0f);
    EXPECT_EQ(s[6], 0.0f);
  }
}

TEST(LightVisibility, SharesTimesUnoccludedLightAddUpToTheLight)
{
  Scene scene = LidScene(1.7);
  scene.GlobalAmbient = { 0.25 };
  scene.Lights.push_back(Sun({ 1, 0.2, -1 }));
  scene.Lights.push_back(Lamp(scene, { 1.1, 2.3, 2.5 }));
  scene.Lights.push_back(Panel(scene, { 2.2, 1, 1.6 }));
  Light sky;
  sky.Type = LightType::Environment;
  sky.Intensity = { 0.3 };
  sky.Environment = SkyRadiance::Uniform();
  scene.Lights.push_back(sky);
  const OcclusionScene occluders(scene);
  const std::vector<Patch> patches = MakePatches(scene, 0);
  DirectOptions options;
  options.RelativeTolerance = 5e-3;
  const DirectResult all = ComputeDirectIrradiance(scene, occluders, patches, options);
  const LightShares shares =
    FindLightVisibility(scene, occluders, patches, scene.Cells, options)[0];
  std::vector<double> sum(patches.size(), 0.25);
  for (std::size_t k = 0; k < scene.Lights.size(); ++k)
  {
    DirectOptions alone = options;
    alone.OnlyLight = static_cast<std::ptrdiff_t>(k);
    alone.Occlusion = false;
    const DirectResult open = ComputeDirectIrradiance(scene, occluders, patches, alone);
    for (std::size_t i = 0; i < patches.size(); ++i)
    {
      const float share = shares[static_cast<std::size_t>(patches[i].Cell) * 4 + k];
      EXPECT_GE(share, 0.0f);
      EXPECT_LE(share, 1.0f);
      sum[i] += share * open.Irradiance[i];
    }
  }
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    EXPECT_NEAR(sum[i], all.Irradiance[i], 1e-2 * all.Irradiance[i]) << i;
  }
}

TEST(LightVisibility, PointsAndBothSides)
{
  Scene scene = LidScene(2.0);
  scene.Lights.push_back(Sun({ 0, 0, -1 }));
  scene.Lights.push_back(Sun({ 0, 0, 1 }));
  scene.Optics.TwoSided.assign(scene.Cells, 1);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 8; ++i)
  {
    points.push_back({ Vec3{ 0.25 + 0.5 * i, 1.3, 0 } - scene.Origin, { 0, 0, 1 }, -1, {}, 0.0 });
  }
  const LightShares at = FindLightVisibility(scene, OcclusionScene(scene), points, {});
  for (int i = 0; i < 8; ++i)
  {
    EXPECT_EQ(at[2 * i], i < 4 ? 0.0f : 1.0f) << i;
    EXPECT_EQ(at[2 * i + 1], 0.0f);
  }
  IrradianceOptions options;
  options.LightVisibility = true;
  const IrradianceResult both = SimulateIrradiance(scene, points, options);
  ASSERT_EQ(both.CellVisibility[1].size(), scene.Cells * 2);
  EXPECT_EQ(both.PointVisibility[0], at);
  for (std::size_t t = 0; t < 32; ++t)
  {
    EXPECT_EQ(both.CellVisibility[1][2 * t], 0.0f);
    EXPECT_EQ(both.CellVisibility[1][2 * t + 1], 1.0f); // the floor's back, from below
  }
  PlannedRadiosity solved = SimulatePlannedRadiosity(scene, points, true,
    std::vector<EffectSwitch>(EffectCount), [] {
      RadiosityOptions o;
      o.LightVisibility = true;
      return o;
    }());
  EXPECT_EQ(solved.CellVisibility, both.CellVisibility);
  EXPECT_EQ(solved.PointVisibility[0], at);
  options.LightVisibility = false;
  const IrradianceResult off = SimulateIrradiance(scene, points, options);
  EXPECT_TRUE(off.CellVisibility[0].empty());
  EXPECT_EQ(off.Cells[0].Values, both.Cells[0].Values);
}

TEST(LightVisibility, MoreLightsThanThereIsRoomForIsAnError)
{
  Scene scene = LidScene(1.0);
  scene.Lights.assign(MostVisibleLights, Sun({ 0, 0, -1 }));
  EXPECT_NO_THROW(CheckLightVisibility(scene));
  scene.Lights.push_back(Sun({ 0, 0, -1 }));
  EXPECT_THROW(OfCells(scene), InputError);
}

TEST(LightVisibility, RanksGetTheBytesOfOneProcess)
{
  Scene scene = LidScene(1.7);
  scene.Lights.push_back(Sun({ 1, 0.2, -1 }));
  scene.Lights.push_back(Lamp(scene, { 1.1, 2.3, 2.5 }));
  scene.Lights.push_back(Panel(scene, { 2.2, 1, 1.6 }));
  const OcclusionScene occluders(scene);
  const LightShares alone = OfCells(scene)[0];
  std::mutex guard;
  int compared = 0;
  test::ThreadRanks(3).Run([&](const Communicator& ranks) {
    DirectOptions options;
    options.Ranks = &ranks;
    options.Threads = 1;
    const LightShares shares = OfCells(scene, options)[0];
    const std::lock_guard<std::mutex> lock(guard);
    EXPECT_EQ(shares, alone);
    ++compared;
  });
  EXPECT_EQ(compared, 3);
}

} // namespace
