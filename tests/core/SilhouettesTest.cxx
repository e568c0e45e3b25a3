// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/DirectIrradiance.h"
#include "radiometry/irradiance/Silhouettes.h"
#include "radiometry/visibility/OcclusionScene.h"
#include "tests/core/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <tuple>

using namespace radiometry;

namespace
{

/// A room with round and flat things in it, some of them cutting through others.
test::Mesh Furnished()
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 4, 4, 3 }, 9, true);
  mesh.AddSphere({ 1, 2, 1 }, 0.5, 12, false);
  mesh.AddSphere({ 3, 1, 0.2 }, 0.6, 10, false); // through the floor
  mesh.AddBox({ 2.3, 2.4, 0 }, { 3.1, 3.0, 1.1 }, 3, false);
  mesh.AddGrid({ 0.5, 0.5, 1.7 }, { 1.1, 0.2, 0.1 }, { -0.1, 0.9, 0.2 }, 4, 3);
  return mesh;
}

Light At(const Scene& scene, const Vec3& position)
{
  Light light;
  light.Position = position - scene.Origin;
  light.Intensity = { 1.0 };
  return light;
}

using Key = std::array<double, 6>;
Key KeyOf(const Segment3& s)
{
  const bool swap = std::tie(s.B.x, s.B.y, s.B.z) < std::tie(s.A.x, s.A.y, s.A.z);
  const Vec3& a = swap ? s.B : s.A;
  const Vec3& b = swap ? s.A : s.B;
  return { a.x, a.y, a.z, b.x, b.y, b.z };
}

TEST(ShadowLines, EveryEdgeHasOneOwnerAndFoldsArePaired)
{
  test::Mesh mesh = Furnished();
  mesh.Triangles.push_back(mesh.Triangles[5]); // a duplicate
  const Scene scene = mesh.ToScene();
  const OcclusionScene occluders(scene);
  const ShadowLines& lines = occluders.Lines(scene, 0);
  struct Sharing
  {
    int Owners = 0;
    std::vector<std::int32_t> Opposite;
  };
  std::map<std::pair<std::int32_t, std::int32_t>, Sharing> edges;
  for (std::size_t e = 0; e < 3 * scene.Triangles.size(); ++e)
  {
    const auto& t = scene.Triangles[e / 3];
    const std::int32_t a = t[e % 3];
    const std::int32_t b = t[(e % 3 + 1) % 3];
    Sharing& s = edges[{ std::min(a, b), std::max(a, b) }];
    s.Owners += lines.Owns(e) ? 1 : 0;
    s.Opposite.push_back(t[(e % 3 + 2) % 3]);
    const std::int32_t twin = lines.Across(e);
    if (twin >= 0)
    {
      EXPECT_EQ(lines.Across(static_cast<std::size_t>(twin)), static_cast<std::int32_t>(e));
      const auto& u = scene.Triangles[twin / 3];
      EXPECT_TRUE(std::find(u.begin(), u.end(), a) != u.end());
      EXPECT_TRUE(std::find(u.begin(), u.end(), b) != u.end());
    }
  }
  for (auto& [key, s] : edges)
  {
    EXPECT_EQ(s.Owners, 1);
    std::sort(s.Opposite.begin(), s.Opposite.end());
    s.Opposite.erase(std::unique(s.Opposite.begin(), s.Opposite.end()), s.Opposite.end());
  }
}

