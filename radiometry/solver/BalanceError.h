// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/FormFactorOperator.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// Adds to the errors of gathered light (elements x bands, W/m^2) what they do to the energy of each
/// component as a whole.
///   Model   errors e_i of rows that are independent of each other sum to sqrt(sum (A_i e_i)^2), and
///           what a component gets too much it keeps until it is lost: its irradiance is off by
///           that over sum A_i loss_i, everywhere alike. Much where little is lost (a white room
///           with a pinhole), nothing to speak of elsewhere, and nothing at all where all rows sum
///           to one: such components conserve energy by construction. Errors of form factors have
///           one sign over some neighbours: they count as of sixteen together
///   Reads   `component` of each element and `lossShare` (components x bands), as SolveResult has
///           them
void AddBalanceError(const FormFactorOperator& F, const std::vector<std::int32_t>& component,
  const std::vector<double>& lossShare, std::size_t bands, const std::vector<double>& formFactor,
  std::vector<double>& visibility);

} // namespace radiometry
