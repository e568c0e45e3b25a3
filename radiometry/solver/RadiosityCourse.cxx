// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/formfactor/DenseOperator.h"
#include "radiometry/formfactor/HierarchicalOperator.h"
#include "radiometry/formfactor/MonteCarloOperator.h"
#include "radiometry/solver/ElementOverlap.h"
#include "radiometry/solver/RadiosityRun.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace radiometry
{
namespace
{

constexpr int FirstRays = 64;
/// Rays of an element from which on they tell what they will need, and what elements do.
constexpr double SureRays = 256.0;
/// Share of the cells that may be beyond any number of rays.
constexpr double MostOpen = 0.04;
constexpr double FirstTolerance = 0.03;
/// A part of the error counts as limiting above this share of the other.
constexpr double Limiting = 0.3;
/// The finest tolerance of links of a row, as a share of that of all.
constexpr float FinestLinks = 0.02f;

} // namespace

std::unique_ptr<RadiosityLevel> RadiosityRun::Begin(
  RadiosityMethod method, const ElementSet& coarsest, const StageProgress& stage)
{
  const RadiosityOptions& options = this->Context.Options;
  const bool refine = options.Refinement != RefinementMode::Off;
  const bool dense = method == RadiosityMethod::Dense;
  const std::size_t most = this->MostElements(method, coarsest.Size());
  double area = std::numeric_limits<double>::infinity();
  ElementSet elements = coarsest;
  if (refine)
  {
    // All pairs begin coarse: elements and exchange get finer as the error asks for the one or the
    // other. Others begin with elements that are likely to be fine enough.
    double wanted = dense ? 200.0 : std::clamp(60.0 / options.RelativeTolerance, 500.0, 6000.0);
    const std::size_t room = dense ? most : std::max<std::size_t>(coarsest.Size(), most / 2);
    while (coarsest.CountAtArea(this->Area / wanted) > room && wanted > 1e-3)
    {
      wanted *= 0.7;
    }
    area = this->Area / wanted;
    elements = coarsest.DividedToArea(area);
  }
  else if (dense && 4 * coarsest.Size() <= most)
  {
    // One radiosity a cell, and the solve without that restriction to know what it costs.
    elements = coarsest.Divided(std::vector<std::uint8_t>(coarsest.Size(), 1));
  }
  this->Context.Tolerance =
    std::max(options.RelativeTolerance, refine && dense ? FirstTolerance : 0.0);
  bool complete = true;
  const std::size_t uneven = dense ? 0 : std::min(most, 2 * std::max<std::size_t>(elements.Size(), 8000));
  auto level = this->RefineByLight(
    std::move(elements), dense ? most : uneven, uneven, nullptr, complete, stage);
  level->Method = method;
  level->TargetArea = area;
  level->Tolerance = this->Context.Tolerance;
  if (!complete && dense && this->MayTurnToMany())
  {
    std::string why;
    const RadiosityMethod other = this->ChooseForMany(level->Elements.Size(), why);
    this->Result.MethodWhy = std::string(MethodName(other)) +
      ": small things close to large ones ask for more elements than all pairs allow" + why;
    return this->Begin(other, coarsest, stage);
  }
  return level;
}

std::unique_ptr<RadiosityLevel> RadiosityRun::Next(const RadiosityAdvance& advance,
  std::unique_ptr<RadiosityLevel> level, const ElementSet& coarsest, const StageProgress& stage)
{
  // The old operator makes room for the new one.
  const std::int64_t samples = level->F ? level->F->Samples() : 0;
  level->Carlo = nullptr;
  level->F.reset();
  if (advance.OtherMethod)
  {
    std::string why;
    const RadiosityMethod other = this->ChooseForMany(level->Elements.Size(), why);
    this->Result.MethodWhy = std::string(MethodName(other)) +
      ": the tolerance asks for more elements than all pairs allow" + why;
    return this->Begin(other, coarsest, stage);
  }
  this->Context.Tolerance = advance.Tolerance;
  if (!advance.Rows.empty())
  {
    level->RowTolerance = advance.Rows;
  }
  if (advance.Divided.empty() && advance.Area == level->TargetArea)
  {
    level->Tolerance = advance.Tolerance;
    return level;
  }
  const bool dense = level->Method == RadiosityMethod::Dense;
  const std::size_t most = this->MostElements(level->Method, coarsest.Size());
  ElementSet elements = advance.Divided.empty() ? coarsest.DividedToArea(advance.Area)
                                                : level->Elements.Divided(advance.Divided);
  bool complete = true;
  const std::size_t uneven = dense ? 0 : most;
  auto next =
    this->RefineByLight(std::move(elements), most, uneven, level.get(), complete, stage);
  next->Method = level->Method;
  next->TargetArea = advance.Area;
  next->Tolerance = advance.Tolerance;
  next->Rays = static_cast<int>(samples / static_cast<std::int64_t>(level->Elements.Size()));
  next->BeginFrom(*level, this->Context.Bands);
  if (!complete && dense && this->MayTurnToMany())
  {
    RadiosityAdvance turn;
    turn.OtherMethod = true;
    return this->Next(turn, std::move(next), coarsest, stage);
  }
  return next;
}

void RadiosityRun::BuildOperator(
  RadiosityLevel& level, const ElementSet& coarsest, const StageProgress& stage)
{
  const double begin = this->Result.Convergence.Elapsed();
  ExchangeOptions exchange = this->Context.Exchange();
  exchange.RowTolerance = level.RowTolerance.empty() ? nullptr : &level.RowTolerance;
  if (this->Context.Options.TimeBudget > 0.0)
  {
    exchange.SecondsLeft = std::max(0.01, 0.7 * this->Left());
  }
  if (level.Method == RadiosityMethod::MonteCarlo)
  {
    const auto n = static_cast<double>(level.Elements.Size());
    double rays = std::max(level.Rays, FirstRays);
    if (this->Context.Options.TimeBudget > 0.0)
    {
      rays = std::clamp(0.2e6 * this->Left() / n, 16.0, rays);
    }
    rays = std::min(rays, 0.8 * static_cast<double>(this->Context.Memory) / (4.0 * n));
    exchange.SecondsLeft *= 0.5; // a solve follows, and perhaps more rays
    auto carlo = std::make_unique<MonteCarloOperator>(this->Context.Occluders, level.Elements,
      exchange, std::max(8, static_cast<int>(rays)), stage);
    level.Carlo = carlo.get();
    level.F = std::move(carlo);
  }
  else if (level.Method == RadiosityMethod::Hierarchical)
  {
    level.F = std::make_unique<HierarchicalOperator>(
      this->Context.Geometry, this->Context.Occluders, level.Elements, exchange, stage);
  }
  else
  {
    OperatorClock clock(*this, level, stage);
    StageProgress told = stage;
    const bool last =
      4 * level.Elements.Size() > this->MostElements(level.Method, coarsest.Size());
    told.Listener = last ? &clock : stage.Listener;
    level.F = std::make_unique<DenseOperator>(
      this->Context.Geometry, this->Context.Occluders, level.Elements, exchange, told);
  }
  level.ExchangeSeconds = this->Agreed(this->Result.Convergence.Elapsed() - begin);
}

RadiosityAdvance RadiosityRun::Decide(
  const RadiosityLevel& level, const ElementSet& coarsest, const RadiosityState& state)
{
  if (level.Carlo)
  {
    return this->DecideRays(level, coarsest, state);
  }
  RadiosityAdvance advance;
  advance.Tolerance = level.Tolerance;
  advance.Area = level.TargetArea;
  const RadiosityErrorBudget& budget = this->Result.Budget;
  const double sampled = budget.Direct + budget.Visibility + budget.FormFactors;
  const bool elements = budget.Discretisation > Limiting * sampled;
  const double error = this->Result.Convergence.Rows.back().RelativeError;
  const bool finerExchange = sampled > Limiting * budget.Discretisation &&
    this->FinerExchange(level, state, advance);
  double ratio = 1.0;
  const bool dense = level.Method == RadiosityMethod::Dense;
  const bool finerElements = (elements || (!finerExchange && !dense)) &&
    this->FinerElements(level, coarsest, state.Unfinished, advance, ratio);
  if (finerExchange || finerElements)
  {
    if (finerElements && !dense)
    {
      if (error > 0.93 * this->DividedError)
      {
        advance.Outcome = "finer elements no longer help";
      }
      this->DividedError = error;
    }
    const double predicted = 2.0 * state.SolveSeconds * ratio +
      level.ExchangeSeconds * std::pow(ratio, dense ? 2.0 : 1.0) * level.Tolerance /
        advance.Tolerance;
    if (advance.Outcome.empty() && predicted > this->Left())
    {
      advance.Outcome = "the time budget does not allow a finer step";
    }
  }
  else if (this->Context.Options.Refinement == RefinementMode::Off)
  {
    advance.Outcome = "one radiosity a cell, as asked";
  }
  else if (elements && dense && this->MayTurnToMany() && !this->Context.Convex &&
    this->Context.Options.Occlusion)
  {
    advance.OtherMethod = true;
  }
  else
  {
    advance.Outcome = elements ? "the elements' size limits the error"
                               : "sampling of direct light and visibility limits the error";
  }
  return advance;
}

/// Elements while too many cells are beyond any number of rays, for finer ones ask for rays anew;
/// then rays.
RadiosityAdvance RadiosityRun::DecideRays(
  const RadiosityLevel& level, const ElementSet& coarsest, const RadiosityState& state)
{
  RadiosityAdvance advance;
  advance.Tolerance = level.Tolerance;
  advance.Area = level.TargetArea;
  const double error = this->Result.Convergence.Rows.back().RelativeError;
  const bool helped = this->Result.MetShare >= this->LastMet + 0.01 ||
    this->Result.Excess95 <= 0.95 * this->LastExcess || error <= 0.95 * this->LastError;
  this->LastMet = this->Result.MetShare;
  this->LastExcess = this->Result.Excess95;
  this->LastError = error;
  const double each = static_cast<double>(level.F->Samples()) / static_cast<double>(level.F->Size());
  const bool sure = each >= SureRays;
  const bool rays = state.Rays.Total > 0.0 && (helped || !sure);
  const bool finer = sure && (state.Rays.Open > MostOpen || !rays) &&
    error <= 0.93 * this->DividedError;
  double ratio = 1.0;
  if (finer && this->FinerElements(level, coarsest, state.Unfinished, advance, ratio))
  {
    const double again = ratio * (level.ExchangeSeconds + 2.0 * state.SolveSeconds);
    if (again < this->Left())
    {
      this->DividedError = error;
      this->LastMet = 0.0;
      this->LastError = std::numeric_limits<double>::infinity();
      return advance;
    }
    advance.Divided.clear();
    advance.Outcome = rays ? "" : "the time budget does not allow a finer step";
  }
  if (rays)
  {
    RayPlan plan = state.Rays;
    if (this->FitRays(level, state, advance, plan))
    {
      advance.Rays = std::move(plan.Rays);
    }
  }
  else if (advance.Outcome.empty())
  {
    advance.Outcome = this->Context.Options.Refinement == RefinementMode::Off
      ? "one radiosity a cell, as asked"
      : state.Rays.Open > MostOpen ? "finer elements no longer help"
                                   : "more rays no longer help";
  }
  return advance;
}

/// Takes as many of the rays as memory and time allow; false where that is hardly any.
bool RadiosityRun::FitRays(const RadiosityLevel& level, const RadiosityState& state,
  RadiosityAdvance& advance, RayPlan& plan) const
{
  constexpr double hardly = 0.05;
  const auto has = static_cast<double>(std::max<std::int64_t>(1, level.F->Samples()));
  const auto bytes = static_cast<double>(level.F->MemoryBytes());
  const double room = (static_cast<double>(this->Context.Memory) - bytes) / 4.0;
  // Each ray is traced once, and looked at in the solve that follows.
  const double raySeconds = (level.ExchangeSeconds + state.SolveSeconds) / has;
  const double affordable = (0.95 * this->Left() - state.SolveSeconds) / raySeconds;
  const double share = std::min(room, affordable) / plan.Total;
  if (share >= 1.0)
  {
    return true;
  }
  if (!(share * plan.Total > hardly * has))
  {
    advance.Outcome = room < affordable ? "the memory limit does not allow more rays"
                                        : "the time budget does not allow more rays";
    return false;
  }
  for (std::int32_t& rays : plan.Rays)
  {
    rays = static_cast<std::int32_t>(share * rays);
  }
  return true;
}

/// A finer tolerance of all pairs, or links made anew that are finer where what they leave unsure
/// limits.
bool RadiosityRun::FinerExchange(
  const RadiosityLevel& level, const RadiosityState& state, RadiosityAdvance& advance)
{
  if (level.Method == RadiosityMethod::Dense)
  {
    advance.Tolerance = std::max(this->Context.Options.RelativeTolerance, 0.3 * level.Tolerance);
    return advance.Tolerance < level.Tolerance;
  }
  // By neighbourhoods, for to ask each element by itself would end with those whose rays happen to
  // have missed what is bright.
  const std::size_t n = level.Elements.Size();
  std::size_t neighbourhoods = 0;
  const std::vector<std::int32_t> neighbourhood =
    level.Elements.Groups(this->Context.Geometry, 3, neighbourhoods);
  std::vector<double> wanting(neighbourhoods, 0.0), whole(neighbourhoods, 0.0);
  for (std::size_t e = 0; e < n; ++e)
  {
    bool limits = false;
    for (std::size_t b = 0; b < this->Context.Bands; ++b)
    {
      const std::size_t k = e * this->Context.Bands + b;
      limits = limits ||
        level.VisibilityError[k] + level.FormFactorError[k] >
          Limiting * (std::abs(level.Discretisation[k]) + level.DirectError[k]);
    }
    const auto g = static_cast<std::size_t>(neighbourhood[e]);
    whole[g] += level.Elements.GetAreas()[e];
    wanting[g] += state.Unfinished[e] && limits ? level.Elements.GetAreas()[e] : 0.0;
  }
  std::vector<std::uint8_t> marked(n, 0);
  for (std::size_t e = 0; e < n; ++e)
  {
    const auto g = static_cast<std::size_t>(neighbourhood[e]);
    marked[e] = wanting[g] > 0.1 * whole[g];
  }
  return this->FinerRows(level, marked, advance);
}

/// Links are made anew, finer for the rows that want it.
bool RadiosityRun::FinerRows(const RadiosityLevel& level, const std::vector<std::uint8_t>& marked,
  RadiosityAdvance& advance) const
{
  const auto step =
    static_cast<float>(std::clamp(0.8 / std::max(1.0, this->Result.Excess95), 0.25, 0.6));
  advance.Rows = level.RowTolerance;
  advance.Rows.resize(marked.size(), 1.0f);
  bool any = false;
  for (std::size_t e = 0; e < marked.size(); ++e)
  {
    const float finer = std::max(FinestLinks, step * advance.Rows[e]);
    any = any || (marked[e] && finer < advance.Rows[e]);
    advance.Rows[e] = marked[e] ? finer : advance.Rows[e];
  }
  if (!any)
  {
    advance.Rows.clear();
  }
  return any;
}

/// A quarter of the area where all pairs allow it; else those whose unevenness does most harm.
/// `ratio`: by how many times more elements.
bool RadiosityRun::FinerElements(const RadiosityLevel& level, const ElementSet& coarsest,
  const std::vector<std::uint8_t>& unfinished, RadiosityAdvance& advance, double& ratio)
{
  if (this->Context.Options.Refinement == RefinementMode::Off)
  {
    return false;
  }
  const std::size_t n = level.Elements.Size();
  const std::size_t limit = this->MostElements(level.Method, coarsest.Size());
  if (level.Method == RadiosityMethod::Dense)
  {
    const std::size_t now = coarsest.CountAtArea(level.TargetArea);
    double next = 0.25 * level.TargetArea;
    while (coarsest.CountAtArea(next) > limit && next < 0.7 * level.TargetArea)
    {
      next *= 1.2;
    }
    const std::size_t then = coarsest.CountAtArea(next);
    if (then > limit || then <= now)
    {
      return false;
    }
    advance.Area = next;
    ratio = static_cast<double>(then) / static_cast<double>(std::max<std::size_t>(1, now));
    return true;
  }
  std::vector<std::uint8_t> marked =
    level.Harmful(this->Context, unfinished, limit > n ? (limit - n) / 6 : 0);
  const auto more = std::count(marked.begin(), marked.end(), 1);
  ratio = 1.0 + 3.0 * static_cast<double>(more) / static_cast<double>(n);
  if (more == 0)
  {
    return false;
  }
  advance.Divided = std::move(marked);
  return true;
}

} // namespace radiometry
