// SPDX-License-Identifier: BSD-3-Clause

/// Question: is what Auto leaves out within the bound that the plan states, how close are the bounds,
/// and how much time does the plan save?
///
/// Random scenes (tests/core/EffectRandomScene.h), each simulated with every effect Auto and with
/// every effect On; then each effect that it has Off, all others On. Values are compared one by one.
///   A value holds where |Auto - On| <= bound of what Auto dropped + the errors of the estimates
///   A bound's tightness is bound/greatest sure change (difference less both errors) of any value
/// Seconds are the processor's, on one thread. Prints JSON.
///
///   effect_saving [direct scenes=1000] [radiosity scenes=200] [first seed=1]

#include "benchmarks/Provenance.h"
#include "tests/core/EffectRandomRuns.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <string>
#include <vector>

using namespace radiometry;
using nlohmann::json;

namespace
{

double Quantile(std::vector<double> values, double share)
{
  if (values.empty())
  {
    return 0.0;
  }
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// What is found of one effect over all scenes.
struct EffectTally
{
  int Scenes = 0;    // that have the effect
  int Dropped = 0;   // in which Auto left it out
  int Unbounded = 0; // whose bound is infinite
  std::size_t Values = 0;
  std::size_t Exceeding = 0;
  std::vector<double> Tightness;
};

struct Tally
{
  test::EffectDifference Auto;
  std::vector<double> Ratio; // seconds of On / seconds of Auto
  double SecondsAuto = 0.0;
  double SecondsOn = 0.0;
  int WithDrops = 0;
  std::map<Effect, EffectTally> Effects;
  json Failures = json::array();
};

void Add(test::EffectDifference& sum, const test::EffectDifference& one)
{
  sum.Values += one.Values;
  sum.Equal += one.Equal;
  sum.Bounded += one.Bounded;
  sum.Estimated += one.Estimated;
  sum.Exceeding += one.Exceeding;
}

void Run(std::uint64_t seed, test::Simulation what, Tally& tally)
{
  const test::RandomScene scene = test::MakeRandomScene(seed,
    what == test::Simulation::Direct ? test::RandomSize::Direct : test::RandomSize::Radiosity);
  const auto on = test::All(EffectSwitch::On);
  const test::EffectRun full = Simulate(scene, what, on);
  const test::EffectRun plan = Simulate(scene, what, test::All(EffectSwitch::Auto));
  const test::EffectDifference found = Compare(plan, full, plan.Dropped);
  Add(tally.Auto, found);
  if (found.Exceeding > 0)
  {
    tally.Failures.push_back({ { "scene", scene.What }, { "values", found.Exceeding },
      { "of", found.Values }, { "worst", found.Where }, { "excess", found.Excess } });
  }
  tally.WithDrops += plan.Dropped > 0.0;
  tally.SecondsAuto += plan.ProcessorSeconds;
  tally.SecondsOn += full.ProcessorSeconds;
  tally.Ratio.push_back(full.ProcessorSeconds / std::max(plan.ProcessorSeconds, 1e-6));

  for (const Effect effect : PresentEffects(full))
  {
    const auto k = static_cast<std::size_t>(effect);
    EffectTally& mine = tally.Effects[effect];
    ++mine.Scenes;
    mine.Dropped += plan.Effects[k].Dropped;
    const test::EffectRun less = Simulate(scene, what, test::With(on, effect, EffectSwitch::Off));
    const double bound = less.Effects[k].Bound;
    if (less.Effects[k].Simulated)
    {
      continue; // it cannot be switched off
    }
    if (!std::isfinite(bound))
    {
      ++mine.Unbounded;
      continue;
    }
    const test::EffectDifference change = Compare(less, full, bound, { false, true, effect == Effect::BackFaces });
    mine.Values += change.Values;
    mine.Exceeding += change.Exceeding;
    if (change.GreatestSure > 0.0)
    {
      mine.Tightness.push_back(bound / change.GreatestSure);
    }
    if (change.Exceeding > 0)
    {
      tally.Failures.push_back(
        { { "scene", scene.What }, { "off", EffectName(effect) }, { "values", change.Exceeding },
          { "of", change.Values }, { "worst", change.Where }, { "excess", change.Excess } });
    }
  }
}

json Summary(const Tally& tally, int scenes)
{
  json out;
  out["scenes"] = scenes;
  out["scenes_with_drops"] = tally.WithDrops;
  out["values"] = tally.Auto.Values;
  out["values_equal"] = tally.Auto.Equal;
  out["values_within_the_bound_alone"] = tally.Auto.Bounded;
  out["values_within_bound_and_errors"] = tally.Auto.Estimated;
  out["values_beyond"] = tally.Auto.Exceeding;
  out["seconds_auto"] = tally.SecondsAuto;
  out["seconds_on"] = tally.SecondsOn;
  const double quantiles[] = { 0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0 };
  for (const double q : quantiles)
  {
    out["on_over_auto_quantiles"].push_back({ q, Quantile(tally.Ratio, q) });
  }
  const double edges[] = { 0.0, 0.5, 0.8, 0.9, 0.97, 1.03, 1.1, 1.25, 1.5, 2, 3, 5, 10, 30, 1e9 };
  for (std::size_t k = 0; k + 1 < std::size(edges); ++k)
  {
    const auto count = std::count_if(tally.Ratio.begin(), tally.Ratio.end(),
      [&](double r) { return r >= edges[k] && r < edges[k + 1]; });
    out["on_over_auto_histogram"].push_back(
      { { "from", edges[k] }, { "to", edges[k + 1] }, { "scenes", count } });
  }
  for (const auto& [effect, e] : tally.Effects)
  {
    out["effects"].push_back({ { "effect", EffectName(effect) }, { "scenes", e.Scenes },
      { "dropped_by_auto", e.Dropped }, { "without_bound", e.Unbounded }, { "values", e.Values },
      { "beyond_bound", e.Exceeding }, { "bound_over_change_median", Quantile(e.Tightness, 0.5) },
      { "bound_over_change_least", Quantile(e.Tightness, 0.0) },
      { "bound_over_change_greatest", Quantile(e.Tightness, 1.0) } });
  }
  out["failures"] = tally.Failures;
  return out;
}

} // namespace

int main(int argc, char** argv)
{
  const int counts[] = { argc > 1 ? std::atoi(argv[1]) : 1000, argc > 2 ? std::atoi(argv[2]) : 200 };
  const std::uint64_t first = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  json out;
  benchmark::AddProvenance(out);
  const std::pair<const char*, test::Simulation> kinds[] = {
    { "direct", test::Simulation::Direct }, { "radiosity", test::Simulation::Radiosity }
  };
  for (int k = 0; k < 2; ++k)
  {
    Tally tally;
    for (int i = 0; i < counts[k]; ++i)
    {
      const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
      try
      {
        Run(seed, kinds[k].second, tally);
      }
      catch (const std::exception& e)
      {
        tally.Failures.push_back({ { "seed", seed }, { "exception", e.what() } });
      }
    }
    out[kinds[k].first] = Summary(tally, counts[k]);
  }
  std::cout << out.dump(1) << '\n';
  return 0;
}
