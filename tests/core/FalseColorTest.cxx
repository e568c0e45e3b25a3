// SPDX-License-Identifier: BSD-3-Clause
// False colours: scale and legend agree, ranges and levels are round, lines lie between bands.
#include "radiometry/imaging/FalseColor.h"
#include "radiometry/scene/InputError.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

using namespace radiometry;
using namespace radiometry::imaging;

namespace
{

const double odd = std::numeric_limits<double>::quiet_NaN();
const double endless = std::numeric_limits<double>::infinity();

FalseColorSettings Scale(double low, double high, ColorScale scale, int steps = 0)
{
  FalseColorSettings settings;
  settings.Minimum = low;
  settings.Maximum = high;
  settings.Scale = scale;
  settings.Steps = steps;
  return settings;
}

std::string FaultOf(const FalseColorSettings& settings)
{
  try
  {
    FalseColorMap map(settings);
  }
  catch (const InputError& e)
  {
    return e.Array;
  }
  return "";
}

} // namespace

TEST(FalseColor, PalettesRunFromEndToEnd)
{
  EXPECT_EQ(PaletteColor(Palette::Viridis, 0.0), (ByteColor{ { 68, 1, 84 } }));
  EXPECT_EQ(PaletteColor(Palette::Viridis, 1.0), (ByteColor{ { 253, 231, 37 } }));
  EXPECT_EQ(PaletteColor(Palette::Grey, 0.5), (ByteColor{ { 128, 128, 128 } }));
  for (Palette p : { Palette::Viridis, Palette::Inferno, Palette::Spectrum, Palette::Grey })
  {
    EXPECT_EQ(PaletteColor(p, -3.0), PaletteColor(p, 0.0));
    EXPECT_EQ(PaletteColor(p, odd), PaletteColor(p, 0.0));
    EXPECT_EQ(PaletteColor(p, 7.0), PaletteColor(p, 1.0));
  }
  // The even ones grow lighter all the way.
  for (Palette p : { Palette::Viridis, Palette::Inferno, Palette::Grey })
  {
    double last = -1;
    for (int i = 0; i <= 100; ++i)
    {
      const ByteColor c = PaletteColor(p, i / 100.0);
      const double light = 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2];
      EXPECT_GT(light, last - 0.8) << i;
      last = light;
    }
  }
}

TEST(FalseColor, PositionsAreThoseOfTheScale)
{
  const FalseColorMap log(Scale(1, 10000, ColorScale::Logarithmic));
  EXPECT_NEAR(log.Position(100), 0.5, 1e-15);
  EXPECT_NEAR(log.Value(0.75), 1000, 1e-9);
  EXPECT_EQ(log.Position(0), 0.0);
  EXPECT_EQ(log.Position(-5), 0.0);
  EXPECT_EQ(log.Position(1e9), 1.0);
  const FalseColorMap linear(Scale(-2, 2, ColorScale::Linear));
  EXPECT_NEAR(linear.Position(1), 0.75, 1e-15);
  EXPECT_NEAR(linear.Value(0.25), -1, 1e-15);
}

TEST(FalseColor, EveryValueHasTheColourOfItsRowOfTheLegend)
{
  std::mt19937 random(1);
  FalseColorSettings levels;
  levels.Levels = { 1, 10, 300, 500, 2000 };
  for (const FalseColorSettings& settings :
    { Scale(0.5, 5000, ColorScale::Logarithmic), Scale(0.5, 5000, ColorScale::Logarithmic, 7),
      Scale(-3, 5, ColorScale::Linear), Scale(-3, 5, ColorScale::Linear, 1), levels })
  {
    const FalseColorMap map(settings);
    const auto& limits = map.GetLimits();
    ASSERT_EQ(limits.size(), map.GetColors().size() + 1);
    std::uniform_real_distribution<double> anywhere(limits.front(), limits.back());
    for (int i = 0; i < 2000; ++i)
    {
      const double value = i % 5 ? anywhere(random) : limits[i % limits.size()];
      std::size_t row = 0;
      while (row + 2 < limits.size() && value >= limits[row + 1])
      {
        ++row;
      }
      ASSERT_EQ(map.Color(value), map.GetColors()[row]) << value;
    }
    EXPECT_EQ(map.Color(-1e300), map.GetColors().front());
    EXPECT_EQ(map.Color(1e300), map.GetColors().back());
    for (double v : { odd, endless, -endless })
    {
      EXPECT_EQ(map.Color(v), settings.NotFinite);
    }
  }
}

