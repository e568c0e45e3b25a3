// SPDX-License-Identifier: BSD-3-Clause
// The bound on |Gouraud - Phong| against dense sampling of both.
#include "radiometry/shading/ShadingBound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

using namespace radiometry;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

struct Random
{
  std::mt19937 Engine;
  double In(double a, double b)
  {
    return a + (b - a) * (static_cast<double>(this->Engine()) / 4294967296.0);
  }
  bool Chance(double p) { return this->In(0.0, 1.0) < p; }
  Rgb Color(double most)
  {
    return { this->In(0.0, most), this->In(0.0, most), this->In(0.0, most) };
  }
  Vec3 Direction()
  {
    const double z = this->In(-1.0, 1.0);
    const double phi = this->In(0.0, 6.283185307179586);
    const double s = std::sqrt(1.0 - z * z);
    return { s * std::cos(phi), s * std::sin(phi), z };
  }
};

struct Case
{
  LightingModel Model;
  std::vector<DisplayLight> Lights;
  DisplayMaterial Front;
  DisplayMaterial Back;
  Vec3 Eye;
  Vec3 Viewer;
  ShadedTriangle Triangle;

  double Bound(double enough = Infinity) const
  {
    return ShadingBound(
      Model, Lights, Front, Back, Eye, Viewer, Triangle, enough);
  }
  Rgb At(const std::array<double, 3>& w, bool front) const
  {
    ShadingSample sample;
    for (int k = 0; k < 3; ++k)
    {
      sample.Point += w[k] * Triangle.Points[k];
      sample.Normal += w[k] * Triangle.Normals[k];
    }
    sample.Eye = Eye;
    sample.Viewer = Viewer;
    sample.FrontFacing = front;
    return Shade(Model, Lights, Front, Back, sample).Color;
  }
  /// The greatest difference over a grid of places.
  double Difference(int steps) const
  {
    double most = 0.0;
    for (const bool front : { true, false })
    {
      if (!front && !Model.TwoSided)
      {
        continue;
      }
      const Rgb a = this->At({ { 1, 0, 0 } }, front);
      const Rgb b = this->At({ { 0, 1, 0 } }, front);
      const Rgb c = this->At({ { 0, 0, 1 } }, front);
      for (int i = 0; i <= steps; ++i)
      {
        for (int j = 0; i + j <= steps; ++j)
        {
          const double u = static_cast<double>(i) / steps;
          const double v = static_cast<double>(j) / steps;
          const Rgb g = u * a + v * b + (1.0 - u - v) * c;
          const Rgb p = this->At({ { u, v, 1.0 - u - v } }, front);
          most = std::max(
            { most, std::abs(g.r - p.r), std::abs(g.g - p.g), std::abs(g.b - p.b) });
        }
      }
    }
    return most;
  }
};

/// kind: 0 directional, 1 point, 2 spot, 3 any.
Case MakeCase(unsigned seed, int kind, double size, bool highlight, ReflectionModel reflection)
{
  Random random{ std::mt19937(seed) };
  Case c;
  c.Model.Reflection = reflection;
  c.Model.LocalViewer = random.Chance(0.7);
  c.Model.TwoSided = random.Chance(0.5);
  const Vec3 center = random.In(0.0, 3.0) * random.Direction();
  const Vec3 axis = random.Direction();
  for (int k = 0; k < 3; ++k)
  {
    c.Triangle.Points[k] = center + random.In(0.3, 1.0) * size * random.Direction();
  }
  const Vec3 face = Normalized(AreaNormal2(c.Triangle.Points));
  for (int k = 0; k < 3; ++k)
  {
    const Vec3 bent = face + random.In(0.0, 1.0) * size * random.Direction();
    c.Triangle.Normals[k] = Normalized(bent);
  }
  if (random.Chance(0.1)) // of unlike lengths: allowed, and only then is the bound loose
  {
    c.Triangle.Normals[0] = random.In(0.5, 2.0) * c.Triangle.Normals[0];
  }
  c.Eye = center + random.In(0.5, 4.0) * random.Direction();
  c.Viewer = axis;
  const int count = 1 + static_cast<int>(random.Engine() % 3);
  for (int i = 0; i < count; ++i)
  {
    const int of = kind == 3 ? static_cast<int>(random.Engine() % 3) : kind;
    DisplayLight light;
    const Vec3 from = of == 0 ? random.Direction() : center + random.In(0.5, 4.0) * random.Direction();
    light.Position = { { from.x, from.y, from.z, of == 0 ? 0.0 : 1.0 } };
    light.Diffuse = random.Color(2.0);
    light.Specular = random.Chance(0.5) ? light.Diffuse : random.Color(2.0);
    light.Ambient = random.Chance(0.3) ? random.Color(0.5) : Rgb();
    if (of != 0)
    {
      const double a = random.In(0.0, 1.0);
      light.Attenuation = a < 0.5 ? std::array<double, 3>{ { 0.0, 0.0, 1.0 } }
                                  : std::array<double, 3>{ { random.In(0.01, 1.0), random.In(0.0, 1.0),
                                      random.In(0.0, 1.0) } };
    }
    if (of == 2)
    {
      light.SpotDirection = center - from + random.In(0.0, 1.0) * random.Direction();
      light.CosCutoff = std::cos(random.In(0.1, 1.5));
      light.SpotExponent = random.Chance(0.5) ? random.In(0.0, 30.0) : 0.0;
      light.SmoothEdge = random.Chance(0.5);
      light.CosInnerCutoff =
        light.CosCutoff + (1.0 - light.CosCutoff) * random.In(0.1, 0.9);
    }
    c.Lights.push_back(light);
  }
  const auto material = [&]() {
    DisplayMaterial m;
    m.Diffuse = random.Color(1.0);
    m.Ambient = random.Color(1.0);
    m.Specular = highlight ? random.Color(1.0) : Rgb();
    m.Shininess = random.Chance(0.2) ? std::floor(random.In(0.0, 4.0)) : random.In(0.2, 80.0);
    return m;
  };
  c.Front = material();
  c.Back = material();
  return c;
}

