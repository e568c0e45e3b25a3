// SPDX-License-Identifier: BSD-3-Clause
// Picture against radiometry/shading, pixel by pixel. Needs a display: run through display.py.
//
// The rule (docs/rendering/parity.md): |picture - model| <= max(2e-5 |model|, 1e-6) in each band of
// each pixel. Where the model itself moves further than that when its float32 inputs move by four
// roundings, no float32 picture can be held to it: there, and only there, the difference may be as
// large as that movement (FloatConditioning). Pixels at whose rim another triangle begins, and
// samples on a step of the model (the hard edge of a cone, the end of a legacy highlight), are not
// compared.
//
// With RADIOMETRY_PARITY_JSON set, the table is written to that file.
#include "ParityStage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

using namespace radiometry;

namespace
{

constexpr int Size = 64;
constexpr double Relative = 2e-5;
constexpr double Floor = 1e-6;
const char* const Shadings[] = { "Flat", "Gouraud", "Phong" };

ParityStage& TheStage()
{
  static ParityStage* stage = new ParityStage(Size); // outlives the tests: contexts and static
  return *stage;                                     // order do not mix
}

/// One row of the table.
struct Difference
{
  std::string Feature;
  std::string Shading;
  int Scenes = 0;
  long Pixels = 0;              // compared, of a surface
  long AboveOne = 0;            // of them with a band above 1
  double Worst = 0.0;           // of the well-conditioned: |picture - model|/max(|model|, floor)
  long IllConditioned = 0;      // values held to their conditioning
  double WorstConditioned = 0.0; // of those: difference over what conditioning allows
  double Brightest = 0.0;       // the greatest value compared
};

std::vector<Difference>& Table()
{
  static std::vector<Difference> table;
  return table;
}

class TableWriter : public ::testing::Environment
{
public:
  void TearDown() override
  {
    const char* path = std::getenv("RADIOMETRY_PARITY_JSON");
    if (!path)
    {
      return;
    }
    std::ofstream file(path);
    file << "{\n  \"renderer\": \"" << TheStage().GetRenderer() << "\",\n  \"relative\": " << Relative << ",\n  \"floor\": " << Floor
         << ",\n  \"size\": " << Size << ",\n  \"rows\": [";
    const char* separator = "\n";
    for (const Difference& d : Table())
    {
      file << separator << "    {\"feature\": \"" << d.Feature << "\", \"shading\": \""
           << d.Shading << "\", \"scenes\": " << d.Scenes << ", \"pixels\": " << d.Pixels
           << ", \"above_one\": " << d.AboveOne << ", \"worst\": " << d.Worst
           << ", \"ill_conditioned\": " << d.IllConditioned
           << ", \"worst_conditioned\": " << d.WorstConditioned
           << ", \"brightest\": " << d.Brightest << "}";
      separator = ",\n";
    }
    file << "\n  ]\n}\n";
  }
};

const auto* const Writer = ::testing::AddGlobalTestEnvironment(new TableWriter);

void ComparePixel(const ParityScene& scene, int x, int y, const ParityPixel& expected,
  const float* drawn, Difference& total, int& wrong)
{
  const double model[3] = { expected.Color.r, expected.Color.g, expected.Color.b };
  bool above = false;
  for (int c = 0; c < 3; ++c)
  {
    const double off = std::abs(drawn[c] - model[c]);
    const double scale = std::max(std::abs(model[c]), Floor / Relative);
    double error = off / scale;
    above = above || model[c] > 1.0;
    total.Brightest = std::max(total.Brightest, model[c]);
    if (!(error <= Relative))
    {
      const Rgb allowed = FloatConditioning(scene, x, y, Size);
      const double condition = c == 0 ? allowed.r : (c == 1 ? allowed.g : allowed.b);
      if (condition > Relative * scale)
      {
        ++total.IllConditioned;
        total.WorstConditioned = std::max(total.WorstConditioned, off / condition);
        if (off <= condition)
        {
          continue;
        }
      }
      if (++wrong <= 2)
      {
        ADD_FAILURE() << scene.Name << "\nshading " << scene.Shading << " model "
                      << static_cast<int>(scene.Model.Reflection) << " pixel " << x << " " << y
                      << " band " << c << ": picture " << drawn[c] << ", model " << model[c]
                      << ", error " << error << ", conditioning " << condition / scale << " ["
                      << TheStage().GetMapper()->GetShaderFeatures() << "]";
      }
    }
    total.Worst = std::max(total.Worst, error);
  }
  total.AboveOne += above ? 1 : 0;
}

void CompareScene(const ParityScene& scene, Difference& total)
{
  ParityStage& stage = TheStage();
  stage.Set(scene);
  const float* picture = stage.Draw();
  ASSERT_EQ(stage.GetMapper()->GetNumberOfLightsNotDrawn(), 0);
  int wrong = 0;
  ++total.Scenes;
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      const ParityPixel expected = EvaluatePixel(scene, x, y, Size);
      if (!expected.Comparable)
      {
        continue;
      }
      const float* drawn = picture + 4 * (y * Size + x);
      ASSERT_NEAR(drawn[3], expected.Alpha, 1e-6) << scene.Name << " " << x << " " << y;
      if (expected.Hit)
      {
        ++total.Pixels;
        ComparePixel(scene, x, y, expected, drawn, total, wrong);
      }
    }
  }
}

