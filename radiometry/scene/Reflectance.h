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
///   Model   rho a_n(theta), for n > 0
///             a_n = cos(theta) (1 + I_{cos^2 theta}(1/2, n/2 + 1))/2
///                 + (n + 2)/(2 pi (n + 1)) B(n/2 + 3/2, 1/2) sin^(n + 2)(theta),
///           I the regularised incomplete beta function. About the axis square to the normal and to
///           the lobe's own the integral of cos^n(alpha) cos(theta_out) falls into two factors:
///           powers of one cosine (docs/physics/shading.md)
///   Value   rho at normal incidence, exactly; falls toward grazing; to some 1e-13
///   Source  the closed form at theta = 0: Lafortune and Willems 1994, eq. 5
double PhongLobeReflectance(double rho, double shininess, double cosTheta);

/// The beta function B(p, 1/2) = sqrt(pi) Gamma(p)/Gamma(p + 1/2) for p > 0, without the differences
/// of large logarithms: Stirling's series of the ratio from p = 32 on, B(p) = B(p + 1) (p + 1/2)/p
/// below.
double BetaWithHalf(double p);

} // namespace radiometry
