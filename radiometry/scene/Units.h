// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/InputError.h"

#include <cmath>
#include <string>
#include <vector>

/// Units at the edge: degrees and photometric quantities are converted here, once, to radians and
/// SI. Inside everything is radiometric; a photometric quantity X_v [lm ...] and a radiometric one
/// X_e [W ...] are tied by X_v = K X_e, with K the luminous efficacy of the light's spectrum.
namespace radiometry
{
namespace units
{

inline constexpr double Pi = 3.141592653589793238462643;

/// lm/W at 555 nm, where V = 1 (CIE 018:2019: K_m = 683.002 for wavelengths in standard air).
/// The default efficacy: a light stated in lumens alone then reads the same in lumens after
/// any number of conversions, whatever its true spectrum.
inline constexpr double MaximumLuminousEfficacy = 683.002;

constexpr double Radians(double degrees)
{
  return degrees * (Pi / 180.0);
}
constexpr double Degrees(double radians)
{
  return radians * (180.0 / Pi);
}

/// Shares of the bands in the luminous quantity: they sum to 1, so equal bands X read K X.
/// Three bands are linear Rec.709 with the D65 white (ITU-R BT.709-6, item 3.3); any other number
/// of bands without further knowledge counts each alike.
inline std::vector<double> LuminanceWeights(int bands)
{
  if (bands == 3)
  {
    return { 0.2126, 0.7152, 0.0722 };
  }
  return std::vector<double>(static_cast<std::size_t>(bands), 1.0 / bands);
}

/// Photometric value of one tuple of a radiometric quantity: K sum_b w_b X_b.
inline double Photometric(const double* values, int bands, double efficacy = MaximumLuminousEfficacy)
{
  if (bands == 1)
  {
    return efficacy * values[0];
  }
  const std::vector<double> weights = LuminanceWeights(bands);
  double sum = 0.0;
  for (int b = 0; b < bands; ++b)
  {
    sum += weights[b] * values[b];
  }
  return efficacy * sum;
}

/// Radiometric value of a photometric one.
/// Fails: InputError{LuminousEfficacy} unless 0 < efficacy and finite.
inline double Radiometric(double photometric, double efficacy = MaximumLuminousEfficacy)
{
  if (!(efficacy > 0.0) || !std::isfinite(efficacy))
  {
    throw InputError("LuminousEfficacy", -1, efficacy, "a positive finite number of lm/W");
  }
  return photometric / efficacy;
}

/// Degrees with the array's name checked for use as the half-angle of a cone: (0, 90] or 180.
inline void CheckCutoff(const std::string& name, long long index, double degrees)
{
  if (!((degrees > 0.0 && degrees <= 90.0) || degrees == 180.0))
  {
    throw InputError(name, index, degrees, "degrees in (0, 90], or 180 for no cone");
  }
}

} // namespace units
} // namespace radiometry
