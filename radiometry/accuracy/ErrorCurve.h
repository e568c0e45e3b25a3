// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace radiometry
{

/// Error against time: a point for each run of the same computation, in any order.
struct ErrorCurve
{
  std::vector<double> Seconds;
  std::vector<double> Errors;

  /// The same points in the order of their seconds.
  ErrorCurve InTime() const;
};

/// error = Factor seconds^Exponent, by least squares in the logarithms.
struct PowerLaw
{
  std::size_t Points = 0; // with seconds and error above 0
  bool Known = false;     // their times differ by a factor of 1.5 or more; the rest is 0 otherwise
  double Factor = 0.0;    // error at one second
  double Exponent = 0.0;
  double Explained = 0.0; // R^2: the share of the variance of log(error) that it explains
  double Longest = 0.0;   // seconds of the points

  /// Whether three or more errors fall with the time, at least as seconds^-0.15, and the law explains
  /// at least half of how they vary.
  bool Falls() const;
  /// Seconds in which the error becomes that small, where it falls and these are at most 100 times
  /// those of the longest run; else below 0.
  double SecondsTo(double error) const;
};
PowerLaw FitPowerLaw(const ErrorCurve& curve);

/// When a curve, in the order of time, first comes down to an error.
struct Arrival
{
  enum Kinds
  {
    Between,  // two runs: interpolated in the logarithms
    Already,  // at the first run, which may have been more than was needed
    Never,    // no run
  };
  Kinds Kind = Never;
  double Seconds = -1.0;
};
Arrival ArriveAt(double error, const ErrorCurve& curve);

} // namespace radiometry
