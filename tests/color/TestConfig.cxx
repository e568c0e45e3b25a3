// SPDX-License-Identifier: BSD-3-Clause
// The project's own config, $OCIO, and configs that are missing or broken.
#include "color/ColorConfig.h"
#include "color/ColorTransform.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>

using namespace radiometry::color;
namespace fs = std::filesystem;

namespace
{

struct Environment
{
  explicit Environment(const char* value) { value ? setenv("OCIO", value, 1) : unsetenv("OCIO"); }
  ~Environment() { unsetenv("OCIO"); }
};

fs::path Write(const std::string& name, const std::string& text)
{
  const fs::path path = fs::path(testing::TempDir()) / name;
  std::ofstream(path) << text;
  return path;
}

std::string MessageOf(const std::function<void()>& body)
{
  try
  {
    body();
  }
  catch (const ColorError& e)
  {
    return e.what();
  }
  return "";
}

bool Has(const std::vector<std::string>& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

const char* const small = "ocio_profile_version: 2\n"
                          "roles: {scene_linear: lin, default: lin}\n"
                          "displays: {screen: [!<View> {name: Plain, colorspace: lin}]}\n"
                          "colorspaces:\n"
                          "  - !<ColorSpace> {name: lin}\n";

} // namespace

TEST(Config, TheProjectsOwnValidatesAndHasWhatIsPromised)
{
  const ColorConfig config = ColorConfig::Open(ColorConfig::BuiltInName);
  EXPECT_NO_THROW(config.Validate());
  EXPECT_EQ(config.Origin(), "builtin");
  EXPECT_EQ(config.Displays(), (std::vector<std::string>{ "sRGB", "Rec.1886", "Display P3" }));
  for (const std::string& display : config.Displays())
  {
    EXPECT_EQ(config.Views(display), (std::vector<std::string>{ "Plain", "ACES", "Raw" }));
    EXPECT_EQ(config.DefaultView(display), "Plain");
  }
  for (const char* space : { "Linear Rec.709", "ACEScg", "ACES2065-1", "sRGB Texture", "Raw" })
  {
    EXPECT_TRUE(Has(config.ColorSpaces(), space)) << space;
  }
  EXPECT_EQ(config.LinearRec709(), "Linear Rec.709");
  EXPECT_TRUE(config.HasColorSpace("lin_srgb"));
  EXPECT_FALSE(config.HasColorSpace("no such space"));
}

TEST(Config, ItsFileIsItsText)
{
  std::ifstream file(RADIOMETRY_SOURCE_DIR "/color/radiometry.ocio");
  const std::string text{ std::istreambuf_iterator<char>(file), {} };
  EXPECT_EQ(text, BuiltInConfigText());
}

TEST(Config, OcioVariableIsHonoured)
{
  const fs::path path = Write("variable.ocio", small);
  {
    Environment set(path.c_str());
    EXPECT_EQ(ColorConfig::Open().Displays(), std::vector<std::string>{ "screen" });
    EXPECT_EQ(ColorConfig::Open("builtin").Origin(), "builtin");
  }
  Environment none(nullptr);
  EXPECT_EQ(ColorConfig::Open().Origin(), "builtin");
  Environment empty("");
  EXPECT_EQ(ColorConfig::Open().Origin(), "builtin");
}

TEST(Config, MissingFileIsNamed)
{
  const auto text = MessageOf([] { ColorConfig::Open("/nowhere/config.ocio"); });
  EXPECT_NE(text.find("/nowhere/config.ocio"), std::string::npos) << text;
  Environment set("/nowhere/else.ocio");
  const auto variable = MessageOf([] { ColorConfig::Open(); });
  EXPECT_NE(variable.find("/nowhere/else.ocio"), std::string::npos) << variable;
  EXPECT_NE(variable.find("variable OCIO"), std::string::npos) << variable;
  EXPECT_NE(MessageOf([] { ColorConfig::Open("/tmp"); }).find("folder"), std::string::npos);
}

TEST(Config, BrokenFilesAreRefused)
{
  for (const std::string& text : { std::string("not a config at all"), std::string(),
         std::string("ocio_profile_version: 99\n"), std::string("\0\1\2\3", 4),
         BuiltInConfigText().substr(0, BuiltInConfigText().size() / 2) + "\n  - !<Broken" })
  {
    const fs::path path = Write("broken.ocio", text);
    const auto message = MessageOf([&] { ColorConfig::Open(path.string()); });
    EXPECT_NE(message.find("broken.ocio"), std::string::npos) << text.substr(0, 40);
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(Config, InconsistentConfigFailsValidation)
{
  std::string text = small;
  text.replace(text.find("colorspace: lin"), 15, "colorspace: gone");
  const ColorConfig config = ColorConfig::FromText(text);
  EXPECT_THROW(config.Validate(), ColorError);
  EXPECT_THROW(ColorTransform(config, {}), ColorError);
}

TEST(Config, UnknownNamesSayWhatThereIs)
{
  const ColorConfig config = ColorConfig::Open("builtin");
  const auto message = [&](const TransformOptions& options) {
    return MessageOf([&] { ColorTransform transform(config, options); });
  };
  TransformOptions options;
  options.SourceColorSpace = "Klingon";
  EXPECT_NE(message(options).find("ACEScg"), std::string::npos) << message(options);
  options = {};
  options.Display = "Kinescope";
  EXPECT_NE(message(options).find("Rec.1886"), std::string::npos) << message(options);
  options = {};
  options.View = "Pretty";
  EXPECT_NE(message(options).find("ACES"), std::string::npos) << message(options);
  options = {};
  options.Look = "Noir";
  EXPECT_NE(message(options).find("Gamut Compression"), std::string::npos) << message(options);
  options = {};
  options.TargetColorSpace = "Klingon";
  EXPECT_NE(message(options).find("Klingon"), std::string::npos) << message(options);
}

TEST(Config, MissingLutIsAnError)
{
  std::string text = small;
  text.replace(text.find("{name: lin}"), 11,
    "{name: lin, to_scene_reference: !<FileTransform> {src: no_such_file.spi1d}}\n"
    "  - !<ColorSpace> {name: other}");
  const ColorConfig config = ColorConfig::FromText(text);
  TransformOptions options;
  options.SourceColorSpace = "lin";
  options.TargetColorSpace = "other";
  const auto message = MessageOf([&] { ColorTransform transform(config, options); });
  EXPECT_NE(message.find("no_such_file.spi1d"), std::string::npos) << message;
}
