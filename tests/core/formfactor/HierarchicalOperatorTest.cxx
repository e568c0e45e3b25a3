// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/HierarchicalOperator.h"

#include "radiometry/scene/InputError.h"
#include "tests/core/TestScenes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

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
    EXPECT_NE(error.Expected.find("at least"), std::string::npos);
  }
}
