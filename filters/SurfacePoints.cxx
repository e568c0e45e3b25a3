// SPDX-License-Identifier: BSD-3-Clause
#include "SurfacePoints.h"

#include "SceneAdapter.h"
#include "SurfacePolygons.h"
#include "radiometry/geometry/Creases.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <string>

SurfacePoints::SurfacePoints(const SceneAdapter& adapter, const radiometry::Scene& scene,
  double metersPerUnit, bool wanted, double featureAngle)
{
  if (adapter.IsGathered())
  {
    this->Gather(adapter, scene, metersPerUnit, wanted, featureAngle);
    return;
  }
  for (const SceneAdapter::Block& block : adapter.Blocks())
  {
    Block carrier;
    carrier.First = this->All.size();
    if (block.Sensors)
    {
      carrier.Data = block.Data;
      this->AddSensors(block.Data, scene, metersPerUnit);
    }
    else if (wanted && block.Cells > 0)
    {
      carrier.Data =
        this->AddVertices(block.Data, block.FirstCell, scene, metersPerUnit, featureAngle);
    }
    this->Carriers.push_back(carrier);
  }
}

void SurfacePoints::AddSensors(
  vtkPolyData* data, const radiometry::Scene& scene, double metersPerUnit)
{
  const std::vector<radiometry::SurfacePoint> sensors = ReadSensors(data, scene, metersPerUnit);
  this->All.insert(this->All.end(), sensors.begin(), sensors.end());
}

std::vector<radiometry::SurfacePoint> SurfacePoints::ReadSensors(
  vtkPolyData* data, const radiometry::Scene& scene, double metersPerUnit)
{
  std::vector<radiometry::SurfacePoint> sensors;
  namespace names = radiometry::names;
  vtkDataArray* normals = data->GetPointData()->GetArray(names::Normals);
  if (normals->GetNumberOfComponents() != 3 ||
    normals->GetNumberOfTuples() != data->GetNumberOfPoints())
  {
    throw radiometry::InputError(names::Normals, -1,
      std::to_string(normals->GetNumberOfTuples()) + " tuples of " +
        std::to_string(normals->GetNumberOfComponents()) + " components",
      std::to_string(data->GetNumberOfPoints()) + " tuples of 3, one a sensor");
  }
  const bool single = data->GetPoints()->GetDataType() == VTK_FLOAT;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double p[3];
    data->GetPoint(i, p);
    const radiometry::Vec3 point{ p[0], p[1], p[2] };
    const radiometry::Vec3 normal{ normals->GetComponent(i, 0), normals->GetComponent(i, 1),
      normals->GetComponent(i, 2) };
    if (!IsFinite(point))
    {
      throw radiometry::InputError("Points", i,
        std::isfinite(p[0]) ? (std::isfinite(p[1]) ? p[2] : p[1]) : p[0], "finite coordinates");
    }
    if (!IsFinite(normal) || !(Length(normal) > 0.0))
    {
      throw radiometry::InputError(
        names::Normals, i, normal.x, "a finite direction of a sensor, not zero");
    }
    const double rounding = single
      ? 1.2e-7 * metersPerUnit * std::max({ std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2]) })
      : 0.0;
    sensors.push_back(
      { metersPerUnit * point - scene.Origin, Normalized(normal), -1, {}, rounding });
  }
  return sensors;
}

vtkSmartPointer<vtkPolyData> SurfacePoints::AddVertices(vtkPolyData* data, std::size_t firstCell,
  const radiometry::Scene& scene, double metersPerUnit, double featureAngle)
{
  std::vector<radiometry::Vec3> points(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    double p[3];
    data->GetPoint(static_cast<vtkIdType>(i), p);
    points[i] = metersPerUnit * radiometry::Vec3{ p[0], p[1], p[2] } - scene.Origin;
  }
  const SurfacePolygons polygons = CollectPolygons(data);
  const radiometry::SplitSurface split = radiometry::SplitAtCreases(points, polygons.Offsets,
    polygons.Corners, std::cos(radiometry::units::Radians(featureAngle)));

  this->AddSplit(points, polygons, firstCell, split, scene);
  return MakePolyData(data, polygons, split);
}

void SurfacePoints::AddSplit(const std::vector<radiometry::Vec3>& points,
  const SurfacePolygons& polygons, std::size_t firstCell, const radiometry::SplitSurface& split,
  const radiometry::Scene& scene)
{
  // The scene's triangles of each of the caller's cells.
  std::vector<std::vector<std::int32_t>> trianglesOf(scene.Cells);
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    trianglesOf[scene.TriangleCell[t]].push_back(static_cast<std::int32_t>(t));
  }
  const std::size_t first = this->All.size();
  for (std::size_t i = 0; i < split.Source.size(); ++i)
  {
    radiometry::SurfacePoint point;
    point.Point = points[split.Source[i]];
    point.Normal = split.Normals[i];
    this->All.push_back(std::move(point));
  }
  for (std::size_t c = 0; c < polygons.Origin.size(); ++c)
  {
    const std::vector<std::int32_t>& triangles =
      trianglesOf[firstCell + static_cast<std::size_t>(polygons.Origin[c])];
    for (std::int64_t k = polygons.Offsets[c]; k < polygons.Offsets[c + 1]; ++k)
    {
      radiometry::SurfacePoint& point = this->All[first + split.Corners[k]];
      for (const std::int32_t t : triangles)
      {
        // A cell's triangles: those that have this corner, each once.
        const radiometry::Triangle3 corners = scene.TriangleAt(t);
        const bool here = std::any_of(corners.begin(), corners.end(),
          [&](const radiometry::Vec3& corner) { return corner == point.Point; });
        if (here && std::find(point.Around.begin(), point.Around.end(), t) == point.Around.end())
        {
          point.Around.push_back(t);
        }
      }
    }
  }
  for (std::size_t i = first; i < this->All.size(); ++i)
  {
    radiometry::SurfacePoint& point = this->All[i];
    point.Triangle = point.Around.empty() ? -1 : point.Around.front();
  }
}
