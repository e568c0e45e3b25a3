// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/DirectIrradiance.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace radiometry
{

/// The cells of a surface cut along the edges of shadows.
struct ShadowPieces
{
  std::vector<Vec3> Points;           // corners of the pieces; equal ones are one point
  std::vector<std::int32_t> Corners;  // of all pieces, one after the other; counter-clockwise
  std::vector<std::size_t> First;     // of each piece, and the end
  std::vector<std::int32_t> Cell;     // the caller's cell of each piece, ascending
  std::vector<std::uint8_t> Whole;    // 1: the caller's cell as it was, without corners here
  std::size_t Full = 0;               // cells that reached the limit of pieces
  bool TimedOut = false;              // no time was left for some cells: they stay whole

  std::size_t Size() const { return this->Cell.size(); }
};

/// Cuts each cell of the surface along the edges of the shadows of point, spot and directional
/// lights (of panes, too), so that these edges are geometry.
///   Pieces  convex; pieces on both sides of a cut that all lights light alike are joined again where
///           the union is convex, and a cell without a shadow's edge stays whole. The edges within a
///           cell fit each other; where cells meet, one may have a corner on the other's edge
///   Edges   in the plane through the light and the edge that casts the shadow, to rounding
///   Limit   of `most` pieces a cell (before they are joined): beyond, the largest parts are cut
///           first and the rest stays uncut
///   Time    after half of options.SecondsLeft (above 0) no further cell is cut
///   Cost    O(lines log lines) for each cell and light, one ray for each piece and light
ShadowPieces CutAlongShadows(const Scene& scene, const OcclusionScene& occluders,
  const DirectOptions& options, bool backFaces, std::size_t most, const StageProgress& stage = {});

/// The patches of the pieces, `Cell` the number of the piece: of side 0, and where cells are
/// two-sided and `backFaces` also of side 1.
std::vector<Patch> MakePatches(const Scene& scene, const ShadowPieces& pieces, bool backFaces);

} // namespace radiometry
