// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAccuracyStudy.h"

#include "ControllerCommunicator.h"
#include "StudyRuns.h"
#include "radiometry/scene/InputError.h"
#include "vtkRadiometricAlgorithm.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCompositeDataSet.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

vtkStandardNewMacro(vtkAccuracyStudy);

using radiometry::InputError;

namespace
{

constexpr int ReferencePort = 1;
constexpr int SurfacePort = 2;
constexpr int CurvesPort = 3;

/// A list, checked, in the order of the runs, without repetitions.
std::vector<double> Levels(std::vector<double> list, const char* name, bool budgets)
{
  if (list.empty())
  {
    throw InputError(name, -1, "none", "at least one");
  }
  for (std::size_t k = 0; k < list.size(); ++k)
  {
    const bool good = budgets ? list[k] > 0.0 && std::isfinite(list[k])
                              : list[k] >= 0.0 && list[k] <= 1.0;
    if (!good)
    {
      throw InputError(name, static_cast<long long>(k), list[k],
        budgets ? "seconds, finite and above 0" : "a number in [0, 1]");
    }
  }
  if (budgets)
  {
    std::sort(list.begin(), list.end());
  }
  else
  {
    std::sort(list.begin(), list.end(), std::greater<double>());
  }
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

/// Brings the inputs of a filter up to date that no pipeline updates.
void UpdateInputs(vtkRadiometricAlgorithm* filter, const ControllerCommunicator* ranks)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    for (int k = 0; k < filter->GetNumberOfInputConnections(port); ++k)
    {
      int output = 0;
      vtkAlgorithm* producer = filter->GetInputAlgorithm(port, k, output);
      vtkNew<vtkInformationVector> requests;
      requests->SetNumberOfInformationObjects(output + 1);
      vtkInformation* request = requests->GetInformationObject(output);
      request->Set(Pipeline::UPDATE_PIECE_NUMBER(), ranks ? ranks->Rank() : 0);
      request->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), ranks ? ranks->Size() : 1);
      request->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
      producer->Update(output, requests);
    }
  }
}

} // namespace

vtkAccuracyStudy::vtkAccuracyStudy()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(4);
  this->Controller = vtkMultiProcessController::GetGlobalController();
}

vtkAccuracyStudy::~vtkAccuracyStudy()
{
  this->SetArray(nullptr);
}

void vtkAccuracyStudy::SetFilter(vtkRadiometricAlgorithm* filter)
{
  if (this->Filter != filter)
  {
    this->Filter = filter;
    this->Modified();
  }
}

vtkRadiometricAlgorithm* vtkAccuracyStudy::GetFilter()
{
  return this->Filter;
}

vtkRadiometricAlgorithm* vtkAccuracyStudy::FindFilter()
{
  if (this->Filter)
  {
    return this->Filter;
  }
  vtkAlgorithm* here = this;
  while (here && here->GetNumberOfInputPorts() > 0 && here->GetNumberOfInputConnections(0) > 0)
  {
    here = here->GetInputAlgorithm(0, 0);
    if (auto* found = vtkRadiometricAlgorithm::SafeDownCast(here))
    {
      return found;
    }
  }
  return nullptr;
}

void vtkAccuracyStudy::SetReferenceConnection(vtkAlgorithmOutput* reference)
{
  this->SetInputConnection(ReferencePort, reference);
}

void vtkAccuracyStudy::SetReferenceData(vtkDataObject* reference)
{
  this->SetInputDataInternal(ReferencePort, reference);
}

void vtkAccuracyStudy::AddTolerance(double tolerance)
{
  this->Tolerances.push_back(tolerance);
  this->Modified();
}

void vtkAccuracyStudy::ClearTolerances()
{
  this->Tolerances.clear();
  this->Modified();
}

double vtkAccuracyStudy::GetTolerance(int index) const
{
  return index >= 0 && index < this->GetNumberOfTolerances()
    ? this->Tolerances[static_cast<std::size_t>(index)]
    : -1.0;
}

void vtkAccuracyStudy::AddTimeBudget(double seconds)
{
  this->TimeBudgets.push_back(seconds);
  this->Modified();
}

void vtkAccuracyStudy::ClearTimeBudgets()
{
  this->TimeBudgets.clear();
  this->Modified();
}

double vtkAccuracyStudy::GetTimeBudget(int index) const
{
  return index >= 0 && index < this->GetNumberOfTimeBudgets()
    ? this->TimeBudgets[static_cast<std::size_t>(index)]
    : -1.0;
}

void vtkAccuracyStudy::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

vtkMultiProcessController* vtkAccuracyStudy::GetController()
{
  return this->Controller;
}

vtkMTimeType vtkAccuracyStudy::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Filter ? std::max(own, this->Filter->GetMTime()) : own;
}

int vtkAccuracyStudy::ComputePipelineMTime(vtkInformation* request, vtkInformationVector** inputs,
  vtkInformationVector* outputs, int port, vtkMTimeType* mtime)
{
  const int result =
    this->Superclass::ComputePipelineMTime(request, inputs, outputs, port, mtime);
  auto* executive = this->Filter
    ? vtkDemandDrivenPipeline::SafeDownCast(this->Filter->GetExecutive())
    : nullptr;
  if (executive && executive->UpdatePipelineMTime()) // of what no connection leads to
  {
    *mtime = std::max(*mtime, executive->GetPipelineMTime());
  }
  return result;
}

