// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIrradianceFilter.h"

#include "RadiometricJob.h"
#include "RadiometricResults.h"
#include "radiometry/irradiance/IrradianceCache.h"
#include "radiometry/irradiance/IrradianceSimulation.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <sstream>
#include <string>

vtkStandardNewMacro(vtkIrradianceFilter);

vtkIrradianceFilter::vtkIrradianceFilter()
  : Cache(std::make_shared<radiometry::IrradianceCache>())
{
}

vtkIrradianceFilter::~vtkIrradianceFilter() = default;

void vtkIrradianceFilter::ReleaseCache()
{
  this->Cache->Release();
}

double vtkIrradianceFilter::GetCacheMemory()
{
  constexpr double mebibyte = 1024.0 * 1024.0;
  return static_cast<double>(this->Cache->MemoryBytes()) / mebibyte;
}

void vtkIrradianceFilter::Simulate(Job& job, Result& result)
{
  radiometry::IrradianceOptions options;
  options.RelativeTolerance = this->RelativeTolerance;
  options.AbsoluteTolerance = this->AbsoluteTolerance;
  options.TimeBudget = job.TimeBudget;
  options.PilotOnly = job.PilotOnly;
  options.Threads = job.Threads;
  options.MemoryLimit = job.Memory;
  options.Ranks = job.Ranks;
  options.Cells = job.WantCells;
  options.Switches = job.Switches;
  options.LightVisibility = job.WantVisibility;
  options.RefineShadowBoundaries = this->RefineShadowBoundaries && job.WantCells;
  options.PiecesPerCell = static_cast<std::size_t>(this->MaximumPiecesPerCell);
  if (this->RefineShadowBoundaries && !job.WantCells)
  {
    vtkWarningMacro("RefineShadowBoundaries has no effect with SampleLocation Points: values are "
                    "wanted at the points that there are.");
  }
  if (!this->CacheResults || this->CachedFor != job.Ranks)
  {
    this->Cache->Release();
  }
  this->CachedFor = job.Ranks;
  radiometry::IrradianceResult computed = radiometry::SimulateIrradiance(job.Scene, job.Points,
    options, job.Progress, this->CacheResults ? this->Cache.get() : nullptr);

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
  AddShares(computed.CellVisibility, result.CellShares);
  AddShares(computed.PointVisibility, result.PointShares);
  result.Convergence = std::move(computed.Convergence);
  result.Effects = std::move(computed.Effects);
  result.Cost = computed.Cost;
  result.Outcome = computed.Outcome;
  if (computed.DroppedPeak > 0.0)
  {
    std::ostringstream why;
    why << "lights whose bounds together are small beside the tolerance are left out value by value; "
           "what they may add is part of IrradianceError, on average "
        << computed.DroppedMean << " W/m^2";
    result.Omissions.push_back({ "WeakLights", why.str(), computed.DroppedPeak });
  }
  if (options.RefineShadowBoundaries)
  {
    const radiometry::ShadowPieces& pieces = computed.Pieces;
    const auto whole = std::count(pieces.Whole.begin(), pieces.Whole.end(), 1);
    const std::size_t cells = job.Scene.Cells - static_cast<std::size_t>(whole);
    result.Method = std::to_string(cells) + " cells cut along the edges of shadows into " +
      std::to_string(pieces.Size() - static_cast<std::size_t>(whole)) + " pieces";
    if (pieces.Full > 0)
    {
      result.Method += "; " + std::to_string(pieces.Full) +
        " of them reached the limit of pieces (MaximumPiecesPerCell)";
      vtkWarningMacro(<< pieces.Full << " cells have more shadow edges than "
                      << this->MaximumPiecesPerCell
                      << " pieces can follow (MaximumPiecesPerCell): some run through pieces.");
    }
    result.Pieces = std::move(computed.Pieces);
  }
}

void vtkIrradianceFilter::CopyMembers(vtkRadiometricAlgorithm* from)
{
  this->Superclass::CopyMembers(from);
  auto* other = vtkIrradianceFilter::SafeDownCast(from);
  this->RefineShadowBoundaries = other->RefineShadowBoundaries;
  this->MaximumPiecesPerCell = other->MaximumPiecesPerCell;
  this->CacheResults = other->CacheResults;
}

void vtkIrradianceFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RefineShadowBoundaries: " << this->RefineShadowBoundaries << '\n'
     << indent << "MaximumPiecesPerCell: " << this->MaximumPiecesPerCell << '\n'
     << indent << "CacheResults: " << this->CacheResults << '\n';
}