struct Tally
{
  std::vector<double> Ratios; // bound / difference
  int Infinite = 0;
  double Median()
  {
    EXPECT_FALSE(Ratios.empty());
    std::nth_element(Ratios.begin(), Ratios.begin() + Ratios.size() / 2, Ratios.end());
    return Ratios[Ratios.size() / 2];
  }
};

/// Never violated. Returns how loose it is.
Tally Check(int kind, double size, bool highlight, ReflectionModel reflection, int cases, int steps)
{
  Tally tally;
  for (int i = 0; i < cases; ++i)
  {
    const unsigned seed = 1000u * static_cast<unsigned>(kind + 1) + static_cast<unsigned>(i);
    const Case c = MakeCase(seed, kind, size, highlight, reflection);
    const double bound = c.Bound();
    const double difference = c.Difference(steps);
    EXPECT_LE(difference, bound * (1.0 + 1e-9) + 1e-13)
      << "seed " << seed << " kind " << kind << " size " << size << " model "
      << static_cast<int>(reflection);
    if (!std::isfinite(bound))
    {
      ++tally.Infinite;
    }
    else if (difference > 1e-9)
    {
      tally.Ratios.push_back(bound / difference);
    }
  }
  return tally;
}

const ReflectionModel Models[] = { ReflectionModel::BlinnPhong, ReflectionModel::Phong,
  ReflectionModel::Physical };
const char* const Kinds[] = { "directional", "point", "spot", "any" };

} // namespace

TEST(ShadingBound, IsNeverViolatedAndNotLooseOnDiffuseSurfaces)
{
  for (int kind = 0; kind < 4; ++kind)
  {
    for (const double size : { 0.02, 0.1, 0.5 })
    {
      Tally tally = Check(kind, size, false, ReflectionModel::Physical, 400, 16);
      const double median = tally.Median();
      std::printf("matte %-11s size %.2f: bound/difference median %.2f, no bound %d of 400\n",
        Kinds[kind], size, median, tally.Infinite);
      EXPECT_LT(median, size < 0.3 ? 7.0 : 20.0);
      EXPECT_LT(tally.Infinite, size < 0.3 ? 1 : 20);
    }
  }
}

TEST(ShadingBound, IsNeverViolatedAndNotLooseOnHighlights)
{
  for (const ReflectionModel model : Models)
  {
    for (const double size : { 0.02, 0.1, 0.5 })
    {
      Tally tally = Check(3, size, true, model, 400, 16);
      const double median = tally.Median();
      std::printf("gloss model %d     size %.2f: bound/difference median %.2f, no bound %d of 400\n",
        static_cast<int>(model), size, median, tally.Infinite);
      EXPECT_LT(median, size < 0.3 ? 6.0 : 20.0);
    }
  }
}

