// SPDX-License-Identifier: BSD-3-Clause
// Light of lights over mirrors and glossy surfaces, by images and by paths.
#include "radiometry/formfactor/LightPaths.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/irradiance/IrradianceSimulation.h"
#include "radiometry/irradiance/SkyTable.h"
#include "radiometry/scene/Reflectance.h"
#include "tests/core/TestScenes.h"
#include "tests/core/ThreadRanks.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace radiometry;

namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double Mirror = std::numeric_limits<double>::infinity();

struct World
{
  explicit World(const test::Mesh& mesh)
    : Geometry(mesh.ToScene(0.0))
  {
    this->Geometry.Optics.SpecularReflectance[0].assign(this->Geometry.Cells, 0.0);
    this->Geometry.Optics.Shininess[0].assign(this->Geometry.Cells, 10.0);
  }
  void Set(std::size_t from, double specular, double shininess)
  {
    for (std::size_t c = from; c < this->Geometry.Cells; ++c)
    {
      this->Geometry.Optics.SpecularReflectance[0][c] = specular;
      this->Geometry.Optics.Shininess[0][c] = shininess;
    }
  }
  SpecularLight Find(double tolerance = 0.01, std::uint64_t seed = 0, int threads = 0,
    const Communicator* ranks = nullptr)
  {
    this->Occluders = std::make_unique<OcclusionScene>(this->Geometry);
    this->Elements = std::make_unique<ElementSet>(this->Geometry, true);
    this->Surfaces = std::make_unique<SpecularSurfaces>(this->Geometry, true, true, true);
    SpecularLightOptions options;
    options.RelativeTolerance = tolerance;
    options.Seed = seed;
    options.Threads = threads;
    options.Ranks = ranks;
    const std::vector<double> known(
      this->Elements->Size() * static_cast<std::size_t>(this->Geometry.Optics.Bands), 0.0);
    return FindSpecularLight(this->Geometry, *this->Occluders, *this->Elements, {},
      *this->Surfaces, known, options);
  }
  Scene Geometry;
  std::unique_ptr<OcclusionScene> Occluders;
  std::unique_ptr<ElementSet> Elements;
  std::unique_ptr<SpecularSurfaces> Surfaces;
};

Light PointAt(const Scene& scene, const Vec3& p)
{
  Light light;
  light.Position = p - scene.Origin;
  light.Intensity = { 100.0 };
  return light;
}

/// Counter-clockwise seen from below.
Light PanelAt(const Scene& scene, const Vec3& corner, double size)
{
  Light light;
  light.Type = LightType::Area;
  light.Intensity = { 100.0 };
  for (const Vec3& p : { corner, corner + Vec3{ 0, size, 0 }, corner + Vec3{ size, size, 0 },
         corner + Vec3{ size, 0, 0 } })
  {
    light.Polygon.push_back(p - scene.Origin);
  }
  light.Position = light.Polygon[0];
  return light;
}

Light Beam(const Vec3& direction)
{
  Light light;
  light.Type = LightType::Directional;
  light.Direction = Normalized(direction);
  light.Intensity = { 100.0 };
  return light;
}

constexpr std::size_t Floor = 128;

/// A floor and a screen upon it beside a wall at x = 0 that is a mirror, of one plane or dented by so
/// little (radians) that each of its triangles is one of its own.
test::Mesh Beside(double dent, bool wall = true)
{
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 3, 0, 0 }, { 0, 3, 0 }, 8, 8);
  mesh.AddGrid({ 1.0, 1.0, 0 }, { 0.2, 1, 0 }, { 0, 0, 0.7 }, 1, 1);
  mesh.AddGrid({ 1.0, 1.0, 0 }, { 0, 0, 0.7 }, { 0.2, 1, 0 }, 1, 1);
  if (wall)
  {
    const std::size_t first = mesh.Points.size();
    mesh.AddGrid({ 0, -2, 0 }, { 0, 7, 0 }, { 0, 0, 4 }, 6, 6); // faces +x
    for (std::size_t p = first; p < mesh.Points.size(); ++p)
    {
      mesh.Points[p].x += dent * std::sin(static_cast<double>(17 * p));
    }
  }
  return mesh;
}

