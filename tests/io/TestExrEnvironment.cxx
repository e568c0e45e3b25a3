// SPDX-License-Identifier: BSD-3-Clause
// Colours by chromaticities, and cube maps as lat-long pictures.
#include "io/ExrColor.h"
#include "io/ExrEnvironment.h"
#include "io/ExrReader.h"
#include "io/ExrWriter.h"

#include <cmath>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

using namespace radiometry::io;
namespace fs = std::filesystem;

namespace
{

constexpr double Pi = 3.14159265358979323846;
const fs::path folder = RADIOMETRY_SHARED_DATA "/exr";

struct Direction
{
  double x, y, z;
};
using Light = std::function<float(const Direction&)>;

/// A cube map of a function, by the drawing in ImfEnvmap.h: faces +X, -X, +Y, -Y, +Z, -Z from the
/// top, their edges at the outermost pixels' middles.
ExrPart Cube(int n, const Light& light)
{
  auto values = std::make_shared<std::vector<float>>();
  for (int face = 0; face < 6; ++face)
  {
    for (int j = 0; j < n; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        const double u = n > 1 ? 2.0 * i / (n - 1.0) - 1.0 : 0.0;
        const double v = n > 1 ? 2.0 * j / (n - 1.0) - 1.0 : 0.0;
        const Direction directions[6] = { { 1, -v, u }, { -1, -v, -u }, { u, 1, -v }, { u, -1, v },
          { -u, -v, 1 }, { u, -v, -1 } };
        values->push_back(light(directions[face]));
      }
    }
  }
  ExrPart part;
  part.DataWindow = ExrBox::OfSize(n, 6 * n);
  part.Channels = { ExrChannel::View("Y", values->data(), n) };
  part.Channels[0].Owner = values;
  part.Attributes["envmap"] = std::string("cube");
  return part;
}

Direction AtLatLong(const ExrPart& part, int x, int y)
{
  const double latitude = Pi * (0.5 - (y + 0.5) / part.DataWindow.Height());
  const double longitude = Pi * (1.0 - 2.0 * (x + 0.5) / part.DataWindow.Width());
  return { std::sin(longitude) * std::cos(latitude), std::sin(latitude),
    std::cos(longitude) * std::cos(latitude) };
}

float Smooth(const Direction& d)
{
  const double r = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  return static_cast<float>(2.0 + d.x / r + 0.5 * d.y * d.z / (r * r) + 0.3 * d.y / r);
}

ExrPart Colour(const std::vector<float>& r, const std::vector<float>& g,
  const std::vector<float>& b, const ExrChromaticities& xy)
{
  ExrPart part;
  part.DataWindow = ExrBox::OfSize(static_cast<int>(r.size()), 1);
  const int width = static_cast<int>(r.size());
  part.Channels = { ExrChannel::View("B", b.data(), width), ExrChannel::View("G", g.data(), width),
    ExrChannel::View("R", r.data(), width) };
  part.Attributes["chromaticities"] = xy;
  return part;
}

std::string MessageOf(const std::function<void()>& body)
{
  try
  {
    body();
  }
  catch (const FileError& e)
  {
    return e.what();
  }
  return "";
}

} // namespace

TEST(ExrEnvironment, ACubeShowsTheSameDirections)
{
  double last = 1.0;
  for (const int n : { 8, 16, 64 })
  {
    const ExrPart map = ToLatLong("x", Cube(n, Smooth));
    ASSERT_EQ(map.DataWindow.Width(), 4 * n);
    ASSERT_EQ(map.DataWindow.Height(), 2 * n);
    EXPECT_EQ(EnvironmentKind(map), "latlong");
    double worst = 0.0;
    double integral = 0.0;
    for (int y = 0; y < 2 * n; ++y)
    {
      const double area =
        (std::sin(Pi * (0.5 - double(y) / (2 * n))) - std::sin(Pi * (0.5 - double(y + 1) / (2 * n)))) *
        2.0 * Pi / (4 * n);
      for (int x = 0; x < 4 * n; ++x)
      {
        const double value = map.Channels[0].At(x, y);
        worst = std::max(worst, std::abs(value - Smooth(AtLatLong(map, x, y))));
        integral += value * area;
      }
    }
    EXPECT_LT(worst, 1.5 / n) << n; // the face's steps, as the function's slope is about one
    EXPECT_LT(worst, last) << n;
    EXPECT_NEAR(integral, 8.0 * Pi, 8.0 * Pi * 0.02 / n) << n; // 2 all around
    last = worst;
  }
}

