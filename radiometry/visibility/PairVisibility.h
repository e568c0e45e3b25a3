// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/PairExchange.h"
#include "radiometry/visibility/OcclusionScene.h"
#include "radiometry/visibility/PatchBlockers.h"

#include <cstdint>

namespace radiometry
{

/// The share of an exchange that arrives in spite of what stands between.
struct PairVisibilityResult
{
  double Fraction = 1.0;
  double Error = 0.0; // standard error
  int Rays = 0;
};

/// How many points a sampled pair gets.
struct PairSampling
{
  std::uint64_t Key = 0; // of the scrambled sequences
  int First = 16;        // points in all at first
  int Most = 4096;       // and at most
  double Wanted = 0.0;   // standard error to stop at
};

/// Samples the visible fraction of the exchange between two patches as a ratio estimator
/// V = sum k v / sum k over points of both patches, k the exchange kernel: without noise where all
/// is visible or nothing.
///   Points  four shifted sequences (for the error) keyed on `key`; at first `first` points in all;
///           where these disagree, twice as many until the error is below `wanted`, at most `most`
///   Error   standard error: from the spread of the four sequences and, against luck, that of
///           independent points; where all n points agree, sqrt(2/((n+2)(n+3))), the spread of V
///           given that (uniform prior; n counts points by their weights). Twice the error holds the
///           true V in 97 to 99 % of pairs that something may stand between
///   Cost    a segment asked of OcclusionScene a point, 0.3 us
PairVisibilityResult PairVisibility(const OcclusionScene& scene, const ExchangePatch& a,
  std::int32_t triangleA, const ExchangePatch& b, std::int32_t triangleB, std::uint64_t key,
  int first, int most, double wanted);

/// The same between patches of which the candidates between are known: asks these where they are
/// few, the scene where they are many or were not all kept.
PairVisibilityResult PairVisibility(const OcclusionScene& scene, const PatchBlockers& blockers,
  const PlacedPatch& a, const PlacedPatch& b, const PatchBlockers::Candidates& between,
  const PairSampling& sampling);

} // namespace radiometry
