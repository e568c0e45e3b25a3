// SPDX-License-Identifier: BSD-3-Clause
// What is written is what is read.
#include "io/ExrReader.h"
#include "io/ExrWriter.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <sys/stat.h>

using namespace radiometry::io;
namespace fs = std::filesystem;

namespace
{

constexpr int width = 37;
constexpr int height = 29;

/// Every kind of finite float: the bits are random.
std::vector<float> AnyFloats(unsigned seed)
{
  std::mt19937 random(seed);
  std::vector<float> values;
  while (values.size() < width * height)
  {
    const std::uint32_t bits = random();
    float value;
    std::memcpy(&value, &bits, 4);
    if (std::isfinite(value))
    {
      values.push_back(value);
    }
  }
  return values;
}

ExrPart Picture(const std::vector<float>& values)
{
  ExrPart part;
  part.DataWindow = ExrBox::OfSize(width, height);
  part.Channels = { ExrChannel::View("Irradiance", values.data(), width) };
  return part;
}

std::string File(const std::string& name)
{
  return testing::TempDir() + "/round-trip-" + name + ".exr";
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

void ExpectSameBits(const ExrChannel& channel, const std::vector<float>& values)
{
  for (int y = 0; y < height; ++y)
  {
    ASSERT_EQ(std::memcmp(static_cast<const float*>(channel.Data) + y * channel.YStride,
                values.data() + y * width, 4 * width),
      0)
      << "row " << y;
  }
}

} // namespace

TEST(ExrRoundTrip, FloatIsExactInEveryLosslessCompressionAndTiled)
{
  const auto values = AnyFloats(1);
  for (const char* name : { "None", "RLE", "ZIPS", "ZIP", "PIZ" })
  {
    for (int tile : { 0, 16 })
    {
      SCOPED_TRACE(std::string(name) + (tile ? " tiles" : " lines"));
      ExrPart part = Picture(values);
      part.Compression = CompressionFromString(name);
      part.TileWidth = part.TileHeight = tile;
      WriteExr(File("exact"), { part });
      const ExrImage image = ReadExr(File("exact"));
      ASSERT_EQ(image.size(), 1u);
      EXPECT_EQ(ToString(image[0].Compression), name);
      EXPECT_EQ(image[0].TileWidth, tile);
      ExpectSameBits(*image[0].Find("Irradiance"), values);
    }
  }
}

TEST(ExrRoundTrip, LossyCompressionsStayClose)
{
  std::vector<float> smooth(width * height);
  for (int i = 0; i < width * height; ++i)
  {
    smooth[i] = 1.0f + 0.5f * std::sin(0.02f * static_cast<float>(i));
  }
  for (const char* name : { "PXR24", "B44", "B44A", "DWAA", "DWAB" })
  {
    ExrPart part = Picture(smooth);
    part.Channels[0].Name = "Y";
    part.Channels[0].Type = ExrPixelType::Half;
    part.Compression = CompressionFromString(name);
    WriteExr(File("lossy"), { part });
    const ExrImage image = ReadExr(File("lossy"));
    for (int i = 0; i < width * height; ++i)
    {
      ASSERT_NEAR(image[0].Channels[0].At(i % width, i / width), smooth[i], 0.03) << name;
    }
  }
  EXPECT_THROW(CompressionFromString("LZ77"), std::invalid_argument);
}

TEST(ExrRoundTrip, HalfRoundsToNearestAndUIntIsExact)
{
  std::vector<float> values(width * height);
  std::vector<std::uint32_t> ids(width * height);
  for (int i = 0; i < width * height; ++i)
  {
    values[i] = 0.1f * static_cast<float>(i) - 20.0f;
    ids[i] = 4294967295u - static_cast<std::uint32_t>(i) * 4001u;
  }
  ExrPart part = Picture(values);
  part.Channels[0].Type = ExrPixelType::Half;
  ExrChannel id;
  id.Name = "CellId";
  id.Type = ExrPixelType::UInt;
  id.Kind = ExrChannel::Memory::UInt32;
  id.Data = ids.data();
  id.YStride = width;
  part.Channels.push_back(id);
  WriteExr(File("types"), { part });
  const ExrImage image = ReadExr(File("types"));
  EXPECT_EQ(image[0].Find("Irradiance")->Type, ExrPixelType::Half);
  EXPECT_EQ(image[0].Find("CellId")->Type, ExrPixelType::UInt);
  for (int i = 0; i < width * height; ++i)
  {
    ASSERT_EQ(image[0].Find("CellId")->At(i % width, i / width), ids[i]);
    ASSERT_NEAR(image[0].Find("Irradiance")->At(i % width, i / width), values[i],
      std::abs(values[i]) / 2048.0 + 3e-8);
  }
}

TEST(ExrRoundTrip, DoublesAndStridesAndBottomUp)
{
  // Interleaved vectors stored from the bottom row up, as VTK keeps its images.
  std::vector<double> vectors(3 * width * height);
  for (std::size_t i = 0; i < vectors.size(); ++i)
  {
    vectors[i] = static_cast<double>(i);
  }
  ExrPart part;
  part.DataWindow = ExrBox::OfSize(width, height);
  for (int c = 0; c < 3; ++c)
  {
    ExrChannel channel;
    channel.Name = std::string("N.") + "XYZ"[c];
    channel.Kind = ExrChannel::Memory::Float64;
    channel.Data = vectors.data() + 3 * width * (height - 1) + c;
    channel.XStride = 3;
    channel.YStride = -3 * width;
    part.Channels.push_back(channel);
  }
  WriteExr(File("strides"), { part });
  const ExrImage image = ReadExr(File("strides"));
  for (int c = 0; c < 3; ++c)
  {
    const ExrChannel& channel = *image[0].Find(std::string("N.") + "XYZ"[c]);
    EXPECT_EQ(channel.At(0, 0), 3.0 * width * (height - 1) + c);
    EXPECT_EQ(channel.At(width - 1, height - 1), 3.0 * (width - 1) + c);
  }
}

TEST(ExrRoundTrip, WindowsAttributesAndParts)
{
  const auto values = AnyFloats(2);
  ExrPart part = Picture(values);
  part.Name = "left";
  part.DataWindow = { -5, 7, -5 + width - 1, 7 + height - 1 };
  part.DisplayWindow = { 0, 0, 99, 79 };
  part.PixelAspectRatio = 1.25f;
  part.Attributes = { { "chromaticities", Rec709Chromaticities() }, { "whiteLuminance", 250.0f },
    { "adoptedNeutral", std::array<float, 2>{ 0.3127f, 0.329f } },
    { "units:Irradiance", std::string("W/m^2") }, { "seconds", 1.0 / 3.0 }, { "bands", 3 },
    { "envmap", std::string("cube") }, { "options", std::vector<std::string>{ "Occlusion=1", "" } },
    { "bounds", std::array<double, 3>{ 1e300, -0.0, 0.1 } },
    { "wavelengths", std::vector<float>{ 0.4f, 0.5f } },
    { "up", std::array<float, 3>{ 0, 0, 1 } } };
  ExrPart second = Picture(values);
  second.Name = "right";
  second.TileWidth = second.TileHeight = 8;
  // The format has these once for the whole file.
  second.DisplayWindow = part.DisplayWindow;
  second.PixelAspectRatio = part.PixelAspectRatio;
  second.Attributes["chromaticities"] = Rec709Chromaticities();
  WriteExr(File("parts"), { part, second });
  const ExrImage image = ReadExr(File("parts"));
  ASSERT_EQ(image.size(), 2u);
  EXPECT_EQ(image[0].Name, "left");
  EXPECT_EQ(image[1].Name, "right");
  EXPECT_TRUE(image[0].DataWindow == part.DataWindow);
  EXPECT_TRUE(image[0].DisplayWindow == part.DisplayWindow);
  EXPECT_EQ(image[0].PixelAspectRatio, 1.25f);
  EXPECT_EQ(image[0].Attributes, part.Attributes);
  EXPECT_EQ(image[1].TileWidth, 8);
  ExpectSameBits(image[0].Channels[0], values);
  ExpectSameBits(image[1].Channels[0], values);
  EXPECT_EQ(ReadExrHeaders(File("parts")).size(), 2u);
  EXPECT_THROW(WriteExr(File("parts"), { part, part }), FileError);
}

TEST(ExrRoundTrip, SubSampledChannels)
{
  std::vector<float> full(8 * 6);
  std::vector<float> coarse(4 * 2);
  for (int i = 0; i < 48; ++i)
  {
    full[i] = static_cast<float>(i);
  }
  for (int i = 0; i < 8; ++i)
  {
    coarse[i] = 100.0f + static_cast<float>(i);
  }
  ExrPart part;
  part.DataWindow = { 2, 3, 9, 8 };
  part.Channels = { ExrChannel::View("Y", full.data(), 8),
    ExrChannel::View("Chroma", coarse.data(), 4) };
  part.Channels[1].XSampling = 2;
  part.Channels[1].YSampling = 3;
  WriteExr(File("sampled"), { part });
  const ExrImage image = ReadExr(File("sampled"));
  const ExrChannel& chroma = *image[0].Find("Chroma");
  EXPECT_EQ(chroma.XSampling, 2);
  EXPECT_EQ(chroma.YSampling, 3);
  for (int j = 0; j < 6; ++j)
  {
    for (int i = 0; i < 8; ++i)
    {
      ASSERT_EQ(image[0].Find("Y")->At(i, j), full[8 * j + i]);
      ASSERT_EQ(chroma.At(i / 2, j / 3), coarse[4 * (j / 3) + i / 2]);
    }
  }
  part.DataWindow = { 1, 3, 8, 8 };
  EXPECT_THROW(WriteExr(File("sampled"), { part }), FileError);
}

TEST(ExrRoundTrip, NonFiniteIsAnErrorThatNamesThePixel)
{
  auto values = AnyFloats(3);
  values[5 * width + 11] = std::numeric_limits<float>::infinity();
  ExrPart part = Picture(values);
  part.DataWindow = { 100, 200, 100 + width - 1, 200 + height - 1 };
  fs::remove(File("nan"));
  const auto message = MessageOf([&] { WriteExr(File("nan"), { part }); });
  EXPECT_NE(message.find("'Irradiance', pixel (111, 205): inf"), std::string::npos) << message;
  EXPECT_FALSE(fs::exists(File("nan")));

  ExrWriteOptions keep;
  keep.KeepNonFinite = true;
  std::uint32_t bits = 0x7fc01234u; // a NaN with a payload
  std::memcpy(&values[0], &bits, 4);
  WriteExr(File("nan"), { part }, keep);
  ExpectSameBits(ReadExr(File("nan"))[0].Channels[0], values);
}

TEST(ExrRoundTrip, WhatTheTypeCannotHoldIsAnError)
{
  std::vector<float> values(width * height, 1.0f);
  const auto message = [&](ExrPixelType type, float value) {
    values[3] = value;
    ExrPart part = Picture(values);
    part.Channels[0].Type = type;
    return MessageOf([&] { WriteExr(File("range"), { part }); });
  };
  EXPECT_EQ(message(ExrPixelType::Half, 65504.0f), "");
  EXPECT_EQ(message(ExrPixelType::Half, 65519.0f), ""); // rounds to 65504
  EXPECT_NE(message(ExrPixelType::Half, 65520.0f).find("65504"), std::string::npos);
  EXPECT_NE(message(ExrPixelType::UInt, -1.0f).find("whole number"), std::string::npos);
  EXPECT_NE(message(ExrPixelType::UInt, 0.5f).find("whole number"), std::string::npos);
  EXPECT_NE(message(ExrPixelType::UInt, NAN).find("whole number"), std::string::npos);
  EXPECT_EQ(message(ExrPixelType::UInt, 7.0f), "");
}

TEST(ExrRoundTrip, WhatIsNoImageIsAnError)
{
  const auto values = AnyFloats(4);
  EXPECT_THROW(WriteExr(File("no"), {}), FileError);
  ExrPart part = Picture(values);
  part.Channels.clear();
  EXPECT_THROW(WriteExr(File("no"), { part }), FileError);
  part = Picture(values);
  part.Channels.push_back(part.Channels[0]);
  EXPECT_THROW(WriteExr(File("no"), { part }), FileError);
  part = Picture(values);
  part.DataWindow = {};
  EXPECT_THROW(WriteExr(File("no"), { part }), FileError);
  part = Picture(values);
  part.Attributes["compression"] = std::string("mine");
  EXPECT_THROW(WriteExr(File("no"), { part }), FileError);
  part = Picture(values);
  part.Attributes["envmap"] = std::string("sphere");
  EXPECT_THROW(WriteExr(File("no"), { part }), FileError);
  part = Picture(values);
  part.Attributes["chromaticities"] = 1.0;
  EXPECT_THROW(WriteExr(File("no"), { part }), FileError);
  part = Picture(values);
  part.Channels[0].Name = "";
  EXPECT_THROW(WriteExr(File("no"), { part }), FileError);
  EXPECT_THROW(WriteExr("/nowhere/picture.exr", { Picture(values) }), FileError);
  EXPECT_FALSE(fs::exists(File("no")));
}

TEST(ExrRoundTrip, LongAndForeignNames)
{
  const auto values = AnyFloats(5);
  ExrPart part = Picture(values);
  part.Channels[0].Name = std::string(200, 'a') + ".Ångström µm";
  part.Attributes["a rather long attribute name that needs the long form"] = std::string("ja");
  WriteExr(File("names"), { part });
  const ExrImage image = ReadExr(File("names"));
  EXPECT_EQ(image[0].Channels[0].Name, part.Channels[0].Name);
  EXPECT_EQ(image[0].Attributes, part.Attributes);
}

TEST(ExrRoundTrip, TheNumberOfThreadsDoesNotMatter)
{
  std::vector<float> values(640 * 480);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = std::sin(0.001f * static_cast<float>(i)) + static_cast<float>(i % 3);
  }
  const auto bytes = [&](int threads, int tile) {
    ExrPart part;
    part.DataWindow = ExrBox::OfSize(640, 480);
    part.TileWidth = part.TileHeight = tile;
    for (const char* name : { "A", "B", "C" })
    {
      part.Channels.push_back(ExrChannel::View(name, values.data(), 640));
    }
    ExrWriteOptions options;
    options.Threads = threads;
    WriteExr(File("threads"), { part }, options);
    std::ifstream in(File("threads"), std::ios::binary);
    return std::string{ std::istreambuf_iterator<char>(in), {} };
  };
  for (int tile : { 0, 64 })
  {
    const std::string one = bytes(1, tile);
    EXPECT_GT(one.size(), 10000u);
    for (int threads : { 2, 0 })
    {
      EXPECT_EQ(bytes(threads, tile), one) << threads;
    }
  }
}

TEST(ExrRoundTrip, OnePixel)
{
  const float value = -3.5f;
  ExrPart part;
  part.DataWindow = ExrBox::OfSize(1, 1);
  part.Channels = { ExrChannel::View("Z", &value, 1) };
  WriteExr(File("one"), { part });
  EXPECT_EQ(ReadExr(File("one"))[0].Channels[0].At(0, 0), -3.5);
}
