// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/DenseOperator.h"

#include "radiometry/formfactor/GroupedOperator.h"
#include "radiometry/scene/InputError.h"
#include "tests/core/TestScenes.h"
#include "tests/core/ThreadRanks.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <sstream>

using namespace radiometry;

namespace
{

struct Built
{
  explicit Built(const test::Mesh& mesh, const ExchangeOptions& options = {}, double area = 1e300)
    : Geometry(mesh.ToScene())
    , Occluders(Geometry)
    , Elements(ElementSet(Geometry, true).DividedToArea(area))
    , F(Geometry, Occluders, Elements, options)
  {
  }
  Scene Geometry;
  OcclusionScene Occluders;
  ElementSet Elements;
  DenseOperator F;
};

double Defect(const DenseOperator& f)
{
  double worst = 0.0;
  for (std::size_t i = 0; i < f.Size(); ++i)
  {
    worst = std::max(worst, std::abs(1.0 - f.RowSum(i)));
  }
  return worst;
}

/// A room with a pillar, on the floor or above it, and a screen.
test::Mesh Furnished(double foot = 0.0)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 5, true);
  mesh.AddBox({ 0.3, 0.3, foot }, { 0.6, 0.7, 0.5 }, 2, false);
  mesh.AddGrid({ 0.1, 0.1, 0.6 }, { 0.5, 0, 0 }, { 0, 0.5, 0.1 }, 3, 3);
  return mesh;
}

struct Values
{
  std::vector<double> Rows, Out, Geometry, Visibility;
  std::vector<std::int32_t> Components;
  ClosureReport Closure;
};

/// What can be asked of an operator, for three bands.
Values AllOf(const FormFactorOperator& f)
{
  Values v;
  const std::size_t n = f.Size();
  std::vector<double> B(3 * n);
  for (std::size_t k = 0; k < B.size(); ++k)
  {
    B[k] = 1.0 + std::sin(static_cast<double>(k));
  }
  v.Out.resize(3 * n);
  v.Geometry.resize(3 * n);
  v.Visibility.resize(3 * n);
  f.Apply(B.data(), v.Out.data(), 3);
  f.ApplyError(B.data(), v.Geometry.data(), v.Visibility.data(), 3);
  for (std::size_t i = 0; i < n; ++i)
  {
    v.Rows.push_back(f.RowSum(i));
  }
  v.Components = f.Components();
  v.Closure = f.Closure();
  return v;
}

double Furthest(const std::vector<double>& a, const std::vector<double>& b)
{
  double worst = a.size() == b.size() ? 0.0 : 1e300;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
  {
    worst = std::max(worst, std::abs(a[k] - b[k]) / std::max(1e-3, std::abs(b[k])));
  }
  return worst;
}

} // namespace

TEST(ElementSet, FindsTheElementOfAPoint)
{
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 3, 0, 0 }, { 0, 1, 0 }, 1, 1);
  Scene scene = mesh.ToScene();
  scene.Optics.TwoSided[1] = 1;
  ElementSet elements(scene, true);
  EXPECT_EQ(elements.Size(), 3u);
  EXPECT_EQ(elements.CountAtArea(0.1), 48u);
  elements = elements.DividedToArea(0.1);
  EXPECT_EQ(elements.Size(), 48u);
  std::vector<std::uint8_t> marked(48, 0);
  marked[5] = 1;
  elements = elements.Divided(marked);
  EXPECT_EQ(elements.Size(), 51u);
  double area = 0.0;
  for (std::size_t e = 0; e < elements.Size(); ++e)
  {
    const Patch& p = elements.GetPatches()[e];
    area += elements.GetAreas()[e];
    const Triangle3 t = scene.TriangleAt(static_cast<std::size_t>(p.Triangle));
    EXPECT_GT(Dot(AreaNormal2(p.Corners), AreaNormal2(t)) * (p.Side ? -1.0 : 1.0), 0.0);
    // Barycentric coordinates of a point of the element lead back to it.
    const Vec3 c = 0.5 * p.Corners[0] + 0.3 * p.Corners[1] + 0.2 * p.Corners[2];
    const double whole = LengthSquared(AreaNormal2(t));
    const double u = Dot(Cross(c - t[0], t[2] - t[0]), AreaNormal2(t)) / whole;
    const double v = Dot(Cross(t[1] - t[0], c - t[0]), AreaNormal2(t)) / whole;
    EXPECT_EQ(elements.Find(p.Triangle, p.Side == 0, u, v), static_cast<std::int32_t>(e));
  }
  EXPECT_NEAR(area, 4.5, 1e-14);
  EXPECT_EQ(elements.Find(0, false, 0.3, 0.3), -1);
  EXPECT_EQ(elements.Find(-1, true, 0.3, 0.3), -1);
  std::size_t groups = 0;
  const auto group = elements.Groups(scene, 1, groups);
  EXPECT_EQ(groups, 13u); // twelve parents, one of which has a divided child
  EXPECT_EQ(group.size(), 51u);
}

