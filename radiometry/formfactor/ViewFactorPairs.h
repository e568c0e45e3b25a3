// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/PatchTree.h"
#include "radiometry/formfactor/ViewFactors.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/visibility/Blockers.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

namespace radiometry
{

/// The exchange of two groups (by their places in the tree, I <= J): S = A_I F_IJ = A_J F_JI.
struct GroupExchange
{
  std::int32_t I, J;
  double Value;      // m^2
  double Truncation; // bound of what rules and rounding may have changed, m^2
  double Sampling;   // what 95 % of samples' errors stay below, m^2
  double Error() const { return this->Truncation + this->Sampling; }
};

/// A pair of nodes of which part of the exchange is sampled, in rounds: a round's points are fresh
/// and its estimate stands alone, so that what earlier rounds saw decides on where to look and not
/// on what is counted.
struct ExchangeStratum
{
  static constexpr int Sets = 4; // independent sequences
  std::int32_t A, B;             // nodes
  double Exact;                  // the unoccluded exchange, known; below 0: sampled too
  double Weight[Sets] = {};      // sums of the kernel
  double Visible[Sets] = {};     // ... where nothing stands between
  std::uint32_t Done = 0;        // points of each sequence in its last round
  std::uint32_t Wanted = 1;      // in the next; 0: none
  std::uint32_t Round = 0;
  std::int64_t Rays = 0; // of all rounds
  bool Open = false;     // nothing stands between
  double Share = 1.0;    // of a cluster's pairs that count: a half of those with itself
  bool Near = false;     // a cluster pair with triangles that touch or nearly so
  bool AnyVisible = false, AnyHidden = false;

  bool Agreed() const { return !this->AnyVisible || !this->AnyHidden; }
};

/// The exchange between all groups of a tree by pairs of nodes. Ranks (ViewFactorOptions::Ranks)
/// share the pairs and the samples; all have all rows after.
class ViewFactorPairs
{
public:
  /// `blockers` null: nothing stands between any two. `hierarchical`: clusters that are apart are
  /// sampled; else every pair of triangles is taken.
  ViewFactorPairs(const PatchTree& tree, const OcclusionScene& occluders, const Blockers* blockers,
    const ViewFactorOptions& options, bool hierarchical, double pairTolerance);

  /// Told once how many seconds the rest is expected to take; false: to end there, without rows.
  using Forecast = std::function<bool(double seconds)>;
  /// Computes; rows by I, then J. Continues `record`.
  std::vector<GroupExchange> Compute(
    const StageProgress& stage, ConvergenceRecord& record, const Forecast& forecast);

  std::int64_t Pairs() const { return this->PairCount; }
  std::int64_t Rays() const { return this->RayCount; }
  bool OutOfTime() const { return this->Late; }

private:
  struct Item
  {
    std::int32_t A, B; // nodes; A of one group
  };
  /// What an item contributed to two groups' exchange.
  struct Part
  {
    std::int32_t I, J;
    double Value, Truncation, Sampling;
    std::uint64_t First, Strata; // of its strata that are still to be refined
    std::uint64_t Item;
  };
  struct Row
  {
    GroupExchange Exchange;
    std::size_t First, Strata; // in the list of all
    bool Met;
  };
  class Worker;
  enum class Proof
  {
    Visible,
    Hidden,
    Unknown
  };

  bool Apart(const PatchTree::Node& a, const PatchTree::Node& b) const;
  bool Small(const PatchTree::Node& a, const PatchTree::Node& b) const;
  /// Of two flat nodes.
  Proof Prove(std::int32_t a, std::int32_t b) const;
  /// Pairs of a node of one group with a node of any; `own`: of the same group.
  void MakeItems(std::int32_t a, std::int32_t b, bool own, std::vector<Item>& items) const;
  void MakeOwnItems(std::int32_t a, std::vector<Item>& items) const;
  double Goal(const GroupExchange& row) const;
  void Sample(ExchangeStratum& stratum) const;
  void SamplePoint(ExchangeStratum& stratum, int set, const std::array<double, 4>& u) const;
  double NearFraction(std::int32_t a, std::int32_t b, const std::array<double, 4>& u) const;
  double Value(const ExchangeStratum& stratum) const;
  double Variance(const ExchangeStratum& stratum) const;
  double Deviation(const ExchangeStratum& stratum) const;
  double Unnoticed(const ExchangeStratum& stratum, double goal) const;
  /// Sets what a row's strata are to sample first.
  void Begin(
    const GroupExchange& row, double scale, ExchangeStratum* strata, std::size_t count) const;
  /// Sets what a row has got, and what its strata are to sample in the next round; true when there
  /// is none. Adds to `ideal` (may be null) the points of each sequence that would do.
  bool Plan(GroupExchange& row, double known, ExchangeStratum* strata, std::size_t count, bool late,
    double* ideal = nullptr) const;
  /// Returns the points of each sequence that would do.
  double Allot(double goal, double scale, ExchangeStratum* strata, std::size_t count) const;
  bool RunItems(const std::vector<Item>& items, const StageProgress& stage,
    std::vector<Part>& parts, std::vector<ExchangeStratum>& strata, const Forecast& forecast);
  void MakeRows(std::vector<Part>& parts, std::vector<ExchangeStratum>& found,
    std::vector<Row>& rows, std::vector<ExchangeStratum>& strata) const;
  void SampleAll(std::vector<ExchangeStratum>& strata, const StageProgress& stage);
  bool Refine(std::vector<Row>& rows, std::vector<ExchangeStratum>& strata,
    const StageProgress& stage, ConvergenceRecord& record, const Forecast& forecast);
  bool TimeIsUp() const;

  const PatchTree& Tree;
  const OcclusionScene& Occluders;
  const Blockers* Between;
  const ViewFactorOptions& Options;
  bool Hierarchical;
  double PairTolerance;
  std::atomic<std::int64_t> PairCount{ 0 }, RayCount{ 0 };
  std::atomic<std::int64_t> Bytes{ 0 };
  mutable std::atomic<bool> Late{ false };
  /// By how much a round of samples may be larger than the one before.
  static constexpr double LeastGrowth = 2.0, GreatestGrowth = 8.0;
  double Growth = GreatestGrowth;
  const ConvergenceRecord* Clock = nullptr;
};

} // namespace radiometry
