// SPDX-License-Identifier: BSD-3-Clause
// vtkOpenColorIOPass: the same numbers as the CPU, for the colours of pictures.
#include "PassFixture.h"

using namespace passtest;

namespace
{

/// Colours neutral and saturated over four decades, as in a picture; opaque.
std::vector<float> ManyColours()
{
  std::mt19937 random(7);
  std::uniform_real_distribution<float> decade(-2.7f, 1.3f);
  std::uniform_real_distribution<float> unit(0.02f, 1.0f);
  std::vector<float> field;
  for (int i = 0; i < size * size; ++i)
  {
    const float luminance = std::pow(10.0f, decade(random));
    for (int c = 0; c < 3; ++c)
    {
      field.push_back(luminance * (i % 3 == 0 ? 1.0f : unit(random)));
    }
    field.push_back(1.0f);
  }
  return field;
}

/// How much of its tolerance the worst colour takes on a display whose curve is a power law: 1e-4;
/// in the blackest 0.001 of the signal, where the slope has no bound, 1e-8 of the light instead.
double WorstOfPowerLaw(const std::vector<float>& a, const std::vector<float>& b)
{
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const double most = std::max(std::abs(a[i]), std::abs(b[i]));
    const double d = most > 1e-3
      ? std::abs(double(a[i]) - b[i]) / std::max(1.0, most) / 1e-4
      : std::abs(std::pow(std::abs(a[i]), 2.4) - std::pow(std::abs(b[i]), 2.4)) / 1e-8;
    worst = std::isnan(d) ? INFINITY : std::max(worst, d);
  }
  return worst;
}

/// The greatest |a - b| / max(1, |b|) over the colours.
double Worst(const std::vector<float>& a, const std::vector<float>& b)
{
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const double d = std::abs(double(a[i]) - b[i]) / std::max(1.0, std::abs(double(b[i])));
    worst = std::isnan(d) ? INFINITY : std::max(worst, d);
  }
  return worst;
}

} // namespace

TEST_F(Pass, AgreesWithTheCpuOnEveryDisplayAndViewOfOurConfig)
{
  const auto config = color::ColorConfig::Open("builtin");
  const auto field = ManyColours();
  this->Display->SetConfigFileName("builtin");
  for (const std::string& display : config.Displays())
  {
    for (const std::string& view : config.Views(display))
    {
      for (const char* look : { "", "Gamut Compression" })
      {
        this->Display->SetDisplay(display.c_str());
        this->Display->SetView(view.c_str());
        this->Display->SetLook(look);
        this->Display->SetExposure(0.75);
        const color::TransformOptions options{ "", "", display, view, look, 0.75 };
        auto expected = field;
        color::ColorTransform(config, options).Apply(expected.data(), size * size, 4);
        const double worst = Worst(this->ShowField(field), expected);
        // A power law without a linear foot has an infinite slope at black.
        const double share =
          display == "Rec.1886" ? WorstOfPowerLaw(this->Read->Pixels, expected) : worst / 5e-6;
        EXPECT_LE(share, 1.0) << display << ", " << view << ", " << look << ": " << worst;
        std::cout << display << ", " << view << (*look ? ", with look" : "") << ": " << worst
                  << "\n";
        EXPECT_EQ(this->Display->GetErrorMessage(), "");
      }
    }
  }
}

TEST_F(Pass, AgreesWithTheCpuOnTheAcademysConfig)
{
  const std::string file = RADIOMETRY_SHARED_DATA "/ocio/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio";
  if (!std::filesystem::exists(file))
  {
    GTEST_SKIP() << "no " << file;
  }
  const auto config = color::ColorConfig::Open(file);
  const auto field = ManyColours();
  this->Display->SetConfigFileName(file.c_str());
  for (const std::string& display : config.Displays())
  {
    for (const std::string& view : config.Views(display))
    {
      this->Display->SetDisplay(display.c_str());
      this->Display->SetView(view.c_str());
      const color::TransformOptions options{ "", "", display, view, "", 0 };
      auto expected = field;
      color::ColorTransform(config, options).Apply(expected.data(), size * size, 4);
      const double worst = Worst(this->ShowField(field), expected);
      const bool power = display == "Rec.1886 Rec.709 - Display" || display == "P3-D65 - Display";
      const double share = power ? WorstOfPowerLaw(this->Read->Pixels, expected) : worst / 5e-6;
      EXPECT_LE(share, 1.0) << display << ", " << view << ": " << worst;
      std::cout << display << ", " << view << ": " << worst << "\n";
    }
  }
}

