// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <limits>

namespace radiometry
{

/// From where something is looked at: a point, or a direction from infinitely far away.
struct Viewer
{
  bool Parallel = false;
  Vec3 Eye;                       // m, when not Parallel
  Vec3 Direction{ 0., 0., -1. };  // unit, from the eye toward the scene, when Parallel
  Vec3 Axis{ 0., 0., -1. };       // unit, of the camera, into the scene
  Vec3 Normal{ 0., 0., -1. };     // unit, of the small receiver at the eye

  /// From a place toward the eye, unit; zero when the eye is there.
  Vec3 Toward(const Vec3& place) const
  {
    return this->Parallel ? -this->Direction : Normalized(this->Eye - place);
  }
};

/// Which side of a triangle a viewer sees: 1 the front, -1 the back, 0 neither: the eye lies in its
/// plane as far as rounding lets it be known. An eye on the triangle itself sees its front.
int SeenSide(const Triangle3& triangle, const Vec3& normal, const Viewer& viewer);

/// What an eye sees of a polygon, summed over its triangles.
struct SeenPolygon
{
  double SolidAngle = 0.0;     // sr, of both sides alike, nothing in the way
  double SolidAngleError = 0.0; // what the rounding of coordinates may make of it
  double Projected = 0.0;      // sr: int cos dw about Viewer::Normal, above its horizon
  double ProjectedError = 0.0;
  double AxisProjected = 0.0;  // the same about Viewer::Axis
  double ImageArea = 0.0;      // of its picture on the plane at distance 1 square to the axis;
                               // infinite where it reaches the plane of the eye
  bool Front = false;          // some of its front is seen
  bool Back = false;

  /// Adds a triangle with its unit normal. `extent`: greatest coordinate of the scene, m.
  ///   Model   solid angle: Van Oosterom and Strackee (SolidAngle.h); projected: pi times Lambert's
  ///           contour formula, clipped at the horizon (PolygonFormFactor.h)
  ///   On it   an eye on the triangle itself: the limit from before it, 2 pi; on its rim pi and on a
  ///           corner that corner's angle: the limits along its normal
  void Add(const Triangle3& triangle, const Vec3& normal, const Viewer& viewer, double extent);

  /// Mean of cos^4(alpha) over its picture, alpha the angle from the axis; NaN where that has none.
  double CosFourthMean() const
  {
    return this->ImageArea > 0.0 ? this->AxisProjected / this->ImageArea
                                 : std::numeric_limits<double>::quiet_NaN();
  }
};

} // namespace radiometry