TEST(ExrEnvironment, EachFaceIsOnItsSide)
{
  // A lamp on each axis in turn: the brightest pixel of the picture lies there.
  const Direction axes[6] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 },
    { 0, 0, -1 } };
  for (const Direction& axis : axes)
  {
    const ExrPart map = ToLatLong("x", Cube(16, [&](const Direction& d) {
      const double r = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
      return d.x * axis.x + d.y * axis.y + d.z * axis.z > 0.95 * r ? 1.0f : 0.0f;
    }));
    int lit = 0;
    for (int y = 0; y < 32; ++y)
    {
      for (int x = 0; x < 64; ++x)
      {
        const Direction d = AtLatLong(map, x, y);
        const double cosine = d.x * axis.x + d.y * axis.y + d.z * axis.z;
        const double value = map.Channels[0].At(x, y);
        if (cosine > 0.995)
        {
          EXPECT_EQ(value, 1.0);
          ++lit;
        }
        if (cosine < 0.85)
        {
          EXPECT_EQ(value, 0.0);
        }
      }
    }
    EXPECT_GT(lit, 0);
  }
}

TEST(ExrEnvironment, OnePixelFacesAndWhatIsNoCube)
{
  const ExrPart map = ToLatLong("x", Cube(1, [](const Direction&) { return 5.0f; }));
  EXPECT_EQ(map.Channels[0].At(0, 0), 5.0);
  EXPECT_EQ(map.Channels[0].At(3, 1), 5.0);
  ExrPart odd = Cube(4, Smooth);
  odd.DataWindow.YMax -= 1;
  EXPECT_NE(MessageOf([&] { ToLatLong("odd.exr", odd); }).find("six square faces"),
    std::string::npos);
  ExrPart plain = Cube(4, Smooth);
  plain.Attributes.clear();
  EXPECT_EQ(ToLatLong("x", plain).DataWindow.Height(), 24); // not said to be a cube: as it is
}

TEST(ExrColor, XyzToRec709ByHand)
{
  // Chromaticities of X, Y, Z themselves: R, G, B are then CIE XYZ.
  const ExrChromaticities xyz = { 1, 0, 0, 1, 0, 0, 1.0f / 3, 1.0f / 3 };
  // XYZ of linear Rec.709 red, green, blue (IEC 61966-2-1) and of D65.
  const std::vector<float> x{ 0.4124f, 0.3576f, 0.1805f, 0.9505f };
  const std::vector<float> y{ 0.2126f, 0.7152f, 0.0722f, 1.0f };
  const std::vector<float> z{ 0.0193f, 0.1192f, 0.9505f, 1.0890f };
  ExrPart part = Colour(x, y, z, xyz);
  ConvertToRec709("x", part);
  const double expected[4][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 1, 1 } };
  for (int p = 0; p < 4; ++p)
  {
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(part.Find(std::string(1, "RGB"[c]))->At(p, 0), expected[p][c], 5e-4);
    }
  }
  EXPECT_EQ(ChromaticitiesOf(part), Rec709Chromaticities());
  // Once is enough: the second time nothing changes, to the bit.
  const double before = part.Find("R")->At(0, 0);
  ConvertToRec709("x", part);
  EXPECT_EQ(part.Find("R")->At(0, 0), before);
}

TEST(ExrColor, Rec709StaysAsItIs)
{
  const std::vector<float> values{ 0.1f, -7.0f, 1e30f, std::numeric_limits<float>::infinity() };
  ExrPart part = Colour(values, values, values, Rec709Chromaticities());
  ConvertToRec709("x", part);
  EXPECT_EQ(part.Channels[0].Data, values.data());
  part.Attributes.clear();
  ConvertToRec709("x", part);
  EXPECT_EQ(part.Channels[0].Data, values.data());
}

