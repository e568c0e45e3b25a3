// SPDX-License-Identifier: BSD-3-Clause
// The picture's area lights, skies and luminaires: closed forms, and the simulation's own answers.
#include "radiometry/irradiance/DirectIrradiance.h"
#include "radiometry/scene/CandelaWeb.h"
#include "radiometry/scene/SkyRadiance.h"
#include "radiometry/shading/LightingModel.h"
#include "tests/core/TestScenes.h"

#include <gtest/gtest.h>

#include <random>

using namespace radiometry;

namespace
{

const double Pi = std::acos(-1.0);

/// Irradiance at points by the simulation, of one light in an empty scene.
std::vector<double> Simulated(const Light& light, const std::vector<SurfacePoint>& points)
{
  test::Mesh mesh;
  mesh.AddGrid({ 500, 500, 500 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1); // far away
  Scene scene = mesh.ToScene();
  Light moved = light;
  moved.Position = light.Position - scene.Origin;
  for (Vec3& corner : moved.Polygon)
  {
    corner = corner - scene.Origin;
  }
  scene.Lights.push_back(moved);
  std::vector<SurfacePoint> shifted = points;
  for (SurfacePoint& p : shifted)
  {
    p.Point = p.Point - scene.Origin;
  }
  DirectOptions options;
  options.Occlusion = false;
  options.RelativeTolerance = 1e-6;
  return ComputeDirectIrradiance(scene, OcclusionScene(scene), shifted, options).Irradiance;
}

/// pi times the picture's diffuse sum: irradiance.
double Pictured(const DisplayLight& light, const SurfacePoint& p)
{
  LightingModel model;
  ShadingSample sample;
  sample.Point = p.Point;
  sample.Normal = p.Normal;
  return Pi * SumLights(model, { light }, 10.0, sample).Diffuse.r;
}

std::vector<SurfacePoint> RandomPoints(int count, double size)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  std::vector<SurfacePoint> points;
  while (static_cast<int>(points.size()) < count)
  {
    const Vec3 n{ in(random), in(random), in(random) };
    if (Length(n) > 0.1)
    {
      points.push_back({ size * Vec3{ in(random), in(random), in(random) }, Normalized(n), -1, {},
        0.0 });
    }
  }
  return points;
}

TEST(ExtendedLights, SquareStraightAboveHasItsTabulatedFormFactor)
{
  // A square of side 2 one above a point on its axis: F = 4/pi/sqrt(2) atan(1/sqrt(2)).
  const std::vector<Vec3> square{ { 1, -1, 1 }, { -1, -1, 1 }, { -1, 1, 1 }, { 1, 1, 1 } };
  const double exact = 4.0 / Pi / std::sqrt(2.0) * std::atan(1.0 / std::sqrt(2.0));
  EXPECT_NEAR(PolygonFormFactor(square, {}, { 0, 0, 1 }), exact, 1e-15);
  EXPECT_EQ(PolygonFormFactor(square, {}, { 0, 0, -1 }), 0.0);               // below the horizon
  EXPECT_NEAR(PolygonFormFactor(square, { 0, 0, 2 }, { 0, 0, -1 }), -exact, 1e-15); // its back
  // Half of it about a normal in its plane: the part above the horizon alone.
  EXPECT_GT(PolygonFormFactor(square, {}, { 1, 0, 0 }), 0.0);
}

TEST(ExtendedLights, PolygonsAreThoseOfTheSimulation)
{
  Light area;
  area.Type = LightType::Area;
  area.Intensity = { 3.0 };
  // Concave: an L, tilted a little.
  area.Polygon = { { 0, 0, 1 }, { 0, 2, 1.2 }, { 1, 2, 1.2 }, { 1, 1, 1.1 }, { 2, 1, 1.1 },
    { 2, 0, 1 } };
  DisplayLight shown;
  shown.Diffuse = { 3, 3, 3 };
  shown.Polygon = area.Polygon;
  const std::vector<SurfacePoint> points = RandomPoints(400, 3.0);
  const std::vector<double> expected = Simulated(area, points);
  int lit = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_NEAR(Pictured(shown, points[i]), expected[i], 1e-7 + 1e-6 * expected[i]) << i;
    lit += expected[i] > 1e-3 ? 1 : 0;
  }
  EXPECT_GT(lit, 50);
}

TEST(ExtendedLights, LuminairesAreThoseOfTheSimulation)
{
  const auto web = std::make_shared<const CandelaWeb>(WebType::C,
    std::vector<double>{ 0, 40, 90, 200, 360 }, std::vector<double>{ 0, 30, 60, 90, 120 },
    std::vector<double>{ 5, 4, 3, 2, 1, 5, 3, 1, 4, 2, 5, 1, 2, 3, 1, 5, 2, 2, 1, 1, 5, 4, 3, 2, 1 });
  Light lamp;
  lamp.Intensity = { 2.0 };
  lamp.Web = web;
  lamp.Direction = Normalized({ 0.3, -0.2, -1.0 });
  lamp.Reference = LuminaireAxes(lamp.Direction, { 0.2, 1.0, 0.1 })[0];
  DisplayLight shown;
  shown.Position = { { 0, 0, 0, 1 } };
  shown.Diffuse = { 2, 2, 2 };
  shown.Attenuation = { { 0, 0, 1 } };
  shown.SpotDirection = 5.0 * lamp.Direction;
  shown.Reference = { 0.2, 1.0, 0.1 };
  shown.Web = web;
  const std::vector<SurfacePoint> points = RandomPoints(400, 3.0);
  const std::vector<double> expected = Simulated(lamp, points);
  int lit = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_NEAR(Pictured(shown, points[i]), expected[i], 1e-9 * (1.0 + expected[i])) << i;
    lit += expected[i] > 1e-3 ? 1 : 0;
  }
  EXPECT_GT(lit, 50);
}

