// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/effects/SceneEffects.h"

#include "radiometry/irradiance/IrradianceSimulation.h"
#include "radiometry/visibility/Convexity.h"
#include "tests/core/TestScenes.h"

#include <gtest/gtest.h>

using namespace radiometry;

namespace
{

const std::vector<EffectSwitch> Auto(EffectCount, EffectSwitch::Auto);

std::vector<EffectSwitch> With(Effect effect, EffectSwitch value)
{
  std::vector<EffectSwitch> switches = Auto;
  switches[static_cast<int>(effect)] = value;
  return switches;
}

Light MakePoint(const Scene& scene, const Vec3& position)
{
  Light light;
  light.Position = position - scene.Origin;
  light.Intensity = { 1.0 };
  return light;
}

TEST(EffectPlan, ConvexBodyNeitherShadowsNorLightsItself)
{
  test::Mesh mesh;
  mesh.AddSphere({ 0, 0, 0 }, 1.0, 12, false);
  Scene scene = mesh.ToScene();
  scene.Lights = { MakePoint(scene, { 3, 0, 0 }) };
  EXPECT_EQ(FindConvexity(scene), Convexity::Body);
  EffectAbilities all;
  all.Interreflection = true;
  const SceneEffects effects(scene, Auto, all);
  const EffectPlan& plan = effects.Plan();
  EXPECT_FALSE(plan.Simulates(Effect::Occlusion));
  EXPECT_FALSE(plan.Simulates(Effect::Interreflection));
  // Leaving the shadows out changes no value at all.
  IrradianceOptions on;
  on.Switches = With(Effect::Occlusion, EffectSwitch::On);
  const IrradianceResult with = SimulateIrradiance(scene, {}, on);
  const IrradianceResult without = SimulateIrradiance(scene, {}, {});
  EXPECT_TRUE(with.Effects[0].Simulated);
  EXPECT_FALSE(without.Effects[0].Simulated);
  EXPECT_EQ(with.Cells[0].Values, without.Cells[0].Values);
}

TEST(EffectPlan, ConvexRoomNeedsNoShadowsForLightsInsideOnly)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 4, 4, 4 }, 3, true);
  Scene scene = mesh.ToScene();
  EXPECT_EQ(FindConvexity(scene), Convexity::Room);
  scene.Lights = { MakePoint(scene, { 1, 2, 3 }) };
  EXPECT_FALSE(SceneEffects(scene, Auto, {}).Plan().Simulates(Effect::Occlusion));
  EXPECT_TRUE(SceneEffects(scene, Auto, {}).Plan()[Effect::Interreflection].Present);
  scene.Lights = { MakePoint(scene, { 5, 2, 3 }) };
  EXPECT_TRUE(SceneEffects(scene, Auto, {}).Plan().Simulates(Effect::Occlusion));
  scene.Lights[0].Type = LightType::Directional;
  EXPECT_TRUE(SceneEffects(scene, Auto, {}).Plan().Simulates(Effect::Occlusion));
  scene.Lights[0].Enabled = false;
  EXPECT_FALSE(SceneEffects(scene, Auto, {}).Plan().Simulates(Effect::Occlusion));
}

TEST(EffectPlan, TwoBodiesAreGeneral)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 1, false);
  mesh.AddBox({ 2, 0, 0 }, { 3, 1, 1 }, 1, false);
  EXPECT_EQ(FindConvexity(mesh.ToScene()), Convexity::General);
}

TEST(EffectPlan, OffLeavesOutAndBoundsAndOnForces)
{
  test::Mesh mesh;
  mesh.AddGrid({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 4, 4);
  mesh.AddGrid({ -0.3, -0.2, 0.5 }, { 0.7, 0, 0 }, { 0, 0.4, 0 }, 1, 1);
  Scene scene = mesh.ToScene();
  Light spot = MakePoint(scene, { 0, 0, 1 });
  spot.Type = LightType::Spot;
  spot.CosCutoff = 0.9;
  spot.Attenuation[0] = 1.0;
  scene.Lights = { spot };
  IrradianceOptions options;
  const IrradianceResult full = SimulateIrradiance(scene, {}, options);
  for (const Effect effect : { Effect::Occlusion, Effect::SpotShape, Effect::Attenuation })
  {
    const int k = static_cast<int>(effect);
    EXPECT_TRUE(full.Effects[k].Simulated);
    EXPECT_EQ(full.Effects[k].Bound, 0.0);
    options.Switches = With(effect, EffectSwitch::Off);
    const IrradianceResult less = SimulateIrradiance(scene, {}, options);
    EXPECT_FALSE(less.Effects[k].Simulated);
    double change = 0.0;
    for (std::size_t i = 0; i < full.Cells[0].Values.size(); ++i)
    {
      change = std::max(change, std::fabs(full.Cells[0].Values[i] - less.Cells[0].Values[i]));
    }
    EXPECT_GT(change, 0.0) << EffectName(effect);
    EXPECT_LE(change, less.Effects[k].Bound) << EffectName(effect);
  }
  options.Switches = With(Effect::BackFaces, EffectSwitch::On); // no surface has a back: harmless
  EXPECT_EQ(SimulateIrradiance(scene, {}, options).Cells[0].Values, full.Cells[0].Values);
}

TEST(EffectPlan, WhatOnlyBlocksLightReflectsNoneAndAFreeSensorSeesTheFloor)
{
  test::Mesh mesh;
  mesh.AddGrid({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 2, 2);
  const std::size_t floor = mesh.Triangles.size();
  mesh.AddBox({ 0, 0, 0.3 }, { 0.5, 0.5, 0.6 }, 1, false);
  Scene scene = mesh.ToScene();
  scene.ReceiverTriangles = floor; // the box only blocks light
  std::fill(scene.TriangleCell.begin() + static_cast<std::ptrdiff_t>(floor),
    scene.TriangleCell.end(), -1);
  scene.Lights = { MakePoint(scene, { -0.5, 0, 1 }) };
  EffectAbilities all;
  all.Interreflection = true;
  const SceneEffects blocked(scene, Auto, all);
  EXPECT_TRUE(blocked.Plan().Simulates(Effect::Occlusion));
  EXPECT_FALSE(blocked.Plan()[Effect::Interreflection].Present);
  const std::vector<SurfacePoint> sensor{ { Vec3{ 0, 0, 0.2 } - scene.Origin, { 0, 0, -1 }, -1, {} } };
  EXPECT_TRUE(SceneEffects(scene, Auto, all, sensor).Plan().Simulates(Effect::Interreflection));
}

TEST(EffectPlan, EmptySceneIsPlannedToo)
{
  const Scene empty;
  const SceneEffects effects(empty, Auto, {});
  const EffectPlan& plan = effects.Plan();
  for (int k = 0; k < EffectCount; ++k)
  {
    EXPECT_FALSE(plan.Simulates(static_cast<Effect>(k)));
    EXPECT_EQ(plan[static_cast<Effect>(k)].Why.empty(), !plan[static_cast<Effect>(k)].Known);
  }
}

} // namespace
