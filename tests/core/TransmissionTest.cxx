// SPDX-License-Identifier: BSD-3-Clause
// What panes let through along a ray: layers, shared edges, folds, coincident faces, far places.
#include "radiometry/irradiance/IrradianceSimulation.h"
#include "radiometry/scene/SkyRadiance.h"
#include "radiometry/visibility/OcclusionScene.h"

#include "tests/core/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

// ---- Direct light through panes ----

/// A floor (cells first) with panes above it; every pane triangle lets through its share.
struct Room
{
  test::Mesh Mesh;
  std::size_t Floor = 0;
  std::vector<std::vector<double>> Shares;

  explicit Room(int n, const Vec3& offset = {})
  {
    this->Mesh.AddGrid(offset, { 4, 0, 0 }, { 0, 4, 0 }, n, n);
    this->Floor = this->Mesh.Triangles.size();
  }
  void Close(const std::vector<double>& share)
  {
    this->Shares.resize(this->Mesh.Triangles.size(), share);
  }
  Scene Make(const std::vector<double>& floorShare) const
  {
    std::vector<std::vector<double>> shares(this->Floor, floorShare);
    for (std::size_t t = this->Floor; t < this->Shares.size(); ++t)
    {
      shares.push_back(this->Shares[t]);
    }
    return Glass(this->Mesh, shares);
  }
  /// Everything from here on lets `share` through.
  void Pane(const Vec3& o, const Vec3& a, const Vec3& b, int n, const std::vector<double>& share)
  {
    this->Shares.resize(this->Mesh.Triangles.size(), share);
    this->Mesh.AddGrid(o, a, b, n, n);
    this->Close(share);
  }
};

Light PointLight(const Scene& scene, const Vec3& place, std::vector<double> intensity)
{
  Light light;
  light.Position = place - scene.Origin;
  light.Intensity = std::move(intensity);
  return light;
}

IrradianceResult Simulate(const Scene& scene, EffectSwitch transmission = EffectSwitch::Auto,
  double tolerance = 0.01)
{
  IrradianceOptions options;
  options.RelativeTolerance = tolerance;
  options.Switches[static_cast<int>(Effect::Transmission)] = transmission;
  return SimulateIrradiance(scene, {}, options);
}

TEST(TransmittedLight, PanesMultiply)
{
  // One to four panes that cover all of the floor, of one share and tinted; UTM coordinates, too.
  for (const Vec3& at : { Vec3{}, Vec3{ 5e5, 4e6, 30 } })
  {
    Room bare(6, at);
    Scene open = bare.Make({ 0.0, 0.0, 0.0 });
    open.Lights = { PointLight(open, at + Vec3{ 1.3, 2.1, 3.0 }, { 5.0, 3.0, 1.0 }) };
    const IrradianceResult expected = Simulate(open);
    const std::array<double, 3> share{ 0.5, 0.8, 0.0625 };
    for (int panes = 1; panes <= 4; ++panes)
    {
      Room room(6, at);
      for (int k = 0; k < panes; ++k)
      {
        room.Pane(at + Vec3{ -4, -4, 0.5 + 0.5 * k }, { 12, 0, 0.01 * k }, { 0, 12, 0 }, 3,
          { share[0], share[1], share[2] });
      }
      Scene scene = room.Make({ 0.0, 0.0, 0.0 });
      scene.Lights = { PointLight(scene, at + Vec3{ 1.3, 2.1, 3.0 }, { 5.0, 3.0, 1.0 }) };
      const IrradianceResult got = Simulate(scene);
      for (std::size_t c = 0; c < room.Floor; ++c)
      {
        for (int b = 0; b < 3; ++b)
        {
          const double want = expected.Cells[0].Values[3 * c + b] * std::pow(share[b], panes);
          EXPECT_NEAR(got.Cells[0].Values[3 * c + b], want, 1e-9 * want) << panes << ' ' << c;
          EXPECT_LE(std::fabs(got.Cells[0].Values[3 * c + b] - want),
            got.Cells[0].Errors[3 * c + b] + (at.x > 0.0 ? 1e-9 * want : 0.0));
        }
      }
      EXPECT_TRUE(got.Effects[static_cast<int>(Effect::Transmission)].Simulated);
    }
  }
}