int vtkAccuracyStudy::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(),
    port == ReferencePort ? "vtkPolyData" : "vtkDataObject");
  if (port == ReferencePort)
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  }
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkAccuracyStudy::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(
    vtkDataObject::DATA_TYPE_NAME(), port == SurfacePort ? "vtkDataObject" : "vtkTable");
  return 1;
}

int vtkAccuracyStudy::RequestDataObject(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkRadiometricAlgorithm* const filter = this->FindFilter();
  if (filter && filter == this->Filter && filter->GetNumberOfInputConnections(0) > 0)
  {
    filter->UpdateDataObject();
  }
  vtkDataObject* const surface = filter ? filter->GetOutputDataObject(0) : nullptr;
  const bool composite = vtkCompositeDataSet::SafeDownCast(surface) != nullptr;
  for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
  {
    vtkDataObject* const there = vtkDataObject::GetData(outputs, port);
    const char* const wanted = port != SurfacePort
      ? "vtkTable"
      : (composite ? surface->GetClassName() : "vtkPolyData");
    if (there && there->IsA(wanted))
    {
      continue;
    }
    vtkSmartPointer<vtkDataObject> made;
    if (port != SurfacePort)
    {
      made = vtkSmartPointer<vtkTable>::New();
    }
    else if (composite)
    {
      made = vtk::TakeSmartPointer(surface->NewInstance());
    }
    else
    {
      made = vtkSmartPointer<vtkPolyData>::New();
    }
    outputs->GetInformationObject(port)->Set(vtkDataObject::DATA_OBJECT(), made);
  }
  return 1;
}

void vtkAccuracyStudy::Study(const ControllerCommunicator* ranks, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  const bool budgets = this->Mode == TIME_BUDGETS;
  const std::vector<double> levels = Levels(
    budgets ? this->TimeBudgets : this->Tolerances, budgets ? "TimeBudgets" : "Tolerances", budgets);
  if (!(this->TimeLimit >= 0.0) || !std::isfinite(this->TimeLimit))
  {
    throw InputError("TimeLimit", -1, this->TimeLimit, "seconds, finite and at least 0");
  }
  vtkRadiometricAlgorithm* const filter = this->FindFilter();
  if (!filter)
  {
    throw InputError("Input", -1, "no filter",
      "an output of Irradiance, Radiosity, Radiance or View Factors, or one of them by SetFilter");
  }
  if (filter == this->Filter)
  {
    UpdateInputs(filter, ranks);
  }
  const std::string given = this->Array ? this->Array : "";
  const std::string array =
    given.empty() || given == "None" ? FirstQuantity(filter) : given; // ParaView's word for none
  StudyRunner runner(this, filter, this->TimeLimit);
  StudyRuns study(runner, ranks, array, filter->GetMetersPerUnit());
  if (vtkDataObject* reference = vtkDataObject::GetData(inputs[ReferencePort]))
  {
    study.SetReference(reference);
  }
  study.Make(levels, budgets, this->Fresh, this->Repeats);
  study.Compare();
  if (this->FloatComparison)
  {
    study.CompareFloat();
  }
  for (const std::string& warning : runner.Warnings())
  {
    vtkWarningMacro(<< warning);
  }
  if (!study.Record().Stopped.empty())
  {
    vtkWarningMacro(<< study.Record().Stopped);
  }
  if (study.Surface())
  {
    vtkDataObject::GetData(outputs, SurfacePort)->ShallowCopy(study.Surface());
  }
  if (!ranks || ranks->Rank() == 0) // tables of all ranks are put together by who reads them
  {
    WriteStudyRuns(study.Record(), vtkTable::GetData(outputs, 0));
    WriteStudySummary(study.Record(), vtkTable::GetData(outputs, 1));
    WriteStudyCurves(study.Record(), vtkTable::GetData(outputs, CurvesPort));
  }
}

int vtkAccuracyStudy::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const auto clear = [&] {
    for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
    {
      vtkDataObject::GetData(outputs, port)->Initialize();
    }
  };
  clear();
  const auto ranks = ControllerCommunicator::Make(this->Controller);
  try
  {
    this->Study(ranks.get(), inputs, outputs);
    if (ranks)
    {
      ranks->Finish();
    }
  }
  catch (const radiometry::Aborted&)
  {
    clear();
    const std::string failure = ranks ? ranks->Fail("") : std::string();
    if (!failure.empty()) // of another rank
    {
      vtkErrorMacro(<< failure);
      return 0;
    }
    return 1;
  }
  catch (const std::exception& error)
  {
    clear();
    vtkErrorMacro(<< (ranks ? ranks->Fail(error.what()) : std::string(error.what())));
    return 0;
  }
  this->UpdateProgress(1.0);
  return 1;
}

void vtkAccuracyStudy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto list = [&](const char* name, const std::vector<double>& numbers) {
    os << indent << name << ":";
    for (const double number : numbers)
    {
      os << ' ' << number;
    }
    os << '\n';
  };
  os << indent << "Filter: " << (this->Filter ? this->Filter->GetClassName() : "(upstream)") << '\n'
     << indent << "Mode: " << (this->Mode == TOLERANCES ? "Tolerances" : "TimeBudgets") << '\n';
  list("Tolerances", this->Tolerances);
  list("TimeBudgets", this->TimeBudgets);
  os << indent << "Fresh: " << this->Fresh << '\n'
     << indent << "Array: " << (this->Array ? this->Array : "(the filter's first)") << '\n'
     << indent << "TimeLimit: " << this->TimeLimit << " s\n"
     << indent << "Repeats: " << this->Repeats << '\n'
     << indent << "FloatComparison: " << this->FloatComparison << '\n';
}
