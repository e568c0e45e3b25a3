// SPDX-License-Identifier: BSD-3-Clause
#include "StudyRun.h"

#include "StatisticsBlocks.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"
#include "vtkRadianceFilter.h"
#include "vtkRadiometricFilter.h"
#include "vtkViewFactorFilter.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <cmath>

namespace names = radiometry::names;
using radiometry::InputError;

namespace
{

constexpr char PartMark[] = "Error: "; // before a part of the error in the EffectPlan

/// The shares of the items of a field in the area of the pieces.
std::vector<double> Weights(
  const std::vector<SurfacePiece>& pieces, const StatisticsField& field)
{
  std::vector<double> weights(static_cast<std::size_t>(field.Array->GetNumberOfTuples()), 0.0);
  for (const SurfacePiece& piece : pieces)
  {
    if (field.OnCells)
    {
      weights[static_cast<std::size_t>(piece.Cell)] += piece.Area;
      continue;
    }
    for (const vtkIdType point : piece.Points)
    {
      if (point >= 0)
      {
        weights[static_cast<std::size_t>(point)] += piece.Area / 3.0;
      }
    }
  }
  return weights;
}

void Append(vtkDataArray* array, const std::string& label, std::vector<double>& values)
{
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    for (int b = 0; b < array->GetNumberOfComponents(); ++b)
    {
      values.push_back(array->GetComponent(i, b));
      if (!std::isfinite(values.back()))
      {
        throw InputError(label, i, values.back(), "a finite number");
      }
    }
  }
}

/// The output that is a table with that column, or null.
vtkTable* TableWith(vtkRadiometricAlgorithm* filter, const char* column)
{
  for (int port = 1; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(port));
    if (table && table->GetColumnByName(column))
    {
      return table;
    }
  }
  return nullptr;
}

std::string FieldWord(vtkFieldData* data, const char* name)
{
  auto* array = vtkStringArray::SafeDownCast(data->GetAbstractArray(name));
  return array && array->GetNumberOfValues() > 0 ? array->GetValue(0) : std::string();
}

void ReadCost(vtkFieldData* data, StudyRun& run)
{
  vtkDataArray* cost = data->GetArray("RadiometryCost");
  for (int k = 0; cost && cost->GetNumberOfTuples() > 0 && k < cost->GetNumberOfComponents(); ++k)
  {
    const std::string name = cost->GetComponentName(k) ? cost->GetComponentName(k) : "";
    if (name == "Samples")
    {
      run.Samples = cost->GetComponent(0, k);
    }
    else if (name == "MemoryMiB")
    {
      run.MemoryMiB = cost->GetComponent(0, k);
    }
  }
}

void ReadPlan(vtkTable* plan, StudyRun& run)
{
  auto* effects = vtkStringArray::SafeDownCast(plan->GetColumnByName("Effect"));
  auto* decisions = vtkStringArray::SafeDownCast(plan->GetColumnByName("Decision"));
  auto* bounds = vtkDataArray::SafeDownCast(plan->GetColumnByName("Bound"));
  for (vtkIdType k = 0; effects && decisions && bounds && k < plan->GetNumberOfRows(); ++k)
  {
    const std::string effect = effects->GetValue(k);
    if (effect.rfind(PartMark, 0) == 0)
    {
      run.Parts.emplace_back(effect, bounds->GetComponent(k, 0));
    }
    else if (decisions->GetValue(k) == "simulated")
    {
      run.Effects += (run.Effects.empty() ? "" : ", ") + effect;
    }
  }
}

} // namespace

std::string FirstQuantity(vtkRadiometricAlgorithm* filter)
{
  if (vtkViewFactorFilter::SafeDownCast(filter))
  {
    return "ViewFactorSum";
  }
  return vtkRadianceFilter::SafeDownCast(filter) ? names::Radiance : names::Irradiance;
}

radiometry::StatedValues ReadStatedValues(
  vtkDataObject* surface, const std::string& array, double metersPerUnit, const std::string& whose)
{
  radiometry::StatedValues all;
  all.Bands = 0;
  bool anyCells = false;
  for (const StatisticsBlock& block : StatisticsBlocks(surface))
  {
    anyCells = anyCells || block.Data->GetNumberOfCells() > 0;
    const StatisticsField field = FindField(block.Data, array);
    if (!field.Array || field.Array->GetNumberOfTuples() == 0)
    {
      continue;
    }
    const std::string label = whose + block.Name + (block.Name.empty() ? "" : " ") + array;
    const int bands = field.Array->GetNumberOfComponents();
    if (all.Bands != 0 && bands != all.Bands)
    {
      throw InputError(
        label, -1, std::to_string(bands) + " components", std::to_string(all.Bands));
    }
    all.Bands = bands;
    const StatisticsField error = FindField(block.Data, array + names::ErrorSuffix);
    if (error.Array &&
      (error.OnCells != field.OnCells || error.Array->GetNumberOfComponents() != bands))
    {
      throw InputError(label + names::ErrorSuffix, -1,
        std::to_string(error.Array->GetNumberOfComponents()) + " components",
        std::to_string(bands) + ", on the same cells or points");
    }
    Append(field.Array, label, all.Values);
    if (error.Array)
    {
      all.Errors.resize(all.Values.size() -
        static_cast<std::size_t>(field.Array->GetNumberOfTuples() * bands));
      Append(error.Array, label + names::ErrorSuffix, all.Errors);
    }
    const std::vector<double> weights = Weights(block.Pieces(metersPerUnit), field);
    all.Weights.insert(all.Weights.end(), weights.begin(), weights.end());
  }
  if (all.Bands == 0)
  {
    if (anyCells)
    {
      throw InputError(whose + array, -1, "missing", "a cell or point array of the surface (Array)");
    }
    all.Bands = 1;
  }
  if (!all.Errors.empty())
  {
    all.Errors.resize(all.Values.size());
  }
  return all;
}

void ReadReport(vtkRadiometricAlgorithm* filter, vtkDataObject* surface, StudyRun& run)
{
  run.PredictedSeconds = filter->GetPredictedSeconds();
  for (const StatisticsBlock& block : StatisticsBlocks(surface))
  {
    vtkFieldData* data = block.Data->GetFieldData();
    if (run.Outcome.empty())
    {
      run.Outcome = FieldWord(data, "RadiometryOutcome");
      run.Method = FieldWord(data, "RadiometryMethod");
      ReadCost(data, run);
    }
  }
  if (vtkTable* plan = TableWith(filter, "Decision"))
  {
    ReadPlan(plan, run);
  }
  vtkTable* record = TableWith(filter, "EstimatedError");
  vtkDataArray* samples =
    record ? vtkDataArray::SafeDownCast(record->GetColumnByName("Samples")) : nullptr;
  if (run.Samples < 0.0 && samples && samples->GetNumberOfTuples() > 0)
  {
    run.Samples = samples->GetComponent(samples->GetNumberOfTuples() - 1, 0);
  }
}
