// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/core/Calibration.h"

#include <functional>

namespace test
{

struct BeamKind
{
  const char* Name;
  std::function<radiometry::Light(Random&)> Make; // above the floor, in absolute coordinates
};

std::vector<BeamKind> WebKinds();
/// A luminaire's intensity, relative to its greatest, along `way`.
double WebIntensity(const radiometry::Light& light, const radiometry::Vec3& way);
/// The cones (cosines about the axis) and planes (normals, through the light) at which it bends.
void AddWebBreaks(const radiometry::Light& light, std::vector<double>& cosines,
  std::vector<radiometry::Vec3>& planes);

} // namespace test
