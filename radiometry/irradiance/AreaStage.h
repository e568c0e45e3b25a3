// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/AreaReceiver.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace radiometry
{

/// All that the light of area sources on a scene needs, made once: then any receiver may be asked
/// for, from any thread.
class AreaStage
{
public:
  /// `transmission`: panes let their share through; else they are opaque.
  AreaStage(const Scene& scene, const OcclusionScene& occluders, const AreaSources& sources,
    bool occlusion, bool transmission, std::uint64_t seed = 0);

  /// `index` of the receiver keys its samples.
  AreaLight At(const Patch& patch, std::size_t index, const double* before,
    const AreaEffort& effort) const;
  AreaLight At(const SurfacePoint& point, std::size_t index, const double* before,
    const AreaEffort& effort) const;

private:
  template <class Ask>
  AreaLight Gather(const Ask& ask) const;
  std::vector<ViewPoint> Places(const SurfacePoint& point) const;

  const Scene& Geometry;
  const OcclusionScene& Occluders;
  std::unique_ptr<Blockers> Blocking; // null: nothing hides anything
  // One, or where panes let light through one for all bands that they treat alike.
  std::vector<std::unique_ptr<SourceView>> Views;
  std::vector<AreaReceiver> Receivers;
  std::vector<std::size_t> ViewOfBand;
  std::uint64_t Seed;
};

} // namespace radiometry
