// SPDX-License-Identifier: BSD-3-Clause
// Files that others wrote: the pictures of openexr-images.
#include "color/Primaries.h"
#include "io/ExrReader.h"
#include "io/ExrWriter.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>
#include <set>

using namespace radiometry::io;
namespace color = radiometry::color;
namespace fs = std::filesystem;

namespace
{

const fs::path folder = RADIOMETRY_SHARED_DATA "/exr";

#define NEEDS_DATA()                 \
  if (!fs::exists(folder))           \
  {                                  \
    GTEST_SKIP() << "no " << folder; \
  }

color::Primaries PrimariesOf(const ExrPart& part)
{
  const auto found = part.Attributes.find("chromaticities");
  const auto c = found == part.Attributes.end() ? Rec709Chromaticities()
                                                : std::get<ExrChromaticities>(found->second);
  return { { c[0], c[1] }, { c[2], c[3] }, { c[4], c[5] }, { c[6], c[7] } };
}

/// The picture in linear Rec.709, as its chromaticities say: the same CIE XYZ, so no adaptation
/// of the white.
std::vector<double> InRec709(const std::string& name)
{
  const ExrPart part = ReadExr((folder / "Chromaticities" / name).string())[0];
  const auto m = color::Multiply(color::Inverse(color::RgbToXyz(color::Primaries::Rec709())),
    color::RgbToXyz(PrimariesOf(part)));
  std::vector<double> pixels;
  for (long long y = 0; y < part.DataWindow.Height(); ++y)
  {
    for (long long x = 0; x < part.DataWindow.Width(); ++x)
    {
      const double rgb[3] = { part.Find("R")->At(x, y), part.Find("G")->At(x, y),
        part.Find("B")->At(x, y) };
      for (int i = 0; i < 3; ++i)
      {
        pixels.push_back(m[3 * i] * rgb[0] + m[3 * i + 1] * rgb[1] + m[3 * i + 2] * rgb[2]);
      }
    }
  }
  return pixels;
}

/// Mean absolute difference relative to the mean.
double Difference(const std::vector<double>& a, const std::vector<double>& b)
{
  double difference = 0;
  double mean = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    difference += std::abs(a[i] - b[i]);
    mean += std::abs(a[i]);
  }
  return difference / mean;
}

} // namespace

TEST(ExrRealFiles, ChromaticitiesLookAlike)
{
  NEEDS_DATA();
  const auto rec709 = InRec709("Rec709.exr");
  const auto xyz = InRec709("XYZ.exr");
  ASSERT_EQ(rec709.size(), xyz.size());
  // Half has 11 bits. Blue loses some in XYZ, where it is a difference; in the mean 5e-4.
  EXPECT_LT(Difference(rec709, xyz), 1e-3);
  // Chroma at half the resolution: edges differ, surfaces do not.
  EXPECT_LT(Difference(rec709, InRec709("Rec709_YC.exr")), 0.03);
  EXPECT_LT(Difference(rec709, InRec709("XYZ_YC.exr")), 0.03);
  // And without a look at the attribute they are worlds apart: the test can fail.
  const ExrPart raw = ReadExr((folder / "Chromaticities" / "XYZ.exr").string())[0];
  std::vector<double> unconverted;
  for (long long y = 0; y < raw.DataWindow.Height(); ++y)
  {
    for (long long x = 0; x < raw.DataWindow.Width(); ++x)
    {
      for (const char* name : { "R", "G", "B" })
      {
        unconverted.push_back(raw.Find(name)->At(x, y));
      }
    }
  }
  EXPECT_GT(Difference(rec709, unconverted), 0.05);
}

