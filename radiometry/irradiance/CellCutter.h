// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/DirectIrradiance.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace radiometry
{

/// What became of one cell; without pieces it stays whole.
struct CellPieces
{
  std::vector<Vec3> Points;
  std::vector<std::vector<std::int32_t>> Loops;
  bool Full = false;
};

/// Cuts cells along the edges of the shadows that point, spot and directional lights cast on them.
///   Method  each triangle is divided along the planes through a light and the silhouette segments in
///           its shaft, the weightiest segment first, each half keeping those whose shadows may fall
///           on it; one ray a light tells the state of what no segment is left for; pieces of one
///           state are joined (PieceMerging)
///   Cost    O(lines log lines) and a ray a piece, for each light
/// Thread-safe after construction.
class CellCutter
{
public:
  /// `most`: pieces of one cell.
  CellCutter(const Scene& scene, const OcclusionScene& occluders, const DirectOptions& options,
    bool backFaces, std::size_t most, const StageProgress& stage);
  ~CellCutter();

  /// `triangles`: of the scene, all of one cell.
  CellPieces Cut(const std::vector<std::int32_t>& triangles) const;

private:
  class Internals;
  std::unique_ptr<Internals> Impl;
};

} // namespace radiometry
