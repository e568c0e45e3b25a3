// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace radiometry
{

/// Multiplies by a symmetric matrix S of exchange areas: out = S x.
using SymmetricProduct = std::function<void(const double* x, double* out)>;

/// The least change sum dS_ij^2/S_ij, symmetric, that makes the rows in `closed` sum to their
/// areas: dS_ij = S_ij (l_i + l_j), l = 0 on the other rows.
///   Method   (diag(r) + S) l = A - r over the closed rows by conjugate gradients, repeated so that
///            the sums are right to rounding
///   Returns  l, empty when nothing is to change or the change would exceed half an entry (then
///            the rows are not what they seem). `largest` gets the largest relative change
std::vector<double> LeastClosure(const SymmetricProduct& multiply, const std::vector<double>& areas,
  const std::vector<std::uint8_t>& closed, double& largest);

} // namespace radiometry
