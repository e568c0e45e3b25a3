// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVertexNormalsFilter.h"

#include "PointMerger.h"
#include "SurfacePolygons.h"
#include "radiometry/geometry/Creases.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"
#include "radiometry/shading/VertexNormals.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkVertexNormalsFilter);

using radiometry::InputError;
using radiometry::Vec3;

namespace
{

struct Block
{
  vtkPolyData* Input;
  SurfacePolygons Polygons;
  std::size_t FirstCorner; // among those of all blocks
};

/// All blocks as one mesh, its points numbered anew.
class Mesh
{
public:
  explicit Mesh(bool merge)
    : Merge(merge)
    , Merger(this->Merged)
  {
    this->Merged->SetDataTypeToDouble();
  }

  void Add(vtkPolyData* data)
  {
    Block block{ data, CollectPolygons(data), this->Corners.size() };
    std::vector<std::int64_t> number(static_cast<std::size_t>(data->GetNumberOfPoints()));
    for (std::size_t i = 0; i < number.size(); ++i)
    {
      double p[3];
      data->GetPoint(static_cast<vtkIdType>(i), p);
      for (const double x : p)
      {
        if (!std::isfinite(x))
        {
          throw InputError("Points", static_cast<long long>(i), x, "finite coordinates");
        }
      }
      const Vec3 point{ p[0], p[1], p[2] };
      number[i] = this->Merge ? this->Merger.Add(point) : static_cast<vtkIdType>(this->Points.size());
      if (number[i] == static_cast<std::int64_t>(this->Points.size()))
      {
        this->Points.push_back(point);
      }
    }
    for (const std::int64_t corner : block.Polygons.Corners)
    {
      this->Corners.push_back(number[static_cast<std::size_t>(corner)]);
    }
    for (std::size_t c = 1; c < block.Polygons.Offsets.size(); ++c)
    {
      this->Offsets.push_back(
        static_cast<std::int64_t>(block.FirstCorner) + block.Polygons.Offsets[c]);
    }
    this->Blocks.push_back(std::move(block));
  }

  std::vector<Block> Blocks;
  std::vector<Vec3> Points;
  std::vector<std::int64_t> Offsets{ 0 };
  std::vector<std::int64_t> Corners;

private:
  bool Merge;
  vtkNew<vtkPoints> Merged;
  PointMerger Merger;
};

void AddCellNormals(const Block& block, vtkPolyData* output)
{
  vtkNew<vtkDoubleArray> normals;
  normals->SetName(radiometry::names::Normals);
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(output->GetNumberOfCells());
  normals->Fill(0.0);
  const vtkIdType others = output->GetNumberOfVerts() + output->GetNumberOfLines();
  std::vector<Vec3> corners;
  for (std::size_t c = 0; c + 1 < block.Polygons.Offsets.size(); ++c)
  {
    corners.clear();
    for (std::int64_t k = block.Polygons.Offsets[c]; k < block.Polygons.Offsets[c + 1]; ++k)
    {
      double p[3];
      block.Input->GetPoint(block.Polygons.Corners[k], p);
      corners.push_back({ p[0], p[1], p[2] });
    }
    const Vec3 n = radiometry::CellNormal(corners.data(), corners.size());
    normals->SetTuple3(others + static_cast<vtkIdType>(c), n.x, n.y, n.z);
  }
  output->GetCellData()->SetNormals(normals);
}

/// The block with the normals of its corners' sheets.
vtkSmartPointer<vtkPolyData> Finish(const Block& block,
  const std::vector<std::int64_t>& sheetOfCorner, const std::vector<Vec3>& normalOfSheet,
  bool cellNormals)
{
  const auto first = sheetOfCorner.begin() + static_cast<std::ptrdiff_t>(block.FirstCorner);
  const radiometry::SeparatedPoints separated = radiometry::SeparateSheets(
    static_cast<std::size_t>(block.Input->GetNumberOfPoints()), block.Polygons.Corners,
    { first, first + static_cast<std::ptrdiff_t>(block.Polygons.Corners.size()) });
  radiometry::SplitSurface split{ separated.Source, separated.Corners, {} };
  for (const std::int64_t sheet : separated.Sheet)
  {
    split.Normals.push_back(sheet < 0 ? Vec3{} : normalOfSheet[static_cast<std::size_t>(sheet)]);
  }
  vtkSmartPointer<vtkPolyData> output = MakePolyData(block.Input, block.Polygons, split);
  if (cellNormals)
  {
    AddCellNormals(block, output);
  }
  return output;
}

} // namespace

int vtkVertexNormalsFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

int vtkVertexNormalsFilter::RequestData(
  vtkInformation*, vtkInformationVector** in, vtkInformationVector* out)
{
  vtkDataObject* input = vtkDataObject::GetData(in[0]);
  vtkDataObject* output = vtkDataObject::GetData(out);
  output->Initialize();
  try
  {
    auto* composite = vtkCompositeDataSet::SafeDownCast(input);
    Mesh mesh(this->MergePoints);
    vtkSmartPointer<vtkCompositeDataIterator> iterator;
    if (composite)
    {
      iterator = vtk::TakeSmartPointer(composite->NewIterator());
      for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
      {
        vtkDataObject* leaf = iterator->GetCurrentDataObject();
        if (!vtkPolyData::SafeDownCast(leaf))
        {
          throw InputError("Input", iterator->GetCurrentFlatIndex(), leaf->GetClassName(),
            "polydata; Extract Surface makes it");
        }
        mesh.Add(vtkPolyData::SafeDownCast(leaf));
      }
    }
    else
    {
      mesh.Add(vtkPolyData::SafeDownCast(input));
    }

    std::vector<std::int64_t> sheets = mesh.Corners;
    std::vector<Vec3> points = mesh.Points;
    if (this->Splitting)
    {
      radiometry::SplitSurface split = radiometry::SplitAtCreases(mesh.Points, mesh.Offsets,
        mesh.Corners, std::cos(radiometry::units::Radians(this->FeatureAngle)));
      sheets = std::move(split.Corners);
      points.clear();
      for (const std::int64_t source : split.Source)
      {
        points.push_back(mesh.Points[static_cast<std::size_t>(source)]);
      }
    }
    const std::vector<Vec3> normals = radiometry::ComputeVertexNormals(points, mesh.Offsets, sheets,
      static_cast<radiometry::NormalWeight>(this->Weighting));

    if (!composite)
    {
      vtkPolyData::SafeDownCast(output)->ShallowCopy(
        Finish(mesh.Blocks.front(), sheets, normals, this->ComputeCellNormals));
      return 1;
    }
    auto* result = vtkCompositeDataSet::SafeDownCast(output);
    result->CopyStructure(composite);
    std::size_t block = 0;
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      result->SetDataSet(
        iterator, Finish(mesh.Blocks[block++], sheets, normals, this->ComputeCellNormals));
    }
  }
  catch (const InputError& error)
  {
    vtkErrorMacro(<< error.what());
    output->Initialize();
    return 0;
  }
  return 1;
}

void vtkVertexNormalsFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Weighting: " << this->Weighting << " (0 angle, 1 area, 2 uniform)\n";
  os << indent << "Splitting: " << this->Splitting << "\n";
  os << indent << "FeatureAngle: " << this->FeatureAngle << " degrees\n";
  os << indent << "MergePoints: " << this->MergePoints << "\n";
  os << indent << "ComputeCellNormals: " << this->ComputeCellNormals << "\n";
}
