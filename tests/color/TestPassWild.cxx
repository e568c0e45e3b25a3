// SPDX-License-Identifier: BSD-3-Clause
// vtkOpenColorIOPass against vtkOpenColorIOImageFilter on every display and view of two configs:
// darkness, glare, hues that no display has, alpha; and which config $OCIO means.
#include "PassFixture.h"

#include "vtkFloatArray.h"
#include "vtkOpenColorIOImageFilter.h"
#include "vtkPointData.h"

using namespace passtest;

namespace
{

/// Eight decades, hues outside Rec.709 and so negative values, black, and where asked for all kinds of
/// alpha over premultiplied colours.
std::vector<float> WildColours(bool alpha)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<float> decade(-5.0f, 2.5f);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<float> field;
  for (int i = 0; i < size * size; ++i)
  {
    const float luminance = i % 97 == 0 ? 0.0f : std::pow(10.0f, decade(random));
    const float coverage = !alpha || i % 4 == 0 ? 1.0f : i % 41 == 1 ? 0.0f : unit(random);
    for (int c = 0; c < 3; ++c)
    {
      const float sign = i % 5 == 0 && c == i % 3 ? -0.2f : 1.0f;
      field.push_back(coverage * sign * luminance * (i % 3 == 0 ? 1.0f : unit(random)));
    }
    field.push_back(coverage);
  }
  return field;
}

/// The light that a display makes of a signal, relative to its white: the curves whose slope at black
/// has no bound turn a rounding there into any error of the signal.
double Light(const std::string& display, double signal)
{
  const auto named = [&](const char* word) { return display.find(word) != std::string::npos; };
  const double s = std::abs(signal);
  double light = s;
  if (named("ST2084") || named("PQ"))
  {
    // SMPTE ST 2084, 10000 cd/m^2 at 1; 100 cd/m^2 count as 1.
    const double p = std::pow(s, 1 / 78.84375);
    light = 100.0 *
      std::pow(std::max(p - 0.8359375, 0.0) / (18.8515625 - 18.6875 * p), 1 / 0.1593017578125);
  }
  else if (named("1886") || named("P3-D65"))
  {
    light = std::pow(s, named("1886") ? 2.4 : 2.6);
  }
  return std::copysign(light, signal);
}

/// What vtkOpenColorIOImageFilter makes of the field.
std::vector<float> OnTheCpu(vtkOpenColorIOPass* pass, const std::vector<float>& field)
{
  vtkNew<vtkFloatArray> array;
  array->SetName("RGBA");
  array->SetNumberOfComponents(4);
  array->SetNumberOfTuples(size * size);
  std::copy(field.begin(), field.end(), array->GetPointer(0));
  vtkNew<vtkImageData> image;
  image->SetDimensions(size, size, 1);
  image->GetPointData()->SetScalars(array);
  vtkNew<vtkOpenColorIOImageFilter> filter;
  filter->SetInputData(image);
  filter->SetConfigFileName(pass->GetConfigFileName());
  filter->SetDisplay(pass->GetDisplay());
  filter->SetView(pass->GetView());
  filter->SetLook(pass->GetLook());
  filter->SetExposure(pass->GetExposure());
  filter->Update();
  auto* result = vtkFloatArray::SafeDownCast(filter->GetOutput()->GetPointData()->GetScalars());
  return { result->GetPointer(0), result->GetPointer(0) + field.size() };
}

