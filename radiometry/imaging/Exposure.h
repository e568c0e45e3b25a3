// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

/// Photographic exposure: from a camera's settings, or from the light in the picture itself.
///
///   Model   EV100 = log2(N^2/t 100/S), N the f-number, t the shutter time [s], S the ISO speed. A pixel of
///           1.2 x 2^EV100 cd/m^2 becomes 1, the sensor's saturation: L_max = 78/(q S) N^2/t with
///           q = 0.65 for a lens on its axis
///   Source  ISO 12232:2019 (saturation-based speed); ISO 2720:1974 (meters, K = 12.5); Lagarde and
///           de Rousiers 2014, sections 5.1 and 5.2; Reinhard et al. 2002, eqs. 1 and 2 (key value)
namespace radiometry
{
namespace imaging
{

/// cd/m^2 that expose to 1 at EV100 = 0: 78/(100 x 0.65).
inline constexpr double SaturationLuminance = 1.2;
/// K of ISO 2720 [cd s/m^2] at ISO 1: a meter that reads L sets EV100 = log2(100 L/K).
inline constexpr double MeterConstant = 12.5;

/// EV100 of a camera's settings. Fails: InputError for a value that is not above 0 and finite.
double ExposureValue(double fNumber, double shutterTime, double isoSpeed);
/// EV100 that a meter sets for an average luminance [cd/m^2].
double MeteredExposureValue(double luminance);

/// Luminances of a picture, sorted out.
struct LuminanceSummary
{
  std::size_t Pixels = 0;      ///< all
  std::size_t NonFinite = 0;   ///< with a NaN or an infinity in a channel: not counted below
  std::size_t NotPositive = 0; ///< finite and 0 or less: in no geometric mean
  double Minimum = 0.0;        ///< the least above 0
  double Maximum = 0.0;
  double Mean = 0.0;          ///< of all finite ones
  double GeometricMean = 0.0; ///< of those above 0; 0 where there is none
};

/// Luminance of each pixel: `perUnit` times the value itself (1 or 2 components, the second alpha) or
/// the weighted sum of linear Rec.709 (3 or 4). A NaN where a channel is not finite or alpha is 0
/// (nothing was drawn there); premultiplied colours are divided by their alpha.
std::vector<double> PixelLuminances(
  const double* pixels, std::size_t count, int components, double perUnit);

LuminanceSummary Summarise(const std::vector<double>& luminances);

/// The value that `percent` of the finite luminances do not exceed, linear between neighbours.
/// 0 where there is none. Fails: InputError{Percentile} outside [0, 100].
double LuminancePercentile(const std::vector<double>& luminances, double percent);

enum class ExposureMode
{
  ExposureValue = 0, ///< EV100 as stated
  Camera = 1,        ///< f-number, shutter time, ISO speed
  KeyValue = 2,      ///< the geometric mean becomes KeyValue
  Percentile = 3,    ///< the luminance of a percentile becomes PercentileLevel
  Stops = 4,         ///< values times 2^Compensation, nothing else
  Automatic = 5,     ///< the darker of KeyValue and Percentile
};

struct ExposureSettings
{
  ExposureMode Mode = ExposureMode::Percentile;
  double ExposureValue = 10.0; ///< EV100
  double FNumber = 8.0;
  double ShutterTime = 1.0 / 60.0; ///< [s]
  double IsoSpeed = 100.0;
  double KeyValue = 0.18;
  double Percentile = 99.0;
  double PercentileLevel = 1.0;
  double Compensation = 0.0; ///< stops brighter, in every mode
};

struct ChosenExposure
{
  double Gain = 1.0;          ///< factor on the pixels' values
  double Stops = 0.0;         ///< log2 of it
  double ExposureValue = 0.0; ///< the EV100 that has this gain
  bool NoLight = false;       ///< nothing above 0 to measure: the gain is the compensation alone
};

/// `perUnit` [cd/m^2] of a pixel value of 1, as in PixelLuminances.
/// Fails: InputError that names the setting out of range.
ChosenExposure ChooseExposure(
  const std::vector<double>& luminances, double perUnit, const ExposureSettings& settings);

/// Multiplies the colours of `count` pixels of 1 to 4 components (2 and 4: the last is alpha, kept).
/// Where `repair`, a NaN and -infinity become 0 and +infinity the greatest finite value of the
/// picture, before the gain. Returns how many pixels were not finite.
std::size_t ApplyGain(double* pixels, std::size_t count, int components, double gain, bool repair);

} // namespace imaging
} // namespace radiometry
