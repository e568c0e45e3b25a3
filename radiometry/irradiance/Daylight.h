// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/SkyRadiance.h"

#include <memory>

namespace radiometry
{

/// How the strength of daylight is stated. Photometric or radiometric, as the caller likes.
struct DaylightStrength
{
  double Sky = 0.0;
  bool SkyHorizontal = false; // false: radiance at the zenith (of a map: that its values multiply);
                              // true: irradiance that the sky alone gives a horizontal plane
  double Sun = 0.0;           // 0: no sun
  bool SunHorizontal = false; // false: irradiance normal to the beam; true: on a horizontal plane
  double GroundReflectance = 0.0; // [0, 1]
};

/// A sky with its scale.
struct Daylight
{
  std::shared_ptr<const SkyRadiance> Sky; // over its ground
  double Radiance = 0.0;                  // that the relative sky is a multiple of
  double Sun = 0.0;                       // irradiance normal to the beam
};

/// Scales a sky and its sun, and lights the ground by both:
///   Model   radiance = E_h/H where the horizontal irradiance E_h is stated, H that of the relative
///           sky (bands weighted as luminance); ground radiance = rho (E_sky,h + E_sun,h)/pi
///   Fails   InputError naming the property that is out of range: a sky that sends nothing on a
///           horizontal plane, a sun at or below the horizon that is stated by what it sends there
Daylight MakeDaylight(
  std::shared_ptr<const SkyRadiance> sky, const Vec3& toSun, const DaylightStrength& strength);

} // namespace radiometry
