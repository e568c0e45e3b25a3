// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/shading/LightingModel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace radiometry;

namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double Nan = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

DisplayLight PointLight(double x, double y, double z)
{
  DisplayLight light;
  light.Position = { { x, y, z, 1.0 } };
  return light;
}

/// A diffuse floor z = 0 seen from straight above.
ShadingSample Floor(double x = 0.0, double y = 0.0)
{
  ShadingSample sample;
  sample.Point = { x, y, 0.0 };
  sample.Normal = { 0.0, 0.0, 1.0 };
  sample.Eye = { x, y, 10.0 };
  return sample;
}

LightingModel Legacy(ReflectionModel reflection = ReflectionModel::BlinnPhong)
{
  LightingModel model;
  model.Reflection = reflection;
  return model;
}

bool Finite(const Rgb& c)
{
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

} // namespace

TEST(ShadingModel, LambertUnderAPointLightIsRhoEOverPi)
{
  DisplayLight light = PointLight(0.0, 0.0, 3.0);
  light.Diffuse = { 100.0, 50.0, 25.0 };
  light.Attenuation = { { 0.0, 0.0, 1.0 } };
  DisplayMaterial material;
  material.Diffuse = { 0.5, 0.25, 1.0 };
  // At horizontal distance x: E = I cos/r^2 = I h/(h^2 + x^2)^1.5.
  for (const double x : { 0.0, 1.0, 4.0, 100.0 })
  {
    const double e = 3.0 / std::pow(9.0 + x * x, 1.5);
    const ShadedColor seen = Shade(LightingModel(), { light }, material, material, Floor(x));
    EXPECT_NEAR(seen.Color.r, 0.5 * 100.0 * e / Pi, 1e-14 * 100.0);
    EXPECT_NEAR(seen.Color.g, 0.25 * 50.0 * e / Pi, 1e-14 * 100.0);
    EXPECT_NEAR(seen.Color.b, 1.0 * 25.0 * e / Pi, 1e-14 * 100.0);
  }
}

TEST(ShadingModel, HomogeneousPositionDividesByW)
{
  DisplayLight light = PointLight(2.0, 4.0, 8.0);
  DisplayLight scaled = light;
  scaled.Position = { { 1.0, 2.0, 4.0, 0.5 } };
  const LightSums a = SumLights(Legacy(), { light }, 5.0, Floor());
  const LightSums b = SumLights(Legacy(), { scaled }, 5.0, Floor());
  EXPECT_DOUBLE_EQ(a.Diffuse.r, b.Diffuse.r);
  EXPECT_DOUBLE_EQ(a.Specular.r, b.Specular.r);
}

TEST(ShadingModel, DirectionalLightHasNoFallOffAndNoCone)
{
  DisplayLight light;
  light.Position = { { 0.0, 3.0, 4.0, 0.0 } }; // cos = 0.8, the length does not matter
  light.Attenuation = { { 0.0, 0.0, 1e6 } };
  light.CosCutoff = 0.99;
  light.SpotDirection = { 1.0, 0.0, 0.0 };
  EXPECT_NEAR(SumLights(Legacy(), { light }, 5.0, Floor()).Diffuse.r, 0.8, 1e-15);
}

TEST(ShadingModel, AttenuationPolynomial)
{
  DisplayLight light = PointLight(0.0, 0.0, 2.0);
  light.Attenuation = { { 0.5, 0.25, 0.125 } };
  EXPECT_NEAR(SumLights(Legacy(), { light }, 5.0, Floor()).Diffuse.r, 1.0 / 1.5, 1e-15);
  light.Attenuation = { { 0.0, 0.0, 1.0 } };
  EXPECT_NEAR(SumLights(Legacy(), { light }, 5.0, Floor()).Diffuse.r, 0.25, 1e-15);
}

