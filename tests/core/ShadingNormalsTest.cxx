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

TEST(ShadingNormals, CellNormalByTheRightHandRule)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto normal = [](const std::vector<Vec3>& p) { return CellNormal(p.data(), p.size()); };
  EXPECT_EQ(normal({ { 0, 0, 0 }, { 2, 0, 0 }, { 0, 3, 0 } }), (Vec3{ 0, 0, 1 }));
  EXPECT_EQ(normal({ { 0, 0, 0 }, { 0, 3, 0 }, { 2, 0, 0 } }), (Vec3{ 0, 0, -1 }));
  // Concave at the first corner: its own edges turn the other way.
  EXPECT_EQ(normal({ { 1, 1, 0 }, { 0, 0, 0 }, { 4, 1, 0 }, { 0, 2, 0 } }), (Vec3{ 0, 0, 1 }));
  // Not flat: the vector area, (0, 0, 1) by symmetry.
  ExpectNear(normal({ { 1, 0, 0.1 }, { 0, 1, -0.1 }, { -1, 0, 0.1 }, { 0, -1, -0.1 } }),
    { 0, 0, 1 }, 1e-16);
  // Corners that stand twice or on a straight edge change nothing.
  EXPECT_EQ(normal({ { 0, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 0, 3, 0 } }),
    (Vec3{ 0, 0, 1 }));
  EXPECT_EQ(normal({}), Vec3{});
  EXPECT_EQ(normal({ { 0, 0, 0 }, { 1, 0, 0 } }), Vec3{});
  EXPECT_EQ(normal({ { 0, 0, 0 }, { 1, 1, 1 }, { 2, 2, 2 } }), Vec3{});
  EXPECT_EQ(normal({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, nan, 0 } }), Vec3{});
  for (const double scale : { 1e-300, 1e-160, 1e160, 1e308 })
  {
    EXPECT_EQ(normal({ { 0, 0, 0 }, { scale, 0, 0 }, { 0, scale, 0 } }), (Vec3{ 0, 0, 1 }))
      << scale;
  }
}

TEST(ShadingNormals, ByAngleItDoesNotMatterHowFacesAreCut)
{
  // A pyramid with a concave base of five corners: whole polygons, and two ways of triangles.
  std::vector<Vec3> points{ { 0, 0, 0 }, { 3, 0, 0 }, { 3, 2, 0 }, { 1, 0.5, 0 }, { 0, 2, 0 },
    { 1, 0.3, 2 } };
  const std::vector<std::vector<std::int64_t>> sides{ { 0, 1, 5 }, { 1, 2, 5 }, { 2, 3, 5 },
    { 3, 4, 5 }, { 4, 0, 5 } };
  const auto compute = [&](std::vector<std::vector<std::int64_t>> cells) {
    cells.insert(cells.end(), sides.begin(), sides.end());
    std::vector<std::int64_t> offsets{ 0 };
    std::vector<std::int64_t> corners;
    for (const auto& cell : cells)
    {
      corners.insert(corners.end(), cell.begin(), cell.end());
      offsets.push_back(static_cast<std::int64_t>(corners.size()));
    }
    return ComputeVertexNormals(points, offsets, corners, NormalWeight::Angle);
  };
  const auto whole = compute({ { 4, 3, 2, 1, 0 } });
  const auto one = compute({ { 4, 3, 0 }, { 3, 1, 0 }, { 3, 2, 1 } });
  const auto two = compute({ { 4, 3, 0 }, { 3, 2, 1, 0 } });
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    ExpectNear(one[i], whole[i], 1e-15);
    ExpectNear(two[i], whole[i], 1e-15);
  }
}

TEST(ShadingNormals, UniformCountsCells)
{
  const std::vector<Vec3> points{ { 0, 0, 0 }, { 0, 1, 0 }, { -2, 0, 0 }, { 0, 0, -6 } };
  const Triangles triangles{ { { 0, 1, 2 } }, { { 1, 0, 3 } } };
  ExpectNear(ComputeVertexNormals(points, triangles, NormalWeight::Uniform)[1],
    Normalized({ 1.0, 0.0, 1.0 }), 1e-15);
  // The cut side counts twice: two triangles along x against one along z.
  const Triangles cut{ { { 0, 1, 2 } }, { { 1, 4, 3 } }, { { 1, 0, 4 } } };
  const std::vector<Vec3> more{ { 0, 0, 0 }, { 0, 1, 0 }, { -2, 0, 0 }, { 0, 0, -6 }, { 0, 0, -3 } };
  ExpectNear(ComputeVertexNormals(more, cut, NormalWeight::Uniform)[1],
    Normalized({ 2.0, 0.0, 1.0 }), 1e-15);
  ExpectNear(ComputeVertexNormals(more, cut, NormalWeight::Area)[1],
    Normalized({ 3.0, 0.0, 1.0 }), 1e-15);
}

