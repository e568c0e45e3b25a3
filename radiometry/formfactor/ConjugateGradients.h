// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace radiometry
{

/// Solves M x = right for a symmetric positive semidefinite M by conjugate gradients preconditioned
/// with its diagonal.
///   multiply  out = M x, of vectors; 0 in rows that take no part
///   diagonal  of M; 0 or less: the row takes no part
///   goal      ends when the squared residual, in units of the diagonal, is this share of its first
///   Returns   x, 0 in rows that take no part; what was reached where M turns out not to be definite
///   Source    Hestenes and Stiefel 1952
template <class Product>
std::vector<double> ConjugateGradients(Product&& multiply, const std::vector<double>& diagonal,
  std::vector<double> right, double goal, int iterations)
{
  const std::size_t n = right.size();
  std::vector<double>& r = right;
  std::vector<double> x(n, 0.0), z(n), p(n), product(n);
  double rz = 0.0;
  const auto precondition = [&](std::size_t i) {
    z[i] = diagonal[i] > 0.0 ? r[i] / diagonal[i] : 0.0;
    return r[i] * z[i];
  };
  for (std::size_t i = 0; i < n; ++i)
  {
    rz += precondition(i);
    p[i] = z[i];
  }
  goal *= rz;
  for (int iteration = 0; iteration < iterations && rz > goal; ++iteration)
  {
    multiply(p, product);
    double pq = 0.0;
    for (std::size_t i = 0; i < n; ++i)
    {
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

} // namespace radiometry
