// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/geometry/Creases.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <cstdint>
#include <vector>

class SceneAdapter;
struct SurfacePolygons;
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
    std::vector<std::int32_t> Numbers; // of each of its points there (-1: none); empty: from First on
  };
  /// One for each own block of the adapter.
  const std::vector<Block>& Blocks() const { return this->Carriers; }
  const std::vector<radiometry::SurfacePoint>& Points() const { return this->All; }

private:
  /// Those of all processes (GatheredPoints.cxx).
  void Gather(const SceneAdapter& adapter, const radiometry::Scene& scene, double metersPerUnit,
    bool wanted, double featureAngle);
  void AddSensors(vtkPolyData* data, const radiometry::Scene& scene, double metersPerUnit);
  static std::vector<radiometry::SurfacePoint> ReadSensors(
    vtkPolyData* data, const radiometry::Scene& scene, double metersPerUnit);
  vtkSmartPointer<vtkPolyData> AddVertices(vtkPolyData* data, std::size_t firstCell,
    const radiometry::Scene& scene, double metersPerUnit, double featureAngle);

  /// The points of a surface that was split along its creases; cell k of the polygons' origins is
  /// the scene's cell firstCell + k.
  void AddSplit(const std::vector<radiometry::Vec3>& points, const SurfacePolygons& polygons,
    std::size_t firstCell, const radiometry::SplitSurface& split, const radiometry::Scene& scene);

  std::vector<Block> Carriers;
  std::vector<radiometry::SurfacePoint> All;
};
