// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIrradianceFilter.h"

#include "RadiometricJob.h"
#include "radiometry/irradiance/IrradianceSimulation.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkIrradianceFilter);

void vtkIrradianceFilter::Simulate(Job& job, Result& result)
{
  radiometry::IrradianceOptions options;
  options.RelativeTolerance = this->RelativeTolerance;
  options.AbsoluteTolerance = this->AbsoluteTolerance;
  options.TimeBudget = this->TimeBudget;
  options.Threads = this->NumberOfThreads;
  options.Cells = job.WantCells;
  options.Switches = job.Switches;
  radiometry::IrradianceResult computed =
    radiometry::SimulateIrradiance(job.Scene, job.Points, options, job.Progress);

  static const char* const arrays[2] = { "Irradiance", "IrradianceBack" };
  for (int side = 0; side < 2; ++side)
  {
    if (!computed.Cells[side].Values.empty())
    {
      result.Cells.push_back({ arrays[side], "W/m^2", std::move(computed.Cells[side].Values),
        std::move(computed.Cells[side].Errors) });
    }
    if (!computed.Points[side].Values.empty())
    {
      result.Points.push_back({ arrays[side], "W/m^2", std::move(computed.Points[side].Values),
        std::move(computed.Points[side].Errors) });
    }
  }
  result.Convergence = std::move(computed.Convergence);
  result.Effects = std::move(computed.Effects);
  result.Outcome = computed.Outcome;
}
