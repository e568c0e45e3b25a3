// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/BoxTree.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"
#include "radiometry/visibility/BoxShaft.h"

#include <array>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// A patch in the coordinates of PatchBlockers.
struct PlacedPatch
{
  Triangle3 Corners;
  Vec3 Normal;                // unit
  std::int32_t Triangle = -1; // the scene's, on whose plane it lies
};

/// Patches close together, consecutive in memory.
struct PatchGroup
{
  PatchGroup() = default;
  PatchGroup(const PlacedPatch* patches, std::int32_t count);

  const PlacedPatch* Patches = nullptr;
  std::int32_t Count = 0;
  Box3 Bounds;
  Vec3 Center, Half; // of the bounds
};

/// What is known of all segments between two groups.
enum class Sight
{
  Clear,  // nothing stands between: proven
  Hidden, // every segment is blocked: proven
  Mixed   // not known
};

/// The triangles of a scene as what may stand between two patches or two groups of them, in double
/// and without sampling.
///   Method  a triangle stands between groups A and B only where it touches their shaft, unless both
///           lie on one side of its plane, one lies in its plane, or it lies behind every patch of
///           one. Where A and B lie on opposite sides of the planes of a sheet of triangles whose
///           edges within the shaft are all inner ones (both neighbours part A from B), nothing of
///           the sheet begins or ends in the shaft: one segment tells for all of them
///   Cost    O(log n + triangles in the shaft); O(n log n) to make
///   Same as OcclusionScene: a patch's own triangle and those coplanar with it do not hide it; a
///           segment through a triangle's rim is blocked; panes count as opaque
class PatchBlockers
{
public:
  explicit PatchBlockers(const Scene& scene);

  /// Coordinates scaled to the unit box.
  Vec3 Place(const Vec3& p) const { return this->Scale * (p - this->Center); }
  PlacedPatch Place(const Patch& patch) const;
  /// ... and back.
  Vec3 Unplace(const Vec3& p) const { return this->Center + p / this->Scale; }

  /// What may stand between.
  struct Candidates
  {
    std::vector<std::int32_t> Triangles;
    /// Of each: 0 not known, 1 and 2 the groups lie on opposite sides of its plane, the first one
    /// behind and before it. Holds for parts of the groups, too.
    std::vector<std::uint8_t> Parting;
    bool Complete = false; // false: there are more than were kept
  };
  /// What is known between two groups. `from`: the candidates of groups that these are parts of,
  /// or null; `found` gets theirs, at most some `most`.
  Sight Between(const PatchGroup& a, const PatchGroup& b, const Candidates* from,
    Candidates& found, std::size_t most = 160) const;
  /// True when one of the candidates (complete) blocks the segment from x on patch a to y on b.
  bool Blocked(const Vec3& x, const PlacedPatch& a, const Vec3& y, const PlacedPatch& b,
    const Candidates& candidates) const;

private:
  enum class Place3 : std::uint8_t
  {
    Harmless,
    Parts, // the groups lie on opposite sides of its plane
    Across
  };
  struct Candidate
  {
    std::int32_t Triangle = -1;
    Place3 Kind = Place3::Harmless;
    bool AAbove = false; // where it parts: the first group is on the side of its normal
    bool Open = false;   // of a sheet that ends within the shaft
    bool EdgeWithin[3] = {};   // may touch the shaft
    std::int32_t Next[3] = {}; // the candidate beyond each edge
  };
  void Classify(Candidate& c, const PatchGroup& a, const PatchGroup& b) const;
  Sight Sheets(
    const PatchGroup& a, const PatchGroup& b, std::vector<Candidate>& candidates) const;
  bool Crosses(std::int32_t t, const Vec3& x, const Vec3& y) const;

  Vec3 Center;
  double Scale = 1.0;
  std::vector<Triangle3> Triangles;
  std::vector<Vec3> Normals;
  BoxTree Tree;
  // Who else has the edge from corner k of triangle t to the next one: twice the triangle's number,
  // plus one where the fronts of the two are on opposite sides; NoNeighbour where none or several do.
  static constexpr std::int32_t NoNeighbour = -1;
  std::vector<std::array<std::int32_t, 3>> Neighbour;
  std::vector<std::uint8_t> Repeated; // another triangle has the same corners
};

} // namespace radiometry
