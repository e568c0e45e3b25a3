// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/VisibleFactor.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// What of a source of unit exitance a point gets.
struct SeenSource
{
  double Whole = 0.0;    // were nothing in the way
  double Visible = 0.0;  // past the blockers
  double Variance = 0.0; // of Visible, where part of it had to be sampled
  std::int64_t Rays = 0;
  bool Touched = false;  // something hides some of it
};

/// A place from which sources are looked at.
struct ViewPoint
{
  Vec3 Place;
  RayEnd End;   // from where rays start: the place, perhaps moved a little from a triangle's rim
  Vec3 Normal;  // that irradiance is about
  Vec3 Horizon; // unit; nothing is seen below this plane through the point; zero: none
};

/// Looks at area sources from points.
///
/// Where a few triangles stand in the pyramid between point and source their shadows are cut out of
/// the source: exact. Where many do, the source is halved, largest part first, until few stand before
/// each part or a proof hides it; of the parts left after `work` of them, rays tell what is seen.
class SourceView
{
public:
  /// `blockers` null: nothing is in the way. `band`: of which panes let their share through; -1:
  /// everything is opaque.
  SourceView(const AreaSources& sources, const Blockers* blockers, const OcclusionScene& occluders,
    int band = -1);

  /// `casters`: what may cast shadows (Blockers::Casters), where that is known to be few; else null.
  SeenSource See(const ViewPoint& from, std::size_t source,
    const std::vector<std::int32_t>* casters, int work, std::uint64_t key) const;

  /// The most triangles and groups whose shadows are cut out one by one.
  static constexpr std::size_t MostCut = 192;
  /// The most triangles among which a proof is looked for.
  static constexpr std::size_t MostProof = 16384;

  /// The most panes whose shadows are cut out one by one.
  static constexpr std::size_t MostPanes = 24;

  bool IsPane(std::int32_t caster) const
  {
    return this->Panes && !this->Blocking->IsGroup(caster) && (*this->Panes)[caster] != 0;
  }
  /// How many of some triangles let light through.
  std::size_t CountPanes(const std::vector<std::int32_t>& triangles) const;
  /// True when the shadows of so many triangles are cut out one by one.
  bool Few(const std::vector<std::int32_t>& triangles) const
  {
    return triangles.size() <= MostCut && this->CountPanes(triangles) <= MostPanes;
  }

  const Blockers* GetBlockers() const { return this->Blocking; }
  const AreaSources& GetSources() const { return this->Sources; }

private:
  struct Part;
  void Look(const ViewPoint& from, std::size_t source, Part& part, std::int64_t& rays) const;
  bool Cut(const ViewPoint& from, std::size_t source, const std::vector<std::int32_t>& triangles,
    std::vector<ConvexPolygon>& pieces, double& visible, std::int64_t& rays) const;
  double Passing(const ViewPoint& from, std::size_t source, const Vec3& to) const;
  void Sample(const ViewPoint& from, std::size_t source, const ConvexPolygon& piece, double whole,
    std::uint64_t key, SeenSource& result) const;

  const AreaSources& Sources;
  const Blockers* Blocking;
  const OcclusionScene& Occluders;
  const std::vector<std::uint8_t>* Panes; // per triangle of the scene; null: all are opaque
  int Band;
  std::vector<std::uint8_t> NearSurface; // per source: a triangle comes near it
};

} // namespace radiometry
