// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <array>
#include <vector>

namespace radiometry
{

/// A piece of the line on which a value is the same.
struct IsoSegment
{
  Vec3 A;
  Vec3 B;
};

/// Adds the piece on which a linear function with these values at the corners has the value
/// `level`, if there is one. Triangles that share an edge and its values get the same end there, bit
/// for bit.
void AddIsoSegment(const Triangle3& triangle, const std::array<double, 3>& values, double level,
  std::vector<IsoSegment>& segments);

/// The same for a quadrilateral: four triangles about its middle, where the value is the mean, so
/// that no diagonal is preferred.
void AddIsoSegments(const std::array<Vec3, 4>& quad, const std::array<double, 4>& values,
  double level, std::vector<IsoSegment>& segments);

/// Levels at 1, 2 and 5 times powers of ten strictly between two values: all of them where the
/// values span more than a factor of 15 (in the three largest decades), else equal steps of 1,
/// 2 or 5 times a power of ten, about eight. Empty where the values do not differ.
std::vector<double> NiceLevels(double minimum, double maximum);

} // namespace radiometry
