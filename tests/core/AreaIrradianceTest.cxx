// SPDX-License-Identifier: BSD-3-Clause
#include "TestScenes.h"

#include "radiometry/geometry/PolygonFormFactor.h"
#include "radiometry/irradiance/DirectIrradiance.h"
#include "radiometry/irradiance/IrradianceSimulation.h"
#include "radiometry/scene/InputError.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace radiometry;

namespace
{

const double Pi = std::acos(-1.0);

Light Panel(std::vector<Vec3> corners, double exitance, bool twoSided = false)
{
  Light light;
  light.Type = LightType::Area;
  light.Polygon = std::move(corners);
  light.Intensity = { exitance };
  light.TwoSided = twoSided;
  return light;
}
/// A rectangle about `c` with half sides a and b, shining along a x b.
Light Rectangle(const Vec3& c, const Vec3& a, const Vec3& b, double exitance, bool twoSided = false)
{
  return Panel({ c - a - b, c + a - b, c + a + b, c - a + b }, exitance, twoSided);
}

struct World
{
  explicit World(const test::Mesh& mesh, std::vector<Light> lights)
    : Geometry(mesh.ToScene())
    , Occluders(Geometry)
  {
    for (Light& light : lights)
    {
      for (Vec3& p : light.Polygon)
      {
        p = p - this->Geometry.Origin;
      }
      light.Position = light.Position - this->Geometry.Origin;
      this->Geometry.Lights.push_back(light);
    }
  }
  DirectResult Cells(std::size_t count, DirectOptions options = {}) const
  {
    std::vector<Patch> patches = MakePatches(this->Geometry, 0);
    patches.resize(std::min(count, patches.size()));
    return ComputeDirectIrradiance(this->Geometry, this->Occluders, patches, options);
  }
  DirectResult At(const Vec3& p, const Vec3& n, DirectOptions options = {}) const
  {
    SurfacePoint point;
    point.Point = p - this->Geometry.Origin;
    point.Normal = n;
    return ComputeDirectIrradiance(
      this->Geometry, this->Occluders, std::vector<SurfacePoint>{ point }, options);
  }
  Scene Geometry;
  OcclusionScene Occluders;
};

/// A grid on the plane z = 0, front up.
test::Mesh Floor(double size, int n)
{
  test::Mesh mesh;
  mesh.AddGrid({ -0.5 * size, -0.5 * size, 0 }, { size, 0, 0 }, { 0, size, 0 }, n, n);
  return mesh;
}

/// The area light as many Lambertian spots, whose cell averages are exact, shadows included.
std::vector<Light> AsSpots(const Light& panel, int n)
{
  std::vector<Light> spots;
  const Vec3 o = panel.Polygon[0];
  const Vec3 a = panel.Polygon[1] - o;
  const Vec3 b = panel.Polygon[3] - o;
  const Vec3 normal = Normalized(Cross(a, b));
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      Light spot;
      spot.Type = LightType::Spot;
      spot.Position = o + ((i + 0.5) / n) * a + ((j + 0.5) / n) * b;
      spot.Direction = normal;
      spot.CosCutoff = 0.0;
      spot.Exponent = 1.0;
      spot.Intensity = { panel.Intensity[0] * Length(Cross(a, b)) / (Pi * n * n) };
      spots.push_back(spot);
    }
  }
  return spots;
}

/// Counts what a set of values with errors has to keep.
struct Coverage
{
  int Values = 0;
  int Within = 0;
  std::vector<double> Ratios;
  void Add(double value, double error, double exact, double exactError)
  {
    ++this->Values;
    const double off = std::abs(value - exact);
    this->Within += off <= error + exactError;
    if (error > 3.0 * exactError)
    {
      this->Ratios.push_back(error / std::max(off, 1e-300));
    }
  }
  double Share() const { return static_cast<double>(this->Within) / this->Values; }
  double Median()
  {
    std::sort(this->Ratios.begin(), this->Ratios.end());
    return this->Ratios.empty() ? 0.0 : this->Ratios[this->Ratios.size() / 2];
  }
};

} // namespace

