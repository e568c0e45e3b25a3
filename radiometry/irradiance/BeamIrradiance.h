// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/DirectIrradiance.h"

namespace radiometry
{

/// Adds the light of sources that reach a point from one direction: point, spot, luminaire with a
/// candela web, directional.
///   Model   E = (1/A) sum_k int V_k I_k(w) cos(theta)/r^2 dA
///   Exact   (rounding error only) for every light of physical attenuation on a patch that no
///           silhouette edge crosses as seen from the light; refined to the tolerance elsewhere
///   Cost    O(patches x lights) closed forms and one ray each, times log(occluders)
void AddBeamIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const DirectOptions& options, const StageProgress& stage,
  ConvergenceRecord* record, DirectResult& result);

/// The same at points, about their normals.
void AddBeamIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const DirectOptions& options,
  const StageProgress& stage, ConvergenceRecord* record, DirectResult& result);

/// Neighbouring points in groups whose light is computed together. With DirectOptions::Numbers the
/// points are in that order already.
void PointGroups(const std::vector<SurfacePoint>& points, std::vector<std::uint32_t>& order,
  std::vector<std::uint32_t>& first);

} // namespace radiometry
