// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Light.h"
#include "radiometry/scene/Scene.h"
#include "radiometry/visibility/ShadowLines.h"

#include <vector>

namespace radiometry
{

/// The silhouette of a scene as seen from one light: every line at which the shadow of the scene's
/// surface can begin or end. An edge belongs to it unless exactly two triangles meet there and the
/// light's ray through the edge passes from one to the other.
///   Cost    O(edges) for each light; a search costs O(log(silhouette edges))
class Silhouettes
{
public:
  Silhouettes(const Scene& scene, const ShadowLines& lines, const Light& light);

  /// Finds the silhouette segments that touch the inside of the shaft from the flat triangle
  /// (counter-clockwise seen from the light's side) to the light; lines along the shaft's own sides
  /// do not. Appends at most `most` and returns false when there were more.
  bool InShaft(const Triangle3& triangle, std::size_t most, std::vector<Segment3>& found) const;

  /// Keeps those of `candidates` that touch the inside of the triangle's shaft.
  void Narrow(const Triangle3& triangle, const std::vector<Segment3>& candidates,
    std::vector<Segment3>& found) const;

private:
  struct Shaft;
  Shaft MakeShaft(const Triangle3& triangle) const;

  bool Directional;
  Vec3 Position;
  Vec3 Direction;
  double Tolerance; // m: rounding of the scene's coordinates
  std::vector<Segment3> Segments;
  BoxTree Tree;
};

} // namespace radiometry
