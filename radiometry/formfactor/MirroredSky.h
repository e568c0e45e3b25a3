// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/irradiance/SpecularSources.h"
#include "radiometry/irradiance/SpecularSurfaces.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <vector>

namespace radiometry
{

/// Adds the light of environment lights that comes over mirrors and glossy surfaces.
///   Model   E = int pi L(w') over cosine-weighted directions, followed over the surfaces (PathFollower.h)
///           until the path leaves the scene along w' after one reflection at least
///   Error   2.7 standard deviations of eight scrambled sequences, continued until half of the
///           tolerance is met, or 8 x 512 rays
///   Cost    64 to 4096 paths an element or point; nothing without an environment light
void AddMirroredSky(const Scene& scene, const OcclusionScene& occluders, const ElementSet& elements,
  const SpecularSurfaces& surfaces, const SpecularLightOptions& options, const StageProgress& stage,
  std::vector<double>& values, std::vector<double>& errors);
void AddMirroredSky(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const SpecularSurfaces& surfaces,
  const SpecularLightOptions& options, const StageProgress& stage, std::vector<double>& values,
  std::vector<double>& errors);

} // namespace radiometry
