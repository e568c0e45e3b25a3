// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/PolygonFormFactor.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace radiometry;

namespace
{
constexpr double Pi = 3.14159265358979323846;

SmallPolygon Rectangle(const Vec3& p, const Vec3& a, const Vec3& b)
{
  SmallPolygon q;
  q.N = 4;
  q.P[0] = p;
  q.P[1] = p + a;
  q.P[2] = p + a + b;
  q.P[3] = p + b;
  return q;
}

/// Point under a corner of a parallel rectangle a x b at height c, Howell B-3.
double Corner(double a, double b, double c)
{
  const double x = a / c, y = b / c;
  const double rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
  return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2 * Pi);
}
} // namespace

TEST(PointToPolygon, ParallelRectangle)
{
  for (double a : { 1e-3, 0.3, 1.0, 40.0, 1e4 })
  {
    for (double b : { 1e-2, 1.0, 1e3 })
    {
      const double exact = Corner(a, b, 1.0);
      const double value =
        PointToPolygon({ 0, 0, 0 }, { 0, 0, 1 }, Rectangle({ 0, 0, 1 }, { 0, b, 0 }, { a, 0, 0 }));
      EXPECT_NEAR(value / exact, 1.0, 1e-10) << a << " " << b;
    }
  }
}

TEST(PointToPolygon, PanelOfReferences)
{
  // 2 x 1 m Lambertian panel of 1000 cd/m^2, 3 m above: E = pi L F.
  const double f =
    PointToPolygon({ 0, 0, 0 }, { 0, 0, 1 }, Rectangle({ -1, -0.5, 3 }, { 0, 1, 0 }, { 2, 0, 0 }));
  EXPECT_NEAR(Pi * 1000.0 * f, 203.626, 5e-4);
}

TEST(PointToPolygon, HorizonHalvesWhatCrossesIt)
{
  // A wall through the receiver's plane counts by what is above it.
  const Vec3 n{ 0, 0, 1 };
  const double whole =
    PointToPolygon({ 0, 0, 0 }, n, Rectangle({ 2, -1, -3 }, { 0, 0, 4 }, { 0, 2, 0 }));
  const double upper =
    PointToPolygon({ 0, 0, 0 }, n, Rectangle({ 2, -1, 0 }, { 0, 0, 1 }, { 0, 2, 0 }));
  EXPECT_GT(upper, 0.0);
  EXPECT_NEAR(whole, upper, 1e-15);
  // Behind the receiver, behind the polygon, in its plane: nothing.
  EXPECT_EQ(
    PointToPolygon({ 0, 0, 0 }, n, Rectangle({ 2, -1, -3 }, { 0, 0, 2 }, { 0, 2, 0 })), 0.0);
  EXPECT_EQ(PointToPolygon({ 3, 0, 0 }, n, Rectangle({ 2, -1, 0 }, { 0, 0, 1 }, { 0, 2, 0 })), 0.0);
  EXPECT_EQ(PointToPolygon({ 2, 5, 0 }, n, Rectangle({ 2, -1, 0 }, { 0, 0, 1 }, { 0, 2, 0 })), 0.0);
}

TEST(PointToPolygon, TinyAndDistantKeepTheirDigits)
{
  for (double d : { 10.0, 30.0, 100.0, 1e4, 1e6 })
  {
    // The kernel of an element seen obliquely.
    const Vec3 c{ 0.6 * d, 0, 0.8 * d };
    const double side = 1.0;
    const double element = 0.8 * 0.8 * side * side / (Pi * d * d);
    const double value = PointToPolygon(
      { 0, 0, 0 }, { 0, 0, 1 }, Rectangle(c - Vec3{ 0.5, 0.5, 0 }, { 0, side, 0 }, { side, 0, 0 }));
    EXPECT_NEAR(value / element, 1.0, 2.0 / (d * d) + 1e-13) << d;
  }
  // Continuity where the method changes: both sides of the switch agree with the closed form.
  for (double s : { 0.0140, 0.0141, 0.01415, 0.0142, 0.015, 0.02, 0.021 })
  {
    const double value =
      PointToPolygon({ 0, 0, 0 }, { 0, 0, 1 }, Rectangle({ 0, 0, 1 }, { 0, s, 0 }, { s, 0, 0 }));
    EXPECT_NEAR(value / Corner(s, s, 1.0), 1.0, 1e-12) << s;
  }
}

TEST(PointToPolygon, WedgesAndEdgeOn)
{
  // An endless wall that rises at the wedge angle from the receiver's horizon: (1 + cos)/2 from
  // its edge; a strip from height 0 of a plane at 179 degrees.
  for (double degrees : { 1.0, 45.0, 90.0, 135.0, 179.0, 179.99 })
  {
    const double w = degrees * Pi / 180.0;
    const Vec3 up{ std::cos(w), 0, std::sin(w) };
    const double big = 1e7;
    // At the unit distance from the edge of the half-plane: sees elevations 0 to w of the plane.
    const double value = PointToPolygon(
      { 1, 0, 0 }, { 0, 0, 1 }, Rectangle({ 0, -big, 0 }, { 0, 2 * big, 0 }, big * up));
    const double exact = std::pow(std::cos(0.5 * w), 2);
    EXPECT_NEAR(value, exact, 1e-6) << degrees;
  }
  // 1e-9 above a unit square: all it sees.
  EXPECT_NEAR(PointToPolygon(
                { 0.5, 0.5, 1e-9 }, { 0, 0, -1 }, Rectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 })),
    1.0, 1e-15);
}
