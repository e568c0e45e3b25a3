// SPDX-License-Identifier: BSD-3-Clause
#include "RefinedSurface.h"

#include "radiometry/scene/ArrayNames.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <array>
#include <map>
#include <unordered_map>

namespace
{

using radiometry::ShadowPieces;
using radiometry::Vec3;

/// Makes one block out of its pieces.
class BlockRefiner
{
public:
  BlockRefiner(const SceneAdapter::Block& block, const ShadowPieces& pieces,
    const radiometry::Scene& scene, double metersPerUnit)
    : Source(block)
    , Pieces(pieces)
    , Geometry(scene)
    , MetersPerUnit(metersPerUnit)
  {
    vtkPolyData* data = block.Data;
    this->Points->SetDataTypeToDouble();
    this->Points->SetNumberOfPoints(data->GetNumberOfPoints());
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
    {
      this->Points->SetPoint(i, data->GetPoint(i));
    }
  }

  /// `first`, `end`: the block's pieces. Appends to `order` the piece of each cell of the output.
  vtkSmartPointer<vtkPolyData> Refine(
    std::size_t first, std::size_t end, std::vector<std::size_t>& order)
  {
    vtkPolyData* data = this->Source.Data;
    const vtkIdType beforePolys = data->GetNumberOfVerts() + data->GetNumberOfLines();
    const vtkIdType beforeStrips = beforePolys + data->GetNumberOfPolys();
    vtkNew<vtkCellArray> polys;
    vtkNew<vtkCellArray> strips;
    std::vector<std::size_t> wholeStrips;
    vtkNew<vtkIdList> ids;
    for (std::size_t piece = first; piece < end; ++piece)
    {
      const vtkIdType cell = this->CellOf(piece);
      if (cell < beforePolys)
      {
        order.push_back(piece);
        continue;
      }
      data->GetCellPoints(cell, ids);
      if (!this->Pieces.Whole[piece])
      {
        this->AddPiece(piece, ids, polys);
        order.push_back(piece);
      }
      else if (cell < beforeStrips)
      {
        polys->InsertNextCell(ids);
        order.push_back(piece);
      }
      else
      {
        strips->InsertNextCell(ids);
        wholeStrips.push_back(piece);
      }
    }
    order.insert(order.end(), wholeStrips.begin(), wholeStrips.end());

    auto output = vtkSmartPointer<vtkPolyData>::New();
    output->SetPoints(this->Points);
    output->SetVerts(data->GetVerts());
    output->SetLines(data->GetLines());
    output->SetPolys(polys);
    output->SetStrips(strips);
    output->GetFieldData()->ShallowCopy(data->GetFieldData());
    this->CopyCellData(output, order, order.size() - (end - first));
    return output;
  }

private:
  vtkIdType CellOf(std::size_t piece) const
  {
    return static_cast<vtkIdType>(this->Pieces.Cell[piece]) -
      static_cast<vtkIdType>(this->Source.FirstCell);
  }

  void AddPiece(std::size_t piece, vtkIdList* cell, vtkCellArray* polys)
  {
    // The corners of the cell stay its points; others are new.
    std::map<std::array<double, 3>, vtkIdType> corners;
    for (vtkIdType k = 0; k < cell->GetNumberOfIds(); ++k)
    {
      double p[3];
      this->Source.Data->GetPoint(cell->GetId(k), p);
      const Vec3 inScene =
        this->MetersPerUnit * Vec3{ p[0], p[1], p[2] } - this->Geometry.Origin;
      corners.emplace(std::array<double, 3>{ inScene.x, inScene.y, inScene.z }, cell->GetId(k));
    }
    polys->InsertNextCell(
      static_cast<int>(this->Pieces.First[piece + 1] - this->Pieces.First[piece]));
    for (std::size_t k = this->Pieces.First[piece]; k < this->Pieces.First[piece + 1]; ++k)
    {
      const std::int32_t corner = this->Pieces.Corners[k];
      const Vec3& p = this->Pieces.Points[corner];
      const auto old = corners.find({ p.x, p.y, p.z });
      if (old != corners.end())
      {
        polys->InsertCellPoint(old->second);
        continue;
      }
      const auto [known, isNew] = this->New.emplace(corner, this->Points->GetNumberOfPoints());
      if (isNew)
      {
        const Vec3 place = (p + this->Geometry.Origin) / this->MetersPerUnit;
        this->Points->InsertNextPoint(place.x, place.y, place.z);
      }
      polys->InsertCellPoint(known->second);
    }
  }

  void CopyCellData(
    vtkPolyData* output, const std::vector<std::size_t>& order, std::size_t first) const
  {
    const auto cells = static_cast<vtkIdType>(order.size() - first);
    vtkCellData* from = this->Source.Data->GetCellData();
    vtkCellData* to = output->GetCellData();
    to->CopyAllOn();
    to->CopyAllocate(from, cells);
    vtkNew<vtkIdTypeArray> original;
    original->SetName(radiometry::names::OriginalCellIds);
    original->SetNumberOfTuples(cells);
    for (vtkIdType c = 0; c < cells; ++c)
    {
      const vtkIdType cell = this->CellOf(order[first + static_cast<std::size_t>(c)]);
      to->CopyData(from, cell, c);
      original->SetValue(c, cell);
    }
    to->AddArray(original);
  }

  const SceneAdapter::Block& Source;
  const ShadowPieces& Pieces;
  const radiometry::Scene& Geometry;
  const double MetersPerUnit;
  vtkNew<vtkPoints> Points;
  std::unordered_map<std::int32_t, vtkIdType> New;
};

/// Brings values (items x bands) into another order.
void Reorder(std::vector<double>& values, const std::vector<std::size_t>& order, std::size_t bands)
{
  std::vector<double> sorted;
  sorted.reserve(order.size() * bands);
  for (const std::size_t item : order)
  {
    sorted.insert(sorted.end(), values.begin() + static_cast<std::ptrdiff_t>(item * bands),
      values.begin() + static_cast<std::ptrdiff_t>((item + 1) * bands));
  }
  values.swap(sorted);
}

} // namespace

std::vector<SceneAdapter::Block> RefineSurface(const SceneAdapter& adapter,
  const radiometry::Scene& scene, double metersPerUnit, vtkRadiometricFilter::Result& result)
{
  std::vector<SceneAdapter::Block> blocks = adapter.Blocks();
  std::vector<std::size_t> order;
  std::size_t piece = 0;
  for (SceneAdapter::Block& block : blocks)
  {
    const std::size_t first = piece;
    const std::size_t cellsEnd = block.FirstCell + static_cast<std::size_t>(block.Cells);
    while (piece < result.Pieces.Size() &&
      static_cast<std::size_t>(result.Pieces.Cell[piece]) < cellsEnd)
    {
      ++piece;
    }
    if (block.Sensors)
    {
      continue; // no surface; its values are at points
    }
    const std::size_t firstCell = order.size();
    block.Data = BlockRefiner(block, result.Pieces, scene, metersPerUnit).Refine(first, piece, order);
    block.FirstCell = firstCell;
    block.Cells = block.Data->GetNumberOfCells();
  }
  const auto bands = static_cast<std::size_t>(scene.Optics.Bands);
  for (vtkRadiometricFilter::Result::Quantity& q : result.Cells)
  {
    Reorder(q.Values, order, bands);
    Reorder(q.Errors, order, bands);
  }
  return blocks;
}