TEST(TransmittedLight, OpaqueAndClearPanesAreTheLimits)
{
  const auto run = [](double share, bool pane, EffectSwitch transmission) {
    Room room(5);
    if (pane)
    {
      room.Pane({ 0.7, 0.9, 1.0 }, { 1.5, 0.2, 0.1 }, { -0.1, 1.4, 0.3 }, 2, { share });
    }
    Scene scene = room.Make({ 0.0 });
    if (share == 0.0)
    {
      scene.TriangleTransmittance.clear();
    }
    scene.Lights = { PointLight(scene, { 1.7, 1.9, 3.0 }, { 9.0 }) };
    IrradianceResult result = Simulate(scene, transmission, 1e-9);
    result.Cells[0].Values.resize(room.Floor);
    result.Cells[0].Errors.resize(room.Floor);
    return result;
  };
  const IrradianceResult none = run(0.5, false, EffectSwitch::Auto);
  const IrradianceResult opaque = run(0.0, true, EffectSwitch::Auto);
  const IrradianceResult clear = run(1.0, true, EffectSwitch::Auto);
  const IrradianceResult half = run(0.5, true, EffectSwitch::Auto);
  const IrradianceResult off = run(0.5, true, EffectSwitch::Off);
  // Switched off: as the opaque pane, to the last bit.
  EXPECT_EQ(off.Cells[0].Values, opaque.Cells[0].Values);
  EXPECT_FALSE(off.Effects[static_cast<int>(Effect::Transmission)].Simulated);
  double most = 0.0;
  double shadowed = 0.0;
  for (std::size_t c = 0; c < none.Cells[0].Values.size(); ++c)
  {
    const double bright = none.Cells[0].Values[c];
    const double dark = opaque.Cells[0].Values[c];
    EXPECT_NEAR(clear.Cells[0].Values[c], bright, 1e-13 * bright);
    EXPECT_NEAR(half.Cells[0].Values[c], 0.5 * (bright + dark), 1e-12 * bright);
    most = std::max(most, half.Cells[0].Values[c] - dark);
    shadowed += bright - dark;
  }
  EXPECT_GT(shadowed, 1.0);
  EXPECT_GE(off.Effects[static_cast<int>(Effect::Transmission)].Bound, most);
  EXPECT_LT(off.Effects[static_cast<int>(Effect::Transmission)].Bound, 5.0 * most);
}

TEST(TransmittedLight, APaneOverHalfOfOneCellGivesTheSumOfTheParts)
{
  // A point light over one large cell; the pane's rim casts its edge across it.
  const double share = 0.3;
  Room room(1);
  room.Pane({ -10, -10, 1.0 }, { 11.5, 0, 0 }, { 0, 30, 0 }, 1, { share });
  Scene scene = room.Make({ 0.0 });
  const Vec3 place{ 2.5, 1.0, 2.0 };
  scene.Lights = { PointLight(scene, place, { 1.0 }) };
  const IrradianceResult got = Simulate(scene);
  // The rim at x = 1.5, z = 1 falls on x = 0.5 of the floor: solid angles of both parts, by cutting
  // the triangles (0,0)(4,0)(4,4) and (0,0)(4,4)(0,4) at x = 0.5.
  const auto solid = [&](double x0, double y0, double x1, double y1, double x2, double y2) {
    const Vec3 a = Vec3{ x0, y0, 0 } - place;
    const Vec3 b = Vec3{ x1, y1, 0 } - place;
    const Vec3 c = Vec3{ x2, y2, 0 } - place;
    const double la = Length(a), lb = Length(b), lc = Length(c);
    return 2.0 * std::fabs(std::atan2(Dot(a, Cross(b, c)),
      la * lb * lc + Dot(a, b) * lc + Dot(b, c) * la + Dot(c, a) * lb));
  };
  const double first = share * solid(0, 0, 0.5, 0, 0.5, 0.5) + solid(0.5, 0, 4, 0, 4, 4) +
    solid(0.5, 0, 4, 4, 0.5, 0.5);
  const double second = share * (solid(0, 0, 0.5, 0.5, 0.5, 4) + solid(0, 0, 0.5, 4, 0, 4)) +
    solid(0.5, 0.5, 4, 4, 0.5, 4);
  EXPECT_NEAR(got.Cells[0].Values[0], first / 8.0, 1e-13);
  EXPECT_NEAR(got.Cells[0].Values[1], second / 8.0, 1e-13);
  EXPECT_LT(got.Cells[0].Errors[0], 1e-12);
}

