// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiometricFilter.h"

#include "BandWavelengths.h"
#include "ControllerCommunicator.h"
#include "RadiometricJob.h"
#include "RadiometricResults.h"
#include "RefinedSurface.h"
#include "SceneAdapter.h"
#include "SurfacePoints.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace
{

/// Hands the core's progress to VTK and VTK's abort to the core.
class FilterMonitor : public radiometry::Monitor
{
public:
  explicit FilterMonitor(vtkAlgorithm* filter)
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

radiometry::Vec3 Vector(const double* v)
{
  return { v[0], v[1], v[2] };
}

void CheckRange(const char* name, double value, double least, double most, const char* expected)
{
  if (!(value >= least && value <= most))
  {
    throw radiometry::InputError(name, -1, value, expected);
  }
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
  this->Controller = vtkMultiProcessController::GetGlobalController();
}

vtkRadiometricFilter::~vtkRadiometricFilter() = default;

void vtkRadiometricFilter::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

const ControllerCommunicator* vtkRadiometricFilter::Ranks()
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

vtkMultiProcessController* vtkRadiometricFilter::GetController()
{
  return this->Controller;
}

void vtkRadiometricFilter::AddLightsConnection(vtkAlgorithmOutput* lights)
{
  this->AddInputConnection(1, lights);
}
void vtkRadiometricFilter::AddLightsData(vtkDataObject* lights)
{
  this->AddInputDataInternal(1, lights);
}
void vtkRadiometricFilter::AddOccludersConnection(vtkAlgorithmOutput* occluders)
{
  this->AddInputConnection(2, occluders);
}
void vtkRadiometricFilter::AddOccludersData(vtkDataObject* occluders)
{
  this->AddInputDataInternal(2, occluders);
}

void vtkRadiometricFilter::RemoveLightsConnections()
{
  this->SetInputConnection(1, nullptr);
}
void vtkRadiometricFilter::RemoveOccludersConnections()
{
  this->SetInputConnection(2, nullptr);
}

void vtkRadiometricFilter::SetObjectTransform(vtkMatrix4x4* matrix)
{
  this->SetObjectTransform(matrix->GetData());
}

int vtkRadiometricFilter::FillInputPortInformation(int port, vtkInformation* info)
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

int vtkRadiometricFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkDataObject" : "vtkTable");
  return 1;
}

int vtkRadiometricFilter::RequestDataObject(
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
  for (int port = 1; port < 3; ++port)
  {
    if (!vtkTable::GetData(outputs, port))
    {
      vtkNew<vtkTable> table;
      outputs->GetInformationObject(port)->Set(vtkDataObject::DATA_OBJECT(), table);
    }
  }
  return 1;
}

int vtkRadiometricFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
  vtkDataObject* output = vtkDataObject::GetData(outputs, 0);
  vtkTable* effects = vtkTable::GetData(outputs, 1);
  vtkTable* convergence = vtkTable::GetData(outputs, 2);
  const auto clear = [&] {
    output->Initialize();
    effects->Initialize();
    convergence->Initialize();
  };
  clear();
  const ControllerCommunicator* const ranks = this->Ranks();
  try
  {
    const double infinite = std::numeric_limits<double>::max();
    CheckRange("RelativeTolerance", this->RelativeTolerance, 0.0, 1.0, "a number in [0, 1]");
    CheckRange("AbsoluteTolerance", this->AbsoluteTolerance, 0.0, infinite, "at least 0");
    CheckRange("TimeBudget", this->TimeBudget, 0.0, infinite, "seconds, at least 0");
    CheckRange("MemoryLimit", this->MemoryLimit, 0.0, infinite, "MiB, at least 0");
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

    FilterMonitor monitor(this);
    Job job{ scene, {}, {}, true, &monitor };
    job.Ranks = ranks;
    job.RanksHere = ranks ? ranks->RanksHere() : 1;
    job.Threads = ThreadsOfRank(ranks, this->NumberOfThreads);
    for (const int choice : { this->Occlusion, this->Interreflection, this->SpecularTransport,
           this->Transmission, this->BackFaces, this->Emission, this->Environment, this->SpotShape,
           this->Attenuation })
    {
      job.Switches.push_back(static_cast<radiometry::EffectSwitch>(choice));
    }
    job.WantCells = !this->WantsPoints(adapter);
    const SurfacePoints points(
      adapter, scene, this->MetersPerUnit, !job.WantCells, this->FeatureAngle);
    job.Points = points.Points();
    job.Adapter = &adapter;
    job.Carriers = &points;

    Result result;
    job.WantVisibility = this->LightVisibility;
    this->Simulate(job, result);
    result.LightKeys = adapter.LightKeys();
    AddDose(result.Cells, this->ExposureTime);
    AddDose(result.Points, this->ExposureTime);

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
      points, output, input);
    if (!ranks || ranks->Rank() == 0) // tables of all ranks are put together by who reads them
    {
      writer.WriteEffects(result, effects);
      writer.WriteConvergence(result, convergence);
    }
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

void vtkRadiometricFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RelativeTolerance: " << this->RelativeTolerance << '\n'
     << indent << "AbsoluteTolerance: " << this->AbsoluteTolerance << " W/m^2\n"
     << indent << "TimeBudget: " << this->TimeBudget << " s\n"
     << indent << "MemoryLimit: " << this->MemoryLimit << " MiB\n"
     << indent << "SampleLocation: " << (this->SampleLocation == CELLS ? "Cells" : "Points") << '\n'
     << indent << "TwoSided: " << this->TwoSided << '\n'
     << indent << "MetersPerUnit: " << this->MetersPerUnit << '\n'
     << indent << "ExposureTime: " << this->ExposureTime << " s\n"
     << indent << "LightVisibility: " << this->LightVisibility << '\n'
     << indent << "GlobalAmbient: " << this->GlobalAmbient << " W/m^2\n"
     << indent << "NumberOfThreads: " << this->NumberOfThreads << '\n';
}
