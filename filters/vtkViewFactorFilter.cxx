// SPDX-License-Identifier: BSD-3-Clause
#include "vtkViewFactorFilter.h"

#include "ControllerCommunicator.h"
#include "SceneAdapter.h"
#include "ViewFactorResults.h"
#include "radiometry/formfactor/ViewFactors.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Monitor.h"

#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtksys/SystemInformation.hxx"

#include <algorithm>
#include <limits>
#include <sstream>

vtkStandardNewMacro(vtkViewFactorFilter);

namespace
{

/// Hands the core's progress to VTK and VTK's abort to the core.
class ProgressOf : public radiometry::Monitor
{
public:
  explicit ProgressOf(vtkAlgorithm* filter)
    : Filter(filter)
  {
  }
  bool Progress(double fraction, const char* stage) override
  {
    this->Filter->SetProgressText(stage);
    this->Filter->UpdateProgress(fraction);
    return this->Filter->GetAbortExecute() == 0;
  }

private:
  vtkAlgorithm* Filter;
};

void CheckRange(const char* name, double value, double least, double most, const char* expected)
{
  if (!(value >= least && value <= most))
  {
    throw radiometry::InputError(name, -1, value, expected);
  }
}

std::size_t Bytes(double mebibytes)
{
  constexpr double mebibyte = 1024.0 * 1024.0;
  if (mebibytes > 0.0)
  {
    return static_cast<std::size_t>(mebibytes * mebibyte);
  }
  vtksys::SystemInformation machine;
  machine.RunMemoryCheck();
  return static_cast<std::size_t>(0.5 * mebibyte) * machine.GetTotalPhysicalMemory();
}

} // namespace

vtkViewFactorFilter::vtkViewFactorFilter()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(4);
  this->Controller = vtkMultiProcessController::GetGlobalController();
}

void vtkViewFactorFilter::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

vtkMultiProcessController* vtkViewFactorFilter::GetController()
{
  return this->Controller;
}

vtkViewFactorFilter::~vtkViewFactorFilter()
{
  this->SetPatchArray(nullptr);
}

void vtkViewFactorFilter::AddOccludersConnection(vtkAlgorithmOutput* occluders)
{
  this->AddInputConnection(1, occluders);
}
void vtkViewFactorFilter::AddOccludersData(vtkDataObject* occluders)
{
  this->AddInputDataInternal(1, occluders);
}
void vtkViewFactorFilter::RemoveOccludersConnections()
{
  this->SetInputConnection(1, nullptr);
}

int vtkViewFactorFilter::FillInputPortInformation(int port, vtkInformation* info)
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

int vtkViewFactorFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkDataObject" : "vtkTable");
  return 1;
}

