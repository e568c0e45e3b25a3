// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/SkyIrradiance.h"

namespace radiometry
{

void AddSkyIrradiance(const Scene&, const OcclusionScene&, const std::vector<Patch>&,
  const DirectOptions&, const StageProgress&, ConvergenceRecord*, DirectResult&)
{
}

void AddSkyIrradiance(const Scene&, const OcclusionScene&, const std::vector<SurfacePoint>&,
  const DirectOptions&, const StageProgress&, ConvergenceRecord*, DirectResult&)
{
}

} // namespace radiometry
