// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/formfactor/GeometryKey.h"
#include "radiometry/irradiance/EmitterIrradiance.h"
#include "radiometry/formfactor/FormFactorOperator.h"
#include "radiometry/formfactor/LightPaths.h"
#include "radiometry/formfactor/MonteCarloOperator.h"
#include "radiometry/irradiance/DirectIrradiance.h"
#include "radiometry/solver/ElementOptics.h"
#include "radiometry/solver/RadiositySimulation.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace radiometry
{

/// What every step of a radiosity run knows.
struct RadiosityContext
{
  RadiosityContext(
    const Scene& scene, const OcclusionScene& occluders, const RadiosityOptions& options);

  const Scene& Geometry;
  const OcclusionScene& Occluders;
  RadiosityOptions Options;
  ContentKey Light; // what is lit and how it reflects
  std::size_t Bands = 1;
  std::size_t Memory = 0;  // bytes
  bool Convex = false;     // nothing can hide anything
  double Tolerance = 0.01; // of the exchange at the present step, relative
  std::shared_ptr<const SpecularSurfaces> Paths; // over which light is followed; null: it is not

  /// Sides of triangles that no light can reach from another surface (BlindSides.h); found when first
  /// asked for.
  const std::vector<std::array<std::uint8_t, 2>>& Blind() const;

  ExchangeOptions Exchange() const;
  /// Exchange with emitters and points, for which rays are of no use in a convex scene.
  ExchangeOptions Sight() const;
  DirectOptions Direct(double secondsLeft) const;
  SpecularLightOptions Mirrored(double secondsLeft) const;

private:
  mutable std::vector<std::array<std::uint8_t, 2>> BlindSides;
};

/// Half-widths that cover 95 %: of a normal error, and of one estimated from eight batches by rays
/// that end where the estimate happens to be low.
inline constexpr double DenseCoverage = 2.0;
inline constexpr double CarloCoverage = 2.7;
inline constexpr double LinkCoverage = 2.2;

/// One discretisation of the scene with all that was computed on it. Values: elements x bands.
struct RadiosityLevel
{
  using Values = std::vector<double>;

  RadiosityLevel(const RadiosityContext& context, ElementSet set);

  /// For the optics of a scene of the same geometry: nothing is lit, and what left the elements
  /// before is where the next solve begins.
  void Prepare(const RadiosityContext& context);
  /// For another run: all is kept where the light is the same, else as Prepare.
  void PrepareAgain(const RadiosityContext& context);
  /// What leaves other elements as where the first solve begins.
  void BeginFrom(const RadiosityLevel& earlier, std::size_t bands);

  /// Direct light, and emitters that are few and small as lights. Elements that an earlier level
  /// (of the same lights; may be null) has too keep what was found there.
  void Illuminate(const RadiosityContext& context, double secondsLeft,
    const RadiosityLevel* earlier, const StageProgress& stage);

  /// The same elements for a finer tolerance: direct light of those that do not meet it, once more.
  /// True where First changed.
  bool IlluminateFiner(
    const RadiosityContext& context, double secondsLeft, const StageProgress& stage);

  /// Adds the light of lights over mirrors to First: once, when the elements are those to solve on.
  void AddMirrored(const RadiosityContext& context, double secondsLeft, const StageProgress& stage);

  /// Elements whose first light differs from their neighbours' by more flux than the tolerance
  /// allows (a spot's edge, a shadow, light caught in a gap): worth dividing before anything
  /// else. The most uneven first, at most `most`.
  std::vector<std::uint8_t> Uneven(const RadiosityContext& context, std::size_t most) const;

  /// Elements that much smaller ones see from nearer than their own size (things that stand on a
  /// table): constant radiosity would put light where the small ones keep it away. The most
  /// crowded first, at most `most`.
  std::vector<std::uint8_t> Crowded(
    const RadiosityContext& context, std::size_t most, const StageProgress& stage) const;

  /// Elements whose radiosity differs most from their neighbours', each by the flux that this puts
  /// in the wrong place and by how much of it reaches elements marked in `unfinished`: those that
  /// make up three quarters of the harm (bulk criterion: Doerfler 1996), at most `most`.
  std::vector<std::uint8_t> Harmful(const RadiosityContext& context,
    const std::vector<std::uint8_t>& unfinished, std::size_t most) const;

  /// Radiosity and irradiance by the operator, with their errors. `discretise`: estimate the error
  /// of constant elements too (else the last estimate stays). May be called again when the operator
  /// has got finer.
  void Solve(const RadiosityContext& context, bool discretise, const StageProgress& stage);

  ElementSet Elements;
  ElementOptics Optics;
  EmitterSet Emitters; // treated as lights; empty: emission goes through the operator
  Values First;        // irradiance by lights and such emitters
  Values FirstError;
  SpecularLight Mirrored; // what of First comes over mirrors; empty: nothing
  Values Straight;        // First without it, and its error; empty: as First
  Values StraightError;
  Values Leaving;     // radiosity but for what Emitters treat
  Values Gathered;    // irradiance by what leaves
  Values Irradiance;  // all
  Values DirectError; // FirstError and what it adds by reflection
  Values FormFactorError, VisibilityError, Discretisation, SolverError;
  RadiosityMethod Method = RadiosityMethod::Auto; // F's
  std::string Source; // of an F that is not this run's; empty: the run before
  double TargetArea = 0.0;      // that no element exceeds, m^2
  double Tolerance = 0.0;       // of F
  std::vector<float> RowTolerance; // factor on it of each row; empty: 1
  double ExchangeSeconds = 0.0; // that F took
  double SolveSeconds = 0.0;    // and the last solve
  int Rays = 0;                 // of each element at first; 0: as always
  double MetShare = 1.0;        // of the run that made F
  bool HasGuess = false;        // Gathered is worth beginning from
  double LightMean = 0.0; // of what lights give, over the elements
  bool TimedOut = false;  // lights were not all looked at
  std::unique_ptr<FormFactorOperator> F;
  MonteCarloOperator* Carlo = nullptr; // F, when it is one
  ContentKey Light;             // of the run that it was lit and solved for
  DirectOptions LitFor;         // tolerances of First; 0: it is not lit
  double SolvedFor = 0.0;       // tolerance of the last solve; 0: there is none over F as it is
  double LeftOut = 0.0; // bound on what more bounces than MaximumBounces would add, W/m^2
  double DiscretisedAt = 0.0;   // samples an element at the last estimate; 0: there is none
  int Iterations = 0;
  Values InverseBound; // of the system, from its last solve

  /// Of operator and elements.
  std::size_t MemoryBytes() const;

private:
  void AddLights(const RadiosityContext& context, const std::vector<Patch>& patches,
    double knownMean, double secondsLeft, const StageProgress& stage, Values& light, Values& error);
  void CheckEmission(const RadiosityContext& context) const;
  void SumBounces(const RadiosityContext& context, const DiffuseScattering& scattering);
  void PoolSampling(const RadiosityContext& context);
  void BoundUnmet(const RadiosityContext& context, const std::vector<std::int32_t>& group,
    const std::vector<double>& rays);
  void AddReflectedSampling(const RadiosityContext& context, const DiffuseScattering& scattering);
  void Discretise(const RadiosityContext& context, const DiffuseScattering& scattering,
    const Values& source, const StageProgress& stage);
};

} // namespace radiometry
