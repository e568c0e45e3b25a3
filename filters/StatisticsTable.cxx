// SPDX-License-Identifier: BSD-3-Clause
#include "StatisticsTable.h"

#include "SurfaceBlocks.h"
#include "radiometry/scene/InputError.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <sstream>

namespace
{

constexpr long long everyGroup = -1;

/// The table, column by column.
struct Columns
{
  vtkNew<vtkStringArray> Block;
  vtkNew<vtkIntArray> Group;
  vtkNew<vtkStringArray> GroupName;
  vtkNew<vtkStringArray> Array;
  vtkNew<vtkIntArray> Component;
  std::vector<vtkSmartPointer<vtkDoubleArray>> Numbers;
  vtkNew<vtkIdTypeArray> Cells;

  std::vector<double> Percentiles;

  Columns(const std::vector<double>& thresholds, const std::vector<double>& percentiles)
    : Percentiles(percentiles)
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
      this->AddNumber(name);
    }
    for (std::size_t k = 1; k < thresholds.size(); ++k)
    {
      std::ostringstream name;
      name << "ShareAbove " << thresholds[k];
      this->AddNumber(name.str());
    }
    for (const double percentile : percentiles)
    {
      std::ostringstream name;
      name << "P" << percentile;
      this->AddNumber(name.str());
    }
  }

  void AddNumber(const std::string& name)
  {
    this->Numbers.push_back(vtkSmartPointer<vtkDoubleArray>::New());
    this->Numbers.back()->SetName(name.c_str());
  }

  void Add(const std::string& block, const StatisticsKey& key, const StatisticsEntry& entry)
  {
    const radiometry::AreaStatistics s = entry.Values.front().Result();
    this->Block->InsertNextValue(block);
    this->Group->InsertNextValue(static_cast<int>(key.Group));
    this->GroupName->InsertNextValue(entry.Name);
    this->Array->InsertNextValue(key.Array);
    this->Component->InsertNextValue(key.Component);
    this->Cells->InsertNextValue(entry.Cells);
    std::vector<double> values{ s.Area, s.Minimum, s.Mean, s.Maximum, s.U0(), s.Ud(), s.Flux };
    for (const radiometry::AreaStatisticsCollector& collector : entry.Values)
    {
      values.push_back(collector.Result().ShareAbove());
    }
    for (const double percentile : this->Percentiles)
    {
      values.push_back(entry.Quantiles.At(percentile / 100.0));
    }
    for (std::size_t i = 0; i < this->Numbers.size(); ++i)
    {
      this->Numbers[i]->InsertNextValue(values[i]);
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
      table->AddColumn(number);
    }
    table->AddColumn(this->Cells);
  }
};

} // namespace

void StatisticsEntry::Add(
  const StatisticsField& field, const SurfacePiece& piece, int component)
{
  if (field.OnCells)
  {
    const double value = field.Value(piece.Cell, component);
    for (radiometry::AreaStatisticsCollector& collector : this->Values)
    {
      collector.AddConstant(piece.Area, value);
    }
    if (this->KeepPieces)
    {
      this->Quantiles.AddConstant(piece.Area, value);
    }
  }
  else
  {
    std::array<double, 3> v{};
    for (int k = 0; k < 3; ++k)
    {
      v[k] = field.Value(piece.Points[k], component);
    }
    for (radiometry::AreaStatisticsCollector& collector : this->Values)
    {
      collector.AddLinear(piece.Area, v[0], v[1], v[2]);
    }
    if (this->KeepPieces)
    {
      this->Quantiles.AddLinear(piece.Area, v[0], v[1], v[2]);
    }
  }
  if (this->LastCell != piece.Cell)
  {
    this->LastCell = piece.Cell;
    ++this->Cells;
  }
}

void StatisticsTable::Add(const StatisticsBlock& block, const std::vector<SurfacePiece>& pieces,
  const std::vector<std::string>& arrays)
{
  this->Parts.emplace_back(block.Name, Entries());
  for (const std::string& array : arrays)
  {
    if (FindField(block.Data, array).Array)
    {
      this->AddArray(block, pieces, array, this->Parts.back().second);
    }
  }
}

void StatisticsTable::AddArray(const StatisticsBlock& block,
  const std::vector<SurfacePiece>& pieces, const std::string& array, Entries& part)
{
  const StatisticsField field = FindField(block.Data, array);
  vtkDataArray* groups = this->GroupArray.empty()
    ? nullptr
    : block.Data->GetCellData()->GetArray(this->GroupArray.c_str());
  const int components = field.Array->GetNumberOfComponents();
  for (int c = components == 3 ? weightedComponent : 0; c < components; ++c)
  {
    const auto entryOf = [&](Entries& entries, long long group) -> StatisticsEntry& {
      return entries
        .emplace(StatisticsKey{ group, array, c }, StatisticsEntry(this->Thresholds, !this->Percentiles.empty()))
        .first->second;
    };
    StatisticsEntry& all = entryOf(part, everyGroup);
    StatisticsEntry* total = this->WithWhole ? &entryOf(this->Whole, everyGroup) : nullptr;
    if (total)
    {
      total->LastCell = -1;
    }
    for (const SurfacePiece& piece : pieces)
    {
      all.Add(field, piece, c);
      if (total)
      {
        total->Add(field, piece, c);
      }
      if (groups)
      {
        const auto group = static_cast<long long>(groups->GetComponent(piece.Cell, 0));
        if (group < 0)
        {
          throw radiometry::InputError(
            this->GroupArray, piece.Cell, static_cast<double>(group), "0 or more");
        }
        StatisticsEntry& entry = entryOf(part, group);
        if (entry.Cells == 0)
        {
          entry.Name = ValueName(block.Data, this->GroupArray, group);
        }
        entry.Add(field, piece, c);
      }
    }
  }
}

void StatisticsTable::Write(const std::vector<std::string>& arrays, vtkTable* table) const
{
  Columns columns(this->Thresholds, this->Percentiles);
  const auto add = [&](const std::string& block, const Entries& entries) {
    for (const std::string& array : arrays)
    {
      for (const auto& [key, entry] : entries)
      {
        if (key.Array == array && entry.Cells > 0)
        {
          columns.Add(block, key, entry);
        }
      }
    }
  };
  add("(all)", this->Whole);
  for (const auto& [name, entries] : this->Parts)
  {
    add(name, entries);
  }
  columns.Give(table);
  vtkNew<vtkDoubleArray> thresholds;
  thresholds->SetName("Threshold");
  for (const double threshold : this->Thresholds)
  {
    thresholds->InsertNextValue(threshold);
  }
  table->GetFieldData()->AddArray(thresholds);
}
