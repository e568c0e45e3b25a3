// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/shading/LightingModel.h"

#include "radiometry/scene/CandelaWeb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/// Unit vector along v, or zero where v has no direction.
Vec3 Direction(const Vec3& v)
{
  return IsFinite(v) ? Normalized(v) : Vec3{};
}

/// max(a.b, 0)^n for unit vectors. Near a = b the cosine is taken from the chord, 1 - |a - b|^2/2,
/// which keeps the digits that a large n multiplies. 0^0 is 1, as in OpenGL.
double PowerOfCosine(const Vec3& a, const Vec3& b, double n)
{
  if (n == 0.0)
  {
    return 1.0;
  }
  const double cosine = 1.0 - 0.5 * LengthSquared(a - b);
  return cosine > 0.0 ? std::pow(cosine, n) : 0.0;
}

/// The specular factor for the unit vectors N, L, V with N.L = nl > 0.
double SpecularFactor(ReflectionModel reflection, const Vec3& N, const Vec3& L, const Vec3& V,
  double nl, double shininess)
{
  if (V == Vec3{})
  {
    return 0.0;
  }
  if (reflection != ReflectionModel::Physical)
  {
    return SpecularLobe(reflection, N, L, V, shininess);
  }
  const double lobe = SpecularLobe(ReflectionModel::Phong, N, L, V, shininess);
  return lobe == 0.0 ? 0.0 : (shininess + 2.0) / (2.0 * Pi) * lobe * nl;
}

} // namespace

double SpecularLobe(
  ReflectionModel reflection, const Vec3& N, const Vec3& L, const Vec3& V, double shininess)
{
  if (!(shininess >= 0.0) || std::isinf(shininess))
  {
    return 0.0;
  }
  if (reflection == ReflectionModel::BlinnPhong)
  {
    const Vec3 H = Direction(L + V);
    return H == Vec3{} ? 0.0 : PowerOfCosine(N, H, shininess);
  }
  return PowerOfCosine(2.0 * Dot(N, L) * N - L, V, shininess);
}

double LightFactor(const DisplayLight& light, double r, const Vec3& toPoint)
{
  if (light.Position[3] == 0.0)
  {
    return 1.0;
  }
  double factor =
    1.0 / (light.Attenuation[0] + r * (light.Attenuation[1] + r * light.Attenuation[2]));
  if (!std::isfinite(factor))
  {
    return 0.0;
  }
  if (light.CosCutoff > -1.0)
  {
    const double cosine = Dot(Direction(light.SpotDirection), toPoint);
    if (cosine < light.CosCutoff)
    {
      return 0.0;
    }
    if (light.SpotExponent != 0.0)
    {
      factor *= std::pow(std::max(cosine, 0.0), light.SpotExponent);
    }
    if (light.SmoothEdge && light.CosInnerCutoff > light.CosCutoff)
    {
      const double t = std::min(
        (cosine - light.CosCutoff) / (light.CosInnerCutoff - light.CosCutoff), 1.0);
      factor *= t * t;
    }
  }
  return factor;
}

namespace
{

/// Irradiance of an area light or an environment at a point about a unit normal.
Rgb ExtendedIrradiance(const DisplayLight& light, const Vec3& point, const Vec3& normal)
{
  if (light.Sky)
  {
    return light.Diffuse * light.Sky->Irradiance(normal);
  }
  const double factor = PolygonFormFactor(light.Polygon, point, normal);
  return (light.PolygonTwoSided ? std::abs(factor) : std::max(factor, 0.0)) * light.Diffuse;
}

/// Relative intensity of a luminaire in a unit direction.
double WebFactor(const DisplayLight& light, const Vec3& direction)
{
  const std::array<Vec3, 3> axes = LuminaireAxes(light.SpotDirection, light.Reference);
  return light.Web->Intensity(
    { Dot(direction, axes[0]), Dot(direction, axes[1]), Dot(direction, axes[2]) });
}

} // namespace

LightSums SumLights(const LightingModel& model, const std::vector<DisplayLight>& lights,
  double shininess, const ShadingSample& sample)
{
  LightSums sums;
  const Vec3 N = Direction(sample.Normal);
  const Vec3 V = Direction(model.LocalViewer ? sample.Eye - sample.Point : sample.Viewer);
  for (std::size_t k = 0; k < lights.size(); ++k)
  {
    const DisplayLight& light = lights[k];
    if (!light.Enabled)
    {
      continue;
    }
    if (light.Sky || !light.Polygon.empty())
    {
      const double share = sample.Visibility ? sample.Visibility[k] : 1.0;
      const double unit = model.Reflection == ReflectionModel::Physical ? 1.0 / Pi : 1.0;
      if (!(N == Vec3{}))
      {
        sums.Diffuse += share * unit * ExtendedIrradiance(light, sample.Point, N);
      }
      continue;
    }
    const Vec3 position{ light.Position[0], light.Position[1], light.Position[2] };
    const double w = light.Position[3];
    const Vec3 toLight = w == 0.0 ? position : position / w - sample.Point;
    const double r = Length(toLight);
    if (!(r > 0.0) || !std::isfinite(r))
    {
      continue;
    }
    const Vec3 L = toLight / r;
    double factor = LightFactor(light, r, -L) * (light.Web ? WebFactor(light, -L) : 1.0);
    sums.Ambient += factor * light.Ambient;
    factor *= sample.Visibility ? sample.Visibility[k] : 1.0;
    const double nl = Dot(N, L);
    if (!(nl > 0.0) || factor == 0.0)
    {
      continue;
    }
    const double diffuse = model.Reflection == ReflectionModel::Physical ? nl / Pi : nl;
    sums.Diffuse += factor * diffuse * light.Diffuse;
    sums.Specular +=
      factor * SpecularFactor(model.Reflection, N, L, V, nl, shininess) * light.Specular;
  }
  return sums;
}

ShadedColor ApplyMaterial(
  const LightingModel& model, const DisplayMaterial& material, const LightSums& sums)
{
  return { material.Emission + material.Ambient * (model.GlobalAmbient + sums.Ambient) +
      material.Diffuse * sums.Diffuse + material.Specular * sums.Specular,
    material.Alpha };
}

ShadedColor Shade(const LightingModel& model, const std::vector<DisplayLight>& lights,
  const DisplayMaterial& front, const DisplayMaterial& back, const ShadingSample& sample)
{
  const bool seenFromBehind = model.TwoSided && !sample.FrontFacing;
  const DisplayMaterial& material = seenFromBehind ? back : front;
  ShadingSample side = sample;
  if (seenFromBehind)
  {
    side.Normal = -sample.Normal;
  }
  return ApplyMaterial(model, material, SumLights(model, lights, material.Shininess, side));
}

} // namespace radiometry
