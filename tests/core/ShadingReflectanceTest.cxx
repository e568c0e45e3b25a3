// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/shading/LightingModel.h"
#include "radiometry/scene/Reflectance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace radiometry;

namespace
{

constexpr double Pi = 3.14159265358979323846;
const Vec3 Up{ 0.0, 0.0, 1.0 };

Vec3 Spherical(double theta, double phi)
{
  return { std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta) };
}

/// The same reflectance by brute force over the hemisphere: midpoints of a fine grid.
double BruteForce(double n, double theta)
{
  const int thetas = 800;
  const int phis = 800;
  const Vec3 in = Spherical(theta, 0.0);
  double sum = 0.0;
  for (int i = 0; i < thetas; ++i)
  {
    const double t = (i + 0.5) / thetas * Pi / 2.0;
    for (int j = 0; j < phis; ++j)
    {
      const Vec3 out = Spherical(t, (j + 0.5) / phis * 2.0 * Pi);
      sum += PhongLobeBrdf(1.0, n, Up, in, out) * std::cos(t) * std::sin(t);
    }
  }
  return sum * (Pi / 2.0 / thetas) * (2.0 * Pi / phis);
}

} // namespace

TEST(ShadingReflectance, LambertianReflectsRho)
{
  // Integral of rho/pi cos over the hemisphere: rho.
  double sum = 0.0;
  const int n = 1000;
  for (int i = 0; i < n; ++i)
  {
    const double t = (i + 0.5) / n * Pi / 2.0;
    sum += LambertianBrdf(0.37) * std::cos(t) * std::sin(t) * 2.0 * Pi * (Pi / 2.0 / n);
  }
  EXPECT_NEAR(sum, 0.37, 1e-6);
}

TEST(ShadingReflectance, LobeIsReciprocal)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> theta(0.0, Pi / 2.0);
  std::uniform_real_distribution<double> phi(0.0, 2.0 * Pi);
  for (int i = 0; i < 1000; ++i)
  {
    const Vec3 a = Spherical(theta(random), phi(random));
    const Vec3 b = Spherical(theta(random), phi(random));
    for (const double n : { 0.0, 1.0, 7.5, 60.0 })
    {
      const double f = PhongLobeBrdf(0.8, n, Up, a, b);
      EXPECT_NEAR(f, PhongLobeBrdf(0.8, n, Up, b, a), 1e-13 * (1.0 + f));
    }
  }
}

TEST(ShadingReflectance, NormalIncidenceReflectsExactlyRho)
{
  for (const double n : { 0.0, 0.5, 1.0, 10.0, 128.0, 1e6 })
  {
    EXPECT_EQ(PhongLobeReflectance(0.6, n, 1.0), 0.6);
    EXPECT_NEAR(PhongLobeReflectance(0.6, n, std::cos(1e-4)), 0.6, 1e-7);
  }
}

TEST(ShadingReflectance, EnergyIsNeverGained)
{
  for (const double n : { 0.0, 0.3, 1.0, 4.0, 30.0, 500.0, 1e5 })
  {
    double last = 1.0;
    for (int i = 0; i <= 90; ++i)
    {
      const double share = PhongLobeReflectance(1.0, n, std::cos(i * Pi / 180.0));
      EXPECT_LE(share, 1.0);
      EXPECT_GT(share, 0.0);
      EXPECT_LE(share, last + 1e-9); // falls toward grazing: the horizon cuts the lobe
      last = share;
    }
  }
}

TEST(ShadingReflectance, IntegralAgreesWithBruteForce)
{
  for (const double n : { 0.0, 1.0, 2.5, 20.0 })
  {
    for (const double theta : { 0.2, 0.8, 1.3, 1.55 })
    {
      EXPECT_NEAR(PhongLobeReflectance(1.0, n, std::cos(theta)), BruteForce(n, theta), 2e-5)
        << "n " << n << " theta " << theta;
    }
  }
}

