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
  for (int trial = 0; trial < 5; ++trial)
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
    const World fine(mesh, AsSpots(panel, 32));
    const World coarse(mesh, AsSpots(panel, 16));
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
    }
  }
  EXPECT_GE(coverage.Share(), 0.95);
  EXPECT_LE(coverage.Median(), 10.0);
  EXPECT_LE(worst, 0.0101);
}

TEST(AreaIrradiance, RegularPolygonOnItsAxis)
{
  const int n = 40;
  const double radius = 0.7, height = 1.3;
  std::vector<Vec3> corners;
  for (int k = 0; k < n; ++k)
  {
    corners.push_back({ radius * std::cos(2.0 * Pi * k / n), -radius * std::sin(2.0 * Pi * k / n),
      height }); // shines down
  }
  const double apothem = radius * std::cos(Pi / n), side = 2.0 * radius * std::sin(Pi / n);
  const double slant = std::hypot(height, apothem);
  const double exact = n * 2.0 * std::atan(0.5 * side / slant) * apothem / (2.0 * Pi * slant);
  const World w(Floor(10, 1), { Panel(corners, 3.0) });
  EXPECT_NEAR(w.At({ 0, 0, 0 }, { 0, 0, 1 }).Irradiance[0], 3.0 * exact, 1e-12);
}

TEST(AreaIrradiance, FarAwayItIsAPointLight)
{
  const World w(Floor(10, 1), { Rectangle({ 3e4, 0, 4e4 }, { 0, 0.5, 0 }, { 0.5, 0, 0 }, 100.0) });
  // I = M A cos/pi, E = I cos/r^2 with both cosines 0.8 and r = 5e4.
  EXPECT_NEAR(w.At({ 0, 0, 0 }, { 0, 0, 1 }).Irradiance[0] / (100.0 / Pi * 0.64 / 25e8), 1.0, 1e-8);
}

TEST(AreaIrradiance, ConcaveIsTheSumOfItsPartsAndBothSidesShine)
{
  const std::vector<Vec3> ell{ { 0, 0, 1 }, { 0, 2, 1 }, { 1, 2, 1 }, { 1, 1, 1 }, { 2, 1, 1 },
    { 2, 0, 1 } };
  const std::vector<Vec3> a{ { 0, 0, 1 }, { 0, 2, 1 }, { 1, 2, 1 }, { 1, 0, 1 } };
  const std::vector<Vec3> b{ { 1, 0, 1 }, { 1, 1, 1 }, { 2, 1, 1 }, { 2, 0, 1 } };
  const World whole(Floor(4, 3), { Panel(ell, 2.0) });
  const World parts(Floor(4, 3), { Panel(a, 2.0), Panel(b, 2.0) });
  std::vector<Vec3> back = ell;
  std::reverse(back.begin(), back.end());
  const World turned(Floor(4, 3), { Panel(back, 2.0) });
  const World both(Floor(4, 3), { Panel(back, 2.0, true) });
  const DirectResult w = whole.Cells(18), p = parts.Cells(18), t = turned.Cells(18),
                     s = both.Cells(18);
  for (int i = 0; i < 18; ++i)
  {
    EXPECT_GT(w.Irradiance[i], 0.0);
    EXPECT_NEAR(w.Irradiance[i], p.Irradiance[i], w.Error[i] + p.Error[i]);
    EXPECT_EQ(t.Irradiance[i], 0.0);
    EXPECT_NEAR(s.Irradiance[i], w.Irradiance[i], w.Error[i] + s.Error[i]);
  }
  const Vec3 x{ 0.3, 0.4, 0 };
  EXPECT_NEAR(whole.At(x, { 0, 0, 1 }).Irradiance[0], parts.At(x, { 0, 0, 1 }).Irradiance[0], 1e-13);
}

