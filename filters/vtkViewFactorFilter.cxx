// SPDX-License-Identifier: BSD-3-Clause
#include "vtkViewFactorFilter.h"

#include "ControllerCommunicator.h"
#include "FilterMonitor.h"
#include "SceneAdapter.h"
#include "ViewFactorResults.h"
#include "radiometry/formfactor/ViewFactors.h"

#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <sstream>

vtkStandardNewMacro(vtkViewFactorFilter);

vtkViewFactorFilter::vtkViewFactorFilter()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(4);
  this->AbsoluteTolerance = 1e-4;
}

vtkViewFactorFilter::~vtkViewFactorFilter()
{
  this->SetPatchArray(nullptr);
}

void vtkViewFactorFilter::Compute(const ControllerCommunicator* ranks,
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const radiometry::ConvergenceRecord clock;
  this->Explanation.clear();
  this->CheckLimits();
  const radiometry::Vec3 up{ this->SkyUp[0], this->SkyUp[1], this->SkyUp[2] };
  CheckRange("SkyUp", radiometry::Length(up), 1e-300, std::numeric_limits<double>::max(),
    "a direction, not (0, 0, 0)");

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
  options.TimeBudget =
    this->TimeBudget > 0.0 ? std::max(1e-9, this->TimeBudget - clock.Elapsed()) : 0.0;
  options.PilotOnly = this->PilotOnly;
  options.MemoryLimit = this->MemoryBytes(ranks);
  options.Method = static_cast<radiometry::ViewFactorMethod>(this->Method);
  options.Occlusion = this->Occlusion != OFF;
  options.BackFaces = this->BackFaces != OFF;
  options.Correction = this->Correction;
  options.Up = up;
  options.Threads = ThreadsOfRank(ranks, this->NumberOfThreads);
  options.Ranks = ranks;
  FilterMonitor monitor(this, &this->PredictedSeconds);
  const radiometry::ViewFactorResult result =
    radiometry::ComputeViewFactors(scene, patches.OfCell, patches.Ids.size(), options, &monitor);
  this->PredictedSeconds = result.Cost.PredictedSeconds;
  this->ElapsedSeconds = clock.Elapsed();
  if (this->PilotOnly)
  {
    return;
  }

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
  const PlanReport plan = ReportPlan(result,
    { static_cast<radiometry::EffectSwitch>(this->Occlusion),
      static_cast<radiometry::EffectSwitch>(this->BackFaces) },
    std::find(sides.begin(), sides.end(), 1) != sides.end(), !scene.TriangleTransmittance.empty());
  this->Explanation = plan.Text();
  const ViewFactorResults writer(result, plan, patches, text.str());
  writer.WriteSurface(adapter.OwnBlocks(), vtkDataObject::GetData(outputs, 0), input);
  if (ranks && ranks->Rank() != 0)
  {
    return; // tables of all ranks are put together by who reads them
  }
  writer.WriteTable(this->EnvironmentRows, vtkTable::GetData(outputs, 1));
  plan.Write(vtkTable::GetData(outputs, 2));
  WriteConvergence(result.Convergence, vtkTable::GetData(outputs, 3));
}

void vtkViewFactorFilter::CopyMembers(vtkRadiometricAlgorithm* from)
{
  this->Superclass::CopyMembers(from);
  auto* other = vtkViewFactorFilter::SafeDownCast(from);
  this->Method = other->Method;
  this->Occlusion = other->Occlusion;
  this->BackFaces = other->BackFaces;
  this->Correction = other->Correction;
  this->EnvironmentRows = other->EnvironmentRows;
  std::copy(std::begin(other->SkyUp), std::end(other->SkyUp), this->SkyUp);
  this->SetPatchArray(other->PatchArray);
}

void vtkViewFactorFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  static const char* const methods[] = { "Auto", "Dense", "Hierarchical", "MonteCarlo" };
  os << indent << "PatchArray: " << (this->PatchArray ? this->PatchArray : "(none)") << '\n'
     << indent << "Method: " << methods[this->Method] << '\n'
     << indent << "Correction: " << this->Correction << '\n'
     << indent << "EnvironmentRows: " << this->EnvironmentRows << '\n';
}
