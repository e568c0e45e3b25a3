// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "StatisticsBlocks.h"

#include <string>
#include <vector>

class vtkPolyData;
class vtkTable;

/// Iso-lines of an array over blocks.
///   Model   point values (and sensors of a rectangle) are linear between points, so lines of a
///           linear field are exact and end at the outermost points; cell values are first averaged
///           to the corners among the cells of one smooth sheet (30 degrees), so lines are good to
///           about half a cell
class IsoLines
{
public:
  /// `levels` empty: 1-2-5 steps between the array's extremes (radiometry/geometry/IsoLines.h).
  IsoLines(std::string array, std::vector<double> levels, double metersPerUnit)
    : Array(std::move(array))
    , Levels(std::move(levels))
    , MetersPerUnit(metersPerUnit)
  {
  }
  /// Lines: polylines with cell data Isovalue, Label, Length [m] and point data of the array's
  /// name. Table: Isovalue, Label, Length, AreaAbove [m^2], ShareAbove of each level.
  ///   Fails   radiometry::InputError: values or coordinates that are not finite
  void Write(const std::vector<StatisticsBlock>& blocks,
    const std::vector<std::vector<SurfacePiece>>& pieces, vtkPolyData* lines, vtkTable* table);

private:
  std::string Array;
  std::vector<double> Levels;
  double MetersPerUnit;
};
