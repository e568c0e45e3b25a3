// SPDX-License-Identifier: BSD-3-Clause
#include "SurfacePoints.h"

#include "SceneAdapter.h"
#include "radiometry/geometry/Creases.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

namespace
{

/// The polygons of a surface, strips as triangles, for the core.
struct Polygons
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

Polygons CollectPolygons(vtkPolyData* data)
{
  Polygons polygons;
  vtkIdType cell = data->GetNumberOfVerts() + data->GetNumberOfLines();
  vtkIdType n = 0;
  const vtkIdType* ids = nullptr;
  const auto polys = vtk::TakeSmartPointer(data->GetPolys()->NewIterator());
  for (polys->GoToFirstCell(); !polys->IsDoneWithTraversal(); polys->GoToNextCell(), ++cell)
  {
    polys->GetCurrentCell(n, ids);
    polygons.Add(static_cast<std::size_t>(n), ids, cell);
  }
  const auto strips = vtk::TakeSmartPointer(data->GetStrips()->NewIterator());
  for (strips->GoToFirstCell(); !strips->IsDoneWithTraversal(); strips->GoToNextCell(), ++cell)
  {
    strips->GetCurrentCell(n, ids);
    for (vtkIdType k = 0; k + 2 < n; ++k)
    {
      const vtkIdType odd = k % 2;
      polygons.Add({ ids[k + odd], ids[k + 1 - odd], ids[k + 2] }, cell);
    }
  }
  return polygons;
}

/// The arrays of `from` that have a tuple for each of `count`; others cannot be carried along.
template <typename Attributes>
vtkSmartPointer<Attributes> Complete(Attributes* from, vtkIdType count)
{
  auto kept = vtkSmartPointer<Attributes>::New();
  kept->ShallowCopy(from);
  for (int k = kept->GetNumberOfArrays() - 1; k >= 0; --k)
  {
    if (kept->GetAbstractArray(k)->GetNumberOfTuples() != count)
    {
      kept->RemoveArray(k);
    }
  }
  return kept;
}

/// The polydata of a split surface: points repeated as it says, all data carried along, normals.
vtkSmartPointer<vtkPolyData> MakePolyData(
  vtkPolyData* input, const Polygons& polygons, const radiometry::SplitSurface& split)
{
  auto output = vtkSmartPointer<vtkPolyData>::New();
  output->GetFieldData()->ShallowCopy(input->GetFieldData());
  const auto count = static_cast<vtkIdType>(split.Source.size());
  vtkNew<vtkPoints> points;
  points->SetDataType(input->GetPoints() ? input->GetPoints()->GetDataType() : VTK_DOUBLE);
  points->SetNumberOfPoints(count);
  vtkNew<vtkDoubleArray> normals;
  normals->SetName(radiometry::names::Normals);
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(count);
  vtkPointData* attributes = output->GetPointData();
  const auto pointArrays = Complete(input->GetPointData(), input->GetNumberOfPoints());
  attributes->CopyAllOn();
  attributes->CopyAllocate(pointArrays, count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    points->SetPoint(i, input->GetPoint(split.Source[i]));
    attributes->CopyData(pointArrays, split.Source[i], i);
    const radiometry::Vec3& n = split.Normals[i];
    normals->SetTuple3(i, n.x, n.y, n.z);
  }
  output->SetPoints(points);
  attributes->RemoveArray(radiometry::names::Normals);
  attributes->SetNormals(normals);

  output->SetVerts(input->GetVerts());
  output->SetLines(input->GetLines());
  const vtkIdType others = input->GetNumberOfVerts() + input->GetNumberOfLines();
  vtkCellData* values = output->GetCellData();
  const auto cellArrays = Complete(input->GetCellData(), input->GetNumberOfCells());
  values->CopyAllOn();
  values->CopyAllocate(cellArrays, others + static_cast<vtkIdType>(polygons.Origin.size()));
  for (vtkIdType c = 0; c < others; ++c)
  {
    values->CopyData(cellArrays, c, c);
  }
  vtkNew<vtkCellArray> cells;
  for (std::size_t c = 0; c < polygons.Origin.size(); ++c)
  {
    cells->InsertNextCell(static_cast<int>(polygons.Offsets[c + 1] - polygons.Offsets[c]));
    for (std::int64_t k = polygons.Offsets[c]; k < polygons.Offsets[c + 1]; ++k)
    {
      cells->InsertCellPoint(split.Corners[k]);
    }
    values->CopyData(cellArrays, polygons.Origin[c], others + static_cast<vtkIdType>(c));
  }
  output->SetPolys(cells);
  return output;
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
      carrier.Data =
        this->AddVertices(block.Data, block.FirstCell, scene, metersPerUnit, featureAngle);
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

vtkSmartPointer<vtkPolyData> SurfacePoints::AddVertices(vtkPolyData* data, std::size_t firstCell,
  const radiometry::Scene& scene, double metersPerUnit, double featureAngle)
{
  // The scene's triangles of each of the caller's cells.
  std::vector<std::vector<std::int32_t>> trianglesOf(scene.Cells);
  for (std::size_t t = 0; t < scene.ReceiverTriangles; ++t)
  {
    trianglesOf[scene.TriangleCell[t]].push_back(static_cast<std::int32_t>(t));
  }
  std::vector<radiometry::Vec3> points(static_cast<std::size_t>(data->GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    double p[3];
    data->GetPoint(static_cast<vtkIdType>(i), p);
    points[i] = metersPerUnit * radiometry::Vec3{ p[0], p[1], p[2] } - scene.Origin;
  }
  const Polygons polygons = CollectPolygons(data);
  const radiometry::SplitSurface split = radiometry::SplitAtCreases(points, polygons.Offsets,
    polygons.Corners, std::cos(radiometry::units::Radians(featureAngle)));

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
  return MakePolyData(data, polygons, split);
}
