// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/SurfaceExitance.h"

#include "radiometry/visibility/Convexity.h"

#include <algorithm>
#include <limits>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

double Greatest(const std::vector<double>& values)
{
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

bool TwoSided(const Materials& optics)
{
  return std::any_of(
    optics.TwoSided.begin(), optics.TwoSided.end(), [](std::uint8_t t) { return t != 0; });
}

} // namespace

DiffuseLight ReflectDiffusely(
  const Scene& scene, const std::array<FieldValues, 2>& irradiance, bool emission)
{
  const Materials& optics = scene.Optics;
  const auto bands = static_cast<std::size_t>(optics.Bands);
  const auto own = [](const std::array<std::vector<double>, 2>& sides, std::size_t side,
                     std::size_t at) {
    const std::vector<double>& values = sides[side].empty() ? sides[0] : sides[side];
    return values.empty() ? 0.0 : values[at];
  };
  DiffuseLight light;
  for (std::size_t side = 0; side < 2; ++side)
  {
    const bool any = side == 0 || !irradiance[1].Values.empty() ||
      std::any_of(optics.TwoSided.begin(), optics.TwoSided.end(), [](auto t) { return t != 0; }) ||
      !optics.DiffuseTransmittance.empty();
    if (!any)
    {
      continue;
    }
    light.Exitance[side].assign(scene.Cells * bands, 0.0);
    light.Error[side].assign(scene.Cells * bands, 0.0);
    for (std::size_t at = 0; at < scene.Cells * bands; ++at)
    {
      const std::size_t cell = at / bands;
      const double through =
        optics.DiffuseTransmittance.empty() ? 0.0 : optics.DiffuseTransmittance[at];
      const bool reflects = side == 0 || (!optics.TwoSided.empty() && optics.TwoSided[cell] != 0);
      double value = reflects && emission ? own(optics.EmittedExitance, side, at) : 0.0;
      double error = 0.0;
      const auto add = [&](double share, const FieldValues& e) {
        value += share > 0.0 && !e.Values.empty() ? share * e.Values[at] : 0.0;
        error += share > 0.0 && !e.Errors.empty() ? share * e.Errors[at] : 0.0;
      };
      add(reflects ? own(optics.DiffuseReflectance, side, at) : 0.0, irradiance[side]);
      add(through, irradiance[1 - side]);
      light.Exitance[side][at] = value;
      light.Error[side][at] = error;
    }
  }
  return light;
}

DiffuseLight DiffuseAtPoints(const Scene& scene, const std::vector<SurfacePoint>& points,
  const DiffuseLight& cells, const std::array<FieldValues, 2>& values, bool radiosity,
  bool emission)
{
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  const Materials& optics = scene.Optics;
  DiffuseLight light;
  for (std::size_t side = 0; side < 2; ++side)
  {
    if (cells.Exitance[side].empty())
    {
      continue;
    }
    light.Exitance[side].assign(points.size() * bands, 0.0);
    light.Error[side].assign(points.size() * bands, 0.0);
    const auto own = [&](const std::array<std::vector<double>, 2>& sides, std::size_t at) {
      const std::vector<double>& v = sides[side].empty() ? sides[0] : sides[side];
      return v.empty() ? 0.0 : v[at];
    };
    const auto of = [](const std::vector<double>& v, std::size_t at) {
      return v.empty() ? 0.0 : v[at];
    };
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      if (points[i].Triangle < 0)
      {
        continue;
      }
      std::vector<std::int32_t> around = points[i].Around;
      if (around.empty())
      {
        around.push_back(points[i].Triangle);
      }
      for (std::size_t b = 0; b < bands; ++b)
      {
        const std::size_t here = i * bands + b;
        double value = 0.0, error = 0.0;
        for (const std::int32_t t : around)
        {
          const auto cell =
            static_cast<std::size_t>(scene.TriangleCell[static_cast<std::size_t>(t)]);
          const std::size_t at = cell * bands + b;
          const bool reflects = side == 0 || (!optics.TwoSided.empty() && optics.TwoSided[cell] != 0);
          if (values[side].Values.empty())
          {
            value += cells.Exitance[side][at];
            error += of(cells.Error[side], at);
          }
          else if (radiosity)
          {
            value += values[side].Values[here];
            error += of(values[side].Errors, here);
          }
          else
          {
            const double rho = reflects ? own(optics.DiffuseReflectance, at) : 0.0;
            const double tau = of(optics.DiffuseTransmittance, at);
            value += (reflects && emission ? own(optics.EmittedExitance, at) : 0.0) +
              rho * values[side].Values[here] + tau * of(values[1 - side].Values, here);
            error += rho * of(values[side].Errors, here) + tau * of(values[1 - side].Errors, here);
          }
        }
        light.Exitance[side][here] = value / static_cast<double>(around.size());
        light.Error[side][here] = error / static_cast<double>(around.size());
      }
    }
  }
  return light;
}

double BoundInterreflection(const Scene& scene, const DiffuseLight& direct)
{
  const Materials& optics = scene.Optics;
  const double most =
    std::max(Greatest(direct.Exitance[0]), Greatest(direct.Exitance[1]));
  const double specular =
    std::max(Greatest(optics.SpecularReflectance[0]), Greatest(optics.SpecularReflectance[1]));
  const double diffuse =
    std::max(Greatest(optics.DiffuseReflectance[0]), Greatest(optics.DiffuseReflectance[1])) +
    Greatest(optics.DiffuseTransmittance);
  const bool through = Greatest(optics.DiffuseTransmittance) > 0.0;
  if (diffuse == 0.0 || (most == 0.0 && specular == 0.0) ||
    (FindConvexity(scene) == Convexity::Body && !TwoSided(optics) && !through))
  {
    return 0.0;
  }
  const double share = diffuse + Greatest(optics.Transmittance);
  return specular > 0.0 || share >= 1.0 ? std::numeric_limits<double>::infinity()
                                        : share * most / (Pi * (1.0 - share));
}

double GreatestEmission(const Scene& scene)
{
  const auto& emitted = scene.Optics.EmittedExitance;
  return std::max(Greatest(emitted[0]), Greatest(emitted[1])) / Pi;
}

} // namespace radiometry
