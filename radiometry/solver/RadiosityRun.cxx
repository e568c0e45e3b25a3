// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/RadiosityRun.h"

#include "radiometry/formfactor/DenseOperator.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/solver/RadiosityEvaluation.h"
#include "radiometry/visibility/Convexity.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace radiometry
{
namespace
{

constexpr std::size_t DefaultMemory = std::size_t(2) << 30;
constexpr int FirstRays = 64;
constexpr double FirstTolerance = 0.03;
constexpr int FinerRounds = 8;
constexpr int MostRays = 16384;

const char* const MetOutcome = "the tolerance is met by 95 % of the cells and of their area";

const char* MethodName(RadiosityMethod method)
{
  switch (method)
  {
    case RadiosityMethod::Dense:
      return "Dense";
    case RadiosityMethod::Hierarchical:
      return "Hierarchical";
    case RadiosityMethod::MonteCarlo:
      return "MonteCarlo";
    default:
      return "Auto";
  }
}

} // namespace

RadiosityRun::RadiosityRun(
  const Scene& scene, const OcclusionScene& occluders, const RadiosityOptions& options)
  : Context{ scene, occluders, options }
{
  this->Context.Bands = static_cast<std::size_t>(scene.Optics.Bands);
  this->Context.Memory = options.MemoryLimit ? options.MemoryLimit : DefaultMemory;
  this->Context.Convex = FindConvexity(scene) != Convexity::General;
}

std::size_t RadiosityRun::DenseLimit() const
{
  std::size_t n = this->Context.Options.RelativeTolerance < 0.003 ? 8192 : 4096;
  while (n > 64 && DenseOperator::LeastBytes(n) > this->Context.Memory)
  {
    n = n * 3 / 4;
  }
  return n;
}

std::size_t RadiosityRun::AutomaticLimit() const
{
  // Where nothing hides anything pairs need no rays; else rays from elements are the cheaper way
  // to all but the finest tolerances.
  const std::size_t limit = this->DenseLimit();
  const bool rays = this->Context.Options.Method == RadiosityMethod::Auto &&
    this->Context.Options.Occlusion && !this->Context.Convex &&
    this->Context.Options.RelativeTolerance >= 0.005;
  return rays ? std::min<std::size_t>(limit, 1024) : limit;
}

RadiosityMethod RadiosityRun::Choose(const ElementSet& elements)
{
  const std::size_t n = elements.Size();
  const std::string count = std::to_string(n) + " elements";
  std::string& why = this->Result.MethodWhy;
  if (this->Context.Options.Method == RadiosityMethod::Hierarchical)
  {
    throw InputError(
      "Method", -1, "Hierarchical", "Auto, Dense or MonteCarlo: not available in this version");
  }
  if (this->Context.Options.Method == RadiosityMethod::MonteCarlo &&
    !this->Context.Options.Occlusion)
  {
    throw InputError("Method", -1, "MonteCarlo",
      "Auto or Dense where Occlusion is off: rays cannot pass through what they meet");
  }
  if (this->Context.Options.Method != RadiosityMethod::Auto)
  {
    why = std::string(MethodName(this->Context.Options.Method)) + " as asked";
    return this->Context.Options.Method;
  }
  if (!this->Context.Options.Occlusion)
  {
    why = "Dense: occlusion is off, and rays cannot pass through what they meet";
    return RadiosityMethod::Dense;
  }
  const std::size_t limit = this->AutomaticLimit();
  const double wanted = std::clamp(10.0 / this->Context.Options.RelativeTolerance, 200.0, 2000.0);
  const std::size_t fine = this->Context.Options.Refinement == RefinementMode::Off
    ? n
    : elements.CountAtArea(this->Area / wanted);
  if (n > limit || fine > limit + limit / 2)
  {
    why = "MonteCarlo: " + count + " (" + std::to_string(fine) +
      " when refined for the tolerance), more than the " + std::to_string(limit) +
      " whose pairs would be worth their rays and memory";
    return RadiosityMethod::MonteCarlo;
  }
  const double threads = this->Context.Options.Threads > 0 ? this->Context.Options.Threads : 2.0;
  if (2e-6 * static_cast<double>(n) * static_cast<double>(n) / threads > 0.5 * this->Left())
  {
    why = "MonteCarlo: all pairs of " + count + " do not fit in the time budget";
    return RadiosityMethod::MonteCarlo;
  }
  why = "Dense: all pairs of " + count + " are few";
  return RadiosityMethod::Dense;
}

void RadiosityRun::Illuminate(RadiosityLevel& level, const StageProgress& stage)
{
  StageProgress lights = stage;
  lights.Name = "direct light";
  this->Timed(
    "direct light", [&] { level.IlluminateByLights(this->Context, this->Left(), lights); });
  StageProgress emitters = stage;
  emitters.Name = "emitters";
  emitters.Begin = emitters.End;
  if (!level.Emitters.Empty())
  {
    this->Timed("emitters", [&] { level.IlluminateByEmitters(this->Context, emitters); });
  }
}

/// Finer where first light is uneven (up to `uneven` elements), and where small things stand close
/// to large elements (up to `room`; `complete` tells whether that was enough).
std::unique_ptr<RadiosityLevel> RadiosityRun::RefineByLight(ElementSet elements, std::size_t room,
  std::size_t uneven, bool& complete, const StageProgress& stage)
{
  const double width = stage.End - stage.Begin;
  for (int round = 0;; ++round)
  {
    StageProgress part = stage;
    part.Begin = stage.Begin + width * (1.0 - std::pow(0.5, round));
    part.End = 0.5 * (part.Begin + stage.End);
    auto level = std::make_unique<RadiosityLevel>(this->Context, elements);
    this->Illuminate(*level, part);
    if (this->Context.Options.Refinement == RefinementMode::Off || round == FinerRounds ||
      this->Left() < 0.0)
    {
      return level;
    }
    const std::size_t n = elements.Size();
    const auto share = [n](std::size_t most) { return most > n ? (most - n) / 6 : 0; };
    std::vector<std::uint8_t> finer = level->Uneven(this->Context, share(uneven));
    this->Timed("refinement", [&] {
      part.Begin = part.End;
      part.Name = "refinement";
      const std::vector<std::uint8_t> crowded = level->Crowded(this->Context, n, part);
      std::size_t allowed = share(room);
      for (std::size_t e = 0; e < n; ++e)
      {
        complete = complete && !(crowded[e] && allowed == 0);
        if (crowded[e] && allowed > 0)
        {
          finer[e] = 1;
          --allowed;
        }
      }
    });
    if (std::none_of(finer.begin(), finer.end(), [](std::uint8_t m) { return m != 0; }))
    {
      return level;
    }
    elements = elements.Divided(finer);
  }
}

bool RadiosityRun::RunDense(const ElementSet& coarsest, const StageProgress& stage)
{
  const bool refine = this->Context.Options.Refinement != RefinementMode::Off;
  const std::size_t limit = std::max(this->AutomaticLimit(), coarsest.Size());
  double area = refine ? this->Area / 200.0 : std::numeric_limits<double>::infinity();
  while (refine && coarsest.CountAtArea(area) > limit)
  {
    area *= 2.0;
  }
  // Coarse elements need no fine exchange: both get finer, as the error asks for the one or the
  // other.
  this->Context.Tolerance =
    std::max(this->Context.Options.RelativeTolerance, refine ? FirstTolerance : 0.0);
  this->Result.Outcome = "as fine as this version solves";
  const double span = stage.End - stage.Begin;
  double begin = stage.Begin;
  for (int step = 0;; ++step)
  {
    // Later steps take most of the time: each gets half of what is left.
    const auto part = [&](double from, double to, const char* name) {
      StageProgress p = stage;
      const double width = 0.5 * (stage.Begin + span - begin);
      p.Begin = begin + from * width;
      p.End = begin + to * width;
      p.Name = name;
      return p;
    };
    const double started = this->Result.Convergence.Elapsed();
    ElementSet elements = coarsest.DividedToArea(area);
    if (!refine && 4 * coarsest.Size() <= limit)
    {
      // One radiosity a cell, and the solve without that restriction to know what it costs.
      elements = coarsest.Divided(std::vector<std::uint8_t>(coarsest.Size(), 1));
    }
    bool complete = true;
    std::unique_ptr<RadiosityLevel> level =
      this->RefineByLight(elements, limit, 0, complete, part(0.0, 0.2, "direct light"));
    if (!complete && this->MayTurnToRays())
    {
      return false;
    }
    this->Timed("exchange", [&] {
      level->F = std::make_unique<DenseOperator>(this->Context.Geometry, this->Context.Occluders,
        level->Elements, this->Context.Exchange(), part(0.2, 0.8, "exchange"));
    });
    this->Timed("solve", [&] { level->Solve(this->Context, true, part(0.8, 1.0, "solve")); });
    begin = part(0.0, 1.0, "").End;
    const bool met = EvaluateRadiosity(this->Context, *level, "solved", this->Result, nullptr);
    const std::size_t n = coarsest.CountAtArea(area);
    this->Finest = std::move(level);
    if (met && !(this->Context.Options.Refinement == RefinementMode::On && n == coarsest.Size()))
    {
      this->Result.Outcome = MetOutcome;
      return true;
    }
    if (!refine)
    {
      this->Result.Outcome = "one radiosity a cell, as asked";
      return true;
    }
    // Finer elements where they limit, finer exchange where that does.
    const RadiosityErrorBudget& budget = this->Result.Budget;
    const double sampled = budget.Direct + budget.Visibility + budget.FormFactors;
    const double tolerance = this->Context.Tolerance;
    if (sampled > 0.3 * budget.Discretisation)
    {
      this->Context.Tolerance = std::max(this->Context.Options.RelativeTolerance, 0.3 * tolerance);
    }
    std::size_t count = n;
    double next = area;
    if (budget.Discretisation > 0.3 * sampled)
    {
      next = 0.25 * area;
      while (coarsest.CountAtArea(next) > limit && next < 0.7 * area)
      {
        next *= 1.2;
      }
      count = coarsest.CountAtArea(next);
      if (count > limit || count <= n)
      {
        next = area;
        count = n;
      }
    }
    if (count == n && this->Context.Tolerance == tolerance)
    {
      if (budget.Discretisation > 0.3 * sampled)
      {
        return false;
      }
      this->Result.Outcome = "sampling of direct light and visibility limits the error";
      return true;
    }
    const double ratio = static_cast<double>(count) / static_cast<double>(n);
    const double predicted = (this->Result.Convergence.Elapsed() - started) * ratio * ratio *
      (tolerance / this->Context.Tolerance);
    if (predicted > this->Left())
    {
      this->Result.Outcome = "the time budget does not allow a finer step";
      return true;
    }
    area = next;
  }
}

void RadiosityRun::RunMonteCarlo(const ElementSet& coarsest, const StageProgress& stage)
{
  // Elements fine enough for the tolerance, as far as rays for them fit in time and memory.
  ElementSet elements = coarsest;
  if (this->Context.Options.Refinement != RefinementMode::Off)
  {
    double wanted = std::clamp(60.0 / this->Context.Options.RelativeTolerance, 500.0, 6000.0);
    std::size_t most = std::max<std::size_t>(2 * coarsest.Size(), 30000);
    most = std::min(most, this->Context.Memory / 2 / (FirstRays * 4 + 200));
    while (coarsest.CountAtArea(this->Area / wanted) > most && wanted > 50.0)
    {
      wanted *= 0.7;
    }
    elements = coarsest.DividedToArea(this->Area / wanted);
  }
  const double span = stage.End - stage.Begin;
  const auto part = [&](double from, double to, const char* name) {
    StageProgress p = stage;
    p.Begin = stage.Begin + from * span;
    p.End = stage.Begin + to * span;
    p.Name = name;
    return p;
  };
  this->Context.Tolerance = this->Context.Options.RelativeTolerance;
  bool complete = true;
  const std::size_t room = 2 * std::max<std::size_t>(elements.Size(), 8000);
  std::unique_ptr<RadiosityLevel> level =
    this->RefineByLight(elements, room, room, complete, part(0.0, 0.2, "direct light"));
  const std::size_t n = level->Elements.Size();
  std::size_t neighbourhoods = 0;
  const std::vector<std::int32_t> neighbourhood =
    level->Elements.Groups(this->Context.Geometry, 3, neighbourhoods);
  double raySeconds = 0.0;
  this->Timed("rays", [&] {
    const double begin = this->Result.Convergence.Elapsed();
    int rays = FirstRays;
    if (this->Context.Options.TimeBudget > 0.0)
    {
      rays = static_cast<int>(
        std::clamp(0.2e6 * this->Left() / static_cast<double>(n), 16.0, double(FirstRays)));
    }
    auto carlo = std::make_unique<MonteCarloOperator>(this->Context.Occluders, level->Elements,
      this->Context.Exchange(), rays, part(0.2, 0.3, "rays"));
    level->Carlo = carlo.get();
    level->F = std::move(carlo);
    raySeconds = (this->Result.Convergence.Elapsed() - begin) /
      static_cast<double>(std::max<std::int64_t>(1, level->F->Samples()));
  });
  double at = 0.3, lastMet = 0.0, lastExcess = std::numeric_limits<double>::infinity();
  for (int rounds = 0;; ++rounds)
  {
    const double round = this->Result.Convergence.Elapsed();
    this->Timed("solve",
      [&] { level->Solve(this->Context, rounds == 0 || rounds == 2, part(at, at, "solve")); });
    const double solveSeconds = this->Result.Convergence.Elapsed() - round;
    std::vector<std::uint8_t> unfinished;
    const bool met = EvaluateRadiosity(this->Context, *level, "rays", this->Result, &unfinished);
    if (met)
    {
      this->Result.Outcome = MetOutcome;
      break;
    }
    if (this->Result.MetShare < lastMet + 0.01 && this->Result.Excess > 0.93 * lastExcess)
    {
      this->Result.Outcome = "more rays no longer help: the elements' size limits the rest";
      break;
    }
    lastMet = this->Result.MetShare;
    lastExcess = this->Result.Excess;
    // More rays where rays are what limits: by neighbourhoods, for to ask each element by itself
    // would end with those whose rays happen to have missed what is bright.
    std::vector<double> wanting(neighbourhoods, 0.0), whole(neighbourhoods, 0.0);
    for (std::size_t e = 0; e < n; ++e)
    {
      bool limits = false;
      for (std::size_t b = 0; b < this->Context.Bands; ++b)
      {
        const std::size_t k = e * this->Context.Bands + b;
        limits = limits ||
          level->VisibilityError[k] >
            0.3 * (std::abs(level->Discretisation[k]) + level->DirectError[k]);
      }
      const auto g = static_cast<std::size_t>(neighbourhood[e]);
      whole[g] += level->Elements.GetAreas()[e];
      wanting[g] += unfinished[e] && limits ? level->Elements.GetAreas()[e] : 0.0;
    }
    std::int64_t more = 0;
    for (std::size_t e = 0; e < n; ++e)
    {
      const auto g = static_cast<std::size_t>(neighbourhood[e]);
      unfinished[e] = wanting[g] > 0.1 * whole[g] && level->Carlo->Rays(e) < MostRays;
      more += unfinished[e] ? level->Carlo->Rays(e) : 0;
    }
    if (more == 0)
    {
      this->Result.Outcome = "the elements' size limits the error, not the rays";
      break;
    }
    if (level->F->MemoryBytes() + static_cast<std::size_t>(more) * 4 > this->Context.Memory)
    {
      this->Result.Outcome = "the memory limit does not allow more rays";
      break;
    }
    if (static_cast<double>(more) * raySeconds + 2.0 * solveSeconds > this->Left())
    {
      this->Result.Outcome = "the time budget does not allow more rays";
      break;
    }
    const double to = at + 0.3 * (1.0 - at);
    this->Timed("rays", [&] { level->Carlo->DoubleRays(unfinished, part(at, to, "rays")); });
    at = to;
  }
  this->Finest = std::move(level);
}

} // namespace radiometry
