// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/shading/VertexNormals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace radiometry;

namespace
{

using Triangles = std::vector<std::array<std::int32_t, 3>>;

void ExpectNear(const Vec3& a, const Vec3& b, double tolerance)
{
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

/// Unit cube with outward faces, each cut along one diagonal or the other.
void Cube(bool otherDiagonal, std::vector<Vec3>& points, Triangles& triangles)
{
  for (int i = 0; i < 8; ++i)
  {
    points.push_back({ i & 1 ? 1.0 : 0.0, i & 2 ? 1.0 : 0.0, i & 4 ? 1.0 : 0.0 });
  }
  const int quads[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 },
    { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
  for (const auto& q : quads)
  {
    if (otherDiagonal)
    {
      triangles.push_back({ { q[0], q[1], q[2] } });
      triangles.push_back({ { q[0], q[2], q[3] } });
    }
    else
    {
      triangles.push_back({ { q[1], q[2], q[3] } });
      triangles.push_back({ { q[1], q[3], q[0] } });
    }
  }
}

} // namespace

TEST(ShadingNormals, ByAngleACubesCornersLookAlongItsDiagonals)
{
  for (const bool other : { false, true })
  {
    std::vector<Vec3> points;
    Triangles triangles;
    Cube(other, points, triangles);
    const auto normals = ComputeVertexNormals(points, triangles, NormalWeight::Angle);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      ExpectNear(normals[i], Normalized(points[i] - Vec3{ 0.5, 0.5, 0.5 }), 1e-15);
    }
  }
}

TEST(ShadingNormals, ByAreaWeighsTriangles)
{
  // Two triangles at one edge: one of area 1 facing z, one of area 3 facing x.
  const std::vector<Vec3> points{ { 0, 0, 0 }, { 0, 1, 0 }, { -2, 0, 0 }, { 0, 0, -6 } };
  const Triangles triangles{ { { 0, 1, 2 } }, { { 1, 0, 3 } } };
  const auto byArea = ComputeVertexNormals(points, triangles, NormalWeight::Area);
  ExpectNear(byArea[0], Normalized({ 3.0, 0.0, 1.0 }), 1e-15);
  const auto byAngle = ComputeVertexNormals(points, triangles, NormalWeight::Angle);
  ExpectNear(byAngle[0], Normalized({ 1.0, 0.0, 1.0 }), 1e-15); // two right angles
}

TEST(ShadingNormals, DegenerateAndIsolatedPointsGetZero)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> points{ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 5, 5, 5 },
    { nan, 0, 0 } };
  const auto normals =
    ComputeVertexNormals(points, { { { 0, 1, 2 } }, { { 0, 1, 1 } }, { { 0, 1, 4 } } });
  for (const Vec3& n : normals)
  {
    EXPECT_EQ(n, Vec3{});
  }
  // Two sheets back to back cancel out.
  const auto cancelled = ComputeVertexNormals(
    { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { { { 0, 1, 2 } }, { { 0, 2, 1 } } });
  EXPECT_EQ(cancelled[0], Vec3{});
  EXPECT_TRUE(ComputeVertexNormals({}, {}).empty());
}

TEST(ShadingNormals, FarAwayAndTinyMeshesKeepTheirNormals)
{
  std::vector<Vec3> points;
  Triangles triangles;
  Cube(false, points, triangles);
  const auto reference = ComputeVertexNormals(points, triangles);
  for (Vec3& p : points)
  {
    p = Vec3{ 500000.0, 4000000.0, 100.0 } + p;
  }
  auto moved = ComputeVertexNormals(points, triangles);
  for (Vec3& p : points)
  {
    p = 1e-9 * (p - Vec3{ 500000.0, 4000000.0, 100.0 });
  }
  const auto small = ComputeVertexNormals(points, triangles);
  for (std::size_t i = 0; i < reference.size(); ++i)
  {
    ExpectNear(moved[i], reference[i], 1e-9);
    ExpectNear(small[i], reference[i], 1e-7);
  }
}

TEST(ShadingNormals, TransformStaysPerpendicularToTheSurface)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-2.0, 2.0);
  for (int i = 0; i < 500; ++i)
  {
    Matrix3 m;
    for (auto& row : m)
    {
      row = { { u(random), u(random), u(random) } };
    }
    const auto apply = [&m](const Vec3& v) {
      return Vec3{ m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
        m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
        m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z };
    };
    const Vec3 a{ u(random), u(random), u(random) };
    const Vec3 b{ u(random), u(random), u(random) };
    const Vec3 n = Cross(a, b);
    const Vec3 carried = TransformNormal(m, n);
    EXPECT_NEAR(Length(carried), 1.0, 1e-14);
    EXPECT_NEAR(Dot(carried, Normalized(apply(a))), 0.0, 1e-12);
    EXPECT_NEAR(Dot(carried, Normalized(apply(b))), 0.0, 1e-12);
    EXPECT_GT(Dot(carried, apply(n)), 0.0); // on the side it was on, mirrors included
  }
}

TEST(ShadingNormals, TransformHardCases)
{
  const Matrix3 mirror{ { { { -1, 0, 0 } }, { { 0, 1, 0 } }, { { 0, 0, 1 } } } };
  ExpectNear(TransformNormal(mirror, { 2, 0, 0 }), { -1, 0, 0 }, 0.0);
  ExpectNear(TransformNormal(mirror, { 0, 0, 3 }), { 0, 0, 1 }, 0.0);
  const Matrix3 flatten{ { { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { 0, 0, 0 } } } };
  ExpectNear(TransformNormal(flatten, { 0, 0, 1 }), { 0, 0, 1 }, 0.0);
  EXPECT_EQ(TransformNormal(flatten, { 1, 0, 0 }), Vec3{}); // its plane has become a line
  EXPECT_EQ(TransformNormal(mirror, {}), Vec3{});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(TransformNormal(mirror, { nan, 0, 1 }), Vec3{});
  const Matrix3 huge{ { { { 1e150, 0, 0 } }, { { 0, 1e150, 0 } }, { { 0, 0, 1e150 } } } };
  ExpectNear(TransformNormal(huge, { 0, 1, 0 }), { 0, 1, 0 }, 1e-15);
}
