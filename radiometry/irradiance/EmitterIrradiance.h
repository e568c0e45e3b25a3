// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/ExchangeOptions.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// Emitting patches as lights.
struct EmitterSet
{
  int Bands = 1;
  std::vector<Patch> Patches;
  std::vector<double> Exitance; // patches x bands, W/m^2

  bool Empty() const { return this->Patches.empty(); }
};

/// Layout: receiver by receiver, band by band.
struct EmitterResult
{
  std::vector<double> Irradiance;      // W/m^2
  std::vector<double> GeometryError;   // of the unoccluded exchange
  std::vector<double> VisibilityError; // standard error
  std::int64_t Rays = 0;
};

/// What arrives at patches, averaged over each, straight from emitting patches.
///   Model   E_i = sum_j M_j V_ij S_ij/A_i: S by PairExchange, V by PairVisibility, with rays
///           until a pair's part of the error is small beside the tolerance
///   Cost    receivers x emitters pairs, 4 to 4096 rays each; no noise where nothing hides
EmitterResult ComputeEmitterIrradiance(const OcclusionScene& occluders,
  const std::vector<Patch>& receivers, const EmitterSet& emitters, const ExchangeOptions& options,
  const StageProgress& stage = {});

/// The same at points about their normals: closed form to each emitter, one end of the rays fixed.
EmitterResult ComputeEmitterIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const EmitterSet& emitters,
  const ExchangeOptions& options, const StageProgress& stage = {});

} // namespace radiometry
