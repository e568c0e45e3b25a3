// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/visibility/PairVisibility.h"

#include "radiometry/formfactor/ElementBlocks.h"
#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/geometry/Sampling.h"
#include "tests/core/TestScenes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

using namespace radiometry;

namespace
{

double Uniform(std::uint64_t key, std::uint64_t k)
{
  return static_cast<double>(Hash64(key, k) >> 11) * 0x1p-53;
}

/// Triangles of all sizes at random places.
test::Mesh Soup(std::uint64_t key, int count)
{
  test::Mesh mesh;
  std::uint64_t k = 0;
  const auto u = [&] { return Uniform(key, k++); };
  for (int t = 0; t < count; ++t)
  {
    const Vec3 center{ u(), u(), u() };
    const double size = std::exp2(-4.0 * u());
    const auto first = static_cast<std::int32_t>(mesh.Points.size());
    for (int c = 0; c < 3; ++c)
    {
      mesh.Points.push_back(center + size * Vec3{ u() - 0.5, u() - 0.5, u() - 0.5 });
    }
    mesh.Triangles.push_back({ first, first + 1, first + 2 });
  }
  return mesh;
}

/// A room with a ball and a pillar: smooth sheets that hide much.
test::Mesh Room(int n = 4)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, n, true);
  mesh.AddSphere({ 0.4, 0.45, 0.5 }, 0.25, 8, false);
  mesh.AddBox({ 0.7, 0.6, 0.0 }, { 0.85, 0.8, 0.9 }, 2, false);
  return mesh;
}

struct Sights
{
  int Proven = 0, Wrong = 0;
  int Missed = 0; // not proven, though all segments agreed
};

/// What is proven of pairs of groups of a level (of every so many), against segments asked of the scene.
Sights Compare(const test::Mesh& mesh, std::size_t level, std::size_t every = 1)
{
  const Scene scene = mesh.ToScene();
  const OcclusionScene occluders(scene);
  const PatchBlockers blockers(scene);
  const ElementSet elements(scene, true);
  const ElementBlocks blocks(elements.GetPatches(), &blockers);
  Sights sights;
  std::vector<const ElementBlocks::Node*> nodes;
  for (std::size_t b = 0; b < blocks.Blocks(); ++b)
  {
    for (std::size_t n = level; n < 2 * level; ++n)
    {
      if (blocks.At(b, n).Group.Count > 0)
      {
        nodes.push_back(&blocks.At(b, n));
      }
    }
  }
  PatchBlockers::Candidates found;
  for (std::size_t p = 0; p < nodes.size(); ++p)
  {
    for (std::size_t q = p + 1 + p % every; q < nodes.size(); q += every)
    {
      const PatchGroup& a = nodes[p]->Group;
      const PatchGroup& b = nodes[q]->Group;
      if (ElementBlocks::BackFacing(*nodes[p], *nodes[q]))
      {
        continue;
      }
      const Sight sight = blockers.Between(a, b, nullptr, found);
      int asked = 0, blocked = 0;
      const SobolSequence points(Hash64(p, q)), choices(Hash64(q + 1, p));
      for (std::uint32_t k = 0; k < 12; ++k)
      {
        const auto u = points(k);
        const auto v = choices(k);
        const PlacedPatch& i = a.Patches[static_cast<int>(v[0] * a.Count)];
        const PlacedPatch& j = b.Patches[static_cast<int>(v[1] * b.Count)];
        const Vec3 x = TrianglePoint(i.Corners, u[0], u[1]);
        const Vec3 y = TrianglePoint(j.Corners, u[2], u[3]);
        if (Dot(i.Normal, y - x) <= 0.0 || Dot(j.Normal, x - y) <= 0.0)
        {
          continue;
        }
        const bool hidden = occluders.Occluded(
          { blockers.Unplace(x), i.Triangle }, { blockers.Unplace(y), j.Triangle });
        ++asked;
        blocked += hidden;
        sights.Wrong += sight != Sight::Mixed && hidden != (sight == Sight::Hidden);
      }
      sights.Proven += asked > 0 && sight != Sight::Mixed;
      sights.Missed += asked > 0 && sight == Sight::Mixed && (blocked == 0 || blocked == asked);
    }
  }
  return sights;
}

} // namespace

