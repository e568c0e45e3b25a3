// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/MeasuringGrid.h"

#include "vtkSmartPointer.h"

#include <array>
#include <string>
#include <vector>

class vtkPolyData;

/// Writes sensors as vertices with Normals and SensorCell (docs/arrays.md).
/// `counts`: points along both sides of a rectangle; 0 where there is none.
void WriteSensors(const std::vector<radiometry::Sensor>& sensors,
  const std::array<std::int64_t, 2>& counts, const std::string& rule, vtkPolyData* output);

/// Whether polydata is a grid of sensors: points with normals and no polygons.
bool IsSensorGrid(vtkPolyData* data);

/// One cell for each sensor, with the sensors' point data as cell data: the pieces of the plane
/// (SensorCell), or a vertex each where that array is missing. Field data is kept.
///   Fails   radiometry::InputError: SensorCell of the wrong length or not finite
vtkSmartPointer<vtkPolyData> SensorCells(vtkPolyData* sensors);

/// The sensors of a rectangle joined to quadrilaterals, with their point data; null where
/// SensorGridDimensions is missing, does not fit, or is less than 2 either way.
vtkSmartPointer<vtkPolyData> SensorLattice(vtkPolyData* sensors);
