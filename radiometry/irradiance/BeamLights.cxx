// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/BeamLights.h"

#include "radiometry/effects/CompiledEffects.h"

#include <algorithm>

namespace radiometry
{

BeamLights::BeamLights(const Scene& scene, const OcclusionScene& occluders,
  const DirectOptions& options, bool shadows, const StageProgress& stage)
{
  for (std::size_t k = 0; k < scene.Lights.size(); ++k)
  {
    const Light& light = scene.Lights[k];
    if (options.Takes(k) && light.Enabled && light.Type != LightType::Area && light.Type != LightType::Environment &&
      Magnitude(light) > 0.0)
    {
      this->Sources.push_back(
        std::make_unique<SourceFlux>(light, options.SpotShape, options.Attenuation));
    }
  }
  if (shadows && options.Occlusion && !scene.Triangles.empty() && this->Size() > 0)
  {
    this->Lines = &occluders.Lines(scene, options.Threads, stage);
  }
  for (const std::unique_ptr<SourceFlux>& source : this->Sources)
  {
    this->Outlines.push_back(
      this->Lines ? std::make_unique<Silhouettes>(scene, *this->Lines, source->GetLight()) : nullptr);
    this->Cutters.push_back(std::make_unique<ShadowCutter>(*source, this->Outlines.back().get(),
      occluders,
      Compiled(Effect::Transmission) && options.Transmission && occluders.HasPanes()
        ? scene.Optics.Bands
        : 0));
  }
  this->Tree = LightTree(this->Sources, scene.Optics.Bands);
}

double Magnitude(const Light& light)
{
  return light.Intensity.empty()
    ? 0.0
    : *std::max_element(light.Intensity.begin(), light.Intensity.end());
}

double Extent(const Scene& scene)
{
  double extent = Length(scene.Origin);
  for (const Vec3& p : scene.Points)
  {
    extent = std::max({ extent, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z) });
  }
  return extent;
}

} // namespace radiometry
