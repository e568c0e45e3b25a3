// SPDX-License-Identifier: BSD-3-Clause
#include "SmoothField.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/Vec3.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace vtkradiometry
{
namespace
{

using radiometry::Vec3;

constexpr double CosineOfCrease = 0.8660254037844386; // of 30 degrees

/// The polygons of a block: their normals, areas and materials, and which of them meet at a place.
class Polygons
{
public:
  explicit Polygons(vtkPolyData* block)
    : Cells(block->GetPolys())
    , PlaceOfPoint(static_cast<std::size_t>(block->GetNumberOfPoints()))
    , Material(block->GetCellData()->GetArray("MaterialIndex"))
  {
    std::map<std::array<double, 3>, std::size_t> places;
    for (vtkIdType p = 0; p < block->GetNumberOfPoints(); ++p)
    {
      std::array<double, 3> x;
      block->GetPoint(p, x.data());
      for (double& c : x)
      {
        c = std::isfinite(c) ? c : 0.0; // an order needs numbers
      }
      this->PlaceOfPoint[p] = places.emplace(x, places.size()).first->second;
    }
    this->Around.resize(places.size());
    vtkNew<vtkIdList> ids;
    for (vtkIdType c = 0; c < this->Cells->GetNumberOfCells(); ++c)
    {
      this->Cells->GetCellAtId(c, ids);
      Vec3 normal; // times twice the area
      std::array<Vec3, 3> x;
      for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
      {
        double p[3];
        block->GetPoint(ids->GetId(k), p);
        x[k == 0 ? 0 : 2] = { p[0], p[1], p[2] };
        if (k >= 2)
        {
          normal += Cross(x[1] - x[0], x[2] - x[0]);
        }
        x[1] = x[2];
        auto& around = this->Around[this->PlaceOfPoint[ids->GetId(k)]];
        if (around.empty() || around.back() != c)
        {
          around.push_back(c);
        }
      }
      const double length = Length(normal);
      this->Areas.push_back(std::isfinite(length) ? length : 0.0);
      this->Normals.push_back(length > 0.0 ? (1.0 / length) * normal : Vec3{});
    }
  }
  /// The mean of an array at a corner of cell c.
  void Mean(vtkDataArray* array, vtkIdType c, vtkIdType point, double* value) const
  {
    const int bands = array->GetNumberOfComponents();
    double total = 0.0;
    std::fill_n(value, bands, 0.0);
    for (const vtkIdType other : this->Around[this->PlaceOfPoint[point]])
    {
      if (this->Areas[other] > 0.0 && this->Together(c, other))
      {
        total += this->Areas[other];
        for (int b = 0; b < bands; ++b)
        {
          value[b] += this->Areas[other] * array->GetComponent(other, b);
        }
      }
    }
    for (int b = 0; b < bands; ++b)
    {
      value[b] = total > 0.0 ? value[b] / total : array->GetComponent(c, b);
    }
  }

private:
  bool Together(vtkIdType a, vtkIdType b) const
  {
    return a == b ||
      (Dot(this->Normals[a], this->Normals[b]) >= CosineOfCrease &&
        (!this->Material ||
          this->Material->GetComponent(a, 0) == this->Material->GetComponent(b, 0)));
  }
  vtkCellArray* Cells;
  std::vector<std::size_t> PlaceOfPoint;
  std::vector<std::vector<vtkIdType>> Around;
  std::vector<Vec3> Normals;
  std::vector<double> Areas;
  vtkDataArray* Material;
};

bool OnlyPolygons(vtkPolyData* block)
{
  return block->GetNumberOfPolys() > 0 && block->GetNumberOfPolys() == block->GetNumberOfCells();
}

vtkSmartPointer<vtkPolyData> SmoothBlock(vtkPolyData* block, const std::string& name)
{
  std::vector<vtkDataArray*> fields;
  for (const std::string& which : { name, name + radiometry::names::BackSuffix })
  {
    vtkDataArray* ofCells = block->GetCellData()->GetArray(which.c_str());
    if (ofCells && !block->GetPointData()->GetArray(which.c_str()))
    {
      fields.push_back(ofCells);
    }
  }
  if (fields.empty() || !OnlyPolygons(block))
  {
    return block;
  }
  const Polygons polygons(block);
  const vtkIdType corners = block->GetPolys()->GetNumberOfConnectivityIds();
  auto smooth = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(block->GetPoints()->GetDataType());
  points->SetNumberOfPoints(corners);
  smooth->GetPointData()->CopyAllOn();
  smooth->GetPointData()->CopyAllocate(block->GetPointData(), corners);
  std::vector<vtkSmartPointer<vtkDoubleArray>> means;
  for (vtkDataArray* field : fields)
  {
    means.push_back(vtkSmartPointer<vtkDoubleArray>::New());
    means.back()->SetName(field->GetName());
    means.back()->SetNumberOfComponents(field->GetNumberOfComponents());
    means.back()->SetNumberOfTuples(corners);
  }
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIdList> ids;
  vtkIdType corner = 0;
  for (vtkIdType c = 0; c < block->GetNumberOfPolys(); ++c)
  {
    block->GetPolys()->GetCellAtId(c, ids);
    cells->InsertNextCell(static_cast<int>(ids->GetNumberOfIds()));
    for (const vtkIdType p : *ids)
    {
      points->SetPoint(corner, block->GetPoint(p));
      smooth->GetPointData()->CopyData(block->GetPointData(), p, corner);
      for (std::size_t f = 0; f < fields.size(); ++f)
      {
        const vtkIdType bands = fields[f]->GetNumberOfComponents();
        polygons.Mean(fields[f], c, p, means[f]->GetPointer(corner * bands));
      }
      cells->InsertCellPoint(corner++);
    }
  }
  smooth->SetPoints(points);
  smooth->SetPolys(cells);
  smooth->GetCellData()->ShallowCopy(block->GetCellData());
  smooth->GetFieldData()->ShallowCopy(block->GetFieldData());
  for (const auto& mean : means)
  {
    smooth->GetPointData()->AddArray(mean);
  }
  return smooth;
}

} // namespace

vtkSmartPointer<vtkDataObject> SmoothField(vtkDataObject* data, const std::string& name)
{
  if (auto* block = vtkPolyData::SafeDownCast(data))
  {
    return SmoothBlock(block, name);
  }
  auto* tree = vtkCompositeDataSet::SafeDownCast(data);
  if (!tree)
  {
    return nullptr;
  }
  auto smooth = vtk::TakeSmartPointer(tree->NewInstance());
  smooth->CopyStructure(tree);
  smooth->GetFieldData()->ShallowCopy(tree->GetFieldData());
  auto it = vtk::TakeSmartPointer(tree->NewIterator());
  for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
  {
    vtkDataObject* block = it->GetCurrentDataObject();
    auto* polygons = vtkPolyData::SafeDownCast(block);
    smooth->SetDataSet(it, polygons ? SmoothBlock(polygons, name).Get() : block);
  }
  return smooth;
}

} // namespace vtkradiometry
