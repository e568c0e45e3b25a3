// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/solver/RadiositySimulation.h"
#include "tests/core/Calibration.h"
#include "tests/core/solver/RadiosityScenes.h"

#include <map>
#include <string>
#include <vector>

namespace test
{

/// The methods that are judged, by name.
const std::map<std::string, radiometry::RadiosityMethod>& RadiosityMethods();

/// The irradiance of a run beside the references of its scene. `result`: the run's, unless null.
std::vector<Judged> JudgeRadiosity(const RadiosityScene& scene,
  const std::vector<RadiosityReference>& references, const radiometry::RadiosityOptions& options,
  radiometry::RadiosityResult* result = nullptr);

} // namespace test
