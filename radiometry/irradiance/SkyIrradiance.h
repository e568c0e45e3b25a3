// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/DirectIrradiance.h"

namespace radiometry
{

/// Adds the light of environment lights, averaged over each patch.
///   Model   E = (1/A) int_A int_hemisphere V L(w) cos(theta) dw dA = E_open v; E_open in closed
///           form or as an exact sum over the sky's pixels, v the visible share
///   Exact   where nothing of the scene can hide the sky (proved without a ray: OpenSides): v = 1
///   Else    v by rays in directions chosen by radiance times cosine, from points spread over the
///           patch (scrambled Sobol points keyed on the patch; a ratio, so that what is wholly
///           visible has no noise); more of them until the error, 2.5 standard deviations of
///           independent batches and 2 over the number of rays, meets the tolerance
///   Cost    256 rays for a patch that is not open, more where the sky's edge needs them
void AddSkyIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const DirectOptions& options, const StageProgress& stage,
  ConvergenceRecord* record, DirectResult& result);

/// The same at points, about their normals.
void AddSkyIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const DirectOptions& options,
  const StageProgress& stage, ConvergenceRecord* record, DirectResult& result);

/// The greatest irradiance, in any band, that the enabled environment lights can give [W/m^2].
double GreatestSkyIrradiance(const Scene& scene);

} // namespace radiometry
