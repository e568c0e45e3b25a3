// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ViewFactorClosure.h"

#include "radiometry/formfactor/ConjugateGradients.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

/// out = (diag(W 1) + W) x over the closed groups.
void Multiply(const std::vector<GroupExchange>& rows, const std::vector<double>& weight,
  const std::vector<std::uint8_t>& closed, const std::vector<double>& x, std::vector<double>& out)
{
  std::fill(out.begin(), out.end(), 0.0);
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const auto i = static_cast<std::size_t>(rows[k].I);
    const auto j = static_cast<std::size_t>(rows[k].J);
    if (i == j)
    {
      out[i] += closed[i] ? weight[k] * x[i] : 0.0;
      continue;
    }
    const double flow = weight[k] * ((closed[i] ? x[i] : 0.0) + (closed[j] ? x[j] : 0.0));
    out[i] += closed[i] ? flow : 0.0;
    out[j] += closed[j] ? flow : 0.0;
  }
}

} // namespace

std::vector<double> ExchangeSums(const std::vector<GroupExchange>& rows, std::size_t groups)
{
  std::vector<double> sums(groups, 0.0);
  for (const GroupExchange& row : rows)
  {
    sums[static_cast<std::size_t>(row.I)] += row.Value;
    if (row.I != row.J)
    {
      sums[static_cast<std::size_t>(row.J)] += row.Value;
    }
  }
  return sums;
}

double CloseExchange(std::vector<GroupExchange>& rows, const std::vector<double>& areas,
  const std::vector<std::uint8_t>& closed)
{
  const std::size_t n = areas.size();
  std::vector<double> weight(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    // Rounding at least, so that a sum can be met to rounding.
    const double error = std::max(rows[k].Error(), 1e-15 * rows[k].Value);
    weight[k] = error * error;
  }
  std::vector<double> diagonal(n, 0.0), right(n, 0.0);
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    diagonal[static_cast<std::size_t>(rows[k].I)] += weight[k];
    if (rows[k].I != rows[k].J)
    {
      diagonal[static_cast<std::size_t>(rows[k].J)] += weight[k];
    }
  }
  const std::vector<double> sums = ExchangeSums(rows, n);
  for (std::size_t i = 0; i < n; ++i)
  {
    diagonal[i] = closed[i] ? diagonal[i] : 0.0;
    right[i] = closed[i] ? areas[i] - sums[i] : 0.0;
  }
  const std::vector<double> x = ConjugateGradients(
    [&](const std::vector<double>& p, std::vector<double>& out) {
      Multiply(rows, weight, closed, p, out);
    },
    diagonal, std::move(right), 1e-26, 200);
  double largest = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const auto i = static_cast<std::size_t>(rows[k].I);
    const auto j = static_cast<std::size_t>(rows[k].J);
    const double share = (closed[i] ? x[i] : 0.0) + (i != j && closed[j] ? x[j] : 0.0);
    const double change = std::max(-rows[k].Value, weight[k] * share);
    rows[k].Value += change;
    largest = std::max(largest, std::abs(change) / std::min(areas[i], areas[j]));
  }
  return largest;
}

double CapExchange(std::vector<GroupExchange>& rows, const std::vector<double>& areas)
{
  const std::vector<double> sums = ExchangeSums(rows, areas.size());
  double largest = 0.0;
  for (GroupExchange& row : rows)
  {
    const auto i = static_cast<std::size_t>(row.I);
    const auto j = static_cast<std::size_t>(row.J);
    const double cap = std::min(
      { 1.0, sums[i] > 0.0 ? areas[i] / sums[i] : 1.0, sums[j] > 0.0 ? areas[j] / sums[j] : 1.0 });
    const double change = (1.0 - cap) * row.Value;
    row.Value -= change;
    row.Truncation += change;
    largest = std::max(largest, change / std::min(areas[i], areas[j]));
  }
  return largest;
}

} // namespace radiometry
