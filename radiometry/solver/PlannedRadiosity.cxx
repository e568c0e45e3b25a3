// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/solver/PlannedRadiosity.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>

namespace radiometry
{
namespace
{

/// B = M + rho E + tau E_other at points, with the optics of the cells that meet there averaged.
/// The back of a cell that is not two-sided reflects and emits nothing.
FieldValues RadiosityAt(const Scene& scene, const std::vector<SurfacePoint>& points, int side,
  const RadiosityOptions& options, const std::array<FieldValues, 2>& irradiance)
{
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  const std::vector<double>& reflectance = scene.Optics.DiffuseReflectance[side];
  const std::vector<double>& emitted = scene.Optics.EmittedExitance[side];
  const std::vector<double>& through = scene.Optics.DiffuseTransmittance;
  const FieldValues& here = irradiance[side];
  const FieldValues& there = irradiance[1 - side];
  const bool other = options.Transmission && !through.empty() && !there.Values.empty();
  FieldValues out;
  out.Values.assign(points.size() * bands, 0.0);
  out.Errors.assign(points.size() * bands, 0.0);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    std::vector<std::int32_t> around = points[i].Around;
    if (around.empty() && points[i].Triangle >= 0)
    {
      around.push_back(points[i].Triangle);
    }
    const double share = around.empty() ? 0.0 : 1.0 / static_cast<double>(around.size());
    for (std::size_t b = 0; b < bands; ++b)
    {
      double rho = 0.0, m = 0.0, tau = 0.0;
      for (const std::int32_t t : around)
      {
        const auto cell = static_cast<std::size_t>(scene.TriangleCell[t]);
        const std::size_t at = cell * bands + b;
        tau += other ? share * through[at] : 0.0;
        if (side == 0 || scene.Optics.TwoSided[cell])
        {
          rho += share * reflectance[at];
          m += options.Emission && !emitted.empty() ? share * emitted[at] : 0.0;
        }
      }
      const std::size_t k = i * bands + b;
      out.Values[k] = m + rho * here.Values[k] + (other ? tau * there.Values[k] : 0.0);
      out.Errors[k] = rho * here.Errors[k] + (other ? tau * there.Errors[k] : 0.0);
    }
  }
  return out;
}

/// How much of each light arrives, at cells or at points.
void FindVisibility(const Scene& scene, const OcclusionScene& occluders,
  const std::vector<SurfacePoint>& points, bool cells, const RadiosityOptions& options,
  double secondsLeft, Monitor* monitor, PlannedRadiosity& out)
{
  DirectOptions direct;
  direct.RelativeTolerance = options.RelativeTolerance;
  direct.AbsoluteTolerance = options.AbsoluteTolerance;
  direct.Occlusion = options.Occlusion;
  direct.SpotShape = options.SpotShape;
  direct.Attenuation = options.Attenuation;
  direct.Environment = options.Environment;
  direct.Transmission = options.Transmission;
  direct.Threads = options.Threads;
  direct.Ranks = options.Ranks;
  direct.SecondsLeft = secondsLeft;
  const StageProgress stage{ monitor, 0.98, 0.99, "visibility of lights" };
  const int sides = options.BackFaces ? 2 : 1;
  if (cells)
  {
    std::vector<Patch> patches = MakePatches(scene, 0);
    const std::vector<Patch> backs = sides == 2 ? MakePatches(scene, 1) : std::vector<Patch>();
    patches.insert(patches.end(), backs.begin(), backs.end());
    out.CellVisibility =
      FindLightVisibility(scene, occluders, patches, scene.Cells, direct, stage);
  }
  for (int side = 0; side < sides && !points.empty(); ++side)
  {
    std::vector<SurfacePoint> facing = points;
    for (SurfacePoint& p : facing)
    {
      p.Normal = side == 1 ? -p.Normal : p.Normal;
    }
    out.PointVisibility[side] = FindLightVisibility(scene, occluders, facing, direct, stage);
  }
}

/// What is left of a time budget, between the run and what follows it.
void ShareTime(const std::vector<SurfacePoint>& points, RadiosityOptions& options)
{
  if (options.TimeBudget <= 0.0)
  {
    return;
  }
  constexpr double ofPoints = 0.35, ofVisibility = 0.15;
  const double left = std::max(1e-3, options.TimeBudget - options.SecondsBefore);
  options.SecondsForPoints = points.empty() ? 0.0 : ofPoints * left;
  options.TimeBudget =
    left * (1.0 - (options.LightVisibility ? ofVisibility : 0.0)) - options.SecondsForPoints;
}

/// How many reflections were counted, or matter, and what the others would add.
void TellBounces(
  const RadiosityResult& result, const RadiosityOptions& options, EffectDecision& decision)
{
  if (!decision.Simulated)
  {
    return;
  }
  const auto bounces = [](double n) {
    return std::to_string(static_cast<long long>(n)) + (n == 1.0 ? " bounce" : " bounces");
  };
  if (options.MaximumBounces > 0)
  {
    decision.Why += "; " + bounces(options.MaximumBounces) +
      " as asked (the bound is on what all further ones would add)";
    decision.Bound = std::max(decision.Bound, result.BouncesLeftOut);
  }
  else if (result.BouncesThatMatter > 0.0 && std::isfinite(result.BouncesThatMatter))
  {
    decision.Why += "; all bounces are counted, about " + bounces(result.BouncesThatMatter) +
      (result.BouncesThatMatter == 1.0 ? " matters" : " matter") + " at the tolerance";
  }
}

/// Seconds of the stages, by the effects that they are for; of direct light by its kinds.
void TellSeconds(
  const RadiosityResult& result, const std::array<double, 3>& kinds, SceneEffects& effects)
{
  double direct = 0.0;
  for (const auto& [stage, seconds] : result.Seconds)
  {
    if (stage == "direct light")
    {
      direct += seconds;
      continue;
    }
    const Effect effect = stage == "light over mirrors" ? Effect::SpecularTransport
      : stage == "refinement"                           ? Effect::Discretisation
                                                        : Effect::Interreflection;
    effects.Plan()[effect].Seconds += seconds;
  }
  effects.Spent(kinds, direct - std::accumulate(kinds.begin(), kinds.end(), 0.0));
}

/// How far the elements went.
void TellElements(const RadiosityResult& result, const Scene& scene, EffectDecision& decision)
{
  if (decision.Simulated)
  {
    decision.Why += "; " + std::to_string(result.Elements) + " elements of " +
      std::to_string(scene.ReceiverTriangles) + " triangles";
  }
}

/// No light is negative: what the correction of a coarse exchange pushed below zero is 0, and its
/// error says by how much. A value or an error without a number is never handed out.
void Complete(FieldValues& field, const char* where)
{
  for (std::size_t k = 0; k < field.Values.size(); ++k)
  {
    if (!std::isfinite(field.Values[k]) || !std::isfinite(field.Errors[k]))
    {
      throw std::runtime_error(std::string("the radiosity of ") + where + " value " +
        std::to_string(k) + " could not be bounded: the surface reflects more than its mesh can be "
        "solved for (overlapping faces, or reflectance too near 1)");
    }
    if (field.Values[k] < 0.0)
    {
      field.Errors[k] -= field.Values[k];
      field.Values[k] = 0.0;
    }
  }
}

} // namespace

