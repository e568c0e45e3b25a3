// SPDX-License-Identifier: BSD-3-Clause
// Radiance toward a viewer: against closed forms and against integration of the BRDF.
#include "radiometry/irradiance/OutgoingRadiance.h"
#include "radiometry/irradiance/SeenSurface.h"
#include "radiometry/scene/Reflectance.h"
#include "tests/core/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

using namespace radiometry;

namespace
{

const double Pi = std::acos(-1.0);

/// A scene whose cells' diffuse radiosity is given.
struct World
{
  explicit World(const test::Mesh& mesh)
    : Geometry(mesh.ToScene())
  {
    this->Diffuse.Exitance[0].assign(this->Geometry.Cells, 0.0);
  }
  void Gloss(std::size_t first, std::size_t end, double rho, double exponent)
  {
    auto& specular = this->Geometry.Optics.SpecularReflectance[0];
    auto& shininess = this->Geometry.Optics.Shininess[0];
    specular.resize(this->Geometry.Cells, 0.0);
    shininess.resize(this->Geometry.Cells, 10.0);
    std::fill(specular.begin() + static_cast<long>(first), specular.begin() + static_cast<long>(end), rho);
    std::fill(shininess.begin() + static_cast<long>(first), shininess.begin() + static_cast<long>(end), exponent);
  }
  void AddPointLight(const Vec3& p, double intensity)
  {
    Light light;
    light.Position = p - this->Geometry.Origin;
    light.Intensity = { intensity };
    this->Geometry.Lights.push_back(light);
  }
  void AddPanel(std::vector<Vec3> corners, double exitance)
  {
    Light light;
    light.Type = LightType::Area;
    for (Vec3& p : corners)
    {
      p = p - this->Geometry.Origin;
    }
    light.Polygon = corners;
    light.Intensity = { exitance };
    this->Geometry.Lights.push_back(light);
  }
  Viewer Eye(const Vec3& at) const
  {
    Viewer viewer;
    viewer.Eye = at - this->Geometry.Origin;
    return viewer;
  }
  RadianceResult Cells(const Viewer& viewer, RadianceOptions options = {}) const
  {
    const OcclusionScene occluders(this->Geometry);
    std::vector<std::int32_t> cells(this->Geometry.Cells);
    std::iota(cells.begin(), cells.end(), 0);
    return ComputeOutgoingRadiance(
      this->Geometry, occluders, this->Diffuse, viewer, cells, options);
  }
  /// At points of triangle 0.
  RadianceResult At(const std::vector<Vec3>& places, const Viewer& viewer,
    RadianceOptions options = {}) const
  {
    const OcclusionScene occluders(this->Geometry);
    std::vector<SurfacePoint> points;
    for (const Vec3& p : places)
    {
      points.push_back({ p - this->Geometry.Origin, { 0, 0, 1 }, 0, {}, 0.0 });
    }
    return ComputeOutgoingRadiance(
      this->Geometry, occluders, this->Diffuse, viewer, points, DiffuseLight{}, options);
  }

  Scene Geometry;
  DiffuseLight Diffuse;
};

test::Mesh Floor(double size = 2.0, int n = 1)
{
  test::Mesh mesh;
  mesh.AddGrid({ -0.5 * size, -0.5 * size, 0 }, { size, 0, 0 }, { 0, size, 0 }, n, n);
  return mesh;
}

/// A closed room from -1 to 1, `n` quads a side; the floor is the cells [0, 2 n n).
test::Mesh Room(int n = 1)
{
  test::Mesh mesh;
  mesh.AddBox({ -1, -1, -1 }, { 1, 1, 1 }, n, true);
  return mesh;
}

} // namespace

