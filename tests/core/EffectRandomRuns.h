// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/effects/EffectPlan.h"
#include "tests/core/EffectRandomScene.h"

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

/// Random scenes simulated with one plan and with another, and what the plan's bounds say of that.
namespace test
{

enum class Simulation
{
  Direct,
  Radiosity
};

/// One run, its values by what they are.
struct EffectRun
{
  struct Field
  {
    std::string Name; // "cells", "cells, back", "points", ...
    std::vector<double> Values;
    std::vector<double> Errors;
    bool IsIrradiance = true;
  };
  std::vector<Field> Fields;
  std::vector<radiometry::EffectDecision> Effects;
  double Seconds = 0.0;          // of the simulation
  double ProcessorSeconds = 0.0; // of all threads
  double Dropped = 0.0;          // bound of all that Auto left out, W/m^2

  const Field* Find(const std::string& name) const;
};
using Switches = std::vector<radiometry::EffectSwitch>;

Switches All(radiometry::EffectSwitch value);
Switches With(Switches switches, radiometry::Effect effect, radiometry::EffectSwitch value);

/// On one thread: a run's bytes do not depend on that.
EffectRun Simulate(const RandomScene& scene, Simulation what, const Switches& switches);

/// Values of two runs beside each other, one by one.
struct EffectDifference
{
  std::size_t Values = 0;
  std::size_t Equal = 0;      // to the last bit
  std::size_t Bounded = 0;    // by the plan's bound alone (and rounding)
  std::size_t Estimated = 0;  // by that and the errors of those that are estimates
  std::size_t Exceeding = 0;  // not even by those
  double Greatest = 0.0;      // difference, W/m^2
  double GreatestSure = 0.0;  // the same less both errors: a change that is sure
  double Excess = 0.0;        // greatest difference / what is allowed, of those that exceed
  std::string Where;          // of that excess
};

/// Which values of two runs are compared.
struct Compared
{
  bool Radiosity = true;  // what leaves, too
  bool Points = true;
  bool Backs = false;     // backs of cells that one run has not are 0 in it
};

/// Compares two runs of one scene. `bound`: what the plan says may lie between them. Errors count
/// where a value is an estimate; that of a run in which Auto left something out holds its bound, which
/// is not counted twice.
EffectDifference Compare(
  const EffectRun& one, const EffectRun& other, double bound, const Compared& what = {});

/// The effects that a run's scene has and that can be switched off, in order.
std::vector<radiometry::Effect> PresentEffects(const EffectRun& run);

} // namespace test
