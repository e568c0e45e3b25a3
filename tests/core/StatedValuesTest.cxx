// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/accuracy/ErrorCurve.h"
#include "radiometry/accuracy/StatedValues.h"
#include "radiometry/scene/InputError.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace radiometry;

namespace
{

StatedValues Make(std::vector<double> values, std::vector<double> errors, std::vector<double> weights)
{
  StatedValues made;
  made.Bands = weights.empty() ? 1 : static_cast<int>(values.size() / weights.size());
  made.Values = std::move(values);
  made.Errors = std::move(errors);
  made.Weights = std::move(weights);
  return made;
}

} // namespace

TEST(StatedValues, SummaryByHand)
{
  // Areas 1 and 3; the cell without area counts nowhere.
  const StatedError found =
    SummarizeErrors(Make({ 2.0, -4.0, 99.0 }, { 0.5, 0.1, 50.0 }, { 1.0, 3.0, 0.0 }));
  EXPECT_EQ(found.Values, 2u);
  EXPECT_DOUBLE_EQ(found.MeanValue, 14.0 / 4.0);
  EXPECT_DOUBLE_EQ(found.Absolute, 0.8 / 4.0);
  EXPECT_DOUBLE_EQ(found.Relative, 0.8 / 14.0);
  EXPECT_DOUBLE_EQ(found.Greatest, 0.5);
}

TEST(StatedValues, DeviationByHand)
{
  const StatedValues values = Make({ 1.1, 2.0, 3.2, 7.0 }, { 0.11, 0.1, 0.5, 1.0 }, { 1, 1, 2, 0 });
  const StatedValues exact = Make({ 1.0, 2.0, 3.0, 0.0 }, {}, { 1, 1, 2, 0 });
  const Deviation found = Compare(values, exact);
  EXPECT_EQ(found.Values, 3u);
  EXPECT_NEAR(found.Absolute, (0.1 + 2 * 0.2) / 4, 1e-15);
  EXPECT_NEAR(found.Relative, std::sqrt((0.01 + 2 * 0.04) / 4) / (9.0 / 4), 1e-15);
  EXPECT_NEAR(found.Greatest, 0.2, 1e-15);
  EXPECT_DOUBLE_EQ(found.Coverage, 1.0);
  EXPECT_NEAR(found.Sharpness, 0.5 * (1.1 + 2.5), 1e-12); // of 0.11/0.1 and 0.5/0.2
}

TEST(StatedValues, ErrorsOfTheReferenceCount)
{
  const StatedValues values = Make({ 1.0, 1.0 }, { 0.3, 0.3 }, { 1, 1 });
  EXPECT_DOUBLE_EQ(Compare(values, Make({ 1.49, 1.51 }, {}, { 1, 1 })).Coverage, 0.0);
  // hypot(0.3, 0.4) is 0.5
  EXPECT_DOUBLE_EQ(Compare(values, Make({ 1.49, 1.51 }, { 0.4, 0.4 }, { 1, 1 })).Coverage, 0.5);
}

/// Gaussian values whose errors are two standard deviations: 95.4 % are covered, and the median of
/// 2 sigma / |x| is 2 / 0.6745.
TEST(StatedValues, CoverageAndSharpnessOfGaussians)
{
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const std::size_t n = 40000;
  StatedValues values = Make({}, {}, {});
  StatedValues reference = values;
  for (std::size_t i = 0; i < n; ++i)
  {
    const double sigma = 0.01 * (1.0 + static_cast<double>(i % 7));
    const double own = 0.5 * sigma; // of the reference
    values.Values.push_back(1.0 + sigma * normal(random));
    values.Errors.push_back(2.0 * sigma);
    reference.Values.push_back(1.0 + own * normal(random));
    reference.Errors.push_back(2.0 * own);
    values.Weights.push_back(1.0);
  }
  reference.Weights = values.Weights;
  const Deviation found = Compare(values, reference);
  EXPECT_NEAR(found.Coverage, std::erf(std::sqrt(2.0)), 0.004);
  EXPECT_NEAR(found.Sharpness, 2.0 / (std::sqrt(1.25) * 0.67449), 0.05);
}