TEST(FalseColor, RangesAreRoundAndHoldTheValues)
{
  const auto range = [](std::vector<double> values, ColorScale scale) {
    return ChooseRange(values, scale);
  };
  using Pair = std::pair<double, double>;
  EXPECT_EQ(range({ 3, 70, odd, endless }, ColorScale::Logarithmic), Pair(2, 100));
  EXPECT_EQ(range({ 1, 1000 }, ColorScale::Logarithmic), Pair(1, 1000));
  EXPECT_EQ(range({ -1, 0, 30, 50 }, ColorScale::Logarithmic), Pair(20, 50));
  EXPECT_EQ(range({ 5, 5 }, ColorScale::Logarithmic), Pair(0.5, 5));
  EXPECT_EQ(range({}, ColorScale::Logarithmic), Pair(0.1, 1));
  EXPECT_EQ(range({ 0, 93 }, ColorScale::Linear), Pair(0, 100));
  EXPECT_EQ(range({ -7, 4 }, ColorScale::Linear), Pair(-8, 4));
  EXPECT_EQ(range({ 4, 4 }, ColorScale::Linear), Pair(0, 8));
  EXPECT_EQ(range({ -4 }, ColorScale::Linear), Pair(-8, 0));
  EXPECT_EQ(range({ 0 }, ColorScale::Linear), Pair(0, 1));
  // At most five decades.
  const Pair wide = range({ 1e-12, 1e3 }, ColorScale::Logarithmic);
  EXPECT_NEAR(wide.first, 1e-2, 1e-14);
  for (ColorScale scale : { ColorScale::Linear, ColorScale::Logarithmic })
  {
    std::mt19937 random(9);
    std::lognormal_distribution<double> any(0, 6);
    for (int i = 0; i < 300; ++i)
    {
      const double a = any(random);
      const double b = any(random);
      const Pair r = range({ a, b }, scale);
      EXPECT_LT(r.first, r.second);
      EXPECT_LE(r.first, std::max(std::min(a, b), 1e-5 * std::max(a, b)) * (1 + 1e-9));
      EXPECT_GE(r.second, std::max(a, b) * (1 - 1e-9));
      EXPECT_FALSE(FaultOf(Scale(r.first, r.second, scale)).size());
    }
  }
}

TEST(FalseColor, LevelsAreRound)
{
  EXPECT_EQ(RoundLevels(0, 10, ColorScale::Linear, 5), (std::vector<double>{ 0, 2, 4, 6, 8, 10 }));
  const auto decades = RoundLevels(0.1, 1000, ColorScale::Logarithmic, 6);
  ASSERT_EQ(decades.size(), 5u);
  EXPECT_NEAR(decades[2], 10, 1e-12);
  const auto fine = RoundLevels(1, 100, ColorScale::Logarithmic, 10);
  ASSERT_EQ(fine.size(), 7u);
  EXPECT_NEAR(fine[1], 2, 1e-12);
  EXPECT_NEAR(fine[5], 50, 1e-12);
  EXPECT_TRUE(RoundLevels(1, 1, ColorScale::Linear, 5).empty());
  EXPECT_TRUE(RoundLevels(0, endless, ColorScale::Linear, 5).empty());
}

TEST(FalseColor, IsoLinesLieBetweenBands)
{
  // Rows of 0 1 2 3: one line of the level 1.5, between columns 1 and 2.
  const std::vector<double> values{ 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, odd, 3 };
  const auto lines = IsoLinePixels(values, 4, 3, { 1.5 });
  EXPECT_EQ(lines, (std::vector<std::uint8_t>{ 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0 }));
  EXPECT_EQ(IsoLinePixels(values, 4, 3, {}), std::vector<std::uint8_t>(12, 0));
}

TEST(FalseColor, BadScalesAreNamed)
{
  EXPECT_EQ(FaultOf(Scale(0, 1, ColorScale::Logarithmic)), "Minimum");
  EXPECT_EQ(FaultOf(Scale(odd, 1, ColorScale::Linear)), "Minimum");
  EXPECT_EQ(FaultOf(Scale(1, 1, ColorScale::Linear)), "Maximum");
  EXPECT_EQ(FaultOf(Scale(1, endless, ColorScale::Linear)), "Maximum");
  EXPECT_EQ(FaultOf(Scale(0, 1, ColorScale::Linear, -1)), "Steps");
  FalseColorSettings levels;
  levels.Minimum = 0.1;
  levels.Levels = { 1, 1 };
  EXPECT_EQ(FaultOf(levels), "Levels");
}
