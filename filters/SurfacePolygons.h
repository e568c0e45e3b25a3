// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/Creases.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

class vtkPolyData;

/// The polygons of a surface, strips as triangles, for the core.
struct SurfacePolygons
{
  std::vector<std::int64_t> Offsets{ 0 };
  std::vector<std::int64_t> Corners;
  std::vector<vtkIdType> Origin; // of each, the cell it comes from

  void Add(std::initializer_list<vtkIdType> corners, vtkIdType origin)
  {
    this->Add(corners.size(), corners.begin(), origin);
  }
  void Add(std::size_t count, const vtkIdType* corners, vtkIdType origin)
  {
    this->Corners.insert(this->Corners.end(), corners, corners + count);
    this->Offsets.push_back(static_cast<std::int64_t>(this->Corners.size()));
    this->Origin.push_back(origin);
  }
};

/// The polygons and strips of polydata.
SurfacePolygons CollectPolygons(vtkPolyData* data);

/// The polydata of a split surface: points repeated as it says, all data carried along, normals.
vtkSmartPointer<vtkPolyData> MakePolyData(
  vtkPolyData* input, const SurfacePolygons& polygons, const radiometry::SplitSurface& split);
