// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <string>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkPolyData;

/// The component that stands for all bands together: of three their luminance-weighted sum.
constexpr int weightedComponent = -1;

/// One triangle of a cell; a sensor without a piece of surface counts as one of area 1.
struct SurfacePiece
{
  vtkIdType Cell;
  std::array<vtkIdType, 3> Points; // -1: none, a sensor
  double Area;                     // m^2
};

/// A surface with values. A grid of sensors is given as the cells that they stand for.
struct StatisticsBlock
{
  std::string Name;
  vtkSmartPointer<vtkPolyData> Data;    // values on its cells or points
  vtkSmartPointer<vtkPolyData> Lattice; // of a rectangular grid: the sensors as points; or null
  bool Sensors = false;

  /// The pieces that have area.
  ///   Fails   radiometry::InputError: coordinates that are not finite
  std::vector<SurfacePiece> Pieces(double metersPerUnit) const;
};

/// The polydata of an object (SurfaceBlocks.h) as blocks.
std::vector<StatisticsBlock> StatisticsBlocks(vtkDataObject* object);

/// An array with what it lies on.
struct StatisticsField
{
  vtkDataArray* Array = nullptr;
  bool OnCells = true;

  /// A component, or all bands together.
  ///   Fails   radiometry::InputError: a value that is not finite
  double Value(vtkIdType i, int component) const;
};

/// Cell data is looked at first; Array is null where there is none of that name.
StatisticsField FindField(vtkPolyData* surface, const std::string& name);

/// The names of the result arrays of docs/arrays.md, those of backs included.
std::vector<std::string> ResultQuantities();

/// Every result array of docs/arrays.md that one of the blocks has, without the Error arrays.
std::vector<std::string> ResultNames(const std::vector<StatisticsBlock>& blocks);
