// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ViewFactors.h"

#include "radiometry/formfactor/ViewFactorClosure.h"
#include "radiometry/scene/InputError.h"
#include "tests/core/TestScenes.h"
#include "tests/core/ThreadRanks.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

using namespace radiometry;

namespace
{

const double Pi = std::acos(-1.0);

/// A mesh whose parts are patches.
struct Patched
{
  test::Mesh Mesh;
  std::vector<std::int32_t> Patch;
  std::int32_t Count = 0;

  /// What was added to the mesh since the last call is a patch (`blocks`: none, it only blocks).
  void End(bool blocks = false)
  {
    this->Patch.resize(this->Mesh.Triangles.size(), blocks ? -1 : this->Count);
    this->Count += blocks ? 0 : 1;
  }
  /// Every triangle is a patch.
  void EndEach()
  {
    while (this->Patch.size() < this->Mesh.Triangles.size())
    {
      this->Patch.push_back(this->Count++);
    }
  }
  /// The side of an upright cylinder about the origin, fronts outward or inward.
  void AddCylinder(double radius, double height, int around, int bands, bool inward)
  {
    auto& points = this->Mesh.Points;
    const auto first = static_cast<std::int32_t>(points.size());
    for (int j = 0; j <= bands; ++j)
    {
      for (int i = 0; i < around; ++i)
      {
        const double a = 2.0 * Pi * i / around;
        points.push_back({ radius * std::cos(a), radius * std::sin(a),
          height * (static_cast<double>(j) / bands - 0.5) });
      }
    }
    for (int j = 0; j < bands; ++j)
    {
      for (int i = 0; i < around; ++i)
      {
        const std::int32_t a = first + j * around + i, b = first + j * around + (i + 1) % around;
        const std::array<std::int32_t, 3> t0{ a, b, b + around }, t1{ a, b + around, a + around };
        for (std::array<std::int32_t, 3> t : { t0, t1 })
        {
          if (inward)
          {
            std::swap(t[1], t[2]);
          }
          this->Mesh.Triangles.push_back(t);
        }
      }
    }
  }
  /// A disc in a plane z of so many corners, front up or down.
  void AddDisc(double radius, double z, int corners, bool up)
  {
    auto& points = this->Mesh.Points;
    const auto first = static_cast<std::int32_t>(points.size());
    points.push_back({ 0, 0, z });
    for (int i = 0; i < corners; ++i)
    {
      const double a = 2.0 * Pi * i / corners;
      points.push_back({ radius * std::cos(a), radius * std::sin(a), z });
    }
    for (int i = 0; i < corners; ++i)
    {
      const std::int32_t a = first + 1 + i, b = first + 1 + (i + 1) % corners;
      this->Mesh.Triangles.push_back(up ? std::array<std::int32_t, 3>{ first, a, b }
                                        : std::array<std::int32_t, 3>{ first, b, a });
    }
  }
  ViewFactorResult Compute(const ViewFactorOptions& options = {}) const
  {
    return ComputeViewFactors(
      this->Mesh.ToScene(), this->Patch, static_cast<std::size_t>(this->Count), options);
  }
};

ViewFactorRow At(const ViewFactorResult& result, std::int32_t from, std::int32_t to)
{
  for (const ViewFactorRow& row : result.Rows)
  {
    if (row.From == from && row.To == to)
    {
      return row;
    }
  }
  return { from, to, 0.0, 0.0 };
}

ViewFactorOptions With(ViewFactorMethod method, double relative = 0.01)
{
  ViewFactorOptions options;
  options.Method = method;
  options.RelativeTolerance = relative;
  return options;
}

constexpr ViewFactorMethod All[] = { ViewFactorMethod::Dense, ViewFactorMethod::Hierarchical,
  ViewFactorMethod::MonteCarlo };

} // namespace