TEST(ShadingModel, SpotConeExponentAndSmoothEdge)
{
  DisplayLight light = PointLight(0.0, 0.0, 1.0);
  light.CosCutoff = std::cos(Pi / 6.0);
  light.SpotExponent = 3.0;
  const double phi = Pi / 8.0;
  const Vec3 inside{ std::sin(phi), 0.0, -std::cos(phi) };
  EXPECT_NEAR(LightFactor(light, 1.0, inside), std::pow(std::cos(phi), 3.0), 1e-15);
  const Vec3 outside{ std::sin(Pi / 5.0), 0.0, -std::cos(Pi / 5.0) };
  EXPECT_EQ(LightFactor(light, 1.0, outside), 0.0);
  // The length of the axis means nothing.
  light.SpotDirection = { 0.0, 0.0, -7.5 };
  EXPECT_NEAR(LightFactor(light, 1.0, inside), std::pow(std::cos(phi), 3.0), 1e-15);

  light.SpotExponent = 0.0;
  light.SmoothEdge = true;
  light.CosInnerCutoff = std::cos(Pi / 12.0);
  const double t = (std::cos(phi) - light.CosCutoff) / (light.CosInnerCutoff - light.CosCutoff);
  EXPECT_NEAR(LightFactor(light, 1.0, inside), t * t, 1e-14);
  const Vec3 core{ std::sin(Pi / 20.0), 0.0, -std::cos(Pi / 20.0) };
  EXPECT_DOUBLE_EQ(LightFactor(light, 1.0, core), 1.0);
  light.CosCutoff = -1.0; // 180 degrees: no cone at all
  EXPECT_DOUBLE_EQ(LightFactor(light, 1.0, outside), 1.0);
}

TEST(ShadingModel, BlinnAndPhongHighlightsByTheirAngles)
{
  DisplayLight light;
  const double a = 0.3; // light at 0.3 rad, viewer at 0.1 rad on the other side
  const double v = 0.1;
  light.Position = { { std::sin(a), 0.0, std::cos(a), 0.0 } };
  ShadingSample sample = Floor();
  sample.Eye = { -5.0 * std::sin(v), 0.0, 5.0 * std::cos(v) };
  const double n = 40.0;
  EXPECT_NEAR(SumLights(Legacy(), { light }, n, sample).Specular.r,
    std::pow(std::cos((a - v) / 2.0), n), 1e-13);
  EXPECT_NEAR(SumLights(Legacy(ReflectionModel::Phong), { light }, n, sample).Specular.r,
    std::pow(std::cos(a - v), n), 1e-13);
  EXPECT_NEAR(SumLights(Legacy(ReflectionModel::Physical), { light }, n, sample).Specular.r,
    (n + 2.0) / (2.0 * Pi) * std::pow(std::cos(a - v), n) * std::cos(a), 1e-12);
}

TEST(ShadingModel, ViewerAtInfinity)
{
  DisplayLight light;
  light.Position = { { std::sin(0.4), 0.0, std::cos(0.4), 0.0 } };
  LightingModel model = Legacy();
  model.LocalViewer = false;
  ShadingSample sample = Floor(50.0); // far to the side of the eye: of no consequence
  sample.Eye = { 0.0, 0.0, 1.0 };
  EXPECT_NEAR(
    SumLights(model, { light }, 20.0, sample).Specular.r, std::pow(std::cos(0.2), 20.0), 1e-13);
}

TEST(ShadingModel, AmbientOfSceneAndOfLights)
{
  LightingModel model = Legacy();
  model.GlobalAmbient = { 0.2, 0.3, 0.4 };
  DisplayLight light = PointLight(0.0, 0.0, -1.0); // behind the surface: ambient only
  light.Ambient = { 1.0, 2.0, 3.0 };
  light.Attenuation = { { 0.0, 2.0, 0.0 } };
  DisplayMaterial material;
  material.Ambient = { 0.5, 0.5, 0.5 };
  material.Emission = { 7.0, 0.0, 0.0 };
  material.Alpha = 0.25;
  const ShadedColor seen = Shade(model, { light }, material, material, Floor());
  EXPECT_DOUBLE_EQ(seen.Color.r, 7.0 + 0.5 * (0.2 + 0.5));
  EXPECT_DOUBLE_EQ(seen.Color.g, 0.5 * (0.3 + 1.0));
  EXPECT_DOUBLE_EQ(seen.Color.b, 0.5 * (0.4 + 1.5));
  EXPECT_EQ(seen.Alpha, 0.25);
}

