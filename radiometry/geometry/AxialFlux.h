// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <cstddef>

namespace radiometry
{

/// A radiant intensity that depends only on the angle phi from an axis, with 1 on the axis:
///   I(phi) = cos^e(phi) s(phi) inside the cone, 0 outside it and beyond 90 degrees when e > 0,
///   s(phi) = 1, or with a smooth edge ((cos phi - cos outer)/(cos inner - cos outer))^2 between
///   the inner and the outer cone (the recommendation of KHR_lights_punctual).
class AxialDistribution
{
public:
  /// `cosOuter` is -1 for no cone. A smooth edge needs cosInner > cosOuter; else the edge is hard.
  AxialDistribution(double exponent, double cosOuter, bool smooth = false, double cosInner = 1.0);
  /// The same from versines, 1 - cos, which keep the digits of beams narrower than a degree.
  static AxialDistribution FromVersines(
    double exponent, double outer, bool smooth = false, double inner = 0.0);

  /// I(phi) for cos phi.
  double Intensity(double cosine) const { return this->IntensityAt(1.0 - cosine); }
  /// I(phi) for 1 - cos phi.
  double IntensityAt(double versine) const;
  /// G(phi) = int_0^phi I sin = int over cosines from cos(phi) to 1; versine = 1 - cos(phi).
  double Cumulative(double versine) const;
  /// The flux into the whole sphere: 2 pi G(pi), in units of the axial intensity.
  double TotalFlux() const;
  /// True for I = 1 in every direction.
  bool Isotropic() const { return this->Exponent == 0.0 && this->Outer >= 2.0; }
  /// Versine of the angle beyond which nothing is sent.
  double VersineLimit() const { return this->Outer; }
  double VersineInner() const { return this->Inner; }
  double GetExponent() const { return this->Exponent; }

private:
  AxialDistribution() = default;

  double Exponent = 0.0;
  double Outer = 2.0;
  bool SmoothEdge = false;
  double Inner = 2.0;
};

/// 1 - cos of the angle between two unit vectors, without loss for small angles.
inline double Versine(const Vec3& unit, const Vec3& axis)
{
  return 0.5 * LengthSquared(unit - axis);
}

/// Flux that a source at `from` with axis `axis` (unit) sends onto the front of a flat convex
/// polygon, in units of its axial intensity (so that an isotropic source gives the solid angle).
///   Model   Green's theorem on the sphere: flux = -sum over edges of int G(phi) d psi, psi the
///           azimuth about the axis; each edge is a great-circle arc, cut where it crosses a cone,
///           and integrated by Gauss-Legendre panels: any exponent, any cone, the axis inside or
///           outside. Small polygons clear of a cone's edge: a rule of degree 7 on the polygon.
///   Error   about 1e-13 relative; 1e-16/size relative for a polygon of angular size `size` < 1e-3
///           that a cone's edge crosses, for a sliver of that width, and for a cone of that
///           half-angle; `rounding` gets a bound of it, in the unit of the flux.
///   Source  the idea of Arvo 1995 (axial moments as boundary integrals), for any distribution.
double AxialFlux(const Vec3* polygon, std::size_t count, const Vec3& axis,
  const AxialDistribution& distribution, const Vec3& from = {}, double* rounding = nullptr);

} // namespace radiometry
