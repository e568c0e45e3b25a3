// SPDX-License-Identifier: BSD-3-Clause
// What panes let through along a ray: layers, shared edges, folds, coincident faces, far places.
#include "radiometry/visibility/OcclusionScene.h"

#include "tests/core/TestScenes.h"

#include <gtest/gtest.h>

#include <random>

using namespace radiometry;

namespace
{

/// The scene of a mesh whose triangles let through these shares (each of some bands).
Scene Glass(const test::Mesh& mesh, const std::vector<std::vector<double>>& shares)
{
  Scene scene = mesh.ToScene(0.0);
  scene.Optics.Bands = static_cast<int>(shares.front().size());
  for (auto& side : scene.Optics.DiffuseReflectance)
  {
    side.assign(scene.Cells * shares.front().size(), 0.0);
  }
  for (std::size_t t = 0; t < scene.Triangles.size(); ++t)
  {
    const auto& share = shares[scene.TriangleCell[t] < static_cast<int>(shares.size())
        ? scene.TriangleCell[t]
        : shares.size() - 1];
    scene.TriangleTransmittance.insert(
      scene.TriangleTransmittance.end(), share.begin(), share.end());
  }
  scene.Optics.Transmittance = scene.TriangleTransmittance;
  return scene;
}

Scene Glass(const test::Mesh& mesh, double share)
{
  return Glass(mesh, std::vector<std::vector<double>>(mesh.Triangles.size(), { share }));
}

/// What gets through between two free points given in the mesh's coordinates; 0: nothing.
double Through(const Scene& scene, const OcclusionScene& occluders, const Vec3& from, const Vec3& to)
{
  double band = -1.0;
  const RayEnd a{ from - scene.Origin, -1, occluders.TooClose(from - scene.Origin) };
  const RayEnd b{ to - scene.Origin, -1, occluders.TooClose(to - scene.Origin) };
  return occluders.Visible(a, b, &band) ? band : 0.0;
}

TEST(Transmission, LayersMultiplyWhereverTheRayGoes)
{
  // Grids whose edges and corners the rays hit exactly, at round coordinates.
  for (int layers = 1; layers <= 40; layers += 13)
  {
    test::Mesh mesh;
    for (int k = 0; k < layers; ++k)
    {
      mesh.AddGrid({ 0, 0, 0.125 * k }, { 8, 0, 0 }, { 0, 8, 0 }, 8, 8);
    }
    const Scene scene = Glass(mesh, 0.5);
    const OcclusionScene occluders(scene);
    const double expected = std::exp2(-layers);
    for (int i = 1; i < 32; ++i)
    {
      for (int j = 1; j < 32; ++j)
      {
        const double x = 0.25 * i;
        const double y = 0.25 * j;
        EXPECT_EQ(Through(scene, occluders, { x, y, -1 }, { x, y, 6 }), expected) << x << ' ' << y;
        EXPECT_EQ(Through(scene, occluders, { 4, 4, -1 }, { x, y, 6 }), expected) << x << ' ' << y;
      }
    }
    EXPECT_EQ(Through(scene, occluders, { 9, 4, -1 }, { 9, 4, 6 }), 1.0);
  }
}

TEST(Transmission, EveryRayThroughAClosedBodyCrossesTwoSheets)
{
  // A round body: between outside points a convex body is crossed twice or not at all; toward its
  // corners and edges, too. From the middle, once.
  for (const Vec3& place : { Vec3{ 0, 0, 0 }, Vec3{ 5e5, 4e6, 100 } })
  {
    test::Mesh mesh;
    mesh.AddSphere(place, 1.0, 16, false);
    const Scene scene = Glass(mesh, 0.25);
    const OcclusionScene occluders(scene);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int twice = 0;
    for (int k = 0; k < 20000; ++k)
    {
      const Vec3 a = 5.0 * Normalized({ unit(random), unit(random), unit(random) });
      Vec3 toward{ 0.9 * unit(random), 0.5 * unit(random), 0.5 * unit(random) };
      if (k % 3 == 1)
      {
        toward = mesh.Points[random() % mesh.Points.size()] - place;
      }
      else if (k % 3 == 2)
      {
        const auto& t = mesh.Triangles[random() % mesh.Triangles.size()];
        const double s = 0.5 + 0.5 * unit(random);
        toward = s * mesh.Points[t[0]] + (1 - s) * mesh.Points[t[1]] - place;
      }
      const double one = Through(scene, occluders, place, place + 3.0 * toward);
      EXPECT_EQ(one, Length(toward) > 0.4 ? 0.25 : one);
      const Vec3 beyond = a + 3.0 * (toward - a);
      const double both = Through(scene, occluders, place + a, place + beyond);
      // Rays that graze the silhouette may go either way; well inside they may not.
      const Vec3 d = Normalized(beyond - a);
      const double height = Length(Cross(d, -a));
      if (height < 0.97)
      {
        EXPECT_EQ(both, 0.0625) << k;
        ++twice;
      }
      else if (height > 1.001)
      {
        EXPECT_EQ(both, 1.0) << k;
      }
    }
    EXPECT_GT(twice, 10000);
  }
}

TEST(Transmission, BandsAndOpaqueTrianglesOfOneMesh)
{
  // Two triangles: one tinted, one opaque; behind them a pane that lets one band through.
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  mesh.AddGrid({ -1, -1, 1 }, { 3, 0, 0 }, { 0, 3, 0 }, 1, 1);
  const Scene scene =
    Glass(mesh, { { 0.5, 0.25, 1.0 }, { 0.0, 0.0, 0.0 }, { 0.0, 0.5, 0.0 }, { 0.0, 0.5, 0.0 } });
  const OcclusionScene occluders(scene);
  EXPECT_TRUE(occluders.HasPanes());
  const auto through = [&](double x, double y, double z) {
    std::array<double, 3> bands{ -1, -1, -1 };
    const bool any = occluders.Visible(
      { Vec3{ x, y, -1 } - scene.Origin, -1 }, { Vec3{ x, y, z } - scene.Origin, -1 }, bands.data());
    return any ? bands : std::array<double, 3>{ 0, 0, 0 };
  };
  using Bands = std::array<double, 3>;
  EXPECT_EQ(through(0.7, 0.2, 0.5), (Bands{ 0.5, 0.25, 1.0 }));
  EXPECT_EQ(through(0.7, 0.2, 2.0), (Bands{ 0.0, 0.125, 0.0 }));
  EXPECT_EQ(through(0.2, 0.7, 0.5), (Bands{ 0, 0, 0 }));
  EXPECT_EQ(through(1.5, 0.7, 2.0), (Bands{ 0.0, 0.5, 0.0 }));
  EXPECT_EQ(through(0.5, 0.5, 0.5), (Bands{ 0, 0, 0 })); // along the common edge: the least
  // The plain query takes every triangle as opaque.
  EXPECT_TRUE(occluders.Occluded(
    { Vec3{ 0.7, 0.2, -1 } - scene.Origin, -1 }, { Vec3{ 0.7, 0.2, 0.5 } - scene.Origin, -1 }));
  std::array<double, 3> sky{};
  EXPECT_TRUE(occluders.VisibleDirection(
    { Vec3{ 1.5, 0.7, -1 } - scene.Origin, -1 }, { 0, 0, 1e-3 }, sky.data()));
  EXPECT_EQ(sky, (Bands{ 0.0, 0.5, 0.0 }));
}

TEST(Transmission, FoldsCountTwiceAndCoincidentFacesOnce)
{
  // A sheet folded along x = 1: both leaves reach back over x in [0, 1].
  test::Mesh fold;
  fold.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  fold.AddGrid({ 0, 0, 0.5 }, { 1, 0, -0.5 }, { 0, 1, 0 }, 1, 1);
  const Scene folded = Glass(fold, 0.5);
  const OcclusionScene sheets(folded);
  EXPECT_EQ(Through(folded, sheets, { 0.4, 0.3, -1 }, { 0.4, 0.3, 2 }), 0.25);
  EXPECT_EQ(Through(folded, sheets, { 1 - 1e-9, 0.3, -1 }, { 1 - 1e-9, 0.3, 2 }), 0.25);
  EXPECT_EQ(Through(folded, sheets, { 1 + 1e-9, 0.3, -1 }, { 1 + 1e-9, 0.3, 2 }), 1.0);

  // The same face twice, once turned round, once cut the other way: one sheet, the least counts.
  test::Mesh doubled;
  doubled.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  doubled.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1);
  doubled.AddGrid({ 1, 0, 0 }, { 0, 1, 0 }, { -1, 0, 0 }, 1, 1);
  const Scene coincident = Glass(doubled, { { 0.5 }, { 0.5 }, { 0.25 }, { 0.25 }, { 0.75 } });
  const OcclusionScene faces(coincident);
  for (const double x : { 0.1, 0.5, 0.8 })
  {
    EXPECT_EQ(Through(coincident, faces, { x, 0.3, -1 }, { x, 0.3, 2 }), 0.25);
    EXPECT_EQ(Through(coincident, faces, { x, x, -1 }, { 2 * x - 0.4, x, 2 }), 0.25);
  }
}

