// SPDX-License-Identifier: BSD-3-Clause
// The CPU transform against published numbers and closed forms.
#include "color/ColorTransform.h"
#include "color/Primaries.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

using namespace radiometry::color;

namespace
{

using Colour = std::array<float, 3>;

const ColorConfig& Own()
{
  static const ColorConfig config = ColorConfig::Open("builtin");
  return config;
}

Colour Convert(const ColorConfig& config, const TransformOptions& options, Colour colour)
{
  ColorTransform(config, options).Apply(colour.data(), 1, 3);
  return colour;
}

Colour Convert(const char* from, const char* to, Colour colour, const ColorConfig& config = Own())
{
  TransformOptions options;
  options.SourceColorSpace = from;
  options.TargetColorSpace = to;
  return Convert(config, options, colour);
}

Colour Show(const char* display, const char* view, Colour colour, double exposure = 0)
{
  TransformOptions options;
  options.Display = display;
  options.View = view;
  options.Exposure = exposure;
  return Convert(Own(), options, colour);
}

void ExpectNear(const Colour& a, const std::array<double, 3>& b, double tolerance)
{
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(a[i], b[i], tolerance) << "channel " << i;
  }
}

double SrgbCurve(double x)
{
  // IEC 61966-2-1; OpenColorIO joins the two parts so that slope and value are continuous.
  return x <= 0.0030399346 ? 12.923210180787857 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

const Colour probe{ 0.5f, 0.4f, 0.3f };

} // namespace

TEST(Transform, PublishedNumbersOfTheBuiltInTransforms)
{
  ExpectNear(Convert("ACES2065-1", "CIE-XYZ-D65", probe),
    { 0.472347603390, 0.440425934827, 0.326581044758 }, 2e-7);
  ExpectNear(Convert("ACEScg", "Linear Rec.709", probe),
    { 0.578830986466, 0.388029190156, 0.282302431033 }, 2e-7);
  ExpectNear(Convert("ACEScg", "ACES2065-1", probe),
    { 0.453158317919, 0.394926024520, 0.299297344519 }, 2e-7);
}

TEST(Transform, PublishedNumberOfTheAcesView)
{
  // The ACES view of each display, taken back to CIE XYZ by the display's inverse.
  for (const char* display : { "sRGB", "Rec.1886", "Display P3" })
  {
    TransformOptions view;
    view.SourceColorSpace = "ACES2065-1";
    view.Display = display;
    view.View = "ACES";
    const Colour shown = Convert(Own(), view, probe);
    ExpectNear(
      Convert(display, "CIE-XYZ-D65", shown), { 0.34128153, 0.32533440, 0.24217427 }, 1e-6);
  }
}

TEST(Transform, PlainViewIsTheDisplaysCurveAlone)
{
  for (float x : { 0.0f, 1e-4f, 0.002f, 0.01f, 0.18f, 0.5f, 1.0f, 4.0f })
  {
    const Colour rgb{ x, 0.5f * x, 0.25f * x };
    ExpectNear(Show("sRGB", "Plain", rgb),
      { SrgbCurve(rgb[0]), SrgbCurve(rgb[1]), SrgbCurve(rgb[2]) }, 2e-6 * (1 + x));
    ExpectNear(Show("Rec.1886", "Plain", rgb),
      { std::pow(rgb[0], 1 / 2.4), std::pow(rgb[1], 1 / 2.4), std::pow(rgb[2], 1 / 2.4) },
      // The curve's slope grows without bound toward black, and with it the rounding (2.4e-7 x)
      // of the matrices: two parts in 1e7 of x at 1e-4 are 2e-5 of the result's scale.
      x < 0.01f ? 2e-5 : 2e-6 * (1 + x));
  }
}

