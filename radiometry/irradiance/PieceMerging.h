// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// A convex polygon of a plane, and what tells it from others.
struct PlanePiece
{
  std::vector<Vec3> Corners; // counter-clockwise about the plane's normal
  std::int64_t State = 0;    // pieces of one state may be joined
};

/// Convex polygons that fill a part of a plane.
struct PieceSet
{
  std::vector<Vec3> Points;
  std::vector<std::vector<std::int32_t>> Loops; // corners of each piece, counter-clockwise
  std::vector<std::int64_t> States;
};

/// Joins neighbours of one state as long as their union stays convex, and makes the corners of all
/// pieces fit: a corner of one that lies on another's edge becomes a corner of both. Corners at which
/// no piece turns are left out, `kept` ones excepted.
///   Source  Hertel and Mehlhorn 1983: at most four times as many convex pieces as must be
///   Cost    O(n^2) in the corners, with small constants
PieceSet JoinPieces(const std::vector<PlanePiece>& pieces, const Vec3& normal, double tolerance,
  const std::vector<Vec3>& kept);

} // namespace radiometry
