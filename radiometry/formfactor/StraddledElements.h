// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/scene/Scene.h"

namespace radiometry
{

/// True when a triangle of the scene cuts through the inside of an element, or stands on it with an
/// edge: then what arrives on the two sides of that line differs by a jump, however small the element.
/// Lines that run along elements' own edges do not count.
///   Cost  O(n log n)
bool AnyStraddled(const Scene& scene, const ElementSet& elements, int threads = 0);

} // namespace radiometry
