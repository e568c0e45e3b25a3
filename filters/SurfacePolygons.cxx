// SPDX-License-Identifier: BSD-3-Clause
#include "SurfacePolygons.h"

#include "radiometry/scene/ArrayNames.h"

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

namespace
{

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

} // namespace

SurfacePolygons CollectPolygons(vtkPolyData* data)
{
  SurfacePolygons polygons;
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

vtkSmartPointer<vtkPolyData> MakePolyData(
  vtkPolyData* input, const SurfacePolygons& polygons, const radiometry::SplitSurface& split)
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
