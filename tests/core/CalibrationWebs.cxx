// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/CalibrationBeams.h"

#include "radiometry/scene/CandelaWeb.h"

#include <algorithm>
#include <cmath>
#include <memory>

/// Luminaires: the reference interpolates the web's numbers by itself and integrates between the
/// curves at which the interpolation bends.
namespace test
{
namespace
{

using namespace radiometry;

const double Pi = std::acos(-1.0);
const double Degree = Pi / 180.0;

/// The luminaire's x and y; its axis, where the light goes, is Direction.
Vec3 SideOf(const Light& light)
{
  return Cross(light.Reference, light.Direction);
}

double Between(const std::vector<double>& grid, double at, std::size_t& low)
{
  low = static_cast<std::size_t>(std::upper_bound(grid.begin(), grid.end(), at) - grid.begin());
  low = std::clamp<std::size_t>(low, 1, grid.size() - 1) - 1;
  return (at - grid[low]) / (grid[low + 1] - grid[low]);
}

Light Luminaire(Random& random, std::vector<double> planes)
{
  Light light;
  light.Position = { Uniform(random, -2, 2), Uniform(random, -2, 2), Uniform(random, 1.9, 4) };
  light.Direction =
    Normalized(Vec3{ Uniform(random, -0.4, 0.4), Uniform(random, -0.4, 0.4), -1.0 });
  const double turn = Uniform(random, 0, 2 * Pi);
  light.Reference =
    Normalized(Cross(light.Direction, Vec3{ std::cos(turn), std::sin(turn), 0.0 }));
  light.Intensity = { Uniform(random, 1, 100) };
  const std::vector<double> gammas{ 0, 10, 20, 30, 45, 60, 75, 90 };
  std::vector<double> values;
  const double pole = Uniform(random, 0.5, 1);
  for (std::size_t c = 0; c < planes.size(); ++c)
  {
    for (const double g : gammas)
    {
      const bool last = c + 1 == planes.size() && c > 0;
      values.push_back(last    ? values[values.size() - c * gammas.size()]
          : g == 0.0           ? pole
          : g == gammas.back() ? 0.0
                               : Uniform(random, 0.05, 1));
    }
  }
  light.Web = std::make_shared<CandelaWeb>(WebType::C, planes, gammas, values);
  return light;
}

} // namespace

double WebIntensity(const Light& light, const Vec3& way)
{
  const double along = Dot(way, light.Direction);
  const double x = Dot(way, light.Reference);
  const double y = Dot(way, SideOf(light));
  const double gamma = std::atan2(std::hypot(x, y), along) / Degree;
  double azimuth = std::atan2(y, x) / Degree;
  azimuth += azimuth < 0.0 ? 360.0 : 0.0;
  const std::vector<double>& planes = light.Web->GetHorizontal();
  const std::vector<double>& gammas = light.Web->GetVertical();
  const std::vector<double>& values = light.Web->GetValues();
  if (gamma > gammas.back())
  {
    return 0.0;
  }
  std::size_t g = 0;
  const double t = Between(gammas, gamma, g);
  const auto inPlane = [&](std::size_t c) {
    const double* v = &values[c * gammas.size() + g];
    return (1.0 - t) * v[0] + t * v[1];
  };
  if (planes.size() == 1)
  {
    return inPlane(0);
  }
  std::size_t c = 0;
  const double s = Between(planes, azimuth, c);
  return (1.0 - s) * inPlane(c) + s * inPlane(c + 1);
}

void AddWebBreaks(const Light& light, std::vector<double>& cosines, std::vector<Vec3>& planes)
{
  for (const double g : light.Web->GetVertical())
  {
    if (g > 0.0)
    {
      cosines.push_back(g == 90.0 ? 0.0 : std::cos(g * Degree));
    }
  }
  for (const double c : light.Web->GetHorizontal())
  {
    planes.push_back(
      std::cos(c * Degree) * SideOf(light) - std::sin(c * Degree) * light.Reference);
  }
}

std::vector<BeamKind> WebKinds()
{
  return { { "luminaire, round", [](Random& random) { return Luminaire(random, { 0 }); } },
    { "luminaire, any web",
      [](Random& random) {
        return Luminaire(random, { 0, 45, 90, 135, 180, 225, 270, 315, 360 });
      } } };
}

} // namespace test