TEST(DenseOperator, ClosedCubeConservesToRounding)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 4, 4, 4 }, 4, true);
  ExchangeOptions options;
  const Built cube(mesh, options);
  const ClosureReport closure = cube.F.Closure();
  EXPECT_EQ(closure.ClosedRows, cube.F.Size());
  EXPECT_LT(closure.DefectBefore, 1e-3);
  EXPECT_LT(closure.DefectAfter, 2e-15);
  EXPECT_LT(closure.LargestChange, 2e-3);
  // Opposite walls, by summing the exchange of their cells: 0.1998 of 16 m^2.
  double opposite = 0.0, adjacent = 0.0;
  for (std::size_t i = 0; i < 32; ++i)
  {
    for (std::size_t j = 32; j < 64; ++j)
    {
      opposite += cube.F.Exchange(i, j);
    }
    for (std::size_t j = 64; j < 96; ++j)
    {
      adjacent += cube.F.Exchange(i, j);
    }
  }
  EXPECT_NEAR(opposite / 16.0, 0.199824895698387, 2e-5);
  EXPECT_NEAR(adjacent / 16.0, 0.200043776075403, 2e-5);
}

TEST(DenseOperator, SphereInteriorIsUniform)
{
  // F_ij -> A_j/(4 pi R^2) as facets shrink; for facets more than a radius apart, weighted by
  // their exchange.
  const double pi = std::acos(-1.0);
  double before = 0.0;
  for (int bands : { 8, 16 })
  {
    test::Mesh mesh;
    mesh.AddSphere({ 1, 2, 3 }, 2.0, bands, true);
    const Built sphere(mesh);
    EXPECT_LT(Defect(sphere.F), 2e-15);
    const auto& a = sphere.F.Areas();
    const auto& patches = sphere.Elements.GetPatches();
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      for (std::size_t j = 0; j < a.size(); ++j)
      {
        if (Length(Centroid(patches[i].Corners) - Centroid(patches[j].Corners)) > 2.0)
        {
          const double off = sphere.F.Exchange(i, j) / (a[i] * a[j] / (16.0 * pi)) - 1.0;
          sum += a[i] * a[j];
          squares += a[i] * a[j] * off * off;
        }
      }
    }
    const double rms = std::sqrt(squares / sum);
    EXPECT_LT(rms, bands == 8 ? 0.1 : 0.6 * before);
    before = rms;
  }
}

TEST(DenseOperator, PlatesWithAPlateBetween)
{
  // An opaque plate between two plates: exactly nothing passes.
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2);
  mesh.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 2, 2);
  const Built open(mesh);
  double through = 0.0;
  for (std::size_t i = 0; i < 8; ++i)
  {
    for (std::size_t j = 8; j < 16; ++j)
    {
      through += open.F.Exchange(i, j);
    }
  }
  EXPECT_NEAR(through, 0.199824895698387, 2e-5);
  mesh.AddGrid({ -0.5, -0.5, 0.5 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1);
  const Built blocked(mesh);
  for (std::size_t i = 0; i < 8; ++i)
  {
    for (std::size_t j = 8; j < 16; ++j)
    {
      EXPECT_EQ(blocked.F.Exchange(i, j), 0.0);
    }
  }
}