TEST(Transmission, EndsOnPanesAndNextToThem)
{
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 4, 4);
  for (const double size : { 1.0, 1e-6, 1e9 })
  {
    test::Mesh scaled = mesh;
    for (Vec3& p : scaled.Points)
    {
      p = size * p;
    }
    const Scene scene = Glass(scaled, 0.5);
    const OcclusionScene occluders(scene);
    const auto through = [&](double z0, double z1) {
      return Through(scene, occluders, { 0.3 * size, 0.4 * size, z0 * size },
        { 0.3 * size, 0.4 * size, z1 * size });
    };
    EXPECT_EQ(through(0.0, 1.0), 1.0);     // starts on the pane
    EXPECT_EQ(through(-1.0, 0.0), 1.0);    // ends on it
    EXPECT_EQ(through(1e-9, 1.0), 1.0);    // just above
    EXPECT_EQ(through(-1e-9, 1.0), 0.5);   // just below
    EXPECT_EQ(through(-1e-9, 1e-9), 0.5);  // and out again
    EXPECT_EQ(through(-1e3, 1e6), 0.5);
    // From a point of the pane itself nothing hides.
    double band = 0.0;
    EXPECT_TRUE(occluders.Visible({ Centroid(scene.TriangleAt(5)), 5 },
      { Vec3{ 0.1 * size, 0.2 * size, size } - scene.Origin, -1 }, &band));
    EXPECT_EQ(band, 1.0);
  }
}

TEST(Transmission, WithoutPanesItIsThePlainQuery)
{
  test::Mesh mesh;
  mesh.AddSphere({ 0, 0, 0 }, 1.0, 8, false);
  const Scene scene = mesh.ToScene();
  const OcclusionScene occluders(scene);
  EXPECT_FALSE(occluders.HasPanes());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-2.0, 2.0);
  for (int k = 0; k < 2000; ++k)
  {
    const RayEnd a{ { unit(random), unit(random), unit(random) }, -1 };
    const RayEnd b{ { unit(random), unit(random), unit(random) }, -1 };
    double band = 0.0;
    EXPECT_EQ(occluders.Visible(a, b, &band), !occluders.Occluded(a, b));
    EXPECT_EQ(band, 1.0);
  }
}

} // namespace
