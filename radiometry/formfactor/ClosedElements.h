// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/irradiance/ExchangeOptions.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// For each element 1 where it seems to see nothing but receiving elements: all of 64 rays from it,
/// spread by the cosine, met one. Over ranks each asks for its own share; the answer is everyone's.
///   Limits  an opening that fills less than some hundredth of the hemisphere may be missed: a row
///           that lacks more than its own error is open all the same
///   Cost    at most 64 rays an element, fewer where it is open
std::vector<std::uint8_t> FindClosedElements(const OcclusionScene& occluders,
  const ElementSet& elements, const ExchangeOptions& options, const StageProgress& stage = {});

} // namespace radiometry
