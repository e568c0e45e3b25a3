// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ClosureCorrection.h"

#include "radiometry/formfactor/ConjugateGradients.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

/// Solves (diag(rows) + S) x = right over the closed rows.
std::vector<double> SolveCorrection(const SymmetricProduct& multiply,
  const std::vector<double>& rows, const std::vector<std::uint8_t>& closed,
  const std::vector<double>& right)
{
  std::vector<double> diagonal = rows;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    diagonal[i] = closed[i] ? rows[i] : 0.0;
  }
  const auto product = [&](const std::vector<double>& p, std::vector<double>& out) {
    multiply(p.data(), out.data());
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      out[i] = closed[i] ? out[i] + rows[i] * p[i] : 0.0;
    }
  };
  return ConjugateGradients(product, diagonal, right, 1e-28, 100);
}

} // namespace

std::vector<double> LeastClosure(const SymmetricProduct& multiply, const std::vector<double>& areas,
  const std::vector<std::uint8_t>& closed, double& largest)
{
  const std::size_t n = areas.size();
  const std::vector<double> one(n, 1.0);
  std::vector<double> rows(n), lambda(n, 0.0), defect(n), plain(n), scaled(n);
  multiply(one.data(), rows.data());
  std::vector<double> sums = rows;
  bool changed = false;
  for (int pass = 0; pass < 3; ++pass)
  {
    double size = 0.0;
    for (std::size_t i = 0; i < n; ++i)
    {
      defect[i] = closed[i] ? areas[i] - sums[i] : 0.0;
      size += closed[i] ? defect[i] * defect[i] / areas[i] : 0.0;
    }
    if (size == 0.0)
    {
      break;
    }
    std::vector<double> next = SolveCorrection(multiply, rows, closed, defect);
    double greatest = 0.0;
    for (std::size_t i = 0; i < n; ++i)
    {
      next[i] += lambda[i];
      greatest = std::max(greatest, 2.0 * std::abs(next[i]));
    }
    // An exchange must stay positive.
    if (greatest > 0.5)
    {
      break;
    }
    lambda = std::move(next);
    largest = greatest;
    changed = true;
    // The sums of S_ij (1 + l_i + l_j).
    multiply(one.data(), plain.data());
    multiply(lambda.data(), scaled.data());
    for (std::size_t i = 0; i < n; ++i)
    {
      sums[i] = (1.0 + lambda[i]) * plain[i] + scaled[i];
    }
  }
  return changed ? lambda : std::vector<double>();
}

} // namespace radiometry
