// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/EffectRandomRuns.h"

#include "radiometry/solver/PlannedRadiosity.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <sstream>
#include <utility>

namespace test
{

using namespace radiometry;

namespace
{

/// Sums of the same numbers in another order differ by that much of the values.
constexpr double Rounding = 1e-11;

double Now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void Keep(EffectRun& run, const std::string& name, const std::array<FieldValues, 2>& sides,
  bool irradiance = true)
{
  for (int side = 0; side < 2; ++side)
  {
    if (!sides[side].Values.empty())
    {
      run.Fields.push_back({ name + (side == 0 ? "" : ", back"), sides[side].Values,
        sides[side].Errors, irradiance });
    }
  }
}

void SimulateDirect(const RandomScene& scene, const Switches& switches, EffectRun& run)
{
  IrradianceOptions options;
  options.RelativeTolerance = scene.RelativeTolerance;
  options.AbsoluteTolerance = scene.AbsoluteTolerance;
  options.Threads = 1;
  options.Switches = switches;
  const IrradianceResult result = SimulateIrradiance(scene.Scene, scene.Points, options);
  Keep(run, "cells", result.Cells);
  Keep(run, "points", result.Points);
  run.Effects = result.Effects;
}

void SimulateRadiosity(const RandomScene& scene, const Switches& switches, EffectRun& run)
{
  RadiosityOptions options;
  options.RelativeTolerance = scene.RelativeTolerance;
  options.AbsoluteTolerance = scene.AbsoluteTolerance;
  options.Threads = 1;
  const PlannedRadiosity result =
    SimulatePlannedRadiosity(scene.Scene, scene.Points, true, switches, options);
  Keep(run, "cells", result.Cells.Irradiance);
  Keep(run, "radiosity of cells", result.Cells.Radiosity, false);
  Keep(run, "points", result.PointIrradiance);
  Keep(run, "radiosity of points", result.PointRadiosity, false);
  run.Effects = result.Effects;
}

} // namespace

const EffectRun::Field* EffectRun::Find(const std::string& name) const
{
  const auto at = std::find_if(
    this->Fields.begin(), this->Fields.end(), [&](const Field& f) { return f.Name == name; });
  return at == this->Fields.end() ? nullptr : &*at;
}

Switches All(EffectSwitch value)
{
  return Switches(EffectCount, value);
}

Switches With(Switches switches, Effect effect, EffectSwitch value)
{
  switches[static_cast<std::size_t>(effect)] = value;
  return switches;
}

EffectRun Simulate(const RandomScene& scene, Simulation what, const Switches& switches)
{
  EffectRun run;
  const double begin = Now();
  const std::clock_t processor = std::clock();
  what == Simulation::Direct ? SimulateDirect(scene, switches, run)
                             : SimulateRadiosity(scene, switches, run);
  run.ProcessorSeconds = static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC;
  run.Seconds = Now() - begin;
  for (const EffectDecision& d : run.Effects)
  {
    run.Dropped += d.Dropped ? d.Bound : 0.0;
  }
  return run;
}

namespace
{

/// Adds the values of one field, `b` null where all of the other's are 0.
void Compare(const EffectRun& one, const EffectRun& other, double bound, const EffectRun::Field& a,
  const EffectRun::Field* b, EffectDifference& out)
{
  const auto value = [](const EffectRun::Field* f, std::size_t k) { return f ? f->Values[k] : 0.0; };
  const auto error = [](const EffectRun::Field* f, std::size_t k) { return f ? f->Errors[k] : 0.0; };
  double greatest = 0.0;
  for (std::size_t k = 0; k < a.Values.size(); ++k)
  {
    greatest = std::max({ greatest, std::fabs(a.Values[k]), std::fabs(value(b, k)) });
  }
  const double rounding = Rounding * greatest;
  for (std::size_t k = 0; k < a.Values.size(); ++k)
  {
    const double difference = std::fabs(a.Values[k] - value(b, k));
    const double errors =
      std::max(0.0, a.Errors[k] - one.Dropped) + std::max(0.0, error(b, k) - other.Dropped);
    const double allowed = bound + errors + rounding;
    ++out.Values;
    out.Equal += a.Values[k] == value(b, k);
    out.Bounded += difference <= bound + rounding;
    out.Estimated += difference > bound + rounding && difference <= allowed;
    out.Greatest = std::max(out.Greatest, difference);
    out.GreatestSure = std::max(out.GreatestSure, difference - errors - rounding);
    if (difference <= allowed)
    {
      continue;
    }
    ++out.Exceeding; // NaN, too
    const double excess =
      std::isfinite(difference) ? difference / allowed : std::numeric_limits<double>::infinity();
    if (excess > out.Excess)
    {
      std::ostringstream text;
      text.precision(12);
      text << a.Name << ' ' << k << ": " << a.Values[k] << " +- " << a.Errors[k] << " beside "
           << value(b, k) << " +- " << error(b, k) << ", bound " << bound;
      out.Where = text.str();
      out.Excess = excess;
    }
  }
}

} // namespace

EffectDifference Compare(
  const EffectRun& one, const EffectRun& other, double bound, const Compared& what)
{
  EffectDifference out;
  const auto wanted = [&](const EffectRun::Field& f) {
    return (what.Radiosity || f.IsIrradiance) &&
      (what.Points || f.Name.find("points") == std::string::npos);
  };
  for (const EffectRun::Field& a : one.Fields)
  {
    const EffectRun::Field* b = other.Find(a.Name);
    if (wanted(a) && b)
    {
      Compare(one, other, bound, a, b, out);
    }
  }
  for (const EffectRun::Field& b : other.Fields)
  {
    if (what.Backs && b.Name == "cells, back" && !one.Find(b.Name))
    {
      Compare(other, one, bound, b, nullptr, out);
    }
  }
  return out;
}

std::vector<Effect> PresentEffects(const EffectRun& run)
{
  std::vector<Effect> present;
  for (int k = 0; k < EffectCount; ++k)
  {
    const EffectDecision& row = run.Effects[static_cast<std::size_t>(k)];
    if (row.Known && row.Present && row.Able)
    {
      present.push_back(static_cast<Effect>(k));
    }
  }
  return present;
}

} // namespace test