TEST(DenseOperator, PartlyBlockedWithinItsError)
{
  // Unit plates 1 apart, a screen at half height over half the width. By symmetry (a ray and its
  // mirror image) the exact factor needs no trick: fine strips give the reference.
  test::Mesh coarse, fine;
  for (auto* mesh : { &coarse, &fine })
  {
    const int n = mesh == &fine ? 10 : 2;
    mesh->AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, n, n);
    mesh->AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, n, n);
    mesh->AddGrid({ -2, -2, 0.5 }, { 2.5, 0, 0 }, { 0, 5, 0 }, 1, 1);
  }
  const auto through = [](const Built& b, std::size_t n) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i)
    {
      for (std::size_t j = n; j < 2 * n; ++j)
      {
        sum += b.F.Exchange(i, j);
      }
    }
    return sum;
  };
  ExchangeOptions options;
  options.RelativeTolerance = 1e-3;
  const double reference = through(Built(fine, options), 200);
  options.RelativeTolerance = 0.01;
  int inside = 0;
  double squares = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
  {
    options.Seed = seed;
    const Built b(coarse, options);
    std::vector<double> source(b.F.Size(), 0.0), error(source), geometry(source), E(source);
    for (std::size_t j = 8; j < 16; ++j)
    {
      source[j] = 1.0;
    }
    b.F.ApplyError(source.data(), geometry.data(), error.data(), 1);
    double variance = 0.0;
    for (std::size_t i = 0; i < 8; ++i)
    {
      variance += std::pow(error[i] * b.F.Areas()[i], 2);
    }
    const double off = through(b, 8) - reference;
    inside += std::abs(off) <= 2.0 * std::sqrt(variance) + 1e-4;
    squares += off * off / (variance + 1e-12);
  }
  EXPECT_GE(inside, 18);
  EXPECT_LT(squares / 20.0, 3.0);  // not too bold
  EXPECT_GT(squares / 20.0, 0.02); // nor too timid
}

TEST(DenseOperator, SameBytesForAnyNumberOfThreads)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 3, true);
  mesh.AddBox({ 0.3, 0.3, 0.0 }, { 0.6, 0.7, 0.5 }, 1, false);
  std::vector<double> first;
  for (int threads : { 1, 2, 7 })
  {
    ExchangeOptions options;
    options.Threads = threads;
    const Built b(mesh, options);
    std::vector<double> values;
    for (std::size_t i = 0; i < b.F.Size(); ++i)
    {
      values.push_back(b.F.RowSum(i));
      for (std::size_t j = 0; j < b.F.Size(); ++j)
      {
        values.push_back(b.F.Exchange(i, j));
      }
    }
    std::vector<double> in(
      values.begin(), values.begin() + static_cast<std::ptrdiff_t>(b.F.Size()));
    std::vector<double> out(in.size());
    b.F.Apply(in.data(), out.data(), 1);
    values.insert(values.end(), out.begin(), out.end());
    if (first.empty())
    {
      first = values;
    }
    EXPECT_EQ(std::memcmp(first.data(), values.data(), values.size() * sizeof(double)), 0)
      << threads;
  }
}

TEST(DenseOperator, RowsNeverExceedOne)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 2, 1 }, 2, true);
  mesh.AddBox({ 0.3, 0.3, 0.0 }, { 0.6, 0.7, 0.5 }, 2, false);
  mesh.AddGrid({ 0.1, 1.2, 0.1 }, { 0.5, 0, 0 }, { 0, 0, 0.9 }, 2, 2);
  const Built b(mesh);
  for (std::size_t i = 0; i < b.F.Size(); ++i)
  {
    EXPECT_LE(b.F.RowSum(i), 1.0 + 1e-12) << i;
    EXPECT_GE(b.F.RowSum(i), 0.0);
  }
}

TEST(DenseOperator, MemoryLimitSaysWhatWouldDo)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 12, true);
  ExchangeOptions options;
  options.MemoryLimit = 1 << 20;
  try
  {
    const Built b(mesh, options);
    FAIL() << "no error";
  }
  catch (const InputError& error)
  {
    EXPECT_EQ(error.Array, "MemoryLimit");
    const double least = std::stod(error.Expected.substr(error.Expected.find("least") + 6));
    EXPECT_GT(least, 5.0);
    EXPECT_LT(least, 40.0);
    options.MemoryLimit = static_cast<std::size_t>(least * 1024 * 1024);
    const Built enough(mesh, options);
    EXPECT_LE(enough.F.MemoryBytes(), options.MemoryLimit);
    EXPECT_LT(Defect(enough.F), 1e-14); // single precision conserves all the same
  }
}