/// The screen where the mirror shows it, so that the direct light of the image meets it.
test::Mesh Unfolded()
{
  test::Mesh mesh = Beside(0.0, false);
  for (std::size_t k = 0; k < 2; ++k)
  {
    mesh.AddGrid({ -1.0, 1.0, 0 }, k ? Vec3{ 0, 0, 0.7 } : Vec3{ -0.2, 1, 0 },
      k ? Vec3{ -0.2, 1, 0 } : Vec3{ 0, 0, 0.7 }, 1, 1);
  }
  return mesh;
}

struct Agreement
{
  std::size_t Inside = 0, Count = 0;
  double Mean = 0.0, Exact = 0.0;
  std::vector<double> Ratios;
};

void Compare(const SpecularLight& light, const std::vector<double>& exact, double share,
  Agreement& a)
{
  for (std::size_t e = 0; e < Floor; ++e)
  {
    const double off = std::abs(light.Irradiance[e] - share * exact[e]);
    ++a.Count;
    a.Inside += off <= light.Error[e] + 5e-4 * share * exact[e] + 1e-9;
    a.Mean += light.Irradiance[e];
    a.Exact += share * exact[e];
    if (off > 1e-9)
    {
      a.Ratios.push_back(light.Error[e] / off);
    }
  }
}

} // namespace

TEST(SpecularLight, AMirrorIsASecondLamp)
{
  // What the floor gets over the mirror is what the lamp's image gives where there is no mirror.
  const Vec3 at{ 1.7, 1.2, 1.6 };
  const double size = 0.5;
  const Vec3 beam{ -1.0, 0.2, -0.8 };
  for (const double dent : { 0.0, 1e-4 })
  {
    for (int kind = 0; kind < 3; ++kind)
    {
      Agreement a;
      for (std::uint64_t seed = 0; seed < 2; ++seed)
      {
        World w(Beside(dent));
        w.Set(Floor + 4, 0.8, Mirror);
        World u(Unfolded());
        const auto& s = w.Geometry;
        const auto& t = u.Geometry;
        w.Geometry.Lights = { kind == 0 ? PointAt(s, at)
            : kind == 1                 ? PanelAt(s, at, size)
                                        : Beam(beam) };
        u.Geometry.Lights = { kind == 0 ? PointAt(t, { -at.x, at.y, at.z })
            : kind == 1                 ? PanelAt(t, { -at.x - size, at.y, at.z }, size)
                                        : Beam({ -beam.x, beam.y, beam.z }) };
        const SpecularLight light = w.Find(dent > 0.0 ? 0.2 : 0.01, seed);
        EXPECT_EQ(light.Paths > 0 && light.ByPaths[Floor / 2] > 0.0, dent > 0.0);
        const OcclusionScene occluders(u.Geometry);
        DirectOptions options;
        options.RelativeTolerance = 1e-3;
        // Means over points spread over each cell.
        constexpr std::size_t Each = 512;
        std::vector<SurfacePoint> points;
        for (std::size_t e = 0; e < Floor; ++e)
        {
          const SobolSequence sequence(e);
          for (std::uint32_t k = 0; k < Each; ++k)
          {
            const auto v = sequence(k);
            points.push_back({ TrianglePoint(u.Geometry.TriangleAt(e), v[0], v[1]), { 0, 0, 1 },
              static_cast<std::int32_t>(e), {} });
          }
        }
        std::vector<double> exact(Floor, 0.0);
        if (kind == 1)
        {
          const DirectResult direct =
            ComputeDirectIrradiance(u.Geometry, occluders, points, options);
          for (std::size_t k = 0; k < points.size(); ++k)
          {
            exact[k / Each] += direct.Irradiance[k] / Each;
          }
        }
        else
        {
          exact =
            ComputeDirectIrradiance(u.Geometry, occluders, MakePatches(u.Geometry, 0), options)
              .Irradiance;
        }
        Compare(light, exact, 0.8, a);
      }
      EXPECT_GE(a.Inside, static_cast<std::size_t>(0.95 * static_cast<double>(a.Count)))
        << kind << " " << dent;
      EXPECT_NEAR(a.Mean / a.Exact, 1.0, dent > 0.0 ? 0.02 : 0.003) << kind << " " << dent;
      if (a.Ratios.size() > 50)
      {
        std::nth_element(
          a.Ratios.begin(), a.Ratios.begin() + static_cast<long>(a.Ratios.size() / 2), a.Ratios.end());
        EXPECT_LT(a.Ratios[a.Ratios.size() / 2], 10.0) << kind << " " << dent;
      }
    }
  }
}

