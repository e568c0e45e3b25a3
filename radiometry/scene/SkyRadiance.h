// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <array>
#include <memory>
#include <vector>

namespace radiometry
{

/// The values of the SkyModel array.
enum class SkyModel
{
  Uniform = 0,            // over the whole sphere
  Map = 1,                // a lat-long picture
  General = 2,            // CIE standard general sky
  TraditionalOvercast = 3 // (1 + 2 sin(elevation))/3
};

/// The axes of a sky: directions are kept as (East, North, Up). Azimuth is counted from North
/// toward East: clockwise seen from above, as on a compass.
struct SkyFrame
{
  Vec3 East{ 1.0, 0.0, 0.0 };
  Vec3 North{ 0.0, 1.0, 0.0 };
  Vec3 Up{ 0.0, 0.0, 1.0 };

  SkyFrame() = default;
  /// `down` and the direction of azimuth 0, of any length; of the latter the part square to `down`.
  SkyFrame(const Vec3& down, const Vec3& reference);

  Vec3 ToSky(const Vec3& world) const
  {
    return { Dot(this->East, world), Dot(this->North, world), Dot(this->Up, world) };
  }
  Vec3 ToWorld(const Vec3& sky) const
  {
    return sky.x * this->East + sky.y * this->North + sky.z * this->Up;
  }
};

/// Radiance of a sky in each direction, relative to the Intensity of its light. Immutable.
///   Model   Uniform  1 everywhere, below the horizon too
///           Map      the pixel's value, constant over the pixel: row 0 begins at the zenith, the
///                    last row ends at the nadir, the middle column's edge is azimuth 0, azimuth
///                    grows to the right (as seen from inside, so text on the map reads rightly)
///           General  L/Lz = f(chi) phi(Z)/(f(Zs) phi(0)), f(chi) = 1 + c (e^(d chi) - e^(d pi/2))
///                    + e cos^2 chi, phi(Z) = 1 + a e^(b/cos Z); chi from the sun, Z from the
///                    zenith, Zs the sun's; 1 at the zenith
///           TraditionalOvercast  (1 + 2 sin(elevation))/3
///           below the horizon General and TraditionalOvercast are GroundRadiance (default 0)
///   Source  ISO 15469:2004 / CIE S 011:2003, eq. 1 to 6 and table 1; Moon and Spencer (1942)
///   Fails   InputError naming SkyCoefficients, SunDirection, GroundRadiance or EnvironmentMap
class SkyRadiance
{
public:
  static std::shared_ptr<const SkyRadiance> Uniform();
  static std::shared_ptr<const SkyRadiance> Overcast(double groundRadiance = 0.0);
  /// `toSun`: East, North, Up; any length but zero.
  static std::shared_ptr<const SkyRadiance> General(
    const std::array<double, 5>& coefficients, const Vec3& toSun, double groundRadiance = 0.0);
  /// `values`: height rows of width pixels of `bands` numbers, from the upper left.
  static std::shared_ptr<const SkyRadiance> Map(
    int width, int height, int bands, std::vector<double> values);

  /// The same sky over a ground of that radiance, relative as the sky's; Uniform and Map have none.
  std::shared_ptr<const SkyRadiance> WithGround(double groundRadiance) const;

  /// a to e of type 1 to 15 of the CIE general sky, and its description.
  static const std::array<double, 5>& TypeCoefficients(int type);
  static const char* TypeName(int type);
  /// True where the distribution depends on where the sun is.
  static bool NeedsSun(int type);
  static constexpr int Types = 15;

  SkyModel Model() const { return this->Kind; }
  /// 1: the same in every band of the light; else as many as the light's Intensity.
  int Bands() const { return this->BandCount; }
  const std::array<double, 5>& Coefficients() const { return this->Abcde; }
  const Vec3& ToSun() const { return this->Sun; } // unit; East, North, Up
  double GroundRadiance() const { return this->Ground; }
  int Width() const { return this->Columns; }   // of a map; else 0
  int Height() const { return this->Rows; }
  const std::vector<double>& Values() const { return this->Pixels; }

  /// Relative radiance toward a unit direction (East, North, Up).
  double At(const Vec3& direction, int band = 0) const;

private:
  SkyRadiance() = default;

  SkyModel Kind = SkyModel::Uniform;
  int BandCount = 1;
  std::array<double, 5> Abcde{};
  Vec3 Sun{ 0.0, 0.0, 1.0 };
  double AtZenith = 1.0; // f(Zs) phi(0)
  double Ground = 0.0;
  int Columns = 0;
  int Rows = 0;
  std::vector<double> Pixels;
};

} // namespace radiometry
