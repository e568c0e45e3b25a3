// SPDX-License-Identifier: BSD-3-Clause
#include "StudyRunner.h"

#include "RoundedData.h"
#include "vtkIrradianceFilter.h"
#include "vtkRadiometricAlgorithm.h"
#include "vtkRadiosityFilter.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkNew.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace
{

/// A message of vtkErrorMacro or vtkWarningMacro without its file, class and address.
std::string Words(const char* message)
{
  std::string words = message ? message : "";
  const std::size_t mark = words.find("): ");
  words = mark == std::string::npos ? words : words.substr(mark + 3);
  const std::size_t end = words.find_last_not_of(" \n\r");
  return end == std::string::npos ? std::string() : words.substr(0, end + 1);
}

std::string Seconds(double seconds)
{
  std::ostringstream text;
  text.precision(3);
  text << seconds << " s";
  return text.str();
}

} // namespace

/// Hears what a copy and its executive say while they run.
class StudyRunner::Listener : public vtkCommand
{
public:
  static Listener* New() { return new Listener; }

  void Execute(vtkObject* caller, unsigned long event, void* data) override
  {
    const auto* text = static_cast<const char*>(data);
    switch (event)
    {
      case vtkCommand::ErrorEvent:
        (caller == this->Copy ? this->Errors : this->Failures).push_back(Words(text));
        break;
      case vtkCommand::WarningEvent:
        this->Warnings.push_back(Words(text));
        break;
      case vtkCommand::ProgressEvent:
        this->Progress(*static_cast<double*>(data));
        break;
      case vtkRadiometricAlgorithm::PredictedEvent:
        this->Predicted(*static_cast<double*>(data));
        break;
      default:
        break;
    }
  }

  StudyRunner* Runner = nullptr;
  vtkRadiometricAlgorithm* Copy = nullptr;
  double Began = 0.0;
  Ends End = Done;
  std::vector<std::string> Errors;
  std::vector<std::string> Failures; // of the executive, which says less
  std::vector<std::string> Warnings;

private:
  void Stop(Ends end)
  {
    this->End = std::max(this->End, end);
    this->Copy->SetAbortExecute(1);
  }

  void Progress(double fraction)
  {
    StudyRunner& runner = *this->Runner;
    const char* stage = this->Copy->GetProgressText();
    const std::string text = runner.Name + (stage && *stage ? ": " : "") + (stage ? stage : "");
    runner.Owner->SetProgressText(text.c_str());
    runner.Owner->UpdateProgress(
      runner.Begin + (runner.End - runner.Begin) * std::clamp(fraction, 0.0, 1.0));
    if (runner.Owner->GetAbortExecute())
    {
      this->Stop(Aborted);
    }
    else if (runner.IsLate())
    {
      runner.Why = "the time limit of " + Seconds(runner.Limit) + " ended it";
      this->Stop(Late);
    }
  }

  void Predicted(double seconds)
  {
    StudyRunner& runner = *this->Runner;
    if (runner.Limit > 0.0 && this->Began + seconds > runner.Limit)
    {
      runner.Why = "predicted to take " + Seconds(seconds) + ", with " +
        Seconds(runner.Limit - this->Began) + " left of the time limit of " +
        Seconds(runner.Limit);
      this->Stop(Late);
    }
  }
};

vtkSmartPointer<vtkRadiometricAlgorithm> StudyRunner::Copy(bool rounded) const
{
  if (this->Filter->GetNumberOfInputConnections(0) == 0)
  {
    throw std::runtime_error(
      std::string("the filter to study (") + this->Filter->GetClassName() + ") has no surface");
  }
  auto copy = vtk::TakeSmartPointer(this->Filter->NewInstance());
  copy->CopySettings(this->Filter);
  if (auto* irradiance = vtkIrradianceFilter::SafeDownCast(copy))
  {
    irradiance->SetRefineShadowBoundaries(false); // runs would have other cells
  }
  if (auto* radiosity = vtkRadiosityFilter::SafeDownCast(copy))
  {
    radiosity->SetOperatorFileMode(vtkRadiosityFilter::FILE_UNUSED);
  }
  for (int port = 0; port < this->Filter->GetNumberOfInputPorts(); ++port)
  {
    for (int k = 0; k < this->Filter->GetNumberOfInputConnections(port); ++k)
    {
      vtkDataObject* given = this->Filter->GetInputDataObject(port, k);
      if (!given)
      {
        continue;
      }
      vtkSmartPointer<vtkDataObject> data;
      if (rounded)
      {
        data = RoundedToFloat(given);
      }
      else
      {
        data = vtk::TakeSmartPointer(given->NewInstance());
        data->ShallowCopy(given);
      }
      copy->AddInputDataObject(port, data);
    }
  }
  return copy;
}

void StudyRunner::Announce(const std::string& name, double begin, double end)
{
  this->Name = name;
  this->Begin = begin;
  this->End = end;
}

StudyRunner::Ends StudyRunner::Run(vtkRadiometricAlgorithm* copy, double& seconds)
{
  vtkNew<Listener> listener;
  listener->Runner = this;
  listener->Copy = copy;
  listener->Began = this->Elapsed();
  std::vector<std::pair<vtkObject*, unsigned long>> tags;
  for (const unsigned long event :
    { static_cast<unsigned long>(vtkCommand::ErrorEvent),
      static_cast<unsigned long>(vtkCommand::WarningEvent),
      static_cast<unsigned long>(vtkCommand::ProgressEvent),
      static_cast<unsigned long>(vtkRadiometricAlgorithm::PredictedEvent) })
  {
    tags.emplace_back(copy, copy->AddObserver(event, listener));
  }
  vtkExecutive* const executive = copy->GetExecutive();
  tags.emplace_back(executive, executive->AddObserver(vtkCommand::ErrorEvent, listener));

  copy->SetAbortExecute(0);
  copy->Modified(); // a run is made whatever was made before
  copy->Update();
  seconds = this->Elapsed() - listener->Began;
  for (const auto& [object, tag] : tags)
  {
    object->RemoveObserver(tag);
  }
  for (const std::string& warning : listener->Warnings)
  {
    if (std::find(this->Warned.begin(), this->Warned.end(), warning) == this->Warned.end())
    {
      this->Warned.push_back(warning);
    }
  }
  const auto& errors = listener->Errors.empty() ? listener->Failures : listener->Errors;
  if (!errors.empty())
  {
    throw std::runtime_error(this->Name + ": " + errors.front());
  }
  return listener->End;
}