TEST(PatchBlockers, ProvesOnlyWhatIsSo)
{
  for (std::size_t level : { 64, 16, 4, 1 })
  {
    EXPECT_EQ(Compare(Room(), level).Wrong, 0) << level;
    for (std::uint64_t seed = 0; seed < 3; ++seed)
    {
      EXPECT_EQ(Compare(Soup(seed, 200), level).Wrong, 0) << level << " " << seed;
    }
  }
  // Of small elements most of what is so.
  const Sights fine = Compare(Room(16), 64, 97);
  EXPECT_EQ(fine.Wrong, 0);
  EXPECT_GT(fine.Proven, 4 * fine.Missed);
}

TEST(PatchBlockers, ASegmentIsBlockedAsInTheScene)
{
  const Scene scene = Room().ToScene();
  const OcclusionScene occluders(scene);
  const PatchBlockers blockers(scene);
  const ElementSet elements(scene, true);
  const auto& patches = elements.GetPatches();
  PatchBlockers::Candidates between;
  int asked = 0, hidden = 0;
  for (std::uint64_t k = 0; k < 4000; ++k)
  {
    const Patch& a = patches[Hash64(k, 1) % patches.size()];
    const Patch& b = patches[Hash64(k, 2) % patches.size()];
    const PlacedPatch p = blockers.Place(a), q = blockers.Place(b);
    if (blockers.Between({ &p, 1 }, { &q, 1 }, nullptr, between) != Sight::Mixed)
    {
      continue;
    }
    ASSERT_TRUE(between.Complete);
    const Vec3 x = TrianglePoint(p.Corners, Uniform(k, 3), Uniform(k, 4));
    const Vec3 y = TrianglePoint(q.Corners, Uniform(k, 5), Uniform(k, 6));
    if (Dot(p.Normal, y - x) > 0.0 && Dot(q.Normal, x - y) > 0.0)
    {
      const bool blocked = blockers.Blocked(x, p, y, q, between);
      ++asked;
      hidden += blocked;
      EXPECT_EQ(blocked, occluders.Occluded({ blockers.Unplace(x), p.Triangle },
                           { blockers.Unplace(y), q.Triangle }));
    }
  }
  EXPECT_GT(asked, 100);
  EXPECT_GT(hidden, asked / 10);
}

TEST(PatchBlockers, AScreenOfManyTrianglesHidesAsAWhole)
{
  // No single triangle of the ball covers what lies behind it.
  test::Mesh mesh;
  mesh.AddGrid({ -0.1, -0.1, 0 }, { 0.2, 0, 0 }, { 0, 0.2, 0 }, 1, 1);
  mesh.AddGrid({ -0.1, -0.1, 4 }, { 0, 0.2, 0 }, { 0.2, 0, 0 }, 1, 1);
  mesh.AddSphere({ 0.03, 0.02, 2 }, 0.8, 24, false);
  const Scene scene = mesh.ToScene();
  const PatchBlockers blockers(scene);
  std::vector<PlacedPatch> placed;
  for (std::int32_t t = 0; t < 4; ++t)
  {
    placed.push_back(blockers.Place(Patch{ scene.TriangleAt(static_cast<std::size_t>(t)), t, t, 0 }));
  }
  PatchBlockers::Candidates found;
  EXPECT_EQ(blockers.Between({ &placed[0], 2 }, { &placed[2], 2 }, nullptr, found), Sight::Hidden);
  // Half of the ball hides it all the same, but not when it has a hole.
  std::size_t hole = 4;
  const auto at = [&](std::size_t t) {
    const auto& v = mesh.Triangles[t];
    return (mesh.Points[v[0]] + mesh.Points[v[1]] + mesh.Points[v[2]]) / 3.0;
  };
  test::Mesh half = mesh, open = mesh;
  half.Triangles.resize(4);
  double nearest = 1e300;
  for (std::size_t t = 4; t < mesh.Triangles.size(); ++t)
  {
    const Vec3 c = at(t);
    if (c.z < 2.0)
    {
      hole = c.x * c.x + c.y * c.y < nearest ? half.Triangles.size() : hole;
      nearest = std::min(nearest, c.x * c.x + c.y * c.y);
      half.Triangles.push_back(mesh.Triangles[t]);
    }
  }
  open.Triangles = half.Triangles;
  open.Triangles.erase(open.Triangles.begin() + static_cast<std::ptrdiff_t>(hole));
  for (const test::Mesh* shell : { &half, &open })
  {
    const Scene part = shell->ToScene();
    const PatchBlockers some(part);
    placed.clear();
    for (std::int32_t t = 0; t < 4; ++t)
    {
      placed.push_back(some.Place(Patch{ part.TriangleAt(static_cast<std::size_t>(t)), t, t, 0 }));
    }
    EXPECT_EQ(some.Between({ &placed[0], 2 }, { &placed[2], 2 }, nullptr, found),
      shell == &half ? Sight::Hidden : Sight::Mixed);
  }
}

