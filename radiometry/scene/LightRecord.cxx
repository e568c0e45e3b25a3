// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/scene/LightRecord.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace radiometry
{
namespace
{

std::string Text(const Vec3& v)
{
  char text[120];
  std::snprintf(text, sizeof text, "(%.9g, %.9g, %.9g)", v.x, v.y, v.z);
  return text;
}

/// int_0^1 (co + d t)^e t^2 dt, times d: the smooth part of the cone in c = cos(phi).
double SmoothPart(double co, double ci, double e)
{
  const double d = ci - co;
  if (d > 0.25 * co)
  {
    // c^{e+1} (c^2/(e+3) - 2 co c/(e+2) + co^2/(e+1)) between co and ci; (ci - co)^2 >= co^2/16
    // keeps the cancellation below two digits.
    const auto primitive = [&](double c) {
      return std::pow(c, e + 1.0) *
        (c * c / (e + 3.0) - 2.0 * co * c / (e + 2.0) + co * co / (e + 1.0));
    };
    return (primitive(ci) - primitive(co)) / (d * d);
  }
  // Here (co + d t)^e varies by (1 + d/co)^e at most: 10 Gauss-Legendre points on each of a few
  // pieces (more for a large exponent) reach rounding.
  static constexpr std::array<double, 5> x{ 0.1488743389816312, 0.4333953941292472,
    0.6794095682990244, 0.8650633666889845, 0.9739065285171717 };
  static constexpr std::array<double, 5> w{ 0.2955242247147529, 0.2692667193099963,
    0.2190863625159820, 0.1494513491505806, 0.0666713443086881 };
  const double growth = e * std::log1p(d / co);
  const int pieces = 1 + static_cast<int>(std::fmin(growth / 2.0, 10000.0));
  double sum = 0.0;
  for (int p = 0; p < pieces; ++p)
  {
    for (std::size_t k = 0; k < x.size(); ++k)
    {
      for (const double sign : { -1.0, 1.0 })
      {
        const double t = (p + 0.5 * (1.0 + sign * x[k])) / pieces;
        sum += 0.5 * w[k] / pieces * t * t * std::pow(co + d * t, e);
      }
    }
  }
  return d * sum;
}

/// The unit vector square to `axis` nearest to `reference`; any one where there is none.
Vec3 SquareTo(const Vec3& axis, const Vec3& reference)
{
  const Vec3 square = reference - Dot(axis, reference) * axis;
  if (Length(square) > 1e-12 * Length(reference))
  {
    return Normalized(square);
  }
  const Vec3 other = std::fabs(axis.x) < 0.9 ? Vec3{ 1.0, 0.0, 0.0 } : Vec3{ 0.0, 1.0, 0.0 };
  return Normalized(other - Dot(axis, other) * axis);
}

} // namespace

double SpotFluxFactor(double cutoffDegrees, double innerCutoffDegrees, double exponent)
{
  if (cutoffDegrees == 180.0)
  {
    return 4.0 * units::Pi;
  }
  const double e = exponent;
  // (1 - c^{e+1})/(e+1) without cancellation for narrow cones: 1 - cos t = 2 sin^2(t/2).
  const auto cap = [e](double degrees) {
    const double s = std::sin(0.5 * units::Radians(degrees));
    const double versine = 2.0 * s * s;
    return versine >= 1.0 ? 1.0 / (e + 1.0) : -std::expm1((e + 1.0) * std::log1p(-versine)) / (e + 1.0);
  };
  if (innerCutoffDegrees < 0.0)
  {
    return 2.0 * units::Pi * cap(cutoffDegrees);
  }
  const double ci = std::cos(units::Radians(innerCutoffDegrees));
  const double co = cutoffDegrees == 90.0 ? 0.0 : std::cos(units::Radians(cutoffDegrees));
  return 2.0 * units::Pi * (cap(innerCutoffDegrees) + SmoothPart(co, ci, e));
}

Vec3 UnitDirection(const char* name, const Vec3& direction, long long index)
{
  if (!IsFinite(direction) || !(Length(direction) > 0.0))
  {
    throw InputError(name, index, Text(direction), "a finite vector that is not zero");
  }
  return Normalized(direction);
}

void Validate(const LightRecord& light, long long index)
{
  const auto finite = [&](const char* name, const Vec3& v) {
    if (!IsFinite(v))
    {
      throw InputError(name, index, Text(v), "finite numbers");
    }
  };
  finite("Position", light.Position);
  finite(names::Direction, light.Direction);
  finite(names::Attenuation, light.Attenuation);
  for (const double value : light.Intensity)
  {
    if (!std::isfinite(value) || value < 0.0)
    {
      throw InputError(names::Intensity, index, value, "a finite number, not negative");
    }
  }
  if (light.Type != LightType::Point || light.Web)
  {
    UnitDirection(names::Direction, light.Direction, index);
  }
  if (light.Web)
  {
    UnitDirection(names::ReferenceDirection, light.Reference, index);
    if (light.Type != LightType::Point)
    {
      throw InputError(names::PhotometricWeb, index, static_cast<int>(light.Type),
        "a web on a light of LightType 0 only");
    }
  }
  if (light.Attenuation.x < 0.0 || light.Attenuation.y < 0.0 || light.Attenuation.z < 0.0 ||
    light.Attenuation == Vec3{})
  {
    throw InputError(names::Attenuation, index, Text(light.Attenuation),
      "no coefficient below zero and at least one above");
  }
  if (light.Type == LightType::Area)
  {
    if (light.Polygon.size() < 3)
    {
      throw InputError("Polygons", index, static_cast<double>(light.Polygon.size()),
        "at least 3 corners of an area light");
    }
    if (!(light.Attenuation == Vec3{ 0.0, 0.0, 1.0 }))
    {
      throw InputError(names::Attenuation, index, Text(light.Attenuation),
        "(0, 0, 1) for an area light: it has no other fall-off");
    }
    for (const Vec3& corner : light.Polygon)
    {
      finite("Polygons", corner);
    }
  }
  if (light.AttachedTo < 0 || light.AttachedTo > 2)
  {
    throw InputError(names::AttachedTo, index, light.AttachedTo, "0 scene, 1 object or 2 camera");
  }
  if (light.Type != LightType::Spot)
  {
    return;
  }
  units::CheckCutoff(names::SpotCutoff, index, light.SpotCutoff);
  if (!std::isfinite(light.SpotExponent) || light.SpotExponent < 0.0)
  {
    throw InputError(
      names::SpotExponent, index, light.SpotExponent, "a finite number, not negative");
  }
  if (light.SpotCutoff == 180.0 && light.SpotExponent != 0.0)
  {
    throw InputError(names::SpotExponent, index, light.SpotExponent,
      "0 where SpotCutoff is 180 (no cone), or a cutoff of at most 90 degrees");
  }
  if (!std::isfinite(light.SpotInnerCutoff) ||
    (light.SpotInnerCutoff >= 0.0 && !(light.SpotInnerCutoff < light.SpotCutoff)) ||
    (light.SpotInnerCutoff >= 0.0 && light.SpotCutoff == 180.0))
  {
    throw InputError(names::SpotInnerCutoff, index, light.SpotInnerCutoff,
      "degrees in [0, SpotCutoff), or below 0 for a hard edge");
  }
}

Light ToLight(
  const LightRecord& record, double metersPerUnit, const Vec3& origin, std::size_t index)
{
  Light light;
  light.Type = record.Type;
  light.Position = metersPerUnit * record.Position - origin;
  light.Direction = record.Type == LightType::Point && !record.Web ? record.Direction
                                                                   : Normalized(record.Direction);
  light.Reference = SquareTo(light.Direction, record.Reference);
  for (const Vec3& corner : record.Polygon)
  {
    light.Polygon.push_back(metersPerUnit * corner - origin);
  }
  light.TwoSided = record.TwoSided;
  light.Web = record.Web;
  light.Environment = record.Environment;
  light.Intensity = record.Intensity;
  light.Enabled = record.Enabled;
  light.Index = static_cast<long long>(index);
  for (int k = 0; k < 3; ++k)
  {
    light.Attenuation[k] = record.Attenuation[k];
  }
  if (record.Type == LightType::Spot && record.SpotCutoff < 180.0)
  {
    light.CosCutoff = record.SpotCutoff == 90.0 ? 0.0 : std::cos(units::Radians(record.SpotCutoff));
    const auto versine = [](double degrees) {
      const double s = std::sin(0.5 * units::Radians(degrees));
      return 2.0 * s * s;
    };
    light.VersineCutoff = record.SpotCutoff == 90.0 ? 1.0 : versine(record.SpotCutoff);
    light.VersineInnerCutoff =
      record.SpotInnerCutoff >= 0.0 ? versine(record.SpotInnerCutoff) : light.VersineCutoff;
    light.Exponent = record.SpotExponent;
    light.SmoothEdge = record.SpotInnerCutoff >= 0.0;
    light.CosInnerCutoff =
      light.SmoothEdge ? std::cos(units::Radians(record.SpotInnerCutoff)) : light.CosCutoff;
  }
  return light;
}

} // namespace radiometry
