// SPDX-License-Identifier: BSD-3-Clause
// Exposure and the difference of pictures: closed forms, invariants, pixels that are no numbers.
#include "radiometry/imaging/Exposure.h"
#include "radiometry/imaging/PictureDifference.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include <algorithm>
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

std::vector<double> Lognormal(int n)
{
  std::mt19937 random(4);
  std::lognormal_distribution<double> values(2.0, 1.5);
  std::vector<double> list;
  for (int i = 0; i < n; ++i)
  {
    list.push_back(values(random));
  }
  return list;
}

std::string FaultOf(ExposureSettings settings, double perUnit = 1.0)
{
  try
  {
    ChooseExposure({ 1.0, 2.0 }, perUnit, settings);
  }
  catch (const InputError& e)
  {
    return e.Array;
  }
  return "";
}

} // namespace

TEST(Exposure, ValuesOfCameras)
{
  EXPECT_EQ(ExposureValue(1.0, 1.0, 100.0), 0.0);                    // by definition
  EXPECT_NEAR(ExposureValue(16.0, 1.0 / 128.0, 100.0), 15.0, 1e-14); // the sunny 16, nearly
  EXPECT_NEAR(ExposureValue(8.0, 1.0 / 64.0, 400.0), 10.0, 1e-14);
  // ISO 2720, K = 12.5: 0.125 cd/m^2 at EV 0, 4096 cd/m^2 at EV 15.
  EXPECT_NEAR(MeteredExposureValue(0.125), 0.0, 1e-14);
  EXPECT_NEAR(MeteredExposureValue(4096.0), 15.0, 1e-13);
}

TEST(Exposure, SaturationIsThatOfTheSpeed)
{
  ExposureSettings settings;
  settings.Mode = ExposureMode::Camera;
  settings.FNumber = 4.0;
  settings.ShutterTime = 0.01;
  settings.IsoSpeed = 200.0;
  const ChosenExposure chosen = ChooseExposure({}, 1.0, settings);
  // L_max = 78 N^2/(0.65 S t).
  EXPECT_NEAR(chosen.Gain, 0.65 * 200.0 * 0.01 / (78.0 * 16.0), 1e-15);
  EXPECT_NEAR(chosen.ExposureValue, ExposureValue(4.0, 0.01, 200.0), 1e-13);
  // A picture in W/(m^2 sr) has a gain 683.002 times as great and the same EV.
  const ChosenExposure watts = ChooseExposure({}, units::MaximumLuminousEfficacy, settings);
  EXPECT_NEAR(watts.Gain, chosen.Gain * 683.002, 1e-12);
  EXPECT_NEAR(watts.ExposureValue, chosen.ExposureValue, 1e-12);
  settings.Mode = ExposureMode::ExposureValue;
  settings.ExposureValue = chosen.ExposureValue;
  EXPECT_NEAR(ChooseExposure({}, 1.0, settings).Gain, chosen.Gain, 1e-15);
  settings.Compensation = 2.0;
  EXPECT_NEAR(ChooseExposure({}, 1.0, settings).Gain, 4.0 * chosen.Gain, 1e-15);
  EXPECT_NEAR(ChooseExposure({}, 1.0, settings).ExposureValue, chosen.ExposureValue - 2.0, 1e-13);
}

TEST(Exposure, KeyAndPercentileComeOutAsAsked)
{
  const auto luminances = Lognormal(5000);
  for (double perUnit : { 1.0, 683.002, 1e-3 })
  {
    ExposureSettings settings;
    settings.Mode = ExposureMode::KeyValue;
    auto shown = luminances;
    const double key = ChooseExposure(luminances, perUnit, settings).Gain / perUnit;
    std::transform(shown.begin(), shown.end(), shown.begin(), [&](double l) { return l * key; });
    EXPECT_NEAR(Summarise(shown).GeometricMean, 0.18, 1e-12);
    settings.Mode = ExposureMode::Percentile;
    settings.Percentile = 95;
    settings.PercentileLevel = 0.8;
    const double gain = ChooseExposure(luminances, perUnit, settings).Gain / perUnit;
    EXPECT_NEAR(gain * LuminancePercentile(luminances, 95), 0.8, 1e-13);
  }
}

