// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/PatchTree.h"
#include "radiometry/formfactor/ViewFactors.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace radiometry
{

/// A share of a group's rays, by independent sequences.
struct RayShare
{
  double Value = 0.0;
  double Error = 0.0; // covers 95 %: the sequences' spread, and what so many rays may not notice
};

/// Rays that leave the groups of a tree as diffuse light does, and what they meet.
class ViewFactorRays
{
public:
  static constexpr int Sets = 16;
  enum Fate
  {
    Sky,     // meets nothing, above the horizon
    Ground,  // ... below
    Blocked, // a side that belongs to no group
    HitHigh, // anything, above the horizon
    HitLow,  // ... below
    Fates
  };

  /// `groupOfSide`: by triangle and side (2 t, 2 t + 1) the group's place, -1: none. `count`: hits
  /// are counted group by group.
  ViewFactorRays(const PatchTree& tree, const OcclusionScene& occluders,
    const std::vector<std::int32_t>& groupOfSide, const ViewFactorOptions& options, bool count);

  /// Continues each group's rays to so many.
  void Trace(const std::vector<std::uint32_t>& rays, const StageProgress& stage);

  std::uint32_t Rays(std::int32_t group) const { return Sets * this->Done[group]; }
  RayShare Share(std::int32_t group, Fate fate) const
  {
    std::array<double, Sets> hits;
    for (int set = 0; set < Sets; ++set)
    {
      hits[set] = this->Tallies[group][set][fate];
    }
    return this->Share(group, hits);
  }
  /// No ray met anything but groups.
  bool SeesGroupsOnly(std::int32_t group) const;
  /// Of rays that met groups: the group, and how many of each sequence; by group.
  using Hits = std::pair<std::int32_t, std::array<std::int32_t, Sets>>;
  const std::vector<Hits>& HitsOf(std::int32_t group) const { return this->Met[group]; }
  RayShare Share(std::int32_t group, const std::array<double, Sets>& hits) const;
  std::int64_t Total() const { return this->TotalRays; }

private:
  struct Task
  {
    std::int32_t Group, Set;
    std::uint32_t Begin, End;
  };
  struct Outcome
  {
    std::array<std::int32_t, Fates> Tally{};
    std::vector<std::pair<std::int32_t, std::int32_t>> Hits;
  };
  void Run(const Task& task, Outcome& outcome) const;
  void Merge(const Task& task, const Outcome& outcome);
  void ShareOutcomes(const RankShare& share, std::vector<Outcome>& outcomes) const;

  const PatchTree& Tree;
  const OcclusionScene& Occluders;
  const std::vector<std::int32_t>& GroupOfSide;
  const ViewFactorOptions& Options;
  Vec3 Up;
  bool Count;
  std::vector<std::uint32_t> Done; // rays of each sequence
  std::vector<std::array<std::array<double, Fates>, Sets>> Tallies;
  std::vector<std::vector<Hits>> Met;
  std::int64_t TotalRays = 0;
};

} // namespace radiometry