TEST(ShadingModel, TwoSidedUsesTheBackMaterialAndReversedNormal)
{
  LightingModel model = Legacy();
  DisplayLight light;
  light.Position = { { 0.0, 0.0, -1.0, 0.0 } };
  DisplayMaterial front;
  front.Diffuse = { 1.0, 1.0, 1.0 };
  DisplayMaterial back;
  back.Diffuse = { 0.1, 0.2, 0.3 };
  ShadingSample sample = Floor();
  sample.Eye.z = -10.0;
  sample.FrontFacing = false;
  EXPECT_EQ(Shade(model, { light }, front, back, sample).Color, Rgb());
  model.TwoSided = true;
  EXPECT_NEAR(Shade(model, { light }, front, back, sample).Color.g, 0.2, 1e-15);
  sample.FrontFacing = true;
  EXPECT_EQ(Shade(model, { light }, front, back, sample).Color, Rgb());
}

TEST(ShadingModel, LightAddsUp)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-2.0, 2.0);
  std::vector<DisplayLight> lights;
  Rgb sum;
  LightingModel model;
  for (int i = 0; i < 20; ++i)
  {
    DisplayLight light = PointLight(u(random), u(random), u(random));
    light.Enabled = i % 3 != 0;
    lights.push_back(light);
    sum += SumLights(model, { light }, 12.0, Floor()).Specular;
  }
  const double together = SumLights(model, lights, 12.0, Floor()).Specular.r;
  EXPECT_NEAR(together, sum.r, 1e-12 * std::max(1.0, sum.r));
}

TEST(ShadingModel, DegenerateNormalsReflectNothing)
{
  DisplayLight light = PointLight(0.0, 0.0, 1.0);
  light.Ambient = { 1.0, 1.0, 1.0 };
  DisplayMaterial material;
  material.Specular = { 1.0, 1.0, 1.0 };
  material.Ambient = { 0.5, 0.5, 0.5 };
  for (const Vec3& normal : { Vec3{}, Vec3{ Nan, 0.0, 1.0 }, Vec3{ Infinity, 0.0, 0.0 } })
  {
    ShadingSample sample = Floor();
    sample.Normal = normal;
    const ShadedColor seen = Shade(Legacy(), { light }, material, material, sample);
    EXPECT_DOUBLE_EQ(seen.Color.r, 0.5); // the ambient light knows no normal
  }
  ShadingSample tiny = Floor();
  tiny.Normal = { 0.0, 0.0, 1e-300 };
  EXPECT_NEAR(SumLights(Legacy(), { light }, 1.0, tiny).Diffuse.r, 1.0, 1e-15);
}

TEST(ShadingModel, HardPlacesStayFinite)
{
  DisplayMaterial material;
  material.Specular = { 1.0, 1.0, 1.0 };
  for (const auto reflection :
    { ReflectionModel::BlinnPhong, ReflectionModel::Phong, ReflectionModel::Physical })
  {
    for (const double n : { 0.0, 1e-3, 128.0, 1e9 })
    {
      material.Shininess = n;
      DisplayLight light = PointLight(0.0, 0.0, 0.0); // at the very point
      light.Attenuation = { { 0.0, 0.0, 1.0 } };
      EXPECT_EQ(Shade(Legacy(reflection), { light }, material, material, Floor()).Color, Rgb());
      light = PointLight(1.0, 0.0, 1e-12); // grazing
      EXPECT_TRUE(
        Finite(Shade(Legacy(reflection), { light }, material, material, Floor()).Color));
      ShadingSample sample = Floor();
      sample.Eye = sample.Point; // the eye in the surface
      EXPECT_TRUE(
        Finite(Shade(Legacy(reflection), { light }, material, material, sample).Color));
      sample.Eye = { 0.0, 0.0, -1.0 }; // opposite to the light: H has no direction
      light = PointLight(0.0, 0.0, 1.0);
      EXPECT_TRUE(
        Finite(Shade(Legacy(reflection), { light }, material, material, sample).Color));
    }
  }
}