TEST(OutgoingRadiance, DiffuseIsRadiosityOverPi)
{
  World world(Room());
  for (std::size_t c = 0; c < world.Geometry.Cells; ++c)
  {
    world.Diffuse.Exitance[0][c] = 1.0 + static_cast<double>(c);
  }
  world.Diffuse.Error[0].assign(world.Geometry.Cells, 0.25);
  const RadianceResult inside = world.Cells(world.Eye({ 0.2, 0.1, 0.3 }));
  for (std::size_t c = 0; c < world.Geometry.Cells; ++c)
  {
    EXPECT_NEAR(inside.Values[c], (1.0 + static_cast<double>(c)) / Pi, 1e-15);
    EXPECT_NEAR(inside.Errors[c], 0.25 / Pi, 1e-15);
  }
  EXPECT_EQ(inside.Rays, 0);
  // From outside only backs of the near wall are seen: they send nothing.
  const RadianceResult outside = world.Cells(world.Eye({ 0, 0, 30 }));
  EXPECT_GT(*std::max_element(outside.Values.begin(), outside.Values.end()), 0.0);
  const SeenSurface seen = LookAtCells(world.Geometry, world.Eye({ 0, 0, 30 }));
  for (std::size_t c = 0; c < world.Geometry.Cells; ++c)
  {
    EXPECT_EQ(outside.Values[c] > 0.0, seen.Facing[c] > 0.0);
  }
}

TEST(OutgoingRadiance, HighlightOfAPointLight)
{
  for (const double n : { 0.0, 1.0, 10.0, 300.0 })
  {
    World world(Floor());
    world.Gloss(0, 2, 0.4, n);
    world.AddPointLight({ 0.7, 0.2, 1.1 }, 5.0);
    const Vec3 eye{ -0.5, 0.1, 0.8 };
    const std::vector<Vec3> places{ { 0.1, 0.1, 0 }, { 0.2, -0.3, 0 }, { 0.05, 0.14, 0 } };
    const RadianceResult found = world.At(places, world.Eye(eye));
    for (std::size_t k = 0; k < places.size(); ++k)
    {
      const Vec3 in = Vec3{ 0.7, 0.2, 1.1 } - places[k];
      const double r2 = LengthSquared(in);
      const double e = 5.0 * (in.z / std::sqrt(r2)) / r2;
      const double f =
        PhongLobeBrdf(0.4, n, { 0, 0, 1 }, Normalized(in), Normalized(eye - places[k]));
      EXPECT_NEAR(found.Values[k], f * e, 1e-12 * (f * e + 1e-3)) << n << ' ' << k;
      EXPECT_LE(std::fabs(found.Values[k] - f * e), found.Errors[k] + 1e-12);
    }
  }
}

TEST(OutgoingRadiance, CellAverageOfAHighlight)
{
  World world(Floor());
  world.Gloss(0, 2, 0.4, 60.0);
  world.AddPointLight({ 0.7, 0.2, 1.1 }, 5.0);
  const Vec3 eye{ -0.5, 0.1, 0.8 };
  RadianceOptions options;
  options.RelativeTolerance = 1e-3;
  const RadianceResult found = world.Cells(world.Eye(eye), options);
  for (std::size_t c = 0; c < 2; ++c)
  {
    const Triangle3 t = world.Geometry.TriangleAt(c);
    constexpr int m = 300;
    double sum = 0.0;
    for (int i = 0; i < m; ++i)
    {
      for (int j = 0; j < m - i; ++j)
      {
        for (int up = 0; up < (j < m - i - 1 ? 2 : 1); ++up)
        {
          const double u = (i + (up ? 2.0 : 1.0) / 3.0) / m, v = (j + (up ? 2.0 : 1.0) / 3.0) / m;
          const Vec3 p = (1 - u - v) * t[0] + u * t[1] + v * t[2] + world.Geometry.Origin;
          const Vec3 in = Vec3{ 0.7, 0.2, 1.1 } - p;
          const double r2 = LengthSquared(in);
          sum += PhongLobeBrdf(0.4, 60.0, { 0, 0, 1 }, Normalized(in), Normalized(eye - p)) * 5.0 *
            in.z / (r2 * std::sqrt(r2)) / (m * m);
        }
      }
    }
    EXPECT_NEAR(found.Values[c], sum, found.Errors[c] + 1e-5 * sum);
    EXPECT_LT(found.Errors[c], 0.05 * sum);
  }
}

