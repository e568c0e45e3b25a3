// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/MonteCarloOperator.h"

#include "radiometry/formfactor/DenseOperator.h"
#include "radiometry/irradiance/EmitterIrradiance.h"
#include "radiometry/scene/InputError.h"
#include "tests/core/TestScenes.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

using namespace radiometry;

namespace
{

struct World
{
  explicit World(const test::Mesh& mesh)
    : Geometry(mesh.ToScene())
    , Occluders(Geometry)
    , Elements(Geometry, true)
  {
  }
  Scene Geometry;
  OcclusionScene Occluders;
  ElementSet Elements;
};

/// A box with a smaller one standing in it.
test::Mesh Furnished()
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 2, 3, 1 }, 4, true);
  mesh.AddBox({ 0.5, 0.8, 0.0 }, { 1.1, 1.7, 0.6 }, 3, false);
  return mesh;
}

} // namespace

TEST(MonteCarloOperator, ClosedSceneConservesEnergy)
{
  // Without the inner box's bottom, which lies on the floor: every ray meets a front.
  test::Mesh mesh;
  mesh.AddSphere({ 0, 0, 0 }, 1.5, 8, true);
  mesh.AddBox({ -0.4, -0.3, -0.5 }, { 0.4, 0.3, 0.5 }, 2, false);
  const World w(mesh);
  const MonteCarloOperator f(w.Occluders, w.Elements, {}, 128);
  EXPECT_EQ(f.Closure().ClosedRows, f.Size());
  std::vector<double> one(f.Size(), 1.0), out(f.Size());
  f.Apply(one.data(), out.data(), 1);
  std::vector<double> some(f.Size());
  for (std::size_t i = 0; i < f.Size(); ++i)
  {
    EXPECT_NEAR(f.RowSum(i), 1.0, 1e-15);
    EXPECT_NEAR(out[i], 1.0, 1e-13);
    some[i] = std::sin(static_cast<double>(3 * i)) + 1.0;
  }
  f.Apply(some.data(), out.data(), 1);
  double sent = 0.0, received = 0.0;
  for (std::size_t i = 0; i < f.Size(); ++i)
  {
    sent += f.Areas()[i] * some[i];
    received += f.Areas()[i] * out[i];
  }
  EXPECT_NEAR(received / sent, 1.0, 1e-13);
}

TEST(MonteCarloOperator, AgreesWithDenseWithinTheErrorsOfBoth)
{
  const World w(Furnished());
  ExchangeOptions options;
  options.RelativeTolerance = 1e-3;
  const DenseOperator dense(w.Geometry, w.Occluders, w.Elements, options);
  MonteCarloOperator carlo(w.Occluders, w.Elements, options, 512);
  std::vector<double> source(dense.Size() * 2, 0.0);
  for (std::size_t i = 0; i < dense.Size(); ++i)
  {
    source[2 * i] = 1.0 + (i % 7);
    source[2 * i + 1] = i < 32 ? 5.0 : 0.0; // the floor only
  }
  for (int round = 0; round < 2; ++round)
  {
    std::vector<double> a(source), b(source), ea(source), eb(source), g(source);
    dense.Apply(source.data(), a.data(), 2);
    dense.ApplyError(source.data(), g.data(), ea.data(), 2);
    carlo.Apply(source.data(), b.data(), 2);
    carlo.ApplyError(source.data(), g.data(), eb.data(), 2);
    std::size_t inside = 0, counted = 0;
    double squares = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k)
    {
      const double error = std::hypot(ea[k], eb[k]);
      if (error > 0.0)
      {
        ++counted;
        inside += std::abs(a[k] - b[k]) <= 2.4 * error;
        squares += std::min(25.0, std::pow((a[k] - b[k]) / error, 2));
      }
      else
      {
        EXPECT_NEAR(a[k], b[k], 1e-9);
      }
    }
    EXPECT_GT(counted, a.size() / 2);
    EXPECT_GE(inside, static_cast<std::size_t>(0.92 * counted)) << counted;
    EXPECT_GT(squares / counted, 0.3);
    EXPECT_LT(squares / counted, 2.5);
    carlo.DoubleRays(std::vector<std::uint8_t>(carlo.Size(), 1));
    EXPECT_EQ(carlo.Rays(0), 1024 << round);
  }
}

TEST(MonteCarloOperator, RaysContinueTheSameSequence)
{
  const World w(Furnished());
  MonteCarloOperator grown(w.Occluders, w.Elements, {}, 64);
  std::vector<std::uint8_t> marked(grown.Size(), 1);
  grown.DoubleRays(marked);
  const MonteCarloOperator whole(w.Occluders, w.Elements, {}, 128);
  std::vector<double> source(grown.Size()), a(source), b(source);
  for (std::size_t i = 0; i < source.size(); ++i)
  {
    source[i] = static_cast<double>(i % 11);
  }
  grown.Apply(source.data(), a.data(), 1);
  whole.Apply(source.data(), b.data(), 1);
  for (std::size_t i = 0; i < source.size(); ++i)
  {
    EXPECT_NEAR(a[i], b[i], 1e-12);
  }
}