TEST(StatedValues, AgainstItself)
{
  const StatedValues values = Make({ 1.0, 0.0, 5.0 }, { 0.0, 0.0, 0.2 }, { 1, 1, 1 });
  const Deviation found = Compare(values, values);
  EXPECT_EQ(found.Absolute, 0.0);
  EXPECT_EQ(found.Relative, 0.0);
  EXPECT_EQ(found.Coverage, 1.0);
  EXPECT_LT(found.Sharpness, 0.0); // nothing differs
}

TEST(StatedValues, NothingAndDarkness)
{
  const StatedValues none = Make({}, {}, {});
  EXPECT_EQ(SummarizeErrors(none).Values, 0u);
  EXPECT_EQ(Compare(none, none).Values, 0u);
  EXPECT_EQ(Differences(none, none).Values, 0u);
  const StatedValues dark = Make({ 0.0, 0.0 }, { 0.0, 0.0 }, { 1, 1 });
  EXPECT_EQ(SummarizeErrors(dark).Relative, 0.0);
  EXPECT_EQ(Compare(dark, dark).Relative, 0.0);
  EXPECT_EQ(Compare(dark, dark).Coverage, 1.0);
  EXPECT_EQ(Differences(dark, dark).Values, 0u);
  // Light where the reference is dark: no relative error can be given, the absolute one is there.
  const Deviation lit = Compare(Make({ 1.0, 1.0 }, { 0.5, 0.5 }, { 1, 1 }), dark);
  EXPECT_EQ(lit.Relative, -1.0);
  EXPECT_EQ(SummarizeErrors(Make({ 0.0 }, { 0.1 }, { 1 })).Relative, -1.0);
  EXPECT_EQ(lit.Absolute, 1.0);
  EXPECT_EQ(lit.Coverage, 0.0);
}

TEST(StatedValues, NumbersNearTheEndsOfTheRange)
{
  const StatedValues huge = Make({ 1e308, 1.5e308 }, { 1e307, 1e307 }, { 1e300, 1e300 });
  EXPECT_DOUBLE_EQ(SummarizeErrors(huge).MeanValue, 1.25e308);
  EXPECT_DOUBLE_EQ(SummarizeErrors(huge).Relative, 0.08);
  const Deviation far = Compare(huge, Make({ 1.5e308, 1.5e308 }, {}, { 1e300, 1e300 }));
  EXPECT_DOUBLE_EQ(far.Relative, 0.5e308 / std::sqrt(2.0) / 1.5e308);
  const StatedValues tiny = Make({ 1e-320, 2e-320 }, { 0.0, 0.0 }, { 1e-300, 1e-300 });
  EXPECT_EQ(Compare(tiny, tiny).Relative, 0.0);
  EXPECT_EQ(Compare(huge, tiny).Relative, -1.0); // beyond the range
}

TEST(StatedValues, OfAnotherSize)
{
  const StatedValues two = Make({ 1.0, 2.0 }, {}, { 1, 1 });
  EXPECT_THROW(Compare(two, Make({ 1.0 }, {}, { 1 })), InputError);
  EXPECT_THROW(Compare(two, Make({ 1, 2, 3, 4 }, {}, { 1, 1 })), InputError); // bands
}

TEST(StatedValues, FloatDifferences)
{
  const RelativeDifference stored = FloatStorage(Make({ 0.1, 1.0, 0.0, 3.0 }, {}, { 1, 1, 1, 1 }));
  EXPECT_EQ(stored.Values, 3u);
  EXPECT_NEAR(stored.Greatest, std::abs(0.1f - 0.1) / 0.1, 1e-12);
  EXPECT_EQ(stored.Median, 0.0);
  const RelativeDifference far =
    Differences(Make({ 1.0, 0.0 }, {}, { 1, 1 }), Make({ 0.75, 2.0 }, {}, { 1, 1 }));
  EXPECT_DOUBLE_EQ(far.Greatest, 1.0);
  EXPECT_DOUBLE_EQ(far.Median, 0.5 * (0.25 + 1.0));
}

