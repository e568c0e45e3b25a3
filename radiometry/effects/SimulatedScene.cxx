// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/effects/SimulatedScene.h"

#include "radiometry/scene/SkyRadiance.h"

#include <algorithm>
#include <numeric>

namespace radiometry
{
namespace
{

/// Calls f(values, items) for every array of a scene that depends on the band.
template <class AScene, class Function>
void ForBandArrays(AScene& scene, const Function& f)
{
  for (std::size_t side = 0; side < 2; ++side)
  {
    f(scene.Optics.DiffuseReflectance[side]);
    f(scene.Optics.SpecularReflectance[side]);
    f(scene.Optics.EmittedExitance[side]);
  }
  f(scene.Optics.Transmittance);
  f(scene.Optics.DiffuseTransmittance);
  f(scene.TriangleTransmittance);
  f(scene.GlobalAmbient);
  for (auto& light : scene.Lights)
  {
    f(light.Intensity);
  }
}

bool Equal(const std::vector<double>& values, std::size_t bands, std::size_t a, std::size_t b)
{
  for (std::size_t i = 0; i + bands <= values.size(); i += bands)
  {
    if (values[i + a] != values[i + b])
    {
      return false;
    }
  }
  return true;
}

/// Whether two bands are the same in all that depends on the band. An array of another width (one
/// number for all bands) is the same in all.
bool SameBands(const Scene& scene, std::size_t a, std::size_t b)
{
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  bool same = true;
  ForBandArrays(scene, [&](const std::vector<double>& values) {
    same = same && Equal(values, bands, a, b);
  });
  for (std::size_t k = 0; same && k < scene.Lights.size(); ++k)
  {
    const SkyRadiance* sky = scene.Lights[k].Environment.get();
    same = !sky || sky->Bands() <= 1 ||
      Equal(sky->Values(), static_cast<std::size_t>(sky->Bands()), a, b);
  }
  return same;
}

/// Of each item one number for each group: that of its first band, or the mean of all bands.
void Narrow(std::vector<double>& values, const BandGroups& groups, bool grey)
{
  const std::size_t bands = groups.Bands();
  const std::size_t items = values.size() / bands;
  if (items * bands != values.size())
  {
    return;
  }
  const std::size_t width = grey ? 1 : groups.Size();
  for (std::size_t i = 0; i < items; ++i)
  {
    if (grey)
    {
      const double* first = values.data() + i * bands;
      values[i] = std::accumulate(first, first + bands, 0.0) / static_cast<double>(bands);
      continue;
    }
    for (std::size_t g = 0; g < width; ++g)
    {
      values[i * width + g] = values[i * bands + static_cast<std::size_t>(groups.Firsts[g])];
    }
  }
  values.resize(items * width);
}

/// The product of a light's intensity and its map is what has a band: of a grey map both are means of
/// the products.
std::shared_ptr<const SkyRadiance> NarrowSky(
  Light& light, const BandGroups& groups, bool grey)
{
  const SkyRadiance& sky = *light.Environment;
  std::vector<double> values = sky.Values();
  if (grey)
  {
    for (std::size_t k = 0; k < values.size(); ++k)
    {
      values[k] *= light.Intensity[k % light.Intensity.size()];
    }
    light.Intensity.assign(light.Intensity.size(), 1.0);
  }
  Narrow(values, groups, grey);
  return SkyRadiance::Map(
    sky.Width(), sky.Height(), grey ? 1 : static_cast<int>(groups.Size()), std::move(values));
}

} // namespace

BandGroups SingleBands(int bands)
{
  BandGroups groups;
  groups.Group.resize(static_cast<std::size_t>(bands));
  std::iota(groups.Group.begin(), groups.Group.end(), 0);
  groups.Firsts = groups.Group;
  return groups;
}

BandGroups FindBandGroups(const Scene& scene)
{
  BandGroups groups;
  for (int b = 0; b < scene.Optics.Bands; ++b)
  {
    const auto same = std::find_if(groups.Firsts.begin(), groups.Firsts.end(), [&](int first) {
      return SameBands(scene, static_cast<std::size_t>(first), static_cast<std::size_t>(b));
    });
    groups.Group.push_back(static_cast<int>(same - groups.Firsts.begin()));
    if (same == groups.Firsts.end())
    {
      groups.Firsts.push_back(b);
    }
  }
  return groups;
}

const std::vector<double>& OfSide(
  const std::array<std::vector<double>, 2>& sides, std::size_t side)
{
  return sides[side].empty() ? sides[0] : sides[side];
}

bool IsMirror(const Materials& optics, std::size_t side, std::size_t cell)
{
  const auto bands = static_cast<std::size_t>(optics.Bands);
  const std::vector<double>& specular = OfSide(optics.SpecularReflectance, side);
  const std::vector<double>& shininess = OfSide(optics.Shininess, side);
  if (specular.empty() || shininess.empty() || shininess[cell] < MirrorShininess)
  {
    return false;
  }
  const double* first = specular.data() + cell * bands;
  return std::any_of(first, first + bands, [](double rho) { return rho > 0.0; });
}

Scene ReduceScene(const Scene& scene, const SceneParts& parts, const BandGroups& groups)
{
  Scene reduced = scene;
  for (Light& light : reduced.Lights)
  {
    light.Enabled =
      light.Enabled && !parts.WithoutLights[static_cast<std::size_t>(light.Type)];
    if (parts.WithoutWebs)
    {
      light.Web = nullptr;
    }
  }
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  for (std::size_t side = 0; side < 2 && parts.WithoutMirrors; ++side)
  {
    std::vector<double>& specular = reduced.Optics.SpecularReflectance[side];
    specular = OfSide(scene.Optics.SpecularReflectance, side);
    for (std::size_t cell = 0; cell < scene.Cells && !specular.empty(); ++cell)
    {
      if (IsMirror(scene.Optics, side, cell))
      {
        std::fill_n(specular.begin() + static_cast<std::ptrdiff_t>(cell * bands), bands, 0.0);
      }
    }
  }
  if (groups.AllApart() && !parts.Grey)
  {
    return reduced;
  }
  for (Light& light : reduced.Lights)
  {
    if (light.Environment && light.Environment->Bands() > 1)
    {
      light.Environment = NarrowSky(light, groups, parts.Grey);
    }
  }
  ForBandArrays(
    reduced, [&](std::vector<double>& values) { Narrow(values, groups, parts.Grey); });
  reduced.Optics.Bands = parts.Grey ? 1 : static_cast<int>(groups.Size());
  return reduced;
}

std::vector<double> SpreadBands(std::vector<double> values, const BandGroups& groups)
{
  const std::size_t width = groups.Size();
  if (groups.AllApart() || values.empty())
  {
    return values;
  }
  const std::size_t items = values.size() / width;
  std::vector<double> all(items * groups.Bands());
  for (std::size_t i = 0; i < items; ++i)
  {
    for (std::size_t b = 0; b < groups.Bands(); ++b)
    {
      all[i * groups.Bands() + b] = values[i * width + static_cast<std::size_t>(groups.Group[b])];
    }
  }
  return all;
}

} // namespace radiometry
