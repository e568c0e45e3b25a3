// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/SeenPolygon.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"

#include <vector>

namespace radiometry
{

/// The middle of the box of the receiving triangles, and half its diagonal.
Vec3 MiddleOf(const Scene& scene, double* radius = nullptr);

/// An eye that sees the whole scene: at the distance where a cone of 30 degrees holds the sphere about
/// its box, looking along -z, as a view's Reset Camera sets it.
Viewer HomeViewer(const Scene& scene);

/// How each cell (or point) is seen. Cells without area are not: 0.
struct SeenSurface
{
  std::vector<double> Facing;  // 1 its front is seen, -1 its back, 0 neither or some of both
  std::vector<double> CosAxis; // of the angle between the axis and the way to its middle
  std::vector<double> OffAxisDegrees;
  std::vector<double> SolidAngle; // sr; of points and for parallel viewers none of these
  std::vector<double> SolidAngleError;
  std::vector<double> Projected;
  std::vector<double> ProjectedError;
  std::vector<double> CosFourthMean; // over its picture; NaN: it has none
};

/// A parallel viewer sees everything at the angle between its direction and its axis.
///   Cost  O(triangles)
SeenSurface LookAtCells(const Scene& scene, const Viewer& viewer);
SeenSurface LookAtPoints(const std::vector<SurfacePoint>& points, const Viewer& viewer);

} // namespace radiometry
