// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace radiometry
{

/// The integral of f(u, v) over the unit square.
///   Model   cells of 4 x 4 Gauss points; the one where halving both sides changes most is divided
///           until the sum of these changes is below relativeTolerance times the sum of |cells|
///   Writes  value, and as error that sum of changes
///   Cost    at most about `evaluations` calls
struct CubatureResult
{
  double Value = 0.0;
  double Error = 0.0;
  long long Evaluations = 0;
};
CubatureResult IntegrateUnitSquare(const std::function<double(double, double)>& f,
  double relativeTolerance, long long evaluations);

} // namespace radiometry