/// How much of its tolerance the worst value of the GPU takes: 5e-6 of light, relative above 1, and what
/// the CPU's result moves when the input moves by two millionths of its largest channel (the matrices
/// subtract nearly equal numbers for hues outside the display's gamut).
double Share(
  vtkOpenColorIOPass* pass, const std::vector<float>& field, const std::vector<float>& shown)
{
  const bool raw = std::string(pass->GetView()) == "Raw";
  const std::string display = raw ? "" : pass->GetDisplay(); // numbers, and not a signal
  const auto expected = OnTheCpu(pass, field);
  const auto light = [&](const std::vector<float>& values, std::size_t i) {
    const float alpha = values[i / 4 * 4 + 3];
    return i % 4 == 3 || !(alpha > 0.0f) ? values[i] : alpha * Light(display, values[i] / alpha);
  };
  std::vector<double> allowed(field.size(), 5e-6);
  for (int channel = 0; channel < 3; ++channel)
  {
    for (float sign : { -2e-6f, 2e-6f })
    {
      auto moved = field;
      for (std::size_t i = 0; i < field.size(); i += 4)
      {
        moved[i + channel] +=
          sign * std::max({ std::abs(field[i]), std::abs(field[i + 1]), std::abs(field[i + 2]) });
      }
      const auto there = OnTheCpu(pass, moved);
      for (std::size_t i = 0; i < field.size(); ++i)
      {
        allowed[i] += std::abs(light(there, i) - light(expected, i));
      }
    }
  }
  double worst = 0;
  for (std::size_t i = 0; i < field.size(); ++i)
  {
    const double reference = light(expected, i);
    const double scale = std::max(1.0, std::abs(reference));
    const double part = std::abs(light(shown, i) - reference) / (allowed[i] * scale);
    worst = std::isnan(part) ? INFINITY : std::max(worst, part);
  }
  return worst;
}

} // namespace

class WildPass
  : public Pass
  , public testing::WithParamInterface<const char*>
{
};

TEST_P(WildPass, AgreesOnEveryDisplayAndView)
{
  const std::string file = GetParam();
  if (file != "builtin" && !std::filesystem::exists(file))
  {
    GTEST_SKIP() << "no " << file;
  }
  this->Display->SetConfigFileName(file.c_str());
  const auto config = color::ColorConfig::Open(file);
  int views = 0;
  for (const std::string& display : config.Displays())
  {
    for (const std::string& view : config.Views(display))
    {
      this->Display->SetDisplay(display.c_str());
      this->Display->SetView(view.c_str());
      for (bool alpha : { false, true })
      {
        const auto field = WildColours(alpha);
        const double share = Share(this->Display, field, this->ShowField(field));
        EXPECT_LE(share, 1.0) << display << ", " << view;
        EXPECT_EQ(this->Display->GetErrorMessage(), "");
        std::cout << display << ", " << view << (alpha ? ", alpha" : "") << ": " << share
                  << " of what is allowed\n";
      }
      ++views;
    }
  }
  EXPECT_GE(views, 9);
}

INSTANTIATE_TEST_SUITE_P(Configs, WildPass,
  testing::Values(
    "builtin", RADIOMETRY_SHARED_DATA "/ocio/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio"));

TEST_F(Pass, TakesTheConfigThatOcioNames)
{
  const std::string folder = testing::TempDir();
  const std::string file = folder + "/environment.ocio";
  {
    std::ofstream lut(folder + "/halve.spi1d");
    lut << "Version 1\nFrom 0.0 1.0\nLength 3\nComponents 1\n{\n0.0\n0.1\n0.5\n}\n";
    std::ofstream(file) << "ocio_profile_version: 2\n"
                           "search_path: .\n"
                           "roles: {scene_linear: lin, default: lin}\n"
                           "displays: {screen: [!<View> {name: Half, colorspace: half}]}\n"
                           "colorspaces:\n"
                           "  - !<ColorSpace> {name: lin}\n"
                           "  - !<ColorSpace> {name: half, from_scene_reference: "
                           "!<FileTransform> {src: halve.spi1d, interpolation: linear}}\n";
  }
  const std::vector<float> field(4 * size * size, 1.0f);
  Errors errors(this->Display);
  setenv("OCIO", file.c_str(), 1);
  this->Display->SetDisplay("screen");
  EXPECT_NEAR(this->ShowField(field)[0], 0.5f, 1e-6);
  EXPECT_NEAR(OnTheCpu(this->Display, field)[0], 0.5f, 1e-6);
  EXPECT_EQ(errors.Count, 0);
  // A table that is gone: told, and the linear picture as it is.
  std::filesystem::remove(folder + "/halve.spi1d");
  setenv("OCIO", "/nowhere/else.ocio", 1);
  this->Display->SetView("Half"); // a change of names, so that the config is looked at again
  EXPECT_EQ(this->ShowField(field)[0], 1.0f);
  EXPECT_NE(this->Display->GetErrorMessage().find("OCIO"), std::string::npos);
  EXPECT_EQ(errors.Count, 1);
  unsetenv("OCIO");
}
