// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/geometry/BoxTree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace radiometry;

namespace
{

TEST(BoxTree, FindsWhatBruteForceFindsAtEverySize)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const int n : { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 13, 31, 100, 1000, 20001 })
  {
    std::vector<Box3> boxes(n);
    for (Box3& box : boxes)
    {
      const Vec3 p{ unit(random), unit(random), 0.0 };
      box.Add(p);
      box.Add(p + 0.02 * Vec3{ unit(random), unit(random), unit(random) });
    }
    const BoxTree tree(boxes);
    Box3 wanted;
    wanted.Add(Vec3{ 0.4, 0.5, -1 });
    wanted.Add(Vec3{ 0.6, 0.55, 1 });
    const auto overlaps = [&](const Box3& b) {
      return b.Min.x <= wanted.Max.x && b.Max.x >= wanted.Min.x && b.Min.y <= wanted.Max.y &&
        b.Max.y >= wanted.Min.y;
    };
    std::vector<int> found;
    EXPECT_TRUE(tree.Visit(overlaps, [&](std::int32_t i) {
      if (overlaps(boxes[i]))
      {
        found.push_back(i);
      }
      return true;
    }));
    std::sort(found.begin(), found.end());
    std::vector<int> expected;
    for (int i = 0; i < n; ++i)
    {
      if (overlaps(boxes[i]))
      {
        expected.push_back(i);
      }
    }
    EXPECT_EQ(found, expected) << n;
  }
}

TEST(BoxTree, EqualBoxesAndAnEarlyEnd)
{
  std::vector<Box3> boxes(100);
  for (Box3& box : boxes)
  {
    box.Add(Vec3{ 1, 2, 3 });
  }
  const BoxTree tree(boxes);
  int visited = 0;
  EXPECT_FALSE(tree.Visit(
    [](const Box3&) { return true; }, [&](std::int32_t) { return ++visited < 10; }));
  EXPECT_EQ(visited, 10);
}

} // namespace