TEST(PairVisibility, TwiceTheErrorHoldsTheTruth)
{
  // Pairs that something may stand between, against some ten thousand segments each.
  int pairs = 0, inside = 0;
  std::vector<double> ratios;
  for (const test::Mesh& mesh : { Room(), Soup(7, 120) })
  {
    const Scene scene = mesh.ToScene();
    const OcclusionScene occluders(scene);
    const PatchBlockers blockers(scene);
    const ElementSet elements(scene, true);
    const auto& patches = elements.GetPatches();
    PatchBlockers::Candidates between;
    const int most = pairs + 150;
    for (std::uint64_t k = 0; pairs < most; ++k)
    {
      const Patch& a = patches[Hash64(k, 1) % patches.size()];
      const Patch& b = patches[Hash64(k, 2) % patches.size()];
      const PlacedPatch p = blockers.Place(a), q = blockers.Place(b);
      if (a.Triangle == b.Triangle || !(PairExchange(a.Corners, b.Corners, 1e-3).Value > 0.0) ||
        blockers.Between({ &p, 1 }, { &q, 1 }, nullptr, between) != Sight::Mixed ||
        !between.Complete)
      {
        continue;
      }
      const PairVisibilityResult v =
        PairVisibility(occluders, blockers, p, q, between, { k, 16, 1024, 0.05 });
      const SobolSequence sequence(Hash64(k, 3));
      double all = 0.0, seen = 0.0;
      for (std::uint32_t n = 0; n < 8192; ++n)
      {
        const auto u = sequence(n);
        const Vec3 x = TrianglePoint(p.Corners, u[0], u[1]);
        const Vec3 y = TrianglePoint(q.Corners, u[2], u[3]);
        const Vec3 r = y - x;
        const double kernel = std::max(0.0, Dot(p.Normal, r)) * std::max(0.0, -Dot(q.Normal, r)) /
          (LengthSquared(r) * LengthSquared(r));
        all += kernel;
        seen += kernel > 0.0 && !blockers.Blocked(x, p, y, q, between) ? kernel : 0.0;
      }
      if (all > 0.0)
      {
        const double off = std::abs(v.Fraction - seen / all);
        ++pairs;
        inside += off <= 2.0 * v.Error + 2e-3;
        if (off > 2e-3)
        {
          ratios.push_back(2.0 * v.Error / off);
        }
      }
    }
  }
  EXPECT_GE(inside, 0.95 * pairs);
  std::sort(ratios.begin(), ratios.end());
  EXPECT_LT(ratios[ratios.size() / 2], 10.0);
  EXPECT_GT(ratios.size(), 100u);
}

TEST(PairVisibility, NothingInTheWayIsExact)
{
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  mesh.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1);
  mesh.AddGrid({ 2, 0, 0.5 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  const Scene scene = mesh.ToScene();
  const OcclusionScene occluders(scene);
  const PairVisibilityResult v = PairVisibility(occluders, ExchangePatch(scene.TriangleAt(0)), 0,
    ExchangePatch(scene.TriangleAt(2)), 2, 1, 64, 4096, 0.01);
  EXPECT_EQ(v.Fraction, 1.0);
  EXPECT_LT(v.Error, 0.05); // only the proof knows
  const PatchBlockers blockers(scene);
  const PlacedPatch p = blockers.Place(Patch{ scene.TriangleAt(0), 0, 0, 0 });
  const PlacedPatch q = blockers.Place(Patch{ scene.TriangleAt(2), 2, 2, 0 });
  PatchBlockers::Candidates found;
  EXPECT_EQ(blockers.Between({ &p, 1 }, { &q, 1 }, nullptr, found), Sight::Clear);
}
