// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/scene/Scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// Triangles whose shadow is that of one convex thing.
struct ConvexGroup
{
  /// A flat sheet: its rim, counter-clockwise about its normal. Empty: a closed body.
  std::vector<Vec3> Rim;
  Vec3 Normal;
  /// A body: its edges, with the two faces that meet there.
  struct Edge
  {
    Vec3 A, B;
    std::array<std::int32_t, 2> Faces; // of Triangles
  };
  std::vector<Edge> Edges;
  /// A body: of each triangle the outward unit normal n and the height of its plane: before it where
  /// n . x > height.
  struct Face
  {
    Vec3 Normal;
    double Height;
  };
  std::vector<Face> Faces;
  Vec3 Middle; // inside it
  std::vector<std::int32_t> Triangles;
  std::vector<Vec3> Corners;
  Box3 Box;
};

/// Finds flat sheets of several triangles with a convex rim (a divided wall), and closed convex bodies
/// (boxes, balls), among opaque triangles joined by edges of just two of them. Faces may be off a
/// body's convexity by the rounding of single precision.
///   Cost  O(n log n), and faces x corners for each body, in all no more than some 1e8
class ConvexGroups
{
public:
  /// `edges`: the number of the edge of each triangle's sides, from 0; `rounding` of coordinates, m.
  ConvexGroups(const Scene& scene, const std::vector<std::array<std::int32_t, 3>>& edges,
    std::size_t edgeCount, double rounding);

  std::size_t Size() const { return this->Groups.size(); }
  const ConvexGroup& operator[](std::size_t g) const { return this->Groups[g]; }
  /// The group of a triangle; -1: none.
  std::int32_t Of(std::int32_t t) const { return this->GroupOf[t]; }

private:
  bool MakeBody(const Scene& scene, ConvexGroup& group) const;
  bool MakeSheet(const Scene& scene, double rounding, ConvexGroup& group) const;

  std::vector<ConvexGroup> Groups;
  std::vector<std::int32_t> GroupOf;
};

} // namespace radiometry
