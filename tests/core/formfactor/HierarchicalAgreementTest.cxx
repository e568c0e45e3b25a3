// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/DenseOperator.h"
#include "radiometry/formfactor/HierarchicalOperator.h"
#include "tests/core/TestScenes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace radiometry;

namespace
{

test::Mesh Cornell()
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 1, 1, 1 }, 6, true);
  mesh.AddBox({ 0.15, 0.2, 0 }, { 0.45, 0.5, 0.6 }, 2, false);
  mesh.AddBox({ 0.55, 0.5, 0 }, { 0.85, 0.8, 0.3 }, 2, false);
  return mesh;
}

test::Mesh Rooms()
{
  test::Mesh mesh;
  mesh.AddBox({ 0, 0, 0 }, { 8, 4, 3 }, 8, true);
  mesh.AddBox({ 3.9, 0, 0 }, { 4.1, 1.5, 3 }, 2, false);
  mesh.AddBox({ 3.9, 2.5, 0 }, { 4.1, 4, 3 }, 2, false);
  mesh.AddBox({ 3.9, 1.5, 2 }, { 4.1, 2.5, 3 }, 1, false);
  return mesh;
}

test::Mesh Soup()
{
  test::Mesh mesh;
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (int i = 0; i < 700; ++i)
  {
    const Vec3 c{ u(generator), u(generator), u(generator) };
    const auto first = static_cast<std::int32_t>(mesh.Points.size());
    for (int k = 0; k < 3; ++k)
    {
      const double x = u(generator) - 0.5, y = u(generator) - 0.5, z = u(generator) - 0.5;
      mesh.Points.push_back(c + 0.2 * Vec3{ x, y, z });
    }
    mesh.Triangles.push_back({ first, first + 1, first + 2 });
  }
  return mesh;
}

test::Mesh Sphere()
{
  test::Mesh mesh;
  mesh.AddSphere({ 0, 0, 0 }, 1, 14, true);
  return mesh;
}

test::Mesh Slots()
{
  test::Mesh mesh;
  mesh.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 10, 10);
  mesh.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 10, 10);
  for (int k = 0; k < 5; ++k)
  {
    mesh.AddBox({ 0.04 + 0.2 * k, -0.1, 0.48 }, { 0.14 + 0.2 * k, 1.1, 0.52 }, 1, false);
  }
  return mesh;
}

} // namespace

/// The reference is all pairs at a tenth of the tolerance; light leaves the top of the scene, or all
/// of it as after one reflection. A row's stated error (95 %): 2.2 times that of form factors and
/// twice that of visibility.
TEST(HierarchicalAgreement, ErrorsCoverWhatAllPairsSay)
{
  const std::pair<const char*, test::Mesh> scenes[] = { { "cornell", Cornell() },
    { "rooms", Rooms() }, { "soup", Soup() }, { "sphere", Sphere() }, { "slots", Slots() } };
  for (const auto& [name, mesh] : scenes)
  {
    const Scene scene = mesh.ToScene();
    const OcclusionScene occluders(scene);
    const ElementSet elements(scene, true);
    ExchangeOptions options;
    options.RelativeTolerance = 0.03;
    const HierarchicalOperator f(scene, occluders, elements, options);
    options.RelativeTolerance = 0.003;
    options.Seed = 77;
    const DenseOperator all(scene, occluders, elements, options);
    const std::size_t n = f.Size();
    std::vector<double> source(n), got(n), wanted(n), form(n), sight(n), ownForm(n), ownSight(n);
    double top = -1e300;
    for (const Patch& p : elements.GetPatches())
    {
      top = std::max(top, Centroid(p.Corners).z);
    }
    for (std::size_t i = 0; i < n; ++i)
    {
      source[i] = Centroid(elements.GetPatches()[i].Corners).z > 0.95 * top ? 1.0 : 0.0;
    }
    for (int bounce = 0; bounce < 2; ++bounce)
    {
      f.Apply(source.data(), got.data(), 1);
      f.ApplyError(source.data(), form.data(), sight.data(), 1);
      all.Apply(source.data(), wanted.data(), 1);
      all.ApplyError(source.data(), ownForm.data(), ownSight.data(), 1);
      std::size_t inside = 0;
      double squares = 0.0, mean = 0.0;
      std::vector<double> ratios;
      for (std::size_t i = 0; i < n; ++i)
      {
        const double off = std::abs(got[i] - wanted[i]);
        const double stated = 2.2 * form[i] + 2.0 * sight[i];
        inside += off <= stated + ownForm[i] + 2.0 * ownSight[i];
        ratios.push_back(stated / std::max(off, 1e-12));
        squares += off * off / static_cast<double>(n);
        mean += wanted[i] / static_cast<double>(n);
      }
      std::nth_element(
        ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(n / 2), ratios.end());
      EXPECT_GE(static_cast<double>(inside), 0.95 * static_cast<double>(n)) << name << bounce;
      EXPECT_LT(ratios[n / 2], 10.0) << name << bounce;
      if (bounce == 1)
      {
        EXPECT_LT(std::sqrt(squares), 0.03 * mean) << name;
      }
      for (std::size_t i = 0; i < n; ++i)
      {
        source[i] = 0.5 * wanted[i] + (bounce == 0 ? 0.1 : 0.0);
      }
    }
  }
}

TEST(HierarchicalAgreement, FinerToleranceIsNearer)
{
  const test::Mesh mesh = Cornell();
  const Scene scene = mesh.ToScene();
  const OcclusionScene occluders(scene);
  const ElementSet elements(scene, true);
  ExchangeOptions options;
  options.RelativeTolerance = 1e-3;
  const DenseOperator all(scene, occluders, elements, options);
  std::vector<double> source(elements.Size()), wanted(source), got(source);
  for (std::size_t i = 0; i < source.size(); ++i)
  {
    source[i] = elements.GetPatches()[i].Corners[0].x > 0.0;
  }
  all.Apply(source.data(), wanted.data(), 1);
  double last = 1.0;
  for (const double tolerance : { 0.1, 0.03, 0.01 })
  {
    options.RelativeTolerance = tolerance;
    const HierarchicalOperator f(scene, occluders, elements, options);
    f.Apply(source.data(), got.data(), 1);
    double squares = 0.0;
    for (std::size_t i = 0; i < got.size(); ++i)
    {
      squares += (got[i] - wanted[i]) * (got[i] - wanted[i]) / static_cast<double>(got.size());
    }
    EXPECT_LT(std::sqrt(squares), 0.9 * last) << tolerance;
    last = std::sqrt(squares);
  }
  EXPECT_LT(last, 0.005);
}
