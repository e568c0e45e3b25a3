// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/IrradianceSimulation.h"

#include "radiometry/irradiance/IrradianceCache.h"
#include "radiometry/irradiance/IrradianceCourse.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

namespace radiometry
{

std::vector<Patch> MakePatches(const Scene& scene, int side)
{
  std::vector<Patch> patches;
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    const std::int32_t cell = scene.TriangleCell[t];
    if (side == 1 && (scene.Optics.TwoSided.empty() || !scene.Optics.TwoSided[cell]))
    {
      continue;
    }
    Triangle3 corners = scene.TriangleAt(t);
    if (side == 1)
    {
      std::swap(corners[1], corners[2]);
    }
    patches.push_back(
      { corners, static_cast<std::int32_t>(t), cell, static_cast<std::uint8_t>(side) });
  }
  return patches;
}

FieldValues AverageOver(std::size_t count, int bandCount, const std::vector<Patch>& patches,
  int side, const std::vector<double>& values, const std::vector<double>& errors,
  const std::vector<float>& dropped)
{
  const auto bands = static_cast<std::size_t>(bandCount);
  FieldValues out;
  out.Values.assign(count * bands, 0.0);
  out.Errors.assign(count * bands, 0.0);
  std::vector<double> together(dropped.empty() ? 0 : count * bands, 0.0);
  std::vector<double> areas(count, 0.0);
  for (const Patch& p : patches)
  {
    areas[p.Cell] += p.Side == side ? Area(p.Corners) : 0.0;
  }
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    if (patches[i].Side != side)
    {
      continue;
    }
    const auto cell = static_cast<std::size_t>(patches[i].Cell);
    const double share = Area(patches[i].Corners) / areas[cell];
    for (std::size_t b = 0; b < bands; ++b)
    {
      const double error = errors[i * bands + b];
      const double common = dropped.empty() ? 0.0 : std::min<double>(error, dropped[i]);
      double& independent = out.Errors[cell * bands + b];
      independent = std::hypot(independent, share * (error - common));
      out.Values[cell * bands + b] += share * values[i * bands + b];
      if (!dropped.empty())
      {
        together[cell * bands + b] += share * common;
      }
    }
  }
  for (std::size_t k = 0; k < together.size(); ++k)
  {
    out.Errors[k] += together[k];
  }
  return out;
}

double GreatestValue(std::initializer_list<const std::array<FieldValues, 2>*> fields)
{
  double greatest = 0.0;
  for (const std::array<FieldValues, 2>* sides : fields)
  {
    for (const FieldValues& field : *sides)
    {
      for (std::size_t k = 0; k < field.Values.size(); ++k)
      {
        greatest = std::max(greatest, field.Values[k] + field.Errors[k]);
      }
    }
  }
  return greatest;
}

void AddDropped(double bound, std::initializer_list<std::array<FieldValues, 2>*> fields)
{
  for (std::array<FieldValues, 2>* sides : fields)
  {
    for (FieldValues& field : *sides)
    {
      for (double& error : field.Errors)
      {
        error += bound;
      }
    }
  }
}

namespace
{

/// Takes the values out of the cache that all ranks can go on from, and puts them back at the end,
/// or when the user stops the run.
class KeptValues
{
public:
  KeptValues(IrradianceCache* cache, const ContentKey& key, const IrradianceOptions& options)
    : Cache(cache)
    , Key(key)
    , Options(options)
  {
    this->Values = cache ? cache->Take(key) : nullptr;
    double missing = this->Values ? 0.0 : 1.0;
    if (options.Ranks)
    {
      options.Ranks->Largest(&missing, 1);
    }
    if (missing > 0.0)
    {
      this->Values = std::make_unique<IrradianceKept>();
    }
  }
  void Keep()
  {
    if (this->Cache)
    {
      this->Cache->Keep(this->Key, std::move(this->Values));
      if (this->Options.MemoryLimit > 0 && this->Cache->MemoryBytes() > this->Options.MemoryLimit)
      {
        this->Cache->Release();
      }
    }
  }
  IrradianceKept& operator*() { return *this->Values; }

private:
  IrradianceCache* Cache;
  ContentKey Key;
  const IrradianceOptions& Options;
  std::unique_ptr<IrradianceKept> Values;
};

/// Seconds a triangle or point that bounds on what is left out take.
constexpr double BoundSeconds = 3e-6;

DirectOptions DirectOf(const IrradianceOptions& options, const EffectPlan& plan)
{
  DirectOptions direct;
  direct.RelativeTolerance = options.RelativeTolerance;
  direct.AbsoluteTolerance = options.AbsoluteTolerance;
  direct.Occlusion = plan.Simulates(Effect::Occlusion);
  direct.SpotShape = plan.Simulates(Effect::SpotShape);
  direct.Attenuation = plan.Simulates(Effect::Attenuation);
  direct.Environment = plan.Simulates(Effect::Environment);
  direct.Transmission = plan.Simulates(Effect::Transmission);
  direct.Emission = plan.Simulates(Effect::Emission);
  const auto forced = [&](Effect effect) { return plan[effect].Wish == EffectSwitch::On; };
  direct.DropSky = !forced(Effect::Environment);
  direct.DropAreas = !forced(Effect::Emission) && !forced(Effect::AreaLights);
  direct.Dropped = plan.DroppedBound();
  direct.Threads = options.Threads;
  direct.Ranks = options.Ranks;
  return direct;
}

std::string OutcomeOf(bool timedOut, const IrradianceResult& result)
{
  std::string outcome = timedOut
    ? "the time budget ended the run before every value met its tolerance"
    : "every value met its tolerance or is as fine as can be";
  if (result.Pieces.TimedOut)
  {
    outcome += "; no time was left to cut all cells along the edges of shadows";
  }
  if (result.Pieces.Full > 0)
  {
    outcome += "; " + std::to_string(result.Pieces.Full) +
      " cells have more shadow edges than the limit of pieces let them be cut along";
  }
  return outcome;
}

} // namespace

