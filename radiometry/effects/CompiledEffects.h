// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/effects/EffectPlan.h"

#ifndef RADIOMETRY_EFFECTS_LEFT_OUT
#define RADIOMETRY_EFFECTS_LEFT_OUT
#endif

namespace radiometry
{

/// True when this build of the core can simulate the effect; false for those that CMake's list
/// VTKRADIOMETRY_EFFECTS_LEFT_OUT names (empty unless asked for). Such a plan says that it cannot, and
/// gives the effect's bound; values of an effect that is present are then without it.
///
/// A constant, asked first where the core asks whether an effect takes part, so that the compiler takes
/// out what only the effect needs. It is what the test that an absent effect costs nothing compares
/// with (tests/core/effect_instructions.py). Included by .cxx files alone: CMake compiles those once
/// more for each other list.
constexpr bool Compiled(Effect effect)
{
  constexpr Effect leftOut[] = { static_cast<Effect>(-1), RADIOMETRY_EFFECTS_LEFT_OUT };
  for (const Effect other : leftOut)
  {
    if (other == effect)
    {
      return false;
    }
  }
  return true;
}

} // namespace radiometry
