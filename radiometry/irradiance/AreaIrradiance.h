// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/DirectIrradiance.h"

namespace radiometry
{

/// Adds the light of area lights and, with DirectOptions::Emission, of emitting surfaces, averaged over each patch.
void AddAreaIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const DirectOptions& options, const StageProgress& stage,
  ConvergenceRecord* record, DirectResult& result);

/// The same at points, about their normals.
void AddAreaIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const DirectOptions& options,
  const StageProgress& stage, ConvergenceRecord* record, DirectResult& result);

} // namespace radiometry
