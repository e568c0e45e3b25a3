// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/RadiosityRun.h"

#include "radiometry/scene/Communicator.h"
#include "radiometry/solver/RadiosityEvaluation.h"
#include "radiometry/visibility/Convexity.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace radiometry
{
namespace
{

/// Under other lights a kept operator does for so many of the cells, or for not much fewer than in
/// the run that made it: to make it anew for the rest takes as long as the first time.
constexpr double KeptShare = 0.85;
constexpr double KeptLoss = 0.05;

std::string Percent(double share)
{
  return std::to_string(static_cast<int>(std::floor(100.0 * share))) + " %";
}

const char* const MetOutcome = "the tolerance is met by 95 % of the cells and of their area";

} // namespace

RadiosityRun::RadiosityRun(const Scene& scene, const OcclusionScene& occluders,
  const RadiosityOptions& options, RadiosityCache* cache)
  : Context(scene, occluders, options)
  , Cache(cache)
{
  this->Result.Convergence.PartNames = { "Direct", "FormFactor", "Visibility", "Discretisation",
    "Solver" };
  this->Context.Convex = cache ? cache->Convex() : FindConvexity(scene) != Convexity::General;
}

RadiosityRun::~RadiosityRun()
{
  if (this->Finest && this->Finest->F && this->Cache)
  {
    this->Cache->Keep(this->Context.Geometry, this->Context.Options, std::move(this->Finest));
  }
}

double RadiosityRun::Agreed(double seconds) const
{
  if (this->Context.Options.Ranks)
  {
    this->Context.Options.Ranks->Largest(&seconds, 1);
  }
  return seconds;
}

bool RadiosityRun::MeanMeets() const
{
  const ConvergenceRecord::Row& last = this->Result.Convergence.Rows.back();
  return last.RelativeError <= this->Context.Options.RelativeTolerance ||
    last.AbsoluteError <= this->Context.Options.AbsoluteTolerance;
}

void RadiosityRun::Predict(double remaining, const StageProgress& stage)
{
  RunCost& cost = this->Result.Cost;
  if (cost.PredictedSeconds >= 0.0)
  {
    return;
  }
  const double spent = this->Elapsed();
  const double budget = this->Context.Options.TimeBudget;
  double whole = spent + this->Agreed(std::max(0.0, remaining));
  whole = budget > 0.0 ? std::max(spent, std::min(budget, whole)) : whole;
  cost.PredictedAt = this->Context.Options.SecondsBefore + spent;
  cost.PredictedSeconds = this->Context.Options.SecondsBefore + whole + this->AfterSeconds();
  if (stage.Listener)
  {
    stage.Listener->Predicted(cost.PredictedSeconds);
  }
}

bool RadiosityRun::Resume(const StageProgress& stage)
{
  std::unique_ptr<RadiosityLevel>& level = this->Finest;
  if (this->Cache)
  {
    level = this->Cache->Take(this->Context.Geometry, this->Context.Options);
  }
  if (!level)
  {
    return false;
  }
  const bool same = level->Light == this->Context.Light && level->LitFor.RelativeTolerance > 0.0;
  level->PrepareAgain(this->Context);
  this->Context.Tolerance = level->Tolerance;
  this->Result.MethodWhy = std::string(MethodName(level->Method)) + ": " +
    (level->Source.empty() ? "kept from the run before, geometry is the same" : level->Source);
  if (same)
  {
    this->Result.MethodWhy += " and so are the lights: it goes on from there";
  }
  level->Source.clear();
  this->Timed("direct light", [&] {
    if (same)
    {
      level->IlluminateFiner(this->Context, this->Left(), stage);
    }
    else
    {
      level->Illuminate(this->Context, this->Left(), nullptr, stage);
    }
  });
  this->KeptMetShare = !same && level->F ? level->MetShare : -1.0;
  return true;
}

bool RadiosityRun::SolveLevel(RadiosityLevel& level, const ElementSet& coarsest,
  RadiosityState& state, const StageProgress& stage)
{
  const auto part = [&](double from, double to, const char* name) {
    StageProgress p = stage;
    p.Begin = stage.Begin + from * (stage.End - stage.Begin);
    p.End = stage.Begin + to * (stage.End - stage.Begin);
    p.Name = name;
    return p;
  };
  this->Result.Method = level.Method;
  if (this->Context.Paths && level.Mirrored.Irradiance.empty())
  {
    this->Timed("light over mirrors", [&] {
      level.AddMirrored(this->Context, this->Left(), part(0.1, 0.2, "light over mirrors"));
    });
  }
  if (!level.F)
  {
    this->Timed("exchange", [&] { this->BuildOperator(level, coarsest, part(0.2, 0.8, "exchange")); });
  }
  if (!(level.SolvedFor > 0.0 && level.SolvedFor <= this->Context.Options.RelativeTolerance))
  {
    // What constant elements change is estimated at first, and again when rays have grown to many
    // more: few tell more of their own noise.
    const double samples = static_cast<double>(level.F->Samples()) /
      static_cast<double>(std::max<std::size_t>(1, level.F->Size()));
    const bool discretise = level.DiscretisedAt == 0.0 || samples >= 3.0 * level.DiscretisedAt;
    state.SolveSeconds = this->Timed(
      "solve", [&] { level.Solve(this->Context, discretise, part(0.8, 1.0, "solve")); });
    level.SolveSeconds = state.SolveSeconds;
  }
  state.SolveSeconds = level.SolveSeconds;
  return EvaluateRadiosity(
    this->Context, level, "solved", this->Result, &state.Unfinished, &state.Cells);
}

std::string RadiosityRun::Ended(
  bool met, const RadiosityLevel& level, const ElementSet& coarsest)
{
  const bool atLeastOnce = this->Context.Options.Refinement == RefinementMode::On;
  if (met && !(atLeastOnce && level.Elements.Size() == coarsest.Size()))
  {
    return MetOutcome;
  }
  if (!atLeastOnce && level.Elements.Size() > MostRefined && this->MeanMeets())
  {
    return "the tolerance is met by the mean error, which is enough for more than " +
      std::to_string(MostRefined) + " elements unless Refinement is On; " +
      Percent(this->Result.MetShare) + " of the cells or their area meet it";
  }
  if (this->KeptMetShare >= 0.0 &&
    this->Result.MetShare >= std::min(KeptShare, this->KeptMetShare - KeptLoss))
  {
    return "the tolerance is met by " + Percent(this->Result.MetShare) +
      " of the cells or their area over the exchange that was kept";
  }
  return "";
}

void RadiosityRun::Follow(const ElementSet& coarsest, const StageProgress& stage)
{
  double begin = stage.Begin;
  // Later steps take most of the time: each gets half of what is left.
  const auto part = [&](double from, double to, const char* name) {
    StageProgress p = stage;
    const double width = 0.5 * (stage.End - begin);
    p.Begin = begin + from * width;
    p.End = begin + to * width;
    p.Name = name;
    return p;
  };
  std::unique_ptr<RadiosityLevel>& level = this->Finest;
  if (!this->Resume(part(0.0, 0.5, "direct light")))
  {
    level = this->Begin(this->Choose(coarsest), coarsest, part(0.0, 0.2, "direct light"));
  }
  for (;;)
  {
    RadiosityState state;
    const bool met = this->SolveLevel(*level, coarsest, state, part(0.0, 1.0, ""));
    begin = part(0.0, 1.0, "").End;
    level->MetShare = this->KeptMetShare >= 0.0 ? level->MetShare : this->Result.MetShare;
    this->Result.Outcome = this->Ended(met, *level, coarsest);
    if (!this->Result.Outcome.empty())
    {
      break;
    }
    this->KeptMetShare = -1.0;
    if (level->Carlo)
    {
      state.Rays = PlanRays(this->Context, *level, state.Cells);
    }
    RadiosityAdvance advance = this->Decide(*level, coarsest, state);
    if (!advance.Outcome.empty())
    {
      this->Result.Outcome = std::move(advance.Outcome);
      break;
    }
    const double remaining = this->Remaining(*level, coarsest, state);
    if (remaining >= 0.0)
    {
      this->Predict(remaining, part(0.0, 0.0, "exchange"));
      if (this->Context.Options.PilotOnly)
      {
        this->Result.Outcome = "the pilot is done";
        return;
      }
    }
    if (!advance.Rays.empty())
    {
      level->Carlo->SetSecondsLeft(this->Context.Options.TimeBudget > 0.0
          ? std::max(0.01, this->Left() - 1.5 * state.SolveSeconds)
          : 0.0);
      level->ExchangeSeconds += this->Timed(
        "rays", [&] { level->Carlo->AddRays(advance.Rays, part(0.0, 0.8, "rays")); });
      level->SolvedFor = 0.0;
      continue;
    }
    level = this->Next(advance, std::move(level), coarsest, part(0.0, 0.2, "direct light"));
  }
  this->Predict(0.0, part(0.0, 0.0, "solve"));
  this->CountBounces(*level);
}

void RadiosityRun::CountBounces(const RadiosityLevel& level)
{
  this->Result.BouncesLeftOut = level.LeftOut;
  if (this->Context.Options.MaximumBounces > 0 || !this->Context.Options.Interreflection)
  {
    return;
  }
  // Each bounce adds some share of the one before: as E = E_0 (1 + s + s^2 ...), on average.
  const std::size_t nb = this->Context.Bands;
  std::vector<double> emitted(level.Gathered.size(), 0.0);
  if (level.Emitters.Empty())
  {
    level.F->Apply(level.Optics.Exitance.data(), emitted.data(), static_cast<int>(nb));
  }
  double first = 0.0, all = 0.0;
  for (std::size_t k = 0; k < level.Irradiance.size(); ++k)
  {
    const double area = level.Elements.GetAreas()[k / nb];
    first += area * (level.First[k] + emitted[k]);
    all += area * level.Irradiance[k];
  }
  const double share = all > 0.0 ? std::clamp(1.0 - first / all, 0.0, 1.0) : 0.0;
  const double tolerance = this->Context.Options.RelativeTolerance;
  this->Result.BouncesThatMatter = share <= 0.0 || tolerance <= 0.0 || tolerance >= 1.0 ? 0.0
    : share >= 1.0 ? std::numeric_limits<double>::infinity()
                   : std::max(0.0, std::ceil(std::log(tolerance) / std::log(share)) - 1.0);
}

} // namespace radiometry