TEST(DenseOperator, SizeAndPlaceDoNotMatter)
{
  const Built here(Furnished(0.1));
  const Values expected = AllOf(here.F);
  for (const double size : { 1e-6, 1.0, 1e6 })
  {
    for (const Vec3& place : { Vec3{}, Vec3{ 5e5, 4e6, 100.0 } })
    {
      test::Mesh mesh = Furnished(0.1);
      for (Vec3& p : mesh.Points)
      {
        // Turned by some 37 degrees about z and 53 about x, in whole numbers of fifths.
        p = { 0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z };
        p = { p.x, 0.6 * p.y - 0.8 * p.z, 0.8 * p.y + 0.6 * p.z };
        p = size * (p + place);
      }
      const Built there(mesh);
      const Values values = AllOf(there.F);
      std::size_t inside = 0;
      for (std::size_t k = 0; k < values.Out.size(); ++k)
      {
        const double error = 2.0 * std::hypot(values.Visibility[k], expected.Visibility[k]) +
          values.Geometry[k] + expected.Geometry[k];
        inside += std::abs(values.Out[k] - expected.Out[k]) <= error + 1e-6;
      }
      EXPECT_GE(static_cast<double>(inside), 0.95 * static_cast<double>(values.Out.size()))
        << size << " " << place.x;
      EXPECT_LT(Furthest(values.Out, expected.Out), 0.2) << size << " " << place.x;
      EXPECT_EQ(values.Components, expected.Components);
      EXPECT_LT(values.Closure.DefectAfter, 2e-15);
    }
  }
}

TEST(DenseOperator, DividedPatchesExchangeTheSame)
{
  // Reciprocity and additivity: whole cells, and the same cells in quarters, behind a pillar.
  const Built whole(Furnished()), parts(Furnished(), {}, 0.01);
  std::size_t cells = 0;
  const auto cellOf = parts.Elements.CellGroups(cells);
  ASSERT_GT(parts.F.Size(), 2 * whole.F.Size());
  std::vector<double> coarse(whole.F.Size()), fine(parts.F.Size());
  std::vector<double> B(whole.F.Size(), 0.0), divided(parts.F.Size());
  for (std::size_t i = 0; i < B.size(); ++i)
  {
    B[i] = Centroid(whole.Elements.GetPatches()[i].Corners).z > 0.499 ? 1.0 : 0.0;
  }
  for (std::size_t e = 0; e < divided.size(); ++e)
  {
    divided[e] = B[static_cast<std::size_t>(parts.Elements.GetPatches()[e].Cell)];
  }
  whole.F.Apply(B.data(), coarse.data(), 1);
  parts.F.Apply(divided.data(), fine.data(), 1);
  std::vector<double> geometry(B.size()), visibility(B.size()), mean(B.size(), 0.0);
  whole.F.ApplyError(B.data(), geometry.data(), visibility.data(), 1);
  for (std::size_t e = 0; e < divided.size(); ++e)
  {
    mean[static_cast<std::size_t>(parts.Elements.GetPatches()[e].Cell)] +=
      fine[e] * parts.F.Areas()[e];
  }
  std::size_t inside = 0;
  for (std::size_t i = 0; i < B.size(); ++i)
  {
    const double off = std::abs(mean[i] / whole.F.Areas()[i] - coarse[i]);
    inside += off <= 2.5 * visibility[i] + geometry[i] + 1e-3;
  }
  EXPECT_GE(static_cast<double>(inside), 0.95 * static_cast<double>(B.size()));
}

