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

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>

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

  /// `order` gets the piece of each cell of the output (-1: none).
  vtkSmartPointer<vtkPolyData> Refine(std::vector<std::int32_t>& order)
  {
    vtkPolyData* data = this->Source.Data;
    const vtkIdType beforePolys = data->GetNumberOfVerts() + data->GetNumberOfLines();
    const vtkIdType beforeStrips = beforePolys + data->GetNumberOfPolys();
    vtkNew<vtkCellArray> polys;
    vtkNew<vtkCellArray> strips;
    std::vector<std::int32_t> wholeStrips;
    std::vector<vtkIdType> stripCells;
    std::vector<vtkIdType> cells; // of the block, that those of the output come from
    vtkNew<vtkIdList> ids;
    const auto add = [&](vtkIdType cell, std::int32_t piece) {
      if (cell < beforePolys)
      {
        order.push_back(piece);
        cells.push_back(cell);
        return;
      }
      data->GetCellPoints(cell, ids);
      const bool cut = piece >= 0 && !this->Pieces.Whole[static_cast<std::size_t>(piece)];
      if (!cut && cell >= beforeStrips)
      {
        strips->InsertNextCell(ids);
        wholeStrips.push_back(piece);
        stripCells.push_back(cell);
        return;
      }
      if (cut)
      {
        this->AddPiece(static_cast<std::size_t>(piece), ids, polys);
      }
      else
      {
        polys->InsertNextCell(ids);
      }
      order.push_back(piece);
      cells.push_back(cell);
    };
    for (vtkIdType cell = 0; cell < this->Source.Cells; ++cell)
    {
      const std::int32_t number = this->Source.Number(cell);
      const auto range =
        std::equal_range(this->Pieces.Cell.begin(), this->Pieces.Cell.end(), number);
      if (range.first == range.second)
      {
        add(cell, -1);
      }
      for (auto piece = range.first; piece != range.second; ++piece)
      {
        add(cell, static_cast<std::int32_t>(piece - this->Pieces.Cell.begin()));
      }
    }
    order.insert(order.end(), wholeStrips.begin(), wholeStrips.end());
    cells.insert(cells.end(), stripCells.begin(), stripCells.end());

    auto output = vtkSmartPointer<vtkPolyData>::New();
    output->SetPoints(this->Points);
    output->SetVerts(data->GetVerts());
    output->SetLines(data->GetLines());
    output->SetPolys(polys);
    output->SetStrips(strips);
    output->GetFieldData()->ShallowCopy(data->GetFieldData());
    this->CopyCellData(output, cells);
    return output;
  }

private:
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

  void CopyCellData(vtkPolyData* output, const std::vector<vtkIdType>& origin) const
  {
    const auto cells = static_cast<vtkIdType>(origin.size());
    vtkCellData* from = this->Source.Data->GetCellData();
    vtkCellData* to = output->GetCellData();
    to->CopyAllOn();
    to->CopyAllocate(from, cells);
    vtkNew<vtkIdTypeArray> original;
    original->SetName(radiometry::names::OriginalCellIds);
    original->SetNumberOfTuples(cells);
    for (vtkIdType c = 0; c < cells; ++c)
    {
      const vtkIdType cell = origin[static_cast<std::size_t>(c)];
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

} // namespace

std::vector<SceneAdapter::Block> RefineSurface(const SceneAdapter& adapter,
  const radiometry::Scene& scene, double metersPerUnit, const radiometry::ShadowPieces& pieces)
{
  std::vector<SceneAdapter::Block> blocks = adapter.OwnBlocks();
  for (SceneAdapter::Block& block : blocks)
  {
    if (block.Sensors)
    {
      continue; // no surface; its values are at points
    }
    std::vector<std::int32_t> order;
    block.Data = BlockRefiner(block, pieces, scene, metersPerUnit).Refine(order);
    block.Cells = block.Data->GetNumberOfCells();
    block.Numbers = std::move(order);
  }
  return blocks;
}
