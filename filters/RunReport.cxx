// SPDX-License-Identifier: BSD-3-Clause
#include "RunReport.h"

#include "radiometry/scene/ArrayNames.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <cstddef>
#include <iterator>

namespace
{

template <typename Array>
Array* AddColumn(vtkTable* table, const char* name)
{
  vtkNew<Array> column;
  column->SetName(name);
  table->AddColumn(column);
  return column; // kept alive by the table
}

} // namespace

void PlanReport::Add(const std::vector<radiometry::EffectDecision>& effects)
{
  for (std::size_t k = 0; k < effects.size(); ++k)
  {
    const radiometry::EffectDecision& d = effects[k];
    const auto effect = static_cast<radiometry::Effect>(k);
    if (d.Known)
    {
      this->Rows.push_back({ radiometry::EffectName(effect),
        radiometry::HasSwitch(effect) ? radiometry::SwitchName(d.Wish) : "",
        radiometry::DecisionName(d), d.Bound, d.Seconds, d.Why });
      this->Lines.push_back(radiometry::Explain(effect, d, this->Unit));
    }
  }
}

void PlanReport::AddDropped(const std::string& name, const std::string& why, double bound)
{
  radiometry::EffectDecision row;
  row.Present = row.Dropped = true;
  row.Why = why;
  row.Bound = bound;
  this->Rows.push_back({ name, "", radiometry::DecisionName(row), bound, 0.0, why });
  this->Lines.push_back(radiometry::Explain(name, row, this->Unit));
}

void PlanReport::AddEstimate(const std::string& name, const std::string& what, double value)
{
  this->Rows.push_back({ name, "", "estimated", value, 0.0, what });
}

void PlanReport::Write(vtkTable* table) const
{
  auto* effect = AddColumn<vtkStringArray>(table, "Effect");
  auto* switches = AddColumn<vtkStringArray>(table, "Switch");
  auto* decision = AddColumn<vtkStringArray>(table, "Decision");
  auto* bound = AddColumn<vtkDoubleArray>(table, "Bound");
  auto* unit = AddColumn<vtkStringArray>(table, "Unit");
  auto* seconds = AddColumn<vtkDoubleArray>(table, "Seconds");
  auto* why = AddColumn<vtkStringArray>(table, "Why");
  for (const Row& row : this->Rows)
  {
    effect->InsertNextValue(row.Effect);
    switches->InsertNextValue(row.Switch);
    decision->InsertNextValue(row.Decision);
    bound->InsertNextValue(row.Bound);
    unit->InsertNextValue(this->Unit);
    seconds->InsertNextValue(row.Seconds);
    why->InsertNextValue(row.Why);
  }
}

std::string PlanReport::Text() const
{
  std::string text;
  for (const std::string& line : this->Lines)
  {
    text += line + '\n';
  }
  return text;
}

void WriteConvergence(const radiometry::ConvergenceRecord& record, vtkTable* table)
{
  auto* seconds = AddColumn<vtkDoubleArray>(table, "Seconds");
  auto* relative = AddColumn<vtkDoubleArray>(table, "EstimatedError");
  auto* absolute = AddColumn<vtkDoubleArray>(table, "AbsoluteError");
  auto* samples = AddColumn<vtkIdTypeArray>(table, "Samples");
  auto* stage = AddColumn<vtkStringArray>(table, "Stage");
  std::vector<vtkDoubleArray*> parts;
  for (const std::string& name : record.PartNames)
  {
    parts.push_back(
      AddColumn<vtkDoubleArray>(table, (name + radiometry::names::ErrorSuffix).c_str()));
  }
  for (const auto& row : record.Rows)
  {
    for (std::size_t k = 0; k < parts.size(); ++k)
    {
      parts[k]->InsertNextValue(k < row.Parts.size() ? row.Parts[k] : 0.0);
    }
    seconds->InsertNextValue(row.Seconds);
    relative->InsertNextValue(row.RelativeError);
    absolute->InsertNextValue(row.AbsoluteError);
    samples->InsertNextValue(row.Samples);
    stage->InsertNextValue(row.Stage);
  }
}

void AddRunCost(const radiometry::RunCost& cost, vtkFieldData* data)
{
  const std::pair<const char*, double> numbers[] = { { "Seconds", cost.Seconds },
    { "PredictedSeconds", cost.PredictedSeconds }, { "PredictedAt", cost.PredictedAt },
    { "Samples", static_cast<double>(cost.Samples) },
    { "MemoryMiB", static_cast<double>(cost.Bytes) / 1048576.0 } };
  vtkNew<vtkDoubleArray> array;
  array->SetName("RadiometryCost");
  array->SetNumberOfComponents(static_cast<int>(std::size(numbers)));
  array->SetNumberOfTuples(1);
  for (int k = 0; k < array->GetNumberOfComponents(); ++k)
  {
    array->SetComponentName(k, numbers[k].first);
    array->SetTypedComponent(0, k, numbers[k].second);
  }
  data->AddArray(array);
}
