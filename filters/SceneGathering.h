// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "SceneAdapter.h"
#include "radiometry/scene/LightRecord.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/// The point ids of gathered parts, where they have them.
constexpr char GatheredPointIds[] = "vtkRadiometryPointIds";
constexpr char GatheredCellIds[] = "vtkRadiometryCellIds";

/// How the parts that several processes hold of a scene become one (SceneAdapter::Gather).
///
///   Parts   the leaves of all processes, those of the same place in the input one after the other by
///           rank. Parts with the same bytes (data that every process has whole) count once
///   Order   of the cells of a leaf: that of their global ids, where all of them have ids that tell
///           them apart (the attribute GlobalIds, else the array GlobalCellIds); else by rank. With
///           ids in the order of the undivided data the scene is that of one process, bit for bit
///   Ghosts  cells that vtkGhostType marks as duplicates are of no scene: their results are those
///           of the cell that they copy, found by its id or its corners, in whatever part it is; 0
///           where no process has it. Cells with the id and the corners of another one are such too
///   Solids  of the faces of solids, two with the same corners in different parts are inner ones, of
///           no scene: they get 0
class PartNumbers
{
public:
  /// Numbers the cells of parts, which are sorted by Leaf. Sets Numbers and Gathered of each: of
  /// cells that are none of the scene -1. `all`, by part: the same, but for copies the number of
  /// what they copy. Returns how many there are.
  static std::size_t OfCells(
    std::vector<SceneAdapter::Block>& parts, std::vector<std::vector<std::int32_t>>& all);
  /// The same for the points of sensor grids, each leaf from 0 on.
  static void OfSensors(
    std::vector<SceneAdapter::Block>& parts, std::vector<std::vector<std::int32_t>>& all);
};

/// The lights of parts of light data, each light once: where processes have the same lights, as
/// many of a kind count as the process has that has most of them.
class LightsOnce
{
public:
  /// Those among the lights of a part that no part of the same leaf before it had.
  std::vector<radiometry::LightRecord> New(
    const SceneAdapter::Block& part, std::vector<radiometry::LightRecord> lights);

private:
  std::int64_t Leaf = -1;
  std::vector<radiometry::LightRecord> Known; // of that leaf
};
