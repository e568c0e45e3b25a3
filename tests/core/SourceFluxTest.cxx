// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/AxialFlux.h"
#include "radiometry/geometry/SolidAngle.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

using namespace radiometry;

namespace
{

const double Pi = std::acos(-1.0);

/// For polygons written out in place.
double AxialFlux(const std::vector<Vec3>& polygon, const Vec3& axis, const AxialDistribution& d)
{
  return radiometry::AxialFlux(polygon.data(), polygon.size(), axis, d);
}

TEST(SolidAngle, ClosedForms)
{
  // An octant; the front faces the origin.
  EXPECT_NEAR(SolidAngle({ 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }), Pi / 2, 1e-15);
  EXPECT_NEAR(SolidAngle({ 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }), -Pi / 2, 1e-15);
  // A square of half side a at distance d: 4 asin(a^2/(a^2 + d^2)).
  for (const double d : { 1e-9, 1e-3, 0.5, 1.0, 1e3, 1e6, 1e9 })
  {
    const std::vector<Vec3> square{ { -1, -1, d }, { -1, 1, d }, { 1, 1, d }, { 1, -1, d } };
    const double exact = 4.0 * std::atan2(1.0, d * std::sqrt(2.0 + d * d));
    EXPECT_NEAR(SolidAngle(square.data(), 4) / exact, 1.0, 4e-15) << d;
  }
}

TEST(SolidAngle, ClosedSurfaceSumsToFullSphere)
{
  // Any point inside a tetrahedron with faces inward sees 4 pi, outside 0.
  const Vec3 p[4] = { { 1, 1, 1 }, { -1, -1, 1 }, { -1, 1, -1 }, { 1, -1, -1 } };
  const int face[4][3] = { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-0.2, 0.2);
  for (int k = 0; k < 100; ++k)
  {
    const double far = k % 2 ? 20.0 : 1.0;
    const Vec3 o = far * Vec3{ unit(random), unit(random), unit(random) };
    double sum = 0.0;
    for (const auto& f : face)
    {
      sum += SolidAngle(p[f[0]] - o, p[f[1]] - o, p[f[2]] - o);
    }
    const bool inside = std::fabs(std::fabs(sum) - 4 * Pi) < 1e-12;
    const bool outside = std::fabs(sum) < 1e-12;
    EXPECT_TRUE(inside || outside) << sum;
    if (k % 2 == 0)
    {
      EXPECT_TRUE(inside);
    }
  }
}

/// A brute-force product rule on the polygon's triangles, as an independent route.
double Reference(const std::vector<Vec3>& polygon, const Vec3& axis, const AxialDistribution& d, int n)
{
  double sum = 0.0;
  for (std::size_t k = 2; k < polygon.size(); ++k)
  {
    const Vec3 &a = polygon[0], &b = polygon[k - 1], &c = polygon[k];
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j < n - i; ++j)
      {
        const auto at = [&](double u, double v) { return a + (u / n) * (b - a) + (v / n) * (c - a); };
        const auto add = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
          const Vec3 m = (p + q + r) / 3.0;
          sum += SolidAngle(p, q, r) * d.Intensity(Dot(Normalized(m), axis));
        };
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (j < n - i - 1)
        {
          add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
      }
    }
  }
  return sum;
}

TEST(AxialFlux, MatchesBruteForceForAnyDistribution)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const double exponents[] = { 0.0, 0.5, 1.0, 3.0, 20.0 };
  const double cones[] = { -1.0, 0.0, 0.3, 0.9 };
  for (int k = 0; k < 60; ++k)
  {
    const double z = 0.3 + std::fabs(unit(random));
    const std::vector<Vec3> triangle{ { 2 * unit(random), 2 * unit(random), z },
      { 2 * unit(random), 2 * unit(random), z }, { 2 * unit(random), 2 * unit(random), z } };
    const Vec3 axis = Normalized({ unit(random), unit(random), 0.2 + unit(random) });
    const double outer = cones[k % 4];
    const bool smooth = k % 3 == 0 && outer >= 0.0;
    const AxialDistribution d(exponents[k % 5], outer, smooth, 0.5 * (1.0 + outer));
    const double exact = AxialFlux(triangle, axis, d);
    const double brute = Reference(triangle, axis, d, 300);
    EXPECT_NEAR(exact, brute, 3e-4 * std::fabs(SolidAngle(triangle.data(), 3)) + 1e-12)
      << k << " e " << exponents[k % 5] << " cone " << outer;
    EXPECT_EQ(exact >= 0.0, SolidAngle(triangle.data(), 3) >= 0.0 || exact == 0.0);
  }
}

TEST(AxialFlux, PartsSumToTheWholeAndConesToTheirFlux)
{
  // A plane of 1e4 half side at distance 1 with the axis tilted: nearly all of the cone.
  const double h = 1e4;
  const std::vector<Vec3> plane{ { -h, -h, 1 }, { -h, h, 1 }, { h, h, 1 }, { h, -h, 1 } };
  for (const double cosine : { 0.999, 0.9, 0.6 })
  {
    const AxialDistribution hard(0.0, cosine);
    EXPECT_NEAR(AxialFlux(plane, Normalized({ 0.3, 0.1, 1 }), hard), hard.TotalFlux(), 1e-12);
    EXPECT_NEAR(hard.TotalFlux(), 2 * Pi * (1 - cosine), 1e-14);
    const AxialDistribution power(2.5, cosine);
    EXPECT_NEAR(AxialFlux(plane, Normalized({ 0.3, 0.1, 1 }), power), power.TotalFlux(), 1e-12);
    EXPECT_NEAR(power.TotalFlux(), 2 * Pi * (1 - std::pow(cosine, 3.5)) / 3.5, 1e-13);
  }
  // Additivity, cut anywhere, cone crossing or not.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 200; ++k)
  {
    const double scale = std::pow(10.0, -5.0 * unit(random));
    const Vec3 a{ unit(random), unit(random), 1 };
    const Vec3 b = a + scale * Vec3{ unit(random), -unit(random), 0 };
    const Vec3 c = a + scale * Vec3{ unit(random), unit(random), 0.3 };
    const Vec3 m = b + unit(random) * (c - b);
    const AxialDistribution d(3.0 * unit(random), std::cos(0.9), k % 2 == 0, std::cos(0.5));
    const Vec3 axis = Normalized({ 0.1, 0.2, 1 });
    const double whole = AxialFlux({ a, b, c }, axis, d);
    const double parts = AxialFlux({ a, b, m }, axis, d) + AxialFlux({ a, m, c }, axis, d);
    const double omega = std::fabs(SolidAngle(a, b, c));
    EXPECT_NEAR(whole, parts, 1e-12 * omega + 1e-15 * scale) << k << " scale " << scale;
  }
}

TEST(AxialFlux, NothingOutsideTheCone)
{
  const AxialDistribution d(0.0, std::cos(0.2));
  EXPECT_EQ(AxialFlux({ { 1, 0, 1 }, { 1, 1, 1 }, { 2, 0, 1 } }, { 0, 0, 1 }, d), 0.0);
  const AxialDistribution half(1.0, -1.0); // cos^1: nothing behind
  EXPECT_EQ(AxialFlux({ { 1, 0, -1 }, { 2, 0, -1 }, { 1, 1, -1 } }, { 0, 0, 1 }, half), 0.0);
}

} // namespace