TEST(ShadingReflectance, AHugeExponentIsAMirror)
{
  // The lobe shrinks to the mirror direction, at cos(theta): (n + 2)/(2 pi) normalises it for
  // theta = 0 only.
  for (const double theta : { 0.3, 1.0, 1.5 })
  {
    EXPECT_NEAR(PhongLobeReflectance(1.0, 1e9, std::cos(theta)), std::cos(theta), 1e-8);
  }
  // At grazing incidence the mean of max(0, x) over a Gaussian of variance 1/n: 1/sqrt(2 pi n).
  EXPECT_NEAR(PhongLobeReflectance(1.0, 1e10, 0.0) * std::sqrt(2.0 * Pi * 1e10), 1.0, 1e-6);
}

TEST(ShadingReflectance, ClosedFormForExponentOne)
{
  // n = 1 at grazing incidence, in = x: alpha is the angle to -x; 3/(2 pi) times the integral of
  // max(-x, 0) z over the hemisphere = 3/(2 pi) * 2/3 = 1/pi.
  EXPECT_NEAR(PhongLobeReflectance(1.0, 1.0, 0.0), 1.0 / Pi, 1e-9);
}

TEST(ShadingReflectance, PhysicalModelIsTheBrdfTimesIrradiance)
{
  // Two routes: the lighting model, and BRDF x E.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> theta(0.01, 1.5);
  std::uniform_real_distribution<double> phi(0.0, 2.0 * Pi);
  for (int i = 0; i < 200; ++i)
  {
    const Vec3 in = Spherical(theta(random), phi(random));
    const Vec3 out = Spherical(theta(random), phi(random));
    DisplayLight light;
    light.Position = { { in.x, in.y, in.z, 0.0 } };
    light.Diffuse = light.Specular = { 10.0, 10.0, 10.0 };
    DisplayMaterial material;
    material.Diffuse = { 0.3, 0.3, 0.3 };
    material.Specular = { 0.4, 0.4, 0.4 };
    material.Shininess = 25.0;
    ShadingSample sample;
    sample.Normal = Up;
    sample.Eye = 4.0 * out;
    const double e = 10.0 * in.z;
    const double expected =
      (LambertianBrdf(0.3) + PhongLobeBrdf(0.4, 25.0, Up, in, out)) * e;
    EXPECT_NEAR(Shade(LightingModel(), { light }, material, material, sample).Color.r, expected,
      1e-12 * (1.0 + expected));
  }
}

TEST(ShadingReflectance, LegacyPhongGainsEnergyAndIsNotReciprocal)
{
  // Said in the docs; held here. As a "BRDF" the legacy lobe is max(R.V, 0)^n/(N.L).
  LightingModel legacy;
  legacy.Reflection = ReflectionModel::Phong;
  const auto lobe = [&](const Vec3& in, const Vec3& out) {
    DisplayLight light;
    light.Position = { { in.x, in.y, in.z, 0.0 } };
    ShadingSample sample;
    sample.Normal = Up;
    sample.Eye = out;
    return SumLights(legacy, { light }, 5.0, sample).Specular.r / in.z;
  };
  const Vec3 steep = Spherical(0.3, 0.0);
  const Vec3 grazing = Spherical(1.4, Pi);
  EXPECT_GT(std::abs(lobe(steep, grazing) - lobe(grazing, steep)), 0.1 * lobe(grazing, steep));
  // Grazing light, k_s = 1: reflected over received exceeds one.
  double reflected = 0.0;
  const int n = 200;
  const Vec3 in = Spherical(1.5, 0.0);
  for (int i = 0; i < n; ++i)
  {
    const double t = (i + 0.5) / n * Pi / 2.0;
    for (int j = 0; j < n; ++j)
    {
      reflected += lobe(in, Spherical(t, (j + 0.5) / n * 2.0 * Pi)) * std::cos(t) * std::sin(t) *
        (Pi / 2.0 / n) * (2.0 * Pi / n);
    }
  }
  EXPECT_GT(reflected, 1.0);
}
