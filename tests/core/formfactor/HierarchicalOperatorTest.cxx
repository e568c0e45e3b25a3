// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/HierarchicalOperator.h"

#include "radiometry/scene/InputError.h"
#include "tests/core/TestScenes.h"
#include "tests/core/ThreadRanks.h"

#include <algorithm>
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
  /// A_i F_ij as a matrix, column by column.
  std::vector<double> Matrix() const
  {
    const std::size_t n = this->F.Size();
    std::vector<double> s(n * n), unit(n), column(n);
    for (std::size_t j = 0; j < n; ++j)
    {
      std::fill(unit.begin(), unit.end(), 0.0);
      unit[j] = 1.0;
      this->F.Apply(unit.data(), column.data(), 1);
      for (std::size_t i = 0; i < n; ++i)
      {
        s[i * n + j] = column[i] * this->F.Areas()[i];
      }
    }
    return s;
  }
  double Defect() const
  {
    double worst = 0.0;
    for (std::size_t i = 0; i < this->F.Size(); ++i)
    {
      worst = std::max(worst, std::abs(1.0 - this->F.RowSum(i)));
    }
    return worst;
  }
  Scene Geometry;
  OcclusionScene Occluders;
  ElementSet Elements;
  HierarchicalOperator F;
};

} // namespace

TEST(HierarchicalOperator, ClosedCubeConservesToRounding)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 4, 4, 4 }, 8, true);
  const Built cube(mesh);
  EXPECT_EQ(cube.F.Closure().ClosedRows, cube.F.Size());
  EXPECT_LT(cube.Defect(), 1e-14);
  // Opposite and adjacent walls: 0.1998 and 0.2000 of all that leaves one.
  const std::size_t wall = cube.F.Size() / 6;
  std::vector<double> source(cube.F.Size(), 0.0), out(cube.F.Size());
  std::fill(source.begin(), source.begin() + static_cast<std::ptrdiff_t>(wall), 1.0);
  cube.F.Apply(source.data(), out.data(), 1);
  double sums[6] = {};
  for (std::size_t i = 0; i < out.size(); ++i)
  {
    sums[i / wall] += out[i] * cube.F.Areas()[i] / 16.0;
  }
  EXPECT_EQ(sums[0], 0.0);
  EXPECT_NEAR(sums[1], 0.199824895698387, 2e-3);
  for (int k = 2; k < 6; ++k)
  {
    EXPECT_NEAR(sums[k], 0.200043776075403, 2e-3);
  }
}

TEST(HierarchicalOperator, ReciprocityIsExactAndRowsAreBounded)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 2, 1 }, 4, true);
  mesh.AddBox({ 0.3, 0.3, 0.0 }, { 0.6, 0.7, 0.5 }, 2, false);
  mesh.AddGrid({ 0.1, 1.2, 0.1 }, { 0.5, 0, 0 }, { 0, 0.2, 0.9 }, 2, 2);
  const Built b(mesh);
  const std::vector<double> s = b.Matrix();
  const std::size_t n = b.F.Size();
  for (std::size_t i = 0; i < n; ++i)
  {
    double row = 0.0;
    for (std::size_t j = 0; j < n; ++j)
    {
      row += s[i * n + j] / b.F.Areas()[i];
      EXPECT_NEAR(s[i * n + j], s[j * n + i], 1e-15 * b.F.Areas()[i]);
      EXPECT_GE(s[i * n + j], -1e-16 * b.F.Areas()[i]);
    }
    EXPECT_NEAR(row, b.F.RowSum(i), 1e-12);
    EXPECT_LE(row, 1.0 + 1e-12);
  }
}

TEST(HierarchicalOperator, SameBytesForAnyNumberOfThreads)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 8, true);
  mesh.AddBox({ 0.3, 0.3, 0.0 }, { 0.6, 0.7, 0.5 }, 4, false);
  std::vector<double> first;
  for (int threads : { 1, 4 })
  {
    ExchangeOptions options;
    options.Threads = threads;
    const Built b(mesh, options);
    std::vector<double> in(b.F.Size()), values(3 * b.F.Size());
    for (std::size_t i = 0; i < in.size(); ++i)
    {
      in[i] = std::sin(static_cast<double>(i));
    }
    b.F.Apply(in.data(), values.data(), 1);
    b.F.ApplyError(in.data(), values.data() + in.size(), values.data() + 2 * in.size(), 1);
    if (first.empty())
    {
      first = values;
    }
    EXPECT_EQ(std::memcmp(first.data(), values.data(), values.size() * sizeof(double)), 0);
  }
}