TEST(OutgoingRadiance, SmallHighlightOnALargeCell)
{
  // A spot of some centimetres on a floor of 40 m, one quadrilateral: against rings about its middle.
  for (const double n : { 1000.0, 1e5 })
  {
    World world(Floor(40.0));
    world.Gloss(0, 2, 0.4, n);
    const Vec3 lamp{ 1.3, 0.4, 1.5 }, eye{ -0.5, -0.6, 0.7 };
    world.AddPointLight(lamp, 5.0);
    const Vec3 peak = eye + (0.7 / 2.2) * (Vec3{ lamp.x, lamp.y, -lamp.z } - eye);
    double sum = 0.0;
    constexpr int rings = 2000, spokes = 720;
    const double reach = 20.0 / std::sqrt(n);
    for (int i = 0; i < rings; ++i)
    {
      const double r = reach * (i + 0.5) / rings;
      for (int j = 0; j < spokes; ++j)
      {
        const double psi = 2.0 * Pi * (j + 0.5) / spokes;
        const Vec3 p = peak + r * Vec3{ std::cos(psi), std::sin(psi), 0.0 };
        const Vec3 in = lamp - p;
        const double r2 = LengthSquared(in);
        sum += PhongLobeBrdf(0.4, n, { 0, 0, 1 }, Normalized(in), Normalized(eye - p)) * 5.0 * in.z /
          (r2 * std::sqrt(r2)) * r * (reach / rings) * (2.0 * Pi / spokes);
      }
    }
    RadianceOptions options;
    options.RelativeTolerance = 1e-3;
    const RadianceResult found = world.Cells(world.Eye(eye), options);
    const double flux = 800.0 * (found.Values[0] + found.Values[1]);
    EXPECT_NEAR(flux / sum, 1.0, 2e-3) << n;
    EXPECT_LE(std::fabs(flux - sum), 800.0 * (found.Errors[0] + found.Errors[1]) + 1e-4 * sum) << n;
    EXPECT_LT(found.Errors[0] + found.Errors[1], 0.01 * sum / 800.0) << n;
  }
}

TEST(OutgoingRadiance, HalfAHighlightInShadow)
{
  // A wall's edge stands so that half of the highlight is dark: its value half of the whole one's.
  double flux[2];
  for (const bool wall : { false, true })
  {
    test::Mesh mesh = Floor(4.0);
    if (wall)
    {
      mesh.AddGrid({ 0, -5, 0.5 }, { 5, 0, 0 }, { 0, 10, 0 }, 1, 1);
    }
    World world(mesh);
    world.Gloss(0, 2, 0.4, 200.0);
    world.AddPointLight({ 0, 0, 2 }, 5.0);
    const RadianceResult found = world.Cells(world.Eye({ 0, 0, 0.4 }));
    flux[wall ? 1 : 0] = found.Values[0] + found.Values[1];
    EXPECT_GT(flux[wall ? 1 : 0], 0.0);
    if (wall)
    {
      EXPECT_NEAR(flux[1], 0.5 * flux[0], found.Errors[0] + found.Errors[1] + 0.01 * flux[0]);
      EXPECT_LT(found.Errors[0] + found.Errors[1], 0.1 * flux[1]);
    }
  }
}

