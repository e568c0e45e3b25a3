// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ClosedElements.h"
#include "radiometry/scene/Collective.h"
#include "tests/core/TestScenes.h"
#include "tests/core/ThreadRanks.h"

#include <atomic>
#include <gtest/gtest.h>
#include <numeric>

using namespace radiometry;

TEST(ThreadRanks, SumLargestAndGather)
{
  for (int size : { 1, 2, 5 })
  {
    test::ThreadRanks(size).Run([&](const Communicator& ranks) {
      ASSERT_EQ(ranks.Size(), size);
      const int r = ranks.Rank();
      std::vector<double> values{ 1.0 + r, -2.0 * r };
      ranks.Sum(values.data(), 2);
      EXPECT_EQ(values[0], size * (size + 1) / 2);
      EXPECT_EQ(values[1], -size * (size - 1));
      std::int64_t count = r;
      ranks.Sum(&count, 1);
      EXPECT_EQ(count, size * (size - 1) / 2);
      double most = r == size / 2 ? 7.0 : -1.0;
      ranks.Largest(&most, 1);
      EXPECT_EQ(most, 7.0);
      const std::size_t n = 7;
      std::vector<std::int32_t> mine(n, -1), all(n);
      const RankShare share(&ranks, n);
      for (std::size_t i = share.Begin; i < share.End; ++i)
      {
        mine[i] = static_cast<std::int32_t>(i);
      }
      ranks.Gather(mine.data(), RankShare::Begins(ranks, n));
      std::iota(all.begin(), all.end(), 0);
      EXPECT_EQ(mine, all);
    });
  }
}

TEST(ThreadRanks, ARankThatLeavesStopsTheOthers)
{
  EXPECT_THROW(test::ThreadRanks(3).Run([](const Communicator& ranks) {
    double value = 0.0;
    ranks.Sum(&value, 1);
    if (ranks.Rank() == 1)
    {
      throw InputError("Normals", 3, 0.0, "unit length");
    }
    ranks.Sum(&value, 1);
  }),
    InputError);
}

TEST(Collectively, FailsOnAllRanksOrOnNone)
{
  std::atomic<int> stopped{ 0 };
  test::ThreadRanks(4).Run([&](const Communicator& ranks) {
    Collectively(&ranks, [] {});
    try
    {
      Collectively(&ranks, [&] {
        if (ranks.Rank() == 2)
        {
          throw Aborted();
        }
      });
    }
    catch (const Aborted&)
    {
      ++stopped;
    }
    try
    {
      Collectively(&ranks, [&] {
        if (ranks.Rank() == 0)
        {
          throw std::bad_alloc();
        }
      });
    }
    catch (const std::bad_alloc&)
    {
      stopped += 100;
    }
    catch (const std::runtime_error&)
    {
      stopped += 10;
    }
  });
  EXPECT_EQ(stopped, 134);
}

TEST(ClosedElements, AreThoseOfTheWholeOnEachRank)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 2, true);
  mesh.AddGrid({ 3, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  mesh.AddGrid({ 3, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1);
  const Scene scene = mesh.ToScene();
  const OcclusionScene occluders(scene);
  const ElementSet elements(scene, true);
  const auto closed = FindClosedElements(occluders, elements, {});
  ASSERT_EQ(closed.size(), 52u);
  for (std::size_t i = 0; i < closed.size(); ++i)
  {
    EXPECT_EQ(closed[i], i < 48 ? 1 : 0) << i;
  }
  test::ThreadRanks(3).Run([&](const Communicator& ranks) {
    ExchangeOptions options;
    options.Ranks = &ranks;
    EXPECT_EQ(FindClosedElements(occluders, elements, options), closed);
  });
}
