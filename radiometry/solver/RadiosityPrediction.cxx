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
/// What finer elements to come add to the rays that the first ones ask for.
constexpr double ElementsToCome = 1.4;
/// Times the rays there are: so many few rays can tell.
constexpr double NearRays = 10.0;
constexpr double LinksToCome = 6.0;
/// Of an operator, when the time of the whole can be told, and what solves take beside it.
constexpr double EarlyShare = 0.15;
constexpr double SolveShare = 0.08;

} // namespace

double RadiosityRun::Remaining(
  const RadiosityLevel& level, const ElementSet& coarsest, const RadiosityState& state) const
{
  return level.Carlo ? this->RemainingRays(level, state)
    : level.Method == RadiosityMethod::Dense ? this->RemainingPairs(level, coarsest)
                                             : this->RemainingLinks(level);
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

/// Rays at the pace of those so far, each looked at in some solves. Below 0: they are too few to tell.
double RadiosityRun::RemainingRays(
  const RadiosityLevel& level, const RadiosityState& state) const
{
  const auto has = static_cast<double>(std::max<std::int64_t>(1, level.F->Samples()));
  // Few rays overrate what constant elements change: only what they say of themselves counts.
  const bool sure = has >= SureRays * static_cast<double>(level.F->Size());
  if (!sure && ElementsToCome * state.Rays.Rough > NearRays * has)
  {
    return -1.0;
  }
  const double wanted = std::max(
    has + state.Rays.Total, sure ? state.Rays.Wanted : ElementsToCome * state.Rays.Rough);
  return level.ExchangeSeconds * (wanted / has - 1.0) + 2.0 * state.SolveSeconds * wanted / has;
}

/// The next elements, up to as many as are allowed, or the same to a finer tolerance.
double RadiosityRun::RemainingPairs(
  const RadiosityLevel& level, const ElementSet& coarsest) const
{
  const auto n = static_cast<double>(std::max<std::size_t>(1, level.Elements.Size()));
  const auto most = static_cast<double>(this->MostElements(level.Method, coarsest.Size()));
  const double ratio = std::clamp(most / n, 1.0, 4.0);
  return (level.ExchangeSeconds + level.SolveSeconds) * ratio * ratio;
}

/// What links take grows as they are made finer; so many times what the first ones took is the mean
/// over scenes and tolerances.
double RadiosityRun::RemainingLinks(const RadiosityLevel& level) const
{
  return LinksToCome * (level.ExchangeSeconds + level.SolveSeconds);
}

RadiosityRun::OperatorClock::OperatorClock(
  RadiosityRun& run, const RadiosityLevel& level, const StageProgress& stage)
  : Run(run)
  , Level(level)
  , Stage(stage)
  , Start(run.Result.Convergence.Elapsed())
{
}

bool RadiosityRun::OperatorClock::Progress(double fraction, const char* stage)
{
  const double share = (fraction - this->Stage.Begin) / (this->Stage.End - this->Stage.Begin);
  if (share >= EarlyShare && !this->Said && !this->Run.Context.Options.Ranks)
  {
    this->Said = true;
    const double spent = this->Run.Result.Convergence.Elapsed() - this->Start;
    const double all = spent / std::clamp(share, EarlyShare, 1.0);
    const bool finer = this->Run.Context.Options.RelativeTolerance < this->Level.Tolerance;
    this->Run.Predict(all * (finer ? 1.9 : 1.0) + SolveShare * all - spent, this->Stage);
  }
  return !this->Stage.Listener || this->Stage.Listener->Progress(fraction, stage);
}

} // namespace radiometry