TEST_F(Pass, AgreesWithTheCpuOnConfigsWithLuts)
{
  const std::string folder = testing::TempDir();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> wobble(-0.05, 0.05);
  {
    std::ofstream cube(folder + "/wobble.cube");
    cube << "LUT_3D_SIZE 9\n";
    for (int b = 0; b < 9; ++b)
    {
      for (int g = 0; g < 9; ++g)
      {
        for (int r = 0; r < 9; ++r)
        {
          cube << r / 8.0 + wobble(random) << " " << g / 8.0 + wobble(random) << " "
               << b / 8.0 + wobble(random) << "\n";
        }
      }
    }
    std::ofstream curve(folder + "/curve.spi1d");
    curve << "Version 1\nFrom 0.0 8.0\nLength 9000\nComponents 1\n{\n";
    for (int i = 0; i < 9000; ++i)
    {
      curve << std::sqrt(i / 8999.0) << "\n";
    }
    curve << "}\n";
    std::ofstream config(folder + "/luts.ocio");
    config << "ocio_profile_version: 2\nsearch_path: .\nroles: {scene_linear: lin, default: lin}\n"
              "displays:\n  screen:\n"
              "    - !<View> {name: trilinear, colorspace: trilinear}\n"
              "    - !<View> {name: tetrahedral, colorspace: tetrahedral}\n"
              "    - !<View> {name: inverse, colorspace: inverse}\n"
              "colorspaces:\n  - !<ColorSpace> {name: lin}\n";
    for (const char* kind : { "trilinear", "tetrahedral" })
    {
      config << "  - !<ColorSpace>\n    name: " << kind
             << "\n    from_scene_reference: !<GroupTransform>\n      children:\n"
             << "        - !<FileTransform> {src: curve.spi1d, interpolation: linear}\n"
             << "        - !<FileTransform> {src: wobble.cube, interpolation: "
             << (kind[1] == 'r' ? "linear" : "tetrahedral") << "}\n";
    }
    config << "  - !<ColorSpace>\n    name: inverse\n    from_scene_reference: !<FileTransform> "
              "{src: curve.spi1d, interpolation: linear, direction: inverse}\n";
  }
  const std::string file = folder + "/luts.ocio";
  const auto config = color::ColorConfig::Open(file);
  auto field = ManyColours();
  this->Display->SetConfigFileName(file.c_str());
  this->Display->SetSourceColorSpace("lin");
  for (const std::string view : { "trilinear", "tetrahedral", "inverse" })
  {
    const color::TransformOptions options{ "lin", "", "screen", view, "", 0 };
    const color::ColorTransform transform(config, options);
    EXPECT_EQ(transform.Shader("f", "p_").Textures.size(), view == "inverse" ? 1u : 2u);
    auto expected = field;
    transform.Apply(expected.data(), size * size, 4);
    this->Display->SetView(view.c_str());
    const double worst = Worst(this->ShowField(field), expected);
    std::cout << view << ": " << worst << "\n";
    EXPECT_LE(worst, 5e-6) << view;
    EXPECT_EQ(this->Display->GetErrorMessage(), "");
  }
}

TEST_F(Pass, ExposureFollowsWithoutANewShader)
{
  const auto config = color::ColorConfig::Open("builtin");
  const auto field = ManyColours();
  this->ShowField(field);
  const std::string source = this->Display->GetFragmentShaderSource();
  EXPECT_NE(source.find("exposure"), std::string::npos);
  for (double stops : { -2.0, 3.5 })
  {
    this->Display->SetExposure(stops);
    auto expected = field;
    color::TransformOptions options;
    options.Exposure = stops;
    color::ColorTransform(config, options).Apply(expected.data(), size * size, 4);
    EXPECT_LE(Worst(this->ShowField(field), expected), 5e-6);
    EXPECT_EQ(this->Display->GetFragmentShaderSource(), source);
  }
}

TEST_F(Pass, AlphaIsUnpremultipliedAndNothingIsUntouched)
{
  std::vector<float> field(4 * size * size, 0.0f);
  for (int i = 0; i < size * size; ++i)
  {
    const float alpha = static_cast<float>(i % 5) / 4.0f;
    for (int c = 0; c < 3; ++c)
    {
      field[4 * i + c] = 0.5f * alpha;
    }
    field[4 * i + 3] = alpha;
  }
  const auto shown = this->ShowField(field);
  const float encoded = 1.055f * std::pow(0.5f, 1 / 2.4f) - 0.055f;
  for (int i = 0; i < size * size; ++i)
  {
    const float alpha = static_cast<float>(i % 5) / 4.0f;
    ASSERT_NEAR(shown[4 * i], encoded * alpha, 2e-6);
    ASSERT_NEAR(shown[4 * i + 3], alpha, 1e-6);
  }
}