void Conclude(const Difference& total)
{
  std::printf("%-32s %-8s %4d scenes %8ld pixels, worst %.2e, brightest %.3g, "
              "ill-conditioned values %ld (at %.2f of what is allowed)\n",
    total.Feature.c_str(), total.Shading.c_str(), total.Scenes, total.Pixels, total.Worst,
    total.Brightest, total.IllConditioned, total.WorstConditioned);
  EXPECT_GT(total.Pixels, 100 * total.Scenes);
  EXPECT_LE(total.IllConditioned, 0.01 * 3 * total.Pixels); // three values a pixel
  Table().push_back(total);
}

class EachFeature : public ::testing::TestWithParam<std::size_t>
{
};

} // namespace

TEST_P(EachFeature, Alone)
{
  const ParityFeature& feature = ParityFeatures()[GetParam()];
  for (int shading = 0; shading < 3; ++shading)
  {
    Difference total;
    total.Feature = feature.Name;
    total.Shading = Shadings[shading];
    for (std::uint32_t i = 0; i < 8; ++i)
    {
      const auto seed = static_cast<std::uint32_t>(1000 * (GetParam() + 1)) + i;
      CompareScene(MakeFeatureScene(feature, seed, shading), total);
    }
    Conclude(total);
  }
}

INSTANTIATE_TEST_SUITE_P(
  Parity, EachFeature, ::testing::Range<std::size_t>(0, ParityFeatures().size()));

TEST(Parity, RandomCombinations)
{
  for (int shading = 0; shading < 3; ++shading)
  {
    Difference total;
    total.Feature = "random combinations";
    total.Shading = Shadings[shading];
    for (std::uint32_t seed = 1; seed <= 300; ++seed)
    {
      CompareScene(MakeRandomScene(seed, shading), total);
    }
    Conclude(total);
  }
}

TEST(Parity, NormalsAndDepth)
{
  ParityStage& stage = TheStage();
  for (std::uint32_t seed = 1; seed <= 60; ++seed)
  {
    ParityScene scene = MakeRandomScene(500 + seed, seed % 2 ? 2 : 0);
    if (scene.Colors != ParityColors::Property || scene.Alpha < 1.0)
    {
      continue;
    }
    stage.Set(scene);
    stage.GetMapper()->SetFieldModeToNormals();
    const float* picture = stage.Draw();
    const float* depth = stage.GetDepth();
    int compared = 0;
    for (int i = 0; i < Size * Size; ++i)
    {
      const ParityPixel expected = EvaluatePixel(scene, i % Size, i / Size, Size);
      if (!expected.Comparable)
      {
        continue;
      }
      if (!expected.Hit)
      {
        EXPECT_EQ(depth[i], 1e10f);
        continue;
      }
      ++compared;
      for (int c = 0; c < 3; ++c)
      {
        // Normals are interpolated in single precision: 3e-6 with Mesa 22, 6.4e-6 with Mesa 25.
        EXPECT_NEAR(picture[4 * i + c], expected.Normal[c], 1e-5) << scene.Name;
      }
      EXPECT_NEAR(depth[i], expected.Depth, 2e-5 * expected.Depth) << scene.Name;
    }
    EXPECT_GT(compared, 100);
  }
}

