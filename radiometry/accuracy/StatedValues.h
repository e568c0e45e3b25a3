// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace radiometry
{

/// A computed quantity with the error that is stated of each value: items (cells or points) x bands.
struct StatedValues
{
  int Bands = 1;
  std::vector<double> Values;
  std::vector<double> Errors;  // as Values, covering 95 %; empty: none is stated, values are exact
  std::vector<double> Weights; // of items: area; those of 0 or less count nowhere

  std::size_t Items() const { return this->Weights.size(); }
};

/// What the stated errors of a quantity say, in the words of ConvergenceRecord.
struct StatedError
{
  std::size_t Values = 0; // that count
  double MeanValue = 0.0; // area-weighted mean of |value|
  double Relative = 0.0;  // mean error over mean value; 0 where both are 0, -1 (not known) where
                          // only the value is
  double Absolute = 0.0;  // area-weighted mean error, in the unit of the quantity
  double Greatest = 0.0;
};
StatedError SummarizeErrors(const StatedValues& values);

/// How far values are from those of a reference, and how well their stated errors say it.
///   Model   coverage: the share of values (each counts one) with |v - r| <= hypot(e_v, e_r), e_r at
///           least four times the rounding of r: both errors are taken as independent.
///           Sharpness: the median of e_v / |v - r| over the values that differ from the reference by
///           more than that
struct Deviation
{
  std::size_t Values = 0;
  double Relative = 0.0;  // root of the area-weighted mean of (v - r)^2, over the mean of |r|; 0
                          // where both are 0, -1 (not known) where only the mean is
  double Absolute = 0.0;  // area-weighted mean of |v - r|
  double Greatest = 0.0;
  double Coverage = 0.0;  // in [0, 1]
  double Sharpness = -1.0; // below 0: no value differs
};
/// Both have the same items and bands; weights are those of `values`.
///   Fails   InputError where numbers of values differ
Deviation Compare(const StatedValues& values, const StatedValues& reference);

/// Relative differences of values of the same items, where either is not 0: |a - b| / max(|a|, |b|).
struct RelativeDifference
{
  std::size_t Values = 0;
  double Greatest = 0.0;
  double Median = 0.0;
};
RelativeDifference Differences(const StatedValues& a, const StatedValues& b);
/// Of values and themselves as stored in single precision.
RelativeDifference FloatStorage(const StatedValues& values);

} // namespace radiometry
