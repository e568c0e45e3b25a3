// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace radiometry
{

/// A rule on the triangle: barycentric coordinates and weights that sum to 1 (multiply by the
/// area). All weights are positive and all points inside.
struct TriangleRule
{
  struct Node
  {
    double B0, B1, B2, Weight;
  };
  int Degree; // polynomials up to this degree are integrated exactly
  std::vector<Node> Nodes;
};

/// The smallest rule that is exact to at least `degree` (1 to 8).
///   Source  Strang and Fix (1973), Dunavant (1985): 1, 3, 6, 7, 12, 16 points
const TriangleRule& TriangleRuleOfDegree(int degree);

/// A rule on [0, 1], weights summing to 1.
struct LineRule
{
  std::vector<double> Nodes;
  std::vector<double> Weights;
};

/// Gauss-Legendre with n points (1 to 128): exact for degree 2n - 1. Computed by Newton's method.
const LineRule& GaussLegendre(int n);

/// One level of the double-exponential rule on [0, 1] (Takahasi and Mori 1974), for integrands
/// with singular ends: x = 1/(1 + exp(-pi sinh t)), t in steps of 2^-level. Nodes come in pairs
/// x and 1 - x; only those below 1/2 are stored, so that the distance from either end is exact.
/// Level k > 0 holds only the nodes that are not in level k - 1.
struct DoubleExponentialLevel
{
  std::vector<double> Distance; // from an end, ascending towards the middle; at most 1/2
  std::vector<double> Weight;   // of that node: already multiplied by the step
  bool HasMiddle = false;       // the last node is 1/2 itself and stands once
};
const DoubleExponentialLevel& DoubleExponential(int level);
/// The number of levels, 0 to DoubleExponentialLevels - 1.
inline constexpr int DoubleExponentialLevels = 7;

} // namespace radiometry