TEST(ExrRealFiles, EveryHalfValue)
{
  NEEDS_DATA();
  const std::string file = (folder / "TestImages" / "AllHalfValues.exr").string();
  const ExrPart part = ReadExr(file)[0];
  std::set<float> finite;
  int nan = 0;
  int infinite = 0;
  const ExrChannel& g = *part.Find("G");
  for (long long y = 0; y < part.DataWindow.Height(); ++y)
  {
    for (long long x = 0; x < part.DataWindow.Width(); ++x)
    {
      const float v = static_cast<float>(g.At(x, y));
      nan += std::isnan(v);
      infinite += std::isinf(v);
      if (std::isfinite(v))
      {
        finite.insert(v);
      }
    }
  }
  // 2^16 less the 2046 NaN and 2 infinities; +0 and -0 compare equal.
  EXPECT_EQ(finite.size(), 65536u - 2046 - 2 - 1);
  EXPECT_EQ(nan, 2046);
  EXPECT_EQ(infinite, 2);
  EXPECT_EQ(*finite.rbegin(), 65504.0f);

  ExrReadOptions strict;
  strict.KeepNonFinite = false;
  EXPECT_THROW(ReadExr(file, strict), FileError);

  // Through our own writer as half and back: the same bits, NaN apart.
  const std::string copy = testing::TempDir() + "/all-half.exr";
  fs::remove(copy);
  EXPECT_THROW(WriteExr(copy, { part }), FileError);
  EXPECT_FALSE(fs::exists(copy));
  ExrWriteOptions keep;
  keep.KeepNonFinite = true;
  WriteExr(copy, { part }, keep);
  const ExrPart again = ReadExr(copy)[0];
  for (long long y = 0; y < part.DataWindow.Height(); ++y)
  {
    for (long long x = 0; x < part.DataWindow.Width(); ++x)
    {
      const float a = static_cast<float>(g.At(x, y));
      const float b = static_cast<float>(again.Find("G")->At(x, y));
      ASSERT_TRUE(std::memcmp(&a, &b, 4) == 0 || (std::isnan(a) && std::isnan(b)));
    }
  }
}

TEST(ExrRealFiles, NanAndInfinitiesAreNamed)
{
  NEEDS_DATA();
  const std::string file = (folder / "TestImages" / "BrightRingsNanInf.exr").string();
  ExrReadOptions strict;
  strict.KeepNonFinite = false;
  try
  {
    ReadExr(file, strict);
    FAIL() << "read NaN without a word";
  }
  catch (const FileError& e)
  {
    EXPECT_NE(std::string(e.what()).find("pixel ("), std::string::npos) << e.what();
  }
  EXPECT_NO_THROW(ReadExr(file));
}

TEST(ExrRealFiles, NegativeRgbIsKept)
{
  NEEDS_DATA();
  const ExrPart part = ReadExr((folder / "TestImages" / "WideColorGamut.exr").string())[0];
  double least = 0;
  for (long long y = 0; y < part.DataWindow.Height(); ++y)
  {
    for (long long x = 0; x < part.DataWindow.Width(); ++x)
    {
      least = std::min(least, part.Find("R")->At(x, y));
    }
  }
  EXPECT_LT(least, -0.01);
}

TEST(ExrRealFiles, EveryOneIsReadAndComesBackTheSame)
{
  NEEDS_DATA();
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
  {
    if (entry.path().extension() != ".exr" || entry.path().parent_path().filename() == "Damaged")
    {
      continue;
    }
    ++files;
    SCOPED_TRACE(entry.path().string());
    if (entry.path().filename() == "Trunks.exr")
    {
      // Deep data, several samples a pixel: refused with a word about it.
      EXPECT_THROW(ReadExr(entry.path().string()), FileError);
      continue;
    }
    ExrImage image;
    ASSERT_NO_THROW(image = ReadExr(entry.path().string()));
    for (ExrPart& part : image)
    {
      part.Compression = ExrCompression::ZIP;
    }
    const std::string copy = testing::TempDir() + "/copy.exr";
    ExrWriteOptions keep;
    keep.KeepNonFinite = true;
    ASSERT_NO_THROW(WriteExr(copy, image, keep));
    const ExrImage again = ReadExr(copy);
    ASSERT_EQ(again.size(), image.size());
    for (std::size_t p = 0; p < image.size(); ++p)
    {
      EXPECT_TRUE(again[p].DataWindow == image[p].DataWindow);
      EXPECT_TRUE(again[p].DisplayWindow == image[p].DisplayWindow);
      EXPECT_EQ(again[p].Attributes, image[p].Attributes);
      ASSERT_EQ(again[p].Channels.size(), image[p].Channels.size());
      for (const ExrChannel& a : image[p].Channels)
      {
        const ExrChannel* b = again[p].Find(a.Name);
        ASSERT_NE(b, nullptr) << a.Name;
        for (long long y = 0; y < image[p].DataWindow.Height() / a.YSampling; ++y)
        {
          for (long long x = 0; x < image[p].DataWindow.Width() / a.XSampling; ++x)
          {
            const double u = a.At(x, y);
            const double v = b->At(x, y);
            ASSERT_TRUE(u == v || (std::isnan(u) && std::isnan(v))) << a.Name;
          }
        }
      }
    }
  }
  EXPECT_GE(files, 14);
}
