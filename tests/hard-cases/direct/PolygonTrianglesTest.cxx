// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/PolygonTriangles.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

using namespace radiometry;

namespace
{

using Triangles = std::vector<std::array<std::int32_t, 3>>;

Vec3 VectorArea2(const std::vector<Vec3>& p)
{
  Vec3 sum;
  for (std::size_t k = 1; k + 1 < p.size(); ++k)
  {
    sum += Cross(p[k] - p[0], p[k + 1] - p[0]);
  }
  return sum;
}

/// The triangles turn as the polygon does and their areas add up to its own: with no turn against it,
/// that leaves no room for overlaps or gaps.
void ExpectTiles(const std::vector<Vec3>& p, const char* what)
{
  const Triangles triangles = PolygonTriangles(p);
  ASSERT_FALSE(triangles.empty()) << what;
  const Vec3 area = VectorArea2(p);
  const Vec3 n = Normalized(area);
  double sum = 0.0;
  for (const auto& t : triangles)
  {
    const double turn = Dot(n, AreaNormal2({ p[t[0]], p[t[1]], p[t[2]] }));
    EXPECT_GT(turn, -1e-15 * Length(area)) << what;
    sum += turn;
  }
  EXPECT_NEAR(sum / Length(area), 1.0, 1e-12) << what;
}

TEST(PolygonTriangles, ConvexConcaveAndStars)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.05, 1.0);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 200; ++round)
  {
    const int n = 4 + round % 40;
    const Vec3 u = Normalized({ normal(random), normal(random), normal(random) });
    const Vec3 v = Normalized(Cross(u, { normal(random), normal(random), normal(random) }));
    std::vector<Vec3> p;
    for (int k = 0; k < n; ++k)
    {
      const double angle = 2 * std::acos(-1.0) * k / n;
      const double r = round % 3 == 0 ? 1.0 : unit(random); // every third one convex
      p.push_back(r * (std::cos(angle) * u + std::sin(angle) * v) + 100.0 * u);
    }
    ExpectTiles(p, "star");
  }
}

TEST(PolygonTriangles, NeedlesStraightCornersAndKeyholes)
{
  for (const double w : { 1e-6, 1e-9, 1e-12 })
  {
    ExpectTiles({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, w, 0 }, { 0, w, 0 } }, "needle");
    ExpectTiles({ { 0, 0, 0 }, { 0.5, 0, 0 }, { 1, 0, 0 }, { 1, w, 0 }, { 0.3, w, 0 }, { 0, w, 0 } },
      "needle with straight corners");
  }
  ExpectTiles({ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 1, 2, 0 }, { 0, 2, 0 },
                { 0, 1, 0 } },
    "straight corners");
  ExpectTiles({ { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, 0, 0 }, { 0.5, 1, 0 } }, "spike");
  // A square with a square hole, the cut walked twice.
  ExpectTiles({ { 0, 0, 0 }, { 3, 0, 0 }, { 3, 3, 0 }, { 0, 3, 0 }, { 0, 0, 0 }, { 1, 1, 0 },
                { 1, 2, 0 }, { 2, 2, 0 }, { 2, 1, 0 }, { 1, 1, 0 } },
    "keyhole");
  // A dart: only one of a quad's diagonals is inside.
  const Triangles dart = PolygonTriangles({ { 0, 0, 0 }, { 2, 1, 0 }, { 0, 2, 0 }, { 0.5, 1, 0 } });
  EXPECT_EQ(dart, (Triangles{ { 0, 1, 3 }, { 1, 2, 3 } }));
}

TEST(PolygonTriangles, NotQuiteFlatKeepsItsRim)
{
  // Whatever the cut, the vector area is that of the rim.
  const std::vector<Vec3> p{ { 0, 0, 0.1 }, { 1, 0, -0.2 }, { 1.2, 0.9, 0.3 }, { 0.3, 0.4, 0 },
    { 0, 1, -0.1 } };
  Vec3 sum;
  for (const auto& t : PolygonTriangles(p))
  {
    sum += AreaNormal2({ p[t[0]], p[t[1]], p[t[2]] });
  }
  EXPECT_NEAR(Length(sum - VectorArea2(p)), 0.0, 1e-15);
}

TEST(PolygonTriangles, WithoutAreaOrCrossing)
{
  EXPECT_TRUE(PolygonTriangles({}).empty());
  EXPECT_TRUE(PolygonTriangles({ { 0, 0, 0 }, { 1, 0, 0 } }).empty());
  EXPECT_TRUE(PolygonTriangles({ { 0, 0, 0 }, { 1, 1, 1 }, { 2, 2, 2 }, { 3, 3, 3 } }).empty());
  EXPECT_TRUE(PolygonTriangles({ { 1, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 } }).empty());
  EXPECT_TRUE(PolygonTriangles({ { 0, 0, 0 }, { 1, 1, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }).empty());
  EXPECT_TRUE(PolygonTriangles({ { 0, 0, 0 }, { 2, 1.5, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }).empty());
  std::vector<Vec3> pentagram;
  for (int k = 0; k < 5; ++k)
  {
    const double angle = 4 * std::acos(-1.0) * k / 5;
    pentagram.push_back({ std::cos(angle), std::sin(angle), 0 });
  }
  EXPECT_TRUE(PolygonTriangles(pentagram).empty());
}

TEST(PolygonTriangles, TurningAndScalingKeepTheCut)
{
  const std::vector<Vec3> p{ { 0, 0, 0.1 }, { 1, 0, 0 }, { 1, 1, 0.1 }, { 0, 1, 0 } };
  const Triangles reference = PolygonTriangles(p);
  for (const double s : { 1e-6, 0.3, 7e8 })
  {
    std::vector<Vec3> q;
    for (const Vec3& c : p)
    {
      q.push_back(s * Vec3{ 0.6 * c.x - 0.8 * c.z, c.y, 0.8 * c.x + 0.6 * c.z } + Vec3{ s, -s, s });
    }
    EXPECT_EQ(PolygonTriangles(q), reference);
  }
}

} // namespace