TEST(HierarchicalOperator, FewElements)
{
  test::Mesh none;
  const Built empty(none);
  EXPECT_EQ(empty.F.Size(), 0u);
  empty.F.Apply(nullptr, nullptr, 1);
  EXPECT_TRUE(empty.F.Components().empty());

  test::Mesh one;
  one.Points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  one.Triangles = { { 0, 1, 2 } };
  const Built single(one);
  double x = 1.0, out = 7.0;
  single.F.Apply(&x, &out, 1);
  EXPECT_EQ(out, 0.0);
  EXPECT_EQ(single.F.RowSum(0), 0.0);
}

TEST(HierarchicalOperator, MemoryLimitSaysWhatWouldDo)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 12, true);
  ExchangeOptions options;
  options.MemoryLimit = 1 << 18;
  try
  {
    const Built b(mesh, options);
    FAIL() << "no error";
  }
  catch (const InputError& error)
  {
    EXPECT_EQ(error.Array, "MemoryLimit");
    const double least = std::stod(error.Expected.substr(error.Expected.find("least") + 6));
    EXPECT_LT(least, 8.0);
    options.MemoryLimit = static_cast<std::size_t>(least * 1024 * 1024);
    const Built enough(mesh, options);
    EXPECT_LE(enough.F.MemoryBytes(), options.MemoryLimit);
    EXPECT_LT(enough.Defect(), 1e-12);
    EXPECT_NE(enough.F.Description().find("coarser"), std::string::npos);
  }
}

TEST(HierarchicalOperator, SphereInteriorIsUniform)
{
  // What a sphere's inside receives does not depend on the place: A_source/(4 pi R^2), as facets
  // shrink.
  double before = 1.0;
  for (int bands : { 8, 16, 32 })
  {
    test::Mesh mesh;
    mesh.AddSphere({ 1, 2, 3 }, 2.0, bands, true);
    ExchangeOptions options;
    options.RelativeTolerance = 0.01;
    const Built sphere(mesh, options);
    EXPECT_LT(sphere.Defect(), 1e-14);
    std::vector<double> source(sphere.F.Size()), out(sphere.F.Size());
    double area = 0.0, whole = 0.0;
    for (std::size_t i = 0; i < source.size(); ++i)
    {
      source[i] = sphere.Elements.GetPatches()[i].Corners[0].z > 0.9;
      area += source[i] * sphere.F.Areas()[i];
      whole += sphere.F.Areas()[i];
    }
    sphere.F.Apply(source.data(), out.data(), 1);
    double squares = 0.0;
    for (std::size_t i = 0; i < source.size(); ++i)
    {
      const double off = out[i] / (area / whole) - 1.0;
      // Facets that touch the source see it at other angles than the sphere's.
      squares += source[i] == 0.0 ? off * off * sphere.F.Areas()[i] / whole : 0.0;
    }
    EXPECT_LT(std::sqrt(squares), 0.8 * before) << bands;
    before = std::sqrt(squares);
  }
  EXPECT_LT(before, 0.06);
}

TEST(HierarchicalOperator, SquaresAtAnyDivision)
{
  // Unit squares: parallel at distance one, and square to each other along an edge.
  for (int n : { 1, 4, 12 })
  {
    test::Mesh parallel, corner;
    parallel.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, n, n);
    parallel.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, n, n);
    corner.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, n, n);
    corner.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, n, n);
    ExchangeOptions options;
    options.RelativeTolerance = 0.01;
    for (const test::Mesh* mesh : { &parallel, &corner })
    {
      const Built b(*mesh, options);
      const std::size_t half = b.F.Size() / 2;
      std::vector<double> source(2 * half, 0.0), out(2 * half);
      std::fill(source.begin(), source.begin() + static_cast<std::ptrdiff_t>(half), 1.0);
      b.F.Apply(source.data(), out.data(), 1);
      double flux = 0.0;
      for (std::size_t i = 0; i < 2 * half; ++i)
      {
        flux += out[i] * b.F.Areas()[i];
        EXPECT_TRUE(i >= half || out[i] == 0.0);
      }
      EXPECT_NEAR(flux, mesh == &parallel ? 0.199824895698387 : 0.200043776075403, 6e-4) << n;
    }
  }
}

