// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/DirectKind.h"

#include <memory>

namespace radiometry
{

/// The light of sources that reach a point from one direction: point, spot, luminaire with a candela
/// web, directional.
///   Model   E = (1/A) sum_k int V_k I_k(w) cos(theta)/r^2 dA
///   Exact   (rounding error only) for every light of physical attenuation on a patch that no
///           silhouette edge crosses as seen from the light; refined to the tolerance elsewhere
///   Cost    O(patches x lights) closed forms and one ray each, times log(occluders); what shadows
///           need is built only where a light reaches a patch
/// Null: there is no such light. `seconds`: what building may take; 0: no limit. Beyond that half of
/// each light is taken, with an error of half.
std::unique_ptr<DirectKind> MakeBeams(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const ReceiverGroups& groups, const DirectOptions& options,
  DirectFields& fields, const StageProgress& stage, double seconds);

/// The same at points, about their normals.
std::unique_ptr<DirectKind> MakeBeams(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const ReceiverGroups& groups,
  const DirectOptions& options, DirectFields& fields, const StageProgress& stage, double seconds);

/// The places in the order of a curve that fills space: runs of them are neighbours.
std::vector<std::uint32_t> SpatialOrder(const std::vector<Vec3>& places);

/// Neighbouring points in groups whose light is computed together.
ReceiverGroups PointGroups(const std::vector<SurfacePoint>& points);

} // namespace radiometry
