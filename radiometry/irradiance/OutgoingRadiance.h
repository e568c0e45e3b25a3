// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/accuracy/ConvergenceRecord.h"
#include "radiometry/geometry/SeenPolygon.h"
#include "radiometry/irradiance/IrradianceSimulation.h"
#include "radiometry/irradiance/RadianceTracer.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/scene/Patch.h"
#include "radiometry/scene/Scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace radiometry
{

struct RadianceOptions
{
  double RelativeTolerance = 0.01; // of each value's error, relative to the value
  double AbsoluteTolerance = 0.0;  // W/(m^2 sr)
  double SecondsLeft = 0.0;        // after that no value is made better; 0: no limit
  int Threads = 0;                 // 0: all
  RadianceEffects Effects;
  /// Share of each light that arrives at each cell or point, receivers x lights; empty: not known.
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
  double LeftOut = 0.0; // bound of what the effects that are off may change
};

/// What surfaces send diffusely when this falls on them (front and back; empty: nothing does):
/// B = M + rho E + tau E_other of each side that receives, with their errors. `emission` false: without M.
DiffuseLight ReflectDiffusely(
  const Scene& scene, const std::array<FieldValues, 2>& irradiance, bool emission);

/// A viewer who sees the whole scene: at the distance where a cone of 30 degrees holds the sphere
/// about its box, looking along -z, as a view's Reset Camera sets it.
Viewer HomeViewer(const Scene& scene);
/// The middle of the box of the receiving triangles.
Vec3 MiddleOf(const Scene& scene, double* radius = nullptr);

/// Radiance that cells send toward a viewer, averaged over each cell's area.
///   Model    L = B/pi of the side that is seen + (1/A) int_A [int f(w, out) L(w) cos dw + tau L(-out)]
///            (RadianceTracer.h). Nothing is asked about what stands between the cell and the viewer.
///            A side that sends nothing, and a cell whose plane holds the eye, gives 0
///   Error    of B as given (over pi); of the rest 2.4 standard deviations of eight independent sets
///            of samples, which are doubled until the tolerance is met or 512 a set, and what errors
///            of the surroundings' B make
///   Cost     O(cells); a cell that reflects specularly or transmits: 64 to 4096 samples of about one
///            ray a light and two more
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

} // namespace radiometry