// The bound is of second order, as the difference is.
TEST(ShadingBound, FallsWithTheSquareOfTheSize)
{
  Case c = MakeCase(5, 1, 0.2, false, ReflectionModel::Physical);
  Vec3 middle = Centroid(c.Triangle.Points);
  Vec3 normal = c.Triangle.Normals[0] + c.Triangle.Normals[1] + c.Triangle.Normals[2];
  const auto shrink = [&](double s) {
    Case small = c;
    for (int k = 0; k < 3; ++k)
    {
      small.Triangle.Points[k] = middle + s * (c.Triangle.Points[k] - middle);
      small.Triangle.Normals[k] = normal / 3.0 + s * (c.Triangle.Normals[k] - normal / 3.0);
    }
    return small;
  };
  const double at = shrink(0.1).Bound();
  ASSERT_GT(at, 0.0);
  EXPECT_NEAR(shrink(0.01).Bound() / at, 0.01, 0.002);
}

// What does not vary is exact: one normal, directional light, no highlight.
TEST(ShadingBound, IsZeroWhereNothingVaries)
{
  Case c = MakeCase(7, 0, 0.5, false, ReflectionModel::Physical);
  c.Triangle.Normals[1] = c.Triangle.Normals[2] = c.Triangle.Normals[0] = { 0.0, 0.0, 1.0 };
  c.Lights.resize(1);
  c.Lights[0].Position = { { 0.0, 0.3, 0.4, 0.0 } };
  EXPECT_NEAR(c.Bound(), 0.0, 1e-15);
  c.Lights[0].Position = { { 0.0, 0.3, -0.4, 0.0 } }; // behind
  EXPECT_NEAR(c.Bound(), 0.0, 1e-15);
  c.Lights.clear();
  EXPECT_EQ(c.Bound(), 0.0);
}

TEST(ShadingBound, HardCases)
{
  const Case whole = MakeCase(11, 1, 0.1, true, ReflectionModel::Phong);
  Case c = whole;
  c.Triangle.Normals[1] = {}; // the interpolated normal may vanish
  c.Triangle.Normals[0] = -c.Triangle.Normals[2];
  EXPECT_EQ(c.Bound(), Infinity);
  c = whole;
  c.Triangle.Normals[1].x = std::nan("");
  EXPECT_EQ(c.Bound(), Infinity);
  c = whole;
  c.Triangle.Points[1].x = Infinity;
  EXPECT_EQ(c.Bound(), Infinity);
  c = whole;
  const Vec3 on = Centroid(c.Triangle.Points); // a light on the surface
  c.Lights[0].Position = { { on.x, on.y, on.z, 1.0 } };
  EXPECT_EQ(c.Bound(), Infinity);
  c.Lights[0].Enabled = false;
  EXPECT_LT(c.Bound(), Infinity);
  c = whole;
  c.Lights[0].Diffuse.r = std::nan("");
  EXPECT_EQ(c.Bound(), Infinity);
  // A triangle without area has nothing to interpolate.
  c = whole;
  c.Triangle.Points[1] = c.Triangle.Points[2] = c.Triangle.Points[0];
  c.Triangle.Normals[1] = c.Triangle.Normals[2] = c.Triangle.Normals[0];
  EXPECT_NEAR(c.Bound(), 0.0, 1e-14);
  // A cone's hard edge across it: at most the light itself, and no less than the step.
  c = MakeCase(13, 2, 0.1, false, ReflectionModel::Physical);
  c.Lights.resize(1);
  c.Lights[0].Ambient = Rgb();
  c.Lights[0].SmoothEdge = false;
  c.Lights[0].SpotExponent = 0.0;
  c.Triangle.Points = { { { 0, 0, 0 }, { 0.1, 0, 0 }, { 0, 0.1, 0 } } };
  c.Triangle.Normals = { { { 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 } } };
  c.Lights[0].Position = { { 0, 0, 1, 1 } };
  c.Lights[0].Attenuation = { { 1, 0, 0 } };
  c.Lights[0].SpotDirection = { 0.05 - std::tan(0.3), 0, -1 };
  c.Lights[0].CosCutoff = std::cos(0.3);
  const double bound = c.Bound();
  EXPECT_GE(bound, c.Difference(40));
  EXPECT_LT(bound, 2.0);
}

// Stopping early changes no decision.
TEST(ShadingBound, StopsAtEnough)
{
  for (unsigned seed = 0; seed < 200; ++seed)
  {
    const Case c = MakeCase(seed, 3, 0.1, true, ReflectionModel::Physical);
    const double whole = c.Bound();
    for (const double enough : { 0.0, 1e-3, 1e-2 })
    {
      const double part = c.Bound(enough);
      EXPECT_LE(part, whole);
      EXPECT_EQ(part <= enough, whole <= enough);
    }
  }
}
