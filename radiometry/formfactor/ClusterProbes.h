// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementTree.h"
#include "radiometry/irradiance/ExchangeOptions.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// What rays from an element meet: pairs of rays from 4 to 128 points of it (the fewer the more
/// elements there are), opposite about the normal, spread by the cosine.
struct ClusterProbes
{
  ClusterProbes(const OcclusionScene& occluders, const ElementSet& elements,
    const ExchangeOptions& options, const StageProgress& stage);

  /// For each element where points lie within a body, as where something stands on it (both rays
  /// of a point meet sides that do not receive): 0 nowhere, 1 on a part, 2 everywhere. All 0 where
  /// more than a third of the elements would be in part: then sheets were met from behind.
  std::vector<std::uint8_t> Covered;
  /// Of all rays, weighted by area, how many met a receiving element: the mean row sum, about.
  double Share = 1.0;
  /// 1 for elements that seem to see nothing but receiving elements: all of some 64 rays from it
  /// and its neighbours in the tree met one.
  std::vector<std::uint8_t> Closed(const ElementTree& tree) const;

private:
  std::vector<std::uint8_t> Missed; // 1: a ray met no receiving element
  int Rays = 0;                     // of each element
};

} // namespace radiometry
