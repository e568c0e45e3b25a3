// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <cstddef>
#include <string>
#include <vector>

namespace radiometry
{

/// Which angles a candela web is given in, numbered as in LM-63.
enum class WebType
{
  C = 1, // planes through the vertical axis: the usual luminaire
  B = 2, // planes through a horizontal axis: floodlights
  A = 3  // as B about the other horizontal axis: headlamps, signals
};

/// A luminous or radiant intensity distribution on a grid of two angles (a "photometric web").
///
/// In the luminaire's own frame the light hangs and sends its light down: -z is its axis, x the
/// direction of C = 0 (length of an IES luminaire), y that of C = 90. With angles of the file
///   C   d = (sin g cos C, sin g sin C, -cos g)          horizontal C, vertical g (gamma)
///   B   d = (cos H sin V, -sin H, -cos H cos V)         horizontal H, vertical V
///   A   d = (sin Y, -cos Y sin X, -cos Y cos X)         horizontal X, vertical Y
/// so that zero angles are the axis in each, and the solid angle is sin g dg dC, cos H dH dV or
/// cos Y dX dY (B taken as C is the usual defect: it is some 7 % wrong).
///
/// Model   bilinear in the two angles: continuous inside the grid (at a pole where the file gives
///         one value there); 0 outside it. Values are relative to the greatest, so it is 1.
/// Symmetry  a grid that covers a part is completed, by its first and last horizontal angle:
///   C   0: the same in every plane; 0..90: four quadrants; 0..180, or 90..270 or -90..90: two
///       halves; 0..360; 0..last above 180 without 360: closed with the first plane
///   B, A  -90..90 as it is; 0..90, of either angle: mirrored
/// Source  ANSI/IES LM-63-02 (R2008), sections 3 and 5; CIE 121
/// Fails   InputError: too few or falling angles, angles or values out of range, no value above 0
class CandelaWeb
{
public:
  /// Angles in degrees, ascending; values [W/sr, cd or relative], plane by plane: those of the first
  /// horizontal angle, with all vertical ones, first. `name` is named in errors.
  CandelaWeb(WebType type, std::vector<double> horizontal, std::vector<double> vertical,
    std::vector<double> values, const std::string& name = "PhotometricWeb");

  WebType GetType() const { return this->Type; }
  /// The completed grid, degrees.
  const std::vector<double>& GetHorizontal() const { return this->Horizontal; }
  const std::vector<double>& GetVertical() const { return this->Vertical; }
  /// Values of the completed grid relative to the greatest, plane by plane.
  const std::vector<double>& GetValues() const { return this->Values; }
  /// The greatest value, in the unit of what was given.
  double GetGreatest() const { return this->Greatest; }

  /// Relative intensity in a direction of the luminaire's frame (any length but zero).
  double Intensity(const Vec3& direction) const;
  /// The same by the angles of the file, degrees.
  double IntensityAt(double horizontal, double vertical) const;
  /// The direction of these angles (degrees) in the luminaire's frame.
  Vec3 DirectionOf(double horizontal, double vertical) const;
  /// Flux into the whole sphere per unit of the greatest value [sr]: exact for the interpolant.
  double TotalFlux() const { return this->Flux; }

  /// The grid about its pole, for integration: theta from the pole, psi the azimuth, in radians.
  ///   theta = g, H + 90 or Y + 90 degrees; psi = C, V or X
  struct PolarGrid
  {
    std::vector<double> Theta;
    std::vector<double> Psi;      // one: the same all round; covers the circle when Closed
    std::vector<double> Value;    // Psi x Theta
    std::vector<double> CellFlux; // Psi x (Theta - 1): int I sin(theta) d theta over each interval
    std::vector<double> Below;    // Psi x Theta: the same from the first theta up to this one
    Vec3 AxisX, AxisY, Pole;      // psi = 0, psi = 90 degrees, theta = 0, in the luminaire's frame
    double Handedness = 1.0;      // of AxisX, AxisY, Pole
    bool Closed = false;          // psi goes round
    bool Seamless = false;        // and its last values are its first

    std::size_t Thetas() const { return this->Theta.size(); }
    std::size_t Psis() const { return this->Psi.size(); }
  };
  const PolarGrid& Grid() const { return this->Polar; }

  /// int (a + b (theta - from)) sin(theta) d theta from `from` to `to`, without cancellation.
  static double SineIntegral(double from, double to, double a, double b);

private:
  void Check(const std::string& name) const;
  void Complete(const std::string& name);
  void MakePolar();

  WebType Type;
  std::vector<double> Horizontal;
  std::vector<double> Vertical;
  std::vector<double> Values;
  double Greatest = 0.0;
  double Flux = 0.0;
  PolarGrid Polar;
};

} // namespace radiometry