TEST(AreaIrradiance, BehindAHalfPlane)
{
  // A plate at half the panel's height hides what lies beyond its edge x = 0: from (x, y) the panel
  // is seen where its own x is below -x.
  test::Mesh mesh = Floor(2.0, 4);
  const std::size_t floor = mesh.Triangles.size();
  mesh.AddGrid({ 0, -50, 0.5 }, { 100, 0, 0 }, { 0, 100, 0 }, 1, 1);
  const World w(mesh, { Rectangle({ 0, 0, 1 }, { 0, 0.5, 0 }, { 0.6, 0, 0 }, 10.0) });
  const auto exact = [](const Vec3& p) {
    const double edge = std::min(0.6, -p.x);
    SmallPolygon seen;
    seen.N = 4;
    seen.P[0] = { -0.6, -0.5, 1 };
    seen.P[1] = { -0.6, 0.5, 1 };
    seen.P[2] = { edge, 0.5, 1 };
    seen.P[3] = { edge, -0.5, 1 };
    return edge > -0.6 ? 10.0 * PointToPolygon(p, { 0, 0, 1 }, seen) : 0.0;
  };
  for (const double x : { -0.9, -0.6, -0.3, 0.0, 0.1, 0.45, 0.6, 0.9 })
  {
    const DirectResult r = w.At({ x, 0.2, 0 }, { 0, 0, 1 });
    EXPECT_NEAR(r.Irradiance[0], exact({ x, 0.2, 0 }), 1e-12) << x;
    EXPECT_LE(r.Error[0], 1e-11);
  }
  const DirectResult cells = w.Cells(floor);
  const std::vector<Patch> patches = MakePatches(w.Geometry, 0);
  Coverage coverage;
  for (std::size_t i = 0; i < floor; ++i)
  {
    const Triangle3& c = patches[i].Corners;
    const int n = 60;
    double sum = 0.0;
    for (int a = 0; a < n; ++a)
    {
      for (int b = 0; b < 2 * a + 1; ++b)
      {
        // Centroids of the n^2 small triangles.
        const double row = (a + (b % 2 ? 1.0 / 3.0 : 2.0 / 3.0)) / n;
        const double along = (b / 2 + (b % 2 ? 2.0 / 3.0 : 1.0 / 3.0)) / n;
        sum += exact(c[0] + row * (c[1] - c[0]) + along * (c[2] - c[1]) + w.Geometry.Origin);
      }
    }
    const double mean = sum / (n * n);
    coverage.Add(cells.Irradiance[i], cells.Error[i], mean, 2e-4);
    EXPECT_LE(cells.Error[i], 0.01 * cells.Irradiance[i] + 1e-3);
    EXPECT_NEAR(cells.Irradiance[i], mean, 2.0 * cells.Error[i] + 2e-4);
  }
  EXPECT_GE(coverage.Share(), 0.95);
}

TEST(AreaIrradiance, ReciprocityPastABlocker)
{
  const Triangle3 low{ Vec3{ 0, 0, 0 }, Vec3{ 1, 0, 0 }, Vec3{ 0, 1, 0 } };
  const Triangle3 high{ Vec3{ 0.2, 0.1, 1 }, Vec3{ 0.3, 1.1, 1.2 }, Vec3{ 1.2, 0.2, 0.8 } };
  const auto exchange = [](const Triangle3& to, const Triangle3& from, double& error) {
    test::Mesh mesh;
    mesh.Points = { to[0], to[1], to[2] };
    mesh.Triangles = { { 0, 1, 2 } };
    mesh.AddGrid({ 0.2, 0.2, 0.5 }, { 0.4, 0, 0.1 }, { 0, 0.3, 0 }, 1, 1);
    const World w(mesh, { Panel({ from[0], from[1], from[2] }, 1.0) });
    const DirectResult r = w.Cells(1);
    error = r.Error[0] * Area(to);
    return r.Irradiance[0] * Area(to);
  };
  double e1 = 0.0, e2 = 0.0;
  const double forth = exchange(low, high, e1), back = exchange(high, low, e2);
  EXPECT_GT(forth, 0.0);
  EXPECT_NEAR(forth, back, std::hypot(e1, e2) + 1e-12);
}