TEST(ViewFactors, SquaresAreRightOnAnyMesh)
{
  const Vec3 x{ 1, 0, 0 }, y{ 0, 1, 0 }, z{ 0, 0, 1 };
  for (const int n : { 1, 2, 5 })
  {
    Patched parallel, upright;
    parallel.Mesh.AddGrid({}, x, y, n, n);
    parallel.End();
    parallel.Mesh.AddGrid(z, y, x, n + 1, n);
    parallel.End();
    upright.Mesh.AddGrid({}, x, y, n, n);
    upright.End();
    upright.Mesh.AddGrid({}, y, z, n, n + 2);
    upright.End();
    const ViewFactorRow a = At(parallel.Compute(), 0, 1);
    EXPECT_NEAR(a.Value, 0.199824895698387, 1e-10);
    EXPECT_LE(a.Error, 1e-7);
    const ViewFactorRow b = At(upright.Compute(), 1, 0);
    EXPECT_NEAR(b.Value, 0.200043776075403, 1e-10);
    EXPECT_LE(b.Error, 1e-7);
  }
}

TEST(ViewFactors, PolygonsTendToDiscsAndCylinders)
{
  // Coaxial discs R = H: 0.381966011250105; the polygons' own value falls short by O(1/n^2).
  double before = 1.0;
  for (const int n : { 16, 32, 64 })
  {
    Patched discs;
    discs.AddDisc(1.0, 0.0, n, true);
    discs.End();
    discs.AddDisc(1.0, 1.0, n, false);
    discs.End();
    const double off = std::abs(At(discs.Compute(), 0, 1).Value - 0.381966011250105);
    EXPECT_LT(off, 0.3 * before);
    before = off;
  }
  EXPECT_LT(before, 1e-3);
  // Inner to outer cylinder; the polygonal one within 1 %.
  Patched cylinders;
  cylinders.AddCylinder(0.125, 1.0, 24, 4, false);
  cylinders.End();
  cylinders.AddCylinder(0.25, 1.0, 24, 4, true);
  cylinders.End();
  for (const ViewFactorMethod method : All)
  {
    EXPECT_NEAR(At(cylinders.Compute(With(method)), 0, 1).Value, 0.910868433007748, 0.01);
  }
}

TEST(ViewFactors, BlockedCylinderSeesTheSphereWithinTheError)
{
  // A cylinder in a sphere, behind a wider cylinder: 0.089131566992252 for round ones. Hierarchical
  // at half a per cent, several seeds; the mesh is close to round.
  Patched scene;
  scene.AddCylinder(0.125, 1.0, 96, 12, false);
  scene.End();
  scene.Mesh.AddSphere({}, 3.0, 12, true);
  scene.End();
  scene.AddCylinder(0.25, 1.0, 96, 12, true);
  scene.End(true);
  for (const std::uint64_t seed : { 0, 1 })
  {
    ViewFactorOptions options = With(ViewFactorMethod::Hierarchical, 0.005);
    options.Seed = seed;
    const ViewFactorRow row = At(scene.Compute(options), 0, 1);
    EXPECT_LE(row.Error, 0.00501 * row.Value);
    EXPECT_LE(std::abs(row.Value - 0.089131566992252), row.Error + 2e-4);
  }
}

TEST(ViewFactors, NothingComesThroughAPlate)
{
  for (const ViewFactorMethod method : All)
  {
    Patched plates;
    plates.Mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 4, 4);
    plates.End();
    plates.Mesh.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 4, 4);
    plates.End();
    plates.Mesh.AddGrid({ -2, -2, 0.5 }, { 5, 0, 0 }, { 0, 5, 0 }, 3, 3);
    plates.End(true);
    EXPECT_TRUE(plates.Compute(With(method)).Rows.empty());
  }
}

