// SPDX-License-Identifier: BSD-3-Clause
// Radiance along a line in vacuum is constant: measured through two small apertures at many distances,
// with the project's own exchange.
#include "radiometry/formfactor/ViewFactors.h"
#include "radiometry/irradiance/DirectIrradiance.h"
#include "radiometry/irradiance/SeenSurface.h"
#include "radiometry/irradiance/IrradianceSimulation.h"
#include "tests/core/TestScenes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace radiometry;

namespace
{

const double Pi = std::acos(-1.0);

/// Two square apertures of side `a` and `b` at distance r, the second turned by an angle about y and
/// moved aside; the first looks up. Front faces front.
test::Mesh Apertures(double a, double b, double r, double aside, double turn)
{
  test::Mesh mesh;
  mesh.AddGrid({ -0.5 * a, -0.5 * a, 0 }, { a, 0, 0 }, { 0, a, 0 }, 1, 1);
  const Vec3 u{ std::cos(turn), 0, std::sin(turn) };
  const Vec3 center{ aside * r, 0, r };
  mesh.AddGrid(center - 0.5 * b * u - Vec3{ 0, 0.5 * b, 0 }, { 0, b, 0 }, b * u, 1, 1);
  return mesh;
}

} // namespace

TEST(RadianceAlongALine, ThroughTwoApertures)
{
  // The flux that goes through both is L G, G = pi A1 F12 their geometric extent. The first sends M: the
  // flux that arrives is that of the irradiance which the second receives.
  const double exitance = 3.0;
  for (const double r : { 1e-2, 0.1, 1.0, 10.0, 100.0 })
  {
    for (const double aside : { 0.0, 0.6 })
    {
      const double a = 1e-3, b = 2e-3; // m: as small as the nearest distance lets them be
      const test::Mesh mesh = Apertures(a, b, r, aside, aside > 0.0 ? 0.3 : 0.0);
      Scene scene = mesh.ToScene(0.0);
      ViewFactorOptions options;
      options.RelativeTolerance = 1e-7;
      options.AbsoluteTolerance = 0.0;
      const ViewFactorResult factors = ComputeViewFactors(scene, { 0, 0, 1, 1 }, 2, options);
      double f12 = 0.0;
      for (const ViewFactorRow& row : factors.Rows)
      {
        f12 = row.From == 0 && row.To == 1 ? row.Value : f12;
      }
      const double extent = Pi * factors.Areas[0] * f12;

      Light light;
      light.Type = LightType::Area;
      const double h = 0.5 * a;
      for (const Vec3& corner : { Vec3{ -h, -h, 0 }, Vec3{ h, -h, 0 }, Vec3{ h, h, 0 }, Vec3{ -h, h, 0 } })
      {
        light.Polygon.push_back(corner - scene.Origin);
      }
      light.Intensity = { exitance };
      scene.Lights.push_back(light);
      const OcclusionScene occluders(scene);
      DirectOptions direct;
      direct.RelativeTolerance = 1e-7;
      direct.Occlusion = false;
      const DirectResult irradiance =
        ComputeDirectIrradiance(scene, occluders, MakePatches(scene, 0), direct);
      double flux = 0.0;
      for (std::size_t t = 2; t < 4; ++t)
      {
        flux += irradiance.Irradiance[t] * Area(scene.TriangleAt(t));
      }
      EXPECT_NEAR(flux / extent, exitance / Pi, 1e-5 * exitance / Pi) << r << ' ' << aside;

      // And by what an eye in the second sees of the first: L = E/projected solid angle.
      Viewer eye;
      eye.Eye = Vec3{ aside * r, 0, r } - scene.Origin;
      eye.Normal = Normalized(AreaNormal2(scene.TriangleAt(2)));
      const SeenSurface seen = LookAtCells(scene, eye);
      SurfacePoint sensor;
      sensor.Point = eye.Eye;
      sensor.Normal = eye.Normal;
      const DirectResult there =
        ComputeDirectIrradiance(scene, occluders, std::vector<SurfacePoint>{ sensor }, direct);
      EXPECT_NEAR(there.Irradiance[0] / (seen.Projected[0] + seen.Projected[1]), exitance / Pi,
        1e-9 * exitance / Pi)
        << r << ' ' << aside;
    }
  }
}
