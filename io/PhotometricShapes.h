// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/PhotometricFile.h"

#include <cstdint>
#include <vector>

namespace radiometry::io
{

/// Where a luminaire hangs: its frame (CandelaWeb.h) in the scene.
struct LuminairePlacement
{
  Vec3 Position;
  Vec3 Axis{ 0.0, 0.0, -1.0 };     // unit
  Vec3 Reference{ 1.0, 0.0, 0.0 }; // unit, square to Axis: where C = 0 lies

  /// Turns it about its axis, in the sense in which C grows (counter-clockwise seen from above).
  void Turn(double degrees);
  Vec3 Direction(const Vec3& local) const;
  Vec3 Point(const Vec3& local) const { return this->Position + this->Direction(local); }
};

/// Polygons to look at; Value is one number a point.
struct LuminaireMesh
{
  std::vector<Vec3> Points;
  std::vector<double> Value;
  std::vector<std::vector<std::int32_t>> Polygons; // counter-clockwise seen from outside
};

/// The distribution as a surface about its centre: radius `scale` times the relative intensity,
/// which is also Value. Steps of the web's grid, cut to 5 degrees at most.
LuminaireMesh DistributionSolid(
  const CandelaWeb& web, const LuminairePlacement& placement, double scale);

/// The luminous faces to scale, facing where they send their light: the bottom, and sides of
/// luminous height. None for a point. Curved outlines have 48 corners.
LuminaireMesh OpeningSurface(const LuminousOpening& opening, const LuminairePlacement& placement);

/// n x m places, each for an equal share of the area of the opening seen from below.
std::vector<Vec3> OpeningSamples(
  const LuminousOpening& opening, const LuminairePlacement& placement, int n, int m);

} // namespace radiometry::io
