// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <vector>

class SceneAdapter;
class vtkPolyData;

/// The points at which results are wanted, and the polydata that will carry them: sensor grids as
/// they are; surfaces, when point values are asked for, with points split along their creases.
class SurfacePoints
{
public:
  SurfacePoints(const SceneAdapter& adapter, const radiometry::Scene& scene, double metersPerUnit,
    bool wanted, double featureAngle);

  struct Block
  {
    vtkSmartPointer<vtkPolyData> Data; // null: this block has no point results
    std::size_t First = 0;             // of its points among Points()
  };
  /// One for each block of the adapter.
  const std::vector<Block>& Blocks() const { return this->Carriers; }
  const std::vector<radiometry::SurfacePoint>& Points() const { return this->All; }

private:
  void AddSensors(vtkPolyData* data, const radiometry::Scene& scene, double metersPerUnit);
  vtkSmartPointer<vtkPolyData> AddVertices(vtkPolyData* data, std::size_t firstCell,
    const radiometry::Scene& scene, double metersPerUnit, double featureAngle);

  std::vector<Block> Carriers;
  std::vector<radiometry::SurfacePoint> All;
};
