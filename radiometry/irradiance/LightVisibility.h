// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/DirectIrradiance.h"

#include <array>
#include <vector>

namespace radiometry
{

/// Lights that a table of visibility has room for.
inline constexpr std::size_t MostVisibleLights = 64;

/// How much of each light arrives: values x lights, in the order of Scene::Lights.
using LightShares = std::vector<float>;

/// Fails with InputError{"LightVisibility"} where the scene has more lights than there is room for.
void CheckLightVisibility(const Scene& scene);

/// For each light alone the share in [0, 1] of its unoccluded irradiance that arrives: of front and
/// back (where there are patches of it) of each of `items` cells or pieces (Patch::Cell).
///   Model   V_k = int V E_k dA / int E_k dA, all bands together; lights that are disabled or do not
///           reach an item: 0; not hidden: exactly 1
///   Exact   where DirectIrradiance.h says that light is; else to its tolerance
///   Time    with SecondsLeft each light gets an equal part; what is not done in time counts half
///   Cost    that of the irradiance by each light alone; lights x items x 4 bytes
///   Ranks   collective; the same bytes as of one process
std::array<LightShares, 2> FindLightVisibility(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, std::size_t items, const DirectOptions& options,
  const StageProgress& stage = {});

/// The same at points, about their normals.
LightShares FindLightVisibility(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const DirectOptions& options,
  const StageProgress& stage = {});

} // namespace radiometry
