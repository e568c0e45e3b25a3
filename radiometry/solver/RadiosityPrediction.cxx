// SPDX-License-Identifier: BSD-3-Clause
// RadiosityRun: what it will still take, told from what its first levels took.
#include "radiometry/solver/RadiosityRun.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

constexpr double SureRays = 256.0;

} // namespace

double RadiosityRun::Remaining(
  const RadiosityLevel& level, const ElementSet& coarsest, const RadiosityState& state) const
{
  return level.Carlo ? this->RemainingRays(level, state)
    : level.Method == RadiosityMethod::Dense ? this->RemainingPairs(level, coarsest)
                                             : this->RemainingLinks(level, coarsest, state);
}

double RadiosityRun::AfterSeconds() const
{
  constexpr double raysOfPoint = 1000.0;
  constexpr double raySeconds = 4e-7; // of one thread
  if (!this->Finest || !this->Finest->F)
  {
    return 0.0;
  }
  const RadiosityLevel& level = *this->Finest;
  const int threads =
    this->Context.Options.Threads > 0 ? this->Context.Options.Threads : AvailableThreads();
  const double each = level.Carlo
    ? level.ExchangeSeconds / static_cast<double>(std::max<std::int64_t>(1, level.F->Samples()))
    : raySeconds / threads;
  return each * raysOfPoint * static_cast<double>(this->Context.Options.PointsAfter);
}

/// Rays at the pace of those so far, each looked at in some solves. Below 0: too early to tell.
double RadiosityRun::RemainingRays(
  const RadiosityLevel& level, const RadiosityState& state) const
{
  const auto has = static_cast<double>(std::max<std::int64_t>(1, level.F->Samples()));
  if (has < SureRays * static_cast<double>(level.F->Size()))
  {
    return -1.0;
  }
  const double wanted = std::max(has + state.Rays.Total, state.Rays.Wanted);
  const double solves = 2.0 * state.SolveSeconds * wanted / has;
  return level.ExchangeSeconds * (wanted / has - 1.0) + solves;
}

double RadiosityRun::RemainingPairs(
  const RadiosityLevel& level, const ElementSet& coarsest) const
{
  (void)coarsest;
  return 4.0 * (level.ExchangeSeconds + level.SolveSeconds);
}

double RadiosityRun::RemainingLinks(
  const RadiosityLevel& level, const ElementSet& coarsest, const RadiosityState& state) const
{
  (void)coarsest;
  (void)state;
  return 2.0 * (level.ExchangeSeconds + level.SolveSeconds);
}

} // namespace radiometry
