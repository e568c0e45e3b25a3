// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/effects/LightBounds.h"
#include "radiometry/effects/OpticalLimits.h"
#include "radiometry/scene/Scene.h"

#include <array>
#include <limits>

namespace radiometry
{

/// Bound on the light of lights that arrives by way of surfaces that reflect specularly, at least one,
/// before any diffuse reflection: of any value and at any place [W/m^2, brightest band].
///
/// Mirrors (no lobe). Through one flat mirror, or the facets of one convex body, a place is lit by at
///   most one image of a light: for two facets a, b of a convex body the outward normals satisfy
///   n_b.(b - a) >= 0 >= n_a.(b - a), so that the reflected directions r = d - 2(d.n)n satisfy
///   (b - a).(r_b - r_a) >= (b - a).(d_b - d_a) >= 0, as the incoming d spread from the light; two
///   reflected rays that met would need (b - a).(r_b - r_a) < 0. Reflected rays spread in their turn,
///   so the same holds along a sequence of such groups of facets. Facets are flat: the image is as
///   strong as the light at the unfolded distance, which is at least that from light to facet. So a
///   light of intensity I gives at most sum over groups g of rho_g I k(d_g), and over all sequences,
///   with G groups, of which none follows itself, 1/(1 - (G - 1) rho) times that. Mirrors that are
///   not convex bodies count plane by plane.
/// Lobes. f <= rho (n + 2)/(2 pi): a surface under the irradiance E sends at most the radiance
///   rho (n + 2)/(2 pi) E, and the hemisphere at most pi times that. Where few planes have lobes, a
///   plane gives at most q (1 + ln(2 (n + 2)/q)) rho I/h^2, q = (n/(n + 2))^(n/2), h its distance from
///   the light: at a place that is D from the light's image, a direction at an angle psi from the
///   image meets the lobe at alpha >= psi, at the distance r from the image, r sin(alpha) =
///   D sin(psi); cos^n(alpha)/r^2 is then at most 2 q/((n + 2) D^2 sin^2(psi)) and 1/h^2, and the
///   smaller of both, integrated over the hemisphere, is greatest at D = h.
/// After a lobe light is radiance: further specular reflection adds s/(1 - s), s the greatest share
///   that stays radiance; and no more than the series of rho (n + 2)/2, as each lobe sends so much of
///   the irradiance that the one before gives. Nothing where all such surfaces lie in one plane or on
///   one convex body. The same for panels and skies, of radiance L: s/(1 - s) pi L.
/// Averages over cells also get no more than all that surfaces reflect specularly of the lights, over
///   the smallest cell: Phi/(1 - s)/A.
struct SpecularReach
{
  double Value = 0.0;
  double Peak = 0.0; // infinite where mirrors see each other too well

  /// Of light that met a mirror among them.
  double MirrorValue = 0.0;
  double MirrorPeak = 0.0;
};

/// Of the lights of some kinds (by LightType). `straight`: what BoundFirstReflection says of these
/// lights, if it is known: a first lobe sends rho (n + 2)/2 of that. Cost: facets x lights, some 50 ns each, at most 1e7 of
/// them; more are bounded together.
SpecularReach BoundSpecular(const Scene& scene, const OpticalLimits& optics, bool cellsOnly,
  const std::array<bool, 5>& kinds, const LightVariants& variants,
  const FirstReflection& straight = { std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::infinity() });

} // namespace radiometry