TEST(SpecularLight, AMirrorShowsTheSky)
{
  // By a large mirror a floor gets from the half of the sky that it hides what the other half gives.
  test::Mesh mesh;
  mesh.AddGrid({ 0.001, -0.1, 0 }, { 0.2, 0, 0 }, { 0, 0.2, 0 }, 2, 2);
  mesh.AddGrid({ 0, -400, 0 }, { 0, 800, 0 }, { 0, 0, 400 }, 40, 40);
  World w(mesh);
  w.Set(8, 1.0, Mirror);
  w.Geometry.Lights = { test::SkyLight(SkyRadiance::Overcast(), { 2.0 }) };
  const SpecularLight light = w.Find(0.02);
  const double whole = 2.0 * HorizontalIrradiance(SkyRadiance::Overcast());
  for (std::size_t e = 0; e < 8; ++e)
  {
    EXPECT_NEAR(light.Irradiance[e], 0.5 * whole, light.Error[e] + 0.01 * whole) << e;
    EXPECT_LT(light.Error[e], whole);
  }
}

TEST(SpecularLight, AGlossyPlateSpreadsByItsLobe)
{
  // Lamp, glossy plate and a small receiver above it, against the integral over the plate.
  for (const double n : { 0.0, 3.0, 40.0 })
  {
    test::Mesh mesh;
    mesh.AddGrid({ 0.9, 0.4, 1.0 }, { 0, 0.2, 0 }, { 0.2, 0, 0 }, 4, 4); // faces down
    mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 6, 6);
    World w(mesh);
    w.Set(32, 0.7, n);
    const Vec3 lamp{ 0.1, 0.5, 0.8 };
    w.Geometry.Lights = { PointAt(w.Geometry, lamp) };
    const SpecularLight light = w.Find(0.2);
    double mean = 0.0;
    for (std::size_t e = 0; e < 32; ++e)
    {
      mean += light.Irradiance[e] / 32.0;
    }
    double expected = 0.0;
    constexpr int Grid = 80, Inner = 6;
    for (int i = 0; i < Grid * Grid; ++i)
    {
      const Vec3 y{ (i % Grid + 0.5) / Grid, (i / Grid + 0.5) / Grid, 0.0 };
      const Vec3 in = lamp - y;
      const double arrives = 100.0 * in.z / std::pow(Length(in), 3);
      for (int j = 0; j < Inner * Inner; ++j)
      {
        const Vec3 x{ 0.9 + 0.2 * (j % Inner + 0.5) / Inner, 0.4 + 0.2 * (j / Inner + 0.5) / Inner,
          1.0 };
        const Vec3 out = x - y;
        const double f =
          PhongLobeBrdf(0.7, n, { 0, 0, 1 }, Normalized(in), Normalized(out));
        expected += arrives * f * out.z * out.z / std::pow(LengthSquared(out), 2) /
          (Grid * Grid * Inner * Inner);
      }
    }
    EXPECT_NEAR(mean, expected, 0.03 * expected) << n;
    EXPECT_LT(light.Error[7], 0.3 * mean);
  }
}

TEST(SpecularLight, ALampInAMirrorBallKeepsItsPower)
{
  // Arrivals over any number of mirrors: Phi rho_s/(1 - rho_s), bands apart.
  test::Mesh mesh;
  mesh.AddSphere({ 0, 0, 0 }, 1.0, 8, true);
  World w(mesh);
  Materials& o = w.Geometry.Optics;
  o.Bands = 2;
  o.DiffuseReflectance[0].assign(2 * w.Geometry.Cells, 0.0);
  o.SpecularReflectance[0].assign(2 * w.Geometry.Cells, 0.8);
  for (std::size_t c = 0; c < w.Geometry.Cells; ++c)
  {
    o.SpecularReflectance[0][2 * c + 1] = 0.3;
    o.Shininess[0][c] = 1e6;
  }
  Light lamp = PointAt(w.Geometry, { 0.3, 0.2, -0.1 });
  lamp.Intensity = { 1.0, 2.0 };
  w.Geometry.Lights = { lamp };
  const SpecularLight light = w.Find(0.3);
  double flux[2] = { 0.0, 0.0 };
  for (std::size_t e = 0; e < w.Elements->Size(); ++e)
  {
    flux[0] += w.Elements->GetAreas()[e] * light.Irradiance[2 * e];
    flux[1] += w.Elements->GetAreas()[e] * light.Irradiance[2 * e + 1];
  }
  EXPECT_NEAR(flux[0] / (4.0 * Pi * 0.8 / 0.2), 1.0, 0.01);
  EXPECT_NEAR(flux[1] / (8.0 * Pi * 0.3 / 0.7), 1.0, 0.01);
}

