// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/scene/Light.h"
#include "radiometry/scene/Scene.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// A line that may bound a shadow.
struct Segment3
{
  Vec3 A;
  Vec3 B;
};

/// The edges of a scene's triangles, each with the corners opposite to it.
class MeshEdges
{
public:
  explicit MeshEdges(const Scene& scene);

  struct Edge
  {
    std::int32_t A, B;
    std::int32_t Opposite[2]; // -1: none (a border)
    bool Manifold;            // two triangles or one
  };
  std::vector<Edge> Edges;
};

/// The silhouette of a scene as seen from one light: every line at which the shadow of the scene's
/// surface can begin or end. An edge belongs to it unless exactly two triangles meet there and the
/// light's ray through the edge passes from one to the other.
///   Cost    O(edges) for each light; a search costs O(log(silhouette edges))
class Silhouettes
{
public:
  Silhouettes(const Scene& scene, const MeshEdges& edges, const Light& light);

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

/// Where triangles of the scene cut through one another: lines at which a shadow can begin without
/// an edge being there. One list of segments for each receiving triangle, mostly empty.
std::vector<std::vector<Segment3>> FindIntersections(
  const Scene& scene, int threads, const struct StageProgress& stage);

} // namespace radiometry
