// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/DirectIrradiance.h"
#include "radiometry/irradiance/LightTree.h"
#include "tests/core/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

using namespace radiometry;

namespace
{

const double Pi = std::acos(-1.0);

struct Random
{
  std::mt19937 Engine{ 11 };
  std::uniform_real_distribution<double> Uniform{ 0.0, 1.0 };
  double operator()() { return this->Uniform(this->Engine); }
  Vec3 Direction()
  {
    const double z = 2 * (*this)() - 1;
    const double a = 2 * Pi * (*this)();
    const double s = std::sqrt(1 - z * z);
    return { s * std::cos(a), s * std::sin(a), z };
  }
};

/// Lights of all kinds that a beam may be.
std::vector<Light> RandomLights(Random& random, int count, const Vec3& low, const Vec3& high)
{
  std::vector<Light> lights;
  for (int k = 0; k < count; ++k)
  {
    Light light;
    light.Position = { low.x + (high.x - low.x) * random(), low.y + (high.y - low.y) * random(),
      low.z + (high.z - low.z) * random() };
    light.Direction = random.Direction();
    light.Intensity = { std::exp(3 * random()), random() };
    switch (k % 5)
    {
      case 1:
        light.Type = LightType::Spot;
        light.CosCutoff = std::cos(0.1 + 1.4 * random());
        light.Exponent = k % 2 == 0 ? 0.0 : 20 * random();
        break;
      case 2:
        light.Attenuation[0] = random();
        light.Attenuation[1] = random();
        break;
      case 3:
        light.Type = LightType::Spot;
        light.SmoothEdge = true;
        light.CosInnerCutoff = std::cos(0.3);
        light.CosCutoff = std::cos(0.5);
        break;
      case 4:
        if (k % 20 == 4)
        {
          light.Type = LightType::Directional;
          light.Intensity = { 0.01 * random(), 0.01 };
        }
        break;
      default:
        break;
    }
    lights.push_back(light);
  }
  return lights;
}

TEST(LightTree, NoLightExceedsItsBound)
{
  Random random;
  std::vector<std::unique_ptr<SourceFlux>> sources;
  for (const Light& light : RandomLights(random, 300, { -2, -2, -2 }, { 2, 2, 2 }))
  {
    sources.push_back(std::make_unique<SourceFlux>(light, true, true));
  }
  const LightTree tree(sources, 2);
  int positive = 0;
  int tight = 0;
  for (int k = 0; k < 300; ++k)
  {
    const Vec3 place{ 3 * random() - 1.5, 3 * random() - 1.5, 3 * random() - 1.5 };
    const double size = std::pow(10.0, -3 * random());
    const double spread = k % 3 == 0 ? 0.0 : 0.8 * random();
    const Vec3 mean = random.Direction();
    ReceiverBounds bounds;
    bounds.Greatest = std::numeric_limits<double>::infinity();
    bounds.Normal = mean;
    bounds.CosSpread = std::cos(spread) - 1e-12;
    std::vector<std::pair<Vec3, Vec3>> points;
    for (int j = 0; j < 8; ++j)
    {
      const Vec3 p = place + size * Vec3{ random(), random(), random() };
      const Vec3 off = random.Direction();
      const Vec3 aside = Normalized(off - Dot(off, mean) * mean);
      const double angle = spread * random();
      bounds.Box.Add(p);
      points.emplace_back(p, std::cos(angle) * mean + std::sin(angle) * aside);
    }
    // The greatest bound of all entries above a light must hold for it: follow each way down.
    std::vector<std::pair<std::int32_t, double>> stack;
    for (const std::int32_t root : tree.Roots())
    {
      stack.push_back({ root, std::numeric_limits<double>::infinity() });
    }
    while (!stack.empty())
    {
      const auto [entry, above] = stack.back();
      stack.pop_back();
      const double gain = std::min(above, tree.Gain(entry, bounds));
      if (!tree.IsLight(entry))
      {
        stack.push_back({ tree.Children(entry)[0], gain });
        stack.push_back({ tree.Children(entry)[1], gain });
        continue;
      }
      double most = 0.0;
      for (const auto& [p, n] : points)
      {
        most = std::max(most, sources[tree.LightOf(entry)]->AtPoint(p, n));
      }
      EXPECT_LE(most, gain * (1 + 1e-9) + 1e-300);
      positive += most > 0.0 ? 1 : 0;
      tight += most > 0.3 * gain && most > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(positive, 10000);
  EXPECT_GT(tight, positive / 4); // a bound of infinity would hold, too
}

/// Each light by itself, summed up.
DirectResult OneByOne(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const DirectOptions& options)
{
  DirectResult sum;
  sum.Irradiance.assign(patches.size() * scene.Optics.Bands, 0.0);
  Scene single = scene;
  for (const Light& light : scene.Lights)
  {
    single.Lights = { light };
    const DirectResult r = ComputeDirectIrradiance(single, occluders, patches, options);
    for (std::size_t k = 0; k < sum.Irradiance.size(); ++k)
    {
      sum.Irradiance[k] += r.Irradiance[k];
    }
  }
  return sum;
}

struct Room
{
  Scene Geometry;
  std::vector<Patch> Patches;

  explicit Room(int lights, double span = 1.0)
  {
    test::Mesh mesh;
    mesh.AddGrid({ -4, -4, 0 }, { 8, 0, 0 }, { 0, 8, 0 }, 24, 24);
    mesh.AddSphere({ 0.4, 0.3, 0.8 }, 0.5, 8, false);
    mesh.AddBox({ -2, -1, 0 }, { -1, 0, 1.5 }, 2, false);
    this->Geometry = mesh.ToScene();
    this->Geometry.Optics.Bands = 2;
    Random random;
    this->Geometry.Lights =
      RandomLights(random, lights, { -4 * span, -4 * span, 0.2 }, { 4 * span, 4 * span, 2.5 });
    for (Light& light : this->Geometry.Lights)
    {
      light.Position = light.Position - this->Geometry.Origin;
    }
    for (std::size_t t = 0; t < this->Geometry.Triangles.size(); ++t)
    {
      this->Patches.push_back(
        { this->Geometry.TriangleAt(t), static_cast<std::int32_t>(t), 0, 0 });
    }
  }
};

/// Counts values whose difference is within their error, and checks the tolerance.
void ExpectCovered(const DirectResult& got, const DirectResult& wanted, double tolerance)
{
  int covered = 0;
  int wanting = 0;
  for (std::size_t k = 0; k < got.Irradiance.size(); ++k)
  {
    const double difference = std::fabs(got.Irradiance[k] - wanted.Irradiance[k]);
    covered += difference <= got.Error[k] + 1e-12 * wanted.Irradiance[k] ? 1 : 0;
    wanting += got.Error[k] > 1.001 * tolerance * got.Irradiance[k] + 1e-12 ? 1 : 0;
  }
  EXPECT_GE(covered, 0.95 * static_cast<double>(got.Irradiance.size()));
  EXPECT_LE(wanting, 0.02 * static_cast<double>(got.Irradiance.size()));
}

TEST(ManyLights, AgreeWithEachLightByItself)
{
  const Room room(300);
  const OcclusionScene occluders(room.Geometry);
  DirectOptions exact;
  exact.RelativeTolerance = 1e-7;
  const DirectResult reference = OneByOne(room.Geometry, occluders, room.Patches, exact);
  for (const double tolerance : { 1e-7, 0.01, 0.1 })
  {
    DirectOptions options;
    options.RelativeTolerance = tolerance;
    const DirectResult r =
      ComputeDirectIrradiance(room.Geometry, occluders, room.Patches, options);
    ExpectCovered(r, reference, tolerance);
    EXPECT_LE(r.DroppedMean, r.DroppedPeak);
  }
}

TEST(ManyLights, FarLightsAreDroppedAndTheBoundIsPartOfTheError)
{
  // Eight lamps near a small floor and five hundred a hundred metres away.
  test::Mesh mesh;
  mesh.AddGrid({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 8, 8);
  Scene scene = mesh.ToScene();
  Random random;
  for (int k = 0; k < 508; ++k)
  {
    Light light;
    light.Intensity = { 1.0 };
    const double far = k < 8 ? 0.0 : 300.0;
    light.Position = { far + random(), random(), 0.5 + 0.5 * random() };
    scene.Lights.push_back(light);
  }
  const OcclusionScene occluders(scene);
  std::vector<Patch> patches;
  for (std::size_t t = 0; t < scene.Triangles.size(); ++t)
  {
    patches.push_back({ scene.TriangleAt(t), static_cast<std::int32_t>(t), 0, 0 });
  }
  DirectOptions options;
  const DirectResult r = ComputeDirectIrradiance(scene, occluders, patches, options);
  options.RelativeTolerance = 1e-9;
  const DirectResult all = ComputeDirectIrradiance(scene, occluders, patches, options);
  EXPECT_GT(r.DroppedPeak, 0.0);
  EXPECT_LT(r.Rays, all.Rays / 10);
  for (std::size_t k = 0; k < patches.size(); ++k)
  {
    EXPECT_LE(std::fabs(r.Irradiance[k] - all.Irradiance[k]), r.Error[k]);
    EXPECT_LE(r.Error[k], 0.01 * r.Irradiance[k]);
    EXPECT_GT(r.Error[k], 1e-9 * r.Irradiance[k]);
  }
}

TEST(ManyLights, SamplesAreHonest)
{
  const Room room(600);
  const OcclusionScene occluders(room.Geometry);
  occluders.Lines(room.Geometry, 0);
  DirectOptions exact;
  exact.RelativeTolerance = 1e-5;
  const DirectResult reference =
    ComputeDirectIrradiance(room.Geometry, occluders, room.Patches, exact);
  DirectOptions options;
  options.RelativeTolerance = 0.3; // met by samples at most places
  const DirectResult r =
    ComputeDirectIrradiance(room.Geometry, occluders, room.Patches, options);
  int covered = 0;
  std::vector<double> ratios;
  for (std::size_t k = 0; k < r.Irradiance.size(); ++k)
  {
    const double difference = std::fabs(r.Irradiance[k] - reference.Irradiance[k]);
    covered += difference <= r.Error[k] + 2e-5 * reference.Irradiance[k] ? 1 : 0;
    if (reference.Irradiance[k] > 0.0)
    {
      ratios.push_back(r.Error[k] / std::max(difference, 1e-9 * reference.Irradiance[k]));
    }
  }
  EXPECT_LT(r.Rays, reference.Rays);
  EXPECT_GE(covered, 0.95 * static_cast<double>(r.Irradiance.size()));
  std::nth_element(ratios.begin(), ratios.begin() + ratios.size() / 2, ratios.end());
  EXPECT_LT(ratios[ratios.size() / 2], 10.0);
}

TEST(ManyLights, PointsAgreeWithEachLightByItself)
{
  const Room room(300);
  const OcclusionScene occluders(room.Geometry);
  Random random;
  std::vector<SurfacePoint> points;
  for (int k = 0; k < 500; ++k)
  {
    SurfacePoint p;
    p.Point = Vec3{ 6 * random() - 3, 6 * random() - 3, 0.1 + 0.5 * random() } -
      room.Geometry.Origin;
    p.Normal = random.Direction();
    points.push_back(p);
  }
  const auto bands = static_cast<std::size_t>(room.Geometry.Optics.Bands);
  std::vector<double> wanted(points.size() * bands, 0.0);
  Scene single = room.Geometry;
  for (const Light& light : room.Geometry.Lights)
  {
    single.Lights = { light };
    const DirectResult r = ComputeDirectIrradiance(single, occluders, points, {});
    for (std::size_t k = 0; k < wanted.size(); ++k)
    {
      wanted[k] += r.Irradiance[k];
    }
  }
  for (const double tolerance : { 1e-9, 0.1 })
  {
    DirectOptions options;
    options.RelativeTolerance = tolerance;
    const DirectResult r = ComputeDirectIrradiance(room.Geometry, occluders, points, options);
    int covered = 0;
    for (std::size_t k = 0; k < wanted.size(); ++k)
    {
      covered += std::fabs(r.Irradiance[k] - wanted[k]) <= r.Error[k] + 1e-12 * wanted[k] ? 1 : 0;
      EXPECT_LE(r.Error[k], 1.001 * tolerance * r.Irradiance[k] + 1e-12);
    }
    EXPECT_GE(covered, 0.95 * static_cast<double>(wanted.size()));
  }
}

/// A run with a time budget ends with a picture of everything, and errors that hold.
TEST(ManyLights, ATimeBudgetGivesAnHonestPicture)
{
  const Room room(900);
  const OcclusionScene occluders(room.Geometry);
  DirectOptions exact;
  exact.RelativeTolerance = 1e-4;
  const DirectResult reference =
    ComputeDirectIrradiance(room.Geometry, occluders, room.Patches, exact);
  for (const double seconds : { 1e-6, 0.05 })
  {
    DirectOptions options;
    options.RelativeTolerance = 1e-5;
    options.SecondsLeft = seconds;
    ConvergenceRecord record;
    const DirectResult r = ComputeDirectIrradiance(
      room.Geometry, occluders, room.Patches, options, {}, &record);
    EXPECT_TRUE(r.TimedOut);
    EXPECT_GE(record.Rows.size(), 1u);
    EXPECT_LT(r.Rays, reference.Rays);
    int covered = 0;
    for (std::size_t k = 0; k < r.Irradiance.size(); ++k)
    {
      EXPECT_TRUE(std::isfinite(r.Error[k]));
      covered += std::fabs(r.Irradiance[k] - reference.Irradiance[k]) <=
          r.Error[k] + 1e-3 * reference.Irradiance[k]
        ? 1
        : 0;
    }
    EXPECT_GE(covered, 0.95 * static_cast<double>(r.Irradiance.size())) << seconds;
  }
}

TEST(ManyLights, SameBytesForAnyNumberOfThreads)
{
  const Room room(150);
  const OcclusionScene occluders(room.Geometry);
  DirectOptions options;
  options.RelativeTolerance = 0.05;
  options.Threads = 1;
  const DirectResult one =
    ComputeDirectIrradiance(room.Geometry, occluders, room.Patches, options);
  options.Threads = 7;
  const DirectResult many =
    ComputeDirectIrradiance(room.Geometry, occluders, room.Patches, options);
  EXPECT_EQ(one.Irradiance, many.Irradiance);
  EXPECT_EQ(one.Error, many.Error);
  EXPECT_EQ(one.Rays, many.Rays);
}

} // namespace
