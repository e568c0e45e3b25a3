// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/OcclusionScene.h"

#include "tests/core/TestScenes.h"

#include <gtest/gtest.h>

#include <random>

using namespace radiometry;

namespace
{

RayEnd OnTriangle(const Scene& scene, std::int32_t t, double u, double v)
{
  const Triangle3 c = scene.TriangleAt(t);
  return { (1.0 - u - v) * c[0] + u * c[1] + v * c[2], t };
}

TEST(Visibility, PlateHidesWhatIsBehindIt)
{
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  const Scene scene = mesh.ToScene();
  const OcclusionScene occluders(scene);
  const auto end = [&](double x, double y, double z) {
    return RayEnd{ Vec3{ x, y, z } - scene.Origin, -1 };
  };
  EXPECT_TRUE(occluders.Occluded(end(0.3, 0.4, 1), end(0.3, 0.4, -1)));
  EXPECT_TRUE(occluders.Occluded(end(0.5, 0.5, 1), end(0.5, 0.5, -1))); // on the diagonal
  EXPECT_FALSE(occluders.Occluded(end(1.3, 0.4, 1), end(1.3, 0.4, -1)));
  EXPECT_FALSE(occluders.Occluded(end(0.3, 0.4, 1), end(0.3, 0.4, 1e-9)));
  EXPECT_TRUE(occluders.Occluded(end(0.3, 0.4, 1e-9), end(0.3, 0.4, -1e-9)));
  EXPECT_TRUE(occluders.Occluded(end(0.3, 0.4, 1e9), end(0.3, 0.4, -1e9)));
  EXPECT_FALSE(occluders.Occluded(end(0.3, 0.4, 0), end(0.3, 0.4, -1))); // starts on the plane
  EXPECT_TRUE(occluders.OccludedDirection(end(0.3, 0.4, 5), { 0, 0, -1e-3 }));
  EXPECT_FALSE(occluders.OccludedDirection(end(0.3, 0.4, 5), { 0, 0, 1 }));
  const SurfaceHit hit = occluders.Closest(end(0.75, 0.25, 2), { 0, 0, -2 });
  ASSERT_GE(hit.Triangle, 0);
  EXPECT_TRUE(hit.Front);
  EXPECT_NEAR(hit.Distance, 1.0, 1e-12);
  const Triangle3 t = scene.TriangleAt(hit.Triangle);
  const Vec3 p = (1 - hit.U - hit.V) * t[0] + hit.U * t[1] + hit.V * t[2] + scene.Origin;
  EXPECT_NEAR(p.x, 0.75, 1e-12);
  EXPECT_NEAR(p.y, 0.25, 1e-12);
}

/// A closed box: from points on its inside faces no light outside is seen, however near the points
/// are to edges and corners and the light to the wall; all of the inside is seen.
void ClosedBox(const Vec3& offset, double size)
{
  test::Mesh mesh;
  mesh.AddBox(offset, offset + Vec3{ size, size, size }, 4, true);
  const Scene scene = mesh.ToScene();
  const OcclusionScene occluders(scene);
  const Vec3 low = offset - scene.Origin;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int leaks = 0;
  int shadows = 0;
  for (int k = 0; k < 40000; ++k)
  {
    const auto t = static_cast<std::int32_t>(random() % scene.Triangles.size());
    // Half of the points lie within 1e-7 of a corner or an edge of their cell.
    const double near = k % 2 ? 1e-7 : 1.0;
    double u = near * unit(random);
    double v = (k % 4 == 1 ? 1e-7 : 1.0) * unit(random);
    if (u + v > 1.0)
    {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const RayEnd from = OnTriangle(scene, t, u, v);
    const Vec3 inside = low + size * Vec3{ unit(random), unit(random), unit(random) };
    shadows += occluders.Occluded(from, { inside, -1 }) ? 1 : 0;
    // A light 1e-4 of the size behind one of the walls.
    Vec3 outside = inside;
    const int axis = static_cast<int>(random() % 3);
    outside[axis] = random() % 2 ? low[axis] - 1e-4 * size : low[axis] + (1.0 + 1e-4) * size;
    const Vec3 n = AreaNormal2(scene.TriangleAt(t));
    if (Dot(n, outside - from.Point) > 0.0) // before the receiver: only the other walls hide it
    {
      leaks += occluders.Occluded(from, { outside, -1 }) ? 0 : 1;
    }
  }
  EXPECT_EQ(leaks, 0);
  EXPECT_EQ(shadows, 0);
}

TEST(Visibility, ClosedBoxNeitherLeaksNorShadowsItself)
{
  ClosedBox({ 0, 0, 0 }, 1.0);
}
TEST(Visibility, ClosedBoxInUtmCoordinates)
{
  ClosedBox({ 5e5, 4e6, 100 }, 10.0);
}
TEST(Visibility, ClosedBoxTiny)
{
  ClosedBox({ 0, 0, 0 }, 1e-6);
}
TEST(Visibility, ClosedBoxHuge)
{
  ClosedBox({ -3e8, 1e8, 0 }, 1e9);
}

TEST(Visibility, CoplanarAndDuplicateFacesDoNotHideEachOther)
{
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 3);
  mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 3);
  mesh.AddGrid({ 0.1, 0.1, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2);
  const Scene scene = mesh.ToScene();
  const OcclusionScene occluders(scene);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 20000; ++k)
  {
    const auto t = static_cast<std::int32_t>(random() % scene.Triangles.size());
    const double u = unit(random);
    const RayEnd from = OnTriangle(scene, t, u, (1.0 - u) * unit(random));
    // From straight up to 1e-6 rad above the plane.
    const double height = std::pow(10.0, -6.0 * unit(random));
    EXPECT_FALSE(occluders.OccludedDirection(from, { unit(random) - 0.5, unit(random) - 0.5, height }));
  }
}

TEST(Visibility, ConvexSurfaceSeenFromOutsideIsNotHiddenByItself)
{
  test::Mesh mesh;
  mesh.AddSphere({ 0, 0, 0 }, 1.0, 40, false);
  const Scene scene = mesh.ToScene();
  const OcclusionScene occluders(scene);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 20000; ++k)
  {
    const auto t = static_cast<std::int32_t>(random() % scene.Triangles.size());
    const double u = unit(random);
    const RayEnd from = OnTriangle(scene, t, u, (1.0 - u) * unit(random));
    const Vec3 d{ unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5 };
    const double cosine = Dot(Normalized(d), Normalized(AreaNormal2(scene.TriangleAt(t))));
    if (cosine > 1e-9)
    {
      EXPECT_FALSE(occluders.OccludedDirection(from, d));
    }
    else if (cosine < -1e-3)
    {
      EXPECT_TRUE(occluders.OccludedDirection(from, d));
    }
  }
}

TEST(Visibility, EmptySceneHidesNothing)
{
  const Scene scene;
  const OcclusionScene occluders(scene);
  EXPECT_FALSE(occluders.Occluded({ { 0, 0, 0 }, -1 }, { { 1, 1, 1 }, -1 }));
  EXPECT_EQ(occluders.Closest({ { 0, 0, 0 }, -1 }, { 0, 0, 1 }).Triangle, -1);
}

} // namespace
