// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

/// Spectra to colour: the colour-matching functions of the CIE 1931 standard observer (2 degrees),
/// tabulated at 5 nm from 380 to 780 nm, linear in between, 0 outside.
///
///   Model   X = sum_b S_b w_b, w_b the share of band b in x-bar, y-bar, z-bar; linear Rec.709 by the
///           matrix of its primaries and its white D65; nothing is clipped: a colour that Rec.709
///           cannot show has a negative channel
///   Light   L_v = 683.002 lm/W Y [cd/m^2 of a radiance]: y-bar is V, and this table is the only one
///   Source  CIE 015:2018, table T.1 (5 nm, 2 degrees); D65: CIE S 014-2; checked digit by digit
///           against CVRL (UCL) and the table in raysect. Rec.709: ITU-R BT.709-6, 1.3 and 1.4
///   Beyond  bands, or parts of bands, below 380 and above 780 nm have no colour and no luminance
namespace radiometry
{
namespace imaging
{

using Triple = std::array<double, 3>; ///< X, Y, Z or linear R, G, B

inline constexpr double FirstVisibleWavelength = 380.0; // nm
inline constexpr double LastVisibleWavelength = 780.0;  // nm

/// x-bar, y-bar, z-bar at a wavelength [nm]; 0 outside the table (and for a NaN).
Triple ColorMatchingFunctions(double wavelength);

/// V(lambda), the photopic luminous efficiency: y-bar.
double LuminousEfficiency(double wavelength);

/// The integral [nm] of x-bar, y-bar, z-bar from `from` to `to`, exact for the linear interpolation.
Triple ColorMatchingIntegral(double from, double to);

/// Relative power of illuminant D65, 100 at 560 nm; linear between 5 nm, 0 outside the table.
double IlluminantD65(double wavelength);

Triple XyzToLinearRec709(const Triple& xyz);
Triple LinearRec709ToXyz(const Triple& rgb);

/// What to do with a colour that Rec.709 cannot show, which has a negative channel.
enum class Gamut
{
  Keep = 0,       ///< as it is: scene-linear light
  Clip = 1,       ///< negative channels become 0: brighter than it was
  Desaturate = 2, ///< mixed with the grey of its luminance until no channel is negative
};
Triple FitGamut(const Triple& rgb, Gamut gamut);

/// What the N numbers of a spectral array say.
enum class BandValues
{
  Power = 0,        ///< what lies in each band, in the array's unit (W/m^2 ...): docs/arrays.md
  PerNanometre = 1, ///< a density, in the array's unit a nanometre
  Lines = 2,        ///< all power of a band lies at its wavelength: spectral lines, lasers
  Reflectance = 3,  ///< a share [1] of the light of an illuminant; 1 everywhere is its white, Y = 1
};

/// The light that reflectances are seen in.
enum class Illuminant
{
  D65 = 0,         ///< a perfect white is R = G = B = 1
  EqualEnergy = 1, ///< E: a perfect white is X = Y = Z = 1, pinkish in Rec.709
};

/// How N bands become X, Y, Z and linear Rec.709. Built once, applied to any number of tuples.
///
///   Edges   band b reaches half-way to its neighbours; the first and the last reach as far outward as
///           inward; any spacing. One band alone has no width and is taken as a line
///   Gaps    what the bands of a reflectance leave out of the visible counts to the nearest band that
///           reaches into it; of a light, nothing is there
///   Cost    O(N) for each tuple
///   Fails   InputError{Wavelengths, index, value}: none, not finite, outside [10, 1e6] nm, two alike;
///           a single band PerNanometre
///
/// The wavelengths may come in any order; the values are in the same order.
class SpectralColor
{
public:
  SpectralColor(const double* wavelengths, int bands, BandValues values = BandValues::Power,
    Illuminant illuminant = Illuminant::D65);

  int GetBands() const { return static_cast<int>(this->Xyz.size()); }
  /// Lower and upper edge [nm] of each band, in the order of the wavelengths.
  const std::vector<std::array<double, 2>>& GetEdges() const { return this->Edges; }
  /// X, Y, Z of a 1 in each band. The second times 683.002 lm/W is its luminous efficacy.
  const std::vector<Triple>& GetXyzWeights() const { return this->Xyz; }
  /// Linear R, G, B of a 1 in each band, for shaders and tables.
  const std::vector<Triple>& GetRgbWeights() const { return this->Rgb; }

  Triple ToXyz(const double* values) const;
  Triple ToRgb(const double* values) const;
  /// 683.002 lm/W Y: luminance [cd/m^2] of a radiance, illuminance [lx] of an irradiance.
  double ToPhotometric(const double* values) const;

private:
  std::vector<std::array<double, 2>> Edges;
  std::vector<Triple> Xyz;
  std::vector<Triple> Rgb;
};

/// The one rule of the project for what N numbers look like: three are linear Rec.709, one is grey;
/// others go through `spectrum` where it stands for as many bands, else they are the grey of their
/// mean.
Triple ColorOfBands(const double* values, int bands, const SpectralColor* spectrum = nullptr);

} // namespace imaging
} // namespace radiometry
