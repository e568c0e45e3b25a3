// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/scene/Scene.h"

#include <cstddef>

namespace radiometry
{

/// Proves, in double and without a ray, that nothing of a scene can hide the sky from a flat
/// receiver: no triangle reaches above its plane or, under a sky that is dark below the horizon,
/// what does reach above it lies no higher than the receiver's lowest point.
///   Cost    O(triangles log triangles) once; a few boxes a question where the answer is near
class OpenSides
{
public:
  explicit OpenSides(const Scene& scene);

  /// `points`: the receiver's corners (or one point), on the plane of unit normal `normal`. `up`:
  /// the zenith of a sky that is dark below the horizon, else null.
  bool Open(const Vec3* points, std::size_t count, const Vec3& normal, const Vec3* up) const;

private:
  const Scene& Geometry;
  BoxTree Tree;
  double Rounding; // of the coordinates, m
};

} // namespace radiometry
