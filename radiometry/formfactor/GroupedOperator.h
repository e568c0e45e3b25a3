// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/FormFactorOperator.h"

namespace radiometry
{

/// The same exchange between groups of elements, each of one constant radiosity: the Galerkin
/// projection R F P with P the repetition over members and R the area-weighted mean. Makes one
/// unknown of a cell of many triangles, and the coarse solve from which discretisation error is
/// estimated, out of an operator that exists already.
class GroupedOperator : public FormFactorOperator
{
public:
  /// `inner` must outlive this. `group` gives each element's group in [0, count).
  GroupedOperator(
    const FormFactorOperator& inner, std::vector<std::int32_t> group, std::size_t count);

  std::size_t Size() const override { return this->GroupAreas.size(); }
  const std::vector<double>& Areas() const override { return this->GroupAreas; }
  void Apply(const double* B, double* out, int bands) const override;
  int Bands() const override { return this->Inner.Bands(); }
  double RowSum(std::size_t i, int band = 0) const override
  {
    return this->RowSums[i * this->RowBands() + static_cast<std::size_t>(band) % this->RowBands()];
  }
  void ApplyError(
    const double* B, double* formFactor, double* visibility, int bands) const override;
  std::vector<std::int32_t> Components() const override;
  std::size_t MemoryBytes() const override;
  std::int64_t Samples() const override { return this->Inner.Samples(); }
  ClosureReport Closure() const override { return this->Inner.Closure(); }
  std::string Description() const override;

  /// The group of each element.
  const std::vector<std::int32_t>& Groups() const { return this->Group; }
  /// Area-weighted means of element values over the groups.
  void Restrict(const double* elements, double* groups, int bands) const;
  /// Group values repeated on their elements.
  void Prolong(const double* groups, double* elements, int bands) const;

private:
  std::size_t RowBands() const
  {
    return static_cast<std::size_t>(this->Inner.Bands() > 0 ? this->Inner.Bands() : 1);
  }

  const FormFactorOperator& Inner;
  std::vector<std::int32_t> Group;
  std::vector<double> GroupAreas;
  std::vector<double> Share;   // of each element in its group's area
  std::vector<double> RowSums; // groups x bands that differ
};

} // namespace radiometry
