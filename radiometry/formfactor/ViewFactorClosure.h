// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ViewFactorPairs.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// sum_J S_IJ of each of n groups.
std::vector<double> ExchangeSums(const std::vector<GroupExchange>& rows, std::size_t groups);

/// Makes the sums of the groups in `closed` equal to their areas by the change of least
/// sum dS^2/Error^2 that keeps S symmetric: what is known well moves least.
///   Method   (diag(W 1) + W) l = A - S 1 over the closed groups, W = Error^2, by conjugate
///            gradients; dS_IJ = W_IJ (l_I + l_J)
///   Limits   entries stay at least 0
///   Returns  the greatest |dS_IJ|/min(A_I, A_J)
double CloseExchange(std::vector<GroupExchange>& rows, const std::vector<double>& areas,
  const std::vector<std::uint8_t>& closed);

/// Scales the rows of groups down whose sums exceed their areas (faces that lie in one another are
/// seen twice), S staying symmetric; errors grow by the change. Returns as above.
double CapExchange(std::vector<GroupExchange>& rows, const std::vector<double>& areas);

} // namespace radiometry
