// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/RadiosityLevel.h"

#include "radiometry/effects/CompiledEffects.h"
#include "radiometry/formfactor/GroupedOperator.h"
#include "radiometry/solver/BalanceError.h"
#include "radiometry/solver/BlindSides.h"
#include "radiometry/geometry/Sampling.h"
#include "radiometry/solver/ElementOverlap.h"
#include "radiometry/solver/LightKey.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/solver/RadiositySolver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace radiometry
{
namespace
{

using Values = RadiosityLevel::Values;

constexpr std::uint64_t SignDraws = 3;
constexpr std::size_t EmitterPairs = 4000000;
constexpr std::size_t DefaultMemory = std::size_t(2) << 30;

/// The system solved with one unknown for each group of elements. `guess`: what may arrive at the
/// elements; null: nothing is known.
SolveResult SolveGrouped(const GroupedOperator& grouped, const std::vector<double>& areas,
  const DiffuseScattering& scattering, const Values& source, int bands, SolveOptions options,
  const Values* guess, const StageProgress& stage)
{
  const std::size_t values = grouped.Size() * static_cast<std::size_t>(bands);
  Values groupSource(values), groupGuess;
  grouped.Restrict(source.data(), groupSource.data(), bands);
  if (guess)
  {
    groupGuess.resize(values);
    grouped.Restrict(guess->data(), groupGuess.data(), bands);
    options.Guess = &groupGuess;
  }
  return SolveRadiosity(grouped,
    scattering.Grouped(
      static_cast<std::size_t>(bands), areas, grouped.Groups(), grouped.Size()),
    groupSource, bands, options, {}, stage);
}

} // namespace

RadiosityContext::RadiosityContext(
  const Scene& scene, const OcclusionScene& occluders, const RadiosityOptions& options)
  : Geometry(scene)
  , Occluders(occluders)
  , Options(options)
  , Bands(static_cast<std::size_t>(scene.Optics.Bands))
  , Memory(options.MemoryLimit ? options.MemoryLimit : DefaultMemory)
{
  this->Light = KeyOfLight(scene, options);
  if ((Compiled(Effect::SpecularTransport) || Compiled(Effect::Transmission)) &&
    options.FollowsPaths() &&
    (options.Method == RadiosityMethod::Auto || options.Method == RadiosityMethod::MonteCarlo))
  {
    const auto paths = std::make_shared<const SpecularSurfaces>(
      scene, options.SpecularTransport, options.PathTransmission, options.BackFaces);
    this->Paths = paths->Empty() ? nullptr : paths;
  }
}

const std::vector<std::array<std::uint8_t, 2>>& RadiosityContext::Blind() const
{
  if (this->BlindSides.empty())
  {
    this->BlindSides = FindBlindSides(this->Geometry);
  }
  return this->BlindSides;
}

ExchangeOptions RadiosityContext::Exchange() const
{
  ExchangeOptions o;
  o.RelativeTolerance = this->Tolerance;
  o.Occlusion = this->Options.Occlusion;
  o.MemoryLimit = this->Memory;
  o.Threads = this->Options.Threads;
  o.Ranks = this->Options.Ranks;
  o.Seed = this->Options.Seed;
  o.Paths = this->Paths;
  return o;
}

SpecularLightOptions RadiosityContext::Mirrored(double secondsLeft) const
{
  SpecularLightOptions o;
  o.RelativeTolerance = 0.5 * this->Options.RelativeTolerance;
  o.AbsoluteTolerance = 0.5 * this->Options.AbsoluteTolerance;
  o.SpotShape = this->Options.SpotShape;
  o.Attenuation = this->Options.Attenuation;
  o.Environment = this->Options.Environment;
  o.SecondsLeft = this->Options.TimeBudget > 0.0 ? std::max(1e-3, 0.5 * secondsLeft) : 0.0;
  o.Threads = this->Options.Threads;
  o.Seed = this->Options.Seed;
  o.Ranks = this->Options.Ranks;
  return o;
}

ExchangeOptions RadiosityContext::Sight() const
{
  ExchangeOptions o = this->Exchange();
  o.Occlusion = o.Occlusion && !this->Convex;
  return o;
}

namespace
{

/// What reflection adds everywhere, dim places too, as a share of the mean direct light: some
/// rho/(1 - rho) where little is lost, of which three quarters are counted on.
double ReflectedShare(const Materials& optics)
{
  const std::vector<double>& reflectance = optics.DiffuseReflectance[0];
  double mean = 0.0;
  for (const double r : reflectance)
  {
    mean += r / static_cast<double>(reflectance.size());
  }
  return mean < 0.5 ? 0.75 * mean / (1.0 - mean) : 0.75;
}

} // namespace

DirectOptions RadiosityContext::Direct(double secondsLeft) const
{
  DirectOptions o;
  o.RelativeTolerance = 0.5 * this->Options.RelativeTolerance;
  o.AbsoluteTolerance = 0.5 * this->Options.AbsoluteTolerance;
  o.MeanShare = this->Options.Interreflection ? ReflectedShare(this->Geometry.Optics) : 0.0;
  o.SecondsLeft = this->Options.TimeBudget > 0.0 ? std::max(1e-3, 0.5 * secondsLeft) : 0.0;
  o.Occlusion = this->Options.Occlusion;
  o.SpotShape = this->Options.SpotShape;
  o.Attenuation = this->Options.Attenuation;
  o.Environment = this->Options.Environment;
  o.Transmission = this->Options.Transmission;
  o.KindSeconds = this->Options.KindSeconds;
  o.Threads = this->Options.Threads;
  o.Ranks = this->Options.Ranks;
  return o;
}

RadiosityLevel::RadiosityLevel(const RadiosityContext& context, ElementSet set)
  : Elements(std::move(set))
  , Optics(context.Geometry, Elements, false)
{
  this->Prepare(context);
}

void RadiosityLevel::Prepare(const RadiosityContext& context)
{
  const std::size_t values = this->Elements.Size() * context.Bands;
  this->Optics = ElementOptics(context.Geometry, this->Elements, context.Options.Emission,
    context.Options.Transmission);
  for (Values* v : { &this->First, &this->FirstError, &this->Irradiance, &this->DirectError,
         &this->FormFactorError, &this->VisibilityError, &this->Discretisation,
         &this->SolverError })
  {
    v->assign(values, 0.0);
  }
  this->Light = context.Light;
  this->LitFor.RelativeTolerance = 0.0;
  this->SolvedFor = 0.0;
  this->DiscretisedAt = 0.0;
  this->HasGuess = this->HasGuess && this->Gathered.size() == values;
  this->Gathered.resize(values, 0.0);
  this->Leaving.resize(values, 0.0);
  const auto positive = [](double m) { return m > 0.0; };
  this->Emitters = {};
  this->Mirrored = {};
  if (std::any_of(this->Optics.Exitance.begin(), this->Optics.Exitance.end(), positive))
  {
    this->Emitters =
      SmallEmitters(context.Geometry, this->Elements, context.Options.BackFaces, EmitterPairs);
  }
}

void RadiosityLevel::PrepareAgain(const RadiosityContext& context)
{
  if (this->Light != context.Light || !(this->LitFor.RelativeTolerance > 0.0))
  {
    this->Prepare(context);
  }
}

void RadiosityLevel::BeginFrom(const RadiosityLevel& earlier, std::size_t bands)
{
  const std::vector<ElementOrigin> origin = FindOrigins(this->Elements, earlier.Elements);
  for (std::size_t e = 0; e < origin.size(); ++e)
  {
    if (origin[e].Element >= 0)
    {
      const std::size_t from = static_cast<std::size_t>(origin[e].Element) * bands;
      std::copy_n(earlier.Leaving.data() + from, bands, this->Leaving.data() + e * bands);
      std::copy_n(earlier.Gathered.data() + from, bands, this->Gathered.data() + e * bands);
    }
  }
  this->HasGuess = true;
  if (!earlier.RowTolerance.empty())
  {
    this->RowTolerance.assign(origin.size(), 1.0f);
    for (std::size_t e = 0; e < origin.size(); ++e)
    {
      const std::int32_t from = origin[e].Element;
      this->RowTolerance[e] = from < 0 ? 1.0f : earlier.RowTolerance[static_cast<std::size_t>(from)];
    }
  }
}

std::size_t RadiosityLevel::MemoryBytes() const
{
  std::size_t bytes = this->F ? this->F->MemoryBytes() : 0;
  bytes += this->Elements.Size() * (sizeof(Patch) + 64);
  for (const Values* v : { &this->First, &this->FirstError, &this->Leaving, &this->Gathered,
         &this->Irradiance, &this->DirectError, &this->FormFactorError, &this->VisibilityError, &this->Discretisation,
         &this->SolverError, &this->InverseBound })
  {
    bytes += v->size() * sizeof(double);
  }
  return bytes;
}

/// Lights and emitters at some of the elements. `knownMean`: what lights give on average, where that
/// is known from others; negative: of these.
void RadiosityLevel::AddLights(const RadiosityContext& context, const std::vector<Patch>& patches,
  double knownMean, double secondsLeft, const StageProgress& stage, Values& light, Values& error)
{
  const ConvergenceRecord clock;
  StageProgress part = stage;
  part.End = this->Emitters.Empty() ? stage.End : 0.5 * (stage.Begin + stage.End);
  DirectOptions options = context.Direct(secondsLeft);
  if (knownMean >= 0.0)
  {
    options.AbsoluteTolerance = std::max(
      options.AbsoluteTolerance, options.RelativeTolerance * options.MeanShare * knownMean);
    options.MeanShare = 0.0;
  }
  DirectResult direct =
    ComputeDirectIrradiance(context.Geometry, context.Occluders, patches, options, part);
  this->TimedOut = this->TimedOut || direct.TimedOut;
  light = std::move(direct.Irradiance);
  error = std::move(direct.Error);
  if (knownMean < 0.0)
  {
    double sum = 0.0, area = 0.0;
    for (std::size_t k = 0; k < light.size(); ++k)
    {
      const double a = Area(patches[k / context.Bands].Corners);
      sum += a * light[k];
      area += a;
    }
    this->LightMean = area > 0.0 ? sum / area : 0.0;
  }
  if (this->Emitters.Empty())
  {
    return;
  }
  part.Begin = part.End;
  part.End = stage.End;
  part.Name = "emitters";
  ExchangeOptions sight = context.Sight();
  if (context.Options.TimeBudget > 0.0)
  {
    sight.SecondsLeft = std::max(1e-3, 0.5 * secondsLeft - clock.Elapsed());
  }
  sight.RelativeTolerance = context.Options.RelativeTolerance;
  const EmitterResult e = ComputeEmitterIrradiance(
    context.Geometry, context.Occluders, patches, this->Emitters, sight, part);
  this->TimedOut = this->TimedOut || e.TimedOut;
  for (std::size_t k = 0; k < light.size(); ++k)
  {
    light[k] += e.Irradiance[k];
    error[k] = std::hypot(error[k], e.Error[k]);
  }
}

void RadiosityLevel::Illuminate(const RadiosityContext& context, double secondsLeft,
  const RadiosityLevel* earlier, const StageProgress& stage)
{
  // What only time kept from being found is not worth keeping.
  constexpr double good = 0.25;
  const std::size_t nb = context.Bands;
  const std::vector<Patch>& patches = this->Elements.GetPatches();
  this->TimedOut = false;
  this->Mirrored = {};
  this->Straight.clear();
  this->StraightError.clear();
  if (!earlier || earlier->Emitters.Empty() != this->Emitters.Empty())
  {
    this->AddLights(context, patches, -1.0, secondsLeft, stage, this->First, this->FirstError);
  }
  else
  {
    const Values& before = earlier->Straight.empty() ? earlier->First : earlier->Straight;
    const Values& beforeError =
      earlier->Straight.empty() ? earlier->FirstError : earlier->StraightError;
    const std::vector<ElementOrigin> origin = FindOrigins(this->Elements, earlier->Elements);
    std::vector<std::size_t> fresh;
    std::vector<Patch> those;
    for (std::size_t e = 0; e < patches.size(); ++e)
    {
      const std::size_t from = static_cast<std::size_t>(std::max(0, origin[e].Element)) * nb;
      bool kept = origin[e].Same;
      for (std::size_t b = 0; kept && b < nb; ++b)
      {
        this->First[e * nb + b] = before[from + b];
        this->FirstError[e * nb + b] = beforeError[from + b];
        kept = !earlier->TimedOut || beforeError[from + b] <= good * before[from + b];
      }
      if (!kept)
      {
        fresh.push_back(e);
        those.push_back(patches[e]);
      }
    }
    this->LightMean = earlier->LightMean;
    Values light, error;
    this->AddLights(context, those, this->LightMean, secondsLeft, stage, light, error);
    for (std::size_t k = 0; k < fresh.size(); ++k)
    {
      std::copy_n(light.data() + k * nb, nb, this->First.data() + fresh[k] * nb);
      std::copy_n(error.data() + k * nb, nb, this->FirstError.data() + fresh[k] * nb);
    }
  }
  this->Irradiance = this->First;
  this->DirectError = this->FirstError;
  this->LitFor = context.Direct(0.0);
  this->SolvedFor = 0.0;
}

bool RadiosityLevel::IlluminateFiner(
  const RadiosityContext& context, double secondsLeft, const StageProgress& stage)
{
  const DirectOptions wanted = context.Direct(0.0);
  const bool finer = wanted.RelativeTolerance < this->LitFor.RelativeTolerance ||
    wanted.AbsoluteTolerance < this->LitFor.AbsoluteTolerance;
  if (!finer && !this->TimedOut)
  {
    return false;
  }
  const std::size_t nb = context.Bands;
  const Values& light = this->Straight.empty() ? this->First : this->Straight;
  const Values& error = this->Straight.empty() ? this->FirstError : this->StraightError;
  const double floor = std::max(wanted.AbsoluteTolerance,
    wanted.RelativeTolerance * wanted.MeanShare * this->LightMean);
  std::vector<std::size_t> open;
  std::vector<Patch> those;
  for (std::size_t e = 0; e < this->Elements.Size(); ++e)
  {
    bool fine = true;
    for (std::size_t k = e * nb; k < (e + 1) * nb; ++k)
    {
      fine = fine && error[k] <= std::max(floor, wanted.RelativeTolerance * light[k]);
    }
    if (!fine)
    {
      open.push_back(e);
      those.push_back(this->Elements.GetPatches()[e]);
    }
  }
  this->LitFor = wanted;
  this->TimedOut = false;
  if (open.empty() && this->Straight.empty())
  {
    return false;
  }
  this->First = Values(light);
  this->FirstError = Values(error);
  this->Straight.clear();
  this->StraightError.clear();
  this->Mirrored = {};
  Values found, foundError;
  this->AddLights(context, those, this->LightMean, secondsLeft, stage, found, foundError);
  for (std::size_t k = 0; k < open.size(); ++k)
  {
    std::copy_n(found.data() + k * nb, nb, this->First.data() + open[k] * nb);
    std::copy_n(foundError.data() + k * nb, nb, this->FirstError.data() + open[k] * nb);
  }
  this->Irradiance = this->First;
  this->DirectError = this->FirstError;
  this->SolvedFor = 0.0;
  return true;
}

void RadiosityLevel::AddMirrored(
  const RadiosityContext& context, double secondsLeft, const StageProgress& stage)
{
  if (!context.Paths)
  {
    return;
  }
  StageProgress part = stage;
  part.Name = "light over mirrors";
  this->Straight = this->First;
  this->StraightError = this->FirstError;
  this->Mirrored = FindSpecularLight(context.Geometry, context.Occluders, this->Elements,
    this->Emitters, *context.Paths, this->First, context.Mirrored(secondsLeft), part);
  for (std::size_t k = 0; k < this->First.size(); ++k)
  {
    this->First[k] += this->Mirrored.Irradiance[k];
    this->FirstError[k] = std::hypot(this->FirstError[k], this->Mirrored.Error[k]);
  }
  this->SolvedFor = 0.0;
  this->Irradiance = this->First;
  this->DirectError = this->FirstError;
}

void RadiosityLevel::CheckEmission(const RadiosityContext& context) const
{
  if (!context.Paths || !this->Emitters.Empty())
  {
    return;
  }
  for (std::size_t k = 0; k < this->Optics.Exitance.size(); ++k)
  {
    const Patch& p = this->Elements.GetPatches()[k / context.Bands];
    const std::size_t band = context.Paths->Width() > 1 ? k % context.Bands : 0;
    if (this->Optics.Exitance[k] > 0.0 && !(context.Paths->Left(p.Triangle, p.Side == 0, band) > 0.0))
    {
      throw InputError(names::EmittedExitance, p.Cell, this->Optics.Exitance[k],
        "0 where SpecularReflectance and Transmittance sum to 1: what sends all on does not emit");
    }
  }
}

void RadiosityLevel::Solve(
  const RadiosityContext& context, bool discretise, const StageProgress& stage)
{
  this->CheckEmission(context);
  const std::size_t n = this->Elements.Size();
  const std::size_t values = n * context.Bands;
  const int bands = static_cast<int>(context.Bands);
  const bool perCell = context.Options.Refinement == RefinementMode::Off;
  // Without interreflection only what is emitted travels on.
  const DiffuseScattering scattering = context.Options.Interreflection
    ? this->Optics.Scattering()
    : DiffuseScattering(Values(values, 0.0));
  Values source(values);
  scattering.Apply(this->First.data(), source.data(), context.Bands);
  for (std::size_t k = 0; k < values && this->Emitters.Empty(); ++k)
  {
    source[k] += this->Optics.Exitance[k];
  }

  SolveOptions options;
  options.Tolerance = std::clamp(3e-3 * context.Options.RelativeTolerance, 1e-9, n < 20000 ? 1e-5 : 1e-4);
  options.Threads = context.Options.Threads;
  const Values guess = this->HasGuess ? this->Gathered : Values();
  options.Guess = this->HasGuess ? &guess : nullptr;
  options.InverseBound = this->InverseBound.empty() ? nullptr : &this->InverseBound;
  SolveResult r;
  std::vector<std::int32_t> component; // empty where nothing had to be solved
  if (context.Options.MaximumBounces > 0 && context.Options.Interreflection)
  {
    this->SumBounces(context, scattering);
  }
  else if (perCell)
  {
    std::size_t count = 0;
    const std::vector<std::int32_t> group = this->Elements.CellGroups(count);
    const GroupedOperator grouped(*this->F, group, count);
    r = SolveGrouped(grouped, this->F->Areas(), scattering, source, bands, options,
      this->HasGuess ? &guess : nullptr, stage);
    grouped.Prolong(r.Radiosity.data(), this->Leaving.data(), bands);
    grouped.Prolong(r.Error.data(), this->SolverError.data(), bands);
    for (std::size_t e = 0; e < n && !r.Component.empty(); ++e)
    {
      component.push_back(r.Component[static_cast<std::size_t>(group[e])]);
    }
    this->F->Apply(this->Leaving.data(), this->Gathered.data(), bands);
  }
  else
  {
    std::vector<std::int32_t> cells(n);
    for (std::size_t e = 0; e < n; ++e)
    {
      cells[e] = this->Elements.GetPatches()[e].Cell;
    }
    r = SolveRadiosity(*this->F, scattering, source, bands, options, cells, stage);
    this->Leaving = std::move(r.Radiosity);
    this->SolverError = std::move(r.Error);
    this->Gathered = std::move(r.Irradiance);
    component = std::move(r.Component);
  }
  this->Iterations += r.Iterations;
  this->HasGuess = true;
  this->InverseBound = std::move(r.InverseBound);
  for (std::size_t k = 0; k < values; ++k)
  {
    this->Irradiance[k] = this->First[k] + this->Gathered[k];
  }

  // What the operator does not know, given what leaves.
  this->F->ApplyError(
    this->Leaving.data(), this->FormFactorError.data(), this->VisibilityError.data(), bands);
  if (this->Carlo)
  {
    this->PoolSampling(context);
    this->AddReflectedSampling(context, scattering);
  }
  const double coverage = this->Carlo ? CarloCoverage : DenseCoverage;
  for (double& v : this->VisibilityError)
  {
    v *= coverage;
  }
  // Of pairs it is a bound, of links a standard error.
  if (this->Method == RadiosityMethod::Hierarchical)
  {
    for (double& v : this->FormFactorError)
    {
      v *= LinkCoverage;
    }
  }
  AddBalanceError(*this->F, component, r.LossShare, context.Bands, this->FormFactorError,
    this->VisibilityError);

  // Errors of direct light travel on as light does.
  Values carried(values), arrived(values);
  scattering.Apply(this->FirstError.data(), carried.data(), context.Bands);
  this->F->Apply(carried.data(), arrived.data(), bands);
  for (std::size_t k = 0; k < values; ++k)
  {
    this->DirectError[k] = this->FirstError[k] + arrived[k];
  }
  if (discretise)
  {
    this->Discretise(context, scattering, source, stage);
    this->DiscretisedAt = static_cast<double>(this->F->Samples()) / static_cast<double>(n);
  }
  this->SolvedFor = context.Options.RelativeTolerance;
}

/// Rays that all missed a small bright place know nothing of it and seem sure of themselves: each
/// element's spread of eight batches is averaged with that of its neighbourhood.
void RadiosityLevel::PoolSampling(const RadiosityContext& context)
{
  const std::size_t nb = context.Bands;
  std::size_t count = 0;
  const std::vector<std::int32_t> group = this->Elements.Groups(context.Geometry, 2, count);
  Values square(count * nb, 0.0), members(count, 0.0), rays(count, 0.0);
  for (std::size_t e = 0; e < group.size(); ++e)
  {
    // Brought to the variance of one ray: elements differ in how many they have.
    const auto g = static_cast<std::size_t>(group[e]);
    members[g] += 1.0;
    rays[g] += this->Carlo->OwnRays(e);
    for (std::size_t b = 0; b < nb; ++b)
    {
      const double v = this->VisibilityError[e * nb + b];
      square[g * nb + b] += v * v * this->Carlo->Rays(e);
    }
  }
  for (std::size_t e = 0; e < group.size(); ++e)
  {
    const auto g = static_cast<std::size_t>(group[e]);
    for (std::size_t b = 0; b < nb; ++b)
    {
      double& v = this->VisibilityError[e * nb + b];
      const double pooled = square[g * nb + b] / members[g] / this->Carlo->Rays(e);
      v = std::sqrt(0.5 * (v * v + pooled));
    }
  }
  this->BoundUnmet(context, group, rays);
}

/// Where N rays of a neighbourhood met nothing that sends light, the share of it that does is below
/// 3/N with 95 %: so much of the greatest radiosity may arrive all the same. Nothing where no surface
/// is before the plane.
void RadiosityLevel::BoundUnmet(const RadiosityContext& context,
  const std::vector<std::int32_t>& group, const std::vector<double>& rays)
{
  const std::size_t nb = context.Bands;
  Values greatest(nb, 0.0), met(rays.size() * nb, 0.0);
  for (std::size_t k = 0; k < this->Gathered.size(); ++k)
  {
    met[static_cast<std::size_t>(group[k / nb]) * nb + k % nb] += std::max(0.0, this->Gathered[k]);
  }
  for (std::size_t k = 0; k < this->Leaving.size(); ++k)
  {
    greatest[k % nb] = std::max(greatest[k % nb], this->Leaving[k]);
  }
  for (std::size_t k = 0; k < this->VisibilityError.size(); ++k)
  {
    const Patch& p = this->Elements.GetPatches()[k / nb];
    const auto g = static_cast<std::size_t>(group[k / nb]);
    if (met[g * nb + k % nb] > 0.0 || !(rays[g] > 0.0) ||
      context.Blind()[static_cast<std::size_t>(p.Triangle)][p.Side])
    {
      continue;
    }
    this->VisibilityError[k] =
      std::max(this->VisibilityError[k], 3.0 / CarloCoverage / rays[g] * greatest[k % nb]);
  }
}

/// Rays err independently of each other, and what an element misjudges so is reflected on: where few
/// elements are seen (in a gap) that does not average out. Signs drawn at random for what each leaves
/// wrong give the mean square of what arrives of it.
void RadiosityLevel::AddReflectedSampling(
  const RadiosityContext& context, const DiffuseScattering& scattering)
{
  const std::size_t n = this->Elements.Size();
  const std::size_t nb = context.Bands;
  Values sent(n * nb), square(n * nb, 0.0), drawn(n * nb), arrived(n * nb);
  scattering.Apply(this->VisibilityError.data(), sent.data(), nb);
  for (std::uint64_t draw = 0; draw < SignDraws; ++draw)
  {
    for (std::size_t k = 0; k < sent.size(); ++k)
    {
      const std::uint64_t key = Hash64(Hash64(context.Options.Seed ^ 0x7369676e73ull, draw), k / nb);
      drawn[k] = (key & 1) ? sent[k] : -sent[k];
    }
    this->F->Apply(drawn.data(), arrived.data(), static_cast<int>(nb));
    for (std::size_t k = 0; k < arrived.size(); ++k)
    {
      square[k] += arrived[k] * arrived[k] / static_cast<double>(SignDraws);
    }
  }
  std::size_t count = 0;
  const std::vector<std::int32_t> group = this->Elements.Groups(context.Geometry, 1, count);
  Values pooled(count * nb, 0.0), members(count, 0.0);
  for (std::size_t e = 0; e < n; ++e)
  {
    const auto g = static_cast<std::size_t>(group[e]);
    members[g] += 1.0;
    for (std::size_t b = 0; b < nb; ++b)
    {
      pooled[g * nb + b] += square[e * nb + b];
    }
  }
  for (std::size_t k = 0; k < square.size(); ++k)
  {
    const auto g = static_cast<std::size_t>(group[k / nb]);
    double& v = this->VisibilityError[k];
    v = std::sqrt(v * v + pooled[g * nb + k % nb] / members[g]);
  }
}

} // namespace radiometry
