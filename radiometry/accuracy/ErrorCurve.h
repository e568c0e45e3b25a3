// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace radiometry
{

/// Error against time: a point for each run of the same computation, from coarse to fine.
struct ErrorCurve
{
  std::vector<double> Seconds;
  std::vector<double> Errors;
};

/// error = Factor seconds^Exponent, by least squares in the logarithms.
struct PowerLaw
{
  std::size_t Points = 0; // with seconds and error above 0
  bool Known = false;     // their times differ by a factor of 1.5 or more; the rest is 0 otherwise
  double Factor = 0.0;    // error at one second
  double Exponent = 0.0;

  /// Seconds in which the error becomes that small; below 0: never, or it is not known.
  double SecondsTo(double error) const;
};
PowerLaw FitPowerLaw(const ErrorCurve& curve);

/// When a curve first comes down to an error.
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
