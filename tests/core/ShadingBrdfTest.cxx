// SPDX-License-Identifier: BSD-3-Clause
// The lighting model as a BRDF: reciprocity, energy, closed forms against integration.
#include "radiometry/shading/Reflectance.h"
#include "radiometry/scene/InputError.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace radiometry;

namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double Nan = std::numeric_limits<double>::quiet_NaN();
const Vec3 Up{ 0.0, 0.0, 1.0 };

Brdf Make(ReflectionModel model, double diffuse, double specular, double n)
{
  Brdf brdf;
  brdf.Reflection = model;
  brdf.Diffuse = diffuse;
  brdf.Specular = specular;
  brdf.Shininess = n;
  return brdf;
}

Vec3 Spherical(double theta, double phi)
{
  return { std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta) };
}

/// a_n(theta) for a whole n by the recurrence C_m = s^(m-1) c/m + (m-1)/m C_(m-2), C_0 = pi - theta,
/// C_1 = 1 + c, and the lobe's other factor by the same at theta = 0.
double LobeByRecurrence(int n, double theta)
{
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  const auto integral = [](int m, double angle) {
    double value = m % 2 ? 1.0 + std::cos(angle) : Pi - angle;
    for (int k = m % 2 ? 3 : 2; k <= m; k += 2)
    {
      value = std::pow(std::sin(angle), k - 1) * std::cos(angle) / k + (k - 1.0) / k * value;
    }
    return value;
  };
  // Integral of (1 - y^2)^((n + 1)/2) over [-1, 1]: of cos^(n + 2) over [-pi/2, pi/2].
  const double across = integral(n + 2, 0.0);
  const double along = c * integral(n + 1, theta) + std::pow(s, n + 2) / (n + 1.0);
  return (n + 2.0) / (2.0 * Pi) * across * along;
}

/// The reflectance for light along `in` by midpoints of EvaluateBrdf over the hemisphere.
double BruteForce(const Brdf& brdf, const Vec3& in, int steps = 600)
{
  double sum = 0.0;
  for (int i = 0; i < steps; ++i)
  {
    const double t = (i + 0.5) / steps * Pi / 2.0;
    for (int j = 0; j < steps; ++j)
    {
      sum += EvaluateBrdf(brdf, Up, in, Spherical(t, (j + 0.5) / steps * 2.0 * Pi)) *
        std::cos(t) * std::sin(t);
    }
  }
  return sum * (Pi / 2.0 / steps) * (2.0 * Pi / steps);
}

} // namespace

TEST(ShadingBrdf, ValuesByHand)
{
  const Vec3 in = Spherical(0.5, 0.0);
  const Vec3 out = Spherical(0.2, Pi); // 0.3 rad off the mirror direction
  EXPECT_NEAR(EvaluateBrdf(Make(ReflectionModel::Physical, 0.3, 0.0, 5.0), Up, in, out), 0.3 / Pi,
    1e-16);
  EXPECT_NEAR(EvaluateBrdf(Make(ReflectionModel::Physical, 0.3, 0.6, 5.0), Up, in, out),
    0.3 / Pi + 0.6 * 7.0 / (2.0 * Pi) * std::pow(std::cos(0.3), 5.0), 1e-14);
  EXPECT_NEAR(EvaluateBrdf(Make(ReflectionModel::Phong, 0.3, 0.6, 5.0), Up, in, out),
    (0.3 + 0.6 * std::pow(std::cos(0.3), 5.0) / std::cos(0.5)) / Pi, 1e-14);
  EXPECT_NEAR(EvaluateBrdf(Make(ReflectionModel::BlinnPhong, 0.3, 0.6, 5.0), Up, in, out),
    (0.3 + 0.6 * std::pow(std::cos(0.15), 5.0) / std::cos(0.5)) / Pi, 1e-14);
}

TEST(ShadingBrdf, BelowTheSurfaceAndWithoutDirectionNothingIsReflected)
{
  for (const auto model :
    { ReflectionModel::Physical, ReflectionModel::Phong, ReflectionModel::BlinnPhong })
  {
    for (const double n : { 0.0, 3.0, 1e9, Infinity })
    {
      const Brdf brdf = Make(model, 0.5, 0.5, n);
      EXPECT_EQ(EvaluateBrdf(brdf, Up, -Up, Up), 0.0);
      EXPECT_EQ(EvaluateBrdf(brdf, Up, Up, Spherical(2.0, 0.0)), 0.0);
      EXPECT_EQ(EvaluateBrdf(brdf, Up, { Nan, 0.0, 1.0 }, { 0.0, 0.0, Nan }), 0.0);
      EXPECT_TRUE(std::isfinite(EvaluateBrdf(brdf, Up, Up, Up)));
    }
  }
}

