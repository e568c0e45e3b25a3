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

/// The irradiance of a run beside the references of its scene. `result`: the run's, unless null;
/// `gathered`: the same at cells' centroids, by final gather, unless null.
std::vector<Judged> JudgeRadiosity(const RadiosityScene& scene,
  const std::vector<RadiosityReference>& references, const radiometry::RadiosityOptions& options,
  radiometry::RadiosityResult* result = nullptr, std::vector<Judged>* gathered = nullptr);

/// What falls through a hole of a thousandth to a tenth of a wall into a black room.
std::vector<Judged> JudgePinhole(radiometry::RadiosityMethod method, std::uint64_t seed);

} // namespace test
