// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/DirectKind.h"

#include <memory>

namespace radiometry
{

/// The light of environment lights.
///   Model   E_s v with E_s the irradiance with nothing in the way and v the visible share of it
///   Exact   where a proof shows that nothing stands in the way (OpenSides): no rays. What is small
///           beside what is there already is left out without one
///   Else    v by rays (VisibleSky), in rounds until the tolerance is met
/// Null: there is none.
std::unique_ptr<DirectKind> MakeSkies(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const DirectOptions& options, DirectFields& fields,
  const StageProgress& stage, double seconds);

/// The same at points, about their normals.
std::unique_ptr<DirectKind> MakeSkies(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const DirectOptions& options, DirectFields& fields,
  const StageProgress& stage, double seconds);

/// No plane gets more from all skies of the scene, in any band (W/m^2).
double GreatestSkyIrradiance(const Scene& scene);

} // namespace radiometry