TEST(ViewFactors, NestedBodies)
{
  for (const ViewFactorMethod method : All)
  {
    Patched cubes;
    cubes.Mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 2, false);
    cubes.End();
    cubes.Mesh.AddBox({ -1, -1, -1 }, { 2, 2, 2 }, 2, true);
    cubes.End();
    const ViewFactorResult result = cubes.Compute(With(method));
    EXPECT_NEAR(At(result, 0, 1).Value, 1.0, 1e-12);
    EXPECT_NEAR(At(result, 1, 0).Value, 1.0 / 9.0, 1e-12);
    EXPECT_NEAR(At(result, 1, 1).Value, 8.0 / 9.0, 1e-12);
    EXPECT_LE(result.ClosureBefore, 0.02);
    EXPECT_LE(result.ClosureAfter, 1e-12);
    EXPECT_EQ(result.Closed[0] + result.Closed[1], 2);
  }
}

TEST(ViewFactors, SphereInteriorIsUniform)
{
  // Facet to facet more than a radius apart: A_j/(4 pi R^2) to a few per cent on this mesh.
  Patched sphere;
  sphere.Mesh.AddSphere({ 7, 0, 0 }, 2.0, 10, true);
  sphere.EndEach();
  const ViewFactorResult result = sphere.Compute();
  const double total = 16.0 * Pi;
  double worst = 0.0;
  for (const ViewFactorRow& row : result.Rows)
  {
    worst = std::max(worst,
      std::abs(result.Areas[static_cast<std::size_t>(row.From)] * row.Value -
        result.Areas[static_cast<std::size_t>(row.To)] * At(result, row.To, row.From).Value));
    if (row.From > 40)
    {
      break;
    }
  }
  EXPECT_LE(worst, 1e-15 * total);
  for (const double s : result.Sum.Value)
  {
    EXPECT_NEAR(s, 1.0, 1e-9);
  }
  // Over all pairs the mean of F_ij/A_j is that of the round one.
  double mean = 0.0;
  for (const ViewFactorRow& row : result.Rows)
  {
    mean += row.Value / result.Areas[static_cast<std::size_t>(row.To)];
  }
  EXPECT_NEAR(mean / static_cast<double>(result.Rows.size()), 1.0 / total, 0.05 / total);
}

TEST(ViewFactors, MethodsAgreeWithinTheirErrors)
{
  // A room with two boxes; walls of two triangles and of many.
  Patched room;
  room.Mesh.AddBox({ 0, 0, 0 }, { 4, 3, 2.5 }, 2, true);
  room.EndEach();
  room.Mesh.AddBox({ 1, 1, 0 }, { 1.7, 1.6, 1.2 }, 1, false);
  room.End();
  room.Mesh.AddBox({ 2.5, 0.4, 0 }, { 3.1, 2.2, 0.8 }, 2, false);
  room.End();
  ViewFactorOptions fine = With(ViewFactorMethod::Dense, 0.01);
  fine.AbsoluteTolerance = 2e-4;
  const ViewFactorResult exact = room.Compute(fine);
  for (const ViewFactorMethod method : All)
  {
    ViewFactorOptions options = With(method, 0.03);
    options.AbsoluteTolerance = 1e-3;
    const ViewFactorResult result = room.Compute(options);
    int within = 0, all = 0;
    for (const ViewFactorRow& row : exact.Rows)
    {
      const ViewFactorRow other = At(result, row.From, row.To);
      ++all;
      within += std::abs(other.Value - row.Value) <=
        std::max(other.Error, other.Value == 0.0 ? 2e-4 : 0.0) + row.Error;
    }
    EXPECT_GE(within, static_cast<int>(0.95 * all)) << static_cast<int>(method) << " of " << all;
  }
}

