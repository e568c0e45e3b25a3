// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiometricAlgorithm.h"

#include "ControllerCommunicator.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Monitor.h"

#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtksys/SystemInformation.hxx"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

vtkRadiometricAlgorithm::vtkRadiometricAlgorithm()
{
  this->Controller = vtkMultiProcessController::GetGlobalController();
}

vtkRadiometricAlgorithm::~vtkRadiometricAlgorithm() = default;

void vtkRadiometricAlgorithm::AddOccludersConnection(vtkAlgorithmOutput* occluders)
{
  this->AddInputConnection(this->GetNumberOfInputPorts() - 1, occluders);
}

void vtkRadiometricAlgorithm::AddOccludersData(vtkDataObject* occluders)
{
  this->AddInputDataInternal(this->GetNumberOfInputPorts() - 1, occluders);
}

void vtkRadiometricAlgorithm::RemoveOccludersConnections()
{
  this->SetInputConnection(this->GetNumberOfInputPorts() - 1, nullptr);
}

void vtkRadiometricAlgorithm::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

vtkMultiProcessController* vtkRadiometricAlgorithm::GetController()
{
  return this->Controller;
}

const ControllerCommunicator* vtkRadiometricAlgorithm::Ranks()
{
  if (this->CommunicatorsLast != this->Controller || this->Communicators.empty())
  {
    this->Communicators.push_back(ControllerCommunicator::Make(this->Controller));
    this->CommunicatorsLast = this->Controller;
  }
  const ControllerCommunicator* ranks = this->Communicators.back().get();
  if (ranks)
  {
    ranks->Begin();
  }
  return ranks;
}

void vtkRadiometricAlgorithm::CopySettings(vtkRadiometricAlgorithm* from)
{
  if (!from || std::strcmp(from->GetClassName(), this->GetClassName()) != 0)
  {
    vtkErrorMacro("CopySettings: " << (from ? from->GetClassName() : "no filter") << ": expected a "
                                   << this->GetClassName());
    return;
  }
  this->CopyMembers(from);
  this->Modified();
}

void vtkRadiometricAlgorithm::CopyMembers(vtkRadiometricAlgorithm* from)
{
  this->RelativeTolerance = from->RelativeTolerance;
  this->AbsoluteTolerance = from->AbsoluteTolerance;
  this->TimeBudget = from->TimeBudget;
  this->MemoryLimit = from->MemoryLimit;
  this->TwoSided = from->TwoSided;
  this->MetersPerUnit = from->MetersPerUnit;
  this->NumberOfThreads = from->NumberOfThreads;
  this->Controller = from->Controller;
}

double vtkRadiometricAlgorithm::PredictSeconds()
{
  this->PilotOnly = true;
  this->Modified();
  this->Update();
  this->PilotOnly = false;
  this->Modified();
  return this->PredictedSeconds;
}

void vtkRadiometricAlgorithm::CheckRange(
  const char* name, double value, double least, double most, const char* expected)
{
  if (!(value >= least && value <= most))
  {
    throw radiometry::InputError(name, -1, value, expected);
  }
}

void vtkRadiometricAlgorithm::CheckLimits() const
{
  const double infinite = std::numeric_limits<double>::max();
  CheckRange("RelativeTolerance", this->RelativeTolerance, 0.0, 1.0, "a number in [0, 1]");
  CheckRange("AbsoluteTolerance", this->AbsoluteTolerance, 0.0, infinite, "at least 0");
  CheckRange("TimeBudget", this->TimeBudget, 0.0, infinite, "seconds, at least 0");
  CheckRange("MemoryLimit", this->MemoryLimit, 0.0, infinite, "MiB, at least 0");
}

std::size_t vtkRadiometricAlgorithm::MemoryBytes(const ControllerCommunicator* ranks) const
{
  double mebibytes = this->MemoryLimit;
  if (!(mebibytes > 0.0))
  {
    vtksys::SystemInformation machine;
    machine.RunMemoryCheck();
    mebibytes = 0.5 * static_cast<double>(machine.GetTotalPhysicalMemory()) /
      (ranks ? ranks->RanksHere() : 1);
  }
  if (ranks)
  {
    // The least of all, so that they choose alike.
    mebibytes = -mebibytes;
    ranks->Largest(&mebibytes, 1);
    mebibytes = -mebibytes;
  }
  constexpr double mebibyte = 1024.0 * 1024.0;
  return static_cast<std::size_t>(std::min(mebibytes * mebibyte, 1e18));
}

int vtkRadiometricAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  if (port > 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  }
  return 1;
}

int vtkRadiometricAlgorithm::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkDataObject" : "vtkTable");
  return 1;
}

int vtkRadiometricAlgorithm::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
  if (!input)
  {
    return 0;
  }
  // A composite keeps its structure; everything else becomes a surface of polygons.
  auto* composite = vtkCompositeDataSet::SafeDownCast(input);
  const char* wanted = composite ? input->GetClassName() : "vtkPolyData";
  vtkDataObject* output = vtkDataObject::GetData(outputs, 0);
  if (!output || !output->IsA(wanted))
  {
    auto made = vtk::TakeSmartPointer(
      composite ? input->NewInstance() : static_cast<vtkDataObject*>(vtkPolyData::New()));
    outputs->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), made);
  }
  for (int port = 1; port < this->GetNumberOfOutputPorts(); ++port)
  {
    if (!vtkTable::GetData(outputs, port))
    {
      vtkNew<vtkTable> table;
      outputs->GetInformationObject(port)->Set(vtkDataObject::DATA_OBJECT(), table);
    }
  }
  return 1;
}

int vtkRadiometricAlgorithm::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const auto clear = [&] {
    for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
    {
      vtkDataObject::GetData(outputs, port)->Initialize();
    }
  };
  clear();
  const ControllerCommunicator* const ranks = this->Ranks();
  try
  {
    this->Compute(ranks, inputs, outputs);
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

void vtkRadiometricAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RelativeTolerance: " << this->RelativeTolerance << '\n'
     << indent << "AbsoluteTolerance: " << this->AbsoluteTolerance << '\n'
     << indent << "TimeBudget: " << this->TimeBudget << " s\n"
     << indent << "MemoryLimit: " << this->MemoryLimit << " MiB\n"
     << indent << "TwoSided: " << this->TwoSided << '\n'
     << indent << "MetersPerUnit: " << this->MetersPerUnit << '\n'
     << indent << "NumberOfThreads: " << this->NumberOfThreads << '\n';
}
