// SPDX-License-Identifier: BSD-3-Clause
#include "IsoLinePolyData.h"

#include "PointMerger.h"
#include "StatisticsTable.h"
#include "radiometry/geometry/IsoLines.h"

#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkStripper.h"
#include "vtkTable.h"

#include <cmath>
#include <sstream>

using radiometry::Vec3;

namespace
{

/// Cells that meet at more than this angle do not share their values.
const double cosSheet = std::cos(30.0 * 3.14159265358979323846 / 180.0);

/// One triangle or quadrilateral with values at its corners.
struct Facet
{
  std::array<Vec3, 4> Corners;
  std::array<double, 4> Values;
  int Count;
};

int ComponentOf(const StatisticsField& field)
{
  return field.Array->GetNumberOfComponents() == 1 ? 0 : weightedComponent;
}

/// The polygons of a surface, cut to triangles and quadrilaterals. `value` of (cell, corner's place
/// in that cell, point).
template <typename Value>
void AddFacets(vtkPolyData* surface, const Value& value, std::vector<Facet>& facets)
{
  vtkNew<vtkGenericCell> cell;
  vtkNew<vtkIdList> ids;
  vtkNew<vtkPoints> points;
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i)
  {
    surface->GetCell(i, cell);
    if (cell->GetCellDimension() != 2)
    {
      continue;
    }
    Facet facet{};
    const auto add = [&](vtkIdType point, vtkIdType place) {
      double p[3];
      surface->GetPoint(point, p);
      facet.Corners[facet.Count] = { p[0], p[1], p[2] };
      facet.Values[facet.Count] = value(i, place, point);
      ++facet.Count;
    };
    if (cell->GetCellType() == VTK_QUAD)
    {
      for (int k = 0; k < 4; ++k)
      {
        add(cell->GetPointId(k), k);
      }
      facets.push_back(facet);
      continue;
    }
    cell->Triangulate(0, ids, points);
    for (vtkIdType t = 0; t + 2 < ids->GetNumberOfIds(); t += 3)
    {
      facet.Count = 0;
      for (int k = 0; k < 3; ++k)
      {
        add(ids->GetId(t + k), cell->GetPointIds()->IsId(ids->GetId(t + k)));
      }
      facets.push_back(facet);
    }
  }
}

/// Cell values at the corners of cells: averages over the cells of one smooth sheet that meet there.
class CornerAverages
{
public:
  CornerAverages(vtkPolyData* surface, const StatisticsField& field)
  {
    vtkNew<vtkPoints> merged;
    PointMerger merger(merged);
    vtkNew<vtkGenericCell> cell;
    const int component = ComponentOf(field);
    const vtkIdType count = surface->GetNumberOfCells();
    this->First.resize(static_cast<std::size_t>(count) + 1);
    for (vtkIdType i = 0; i < count; ++i)
    {
      surface->GetCell(i, cell);
      this->First[i] = this->Place.size();
      const bool polygon = cell->GetCellDimension() == 2;
      this->Values.push_back(polygon ? field.Value(i, component) : 0.0);
      this->Normals.push_back(polygon ? Normal(cell) : Vec3{});
      for (vtkIdType k = 0; polygon && k < cell->GetNumberOfPoints(); ++k)
      {
        double p[3];
        surface->GetPoint(cell->GetPointId(k), p);
        const vtkIdType place = merger.Add({ p[0], p[1], p[2] });
        this->Place.push_back(place);
        this->Around.resize(static_cast<std::size_t>(merged->GetNumberOfPoints()));
        this->Around[place].push_back(i);
      }
    }
    this->First[count] = this->Place.size();
  }

  double operator()(vtkIdType cell, vtkIdType place, vtkIdType) const
  {
    double sum = 0.0;
    double count = 0.0;
    for (const vtkIdType other : this->Around[this->Place[this->First[cell] + place]])
    {
      if (other == cell || Dot(this->Normals[cell], this->Normals[other]) >= cosSheet)
      {
        sum += this->Values[other];
        count += 1.0;
      }
    }
    return sum / count;
  }

private:
  static Vec3 Normal(vtkCell* cell)
  {
    Vec3 sum;
    double a[3];
    double b[3];
    double c[3];
    cell->GetPoints()->GetPoint(0, a);
    for (vtkIdType k = 1; k + 1 < cell->GetNumberOfPoints(); ++k)
    {
      cell->GetPoints()->GetPoint(k, b);
      cell->GetPoints()->GetPoint(k + 1, c);
      sum += radiometry::AreaNormal2(
        { Vec3{ a[0], a[1], a[2] }, Vec3{ b[0], b[1], b[2] }, Vec3{ c[0], c[1], c[2] } });
    }
    return Normalized(sum);
  }

