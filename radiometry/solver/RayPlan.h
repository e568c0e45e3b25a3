// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/solver/RadiosityEvaluation.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// What rays would finish a level, and what they would not.
struct RayPlan
{
  std::vector<std::int32_t> Rays; // to add to each element
  double Total = 0.0;             // of them
  double Wanted = 0.0; // rays in all that the level needs, those it has and those past this step too
  double Rough = 0.0;  // the same by what rays say of their own errors alone
  double Open = 0.0;   // share of the cells or of their area (the greater) that no ray finishes
};

/// Rays for the cells that are cheapest to finish, until as many are as the run needs.
///   Model   errors of rays fall with the root of their number: what a cell lacks says how many it
///           needs. Elements get what their cell needs, but not much less than their neighbourhood:
///           what rays happened to miss seems to need none
///   Step    at most eight times the rays that an element has, while these are few: what they say of
///           their own error is uncertain
RayPlan PlanRays(
  const RadiosityContext& context, const RadiosityLevel& level, const CellStates& states);

} // namespace radiometry
