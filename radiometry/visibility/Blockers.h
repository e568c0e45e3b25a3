// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Scene.h"
#include "radiometry/visibility/ConvexGroups.h"
#include "radiometry/visibility/Shaft.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace radiometry
{

/// The triangles of a scene as what may stand between a receiver and a light, all in double.
///   Cost  O(n log n) to make; a search costs O(log n + found)
class Blockers
{
public:
  explicit Blockers(const Scene& scene);

  bool Empty() const { return this->Tree.Empty(); }
  const Triangle3& operator[](std::int32_t t) const { return this->Triangles[t]; }
  const Vec3& Normal(std::int32_t t) const { return this->Normals[t]; }
  /// How far rounding of the scene's coordinates may move a point, m.
  double Rounding() const { return this->Tolerance; }

  /// True when a triangle's box comes within rounding of single precision of a box.
  bool AnyNear(const Box3& box) const;

  /// True when every triangle that touches the point lies square to `normal` (unit).
  bool FlatAt(const Vec3& point, const Vec3& normal) const;

  /// Appends the triangles that touch the inside of a shaft; at most `most`, and false when there
  /// were more.
  bool InShaft(const Shaft& shaft, std::size_t most, std::vector<std::int32_t>& found) const;

  /// What casts the shadows of triangles that stand before a light on the plane about `normal`: groups,
  /// numbered after the triangles, in place of their members. A body counts where the light is all
  /// beyond it.
  std::vector<std::int32_t> Casters(
    const std::vector<std::int32_t>& triangles, const Vec3& normal, const Vec3& through) const;
  bool IsGroup(std::int32_t caster) const
  {
    return caster >= static_cast<std::int32_t>(this->Triangles.size());
  }
  const ConvexGroup& Group(std::int32_t caster) const
  {
    return (*this->Groups)[static_cast<std::size_t>(caster) - this->Triangles.size()];
  }

  /// Proof that nothing of the light is seen from anywhere on the receiver. `inside`: all that
  /// touches their shaft.
  ///   Either  one triangle stands across all segments between corners (the crossings of a plane
  ///           by segments between two convex sets lie in the hull of those of their corners)
  ///   Or      no triangle cuts through receiver or light, and every edge inside the shaft has
  ///           triangles on both of its sides as seen from all of the receiver: nothing begins or ends
  bool HideAll(const ConvexPolygon& receiver, const ConvexPolygon& light, const Shaft& shaft,
    const std::vector<std::int32_t>& inside) const;

private:
  bool Cuts(std::int32_t t, const ConvexPolygon& polygon) const;
  bool Parts(std::int32_t t, const ConvexPolygon& receiver, const ConvexPolygon& light) const;
  bool Covers(std::int32_t t, const ConvexPolygon& receiver, const ConvexPolygon& light) const;
  bool Closed(std::int32_t edge, const Segment3& s, const ConvexPolygon& receiver) const;

  std::vector<Triangle3> Triangles;
  std::vector<Vec3> Normals;
  BoxTree Tree;
  double Tolerance = 0.0;
  double Extent = 0.0; // of the coordinates, m
  // Edges by number; the corners opposite to edge e: Opposite[First[e]] to Opposite[First[e + 1]].
  std::vector<std::array<std::int32_t, 3>> EdgeOf;
  std::vector<std::int32_t> First;
  std::vector<Vec3> Opposite;
  std::unique_ptr<ConvexGroups> Groups;
};

} // namespace radiometry