TEST(MonteCarloOperator, SameBytesForAnyNumberOfThreads)
{
  const World w(Furnished());
  std::vector<double> first;
  for (int threads : { 1, 2, 7 })
  {
    ExchangeOptions options;
    options.Threads = threads;
    const MonteCarloOperator f(w.Occluders, w.Elements, options, 64);
    std::vector<double> in(3 * f.Size()), out(in), error(in), none(in);
    for (std::size_t i = 0; i < in.size(); ++i)
    {
      in[i] = std::cos(static_cast<double>(i));
    }
    f.Apply(in.data(), out.data(), 3);
    f.ApplyError(in.data(), none.data(), error.data(), 3);
    out.insert(out.end(), error.begin(), error.end());
    if (first.empty())
    {
      first = out;
    }
    EXPECT_EQ(std::memcmp(first.data(), out.data(), out.size() * sizeof(double)), 0) << threads;
  }
}

TEST(MonteCarloOperator, MemoryLimit)
{
  const World w(Furnished());
  ExchangeOptions options;
  options.MemoryLimit = 100000;
  EXPECT_THROW(MonteCarloOperator(w.Occluders, w.Elements, options, 4096), InputError);
}

TEST(EmitterIrradiance, SmallLampOverAFloorWithAndWithoutAScreen)
{
  // A lamp of 10 cm, 1.5 m over a grid, half of it behind a screen: against the closed form of the
  // open case at points, and against points for patches.
  test::Mesh mesh;
  mesh.AddGrid({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 6, 6);
  const std::size_t floor = mesh.Triangles.size();
  mesh.AddGrid({ -0.05, -0.05, 1.5 }, { 0, 0.1, 0 }, { 0.1, 0, 0 }, 1, 1);
  const World open(mesh);
  mesh.AddGrid({ 0.0, -0.5, 0.7 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  const World screened(mesh);
  EmitterSet lamp;
  lamp.Bands = 2;
  std::vector<Patch> receivers(
    open.Elements.GetPatches().begin(), open.Elements.GetPatches().begin() + floor);
  lamp.Patches = { open.Elements.GetPatches()[floor], open.Elements.GetPatches()[floor + 1] };
  lamp.Exitance = { 1000.0, 10.0, 1000.0, 10.0 };
  ExchangeOptions options;
  options.RelativeTolerance = 0.005;
  const EmitterResult free = ComputeEmitterIrradiance(open.Geometry, open.Occluders, receivers, lamp, options);
  const EmitterResult partly =
    ComputeEmitterIrradiance(screened.Geometry, screened.Occluders, receivers, lamp, options);
  std::vector<SurfacePoint> points;
  const int grid = 24; // points a receiver
  for (const Patch& p : receivers)
  {
    for (int i = 0; i < grid; ++i)
    {
      for (int j = 0; i + j < grid; ++j)
      {
        const double u = (i + 1.0 / 3.0) / grid, v = (j + 1.0 / 3.0) / grid;
        const Vec3 x =
          p.Corners[0] + u * (p.Corners[1] - p.Corners[0]) + v * (p.Corners[2] - p.Corners[0]);
        points.push_back({ x, { 0, 0, 1 }, p.Triangle, {} });
      }
    }
  }
  const std::size_t each = points.size() / receivers.size();
  const EmitterResult atPoints =
    ComputeEmitterIrradiance(screened.Geometry, screened.Occluders, points, lamp, options);
  const Vec3 middle = 0.5 * (Centroid(lamp.Patches[0].Corners) + Centroid(lamp.Patches[1].Corners));
  int shaded = 0, half = 0, inside = 0;
  for (std::size_t i = 0; i < floor; ++i)
  {
    const Vec3 c = Centroid(receivers[i].Corners);
    const double d2 = LengthSquared(c - middle);
    const double rough = 1000.0 * 0.01 * 1.5 * 1.5 / (std::acos(-1.0) * d2 * d2);
    EXPECT_NEAR(free.Irradiance[2 * i] / rough, 1.0, 0.04);
    EXPECT_NEAR(free.Irradiance[2 * i + 1] * 100.0, free.Irradiance[2 * i], 1e-12);
    EXPECT_LE(free.Error[2 * i], 1e-4 * free.Irradiance[2 * i]);
    double mean = 0.0;
    for (std::size_t k = 0; k < each; ++k)
    {
      mean += atPoints.Irradiance[2 * (i * each + k)] / each;
    }
    const double v = partly.Irradiance[2 * i] / free.Irradiance[2 * i];
    shaded += v == 0.0;
    half += v > 0.01 && v < 0.99;
    inside += std::abs(partly.Irradiance[2 * i] - mean) <=
      partly.Error[2 * i] + 0.01 * free.Irradiance[2 * i];
  }
  EXPECT_GT(shaded, 5);
  EXPECT_GT(half, 5);
  EXPECT_GE(inside, static_cast<int>(0.95 * floor));
}
