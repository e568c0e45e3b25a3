// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/CandelaWeb.h"

#include <cstddef>
#include <memory>

namespace radiometry
{

struct WebCorner;

/// What a luminaire with a candela web sends through polygons, in units of its greatest intensity.
///   Model   flux = int I d omega, I bilinear in the web's angles. By Green's theorem on the sphere
///           it is the integral along the rim of G(theta, psi) d psi, with
///           G = int I sin(theta) d theta, which has a closed form in each cell of the grid. Every
///           edge is a great-circle arc; it is cut where it crosses a line of the grid, so that
///           every kink of the interpolant and every narrow beam is met exactly, and each piece is
///           integrated by a Gauss rule fit to its length. A small polygon inside one cell: a rule
///           of degree 5 times the exact solid angle.
///   Error   1e-12 of the flux or better, plus 1e-15 of the greatest intensity about the polygon
///           times its angular size, plus (4e-16/delta)^2 where the rim passes a pole of the web at an
///           angle delta; `error` of OnPolygon bounds it
///   Cost    O(lines of the grid that the rim crosses); a small polygon: a few hundred nanoseconds
///   Source  the idea of Arvo 1995 (moments as boundary integrals), for any distribution
class WebFlux
{
public:
  /// `axis` (unit) is the luminaire's axis, `reference` (unit, square to it) the direction of C = 0.
  WebFlux(std::shared_ptr<const CandelaWeb> web, const Vec3& axis, const Vec3& reference);

  /// Relative intensity in a direction of the scene (any length but zero).
  double Intensity(const Vec3& direction) const;
  /// Flux onto the front of a flat convex polygon seen from the light at `from` [sr]; adds a bound on
  /// its rounding and quadrature error to `error`.
  double OnPolygon(
    const Vec3* polygon, std::size_t count, double& error, const Vec3& from = {}) const;

private:
  struct View;

  Vec3 ToGrid(const Vec3& v) const;
  double InCell(
    const View& view, const WebCorner& cell, double size, double sine, double& error) const;
  double AcrossCells(const View& view, double& error) const;

  std::shared_ptr<const CandelaWeb> Web;
  const CandelaWeb::PolarGrid& Grid;
  Vec3 Rows[3]; // of the rotation from the scene to the grid's axes
  double Sign;  // of the flux: the grid's handedness
};

} // namespace radiometry
