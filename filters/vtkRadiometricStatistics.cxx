// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiometricStatistics.h"

#include "SurfaceBlocks.h"
#include "radiometry/accuracy/AreaStatistics.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"
#include "radiometry/scene/Vec3.h"

#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

vtkStandardNewMacro(vtkRadiometricStatistics);

namespace
{

using radiometry::AreaStatistics;
using radiometry::AreaStatisticsCollector;
using radiometry::InputError;
using radiometry::Vec3;

constexpr long long everyGroup = -1;
constexpr int weightedComponent = -1;

/// One triangle of a cell.
struct Piece
{
  vtkIdType Cell;
  std::array<vtkIdType, 3> Points;
  double Area;
};

/// The triangles of the cells that have area.
std::vector<Piece> Pieces(vtkPolyData* surface, double metersPerUnit)
{
  std::vector<Piece> pieces;
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
    cell->Triangulate(0, ids, points);
    for (vtkIdType t = 0; t + 2 < ids->GetNumberOfIds(); t += 3)
    {
      radiometry::Triangle3 corners;
      for (int k = 0; k < 3; ++k)
      {
        double p[3];
        surface->GetPoint(ids->GetId(t + k), p);
        corners[k] = metersPerUnit * Vec3{ p[0], p[1], p[2] };
        if (!radiometry::IsFinite(corners[k]))
        {
          throw InputError("Points", ids->GetId(t + k), p[0] + p[1] + p[2], "finite coordinates");
        }
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

struct Key
{
  long long Group;
  std::string Array;
  int Component;
  bool operator<(const Key& o) const
  {
    return std::tie(this->Group, this->Array, this->Component) <
      std::tie(o.Group, o.Array, o.Component);
  }
};

struct Entry
{
  explicit Entry(double threshold)
    : Values(threshold)
  {
  }
  AreaStatisticsCollector Values;
  std::string Name;
  vtkIdType Cells = 0;
  vtkIdType LastCell = -1;
};

using Entries = std::map<Key, Entry>;

/// An array with what it lies on.
struct Field
{
  vtkDataArray* Array = nullptr;
  bool OnCells = true;

  /// A component, or the weighted sum of three bands.
  double Value(vtkIdType i, int component) const
  {
    double value = 0.0;
    if (component != weightedComponent)
    {
      value = this->Array->GetComponent(i, component);
    }
    else
    {
      const double rgb[3] = { this->Array->GetComponent(i, 0), this->Array->GetComponent(i, 1),
        this->Array->GetComponent(i, 2) };
      value = radiometry::units::Photometric(rgb, 3, 1.0);
    }
    if (!std::isfinite(value))
    {
      throw InputError(this->Array->GetName(), i, value, "a finite number");
    }
    return value;
  }
};

Field FindField(vtkPolyData* surface, const std::string& name)
{
  vtkDataArray* onCells = surface->GetCellData()->GetArray(name.c_str());
  return { onCells ? onCells : surface->GetPointData()->GetArray(name.c_str()),
    onCells != nullptr };
}

/// Every result array of docs/arrays.md that one of the surfaces has.
std::vector<std::string> ResultNames(
  const std::vector<std::pair<std::string, vtkPolyData*>>& blocks)
{
  namespace names = radiometry::names;
  std::vector<std::string> found;
  for (const std::string name : { names::Irradiance, names::Radiosity, names::Radiance,
         names::Illuminance, names::LuminousExitance, names::Luminance })
  {
    for (const std::string& full : { name, name + names::BackSuffix })
    {
      if (std::any_of(blocks.begin(), blocks.end(),
            [&](const auto& block) { return FindField(block.second, full).Array != nullptr; }))
      {
        found.push_back(full);
      }
    }
  }
  return found;
}

void AddPiece(Entry& entry, const Field& field, const Piece& piece, int component)
{
  if (field.OnCells)
  {
    entry.Values.AddConstant(piece.Area, field.Value(piece.Cell, component));
  }
  else
  {
    const auto& p = piece.Points;
    entry.Values.AddLinear(piece.Area, field.Value(p[0], component),
      field.Value(p[1], component), field.Value(p[2], component));
  }
  if (entry.LastCell != piece.Cell)
  {
    entry.LastCell = piece.Cell;
    ++entry.Cells;
  }
}

/// Adds a surface to the entries of its block and to those of the whole (where that is not null).
void Collect(vtkPolyData* surface, const std::vector<Piece>& pieces, const std::string& name,
  const char* groupArray, double threshold, Entries& block, Entries* whole)
{
  const Field field = FindField(surface, name);
  if (!field.Array)
  {
    return;
  }
  vtkDataArray* groups =
    groupArray && *groupArray ? surface->GetCellData()->GetArray(groupArray) : nullptr;
  const int components = field.Array->GetNumberOfComponents();
  for (int c = components == 3 ? weightedComponent : 0; c < components; ++c)
  {
    const auto entryOf = [&](Entries& entries, long long group) -> Entry& {
      return entries.emplace(Key{ group, name, c }, Entry(threshold)).first->second;
    };
    Entry& all = entryOf(block, everyGroup);
    Entry* total = whole ? &entryOf(*whole, everyGroup) : nullptr;
    if (total)
    {
      total->LastCell = -1;
    }
    for (const Piece& piece : pieces)
    {
      AddPiece(all, field, piece, c);
      if (total)
      {
        AddPiece(*total, field, piece, c);
      }
      if (groups)
      {
        const auto group = static_cast<long long>(groups->GetComponent(piece.Cell, 0));
        if (group < 0)
        {
          throw InputError(groupArray, piece.Cell, static_cast<double>(group), "0 or more");
        }
        Entry& entry = entryOf(block, group);
        if (entry.Cells == 0)
        {
          entry.Name = ValueName(surface, groupArray, group);
        }
        AddPiece(entry, field, piece, c);
      }
    }
  }
}

/// The table, column by column.
struct Columns
{
  vtkNew<vtkStringArray> Block;
  vtkNew<vtkIntArray> Group;
  vtkNew<vtkStringArray> GroupName;
  vtkNew<vtkStringArray> Array;
  vtkNew<vtkIntArray> Component;
  std::vector<std::pair<const char*, vtkSmartPointer<vtkDoubleArray>>> Numbers;
  vtkNew<vtkIdTypeArray> Cells;

  Columns()
  {
    this->Block->SetName("Block");
    this->Group->SetName("Group");
    this->GroupName->SetName("GroupName");
    this->Array->SetName("Array");
    this->Component->SetName("Component");
    this->Cells->SetName("Cells");
    for (const char* name :
      { "Area", "Minimum", "Mean", "Maximum", "U0", "Ud", "Flux", "ShareAbove" })
    {
      this->Numbers.emplace_back(name, vtkSmartPointer<vtkDoubleArray>::New());
      this->Numbers.back().second->SetName(name);
    }
  }

  void Add(const std::string& block, const Entries& entries, const std::vector<std::string>& order)
  {
    // By array as they were asked for, then by group, then by component.
    for (const std::string& array : order)
    {
      for (const auto& [key, entry] : entries)
      {
        const AreaStatistics s = entry.Values.Result();
        if (key.Array != array || s.Pieces == 0)
        {
          continue;
        }
        this->Block->InsertNextValue(block);
        this->Group->InsertNextValue(static_cast<int>(key.Group));
        this->GroupName->InsertNextValue(entry.Name);
        this->Array->InsertNextValue(array);
        this->Component->InsertNextValue(key.Component);
        this->Cells->InsertNextValue(entry.Cells);
        const double values[] = { s.Area, s.Minimum, s.Mean, s.Maximum, s.U0(), s.Ud(), s.Flux,
          s.ShareAbove() };
        for (std::size_t i = 0; i < this->Numbers.size(); ++i)
        {
          this->Numbers[i].second->InsertNextValue(values[i]);
        }
      }
    }
  }

  void Give(vtkTable* table) const
  {
    table->AddColumn(this->Block);
    table->AddColumn(this->Group);
    table->AddColumn(this->GroupName);
    table->AddColumn(this->Array);
    table->AddColumn(this->Component);
    for (const auto& number : this->Numbers)
    {
      table->AddColumn(number.second);
    }
    table->AddColumn(this->Cells);
  }
};

} // namespace

vtkRadiometricStatistics::vtkRadiometricStatistics() = default;

vtkRadiometricStatistics::~vtkRadiometricStatistics()
{
  this->SetGroupArray(nullptr);
}

void vtkRadiometricStatistics::AddArrayName(const char* name)
{
  if (name && *name)
  {
    this->ArrayNames.emplace_back(name);
    this->Modified();
  }
}

void vtkRadiometricStatistics::ClearArrayNames()
{
  this->ArrayNames.clear();
  this->Modified();
}

void vtkRadiometricStatistics::SetArrayName(const char* name)
{
  this->ClearArrayNames();
  this->AddArrayName(name);
}

int vtkRadiometricStatistics::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

int vtkRadiometricStatistics::RequestData(
  vtkInformation*, vtkInformationVector** in, vtkInformationVector* out)
{
  vtkDataObject* input = vtkDataObject::GetData(in[0]);
  vtkTable* output = vtkTable::GetData(out);
  output->Initialize();
  try
  {
    if (!(this->MetersPerUnit > 0.0) || !std::isfinite(this->MetersPerUnit))
    {
      throw InputError("MetersPerUnit", -1, this->MetersPerUnit, "a finite number above 0");
    }
    const auto blocks = SurfaceBlocks(input);
    const std::vector<std::string> names =
      this->ArrayNames.empty() ? ResultNames(blocks) : this->ArrayNames;
    const bool composite = vtkCompositeDataSet::SafeDownCast(input) != nullptr;
    bool anyCells = false;
    std::set<std::string> found;
    bool groupFound = false;
    Entries whole;
    std::vector<std::pair<std::string, Entries>> parts;
    for (const auto& [name, surface] : blocks)
    {
      anyCells = anyCells || surface->GetNumberOfCells() > 0;
      groupFound = groupFound ||
        (this->GroupArray && surface->GetCellData()->GetArray(this->GroupArray) != nullptr);
      const std::vector<Piece> pieces = Pieces(surface, this->MetersPerUnit);
      parts.emplace_back(name, Entries());
      for (const std::string& array : names)
      {
        if (FindField(surface, array).Array)
        {
          found.insert(array);
        }
        Collect(surface, pieces, array, this->GroupArray, this->Threshold, parts.back().second,
          composite ? &whole : nullptr);
      }
    }
    for (const std::string& array : names)
    {
      if (anyCells && found.count(array) == 0)
      {
        throw InputError(array, -1, "missing", "a cell or point array of the surface");
      }
    }
    if (anyCells && this->GroupArray && *this->GroupArray && !groupFound)
    {
      throw InputError(this->GroupArray, -1, "missing", "an integer cell array of the surface");
    }
    Columns columns;
    columns.Add("(all)", whole, names);
    for (const auto& [name, entries] : parts)
    {
      columns.Add(name, entries, names);
    }
    columns.Give(output);
    vtkNew<vtkDoubleArray> threshold;
    threshold->SetName("Threshold");
    threshold->InsertNextValue(this->Threshold);
    output->GetFieldData()->AddArray(threshold);
  }
  catch (const InputError& error)
  {
    vtkErrorMacro(<< error.what());
    output->Initialize();
    return 0;
  }
  return 1;
}

void vtkRadiometricStatistics::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ArrayNames:";
  for (const std::string& name : this->ArrayNames)
  {
    os << " " << name;
  }
  os << "\n";
  os << indent << "GroupArray: " << (this->GroupArray ? this->GroupArray : "(none)") << "\n";
  os << indent << "Threshold: " << this->Threshold << "\n";
  os << indent << "MetersPerUnit: " << this->MetersPerUnit << "\n";
}
