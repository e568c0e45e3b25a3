// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/solver/RadiosityLevel.h"

namespace radiometry
{

/// Cells darker than this share of the mean are held to the tolerance of the share.
inline constexpr double DarkestShare = 0.05;

/// Averages a level's values over the cells and puts the parts of their errors together: fills
/// values, errors, budget and a row of Convergence of the result.
///   Error   hypot(direct, visibility, discretisation) + form factors + solver. Visibility of
///           elements is independent (squares add); the rest may have one sign (adds)
///   Returns true when 95 % of the cells and of their area meet the tolerance. `unfinished` gets 1 for each element
///           of a cell that does not
bool EvaluateRadiosity(const RadiosityContext& context, const RadiosityLevel& level,
  const char* stage, RadiosityResult& result, std::vector<std::uint8_t>* unfinished);

} // namespace radiometry
