// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/IrradianceSimulation.h"
#include "radiometry/scene/CandelaWeb.h"
#include "radiometry/scene/SkyRadiance.h"
#include "radiometry/solver/PlannedRadiosity.h"
#include "tests/core/TestScenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace radiometry;

/// Every effect: absent, present, On, Off with no more change than its bound, and dropped by Auto
/// where it is faint.
namespace
{

std::vector<EffectSwitch> Switches(Effect effect = Effect::Occlusion,
  EffectSwitch value = EffectSwitch::Auto)
{
  std::vector<EffectSwitch> switches(EffectCount, EffectSwitch::Auto);
  switches[static_cast<std::size_t>(effect)] = value;
  return switches;
}

/// A floor, a two-sided screen over a part of it, a wall beside it, and a lamp.
Scene Stage()
{
  test::Mesh mesh;
  mesh.AddGrid({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 4, 4);    // cells 0 to 31
  mesh.AddGrid({ -1, 1, 0 }, { 2, 0, 0 }, { 0, 0, 2 }, 2, 2);     // 32 to 39: a wall, front to -y
  mesh.AddGrid({ 0.2, -0.5, 0.7 }, { 0.5, 0, 0 }, { 0, 0.5, 0 }, 1, 1); // 40, 41: the screen
  Scene scene = mesh.ToScene(0.4);
  Light lamp;
  lamp.Position = Vec3{ -0.2, 0.1, 1.5 } - scene.Origin;
  lamp.Intensity = { 3.0 };
  scene.Lights = { lamp };
  return scene;
}

Light Panel(const Scene& scene, double exitance)
{
  Light panel;
  panel.Type = LightType::Area;
  panel.Intensity = { exitance };
  for (const Vec3& p : { Vec3{ -0.5, -0.5, 1.8 }, Vec3{ -0.5, 0, 1.8 }, Vec3{ 0, 0, 1.8 },
         Vec3{ 0, -0.5, 1.8 } })
  {
    panel.Polygon.push_back(p - scene.Origin);
  }
  return panel;
}

void AddGloss(Scene& scene, double reflectance, double shininess)
{
  scene.Optics.SpecularReflectance[0].assign(scene.Cells, 0.0);
  scene.Optics.Shininess[0].assign(scene.Cells, shininess);
  for (std::size_t c = 32; c < 40; ++c)
  {
    scene.Optics.SpecularReflectance[0][c] = reflectance;
  }
}

void AddBands(Scene& scene, double tint)
{
  const auto widen = [&](std::vector<double>& values, double last) {
    std::vector<double> wide;
    for (const double v : values)
    {
      wide.insert(wide.end(), { v, v, v * last });
    }
    values = wide;
  };
  widen(scene.Optics.DiffuseReflectance[0], tint);
  widen(scene.Optics.DiffuseReflectance[1], tint);
  for (Light& light : scene.Lights)
  {
    widen(light.Intensity, tint);
  }
  scene.Optics.Bands = 3;
}

struct Case
{
  Effect Which;
  bool Surfaces; // only Radiosity simulates it
  std::function<void(Scene&, double)> Add; // `strength`: 1, or faint
};

const std::vector<Case>& Cases()
{
  static const auto light = [](LightType type) {
    return [type](Scene& scene, double strength) {
      Light l = scene.Lights[0];
      l.Type = type;
      l.Position.x += 0.4;
      l.Direction = Normalized(Vec3{ 0.2, 0.3, -1.0 });
      l.Intensity = { 2.0 * strength };
      l.CosCutoff = type == LightType::Spot ? 0.8 : -1.0;
      scene.Lights.push_back(l);
    };
  };
  static const std::vector<Case> cases{
    { Effect::SpotLights, false, light(LightType::Spot) },
    { Effect::DirectionalLights, false, light(LightType::Directional) },
    { Effect::AreaLights, false,
      [](Scene& s, double strength) { s.Lights.push_back(Panel(s, 5.0 * strength)); } },
    { Effect::Environment, false,
      [](Scene& s, double strength) {
        s.Lights.push_back(test::SkyLight(SkyRadiance::Overcast(), { 0.5 * strength }));
      } },
    { Effect::SpotShape, false, light(LightType::Spot) },
    { Effect::Attenuation, false,
      [](Scene& s, double strength) {
        light(LightType::Point)(s, strength);
        s.Lights.back().Attenuation[0] = 1.0;
        s.Lights.back().Attenuation[2] = 0.5;
      } },
    { Effect::CandelaWebs, false,
      [](Scene& s, double strength) {
        light(LightType::Point)(s, strength);
        s.Lights.back().Web = std::make_shared<CandelaWeb>(WebType::C, std::vector<double>{ 0.0 },
          std::vector<double>{ 0.0, 45.0, 90.0 }, std::vector<double>{ 1.0, 0.4, 0.1 });
      } },
    { Effect::Emission, false,
      [](Scene& s, double strength) {
        s.Optics.EmittedExitance[0].assign(s.Cells, 0.0);
        s.Optics.EmittedExitance[0][32] = 4.0 * strength;
      } },
    { Effect::Transmission, false,
      [](Scene& s, double strength) {
        s.Optics.Transmittance.assign(s.Cells, 0.0);
        s.TriangleTransmittance.assign(s.Triangles.size(), 0.0);
        for (std::size_t t = 40; t < 42; ++t)
        {
          s.Optics.Transmittance[t] = s.TriangleTransmittance[t] = 0.5 * strength;
        }
      } },
    { Effect::SpecularTransport, true,
      [](Scene& s, double strength) { AddGloss(s, 0.5 * strength, 20.0); } },
    { Effect::Mirrors, true,
      [](Scene& s, double strength) { AddGloss(s, 0.5 * strength, MirrorShininess); } },
    { Effect::SpectralBands, false,
      [](Scene& s, double strength) { AddBands(s, 1.0 - 0.5 * strength); } },
  };
  return cases;
}

struct Simulation
{
  std::array<FieldValues, 2> Cells;
  std::vector<EffectDecision> Effects;
  double Dropped = 0.0;
};

Simulation Simulate(const Scene& scene, bool surfaces, const std::vector<EffectSwitch>& switches,
  double absolute = 0.0, double relative = 0.05)
{
  Simulation run;
  if (surfaces)
  {
    RadiosityOptions options;
    options.RelativeTolerance = relative;
    options.AbsoluteTolerance = absolute;
    options.Refinement = RefinementMode::Off;
    PlannedRadiosity r = SimulatePlannedRadiosity(scene, {}, true, switches, options);
    run.Cells = std::move(r.Cells.Irradiance);
    run.Effects = std::move(r.Effects);
  }
  else
  {
    IrradianceOptions options;
    options.RelativeTolerance = relative;
    options.AbsoluteTolerance = absolute;
    options.Switches = switches;
    IrradianceResult r = SimulateIrradiance(scene, {}, options);
    run.Cells = std::move(r.Cells);
    run.Effects = std::move(r.Effects);
  }
  for (const EffectDecision& d : run.Effects)
  {
    run.Dropped += d.Dropped ? d.Bound : 0.0;
  }
  return run;
}

/// Greatest of |a - b| less `errors` times the stated errors of both.
double Change(const Simulation& a, const Simulation& b, double errors)
{
  double greatest = 0.0;
  for (std::size_t i = 0; i < a.Cells[0].Values.size(); ++i)
  {
    greatest = std::max(greatest,
      std::fabs(a.Cells[0].Values[i] - b.Cells[0].Values[i]) -
        errors * (a.Cells[0].Errors[i] + b.Cells[0].Errors[i]));
  }
  return greatest;
}

const EffectDecision& Row(const Simulation& run, Effect effect)
{
  return run.Effects[static_cast<std::size_t>(effect)];
}

TEST(EffectSwitch, AbsentPresentOnAndOff)
{
  for (const Case& c : Cases())
  {
    SCOPED_TRACE(EffectName(c.Which));
    const Scene without = Stage();
    const Simulation absent = Simulate(without, c.Surfaces, Switches());
    EXPECT_FALSE(Row(absent, c.Which).Present);
    EXPECT_FALSE(Row(absent, c.Which).Simulated);
    EXPECT_EQ(Row(absent, c.Which).Bound, 0.0);
    Scene scene = Stage();
    c.Add(scene, 1.0);
    const Simulation present = Simulate(scene, c.Surfaces, Switches());
    EXPECT_TRUE(Row(present, c.Which).Present);
    EXPECT_TRUE(Row(present, c.Which).Simulated);
    EXPECT_FALSE(Row(present, c.Which).Dropped);
    const Simulation on = Simulate(scene, c.Surfaces, Switches(c.Which, EffectSwitch::On));
    if (!c.Surfaces) // sampled otherwise where bands are not put together
    {
      EXPECT_LE(Change(present, on, 1.0), 0.0);
    }
    const Simulation off = Simulate(scene, c.Surfaces, Switches(c.Which, EffectSwitch::Off));
    EXPECT_FALSE(Row(off, c.Which).Simulated);
    EXPECT_FALSE(Row(off, c.Which).Dropped);
    const double bound = Row(off, c.Which).Bound;
    EXPECT_GT(Change(present, off, -1.0), 0.0);
    EXPECT_LE(Change(present, off, 1.0), bound);
    EXPECT_LE(bound, 200.0 * Change(present, off, 0.0)); // and it says something
    EXPECT_NE(Row(off, c.Which).Why.find("switched off"), std::string::npos);
  }
}

TEST(EffectSwitch, AutoDropsWhatIsFaintAndStatesIt)
{
  for (const Case& c : Cases())
  {
    SCOPED_TRACE(EffectName(c.Which));
    Scene scene = Stage();
    c.Add(scene, 1e-6);
    const double tolerance = 2e-3; // of values of some 1 W/m^2
    const Simulation plan = Simulate(scene, c.Surfaces, Switches(), tolerance, 0.0);
    const EffectDecision& row = Row(plan, c.Which);
    EXPECT_TRUE(row.Present);
    EXPECT_TRUE(row.Dropped);
    EXPECT_FALSE(row.Simulated);
    EXPECT_GT(plan.Dropped, 0.0);
    EXPECT_LE(plan.Dropped, 0.25 * tolerance);
    for (const double e : plan.Cells[0].Errors)
    {
      EXPECT_GE(e, plan.Dropped);
    }
    const Simulation all = Simulate(
      scene, c.Surfaces, std::vector<EffectSwitch>(EffectCount, EffectSwitch::On), tolerance, 0.0);
    EXPECT_FALSE(Row(all, c.Which).Dropped);
    if (!c.Surfaces)
    {
      EXPECT_LE(Change(plan, all, 0.0), plan.Dropped + tolerance);
    }
    EXPECT_LE(Change(plan, all, 1.0), 0.0);
    // Without a tolerance there is nothing that cannot matter.
    if (!c.Surfaces)
    {
      EXPECT_FALSE(Row(Simulate(scene, false, Switches(), 0.0, 0.01), c.Which).Dropped);
    }
  }
}

TEST(EffectSwitch, GlobalAmbientIsWhatNothingCanBeSmallerThan)
{
  Scene scene = Stage();
  Cases()[1].Add(scene, 1e-6); // a faint beam
  scene.GlobalAmbient = { 1.0 };
  const Simulation plan = Simulate(scene, false, Switches(), 0.0, 0.01);
  EXPECT_TRUE(Row(plan, Effect::DirectionalLights).Dropped);
  EXPECT_TRUE(Row(plan, Effect::GlobalAmbient).Simulated);
  scene.GlobalAmbient = { 1e-5 };
  EXPECT_FALSE(Row(Simulate(scene, false, Switches(), 0.0, 0.01), Effect::DirectionalLights).Dropped);
}

TEST(EffectSwitch, InAConvexRoomTheLampItselfIsKnownToBeThere)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 2, 2, 2 }, 3, true);
  Scene scene = mesh.ToScene(0.3);
  Light lamp;
  lamp.Position = Vec3{ 1, 1, 1.2 } - scene.Origin;
  lamp.Intensity = { 5.0 };
  Light faint = lamp;
  faint.Type = LightType::Spot;
  faint.CosCutoff = 0.5;
  faint.Intensity = { 1e-5 };
  scene.Lights = { lamp, faint };
  const Simulation plan = Simulate(scene, false, Switches(), 0.0, 0.01);
  EXPECT_TRUE(Row(plan, Effect::SpotLights).Dropped);
  const Simulation all = Simulate(
    scene, false, std::vector<EffectSwitch>(EffectCount, EffectSwitch::On), 0.0, 0.01);
  for (std::size_t i = 0; i < all.Cells[0].Values.size(); ++i)
  {
    EXPECT_LE(std::fabs(plan.Cells[0].Values[i] - all.Cells[0].Values[i]),
      0.0025 * all.Cells[0].Values[i]);
  }
}

