// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiosityFilter.h"

#include "RadiometricJob.h"
#include "RadiometricResults.h"
#include "radiometry/scene/ArrayNames.h"
#include "radiometry/scene/InputError.h"
#include "radiometry/scene/Units.h"
#include "radiometry/solver/PlannedRadiosity.h"

#include "vtkObjectFactory.h"

#include <utility>

vtkStandardNewMacro(vtkRadiosityFilter);

namespace
{

namespace names = radiometry::names;
using Quantity = vtkRadiometricFilter::Result::Quantity;

/// Irradiance, radiosity and radiance of one side.
void AddQuantities(int side, radiometry::FieldValues& irradiance, radiometry::FieldValues& radiosity,
  std::vector<Quantity>& quantities)
{
  if (irradiance.Values.empty())
  {
    return;
  }
  const std::string back = side == 1 ? names::BackSuffix : "";
  Quantity radiance{ names::Radiance + back, "W/(m^2 sr)", radiosity.Values, radiosity.Errors };
  for (std::vector<double>* values : { &radiance.Values, &radiance.Errors })
  {
    for (double& value : *values)
    {
      value /= radiometry::units::Pi;
    }
  }
  quantities.push_back({ names::Irradiance + back, "W/m^2", std::move(irradiance.Values),
    std::move(irradiance.Errors) });
  quantities.push_back({ names::Radiosity + back, "W/m^2", std::move(radiosity.Values),
    std::move(radiosity.Errors) });
  quantities.push_back(std::move(radiance));
}

constexpr double Mebibyte = 1024.0 * 1024.0;

} // namespace

vtkRadiosityFilter::vtkRadiosityFilter()
  : Cache(std::make_shared<radiometry::RadiosityCache>())
{
}

vtkRadiosityFilter::~vtkRadiosityFilter() { this->SetOperatorFile(nullptr); }

void vtkRadiosityFilter::ReleaseCache() { this->Cache->Release(); }

double vtkRadiosityFilter::GetCacheMemory()
{
  return static_cast<double>(this->Cache->MemoryBytes()) / Mebibyte;
}

void vtkRadiosityFilter::Simulate(Job& job, Result& result)
{
  radiometry::RadiosityOptions options;
  options.RelativeTolerance = this->RelativeTolerance;
  options.AbsoluteTolerance = this->AbsoluteTolerance;
  options.TimeBudget = job.TimeBudget;
  options.PilotOnly = job.PilotOnly;
  options.MemoryLimit = job.Memory;
  options.Method = static_cast<radiometry::RadiosityMethod>(this->Method);
  options.Refinement = static_cast<radiometry::RefinementMode>(this->Refinement);
  options.MaximumBounces = this->MaximumBounces;
  options.LightVisibility = job.WantVisibility;
  options.Threads = job.Threads;
  options.Ranks = job.Ranks;
  const std::string file = this->OperatorFile ? this->OperatorFile : "";
  if (this->OperatorFileMode != FILE_UNUSED && file.empty())
  {
    throw radiometry::InputError("OperatorFile", -1, "", "the name of a file");
  }
  options.LoadOperator = this->OperatorFileMode == LOAD_FILE ? file : "";
  options.SaveOperator = this->OperatorFileMode == SAVE_FILE ? file : "";

  if (!this->CacheOperator || this->CachedFor != job.Ranks)
  {
    this->Cache->Release();
  }
  this->CachedFor = job.Ranks;
  radiometry::PlannedRadiosity computed = radiometry::SimulatePlannedRadiosity(job.Scene, job.Points,
    job.WantCells, job.Switches, options, job.Progress,
    this->CacheOperator ? this->Cache.get() : nullptr);
  for (int side = 0; side < 2; ++side)
  {
    if (job.WantCells)
    {
      AddQuantities(side, computed.Cells.Irradiance[side], computed.Cells.Radiosity[side],
        result.Cells);
    }
    AddQuantities(
      side, computed.PointIrradiance[side], computed.PointRadiosity[side], result.Points);
  }
  const radiometry::RadiosityErrorBudget& budget = computed.Cells.Parts;
  result.ErrorParts = { { "Error: direct light", budget.Direct },
    { "Error: form factors", budget.FormFactors }, { "Error: visibility", budget.Visibility },
    { "Error: discretisation", budget.Discretisation }, { "Error: solver", budget.Solver } };
  AddShares(computed.CellVisibility, result.CellShares);
  AddShares(computed.PointVisibility, result.PointShares);
  result.Convergence = std::move(computed.Cells.Convergence);
  result.Effects = std::move(computed.Effects);
  result.Cost = computed.Cost;
  result.Outcome = computed.Cells.Outcome;
  result.Method = computed.Cells.MethodWhy;
}

void vtkRadiosityFilter::CopyMembers(vtkRadiometricAlgorithm* from)
{
  this->Superclass::CopyMembers(from);
  auto* other = vtkRadiosityFilter::SafeDownCast(from);
  this->Method = other->Method;
  this->MaximumBounces = other->MaximumBounces;
  this->CacheOperator = other->CacheOperator;
  this->OperatorFileMode = other->OperatorFileMode;
  this->SetOperatorFile(other->OperatorFile);
}

void vtkRadiosityFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  static const char* const methods[] = { "Auto", "Dense", "Hierarchical", "MonteCarlo" };
  os << indent << "Method: " << methods[this->Method] << '\n'
     << indent << "MaximumBounces: " << this->MaximumBounces << '\n'
     << indent << "OperatorFile: " << (this->OperatorFile ? this->OperatorFile : "(none)") << '\n'
     << indent << "OperatorFileMode: " << this->OperatorFileMode << '\n'
     << indent << "CacheOperator: " << this->CacheOperator << '\n';
}
