// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/accuracy/ConvergenceRecord.h"
#include "radiometry/accuracy/RunCost.h"
#include "radiometry/effects/SceneEffects.h"
#include "radiometry/irradiance/DirectIrradiance.h"
#include "radiometry/irradiance/LightVisibility.h"
#include "radiometry/irradiance/ShadowPieces.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"

#include <array>
#include <initializer_list>
#include <string>
#include <vector>

namespace radiometry
{

class IrradianceCache;

struct IrradianceOptions
{
  double RelativeTolerance = 0.01;
  double AbsoluteTolerance = 0.0; // W/m^2
  double TimeBudget = 0.0;        // s; 0: none
  int Threads = 0;                // 0: all
  bool Cells = true;              // compute averages over cells
  bool RefineShadowBoundaries = false; // over the pieces into which shadows' edges cut the cells
  std::size_t PiecesPerCell = 1000;    // at most
  bool LightVisibility = false;        // how much of each light arrives, too
  bool PilotOnly = false; // end where the cost of the run is known: Cost.PredictedSeconds
  std::vector<EffectSwitch> Switches = std::vector<EffectSwitch>(EffectCount);
  std::size_t MemoryLimit = 0; // bytes; what is kept for the next run counts; 0: no limit
  const Communicator* Ranks = nullptr; // that share the work; null: this process alone
};

/// Values with their errors, items x bands; empty where not computed.
struct FieldValues
{
  std::vector<double> Values;
  std::vector<double> Errors;
};

struct IrradianceResult
{
  std::array<FieldValues, 2> Cells;  // front, back (where any cell is two-sided); W/m^2; by piece
                                     // when shadows' edges were refined
  std::array<FieldValues, 2> Points;
  std::vector<EffectDecision> Effects;
  ConvergenceRecord Convergence;
  std::string Outcome; // what ended the run
  RunCost Cost;
  double DroppedPeak = 0.0; // greatest bound on weak lights that a value left out: part of its error,
  double DroppedMean = 0.0; // and the mean over the values, W/m^2
  ShadowPieces Pieces; // empty unless shadows' edges were refined
  std::array<LightShares, 2> CellVisibility; // empty unless asked for
  std::array<LightShares, 2> PointVisibility;
};

/// Direct light on a scene: plans the effects, computes what it calls for, bounds what it left out.
/// `cache`: what an earlier run left is gone on from, and this one's is left there; null: nothing is.
/// With PilotOnly the result holds its cost alone.
IrradianceResult SimulateIrradiance(const Scene& scene, const std::vector<SurfacePoint>& points,
  const IrradianceOptions& options, Monitor* monitor = nullptr, IrradianceCache* cache = nullptr);

/// One patch for each receiving triangle, of side 0 or 1; side 1 only where cells are two-sided.
std::vector<Patch> MakePatches(const Scene& scene, int side);

/// Area-weighted means over the patches of one side of each of `count` items (Patch::Cell: cells, or
/// pieces of them). Errors of patches are independent, but for the part of each that is a bound on
/// lights left out (`dropped`, by patch; empty: none): those add up.
FieldValues AverageOver(std::size_t count, int bands, const std::vector<Patch>& patches, int side,
  const std::vector<double>& values, const std::vector<double>& errors,
  const std::vector<float>& dropped = {});

/// The greatest value with its error of fields; 0: there are none.
double GreatestValue(std::initializer_list<const std::array<FieldValues, 2>*> fields);
/// Adds to the errors of all values what may have been dropped of each.
void AddDropped(double bound, std::initializer_list<std::array<FieldValues, 2>*> fields);

} // namespace radiometry
