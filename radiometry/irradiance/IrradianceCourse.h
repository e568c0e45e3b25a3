// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/DirectRun.h"
#include "radiometry/irradiance/IrradianceCache.h"
#include "radiometry/irradiance/IrradianceSimulation.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace radiometry
{

/// One simulation of direct light from its pilot to its end: cells (or the pieces of them), points,
/// front and back, and the shares of lights. SimulateIrradiance plans it and bounds what it leaves
/// out.
class IrradianceCourse
{
public:
  /// `kept`: values to go on from, and where they stay. All must outlive this.
  IrradianceCourse(const Scene& scene, const OcclusionScene& occluders,
    const std::vector<SurfacePoint>& points, const IrradianceOptions& options,
    const DirectOptions& direct, int sides, IrradianceKept& kept, IrradianceResult& result,
    Monitor* monitor);
  ~IrradianceCourse();

  /// Works on a part of the receivers that lies all over the surface. Returns the seconds that the
  /// whole simulation takes, from its beginning, or its budget where that comes first. Collective.
  double Pilot();
  /// ... and on the rest; fills the result's values, pieces and shares. Collective.
  void Finish();

  std::int64_t Rays = 0;
  bool TimedOut = false;

private:
  double Left() const;
  void CutCells();
  void MakeRuns();
  void FinishCells();
  void FinishPoints(std::size_t side);
  void FindShares();
  double SharesSeconds() const;
  double Budget(std::size_t part) const;

  const Scene& Geometry;
  const OcclusionScene& Occluders;
  const std::vector<SurfacePoint>& Points;
  const IrradianceOptions& Options;
  DirectOptions Direct;
  const std::size_t Sides;
  IrradianceKept& Kept;
  IrradianceResult& Result;
  Monitor* Listener;
  double CellsBegin = 0.02; // progress
  double CellsEnd = 0.02;
  double End = 0.98;
  bool WantShares = false; // that are not there yet

  std::size_t Items = 0; // cells or pieces
  std::vector<Patch> Patches;
  std::array<std::vector<SurfacePoint>, 2> Facing;
  std::unique_ptr<DirectRun<Patch>> CellRun;
  std::array<std::unique_ptr<DirectRun<SurfacePoint>>, 2> PointRuns;
  /// Seconds that the rest of cells, points of each side and shares takes.
  std::array<double, 4> Rest{};
};

} // namespace radiometry
