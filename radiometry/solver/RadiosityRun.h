// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/solver/RadiosityLevel.h"

#include <limits>
#include <memory>
#include <utility>

namespace radiometry
{

/// One run of RadiositySimulation: which method, how fine, when to stop.
struct RadiosityRun
{
  RadiosityContext Context;
  RadiosityResult Result;
  std::unique_ptr<RadiosityLevel> Finest;
  double Area = 0.0;

  RadiosityRun(
    const Scene& scene, const OcclusionScene& occluders, const RadiosityOptions& options);

  double Left() const
  {
    return this->Context.Options.TimeBudget > 0.0
      ? this->Context.Options.TimeBudget - this->Result.Convergence.Elapsed()
      : std::numeric_limits<double>::infinity();
  }
  /// Runs f and adds its seconds to the stage's.
  template <class Function>
  void Timed(const char* stage, Function&& f)
  {
    const double begin = this->Result.Convergence.Elapsed();
    f();
    const double spent = this->Result.Convergence.Elapsed() - begin;
    for (auto& s : this->Result.Seconds)
    {
      if (s.first == stage)
      {
        s.second += spent;
        return;
      }
    }
    this->Result.Seconds.emplace_back(stage, spent);
  }

  RadiosityMethod Choose(const ElementSet& elements);
  std::size_t DenseLimit() const;
  std::size_t AutomaticLimit() const;
  void Illuminate(RadiosityLevel& level, const StageProgress& stage);
  std::unique_ptr<RadiosityLevel> RefineByLight(ElementSet elements, std::size_t room,
    std::size_t uneven, bool& complete, const StageProgress& stage);
  bool MayTurnToRays() const
  {
    return this->Context.Options.Method == RadiosityMethod::Auto &&
      this->Context.Options.Occlusion && !this->Context.Convex;
  }
  /// False when elements are too coarse for the tolerance and all pairs of finer ones too many.
  bool RunDense(const ElementSet& coarsest, const StageProgress& stage);
  void RunMonteCarlo(const ElementSet& coarsest, const StageProgress& stage);
};

} // namespace radiometry