TEST(ErrorCurve, FitsAPowerLaw)
{
  ErrorCurve curve;
  for (const double t : { 0.01, 0.3, 2.0, 50.0 })
  {
    curve.Seconds.push_back(t);
    curve.Errors.push_back(0.07 * std::pow(t, -0.5));
  }
  const PowerLaw law = FitPowerLaw(curve);
  EXPECT_TRUE(law.Known);
  EXPECT_EQ(law.Points, 4u);
  EXPECT_NEAR(law.Exponent, -0.5, 1e-13);
  EXPECT_NEAR(law.Factor, 0.07, 1e-13);
  EXPECT_NEAR(law.Explained, 1.0, 1e-12);
  EXPECT_TRUE(law.Falls());
  EXPECT_NEAR(law.SecondsTo(0.001), 4900.0, 1e-8);
  EXPECT_LT(law.SecondsTo(0.0007), 0.0); // 10,000 s: too far beyond 50
  // Between two runs it is the law itself.
  const Arrival arrival = ArriveAt(0.05, curve);
  EXPECT_EQ(arrival.Kind, Arrival::Between);
  EXPECT_NEAR(arrival.Seconds, std::pow(0.07 / 0.05, 2), 1e-12);
}

TEST(ErrorCurve, WhatCannotBeFitted)
{
  EXPECT_FALSE(FitPowerLaw({}).Known);
  EXPECT_FALSE(FitPowerLaw({ { 1.0 }, { 0.1 } }).Known);
  EXPECT_FALSE(FitPowerLaw({ { 1.0, 1.0 }, { 0.1, 0.01 } }).Known);      // one time
  EXPECT_FALSE(FitPowerLaw({ { 1.0, 1.2 }, { 0.1, 0.01 } }).Known);      // nearly one time
  EXPECT_FALSE(FitPowerLaw({ { 1.0, 2.0, 3.0 }, { 0.1, 0.0, 0.0 } }).Known); // exact runs
  EXPECT_FALSE(FitPowerLaw({ { 1.0, 4.0 }, { 0.2, 0.1 } }).Falls()); // two points
  const PowerLaw grows = FitPowerLaw({ { 1.0, 2.0, 4.0 }, { 0.1, 0.15, 0.2 } });
  EXPECT_TRUE(grows.Known);
  EXPECT_FALSE(grows.Falls());
  EXPECT_LT(grows.SecondsTo(0.01), 0.0);
  EXPECT_FALSE(FitPowerLaw({ { 1.0, 5.0, 10.0 }, { 0.1, 0.095, 0.09 } }).Falls()); // hardly
  // Up and down: the slope of a line through it says nothing.
  const PowerLaw scattered = FitPowerLaw({ { 1, 2, 3, 4 }, { 0.02, 0.08, 0.01, 0.03 } });
  EXPECT_LT(scattered.Exponent, 0.0);
  EXPECT_FALSE(scattered.Falls());
  EXPECT_LT(PowerLaw().SecondsTo(0.1), 0.0);
}

TEST(ErrorCurve, Arrivals)
{
  const ErrorCurve curve{ { 1.0, 4.0, 9.0 }, { 0.2, 0.05, 0.0 } };
  EXPECT_EQ(ArriveAt(0.3, curve).Kind, Arrival::Already);
  EXPECT_EQ(ArriveAt(0.3, curve).Seconds, 1.0);
  EXPECT_DOUBLE_EQ(ArriveAt(0.1, curve).Seconds, 2.0);
  EXPECT_DOUBLE_EQ(ArriveAt(0.05, curve).Seconds, 4.0);
  EXPECT_EQ(ArriveAt(0.01, curve).Kind, Arrival::Between); // an exact run: that run's time
  EXPECT_EQ(ArriveAt(0.01, curve).Seconds, 9.0);
  EXPECT_EQ(ArriveAt(0.01, { { 1.0 }, { 0.2 } }).Kind, Arrival::Never);
  EXPECT_LT(ArriveAt(0.01, { { 1.0 }, { 0.2 } }).Seconds, 0.0);
  EXPECT_EQ(ArriveAt(0.01, {}).Kind, Arrival::Never);
  // A finer run that happened to be faster.
  EXPECT_EQ(ArriveAt(0.01, { { 2.0, 1.5 }, { 0.2, 0.001 } }).Seconds, 1.5);
  EXPECT_EQ(ArriveAt(0.1, { { 9.0, 1.0, 4.0 }, { 0.0, 0.2, 0.05 } }).Seconds, 2.0); // any order
}