TEST(HierarchicalOperator, APlateBetweenHidesAll)
{
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 8, 8);
  mesh.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 8, 8);
  mesh.AddGrid({ -0.5, -0.5, 0.5 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1);
  const Built b(mesh);
  std::vector<double> source(b.F.Size(), 0.0), out(b.F.Size());
  std::fill(source.begin(), source.begin() + 128, 1.0);
  b.F.Apply(source.data(), out.data(), 1);
  for (std::size_t i = 128; i < 256; ++i)
  {
    EXPECT_EQ(out[i], 0.0);
  }
}

TEST(HierarchicalOperator, SavedAndLoadedIsTheSame)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 4, true);
  mesh.AddSphere({ 0.5, 0.5, 0.4 }, 0.2, 6, false);
  const Built b(mesh);
  std::stringstream stream;
  ArchiveWriter out(stream);
  b.F.Save(out);
  const std::string bytes = stream.str();
  ArchiveReader in(stream, bytes.size());
  const auto loaded = HierarchicalOperator::Load(in);
  ASSERT_EQ(loaded->Size(), b.F.Size());
  std::vector<double> x(b.F.Size()), y(x), z(x);
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    x[i] = 1.0 + std::sin(static_cast<double>(i));
  }
  b.F.Apply(x.data(), y.data(), 1);
  loaded->Apply(x.data(), z.data(), 1);
  EXPECT_EQ(std::memcmp(y.data(), z.data(), y.size() * sizeof(double)), 0);
  EXPECT_EQ(loaded->Components(), b.F.Components());
  EXPECT_EQ(loaded->Description(), b.F.Description());
  // Damaged or cut short: an error, and no reading outside.
  for (std::size_t at = 0; at < bytes.size(); at += 9973)
  {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    std::stringstream bad(damaged), cut(bytes.substr(0, at));
    ArchiveReader badIn(bad, bytes.size()), cutIn(cut, bytes.size());
    try
    {
      HierarchicalOperator::Load(badIn)->Apply(x.data(), z.data(), 1);
    }
    catch (const std::runtime_error&)
    {
    }
    EXPECT_THROW(HierarchicalOperator::Load(cutIn), std::runtime_error) << at;
  }
}

TEST(HierarchicalOperator, RanksShareLinks)
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 5, true);
  mesh.AddBox({ 0.3, 0.3, 0.1 }, { 0.6, 0.7, 0.5 }, 3, false);
  mesh.AddBox({ 3, 0, 0 }, { 4, 1, 1 }, 2, true);
  const Built serial(mesh);
  const std::size_t n = serial.F.Size();
  std::vector<double> x(2 * n), wanted(2 * n), form(2 * n), sight(2 * n);
  for (std::size_t i = 0; i < 2 * n; ++i)
  {
    x[i] = 1.0 + std::sin(static_cast<double>(i));
  }
  serial.F.Apply(x.data(), wanted.data(), 2);
  serial.F.ApplyError(x.data(), form.data(), sight.data(), 2);
  const auto components = serial.F.Components();
  EXPECT_EQ(*std::max_element(components.begin(), components.end()), 1);
  test::ThreadRanks(3).Run([&](const Communicator& ranks) {
    ExchangeOptions options;
    options.Ranks = &ranks;
    const HierarchicalOperator f(serial.Geometry, serial.Occluders, serial.Elements, options);
    std::vector<double> y(2 * n), a(2 * n), b(2 * n);
    f.Apply(x.data(), y.data(), 2);
    f.ApplyError(x.data(), a.data(), b.data(), 2);
    for (std::size_t i = 0; i < 2 * n; ++i)
    {
      EXPECT_NEAR(y[i], wanted[i], 1e-12);
      EXPECT_NEAR(a[i], form[i], 1e-9);
      EXPECT_NEAR(b[i], sight[i], 1e-9);
    }
    EXPECT_EQ(f.Components(), components);
    EXPECT_EQ(f.Links(), serial.F.Links());
    EXPECT_EQ(f.Samples(), serial.F.Samples());
    EXPECT_LT(f.MemoryBytes(), serial.F.MemoryBytes());
  });
}

