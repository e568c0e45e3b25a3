// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

namespace radiometry
{

/// BRDF of a Lambertian surface: rho/pi, 1/sr.
double LambertianBrdf(double rho);

/// BRDF of the energy-conserving Phong lobe, 1/sr, for unit vectors that point away from the
/// surface; zero where either lies below it.
///   Model   f = rho (n + 2)/(2 pi) max(cos alpha, 0)^n, alpha between `out` and the mirror image
///           of `in`. The same for in and out exchanged (Helmholtz reciprocity).
///   Source  Lafortune and Willems 1994, eq. 4 and 5
double PhongLobeBrdf(
  double rho, double shininess, const Vec3& normal, const Vec3& in, const Vec3& out);

/// Directional-hemispherical reflectance of that lobe for light that comes at angle theta from the
/// normal (cosTheta in [0, 1]): the share of its power that leaves again, into all directions.
///   Model   rho (n + 2)/(2 pi) times the integral of cos^n(alpha) cos(theta_out) over the
///           hemisphere; about the lobe's axis the inner integral has a closed form, the outer is
///           done by Gauss-Legendre quadrature to about 1e-10
///   Value   rho at normal incidence, exactly; never more than rho
///   Source  the closed form at theta = 0: Lafortune and Willems 1994, eq. 5
double PhongLobeReflectance(double rho, double shininess, double cosTheta);

} // namespace radiometry
