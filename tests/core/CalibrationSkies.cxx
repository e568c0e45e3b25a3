// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/CalibrationExtended.h"

#include "radiometry/scene/SkyRadiance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>

/// Environment lights over the floor. The reference takes from the whole sky's irradiance what the
/// blockers hide: L cos(theta) over the union of their shadows on the plane one metre above the point.
namespace test
{
namespace
{

using namespace radiometry;

const double Pi = std::acos(-1.0);

/// Radiance toward a unit direction above the horizon.
using Radiance = std::function<double(const Vec3&)>;

/// Irradiance of the whole sky on level ground: L over the disc of (sin theta cos phi, sin theta sin
/// phi), where the cosine is the projection's.
Integral WholeSky(const Radiance& sky, const Vec3& sun, double tolerance)
{
  RegionIntegrand f;
  f.Value = [&](double x, double y) {
    const double z2 = 1.0 - x * x - y * y;
    return z2 > 0.0 ? sky({ x, y, std::sqrt(z2) }) : 0.0;
  };
  f.OnLine = [&](const Point2& o, const Point2& d, std::vector<double>& s) {
    const double a = d.x * d.x + d.y * d.y;
    const double b = o.x * d.x + o.y * d.y;
    const double root = b * b - a * (o.x * o.x + o.y * o.y - 1.0);
    if (root >= 0.0)
    {
      s.push_back((-b - std::sqrt(root)) / a);
      s.push_back((-b + std::sqrt(root)) / a);
    }
    if (d.y == 0.0)
    {
      s.push_back((sun.x - o.x) / d.x);
    }
  };
  f.Extremes = { sun.y };
  return IntegrateRegion({ { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } }, {}, f, tolerance);
}

PointReference Reference(const Radiance& sky, const Integral& whole)
{
  return [sky, whole](
           const Vec3& at, const std::vector<Triangle3>& blockers, double tolerance) {
    std::vector<Convex2> shadows;
    Point2 low{ 0, 0 };
    Point2 high{ 0, 0 };
    for (const Triangle3& blocker : blockers)
    {
      Convex2 shadow;
      for (const Vec3& v : blocker)
      {
        shadow.push_back({ (v.x - at.x) / (v.z - at.z), (v.y - at.y) / (v.z - at.z) });
        low = { std::min(low.x, shadow.back().x), std::min(low.y, shadow.back().y) };
        high = { std::max(high.x, shadow.back().x), std::max(high.y, shadow.back().y) };
      }
      shadows.push_back(shadow);
    }
    if (shadows.empty())
    {
      return whole;
    }
    RegionIntegrand f;
    f.Value = [&](double x, double y) {
      const double r2 = x * x + y * y + 1.0;
      const double r = std::sqrt(r2);
      return sky({ x / r, y / r, 1.0 / r }) / (r2 * r2);
    };
    f.Extremes = { 0.0 };
    const Integral hidden = IntegrateRegion(
      { low, { high.x, low.y }, high, { low.x, high.y } }, shadows, f, tolerance, true);
    return Integral{ whole.Value - hidden.Value, whole.Error + hidden.Error };
  };
}

Light SkyLight(std::shared_ptr<const SkyRadiance> sky, double intensity)
{
  Light light;
  light.Type = LightType::Environment;
  light.Reference = { 0.0, 1.0, 0.0 }; // north: East, North, Up are x, y, z
  light.Intensity = { intensity };
  light.Environment = std::move(sky);
  return light;
}

PointReference UniformSky(CalibrationScene& scene, Random& random)
{
  const double l = Uniform(random, 1, 100);
  scene.Scene.Lights = { SkyLight(SkyRadiance::Uniform(), l) };
  return Reference([l](const Vec3&) { return l; }, { Pi * l, 1e-15 * l });
}

PointReference Overcast(CalibrationScene& scene, Random& random)
{
  const double l = Uniform(random, 1, 100);
  scene.Scene.Lights = { SkyLight(SkyRadiance::Overcast(), l) };
  return Reference(
    [l](const Vec3& d) { return l * (1.0 + 2.0 * d.z) / 3.0; }, { 7.0 * Pi / 9.0 * l, 1e-15 * l });
}

PointReference General(CalibrationScene& scene, Random& random)
{
  const double l = Uniform(random, 1, 100);
  const double elevation = Uniform(random, 0.3, 1.4);
  const double azimuth = Uniform(random, 0, 2 * Pi);
  const Vec3 sun{ std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
    std::sin(elevation) };
  const std::array<double, 5> k =
    SkyRadiance::TypeCoefficients(1 + static_cast<int>(random() % 15));
  scene.Scene.Lights = { SkyLight(SkyRadiance::General(k, sun), l) };
  const auto indicatrix = [k](double chi) {
    return 1.0 + k[2] * (std::exp(k[3] * chi) - std::exp(0.5 * k[3] * Pi)) +
      k[4] * std::cos(chi) * std::cos(chi);
  };
  const double zenith = indicatrix(0.5 * Pi - elevation) * (1.0 + k[0] * std::exp(k[1]));
  const Radiance sky = [=](const Vec3& d) {
    const double chi = std::atan2(Length(Cross(d, sun)), Dot(d, sun));
    return l * indicatrix(chi) * (1.0 + k[0] * std::exp(k[1] / std::max(d.z, 1e-300))) / zenith;
  };
  return Reference(sky, WholeSky(sky, sun, 1e-7));
}

} // namespace

std::vector<ExtendedKind> SkyKinds()
{
  return { { "sky, uniform", true, UniformSky }, { "sky, overcast", true, Overcast },
      { "sky, CIE general", true, General } };
}

void AddSkyCases(std::vector<CalibrationCase>& cases)
{
  AddExtendedCases(cases, SkyKinds());
}

} // namespace test