TEST(Exposure, AutomaticIsTheDarkerOfTheTwo)
{
  const auto luminances = Lognormal(5000);
  for (double percentile : { 60.0, 99.9 })
  {
    ExposureSettings settings;
    settings.Percentile = percentile;
    double least = endless;
    for (ExposureMode mode : { ExposureMode::KeyValue, ExposureMode::Percentile })
    {
      settings.Mode = mode;
      least = std::min(least, ChooseExposure(luminances, 2.0, settings).Gain);
    }
    settings.Mode = ExposureMode::Automatic;
    EXPECT_EQ(ChooseExposure(luminances, 2.0, settings).Gain, least);
  }
  // One lamp in the dark: its percentile is 0 and says nothing.
  ExposureSettings settings;
  settings.Mode = ExposureMode::Automatic;
  settings.Percentile = 50;
  EXPECT_NEAR(ChooseExposure({ 0, 0, 0, 36.0 }, 1.0, settings).Gain, 0.18 / 36.0, 1e-15);
  EXPECT_TRUE(ChooseExposure({ 0, 0 }, 1.0, settings).NoLight);
}

TEST(Exposure, PercentilesAreThoseOfTheSortedList)
{
  const std::vector<double> list{ 4, odd, 1, endless, 3, 2, 5 };
  EXPECT_EQ(LuminancePercentile(list, 0), 1.0);
  EXPECT_EQ(LuminancePercentile(list, 100), 5.0);
  EXPECT_EQ(LuminancePercentile(list, 50), 3.0);
  EXPECT_NEAR(LuminancePercentile(list, 60), 3.4, 1e-14);
  EXPECT_EQ(LuminancePercentile({ odd }, 50), 0.0);
  EXPECT_THROW(LuminancePercentile(list, 101), InputError);
  EXPECT_THROW(LuminancePercentile(list, odd), InputError);
}

TEST(Exposure, SummaryCountsWhatIsNoLight)
{
  const LuminanceSummary s = Summarise({ odd, endless, 0.0, -1.0, 2.0, 8.0 });
  EXPECT_EQ(s.Pixels, 6u);
  EXPECT_EQ(s.NonFinite, 2u);
  EXPECT_EQ(s.NotPositive, 2u);
  EXPECT_EQ(s.Minimum, 2.0);
  EXPECT_EQ(s.Maximum, 8.0);
  EXPECT_EQ(s.Mean, 2.25);
  EXPECT_NEAR(s.GeometricMean, 4.0, 1e-14);
  const LuminanceSummary none = Summarise({});
  EXPECT_EQ(none.Mean + none.Maximum + none.Minimum + none.GeometricMean, 0.0);
}

TEST(Exposure, LuminanceOfPixels)
{
  const double rgba[] = { 0.5, 0.25, 0.125, 0.5, 1, 1, 1, 0, odd, 0, 0, 1 };
  const auto l = PixelLuminances(rgba, 3, 4, 683.002);
  EXPECT_NEAR(l[0], 683.002 * (0.2126 * 1.0 + 0.7152 * 0.5 + 0.0722 * 0.25), 1e-10);
  EXPECT_TRUE(std::isnan(l[1])); // nothing drawn
  EXPECT_TRUE(std::isnan(l[2]));
  const double grey[] = { 3.0 };
  EXPECT_EQ(PixelLuminances(grey, 1, 1, 2.0)[0], 6.0);
}

TEST(Exposure, DarknessAndBadSettings)
{
  ExposureSettings settings;
  const ChosenExposure dark = ChooseExposure({ 0.0, 0.0, odd }, 1.0, settings);
  EXPECT_TRUE(dark.NoLight);
  EXPECT_EQ(dark.Gain, 1.0);
  settings.Percentile = -1;
  EXPECT_EQ(FaultOf(settings), "Percentile");
  settings = {};
  settings.PercentileLevel = 0;
  EXPECT_EQ(FaultOf(settings), "PercentileLevel");
  settings = {};
  settings.Compensation = odd;
  EXPECT_EQ(FaultOf(settings), "Compensation");
  settings.Compensation = 5000;
  EXPECT_EQ(FaultOf(settings), "ExposureValue");
  settings = {};
  settings.Mode = ExposureMode::Camera;
  settings.ShutterTime = 0;
  EXPECT_EQ(FaultOf(settings), "ShutterTime");
  EXPECT_EQ(FaultOf({}, -1.0), "LuminancePerUnit");
}

