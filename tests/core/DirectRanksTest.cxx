// SPDX-License-Identifier: BSD-3-Clause
// Direct light that ranks share: the bytes of one process, whatever their number.
#include "radiometry/geometry/Sampling.h"
#include "radiometry/irradiance/DirectIrradiance.h"
#include "radiometry/irradiance/IrradianceSimulation.h"
#include "radiometry/irradiance/ReceiverShare.h"
#include "radiometry/irradiance/ShadowPieces.h"
#include "radiometry/scene/LightRecord.h"
#include "radiometry/scene/SceneBuilder.h"
#include "radiometry/scene/SkyRadiance.h"
#include "tests/core/ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numeric>

using namespace radiometry;

namespace
{

/// A floor of n x n cells under a crumpled sheet, which casts shadows everywhere.
Scene MakeScene(int n, int lamps, bool panel, bool sky)
{
  SceneBuilder builder;
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> cells;
  const auto sheet = [&](double z, double bumps, int side) {
    const auto first = static_cast<std::int32_t>(points.size());
    for (int j = 0; j <= side; ++j)
    {
      for (int i = 0; i <= side; ++i)
      {
        const double h =
          bumps * static_cast<double>(Hash64(static_cast<std::uint64_t>(97 * j + i)) % 1000) / 1000.0;
        points.push_back({ 4.0 * i / side - 2.0, 4.0 * j / side - 2.0, z + h });
      }
    }
    for (int j = 0; j < side; ++j)
    {
      for (int i = 0; i < side; ++i)
      {
        const std::int32_t a = first + j * (side + 1) + i;
        if (bumps > 0.0 && (i + j) % 2 == 0)
        {
          continue; // holes
        }
        triangles.push_back({ a, a + 1, a + side + 2 });
        triangles.push_back({ a, a + side + 2, a + side + 1 });
        const std::int32_t cell = cells.empty() ? 0 : cells.back() + 1;
        cells.insert(cells.end(), { cell, cell });
      }
    }
  };
  sheet(0.0, 0.0, n);
  sheet(0.7, 0.3, n / 2);
  builder.AddMesh(SceneBuilder::Role::Receiver, points, triangles, cells, 1.0);
  Scene scene = builder.Finish(static_cast<std::size_t>(cells.back()) + 1);
  for (auto& side : scene.Optics.DiffuseReflectance)
  {
    side.assign(scene.Cells, 0.5);
  }
  scene.Optics.TwoSided.assign(scene.Cells, 0);
  const auto add = [&](const LightRecord& record) {
    scene.Lights.push_back(ToLight(record, 1.0, scene.Origin, scene.Lights.size()));
  };
  for (int k = 0; k < lamps; ++k)
  {
    LightRecord lamp;
    lamp.Position = { 2.0 * std::cos(2.4 * k), 2.0 * std::sin(2.4 * k), 2.0 + 0.01 * k };
    add(lamp);
  }
  if (panel)
  {
    LightRecord light;
    light.Type = LightType::Area;
    light.Polygon = { { -0.5, -0.5, 3 }, { -0.5, 0.5, 3 }, { 0.5, 0.5, 3 }, { 0.5, -0.5, 3 } };
    add(light);
  }
  if (sky)
  {
    LightRecord light;
    light.Type = LightType::Environment;
    light.Environment = SkyRadiance::Overcast();
    add(light);
  }
  return scene;
}

/// The result of each rank.
template <class Receivers>
std::vector<DirectResult> OnRanks(int size, const Scene& scene, const OcclusionScene& occluders,
  const Receivers& receivers, DirectOptions options)
{
  std::vector<DirectResult> results(static_cast<std::size_t>(size));
  test::ThreadRanks(size).Run([&](const Communicator& ranks) {
    DirectOptions own = options;
    own.Ranks = &ranks;
    own.Threads = 1;
    ConvergenceRecord record;
    results[static_cast<std::size_t>(ranks.Rank())] =
      ComputeDirectIrradiance(scene, occluders, receivers, own, {}, &record);
    EXPECT_FALSE(record.Rows.empty());
  });
  return results;
}

template <class Receivers>
void ExpectSame(const Scene& scene, const Receivers& receivers, const DirectOptions& options)
{
  const OcclusionScene occluders(scene);
  ConvergenceRecord record;
  const DirectResult one =
    ComputeDirectIrradiance(scene, occluders, receivers, options, {}, &record);
  ASSERT_GT(*std::max_element(one.Irradiance.begin(), one.Irradiance.end()), 0.0);
  for (const int size : { 1, 2, 3 })
  {
    for (const DirectResult& r : OnRanks(size, scene, occluders, receivers, options))
    {
      EXPECT_EQ(r.Irradiance, one.Irradiance);
      EXPECT_EQ(r.Error, one.Error);
      EXPECT_EQ(r.Dropped, one.Dropped);
      EXPECT_EQ(r.PeakUnshadowed, one.PeakUnshadowed);
      EXPECT_EQ(r.DroppedPeak, one.DroppedPeak);
      EXPECT_NEAR(r.DroppedMean, one.DroppedMean, 1e-9 * one.DroppedMean);
      EXPECT_EQ(r.Rays, one.Rays);
    }
  }
}

std::vector<SurfacePoint> MakePoints()
{
  std::vector<SurfacePoint> points;
  for (int k = 0; k < 333; ++k)
  {
    points.push_back({ { std::cos(k) * 1.9, std::sin(1.7 * k) * 1.9, 0.01 * (k % 30) - 0.4 },
      Normalized(Vec3{ 0.1 * std::sin(k), 0.1, 1.0 }), -1, {}, 0.0 });
  }
  return points;
}

} // namespace