  std::vector<std::size_t> First;             // of a cell in Place
  std::vector<vtkIdType> Place;               // merged points of the cells' corners
  std::vector<std::vector<vtkIdType>> Around; // cells at a merged point
  std::vector<double> Values;
  std::vector<Vec3> Normals;
};

std::vector<Facet> Facets(const StatisticsBlock& block, const std::string& name)
{
  std::vector<Facet> facets;
  vtkPolyData* surface = block.Lattice ? block.Lattice : block.Data;
  const StatisticsField field = FindField(surface, name);
  if (field.Array && field.OnCells)
  {
    AddFacets(surface, CornerAverages(surface, field), facets);
  }
  else if (field.Array)
  {
    const int component = ComponentOf(field);
    AddFacets(
      surface,
      [&](vtkIdType, vtkIdType, vtkIdType point) { return field.Value(point, component); },
      facets);
  }
  return facets;
}

/// Segments joined to polylines.
vtkSmartPointer<vtkPolyData> Join(const std::vector<radiometry::IsoSegment>& segments)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  PointMerger merger(points);
  vtkNew<vtkCellArray> lines;
  for (const radiometry::IsoSegment& segment : segments)
  {
    const vtkIdType ids[2] = { merger.Add(segment.A), merger.Add(segment.B) };
    lines->InsertNextCell(2, ids);
  }
  vtkNew<vtkPolyData> pieces;
  pieces->SetPoints(points);
  pieces->SetLines(lines);
  vtkNew<vtkStripper> stripper;
  stripper->SetInputData(pieces);
  stripper->JoinContiguousSegmentsOn();
  stripper->SetMaximumLength(100000);
  stripper->Update();
  return stripper->GetOutput();
}

/// The unit of an array, as the simulating filters wrote it; empty where they did not.
std::string UnitOf(const std::vector<StatisticsBlock>& blocks, const std::string& array)
{
  for (const StatisticsBlock& block : blocks)
  {
    auto* units = vtkStringArray::SafeDownCast(
      block.Data->GetFieldData()->GetAbstractArray("RadiometryUnits"));
    for (vtkIdType k = 0; units && k < units->GetNumberOfValues(); ++k)
    {
      const std::string words = units->GetValue(k);
      if (words.compare(0, array.size() + 2, array + " [") == 0 && words.back() == ']')
      {
        return words.substr(array.size() + 2, words.size() - array.size() - 3);
      }
    }
  }
  return {};
}

std::string LabelOf(double level, const std::string& unit)
{
  std::ostringstream label;
  label << level;
  if (!unit.empty())
  {
    label << " " << unit;
  }
  return label.str();
}

/// The lines output, line by line.
struct Lines
{
  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Cells;
  vtkNew<vtkDoubleArray> Isovalue;
  vtkNew<vtkStringArray> Label;
  vtkNew<vtkDoubleArray> Length;
  vtkNew<vtkDoubleArray> Value;

  explicit Lines(const std::string& array)
  {
    this->Points->SetDataTypeToDouble();
    this->Isovalue->SetName("Isovalue");
    this->Label->SetName("Label");
    this->Length->SetName("Length");
    this->Value->SetName(array.c_str());
  }