TEST(ShadingBrdf, PhysicalIsReciprocalAtAllAngles)
{
  for (const double n : { 0.0, 0.5, 1.0, 7.0, 60.0, 1000.0, 1e5 })
  {
    const Brdf brdf = Make(ReflectionModel::Physical, 0.2, 0.8, n);
    for (int i = 0; i < 90; i += 3)
    {
      for (int j = 0; j <= i; j += 3)
      {
        for (int k = 0; k <= 180; k += 10)
        {
          const Vec3 a = Spherical(i * Pi / 180.0, 0.3);
          const Vec3 b = Spherical(j * Pi / 180.0, 0.3 + k * Pi / 180.0);
          const double f = EvaluateBrdf(brdf, Up, a, b);
          EXPECT_NEAR(f, EvaluateBrdf(brdf, Up, b, a), 1e-15 * (n + 2.0) * (n + 2.0));
        }
      }
    }
  }
}

TEST(ShadingBrdf, PhysicalNeverGainsEnergyAtAnyAngle)
{
  for (const double n : { 0.0, 1e-6, 0.1, 1.0, 3.0, 10.0, 47.5, 300.0, 1e4, 9.9e5, 1e6, Infinity })
  {
    const Brdf brdf = Make(ReflectionModel::Physical, 0.25, 0.75, n);
    double last = 1.0;
    for (int i = 0; i <= 900; ++i)
    {
      const double share = *ClosedReflectance(brdf, std::cos(i * Pi / 1800.0));
      EXPECT_LE(share, 1.0 + 1e-15);
      EXPECT_GE(share, 0.25);
      EXPECT_LE(share, last + 1e-12) << n << " " << i; // falls toward grazing
      last = share;
    }
  }
}

TEST(ShadingBrdf, ClosedFormIsTheRecurrenceForWholeExponents)
{
  for (const int n : { 1, 2, 3, 4, 5, 10, 11, 50, 128, 1001 })
  {
    const Brdf lobe = Make(ReflectionModel::Physical, 0.0, 1.0, n);
    for (int i = 0; i <= 90; ++i)
    {
      const double theta = i * Pi / 180.0;
      EXPECT_NEAR(*ClosedReflectance(lobe, std::cos(theta)), LobeByRecurrence(n, theta), 2e-13)
        << n << " " << i;
    }
  }
}

TEST(ShadingBrdf, ClosedFormAtItsEnds)
{
  for (const double n : { 1e-3, 1.0, 64.0, 1e5 })
  {
    EXPECT_DOUBLE_EQ(*ClosedReflectance(Make(ReflectionModel::Physical, 0.0, 1.0, n), 1.0), 1.0);
  }
  EXPECT_NEAR(
    *ClosedReflectance(Make(ReflectionModel::Physical, 0.0, 1.0, 1.0), 0.0), 1.0 / Pi, 1e-15);
  // A sharp lobe: the mean of max(0, x) of a Gaussian of variance 1/n at grazing incidence.
  EXPECT_NEAR(*ClosedReflectance(Make(ReflectionModel::Physical, 0.0, 1.0, 9e5), 0.0) *
      std::sqrt(2.0 * Pi * 9e5),
    1.0, 2e-6);
  // From 1e6 on it is a mirror.
  EXPECT_DOUBLE_EQ(*ClosedReflectance(Make(ReflectionModel::Physical, 0.1, 0.7, 1e6), 0.3), 0.8);
  EXPECT_FALSE(ClosedReflectance(Make(ReflectionModel::Physical, 0.1, 0.7, 5.0), Nan));
  EXPECT_FALSE(ClosedReflectance(Make(ReflectionModel::Phong, 0.1, 0.7, 5.0), 0.0));
}

TEST(ShadingBrdf, IntegrationAgreesWithTheClosedForms)
{
  for (const auto model :
    { ReflectionModel::Physical, ReflectionModel::Phong, ReflectionModel::BlinnPhong })
  {
    for (const double n : { 0.0, 0.5, 1.0, 10.0, 128.0, 2e4 })
    {
      const Brdf brdf = Make(model, 0.4, 0.5, n);
      for (const double theta : { 0.0, 0.3, 1.2, 1.56 })
      {
        const auto closed = ClosedReflectance(brdf, std::cos(theta));
        if (!closed)
        {
          EXPECT_EQ(model, ReflectionModel::BlinnPhong);
          continue;
        }
        const IntegratedValue value = IntegrateReflectance(brdf, std::cos(theta), 1e-6);
        EXPECT_LE(std::abs(value.Value - *closed), value.Error + 1e-12 * *closed)
          << int(model) << " n " << n << " theta " << theta;
        EXPECT_LE(value.Error, 1e-5 * *closed) << int(model) << " n " << n << " theta " << theta;
      }
    }
  }
}

