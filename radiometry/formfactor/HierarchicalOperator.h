// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/formfactor/FormFactorOperator.h"
#include "radiometry/irradiance/ExchangeOptions.h"
#include "radiometry/scene/Archive.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <memory>

namespace radiometry
{

/// Exchange between clusters of elements (ElementTree), linked where it is alike enough for the
/// tolerance (ClusterRefiner); any triangle soup.
///   Model        S_ij = A_i A_j K_ab (1 + first order in places and normals) d_i d_j for i of a,
///                j of b (ExchangeSlope): each pair of elements is covered by at most one link
///   Reciprocity  exact: a link serves both directions
///   Closure      rows that see nothing but elements sum to one to rounding, others not above:
///                S is scaled by d on both sides, the least that does it; a closed row that
///                only a large d would mend takes what is missing from its own element
///                Duplicated faces: CoveredElements
///   Error        squares of the links' errors add (their signs are independent), times what links
///                of one direction have in common, found against all pairs; for closed rows what
///                matters of a link is by how much B differs there from what the row receives: a
///                constant B is received exactly. 2.2 times the form factors' and twice the
///                visibility's hold 95 % on the scenes of HierarchicalAgreementTest
///   Limits       the tolerance is one of a mean B: what a small source far brighter than all else
///                sends is right to the same share of its own B
///   Memory       56 bytes a link, some 400 bytes an element; 2.5 times that while links are made
///   Cost         O(n) links, about (1/tolerance) an element; Apply O(n + links)
///   Fails        InputError{"MemoryLimit"} naming the least that would do. Where the links for
///                the tolerance do not fit, coarser ones are made, and the error says so
class HierarchicalOperator : public FormFactorOperator
{
public:
  HierarchicalOperator(const Scene& scene, const OcclusionScene& occluders,
    const ElementSet& elements, const ExchangeOptions& options, const StageProgress& stage = {});
  ~HierarchicalOperator() override;

  /// Bytes that each of some ranks needs for n elements in most scenes; in clutter more.
  static std::size_t LeastBytes(std::size_t n, int ranks = 1);

  /// Everything but what belongs to the process. Over ranks each saves its own share.
  void Save(ArchiveWriter& out) const;
  /// Throws std::runtime_error where the archive is damaged or of another number of ranks.
  static std::unique_ptr<HierarchicalOperator> Load(
    ArchiveReader& in, int threads = 0, const Communicator* ranks = nullptr);

  std::size_t Size() const override;
  const std::vector<double>& Areas() const override;
  void Apply(const double* B, double* out, int bands) const override;
  double RowSum(std::size_t i, int band = 0) const override;
  void ApplyError(
    const double* B, double* formFactor, double* visibility, int bands) const override;
  std::vector<std::int32_t> Components() const override;
  std::size_t MemoryBytes() const override;
  std::int64_t Samples() const override;
  ClosureReport Closure() const override;
  std::string Description() const override;

  /// Links between nodes, each for both directions.
  std::size_t Links() const;

private:
  HierarchicalOperator();
  struct Internals;
  std::unique_ptr<Internals> Impl;
};

} // namespace radiometry
