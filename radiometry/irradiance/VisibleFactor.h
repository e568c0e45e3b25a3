// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/AreaSources.h"
#include "radiometry/visibility/Blockers.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

using Pieces = std::vector<ConvexPolygon>;

/// The parts of a source that point x sees above its horizon (normal n), were nothing in the way.
/// `horizon`: normal of a further plane through x below which nothing is seen (zero: none). Empty
/// where x lies behind the source or in its plane.
void PiecesAbove(
  const Vec3& x, const Vec3& n, const Vec3& horizon, const AreaSource& source, Pieces& pieces);

/// Irradiance at x about n for unit exitance of the pieces: Lambert's contour formula.
double Factor(const Vec3& x, const Vec3& n, const Pieces& pieces);

/// Cuts the shadows of triangles and convex groups of them out of the pieces, in closed form: seen from
/// x, a flat caster hides what lies inside the planes through x and its edges and beyond its own plane; a
/// body what lies inside the planes through x and the edges at which the faces that x sees end.
/// Returns whether anything was hidden. `hidden`, where given, gets the parts that were cut out.
///   Error  rounding only; what lies within rounding of such a plane belongs to both of its sides
///   Cost   some 0.1 us for each caster (a body: 5 ns a face), and for each piece that it divides
bool CutShadows(const Vec3& x, const Blockers& blockers, const std::int32_t* casters,
  std::size_t count, Pieces& pieces, Pieces* hidden = nullptr);

} // namespace radiometry
