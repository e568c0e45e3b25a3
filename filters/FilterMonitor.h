// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Monitor.h"

#include "vtkRadiometricAlgorithm.h"

/// Hands the core's progress to VTK and VTK's abort to the core.
class FilterMonitor : public radiometry::Monitor
{
public:
  /// `predicted` (may be null) gets what the core predicts [s].
  explicit FilterMonitor(vtkAlgorithm* filter, double* predicted = nullptr)
    : Filter(filter)
    , PredictedSeconds(predicted)
  {
  }
  bool Progress(double fraction, const char* stage) override
  {
    this->Filter->SetProgressText(stage);
    this->Filter->UpdateProgress(fraction);
    return this->Filter->GetAbortExecute() == 0;
  }

  void Predicted(double seconds) override
  {
    if (this->PredictedSeconds)
    {
      *this->PredictedSeconds = seconds;
    }
    this->Filter->InvokeEvent(vtkRadiometricAlgorithm::PredictedEvent, &seconds);
  }

private:
  vtkAlgorithm* Filter;
  double* PredictedSeconds;
};
