// SPDX-License-Identifier: BSD-3-Clause
#include "SurfacePoints.h"

#include "SceneAdapter.h"
#include "radiometry/geometry/PolygonTriangles.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataNormals.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace
{

constexpr char OriginalCell[] = "RadiometryOriginalCell";

/// A copy whose points are split along creases and carry normals; cells remember their origin.
vtkSmartPointer<vtkPolyData> SplitCreases(vtkPolyData* input, double featureAngle)
{
  vtkNew<vtkPolyData> tagged;
  tagged->ShallowCopy(input);
  vtkNew<vtkIdTypeArray> origin;
  origin->SetName(OriginalCell);
  origin->SetNumberOfTuples(input->GetNumberOfCells());
  for (vtkIdType c = 0; c < input->GetNumberOfCells(); ++c)
  {
    origin->SetValue(c, c);
  }
  tagged->GetCellData()->AddArray(origin);
  tagged->GetPointData()->SetNormals(nullptr);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(tagged);
  normals->SetFeatureAngle(featureAngle);
  normals->SplittingOn();
  normals->ConsistencyOff();
  normals->AutoOrientNormalsOff();
  normals->ComputePointNormalsOn();
  normals->ComputeCellNormalsOff();
  normals->Update();
  return normals->GetOutput();
}

/// Unit normals of the cells, in double (VTK's are single and would tilt a turned surface by 1e-7);
/// zero for cells without area.
std::vector<radiometry::Vec3> CellNormals(vtkPolyData* data)
{
  std::vector<radiometry::Vec3> normals(static_cast<std::size_t>(data->GetNumberOfCells()));
  std::vector<radiometry::Vec3> polygon;
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c)
  {
    data->GetCellPoints(c, corners);
    polygon.clear();
    for (vtkIdType k = 0; k < corners->GetNumberOfIds(); ++k)
    {
      double p[3];
      data->GetPoint(corners->GetId(k), p);
      polygon.push_back({ p[0], p[1], p[2] });
    }
    normals[c] = radiometry::PolygonNormal(polygon);
  }
  return normals;
}

} // namespace

SurfacePoints::SurfacePoints(const SceneAdapter& adapter, const radiometry::Scene& scene,
  double metersPerUnit, bool wanted, double featureAngle)
{
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
      carrier.Data = SplitCreases(block.Data, featureAngle);
      this->AddVertices(carrier.Data, block.FirstCell, scene, metersPerUnit);
    }
    this->Carriers.push_back(carrier);
  }
}

void SurfacePoints::AddSensors(
  vtkPolyData* data, const radiometry::Scene& scene, double metersPerUnit)
{
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
    this->All.push_back(
      { metersPerUnit * point - scene.Origin, Normalized(normal), -1, {}, rounding });
  }
}

void SurfacePoints::AddVertices(vtkPolyData* split, std::size_t firstCell,
  const radiometry::Scene& scene, double metersPerUnit)
{
  namespace names = radiometry::names;
  // The scene's triangles of each of the caller's cells.
  std::vector<std::vector<std::int32_t>> trianglesOf(scene.Cells);
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    trianglesOf[scene.TriangleCell[t]].push_back(static_cast<std::int32_t>(t));
  }
  const vtkSmartPointer<vtkDataArray> normals = split->GetPointData()->GetNormals();
  const std::vector<radiometry::Vec3> cellNormals = CellNormals(split);
  auto* origin = vtkIdTypeArray::SafeDownCast(split->GetCellData()->GetArray(OriginalCell));
  split->BuildLinks();
  vtkNew<vtkIdList> cells;
  for (vtkIdType i = 0; i < split->GetNumberOfPoints(); ++i)
  {
    double p[3];
    split->GetPoint(i, p);
    radiometry::SurfacePoint point;
    point.Point = metersPerUnit * radiometry::Vec3{ p[0], p[1], p[2] } - scene.Origin;
    split->GetPointCells(i, cells);
    for (vtkIdType k = 0; k < cells->GetNumberOfIds(); ++k)
    {
      point.Normal += cellNormals[cells->GetId(k)];
      const auto cell = firstCell + static_cast<std::size_t>(origin->GetValue(cells->GetId(k)));
      for (const std::int32_t t : trianglesOf[cell])
      {
        // A polygon's triangles: those that have this corner.
        for (const radiometry::Vec3& corner : scene.TriangleAt(t))
        {
          if (Length(corner - point.Point) <= 1e-12 * (Length(corner) + Length(point.Point)))
          {
            point.Around.push_back(t);
            break;
          }
        }
      }
    }
    point.Normal = radiometry::Normalized(point.Normal);
    point.Triangle = point.Around.empty() ? -1 : point.Around.front();
    this->All.push_back(std::move(point));
  }
  split->GetCellData()->RemoveArray(OriginalCell);
  split->GetPointData()->SetNormals(nullptr);
  if (normals)
  {
    normals->SetName(names::Normals);
    split->GetPointData()->AddArray(normals);
    split->GetPointData()->SetActiveNormals(names::Normals);
  }
}
