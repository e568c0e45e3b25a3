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

std::vector<BeamKind> BeamKinds();
/// What such a light gives one of the floor's cells (its integral) and one of its points.
Integral BeamOverCell(const radiometry::Light& light, const radiometry::Triangle3& cell,
  const std::vector<radiometry::Triangle3>& blockers, double tolerance);
double BeamAt(const radiometry::Light& light, const radiometry::Vec3& point,
  const std::vector<radiometry::Triangle3>& blockers);

std::vector<BeamKind> WebKinds();
/// A luminaire's intensity, relative to its greatest, along `way`.
double WebIntensity(const radiometry::Light& light, const radiometry::Vec3& way);
/// The cones (cosines about the axis) and planes (normals, through the light) at which it bends.
void AddWebBreaks(const radiometry::Light& light, std::vector<double>& cosines,
  std::vector<radiometry::Vec3>& planes);

} // namespace test
