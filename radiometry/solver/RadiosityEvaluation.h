// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/solver/RadiosityLevel.h"

#include <array>
#include <vector>

namespace radiometry
{

/// Cells darker than this share of the mean are held to the tolerance of the share.
inline constexpr double DarkestShare = 0.05;

/// What a cell's side lacks in its worst band: parts of its error as shares of what is allowed.
struct CellState
{
  float Area = 0.0f; // m^2; 0: receives nothing
  float Excess = 0.0f; // of the whole; above 1: unfinished
  float Direct = 0.0f, Visibility = 0.0f, Discretisation = 0.0f;
  float Bounds = 0.0f; // form factors and solver, which add up

  /// By what factor its rays have to be more for it to be finished, were they all that is changed;
  /// infinite where that is not enough.
  double RayNeed() const;
  /// What no ray changes.
  double WithoutRays() const;
};
using CellStates = std::array<std::vector<CellState>, 2>; // front, back

/// Averages a level's values over the cells and puts the parts of their errors together: fills
/// values, errors, budget and a row of Convergence of the result.
///   Error   hypot(direct, visibility, discretisation) + form factors + solver. Visibility of
///           elements is independent (squares add); the rest may have one sign (adds)
///   Returns true when 95 % of the cells and of their area meet the tolerance. `unfinished` gets 1 for each element
///           of a cell that does not; `states` what each cell lacks
bool EvaluateRadiosity(const RadiosityContext& context, const RadiosityLevel& level,
  const char* stage, RadiosityResult& result, std::vector<std::uint8_t>* unfinished,
  CellStates* states = nullptr);

} // namespace radiometry
