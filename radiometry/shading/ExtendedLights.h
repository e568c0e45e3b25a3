// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/SkyRadiance.h"
#include "radiometry/scene/Vec3.h"
#include "radiometry/shading/Rgb.h"

#include <array>
#include <vector>

namespace radiometry
{

class CandelaWeb;

/// What a flat polygon of exitance 1 gives at a point about a unit normal: its form factor, what lies
/// below the horizon cut off. Positive where the point sees its front (counter-clockwise corners),
/// negative where it sees its back.
///   Model   F = 1/(2 pi) sum theta_k Gamma_k . N over the edges, convex or concave
///   Source  Lambert, Photometria (1760); Baum, Rushmeier and Winget 1989, eq. 8
///   Exact   in front of and behind the polygon; in its own plane: 0
double PolygonFormFactor(
  const std::vector<Vec3>& polygon, const Vec3& point, const Vec3& normal);

/// Irradiance of a sky on a plane as a quadratic function of its normal: what is left of it after
/// degree 2 of its spherical harmonics.
///   Model   E(n) = m0/4 + n.m1/2 + 5/32 (3 n^T M n - m0), m0, m1, M the moments of the radiance
///   Exact   for skies of degree 2, so for uniform ones; for CIE overcast skies within 0.005 of the
///           greatest irradiance, for CIE clear skies within 0.012
///   Source  Ramamoorthi and Hanrahan 2001, eq. 5 to 12
struct SkyQuadric
{
  Rgb Constant;
  std::array<Rgb, 3> Linear;    // x, y, z
  std::array<Rgb, 6> Quadratic; // xx, yy, zz, xy, xz, yz; the mixed ones doubled

  /// About a unit normal; not below 0.
  Rgb Irradiance(const Vec3& normal) const;
  /// The same sky seen in other axes: rows of the rotation from the old ones.
  SkyQuadric Rotated(const std::array<Vec3, 3>& rows) const;
};
SkyQuadric ProjectSky(const SkyRadiance& sky, const SkyFrame& frame, const Rgb& intensity);

/// The axes of a luminaire in space: coordinates of a direction are its products with these.
/// `axis`: of zero angles (its light's direction); `reference`: where C = 0 lies, its part square to
/// the axis; where there is none, any.
std::array<Vec3, 3> LuminaireAxes(const Vec3& axis, const Vec3& reference);

} // namespace radiometry
