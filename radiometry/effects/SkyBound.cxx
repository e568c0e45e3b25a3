// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/effects/LightBounds.h"
#include "radiometry/scene/SkyRadiance.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/// Solid angle of a row of a lat-long map between two angles from the zenith, all round.
double RowAngle(double from, double to)
{
  return 2.0 * Pi * (std::cos(from) - std::cos(to));
}

/// pi times the greatest pixel, and the sum of all pixels times their solid angle.
SkyBound BoundMap(const SkyRadiance& sky, const std::vector<double>& intensity)
{
  SkyBound bound;
  const auto bands = static_cast<std::size_t>(sky.Bands());
  const auto width = static_cast<std::size_t>(sky.Width());
  const auto height = static_cast<std::size_t>(sky.Height());
  for (std::size_t b = 0; b < intensity.size(); ++b)
  {
    double peak = 0.0, flux = 0.0;
    for (std::size_t row = 0; row < height; ++row)
    {
      double sum = 0.0;
      for (std::size_t column = 0; column < width; ++column)
      {
        const double value = sky.Values()[(row * width + column) * bands + (bands > 1 ? b : 0)];
        peak = std::max(peak, value);
        sum += value;
      }
      const double step = Pi / static_cast<double>(height);
      flux += sum / static_cast<double>(width) *
        RowAngle(step * static_cast<double>(row), step * static_cast<double>(row + 1));
    }
    bound.Radiance = std::max(bound.Radiance, intensity[b] * peak);
    bound.Irradiance = std::max(bound.Irradiance, intensity[b] * std::min(Pi * peak, flux));
  }
  return bound;
}

/// L = f(chi) phi(Z)/norm over small parts of the sky: in each, phi is monotone in Z, and of f the
/// exponential is monotone and cos^2 has its greatest value at an end or where the part holds the
/// sun's place or the opposite one. An upper sum, so a bound.
SkyBound BoundGeneral(const SkyRadiance& sky)
{
  constexpr int rows = 30, columns = 60;
  const auto& [a, b, c, d, e] = sky.Coefficients();
  const Vec3 sun = Normalized(sky.ToSun());
  const double atZenith = std::max(1e-300, sky.At({ 0.0, 0.0, 1.0 })); // 1 but for rounding
  const auto phi = [&](double zenith) {
    const double cosine = std::max(std::cos(zenith), 1e-9);
    return 1.0 + a * std::exp(std::clamp(b / cosine, -700.0, 700.0));
  };
  const auto f = [&](double least, double most) {
    const double ends = std::max(c * std::exp(d * least), c * std::exp(d * most));
    const double square = [&](double from, double to) {
      const double one = std::cos(from) * std::cos(from), other = std::cos(to) * std::cos(to);
      const bool middle = from < 0.5 * Pi && to > 0.5 * Pi;
      return e > 0.0 ? std::max(one, other) : (middle ? 0.0 : std::min(one, other));
    }(least, most);
    return 1.0 + ends - c * std::exp(d * 0.5 * Pi) + e * square;
  };
  const double sunAngle = std::acos(std::clamp(sun.z, -1.0, 1.0));
  const double norm = f(sunAngle, sunAngle) * phi(0.0) / atZenith;
  SkyBound bound;
  double flux = 0.0;
  for (int row = 0; row < rows; ++row)
  {
    const double from = 0.5 * Pi * row / rows, to = 0.5 * Pi * (row + 1) / rows;
    const double high = std::max(phi(from), phi(to));
    for (int column = 0; column < columns; ++column)
    {
      const double azimuth = 2.0 * Pi * (column + 0.5) / columns;
      const double zenith = 0.5 * (from + to);
      const Vec3 middle{ std::sin(zenith) * std::sin(azimuth), std::sin(zenith) * std::cos(azimuth),
        std::cos(zenith) };
      const double half = 0.5 * (to - from) + Pi / columns; // no place of the part is farther
      const double chi = std::atan2(Length(Cross(middle, sun)), Dot(middle, sun));
      const double radiance =
        std::max(0.0, f(std::max(0.0, chi - half), std::min(Pi, chi + half)) * high / norm);
      bound.Radiance = std::max(bound.Radiance, radiance);
      flux += radiance * RowAngle(from, to) / columns;
    }
  }
  bound.Radiance = std::max(bound.Radiance, sky.GroundRadiance());
  flux += 2.0 * Pi * sky.GroundRadiance();
  bound.Irradiance = std::min(Pi * bound.Radiance, flux);
  return bound;
}

} // namespace

SkyBound BoundSky(const Light& light)
{
  const double brightest = Brightest(light);
  SkyBound bound{ 1.0, Pi };
  if (light.Environment && light.Environment->Model() == SkyModel::Map)
  {
    return BoundMap(*light.Environment, light.Intensity);
  }
  if (light.Environment && light.Environment->Model() == SkyModel::General)
  {
    bound = BoundGeneral(*light.Environment);
  }
  else if (light.Environment && light.Environment->Model() == SkyModel::TraditionalOvercast)
  {
    bound.Radiance = std::max(1.0, light.Environment->GroundRadiance());
    bound.Irradiance = Pi * bound.Radiance;
  }
  return { bound.Radiance * brightest, bound.Irradiance * brightest };
}

} // namespace radiometry
