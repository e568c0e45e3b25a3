// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/irradiance/AreaSources.h"
#include "radiometry/irradiance/SourceFlux.h"
#include "radiometry/scene/Communicator.h"
#include "radiometry/scene/Scene.h"

#include <memory>
#include <vector>

namespace radiometry
{

/// What of the lights is simulated.
struct SpecularLightOptions
{
  double RelativeTolerance = 0.01; // of each value's error, relative to the value ...
  double AbsoluteTolerance = 0.0;  // W/m^2 ... or so much at least
  bool SpotShape = true;
  bool Attenuation = true;
  bool Environment = true;
  double SecondsLeft = 0.0; // no new round of paths that would end after; 0: no limit
  int Threads = 0;
  std::uint64_t Seed = 0;
  const Communicator* Ranks = nullptr; // that share receivers and reflecting elements; null: none
};

/// One thing that shines on mirrors: a light that reaches a point from one direction, or a triangle of
/// an area light or of an emitting surface. (Skies: see MirroredSky.h.)
struct SpecularSource
{
  enum class Kind
  {
    Beam,
    Panel
  };
  Kind Is = Kind::Beam;
  std::vector<double> Intensity; // per band, unit as its kind's
  double Strength = 0.0;         // of the brightest band
  std::unique_ptr<SourceFlux> Beam;
  Triangle3 Corners; // of a panel
  Vec3 Normal;
  double PanelArea = 0.0;
  std::int32_t Triangle = -1; // of the scene that a panel lies on; -1: none

  /// Irradiance of a point for unit intensity, nothing in the way; of a panel roughly.
  double Roughly(const Vec3& point, const Vec3& normal) const;
  /// The same from a point of a panel, exactly.
  double FromPanel(const Vec3& on, const Vec3& point, const Vec3& normal) const;
};

/// The enabled lights of a scene and the emitters treated as lights.
std::vector<SpecularSource> FindSpecularSources(
  const Scene& scene, const EmitterSet& emitters, const SpecularLightOptions& options);

} // namespace radiometry
