// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/CalibrationSuite.h"

#include <gtest/gtest.h>

/// The contract |value - exact| <= error for 95 % of values, median error/|true error| at most 10, on
/// the cheap rows of the table of docs/accuracy.md (benchmarks/calibration runs all of them): each
/// effect by each method. Seeds are fixed, so the limit of 93 % leaves room for the draw and none for
/// luck; a row fails where so few covered values would be met by chance once in a hundred times.
namespace
{

constexpr double LeastCoverage = 0.93;
constexpr double GreatestMedian = 10.0;

void Holds(const char* what, std::size_t covered, std::size_t count)
{
  EXPECT_GE(test::ChanceOfFewer(covered, count, LeastCoverage), 0.01)
    << what << ": " << covered << " of " << count;
}

void Judge(const std::string& group, double seconds, double longest)
{
  test::Calibration all;
  for (const test::SuiteRow& row :
    test::RunSuite(test::SuiteParts(group), seconds, 20, longest))
  {
    SCOPED_TRACE(row.Effect + ", " + row.Method);
    EXPECT_GT(row.Sum.Exact + row.Sum.Estimated, 0u);
    Holds("exact to rounding", row.Sum.ExactCovered, row.Sum.Exact);
    Holds("estimated", row.Sum.EstimatedCovered, row.Sum.Estimated);
    all.Add(row.Sum);
  }
  EXPECT_GE(all.Coverage(), LeastCoverage);
  ASSERT_GT(all.Estimated, 100u);
  EXPECT_GE(static_cast<double>(all.EstimatedCovered),
    LeastCoverage * static_cast<double>(all.Estimated));
  EXPECT_LE(all.Median(), GreatestMedian);
  EXPECT_LE(all.Undecided, all.Estimated / 5) << "references too coarse to judge by";
}

} // namespace

TEST(CalibrationSuite, ViewFactors) { Judge("view factors", 2.0, 1.0); }
TEST(CalibrationSuite, Radiance) { Judge("radiance", 0.3, 1.0); }

TEST(CalibrationSuite, ChanceOfFewer)
{
  // Two of two: all; none of two at a half: a quarter.
  EXPECT_NEAR(test::ChanceOfFewer(2, 2, 0.93), 1.0, 1e-12);
  EXPECT_NEAR(test::ChanceOfFewer(0, 2, 0.5), 0.25, 1e-12);
  EXPECT_NEAR(test::ChanceOfFewer(1, 3, 0.5), 0.5, 1e-12);
  EXPECT_LT(test::ChanceOfFewer(80, 100, 0.93), 1e-4);
}