TEST(ExrColor, ChromaticitiesThatMakeNoSpaceAreRefused)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> values{ 1.0f };
  for (const ExrChromaticities& xy :
    { ExrChromaticities{ 0.1f, 0.1f, 0.2f, 0.2f, 0.3f, 0.3f, 0.3f, 0.3f },
      ExrChromaticities{ 0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3f, 0.0f },
      ExrChromaticities{ nan, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3f, 0.3f }, ExrChromaticities{} })
  {
    ExrPart part = Colour(values, values, values, xy);
    EXPECT_NE(MessageOf([&] { ConvertToRec709("bad.exr", part); }).find("chromaticities"),
      std::string::npos);
  }
}

TEST(ExrColor, TheFourPicturesLookAlike)
{
  if (!fs::exists(folder))
  {
    GTEST_SKIP() << "no " << folder;
  }
  const auto read = [](const char* name) {
    const std::string file = (folder / "Chromaticities" / name).string();
    ExrPart part = ReadExr(file)[0];
    ConvertToRec709(file, part);
    return part;
  };
  const ExrPart reference = read("Rec709.exr");
  const struct
  {
    const char* Name;
    double Most; // of the mean: half has 11 bits; chroma at half the resolution blurs edges
  } others[] = { { "XYZ.exr", 1e-3 }, { "Rec709_YC.exr", 0.03 }, { "XYZ_YC.exr", 0.03 } };
  for (const auto& other : others)
  {
    const ExrPart part = read(other.Name);
    double difference = 0.0;
    double mean = 0.0;
    for (const char* name : { "R", "G", "B" })
    {
      for (long long y = 0; y < reference.DataWindow.Height(); ++y)
      {
        for (long long x = 0; x < reference.DataWindow.Width(); ++x)
        {
          const double value = reference.Find(name)->At(x, y);
          difference += std::abs(part.Find(name)->At(x, y) - value);
          mean += std::abs(value);
        }
      }
    }
    EXPECT_LT(difference, other.Most * mean) << other.Name;
  }
}

TEST(ExrColor, LuminanceAndChromaOfEverySamplingAndPlace)
{
  // A picture whose chroma is constant, or runs linearly: exact away from the rim, for chroma of all
  // pixels and of every second one, windows that begin left of 0 and right of it, and luminances that no half could hold.
  const double yr = 0.2126390;
  const double yb = 0.0721923;
  for (const int sampling : { 1, 2 })
  {
    for (const int first : { 0, 4, -6 })
    {
      const int n = 40;
      std::vector<float> y, ry, by;
      for (int j = 0; j < n; ++j)
      {
        for (int i = 0; i < n; ++i)
        {
          y.push_back(1e6f + 1e3f * static_cast<float>((i * 7 + j * 3) % 11));
          if (i % sampling == 0 && j % sampling == 0)
          {
            ry.push_back(0.01f * static_cast<float>(i) - 0.2f);
            by.push_back(0.2f - 0.005f * static_cast<float>(j));
          }
        }
      }
      ExrPart part;
      part.Name = "picture";
      part.DataWindow = { first, first, first + n - 1, first + n - 1 };
      part.Channels = { ExrChannel::View("Y", y.data(), n) };
      for (const auto& [name, values] : { std::make_pair("RY", &ry), std::make_pair("BY", &by) })
      {
        ExrChannel channel = ExrChannel::View(name, values->data(), n / sampling);
        channel.XSampling = channel.YSampling = sampling;
        part.Channels.push_back(channel);
      }
      ExrPart other = part;
      other.Name = "again"; // of a file of several parts, too
      const std::string file = testing::TempDir() + "/chroma.exr";
      WriteExr(file, { part, other });
      for (const ExrPart& read : ReadExr(file))
      {
        ASSERT_TRUE(read.Find("R") && read.Find("G") && read.Find("B") && !read.Find("Y"));
        for (int j = 6; j < n - 7; ++j)
        {
          for (int i = 6; i < n - 7; ++i)
          {
            const double luminance = y[j * n + i];
            const double red = (1.0 + 0.01 * i - 0.2) * luminance;
            const double blue = (1.0 + 0.2 - 0.005 * j) * luminance;
            EXPECT_NEAR(read.Find("R")->At(i, j), red, 1e-6 * luminance);
            EXPECT_NEAR(read.Find("B")->At(i, j), blue, 1e-6 * luminance);
            EXPECT_NEAR(read.Find("G")->At(i, j), (luminance - yr * red - yb * blue) / (1 - yr - yb),
              1e-5 * luminance);
          }
        }
      }
    }
  }
}