TEST(Transform, DisplayP3IsItsPrimariesAndTheSrgbCurve)
{
  const Matrix3 m = RgbToRgb(Primaries::Rec709(), Primaries::DisplayP3());
  const Colour rgb{ 0.9f, 0.3f, 0.05f };
  std::array<double, 3> expected;
  for (int i = 0; i < 3; ++i)
  {
    expected[i] = SrgbCurve(m[3 * i] * rgb[0] + m[3 * i + 1] * rgb[1] + m[3 * i + 2] * rgb[2]);
  }
  ExpectNear(Show("Display P3", "Plain", rgb), expected, 2e-6);
}

TEST(Transform, TheSrgbCurveIsThatOfTheStandard)
{
  // IEC 61966-2-1: 12.92 x up to 0.0031308. OpenColorIO's two parts meet a little earlier, with equal
  // slopes; the curves are at most 1.1e-5 apart, a 350th of an 8-bit step.
  double worst = 0;
  for (int i = 0; i <= 1000; ++i)
  {
    const float x = 1e-5f * static_cast<float>(i);
    const double standard = x <= 0.0031308f ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    worst = std::max(worst, std::abs(Show("sRGB", "Plain", { x, x, x })[1] - standard));
  }
  EXPECT_LT(worst, 1.3e-5);
}

