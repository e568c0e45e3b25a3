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
  if (this->Cache)
  {
    level = this->Cache->Take(this->Context.Geometry, this->Context.Options);
  }
  if (level)
  {
    level->Prepare(this->Context);
    this->Context.Tolerance = level->Tolerance;
    this->Result.MethodWhy =
      std::string(MethodName(level->Method)) + ": " +
      (level->Source.empty() ? "kept from the run before, geometry is the same" : level->Source);
    level->Source.clear();
    this->Timed("direct light", [&] {
      level->Illuminate(this->Context, this->Left(), nullptr, part(0.0, 0.5, "direct light"));
    });
  }
  else
  {
    level = this->Begin(this->Choose(coarsest), coarsest, part(0.0, 0.2, "direct light"));
  }
  const RadiosityLevel* kept = this->Cache && level->F ? level.get() : nullptr;
  const bool atLeastOnce = this->Context.Options.Refinement == RefinementMode::On;
  for (;;)
  {
    this->Result.Method = level->Method;
    if (this->Context.Paths && level->Mirrored.Irradiance.empty())
    {
      this->Timed("light over mirrors", [&] {
        level->AddMirrored(this->Context, this->Left(), part(0.1, 0.2, "light over mirrors"));
      });
    }
    if (!level->F)
    {
      this->Timed("exchange", [&] { this->BuildOperator(*level, part(0.2, 0.8, "exchange")); });
      this->Solves = 0;
    }
    // The estimate of what constant elements change is made at first, and once more with more rays.
    const double solveSeconds = this->Timed("solve", [&] {
      level->Solve(this->Context, this->Solves == 0 || this->Solves == 2, part(0.8, 1.0, "solve"));
    });
    ++this->Solves;
    begin = part(0.0, 1.0, "").End;
    std::vector<std::uint8_t> unfinished;
    const bool met =
      EvaluateRadiosity(this->Context, *level, "solved", this->Result, &unfinished);
    level->MetShare = kept ? level->MetShare : this->Result.MetShare;
    if (met && !(atLeastOnce && level->Elements.Size() == coarsest.Size()))
    {
      this->Result.Outcome = MetOutcome;
      return;
    }
    if (!atLeastOnce && level->Elements.Size() > MostRefined && this->MeanMeets())
    {
      this->Result.Outcome = "the tolerance is met by the mean error, which is enough for more than " +
        std::to_string(MostRefined) + " elements unless Refinement is On; " +
        Percent(this->Result.MetShare) + " of the cells or their area meet it";
      return;
    }
    if (kept && this->Result.MetShare >= std::min(KeptShare, kept->MetShare - KeptLoss))
    {
      this->Result.Outcome = "the tolerance is met by " + Percent(this->Result.MetShare) +
        " of the cells or their area over the exchange that was kept";
      return;
    }
    kept = nullptr;
    RadiosityAdvance advance = this->Decide(*level, coarsest, unfinished, solveSeconds);
    if (!advance.Outcome.empty())
    {
      this->Result.Outcome = std::move(advance.Outcome);
      return;
    }
    if (!advance.Rays.empty())
    {
      level->ExchangeSeconds += this->Timed("rays", [&] {
        for (int k = 0; k < advance.Doublings; ++k)
        {
          level->Carlo->DoubleRays(advance.Rays,
            part(0.8 * k / advance.Doublings, 0.8 * (k + 1) / advance.Doublings, "rays"));
        }
      });
      continue;
    }
    level = this->Next(advance, std::move(level), coarsest, part(0.0, 0.2, "direct light"));
  }
}

} // namespace radiometry
