// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RadiometricJob.h"
#include "SceneAdapter.h"

#include <vector>

/// The own blocks of a surface whose cells were cut; Numbers of each: the piece whose results each of
/// its cells has (-1: none).
///   Points  those of the block, and the new ones behind them, in double; point data is not carried
///           over (new points have none)
///   Cells   vertices and lines as they were; polygons: whole ones as they were, pieces in the place
///           of cut ones; pieces of strips; strips that are whole
///   Cell data  copied to each piece, with OriginalCellIds, the number of its cell in the block
std::vector<SceneAdapter::Block> RefineSurface(const SceneAdapter& adapter,
  const radiometry::Scene& scene, double metersPerUnit, const radiometry::ShadowPieces& pieces);