TEST(SpecularLight, ANarrowSpotOnALargeMirrorIsNotLost)
{
  // One of gloss, lit between its corners and its middle: all that it sends on arrives above.
  test::Mesh mesh;
  mesh.AddGrid({ -500, -500, 1 }, { 0, 1000, 0 }, { 1000, 0, 0 }, 1, 1); // faces down
  mesh.AddGrid({ -5, -5, 0 }, { 10, 0, 0 }, { 0, 10, 0 }, 1, 1);
  World w(mesh);
  w.Set(2, 0.7, 50.0);
  Light spot = PointAt(w.Geometry, { 1.0, -0.5, 0.9 });
  spot.Type = LightType::Spot;
  spot.CosCutoff = std::cos(0.1);
  w.Geometry.Lights = { spot };
  const SpecularLight light = w.Find(0.05);
  const double flux = 5e5 * (light.Irradiance[0] + light.Irradiance[1]);
  EXPECT_NEAR(flux / (100.0 * 2.0 * Pi * (1.0 - std::cos(0.1)) * 0.7), 1.0, 0.02);
}

TEST(SpecularLight, SameBytesForAnyNumberOfThreads)
{
  World w(Beside(1e-4));
  w.Set(Floor + 4, 0.8, 1e6);
  w.Geometry.Lights = { PointAt(w.Geometry, { 1.7, 1.2, 1.6 }), Beam({ -1.0, 0.2, -0.8 }) };
  const SpecularLight one = w.Find(0.5, 3, 1);
  for (const int threads : { 2, 5 })
  {
    const SpecularLight other = w.Find(0.5, 3, threads);
    EXPECT_EQ(one.Irradiance, other.Irradiance);
    EXPECT_EQ(one.Error, other.Error);
  }
}

TEST(SpecularLight, RanksGiveTheBytesOfOne)
{
  const auto make = [](double dent) {
    World w(Beside(dent));
    w.Set(Floor + 4, 0.8, dent > 0.0 ? 200.0 : 1e6);
    w.Geometry.Lights = { PointAt(w.Geometry, { 1.7, 1.2, 1.6 }),
      PanelAt(w.Geometry, { 1.7, 1.2, 1.6 }, 0.5), test::SkyLight(SkyRadiance::Overcast()) };
    return w;
  };
  for (const double dent : { 0.0, 1e-4 })
  {
    World whole = make(dent);
    const SpecularLight one = whole.Find(0.5);
    test::ThreadRanks(3).Run([&](const Communicator& ranks) {
      World w = make(dent);
      const SpecularLight light = w.Find(0.5, 0, 1, &ranks);
      EXPECT_EQ(light.Irradiance, one.Irradiance);
      EXPECT_EQ(light.Error, one.Error);
    });
  }
}

TEST(SpecularLight, PointsSeeImagesAndCaustics)
{
  for (const double dent : { 0.0, 1e-4 })
  {
    World w(Beside(dent));
    w.Set(Floor + 4, 0.8, Mirror);
    w.Geometry.Lights = { PointAt(w.Geometry, { 1.7, 1.2, 1.6 }) };
    const SpecularLight light = w.Find(dent > 0.0 ? 0.1 : 0.01);
    std::vector<SurfacePoint> points;
    for (std::size_t e = 0; e < Floor; ++e)
    {
      points.push_back({ Centroid(w.Geometry.TriangleAt(e)), { 0, 0, 1 },
        static_cast<std::int32_t>(e), {} });
    }
    const SpecularLight at = SpecularLightAt(w.Geometry, *w.Occluders, *w.Elements, light, {},
      *w.Surfaces, points, {});
    std::size_t inside = 0;
    for (std::size_t e = 0; e < Floor; ++e)
    {
      inside += std::abs(at.Irradiance[e] - light.Irradiance[e]) <=
        at.Error[e] + light.Error[e] + 0.1 * light.Irradiance[e];
    }
    EXPECT_GE(inside, Floor * 17 / 20); // all but the screen's shadow's edge
  }
}
