// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// Where an element lies in another division of the same surface.
struct ElementOrigin
{
  std::int32_t Element = -1; // that covers it, or the first of those within it
  bool Same = false;         // it is that one
};

/// For each element of a set its origin in an earlier one, of the same scene and the same sides.
std::vector<ElementOrigin> FindOrigins(const ElementSet& elements, const ElementSet& earlier);

} // namespace radiometry