int vtkViewFactorFilter::RequestDataObject(
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

int vtkViewFactorFilter::RequestData(
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
    this->Compute(ranks.get(), inputs, outputs);
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

void vtkViewFactorFilter::Compute(const ControllerCommunicator* ranks,
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const double infinite = std::numeric_limits<double>::max();
  CheckRange("RelativeTolerance", this->RelativeTolerance, 0.0, 1.0, "a number in [0, 1]");
  CheckRange("AbsoluteTolerance", this->AbsoluteTolerance, 0.0, infinite, "at least 0");
  CheckRange("TimeBudget", this->TimeBudget, 0.0, infinite, "seconds, at least 0");
  CheckRange("MemoryLimit", this->MemoryLimit, 0.0, infinite, "MiB, at least 0");
  const radiometry::Vec3 up{ this->SkyUp[0], this->SkyUp[1], this->SkyUp[2] };
  CheckRange("SkyUp", radiometry::Length(up), 1e-300, infinite, "a direction, not (0, 0, 0)");

  vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
  SceneAdapter adapter(this->MetersPerUnit, this->TwoSided, 0.0);
  adapter.AddSurface(input);
  for (int k = 0; k < inputs[1]->GetNumberOfInformationObjects(); ++k)
  {
    adapter.AddOccluder(vtkDataObject::GetData(inputs[1], k));
  }
  // ParaView's word for no array.
  const std::string given = this->PatchArray ? this->PatchArray : "";
  const std::string name = given == "None" ? "" : given;
  adapter.FurtherArrays = { name };
  adapter.Gather(ranks);
  const radiometry::Scene scene = adapter.Build();
  const SurfacePatches patches(adapter.Blocks(), name);

  radiometry::ViewFactorOptions options;
  options.RelativeTolerance = this->RelativeTolerance;
  options.AbsoluteTolerance = this->AbsoluteTolerance;
  options.TimeBudget = this->TimeBudget;
  options.MemoryLimit = Bytes(this->MemoryLimit);
  if (ranks && !(this->MemoryLimit > 0.0))
  {
    options.MemoryLimit /= static_cast<std::size_t>(ranks->RanksHere());
  }
  options.Method = static_cast<radiometry::ViewFactorMethod>(this->Method);
  options.Occlusion = this->Occlusion != OFF;
  options.BackFaces = this->BackFaces != OFF;
  options.Correction = this->Correction;
  options.Up = up;
  options.Threads = ThreadsOfRank(ranks, this->NumberOfThreads);
  options.Ranks = ranks;
  ProgressOf monitor(this);
  const radiometry::ViewFactorResult result =
    radiometry::ComputeViewFactors(scene, patches.OfCell, patches.Ids.size(), options, &monitor);

  std::ostringstream text;
  text << "PatchArray=" << (name.empty() ? "(every cell)" : name)
       << "; RelativeTolerance=" << this->RelativeTolerance
       << "; AbsoluteTolerance=" << this->AbsoluteTolerance << "; TimeBudget=" << this->TimeBudget
       << "; Method=" << this->Method << "; Occlusion=" << this->Occlusion
       << "; BackFaces=" << this->BackFaces << "; TwoSided=" << this->TwoSided
       << "; Correction=" << this->Correction << "; SkyUp=" << this->SkyUp[0] << ','
       << this->SkyUp[1] << ',' << this->SkyUp[2] << "; MetersPerUnit=" << this->MetersPerUnit
       << "; CellsWithoutArea=" << adapter.CellsWithoutArea();
  const auto& sides = scene.Optics.TwoSided;
  const ViewFactorResults writer(result, patches, text.str());
  writer.WriteSurface(adapter.OwnBlocks(), vtkDataObject::GetData(outputs, 0), input);
  if (ranks && ranks->Rank() != 0)
  {
    return; // tables of all ranks are put together by who reads them
  }
  writer.WriteTable(this->EnvironmentRows, vtkTable::GetData(outputs, 1));
  writer.WriteEffects(options.Occlusion, options.BackFaces,
    std::find(sides.begin(), sides.end(), 1) != sides.end(),
    !scene.TriangleTransmittance.empty(), vtkTable::GetData(outputs, 2));
  writer.WriteConvergence(vtkTable::GetData(outputs, 3));
}

void vtkViewFactorFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  static const char* const methods[] = { "Auto", "Dense", "Hierarchical", "MonteCarlo" };
  os << indent << "PatchArray: " << (this->PatchArray ? this->PatchArray : "(none)") << '\n'
     << indent << "RelativeTolerance: " << this->RelativeTolerance << '\n'
     << indent << "AbsoluteTolerance: " << this->AbsoluteTolerance << '\n'
     << indent << "TimeBudget: " << this->TimeBudget << " s\n"
     << indent << "MemoryLimit: " << this->MemoryLimit << " MiB\n"
     << indent << "Method: " << methods[this->Method] << '\n'
     << indent << "TwoSided: " << this->TwoSided << '\n'
     << indent << "Correction: " << this->Correction << '\n'
     << indent << "EnvironmentRows: " << this->EnvironmentRows << '\n'
     << indent << "MetersPerUnit: " << this->MetersPerUnit << '\n'
     << indent << "NumberOfThreads: " << this->NumberOfThreads << '\n';
}
