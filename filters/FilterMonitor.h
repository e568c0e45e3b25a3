// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Monitor.h"

#include "vtkAlgorithm.h"

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