/// What falls on the floor equals what falls on it past each part of the panes, whatever these are:
/// brute force through the query, dense points of the floor.
void AgainstPoints(const Scene& scene, std::size_t floor, double tolerance)
{
  const OcclusionScene occluders(scene);
  const IrradianceResult got = Simulate(scene, EffectSwitch::Auto, 1e-3);
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  const int n = 160;
  std::size_t within = 0;
  std::size_t all = 0;
  double greatest = 0.0;
  for (std::size_t c = 0; c < floor; ++c)
  {
    const Triangle3 t = scene.TriangleAt(c);
    std::vector<double> sum(bands, 0.0);
    std::vector<double> pass(bands);
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j + i < n; ++j)
      {
        for (int half = 0; half < (i + j + 1 < n ? 2 : 1); ++half)
        {
          const double u = (i + (half ? 2.0 : 1.0) / 3.0) / n;
          const double v = (j + (half ? 2.0 : 1.0) / 3.0) / n;
          const Vec3 p = (1 - u - v) * t[0] + u * t[1] + v * t[2];
          for (const Light& light : scene.Lights)
          {
            const bool far = light.Type == LightType::Directional;
            const Vec3 d = far ? -light.Direction : light.Position - p;
            const double r = Length(d);
            const RayEnd from{ p, static_cast<std::int32_t>(c) };
            if (far ? occluders.VisibleDirection(from, d, pass.data())
                    : occluders.Visible(from, { light.Position, -1 }, pass.data()))
            {
              for (std::size_t b = 0; b < bands; ++b)
              {
                sum[b] += pass[b] * light.Intensity[b] * d.z / (far ? 1.0 : r * r * r) / (n * n);
              }
            }
          }
        }
      }
    }
    for (std::size_t b = 0; b < bands; ++b)
    {
      const double value = got.Cells[0].Values[c * bands + b];
      greatest = std::max(greatest, value);
      ++all;
      within += std::fabs(value - sum[b]) <= got.Cells[0].Errors[c * bands + b] + tolerance ? 1 : 0;
    }
  }
  EXPECT_GT(greatest, 10.0 * tolerance);
  EXPECT_GE(within, all - all / 20) << all;
}

TEST(TransmittedLight, FoldedMixedAndTintedPanesAgainstPoints)
{
  // A folded sheet, a mesh of opaque and clear triangles, a leaning pane that cuts the floor, a
  // closed box; a point light and the sun.
  Room room(4);
  room.Pane({ 0.5, 0.5, 0.6 }, { 1.0, 0, 0.4 }, { 0, 1.2, 0 }, 1, { 0.5, 0.25 });
  room.Pane({ 1.5, 0.5, 1.0 }, { -0.8, 0, 0.3 }, { 0, 1.2, 0 }, 1, { 0.5, 0.25 });
  room.Pane({ 2.2, 2.0, 1.2 }, { 1.2, 0, 0 }, { 0, 1.2, 0.1 }, 1, { 0.9, 0.1 });
  room.Shares.back() = { 0.0, 0.0 };
  room.Pane({ 0.3, 2.5, -0.4 }, { 1.0, 0.3, 0 }, { 0.1, 0.6, 0.9 }, 1, { 0.6, 0.6 });
  Scene scene = room.Make({ 0.0, 0.0 });
  Light sun;
  sun.Type = LightType::Directional;
  sun.Direction = Normalized({ 0.3, -0.2, -1.0 });
  sun.Intensity = { 0.5, 1.0 };
  scene.Lights = { PointLight(scene, { 1.9, 1.7, 2.5 }, { 6.0, 2.0 }), sun };
  AgainstPoints(scene, room.Floor, 4e-3);
}

