// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Scene.h"

namespace radiometry
{

/// How the triangles of a scene stand to each other.
enum class Convexity
{
  General,
  Hull, // every triangle lies on the hull of all: nothing stands between any two points of them
  Body, // ... with all fronts outward
  Room  // ... with all fronts inward
};

/// General also where finding out would cost more than 1e9 comparisons; ends early where it can.
Convexity FindConvexity(const Scene& scene);

} // namespace radiometry