TEST(ShadingModel, ShininessZeroAndHuge)
{
  DisplayLight light;
  ShadingSample sample = Floor(); // light, eye and normal in line: the peak
  for (const double n : { 0.0, 1.0, 128.0, 1e6, 1e12 })
  {
    EXPECT_NEAR(SumLights(Legacy(), { light }, n, sample).Specular.r, 1.0, 1e-15);
  }
  // Beside the peak: cos^n with an angle of 1e-5 and n = 1e10 is exp(-n angle^2/2) = exp(-1/2).
  light.Position = { { std::sin(1e-5), 0.0, std::cos(1e-5), 0.0 } };
  EXPECT_NEAR(SumLights(Legacy(ReflectionModel::Phong), { light }, 1e10, sample).Specular.r,
    std::exp(-0.5), 1e-6);
  // n = 0 everywhere 1 where the light shines at all.
  light.Position = { { 1.0, 0.0, 0.1, 0.0 } };
  sample.Eye = { 10.0, 0.0, 0.1 };
  EXPECT_EQ(SumLights(Legacy(ReflectionModel::Phong), { light }, 0.0, sample).Specular.r, 1.0);
}

TEST(ShadingModel, TheBackHasItsOwnOfEverything)
{
  LightingModel model = Legacy();
  model.TwoSided = true;
  model.GlobalAmbient = { 1.0, 1.0, 1.0 };
  DisplayLight light;
  light.Position = { { 0.0, std::sin(0.5), -std::cos(0.5), 0.0 } }; // from below
  light.Specular = { 2.0, 2.0, 2.0 };
  DisplayMaterial front;
  front.Emission = { 100.0, 100.0, 100.0 };
  DisplayMaterial back;
  back.Ambient = { 0.1, 0.1, 0.1 };
  back.Diffuse = { 0.2, 0.2, 0.2 };
  back.Specular = { 0.3, 0.3, 0.3 };
  back.Emission = { 0.4, 0.4, 0.4 };
  back.Shininess = 3.0;
  back.Alpha = 0.75;
  ShadingSample sample = Floor();
  sample.Eye = { 0.0, 0.0, -10.0 };
  sample.FrontFacing = false;
  const ShadedColor seen = Shade(model, { light }, front, back, sample);
  EXPECT_NEAR(seen.Color.r,
    0.4 + 0.1 + 0.2 * std::cos(0.5) + 0.3 * 2.0 * std::pow(std::cos(0.25), 3.0), 1e-14);
  EXPECT_EQ(seen.Alpha, 0.75);
}

TEST(ShadingModel, NoHighlightWhereTheLightIsBehind)
{
  // OpenGL's f_i: without it a broad lobe would shine where N.L < 0.
  DisplayLight light = PointLight(5.0, 0.0, -0.1);
  ShadingSample sample = Floor();
  sample.Eye = { -5.0, 0.0, 1.0 };
  for (const auto reflection :
    { ReflectionModel::BlinnPhong, ReflectionModel::Phong, ReflectionModel::Physical })
  {
    EXPECT_EQ(SumLights(Legacy(reflection), { light }, 0.0, sample).Specular.r, 0.0);
    EXPECT_EQ(SumLights(Legacy(reflection), { light }, 1.0, sample).Diffuse.r, 0.0);
  }
}

TEST(ShadingModel, OddShininessAndFallOffNeverMakeNoNumbers)
{
  DisplayLight light = PointLight(0.0, 0.0, 1.0);
  DisplayLight without = light;
  without.Attenuation = { { 0.0, 0.0, 0.0 } };
  DisplayLight close = PointLight(0.0, 0.0, 1e-200);
  close.Attenuation = { { 0.0, 0.0, 1.0 } };
  for (const auto reflection :
    { ReflectionModel::BlinnPhong, ReflectionModel::Phong, ReflectionModel::Physical })
  {
    for (const double n : { -1.0, Nan, Infinity, -Infinity })
    {
      EXPECT_EQ(SumLights(Legacy(reflection), { light }, n, Floor()).Specular, Rgb()) << n;
    }
    EXPECT_EQ(SumLights(Legacy(reflection), { without, close }, 5.0, Floor()).Diffuse, Rgb());
  }
  for (const double w : { Nan, Infinity, -Infinity, 1e-320 })
  {
    light.Position = { { 1.0, 1.0, 1.0, w } };
    EXPECT_TRUE(Finite(SumLights(Legacy(), { light }, 5.0, Floor()).Diffuse)) << w;
  }
  light.Position = { { -2.0, 0.0, -4.0, -2.0 } }; // a negative w is a place as well: (1, 0, 2)
  EXPECT_NEAR(SumLights(Legacy(), { light }, 5.0, Floor()).Diffuse.r, 2.0 / std::sqrt(5.0), 1e-15);
}
