// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Light.h"
#include "tests/core/EffectRandomDice.h"

#include <string>

namespace test
{

/// Where the box [-1, 1]^3 of a random scene lies in the scene's own coordinates.
struct Placement
{
  radiometry::Vec3 Center;
  double Scale = 1.0;

  radiometry::Vec3 Point(const radiometry::Vec3& p) const { return this->Center + this->Scale * p; }
};

/// A light of any kind, strength and place; `what` gets its words.
radiometry::Light RandomLight(
  Dice& dice, const Bands& bands, const Placement& here, std::string& what);

} // namespace test
