// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/accuracy/ConvergenceRecord.h"
#include "radiometry/accuracy/RunCost.h"
#include "radiometry/formfactor/FormFactorOperator.h"
#include "radiometry/irradiance/IrradianceSimulation.h"
#include "radiometry/scene/Communicator.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace radiometry
{

/// The values of the Method property.
enum class RadiosityMethod
{
  Auto = 0,
  Dense = 1,
  Hierarchical = 2,
  MonteCarlo = 3
};

/// The word for a method.
const char* MethodName(RadiosityMethod method);

/// The values of the Refinement property: may the solve use a finer mesh than the one given?
enum class RefinementMode
{
  Auto = 0, // where the error asks for it and it can be afforded
  On = 1,   // at least once
  Off = 2   // one constant radiosity a cell
};

class RadiosityCache;

struct RadiosityOptions
{
  double RelativeTolerance = 0.01;
  double AbsoluteTolerance = 0.0; // W/m^2
  double TimeBudget = 0.0;        // s; 0: none
  std::size_t MemoryLimit = 0;    // bytes; 0: 2 GiB
  RadiosityMethod Method = RadiosityMethod::Auto;
  RefinementMode Refinement = RefinementMode::Auto;
  bool Interreflection = true;
  bool Forced = false; // exchange is simulated even where no surface faces another
  int MaximumBounces = 0; // so often light that lights or emitters send is reflected; 0: for ever
  bool Occlusion = true;
  bool BackFaces = true;
  bool Emission = true;
  bool SpotShape = true;
  bool Attenuation = true;
  bool Environment = true;
  bool Transmission = true; // of the lights' light
  bool SpecularTransport = false; // light over mirrors is followed
  bool PathTransmission = false;  // what surfaces send is followed through panes
  bool LightVisibility = false;   // how much of each light arrives is wanted, too
  bool PilotOnly = false; // end where the cost of the run is known (RunCost::PredictedSeconds)
  bool SurfaceOnly = false; // no values off the surface will be asked for (IrradianceAt)
  double SecondsBefore = 0.0;  // that the caller spent: they count in what is predicted
  double SecondsForPoints = 0.0; // beside TimeBudget, for IrradianceAt
  std::size_t PointsAfter = 0; // at which values will be wanted when the run has ended: the same
  std::array<double, 3>* KindSeconds = nullptr; // gets what direct light took by kind, if not null
  int Threads = 0;             // 0: all
  std::uint64_t Seed = 0;
  const Communicator* Ranks = nullptr; // that compute together; null: this process alone

  std::string LoadOperator; // file to take the operator from; empty: none
  std::string SaveOperator; // file to write it to in the end; empty: none

  /// Whether what surfaces send is followed over mirrors or through panes: by rays alone.
  bool FollowsPaths() const { return this->SpecularTransport || this->PathTransmission; }
};

/// Area-weighted mean over the cells of each part of IrradianceError, W/m^2.
struct RadiosityErrorBudget
{
  double Direct = 0.0;         // direct light, and what its error adds by reflection
  double FormFactors = 0.0;    // unoccluded exchange
  double Visibility = 0.0;     // sampling of what is hidden (Monte Carlo: all sampling)
  double Discretisation = 0.0; // constant radiosity on each element
  double Solver = 0.0;         // linear system
};

struct RadiosityResult
{
  /// Front, back (where any cell is two-sided and BackFaces); cells x bands, W/m^2.
  std::array<FieldValues, 2> Irradiance;
  std::array<FieldValues, 2> Radiosity;
  RadiosityErrorBudget Budget; // of the brightest band of each cell
  RadiosityErrorBudget Parts;  // in the mean over the bands: of the Convergence's AbsoluteError
  RadiosityMethod Method = RadiosityMethod::Auto; // used
  std::string MethodWhy;                          // why, with the operator's own description
  std::string Outcome;                            // what ended the run
  RunCost Cost;
  ConvergenceRecord Convergence;
  std::vector<std::pair<std::string, double>> Seconds; // by stage
  ClosureReport Closure;
  double BouncesLeftOut = 0.0; // bound on what bounces past MaximumBounces would add to any value, W/m^2
  double BouncesThatMatter = 0.0; // after which the rest is below the tolerance on average; 0: not told
  std::size_t Elements = 0;
  int Iterations = 0;
  double MetShare = 0.0; // of the cells, and of their area, that meets the tolerance (the lesser)
  double Excess = 0.0;   // mean over the cells of error/tolerance (at most 10) where above 1
  double Excess95 = 0.0; // 95 % of the cells have less
  std::int64_t Samples = 0; // pairs and rays of the operator
  std::size_t OperatorBytes = 0;
};

/// Direct light, emission and interreflection on a scene.
///   Reads    scene.Lights, GlobalAmbient (as light that arrives), Optics.DiffuseReflectance,
///            EmittedExitance, TwoSided (front and back)
///   Model    B = M + rho E, E = E_lights + int F dB: diffuse radiosity. Where paths are followed,
///            E holds what comes over mirrors and through panes: of lights (LightPaths.h), of surfaces
///            (MonteCarloOperator.h)
///   Values   averages over the cells; E of a cell of many elements is their area-weighted mean
///   Error    half-width that covers 95 % of values: direct light, exchange, visibility (twice its
///            standard error), discretisation (difference from the solve on elements merged by
///            fours), solver (bound)
///   Method   Dense up to some thousand elements (4000 where nothing hides anything), Hierarchical
///            above, MonteCarlo where paths over mirrors are to be followed; refined from coarse to
///            fine until the tolerance is met, every step a row of Convergence
///   Fails    InputError for optics out of range, a lossless closed cavity with light, a memory
///            limit too small for any method
class RadiositySimulation
{
public:
  /// `scene` and `occluders` must outlive this.
  RadiositySimulation(
    const Scene& scene, const OcclusionScene& occluders, const RadiosityOptions& options);
  /// Begins from what the cache has and leaves there what the next run can begin from. All must
  /// outlive this.
  RadiositySimulation(const Scene& scene, const RadiosityOptions& options, RadiosityCache& cache);
  ~RadiositySimulation();

  /// Once; the result stays available for IrradianceAt.
  const RadiosityResult& Run(const StageProgress& stage = {});

  /// Irradiance at points about their normals by final gather: direct light and emitters as in
  /// Run, the rest by rays to the elements' radiosity. Items x bands.
  FieldValues IrradianceAt(
    const std::vector<SurfacePoint>& points, const StageProgress& stage = {}) const;

private:
  struct Internals;
  std::unique_ptr<Internals> Impl;
};

} // namespace radiometry
