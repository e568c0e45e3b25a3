// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/EffectRandomLight.h"

#include "radiometry/scene/CandelaWeb.h"
#include "radiometry/scene/SkyRadiance.h"

#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace test
{
namespace
{

using namespace radiometry;

const double Degree = std::acos(-1.0) / 180.0;

double Versine(double angle)
{
  const double s = std::sin(0.5 * angle);
  return 2.0 * s * s;
}

void MakeSpot(Dice& dice, Light& light)
{
  light.Type = LightType::Spot;
  if (dice.Chance(0.1))
  {
    return; // no cone
  }
  const double angles[] = { 5.0, 30.0, 60.0, 90.0 };
  const double exponents[] = { 0.0, 1.0, 4.0, 7.5 };
  const double cutoff = angles[dice.Below(4)];
  light.CosCutoff = cutoff == 90.0 ? 0.0 : std::cos(cutoff * Degree);
  light.VersineCutoff = cutoff == 90.0 ? 1.0 : Versine(cutoff * Degree);
  light.CosInnerCutoff = light.CosCutoff;
  light.VersineInnerCutoff = light.VersineCutoff;
  light.Exponent = exponents[dice.Below(4)];
  if (dice.Chance(0.3))
  {
    const double inner = cutoff * dice.Uniform(0.1, 0.9) * Degree;
    light.SmoothEdge = true;
    light.CosInnerCutoff = std::cos(inner);
    light.VersineInnerCutoff = Versine(inner);
  }
}

void MakeLuminaire(Dice& dice, Light& light)
{
  const std::vector<double> planes =
    dice.Chance(0.5) ? std::vector<double>{ 0 } : std::vector<double>{ 0, 90, 180, 270, 360 };
  const std::vector<double> gammas{ 0, 20, 50, 90 };
  std::vector<double> values;
  const double pole = dice.Uniform(0.3, 1.0);
  for (std::size_t c = 0; c < planes.size(); ++c)
  {
    for (std::size_t g = 0; g < gammas.size(); ++g)
    {
      const bool last = c + 1 == planes.size() && c > 0;
      values.push_back(
        last ? values[g] : (g == 0 ? pole : (g + 1 == gammas.size() ? 0.0 : dice.Uniform(0.05, 1.0))));
    }
  }
  light.Web = std::make_shared<CandelaWeb>(WebType::C, planes, gammas, values);
}

void MakePanel(Dice& dice, const Placement& here, Light& light)
{
  const Vec3 corner = dice.InBox(1.0);
  const Vec3 a = dice.InBox(0.5);
  const Vec3 b = dice.InBox(0.5);
  light.Type = LightType::Area;
  light.Polygon = { here.Point(corner), here.Point(corner + a), here.Point(corner + b) };
  if (dice.Chance(0.5))
  {
    light.Polygon.insert(light.Polygon.begin() + 2, here.Point(corner + a + b));
  }
  light.TwoSided = dice.Chance(0.5);
  light.Position = light.Polygon[0];
  light.Direction = Normalized(Cross(a, b));
}

void MakeSky(Dice& dice, Light& light)
{
  light.Type = LightType::Environment;
  light.Direction = { 0, 0, -1 };
  light.Reference = { 0, 1, 0 };
  switch (dice.Below(4))
  {
    case 0:
      light.Environment = SkyRadiance::Uniform();
      break;
    case 1:
      light.Environment = SkyRadiance::Overcast(dice.Uniform(0.0, 0.3));
      break;
    case 2:
      light.Environment =
        SkyRadiance::General(SkyRadiance::TypeCoefficients(1 + dice.Below(15)), { 0.3, 0.2, 0.8 });
      break;
    default:
    {
      std::vector<double> pixels(8);
      for (double& p : pixels)
      {
        p = dice.Uniform(0.0, 1.0);
      }
      light.Environment = SkyRadiance::Map(4, 2, 1, pixels);
    }
  }
}

/// Square to Direction.
Vec3 SomeReference(const Vec3& direction)
{
  return Normalized(
    Cross(direction, std::fabs(direction.z) < 0.9 ? Vec3{ 0, 0, 1 } : Vec3{ 1, 0, 0 }));
}

} // namespace

Light RandomLight(Dice& dice, const Bands& bands, const Placement& here, std::string& what)
{
  static const char* const names[] = { "point", "point", "spot", "spot", "sun", "panel", "sky",
    "luminaire" };
  const int kind = dice.Below(8);
  what += std::string(", ") + names[kind];
  Light light;
  light.Direction = dice.Direction();
  light.Reference = SomeReference(light.Direction);
  Vec3 place = dice.InBox(1.5);
  if (dice.Chance(0.2))
  {
    place = dice.InBox(0.5); // inside of rooms
  }
  const double squared = here.Scale * here.Scale;
  double strength = std::pow(10.0, dice.Uniform(-1.0, 1.0));
  if (dice.Chance(0.25))
  {
    what += " (weak)";
    strength *= std::pow(10.0, dice.Uniform(-9.0, -2.0));
  }
  if (dice.Chance(0.1))
  {
    what += " (far)";
    place = 1000.0 * dice.Direction();
  }
  light.Position = here.Point(place);
  const bool beam = kind < 4 || kind == 7;
  if (kind == 2 || kind == 3)
  {
    MakeSpot(dice, light);
  }
  else if (kind == 4)
  {
    light.Type = LightType::Directional;
  }
  else if (kind == 5)
  {
    MakePanel(dice, here, light);
  }
  else if (kind == 6)
  {
    MakeSky(dice, light);
  }
  else if (kind == 7)
  {
    MakeLuminaire(dice, light);
  }
  light.Intensity = bands.Spectrum(dice, strength * (beam ? squared : 1.0));
  if (beam && dice.Chance(0.15))
  {
    what += " (legacy)";
    const double a = dice.Uniform(0.1, 2.0);
    light.Attenuation[0] = a * squared;
    light.Attenuation[1] = dice.Chance(0.5) ? dice.Uniform(0.0, 1.0) * here.Scale : 0.0;
    light.Attenuation[2] = dice.Chance(0.5) ? dice.Uniform(0.0, 1.0) : 0.0;
  }
  if (dice.Chance(0.1))
  {
    what += " (disabled)";
    light.Enabled = false;
  }
  return light;
}

} // namespace test