TEST(ViewFactors, ErrorsCoverAndAreSharp)
{
  // Patches of several cells, partly hidden: coarse runs of many seeds beside a fine one.
  Patched scene;
  scene.Mesh.AddGrid({ 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 4, 4);
  scene.EndEach();
  scene.Mesh.AddGrid({ 0, 0, 1.5 }, { 0, 2, 0 }, { 2, 0, 0 }, 1, 1);
  scene.End();
  scene.Mesh.AddBox({ 0.6, 0.7, 0.5 }, { 1.3, 1.2, 0.9 }, 1, false);
  scene.End(true);
  ViewFactorOptions fine = With(ViewFactorMethod::Dense, 1e-3);
  fine.AbsoluteTolerance = 1e-6;
  const ViewFactorResult exact = scene.Compute(fine);
  for (const ViewFactorMethod method : All)
  {
    int within = 0, all = 0;
    std::vector<double> ratios;
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
    {
      ViewFactorOptions options = With(method, 0.03);
      options.AbsoluteTolerance = 1e-3;
      options.Seed = seed;
      const ViewFactorResult result = scene.Compute(options);
      for (const ViewFactorRow& row : exact.Rows)
      {
        if (row.Error < 1e-8 && method != ViewFactorMethod::MonteCarlo)
        {
          continue; // wholly visible: exact here too
        }
        const ViewFactorRow other = At(result, row.From, row.To);
        const double off = std::abs(other.Value - row.Value);
        ++all;
        within += off <= other.Error + row.Error;
        ratios.push_back(other.Error / std::max(off, 1e-12));
      }
    }
    ASSERT_GT(all, 20);
    EXPECT_GE(within, static_cast<int>(0.93 * all)) << static_cast<int>(method) << " of " << all;
    std::nth_element(ratios.begin(), ratios.begin() + ratios.size() / 2, ratios.end());
    EXPECT_LT(ratios[ratios.size() / 2], 10.0) << static_cast<int>(method);
  }
}

TEST(ViewFactors, SkyGroundAndObstacles)
{
  Patched court;
  court.Mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  court.End();
  court.Mesh.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 1, 1);
  court.End();
  court.Mesh.AddGrid({ 1, -2, 0 }, { 0, 5, 0 }, { 0, 0, 1 }, 1, 1); // its back to the court
  court.End(true);
  const ViewFactorResult result = court.Compute(With(ViewFactorMethod::Auto, 1e-3));
  const double wall = 0.200043776075403;
  EXPECT_NEAR(At(result, 0, 1).Value, wall, 1e-9);
  // A floor sees no ground; its sky is what walls and backs leave.
  EXPECT_EQ(result.Ground.Value[0], 0.0);
  EXPECT_NEAR(result.Sky.Value[0] + wall + result.Blocked.Value[0], 1.0, 2e-3);
  // The back: a wall of five times the length from its middle, F = 0.2861 to the part right
  // opposite and beyond; by rays of another kind.
  EXPECT_GT(result.Blocked.Value[0], wall);
  for (std::size_t k = 0; k < 2; ++k)
  {
    const double all =
      result.Sum.Value[k] + result.Sky.Value[k] + result.Ground.Value[k] + result.Blocked.Value[k];
    EXPECT_NEAR(all, 1.0, 5e-3);
    EXPECT_NEAR(result.Environment.Value[k], result.Sky.Value[k] + result.Ground.Value[k], 5e-3);
  }
  // The wall's lower half of the view falls on the floor or past it.
  EXPECT_NEAR(
    result.Ground.Value[1] + result.Sky.Value[1] + result.Sum.Value[1] + result.Blocked.Value[1],
    1.0, 5e-3);
}

TEST(ViewFactors, ThreadsAndRepetitionGiveTheSameBytes)
{
  Patched room;
  room.Mesh.AddBox({ 0, 0, 0 }, { 4, 3, 2.5 }, 2, true);
  room.EndEach();
  room.Mesh.AddBox({ 1, 1, 0.5 }, { 1.7, 1.6, 1.2 }, 1, false);
  room.End();
  for (const ViewFactorMethod method : All)
  {
    std::vector<ViewFactorRow> first;
    for (const int threads : { 1, 3, 8 })
    {
      ViewFactorOptions options = With(method, 0.05);
      options.AbsoluteTolerance = 2e-3;
      options.Threads = threads;
      const ViewFactorResult result = room.Compute(options);
      if (first.empty())
      {
        first = result.Rows;
        continue;
      }
      ASSERT_EQ(first.size(), result.Rows.size());
      for (std::size_t k = 0; k < first.size(); ++k)
      {
        EXPECT_EQ(first[k].From, result.Rows[k].From);
        EXPECT_EQ(first[k].To, result.Rows[k].To);
        EXPECT_EQ(first[k].Value, result.Rows[k].Value);
        EXPECT_EQ(first[k].Error, result.Rows[k].Error);
      }
    }
  }
}