TEST(ShadingBrdf, IntegrationAgreesWithBruteForceOverTheFunction)
{
  for (const auto model :
    { ReflectionModel::Physical, ReflectionModel::Phong, ReflectionModel::BlinnPhong })
  {
    for (const double n : { 1.0, 12.0 })
    {
      for (const double theta : { 0.1, 0.8, 1.45 })
      {
        const Brdf brdf = Make(model, 0.3, 0.6, n);
        const double brute = BruteForce(brdf, Spherical(theta, 0.0));
        EXPECT_NEAR(IntegrateReflectance(brdf, std::cos(theta)).Value, brute, 2e-4 * brute)
          << int(model) << " n " << n << " theta " << theta;
      }
    }
  }
}

TEST(ShadingBrdf, Albedo)
{
  EXPECT_EQ(*ClosedAlbedo(Make(ReflectionModel::Physical, 0.37, 0.0, 5.0)), 0.37);
  for (const double n : { 0.0, 0.25, 1.0, 10.0, 100.0 })
  {
    for (const auto model : { ReflectionModel::Physical, ReflectionModel::Phong })
    {
      const Brdf brdf = Make(model, 0.2, 0.7, n);
      const IntegratedValue value = IntegrateAlbedo(brdf, 1e-3);
      EXPECT_LE(std::abs(value.Value - *ClosedAlbedo(brdf)), value.Error + 1e-9)
        << int(model) << " " << n;
      EXPECT_LE(value.Error, 2e-3) << int(model) << " " << n;
    }
  }
  EXPECT_NEAR(
    *ClosedAlbedo(Make(ReflectionModel::Physical, 0.0, 1.0, 9e5)), 2.0 / 3.0, 1e-6);
}

TEST(ShadingBrdf, LegacyModelsAreNotReciprocal)
{
  // Both highlights are the same for in and out exchanged, but the model does not multiply them by
  // N.L: the two values are in the ratio of the cosines.
  const Vec3 steep = Spherical(0.3, 0.0);
  const Vec3 grazing = Spherical(1.4, Pi);
  for (const auto model : { ReflectionModel::Phong, ReflectionModel::BlinnPhong })
  {
    const Brdf brdf = Make(model, 0.0, 1.0, 5.0);
    EXPECT_NEAR(EvaluateBrdf(brdf, Up, grazing, steep) / EvaluateBrdf(brdf, Up, steep, grazing),
      std::cos(0.3) / std::cos(1.4), 1e-10);
  }
  EXPECT_NEAR(std::cos(0.3) / std::cos(1.4), 5.62, 0.01);
}

TEST(ShadingBrdf, LegacyModelsGainEnergyTowardGrazing)
{
  // The angles of docs/physics/shading.md from which a highlight with k_s = 1 alone sends out more
  // than it gets.
  const struct
  {
    ReflectionModel Model;
    double Exponent, Below, Above; // degrees on either side of where it reaches one
  } cases[] = { { ReflectionModel::Phong, 1.0, 70.3, 70.4 },
    { ReflectionModel::Phong, 10.0, 88.7, 88.8 },
    { ReflectionModel::BlinnPhong, 1.0, 29.4, 29.5 },
    { ReflectionModel::BlinnPhong, 10.0, 86.6, 86.7 } };
  for (const auto& c : cases)
  {
    const Brdf brdf = Make(c.Model, 0.0, 1.0, c.Exponent);
    const auto at = [&](double degrees) {
      return IntegrateReflectance(brdf, std::cos(degrees * Pi / 180.0)).Value;
    };
    EXPECT_LT(at(c.Below), 1.0) << int(c.Model) << " " << c.Exponent;
    EXPECT_GT(at(c.Above), 1.0) << int(c.Model) << " " << c.Exponent;
    EXPECT_GT(at(89.99), 2.0) << int(c.Model) << " " << c.Exponent; // and on without limit
  }
}