TEST(DenseOperator, DuplicatesHalveTheLightOfNeither)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 3, true);
  mesh.AddBox({ 0.3, 0.3, 0.2 }, { 0.6, 0.7, 0.5 }, 1, false);
  test::Mesh twice = mesh;
  twice.Triangles.insert(twice.Triangles.end(), mesh.Triangles.begin(), mesh.Triangles.end());
  const Built once(mesh), both(twice);
  const std::size_t n = once.F.Size();
  ASSERT_EQ(both.F.Size(), 2 * n);
  std::vector<double> B(2 * n), seen(n), seenTwice(2 * n), geometry(2 * n), visibility(2 * n);
  for (std::size_t i = 0; i < 2 * n; ++i)
  {
    B[i] = i < n ? 1.0 + std::sin(static_cast<double>(i)) : 17.0; // covered ones send nothing
  }
  once.F.Apply(B.data(), seen.data(), 1);
  both.F.Apply(B.data(), seenTwice.data(), 1);
  both.F.ApplyError(B.data(), geometry.data(), visibility.data(), 1);
  for (std::size_t i = 0; i < n; ++i)
  {
    EXPECT_EQ(seenTwice[i], seenTwice[n + i]) << i;
    EXPECT_NEAR(seenTwice[i], seen[i], 4.0 * visibility[i] + geometry[i] + 2e-3) << i;
    EXPECT_NEAR(both.F.RowSum(i), 1.0, 1e-12);
    EXPECT_EQ(both.F.RowSum(i), both.F.RowSum(n + i));
  }
  EXPECT_LT(both.F.Closure().LargestChange, 0.05);
}

TEST(DenseOperator, APosterOnAWallHidesTheWall)
{
  // A half of the floor is covered by a sheet in its plane, of a higher number or a lower one.
  for (const bool first : { false, true })
  {
    test::Mesh mesh;
    const auto sheet = [&] { mesh.AddGrid({ 0, 0, 0 }, { 0.5, 0, 0 }, { 0, 1, 0 }, 1, 1); };
    first ? sheet() : void();
    mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
    first ? void() : sheet();
    mesh.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 2, 2);
    const Built b(mesh);
    std::vector<double> B(b.F.Size(), 0.0), out(B);
    const std::size_t floor = first ? 2 : 0, poster = first ? 0 : 2;
    // The ceiling receives from floor and poster as from one floor.
    B[0] = B[1] = B[2] = B[3] = 1.0;
    b.F.Apply(B.data(), out.data(), 1);
    double flux = 0.0;
    for (std::size_t i = 4; i < b.F.Size(); ++i)
    {
      flux += out[i] * b.F.Areas()[i];
    }
    EXPECT_NEAR(flux, 0.199824895698387, first ? 0.01 * 0.2 : 1e-5);
    // ... and either from what is on top.
    B[floor] = B[floor + 1] = 0.0;
    b.F.Apply(B.data(), out.data(), 1);
    flux = 0.0;
    for (std::size_t i = 4; i < b.F.Size(); ++i)
    {
      flux += out[i] * b.F.Areas()[i];
    }
    EXPECT_NEAR(flux, first ? 0.5 * 0.199824895698387 : 0.0, 2e-5);
    // Both receive.
    EXPECT_NEAR(b.F.RowSum(poster), 0.1998, 0.05);
    EXPECT_NEAR(b.F.RowSum(floor), 0.1998, 0.05);
  }
}

TEST(DenseOperator, RanksGiveTheSerialValues)
{
  const Scene scene = Furnished().ToScene();
  const OcclusionScene occluders(scene);
  const ElementSet elements(scene, true);
  ExchangeOptions options;
  options.RelativeTolerance = 0.02;
  const DenseOperator serial(scene, occluders, elements, options);
  const Values expected = AllOf(serial);
  for (int size : { 2, 3 })
  {
    std::vector<std::size_t> memory(static_cast<std::size_t>(size));
    test::ThreadRanks(size).Run([&](const Communicator& ranks) {
      ExchangeOptions own = options;
      own.Ranks = &ranks;
      own.Threads = 2;
      const DenseOperator part(scene, occluders, elements, own);
      const Values values = AllOf(part);
      EXPECT_LT(Furthest(values.Out, expected.Out), 1e-12);
      EXPECT_LT(Furthest(values.Geometry, expected.Geometry), 1e-12);
      EXPECT_LT(Furthest(values.Visibility, expected.Visibility), 1e-12);
      EXPECT_LT(Furthest(values.Rows, expected.Rows), 1e-12);
      EXPECT_EQ(values.Components, expected.Components);
      EXPECT_EQ(values.Closure.ClosedRows, expected.Closure.ClosedRows);
      EXPECT_EQ(part.Samples(), serial.Samples());
      memory[static_cast<std::size_t>(ranks.Rank())] = part.MemoryBytes();
    });
    // Each keeps its share of the tiles.
    for (const std::size_t bytes : memory)
    {
      EXPECT_LT(static_cast<double>(bytes), 1.35 / size * static_cast<double>(serial.MemoryBytes()));
    }
  }
}

