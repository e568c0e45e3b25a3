// SPDX-License-Identifier: BSD-3-Clause
#include "StatisticsBlocks.h"

#include "SensorGrid.h"
#include "SurfaceBlocks.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"
#include "radiometry/scene/Vec3.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

using radiometry::InputError;
using radiometry::Vec3;

namespace
{

Vec3 FinitePoint(vtkPolyData* surface, vtkIdType i, double metersPerUnit)
{
  double p[3];
  surface->GetPoint(i, p);
  const Vec3 point = metersPerUnit * Vec3{ p[0], p[1], p[2] };
  if (!radiometry::IsFinite(point))
  {
    throw InputError("Points", i, p[0] + p[1] + p[2], "finite coordinates");
  }
  return point;
}

} // namespace

std::vector<SurfacePiece> StatisticsBlock::Pieces(double metersPerUnit) const
{
  std::vector<SurfacePiece> pieces;
  vtkNew<vtkGenericCell> cell;
  vtkNew<vtkIdList> ids;
  vtkNew<vtkPoints> points;
  for (vtkIdType i = 0; i < this->Data->GetNumberOfCells(); ++i)
  {
    this->Data->GetCell(i, cell);
    if (this->Sensors && cell->GetCellDimension() == 0)
    {
      pieces.push_back({ i, { -1, -1, -1 }, 1.0 });
    }
    if (cell->GetCellDimension() != 2)
    {
      continue;
    }
    cell->Triangulate(0, ids, points);
    for (vtkIdType t = 0; t + 2 < ids->GetNumberOfIds(); t += 3)
    {
      radiometry::Triangle3 corners;
      for (int k = 0; k < 3; ++k)
      {
        corners[k] = FinitePoint(this->Data, ids->GetId(t + k), metersPerUnit);
      }
      const double area = radiometry::Area(corners);
      if (area > 0.0)
      {
        pieces.push_back({ i, { ids->GetId(t), ids->GetId(t + 1), ids->GetId(t + 2) }, area });
      }
    }
  }
  return pieces;
}

std::vector<StatisticsBlock> StatisticsBlocks(vtkDataObject* object)
{
  std::vector<StatisticsBlock> blocks;
  for (const auto& [name, surface] : SurfaceBlocks(object))
  {
    StatisticsBlock block;
    block.Name = name;
    block.Sensors = IsSensorGrid(surface);
    block.Data = surface;
    if (block.Sensors)
    {
      block.Data = SensorCells(surface);
      block.Lattice = SensorLattice(surface);
    }
    blocks.push_back(block);
  }
  return blocks;
}

double StatisticsField::Value(vtkIdType i, int component) const
{
  double value = 0.0;
  const int bands = this->Array->GetNumberOfComponents();
  if (component != weightedComponent)
  {
    value = this->Array->GetComponent(i, component);
  }
  else if (bands == 3)
  {
    double rgb[3];
    this->Array->GetTuple(i, rgb);
    value = radiometry::units::Photometric(rgb, 3, 1.0);
  }
  else
  {
    std::vector<double> tuple(static_cast<std::size_t>(bands));
    this->Array->GetTuple(i, tuple.data());
    value = radiometry::units::Photometric(tuple.data(), bands, 1.0);
  }
  if (!std::isfinite(value))
  {
    throw InputError(this->Array->GetName(), i, value, "a finite number");
  }
  return value;
}

StatisticsField FindField(vtkPolyData* surface, const std::string& name)
{
  vtkDataArray* onCells = surface->GetCellData()->GetArray(name.c_str());
  return { onCells ? onCells : surface->GetPointData()->GetArray(name.c_str()),
    onCells != nullptr };
}

std::vector<std::string> ResultQuantities()
{
  namespace names = radiometry::names;
  std::vector<std::string> all;
  for (const std::string name : { names::Irradiance, names::Radiosity, names::Radiance,
         names::Illuminance, names::LuminousExitance, names::Luminance, names::Dose,
         names::LuminousExposure })
  {
    all.push_back(name);
    all.push_back(name + names::BackSuffix);
  }
  return all;
}

std::vector<std::string> ResultNames(const std::vector<StatisticsBlock>& blocks)
{
  std::vector<std::string> found;
  for (const std::string& name : ResultQuantities())
  {
    if (std::any_of(blocks.begin(), blocks.end(),
          [&](const auto& block) { return FindField(block.Data, name).Array != nullptr; }))
    {
      found.push_back(name);
    }
  }
  return found;
}
