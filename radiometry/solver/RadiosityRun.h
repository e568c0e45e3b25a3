// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/solver/RadiosityCache.h"
#include "radiometry/solver/RadiosityEvaluation.h"
#include "radiometry/solver/RadiosityLevel.h"
#include "radiometry/solver/RayPlan.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace radiometry
{

/// Elements that refinement goes to by itself; more only come from more cells.
inline constexpr std::size_t MostRefined = 60000;

/// What a run does next.
struct RadiosityAdvance
{
  std::string Outcome;               // not empty: it ends, and this is why
  double Tolerance = 0.0;            // of a new operator
  double Area = 0.0;                 // that no element of the next level exceeds, m^2
  std::vector<std::int32_t> Rays;    // to add to each element, on the same level
  std::vector<float> Rows;           // factors on the tolerance of each row; empty: as before
  std::vector<std::uint8_t> Divided; // elements to divide; empty: by area alone
  bool OtherMethod = false;          // the next level's is one for many elements
};

/// Where a level stands after a solve.
struct RadiosityState
{
  std::vector<std::uint8_t> Unfinished; // elements of cells that do not meet the tolerance
  CellStates Cells;
  RayPlan Rays; // of a Monte Carlo level
  double SolveSeconds = 0.0;
};

/// One run of RadiositySimulation: a level of elements, its operator, the solve and what limits its
/// error; then more of that, until the tolerance is met or cannot be.
struct RadiosityRun
{
  RadiosityContext Context;
  RadiosityResult Result;
  std::unique_ptr<RadiosityLevel> Finest;
  double Area = 0.0;
  RadiosityCache* Cache = nullptr;

  RadiosityRun(const Scene& scene, const OcclusionScene& occluders, const RadiosityOptions& options,
    RadiosityCache* cache);
  ~RadiosityRun();

  /// The greatest of the ranks' seconds, so that all decide alike.
  double Agreed(double seconds) const;
  double Elapsed() const { return this->Agreed(this->Result.Convergence.Elapsed()); }
  double Left() const
  {
    return this->Context.Options.TimeBudget > 0.0
      ? this->Context.Options.TimeBudget - this->Elapsed()
      : std::numeric_limits<double>::infinity();
  }
  /// Runs f and adds its seconds to the stage's.
  template <class Function>
  double Timed(const char* stage, Function&& f)
  {
    const double begin = this->Result.Convergence.Elapsed();
    f();
    const double spent = this->Agreed(this->Result.Convergence.Elapsed() - begin);
    for (auto& s : this->Result.Seconds)
    {
      if (s.first == stage)
      {
        s.second += spent;
        return spent;
      }
    }
    this->Result.Seconds.emplace_back(stage, spent);
    return spent;
  }

  /// Whether the mean error is within the tolerance.
  bool MeanMeets() const;
  /// Says, unless it was said, that so many seconds are still to be spent.
  void Predict(double remaining, const StageProgress& stage);
  /// From the first level, or that of the run before, to the last.
  void Follow(const ElementSet& coarsest, const StageProgress& stage);
  /// The level that the run before left, made ready; false: there is none.
  bool Resume(const StageProgress& stage);
  /// Operator, solution, and values with their errors.
  bool SolveLevel(RadiosityLevel& level, const ElementSet& coarsest, RadiosityState& state,
    const StageProgress& stage);
  /// What reflections beyond those that were counted, or that matter, would add.
  void CountBounces(const RadiosityLevel& level);
  /// Why the run ends here; empty: it goes on.
  std::string Ended(bool met, const RadiosityLevel& level, const ElementSet& coarsest);

  // RadiosityMethodChoice.cxx
  RadiosityMethod Choose(const ElementSet& elements);
  /// For more elements than all pairs allow.
  RadiosityMethod ChooseForMany(std::size_t elements, std::string& why) const;
  void CheckMemory(std::size_t elements) const;
  std::size_t DenseLimit() const;
  std::size_t AutomaticLimit() const;
  /// Elements that the method's refinement may come to.
  std::size_t MostElements(RadiosityMethod method, std::size_t coarsest) const;
  bool MayTurnToMany() const
  {
    return this->Context.Options.Method == RadiosityMethod::Auto;
  }

  // RadiosityCourse.cxx
  /// The first level of a method; null where its elements cannot be made fine enough near small
  /// things and another method may be.
  std::unique_ptr<RadiosityLevel> Begin(
    RadiosityMethod method, const ElementSet& coarsest, const StageProgress& stage);
  std::unique_ptr<RadiosityLevel> Next(const RadiosityAdvance& advance,
    std::unique_ptr<RadiosityLevel> level, const ElementSet& coarsest, const StageProgress& stage);
  void BuildOperator(
    RadiosityLevel& level, const ElementSet& coarsest, const StageProgress& stage);
  RadiosityAdvance Decide(const RadiosityLevel& level, const ElementSet& coarsest,
    const RadiosityState& state);
  RadiosityAdvance DecideRays(const RadiosityLevel& level, const ElementSet& coarsest,
    const RadiosityState& state);
  bool FitRays(const RadiosityLevel& level, const RadiosityState& state, RadiosityAdvance& advance,
    RayPlan& plan) const;
  bool FinerExchange(const RadiosityLevel& level, const RadiosityState& state,
    RadiosityAdvance& advance);
  bool FinerRows(const RadiosityLevel& level, const std::vector<std::uint8_t>& marked,
    RadiosityAdvance& advance) const;
  bool FinerElements(const RadiosityLevel& level, const ElementSet& coarsest,
    const std::vector<std::uint8_t>& unfinished, RadiosityAdvance& advance, double& ratio);

  // RadiosityPrediction.cxx
  /// Seconds that a level will still take, method by method; below 0: it is too early to tell.
  double Remaining(const RadiosityLevel& level, const ElementSet& coarsest,
    const RadiosityState& state) const;
  /// Of the final gather at points that follows the run.
  double AfterSeconds() const;
  double RemainingRays(const RadiosityLevel& level, const RadiosityState& state) const;
  double RemainingPairs(const RadiosityLevel& level, const ElementSet& coarsest) const;
  double RemainingLinks(const RadiosityLevel& level) const;
  /// Tells the run's time from the progress of an operator that is likely to be the last.
  class OperatorClock : public Monitor
  {
  public:
    OperatorClock(RadiosityRun& run, const RadiosityLevel& level, const StageProgress& stage);
    bool Progress(double fraction, const char* stage) override;

  private:
    RadiosityRun& Run;
    const RadiosityLevel& Level;
    StageProgress Stage;
    double Start;
    bool Said = false;
  };

  // RadiosityRefinement.cxx
  /// Finer where first light is uneven (up to `uneven` elements), and where small things stand
  /// close to large elements (up to `room`; `complete` tells whether that was enough).
  std::unique_ptr<RadiosityLevel> RefineByLight(ElementSet elements, std::size_t room,
    std::size_t uneven, const RadiosityLevel* earlier, bool& complete, const StageProgress& stage);

  double KeptMetShare = -1.0; // of the run whose operator this one took over under other lights; below
                              // 0: none
  // Of the last steps: to see whether they helped.
  double LastMet = 0.0, LastExcess = std::numeric_limits<double>::infinity();
  double LastError = std::numeric_limits<double>::infinity();
  double DividedError = std::numeric_limits<double>::infinity(); // when elements were last divided
  double LastOpen = 1.0;
  int Levels = 0; // that were begun
};

} // namespace radiometry
