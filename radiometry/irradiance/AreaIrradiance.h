// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/DirectKind.h"

#include <memory>

namespace radiometry
{

/// The light of area lights and, with DirectOptions::Emission, of emitting surfaces, averaged over
/// each patch (AreaReceiver). Null: there are none.
std::unique_ptr<DirectKind> MakeAreas(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const DirectOptions& options, DirectFields& fields,
  double seconds);

/// The same at points, about their normals.
std::unique_ptr<DirectKind> MakeAreas(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const DirectOptions& options, DirectFields& fields,
  double seconds);

} // namespace radiometry
