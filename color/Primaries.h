// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace radiometry::color
{

using Matrix3 = std::array<double, 9>; ///< row by row

/// CIE 1931 xy chromaticities of the three primaries and of the white of an RGB space.
struct Primaries
{
  std::array<double, 2> Red, Green, Blue, White;

  static Primaries Rec709();    ///< Rec. ITU-R BT.709, white D65
  static Primaries ACES_AP0();  ///< SMPTE ST 2065-1
  static Primaries ACES_AP1();  ///< S-2014-004
  static Primaries DisplayP3(); ///< SMPTE RP 431-2 primaries, white D65
};

/// RGB to CIE XYZ, with Y = 1 for R = G = B = 1.
///   Source  SMPTE RP 177-1993, section 3
///   Fails   ColorError where the primaries lie on a line, or y is 0, or a value is not finite
Matrix3 RgbToXyz(const Primaries& primaries);

/// From one RGB space to another; white goes to white by the Bradford adaptation.
Matrix3 RgbToRgb(const Primaries& from, const Primaries& to);

Matrix3 Multiply(const Matrix3& a, const Matrix3& b);
/// Fails with ColorError for a singular matrix.
Matrix3 Inverse(const Matrix3& m);

} // namespace radiometry::color
