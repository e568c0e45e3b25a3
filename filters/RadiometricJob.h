// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkRadiometricFilter.h"

#include "radiometry/accuracy/ConvergenceRecord.h"
#include "radiometry/accuracy/RunCost.h"
#include "radiometry/effects/EffectPlan.h"
#include "radiometry/irradiance/ShadowPieces.h"
#include "radiometry/scene/Communicator.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

class SceneAdapter;
class SurfacePoints;

/// What a simulating filter is to compute: made by vtkRadiometricFilter, read by its subclasses.
struct vtkRadiometricFilter::Job
{
  const radiometry::Scene& Scene;
  std::vector<radiometry::EffectSwitch> Switches;
  /// Wanted at points: sensors, and the vertices of surfaces when SampleLocation is Points.
  std::vector<radiometry::SurfacePoint> Points;
  bool WantCells = true;
  radiometry::Monitor* Progress = nullptr;
  /// The processes that compute this together; null: this one alone. Each has the whole scene.
  const radiometry::Communicator* Ranks = nullptr;
  std::size_t Memory = 0; // bytes that the run may take
  int Threads = 0;   // NumberOfThreads, or this process's share of the machine's; 0: all
  bool WantVisibility = false; // how much of each light arrives
  double TimeBudget = 0.0; // seconds that are left of the filter's; 0: no limit
  bool PilotOnly = false; // end where the cost of the run is known
  /// Where the input's own arrays are found.
  const SceneAdapter* Adapter = nullptr;
  const SurfacePoints* Carriers = nullptr;
};

/// What it computed.
struct vtkRadiometricFilter::Result
{
  /// A quantity with its error, values x bands.
  struct Quantity
  {
    std::string Name; // of the array
    std::string Unit;
    std::vector<double> Values;
    std::vector<double> Errors;
  };
  std::vector<Quantity> Cells; // by cell; by piece when there are pieces
  std::vector<Quantity> Points; // as Job::Points
  /// One number for each of them, whatever the bands.
  struct Scalars
  {
    std::string Name;
    std::string Unit;
    std::vector<double> Values;
    bool Integer = false;
  };
  std::vector<Scalars> CellScalars;
  std::vector<Scalars> PointScalars;
  std::vector<std::pair<std::string, std::vector<double>>> Fields; // further field data
  std::string Active = "Irradiance"; // the array that is shown first
  std::string BoundUnit = "W/m^2";   // of the EffectPlan
  radiometry::ConvergenceRecord Convergence;
  std::vector<radiometry::EffectDecision> Effects; // by Effect
  /// Further rows of the EffectPlan: what was left out beside the effects.
  struct Omission
  {
    std::string Name;
    std::string Why;
    double Bound; // W/m^2
  };
  std::vector<Omission> Omissions;
  std::vector<std::pair<std::string, double>> ErrorParts; // mean over the surface, W/m^2
  std::string Outcome;
  radiometry::RunCost Cost;
  std::string Method; // and why
  /// Shares of lights, without unit and error: values x components.
  struct Shares
  {
    std::string Name;
    std::vector<float> Values;
  };
  std::vector<Shares> CellShares;
  std::vector<Shares> PointShares;
  /// Type, position and direction of each light as its input has them: those the shares are of.
  std::vector<std::array<double, 7>> LightKeys;
  radiometry::ShadowPieces Pieces; // into which cells were cut; none: they were not
};
