// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/scene/Scene.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace radiometry
{

/// A line that may bound a shadow.
struct Segment3
{
  Vec3 A;
  Vec3 B;
};

/// Every line at which the shadow of a scene's surface can begin or end, whatever the light: the
/// edges of its triangles, and the lines at which triangles cut through one another. Depends on
/// geometry only.
///   Cost  O(n log n)
class ShadowLines
{
public:
  /// `tree` holds the boxes of the scene's triangles, in coordinates (p - center) scale.
  ShadowLines(
    const Scene& scene, const BoxTree& tree, const Vec3& center, double scale, int threads,
    const StageProgress& stage);

  struct Edge
  {
    std::int32_t A, B;
    std::int32_t Opposite[2]; // the corners opposite to it; -1: none (a border)
    bool Manifold;            // two triangles or one
  };
  std::vector<Edge> Edges;

  /// Where other triangles cut through a receiving triangle.
  const std::vector<Segment3>& Crossings(std::int32_t triangle) const
  {
    static const std::vector<Segment3> none;
    const auto found = this->Cut.find(triangle);
    return found == this->Cut.end() ? none : found->second;
  }

  /// How far rounding of the scene's coordinates may move a point, m.
  double Tolerance() const { return this->Rounding; }

private:
  void FindEdges(const Scene& scene);
  void FindCrossings(
    const Scene& scene, const BoxTree& tree, const Vec3& center, double scale, int threads,
    const StageProgress& stage);

  double Rounding = 0.0;
  std::unordered_map<std::int32_t, std::vector<Segment3>> Cut;
};

} // namespace radiometry
