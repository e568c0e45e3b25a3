// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// Of each receiving triangle's front and back, 1 where no receiving surface reaches above its plane:
/// no light comes to it from another. What only occludes does not count.
///   Cost    O(triangles) where all see something or lie in few planes; at most some 0.1 s: past that 0
std::vector<std::array<std::uint8_t, 2>> FindBlindSides(const Scene& scene);

/// True where no front, and with `backs` no side, sees a surface that receives.
bool AllBlind(const Scene& scene, const std::vector<std::array<std::uint8_t, 2>>& blind, bool backs);

} // namespace radiometry