TEST(AreaIrradiance, InThePlaneTouchingAndNearlySo)
{
  test::Mesh floor;
  floor.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  const auto lit = [&](const Light& light) { return World(floor, { light }).Cells(2); };
  // In the cells' plane, beside them and on them: nothing, for it shines past.
  EXPECT_EQ(lit(Rectangle({ 3, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 1.0, true)).Irradiance[0], 0.0);
  EXPECT_EQ(lit(Rectangle({ 0.5, 0.5, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 1.0)).Irradiance[0], 0.0);
  // Right above a cell, larger than it: the exitance arrives whole, to within the rim.
  for (const double gap : { 1e-3, 1e-6, 1e-9 })
  {
    const DirectResult r = lit(Rectangle({ 0.5, 0.5, gap }, { 0, 1, 0 }, { 1, 0, 0 }, 5.0));
    EXPECT_NEAR(r.Irradiance[0], 5.0, 5.0 * gap);
    EXPECT_LE(r.Error[0], 1e-3);
  }
  // Upright through the cells' plane: only what stands above counts, on both sides.
  const DirectResult through =
    lit(Rectangle({ 0.5, 0.5, 0 }, { 0, 0.5, 0 }, { 0, 0, 0.5 }, 1.0, true));
  const DirectResult above =
    lit(Rectangle({ 0.5, 0.5, 0.25 }, { 0, 0.5, 0 }, { 0, 0, 0.25 }, 1.0, true));
  EXPECT_GT(above.Irradiance[0], 0.1);
  EXPECT_NEAR(through.Irradiance[0], above.Irradiance[0], 1e-6);
  EXPECT_NEAR(through.Irradiance[1], above.Irradiance[1], 1e-6);
}

TEST(AreaIrradiance, ExactlyNothingBehindAWall)
{
  for (const int n : { 1, 3, 24 })
  {
    test::Mesh mesh = Floor(1.0, 5);
    const std::size_t floor = mesh.Triangles.size();
    mesh.AddGrid({ -2, -2, 0.5 }, { 4, 0, 0 }, { 0, 4, 0 }, n, n);
    const World w(mesh, { Rectangle({ 0, 0, 1 }, { 0, 0.4, 0 }, { 0.4, 0, 0 }, 1e6) });
    const DirectResult r = w.Cells(floor);
    for (std::size_t i = 0; i < floor; ++i)
    {
      EXPECT_EQ(r.Irradiance[i], 0.0) << n;
      EXPECT_EQ(r.Error[i], 0.0) << n;
    }
    EXPECT_EQ(r.Rays, 0);
    EXPECT_GT(r.PeakUnshadowed, 1e4);
    EXPECT_EQ(w.At({ 0.1, 0.2, 0 }, { 0, 0, 1 }).Irradiance[0], 0.0);
  }
}

TEST(AreaIrradiance, ClosedBoxesNeitherLeakInNorOut)
{
  for (const bool inward : { true, false })
  {
    test::Mesh mesh;
    mesh.AddBox({ 0, 0, 0 }, { 1, 1.1, 0.9 }, 3, inward);
    // Seen from inside: panels outside, near a wall, an edge, a corner. Seen from outside: inside.
    std::vector<Light> lights;
    if (inward)
    {
      lights = { Rectangle({ 0.5, 0.5, 0.9001 }, { 0, 0.3, 0 }, { 0.3, 0, 0 }, 1.0, true),
        Rectangle({ 1.0001, 0.5, 0.9001 }, { 0, 1, 0 }, { 0.01, 0, -0.01 }, 1.0, true),
        Rectangle({ 1.01, 1.11, 0.91 }, { 0, 0.005, 0 }, { 0.005, 0, 0 }, 1.0, true) };
    }
    else
    {
      lights = { Rectangle({ 0.5, 0.5, 0.8999 }, { 0, 0.3, 0 }, { 0.3, 0, 0 }, 1.0, true),
        Rectangle({ 0.5, 0.55, 0.45 }, { 0, 0.5, 0 }, { 0, 0, 0.4 }, 1.0, true) };
    }
    const World w(mesh, lights);
    const DirectResult r = w.Cells(mesh.Triangles.size());
    for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
    {
      EXPECT_EQ(r.Irradiance[i], 0.0) << inward << " " << i;
    }
  }
}

TEST(AreaIrradiance, SameBytesForAnyThreads)
{
  test::Mesh mesh = Floor(2.0, 6);
  const std::size_t floor = mesh.Triangles.size();
  mesh.AddSphere({ 0.1, 0, 0.5 }, 0.2, 5, false);
  const World w(mesh, { Rectangle({ 0, 0, 1 }, { 0, 0.4, 0 }, { 0.4, 0, 0 }, 10.0) });
  DirectOptions options;
  options.Threads = 1;
  const DirectResult one = w.Cells(floor, options);
  for (const int threads : { 2, 7 })
  {
    options.Threads = threads;
    const DirectResult r = w.Cells(floor, options);
    EXPECT_EQ(r.Irradiance, one.Irradiance);
    EXPECT_EQ(r.Error, one.Error);
  }
}

TEST(AreaIrradiance, SameAtAnyScaleAndFarFromTheOrigin)
{
  const auto lit = [](double scale, const Vec3& shift) {
    test::Mesh mesh = Floor(2.0, 3);
    const std::size_t floor = mesh.Triangles.size();
    mesh.AddGrid({ -0.2, -0.3, 0.5 }, { 0.5, 0, 0 }, { 0, 0.4, 0.1 }, 1, 1);
    mesh.AddBox({ 0.5, 0.5, 0.0 }, { 0.7, 0.8, 0.5 }, 1, false);
    Light panel = Rectangle({ 0.2, 0.1, 1.0 }, { 0, 0.4, 0 }, { 0.3, 0, 0 }, 100.0);
    for (Vec3& p : mesh.Points)
    {
      p = scale * p + shift;
    }
    for (Vec3& p : panel.Polygon)
    {
      p = scale * p + shift;
    }
    return World(mesh, { panel }).Cells(floor).Irradiance;
  };
  const std::vector<double> plain = lit(1.0, {});
  for (const double scale : { 1e-6, 1e9 })
  {
    const std::vector<double> other = lit(scale, {});
    for (std::size_t i = 0; i < plain.size(); ++i)
    {
      EXPECT_NEAR(other[i], plain[i], 1e-6 * plain[i]) << scale << " " << i;
    }
  }
  const std::vector<double> utm = lit(1.0, { 5e5, 4e6, 0.0 });
  for (std::size_t i = 0; i < plain.size(); ++i)
  {
    EXPECT_NEAR(utm[i], plain[i], 1e-6 * plain[i]) << i;
  }
}

TEST(AreaIrradiance, OfManyPanelsOnlyThoseThatMatter)
{
  std::vector<Light> panels;
  for (int i = -20; i < 20; ++i)
  {
    for (int j = -20; j < 20; ++j)
    {
      panels.push_back(Rectangle({ 4.0 * i, 4.0 * j, 2 }, { 0, 0.2, 0 }, { 0.2, 0, 0 }, 100.0));
    }
  }
  const World w(Floor(8.0, 4), panels);
  DirectOptions options;
  options.Occlusion = false;
  options.RelativeTolerance = 0.01;
  const DirectResult loose = w.Cells(32, options);
  options.RelativeTolerance = 1e-9;
  const DirectResult tight = w.Cells(32, options);
  int dropped = 0;
  for (int i = 0; i < 32; ++i)
  {
    EXPECT_NEAR(loose.Irradiance[i], tight.Irradiance[i], loose.Error[i] + tight.Error[i]);
    EXPECT_LE(loose.Error[i], 0.01 * loose.Irradiance[i]);
    dropped += loose.Irradiance[i] < (1.0 - 1e-6) * tight.Irradiance[i];
  }
  EXPECT_GT(dropped, 0);
  EXPECT_GE(loose.PeakUnshadowed, *std::max_element(
      tight.Irradiance.begin(), tight.Irradiance.end()) * (1.0 - 1e-9));
}

TEST(AreaIrradiance, EmittingTrianglesLightOthersAndNeverThemselves)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 2, true);
  World w(mesh, {});
  // Everything emits 3: inside a closed box each cell gets 3 times the share of what it sees.
  w.Geometry.Optics.EmittedExitance[0].assign(w.Geometry.Cells, 3.0);
  DirectOptions options;
  EXPECT_EQ(w.Cells(48, options).Irradiance[0], 0.0);
  options.Emission = true;
  const DirectResult r = w.Cells(48, options);
  for (int i = 0; i < 48; ++i)
  {
    EXPECT_NEAR(r.Irradiance[i], 3.0, r.Error[i] + 3e-5); // flat faces see nothing of themselves
  }
  const DirectResult middle = w.At({ 0.3, 0.4, 0.5 }, { 1, 0, 0 }, options);
  EXPECT_NEAR(middle.Irradiance[0], 3.0, 1e-9);
}

