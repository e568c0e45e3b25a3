// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementTree.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{

/// How the unoccluded exchange of two clusters a, b changes with place and with normal, to first
/// order: that of points x of a and y of b, relative to its mean, is
///   1 + t (Slope.((x - c_a) - (y - c_b)) + TurnA (n_x - n_a).R - TurnB (n_y - n_b).R)
///   of k = (n_a.R)(-n_b.R)/(pi R^4), R = c_b - c_a, TurnA = 1/n_a.R, TurnB = -1/n_b.R
/// Slope is -Slope of (b, a) to the last bit, and the turns change places, so that the exchange is
/// symmetric.
struct ExchangeSlope
{
  ExchangeSlope(const ElementTree::Node& a, const ElementTree::Node& b)
    : R(b.Center - a.Center)
    , R2(LengthSquared(R))
    , CosA(Dot(a.Normal, R))
    , CosB(-Dot(b.Normal, R))
  {
    if (this->CosA > 0.0 && this->CosB > 0.0)
    {
      this->TurnA = 1.0 / this->CosA;
      this->TurnB = 1.0 / this->CosB;
      this->Slope = (this->TurnB * b.Normal - this->TurnA * a.Normal) + (4.0 / this->R2) * this->R;
    }
  }
  /// k, 1/m^2.
  double Kernel() const
  {
    return this->CosA > 0.0 && this->CosB > 0.0
      ? this->CosA * this->CosB / (3.14159265358979323846 * this->R2 * this->R2)
      : 0.0;
  }
  /// The greatest change by normals of a cluster with that turn.
  double Bend(const ElementTree::Node& node, double turn) const
  {
    return node.Flat() ? 0.0 : turn * node.Bend * std::sqrt(this->R2);
  }
  /// The greatest |Slope.(x - c)| for x of the cluster.
  double Reach(const ElementTree::Node& node) const
  {
    return std::min(Length(this->Slope) * node.Radius,
      Length(Cross(this->Slope, node.Axis)) * node.Radius +
        std::abs(Dot(this->Slope, node.Axis)) * node.Thickness);
  }

  Vec3 R;
  double R2, CosA, CosB;
  double TurnA = 0.0, TurnB = 0.0;
  Vec3 Slope;
};

/// The unoccluded exchange of two clusters by a rule on both.
struct ClusterEstimate
{
  double Exchange = 0.0; // S = int int k, m^2
  double Slope = 0.0;    // t of ExchangeSlope: 1, or less where the exchange would become negative
  // Root mean square of what the linear model misses, relative to the mean:
  double SpreadA = 0.0; // of means over b, at places of a
  double SpreadB = 0.0; // of means over a, at places of b
  double Both = 0.0;    // of pairs of points of the rule
};

/// A rule of 3 to 6 points a cluster: an element's inner points, a cluster's grandchildren moved
/// outward to the places where the rule is exact to the third degree for parts of one shape.
/// Clusters should be farther apart than their sizes.
ClusterEstimate EstimateExchange(
  const ElementTree& tree, const ElementSet& elements, std::int32_t a, std::int32_t b);

} // namespace radiometry
