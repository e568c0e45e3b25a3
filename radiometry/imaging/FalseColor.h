// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

/// Values as colours of a scale that a legend explains: continuous, or in bands between levels, with
/// lines of equal value. Colours are those of the display (sRGB), to be shown as they are.
namespace radiometry
{
namespace imaging
{

using ByteColor = std::array<std::uint8_t, 3>;

enum class ColorScale
{
  Linear = 0,
  Logarithmic = 1,
};

enum class Palette
{
  Viridis = 0,  ///< dark violet, green, yellow; even steps of lightness
  Inferno = 1,  ///< black, red, yellow, near white; even steps of lightness
  Spectrum = 2, ///< blue, cyan, green, yellow, red, as luminance cameras have it
  Grey = 3,
};

/// Colour of a palette at t in [0, 1] (clamped), linear between anchors in display values.
ByteColor PaletteColor(Palette palette, double t);

struct FalseColorSettings
{
  imaging::Palette Palette = imaging::Palette::Viridis;
  ColorScale Scale = ColorScale::Logarithmic;
  double Minimum =
    0.0; ///< the ends of the scale; Minimum < Maximum, above 0 where it is logarithmic
  double Maximum = 1.0;
  int Steps = 0;              ///< bands of equal width on the scale; 0: continuous
  std::vector<double> Levels; ///< where given, the bands' limits; ascending
  ByteColor NotFinite{ { 255, 0, 255 } };
};

/// A scale ready for use.
///   Cost    a value: O(1), with levels O(log levels)
///   Fails   InputError{Minimum, Maximum, Steps, Levels}
class FalseColorMap
{
public:
  explicit FalseColorMap(const FalseColorSettings& settings);

  /// What is below or above the scale has the colour of its end; a NaN or an infinity NotFinite.
  ByteColor Color(double value) const;
  /// Where a value lies on the scale: 0 at its minimum, 1 at its maximum, clamped; 0 for a NaN.
  double Position(double value) const;
  /// The value at a position, the inverse of Position.
  double Value(double position) const;
  /// Limits of the legend's bands, one more than there are colours (256 where it is continuous).
  const std::vector<double>& GetLimits() const { return this->Limits; }
  const std::vector<ByteColor>& GetColors() const { return this->Colors; }
  bool IsContinuous() const { return this->Continuous; }

private:
  std::size_t Band(double value) const;

  FalseColorSettings Settings;
  bool Continuous = true;
  std::vector<double> Limits;
  std::vector<ByteColor> Colors;
};

/// The ends of a scale for values: their least (above 0 where it is logarithmic, and at most five
/// decades below the greatest) and greatest finite ones, rounded outward to 1, 2 or 5 times a power
/// of ten. (0, 1), or (0.1, 1), where there is nothing to go by.
std::pair<double, double> ChooseRange(const std::vector<double>& values, ColorScale scale);

/// About `wanted` round numbers between the ends, both included where they are round: steps of 1, 2
/// or 5 times a power of ten; on a logarithmic scale 1, 2 and 5, or the powers of ten, of each decade.
std::vector<double> RoundLevels(double minimum, double maximum, ColorScale scale, int wanted);

/// 1 where a line of one of the ascending levels runs: between this pixel and the one to the right or
/// above. `values`: row by row. Pixels that are not finite have no lines.
std::vector<std::uint8_t> IsoLinePixels(
  const std::vector<double>& values, int width, int height, const std::vector<double>& levels);

} // namespace imaging
} // namespace radiometry
