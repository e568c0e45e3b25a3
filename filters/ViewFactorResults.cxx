// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactorResults.h"

#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>

namespace names = radiometry::names;
using radiometry::InputError;

namespace
{

constexpr vtkIdType EnvironmentId = -1;
constexpr vtkIdType BlockedId = -2;

/// The patch array of a block, checked.
vtkDataArray* FindPatches(const SceneAdapter::Block& block, const std::string& name)
{
  vtkAbstractArray* found = block.Data->GetCellData()->GetAbstractArray(name.c_str());
  const std::string label = block.Name + name;
  if (!found)
  {
    const bool points = block.Data->GetPointData()->GetAbstractArray(name.c_str()) != nullptr;
    throw InputError(
      label, -1, points ? "point data" : "missing", "an integer array of the cells (PatchArray)");
  }
  auto* array = vtkDataArray::SafeDownCast(found);
  if (!array || array->GetNumberOfComponents() != 1)
  {
    throw InputError(label, -1,
      !array ? std::string("not of numbers") : std::to_string(array->GetNumberOfComponents()) +
          " components",
      "one integer a cell (PatchArray)");
  }
  return array;
}

vtkIdType PatchOf(vtkDataArray* array, vtkIdType cell, const std::string& label)
{
  const double value = array->GetTuple1(cell);
  if (!(std::abs(value) < 9e15) || value != std::floor(value))
  {
    throw InputError(label, cell, value, "an integer (PatchArray); below 0: no patch");
  }
  return static_cast<vtkIdType>(value);
}

/// The leaves in the order in which SceneAdapter saw them.
std::vector<vtkPolyData*> MakeLeaves(vtkDataObject* output, vtkDataObject* input)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(output);
  if (!composite)
  {
    return { vtkPolyData::SafeDownCast(output) };
  }
  std::vector<vtkPolyData*> leaves;
  auto* source = vtkCompositeDataSet::SafeDownCast(input);
  composite->CopyStructure(source);
  auto iterator = vtk::TakeSmartPointer(source->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    vtkNew<vtkPolyData> leaf;
    composite->SetDataSet(iterator, leaf);
    leaves.push_back(leaf); // kept alive by the composite
  }
  return leaves;
}

void AddString(vtkFieldData* data, const char* name, const std::string& value)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  data->AddArray(array);
}

void AddNumber(vtkFieldData* data, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  data->AddArray(array);
}

template <typename Array>
Array* AddColumn(vtkTable* table, const char* name)
{
  vtkNew<Array> column;
  column->SetName(name);
  table->AddColumn(column);
  return column; // kept alive by the table
}

} // namespace

SurfacePatches::SurfacePatches(
  const std::vector<SceneAdapter::Block>& blocks, const std::string& name)
{
  std::size_t cells = 0;
  for (const SceneAdapter::Block& block : blocks)
  {
    for (vtkIdType c = 0; c < block.Cells; ++c)
    {
      cells = std::max(cells, static_cast<std::size_t>(block.Number(c) + 1));
    }
  }
  this->OfCell.assign(cells, -1);
  if (name.empty())
  {
    for (std::size_t c = 0; c < cells; ++c)
    {
      this->OfCell[c] = static_cast<std::int32_t>(c);
      this->Ids.push_back(static_cast<vtkIdType>(c));
    }
    return;
  }
  std::vector<vtkIdType> id(cells, -1);
  for (const SceneAdapter::Block& block : blocks)
  {
    if (block.Cells == 0 || block.Sensors)
    {
      continue;
    }
    vtkDataArray* array = FindPatches(block, name);
    for (vtkIdType c = 0; c < block.Cells; ++c)
    {
      if (block.Number(c) >= 0)
      {
        id[static_cast<std::size_t>(block.Number(c))] = PatchOf(array, c, block.Name + name);
      }
    }
  }
  std::copy_if(id.begin(), id.end(), std::back_inserter(this->Ids),
    [](vtkIdType value) { return value >= 0; });
  std::sort(this->Ids.begin(), this->Ids.end());
  this->Ids.erase(std::unique(this->Ids.begin(), this->Ids.end()), this->Ids.end());
  for (std::size_t c = 0; c < cells; ++c)
  {
    if (id[c] >= 0)
    {
      this->OfCell[c] = static_cast<std::int32_t>(
        std::lower_bound(this->Ids.begin(), this->Ids.end(), id[c]) - this->Ids.begin());
    }
  }
}

void ViewFactorResults::AddCells(const SceneAdapter::Block& block, vtkPolyData* leaf) const
{
  const vtkIdType count = leaf->GetNumberOfCells();
  const auto add = [&](const std::string& name, const std::vector<double>& values) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfTuples(count);
    for (vtkIdType c = 0; c < count; ++c)
    {
      const std::int32_t cell = block.Number(c);
      const std::int32_t patch =
        cell < 0 ? -1 : this->Patches.OfCell[static_cast<std::size_t>(cell)];
      array->SetValue(c, patch < 0 ? 0.0 : values[static_cast<std::size_t>(patch)]);
    }
    leaf->GetCellData()->AddArray(array);
  };
  const auto share = [&](const char* name, const radiometry::ViewFactorShare& values) {
    add(name, values.Value);
    add(std::string(name) + names::ErrorSuffix, values.Error);
  };
  share("ViewFactorSum", this->Result.Sum);
  share("EnvironmentViewFactor", this->Result.Environment);
  share("SkyViewFactor", this->Result.Sky);
  share("GroundViewFactor", this->Result.Ground);
  share("BlockedViewFactor", this->Result.Blocked);
  add("ClosureDefect", this->Result.ClosureDefect);
  leaf->GetCellData()->SetActiveScalars("SkyViewFactor");
}