TEST(AreaIrradiance, OutOfTimeItSaysSo)
{
  test::Mesh mesh = Floor(2.0, 8);
  mesh.AddSphere({ 0.1, 0, 0.5 }, 0.3, 8, false);
  const World w(mesh, { Rectangle({ 0, 0, 1 }, { 0, 0.4, 0 }, { 0.4, 0, 0 }, 10.0) });
  DirectOptions options;
  const DirectResult full = w.Cells(128, options);
  options.SecondsLeft = 1e-9;
  const DirectResult cut = w.Cells(128, options);
  EXPECT_FALSE(full.TimedOut);
  EXPECT_TRUE(cut.TimedOut);
  for (int i = 0; i < 128; ++i)
  {
    EXPECT_NEAR(cut.Irradiance[i], full.Irradiance[i], cut.Error[i] + full.Error[i] + 1e-9);
  }
}

TEST(AreaIrradiance, BadPolygonsAreNamed)
{
  const auto expect = [](const std::vector<Vec3>& corners, const char* word) {
    const World w(Floor(1, 1), { Panel(corners, 1.0) });
    try
    {
      w.Cells(2);
      FAIL() << word;
    }
    catch (const InputError& error)
    {
      EXPECT_EQ(error.Array, "Polygons");
      EXPECT_NE(error.Expected.find(word), std::string::npos) << error.Expected;
    }
  };
  expect({ { 0, 0, 1 }, { 1, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 } }, "cross");
  expect({ { 0, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1.2 }, { 1, 0, 1 } }, "flat");
  // A hole reached by a bridge is no crossing; nothing has no area.
  const std::vector<Vec3> ring{ { 0, 0, 1 }, { 0, 3, 1 }, { 3, 3, 1 }, { 3, 0, 1 }, { 0, 0, 1 },
    { 1, 1, 1 }, { 2, 1, 1 }, { 2, 2, 1 }, { 1, 2, 1 }, { 1, 1, 1 } };
  const World holed(Floor(1, 1), { Panel(ring, 1.0) });
  const World full(Floor(1, 1), { Rectangle({ 1.5, 1.5, 1 }, { 0, 1.5, 0 }, { 1.5, 0, 0 }, 1.0) });
  const World hole(Floor(1, 1), { Rectangle({ 1.5, 1.5, 1 }, { 0, 0.5, 0 }, { 0.5, 0, 0 }, 1.0) });
  EXPECT_NEAR(holed.At({ 1, 2, 0 }, { 0, 0, 1 }).Irradiance[0],
    full.At({ 1, 2, 0 }, { 0, 0, 1 }).Irradiance[0] -
      hole.At({ 1, 2, 0 }, { 0, 0, 1 }).Irradiance[0],
    1e-12);
  const World line(Floor(1, 1), { Panel({ { 0, 0, 1 }, { 1, 0, 1 }, { 2, 0, 1 } }, 1.0) });
  EXPECT_EQ(line.Cells(2).Irradiance[0], 0.0);
}

