// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/PairExchange.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <cstdint>

namespace radiometry
{

/// The share of an exchange that arrives in spite of what stands between.
struct PairVisibilityResult
{
  double Fraction = 1.0;
  double Error = 0.0; // standard error; 0 where all rays agreed
  int Rays = 0;
};

/// Samples the visible fraction of the exchange between two patches as a ratio estimator
/// V = sum k v / sum k over points of both patches, k the exchange kernel: without noise where all
/// is visible or nothing.
///   Points  four independent scrambled sequences (for the error) keyed on `key`; at first `first`
///           points in all; where these disagree, twice as many until the error is below
///           `wanted`, at most `most`
///   Error   the spread of the four sequences, and the mean square of what pairs of the same kind
///           hide from the first points (uniform prior of V)
PairVisibilityResult PairVisibility(const OcclusionScene& scene, const ExchangePatch& a,
  std::int32_t triangleA, const ExchangePatch& b, std::int32_t triangleB, std::uint64_t key,
  int first, int most, double wanted);

} // namespace radiometry
