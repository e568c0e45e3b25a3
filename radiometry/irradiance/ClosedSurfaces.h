// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// The closed surfaces of a scene: connected triangles each of whose edges two of them share, turned
/// alike. Nothing outside is seen from the side that they turn inward.
///   Limits  a surface that cuts through itself may be open to the sky where it is said to be
///           closed; whoever asks must have found no light there by rays
///   Cost    O(triangles log triangles) once
class ClosedSurfaces
{
public:
  explicit ClosedSurfaces(const Scene& scene);

  /// True when the receiver lies on the inner side of a closed surface.
  bool Encloses(const Patch& patch) const;
  bool Encloses(const SurfacePoint& point) const;

private:
  bool Encloses(std::int32_t triangle, const Vec3& normal) const;

  const Scene& Geometry;
  std::vector<std::int8_t> Inward; // triangles: 1 fronts inward, -1 backs inward, 0 not closed
};

} // namespace radiometry
