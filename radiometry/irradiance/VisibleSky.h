// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/SkyTable.h"
#include "radiometry/visibility/PointStarts.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// A flat receiver of sky light: a patch, or a point about its normal.
struct SkyReceiver
{
  Vec3 Normal;                    // unit
  Triangle3 Corners;              // of a patch; the first alone: a point
  std::size_t Count = 3;          // of them
  std::int32_t Triangle = -1;     // on whose plane a patch lies
  std::vector<PointStart> Starts; // of the rays of a point

  /// Where a ray begins, from two numbers in [0, 1); false where a point has no face on that side.
  bool Start(double u, double v, const Vec3& direction, RayEnd& end) const;
};

/// Visible share of what a sky sends to a receiver, per band (one where no band differs).
struct VisibleShare
{
  std::vector<double> Value;
  std::vector<double> Error;
  std::int64_t Rays = 0;
  bool AllHidden = true;
};

/// Estimates it by rays: a pilot run of `samples`/4 finds out in which directions something begins
/// or ends, and up to half of `samples` goes there; the rest everywhere.
///   Model   v = sum_k c_k/S + mean of w (V - c), c_k the pilot's guess in each of S equal parts of
///           the light and w the weight of the sample: without bias whatever the guess, without
///           noise where it is right
///   Error   2.5 standard deviations of 16 independent batches, and 2 over the rays that went
///           everywhere
///   Bytes   from `key` alone
void FindVisibleShare(const OcclusionScene& occluders, const SkyTable& table,
  const SkyReceiver& receiver, bool panes, std::uint64_t key, int samples, VisibleShare& share);

} // namespace radiometry
