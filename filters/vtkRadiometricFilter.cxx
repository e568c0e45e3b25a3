// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiometricFilter.h"

#include "BandWavelengths.h"
#include "ControllerCommunicator.h"
#include "FilterMonitor.h"
#include "RadiometricJob.h"
#include "RadiometricResults.h"
#include "RefinedSurface.h"
#include "SceneAdapter.h"
#include "SurfacePoints.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include "vtkDataObject.h"
#include "vtkInformationVector.h"
#include "vtkMatrix4x4.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>
#include <utility>

namespace
{

radiometry::Vec3 Vector(const double* v)
{
  return { v[0], v[1], v[2] };
}

/// Radiant exposure beside every irradiance (not for a time of 0).
void AddDose(std::vector<vtkRadiometricFilter::Result::Quantity>& quantities, double seconds)
{
  const std::string irradiance = radiometry::names::Irradiance;
  const std::size_t given = seconds > 0.0 ? quantities.size() : 0;
  for (std::size_t k = 0; k < given; ++k)
  {
    if (quantities[k].Name != irradiance &&
      quantities[k].Name != irradiance + radiometry::names::BackSuffix)
    {
      continue;
    }
    auto dose = quantities[k];
    dose.Name = radiometry::names::Dose + dose.Name.substr(irradiance.size());
    dose.Unit = "J/m^2";
    for (std::vector<double>* numbers : { &dose.Values, &dose.Errors })
    {
      for (double& number : *numbers)
      {
        number *= seconds;
      }
    }
    quantities.push_back(std::move(dose));
  }
}

} // namespace

vtkRadiometricFilter::vtkRadiometricFilter()
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(3);
}

vtkRadiometricFilter::~vtkRadiometricFilter() = default;

void vtkRadiometricFilter::AddLightsConnection(vtkAlgorithmOutput* lights)
{
  this->AddInputConnection(1, lights);
}
void vtkRadiometricFilter::AddLightsData(vtkDataObject* lights)
{
  this->AddInputDataInternal(1, lights);
}
void vtkRadiometricFilter::RemoveLightsConnections()
{
  this->SetInputConnection(1, nullptr);
}
void vtkRadiometricFilter::SetObjectTransform(vtkMatrix4x4* matrix)
{
  this->SetObjectTransform(matrix->GetData());
}

std::vector<radiometry::EffectSwitch> vtkRadiometricFilter::EffectSwitches() const
{
  using radiometry::Effect;
  const std::pair<Effect, int> choices[] = {
    { Effect::Occlusion, this->Occlusion },
    { Effect::Interreflection, this->Interreflection },
    { Effect::SpecularTransport, this->SpecularTransport },
    { Effect::Transmission, this->Transmission },
    { Effect::BackFaces, this->BackFaces },
    { Effect::Emission, this->Emission },
    { Effect::Environment, this->Environment },
    { Effect::SpotShape, this->SpotShape },
    { Effect::Attenuation, this->Attenuation },
    { Effect::PointLights, this->PointLights },
    { Effect::SpotLights, this->SpotLights },
    { Effect::DirectionalLights, this->DirectionalLights },
    { Effect::AreaLights, this->AreaLights },
    { Effect::CandelaWebs, this->CandelaWebs },
    { Effect::Mirrors, this->Mirrors },
    { Effect::SpectralBands, this->SpectralBands },
  };
  std::vector<radiometry::EffectSwitch> switches(radiometry::EffectCount);
  for (const auto& [effect, choice] : choices)
  {
    switches[static_cast<std::size_t>(effect)] = static_cast<radiometry::EffectSwitch>(choice);
  }
  return switches;
}

