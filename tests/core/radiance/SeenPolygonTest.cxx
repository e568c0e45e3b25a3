// SPDX-License-Identifier: BSD-3-Clause
// Solid angles and projected solid angles as an eye sees them, and where the eye lies on things.
#include "radiometry/geometry/SeenPolygon.h"
#include "radiometry/scene/Units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace
{

using radiometry::SeenPolygon;
using radiometry::Triangle3;
using radiometry::Vec3;
using radiometry::Viewer;
using radiometry::units::Pi;

SeenPolygon See(const std::vector<Triangle3>& triangles, const Viewer& viewer)
{
  SeenPolygon seen;
  for (const Triangle3& t : triangles)
  {
    seen.Add(t, Normalized(AreaNormal2(t)), viewer, 1.0);
  }
  return seen;
}

/// A rectangle at height z that looks down, a to the right and b up, about its middle.
std::vector<Triangle3> Rectangle(double a, double b, double z)
{
  const Vec3 p{ -a, -b, z }, q{ a, -b, z }, r{ a, b, z }, s{ -a, b, z };
  return { { p, s, r }, { p, r, q } };
}

/// A box about the middle, all fronts inward.
std::vector<Triangle3> Box(double a, double b, double c)
{
  std::vector<Triangle3> box;
  const Vec3 h{ a, b, c };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double sign : { -1.0, 1.0 })
    {
      Vec3 n, u, v;
      n[axis] = sign * h[axis];
      u[(axis + 1) % 3] = h[(axis + 1) % 3];
      v[(axis + 2) % 3] = sign * h[(axis + 2) % 3];
      const Vec3 p = n - u - v, q = n + u - v, r = n + u + v, s = n - u + v;
      box.push_back({ p, r, q });
      box.push_back({ p, s, r });
    }
  }
  return box;
}

Viewer EyeAt(const Vec3& eye, const Vec3& normal)
{
  Viewer viewer;
  viewer.Eye = eye;
  viewer.Normal = viewer.Axis = Normalized(normal);
  return viewer;
}

} // namespace

TEST(SeenPolygon, RectangleOnTheAxis)
{
  for (const double d : { 1e-3, 0.5, 1.0, 20.0, 1e6 })
  {
    const double a = 0.7, b = 0.4;
    const SeenPolygon seen = See(Rectangle(a, b, d), EyeAt({}, { 0, 0, 1 }));
    const double omega = 4.0 * std::atan2(a * b, d * std::sqrt(a * a + b * b + d * d));
    EXPECT_NEAR(seen.SolidAngle / omega, 1.0, 1e-12) << d;
    // pi times the factor of a corner rectangle, four times.
    const double x = a / d, y = b / d;
    const double projected = 2.0 *
      (x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) +
        y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y)));
    EXPECT_NEAR(seen.Projected / projected, 1.0, 1e-12) << d;
    EXPECT_NEAR(seen.ImageArea / (4.0 * x * y), 1.0, 1e-12);
    EXPECT_TRUE(seen.Front);
    EXPECT_FALSE(seen.Back);
    EXPECT_LE(std::fabs(seen.SolidAngle - omega), seen.SolidAngleError);
    EXPECT_LE(std::fabs(seen.Projected - projected), seen.ProjectedError);
  }
}

TEST(SeenPolygon, DiscOfManyTriangles)
{
  // A fan of n: area and solid angle of the disc to 1/n^2.
  constexpr int n = 4000;
  std::vector<Triangle3> disc;
  for (int k = 0; k < n; ++k)
  {
    const double a = 2 * Pi * k / n, b = 2 * Pi * (k + 1) / n;
    disc.push_back({ Vec3{ 0, 0, 2 }, Vec3{ std::cos(b), std::sin(b), 2 },
      Vec3{ std::cos(a), std::sin(a), 2 } });
  }
  const SeenPolygon seen = See(disc, EyeAt({}, { 0, 0, 1 }));
  EXPECT_NEAR(seen.SolidAngle, 2 * Pi * (1 - 2 / std::sqrt(5.0)), 1e-6);
  EXPECT_NEAR(seen.Projected, Pi / 5.0, 1e-6);
  // Mean of cos^4 over the picture of a disc of tangent t: 1/(1 + t^2).
  EXPECT_NEAR(seen.CosFourthMean(), 1.0 / 1.25, 1e-6);
}

TEST(SeenPolygon, ClosedBoxFillsTheSphere)
{
  const auto box = Box(1.0, 2.0, 0.5);
  for (const Vec3& eye : { Vec3{}, Vec3{ 0.9, -1.9, 0.4 }, Vec3{ 1 - 1e-9, 0.3, 0.1 },
         Vec3{ 1 - 1e-14, 2 - 1e-14, 0.5 - 1e-14 }, Vec3{ 1.0, 0.3, 0.1 } })
  {
    const SeenPolygon seen = See(box, EyeAt(eye, { 0.3, -0.5, 0.8 }));
    // Beside a wall the rounding of corners counts, and the errors say so.
    EXPECT_NEAR(seen.SolidAngle, 4 * Pi, 1e-12 + seen.SolidAngleError) << eye.x;
    EXPECT_NEAR(seen.Projected, Pi, 1e-12 + seen.ProjectedError) << eye.x << ' ' << eye.y;
    EXPECT_TRUE(seen.Front && !seen.Back) << eye.x;
  }
  EXPECT_LT(See(box, EyeAt({ 0.9, -1.9, 0.4 }, { 0.3, -0.5, 0.8 })).SolidAngleError, 1e-12);
  const SeenPolygon outside = See(box, EyeAt({ 0, 0, 3 }, { 0, 0, -1 }));
  EXPECT_TRUE(outside.Back);
}