PlannedRadiosity SimulatePlannedRadiosity(const Scene& given,
  const std::vector<SurfacePoint>& points, bool cells, const std::vector<EffectSwitch>& switches,
  RadiosityOptions options, Monitor* monitor, RadiosityCache* cache)
{
  Report(monitor, 0.0, "planning");
  if (options.LightVisibility)
  {
    CheckLightVisibility(given);
  }
  const ConvergenceRecord clock;
  EffectAbilities abilities;
  abilities.Interreflection = true;
  abilities.Emission = true;
  abilities.Environment = true;
  abilities.Transmission = true;
  abilities.RelativeTolerance = options.RelativeTolerance;
  abilities.AbsoluteTolerance = options.AbsoluteTolerance;
  abilities.Drops = !options.LightVisibility; // of each light by itself
  const bool rays =
    options.Method == RadiosityMethod::Auto || options.Method == RadiosityMethod::MonteCarlo;
  const bool unoccluded = switches[static_cast<int>(Effect::Occlusion)] == EffectSwitch::Off;
  abilities.Paths = rays && !unoccluded;
  abilities.NoPaths = !rays ? "only the MonteCarlo method follows light there"
    : unoccluded            ? "where Occlusion is off, rays meet nothing to go on from"
                            : "";
  abilities.Refinement = static_cast<EffectSwitch>(options.Refinement);
  SceneEffects effects(given, switches, abilities, points, cells);
  EffectPlan& plan = effects.Plan();
  const Scene& scene = effects.Simulated();
  options.Interreflection = plan.Simulates(Effect::Interreflection);
  options.Forced = plan[Effect::Interreflection].Wish == EffectSwitch::On;
  // Where nothing can stand between, rays may still be traced: they are how Monte Carlo exchanges.
  options.Occlusion = plan.Simulates(Effect::Occlusion) || !plan[Effect::Occlusion].Present;
  options.BackFaces = plan.Simulates(Effect::BackFaces);
  options.Emission = plan.Simulates(Effect::Emission);
  options.SpotShape = plan.Simulates(Effect::SpotShape);
  options.Attenuation = plan.Simulates(Effect::Attenuation);
  options.Environment = plan.Simulates(Effect::Environment);
  options.Transmission = plan.Simulates(Effect::Transmission);
  options.SpecularTransport = plan.Simulates(Effect::SpecularTransport);
  options.PathTransmission = abilities.Paths && effects.PassesPanes();

  std::array<double, 3> kinds{}; // seconds of direct light
  options.KindSeconds = &kinds;

  PlannedRadiosity out;
  RadiosityCache own;
  RadiosityCache& kept = cache ? *cache : own;
  const OcclusionScene& occluders = kept.Occluders(scene);
  if (!options.LoadOperator.empty())
  {
    kept.Load(options.LoadOperator, scene, options);
  }
  const double budget = options.TimeBudget;
  options.SecondsBefore = clock.Elapsed();
  ShareTime(points, options);
  options.PointsAfter = points.size();
  options.SurfaceOnly = std::all_of(
    points.begin(), points.end(), [](const SurfacePoint& p) { return p.Triangle >= 0; });
  auto made = std::make_unique<RadiositySimulation>(scene, options, kept);
  RadiositySimulation& simulation = *made;
  const double share = points.empty() ? 0.98 : (cells ? 0.8 : 0.6);
  out.Cells = simulation.Run({ monitor, 0.02, share, "radiosity" });
  const std::vector<double>& through = scene.Optics.DiffuseTransmittance;
  const bool diffusing =
    std::any_of(through.begin(), through.end(), [](double tau) { return tau > 0.0; });
  const int sides = options.BackFaces || diffusing ? 2 : 1;
  for (int side = 0; side < sides && !points.empty(); ++side)
  {
    std::vector<SurfacePoint> facing = points;
    for (SurfacePoint& p : facing)
    {
      p.Normal = side == 1 ? -p.Normal : p.Normal;
    }
    const double begin = share + (0.98 - share) * side / sides;
    const double end = share + (0.98 - share) * (side + 1) / sides;
    out.PointIrradiance[side] =
      simulation.IrradianceAt(facing, { monitor, begin, end, "final gather" });
  }
  for (int side = 0; side < sides && !points.empty(); ++side)
  {
    out.PointRadiosity[side] = RadiosityAt(scene, points, side, options, out.PointIrradiance);
  }

  made.reset(); // leaves what the next run may begin from
  if (!options.SaveOperator.empty())
  {
    kept.Save(options.SaveOperator, options.Ranks);
  }
  for (int side = 0; side < 2; ++side)
  {
    Complete(out.Cells.Irradiance[side], "cell");
    Complete(out.Cells.Radiosity[side], "cell");
    Complete(out.PointIrradiance[side], "point");
    Complete(out.PointRadiosity[side], "point");
  }

  if (options.LightVisibility)
  {
    const double left = budget > 0.0 ? std::max(1e-9, budget - clock.Elapsed()) : 0.0;
    FindVisibility(scene, occluders, points, cells, options, left, monitor, out);
  }
  TellSeconds(out.Cells, kinds, effects);
  TellElements(out.Cells, scene, plan[Effect::Discretisation]);
  for (int side = 0; side < 2; ++side)
  {
    for (FieldValues* values : { &out.Cells.Irradiance[side], &out.Cells.Radiosity[side],
           &out.PointIrradiance[side], &out.PointRadiosity[side] })
    {
      values->Values = effects.AllBands(std::move(values->Values));
      values->Errors = effects.AllBands(std::move(values->Errors));
    }
  }
  AddDropped(plan.DroppedBound(), { &out.Cells.Irradiance, &out.Cells.Radiosity,
    &out.PointIrradiance, &out.PointRadiosity });
  effects.Bound(GreatestValue({ &out.Cells.Irradiance, &out.PointIrradiance }));
  TellBounces(out.Cells, options, plan[Effect::Interreflection]);
  out.Effects = plan.Decisions();
  out.Cost = out.Cells.Cost;
  out.Cost.Seconds = clock.Elapsed();
  out.Cost.Samples = out.Cells.Samples;
  out.Cost.Bytes = out.Cells.OperatorBytes;
  Report(monitor, 1.0, "done");
  return out;
}

} // namespace radiometry
