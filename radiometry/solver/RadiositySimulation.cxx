// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/RadiositySimulation.h"

#include "radiometry/formfactor/DenseOperator.h"
#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/formfactor/EmitterIrradiance.h"
#include "radiometry/formfactor/GroupedOperator.h"
#include "radiometry/formfactor/MonteCarloOperator.h"
#include "radiometry/formfactor/PairVisibility.h"
#include "radiometry/formfactor/PointGather.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/solver/ElementOptics.h"
#include "radiometry/solver/RadiositySolver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiometry
{
namespace
{

// Half-widths that cover 95 %: of a normal error, and of one estimated from eight batches.
constexpr double DenseCoverage = 2.0;
constexpr double CarloCoverage = 2.7; // rays stop where the estimate happens to be low
constexpr double DiscretisationSafety = 2.0;
constexpr std::size_t DefaultMemory = std::size_t(2) << 30;
constexpr std::size_t EmitterPairs = 4000000;
constexpr int FirstRays = 64;
constexpr double FirstTolerance = 0.03;
constexpr int MostRays = 16384;
/// Cells darker than this share of the mean are held to the tolerance of the share.
constexpr double DarkShare = 0.05;

const char* const MetOutcome = "the tolerance is met on 95 % of the area";

using Values = std::vector<double>;

/// One discretisation of the scene with all that was computed on it. Values: elements x bands.
struct Level
{
  Level(const Scene& scene, ElementSet set, bool emission)
    : Elements(std::move(set))
    , Optics(scene, Elements, emission)
  {
  }

  ElementSet Elements;
  ElementOptics Optics;
  EmitterSet Emitters; // treated as lights; empty: emission goes through the operator
  Values First;        // irradiance by lights and such emitters
  Values Leaving;      // radiosity but for what Emitters treat
  Values Irradiance;   // all
  Values DirectError, FormFactorError, VisibilityError, Discretisation, SolverError;
  std::unique_ptr<FormFactorOperator> F;
  MonteCarloOperator* Carlo = nullptr; // F, when it is one
  int Iterations = 0;
  Values InverseBound; // of the system, from its first solve
};

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

struct RadiositySimulation::Internals
{
  const Scene& Geometry;
  const OcclusionScene& Occluders;
  RadiosityOptions Options;
  RadiosityResult Result;
  std::unique_ptr<Level> Finest;
  std::size_t Bands = 1;
  std::size_t Memory = DefaultMemory;
  double Area = 0.0;
  double Tolerance = 0.01; // of the exchange at the present step, relative
  bool Convex = false;     // nothing can hide anything

  Internals(const Scene& scene, const OcclusionScene& occluders, const RadiosityOptions& options)
    : Geometry(scene)
    , Occluders(occluders)
    , Options(options)
    , Bands(static_cast<std::size_t>(scene.Optics.Bands))
    , Memory(options.MemoryLimit ? options.MemoryLimit : DefaultMemory)
    , Convex(IsConvex(scene))
  {
  }

  double Left() const
  {
    return this->Options.TimeBudget > 0.0
      ? this->Options.TimeBudget - this->Result.Convergence.Elapsed()
      : std::numeric_limits<double>::infinity();
  }
  ExchangeOptions Exchange() const
  {
    ExchangeOptions o;
    o.RelativeTolerance = this->Tolerance;
    o.Occlusion = this->Options.Occlusion;
    o.MemoryLimit = this->Memory;
    o.Threads = this->Options.Threads;
    o.Seed = this->Options.Seed;
    return o;
  }
  DirectOptions Direct() const
  {
    DirectOptions o;
    o.RelativeTolerance = 0.5 * this->Options.RelativeTolerance;
    o.AbsoluteTolerance = 0.5 * this->Options.AbsoluteTolerance;
    o.SecondsLeft = this->Options.TimeBudget > 0.0 ? std::max(1e-3, 0.5 * this->Left()) : 0.0;
    o.Occlusion = this->Options.Occlusion;
    o.SpotShape = this->Options.SpotShape;
    o.Attenuation = this->Options.Attenuation;
    o.Threads = this->Options.Threads;
    return o;
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
  void Illuminate(Level& level, const StageProgress& stage);
  /// `discretise`: estimate the error of constant elements too (else keep the last estimate).
  void Solve(Level& level, bool discretise, const StageProgress& stage);
  /// Fills Result from a level; true when the tolerance is met.
  bool Evaluate(const Level& level, const char* stage, std::vector<std::uint8_t>* unfinished);
  /// False when elements are too coarse for the tolerance and all pairs of finer ones too many.
  bool RunDense(const ElementSet& coarsest, const StageProgress& stage);
  void RunMonteCarlo(const ElementSet& coarsest, const StageProgress& stage);
};

std::size_t RadiositySimulation::Internals::DenseLimit() const
{
  std::size_t n = this->Options.RelativeTolerance < 0.003 ? 8192 : 4096;
  while (n > 64 && DenseOperator::LeastBytes(n) > this->Memory)
  {
    n = n * 3 / 4;
  }
  return n;
}

std::size_t RadiositySimulation::Internals::AutomaticLimit() const
{
  // Where nothing hides anything pairs need no rays; else rays from elements are the cheaper way
  // to all but the finest tolerances.
  const std::size_t limit = this->DenseLimit();
  const bool rays = this->Options.Method == RadiosityMethod::Auto && this->Options.Occlusion &&
    !this->Convex && this->Options.RelativeTolerance >= 0.005;
  return rays ? std::min<std::size_t>(limit, 1024) : limit;
}

RadiosityMethod RadiositySimulation::Internals::Choose(const ElementSet& elements)
{
  const std::size_t n = elements.Size();
  const std::string count = std::to_string(n) + " elements";
  std::string& why = this->Result.MethodWhy;
  if (this->Options.Method == RadiosityMethod::Hierarchical)
  {
    throw InputError(
      "Method", -1, "Hierarchical", "Auto, Dense or MonteCarlo: not available in this version");
  }
  if (this->Options.Method == RadiosityMethod::MonteCarlo && !this->Options.Occlusion)
  {
    throw InputError("Method", -1, "MonteCarlo",
      "Auto or Dense where Occlusion is off: rays cannot pass through what they meet");
  }
  if (this->Options.Method != RadiosityMethod::Auto)
  {
    why = std::string(MethodName(this->Options.Method)) + " as asked";
    return this->Options.Method;
  }
  if (!this->Options.Occlusion)
  {
    why = "Dense: occlusion is off, and rays cannot pass through what they meet";
    return RadiosityMethod::Dense;
  }
  const std::size_t limit = this->AutomaticLimit();
  const double wanted = std::clamp(10.0 / this->Options.RelativeTolerance, 200.0, 2000.0);
  const std::size_t fine =
    this->Options.Refinement == RefinementMode::Off ? n : elements.CountAtArea(this->Area / wanted);
  if (n > limit || fine > limit + limit / 2)
  {
    why = "MonteCarlo: " + count + " (" + std::to_string(fine) +
      " when refined for the tolerance), more than the " + std::to_string(limit) +
      " whose pairs would be worth their rays and memory";
    return RadiosityMethod::MonteCarlo;
  }
  const double threads = this->Options.Threads > 0 ? this->Options.Threads : 2.0;
  if (2e-6 * static_cast<double>(n) * static_cast<double>(n) / threads > 0.5 * this->Left())
  {
    why = "MonteCarlo: all pairs of " + count + " do not fit in the time budget";
    return RadiosityMethod::MonteCarlo;
  }
  why = "Dense: all pairs of " + count + " are few";
  return RadiosityMethod::Dense;
}

void RadiositySimulation::Internals::Illuminate(Level& level, const StageProgress& stage)
{
  const std::vector<Patch>& patches = level.Elements.GetPatches();
  StageProgress part = stage;
  part.Name = "direct light";
  this->Timed("direct light", [&] {
    DirectResult direct =
      ComputeDirectIrradiance(this->Geometry, this->Occluders, patches, this->Direct(), part);
    level.First = std::move(direct.Irradiance);
    level.DirectError = std::move(direct.Error);
  });
  const std::size_t values = patches.size() * this->Bands;
  level.FormFactorError.assign(values, 0.0);
  level.VisibilityError.assign(values, 0.0);
  level.Discretisation.assign(values, 0.0);
  level.SolverError.assign(values, 0.0);
  level.Irradiance = level.First;
  if (this->Options.Emission)
  {
    level.Emitters =
      SmallEmitters(this->Geometry, level.Elements, this->Options.BackFaces, EmitterPairs);
  }
  if (!level.Emitters.Empty())
  {
    part.Name = "emitters";
    this->Timed("emitters", [&] {
      ExchangeOptions exchange = this->Exchange();
      exchange.Occlusion = exchange.Occlusion && !this->Convex;
      const EmitterResult e =
        ComputeEmitterIrradiance(this->Occluders, patches, level.Emitters, exchange, part);
      for (std::size_t k = 0; k < values; ++k)
      {
        level.First[k] += e.Irradiance[k];
        level.DirectError[k] =
          std::hypot(level.DirectError[k], DenseCoverage * e.VisibilityError[k]) +
          e.GeometryError[k];
      }
    });
    level.Irradiance = level.First;
  }
}

void RadiositySimulation::Internals::Solve(
  Level& level, bool discretise, const StageProgress& stage)
{
  const std::size_t n = level.Elements.Size();
  const std::size_t values = n * this->Bands;
  const int bands = static_cast<int>(this->Bands);
  Values source(values), gathered(values), rho = level.Optics.Reflectance;
  if (!this->Options.Interreflection)
  {
    std::fill(rho.begin(), rho.end(), 0.0);
  }
  for (std::size_t k = 0; k < values; ++k)
  {
    // Without interreflection only what is emitted travels on.
    source[k] = rho[k] * level.First[k] + (level.Emitters.Empty() ? level.Optics.Exitance[k] : 0.0);
  }

  SolveOptions options;
  options.Tolerance = std::clamp(1e-3 * this->Options.RelativeTolerance, 1e-9, 1e-5);
  std::vector<std::int32_t> cells(n);
  for (std::size_t e = 0; e < n; ++e)
  {
    cells[e] = level.Elements.GetPatches()[e].Cell;
  }
  const auto solveIn = [&](const GroupedOperator& grouped, std::size_t groups,
                         const SolveOptions& how) {
    Values groupRho(groups * this->Bands), groupSource(groups * this->Bands);
    grouped.Restrict(rho.data(), groupRho.data(), bands);
    grouped.Restrict(source.data(), groupSource.data(), bands);
    return SolveRadiosity(grouped, groupRho, groupSource, bands, how, {}, stage);
  };
  // A second solve of the same elements begins where the first ended.
  const Values guess = level.Leaving;
  if (!level.InverseBound.empty())
  {
    options.InverseBound = &level.InverseBound;
    options.Guess =
      guess.size() == values && this->Options.Refinement != RefinementMode::Off ? &guess : nullptr;
  }

  level.Leaving.assign(values, 0.0);
  if (this->Options.Refinement == RefinementMode::Off)
  {
    std::size_t count = 0;
    const std::vector<std::int32_t> group = level.Elements.CellGroups(count);
    const GroupedOperator grouped(*level.F, group, count);
    const SolveResult r = solveIn(grouped, count, options);
    grouped.Prolong(r.Radiosity.data(), level.Leaving.data(), bands);
    grouped.Prolong(r.Error.data(), level.SolverError.data(), bands);
    level.Iterations += r.Iterations;
    level.InverseBound = r.InverseBound;
    level.F->Apply(level.Leaving.data(), gathered.data(), bands);
  }
  else
  {
    SolveResult r = SolveRadiosity(*level.F, rho, source, bands, options, cells, stage);
    level.Leaving = std::move(r.Radiosity);
    level.SolverError = std::move(r.Error);
    gathered = std::move(r.Irradiance);
    level.Iterations += r.Iterations;
    level.InverseBound = std::move(r.InverseBound);
  }
  for (std::size_t k = 0; k < values; ++k)
  {
    level.Irradiance[k] = level.First[k] + gathered[k];
  }

  // What the operator does not know, given what leaves.
  level.F->ApplyError(
    level.Leaving.data(), level.FormFactorError.data(), level.VisibilityError.data(), bands);
  const double coverage = level.Carlo ? CarloCoverage : DenseCoverage;
  for (double& v : level.VisibilityError)
  {
    v *= coverage;
  }

  // Errors of direct light travel on as light does.
  Values carried(values), arrived(values);
  for (std::size_t k = 0; k < values; ++k)
  {
    carried[k] = rho[k] * level.DirectError[k];
  }
  level.F->Apply(carried.data(), arrived.data(), bands);
  for (std::size_t k = 0; k < values; ++k)
  {
    level.DirectError[k] += arrived[k];
  }

  if (!discretise)
  {
    return;
  }
  // A difference of some per cent needs no more digits than that.
  const Values none;
  SolveOptions rough;
  rough.Tolerance = std::clamp(0.01 * this->Options.RelativeTolerance, 1e-8, 1e-4);
  rough.InverseBound = &none;
  if (this->Options.Refinement == RefinementMode::Off && level.Elements.Depth(0) > 0)
  {
    const SolveResult free = SolveRadiosity(*level.F, rho, source, bands, rough, cells, stage);
    for (std::size_t k = 0; k < values; ++k)
    {
      level.Discretisation[k] = 1.5 * (free.Irradiance[k] - gathered[k]);
    }
    return;
  }

  // The same on elements merged by fours and by sixteens. What the first merging changes, and how
  // much less that is than what the second does, tell what elements of no size would change.
  std::array<Values, 2> merged;
  for (int levels = 1; levels <= 2; ++levels)
  {
    std::size_t count = 0;
    const std::vector<std::int32_t> group = level.Elements.Groups(this->Geometry, levels, count);
    const GroupedOperator grouped(*level.F, group, count);
    const SolveResult coarse = solveIn(grouped, count, rough);
    Values prolonged(values);
    grouped.Prolong(coarse.Radiosity.data(), prolonged.data(), bands);
    merged[static_cast<std::size_t>(levels - 1)].resize(values);
    level.F->Apply(prolonged.data(), merged[static_cast<std::size_t>(levels - 1)].data(), bands);
  }
  for (std::size_t b = 0; b < this->Bands; ++b)
  {
    double fine = 0.0, coarse = 0.0;
    for (std::size_t e = 0; e < n; ++e)
    {
      const std::size_t k = e * this->Bands + b;
      const double a = level.Elements.GetAreas()[e];
      fine += a * (gathered[k] - merged[0][k]) * (gathered[k] - merged[0][k]);
      coarse += a * (merged[0][k] - merged[1][k]) * (merged[0][k] - merged[1][k]);
    }
    // Each division shrinks the change by `ratio`: the changes still to come sum to 1/(ratio - 1).
    const double ratio = fine > 0.0 ? std::clamp(std::sqrt(coarse / fine), 1.5, 4.0) : 4.0;
    for (std::size_t k = b; k < values; k += this->Bands)
    {
      level.Discretisation[k] = DiscretisationSafety / (ratio - 1.0) * (gathered[k] - merged[0][k]);
    }
  }
}

bool RadiositySimulation::Internals::Evaluate(
  const Level& level, const char* stage, std::vector<std::uint8_t>* unfinished)
{
  const std::size_t n = level.Elements.Size();
  const std::size_t nb = this->Bands;
  const std::vector<Patch>& patches = level.Elements.GetPatches();
  const std::vector<double>& areas = level.Elements.GetAreas();
  const std::size_t cells = this->Geometry.Cells;
  RadiosityResult& result = this->Result;

  // Sums over the cells' sides: linear for what may have one sign, squares for sampling.
  struct Sums
  {
    Values Area, Value, Gathered, Leaving, Direct, FormFactor, Visibility, Signed, Squares, Solver;
  };
  std::array<Sums, 2> sums;
  for (Sums& s : sums)
  {
    s.Area.assign(cells, 0.0);
    for (Values* v : { &s.Value, &s.Gathered, &s.Leaving, &s.Direct, &s.FormFactor, &s.Visibility,
           &s.Signed, &s.Squares, &s.Solver })
    {
      v->assign(cells * nb, 0.0);
    }
  }
  // The spread of the estimate over each element and its neighbours, and its mean share of the
  // gathered light: a difference that happens to pass through zero at one place is not an error of
  // zero there.
  std::size_t groups = 0;
  const std::vector<std::int32_t> group = level.Elements.Groups(this->Geometry, 1, groups);
  Values groupSquare(groups * nb, 0.0), groupArea(groups, 0.0);
  for (std::size_t e = 0; e < n; ++e)
  {
    const auto g = static_cast<std::size_t>(group[e]);
    groupArea[g] += areas[e];
    for (std::size_t b = 0; b < nb; ++b)
    {
      const double d = level.Discretisation[e * nb + b];
      groupSquare[g * nb + b] += areas[e] * d * d;
    }
  }
  Values meanShare(nb, 0.0);
  for (std::size_t b = 0; b < nb; ++b)
  {
    double difference = 0.0, all = 0.0;
    for (std::size_t e = 0; e < n; ++e)
    {
      difference += areas[e] * std::abs(level.Discretisation[e * nb + b]);
      all += areas[e] * (level.Irradiance[e * nb + b] - level.First[e * nb + b]);
    }
    meanShare[b] = all > 0.0 ? difference / all : 0.0;
  }
  bool back = false;
  for (std::size_t e = 0; e < n; ++e)
  {
    Sums& s = sums[patches[e].Side];
    back = back || patches[e].Side == 1;
    const auto c = static_cast<std::size_t>(patches[e].Cell);
    const auto g = static_cast<std::size_t>(group[e]);
    const double a = areas[e];
    s.Area[c] += a;
    for (std::size_t b = 0; b < nb; ++b)
    {
      const std::size_t k = e * nb + b, to = c * nb + b;
      s.Value[to] += a * level.Irradiance[k];
      s.Gathered[to] += a * (level.Irradiance[k] - level.First[k]);
      s.Leaving[to] +=
        a * (level.Optics.Exitance[k] + level.Optics.Reflectance[k] * level.Irradiance[k]);
      s.Direct[to] += a * level.DirectError[k];
      s.FormFactor[to] += a * level.FormFactorError[k];
      s.Visibility[to] += a * a * level.VisibilityError[k] * level.VisibilityError[k];
      s.Signed[to] += a * level.Discretisation[k];
      s.Squares[to] += a * groupSquare[g * nb + b] / groupArea[g];
      s.Solver[to] += a * level.SolverError[k];
    }
  }

  result.Budget = {};
  double totalArea = 0.0, totalValue = 0.0, totalError = 0.0, meanValue = 0.0;
  for (const Sums& s : sums)
  {
    for (std::size_t c = 0; c < cells; ++c)
    {
      totalArea += s.Area[c];
      for (std::size_t b = 0; b < nb; ++b)
      {
        totalValue += s.Value[c * nb + b];
      }
    }
  }
  meanValue = totalArea > 0.0 ? totalValue / (totalArea * static_cast<double>(nb)) : 0.0;
  double met = 0.0;
  std::array<std::vector<std::uint8_t>, 2> open;
  for (std::size_t side = 0; side < (back ? 2 : 1); ++side)
  {
    const Sums& s = sums[side];
    FieldValues& irradiance = result.Irradiance[side];
    FieldValues& radiosity = result.Radiosity[side];
    for (FieldValues* f : { &irradiance, &radiosity })
    {
      f->Values.assign(cells * nb, 0.0);
      f->Errors.assign(cells * nb, 0.0);
    }
    open[side].assign(cells, 0);
    for (std::size_t c = 0; c < cells; ++c)
    {
      const double a = s.Area[c];
      if (!(a > 0.0))
      {
        continue;
      }
      bool fine = true;
      RadiosityErrorBudget worst;
      for (std::size_t b = 0; b < nb; ++b)
      {
        const std::size_t k = c * nb + b;
        const double value = s.Value[k] / a;
        const double direct = s.Direct[k] / a;
        const double formFactor = s.FormFactor[k] / a;
        const double visibility = std::sqrt(s.Visibility[k]) / a;
        const double discretisation = std::max({ std::abs(s.Signed[k]) / a,
          0.5 * std::sqrt(s.Squares[k] / a), 0.7 * meanShare[b] * s.Gathered[k] / a });
        const double solver = s.Solver[k] / a;
        const double error =
          std::hypot(std::hypot(direct, visibility), discretisation) + formFactor + solver;
        irradiance.Values[k] = value;
        irradiance.Errors[k] = error;
        // B = M + rho E holds for the averages, and so for their errors.
        radiosity.Values[k] = s.Leaving[k] / a;
        totalError += a * error;
        const double allowed = std::max(this->Options.AbsoluteTolerance,
          this->Options.RelativeTolerance * std::max(value, DarkShare * meanValue));
        fine = fine && error <= allowed;
        worst.Direct = std::max(worst.Direct, direct);
        worst.FormFactors = std::max(worst.FormFactors, formFactor);
        worst.Visibility = std::max(worst.Visibility, visibility);
        worst.Discretisation = std::max(worst.Discretisation, discretisation);
        worst.Solver = std::max(worst.Solver, solver);
      }
      met += fine ? a : 0.0;
      open[side][c] = !fine;
      const double share = a / totalArea;
      result.Budget.Direct += share * worst.Direct;
      result.Budget.FormFactors += share * worst.FormFactors;
      result.Budget.Visibility += share * worst.Visibility;
      result.Budget.Discretisation += share * worst.Discretisation;
      result.Budget.Solver += share * worst.Solver;
    }
  }
  // Radiosity's error: that of irradiance, reflected. Reflectance is a cell's own.
  for (std::size_t e = 0; e < n; ++e)
  {
    const std::size_t side = patches[e].Side;
    for (std::size_t b = 0; b < nb; ++b)
    {
      const std::size_t to = static_cast<std::size_t>(patches[e].Cell) * nb + b;
      result.Radiosity[side].Errors[to] =
        level.Optics.Reflectance[e * nb + b] * result.Irradiance[side].Errors[to];
    }
  }
  if (unfinished)
  {
    unfinished->assign(n, 0);
    for (std::size_t e = 0; e < n; ++e)
    {
      (*unfinished)[e] = open[patches[e].Side][static_cast<std::size_t>(patches[e].Cell)];
    }
  }
  result.Elements = n;
  result.Iterations = level.Iterations;
  result.Samples = level.F ? level.F->Samples() : 0;
  result.OperatorBytes = level.F ? level.F->MemoryBytes() : 0;
  result.Closure = level.F ? level.F->Closure() : ClosureReport{};
  const double perValue = totalArea * static_cast<double>(nb);
  result.Convergence.Add(stage, totalValue > 0.0 ? totalError / totalValue : 0.0,
    perValue > 0.0 ? totalError / perValue : 0.0, result.Samples);
  return met >= 0.95 * totalArea;
}

bool RadiositySimulation::Internals::RunDense(
  const ElementSet& coarsest, const StageProgress& stage)
{
  const bool refine = this->Options.Refinement != RefinementMode::Off;
  const std::size_t limit = std::max(this->AutomaticLimit(), coarsest.Size());
  double area = refine ? this->Area / 200.0 : std::numeric_limits<double>::infinity();
  while (refine && coarsest.CountAtArea(area) > limit)
  {
    area *= 2.0;
  }
  // Coarse elements need no fine exchange: both get finer, as the error asks for the one or the
  // other.
  this->Tolerance = std::max(this->Options.RelativeTolerance, refine ? FirstTolerance : 0.0);
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
    auto level = std::make_unique<Level>(this->Geometry, elements, this->Options.Emission);
    this->Illuminate(*level, part(0.0, 0.2, "direct light"));
    this->Timed("exchange", [&] {
      level->F = std::make_unique<DenseOperator>(this->Geometry, this->Occluders, level->Elements,
        this->Exchange(), part(0.2, 0.8, "exchange"));
    });
    this->Timed("solve", [&] { this->Solve(*level, true, part(0.8, 1.0, "solve")); });
    begin = part(0.0, 1.0, "").End;
    const bool met = this->Evaluate(*level, "solved", nullptr);
    const std::size_t n = level->Elements.Size();
    this->Finest = std::move(level);
    if (met && !(this->Options.Refinement == RefinementMode::On && n == coarsest.Size()))
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
    const double tolerance = this->Tolerance;
    if (sampled > 0.3 * budget.Discretisation)
    {
      this->Tolerance = std::max(this->Options.RelativeTolerance, 0.3 * tolerance);
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
    if (count == n && this->Tolerance == tolerance)
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
      (tolerance / this->Tolerance);
    if (predicted > this->Left())
    {
      this->Result.Outcome = "the time budget does not allow a finer step";
      return true;
    }
    area = next;
  }
}

void RadiositySimulation::Internals::RunMonteCarlo(
  const ElementSet& coarsest, const StageProgress& stage)
{
  // Elements fine enough for the tolerance, as far as rays for them fit in time and memory.
  ElementSet elements = coarsest;
  if (this->Options.Refinement != RefinementMode::Off)
  {
    double wanted = std::clamp(60.0 / this->Options.RelativeTolerance, 500.0, 6000.0);
    std::size_t most = std::max<std::size_t>(2 * coarsest.Size(), 30000);
    most = std::min(most, this->Memory / 2 / (FirstRays * 4 + 200));
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
  this->Tolerance = this->Options.RelativeTolerance;
  auto level = std::make_unique<Level>(this->Geometry, elements, this->Options.Emission);
  this->Illuminate(*level, part(0.0, 0.2, "direct light"));
  const Values directError = level->DirectError;
  const std::size_t n = level->Elements.Size();
  double raySeconds = 0.0;
  this->Timed("rays", [&] {
    const double begin = this->Result.Convergence.Elapsed();
    int rays = FirstRays;
    if (this->Options.TimeBudget > 0.0)
    {
      rays = static_cast<int>(
        std::clamp(0.2e6 * this->Left() / static_cast<double>(n), 16.0, double(FirstRays)));
    }
    auto carlo = std::make_unique<MonteCarloOperator>(
      this->Occluders, level->Elements, this->Exchange(), rays, part(0.2, 0.3, "rays"));
    level->Carlo = carlo.get();
    level->F = std::move(carlo);
    raySeconds = (this->Result.Convergence.Elapsed() - begin) /
      static_cast<double>(std::max<std::int64_t>(1, level->F->Samples()));
  });
  double at = 0.3;
  for (int rounds = 0;; ++rounds)
  {
    const double round = this->Result.Convergence.Elapsed();
    this->Timed(
      "solve", [&] { this->Solve(*level, rounds == 0 || rounds == 2, part(at, at, "solve")); });
    const double solveSeconds = this->Result.Convergence.Elapsed() - round;
    std::vector<std::uint8_t> unfinished;
    const bool met = this->Evaluate(*level, "rays", &unfinished);
    if (met)
    {
      this->Result.Outcome = MetOutcome;
      break;
    }
    // More rays only where rays are what limits.
    std::int64_t more = 0;
    for (std::size_t e = 0; e < n; ++e)
    {
      bool limits = false;
      for (std::size_t b = 0; b < this->Bands; ++b)
      {
        const std::size_t k = e * this->Bands + b;
        limits = limits ||
          level->VisibilityError[k] >
            0.3 * (std::abs(level->Discretisation[k]) + level->DirectError[k]);
      }
      unfinished[e] = unfinished[e] && limits && level->Carlo->Rays(e) < MostRays;
      more += unfinished[e] ? level->Carlo->Rays(e) : 0;
    }
    if (more == 0)
    {
      this->Result.Outcome = "the elements' size limits the error, not the rays";
      break;
    }
    if (level->F->MemoryBytes() + static_cast<std::size_t>(more) * 4 > this->Memory)
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
    level->DirectError = directError;
  }
  this->Finest = std::move(level);
}

RadiositySimulation::RadiositySimulation(
  const Scene& scene, const OcclusionScene& occluders, const RadiosityOptions& options)
  : Impl(new Internals(scene, occluders, options))
{
}

RadiositySimulation::~RadiositySimulation() = default;

const RadiosityResult& RadiositySimulation::Run(const StageProgress& stage)
{
  Internals& m = *this->Impl;
  CheckOptics(m.Geometry);
  if (!(m.Options.RelativeTolerance > 0.0) && !(m.Options.AbsoluteTolerance > 0.0))
  {
    throw InputError("RelativeTolerance", -1, m.Options.RelativeTolerance,
      "a positive number, unless AbsoluteTolerance is positive");
  }
  m.Options.RelativeTolerance = std::clamp(m.Options.RelativeTolerance, 1e-6, 1.0);
  const ElementSet elements(m.Geometry, m.Options.BackFaces);
  for (const double a : elements.GetAreas())
  {
    m.Area += a;
  }
  m.Result.Method = m.Choose(elements);
  if (elements.Size() == 0)
  {
    for (FieldValues* f : { &m.Result.Irradiance[0], &m.Result.Radiosity[0] })
    {
      f->Values.assign(m.Geometry.Cells * m.Bands, 0.0);
      f->Errors = f->Values;
    }
    m.Result.Outcome = "there is nothing to receive light";
    return m.Result;
  }

  // When nothing travels on, what the lights give is all.
  const ElementOptics optics(m.Geometry, elements, m.Options.Emission);
  const auto positive = [](double v) { return v > 0.0; };
  const bool reflects = m.Options.Interreflection &&
    std::any_of(optics.Reflectance.begin(), optics.Reflectance.end(), positive);
  const bool emits = std::any_of(optics.Exitance.begin(), optics.Exitance.end(), positive);
  const bool lit = emits ||
    std::any_of(m.Geometry.Lights.begin(), m.Geometry.Lights.end(),
      [](const Light& light) { return light.Enabled; });
  const bool lightsOnly = !lit ||
    (!reflects &&
      (!emits || !SmallEmitters(m.Geometry, elements, m.Options.BackFaces, EmitterPairs).Empty()));
  if (lightsOnly)
  {
    auto level = std::make_unique<Level>(m.Geometry, elements, m.Options.Emission);
    m.Illuminate(*level, stage);
    const std::size_t values = elements.Size() * m.Bands;
    level->Leaving.assign(values, 0.0);
    m.Evaluate(*level, "direct light", nullptr);
    m.Finest = std::move(level);
    m.Result.MethodWhy = "none: nothing is reflected";
    m.Result.Outcome = "direct light is all there is";
    return m.Result;
  }
  if (m.Result.Method == RadiosityMethod::MonteCarlo)
  {
    m.RunMonteCarlo(elements, stage);
  }
  else if (!m.RunDense(elements, stage) && m.Options.Method == RadiosityMethod::Auto &&
    m.Options.Occlusion && !m.Convex)
  {
    m.Result.Method = RadiosityMethod::MonteCarlo;
    m.Result.MethodWhy = "MonteCarlo: the tolerance asks for more elements than all pairs allow";
    m.RunMonteCarlo(elements, stage);
  }
  m.Result.MethodWhy += "; " + m.Finest->F->Description();
  return m.Result;
}

FieldValues RadiositySimulation::IrradianceAt(
  const std::vector<SurfacePoint>& points, const StageProgress& stage) const
{
  const Internals& m = *this->Impl;
  FieldValues out;
  if (!m.Finest)
  {
    out.Values.assign(points.size() * m.Bands, 0.0);
    out.Errors = out.Values;
    return out;
  }
  const Level& level = *m.Finest;
  ExchangeOptions exchange = m.Exchange();
  exchange.RelativeTolerance = m.Options.RelativeTolerance;
  exchange.Occlusion = exchange.Occlusion && !m.Convex;
  const auto part = [&](double from, double to, const char* name) {
    StageProgress p = stage;
    p.Begin = stage.Begin + from * (stage.End - stage.Begin);
    p.End = stage.Begin + to * (stage.End - stage.Begin);
    p.Name = name;
    return p;
  };
  DirectResult direct = ComputeDirectIrradiance(
    m.Geometry, m.Occluders, points, m.Direct(), part(0.0, 0.2, "direct light at points"));
  out.Values = std::move(direct.Irradiance);
  out.Errors = std::move(direct.Error);
  if (!level.Emitters.Empty())
  {
    const EmitterResult e = ComputeEmitterIrradiance(m.Geometry, m.Occluders, points,
      level.Emitters, exchange, part(0.2, 0.4, "emitters at points"));
    for (std::size_t k = 0; k < out.Values.size(); ++k)
    {
      out.Values[k] += e.Irradiance[k];
      out.Errors[k] =
        std::hypot(out.Errors[k], DenseCoverage * e.VisibilityError[k]) + e.GeometryError[k];
    }
  }
  if (level.F)
  {
    double mean = 0.0, area = 0.0;
    for (std::size_t k = 0; k < level.Irradiance.size(); ++k)
    {
      const double a = level.Elements.GetAreas()[k / m.Bands];
      mean += a * level.Irradiance[k];
      area += a;
    }
    mean /= area;
    const double allowed =
      std::max(m.Options.AbsoluteTolerance, m.Options.RelativeTolerance * DarkShare * mean);
    const GatherResult g = GatherAtPoints(m.Geometry, m.Occluders, level.Elements, level.Leaving,
      static_cast<int>(m.Bands), points, allowed, exchange, part(0.4, 1.0, "final gather"));
    // The elements' own errors reach points as they reach elements: by their mean share.
    const RadiosityErrorBudget& budget = m.Result.Budget;
    const double share =
      mean > 0.0 ? (budget.Discretisation + budget.FormFactors + budget.Solver) / mean : 0.0;
    for (std::size_t k = 0; k < out.Values.size(); ++k)
    {
      out.Values[k] += g.Irradiance[k];
      out.Errors[k] =
        std::hypot(std::hypot(out.Errors[k], CarloCoverage * g.Error[k]), share * g.Irradiance[k]);
    }
  }
  return out;
}

} // namespace radiometry
