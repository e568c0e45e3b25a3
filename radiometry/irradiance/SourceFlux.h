// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/AxialFlux.h"
#include "radiometry/irradiance/WebFlux.h"
#include "radiometry/scene/Light.h"

#include <cstddef>
#include <memory>

namespace radiometry
{

/// What one light sends, were nothing in the way, in units of its Intensity (every band alike).
///   Model   flux on a polygon: int I(w) cos(theta) f(r) dA, f = 1/(a + b r + c r^2)
///   Methods isotropic: the solid angle; axial: boundary integral (AxialFlux); candela web: boundary
///           integral (WebFlux); directional: the projected area; legacy attenuation: adaptive
///           quadrature over solid angle
class SourceFlux
{
public:
  SourceFlux(const Light& light, bool spotShape, bool attenuation);

  /// Flux onto the front of a flat convex polygon with unit normal `normal` [m^2 or sr], zero when
  /// the light is behind it. `error` gets the error of the quadrature, where there is one.
  double OnPolygon(
    const Vec3* polygon, std::size_t count, const Vec3& normal, double& error) const;
  /// Irradiance at a point about a unit normal.
  double AtPoint(const Vec3& point, const Vec3& normal) const;
  /// True when the light is on the front side of the plane.
  bool InFront(const Vec3& point, const Vec3& normal) const;

  bool Directional() const { return this->Source.Type == LightType::Directional; }
  /// True when attenuation other than the inverse square of physics is computed.
  bool LegacyAttenuation() const { return this->Legacy; }
  const Light& GetLight() const { return this->Source; }
  const AxialDistribution& GetDistribution() const { return this->Distribution; }

private:
  double Attenuated(const Vec3& a, const Vec3& b, const Vec3& c, double whole, int depth,
    double tolerance, double& error) const;
  double Weighted(const Vec3& a, const Vec3& b, const Vec3& c) const;
  double Falloff(double r) const;
  /// Relative intensity toward a point p, seen from the light, at the distance r.
  double Intensity(const Vec3& p, double r) const;

  Light Source;
  AxialDistribution Distribution;
  std::shared_ptr<const WebFlux> Web; // null: the axial distribution
  bool Legacy; // attenuation other than the inverse square
};

} // namespace radiometry
