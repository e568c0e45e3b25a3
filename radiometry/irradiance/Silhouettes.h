// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Light.h"
#include "radiometry/scene/Scene.h"
#include "radiometry/visibility/LightShaft.h"
#include "radiometry/visibility/ShadowLines.h"

#include <vector>

namespace radiometry
{

/// The silhouette of a scene as seen from one light: every line at which the shadow of the scene's
/// surface can begin or end. An edge belongs to it unless exactly two triangles meet there and the
/// light's ray through the edge passes from one to the other.
///   Method  found on demand in a shaft, in the tree over the scene's triangles: nothing is kept for
///           a light, and subtrees that the light sees from one side only are left out
///   Cost    a search: O(log(triangles) + silhouette edges in the shaft) on smooth surfaces
class Silhouettes
{
public:
  /// All three must outlive this.
  Silhouettes(const Scene& scene, const ShadowLines& lines, const Light& light);

  /// Finds the silhouette segments that touch the inside of the shaft from the flat triangle
  /// (counter-clockwise seen from the light's side) to the light; lines along the shaft's own sides
  /// do not. Appends at most `most` and returns false when there were more.
  bool InShaft(const Triangle3& triangle, std::size_t most, std::vector<Segment3>& found) const;
  /// The same in any shaft to this light.
  bool InShaft(const LightShaft& shaft, std::size_t most, std::vector<Segment3>& found) const;

  /// Keeps those of `candidates` that touch the inside of the triangle's shaft.
  void Narrow(const Triangle3& triangle, const std::vector<Segment3>& candidates,
    std::vector<Segment3>& found) const;

  /// True when this edge of the scene (ShadowLines::Across) may bound a shadow.
  bool Bounds(std::size_t edge) const;

private:
  bool OneSided(std::int32_t node) const;

  const Scene& Geometry;
  const ShadowLines& Lines;
  const Light& Source;
  bool Directional;
  Vec3 InTree; // the light in the tree's coordinates, or the direction towards it
  double Margin;
};

} // namespace radiometry
