// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/LightVisibility.h"

#include "radiometry/accuracy/ConvergenceRecord.h"
#include "radiometry/scene/InputError.h"

#include <algorithm>
#include <string>

namespace radiometry
{
namespace
{

/// What rounding may take from light that nothing hides.
constexpr double Rounding = 1e-9;

float Share(double arrived, double open)
{
  if (!(open > 0.0))
  {
    return 0.0f;
  }
  return arrived >= (1.0 - Rounding) * open ? 1.0f
                                            : static_cast<float>(std::max(0.0, arrived / open));
}

/// Calls take(light, arrived, open) for each light that shines, with its irradiance alone, hidden and
/// not hidden, summed over the bands, a value a receiver.
template <typename Receivers, typename Take>
void ForEachLight(const Scene& scene, const OcclusionScene& occluders, const Receivers& receivers,
  const DirectOptions& options, const StageProgress& stage, const Take& take)
{
  const ConvergenceRecord clock;
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  const auto sum = [bands](const std::vector<double>& values) {
    std::vector<double> sums(values.size() / bands, 0.0);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      sums[i / bands] += values[i];
    }
    return sums;
  };
  const std::size_t lights = scene.Lights.size();
  for (std::size_t k = 0; k < lights; ++k)
  {
    if (!scene.Lights[k].Enabled)
    {
      continue;
    }
    StageProgress part = stage;
    const double span = (stage.End - stage.Begin) / static_cast<double>(lights);
    part.Begin = stage.Begin + span * static_cast<double>(k);
    part.End = part.Begin + span;
    DirectOptions alone = options;
    alone.OnlyLight = static_cast<std::ptrdiff_t>(k);
    alone.Emission = false;
    if (options.SecondsLeft > 0.0)
    {
      alone.SecondsLeft = std::max(
        1e-9, (options.SecondsLeft - clock.Elapsed()) / static_cast<double>(lights - k));
    }
    const std::vector<double> arrived =
      sum(ComputeDirectIrradiance(scene, occluders, receivers, alone, part).Irradiance);
    if (!options.Occlusion)
    {
      take(k, arrived, arrived);
      continue;
    }
    alone.Occlusion = false;
    alone.SecondsLeft = 0.0;
    take(k, arrived,
      sum(ComputeDirectIrradiance(
        scene, occluders, receivers, alone, { stage.Listener, part.End, part.End, stage.Name })
            .Irradiance));
  }
}

} // namespace

void CheckLightVisibility(const Scene& scene)
{
  if (scene.Lights.size() > MostVisibleLights)
  {
    throw InputError("LightVisibility", -1, std::to_string(scene.Lights.size()) + " lights",
      "at most " + std::to_string(MostVisibleLights) + " lights, or LightVisibility off");
  }
}

std::array<LightShares, 2> FindLightVisibility(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<Patch>& patches, std::size_t items, const DirectOptions& options,
  const StageProgress& stage)
{
  CheckLightVisibility(scene);
  const std::size_t lights = scene.Lights.size();
  std::array<LightShares, 2> shares;
  for (const Patch& patch : patches)
  {
    shares[patch.Side].resize(items * lights, 0.0f);
  }
  ForEachLight(scene, occluders, patches, options, stage,
    [&](std::size_t light, const std::vector<double>& arrived, const std::vector<double>& open) {
      std::array<std::vector<double>, 2> got{ std::vector<double>(items, 0.0),
        std::vector<double>(items, 0.0) };
      std::array<std::vector<double>, 2> all = got;
      for (std::size_t i = 0; i < patches.size(); ++i)
      {
        const double area = Area(patches[i].Corners);
        got[patches[i].Side][static_cast<std::size_t>(patches[i].Cell)] += area * arrived[i];
        all[patches[i].Side][static_cast<std::size_t>(patches[i].Cell)] += area * open[i];
      }
      for (std::size_t side = 0; side < 2; ++side)
      {
        for (std::size_t i = 0; i < items && !shares[side].empty(); ++i)
        {
          shares[side][i * lights + light] = Share(got[side][i], all[side][i]);
        }
      }
    });
  return shares;
}

LightShares FindLightVisibility(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, const DirectOptions& options, const StageProgress& stage)
{
  CheckLightVisibility(scene);
  const std::size_t lights = scene.Lights.size();
  LightShares shares(points.size() * lights, 0.0f);
  ForEachLight(scene, occluders, points, options, stage,
    [&](std::size_t light, const std::vector<double>& arrived, const std::vector<double>& open) {
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        shares[i * lights + light] = Share(arrived[i], open[i]);
      }
    });
  return shares;
}

} // namespace radiometry
