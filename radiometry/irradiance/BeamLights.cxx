// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/BeamLights.h"

#include "radiometry/effects/CompiledEffects.h"

#include <algorithm>

namespace radiometry
{

BeamLights::BeamLights(const Scene& scene, const DirectOptions& options)
  : Hides(options.Occlusion && !scene.Triangles.empty())
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
  this->Tree = LightTree(this->Sources, scene.Optics.Bands);
  this->Outlines.resize(this->Size());
  this->Cutters.resize(this->Size());
}

BeamLights::BeamLights(const Scene& scene, const OcclusionScene& occluders,
  const DirectOptions& options, bool shadows, const StageProgress& stage)
  : BeamLights(scene, options)
{
  this->FindShadows(scene, occluders, options, shadows, stage);
}

void BeamLights::FindShadows(const Scene& scene, const OcclusionScene& occluders,
  const DirectOptions& options, bool lines, const StageProgress& stage)
{
  if (!this->Hides || this->Size() == 0)
  {
    return;
  }
  occluders.Prepare();
  this->Lines = lines ? &occluders.Lines(scene, options.Threads, stage) : nullptr;
  const int bands = Compiled(Effect::Transmission) && options.Transmission && occluders.HasPanes()
    ? scene.Optics.Bands
    : 0;
  for (std::size_t k = 0; k < this->Size(); ++k)
  {
    this->Outlines[k] = lines
      ? std::make_unique<Silhouettes>(scene, *this->Lines, this->Sources[k]->GetLight())
      : nullptr;
    this->Cutters[k] = std::make_unique<ShadowCutter>(
      *this->Sources[k], this->Outlines[k].get(), occluders, bands);
  }
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