namespace
{

/// The scene with each triangle cut into n x n.
ParityScene Subdivided(const ParityScene& scene, int n)
{
  ParityScene fine = scene;
  fine.Points.clear();
  fine.Normals.clear();
  for (std::size_t t = 0; t < scene.Triangles(); ++t)
  {
    const auto add = [&](int i, int j) {
      const double u = static_cast<double>(i) / n;
      const double v = static_cast<double>(j) / n;
      const Vec3* p = &scene.Points[3 * t];
      const Vec3* m = &scene.Normals[3 * t];
      fine.Points.push_back((1 - u - v) * p[0] + u * p[1] + v * p[2]);
      fine.Normals.push_back(Normalized((1 - u - v) * m[0] + u * m[1] + v * m[2]));
    };
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; i + j < n; ++j)
      {
        add(i, j);
        add(i + 1, j);
        add(i, j + 1);
        if (i + j + 1 < n)
        {
          add(i + 1, j);
          add(i + 1, j + 1);
          add(i, j + 1);
        }
      }
    }
  }
  return fine;
}

} // namespace

/// Auto may differ from Phong by its tolerance and no more, in any scene, at every pixel.
TEST(Parity, AutoIsPhongWithinItsTolerance)
{
  ParityStage& stage = TheStage();
  int mixed = 0;
  int gouraud = 0;
  double most = 0.0; // of what the tolerance allows
  const auto& features = ParityFeatures();
  const auto many = std::find_if(features.begin(), features.end(),
    [](const ParityFeature& feature) { return feature.Name == "1 to 300 lights"; });
  ASSERT_NE(many, features.end());
  for (std::uint32_t seed = 1; seed <= 80; ++seed)
  {
    // A random scene, or many dim lights (Gouraud pays where there are several).
    ParityScene scene = seed % 4 ? Subdivided(MakeFeatureScene(*many, 3000 + seed, 3), 7)
                                 : MakeRandomScene(3000 + seed, 3);
    if (seed % 2)
    {
      scene.Front.Specular = scene.Back.Specular = { 0.5, 0.25, 0.125 };
      scene.Model.TwoSided = seed % 8 < 4;
    }
    stage.Set(scene);
    const double tolerance = std::pow(10.0, -2.0 + 3.0 * (seed % 10) / 9.0);
    stage.GetMapper()->SetShadingTolerance(tolerance);
    stage.GetMapper()->SetShadingTimeShare(1e9); // decides before it draws
    const float* picture = stage.Draw();
    const std::vector<float> drawn(picture, picture + 4 * Size * Size);
    const int used = stage.GetMapper()->GetShadingUsed();
    mixed += used == vtkPhongGouraudMapper::AUTO ? 1 : 0;
    gouraud += used == vtkPhongGouraudMapper::GOURAUD ? 1 : 0;
    stage.GetMapper()->SetShadingToPhong();
    const float* phong = stage.Draw();
    for (int i = 0; i < 4 * Size * Size; ++i)
    {
      const double off = std::abs(static_cast<double>(drawn[i]) - phong[i]);
      const double allowed = tolerance + Relative * std::abs(phong[i]);
      most = std::max(most, off / allowed);
      ASSERT_LE(off, allowed) << scene.Name << " pixel " << i / 4 % Size << " " << i / 4 / Size
                              << " band " << i % 4 << " used " << used;
    }
  }
  std::printf("Auto: %d scenes of both kinds, %d all Gouraud, at most %.2f of the tolerance\n", mixed,
    gouraud, most);
  EXPECT_GE(mixed, 10);
  EXPECT_GE(gouraud, 1);
  EXPECT_GE(most, 0.05); // a bound that wastes all of it decides nothing
}
