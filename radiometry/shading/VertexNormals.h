// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Vec3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// Unit normal of a polygon, by the right-hand rule: its corners turn counter-clockwise around it.
///   Model   the sum of (p_i - p_0) x (p_(i+1) - p_0): twice the vector area (Newell's method), so
///           that concave, not quite flat and partly degenerate polygons have one
///   Returns zero for a polygon without area or with a corner that is not finite
Vec3 CellNormal(const Vec3* corners, std::size_t count);

/// What a cell counts at one of its corners.
enum class NormalWeight
{
  Angle = 0,  // the corner's angle: the same however the cells are cut into smaller ones
  Area = 1,   // the cell's area: needs no arc tangent, and is biased toward large cells
  Uniform = 2 // one: cheapest, and biased toward where the cells are cut up most
};

/// Vertex normals of a mesh of polygons: the weighted mean of the unit normals of the cells at each
/// point, unit length.
///   Reads   the cells' corners (numbers of points) one after the other; cell c has those from
///           offsets[c] to offsets[c + 1]
///   Model   n = sum w_c n_c / |sum w_c n_c|; the angle of a reflex corner is above pi, a corner that
///           stands twice counts once
///   Writes  {0,0,0} for points with no cell, only with degenerate or non-finite ones, or whose mean
///           cancels out. Never a NaN, at any scale of the coordinates
///   Cost    O(corners)
///   Source  Thuermer and Wuethrich 1998 (by angle)
std::vector<Vec3> ComputeVertexNormals(const std::vector<Vec3>& points,
  const std::vector<std::int64_t>& offsets, const std::vector<std::int64_t>& corners,
  NormalWeight weight = NormalWeight::Angle);

/// The same for triangles.
std::vector<Vec3> ComputeVertexNormals(const std::vector<Vec3>& points,
  const std::vector<std::array<std::int32_t, 3>>& triangles,
  NormalWeight weight = NormalWeight::Angle);

/// Points that are repeated wherever their corners belong to different sheets.
struct SeparatedPoints
{
  std::vector<std::int64_t> Source;  // of each point, the point it was; those before come first
  std::vector<std::int64_t> Corners; // of each corner of the cells, its point
  std::vector<std::int64_t> Sheet;   // of each point its sheet; -1: it is no corner
};

/// Gives each point one sheet: sheetOfCorner[k] is a number for the smooth piece of surface that
/// corner k belongs to at its point (SplitSurface::Corners of geometry/Creases.h, for example).
///   Cost    O(corners)
SeparatedPoints SeparateSheets(std::size_t points, const std::vector<std::int64_t>& corners,
  const std::vector<std::int64_t>& sheetOfCorner);

/// The linear part of a transform, row by row.
using Matrix3 = std::array<std::array<double, 3>, 3>;

/// A normal carried along by a linear transform of its surface: the inverse transpose applied and
/// the length made one. Done by cofactors, so singular transforms (a squashed surface) work where
/// the normal still has a meaning; a mirror keeps the normal on the side of the surface it was on.
/// Any finite matrix and normal, however large or small. Zero where no normal is left, or for input
/// that is not finite.
Vec3 TransformNormal(const Matrix3& transform, const Vec3& normal);

} // namespace radiometry