TEST(AreaIrradiance, PanelOverAPlane)
{
  // REFERENCES: 2 x 1 m, 1000 cd/m^2, 3 m above: 203.626 lx. Exitance pi L.
  const World w(Floor(10, 1),
    { Rectangle({ 0, 0, 3 }, { 0, 0.5, 0 }, { 1, 0, 0 }, 1000.0 * Pi) });
  const DirectResult r = w.At({ 0, 0, 0 }, { 0, 0, 1 });
  EXPECT_NEAR(r.Irradiance[0], 203.626, 5e-4);
  EXPECT_LE(r.Error[0], 1e-9 * r.Irradiance[0]);
}

TEST(AreaIrradiance, ParallelAndPerpendicularSquares)
{
  test::Mesh floor;
  floor.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  const auto mean = [&](const Light& light) {
    const World w(floor, { light });
    const DirectResult r = w.Cells(2);
    EXPECT_LE(r.Error[0], 1e-5 * r.Irradiance[0]);
    return 0.5 * (r.Irradiance[0] + r.Irradiance[1]);
  };
  EXPECT_NEAR(mean(Panel({ { 0, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, 0, 1 } }, 1.0)),
    0.199824895698387, 2e-7);
  // Upright on the edge x = 0, shining along +x.
  EXPECT_NEAR(mean(Panel({ { 0, 0, 0 }, { 0, 1, 0 }, { 0, 1, 1 }, { 0, 0, 1 } }, 1.0)),
    0.200043776075403, 2e-7);
}

TEST(AreaIrradiance, CoverageBehindRandomBlockers)
{
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Coverage coverage;
  double worst = 0.0;
  for (int trial = 0; trial < 6; ++trial)
  {
    test::Mesh mesh = Floor(2.0, 3);
    const std::size_t floor = mesh.Triangles.size();
    for (int k = 0; k < 1 + 2 * trial; ++k)
    {
      const Vec3 c{ uniform(engine), uniform(engine), 0.5 + 0.3 * uniform(engine) };
      const auto side = [&] {
        return 0.5 * Vec3{ uniform(engine), uniform(engine), 0.5 * uniform(engine) };
      };
      mesh.AddGrid(c, side(), side(), 1, 1);
    }
    const Light panel = Rectangle({ 0.2, 0.1, 1.0 }, { 0, 0.4, 0 }, { 0.3, 0, 0 }, 100.0);
    const World area(mesh, { panel });
    const World fine(mesh, AsSpots(panel, 48));
    const World coarse(mesh, AsSpots(panel, 24));
    DirectOptions options;
    options.RelativeTolerance = 0.01;
    const DirectResult r = area.Cells(floor, options);
    options.RelativeTolerance = 1e-6;
    const DirectResult a = fine.Cells(floor, options);
    const DirectResult b = coarse.Cells(floor, options);
    for (std::size_t i = 0; i < floor; ++i)
    {
      coverage.Add(r.Irradiance[i], r.Error[i], a.Irradiance[i],
        std::abs(a.Irradiance[i] - b.Irradiance[i]) + 1e-12);
      worst = std::max(worst, r.Error[i] / (r.Irradiance[i] + 0.01));
      if (getenv("AREA_VERBOSE"))
        printf("%d %zu: %g +- %g exact %g (%g)  off/err %g\n", trial, i, r.Irradiance[i], r.Error[i],
          a.Irradiance[i], std::abs(a.Irradiance[i] - b.Irradiance[i]),
          std::abs(r.Irradiance[i] - a.Irradiance[i]) / r.Error[i]);
    }
  }
  EXPECT_GE(coverage.Share(), 0.95);
  EXPECT_LE(coverage.Median(), 10.0);
  EXPECT_LE(worst, 0.0101);
}