TEST(DenseOperator, IsSavedAndLoaded)
{
  const Built b(Furnished());
  std::stringstream stream;
  ArchiveWriter out(stream);
  b.F.Save(out);
  const std::string bytes = stream.str();
  ArchiveReader in(stream, bytes.size());
  const auto loaded = DenseOperator::Load(in);
  EXPECT_EQ(in.Checksum(), out.Checksum());
  const Values was = AllOf(b.F), is = AllOf(*loaded);
  EXPECT_EQ(was.Out, is.Out);
  EXPECT_EQ(was.Geometry, is.Geometry);
  EXPECT_EQ(was.Visibility, is.Visibility);
  EXPECT_EQ(was.Rows, is.Rows);
  EXPECT_EQ(was.Components, is.Components);
  EXPECT_EQ(b.F.Description(), loaded->Description());
  EXPECT_EQ(b.F.MemoryBytes(), loaded->MemoryBytes());
  for (std::size_t length : { std::size_t(0), std::size_t(9), bytes.size() / 2, bytes.size() - 1 })
  {
    std::stringstream cut(bytes.substr(0, length));
    ArchiveReader reader(cut, length);
    EXPECT_THROW(DenseOperator::Load(reader), std::runtime_error) << length;
  }
}

TEST(DenseOperator, PastTheDeadlineItIsCoarseAndSaysSo)
{
  const test::Mesh mesh = Furnished();
  ExchangeOptions options;
  options.RelativeTolerance = 3e-3;
  const Built fine(mesh, options);
  options.RelativeTolerance = 0.01;
  options.SecondsLeft = 1e-6;
  const Built coarse(mesh, options);
  EXPECT_LT(coarse.F.Samples(), fine.F.Samples() / 4);
  const std::size_t n = fine.F.Size();
  // A lit ceiling: what arrives elsewhere.
  std::vector<double> source(n, 0.0), exact(n), rough(n), geometry(n), visibility(n);
  for (std::size_t i = 0; i < n; ++i)
  {
    source[i] = Centroid(fine.Elements.GetPatches()[i].Corners).z > 0.499 ? 1.0 : 0.0;
  }
  fine.F.Apply(source.data(), exact.data(), 1);
  coarse.F.Apply(source.data(), rough.data(), 1);
  coarse.F.ApplyError(source.data(), geometry.data(), visibility.data(), 1);
  std::size_t inside = 0, lit = 0;
  double stated = 0.0, true2 = 0.0;
  for (std::size_t i = 0; i < n; ++i)
  {
    const double off = std::abs(rough[i] - exact[i]);
    ++lit;
    inside += off <= geometry[i] + 2.0 * visibility[i] + 1e-3;
    stated += geometry[i] + 2.0 * visibility[i];
    true2 += off;
  }
  EXPECT_GE(static_cast<double>(inside), 0.95 * static_cast<double>(lit));
  EXPECT_LT(stated, 30.0 * true2);
  for (std::size_t i = 0; i < n; ++i)
  {
    EXPECT_LE(coarse.F.RowSum(i), 1.0 + 1e-12);
  }
}

TEST(GroupedOperator, IsTheGalerkinProjection)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 2, true);
  const Built b(mesh);
  std::vector<std::int32_t> wall(b.F.Size());
  for (std::size_t i = 0; i < wall.size(); ++i)
  {
    wall[i] = static_cast<std::int32_t>(i / 8);
  }
  const GroupedOperator walls(b.F, wall, 6);
  EXPECT_EQ(walls.Size(), 6u);
  const std::vector<double> source{ 1, 0, 0, 0, 0, 0 };
  std::vector<double> out(6);
  walls.Apply(source.data(), out.data(), 1);
  EXPECT_EQ(out[0], 0.0);
  EXPECT_NEAR(out[1], 0.199824895698387, 1e-4);
  EXPECT_NEAR(out[2], 0.200043776075403, 1e-4);
  EXPECT_NEAR(walls.RowSum(3), 1.0, 1e-14);
}