TEST(DirectRanks, PatchesUnderFewAndManyLights)
{
  DirectOptions options;
  for (const int lamps : { 1, 3, 400 }) // many: clusters share what they choose
  {
    const Scene scene = MakeScene(20, lamps, false, false);
    ExpectSame(scene, MakePatches(scene, 0), options);
  }
}

TEST(DirectRanks, PatchesUnderPanelsAndSkies)
{
  DirectOptions options;
  options.RelativeTolerance = 0.1;
  const Scene scene = MakeScene(12, 2, true, true);
  ExpectSame(scene, MakePatches(scene, 0), options);
  options.MeanShare = 0.5; // rounds look at the mean over all ranks
  ExpectSame(scene, MakePatches(scene, 0), options);
}

TEST(DirectRanks, Points)
{
  DirectOptions options;
  options.RelativeTolerance = 0.1;
  ExpectSame(MakeScene(12, 200, false, false), MakePoints(), options);
  ExpectSame(MakeScene(12, 2, true, true), MakePoints(), options);
}

TEST(DirectRanks, MoreRanksThanGroups)
{
  DirectOptions options;
  const Scene scene = MakeScene(4, 2, true, true);
  std::vector<Patch> patches = MakePatches(scene, 0);
  patches.resize(3);
  ExpectSame(scene, patches, options);
}

TEST(DirectRanks, CellsCutAlongShadows)
{
  const Scene scene = MakeScene(8, 2, false, false);
  const OcclusionScene occluders(scene);
  DirectOptions options;
  const ShadowPieces one = CutAlongShadows(scene, occluders, options, false, 1000);
  ASSERT_GT(one.Size(), scene.Cells);
  test::ThreadRanks(3).Run([&](const Communicator& ranks) {
    DirectOptions own = options;
    own.Ranks = &ranks;
    own.Threads = 1;
    const ShadowPieces pieces = CutAlongShadows(scene, occluders, own, false, 1000);
    EXPECT_EQ(pieces.Corners, one.Corners);
    EXPECT_EQ(pieces.First, one.First);
    EXPECT_EQ(pieces.Cell, one.Cell);
    EXPECT_EQ(pieces.Whole, one.Whole);
    ASSERT_EQ(pieces.Points.size(), one.Points.size());
    for (std::size_t k = 0; k < one.Points.size(); ++k)
    {
      EXPECT_TRUE(pieces.Points[k] == one.Points[k]);
    }
  });
}

TEST(DirectRanks, EveryReceiverHasOneRank)
{
  std::vector<std::uint32_t> order(100), first;
  std::iota(order.rbegin(), order.rend(), 0u);
  for (const std::uint32_t f : { 0u, 7u, 7u, 50u, 99u, 100u })
  {
    first.push_back(f);
  }
  std::vector<int> seen(100, 0);
  std::mutex mutex;
  test::ThreadRanks(4).Run([&](const Communicator& ranks) {
    const ReceiverShare share(ranks, order, first);
    std::vector<double> values;
    {
      const std::lock_guard<std::mutex> lock(mutex);
      for (std::size_t k = 0; k < share.Size(); ++k)
      {
        ++seen[share.Begin()[k]];
        values.insert(values.end(), { 2.0 * share.Begin()[k], 2.0 * share.Begin()[k] + 1.0 });
      }
    }
    const std::vector<double> all = share.Gather(values, 2);
    for (std::size_t k = 0; k < all.size(); ++k)
    {
      EXPECT_EQ(all[k], static_cast<double>(k));
    }
  });
  EXPECT_EQ(seen, std::vector<int>(100, 1));
}
