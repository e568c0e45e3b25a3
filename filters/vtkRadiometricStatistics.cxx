// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiometricStatistics.h"

#include "ControllerCommunicator.h"
#include "IsoLinePolyData.h"
#include "StatisticsBlocks.h"
#include "StatisticsGathering.h"
#include "StatisticsTable.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include "vtkAppendPolyData.h"
#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkRadiometricStatistics);

using radiometry::InputError;

namespace
{

bool AnyHas(const std::vector<StatisticsBlock>& blocks, const std::string& array)
{
  return std::any_of(blocks.begin(), blocks.end(),
    [&](const StatisticsBlock& block) { return FindField(block.Data, array).Array != nullptr; });
}

bool AnyGroups(const std::vector<StatisticsBlock>& blocks, const std::string& array)
{
  return std::any_of(blocks.begin(), blocks.end(), [&](const StatisticsBlock& block) {
    return block.Data->GetCellData()->GetArray(array.c_str()) != nullptr;
  });
}

/// A chosen array; empty: none. ParaView's menus say None for that.
std::string Chosen(const char* name)
{
  const std::string chosen = name ? name : "";
  return chosen == "None" ? "" : chosen;
}

/// The array of which lines are drawn when none is named.
std::string PreferredArray(const std::vector<std::string>& arrays)
{
  for (const char* name : { radiometry::names::Illuminance, radiometry::names::Irradiance })
  {
    if (std::find(arrays.begin(), arrays.end(), name) != arrays.end())
    {
      return name;
    }
  }
  return arrays.empty() ? std::string() : arrays.front();
}

void CheckFinite(const char* name, const std::vector<double>& values)
{
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    if (!std::isfinite(values[k]))
    {
      throw InputError(name, static_cast<long long>(k), values[k], "a finite number");
    }
  }
}

/// All grids of sensors as cells.
void WriteSensorCells(const std::vector<StatisticsBlock>& blocks, vtkPolyData* output)
{
  vtkNew<vtkAppendPolyData> append;
  vtkPolyData* only = nullptr;
  for (const StatisticsBlock& block : blocks)
  {
    if (block.Sensors)
    {
      append->AddInputData(block.Data);
      only = block.Data;
    }
  }
  if (append->GetNumberOfInputConnections(0) == 1)
  {
    output->ShallowCopy(only);
  }
  else if (only)
  {
    append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    append->Update();
    output->ShallowCopy(append->GetOutput());
  }
}

} // namespace

vtkRadiometricStatistics::vtkRadiometricStatistics()
{
  this->SetNumberOfOutputPorts(4);
  this->Controller = vtkMultiProcessController::GetGlobalController();
}

void vtkRadiometricStatistics::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

vtkMultiProcessController* vtkRadiometricStatistics::GetController()
{
  return this->Controller;
}

std::vector<std::string> vtkRadiometricStatistics::ArraysRead() const
{
  namespace names = radiometry::names;
  std::vector<std::string> arrays = this->ArrayNames;
  for (const std::string& name : ResultQuantities())
  {
    if (this->ArrayNames.empty())
    {
      arrays.push_back(name);
    }
  }
  for (const std::string& name : { Chosen(this->GroupArray), Chosen(this->IsolineArray),
         std::string(names::SensorCell), std::string(names::Normals) })
  {
    arrays.push_back(name);
  }
  return arrays;
}

vtkRadiometricStatistics::~vtkRadiometricStatistics()
{
  this->SetGroupArray(nullptr);
  this->SetIsolineArray(nullptr);
}

void vtkRadiometricStatistics::AddThreshold(double threshold)
{
  this->MoreThresholds.push_back(threshold);
  this->Modified();
}

void vtkRadiometricStatistics::ClearThresholds()
{
  this->MoreThresholds.clear();
  this->Modified();
}

void vtkRadiometricStatistics::AddPercentile(double percentile)
{
  this->Percentiles.push_back(percentile);
  this->Modified();
}

void vtkRadiometricStatistics::ClearPercentiles()
{
  this->Percentiles.clear();
  this->Modified();
}

void vtkRadiometricStatistics::AddIsovalue(double value)
{
  this->Isovalues.push_back(value);
  this->Modified();
}

void vtkRadiometricStatistics::ClearIsovalues()
{
  this->Isovalues.clear();
  this->Modified();
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

int vtkRadiometricStatistics::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port % 2 == 0 ? "vtkTable" : "vtkPolyData");
  return 1;
}

