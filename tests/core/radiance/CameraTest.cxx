// SPDX-License-Identifier: BSD-3-Clause
// The irradiance of a camera's image: the cos^4 law and what it neglects.
#include "radiometry/imaging/Camera.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

using radiometry::units::Pi;

/// Irradiance of an element at the origin by a disc of radius r at distance 1, its axis t beside
/// the element: the integral of cos cos/(d^2) over the disc by the midpoint rule in polar coordinates.
double DiscByQuadrature(double r, double t)
{
  constexpr int rings = 400, spokes = 400;
  double sum = 0.0;
  for (int i = 0; i < rings; ++i)
  {
    const double s = r * (i + 0.5) / rings;
    for (int j = 0; j < spokes; ++j)
    {
      const double psi = 2.0 * Pi * (j + 0.5) / spokes;
      const double x = t + s * std::cos(psi), y = s * std::sin(psi);
      const double d2 = 1.0 + x * x + y * y;
      sum += s * (r / rings) * (2.0 * Pi / spokes) / (d2 * d2);
    }
  }
  return sum;
}

} // namespace

TEST(Camera, CosFourthTable)
{
  // E/E_axis at 0, 15, 30, 45, 60 degrees: 1, 0.870513, 9/16, 1/4, 1/16.
  const double axis = radiometry::ImageIrradiance(1.0, 2.0, 1.0);
  EXPECT_DOUBLE_EQ(axis, Pi / 16.0);
  const double table[][2] = { { 0., 1. }, { 15., 0.8705127018922193 }, { 30., 0.5625 },
    { 45., 0.25 }, { 60., 0.0625 } };
  for (const auto& row : table)
  {
    const double c = std::cos(radiometry::units::Radians(row[0]));
    EXPECT_NEAR(radiometry::ImageIrradiance(1.0, 2.0, c) / axis, row[1], 1e-15);
  }
  EXPECT_EQ(radiometry::ImageIrradiance(1.0, 2.0, 0.0), 0.0);
  EXPECT_EQ(radiometry::ImageIrradiance(1.0, 2.0, -0.5), 0.0);
}

TEST(Camera, FNumbersInStopsHalveTheLight)
{
  for (const double n : { 1.0, 1.4142135623730951, 2.0, 5.6, 22.0 })
  {
    EXPECT_NEAR(radiometry::ImageIrradiance(3.0, n * std::sqrt(2.0), 0.9) /
        radiometry::ImageIrradiance(3.0, n, 0.9),
      0.5, 1e-14);
  }
}

TEST(Camera, ThinLensIsTheFactorOfItsDisc)
{
  for (const double n : { 0.5, 1.0, 1.4, 4.0 })
  {
    for (const double degrees : { 0., 20., 45., 70. })
    {
      const double a = radiometry::units::Radians(degrees);
      const double direct = DiscByQuadrature(0.5 / n, std::tan(a));
      EXPECT_NEAR(
        radiometry::ThinLensImageIrradiance(1.0, n, std::cos(a)) / direct, 1.0, 2e-5)
        << n << ' ' << degrees;
    }
  }
  // On the axis R^2/(1 + R^2).
  EXPECT_NEAR(radiometry::ThinLensImageIrradiance(1.0, 1.0, 1.0), Pi * 0.25 / 1.25, 1e-15);
  // With magnification the working f-number N (1 + m).
  EXPECT_NEAR(radiometry::ThinLensImageIrradiance(1.0, 2.0, 0.8, 1.0),
    radiometry::ThinLensImageIrradiance(1.0, 4.0, 0.8), 1e-16);
}

TEST(Camera, CosFourthHoldsForSmallPupils)
{
  for (const double degrees : { 0., 30., 60., 85. })
  {
    const double c = std::cos(radiometry::units::Radians(degrees));
    for (const double n : { 8.0, 32.0, 1e4 })
    {
      // R^2 c^2 (3 c^2 - 2), R = 1/(2 N), to the next order.
      const double r2 = 0.25 / (n * n);
      EXPECT_NEAR(radiometry::CosFourthDeviation(n, c), r2 * c * c * (3.0 * c * c - 2.0),
        12.0 * r2 * r2 + 1e-15)
        << degrees << ' ' << n;
    }
  }
  EXPECT_NEAR(radiometry::CosFourthDeviation(1.4, 1.0), 0.25 / 1.96, 1e-14);
  EXPECT_NEAR(radiometry::CosFourthDeviation(8.0, 1.0, 1.0), 4.0 * (1.0 + 1.0 / 1024.0) - 1.0, 1e-12);
  // Fast lenses, wide angles: finite, at most pi L.
  for (const double n : { 1e-6, 0.01, 0.5 })
  {
    for (const double c : { 1e-12, 0.3, 1.0 })
    {
      const double e = radiometry::ThinLensImageIrradiance(1.0, n, c);
      EXPECT_TRUE(e >= 0.0 && e <= Pi * (1.0 + 1e-15)) << n << ' ' << c << ' ' << e;
    }
  }
}

TEST(Camera, AplanaticLensHasNoError)
{
  EXPECT_NEAR(radiometry::AplanaticImageIrradiance(2.0, 1.4),
    radiometry::ImageIrradiance(2.0, 1.4, 1.0), 1e-15);
  EXPECT_NEAR(radiometry::AplanaticImageIrradiance(1.0, 0.5), Pi, 1e-15);
  EXPECT_THROW(radiometry::AplanaticImageIrradiance(1.0, 0.4), radiometry::InputError);
}

TEST(Camera, Images)
{
  EXPECT_DOUBLE_EQ(radiometry::ImageDistance(0.05, 0.1), 0.1);
  EXPECT_DOUBLE_EQ(radiometry::Magnification(0.05, 0.1), 1.0);
  EXPECT_DOUBLE_EQ(radiometry::ImageDistance(0.05, std::numeric_limits<double>::infinity()), 0.05);
  EXPECT_DOUBLE_EQ(radiometry::Magnification(0.05, std::numeric_limits<double>::infinity()), 0.0);
  EXPECT_TRUE(std::isinf(radiometry::ImageDistance(0.05, 0.05)));
  EXPECT_LT(radiometry::ImageDistance(0.05, 0.02), 0.0);
}

TEST(Camera, RefusesNumbersThatAreNone)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : { 0.0, -1.0, nan, std::numeric_limits<double>::infinity() })
  {
    EXPECT_THROW(radiometry::ImageIrradiance(1.0, bad, 1.0), radiometry::InputError);
    EXPECT_THROW(radiometry::ThinLensImageIrradiance(1.0, bad, 1.0), radiometry::InputError);
  }
  EXPECT_THROW(radiometry::ThinLensImageIrradiance(1.0, 2.0, 1.0, nan), radiometry::InputError);
  EXPECT_EQ(radiometry::ImageIrradiance(1.0, 2.0, nan), 0.0);
}