TEST(Silhouettes, OnDemandFindsWhatTheWholeListHolds)
{
  const Scene scene = Furnished().ToScene();
  const OcclusionScene occluders(scene);
  const ShadowLines& lines = occluders.Lines(scene, 0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::size_t total = 0;
  for (int k = 0; k < 200; ++k)
  {
    Light light = At(scene, { 4 * unit(random), 4 * unit(random), 3 * unit(random) });
    if (k % 4 == 0)
    {
      light.Type = LightType::Directional;
      light.Direction = Normalized({ unit(random) - 0.5, unit(random) - 0.5, -1 });
    }
    const Silhouettes outline(scene, lines, light);
    for (int j = 0; j < 30; ++j)
    {
      const auto t = static_cast<std::size_t>(unit(random) * 972.0); // the room
      const LightShaft shaft = LightShaft::OfTriangle(scene.TriangleAt(t), light, lines.Tolerance());
      std::vector<Key> wanted;
      for (std::size_t e = 0; e < 3 * scene.Triangles.size(); ++e)
      {
        const auto& v = scene.Triangles[e / 3];
        const Segment3 s{ scene.Points[v[e % 3]], scene.Points[v[(e % 3 + 1) % 3]] };
        if (lines.Owns(e) && outline.Bounds(e) && shaft.Touches(s))
        {
          wanted.push_back(KeyOf(s));
        }
      }
      std::vector<Segment3> found;
      EXPECT_TRUE(outline.InShaft(scene.TriangleAt(t), 100000, found));
      std::vector<Key> got;
      for (const Segment3& s : found)
      {
        got.push_back(KeyOf(s));
      }
      std::sort(wanted.begin(), wanted.end());
      std::sort(got.begin(), got.end());
      EXPECT_EQ(wanted, got);
      total += got.size();
    }
  }
  EXPECT_GT(total, 1000u); // the comparison was not of nothing with nothing
}

TEST(LightShaft, OfAClusterHoldsThoseOfItsTriangles)
{
  const Scene scene = Furnished().ToScene();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int made = 0;
  for (int k = 0; k < 300; ++k)
  {
    const auto first = static_cast<std::size_t>(unit(random) * 900.0);
    std::vector<Vec3> points;
    Vec3 normal;
    std::vector<Triangle3> triangles;
    for (std::size_t t = first; t < first + 6; ++t)
    {
      triangles.push_back(scene.TriangleAt(t));
      normal += AreaNormal2(triangles.back());
      points.insert(points.end(), triangles.back().begin(), triangles.back().end());
    }
    Light light = At(scene, { 4 * unit(random), 4 * unit(random), 3 * unit(random) });
    if (k % 3 == 0)
    {
      light.Type = LightType::Directional;
      light.Direction = Normalized({ unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5 });
    }
    LightShaft shaft;
    if (!LightShaft::OfCluster(points.data(), points.size(), Normalized(normal), light, 1e-13, shaft))
    {
      continue;
    }
    ++made;
    for (const Triangle3& t : triangles)
    {
      for (int j = 0; j < 20; ++j)
      {
        // A short line across the way from a point of the triangle to the light.
        const double u = unit(random);
        const double v = (1 - u) * unit(random);
        const Vec3 p = (1 - u - v) * t[0] + u * t[1] + v * t[2];
        const Vec3 toLight = light.Type == LightType::Directional ? -3.0 * light.Direction
                                                                  : light.Position - p;
        const Vec3 n = Normalized(normal);
        if (Dot(n, toLight) <= 0.0)
        {
          continue;
        }
        const Vec3 q = p + 0.999 * unit(random) * toLight;
        const Vec3 across{ unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5 };
        EXPECT_TRUE(shaft.Touches({ q - across, q + across }));
        Box3 box;
        box.Add(q);
        EXPECT_TRUE(shaft.Reaches(box));
      }
    }
  }
  EXPECT_GT(made, 150);
}

TEST(ShadowLines, ALineThatStandsOnAFaceCutsIt)
{
  // A wall in two halves, of which one ends and the other begins in the floor's plane: the edge
  // between them is no silhouette, and neither half passes through the floor.
  test::Mesh mesh;
  mesh.AddGrid({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1);
  mesh.AddGrid({ 0.2, -3, -2 }, { 0, 6, 0 }, { 0, 0, 4 }, 1, 2);
  Scene scene = mesh.ToScene();
  const OcclusionScene occluders(scene);
  EXPECT_TRUE(occluders.Lines(scene, 0).Crossed(0));
  Light sun;
  sun.Type = LightType::Directional;
  sun.Direction = Normalized({ -1, 0, -1e-3 });
  sun.Intensity = { 1.0 };
  scene.Lights = { sun };
  // The sun at x > 0 lights the floor's part of x > 0.2 only.
  std::vector<Patch> floor;
  for (std::int32_t t = 0; t < 2; ++t)
  {
    floor.push_back({ scene.TriangleAt(t), t, t, 0 });
  }
  const DirectResult r = ComputeDirectIrradiance(scene, occluders, floor, {});
  const double flux = r.Irradiance[0] * 2 + r.Irradiance[1] * 2;
  EXPECT_NEAR(flux / (0.8 * 2 * -sun.Direction.z), 1.0, 1e-9);
}

TEST(DirectIrradiance, PatchesTogetherAndOneByOneAgree)
{
  // Alone, a patch has a shaft and a ray of its own; together, clusters are decided at once.
  Scene scene = Furnished().ToScene();
  scene.Lights = { At(scene, { 2, 2, 2.5 }), At(scene, { 0.3, 3.7, 0.4 }) };
  Light sun;
  sun.Type = LightType::Directional;
  sun.Direction = Normalized({ 0.3, 0.1, -1 });
  sun.Intensity = { 0.2 };
  scene.Lights.push_back(sun);
  const OcclusionScene occluders(scene);
  std::vector<Patch> patches;
  for (std::size_t t = 0; t < scene.Triangles.size(); ++t)
  {
    patches.push_back({ scene.TriangleAt(t), static_cast<std::int32_t>(t), 0, 0 });
  }
  DirectOptions options;
  options.RelativeTolerance = 1e-6;
  const DirectResult together = ComputeDirectIrradiance(scene, occluders, patches, options);
  double largest = 0.0;
  for (std::size_t t = 0; t < patches.size(); ++t)
  {
    const DirectResult alone = ComputeDirectIrradiance(
      scene, occluders, std::vector<Patch>{ patches[t] }, options);
    EXPECT_NEAR(together.Irradiance[t], alone.Irradiance[0], 1e-12 + 2e-6 * alone.Irradiance[0])
      << t;
    largest = std::max(largest, alone.Irradiance[0]);
  }
  EXPECT_GT(largest, 0.1);
  EXPECT_LT(static_cast<double>(together.Rays), 3.0 * static_cast<double>(patches.size()));
}

} // namespace
