// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementTree.h"
#include "radiometry/geometry/PairExchange.h"
#include "radiometry/irradiance/ExchangeOptions.h"
#include "radiometry/visibility/OcclusionScene.h"
#include "radiometry/visibility/PatchBlockers.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace radiometry
{

/// Exchange between all elements of one node of a tree and all of another.
struct ClusterLink
{
  std::int32_t A, B; // nodes, A < B
  float Kernel;      // S / (area of A, area of B), visibility included, times the tree's area
  float Slope;       // t of ExchangeSlope; 0: the same for all pairs
  // Relative to the exchange without what hides it, root mean squares:
  float FormA, FormB;   // of what the kernel misses at elements of A and of B
  float SightA, SightB; // of what visibility misses at elements of A and of B
  float Factor;         // form factor from A to B, unoccluded
};

using NodePair = std::pair<std::int32_t, std::int32_t>;

/// Divides pairs of nodes until the exchange between them is as alike as the tolerance asks for.
///   Accepts  a pair when F times the spread of the kernel about its linear model, and F times the
///            spread of what is seen, stay below the allowance on both sides; pairs that matter
///            less than that are linked however rough they are
///   Sees     all or nothing where PatchBlockers proves it, else by rays between points of both
///            nodes (keyed on the nodes); what is seen in part is divided on, on the side on which
///            it differs
///   Elements by PairExchange and PairVisibility
class ClusterRefiner
{
public:
  struct Tally
  {
    std::int64_t Pairs = 0, Rays = 0;
  };

  /// `blockers` null: nothing hides anything. `loosened`: factor on the allowance.
  ClusterRefiner(const ElementTree& tree, const ElementSet& elements,
    const OcclusionScene& occluders, const PatchBlockers* blockers, const ExchangeOptions& options,
    double loosened, const std::vector<std::uint8_t>& covered);

  /// All links of a pair, appended; (node, node): those within the node. False when more than
  /// `most` were found (the rest is then missing).
  bool Refine(NodePair pair, std::size_t most, std::vector<ClusterLink>& links, Tally& tally) const;
  /// Divides pairs that no link would do for until there are `wanted`, as tasks for Refine.
  std::vector<NodePair> Tasks(
    std::size_t wanted, std::vector<ClusterLink>& links, Tally& tally) const;

private:
  /// A ray between points of two elements, by their places in the tree's order.
  struct Sample
  {
    std::int32_t I, J;
    float Weight;
    bool Visible;
    float Place[4]; // on the unit square of each triangle
  };
  /// A pair to go on with, and how many of the last samples are its own (rays cast for pairs that
  /// held it, which fell on it).
  struct Open
  {
    NodePair Pair;
    std::int32_t Samples = 0;
    bool Mixed = false; // the pair that held it was seen in part
    std::shared_ptr<const PatchBlockers::Candidates>
      Between; // what may stand between; null: unknown
  };
  struct Work
  {
    std::vector<Open> Stack;
    std::vector<Sample> Samples;
    std::vector<Sample> Own; // of the pair in hand
    PatchBlockers::Candidates Found;
    Tally Count;
  };
  struct View
  {
    double Fraction = 1.0;
    double SpreadA = 0.0, SpreadB = 0.0; // root mean square, by elements of A and of B
    double Error = 0.0;                  // of the fraction
  };
  /// Takes the last pair off the stack: appends a link, pairs to go on with, or nothing where
  /// nothing is exchanged.
  void Step(Work& work, std::vector<ClusterLink>& links) const;
  void LinkElements(Open& open, Work& work, std::vector<ClusterLink>& links) const;
  void Divide(const Open& open, Work& work) const;
  void Divide(const Open& open, bool first, Work& work) const;
  double BlockerPlace(const Work& work) const;
  View Look(Open& open, double factor, Work& work) const;
  View LookByRays(const Open& open, double factor, Work& work) const;
  Sight Prove(Open& open, Work& work) const;
  PatchGroup GroupOf(std::int32_t node) const;
  std::pair<Vec3, Vec3> Ends(const Sample& sample) const;
  Sample Cast(NodePair pair, const std::array<double, 4>& u) const;

  const ElementTree& Tree;
  const ElementSet& Elements;
  const OcclusionScene& Occluders;
  std::vector<ExchangePatch> Shapes;   // in the tree's order
  std::vector<std::int32_t> Triangles; // of the scene, in the tree's order
  std::vector<std::uint8_t> Covered;   // of nodes: holds elements before which something stands
  /// The finest factor on the tolerance that rows of either node want (ExchangeOptions).
  double FinestRow(NodePair pair) const
  {
    return this->RowFactor.empty()
      ? 1.0
      : std::min(this->RowFactor[static_cast<std::size_t>(pair.first)],
          this->RowFactor[static_cast<std::size_t>(pair.second)]);
  }

  std::vector<float> RowFactor; // of each node the least of its elements'; empty: 1
  double Tolerance, FormAllowance, SightAllowance, OwnSightAllowance;
  std::uint64_t Seed;
  const PatchBlockers* Blockers;
  std::vector<PlacedPatch> Placed; // in the tree's order
  std::vector<Box3> Boxes;         // of nodes, of placed patches
};

} // namespace radiometry
