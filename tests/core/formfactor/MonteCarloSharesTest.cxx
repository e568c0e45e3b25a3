// SPDX-License-Identifier: BSD-3-Clause
// The rays of the Monte Carlo operator: over ranks, in files, and where they start.
#include "radiometry/formfactor/MonteCarloOperator.h"

#include "radiometry/geometry/Sampling.h"
#include "tests/core/TestScenes.h"
#include "tests/core/ThreadRanks.h"

#include <cmath>
#include <gtest/gtest.h>
#include <sstream>

using namespace radiometry;

namespace
{

/// A closed room, things in it and a mirror, a satin and a coloured wall: all kinds of paths.
struct World
{
  explicit World(bool paths, bool coloured = false)
  {
    test::Mesh mesh;
    mesh.AddSphere({ 0, 0, 0 }, 2.0, 8, true);
    mesh.AddBox({ -0.5, -0.4, -0.6 }, { 0.5, 0.4, 0.6 }, 2, false);
    this->Geometry = mesh.ToScene();
    Materials& optics = this->Geometry.Optics;
    optics.Bands = 2;
    optics.DiffuseReflectance[0].assign(2 * this->Geometry.Cells, 0.3);
    optics.SpecularReflectance[0].assign(2 * this->Geometry.Cells, 0.0);
    optics.Shininess[0].assign(this->Geometry.Cells, 2e6);
    for (std::size_t c = 0; c < this->Geometry.Cells; c += 3)
    {
      optics.SpecularReflectance[0][2 * c] = 0.6;
      optics.SpecularReflectance[0][2 * c + 1] = coloured ? 0.2 : 0.6;
      optics.Shininess[0][c] = c % 2 ? 2e6 : 20.0;
    }
    this->Occluders = std::make_shared<const OcclusionScene>(this->Geometry);
    this->Elements = std::make_shared<const ElementSet>(this->Geometry, true);
    if (paths)
    {
      this->Options.Paths =
        std::make_shared<const SpecularSurfaces>(this->Geometry, true, true, true);
    }
  }
  Scene Geometry;
  std::shared_ptr<const OcclusionScene> Occluders;
  std::shared_ptr<const ElementSet> Elements;
  ExchangeOptions Options;
};

std::vector<double> Wave(std::size_t n)
{
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    values[i] = 1.0 + std::sin(static_cast<double>(3 * i));
  }
  return values;
}

/// F B and its error, two bands, one after the other.
std::vector<double> Answers(const MonteCarloOperator& f)
{
  const std::vector<double> in = Wave(2 * f.Size());
  std::vector<double> out(in), none(in), error(in);
  f.Apply(in.data(), out.data(), 2);
  f.ApplyError(in.data(), none.data(), error.data(), 2);
  out.insert(out.end(), error.begin(), error.end());
  for (std::size_t i = 0; i < f.Size(); ++i)
  {
    out.push_back(f.RowSum(i, 1));
    out.push_back(f.Components()[i]);
  }
  return out;
}

std::vector<std::uint8_t> EveryThird(std::size_t n)
{
  std::vector<std::uint8_t> marked(n, 0);
  for (std::size_t i = 0; i < n; i += 3)
  {
    marked[i] = 1;
  }
  return marked;
}

const struct
{
  bool Paths, Coloured;
} Kinds[] = { { false, false }, { true, false }, { true, true } };

} // namespace

TEST(MonteCarloShares, RanksGiveTheBytesOfOne)
{
  for (const auto& kind : Kinds)
  {
    const World w(kind.Paths, kind.Coloured);
    MonteCarloOperator whole(w.Occluders, w.Elements, w.Options, 32);
    whole.DoubleRays(EveryThird(whole.Size()));
    const std::vector<double> expected = Answers(whole);
    for (const int size : { 2, 3, 7 })
    {
      test::ThreadRanks(size).Run([&](const Communicator& ranks) {
        ExchangeOptions options = w.Options;
        options.Ranks = &ranks;
        options.Threads = 1;
        MonteCarloOperator f(w.Occluders, w.Elements, options, 32);
        f.DoubleRays(EveryThird(f.Size()));
        EXPECT_EQ(Answers(f), expected);
        EXPECT_EQ(f.Samples(), whole.Samples());
        EXPECT_EQ(f.Closure().ClosedRows, whole.Closure().ClosedRows);
        EXPECT_EQ(f.Closure().ReciprocityDefect, whole.Closure().ReciprocityDefect);
        EXPECT_EQ(f.MemoryBytes() < whole.MemoryBytes(), true);
      });
    }
  }
}

