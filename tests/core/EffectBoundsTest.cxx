// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/effects/EffectBounds.h"

#include "radiometry/effects/SceneEffects.h"
#include "radiometry/geometry/SolidAngle.h"
#include "radiometry/scene/SkyRadiance.h"
#include "tests/core/TestScenes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace radiometry;

namespace
{

const double Pi = std::acos(-1.0);

Light Lamp(const Scene& scene, const Vec3& position, double intensity = 1.0)
{
  Light light;
  light.Position = position - scene.Origin;
  light.Intensity = { intensity };
  return light;
}

void MakeSpecular(Scene& scene, std::size_t from, double reflectance, double shininess)
{
  scene.Optics.SpecularReflectance[0].resize(scene.Cells, 0.0);
  scene.Optics.Shininess[0].resize(scene.Cells, MirrorShininess);
  for (std::size_t c = from; c < scene.Cells; ++c)
  {
    scene.Optics.SpecularReflectance[0][c] = reflectance;
    scene.Optics.Shininess[0][c] = shininess;
  }
}

constexpr std::array<bool, 5> All{ true, true, true, true, true };

SpecularReach Over(const Scene& scene, bool cells = true)
{
  return BoundSpecular(scene, FindOpticalLimits(scene), cells, All, {});
}

TEST(EffectBounds, PointLightIsExactOnCellsAndUnderTheLamp)
{
  test::Mesh mesh;
  mesh.AddGrid({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1);
  Scene scene = mesh.ToScene();
  scene.Lights = { Lamp(scene, { 0.3, -0.2, 0.5 }, 7.0) };
  const LightBounds found = BoundLights(scene, {}, true, false);
  double average = 0.0, flux = 0.0;
  for (std::size_t t = 0; t < 2; ++t)
  {
    const Triangle3 c = scene.TriangleAt(t);
    const Vec3& p = scene.Lights[0].Position;
    const double omega = std::fabs(SolidAngle(c[0] - p, c[1] - p, c[2] - p));
    average = std::max(average, 7.0 * omega / Area(c));
    flux += 7.0 * omega;
  }
  EXPECT_NEAR(found.All.Value, average, 1e-8 * average);
  EXPECT_NEAR(found.All.Peak, 7.0 / 0.25, 1e-7);
  EXPECT_NEAR(found.All.Flux, flux, 1e-8 * flux);
  EXPECT_EQ(found.Kinds[0].Value, found.All.Value);
  EXPECT_EQ(found.Backs.Value, 0.0);
  scene.Lights[0].Position.z = -scene.Lights[0].Position.z; // behind a surface that has no back
  EXPECT_EQ(BoundLights(scene, {}, true, false).All.Peak, 0.0);
}

TEST(EffectBounds, ASpotThatReachesNothingGivesNothingAndChangesAll)
{
  test::Mesh mesh;
  mesh.AddGrid({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 4, 4);
  Scene scene = mesh.ToScene();
  Light spot = Lamp(scene, { 0, 0, 1 }, 3.0);
  spot.Type = LightType::Spot;
  spot.Direction = { 0, 0, 1 };
  spot.CosCutoff = std::cos(0.5);
  scene.Lights = { spot };
  const LightBounds away = BoundLights(scene, {}, true, false);
  EXPECT_EQ(away.All.Peak, 0.0);
  EXPECT_NEAR(away.SpotShape.Peak, 3.0, 1e-7); // without its cone it shines on the middle
  scene.Lights[0].Direction = { 0, 0, -1 };
  scene.Lights[0].CosCutoff = std::cos(1.5); // wider than the square
  const LightBounds onto = BoundLights(scene, {}, true, false);
  EXPECT_NEAR(onto.All.Peak, 3.0, 1e-7);
  EXPECT_EQ(onto.SpotShape.Peak, 0.0);
}

TEST(EffectBounds, ManyPairsTogetherAreNoLess)
{
  test::Mesh mesh;
  mesh.AddGrid({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 40, 40);
  Scene scene = mesh.ToScene();
  Scene few = scene;
  for (int k = 0; k < 120; ++k)
  {
    Light light = Lamp(scene, { std::cos(k), std::sin(2.0 * k), 0.3 + 0.02 * k }, 1.0 + 0.1 * k);
    if (k % 3 == 0)
    {
      light.Attenuation[0] = 1.0;
      light.Attenuation[2] = 0.3;
    }
    scene.Lights.push_back(light); // 384000 pairs
  }
  few.Lights.assign(scene.Lights.begin(), scene.Lights.begin() + 90); // 288000
  const double one = BoundLights(few, {}, true, false).All.Value;
  for (std::size_t k = 90; k < 120; ++k)
  {
    scene.Lights[k].Intensity = { 1e-12 };
  }
  const double together = BoundLights(scene, {}, true, false).All.Value;
  EXPECT_GE(together, one);
  EXPECT_LE(together, 2.0 * one);
}

TEST(EffectBounds, SkiesGiveNoMoreThanTheirBound)
{
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  const Scene scene = mesh.ToScene();
  EXPECT_NEAR(BoundSky(test::SkyLight(SkyRadiance::Uniform(), { 2.0 })).Irradiance, 2.0 * Pi, 1e-12);
  EXPECT_GE(BoundSky(test::SkyLight(SkyRadiance::Overcast())).Irradiance, 7.0 * Pi / 9.0);
  for (int type = 1; type <= SkyRadiance::Types; ++type)
  {
    const Vec3 sun{ 0.5, 0.3, 0.6 };
    const auto sky = SkyRadiance::General(SkyRadiance::TypeCoefficients(type), sun);
    const SkyBound bound = BoundSky(test::SkyLight(sky));
    // A plane that faces the sun, and the sky itself, by brute force.
    const Vec3 n = Normalized(sun);
    double irradiance = 0.0, peak = 0.0;
    constexpr int rows = 90, columns = 180;
    for (int r = 0; r < rows; ++r)
    {
      for (int c = 0; c < columns; ++c)
      {
        const double z = 0.5 * Pi * (r + 0.5) / rows, a = 2.0 * Pi * (c + 0.5) / columns;
        const Vec3 d{ std::sin(z) * std::sin(a), std::sin(z) * std::cos(a), std::cos(z) };
        const double radiance = sky->At(d);
        peak = std::max(peak, radiance);
        irradiance += radiance * std::fmax(0.0, Dot(n, d)) * std::sin(z) * (0.5 * Pi / rows) *
          (2.0 * Pi / columns);
      }
    }
    EXPECT_GE(bound.Radiance, peak) << type;
    EXPECT_LE(bound.Radiance, 2.5 * peak) << type;
    EXPECT_GE(bound.Irradiance, irradiance) << type;
    EXPECT_LE(bound.Irradiance, 3.5 * irradiance) << type;
  }
}

TEST(EffectBounds, OneMirrorIsOneMoreLamp)
{
  // A mirror of many facets above a floor: the image is 2 m above the lamp, 1 m from the mirror.
  test::Mesh mesh;
  mesh.AddGrid({ -5, -5, 0 }, { 10, 0, 0 }, { 0, 10, 0 }, 4, 4);
  const std::size_t floor = mesh.Triangles.size();
  mesh.AddGrid({ -5, -5, 3 }, { 0, 10, 0 }, { 10, 0, 0 }, 8, 8);
  Scene scene = mesh.ToScene(0.0);
  MakeSpecular(scene, floor, 0.9, MirrorShininess);
  scene.Lights = { Lamp(scene, { 0, 0, 2 }, 50.0) };
  const SpecularReach one = Over(scene, false);
  EXPECT_NEAR(one.Peak, 0.9 * 50.0 / 1.0, 1e-6);
  EXPECT_GE(one.Peak, 0.9 * 50.0 / 16.0); // what the floor gets: 4 m from the image
  EXPECT_EQ(one.MirrorPeak, one.Peak);
  // A beam is as strong behind a mirror as before it.
  scene.Lights[0].Type = LightType::Directional;
  scene.Lights[0].Direction = { 0, 0, 1 };
  EXPECT_NEAR(Over(scene, false).Peak, 0.9 * 50.0, 1e-6);
}

TEST(EffectBounds, AConvexMirrorOnlySpreadsAndAHollowOneMayGather)
{
  for (const int bands : { 6, 12, 18 })
  {
    test::Mesh mesh;
    mesh.AddGrid({ -5, -5, -2 }, { 10, 0, 0 }, { 0, 10, 0 }, 2, 2);
    const std::size_t floor = mesh.Triangles.size();
    mesh.AddSphere({ 0, 0, 0 }, 1.0, bands, false);
    Scene ball = mesh.ToScene(0.0);
    MakeSpecular(ball, floor, 0.8, MirrorShininess);
    ball.Lights = { Lamp(ball, { 0, 0, 3 }, 10.0) };
    // However many facets there are: the nearest is at least 2 m away.
    EXPECT_LE(Over(ball, false).Peak, 0.8 * 10.0 / 4.0 * (1.0 + 1e-6)) << bands;
    EXPECT_GE(Over(ball, false).Peak, 0.8 * 10.0 / 9.0) << bands;

    mesh.Triangles.resize(floor);
    mesh.AddSphere({ 0, 0, 0 }, 1.0, bands, true);
    Scene hollow = mesh.ToScene(0.0);
    MakeSpecular(hollow, floor, 0.8, MirrorShininess);
    hollow.Lights = { Lamp(hollow, { 0, 0, 0.1 }, 10.0) };
    EXPECT_TRUE(std::isinf(Over(hollow, false).Peak)); // facets that see each other
    EXPECT_TRUE(std::isfinite(Over(hollow, true).Value)); // all flux over the smallest cell
  }
}

TEST(EffectBounds, LobesAreBoundedByTheirHeightAndByTheirPlane)
{
  // A glossy floor under a lamp, and a place that looks at it: the exact integral over the floor.
  for (const double n : { 0.0, 1.0, 10.0, 100.0, 1e4 })
  {
    test::Mesh mesh;
    mesh.AddGrid({ -50, -50, 0 }, { 100, 0, 0 }, { 0, 100, 0 }, 2, 2);
    Scene scene = mesh.ToScene(0.0);
    MakeSpecular(scene, 0, 0.5, n);
    scene.Lights = { Lamp(scene, { 0, 0, 1 }, 1.0) };
    const double bound = Over(scene, false).Peak;
    for (const double height : { 0.01, 0.1, 1.0, 3.0 })
    {
      // A plane of normal -z at (0, 0, height): E = int f I cos_in/r^2 cos_out cos_x/u^2 dA.
      double sum = 0.0;
      constexpr int steps = 200000;
      for (int k = 0; k < steps; ++k)
      {
        const double psi = 0.5 * Pi * (k + 0.5) / steps; // from straight down
        const double radius = height * std::tan(psi);
        const Vec3 a{ radius, 0.0, 0.0 };
        const Vec3 in = Normalized(Vec3{ 0, 0, 1 } - a);
        const Vec3 out = Normalized(Vec3{ 0, 0, height } - a);
        const Vec3 mirrored{ -in.x, 0.0, in.z };
        const double lobe = std::pow(std::fmax(0.0, Dot(mirrored, out)), n);
        const double radiance =
          0.5 * (n + 2.0) / (2.0 * Pi) * lobe * in.z / (1.0 + radius * radius);
        sum += radiance * std::cos(psi) * 2.0 * Pi * std::sin(psi) * (0.5 * Pi / steps);
      }
      EXPECT_GE(bound, sum) << n << ' ' << height;
    }
    EXPECT_LE(bound, 0.5 * 0.5 * (n + 2.0) * (1.0 + 1e-6)); // rho (n + 2)/2 I/h^2
    EXPECT_LE(bound, 0.5 * 6.0);                            // whatever the exponent
  }
}

TEST(EffectBounds, BouncesThatMatterFollowTheReflectance)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 2, true);
  Scene scene = mesh.ToScene(0.5);
  scene.GlobalAmbient = { 1.0 };
  EffectAbilities all;
  all.Interreflection = true;
  const std::vector<EffectSwitch> autos(EffectCount, EffectSwitch::Auto);
  SceneEffects effects(scene, autos, all);
  EffectBounds& bounds = effects.Bounds();
  const EffectPlan& plan = effects.Plan();
  EXPECT_NEAR(bounds.Interreflection(plan), 1.0, 1e-12); // 0.5/(1 - 0.5): exact in a closed box
  EXPECT_NEAR(bounds.Interreflection(plan, 3), 0.125, 1e-12);
  EXPECT_EQ(bounds.BouncesFor(1.5, plan), 0);
  EXPECT_EQ(bounds.BouncesFor(0.13, plan), 3);
  EXPECT_EQ(bounds.BouncesFor(0.12, plan), 4);
  EXPECT_EQ(bounds.BouncesFor(0.0, plan), -1);
  scene.Optics.DiffuseReflectance[0].assign(scene.Cells, 1.0); // nothing is known of that
  SceneEffects lossless(scene, autos, all);
  EXPECT_TRUE(std::isinf(lossless.Bounds().Interreflection(lossless.Plan())));
  EXPECT_EQ(lossless.Bounds().BouncesFor(1.0, lossless.Plan()), -1);
}

} // namespace