TEST(ExrParts, SharedAttributesAreFilledIn)
{
  const std::vector<float> values(64, 1.5f);
  ExrPart first = Colour(values, values, values, Rec709Chromaticities());
  first.Name = "beauty";
  first.View = "left";
  ExrPart depth;
  depth.Name = "depth";
  depth.View = "right";
  depth.DataWindow = { 2, 3, 9, 10 };
  depth.Channels = { ExrChannel::View("Z", values.data(), 8) };
  const std::string file = testing::TempDir() + "/shared-parts.exr";
  WriteExr(file, { first, depth });
  const ExrImage image = ReadExr(file);
  ASSERT_EQ(image.size(), 2u);
  EXPECT_TRUE(image[0].DisplayWindow == (ExrBox{ 0, 0, 63, 10 }));
  EXPECT_TRUE(image[1].DisplayWindow == (ExrBox{ 0, 0, 63, 10 }));
  EXPECT_TRUE(image[1].DataWindow == depth.DataWindow);
  EXPECT_EQ(image[0].View, "left");
  EXPECT_EQ(image[1].View, "right");
  EXPECT_EQ(ChromaticitiesOf(image[1]), Rec709Chromaticities());

  depth.DisplayWindow = { 0, 0, 99, 99 };
  first.DisplayWindow = { 0, 0, 98, 99 };
  EXPECT_NE(
    MessageOf([&] { WriteExr(file, { first, depth }); }).find("display window"), std::string::npos);
  first.DisplayWindow = {};
  depth.PixelAspectRatio = 2.0f;
  EXPECT_NE(MessageOf([&] { WriteExr(file, { first, depth }); }).find("aspect"), std::string::npos);
  depth.PixelAspectRatio = 1.0f;
  depth.Attributes["chromaticities"] = ExrChromaticities{ 1, 0, 0, 1, 0, 0, 0.3f, 0.3f };
  EXPECT_NE(
    MessageOf([&] { WriteExr(file, { first, depth }); }).find("chromaticities"), std::string::npos);
  EXPECT_EQ(ReadExr(file).size(), 2u); // the file before is whole
}

TEST(ExrParts, TheLevelOfDwaCountsAndIsSaid)
{
  const int n = 128;
  std::vector<float> values;
  for (int k = 0; k < n * n; ++k)
  {
    values.push_back(static_cast<float>(
      2.0 + std::sin(0.13 * (k % n)) * std::cos(0.07 * (k / n)) + 0.05 * ((k * 7919) % 101) / 101.0));
  }
  std::uintmax_t lastSize = 0;
  double lastError = 1.0;
  for (const float level : { 500.0f, 45.0f, 0.0f })
  {
    ExrPart part;
    part.DataWindow = ExrBox::OfSize(n, n);
    for (const char* name : { "B", "G", "R" })
    {
      part.Channels.push_back(ExrChannel::View(name, values.data(), n, ExrPixelType::Half));
    }
    part.Compression = ExrCompression::DWAA;
    part.DwaLevel = level;
    const std::string file = testing::TempDir() + "/dwa.exr";
    WriteExr(file, { part });
    const ExrPart read = ReadExr(file)[0];
    EXPECT_EQ(read.DwaLevel, level);
    double error = 0.0;
    for (int y = 0; y < n; ++y)
    {
      for (int x = 0; x < n; ++x)
      {
        error += std::abs(read.Find("G")->At(x, y) - values[y * n + x]) / (n * n);
      }
    }
    EXPECT_LT(error, lastError);
    EXPECT_GT(fs::file_size(file), lastSize);
    lastError = error;
    lastSize = fs::file_size(file);
  }
  EXPECT_LT(lastError, 2e-3); // next to nothing: the rounding of half
  ExrPart part;
  part.DataWindow = ExrBox::OfSize(n, n);
  part.Channels = { ExrChannel::View("Z", values.data(), n) };
  part.Compression = ExrCompression::DWAB;
  part.DwaLevel = -1.0f;
  EXPECT_NE(MessageOf([&] { WriteExr(testing::TempDir() + "/dwa.exr", { part }); }).find("DWA"),
    std::string::npos);
}