TEST(ViewFactors, RanksGiveTheBytesOfOneProcess)
{
  Patched room;
  room.Mesh.AddBox({ 0, 0, 0 }, { 4, 3, 2.5 }, 2, true);
  room.EndEach();
  room.Mesh.AddBox({ 1, 1, 0.5 }, { 1.7, 1.6, 1.2 }, 2, false);
  room.End();
  for (const ViewFactorMethod method : All)
  {
    ViewFactorOptions options = With(method, 0.05);
    options.AbsoluteTolerance = 2e-3;
    const ViewFactorResult one = room.Compute(options);
    test::ThreadRanks(3).Run([&](const Communicator& ranks) {
      ViewFactorOptions shared = options;
      shared.Ranks = &ranks;
      shared.Threads = 1;
      const ViewFactorResult result = room.Compute(shared);
      ASSERT_EQ(result.Rows.size(), one.Rows.size());
      for (std::size_t k = 0; k < one.Rows.size(); ++k)
      {
        EXPECT_EQ(result.Rows[k].Value, one.Rows[k].Value);
        EXPECT_EQ(result.Rows[k].Error, one.Rows[k].Error);
      }
      EXPECT_EQ(result.Sky.Value, one.Sky.Value);
      EXPECT_EQ(result.Pairs, one.Pairs);
      EXPECT_EQ(result.Rays, one.Rays);
    });
  }
}

TEST(ViewFactors, MemoryLimitIsAnErrorThatNamesEnough)
{
  Patched sphere;
  sphere.Mesh.AddSphere({}, 1.0, 8, true);
  sphere.EndEach();
  ViewFactorOptions options;
  options.MemoryLimit = 1 << 14;
  try
  {
    sphere.Compute(options);
    FAIL();
  }
  catch (const InputError& error)
  {
    EXPECT_EQ(error.Array, "MemoryLimit");
    EXPECT_NE(error.Expected.find("MiB"), std::string::npos);
  }
}

TEST(ViewFactorClosure, MovesWhatIsUncertain)
{
  // Three patches, all closed; the exchange 0-1 is uncertain and off, the others are known.
  const std::vector<double> areas{ 1.0, 1.0, 1.0 };
  std::vector<GroupExchange> rows{ { 0, 1, 0.52, 0.0, 0.05 }, { 0, 2, 0.5, 1e-9, 0.0 },
    { 1, 2, 0.5, 1e-9, 0.0 } };
  EXPECT_NEAR(CloseExchange(rows, areas, { 1, 1, 1 }), 0.02, 1e-9);
  for (const GroupExchange& row : rows)
  {
    EXPECT_NEAR(row.Value, 0.5, 1e-9);
  }
  // Only rows asked for; a patch that sees itself.
  rows = { { 0, 0, 0.25, 0.0, 0.01 }, { 0, 1, 0.7, 0.0, 0.01 } };
  CloseExchange(rows, { 1.0, 2.0 }, { 1, 0 });
  EXPECT_NEAR(rows[0].Value + rows[1].Value, 1.0, 1e-12);
  EXPECT_NEAR(rows[0].Value, 0.275, 1e-9);
  // Sums above the area are scaled down, symmetric.
  rows = { { 0, 1, 1.5, 0.0, 0.0 }, { 0, 2, 0.5, 0.0, 0.0 } };
  EXPECT_NEAR(CapExchange(rows, { 1.0, 5.0, 5.0 }), 0.75, 1e-12);
  EXPECT_NEAR(rows[0].Value + rows[1].Value, 1.0, 1e-12);
  EXPECT_NEAR(rows[0].Error(), 0.75, 1e-12);
}
