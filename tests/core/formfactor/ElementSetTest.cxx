// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ElementSet.h"

#include "tests/core/TestScenes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <sstream>
#include <stdexcept>

using namespace radiometry;

namespace
{

Scene Room()
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 2, 3, 1 }, 2, true);
  mesh.AddGrid({ 0.5, 0.5, 0.5 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 1);
  Scene scene = mesh.ToScene(0.5);
  scene.Optics.TwoSided[scene.Cells - 1] = 1;
  scene.Optics.DiffuseTransmittance.assign(scene.Cells, 0.0);
  scene.Optics.DiffuseTransmittance[scene.Cells - 2] = 0.3;
  return scene;
}

ElementSet Uneven(const Scene& scene)
{
  ElementSet set = ElementSet(scene, true).DividedToArea(0.2);
  std::vector<std::uint8_t> marked(set.Size(), 0);
  for (std::size_t e = 0; e < set.Size(); e += 7)
  {
    marked[e] = 1;
  }
  return set.Divided(marked);
}

void ExpectSame(const ElementSet& a, const ElementSet& b)
{
  ASSERT_EQ(a.Size(), b.Size());
  EXPECT_EQ(a.Cells(), b.Cells());
  EXPECT_EQ(a.GetAreas(), b.GetAreas());
  for (std::size_t e = 0; e < a.Size(); ++e)
  {
    const Patch& p = a.GetPatches()[e];
    const Patch& q = b.GetPatches()[e];
    EXPECT_EQ(p.Triangle, q.Triangle);
    EXPECT_EQ(p.Cell, q.Cell);
    EXPECT_EQ(p.Side, q.Side);
    EXPECT_EQ(a.Depth(e), b.Depth(e));
    EXPECT_EQ(a.Opposite(e), b.Opposite(e));
    for (std::size_t k = 0; k < 3; ++k)
    {
      EXPECT_EQ(Length(p.Corners[k] - q.Corners[k]), 0.0);
    }
  }
}

} // namespace

TEST(ElementSet, SidesThatReceive)
{
  const Scene scene = Room();
  const auto sides = [&](const ElementSet& set, std::size_t cell) {
    std::set<int> found;
    for (const Patch& p : set.GetPatches())
    {
      if (static_cast<std::size_t>(p.Cell) == cell)
      {
        found.insert(p.Side);
      }
    }
    return found;
  };
  const std::set<int> front{ 0 }, both{ 0, 1 };
  for (const bool backs : { true, false })
  {
    const ElementSet set(scene, backs);
    EXPECT_EQ(sides(set, 0), front);
    EXPECT_EQ(sides(set, scene.Cells - 1), backs ? both : front); // two-sided
    EXPECT_EQ(sides(set, scene.Cells - 2), both);                 // lets light through
  }
}

TEST(ElementSet, FindsAndOpposes)
{
  const Scene scene = Room();
  const ElementSet set = Uneven(scene);
  for (std::size_t e = 0; e < set.Size(); ++e)
  {
    const Patch& p = set.GetPatches()[e];
    const Triangle3 root = scene.TriangleAt(static_cast<std::size_t>(p.Triangle));
    const Vec3 at = Centroid(p.Corners) - root[0];
    const Vec3 n = Cross(root[1] - root[0], root[2] - root[0]);
    const double u = Dot(Cross(at, root[2] - root[0]), n) / Dot(n, n);
    const double v = Dot(Cross(root[1] - root[0], at), n) / Dot(n, n);
    EXPECT_EQ(set.Find(p.Triangle, p.Side == 0, u, v), static_cast<std::int32_t>(e));
    EXPECT_EQ(set.Find(p.Triangle, p.Side != 0, u, v), set.Opposite(e));
    if (set.Opposite(e) >= 0)
    {
      EXPECT_EQ(set.Opposite(static_cast<std::size_t>(set.Opposite(e))),
        static_cast<std::int32_t>(e));
    }
  }
}

TEST(ElementSet, GroupsAreNeighbours)
{
  const Scene scene = Room();
  const ElementSet set = Uneven(scene);
  for (int levels = 1; levels <= 3; ++levels)
  {
    std::size_t count = 0;
    const std::vector<std::int32_t> group = set.Groups(scene, levels, count);
    std::vector<double> area(count, 0.0);
    std::vector<Vec3> normal(count);
    std::vector<int> side(count, -1);
    for (std::size_t e = 0; e < set.Size(); ++e)
    {
      const auto g = static_cast<std::size_t>(group[e]);
      const Patch& p = set.GetPatches()[e];
      area[g] += set.GetAreas()[e];
      normal[g] = normal[g] + 0.5 * AreaNormal2(p.Corners);
      EXPECT_TRUE(side[g] < 0 || side[g] == p.Side);
      side[g] = p.Side;
    }
    for (std::size_t g = 0; g < count; ++g)
    {
      EXPECT_NEAR(Length(normal[g]), area[g], 1e-12); // one plane, in a room of boxes
    }
    EXPECT_LT(count, set.Size() / (levels == 1 ? 2 : 4));
  }
}

TEST(ElementSet, SavedAndLoaded)
{
  const Scene scene = Room();
  const ElementSet set = Uneven(scene);
  std::stringstream stream;
  ArchiveWriter writer(stream);
  set.Save(writer);
  const std::string bytes = stream.str();
  {
    std::istringstream in(bytes);
    ArchiveReader reader(in, bytes.size());
    const ElementSet loaded = ElementSet::Load(reader);
    ExpectSame(set, loaded);
    EXPECT_EQ(reader.Checksum(), writer.Checksum());
    // It can be divided on.
    const std::vector<std::uint8_t> all(set.Size(), 1);
    ExpectSame(set.Divided(all), loaded.Divided(all));
  }
  // Damage is an error or another set, never a crash.
  for (std::size_t k = 0; k < bytes.size(); k += 11)
  {
    std::string damaged = bytes;
    damaged[k] = static_cast<char>(damaged[k] ^ 0x55);
    std::istringstream in(damaged);
    ArchiveReader reader(in, damaged.size());
    try
    {
      ElementSet::Load(reader);
    }
    catch (const std::runtime_error&)
    {
    }
  }
  for (std::size_t length : { std::size_t(0), std::size_t(9), bytes.size() / 2, bytes.size() - 1 })
  {
    std::istringstream in(bytes.substr(0, length));
    ArchiveReader reader(in, bytes.size());
    EXPECT_THROW(ElementSet::Load(reader), std::runtime_error) << length;
  }
}

TEST(ElementSet, ManyTrianglesAtOneVertex)
{
  // A fan: every edge meets at vertex 0. Groups must not take the square of their number.
  test::Mesh mesh;
  const std::int32_t n = 200000;
  mesh.Points.push_back({ 0, 0, 0 });
  for (std::int32_t k = 0; k < n; ++k)
  {
    const double angle = 2.0 * std::acos(-1.0) * k / n;
    mesh.Points.push_back({ std::cos(angle), std::sin(angle), 0 });
    mesh.Triangles.push_back({ 0, k + 1, k + 1 < n ? k + 2 : 1 });
  }
  const Scene scene = mesh.ToScene();
  const ElementSet set(scene, false);
  std::size_t count = 0;
  const std::vector<std::int32_t> group = set.Groups(scene, 2, count);
  std::vector<int> members(count, 0);
  for (const std::int32_t g : group)
  {
    ++members[static_cast<std::size_t>(g)];
  }
  for (const int m : members)
  {
    EXPECT_LE(m, 16);
  }
  EXPECT_LT(count, static_cast<std::size_t>(n) / 8);
}
