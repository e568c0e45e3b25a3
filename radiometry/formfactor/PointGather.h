// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/irradiance/ExchangeOptions.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <vector>

namespace radiometry
{

struct GatherResult
{
  std::vector<double> Irradiance; // points x bands, W/m^2
  std::vector<double> Error;      // standard error
  std::int64_t Rays = 0;
};

/// Irradiance at points from elements of known radiosity, by cosine-weighted rays about their
/// normals (final gather).
/// `radiosityError` is the standard error of each element's radiosity, independent of the others':
/// it counts for points that see few elements.
///   Error   spread of eight scrambled sequences, the larger of the last two estimates; the
///           sequences are continued until both are some half of the tolerance, or 8 x 512 rays
///   Time    past options.SecondsLeft (above 0) each point has 8 x 4 rays, if it has none yet
GatherResult GatherAtPoints(const Scene& scene, const OcclusionScene& occluders,
  const ElementSet& elements, const std::vector<double>& radiosity,
  const std::vector<double>& radiosityError, int bands, const std::vector<SurfacePoint>& points,
  double absoluteTolerance, const ExchangeOptions& options, const StageProgress& stage = {});

} // namespace radiometry
