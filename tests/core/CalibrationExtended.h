// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/core/Calibration.h"

#include <functional>

/// Lights that reach a point from many directions. Their reference at a point is an integral over
/// the source (or the plane through which it is seen) less the union of the blockers' shadows on it;
/// that of a cell is its average over many points.
namespace test
{

/// What a light gives an upward point at z = 0 that these triangles may hide it from.
using PointReference = std::function<Integral(const radiometry::Vec3& at,
  const std::vector<radiometry::Triangle3>& blockers, double tolerance)>;

struct ExtendedKind
{
  const char* Name;
  bool Blocked; // also with blockers
  /// Puts the light into the scene and returns its reference.
  std::function<PointReference(CalibrationScene& scene, Random& random)> Place;
};

std::vector<ExtendedKind> AreaKinds();
std::vector<ExtendedKind> SkyKinds();
/// Its average over a cell.
Integral OverCell(const PointReference& reference, const radiometry::Triangle3& cell,
  const std::vector<radiometry::Triangle3>& blockers);

void AddExtendedCases(std::vector<CalibrationCase>& cases, const std::vector<ExtendedKind>& kinds);

} // namespace test