TEST(TransmittedLight, AGlassBoxRoundTheLightTakesItsShareEverywhere)
{
  Room room(8);
  const std::size_t before = room.Mesh.Triangles.size();
  room.Shares.resize(before, { 0.0 });
  room.Mesh.AddBox({ 1.0, 1.0, 0.5 }, { 2.0, 2.2, 1.7 }, 3, false);
  room.Close({ 0.7 });
  Scene scene = room.Make({ 0.0 });
  Room bare(8);
  Scene open = bare.Make({ 0.0 });
  scene.Lights = { PointLight(scene, { 1.4, 1.5, 1.0 }, { 2.0 }) };
  open.Lights = { PointLight(open, { 1.4, 1.5, 1.0 }, { 2.0 }) };
  const IrradianceResult got = Simulate(scene);
  const IrradianceResult expected = Simulate(open);
  for (std::size_t c = 0; c < room.Floor; ++c)
  {
    const double want = 0.7 * expected.Cells[0].Values[c];
    EXPECT_NEAR(got.Cells[0].Values[c], want, 1e-12 * want) << c;
    EXPECT_LE(got.Cells[0].Errors[c], 1e-11 * want);
  }
}

TEST(TransmittedLight, ShadowAndTransmittedLightAreTheUnblockedLight)
{
  // A plate that lets tau through and its complement of 1 - tau share out the light.
  const auto flux = [](double share, bool plate) {
    Room room(3);
    if (plate)
    {
      room.Pane({ 0.9, 1.1, 0.8 }, { 1.3, 0.4, 0.3 }, { -0.3, 1.2, 0.2 }, 4, { share });
    }
    Scene scene = room.Make({ 0.0 });
    scene.Lights = { PointLight(scene, { 2.2, 1.6, 2.5 }, { 4.0 }) };
    const IrradianceResult r = Simulate(scene, EffectSwitch::Auto, 1e-9);
    double sum = 0.0;
    for (std::size_t c = 0; c < room.Floor; ++c)
    {
      sum += r.Cells[0].Values[c] * Area(scene.TriangleAt(c));
    }
    return sum;
  };
  const double open = flux(0.0, false);
  const double dark = flux(0.0, true);
  for (const double share : { 0.2, 0.35, 0.9 })
  {
    const double through = flux(share, true) - dark;
    const double held = open - flux(share, true);
    EXPECT_NEAR(through + held, open - dark, 1e-13 * open);
    EXPECT_NEAR(through, share * (open - dark), 1e-12 * open);
    EXPECT_NEAR(flux(1.0 - share, true) - dark, held, 1e-12 * open);
  }
}

Light PanelLight(const Scene& scene, const Vec3& at, double size, std::vector<double> exitance)
{
  Light light;
  light.Type = LightType::Area;
  const Vec3 o = at - scene.Origin;
  light.Polygon = { o, o + Vec3{ 0, size, 0 }, o + Vec3{ size, size, 0 }, o + Vec3{ size, 0, 0 } };
  light.Intensity = std::move(exitance);
  return light;
}

TEST(TransmittedLight, AreaLightsThroughPanesThatCoverAll)
{
  const auto run = [](int panes, const std::vector<double>& share) {
    Room room(3);
    for (int k = 0; k < panes; ++k)
    {
      room.Pane({ -4, -4, 0.5 + 0.5 * k }, { 12, 0, 0.01 * k }, { 0, 12, 0 }, 1, share);
    }
    Scene scene = room.Make({ 0.0, 0.0, 0.0 });
    scene.Lights = { PanelLight(scene, { 1, 1, 3 }, 1.5, { 5.0, 3.0, 1.0 }) };
    return Simulate(scene);
  };
  const std::vector<double> share{ 0.5, 0.8, 0.0625 };
  const IrradianceResult open = run(0, share);
  for (int panes = 1; panes <= 3; ++panes)
  {
    const IrradianceResult got = run(panes, share);
    for (std::size_t c = 0; c < 18; ++c)
    {
      for (std::size_t b = 0; b < 3; ++b)
      {
        const double want = open.Cells[0].Values[3 * c + b] * std::pow(share[b], panes);
        EXPECT_NEAR(got.Cells[0].Values[3 * c + b], want, 1e-5 * want) << panes << ' ' << c;
      }
    }
  }
}

