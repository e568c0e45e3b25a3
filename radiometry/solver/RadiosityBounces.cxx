// SPDX-License-Identifier: BSD-3-Clause
// RadiosityLevel: a limited number of bounces.
#include "radiometry/solver/RadiosityLevel.h"

#include "radiometry/formfactor/GroupedOperator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiometry
{
namespace
{

using Values = RadiosityLevel::Values;

double Greatest(const Values& values)
{
  return values.empty() ? 0.0 : std::max(0.0, *std::max_element(values.begin(), values.end()));
}

/// A field over the elements with one value a group, as where each cell has one radiosity.
void Merge(const std::vector<std::int32_t>& group, std::size_t count,
  const std::vector<double>& areas, std::size_t bands, Values& field)
{
  Values sum(count * bands, 0.0), area(count, 0.0);
  for (std::size_t e = 0; e < group.size(); ++e)
  {
    const auto g = static_cast<std::size_t>(group[e]);
    area[g] += areas[e];
    for (std::size_t b = 0; b < bands; ++b)
    {
      sum[g * bands + b] += areas[e] * field[e * bands + b];
    }
  }
  for (std::size_t e = 0; e < group.size(); ++e)
  {
    const auto g = static_cast<std::size_t>(group[e]);
    for (std::size_t b = 0; b < bands; ++b)
    {
      field[e * bands + b] = sum[g * bands + b] / area[g];
    }
  }
}

} // namespace

/// E = E_0 + F R E_0 + ... + (F R)^n E_0, E_0 what comes from lights and from what emits.
///
/// What is left out is sum_{k > n} (F R)^k E_0. With q the greatest share that a unit of irradiance
/// everywhere makes of itself in a bounce, |F R x| <= q max|x|: so each term is at most q times the
/// greatest value of the one before, and all that follow term n sum to at most q/(1 - q) of its
/// greatest value.
void RadiosityLevel::SumBounces(
  const RadiosityContext& context, const DiffuseScattering& scattering)
{
  const std::size_t nb = context.Bands;
  const std::size_t n = this->Elements.Size();
  const int bands = static_cast<int>(nb);
  const bool perCell = context.Options.Refinement == RefinementMode::Off;
  std::size_t count = 0;
  const std::vector<std::int32_t> group =
    perCell ? this->Elements.CellGroups(count) : std::vector<std::int32_t>();
  Values term = this->First, arrived(n * nb), sent(n * nb);
  this->Leaving.assign(n * nb, 0.0);
  if (this->Emitters.Empty())
  {
    this->Leaving = this->Optics.Exitance;
    this->F->Apply(this->Leaving.data(), arrived.data(), bands);
    for (std::size_t k = 0; k < term.size(); ++k)
    {
      term[k] += arrived[k];
    }
  }
  Values all = term;
  for (int bounce = 0; bounce < context.Options.MaximumBounces; ++bounce)
  {
    scattering.Apply(term.data(), sent.data(), nb);
    if (perCell)
    {
      Merge(group, count, this->Elements.GetAreas(), nb, sent);
    }
    this->F->Apply(sent.data(), term.data(), bands);
    ++this->Iterations;
    double greatest = 0.0;
    for (std::size_t k = 0; k < term.size(); ++k)
    {
      this->Leaving[k] += sent[k];
      all[k] += term[k];
      greatest = std::max(greatest, std::abs(term[k]));
    }
    if (greatest == 0.0)
    {
      break;
    }
  }
  this->Gathered.resize(n * nb);
  for (std::size_t k = 0; k < all.size(); ++k)
  {
    this->Gathered[k] = all[k] - this->First[k];
  }
  std::fill(this->SolverError.begin(), this->SolverError.end(), 0.0);
  const Values one(n * nb, 1.0);
  scattering.Apply(one.data(), sent.data(), nb);
  this->F->Apply(sent.data(), arrived.data(), bands);
  const double q = Greatest(arrived);
  double greatest = 0.0;
  for (const double t : term)
  {
    greatest = std::max(greatest, std::abs(t));
  }
  this->LeftOut = greatest == 0.0 ? 0.0
    : q < 1.0                     ? greatest * q / (1.0 - q)
                                  : std::numeric_limits<double>::infinity();
}

} // namespace radiometry
