// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/shading/Reflectance.h"

#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Reflectance.h"
#include "radiometry/scene/Scene.h"

#include <cmath>

namespace radiometry
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

void CheckOne(const char* name, long long index, double value, bool mayBeInfinite = false)
{
  if (!(value >= 0.0) || (!mayBeInfinite && std::isinf(value)))
  {
    throw InputError(
      name, index, value, mayBeInfinite ? "a number of at least 0" : "a finite number of at least 0");
  }
}

} // namespace

void CheckBrdf(const Brdf& brdf, long long index)
{
  CheckOne("DiffuseReflectance", index, brdf.Diffuse);
  CheckOne("SpecularReflectance", index, brdf.Specular);
  CheckOne("Shininess", index, brdf.Shininess, true);
  if (brdf.Reflection == ReflectionModel::Physical && brdf.Diffuse + brdf.Specular > 1.0 + 1e-12)
  {
    throw InputError("SpecularReflectance", index, brdf.Specular,
      "DiffuseReflectance + SpecularReflectance of at most 1");
  }
}

double EvaluateBrdf(const Brdf& brdf, const Vec3& normal, const Vec3& in, const Vec3& out)
{
  const double cosIn = Dot(normal, in);
  const double cosOut = Dot(normal, out);
  if (!(cosIn > 0.0) || !(cosOut > 0.0) || !std::isfinite(cosIn) || !std::isfinite(cosOut))
  {
    return 0.0;
  }
  const double diffuse = LambertianBrdf(brdf.Diffuse);
  if (brdf.Specular == 0.0)
  {
    return diffuse;
  }
  if (brdf.Reflection == ReflectionModel::Physical)
  {
    return brdf.Shininess >= MirrorShininess
      ? diffuse
      : diffuse + PhongLobeBrdf(brdf.Specular, brdf.Shininess, normal, in, out);
  }
  const double lobe =
    SpecularLobe(brdf.Reflection, normal, in, out, brdf.Shininess);
  return diffuse + brdf.Specular * lobe / (Pi * cosIn);
}

std::optional<double> ClosedReflectance(const Brdf& brdf, double cosTheta)
{
  const double n = brdf.Shininess;
  if (!(cosTheta >= 0.0 && cosTheta <= 1.0))
  {
    return std::nullopt;
  }
  if (brdf.Specular == 0.0)
  {
    return brdf.Diffuse;
  }
  if (brdf.Reflection == ReflectionModel::Physical)
  {
    const bool whole = n == 0.0 || n >= MirrorShininess;
    return brdf.Diffuse + brdf.Specular * (whole ? 1.0 : PhongLobeReflectance(1.0, n, cosTheta));
  }
  if (cosTheta == 0.0)
  {
    return std::nullopt;
  }
  if (std::isinf(n))
  {
    return brdf.Diffuse;
  }
  if (n == 0.0) // the factor is 1 everywhere: the integral of cos(theta_out)/(pi cos(theta_in))
  {
    return brdf.Diffuse + brdf.Specular / cosTheta;
  }
  if (brdf.Reflection == ReflectionModel::Phong)
  {
    return brdf.Diffuse + brdf.Specular * 2.0 / (n + 2.0) * PhongLobeReflectance(1.0, n, cosTheta) / cosTheta;
  }
  if (cosTheta == 1.0)
  {
    const double log2 = std::log(2.0);
    const double share = 8.0 *
      (-2.0 * std::expm1(-0.5 * log2 * (n + 4.0)) / (n + 4.0) +
        std::expm1(-0.5 * log2 * (n + 2.0)) / (n + 2.0));
    return brdf.Diffuse + brdf.Specular * share;
  }
  return std::nullopt;
}

std::optional<double> ClosedAlbedo(const Brdf& brdf)
{
  const double n = brdf.Shininess;
  if (brdf.Specular == 0.0)
  {
    return brdf.Diffuse;
  }
  if (brdf.Reflection == ReflectionModel::Physical)
  {
    const bool whole = n == 0.0 || n >= MirrorShininess;
    return brdf.Diffuse +
      brdf.Specular *
      (whole ? 1.0 : 2.0 / 3.0 + BetaWithHalf(0.5 * n + 1.5) / (3.0 * Pi * (n + 1.0)));
  }
  if (n == 0.0)
  {
    return brdf.Diffuse + 2.0 * brdf.Specular;
  }
  if (brdf.Reflection == ReflectionModel::Phong)
  {
    return brdf.Diffuse +
      (std::isinf(n) ? 0.0 : brdf.Specular * (2.0 * n + 3.0) / ((n + 1.0) * (n + 2.0)));
  }
  return std::nullopt;
}

} // namespace radiometry