TEST(TransmittedLight, AreaLightsThroughPanesAgainstManyPoints)
{
  // Two tinted panes that overlap, an opaque one, and a finely divided one.
  Room room(1);
  room.Pane({ 0.5, 0.5, 1.0 }, { 2.0, 0, 0 }, { 0, 2.0, 0 }, 2, { 0.5, 0.25 });
  room.Pane({ 1.5, 1.5, 1.5 }, { 2.0, 0, 0 }, { 0, 2.0, 0.2 }, 1, { 0.1, 0.0 });
  room.Pane({ 0.2, 2.5, 0.8 }, { 0.8, 0, 0 }, { 0, 0.8, 0 }, 1, { 0.0, 0.0 });
  room.Pane({ 2.6, 0.2, 0.7 }, { 1.2, 0, 0 }, { 0, 1.2, 0 }, 12, { 0.7, 0.9 });
  Scene scene = room.Make({ 0.0, 0.0 });
  scene.Lights = { PanelLight(scene, { 1, 1, 3 }, 1.5, { 4.0, 7.0 }) };
  const OcclusionScene occluders(scene);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 14; ++i)
  {
    for (int j = 0; j < 14; ++j)
    {
      points.push_back({ Vec3{ 0.15 + 0.28 * i, 0.15 + 0.28 * j, 0.1 } - scene.Origin,
        { 0, 0, 1 }, -1, {}, 0.0 });
    }
  }
  IrradianceOptions options;
  options.RelativeTolerance = 1e-3;
  options.Cells = false;
  const IrradianceResult got = SimulateIrradiance(scene, points, options);
  const double pi = std::acos(-1.0);
  double greatest = 0.0;
  std::size_t within = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const int n = 8000; // of a lattice that no edge runs along
    std::array<double, 2> sum{ 0.0, 0.0 };
    std::array<double, 2> pass{};
    for (int i = 0; i < n; ++i)
    {
      const double u = std::fmod(0.5 + 0.7548776662466927 * i, 1.0);
      const double v = std::fmod(0.5 + 0.5698402909980532 * i, 1.0);
      const Vec3 y = Vec3{ 1 + 1.5 * u, 1 + 1.5 * v, 3 } - scene.Origin;
      const Vec3 d = y - points[k].Point;
      const double r2 = LengthSquared(d);
      if (occluders.Visible({ points[k].Point, -1 }, { y, -1 }, pass.data()))
      {
        for (int b = 0; b < 2; ++b)
        {
          sum[b] += pass[b] * scene.Lights[0].Intensity[b] / pi * d.z * d.z / (r2 * r2) *
            (1.5 * 1.5 / n);
        }
      }
    }
    for (int b = 0; b < 2; ++b)
    {
      const double value = got.Points[0].Values[2 * k + b];
      within += std::fabs(value - sum[b]) <= got.Points[0].Errors[2 * k + b] + 5e-4 ? 1 : 0;
      greatest = std::max(greatest, value);
    }
  }
  EXPECT_GT(greatest, 0.15);
  EXPECT_GE(within, 2 * points.size() * 97 / 100);
}

TEST(TransmittedLight, SkyThroughPanes)
{
  // A pane far wider than the floor under a uniform sky: its share of pi, but for the horizon.
  Room room(2);
  room.Pane({ -4e4, -4e4, 1.0 }, { 8e4, 0, 0 }, { 0, 8e4, 0 }, 1, { 0.3, 0.6 });
  Scene scene = room.Make({ 0.0, 0.0 });
  Light sky;
  sky.Type = LightType::Environment;
  sky.Intensity = { 2.0, 1.0 };
  sky.Environment = SkyRadiance::Uniform();
  scene.Lights = { sky };
  const IrradianceResult got = Simulate(scene);
  const double pi = std::acos(-1.0);
  for (std::size_t c = 0; c < room.Floor; ++c)
  {
    EXPECT_NEAR(got.Cells[0].Values[2 * c], 0.3 * 2.0 * pi, 0.02 * 0.6 * pi);
    EXPECT_NEAR(got.Cells[0].Values[2 * c + 1], 0.6 * pi, 0.02 * 0.6 * pi);
  }
}

