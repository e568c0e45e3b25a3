// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/formfactor/ElementSet.h"
#include "radiometry/irradiance/SpecularImages.h"
#include "radiometry/irradiance/SpecularSources.h"
#include "radiometry/irradiance/SpecularSurfaces.h"
#include "radiometry/scene/Parallel.h"
#include "radiometry/visibility/OcclusionScene.h"

#include <cstdint>
#include <vector>

namespace radiometry
{

/// The light of lights that arrives at elements over mirrors and glossy surfaces, before any diffuse
/// reflection.
struct SpecularLight
{
  std::vector<double> Irradiance; // elements x bands, W/m^2
  std::vector<double> Error;      // half-widths of 95 %
  std::vector<double> ByPaths;    // of Irradiance what paths found; empty: nothing
  std::vector<double> ByPathsError;
  std::int64_t Paths = 0; // traced from the lights
  bool Converged = true;  // false: the tolerance was not met by so many paths as are worth it
};

/// Finds it for every element.
///   Reads    scene.Lights, emitters treated as lights; of surfaces what SpecularSurfaces.h reads
///   Skies    MirroredSky.h
///   Images   flat perfect mirrors: SpecularImages.h
///   Paths    all else. Each element that reflects is lit by the lights (points spread over it, and
///            over area lights), in proportion to what it gets with nothing in the way; what is visible is sent on by its lobe and followed until it ends.
///            Where it arrives it counts: flux over area. Scrambled Sobol points keyed on the
///            element, eight batches, doubled until the tolerance is met
///   Error    2.7 standard deviations of the batches, averaged with those of the neighbourhood
///   Known    irradiance of each element that the tolerance is relative to, beside this
///   Bytes    sums in whole numbers: the same for any number of threads
///   Cost     each path some rays; from 8 paths for a reflecting element to `MostPaths`
SpecularLight FindSpecularLight(const Scene& scene, const OcclusionScene& occluders,
  const ElementSet& elements, const EmitterSet& emitters, const SpecularSurfaces& surfaces,
  const std::vector<double>& known, const SpecularLightOptions& options,
  const StageProgress& stage = {});

/// The same at points: images there; what paths found of the element that a point lies on (averaged
/// over those around a vertex), with what it differs from its neighbourhood as a part of the error; of
/// sensors in free space not known, the mean of all elements is their error.
SpecularLight SpecularLightAt(const Scene& scene, const OcclusionScene& occluders,
  const ElementSet& elements, const SpecularLight& found, const EmitterSet& emitters,
  const SpecularSurfaces& surfaces, const std::vector<SurfacePoint>& points,
  const SpecularLightOptions& options, const StageProgress& stage = {});

} // namespace radiometry
