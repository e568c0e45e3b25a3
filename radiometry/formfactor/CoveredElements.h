// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Archive.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/scene/Patch.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// Elements that lie in one plane, face the same side and overlap (duplicated faces, say): of two the
/// one of the triangle with the lower number is on top. What it covers of the other one sends nothing
/// and is seen by nothing, but receives what arrives on top: there the two are in one place.
///   Model    F_e = S_e/A_e + sum_k w_ek F_k: S counts the uncovered part of e, w_ek is the share of e
///            that k covers
///   Limits   where only a part is covered, the exchange of e is taken in proportion to what is left
///            of it, and k receives evenly: right as elements shrink
///   Cost     O(n log n)
class CoveredElements
{
public:
  CoveredElements() = default;
  explicit CoveredElements(
    const std::vector<Patch>& patches, int threads = 0, const StageProgress& stage = {});

  bool Empty() const { return this->Covers.empty(); }
  /// The share of an element that is not covered, 0 to 1.
  double Uncovered(std::size_t i) const { return this->Left.empty() ? 1.0 : this->Left[i]; }
  /// Adds to covered elements what arrives on top of them; values of element i, band b at i bands + b.
  void Receive(double* values, int bands) const;
  /// A covered element, what covers it, and how much of it.
  struct Cover
  {
    std::int32_t Element, Top;
    double Share;
  };
  /// Those on top come before those they cover.
  const std::vector<Cover>& All() const { return this->Covers; }
  std::size_t MemoryBytes() const
  {
    return this->Covers.size() * sizeof(Cover) + this->Left.size() * sizeof(double);
  }

  void Save(ArchiveWriter& out) const;
  /// Throws std::runtime_error where it is not of n elements.
  void Load(ArchiveReader& in, std::size_t n);

private:
  std::vector<Cover> Covers;
  std::vector<double> Left; // empty: nothing is covered
};

} // namespace radiometry