TEST(SeenPolygon, EyeOnThePolygon)
{
  const Triangle3 t{ Vec3{ 0, 0, 0 }, Vec3{ 2, 0, 0 }, Vec3{ 0, 2, 0 } };
  const auto at = [&](const Vec3& eye, const Vec3& about) {
    return See({ t }, EyeAt(eye, about));
  };
  const Vec3 down{ 0, 0, -1 };
  EXPECT_DOUBLE_EQ(at({ 0.5, 0.5, 0 }, down).SolidAngle, 2 * Pi);
  EXPECT_DOUBLE_EQ(at({ 0.5, 0.5, 0 }, down).Projected, Pi);
  EXPECT_DOUBLE_EQ(at({ 0.5, 0.5, 0 }, { 0, 0, 1 }).Projected, 0.0);
  EXPECT_DOUBLE_EQ(at({ 0.5, 0.5, 0 }, { 1, 0, 0 }).Projected, 0.5 * Pi);
  EXPECT_DOUBLE_EQ(at({ 1, 0, 0 }, down).SolidAngle, Pi);
  EXPECT_DOUBLE_EQ(at({ 1, 1, 0 }, down).SolidAngle, Pi);
  EXPECT_DOUBLE_EQ(at({ 0, 0, 0 }, down).SolidAngle, 0.5 * Pi);
  EXPECT_NEAR(at({ 2, 0, 0 }, down).SolidAngle, 0.25 * Pi, 1e-15);
  EXPECT_EQ(at({ 3, 0, 0 }, down).SolidAngle, 0.0);
  EXPECT_EQ(at({ 1, 1.5, 0 }, down).SolidAngle, 0.0);
  // The limits from before it.
  EXPECT_NEAR(at({ 0.5, 0.5, 1e-12 }, down).SolidAngle, 2 * Pi, 1e-9);
  EXPECT_NEAR(at({ 1, 0, 1e-12 }, down).SolidAngle, Pi, 1e-9);
  EXPECT_NEAR(at({ 0, 0, 1e-12 }, down).SolidAngle, 0.5 * Pi, 1e-9);
  EXPECT_NEAR(at({ 2, 0, 1e-12 }, down).SolidAngle, 0.25 * Pi, 1e-9);
}

TEST(SeenPolygon, CrossingThePlaneOfTheEye)
{
  // A wall that begins behind the camera: its picture has no end, its projected part is what is before.
  const double big = 1e7;
  const Triangle3 a{ Vec3{ -1, -big, -big }, Vec3{ -1, big, -big }, Vec3{ -1, big, big } };
  const Triangle3 b{ Vec3{ -1, -big, -big }, Vec3{ -1, big, big }, Vec3{ -1, -big, big } };
  const SeenPolygon seen = See({ a, b }, EyeAt({}, { 0, 0, 1 }));
  EXPECT_NEAR(seen.SolidAngle, 2 * Pi, 1e-5);
  EXPECT_NEAR(seen.Projected, 0.5 * Pi, 1e-5);
  EXPECT_TRUE(std::isinf(seen.ImageArea));
  EXPECT_EQ(seen.CosFourthMean(), 0.0);
}

TEST(SeenPolygon, DegenerateAndFar)
{
  const Viewer eye = EyeAt({}, { 0, 0, 1 });
  const SeenPolygon none =
    See({ { Vec3{ 0, 0, 1 }, Vec3{ 1, 0, 1 }, Vec3{ 2, 0, 1 } } }, eye);
  EXPECT_EQ(none.SolidAngle, 0.0);
  EXPECT_EQ(none.Projected, 0.0);
  for (const double s : { 1e-9, 1e-3, 1e3, 1e9 })
  {
    const double far = 1e6 * s;
    const SeenPolygon seen = See({ { Vec3{ 0, 0, far }, Vec3{ 0, s, far }, Vec3{ s, 0, far } } }, eye);
    EXPECT_NEAR(seen.SolidAngle / 0.5e-12, 1.0, 1e-9) << s;
    EXPECT_NEAR(seen.Projected / 0.5e-12, 1.0, 1e-9) << s;
  }
}

TEST(SeenPolygon, Parallel)
{
  Viewer viewer;
  viewer.Parallel = true;
  viewer.Direction = { 0, 0, -1 };
  const Triangle3 up{ Vec3{}, Vec3{ 1, 0, 0 }, Vec3{ 0, 1, 0 } };
  EXPECT_EQ(radiometry::SeenSide(up, { 0, 0, 1 }, viewer), 1);
  EXPECT_EQ(radiometry::SeenSide(up, { 0, 0, -1 }, viewer), -1);
  viewer.Direction = { 1, 0, 0 };
  EXPECT_EQ(radiometry::SeenSide(up, { 0, 0, 1 }, viewer), 0);
}
