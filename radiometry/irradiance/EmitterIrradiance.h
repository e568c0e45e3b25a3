// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/AreaSources.h"
#include "radiometry/irradiance/ExchangeOptions.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// Layout: receiver by receiver, band by band.
struct EmitterResult
{
  std::vector<double> Irradiance; // W/m^2
  std::vector<double> Error;      // as that of direct light: at least 95 % of values within it
  std::int64_t Rays = 0;
  bool TimedOut = false; // some are coarser for want of time
};

/// What arrives at patches, averaged over each, straight from emitting patches: as from area lights
/// (AreaReceiver), for callers that choose the emitters. With options.SecondsLeft first coarsely, then
/// as exactly as there is time for; what there was none for is half of what nothing hides, with an error
/// of half.
EmitterResult ComputeEmitterIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& receivers, const EmitterSet& emitters, const ExchangeOptions& options,
  const StageProgress& stage = {});

/// The same at points about their normals.
EmitterResult ComputeEmitterIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const EmitterSet& emitters,
  const ExchangeOptions& options, const StageProgress& stage = {});

} // namespace radiometry