void vtkRadiometricFilter::Compute(const ControllerCommunicator* ranks,
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const radiometry::ConvergenceRecord clock;
  vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
  const double infinite = std::numeric_limits<double>::max();
  this->Explanation.clear();
  this->CheckLimits();
  CheckRange("ExposureTime", this->ExposureTime, 0.0, infinite, "seconds, at least 0");
  CheckRange("LuminousEfficacy", this->LuminousEfficacy, 1e-300, infinite, "lm/W, above 0");

  SceneAdapter adapter(this->MetersPerUnit, this->TwoSided, this->DiffuseReflectance);
  adapter.SetGlobalAmbient(this->GlobalAmbient);
  radiometry::Affine object;
  std::copy_n(this->ObjectTransform, object.size(), object.begin());
  adapter.SetFrames(object,
    { Vector(this->CameraPosition), Vector(this->CameraFocalPoint), Vector(this->CameraViewUp) });
  adapter.AddSurface(input);
  std::vector<vtkDataObject*> stated{ input }; // what may state Wavelengths
  for (int k = 0; k < inputs[1]->GetNumberOfInformationObjects(); ++k)
  {
    stated.push_back(vtkDataObject::GetData(inputs[1], k));
    adapter.AddLights(stated.back());
  }
  for (int k = 0; k < inputs[2]->GetNumberOfInformationObjects(); ++k)
  {
    adapter.AddOccluder(vtkDataObject::GetData(inputs[2], k));
  }
  adapter.FurtherArrays = this->CellArraysRead();
  adapter.FurtherSpectra = adapter.FurtherArrays;
  adapter.Gather(ranks);
  const radiometry::Scene scene = adapter.Build();
  const std::vector<double> wavelengths = CheckedWavelengths(stated, scene.Optics.Bands);

  this->PredictedSeconds = -1.0;
  FilterMonitor monitor(this, &this->PredictedSeconds);
  Job job{ scene, {}, {}, true, &monitor };
  job.Ranks = ranks;
  job.Memory = this->MemoryBytes(ranks);
  job.Threads = ThreadsOfRank(ranks, this->NumberOfThreads);
  job.Switches = this->EffectSwitches();
  job.WantCells = !this->WantsPoints(adapter);
  const SurfacePoints points(
    adapter, scene, this->MetersPerUnit, !job.WantCells, this->FeatureAngle);
  job.Points = points.Points();
  job.Adapter = &adapter;
  job.Carriers = &points;

  Result result;
  job.WantVisibility = this->LightVisibility;
  job.PilotOnly = this->PilotOnly;
  if (this->TimeBudget > 0.0)
  {
    job.TimeBudget = std::max(1e-9, this->TimeBudget - clock.Elapsed());
  }
  this->Simulate(job, result);
  this->PredictedSeconds = result.Cost.PredictedSeconds;
  if (this->PilotOnly)
  {
    this->ElapsedSeconds = clock.Elapsed();
    return;
  }
  result.LightKeys = adapter.LightKeys();
  AddDose(result.Cells, this->ExposureTime);
  AddDose(result.Points, this->ExposureTime);

  const PlanReport plan = ReportPlan(result);
  this->Explanation = plan.Text();
  std::ostringstream options;
  options << "RelativeTolerance=" << this->RelativeTolerance
          << "; AbsoluteTolerance=" << this->AbsoluteTolerance
          << "; TimeBudget=" << this->TimeBudget
          << "; SampleLocation=" << (job.WantCells ? "Cells" : "Points")
          << "; TwoSided=" << this->TwoSided << "; MetersPerUnit=" << this->MetersPerUnit
          << "; ExposureTime=" << this->ExposureTime
          << "; CellsWithoutArea=" << adapter.CellsWithoutArea() << "; GlobalAmbient=";
  for (std::size_t b = 0; b < scene.GlobalAmbient.size(); ++b)
  {
    options << (b > 0 ? "," : "") << scene.GlobalAmbient[b];
  }
  options << (scene.GlobalAmbient.empty() ? "0" : "");
  const RadiometricResults writer(scene.Optics.Bands,
    this->Photometric ? this->LuminousEfficacy : 0.0,
    wavelengths, this->GetClassName(), options.str());
  writer.WriteSurface(result,
    result.Pieces.Size() > 0 ? RefineSurface(adapter, scene, this->MetersPerUnit, result.Pieces)
                             : adapter.OwnBlocks(),
    points, vtkDataObject::GetData(outputs, 0), input);
  if (!ranks || ranks->Rank() == 0) // tables of all ranks are put together by who reads them
  {
    plan.Write(vtkTable::GetData(outputs, 1));
    WriteConvergence(result.Convergence, vtkTable::GetData(outputs, 2));
  }
  this->ElapsedSeconds = clock.Elapsed();
}

void vtkRadiometricFilter::CopyMembers(vtkRadiometricAlgorithm* from)
{
  this->Superclass::CopyMembers(from);
  auto* other = vtkRadiometricFilter::SafeDownCast(from);
  this->SampleLocation = other->SampleLocation;
  this->FeatureAngle = other->FeatureAngle;
  this->Refinement = other->Refinement;
  this->DiffuseReflectance = other->DiffuseReflectance;
  this->Photometric = other->Photometric;
  this->LuminousEfficacy = other->LuminousEfficacy;
  this->ExposureTime = other->ExposureTime;
  this->GlobalAmbient = other->GlobalAmbient;
  this->LightVisibility = other->LightVisibility;
  this->Occlusion = other->Occlusion;
  this->Interreflection = other->Interreflection;
  this->SpecularTransport = other->SpecularTransport;
  this->Transmission = other->Transmission;
  this->BackFaces = other->BackFaces;
  this->Emission = other->Emission;
  this->Environment = other->Environment;
  this->SpotShape = other->SpotShape;
  this->Attenuation = other->Attenuation;
  this->PointLights = other->PointLights;
  this->SpotLights = other->SpotLights;
  this->DirectionalLights = other->DirectionalLights;
  this->AreaLights = other->AreaLights;
  this->CandelaWebs = other->CandelaWebs;
  this->Mirrors = other->Mirrors;
  this->SpectralBands = other->SpectralBands;
  std::copy(std::begin(other->ObjectTransform), std::end(other->ObjectTransform), this->ObjectTransform);
  std::copy(std::begin(other->CameraPosition), std::end(other->CameraPosition), this->CameraPosition);
  std::copy(std::begin(other->CameraFocalPoint), std::end(other->CameraFocalPoint), this->CameraFocalPoint);
  std::copy(std::begin(other->CameraViewUp), std::end(other->CameraViewUp), this->CameraViewUp);
}

void vtkRadiometricFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SampleLocation: " << (this->SampleLocation == CELLS ? "Cells" : "Points") << '\n'
     << indent << "ExposureTime: " << this->ExposureTime << " s\n"
     << indent << "LightVisibility: " << this->LightVisibility << '\n'
     << indent << "GlobalAmbient: " << this->GlobalAmbient << " W/m^2\n";
}
