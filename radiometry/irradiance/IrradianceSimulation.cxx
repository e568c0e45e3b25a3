// SPDX-License-Identifier: BSD-3-Clause
#include "radiometry/irradiance/IrradianceSimulation.h"

#include <algorithm>
#include <cmath>

namespace radiometry
{
namespace
{

double GreatestDifference(const std::vector<double>& a, const std::vector<double>& b)
{
  double greatest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    greatest = std::max(greatest, std::fabs(a[i] - b[i]));
  }
  return greatest;
}

double Greatest(const std::vector<double>& a)
{
  return a.empty() ? 0.0 : *std::max_element(a.begin(), a.end());
}

} // namespace

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

FieldValues AverageOverCells(const Scene& scene, const std::vector<Patch>& patches,
  const std::vector<double>& values, const std::vector<double>& errors)
{
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  FieldValues out;
  out.Values.assign(scene.Cells * bands, 0.0);
  out.Errors.assign(scene.Cells * bands, 0.0);
  std::vector<double> areas(scene.Cells, 0.0);
  for (const Patch& p : patches)
  {
    areas[p.Cell] += Area(p.Corners);
  }
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    const auto cell = static_cast<std::size_t>(patches[i].Cell);
    const double share = Area(patches[i].Corners) / areas[cell];
    for (std::size_t b = 0; b < bands; ++b)
    {
      out.Values[cell * bands + b] += share * values[i * bands + b];
      const double error = share * errors[i * bands + b];
      out.Errors[cell * bands + b] = std::hypot(out.Errors[cell * bands + b], error);
    }
  }
  return out;
}

UnshadowedExtremes FindUnshadowedExtremes(
  const Scene& scene, const OcclusionScene& occluders, const EffectPlan& plan, int threads)
{
  UnshadowedExtremes found;
  DirectOptions options;
  options.Occlusion = false;
  options.Threads = threads;
  for (int side = 0; side < 2; ++side)
  {
    const std::vector<Patch> patches = MakePatches(scene, side);
    const DirectResult full = ComputeDirectIrradiance(scene, occluders, patches, options);
    (side == 0 ? found.Peak : found.PeakBack) = Greatest(full.Irradiance);
    const auto without = [&](Effect effect, bool DirectOptions::*flag, double& change) {
      if (plan[effect].Present && !plan.Simulates(effect))
      {
        DirectOptions less = options;
        less.*flag = false;
        change = std::max(change,
          GreatestDifference(full.Irradiance,
            ComputeDirectIrradiance(scene, occluders, patches, less).Irradiance));
      }
    };
    without(Effect::SpotShape, &DirectOptions::SpotShape, found.Spot);
    without(Effect::Attenuation, &DirectOptions::Attenuation, found.Attenuation);
  }
  return found;
}

IrradianceResult SimulateIrradiance(const Scene& scene, const std::vector<SurfacePoint>& points,
  const IrradianceOptions& options, Monitor* monitor)
{
  IrradianceResult result;
  Report(monitor, 0.0, "planning");
  const bool freePoints = std::any_of(
    points.begin(), points.end(), [](const SurfacePoint& p) { return p.Triangle < 0; });
  EffectPlan plan(scene, options.Switches, EffectAbilities{}, freePoints);
  const OcclusionScene occluders(scene);

  DirectOptions direct;
  direct.RelativeTolerance = options.RelativeTolerance;
  direct.AbsoluteTolerance = options.AbsoluteTolerance;
  direct.Occlusion = plan.Simulates(Effect::Occlusion);
  direct.SpotShape = plan.Simulates(Effect::SpotShape);
  direct.Attenuation = plan.Simulates(Effect::Attenuation);
  direct.Threads = options.Threads;

  const int sides = plan.Simulates(Effect::BackFaces) ? 2 : 1;
  bool timedOut = false;
  for (int side = 0; side < sides; ++side)
  {
    const double begin = 0.02 + 0.96 * side / sides;
    const double middle = begin + (options.Cells ? 0.9 : 0.0) * 0.96 / sides;
    const double end = 0.02 + 0.96 * (side + 1) / sides;
    if (options.TimeBudget > 0.0)
    {
      direct.SecondsLeft = std::max(1e-3, options.TimeBudget - result.Convergence.Elapsed());
    }
    if (options.Cells)
    {
      const std::vector<Patch> patches = MakePatches(scene, side);
      const DirectResult r = ComputeDirectIrradiance(scene, occluders, patches, direct,
        { monitor, begin, middle, "direct light" }, &result.Convergence);
      result.Cells[side] = AverageOverCells(scene, patches, r.Irradiance, r.Error);
      timedOut = timedOut || r.TimedOut;
    }
    if (!points.empty())
    {
      std::vector<SurfacePoint> facing = points;
      if (side == 1)
      {
        for (SurfacePoint& p : facing)
        {
          p.Normal = -p.Normal;
        }
      }
      DirectResult r = ComputeDirectIrradiance(scene, occluders, facing, direct,
        { monitor, middle, end, "direct light at points" }, &result.Convergence);
      result.Points[side] = { std::move(r.Irradiance), std::move(r.Error) };
    }
  }
  plan[Effect::Occlusion].Seconds = result.Convergence.Elapsed();

  const UnshadowedExtremes extremes =
    FindUnshadowedExtremes(scene, occluders, plan, options.Threads);
  plan.Bound(scene, extremes.Peak, extremes.PeakBack, extremes.Spot, extremes.Attenuation);
  for (int k = 0; k < EffectCount; ++k)
  {
    result.Effects.push_back(plan[static_cast<Effect>(k)]);
  }
  result.Outcome = timedOut ? "the time budget ended the run before every value met its tolerance"
                            : "every value met its tolerance or is as fine as can be";
  Report(monitor, 1.0, "done");
  return result;
}

} // namespace radiometry
