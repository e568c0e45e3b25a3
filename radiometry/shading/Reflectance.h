// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"
#include "radiometry/shading/LightingModel.h"

#include <functional>
#include <optional>

namespace radiometry
{

/// How one side of a surface reflects in one band: the lighting model as a function f_r(in, out).
///   Physical    f = rho_d/pi + rho_s (n + 2)/(2 pi) max(R.V, 0)^n
///   Phong       f = (k_d + k_s max(R.V, 0)^n/(N.L))/pi
///   BlinnPhong  f = (k_d + k_s max(N.H, 0)^n/(N.L))/pi
/// The legacy models are no BRDFs: they give colours. They are read here as pi times the radiance,
/// so that k_d is the reflectance of a matte surface; read as radiance itself, all is pi times more.
///   Limits  f is 0 where either direction lies below the surface. n = 0 is a lobe of 1 everywhere.
///           Physical with n >= MirrorShininess (scene/Scene.h) is a perfect mirror, as in the
///           simulation: it has no finite f, so EvaluateBrdf leaves the lobe out, and the functions
///           below take it as what it is.
struct Brdf
{
  ReflectionModel Reflection = ReflectionModel::Physical;
  double Diffuse = 0.5;    // rho_d or k_d
  double Specular = 0.0;   // rho_s or k_s
  double Shininess = 10.0; // n
};

/// A number found by integration and how far it may be from the truth.
struct IntegratedValue
{
  double Value = 0.0;
  double Error = 0.0;
};

/// Throws InputError{"DiffuseReflectance" | "SpecularReflectance" | "Shininess", index, value} for
/// values that are negative, not finite (Shininess may be infinite) or, of Physical, add up to more
/// than 1.
void CheckBrdf(const Brdf& brdf, long long index = 0);

/// f_r(in, out) in 1/sr for unit vectors that point away from the surface.
///   Fails   never: directions that are not finite or below the surface reflect nothing
double EvaluateBrdf(const Brdf& brdf, const Vec3& normal, const Vec3& in, const Vec3& out);

/// The share of the power of a beam that comes at angle theta from the normal which leaves again,
/// into all directions (directional-hemispherical reflectance), in closed form.
///   Physical    rho_d + rho_s a_n(theta) (PhongLobeReflectance in scene/Reflectance.h), for any
///               real n: the horizon cuts the lobe. a_n(0) = 1
///   Phong       k_d + k_s 2/(n + 2) a_n(theta)/cos(theta): grows without limit toward grazing
///   BlinnPhong  at theta = 0 only: k_d + 8 k_s [2 (1 - q^(n+4))/(n + 4) - (1 - q^(n+2))/(n + 2)],
///               q = 1/sqrt(2)
///   Returns nothing where there is no closed form, and for legacy models at cosTheta = 0, where
///           their f is infinite
std::optional<double> ClosedReflectance(const Brdf& brdf, double cosTheta);

/// The same by integration of f cos(theta_out) over the hemisphere, for all models.
///   Cost    adaptive: some thousands of evaluations
///   Fails   InputError as CheckBrdf; for cosTheta outside (0, 1], or 0 with a legacy model
IntegratedValue IntegrateReflectance(
  const Brdf& brdf, double cosTheta, double relativeTolerance = 1e-6);

/// The share that leaves of light that comes from everywhere alike (albedo, bihemispherical
/// reflectance): 2 times the integral of the above over cos(theta) sin(theta) d theta.
///   Physical    rho_d + rho_s (2/3 + B(n/2 + 3/2, 1/2)/(3 pi (n + 1))), n > 0: falls from 5/6 to 2/3
///   Phong       k_d + k_s (2n + 3)/((n + 1)(n + 2)), n > 0
///   BlinnPhong  nothing
std::optional<double> ClosedAlbedo(const Brdf& brdf);
IntegratedValue IntegrateAlbedo(const Brdf& brdf, double relativeTolerance = 1e-4);

/// The radiance that leaves toward `out` [W/(m^2 sr)] under incident radiance L(in):
/// the integral of f(in, out) L(in) cos(theta_in) over the hemisphere.
///   Reads   incident(in): W/(m^2 sr) from the unit direction `in` (away from the surface); finite
///   Error   the sum over the cells of the last subdivision of what halving them changed
///   Limits  light from less than some 0.01 sr may be missed whole: add small lights by f E
///   Cost    adaptive, some `evaluations` calls of incident at most
///   Fails   InputError as CheckBrdf, for `normal` or `out` without a direction, and for an incident
///           radiance that is not finite
IntegratedValue ReflectedRadiance(const Brdf& brdf, const Vec3& normal, const Vec3& out,
  const std::function<double(const Vec3&)>& incident, double relativeTolerance = 1e-4,
  long long evaluations = 2000000);

} // namespace radiometry
