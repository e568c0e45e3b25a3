// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementTree.h"
#include "radiometry/geometry/PairExchange.h"
#include "radiometry/irradiance/ExchangeOptions.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <cstdint>
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
  // Standard errors of a row's form factor, for the elements of A and of B.
  float FormA, FormB; // by the form of the kernel
  float SightA, SightB; // by visibility
};

using NodePair = std::pair<std::int32_t, std::int32_t>;

/// Divides pairs of nodes until the exchange between them is as alike as the tolerance asks for.
///   Accepts  a pair when F times the spread of the kernel about its linear model, and F times the
///            spread of what is seen, stay below the allowance on both sides; pairs that matter
///            less than that are linked however rough they are
///   Sees     rays between points of both nodes (keyed on the nodes); what is seen in part is
///            divided on
///   Elements by PairExchange and PairVisibility
class ClusterRefiner
{
public:
  struct Tally
  {
    std::int64_t Pairs = 0, Rays = 0;
  };

  /// `occlusion` false: nothing hides anything. `loosened`: factor on the allowance.
  ClusterRefiner(const ElementTree& tree, const ElementSet& elements,
    const OcclusionScene& occluders, const ExchangeOptions& options, bool occlusion,
    double loosened);

  /// All links of a pair, appended; (node, node): those within the node. False when more than
  /// `most` were found (the rest is then missing).
  bool Refine(
    NodePair pair, std::size_t most, std::vector<ClusterLink>& links, Tally& tally) const;
  /// Divides pairs that no link would do for until there are `wanted`, as tasks for Refine.
  std::vector<NodePair> Tasks(std::size_t wanted, std::vector<ClusterLink>& links, Tally& tally) const;

private:
  /// One step: appends a link, pairs to go on with, or nothing where nothing is exchanged.
  void Step(NodePair pair, std::vector<ClusterLink>& links, std::vector<NodePair>& more,
    Tally& tally) const;
  void LinkElements(NodePair pair, std::vector<ClusterLink>& links, Tally& tally) const;
  void Divide(NodePair pair, std::vector<NodePair>& more) const;
  struct Sight
  {
    double Fraction = 1.0, Spread = 0.0, Error = 0.0;
  };
  Sight Look(NodePair pair, double factor, Tally& tally) const;

  const ElementTree& Tree;
  const ElementSet& Elements;
  const OcclusionScene& Occluders;
  std::vector<ExchangePatch> Shapes;
  double Tolerance, FormAllowance, SightAllowance;
  std::uint64_t Seed;
  bool Occlusion;
};

} // namespace radiometry
