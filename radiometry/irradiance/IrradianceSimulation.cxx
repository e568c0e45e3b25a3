// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/IrradianceSimulation.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

IrradianceResult SimulateIrradiance(const Scene& given, const std::vector<SurfacePoint>& points,
  const IrradianceOptions& options, Monitor* monitor)
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
  const OcclusionScene occluders(scene);

  DirectOptions direct;
  direct.RelativeTolerance = options.RelativeTolerance;
  direct.AbsoluteTolerance = options.AbsoluteTolerance;
  direct.Occlusion = plan.Simulates(Effect::Occlusion);
  direct.SpotShape = plan.Simulates(Effect::SpotShape);
  direct.Attenuation = plan.Simulates(Effect::Attenuation);
  direct.Environment = plan.Simulates(Effect::Environment);
  direct.Transmission = plan.Simulates(Effect::Transmission);
  direct.Emission = plan.Simulates(Effect::Emission);
  direct.Threads = options.Threads;
  direct.Ranks = options.Ranks;

  const int sides = plan.Simulates(Effect::BackFaces) ? 2 : 1;
  bool timedOut = false;
  std::int64_t rays = 0;
  const auto limit = [&] {
    if (options.TimeBudget > 0.0)
    {
      direct.SecondsLeft = std::max(1e-9, options.TimeBudget - result.Convergence.Elapsed());
    }
  };
  const double end = options.LightVisibility ? 0.5 : 0.98;
  const double middle = options.Cells ? (points.empty() ? end : 0.8 * end) : 0.02;
  if (options.Cells)
  {
    std::vector<Patch> patches;
    std::size_t items = scene.Cells;
    double begin = 0.02;
    if (options.RefineShadowBoundaries)
    {
      begin = 0.3 * middle;
      limit();
      result.Pieces = CutAlongShadows(scene, occluders, direct, sides == 2, options.PiecesPerCell,
        { monitor, 0.02, begin, "cutting along shadows" });
      patches = MakePatches(scene, result.Pieces, sides == 2);
      items = result.Pieces.Size();
    }
    else
    {
      patches = MakePatches(scene, 0);
      const std::vector<Patch> backs = sides == 2 ? MakePatches(scene, 1) : std::vector<Patch>();
      patches.insert(patches.end(), backs.begin(), backs.end());
    }
    limit();
    const DirectResult r = ComputeDirectIrradiance(scene, occluders, patches, direct,
      { monitor, begin, middle, "direct light" }, &result.Convergence);
    // Without time for shadows all errors are of one kind and add up.
    const std::vector<float> common = r.TimedOut
      ? std::vector<float>(patches.size(), std::numeric_limits<float>::max())
      : r.Dropped;
    for (int side = 0; side < sides; ++side)
    {
      result.Cells[side] =
        AverageOver(items, scene.Optics.Bands, patches, side, r.Irradiance, r.Error, common);
    }
    timedOut = r.TimedOut;
    rays = r.Rays;
    result.DroppedPeak = r.DroppedPeak;
    result.DroppedMean = r.DroppedMean;
    if (options.LightVisibility)
    {
      limit();
      result.CellVisibility = FindLightVisibility(scene, occluders, patches, items, direct,
        { monitor, end, points.empty() ? 0.98 : 0.8, "visibility of lights" });
    }
  }
  for (int side = 0; side < sides && !points.empty(); ++side)
  {
    std::vector<SurfacePoint> facing = points;
    for (SurfacePoint& p : facing)
    {
      p.Normal = side == 1 ? -p.Normal : p.Normal;
    }
    limit();
    DirectResult r = ComputeDirectIrradiance(scene, occluders, facing, direct,
      { monitor, middle + (end - middle) * side / sides,
        middle + (end - middle) * (side + 1) / sides, "direct light at points" },
      side == 0 ? &result.Convergence : nullptr);
    timedOut = timedOut || r.TimedOut;
    rays += r.Rays;
    result.DroppedPeak = std::max(result.DroppedPeak, r.DroppedPeak);
    result.DroppedMean = std::max(result.DroppedMean, r.DroppedMean);
    result.Points[side] = { std::move(r.Irradiance), std::move(r.Error) };
    if (options.LightVisibility)
    {
      limit();
      result.PointVisibility[side] = FindLightVisibility(
        scene, occluders, facing, direct, { monitor, 0.8, 0.98, "visibility of lights" });
    }
  }
  EffectDecision& occlusion = plan[Effect::Occlusion];
  occlusion.Seconds = result.Convergence.Elapsed();
  if (occlusion.Simulated)
  {
    const std::size_t values = (options.Cells ? scene.Cells : 0) + points.size();
    occlusion.Why +=
      "; " + std::to_string(rays) + " rays for " + std::to_string(values) + " cells and points";
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
  result.Cost.Seconds = result.Convergence.Elapsed();
  result.Cost.Samples = rays;
  result.Outcome = timedOut ? "the time budget ended the run before every value met its tolerance"
                            : "every value met its tolerance or is as fine as can be";
  if (result.Pieces.TimedOut)
  {
    result.Outcome += "; no time was left to cut all cells along the edges of shadows";
  }
  if (result.Pieces.Full > 0)
  {
    result.Outcome += "; " + std::to_string(result.Pieces.Full) +
      " cells have more shadow edges than the limit of pieces let them be cut along";
  }
  Report(monitor, 1.0, "done");
  return result;
}

} // namespace radiometry
