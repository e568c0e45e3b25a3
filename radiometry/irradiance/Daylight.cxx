// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/Daylight.h"

#include "radiometry/irradiance/SkyTable.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include <cmath>

namespace radiometry
{

Daylight MakeDaylight(
  std::shared_ptr<const SkyRadiance> sky, const Vec3& toSun, const DaylightStrength& strength)
{
  if (!(strength.GroundReflectance >= 0.0 && strength.GroundReflectance <= 1.0))
  {
    throw InputError("GroundReflectance", -1, strength.GroundReflectance, "a number in [0, 1]");
  }
  if (!std::isfinite(strength.Sun) || strength.Sun < 0.0)
  {
    throw InputError("SunIntensity", -1, strength.Sun, "a finite number, not negative");
  }
  const std::vector<double> weights = units::LuminanceWeights(sky->Bands());
  double horizontal = 0.0;
  for (int b = 0; b < sky->Bands(); ++b)
  {
    horizontal += weights[b] * HorizontalIrradiance(sky, b);
  }
  if (strength.SkyHorizontal && !(horizontal > 0.0))
  {
    throw InputError("Intensity", -1, strength.Sky,
      "a radiance: this sky sends nothing on a horizontal plane");
  }
  Daylight daylight;
  daylight.Radiance = strength.SkyHorizontal ? strength.Sky / horizontal : strength.Sky;
  const double sine = Normalized(toSun).z;
  if (strength.Sun > 0.0 && strength.SunHorizontal && !(sine > 0.0))
  {
    throw InputError("SunDirection", -1, units::Degrees(std::asin(sine)),
      "an altitude above 0 degrees for a sun stated by what it sends on a horizontal plane");
  }
  daylight.Sun = strength.SunHorizontal && strength.Sun > 0.0 ? strength.Sun / sine : strength.Sun;
  double ground = strength.GroundReflectance * horizontal / units::Pi;
  if (daylight.Radiance > 0.0 && sine > 0.0)
  {
    ground += strength.GroundReflectance * daylight.Sun * sine / units::Pi / daylight.Radiance;
  }
  daylight.Sky = sky->WithGround(ground);
  return daylight;
}

} // namespace radiometry
