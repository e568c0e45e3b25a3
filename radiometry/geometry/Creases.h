// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// A surface whose points are split where faces meet in a crease, so that each has one normal.
struct SplitSurface
{
  std::vector<std::int64_t> Source;  // of each point, the point it was; those before come first
  std::vector<std::int64_t> Corners; // of each corner of the cells, its point
  std::vector<Vec3> Normals;         // of each point: the mean of its cells' unit normals; or zero
};

/// Splits points along edges where more or fewer than two cells meet, or two whose normals make an
/// angle of at least that of `cosine`. Cells without area split nothing and keep their points.
///   Reads   the cells' corners (numbers of points) one after the other; cell c has those from
///           offsets[c] to offsets[c + 1]
///   Cost    O(corners)
SplitSurface SplitAtCreases(const std::vector<Vec3>& points,
  const std::vector<std::int64_t>& offsets, const std::vector<std::int64_t>& corners,
  double cosine);

} // namespace radiometry