TEST(MonteCarloShares, FilesKeepAll)
{
  for (const auto& kind : Kinds)
  {
    const World w(kind.Paths, kind.Coloured);
    MonteCarloOperator made(w.Occluders, w.Elements, w.Options, 32);
    made.DoubleRays(EveryThird(made.Size()));
    std::stringstream file;
    ArchiveWriter writer(file);
    made.Save(writer);
    const std::string bytes = file.str();
    const auto load = [&](const std::string& text, const World& world) {
      std::istringstream in(text);
      ArchiveReader reader(in, text.size());
      return MonteCarloOperator::Load(reader, world.Occluders, world.Elements, world.Options);
    };
    const auto read = load(bytes, w);
    EXPECT_EQ(Answers(*read), Answers(made));
    made.DoubleRays(EveryThird(made.Size()));
    read->DoubleRays(EveryThird(made.Size()));
    EXPECT_EQ(Answers(*read), Answers(made));

    EXPECT_THROW(load(bytes.substr(0, bytes.size() - 3), w), std::runtime_error);
    EXPECT_THROW(load(bytes, World(!kind.Paths || !kind.Coloured, true)), std::runtime_error);
    // A bit turned anywhere is refused or harmless, never a ray that meets nothing that is there.
    int refused = 0;
    for (std::size_t at = 0; at < bytes.size(); at += 1 + bytes.size() / 400)
    {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ 0x40);
      try
      {
        for (const double v : Answers(*load(damaged, w)))
        {
          EXPECT_FALSE(std::isnan(v));
        }
      }
      catch (const std::runtime_error&)
      {
        ++refused;
      }
    }
    EXPECT_GT(refused, 40);
  }
}

TEST(MonteCarloShares, RaysThatStartFreeMeetWhatOthersMeet)
{
  // From corners and rims, along walls, from outside the scene, at things that touch.
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 2, 3, 1 }, 4, true);
  mesh.AddBox({ 0.5, 0.8, 0.0 }, { 1.1, 1.7, 0.6 }, 3, false);
  mesh.AddBox({ 1.1, 1.0, 0.0 }, { 1.5, 1.5, 1e-7 }, 1, false);
  const Scene scene = mesh.ToScene();
  const OcclusionScene occluders(scene), prepared(scene);
  prepared.PrepareRays();
  std::vector<RayEnd> from;
  std::vector<Vec3> directions;
  const SobolSequence sequence(7);
  for (std::uint32_t k = 0; k < 6000; ++k)
  {
    const auto u = sequence(k);
    const auto t = static_cast<std::int32_t>(k % scene.Triangles.size());
    const Triangle3 v = scene.TriangleAt(static_cast<std::size_t>(t));
    const Vec3 normal = Normalized(AreaNormal2(v));
    const double near = k % 5 == 0 ? 1e-9 : 1.0;
    if (k % 7 == 0)
    {
      from.push_back({ { 5.0 * u[0] - 1.0, 5.0 * u[1] - 1.0, 3.0 * u[2] }, -1 });
    }
    else
    {
      from.push_back({ TrianglePoint(v, near * u[0], u[1]), t });
    }
    directions.push_back((1.0 + k % 3) * CosineDirection(normal, u[2], k % 4 == 0 ? 1e-12 : u[3]));
  }
  std::vector<SurfaceHit> hits;
  for (std::size_t k = 0; k < from.size(); ++k)
  {
    hits.push_back(prepared.Closest(from[k], directions[k]));
  }
  std::size_t met = 0, same = 0;
  for (std::size_t k = 0; k < from.size(); ++k)
  {
    const SurfaceHit single = occluders.Closest(from[k], directions[k]);
    // An edge belongs to either of its triangles.
    if (hits[k].Triangle == single.Triangle)
    {
      EXPECT_EQ(hits[k].Front, single.Front);
    }
    else
    {
      ASSERT_GE(hits[k].Triangle, 0) << k;
      ASSERT_GE(single.Triangle, 0) << k;
    }
    if (single.Triangle >= 0)
    {
      ++met;
      // Sheets 1e-7 apart are one, seen from afar in single precision.
      EXPECT_NEAR(hits[k].Distance, single.Distance, 5e-7);
      same += std::abs(hits[k].Distance - single.Distance) < 1e-12;
    }
  }
  EXPECT_GT(met, from.size() / 2);
  EXPECT_GT(same, met - met / 100);
}