TEST(EffectSwitch, EqualBandsAreComputedOnce)
{
  for (const bool surfaces : { false, true })
  {
    SCOPED_TRACE(surfaces);
    Scene one = Stage();
    one.Lights.push_back(Panel(one, 2.0));
    one.Lights.push_back(test::SkyLight(SkyRadiance::Overcast(), { 0.5 }));
    Scene three = one;
    AddBands(three, 0.5); // two alike and another
    Scene other = one;
    for (Light& light : other.Lights)
    {
      light.Intensity[0] *= 0.5;
    }
    for (int side = 0; side < 2; ++side)
    {
      other.Optics.DiffuseReflectance[side].assign(other.Cells, 0.2);
    }
    Scene equal = one;
    AddBands(equal, 1.0);
    const Simulation alone = Simulate(one, surfaces, Switches());
    const Simulation copied = Simulate(equal, surfaces, Switches());
    EXPECT_FALSE(Row(copied, Effect::SpectralBands).Present);
    const Simulation both = Simulate(three, surfaces, Switches());
    EXPECT_TRUE(Row(both, Effect::SpectralBands).Simulated);
    const std::size_t cells = alone.Cells[0].Values.size();
    ASSERT_EQ(copied.Cells[0].Values.size(), 3 * cells);
    for (std::size_t i = 0; i < cells; ++i)
    {
      for (std::size_t b = 0; b < 3; ++b)
      {
        // The bytes of a run with that band alone.
        EXPECT_EQ(copied.Cells[0].Values[3 * i + b], alone.Cells[0].Values[i]);
        EXPECT_EQ(copied.Cells[0].Errors[3 * i + b], alone.Cells[0].Errors[i]);
      }
      EXPECT_EQ(both.Cells[0].Values[3 * i], both.Cells[0].Values[3 * i + 1]);
      EXPECT_NE(both.Cells[0].Values[3 * i], both.Cells[0].Values[3 * i + 2]);
    }
    // On: each by itself, to the same.
    const Simulation on = Simulate(equal, surfaces, Switches(Effect::SpectralBands, EffectSwitch::On));
    EXPECT_TRUE(Row(on, Effect::SpectralBands).Simulated);
    EXPECT_LE(Change(on, copied, 1.0), 0.0);
    // Off: the mean of all.
    const Simulation grey = Simulate(three, surfaces, Switches(Effect::SpectralBands, EffectSwitch::Off));
    for (std::size_t i = 0; i < cells; ++i)
    {
      EXPECT_EQ(grey.Cells[0].Values[3 * i], grey.Cells[0].Values[3 * i + 2]);
    }
    EXPECT_LE(Change(grey, both, 1.0), Row(grey, Effect::SpectralBands).Bound);
  }
}

TEST(EffectSwitch, SentencesSayWhatWasDone)
{
  Scene scene = Stage();
  Cases()[0].Add(scene, 1.0);
  const Simulation off = Simulate(scene, false, Switches(Effect::SpotLights, EffectSwitch::Off));
  const std::string spots = Explain(Effect::SpotLights, Row(off, Effect::SpotLights), "W/m^2");
  EXPECT_EQ(spots.find("SpotLights is left out: switched off; 1 spot light is on; that changes no "
                       "value by more than "),
    0u);
  EXPECT_EQ(spots.substr(spots.size() - 7), " W/m^2.");
  EXPECT_EQ(Explain(Effect::AreaLights, Row(off, Effect::AreaLights), "W/m^2"),
    "AreaLights is not needed: no area light is on.");
  EXPECT_EQ(Explain(Effect::PointLights, Row(off, Effect::PointLights), "W/m^2"),
    "PointLights is simulated: 1 point light is on.");
  for (int k = 0; k < EffectCount; ++k)
  {
    const EffectDecision& d = off.Effects[static_cast<std::size_t>(k)];
    EXPECT_EQ(d.Known, !d.Why.empty());
  }
}

} // namespace