TEST(ShadingBrdf, ReflectedRadianceUnderUniformLightIsTheReflectance)
{
  // By reciprocity: the integral over what comes in is the reflectance for light from `out`.
  for (const double n : { 0.0, 1.0, 25.0, 3000.0, 1e7 })
  {
    const Brdf brdf = Make(ReflectionModel::Physical, 0.2, 0.7, n);
    for (const double theta : { 0.0, 0.5, 1.2, 1.55 })
    {
      const IntegratedValue radiance = ReflectedRadiance(
        brdf, { 0.0, 0.0, 4.0 }, Spherical(theta, 2.0), [](const Vec3&) { return 3.0; });
      const double expected = 3.0 * *ClosedReflectance(brdf, std::cos(theta));
      EXPECT_NEAR(radiance.Value, expected, radiance.Error + 1e-12);
      EXPECT_LE(radiance.Error, 2e-4 * expected);
    }
  }
}

TEST(ShadingBrdf, ReflectedRadianceOfAStepIsWithinItsError)
{
  // A sky that is bright to one side of a plane through the normal: half of a Lambertian's light.
  for (const double turn : { 0.0, 0.7, 1.9 })
  {
    const Vec3 edge = Spherical(Pi / 2.0, turn);
    const IntegratedValue half = ReflectedRadiance(Make(ReflectionModel::Physical, 0.6, 0.0, 1.0),
      Up, Spherical(0.4, 0.0), [&](const Vec3& in) { return Dot(in, edge) > 0.0 ? 2.0 : 0.0; });
    EXPECT_NEAR(half.Value, 0.6, half.Error + 1e-14);
    EXPECT_LE(half.Error, 0.01);
  }
  // A cap of half-angle b about the normal: rho L sin^2 b.
  const IntegratedValue cap = ReflectedRadiance(Make(ReflectionModel::Physical, 0.6, 0.0, 1.0), Up,
    Up, [&](const Vec3& in) { return in.z > std::cos(0.5) ? 1.0 : 0.0; });
  EXPECT_NEAR(cap.Value, 0.6 * std::pow(std::sin(0.5), 2.0), cap.Error);
}

TEST(ShadingBrdf, ReflectedRadianceOfASmallLampIsFTimesE)
{
  // A cap of 0.1 rad with radiance L gives E = L pi sin^2(0.1) cos(theta) about its axis; the lobe
  // is nearly flat over it.
  const Vec3 axis = Spherical(0.6, 0.0);
  const Brdf brdf = Make(ReflectionModel::Physical, 0.1, 0.8, 4.0);
  const Vec3 out = Spherical(0.9, Pi - 0.2);
  const IntegratedValue seen = ReflectedRadiance(
    brdf, Up, out, [&](const Vec3& in) { return Dot(in, axis) > std::cos(0.1) ? 50.0 : 0.0; });
  const double e = 50.0 * Pi * std::pow(std::sin(0.1), 2.0) * std::cos(0.6);
  EXPECT_NEAR(seen.Value, EvaluateBrdf(brdf, Up, axis, out) * e, 0.01 * seen.Value);
}

TEST(ShadingBrdf, BadInputIsRefused)
{
  const auto dark = [](const Vec3&) { return 0.0; };
  EXPECT_THROW(CheckBrdf(Make(ReflectionModel::Physical, -0.1, 0.0, 1.0)), InputError);
  EXPECT_THROW(CheckBrdf(Make(ReflectionModel::Physical, 0.6, 0.6, 1.0)), InputError);
  EXPECT_THROW(CheckBrdf(Make(ReflectionModel::Phong, 0.6, Nan, 1.0)), InputError);
  EXPECT_THROW(CheckBrdf(Make(ReflectionModel::Phong, 0.6, 0.6, -1.0)), InputError);
  EXPECT_NO_THROW(CheckBrdf(Make(ReflectionModel::Phong, 0.6, 0.6, Infinity)));
  EXPECT_THROW(IntegrateReflectance(Brdf(), 1.5), InputError);
  EXPECT_THROW(
    IntegrateReflectance(Make(ReflectionModel::Phong, 0.6, 0.6, 1.0), 0.0), InputError);
  EXPECT_THROW(ReflectedRadiance(Brdf(), {}, Up, dark), InputError);
  EXPECT_THROW(ReflectedRadiance(Brdf(), Up, { Nan, 0, 0 }, dark), InputError);
  EXPECT_THROW(
    ReflectedRadiance(Brdf(), Up, Up, [](const Vec3&) { return Infinity; }), InputError);
  EXPECT_EQ(ReflectedRadiance(Brdf(), Up, -Up, [](const Vec3&) { return 1.0; }).Value, 0.0);
  try
  {
    CheckBrdf(Make(ReflectionModel::Phong, 0.6, 0.6, -1.0), 7);
    FAIL();
  }
  catch (const InputError& e)
  {
    EXPECT_EQ(e.Array, "Shininess");
    EXPECT_EQ(e.Index, 7);
  }
}
