// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/DirectIrradiance.h"

#include "radiometry/irradiance/AreaIrradiance.h"
#include "radiometry/irradiance/BeamIrradiance.h"
#include "radiometry/irradiance/SkyIrradiance.h"
#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

/// Whether the lights of a kind, or emitting surfaces, take part, and so need time.
bool AnyBeam(const Scene& scene)
{
  return std::any_of(scene.Lights.begin(), scene.Lights.end(), [](const Light& l) {
    return l.Enabled && l.Type != LightType::Area && l.Type != LightType::Environment;
  });
}
bool AnyArea(const Scene& scene, const DirectOptions& options)
{
  const auto lit = [](const std::vector<double>& exitance) {
    return std::any_of(exitance.begin(), exitance.end(), [](double m) { return m > 0.0; });
  };
  return std::any_of(scene.Lights.begin(), scene.Lights.end(),
           [](const Light& l) { return l.Enabled && l.Type == LightType::Area; }) ||
    (options.Emission &&
      (lit(scene.Optics.EmittedExitance[0]) || lit(scene.Optics.EmittedExitance[1])));
}
bool AnySky(const Scene& scene, const DirectOptions& options)
{
  return options.Environment &&
    std::any_of(scene.Lights.begin(), scene.Lights.end(),
      [](const Light& l) { return l.Enabled && l.Type == LightType::Environment; });
}

/// What no double holds is an error and never an infinity handed on.
void CheckFinite(const DirectResult& result)
{
  for (std::size_t i = 0; i < result.Irradiance.size(); ++i)
  {
    if (!std::isfinite(result.Irradiance[i]) || !std::isfinite(result.Error[i]))
    {
      throw InputError("Irradiance", static_cast<long long>(i) / result.Bands,
        result.Irradiance[i], "a number below 1e308 W/m^2: less intensity, or lights less near");
    }
  }
}

template <typename Receivers>
DirectResult Compute(const Scene& scene, const OcclusionScene& occluders,
  const Receivers& receivers, const DirectOptions& options, const StageProgress& stage,
  ConvergenceRecord* record)
{
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  const ConvergenceRecord clock;
  DirectResult result;
  result.Bands = scene.Optics.Bands;
  result.Irradiance.assign(receivers.size() * bands, 0.0);
  result.Error.assign(receivers.size() * bands, 0.0);
  if (receivers.empty())
  {
    return result;
  }
  const bool present[3] = { AnyBeam(scene), AnyArea(scene, options), AnySky(scene, options) };
  constexpr double weights[3] = { 1.0, 3.0, 3.0 };
  double total = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    total += present[k] ? weights[k] : 0.0;
  }
  double done = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    if (!present[k])
    {
      continue;
    }
    StageProgress part = stage;
    part.Begin = stage.Begin + (stage.End - stage.Begin) * done / total;
    done += weights[k];
    part.End = stage.Begin + (stage.End - stage.Begin) * done / total;
    DirectOptions now = options;
    if (options.SecondsLeft > 0.0)
    {
      // Its share of what is left; the last one gets all of it.
      const double left = options.SecondsLeft - clock.Elapsed();
      now.SecondsLeft = std::max(1e-9, left * weights[k] / (total - done + weights[k]));
    }
    using Add = void (*)(const Scene&, const OcclusionScene&, const Receivers&,
      const DirectOptions&, const StageProgress&, ConvergenceRecord*, DirectResult&);
    static constexpr Add components[3] = { AddBeamIrradiance, AddAreaIrradiance, AddSkyIrradiance };
    components[k](scene, occluders, receivers, now, part, record, result);
  }
  for (std::size_t i = 0; i < result.Irradiance.size() && !scene.GlobalAmbient.empty(); ++i)
  {
    result.Irradiance[i] += scene.GlobalAmbient[i % bands];
  }
  CheckFinite(result);
  Report(stage.Listener, stage.End, stage.Name);
  return result;
}

} // namespace

DirectResult ComputeDirectIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, const DirectOptions& options, const StageProgress& stage,
  ConvergenceRecord* record)
{
  return Compute(scene, occluders, patches, options, stage, record);
}

DirectResult ComputeDirectIrradiance(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const DirectOptions& options,
  const StageProgress& stage, ConvergenceRecord* record)
{
  return Compute(scene, occluders, points, options, stage, record);
}

void RecordDirect(ConvergenceRecord* record, const DirectResult& result,
  const std::vector<double>& weights, const char* stage)
{
  if (!record)
  {
    return;
  }
  double value = 0.0;
  double error = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    total += weights[i];
    for (int b = 0; b < result.Bands; ++b)
    {
      value += weights[i] * result.Irradiance[i * result.Bands + b];
      error += weights[i] * result.Error[i * result.Bands + b];
    }
  }
  const double mean = total > 0.0 ? error / (total * result.Bands) : 0.0;
  record->Add(stage, value > 0.0 ? error / value : 0.0, mean, result.Rays);
}

} // namespace radiometry
