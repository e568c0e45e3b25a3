// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/accuracy/ConvergenceRecord.h"
#include "radiometry/accuracy/RunCost.h"
#include "radiometry/scene/Communicator.h"
#include "radiometry/scene/Monitor.h"
#include "radiometry/scene/Scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace radiometry
{

enum class ViewFactorMethod
{
  Auto = 0,
  Dense = 1,        // every pair of triangles
  Hierarchical = 2, // clusters of triangles, sampled where they are apart
  MonteCarlo = 3    // rays
};

struct ViewFactorOptions
{
  /// F_ij is refined until its error is below max(RelativeTolerance F_ij, AbsoluteTolerance), and
  /// so is what each patch sees of the environment, the sky and the ground.
  double RelativeTolerance = 0.01;
  double AbsoluteTolerance = 1e-4;
  double TimeBudget = 0.0;     // seconds after which refinement stops; 0: none
  std::size_t MemoryLimit = 0; // bytes; 0: none
  ViewFactorMethod Method = ViewFactorMethod::Auto;
  bool Occlusion = true;
  bool BackFaces = true;  // the backs of two-sided cells belong to their patches
  bool Correction = true; // rows of closed patches are made to sum to one
  Vec3 Up{ 0.0, 0.0, 1.0 };
  int Threads = 0;
  std::uint64_t Seed = 0;
  bool PilotOnly = false; // end, without rows, where the cost of the run is known
  const Communicator* Ranks = nullptr; // that share the work; null: this process alone
};

/// A view factor of each patch, with its error.
struct ViewFactorShare
{
  std::vector<double> Value, Error;
};

struct ViewFactorRow
{
  std::int32_t From, To;
  double Value, Error;
};

struct ViewFactorResult
{
  std::vector<double> Areas; // m^2, of all sides that a patch sees with
  /// One for each ordered pair of patches that see each other, by From, then To.
  std::vector<ViewFactorRow> Rows;
  ViewFactorShare Sum;         // of a patch's rows
  ViewFactorShare Environment; // what meets nothing
  ViewFactorShare Sky, Ground; // ... above and below the horizon
  ViewFactorShare Blocked;     // what meets a back that does not receive, or an occluder
  /// 1 - Sum - Environment - Blocked before correction, these two counted by rays; of a patch that
  /// sees nothing but patches 1 - Sum.
  std::vector<double> ClosureDefect;
  std::vector<std::uint8_t> Closed; // sees nothing but patches
  /// By rays alone: what a patch's view factor to one that none of its rays met stays below (95 %),
  /// by patch; such pairs have no row. Empty: a pair without a row is 0.
  std::vector<double> Unmet;

  double ClosureBefore = 0.0, ClosureAfter = 0.0;         // greatest |1 - Sum| of closed patches
  double ReciprocityBefore = 0.0, ReciprocityAfter = 0.0; // greatest |A_i F_ij - A_j F_ji|/min(A)
  double LargestCorrection = 0.0;                         // of a view factor
  double LargestSum = 0.0;                                // of a patch's rows, before correction
  double MeanTruncation = 0.0, MeanSampling = 0.0;        // of the rows' errors, averaged by F
  double OcclusionBound = 0.0;  // Occlusion false: the most that leaving it out may change an F
  bool OcclusionNeeded = false; // something may stand between
  std::string Method;           // and why
  std::string Outcome;          // what ended the run, and what the user should know
  std::int64_t Pairs = 0;       // of triangles' sides that face each other, each once
  std::int64_t Rays = 0;
  RunCost Cost;
  ConvergenceRecord Convergence;
};

/// View factors between patches, groups of cells.
///   Model   F_IJ = (1/A_I) int_I int_J V cos cos/(pi r^2) dA dA, V: nothing stands between. A
///           patch holds the receiving sides of its cells: front and back of a two-sided one
///   Reads   patchOfCell: the patch of each of the scene's cells, -1: none (it only blocks)
///   Method  pairs of triangles by PairExchange where nothing stands between (proved by shafts),
///           with sampled visibility where something does; far clusters by samples of both ends,
///           allotted where they reduce a factor's error most; the environment by rays
///   Error   covers 95 %: bounds of truncation and rounding, and the spread of four independent
///           sequences
///   Predicts where nothing stands between, after every 16th pair of nodes; else after the first round
///           of samples
///   Cost    O(pairs of triangles) Dense; O(n) and samples Hierarchical; samples MonteCarlo
///   Fails   InputError{"MemoryLimit"}
ViewFactorResult ComputeViewFactors(const Scene& scene,
  const std::vector<std::int32_t>& patchOfCell, std::size_t patches,
  const ViewFactorOptions& options, Monitor* monitor = nullptr);

} // namespace radiometry
