// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/EffectRandomRuns.h"
#include "tests/core/TestScenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <iostream>
#include <string>

/// What the plan leaves out changes no value by more than it says, on random scenes: 240 of direct
/// light, 16 of radiosity, each a fixed seed. benchmarks/effect_saving is the same for more scenes.
namespace
{

using namespace radiometry;
using namespace test;

/// Scenes of one test: it is cut into some that run beside each other.
struct Share
{
  Simulation What;
  std::uint64_t First;
  std::uint64_t Count;
};

std::ostream& operator<<(std::ostream& text, const Share& share)
{
  return text << "from " << share.First;
}

RandomSize SizeOf(Simulation what)
{
  return what == Simulation::Direct ? RandomSize::Direct : RandomSize::Radiosity;
}

class EffectRandom : public testing::TestWithParam<Share>
{
};

/// What one effect changes stays within its bound: which one goes round with the seed.
std::size_t CheckOff(
  const RandomScene& scene, Simulation simulation, std::uint64_t seed, const EffectRun& full)
{
  const std::vector<Effect> present = PresentEffects(full);
  if (present.empty())
  {
    return 0;
  }
  const Effect effect = present[seed % present.size()];
  const EffectRun less =
    Simulate(scene, simulation, With(All(EffectSwitch::On), effect, EffectSwitch::Off));
  const EffectDecision& row = less.Effects[static_cast<std::size_t>(effect)];
  if (row.Simulated || !std::isfinite(row.Bound))
  {
    return 0; // it cannot be switched off, or nothing is said
  }
  Compared what;
  what.Radiosity = true;
  what.Backs = true;
  const EffectDifference change = Compare(less, full, row.Bound, what);
  EXPECT_EQ(change.Exceeding, 0u)
    << EffectName(effect) << " off, " << scene.What << '\n' << change.Where;
  return change.Values;
}

TEST_P(EffectRandom, BoundsHold)
{
  const Share share = GetParam();
  EffectDifference all;
  std::size_t off = 0;
  double on = 0.0;
  double withPlan = 0.0;
  for (std::uint64_t seed = share.First; seed < share.First + share.Count; ++seed)
  {
    const RandomScene scene = MakeRandomScene(seed, SizeOf(share.What));
    const EffectRun full = Simulate(scene, share.What, All(EffectSwitch::On));
    const EffectRun plan = Simulate(scene, share.What, All(EffectSwitch::Auto));
    ASSERT_TRUE(std::isfinite(plan.Dropped)) << scene.What;
    const EffectDifference found = Compare(plan, full, plan.Dropped);
    EXPECT_EQ(found.Exceeding, 0u) << scene.What << '\n' << found.Where;
    EXPECT_GT(found.Values, 0u) << scene.What;
    off += CheckOff(scene, share.What, seed, full);
    all.Values += found.Values;
    all.Equal += found.Equal;
    all.Bounded += found.Bounded;
    on += full.ProcessorSeconds;
    withPlan += plan.ProcessorSeconds;
  }
  EXPECT_GT(off, 5 * share.Count);
  std::cout << share.Count << " scenes, " << all.Values << " values: " << all.Equal
            << " the same to the last bit, " << all.Bounded << " within the bound without errors; "
            << withPlan << " s, with all effects on " << on << " s\n";
}

/// A sensor above the middle of the lit top of a box gets rho E F, F by the closed form of a corner.
TEST(EffectRandomFinds, SensorsAroundAConvexBodyGetWhatItReflects)
{
  Mesh mesh;
  mesh.AddBox({ -1, -1, -1 }, { 1, 1, 0 }, 2, false);
  RandomScene scene;
  scene.Scene = mesh.ToScene(0.5);
  Light sun;
  sun.Type = LightType::Directional;
  sun.Intensity = { 1.0 };
  scene.Scene.Lights = { sun };
  scene.RelativeTolerance = 0.01;
  SurfacePoint sensor;
  sensor.Point = Vec3{ 0, 0, 1 } - scene.Scene.Origin;
  sensor.Normal = { 0, 0, -1 };
  scene.Points = { sensor };
  const EffectRun run = Simulate(scene, Simulation::Radiosity, All(EffectSwitch::Auto));
  const EffectRun::Field* points = run.Find("points");
  ASSERT_TRUE(points && points->Values.size() == 1);
  const double exact = 0.5 * (4.0 / std::acos(-1.0)) * std::sqrt(0.5) * std::atan(std::sqrt(0.5));
  EXPECT_NEAR(points->Values[0], exact, points->Errors[0] + 1e-12);
  EXPECT_LT(points->Errors[0], 0.05 * exact);
}

INSTANTIATE_TEST_SUITE_P(Direct, EffectRandom,
  testing::Values(Share{ Simulation::Direct, 1, 120 }, Share{ Simulation::Direct, 121, 120 }));
INSTANTIATE_TEST_SUITE_P(Radiosity, EffectRandom,
  testing::Values(Share{ Simulation::Radiosity, 1, 8 }, Share{ Simulation::Radiosity, 9, 8 }));

} // namespace