/// The greatest difference of a sky's quadric from its irradiance, of its greatest value.
double GreatestError(const std::shared_ptr<const SkyRadiance>& sky)
{
  Light light;
  light.Type = LightType::Environment;
  light.Intensity = { 1.5 };
  light.Environment = sky;
  light.Direction = Normalized({ 0.1, 0.4, -1.0 });
  light.Reference = LuminaireAxes(light.Direction, { 0, 1, 0 })[0];
  DisplayLight shown;
  shown.Diffuse = { 1, 1, 1 };
  shown.Sky = std::make_shared<const SkyQuadric>(
    ProjectSky(*sky, SkyFrame(light.Direction, light.Reference), { 1.5, 1.5, 1.5 }));
  const std::vector<SurfacePoint> points = RandomPoints(500, 1.0);
  const std::vector<double> expected = Simulated(light, points);
  double error = 0.0;
  double greatest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    error = std::max(error, std::abs(Pictured(shown, points[i]) - expected[i]));
    greatest = std::max(greatest, expected[i]);
  }
  return error / greatest;
}

TEST(ExtendedLights, SkiesStayWithinTheirStatedErrors)
{
  EXPECT_LT(GreatestError(SkyRadiance::Uniform()), 1e-12);
  const Vec3 sun = Normalized({ 0.4, -0.3, 0.7 });
  const auto type = [&](int k, double ground) {
    return GreatestError(SkyRadiance::General(SkyRadiance::TypeCoefficients(k), sun, ground));
  };
  EXPECT_LT(GreatestError(SkyRadiance::Overcast()), 0.005);
  EXPECT_LT(GreatestError(SkyRadiance::Overcast(0.2)), 0.005);
  EXPECT_LT(type(1, 0.0), 0.005);
  EXPECT_LT(type(5, 0.0), 1e-4);
  EXPECT_LT(type(12, 0.0), 0.012);
  EXPECT_LT(type(12, 0.2), 0.012);
  EXPECT_LT(type(14, 0.0), 0.012);
}

TEST(ExtendedLights, RotationMovesTheSkyWithItsAxes)
{
  const auto sky =
    SkyRadiance::General(SkyRadiance::TypeCoefficients(12), Normalized({ 0.4, -0.3, 0.7 }), 0.1);
  const SkyQuadric upright = ProjectSky(*sky, SkyFrame(), { 1, 2, 3 });
  const auto axes = LuminaireAxes({ 0.3, 0.5, -0.7 }, { 1, 0.2, 0 });
  const SkyQuadric turned = upright.Rotated(axes);
  for (const SurfacePoint& p : RandomPoints(50, 1.0))
  {
    const Vec3 seen{ Dot(p.Normal, axes[0]), Dot(p.Normal, axes[1]), Dot(p.Normal, axes[2]) };
    EXPECT_NEAR(turned.Irradiance(seen).g, upright.Irradiance(p.Normal).g, 1e-12);
  }
}

TEST(ExtendedLights, DegenerateInputGivesNoLight)
{
  const std::vector<Vec3> line{ { 0, 0, 1 }, { 1, 0, 1 }, { 2, 0, 1 } };
  EXPECT_NEAR(PolygonFormFactor(line, {}, { 0, 0, 1 }), 0.0, 1e-15);
  const std::vector<Vec3> square{ { 1, -1, 0 }, { -1, -1, 0 }, { -1, 1, 0 }, { 1, 1, 0 } };
  for (const Vec3 where : { Vec3{ 0, 0, 0 }, Vec3{ 1, 1, 0 }, Vec3{ 1, 0, 0 }, Vec3{ 3, 0, 0 } })
  {
    for (const Vec3 normal : { Vec3{ 0, 0, 1 }, Vec3{ 0, 0, -1 }, Vec3{ 1, 0, 0 } })
    {
      const double f = PolygonFormFactor(square, where, normal);
      EXPECT_TRUE(f >= -1.0 && f <= 1.0) << f;
    }
  }
  DisplayLight sky;
  sky.Sky = std::make_shared<const SkyQuadric>(
    ProjectSky(*SkyRadiance::Uniform(), SkyFrame(), { 1, 1, 1 }));
  EXPECT_EQ(Pictured(sky, { {}, {}, -1, {}, 0.0 }), 0.0);
  EXPECT_NEAR(Pictured(sky, { {}, { 0, 0, 1 }, -1, {}, 0.0 }), Pi, 1e-12);
}

} // namespace