  /// Adds polylines of one level; returns their length.
  double Add(vtkPolyData* joined, double level, const std::string& label, double metersPerUnit)
  {
    double total = 0.0;
    vtkNew<vtkIdList> ids;
    const auto cells = vtk::TakeSmartPointer(joined->GetLines()->NewIterator());
    for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
    {
      cells->GetCurrentCell(ids);
      double length = 0.0;
      double before[3];
      this->Cells->InsertNextCell(ids->GetNumberOfIds());
      for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
      {
        double p[3];
        joined->GetPoint(ids->GetId(k), p);
        length += k > 0 ? std::hypot(p[0] - before[0], p[1] - before[1], p[2] - before[2]) : 0.0;
        std::copy(p, p + 3, before);
        this->Cells->InsertCellPoint(this->Points->InsertNextPoint(p));
        this->Value->InsertNextValue(level);
      }
      this->Isovalue->InsertNextValue(level);
      this->Label->InsertNextValue(label);
      this->Length->InsertNextValue(metersPerUnit * length);
      total += metersPerUnit * length;
    }
    return total;
  }

  void Give(vtkPolyData* output) const
  {
    output->SetPoints(this->Points);
    output->SetLines(this->Cells);
    output->GetCellData()->AddArray(this->Isovalue);
    output->GetCellData()->AddArray(this->Label);
    output->GetCellData()->AddArray(this->Length);
    output->GetPointData()->SetScalars(this->Value);
  }
};

/// Statistics of the array over all blocks, one collector a level.
StatisticsEntry Overall(const std::vector<StatisticsBlock>& blocks,
  const std::vector<std::vector<SurfacePiece>>& pieces, const std::string& array,
  const std::vector<double>& levels)
{
  StatisticsEntry entry(levels);
  for (std::size_t k = 0; k < blocks.size(); ++k)
  {
    const StatisticsField field = FindField(blocks[k].Data, array);
    for (const SurfacePiece& piece : pieces[k])
    {
      if (field.Array)
      {
        entry.Add(field, piece, ComponentOf(field));
      }
    }
  }
  return entry;
}

} // namespace

void IsoLines::Write(const std::vector<StatisticsBlock>& blocks,
  const std::vector<std::vector<SurfacePiece>>& pieces, vtkPolyData* output, vtkTable* table)
{
  std::vector<double> levels = this->Levels;
  if (levels.empty())
  {
    const auto range = Overall(blocks, pieces, this->Array, { 0.0 }).Values.front().Result();
    levels = radiometry::NiceLevels(range.Minimum, range.Maximum);
  }
  const StatisticsEntry above = Overall(blocks, pieces, this->Array, levels);
  std::vector<std::vector<Facet>> facets;
  for (const StatisticsBlock& block : blocks)
  {
    facets.push_back(Facets(block, this->Array));
  }
  const std::string unit = UnitOf(blocks, this->Array);
  Lines lines(this->Array);
  vtkNew<vtkDoubleArray> isovalue;
  vtkNew<vtkStringArray> label;
  vtkNew<vtkDoubleArray> length;
  vtkNew<vtkDoubleArray> areaAbove;
  vtkNew<vtkDoubleArray> shareAbove;
  isovalue->SetName("Isovalue");
  label->SetName("Label");
  length->SetName("Length");
  areaAbove->SetName("AreaAbove");
  shareAbove->SetName("ShareAbove");
  for (std::size_t k = 0; k < levels.size(); ++k)
  {
    const std::string words = LabelOf(levels[k], unit);
    double total = 0.0;
    for (const std::vector<Facet>& block : facets)
    {
      std::vector<radiometry::IsoSegment> segments;
      for (const Facet& f : block)
      {
        if (f.Count == 4)
        {
          radiometry::AddIsoSegments(f.Corners, f.Values, levels[k], segments);
        }
        else
        {
          radiometry::AddIsoSegment({ f.Corners[0], f.Corners[1], f.Corners[2] },
            { f.Values[0], f.Values[1], f.Values[2] }, levels[k], segments);
        }
      }
      total += lines.Add(Join(segments), levels[k], words, this->MetersPerUnit);
    }
    const radiometry::AreaStatistics statistics = above.Values[k].Result();
    isovalue->InsertNextValue(levels[k]);
    label->InsertNextValue(words);
    length->InsertNextValue(total);
    areaAbove->InsertNextValue(statistics.AreaAbove);
    shareAbove->InsertNextValue(statistics.ShareAbove());
  }
  lines.Give(output);
  for (vtkAbstractArray* column : std::initializer_list<vtkAbstractArray*>{
         isovalue, label, length, areaAbove, shareAbove })
  {
    table->AddColumn(column);
  }
}