TEST(Exposure, GainRepairsOnRequest)
{
  double pixels[] = { 1.0, odd, endless, 4.0, -endless, 2.0 };
  EXPECT_EQ(ApplyGain(pixels, 2, 3, 2.0, true), 2u);
  EXPECT_EQ(std::vector<double>(pixels, pixels + 6), (std::vector<double>{ 2, 0, 8, 8, 0, 4 }));
  double kept[] = { odd, 1.0, endless, 0.5 };
  EXPECT_EQ(ApplyGain(kept, 1, 4, 3.0, false), 1u);
  EXPECT_TRUE(std::isnan(kept[0]));
  EXPECT_EQ(kept[1], 3.0);
  EXPECT_EQ(kept[3], 0.5); // alpha
}

TEST(PictureDifference, NumbersOfASmallCase)
{
  const double a[] = { 1, 2, 4, 0 };
  const double b[] = { 1, 3, 2, 0 };
  const ChannelDifference d = CompareChannel(a, b, 4, 1, 0, 0.5, 0.0);
  EXPECT_EQ(d.Pixels, 4u);
  EXPECT_EQ(d.MeanA, 1.75);
  EXPECT_EQ(d.MeanB, 1.5);
  EXPECT_EQ(d.MeanDifference, -0.25);
  EXPECT_EQ(d.MeanAbsolute, 0.75);
  EXPECT_EQ(d.MeanRelative, 0.25 * (0.5 + 0.5));
  EXPECT_NEAR(d.RootMeanSquare, std::sqrt(5.0 / 4), 1e-15);
  EXPECT_NEAR(d.RelativeRootMeanSquare, std::sqrt(5.0 / 21), 1e-15);
  EXPECT_EQ(d.Maximum, 2.0);
  EXPECT_EQ(d.MaximumAt, 2);
  EXPECT_NEAR(d.PeakSignalToNoise, 20 * std::log10(4.0 / std::sqrt(1.25)), 1e-13);
  EXPECT_NEAR(CompareChannel(a, b, 4, 1, 0, 0.5, 1.0).PeakSignalToNoise,
    20 * std::log10(1.0 / std::sqrt(1.25)), 1e-13);
}

TEST(PictureDifference, EqualPicturesAndOtherChannels)
{
  const double a[] = { 1, 5, 2, 6 };
  const double b[] = { 1, 7, 2, 6 };
  const ChannelDifference same = CompareChannel(a, b, 2, 2, 0, 1e-3, 0.0);
  EXPECT_EQ(same.RootMeanSquare, 0.0);
  EXPECT_EQ(same.MaximumAt, -1);
  EXPECT_EQ(same.PeakSignalToNoise, endless);
  EXPECT_EQ(CompareChannel(a, b, 2, 2, 1, 1e-3, 0.0).Maximum, 2.0);
  const ChannelDifference none = CompareChannel(a, b, 0, 2, 1, 1e-3, 0.0);
  EXPECT_EQ(none.Pixels, 0u);
  EXPECT_EQ(none.RootMeanSquare, 0.0);
}

TEST(PictureDifference, WhatIsNoNumberIsCountedAndLeftOut)
{
  const double a[] = { odd, endless, endless, 1, odd };
  const double b[] = { odd, endless, -endless, odd, 2 };
  const ChannelDifference d = CompareChannel(a, b, 5, 1, 0, 1e-3, 0.0);
  EXPECT_EQ(d.Pixels, 0u);
  EXPECT_EQ(d.NonFiniteA, 4u);
  EXPECT_EQ(d.NonFiniteB, 4u);
  EXPECT_EQ(d.Unlike, 3u);
  EXPECT_FALSE(std::isnan(d.RootMeanSquare));
  EXPECT_TRUE(std::isnan(Difference(odd, 1, DifferenceKind::Absolute, 1)));
  EXPECT_EQ(Difference(2, 1, DifferenceKind::Signed, 1), -1.0);
  EXPECT_EQ(Difference(-4, 1, DifferenceKind::Relative, 1), 1.25);
  EXPECT_EQ(RelativeFloor(a, 4), 1e-3);
  EXPECT_EQ(RelativeFloor(a, 2), 1e-30);
}
