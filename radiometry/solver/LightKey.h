// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/GeometryKey.h"
#include "radiometry/solver/RadiositySimulation.h"

namespace radiometry
{

/// What a solution depends on beside geometry, tolerances and method: lights, optics and the effects
/// that are simulated.
ContentKey KeyOfLight(const Scene& scene, const RadiosityOptions& options);

} // namespace radiometry