TEST(Transform, EverySourceOnEveryDisplayIsMatrixAndCurve)
{
  const struct
  {
    const char* Name;
    Primaries Own;
    bool Encoded;
  } sources[] = { { "Linear Rec.709", Primaries::Rec709(), false },
    { "ACEScg", Primaries::ACES_AP1(), false }, { "ACES2065-1", Primaries::ACES_AP0(), false },
    { "sRGB Texture", Primaries::Rec709(), true } };
  const struct
  {
    const char* Name;
    Primaries Own;
    bool Power;
  } displays[] = { { "sRGB", Primaries::Rec709(), false },
    { "Rec.1886", Primaries::Rec709(), true }, { "Display P3", Primaries::DisplayP3(), false } };
  const auto linear = [](double v) {
    return v <= 0.0392857 ? v / 12.923210180787857 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  for (const auto& source : sources)
  {
    for (const auto& display : displays)
    {
      const Matrix3 m = RgbToRgb(source.Own, display.Own);
      // 5.0 is more than any display shows; it is not clipped.
      for (const Colour& rgb : { Colour{ 0.5f, 0.4f, 0.3f }, Colour{ 5.0f, 4.0f, 4.5f } })
      {
        std::array<double, 3> expected{};
        for (int i = 0; i < 3; ++i)
        {
          for (int k = 0; k < 3; ++k)
          {
            expected[i] += m[3 * i + k] * (source.Encoded ? linear(rgb[k]) : double(rgb[k]));
          }
          expected[i] = display.Power ? std::pow(expected[i], 1 / 2.4) : SrgbCurve(expected[i]);
        }
        TransformOptions options;
        options.SourceColorSpace = source.Name;
        options.Display = display.Name;
        options.View = "Plain";
        ExpectNear(Convert(Own(), options, rgb), expected, 4e-6 * std::max(1.0, expected[0]));
      }
    }
  }
}

TEST(Transform, NegativeLightIsMirroredOrCut)
{
  // OpenColorIO continues the curve of sRGB linearly below 0, and cuts a power law off.
  ExpectNear(Show("sRGB", "Plain", { -0.5f, 0.5f, 0.5f }),
    { -0.5 * 12.923210180787857, SrgbCurve(0.5), SrgbCurve(0.5) }, 2e-5);
  EXPECT_EQ(Show("Rec.1886", "Plain", { -0.5f, -0.5f, -0.5f })[0], 0.0f);
}

TEST(Transform, OwnMatricesAgreeWithOpenColorIOs)
{
  const Matrix3 m = RgbToRgb(Primaries::ACES_AP1(), Primaries::Rec709());
  std::array<double, 3> expected;
  for (int i = 0; i < 3; ++i)
  {
    expected[i] = m[3 * i] * 0.5f + m[3 * i + 1] * 0.4f + m[3 * i + 2] * 0.3f;
  }
  ExpectNear(Convert("ACEScg", "Linear Rec.709", probe), expected, 2e-7);
}

TEST(Transform, WhiteStaysWhiteInEveryPlainView)
{
  for (const std::string& display : Own().Displays())
  {
    ExpectNear(Show(display.c_str(), "Plain", { 1, 1, 1 }), { 1, 1, 1 }, 2e-6);
  }
}

TEST(Transform, ExposureIsAPowerOfTwoAndDynamic)
{
  TransformOptions options;
  options.TargetColorSpace = "Linear Rec.709";
  ColorTransform transform(Own(), options);
  for (double stops : { 0.0, 1.0, -3.0, 0.5 })
  {
    transform.SetExposure(stops);
    Colour c{ 0.5f, -0.4f, 30.0f };
    transform.Apply(c.data(), 1, 3);
    const double gain = std::exp2(stops);
    ExpectNear(c, { 0.5f * gain, -0.4f * gain, 30.0f * gain }, 4e-6 * 30 * gain);
  }
  EXPECT_THROW(transform.SetExposure(std::numeric_limits<double>::infinity()), ColorError);
  // In an encoded space too it multiplies light, not code values.
  options.SourceColorSpace = "sRGB Texture";
  options.Exposure = 1;
  ExpectNear(Convert(Own(), options, { 0.5f, 0.5f, 0.5f }),
    { 2 * 0.21404114, 2 * 0.21404114, 2 * 0.21404114 }, 1e-6);
}

TEST(Transform, TwoTransformsKeepTheirOwnExposure)
{
  TransformOptions options;
  options.TargetColorSpace = "ACEScg";
  ColorTransform a(Own(), options);
  ColorTransform b(Own(), options);
  a.SetExposure(3);
  Colour c = probe;
  b.Apply(c.data(), 1, 3);
  ExpectNear(c,
    { Convert("Linear Rec.709", "ACEScg", probe)[0], Convert("Linear Rec.709", "ACEScg", probe)[1],
      Convert("Linear Rec.709", "ACEScg", probe)[2] },
    0);
}

TEST(Transform, DataPassesUntouched)
{
  const Colour odd{ -5.0f, 1e30f, std::numeric_limits<float>::quiet_NaN() };
  TransformOptions view;
  view.View = "Raw";
  view.Exposure = 4;
  TransformOptions source;
  source.SourceColorSpace = "Raw";
  source.View = "ACES";
  source.Exposure = 4;
  for (const TransformOptions& options : { view, source })
  {
    ColorTransform transform(Own(), options);
    EXPECT_TRUE(transform.PassesDataThrough());
    transform.SetExposure(1);
    Colour c = odd;
    transform.Apply(c.data(), 1, 3);
    EXPECT_EQ(c[0], odd[0]);
    EXPECT_EQ(c[1], odd[1]);
    EXPECT_TRUE(std::isnan(c[2]));
  }
}

TEST(Transform, AlphaIsKeptAndThreadsDoNotMatter)
{
  const std::size_t n = 50'001;
  std::vector<float> one(4 * n);
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    one[i] = static_cast<float>(i % 977) / 300.0f - 0.5f;
  }
  const std::vector<float> before = one;
  std::vector<float> many = one;
  TransformOptions options;
  options.View = "ACES";
  options.Exposure = 0.7;
  ColorTransform transform(Own(), options);
  transform.Apply(one.data(), n, 4, 1);
  transform.Apply(many.data(), n, 4, 4);
  EXPECT_EQ(one, many);
  for (std::size_t i = 3; i < one.size(); i += 4)
  {
    ASSERT_EQ(one[i], before[i]);
  }
  EXPECT_NE(one, before);
  EXPECT_THROW(transform.Apply(one.data(), 1, 2), ColorError);
}

