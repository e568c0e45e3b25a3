// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Scene.h"

namespace radiometry
{

/// Brings lights that lie on a surface out of it, where rounding of the surface's coordinates put
/// them behind: a panel at 2.8 m in a ceiling whose points are in single precision, 2.79999995 m.
///   Model   a one-sided area light, a spot or a luminaire with a triangle square to it in front, no
///           farther than twice `rounding` [m], is moved into that triangle's plane. What shines both
///           ways or all around stays: its surface could be on either side
///   Cost    O(triangles x log(such lights)), nothing where there is none or `rounding` is 0
void BringLightsForward(Scene& scene, double rounding);

} // namespace radiometry
