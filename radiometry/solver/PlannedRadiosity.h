// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/accuracy/RunCost.h"
#include "radiometry/effects/SceneEffects.h"
#include "radiometry/irradiance/LightVisibility.h"
#include "radiometry/solver/RadiosityCache.h"
#include "radiometry/solver/RadiositySimulation.h"

#include <array>
#include <vector>

namespace radiometry
{

/// A radiosity run with its effect plan and its values at points.
struct PlannedRadiosity
{
  RadiosityResult Cells;
  std::array<FieldValues, 2> PointIrradiance; // front, back; as the points that were asked for
  std::array<FieldValues, 2> PointRadiosity;
  std::vector<EffectDecision> Effects; // by Effect
  RunCost Cost;
  std::array<LightShares, 2> CellVisibility; // empty unless asked for
  std::array<LightShares, 2> PointVisibility;
};

/// Plans the effects of a scene, simulates those it calls for and bounds those left out.
/// `options`' effect flags are set by the plan. Sensors (points without a triangle) have no
/// radiosity: theirs is 0. `cache` (may be null): what the run before left, and what this leaves.
PlannedRadiosity SimulatePlannedRadiosity(const Scene& scene,
  const std::vector<SurfacePoint>& points, bool cells, const std::vector<EffectSwitch>& switches,
  RadiosityOptions options, Monitor* monitor = nullptr, RadiosityCache* cache = nullptr);

} // namespace radiometry