IrradianceResult SimulateIrradiance(const Scene& given, const std::vector<SurfacePoint>& points,
  const IrradianceOptions& options, Monitor* monitor, IrradianceCache* cache)
{
  IrradianceResult result;
  Report(monitor, 0.0, "planning");
  if (options.LightVisibility)
  {
    CheckLightVisibility(given);
  }
  EffectAbilities abilities;
  abilities.Emission = true;
  abilities.Environment = true;
  abilities.Transmission = true;
  abilities.RelativeTolerance = options.RelativeTolerance;
  abilities.AbsoluteTolerance = options.AbsoluteTolerance;
  abilities.Drops = !options.LightVisibility; // of each light by itself
  SceneEffects effects(given, options.Switches, abilities, points, options.Cells);
  EffectPlan& plan = effects.Plan();
  const Scene& scene = effects.Simulated();
  IrradianceCache none;
  IrradianceCache& store = cache ? *cache : none;
  const OcclusionScene& occluders = store.Occluders(scene);
  DirectOptions direct = DirectOf(options, plan);
  std::array<double, 3> kinds{}; // seconds
  direct.KindSeconds = &kinds;
  const int sides = plan.Simulates(Effect::BackFaces) ? 2 : 1;
  ContentKey key;
  if (cache)
  {
    key = KeyOfDirectLight(store.GeometryKey(), scene, points, direct);
    key.Add(static_cast<std::uint64_t>(sides + (options.Cells ? 2 : 0) +
      (options.RefineShadowBoundaries ? 4 : 0) + (options.LightVisibility ? 8 : 0)));
    key.Add(static_cast<std::uint64_t>(options.PiecesPerCell));
  }
  KeptValues kept(cache, key, options);
  // What was done is kept where the user stops the run; not of several ranks, of which each may have
  // stopped elsewhere.
  const auto stopped = [&] {
    if (!options.Ranks)
    {
      kept.Keep();
    }
  };
  // Bounds on what is left out come after all values.
  const double bounding = plan.LeavesOut()
    ? BoundSeconds * static_cast<double>(scene.ReceiverTriangles + points.size())
    : 0.0;
  IrradianceOptions limited = options;
  limited.TimeBudget =
    options.TimeBudget > 0.0 ? std::max(1e-9, options.TimeBudget - bounding) : 0.0;
  std::int64_t rays = 0;
  bool timedOut = false;
  try
  {
    IrradianceCourse course(
      scene, occluders, points, limited, direct, sides, *kept, result, monitor);
    result.Cost.PredictedSeconds = course.Pilot() + bounding;
    if (options.TimeBudget > 0.0)
    {
      result.Cost.PredictedSeconds = std::min(result.Cost.PredictedSeconds, options.TimeBudget);
    }
    result.Cost.PredictedAt = result.Convergence.Elapsed();
    if (monitor)
    {
      monitor->Predicted(result.Cost.PredictedSeconds);
    }
    if (!options.PilotOnly)
    {
      course.Finish();
    }
    rays = course.Rays;
    timedOut = course.TimedOut;
  }
  catch (const Aborted&)
  {
    stopped();
    throw;
  }
  if (options.PilotOnly)
  {
    kept.Keep();
    result.Cost.Seconds = result.Convergence.Elapsed();
    result.Outcome = "the pilot ended";
    return result;
  }

  EffectDecision& occlusion = plan[Effect::Occlusion];
  effects.Spent(kinds,
    result.Convergence.Elapsed() - std::accumulate(kinds.begin(), kinds.end(), 0.0));
  if (occlusion.Simulated)
  {
    const std::size_t values = (options.Cells ? scene.Cells : 0) + points.size();
    occlusion.Why += "; " + std::to_string(rays) + " rays for " + std::to_string(values) +
      " cells and points";
  }
  for (int side = 0; side < 2; ++side)
  {
    for (FieldValues* values : { &result.Cells[side], &result.Points[side] })
    {
      values->Values = effects.AllBands(std::move(values->Values));
      values->Errors = effects.AllBands(std::move(values->Errors));
    }
  }
  AddDropped(plan.DroppedBound(), { &result.Cells, &result.Points });
  effects.Bound(GreatestValue({ &result.Cells, &result.Points }));
  result.Effects = plan.Decisions();
  kept.Keep();
  result.Cost.Seconds = result.Convergence.Elapsed();
  result.Cost.Samples = rays;
  result.Cost.Bytes = cache ? cache->MemoryBytes() : 0;
  result.Outcome = OutcomeOf(timedOut, result);
  Report(monitor, 1.0, "done");
  return result;
}

} // namespace radiometry