TEST(Transform, LooksChangeThePicture)
{
  TransformOptions options;
  options.TargetColorSpace = "Linear Rec.709";
  const Colour blue{ -0.1f, 0.05f, 2.0f };
  const Colour without = Convert(Own(), options, blue);
  options.Look = "Gamut Compression";
  const Colour with = Convert(Own(), options, blue);
  EXPECT_GT(with[0], without[0] + 0.01f);
}

TEST(Transform, ConfigOfTheAcademyGivesTheSamePictures)
{
  const std::string file = RADIOMETRY_SHARED_DATA "/ocio/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio";
  if (!std::filesystem::exists(file))
  {
    GTEST_SKIP() << "no " << file;
  }
  const ColorConfig cg = ColorConfig::Open(file);
  const struct
  {
    const char *Display, *View, *CgDisplay, *CgView;
  } pairs[] = { { "sRGB", "Plain", "sRGB - Display", "Un-tone-mapped" },
    { "sRGB", "ACES", "sRGB - Display", "ACES 1.0 - SDR Video" },
    { "Rec.1886", "ACES", "Rec.1886 Rec.709 - Display", "ACES 1.0 - SDR Video" } };
  for (const auto& pair : pairs)
  {
    TransformOptions options;
    options.Display = pair.CgDisplay;
    options.View = pair.CgView;
    const Colour theirs = Convert(cg, options, probe);
    ExpectNear(Show(pair.Display, pair.View, probe), { theirs[0], theirs[1], theirs[2] }, 2e-6);
  }
  TransformOptions unnamed;
  EXPECT_EQ(ColorTransform(cg, unnamed).SourceColorSpace(), "Linear Rec.709 (sRGB)");
}

TEST(Transform, Rec709IsBroughtToAConfigThatLacksIt)
{
  const ColorConfig bridged =
    ColorConfig::FromText("ocio_profile_version: 2\n"
                          "roles: {scene_linear: work, default: work, aces_interchange: work}\n"
                          "displays: {screen: [!<View> {name: Plain, colorspace: work}]}\n"
                          "colorspaces:\n  - !<ColorSpace> {name: work}\n");
  TransformOptions options;
  const Colour expected = Convert("Linear Rec.709", "ACES2065-1", probe);
  ExpectNear(Convert(bridged, options, probe), { expected[0], expected[1], expected[2] }, 2e-7);

  const ColorConfig alone =
    ColorConfig::FromText("ocio_profile_version: 2\n"
                          "roles: {scene_linear: work, default: work}\n"
                          "displays: {screen: [!<View> {name: Plain, colorspace: work}]}\n"
                          "colorspaces:\n  - !<ColorSpace> {name: work}\n");
  EXPECT_EQ(ColorTransform(alone, options).SourceColorSpace(), "work");
  options.SourceColorSpace = "Linear Rec.709";
  EXPECT_THROW(ColorTransform(alone, options), ColorError);
}

TEST(Transform, ShaderNamesItsFunctionAndItsExposure)
{
  for (const std::string& display : Own().Displays())
  {
    for (const std::string& view : Own().Views(display))
    {
      TransformOptions options;
      options.Display = display;
      options.View = view;
      options.Exposure = -1.5;
      const ColorTransform transform(Own(), options);
      const GpuShader shader = transform.Shader("show", "ocio_");
      EXPECT_NE(shader.Text.find("vec4 show("), std::string::npos) << shader.Text;
      const bool raw = view == "Raw";
      ASSERT_EQ(shader.Uniforms.size(), raw ? 0u : 1u) << display << " " << view;
      if (!raw)
      {
        EXPECT_NE(shader.Text.find(shader.Uniforms[0].Name), std::string::npos);
        EXPECT_EQ(shader.Uniforms[0].Value, -1.5);
      }
      EXPECT_EQ(transform.PassesDataThrough(), raw);
    }
  }
}