void ViewFactorResults::AddFieldData(vtkDataObject* object) const
{
  vtkFieldData* data = object->GetFieldData();
  AddString(data, "RadiometryUnits", "view factors [1]; PatchAreas [m^2]");
  AddString(data, "RadiometryVersion", VTKRADIOMETRY_VERSION);
  AddString(data, "RadiometryOptions", "vtkViewFactorFilter: " + this->Options);
  AddString(data, "RadiometryOutcome", this->Result.Outcome);
  AddString(data, "RadiometryMethod", this->Result.Method);
  AddRunCost(this->Result.Cost, data);
  vtkNew<vtkStringArray> lines;
  lines->SetName(names::EffectPlan);
  for (const std::string& line : this->Plan.Sentences())
  {
    lines->InsertNextValue(line);
  }
  data->AddArray(lines);
  AddNumber(data, "ClosureDefectBefore", this->Result.ClosureBefore);
  AddNumber(data, "ClosureDefectAfter", this->Result.ClosureAfter);
  AddNumber(data, "ReciprocityDefectBefore", this->Result.ReciprocityBefore);
  AddNumber(data, "ReciprocityDefectAfter", this->Result.ReciprocityAfter);
  AddNumber(data, "LargestCorrection", this->Result.LargestCorrection);
  AddNumber(data, "LargestViewFactorSum", this->Result.LargestSum);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("PatchIds");
  vtkNew<vtkDoubleArray> areas;
  areas->SetName("PatchAreas");
  for (std::size_t k = 0; k < this->Patches.Ids.size(); ++k)
  {
    ids->InsertNextValue(this->Patches.Ids[k]);
    areas->InsertNextValue(this->Result.Areas[k]);
  }
  data->AddArray(ids);
  data->AddArray(areas);
}

void ViewFactorResults::WriteSurface(const std::vector<SceneAdapter::Block>& blocks,
  vtkDataObject* output, vtkDataObject* input) const
{
  const std::vector<vtkPolyData*> leaves = MakeLeaves(output, input);
  for (std::size_t k = 0; k < leaves.size() && k < blocks.size(); ++k)
  {
    leaves[k]->ShallowCopy(blocks[k].Data);
    this->AddCells(blocks[k], leaves[k]);
    this->AddFieldData(leaves[k]);
  }
}

void ViewFactorResults::WriteTable(bool environmentRows, vtkTable* table) const
{
  auto* from = AddColumn<vtkIdTypeArray>(table, "From");
  auto* to = AddColumn<vtkIdTypeArray>(table, "To");
  auto* value = AddColumn<vtkDoubleArray>(table, "ViewFactor");
  auto* error = AddColumn<vtkDoubleArray>(table, "ViewFactorError");
  const auto add = [&](vtkIdType i, vtkIdType j, double f, double e) {
    from->InsertNextValue(i);
    to->InsertNextValue(j);
    value->InsertNextValue(f);
    error->InsertNextValue(e);
  };
  std::size_t next = 0;
  for (std::size_t patch = 0; patch < this->Patches.Ids.size(); ++patch)
  {
    const vtkIdType id = this->Patches.Ids[patch];
    if (environmentRows && this->Result.Areas[patch] > 0.0)
    {
      const auto other = [&](vtkIdType name, const radiometry::ViewFactorShare& share) {
        if (share.Value[patch] > 0.0)
        {
          add(id, name, share.Value[patch], share.Error[patch]);
        }
      };
      other(BlockedId, this->Result.Blocked);
      other(EnvironmentId, this->Result.Environment);
    }
    for (; next < this->Result.Rows.size() &&
         this->Result.Rows[next].From == static_cast<std::int32_t>(patch);
         ++next)
    {
      const radiometry::ViewFactorRow& row = this->Result.Rows[next];
      add(id, this->Patches.Ids[static_cast<std::size_t>(row.To)], row.Value, row.Error);
    }
  }
  this->AddFieldData(table);
}

PlanReport ReportPlan(const radiometry::ViewFactorResult& result,
  const std::array<radiometry::EffectSwitch, 2>& switches, bool backs, bool panes)
{
  using radiometry::Effect;
  std::vector<radiometry::EffectSwitch> wishes(radiometry::EffectCount);
  wishes[static_cast<std::size_t>(Effect::Occlusion)] = switches[0];
  wishes[static_cast<std::size_t>(Effect::BackFaces)] = switches[1];
  radiometry::EffectPlan plan(wishes, "1");
  plan.Decide(Effect::Occlusion, result.OcclusionNeeded, true,
    "nothing stands between any two points of the surfaces", "surfaces may stand between others");
  plan.Decide(
    Effect::BackFaces, backs, true, "no cell is two-sided", "two-sided cells see with both sides");
  plan.Decide(Effect::Transmission, panes, false, "all surfaces are opaque",
    "a view factor takes every surface as opaque");
  const std::pair<Effect, double> bounds[] = { { Effect::Occlusion, result.OcclusionBound },
    { Effect::BackFaces, 1.0 }, { Effect::Transmission, 1.0 } };
  for (const auto& [effect, bound] : bounds)
  {
    plan[effect].Bound = plan.LeavesOut(effect) ? bound : 0.0;
  }
  PlanReport report(plan.BoundUnit());
  report.Add(plan.Decisions());
  report.AddEstimate("Error: form factors",
    "truncation and rounding, in the mean over what is exchanged, relative", result.MeanTruncation);
  report.AddEstimate("Error: visibility",
    "samples, in the mean over what is exchanged, relative", result.MeanSampling);
  return report;
}