TEST(AreaIrradiance, ConvexGroupsCastTheShadowsOfTheirTriangles)
{
  // A ball, a box that stands on the floor and a divided plate, against the same with one triangle
  // missing (a gap too small to matter): those are taken triangle by triangle.
  const auto lit = [](bool broken, const Vec3& x) {
    test::Mesh mesh = Floor(4.0, 1);
    const auto chip = [&](std::size_t first) {
      // Replaces a triangle by nearly all of it, no longer joined to the others.
      auto& t = mesh.Triangles[first];
      const auto n = static_cast<std::int32_t>(mesh.Points.size());
      const Vec3 a = mesh.Points[t[0]], b = mesh.Points[t[1]], c = mesh.Points[t[2]];
      const Vec3 m = (a + b + c) / 3.0;
      for (const Vec3& p : { a, b, c })
      {
        mesh.Points.push_back(p + 1e-9 * (m - p));
      }
      t = { n, n + 1, n + 2 };
    };
    std::size_t at = mesh.Triangles.size();
    mesh.AddSphere({ 0.1, -0.2, 0.6 }, 0.25, 9, false);
    broken ? chip(at) : void();
    at = mesh.Triangles.size();
    mesh.AddBox({ 0.4, 0.3, 0 }, { 0.7, 0.5, 0.5 }, 2, false);
    broken ? chip(at) : void();
    at = mesh.Triangles.size();
    mesh.AddGrid({ -0.7, 0.1, 0.8 }, { 0.4, 0, 0.1 }, { 0.1, 0.3, 0 }, 4, 3);
    broken ? chip(at) : void();
    const World w(mesh, { Rectangle({ 0, 0, 1.2 }, { 0, 0.4, 0 }, { 0.5, 0, 0 }, 10.0) });
    return w.At(x, { 0, 0, 1 }).Irradiance[0];
  };
  int partly = 0;
  for (const Vec3& x : { Vec3{ 0, 0, 0 }, Vec3{ 0.9, 0.7, 0 }, Vec3{ 0.39, 0.4, 0 },
         Vec3{ -0.8, 0.4, 0 }, Vec3{ 0.55, 0.4, 0.1 }, Vec3{ 0.1, -0.2, 0.2 }, Vec3{ 0.5, -0.5, 0 },
         Vec3{ 0.8, 0.5, 0 }, Vec3{ -0.45, 0.3, 0.5 } })
  {
    const double grouped = lit(false, x);
    EXPECT_NEAR(grouped, lit(true, x), 1e-6) << x.x << " " << x.y << " " << x.z;
    partly += grouped > 0.0;
  }
  EXPECT_GE(partly, 6);
}