TEST(OutgoingRadiance, UniformSurroundings)
{
  // Every wall sends L0; the floor reflects a(theta) of it in its lobe.
  for (const double n : { 0.0, 3.0, 40.0, 1000.0, 1e6 })
  {
    World world(Room());
    world.Diffuse.Exitance[0].assign(world.Geometry.Cells, 2.0 * Pi);
    world.Gloss(0, 2, 0.3, n);
    // Which face is cell 0 does not matter: look at it along a line at 60 degrees from its normal.
    const Triangle3 t = world.Geometry.TriangleAt(0);
    const Vec3 normal = Normalized(AreaNormal2(t));
    Viewer viewer;
    viewer.Parallel = true;
    viewer.Direction = -(0.5 * normal + std::sqrt(0.75) * Normalized(t[1] - t[0]));
    RadianceOptions options;
    options.RelativeTolerance = 1e-3;
    const RadianceResult found = world.Cells(viewer, options);
    const double share = n >= MirrorShininess ? 0.3 : PhongLobeReflectance(0.3, n, 0.5);
    EXPECT_NEAR(found.Values[0], 2.0 + 2.0 * share, found.Errors[0] + 1e-12) << n;
    EXPECT_LT(found.Errors[0], 0.01) << n;
  }
}

TEST(OutgoingRadiance, MirroredRoomKeepsItsEnergy)
{
  // All walls send L0 and mirror rho: L = L0/(1 - rho).
  World world(Room(2));
  world.Diffuse.Exitance[0].assign(world.Geometry.Cells, Pi);
  world.Gloss(0, world.Geometry.Cells, 0.6, 1e6);
  const RadianceResult found = world.Cells(world.Eye({ 0.3, 0.2, -0.1 }));
  double mean = 0.0;
  std::size_t covered = 0;
  for (std::size_t c = 0; c < world.Geometry.Cells; ++c)
  {
    mean += found.Values[c] / static_cast<double>(world.Geometry.Cells);
    covered += std::fabs(found.Values[c] - 2.5) <= found.Errors[c] ? 1 : 0;
  }
  EXPECT_NEAR(mean, 2.5, 0.01);
  EXPECT_GE(covered, world.Geometry.Cells * 9 / 10);
}

TEST(OutgoingRadiance, SkyInALobe)
{
  World world(Floor());
  world.Gloss(0, 2, 0.5, 20.0);
  world.Geometry.Lights.push_back(test::SkyLight(SkyRadiance::Uniform(), { 3.0 }));
  Viewer viewer;
  viewer.Parallel = true;
  viewer.Direction = Normalized(Vec3{ 0.8, 0.0, -0.6 });
  const RadianceResult found = world.Cells(viewer);
  const double exact = 3.0 * PhongLobeReflectance(0.5, 20.0, 0.6);
  EXPECT_NEAR(found.Values[0], exact, found.Errors[0]);
  EXPECT_LT(found.Errors[0], 0.011 * exact);
}

TEST(OutgoingRadiance, AreaLightAgainstIntegrationOverIt)
{
  // 60 places under a panel.
  for (const double n : { 2.0, 50.0 })
  {
    World world(Floor());
    world.Gloss(0, 2, 0.5, n);
    world.AddPanel({ { -0.3, 0.3, 1 }, { 0.3, 0.3, 1 }, { 0.3, -0.3, 1 }, { -0.3, -0.3, 1 } }, 4.0);
    const Vec3 eye{ 0.2, -0.4, 0.9 };
    std::vector<Vec3> places;
    for (int k = 0; k < 60; ++k)
    {
      places.push_back({ -0.9 + 1.8 * std::fmod(0.618 * k, 1.0), -0.95 + 0.03 * k, 0.0 });
    }
    RadianceOptions options;
    options.RelativeTolerance = 0.01;
    const RadianceResult found = world.At(places, world.Eye(eye), options);
    int covered = 0;
    for (std::size_t k = 0; k < places.size(); ++k)
    {
      // Over the panel: smooth, so midpoints do.
      double sum = 0.0;
      constexpr int m = 200;
      for (int i = 0; i < m * m; ++i)
      {
        const Vec3 on{ -0.3 + 0.6 * (i % m + 0.5) / m, -0.3 + 0.6 * (i / m + 0.5) / m, 1.0 };
        const Vec3 way = on - places[k];
        const double r2 = LengthSquared(way);
        sum +=
          PhongLobeBrdf(0.5, n, { 0, 0, 1 }, Normalized(way), Normalized(eye - places[k])) /
          (r2 * r2);
      }
      const double direct = sum * 4.0 / Pi * 0.36 / (m * m);
      covered += std::fabs(found.Values[k] - direct) <= found.Errors[k] + 1e-4 * direct ? 1 : 0;
      EXPECT_NEAR(found.Values[k], direct, 3.0 * found.Errors[k] + 1e-4 * direct)
        << n << ' ' << k;
    }
    EXPECT_GE(covered, 55) << n;
  }
}