TEST(HierarchicalOperator, DuplicatesHalveTheLightOfNeither)
{
  test::Mesh single, twice;
  single.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 4, true);
  twice.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 4, true);
  twice.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 4, true);
  const Built a(single), b(twice);
  const std::size_t n = a.F.Size();
  ASSERT_EQ(b.F.Size(), 2 * n);
  std::vector<double> x(2 * n), wanted(n), got(2 * n);
  for (std::size_t i = 0; i < n; ++i)
  {
    x[i] = x[n + i] = 1.0 + std::sin(static_cast<double>(i));
  }
  a.F.Apply(x.data(), wanted.data(), 1);
  b.F.Apply(x.data(), got.data(), 1);
  for (std::size_t i = 0; i < n; ++i)
  {
    EXPECT_NEAR(got[i], wanted[i], 0.02) << i;
    EXPECT_EQ(got[n + i], got[i]) << i;
    EXPECT_NEAR(b.F.RowSum(n + i), 1.0, 1e-12);
  }
}

TEST(HierarchicalOperator, HardMeshes)
{
  test::Mesh duplicates;
  duplicates.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 2, true);
  duplicates.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 2, true);
  test::Mesh slivers;
  slivers.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 200, 1);
  slivers.AddGrid({ 0, 0, 1e-3 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 200);
  test::Mesh apart;
  apart.AddBox({ 5e5, 4e6, 0 }, { 5e5 + 1, 4e6 + 1, 1 }, 2, true);
  apart.AddBox({ 5e5 + 1e4, 4e6, 0 }, { 5e5 + 1e4 + 1e-3, 4e6 + 1e-3, 1e-3 }, 2, true);
  test::Mesh junction; // one wall finer than the floor that it stands on, a needle without area
  junction.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 3);
  junction.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 7, 7);
  junction.Points.push_back({ 0.2, 0.2, 0.5 });
  junction.Points.push_back({ 0.4, 0.4, 0.5 });
  junction.Points.push_back({ 0.6, 0.6, 0.5 });
  const auto last = static_cast<std::int32_t>(junction.Points.size());
  junction.Triangles.push_back({ last - 3, last - 2, last - 1 });
  for (const test::Mesh* mesh : { &duplicates, &slivers, &apart, &junction })
  {
    const Built b(*mesh);
    const std::size_t n = b.F.Size();
    std::vector<double> one(n, 1.0), out(n), form(n), sight(n);
    b.F.Apply(one.data(), out.data(), 1);
    b.F.ApplyError(one.data(), form.data(), sight.data(), 1);
    for (std::size_t i = 0; i < n; ++i)
    {
      EXPECT_TRUE(std::isfinite(out[i]) && std::isfinite(form[i]) && std::isfinite(sight[i]));
      EXPECT_GE(out[i], 0.0);
      EXPECT_LE(out[i], 1.0 + 1e-9) << i;
    }
    if (mesh == &slivers)
    {
      EXPECT_NEAR(out[200], 1.0, 0.02); // plates a thousandth of their size apart
    }
    if (mesh == &apart)
    {
      EXPECT_LT(b.Defect(), 1e-13);
      const auto label = b.F.Components();
      EXPECT_EQ(*std::max_element(label.begin(), label.end()), 1);
    }
  }
}

TEST(HierarchicalOperator, LinksGrowInStepWithElements)
{
  double perElement[2];
  int k = 0;
  for (int n : { 12, 48 })
  {
    test::Mesh mesh;
    mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, n, true);
    ExchangeOptions options;
    options.RelativeTolerance = 0.03;
    const Built b(mesh, options);
    perElement[k++] = static_cast<double>(b.F.Links()) / static_cast<double>(b.F.Size());
  }
  EXPECT_LT(perElement[1], 1.2 * perElement[0]);
}
