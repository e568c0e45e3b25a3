// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/AreaIrradiance.h"

namespace radiometry
{

void AddAreaIrradiance(const Scene&, const OcclusionScene&, const std::vector<Patch>&,
  const DirectOptions&, const StageProgress&, ConvergenceRecord*, DirectResult&)
{
}

void AddAreaIrradiance(const Scene&, const OcclusionScene&, const std::vector<SurfacePoint>&,
  const DirectOptions&, const StageProgress&, ConvergenceRecord*, DirectResult&)
{
}

} // namespace radiometry