TEST(OutgoingRadiance, MirrorShowsWhatIsThere)
{
  // A mirror floor below a ceiling that sends 7: toward any eye it shows 0.9 of its radiance.
  test::Mesh mesh = Floor(2.0);
  mesh.AddGrid({ -50, -50, 1 }, { 0, 100, 0 }, { 100, 0, 0 }, 1, 1);
  World world(mesh);
  world.Gloss(0, 2, 0.9, std::numeric_limits<double>::infinity());
  world.Diffuse.Exitance[0] = { 0, 0, 7.0, 7.0 };
  const RadianceResult found = world.Cells(world.Eye({ 0.1, 0.2, 0.5 }));
  EXPECT_NEAR(found.Values[0], 0.9 * 7.0 / Pi, 1e-12);
  EXPECT_NEAR(found.Values[1], 0.9 * 7.0 / Pi, 1e-12);
  EXPECT_NEAR(found.Values[2], 7.0 / Pi, 1e-12);
}

TEST(OutgoingRadiance, PaneShowsWhatIsBehind)
{
  test::Mesh mesh = Floor(2.0);
  mesh.AddGrid({ -50, -50, -1 }, { 100, 0, 0 }, { 0, 100, 0 }, 1, 1);
  World world(mesh);
  world.Geometry.Optics.Transmittance = { 0.8, 0.8, 0.0, 0.0 };
  world.Geometry.TriangleTransmittance = { 0.8, 0.8, 0.0, 0.0 };
  world.Diffuse.Exitance[0] = { 1.0, 1.0, 5.0, 5.0 };
  const RadianceResult found = world.Cells(world.Eye({ 0.1, 0.2, 2 }));
  EXPECT_NEAR(found.Values[0], (1.0 + 0.8 * 5.0) / Pi, 1e-12);
  RadianceOptions off;
  off.Effects.Transmission = false;
  const RadianceResult without = world.Cells(world.Eye({ 0.1, 0.2, 2 }), off);
  EXPECT_NEAR(without.Values[0], 1.0 / Pi, 1e-12);
  EXPECT_GE(without.LeftOut, found.Values[0] - without.Values[0] - 1e-12);
}

TEST(OutgoingRadiance, ShadowsOfHighlights)
{
  test::Mesh mesh = Floor(2.0, 1);
  mesh.AddGrid({ -5, -5, 1.5 }, { 10, 0, 0 }, { 0, 10, 0 }, 1, 1);
  World world(mesh);
  world.Gloss(0, 2, 0.4, 10.0);
  world.AddPointLight({ 0, 0, 2 }, 5.0);
  const Viewer eye = world.Eye({ 0.2, 0.2, 1.0 });
  EXPECT_EQ(world.Cells(eye).Values[0], 0.0);
  RadianceOptions off;
  off.Effects.Occlusion = false;
  const RadianceResult bright = world.Cells(eye, off);
  EXPECT_GT(bright.Values[0], 0.0);
  EXPECT_GE(bright.LeftOut, bright.Values[0]);
  // What is known of shadows is taken: 1 is not asked again, nor is 0.
  RadianceOptions known;
  known.Known = { 1.0f, 0.0f, 0.5f, 0.5f };
  const RadianceResult told = world.Cells(eye, known);
  EXPECT_NEAR(told.Values[0], bright.Values[0], 0.05 * bright.Values[0]);
  EXPECT_EQ(told.Values[1], 0.0);
}

