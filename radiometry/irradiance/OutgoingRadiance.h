// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/accuracy/ConvergenceRecord.h"
#include "radiometry/accuracy/RunCost.h"
#include "radiometry/geometry/SeenPolygon.h"
#include "radiometry/irradiance/RadianceTracer.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

struct RadianceOptions
{
  double RelativeTolerance = 0.01; // of each value's error, relative to the value
  double AbsoluteTolerance = 0.0;  // W/(m^2 sr)
  double SecondsLeft = 0.0;        // after that no value is made better; 0: no limit
  double SecondsBefore = 0.0;      // of the run, which its prediction includes
  bool PilotOnly = false;          // end where the cost of the run is known
  int Threads = 0;                 // 0: all
  RadianceEffects Effects;
  /// Share of each light that arrives at each cell of the scene or point, x lights; empty: not known.
  std::vector<float> Known;
};

/// Values with their errors, receivers x bands.
struct RadianceResult
{
  std::vector<double> Values; // W/(m^2 sr)
  std::vector<double> Errors; // half-widths of 95 %
  std::int64_t Rays = 0;
  std::size_t Sampled = 0; // receivers that reflect or transmit
  bool TimedOut = false;
  RunCost Cost; // of this and what was before
  double LeftOut = 0.0; // bound of what the effects that are off may change
};

/// Radiance that cells send toward a viewer, averaged over each cell's area.
///   Model    L = B/pi of the side that is seen + (1/A) int_A [int f(w, out) L(w) cos dw + tau L(-out)]
///            (RadianceTracer.h). Nothing is asked about what stands between the cell and the viewer.
///            A side that sends nothing, and a cell whose plane holds the eye, gives 0
///   Error    of B as given (over pi); of the rest 2.9 standard deviations of eight independent sets
///            of samples, which are doubled until the tolerance is met or 2048 a set, and what errors
///            of the surroundings' B make
///   Cost     O(cells); a cell that reflects specularly or transmits: 64 to 16384 samples of about one
///            ray a light and two more
///   Predicts from every 32nd receiver, which are computed first
///   Bytes    the same for any number of threads
RadianceResult ComputeOutgoingRadiance(const Scene& scene, const OcclusionScene& occluders,
  const DiffuseLight& diffuse, const Viewer& viewer, const std::vector<std::int32_t>& cells,
  const RadianceOptions& options, const StageProgress& stage = {},
  ConvergenceRecord* record = nullptr);

/// The same at points, about their normals. `here`: what is sent diffusely at the points themselves,
/// points x bands. A point on no surface (Triangle -1) gives 0.
RadianceResult ComputeOutgoingRadiance(const Scene& scene, const OcclusionScene& occluders,
  const DiffuseLight& diffuse, const Viewer& viewer, const std::vector<SurfacePoint>& points,
  const DiffuseLight& here, const RadianceOptions& options, const StageProgress& stage = {},
  ConvergenceRecord* record = nullptr);

/// Brings results of some cells to the places of all cells of the scene; the others get 0.
void SpreadToCells(
  const Scene& scene, const std::vector<std::int32_t>& cells, RadianceResult& result);

} // namespace radiometry
