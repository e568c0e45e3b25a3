// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Scene.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <cstdint>
#include <vector>

namespace test
{

struct PathEstimate
{
  std::vector<double> Irradiance; // per band, averaged over the cell's side, W/m^2
  std::vector<double> Error;      // standard error, from independent batches
};

/// Irradiance of one side of a cell of one triangle by brute force: paths of reflection (diffuse, by
/// the Phong lobe, by mirrors) and transmission (diffuse, straight through panes) from stratified
/// points, light sources asked at every vertex. It asks the scene what a ray meets and shares nothing
/// else with the operators: no elements, no solve, other random numbers. Knows point, directional
/// and environment lights and emitting cells; what point and directional lights send over mirrors it
/// does not see.
/// Where lamps stand so near a surface that few paths carry most of the light, its error is as
/// unsure as its value.
PathEstimate IrradianceByPaths(const radiometry::Scene& scene,
  const radiometry::OcclusionScene& occluders, std::size_t cell, int side, int strata,
  std::uint64_t seed);

/// ... at the cell's centroid.
PathEstimate IrradianceOfCentroid(const radiometry::Scene& scene,
  const radiometry::OcclusionScene& occluders, std::size_t cell, int side, int strata,
  std::uint64_t seed);

} // namespace test
