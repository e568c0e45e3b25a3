// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/DirectIrradiance.h"
#include "radiometry/irradiance/LightTree.h"
#include "radiometry/irradiance/ShadowCutter.h"

#include <memory>
#include <vector>

namespace radiometry
{

/// The enabled lights of a scene whose light reaches a point from one direction, ready to be asked.
///   Cost  O(lights log(lights)); the lines of the scene are found once a geometry
class BeamLights
{
public:
  /// The lights alone, without what may hide them; Tree is there.
  BeamLights(const Scene& scene, const DirectOptions& options);
  /// ... and what rays need; with `shadows` the lines that bound them, too.
  BeamLights(const Scene& scene, const OcclusionScene& occluders, const DirectOptions& options,
    bool shadows, const StageProgress& stage);
  /// Finds that for lights made without.
  void FindShadows(const Scene& scene, const OcclusionScene& occluders,
    const DirectOptions& options, bool lines, const StageProgress& stage);

  std::size_t Size() const { return this->Sources.size(); }

  bool Hides = false;                 // surfaces may hide them
  const ShadowLines* Lines = nullptr; // null: nothing hides anything, or there is no time to look
  std::vector<std::unique_ptr<SourceFlux>> Sources;
  std::vector<std::unique_ptr<Silhouettes>> Outlines; // null without Lines
  std::vector<std::unique_ptr<ShadowCutter>> Cutters; // null where nothing is asked of them
  LightTree Tree;
};

/// The intensity of a light in its strongest band.
double Magnitude(const Light& light);

/// The largest coordinate that the scene's numbers were computed with, m.
double Extent(const Scene& scene);

} // namespace radiometry
