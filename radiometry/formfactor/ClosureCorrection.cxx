// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/ClosureCorrection.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

/// Solves (diag(rows) + S) x = right over the closed rows, preconditioned by the diagonal.
std::vector<double> SolveCorrection(const SymmetricProduct& multiply,
  const std::vector<double>& rows, const std::vector<std::uint8_t>& closed,
  const std::vector<double>& right)
{
  const std::size_t n = rows.size();
  std::vector<double> x(n, 0.0), r = right, z(n), p(n), product(n);
  double rz = 0.0;
  const auto precondition = [&](std::size_t i) {
    z[i] = closed[i] && rows[i] > 0.0 ? r[i] / rows[i] : 0.0;
    return r[i] * z[i];
  };
  for (std::size_t i = 0; i < n; ++i)
  {
    rz += precondition(i);
    p[i] = z[i];
  }
  const double goal = 1e-28 * rz;
  for (int iteration = 0; iteration < 100 && rz > goal; ++iteration)
  {
    multiply(p.data(), product.data());
    double pq = 0.0;
    for (std::size_t i = 0; i < n; ++i)
    {
      product[i] = closed[i] ? product[i] + rows[i] * p[i] : 0.0;
      pq += p[i] * product[i];
    }
    if (!(pq > 1e-300))
    {
      break;
    }
    const double alpha = rz / pq;
    double next = 0.0;
    for (std::size_t i = 0; i < n; ++i)
    {
      x[i] += alpha * p[i];
      r[i] -= alpha * product[i];
      next += precondition(i);
    }
    const double beta = next / rz;
    rz = next;
    for (std::size_t i = 0; i < n; ++i)
    {
      p[i] = z[i] + beta * p[i];
    }
  }
  return x;
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
