// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/GroupedOperator.h"

#include "radiometry/formfactor/LinkedSets.h"

#include <cmath>
#include <utility>

namespace radiometry
{

GroupedOperator::GroupedOperator(
  const FormFactorOperator& inner, std::vector<std::int32_t> group, std::size_t count)
  : Inner(inner)
  , Group(std::move(group))
  , GroupAreas(count, 0.0)
  , Share(Group.size())
  , RowSums(count * RowBands(), 0.0)
{
  for (std::size_t e = 0; e < this->Group.size(); ++e)
  {
    this->GroupAreas[static_cast<std::size_t>(this->Group[e])] += inner.Areas()[e];
  }
  const std::size_t bands = this->RowBands();
  std::vector<double> sums(this->Group.size() * bands);
  for (std::size_t e = 0; e < this->Group.size(); ++e)
  {
    this->Share[e] = inner.Areas()[e] / this->GroupAreas[static_cast<std::size_t>(this->Group[e])];
    for (std::size_t b = 0; b < bands; ++b)
    {
      sums[e * bands + b] = inner.RowSum(e, static_cast<int>(b));
    }
  }
  this->Restrict(sums.data(), this->RowSums.data(), static_cast<int>(bands));
}

void GroupedOperator::Restrict(const double* elements, double* groups, int bands) const
{
  const auto nb = static_cast<std::size_t>(bands);
  for (std::size_t k = 0; k < this->GroupAreas.size() * nb; ++k)
  {
    groups[k] = 0.0;
  }
  for (std::size_t e = 0; e < this->Group.size(); ++e)
  {
    const auto g = static_cast<std::size_t>(this->Group[e]);
    const double share = this->Share[e];
    for (std::size_t b = 0; b < nb; ++b)
    {
      groups[g * nb + b] += share * elements[e * nb + b];
    }
  }
}

void GroupedOperator::Prolong(const double* groups, double* elements, int bands) const
{
  const auto nb = static_cast<std::size_t>(bands);
  for (std::size_t e = 0; e < this->Group.size(); ++e)
  {
    for (std::size_t b = 0; b < nb; ++b)
    {
      elements[e * nb + b] = groups[static_cast<std::size_t>(this->Group[e]) * nb + b];
    }
  }
}

void GroupedOperator::Apply(const double* B, double* out, int bands) const
{
  const std::size_t values = this->Group.size() * static_cast<std::size_t>(bands);
  std::vector<double> fine(values), result(values);
  this->Prolong(B, fine.data(), bands);
  this->Inner.Apply(fine.data(), result.data(), bands);
  this->Restrict(result.data(), out, bands);
}

void GroupedOperator::ApplyError(
  const double* B, double* formFactor, double* visibility, int bands) const
{
  const auto nb = static_cast<std::size_t>(bands);
  const std::size_t values = this->Group.size() * nb;
  std::vector<double> fine(values), ff(values), vis(values);
  this->Prolong(B, fine.data(), bands);
  this->Inner.ApplyError(fine.data(), ff.data(), vis.data(), bands);
  // Truncation may have one sign (add); sampling of different rows is nearly independent.
  this->Restrict(ff.data(), formFactor, bands);
  for (std::size_t k = 0; k < this->GroupAreas.size() * nb; ++k)
  {
    visibility[k] = 0.0;
  }
  for (std::size_t e = 0; e < this->Group.size(); ++e)
  {
    const auto g = static_cast<std::size_t>(this->Group[e]);
    const double share = this->Share[e];
    for (std::size_t b = 0; b < nb; ++b)
    {
      visibility[g * nb + b] += share * share * vis[e * nb + b] * vis[e * nb + b];
    }
  }
  for (std::size_t k = 0; k < this->GroupAreas.size() * nb; ++k)
  {
    visibility[k] = std::sqrt(visibility[k]);
  }
}

std::vector<std::int32_t> GroupedOperator::Components() const
{
  // Groups join the components of their members.
  const std::vector<std::int32_t> fine = this->Inner.Components();
  LinkedSets sets(fine.size());
  std::vector<std::int32_t> first(this->GroupAreas.size(), -1);
  for (std::size_t e = 0; e < fine.size(); ++e)
  {
    auto& f = first[static_cast<std::size_t>(this->Group[e])];
    if (f < 0)
    {
      f = fine[e];
    }
    else
    {
      sets.Join(fine[e], f);
    }
  }
  std::vector<std::int32_t> number(fine.size(), -1), out(first.size());
  std::int32_t next = 0;
  for (std::size_t g = 0; g < first.size(); ++g)
  {
    auto& label = number[static_cast<std::size_t>(sets.Root(first[g]))];
    if (label < 0)
    {
      label = next++;
    }
    out[g] = label;
  }
  return out;
}

std::size_t GroupedOperator::MemoryBytes() const
{
  return this->Inner.MemoryBytes() + this->Group.size() * sizeof(std::int32_t) +
    (this->Group.size() + 2 * this->GroupAreas.size()) * sizeof(double);
}

std::string GroupedOperator::Description() const
{
  return this->Inner.Description() + ", in " + std::to_string(this->Size()) + " groups";
}

} // namespace radiometry
