// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <vector>

namespace radiometry
{

/// From where rays of a point start: the point itself, or just inside each of the triangles that
/// meet at a vertex, with the normal of each turned to the point's side.
struct PointStart
{
  RayEnd End;
  Vec3 Normal; // a ray below this plane does not start here; zero: any ray does
};
std::vector<PointStart> PointStarts(
  const Scene& scene, const OcclusionScene& occluders, const SurfacePoint& point);

} // namespace radiometry