TEST(TransmittedLight, ManyLightsThroughATintedPane)
{
  // So many that most are left out or estimated: each band within its own error.
  const std::vector<double> share{ 0.5, 0.02 };
  const auto run = [&](bool pane, double tolerance) {
    Room room(4);
    if (pane)
    {
      room.Pane({ -60, -60, 0.5 }, { 120, 0, 0 }, { 0, 120, 0 }, 1, share);
    }
    Scene scene = room.Make({ 0.0, 0.0 });
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int k = 0; k < 3000; ++k)
    {
      scene.Lights.push_back(PointLight(scene,
        { -20 + 44 * unit(random), -20 + 44 * unit(random), 1 + 4 * unit(random) },
        { std::pow(unit(random), 30), std::pow(unit(random), 30) }));
    }
    return Simulate(scene, EffectSwitch::Auto, tolerance);
  };
  const IrradianceResult exact = run(false, 0.0);
  const IrradianceResult got = run(true, 0.05);
  EXPECT_GT(got.DroppedPeak, 0.0);
  std::size_t within = 0;
  for (std::size_t k = 0; k < 64; ++k)
  {
    const double want = share[k % 2] * exact.Cells[0].Values[k];
    within += std::fabs(got.Cells[0].Values[k] - want) <= got.Cells[0].Errors[k] + 1e-12 * want;
    EXPECT_NEAR(got.Cells[0].Values[k], want, 0.15 * want);
  }
  EXPECT_GE(within, 61u);
}

TEST(TransmittedLight, PointsAndThreads)
{
  Room room(4);
  room.Pane({ 0.5, 0.5, 1.0 }, { 2.0, 0, 0 }, { 0, 2.0, 0 }, 2, { 0.5, 0.25 });
  room.Pane({ 1.5, 1.5, 1.5 }, { 2.0, 0, 0 }, { 0, 2.0, 0 }, 2, { 0.1, 0.0 });
  Scene scene = room.Make({ 0.0, 0.0 });
  scene.Lights = { PointLight(scene, { 2.0, 2.0, 8.0 }, { 3.0, 7.0 }) };
  std::vector<SurfacePoint> points;
  std::vector<std::array<double, 2>> expected;
  for (int i = 0; i < 20; ++i)
  {
    for (int j = 0; j < 20; ++j)
    {
      const Vec3 p{ 0.1 + 0.19 * i, 0.1 + 0.19 * j, 0.2 };
      const Vec3 d = Vec3{ 2.0, 2.0, 8.0 } - p;
      const auto crosses = [&](double lo, double hi, double z) {
        const Vec3 at = p + ((z - p.z) / d.z) * d;
        return at.x > lo && at.x < hi && at.y > lo && at.y < hi;
      };
      const double e = d.z / std::pow(Length(d), 3);
      std::array<double, 2> want{ 3.0 * e, 7.0 * e };
      want[0] *= (crosses(0.5, 2.5, 1.0) ? 0.5 : 1.0) * (crosses(1.5, 3.5, 1.5) ? 0.1 : 1.0);
      want[1] *= (crosses(0.5, 2.5, 1.0) ? 0.25 : 1.0) * (crosses(1.5, 3.5, 1.5) ? 0.0 : 1.0);
      points.push_back({ p - scene.Origin, { 0, 0, 1 }, -1, {}, 0.0 });
      expected.push_back(want);
    }
  }
  std::vector<IrradianceResult> results;
  for (const int threads : { 1, 2, 7 })
  {
    IrradianceOptions options;
    options.Threads = threads;
    results.push_back(SimulateIrradiance(scene, points, options));
  }
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (int b = 0; b < 2; ++b)
    {
      EXPECT_NEAR(results[0].Points[0].Values[2 * i + b], expected[i][b], 1e-13) << i;
    }
  }
  for (const IrradianceResult& r : results)
  {
    EXPECT_EQ(r.Points[0].Values, results[0].Points[0].Values);
    EXPECT_EQ(r.Cells[0].Values, results[0].Cells[0].Values);
    EXPECT_EQ(r.Cells[0].Errors, results[0].Cells[0].Errors);
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