void vtkRadiometricStatistics::Describe(vtkDataObject* input, vtkInformationVector* out) const
{
  if (!(this->MetersPerUnit > 0.0) || !std::isfinite(this->MetersPerUnit))
  {
    throw InputError("MetersPerUnit", -1, this->MetersPerUnit, "a finite number above 0");
  }
  std::vector<double> thresholds{ this->Threshold };
  thresholds.insert(thresholds.end(), this->MoreThresholds.begin(), this->MoreThresholds.end());
  CheckFinite("Threshold", thresholds);
  CheckFinite("Isovalues", this->Isovalues);

  for (const double percentile : this->Percentiles)
  {
    if (!(percentile > 0.0 && percentile < 100.0))
    {
      throw InputError("Percentiles", -1, percentile, "a number in (0, 100)");
    }
  }

  const std::vector<StatisticsBlock> blocks = StatisticsBlocks(input);
  const std::vector<std::string> arrays =
    this->ArrayNames.empty() ? ResultNames(blocks) : this->ArrayNames;
  const std::string group = Chosen(this->GroupArray);
  std::string lineArray = Chosen(this->IsolineArray);
  const bool anyCells = std::any_of(blocks.begin(), blocks.end(),
    [](const StatisticsBlock& block) { return block.Data->GetNumberOfCells() > 0; });
  for (const std::string& array : arrays)
  {
    if (anyCells && !AnyHas(blocks, array))
    {
      throw InputError(array, -1, "missing", "a cell or point array of the surface");
    }
  }
  if (anyCells && !lineArray.empty() && !AnyHas(blocks, lineArray))
  {
    throw InputError(lineArray, -1, "missing", "a cell or point array of the surface");
  }
  if (anyCells && !group.empty() && !AnyGroups(blocks, group))
  {
    throw InputError(group, -1, "missing", "an integer cell array of the surface");
  }

  StatisticsTable table(thresholds, this->Percentiles, group, vtkCompositeDataSet::SafeDownCast(input) != nullptr);
  std::vector<std::vector<SurfacePiece>> pieces;
  for (const StatisticsBlock& block : blocks)
  {
    pieces.push_back(block.Pieces(this->MetersPerUnit));
    table.Add(block, pieces.back(), arrays);
  }
  table.Write(arrays, vtkTable::GetData(out, 0));
  lineArray = lineArray.empty() ? PreferredArray(arrays) : lineArray;
  if (this->GenerateIsolines && anyCells && !lineArray.empty())
  {
    IsoLines(lineArray, this->Isovalues, this->MetersPerUnit)
      .Write(blocks, pieces, vtkPolyData::GetData(out, 1), vtkTable::GetData(out, 2));
  }
  WriteSensorCells(blocks, vtkPolyData::GetData(out, 3));
}

int vtkRadiometricStatistics::RequestData(
  vtkInformation*, vtkInformationVector** in, vtkInformationVector* out)
{
  const auto clear = [&] {
    for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
    {
      vtkDataObject::GetData(out, port)->Initialize();
    }
  };
  clear();
  const auto ranks = ControllerCommunicator::Make(this->Controller);
  vtkSmartPointer<vtkDataObject> input = vtkDataObject::GetData(in[0]);
  try
  {
    if (ranks)
    {
      input = GatherForStatistics(*ranks, input, this->ArraysRead());
    }
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< ranks->Fail(error.what()));
    return 0;
  }
  try
  {
    if (input) // the first rank's
    {
      this->Describe(input, out);
    }
  }
  catch (const InputError& error)
  {
    clear();
    vtkErrorMacro(<< error.what());
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
  for (const double threshold : this->MoreThresholds)
  {
    os << indent << "Further threshold: " << threshold << "\n";
  }
  for (const double percentile : this->Percentiles)
  {
    os << indent << "Percentile: " << percentile << "\n";
  }
  os << indent << "GenerateIsolines: " << this->GenerateIsolines << "\n";
  os << indent << "IsolineArray: " << (this->IsolineArray ? this->IsolineArray : "(none)") << "\n";
  for (const double value : this->Isovalues)
  {
    os << indent << "Isovalue: " << value << "\n";
  }
  os << indent << "MetersPerUnit: " << this->MetersPerUnit << "\n";
}
