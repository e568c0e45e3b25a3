// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/scene/Scene.h"

#include <algorithm>
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

/// The part of a segment that lies inside half-spaces, as shares of its length from A to B.
struct SegmentPart
{
  double Begin = 0.0;
  double End = 1.0;

  /// Keeps what lies where a height is positive that is `a` at A and `b` at B; false: nothing.
  bool Keep(double a, double b)
  {
    if (a <= 0.0 && b <= 0.0)
    {
      return false;
    }
    if (a <= 0.0)
    {
      this->Begin = std::max(this->Begin, a / (a - b));
    }
    else if (b <= 0.0)
    {
      this->End = std::min(this->End, a / (a - b));
    }
    return true;
  }
  bool Any() const { return this->Begin < this->End; }
};

/// Every line at which the shadow of a scene's surface can begin or end, whatever the light: the
/// edges of its triangles, and the lines at which triangles cut through one another. Depends on
/// geometry only (and on where its transmittance changes).
///   Model  each edge belongs to one of its triangles; each node of the tree over the triangles
///          knows a cone that holds the normals on both sides of all edges below it, so that a
///          search may leave out subtrees that a light sees from one side only
///   Cost   O(n log n) time, 12 bytes a triangle and 20 a node
class ShadowLines
{
public:
  /// `tree` holds the boxes of the scene's triangles, in coordinates (p - center) scale; it must
  /// outlive this.
  ShadowLines(
    const Scene& scene, const BoxTree& tree, const Vec3& center, double scale, int threads,
    const StageProgress& stage);

  /// What Across says of an edge that is no fold between two triangles.
  static constexpr std::int32_t Always = -1;    // borders, where more than two triangles meet, where
                                                // the transmittance changes: it may bound a shadow
                                                // whatever the light
  static constexpr std::int32_t Elsewhere = -2; // the same, but another triangle stands for it

  /// Of the edge from corner k to corner k + 1 of triangle t: the number 3 t' + k' of the same edge
  /// in the triangle t' that alone shares it, or one of the above.
  std::int32_t Across(std::size_t edge) const { return this->Twins[edge]; }
  /// True when the triangle of this edge stands for it: every edge has one such.
  bool Owns(std::size_t edge) const
  {
    const std::int32_t twin = this->Twins[edge];
    return twin == Always || (twin >= 0 && static_cast<std::size_t>(twin) > edge);
  }

  /// Where other triangles cut through a receiving triangle.
  const std::vector<Segment3>& Crossings(std::int32_t triangle) const
  {
    static const std::vector<Segment3> none;
    if (!this->Crossed(triangle))
    {
      return none;
    }
    const auto found = this->Cut.find(triangle);
    return found->second;
  }
  bool Crossed(std::int32_t triangle) const
  {
    return !this->IsCut.empty() && this->IsCut[triangle] != 0;
  }

  /// How far rounding of the scene's coordinates may move a point, m.
  double Tolerance() const { return this->Rounding; }

  /// A cone of directions: an axis and the spread about it; CosSpread -1 where anything may be.
  struct Cone
  {
    float Axis[3];
    float CosSpread;
    float SinSpread;
  };
  const BoxTree& Tree;
  const Vec3 Center;
  const double Scale;
  /// Of each node of the tree: the normals on both sides of all edges below that may be folds; -1
  /// also where an edge below may bound a shadow whatever the light.
  std::vector<Cone> Cones;

private:
  void FindTwins(const Scene& scene, int threads);
  void FindCones(const Scene& scene);
  Cone TriangleCone(const Scene& scene, std::int32_t t) const;
  bool GoesOn(
    const Scene& scene, const Vec3& through, const Vec3& normal, std::int32_t edge) const;
  void FindCrossings(const Scene& scene, int threads, const StageProgress& stage);

  double Rounding = 0.0;
  std::vector<std::int32_t> Twins;
  std::unordered_map<std::int32_t, std::vector<Segment3>> Cut;
  std::vector<std::uint8_t> IsCut; // by receiving triangle; empty: none is
};

} // namespace radiometry
