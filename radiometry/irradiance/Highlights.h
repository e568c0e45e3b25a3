// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/SeenPolygon.h"
#include "radiometry/irradiance/RadianceTracer.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// How well highlights are wanted.
struct HighlightEffort
{
  double Relative = 0.01;      // error of each band's highlights, relative to them ...
  std::vector<double> Allowed; // ... or so much, per band, W/(m^2 sr)
};

/// Adds what a triangle reflects of point, spot and directional lights by its lobe toward a viewer,
/// averaged over it and times `share`. A triangle whose corners are one point is that point.
///   Model    (1/A) int V f(in, out) E dA of each light; V one ray
///   Method   the triangle is divided about the place where the light is mirrored into the eye, down
///            to the width of the lobe there, so that no highlight is missed however small; then where
///            two rules (16 and 7 points) or four rays differ most, until the effort is met or 400
///            pieces are added
///   Error    differences of the rules, and where shadows end half the highlight of the piece
///   Cost     23 evaluations and 4 rays a light where the lobe is wider than the triangle
/// Returns the rays.
std::int64_t AddHighlights(const RadianceTracer& tracer, const Viewer& viewer,
  const Triangle3& corners, const RadianceTracer::Place& place, double share,
  const HighlightEffort& effort, double* values, double* errors);

} // namespace radiometry