TEST(OutgoingRadiance, EyeAndLightExchanged)
{
  // Helmholtz: L/(I cos/r^2) is f(in, out), the same both ways round.
  const Vec3 a{ 0.7, 0.2, 1.1 }, b{ -0.4, -0.6, 0.3 }, p{ 0.1, 0.1, 0 };
  const auto f = [&](const Vec3& light, const Vec3& eye) {
    World world(Floor());
    world.Gloss(0, 2, 0.4, 25.0);
    world.AddPointLight(light, 5.0);
    const Vec3 in = light - p;
    const double r2 = LengthSquared(in);
    return world.At({ p }, world.Eye(eye)).Values[0] / (5.0 * in.z / (r2 * std::sqrt(r2)));
  };
  EXPECT_NEAR(f(a, b) / f(b, a), 1.0, 1e-12);
}

TEST(OutgoingRadiance, LeftOutBoundsWhatItDoes)
{
  World world(Room());
  world.Diffuse.Exitance[0].assign(world.Geometry.Cells, 2.0);
  world.Gloss(0, 6, 0.3, 100.0);
  world.AddPointLight({ 0.2, 0.1, 0.3 }, 1.0);
  const Viewer eye = world.Eye({ -0.3, 0.4, 0.1 });
  const RadianceResult full = world.Cells(eye);
  RadianceOptions off;
  off.Effects.Specular = false;
  const RadianceResult less = world.Cells(eye, off);
  double change = 0.0;
  for (std::size_t c = 0; c < world.Geometry.Cells; ++c)
  {
    change = std::max(change, std::fabs(full.Values[c] - less.Values[c]));
  }
  EXPECT_GT(change, 0.0);
  EXPECT_GE(less.LeftOut, change);
}

TEST(OutgoingRadiance, ThreadsDoNotMatter)
{
  World world(Room(3));
  world.Diffuse.Exitance[0].assign(world.Geometry.Cells, 2.0);
  world.Gloss(0, 60, 0.3, 30.0);
  world.AddPointLight({ 0.2, 0.1, 0.3 }, 1.0);
  RadianceOptions one, four;
  one.Threads = 1;
  four.Threads = 4;
  const Viewer eye = world.Eye({ -0.3, 0.4, 0.1 });
  EXPECT_EQ(world.Cells(eye, one).Values, world.Cells(eye, four).Values);
  EXPECT_EQ(world.Cells(eye, one).Errors, world.Cells(eye, four).Errors);
}

TEST(OutgoingRadiance, EyeOnThings)
{
  World world(Room());
  world.Diffuse.Exitance[0].assign(world.Geometry.Cells, 2.0);
  world.Gloss(0, world.Geometry.Cells, 0.3, 30.0);
  world.AddPointLight({ 1, 0.1, 0.3 }, 1.0); // on a wall, too
  for (const Vec3& at : { Vec3{ 1, 0.2, 0.1 }, Vec3{ 1, 1, 0.3 }, Vec3{ 1, 1, 1 },
         Vec3{ 1 - 1e-15, 0, 0 }, Vec3{ 1, 0.1, 0.3 } })
  {
    const RadianceResult found = world.Cells(world.Eye(at));
    for (std::size_t c = 0; c < world.Geometry.Cells; ++c)
    {
      EXPECT_TRUE(std::isfinite(found.Values[c]) && found.Values[c] >= 0.0) << at.x << ' ' << c;
      EXPECT_TRUE(std::isfinite(found.Errors[c])) << at.x << ' ' << c;
    }
  }
}