TEST(ShadingNormals, EveryScaleGivesTheSame)
{
  for (const auto weight : { NormalWeight::Angle, NormalWeight::Area, NormalWeight::Uniform })
  {
    std::vector<Vec3> points;
    Triangles triangles;
    Cube(false, points, triangles);
    for (Vec3& p : points)
    {
      p.z *= 3.0;
    }
    const auto reference = ComputeVertexNormals(points, triangles, weight);
    for (const double scale : { 1e-280, 1e-150, 1e150, 1e300 })
    {
      std::vector<Vec3> scaled;
      for (const Vec3& p : points)
      {
        scaled.push_back(scale * p);
      }
      const auto normals = ComputeVertexNormals(scaled, triangles, weight);
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        ExpectNear(normals[i], reference[i], 1e-14);
      }
    }
  }
}

TEST(ShadingNormals, OnASphereAllWeightsApproachTheRadius)
{
  // A sphere in longitudes and latitudes: long thin triangles at the poles.
  double last[3] = { 1.0, 1.0, 1.0 };
  for (const int n : { 8, 16, 32 })
  {
    std::vector<Vec3> points{ { 0, 0, 1 }, { 0, 0, -1 } };
    Triangles triangles;
    const auto at = [&](int i, int j) { return 2 + (i - 1) * 2 * n + (j % (2 * n)); };
    for (int i = 1; i < n; ++i)
    {
      for (int j = 0; j < 2 * n; ++j)
      {
        const double t = i * 3.14159265358979 / n;
        const double p = j * 3.14159265358979 / n;
        points.push_back({ std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t) });
      }
    }
    for (int j = 0; j < 2 * n; ++j)
    {
      triangles.push_back({ { 0, at(1, j), at(1, j + 1) } });
      triangles.push_back({ { 1, at(n - 1, j + 1), at(n - 1, j) } });
      for (int i = 1; i + 1 < n; ++i)
      {
        triangles.push_back({ { at(i, j), at(i + 1, j), at(i + 1, j + 1) } });
        triangles.push_back({ { at(i, j), at(i + 1, j + 1), at(i, j + 1) } });
      }
    }
    for (int w = 0; w < 3; ++w)
    {
      const auto normals = ComputeVertexNormals(points, triangles, static_cast<NormalWeight>(w));
      double worst = 0.0;
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        EXPECT_NEAR(Length(normals[i]), 1.0, 1e-15);
        worst = std::max(worst, Length(normals[i] - points[i]));
      }
      EXPECT_LT(worst, 0.6 * last[w]) << n << " " << w;
      last[w] = worst;
    }
    // By angle the cut of a quad into triangles leaves less behind.
    EXPECT_LT(last[0], last[1]) << n;
    EXPECT_LT(last[0], last[2]) << n;
  }
}

TEST(ShadingNormals, SeparateSheetsRepeatsPoints)
{
  // Two triangles at an edge, on two sheets; the first keeps the points.
  const std::vector<std::int64_t> corners{ 0, 1, 2, 1, 0, 3, 0, 1, 2 };
  const auto result = SeparateSheets(5, corners, { 7, 8, 9, 10, 11, 12, 7, 8, 9 });
  EXPECT_EQ(result.Source, (std::vector<std::int64_t>{ 0, 1, 2, 3, 4, 1, 0 }));
  EXPECT_EQ(result.Corners, (std::vector<std::int64_t>{ 0, 1, 2, 5, 6, 3, 0, 1, 2 }));
  EXPECT_EQ(result.Sheet, (std::vector<std::int64_t>{ 7, 8, 9, 12, -1, 10, 11 }));
  const auto none = SeparateSheets(2, {}, {});
  EXPECT_EQ(none.Sheet, (std::vector<std::int64_t>{ -1, -1 }));
}

TEST(ShadingNormals, TransformOfAnySize)
{
  for (const double s : { 1e-300, 1e-120, 1e120, 1e300 })
  {
    const Matrix3 m{ { { { s, 0, 0 } }, { { 0, 1, 0 } }, { { 0, 0, -1 / s } } } };
    ExpectNear(TransformNormal(m, { 0, 1, 0 }), { 0, 1, 0 }, 1e-15);
    ExpectNear(TransformNormal(m, { 0, 0, 1 }), { 0, 0, -1 }, 1e-15); // a mirror in z
    const Matrix3 all{ { { { s, 0, 0 } }, { { 0, s, 0 } }, { { 0, 0, s } } } };
    ExpectNear(TransformNormal(all, { 3 * s, 0, 4 * s }), { 0.6, 0, 0.8 }, 1e-15);
  }
}
